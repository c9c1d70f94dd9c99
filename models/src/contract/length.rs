//! The clause of runs of different lengths: a plant at an age does not depend on how much longer the run lasts.
//!
//! A model is compiled for the last age of a run, so two models are compared: one compiled for the age itself, one for
//! a longer run. Absent on purpose: growing on past that age, which may not change the past ([`ages_agree`]).
//!
//! [`ages_agree`]: super::ages_agree

use super::bending::bent;
use super::component::{assert_same, born_by, events};
use super::{grown, structure::standing};
use phytomer_sim::clock::Tick;
use phytomer_sim::grow::stand;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{OrganId, Plant, Seed};
use phytomer_sim::pose::organ_frame;
use phytomer_sim::site::Site;

/// A plant grown to `age` by a model that was compiled for a run up to `age` equals the plant grown to `age` by the
/// same model compiled for a longer run: component for component, event for event, and at ages on the way in its
/// diameters, the size of its organs and the frame of each internode and organ, bit for bit; bent, where its wood
/// bends.
///
/// # Panics
/// At the first difference.
pub fn the_length_of_the_run_leaves_no_trace(
    compiled_for_age: &dyn GrowthModel,
    compiled_for_more: &dyn GrowthModel,
    age: Tick,
    seed: &Seed,
) {
    let rule = "a plant does not depend on how long the run lasts";
    let [mut short, mut long] = [compiled_for_age, compiled_for_more].map(|model| grown(model, age, seed));
    assert_same(rule, &born_by(&short, age), &born_by(&long, age));
    assert_same(&format!("{rule}, event for event"), &events(&short), &events(&long));
    assert_eq!(short.death, long.death, "{rule}, to the death of the plant");
    let weightless = Site { gravity: 0.0, ..Site::default() };
    let ages = [1, age / 3, 2 * age / 3, age].into_iter().filter(|&age| age > 0);
    for age in ages {
        let looks = [(compiled_for_age, &mut short), (compiled_for_more, &mut long)].map(|(model, plant)| {
            stand(model, plant, age, &weightless);
            look(plant, age)
        });
        assert!(looks[0] == looks[1], "{rule}, to diameters, sizes and frames at age {age}");
    }
    if compiled_for_age.habit().wood.as_ref().is_some_and(|wood| wood.bends) {
        let frames = [compiled_for_age, compiled_for_more].map(|model| look(&bent(model, age, seed, true), age));
        assert!(frames[0] == frames[1], "{rule}, to the frames of what bends");
    }
}

/// Diameters and frames of the internodes that stand, share and frame of the organs that live, as bits.
fn look(plant: &Plant, age: Tick) -> Vec<u32> {
    let (nodes, frames, organs) = (&plant.nodes, &plant.frames, &plant.organs);
    let mut bits = Vec::new();
    let mut see = |numbers: &[f32]| bits.extend(numbers.iter().map(|x| x.to_bits()));
    for node in standing(plant, age) {
        see(&[nodes.diameter[node], nodes.diameter_tip[node]]);
        [frames.base[node], frames.heading[node], frames.up[node]].iter().for_each(|vector| see(vector));
    }
    for organ in (0..organs.len()).filter(|&organ| organs.birth[organ] <= age && age < organs.death[organ]) {
        let id = OrganId(organ as u32);
        let frame = organ_frame(plant, id, age);
        see(&[plant.expanded(id, age)]);
        [frame.base, frame.heading, frame.up].iter().for_each(|vector| see(vector));
    }
    bits
}
