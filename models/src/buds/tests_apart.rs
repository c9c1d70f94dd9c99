//! Plants in stands whose axes ask about stems and surfaces once a growth unit, where they meet nothing, are those
//! whose axes ask at each node: species drawn at random, far from one another, in one another, with boxes that just
//! touch, and above ground beside a block.
//!
//! A bud that feels ahead by next to nothing feels nothing, but lets each node ask. Absent: what shoots do that meet
//! something (`tests_contact`, `tests_stems`).

use super::BudModel;
use super::start::Start;
use super::tests_random::RandomSpecies;
use crate::fault::Path;
use phytomer_sim::Tick;
use phytomer_sim::plant::{ApexFate, AxisId, Plant, Seed};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::shape::{Cuboid, Shape};
use phytomer_sim::site::stems::{Spared, Stems, Whose};
use phytomer_sim::site::{Manner, Obstacle, Side};
use std::sync::Arc;

/// The last tick of the stands, and the one at which boxes just touch.
const UNTIL: Tick = 9;
const TOUCH: Tick = 5;
/// How far a bud feels ahead whose nodes all ask, metres.
const NEXT_TO_NOTHING: f64 = 1e-300;

/// How many growth units of three nodes are known to meet nothing, and how many are not.
#[derive(Debug, Default)]
struct Units {
    free: usize,
    asked: usize,
}

impl Units {
    fn count(&mut self, plot: &Plot<'_>, tick: Tick, model: &BudModel) {
        let ages: Vec<Option<Tick>> = plot.members.iter().map(|member| member.age_at(tick)).collect();
        let stems = Stems::of(&plot.plants, &ages, plot.site.whose_stems);
        for plant in &plot.plants {
            let living = (0..plant.axes.len()).filter(|axis| plant.axes.apex_fate[*axis] == ApexFate::Alive);
            for axis in living.map(|axis| AxisId(axis as u32)) {
                let spared = Spared { plant: plant.id, axis: axis.0 };
                let reach = &model.laws(plant.axes.order[axis.index()]).reach;
                let length = reach.length(false, 3) + reach.radius;
                let is_free = Start::of(plant, axis).is_far(&stems, length, spared);
                *(if is_free { &mut self.free } else { &mut self.asked }) += 1;
            }
        }
    }
}

/// A block beside the first of three plants.
fn block() -> Obstacle {
    let shape = Shape::Cuboid(Cuboid { low: [0.03, -0.2, 0.0], high: [0.3, 0.2, 0.25] });
    Obstacle { shape: Arc::new(shape), kills: Side::Inside, manner: Manner::Blocks { holds: true } }
}

/// Three plants in a row, so far apart, a little above ground beside a block if they are among `solids`; `None` where
/// one of them outgrows its room.
fn grown<'m>(
    model: &'m BudModel,
    apart: [f64; 2],
    (whose, solids): (Whose, bool),
    mut each_tick: impl FnMut(&Plot<'_>, Tick),
) -> Option<Plot<'m>> {
    let sowing = |number: u32, x: f64| {
        let seed = Seed { plant: number, draws: number.into(), run_seed: 23, component_limit: 4000, keep_events: true };
        Sowing { species: 0, seed, place: [x, 0.0, 0.01], sown: number % 2 }
    };
    let sowings = [sowing(0, 0.0), sowing(1, apart[0]), sowing(2, apart[0] + apart[1])];
    let mut plot = Plot::new(0, vec![model], &sowings);
    plot.site.whose_stems = whose;
    if solids {
        (plot.site.ground, plot.site.obstacles) = (Some(0.0), vec![block()]);
    }
    for tick in 1..=UNTIL {
        plot.site.begin(tick);
        plot.grow_to(tick).ok()?;
        plot.stand(tick);
        each_tick(&plot, tick);
    }
    Some(plot)
}

/// The distances between three plants at which the boxes about their stems touch at a tick, if they grow as alone.
fn touching(model: &BudModel) -> Option<[f64; 2]> {
    let mut spans = [[0.0_f64; 2]; 3];
    let _ = grown(model, [1e3; 2], (Whose::Nobody, false), |plot, tick| {
        if tick == TOUCH {
            for (span, plant) in spans.iter_mut().zip(&plot.plants) {
                let radius = plant.nodes.diameter.iter().fold(0.0_f32, |most, diameter| most.max(0.5 * diameter));
                for base in &plant.frames.base {
                    *span = [span[0].min(f64::from(base[0] - radius)), span[1].max(f64::from(base[0] + radius))];
                }
            }
        }
    })?;
    Some([spans[0][1] - spans[1][0], spans[1][1] - spans[2][0]])
}

fn assert_same(one: &Plant, other: &Plant, told: &str) {
    assert!(one.axes == other.axes, "{told}: axes");
    assert!(one.nodes == other.nodes, "{told}: nodes");
    assert!(one.organs == other.organs, "{told}: organs");
    assert!(one.events == other.events, "{told}: events");
    assert!(one.stated == other.stated && one.stated_organs == other.stated_organs, "{told}: turns");
    assert!(one.frames.base == other.frames.base, "{told}: places");
    assert_eq!(one.components(), other.components(), "{told}");
}

#[test]
fn axes_that_meet_nothing_grow_as_if_each_node_had_asked() {
    let mut species = RandomSpecies::new(31);
    let (mut units, mut stands, mut turned) = (Units::default(), 0, 0);
    for number in 0..220_u32 {
        let Some((text, mut buds)) = species.next() else { continue };
        let answer = ["deflect", "pause", "die"][number as usize % 3];
        buds.contact = serde_json::from_value(serde_json::json!({ "answer": answer })).expect("an answer");
        let Ok(model) = buds.compile(UNTIL, &Path::default()) else { continue };
        let Some(touch) = touching(&model) else { continue };
        let more = [0.0, 1e-4, 2e-3, 0.02, 0.2, 2.0][number as usize / 3 % 6];
        let mut asking = buds.compile(UNTIL, &Path::default()).expect("it was compiled");
        asking.contact.cone.length = NEXT_TO_NOTHING;
        let stood = [
            (touch.map(|apart| apart + more), (Whose::Neighbours, false)),
            ([0.01, 0.03], (Whose::Neighbours, false)),
            ([0.0, 0.3], (Whose::All, false)),
            ([0.6, 0.4], (Whose::Nobody, true)),
            ([0.35, 0.01], (Whose::All, true)),
        ];
        for (apart, met) in stood {
            let quick = grown(&model, apart, met, |plot, tick| units.count(plot, tick, &model));
            let slow = grown(&asking, apart, met, |_, _| ());
            let told = format!("species {number}, {apart:?} m apart, {met:?}: {text}");
            assert_eq!(quick.is_none(), slow.is_none(), "{told}");
            let (Some(quick), Some(slow)) = (quick, slow) else { continue };
            stands += 1;
            for (one, other) in quick.plants.iter().zip(&slow.plants) {
                assert_same(one, other, &told);
                turned += usize::from(!one.stated.is_empty());
            }
        }
    }
    println!("{stands} stands, {turned} plants turned, {units:?}");
    assert!(stands > 150 && turned > 20, "{stands} stands, {turned} plants turned");
    assert!(units.free > 2_000 && units.asked > 2_000, "{units:?}");
}
