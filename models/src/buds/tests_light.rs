//! Laws and responses of the light of a bud: full light changes no byte, shade acts as the closed forms say, and no
//! order of plants and no number of threads shows.
//!
//! Bounds are four standard errors. Absent: how light is found (`phytomer_sim::site::light`).

use super::params::{Axillary, GrowthUnit, Internode, Leaf, Response, Target};
use super::tests::{chimera, hydra};
use super::{BudModel, Buds, Order};
use crate::contract::{self, seed_of};
use crate::fault::Path;
use crate::law::{Count, Law, LawForm, Variate};
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{ApexFate, AxisId, Cause, EventKind, Plant};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::shape::{Cuboid, Shape};
use phytomer_sim::site::light::field::grid_of;
use phytomer_sim::site::light::{Light, Lighting, Projection, Sky, Standing};
use phytomer_sim::{Tick, grow};
use std::sync::Arc;

fn compiled(buds: &Buds, until: Tick) -> BudModel {
    buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn expression(text: &str) -> Law {
    Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() })
}

fn response(acts_on: &[Target], law: &str) -> Response {
    Response { acts_on: acts_on.iter().copied().collect(), law: expression(law), reference: 1.0, orders: None }
}

fn roof() -> Arc<Shape> {
    Arc::new(Shape::Cuboid(Cuboid { low: [-1e4, -1e4, 50.0], high: [1e4, 1e4, 51.0] }))
}

/// Plants of these models a metre apart, grown in this light; the numbers of the plants are those of their sowings.
fn grown(models: &[&dyn GrowthModel], numbers: &[u32], until: Tick, lighting: Option<Lighting>) -> Vec<Plant> {
    let sowing = |number: &u32| Sowing {
        species: *number as usize % models.len(),
        seed: seed_of(12, *number),
        place: [f64::from(number % 4), f64::from(number / 4), 0.0],
        sown: 0,
    };
    let mut plot = Plot::new(0, models.to_vec(), &numbers.iter().map(sowing).collect::<Vec<_>>());
    plot.site.light = lighting.map(Light::of);
    plot.ask_light();
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.plants
}

/// Everything in the columns of a plant, by which tables are written.
fn columns(plant: &Plant) -> String {
    format!("{:?} {:?} {:?} {:?}", plant.axes, plant.nodes, plant.organs, plant.events)
}

/// A response that names the light and does not change with it, a response that does and is grown without `[light]`,
/// and a species without any law of light in deep shade: all have the bytes of none. Growth by the clock numbers
/// components by tick, so plants that follow it are compared with plants that do.
#[test]
fn at_full_light_and_without_light_no_byte_changes() {
    let sky = Sky { rings: 2, azimuths: 4, ..Sky::default() };
    let dark = || Lighting { voxel_m: 0.25, sky, opaque: vec![roof()], ..Lighting::default() };
    for buds in [chimera(), hydra()] {
        let steady = Response { reference: 1.0, ..response(&Target::ALL, "0.3 + 0 * light") };
        let changing = response(&Target::ALL, "0.2 + 0.6 * light");
        let with = |response: Response| compiled(&Buds { response: vec![response], ..buds.clone() }, 12);
        let (plain, steady, changing) = (compiled(&buds, 12), with(steady), with(changing));
        let numbers: Vec<u32> = (0..12).collect();
        let of = |model: &BudModel, light| grown(&[model], &numbers, 12, light).iter().map(columns).collect::<Vec<_>>();
        let known = of(&plain, None);
        assert!(known == of(&changing, None), "without light");
        assert!(known == of(&plain, Some(dark())), "without a law of light");
        let by_the_clock = |model: &BudModel, light: Option<Lighting>| -> Vec<String> {
            let compared = |plant: &Plant| format!("{:?}", contract::components(plant));
            grown(&[model], &numbers, 12, light).iter().map(compared).collect()
        };
        assert!(by_the_clock(&plain, None) == by_the_clock(&steady, Some(dark())), "at the reference");
        assert!(by_the_clock(&plain, None) != by_the_clock(&changing, Some(dark())), "in the dark it responds");
        assert_eq!(plain.expectation(12), changing.expectation(12));
    }
}

#[track_caller]
fn assert_share(happened: usize, of: usize, p: f64, what: &str) {
    let (share, error) = (happened as f64 / of as f64, (p * (1.0 - p) / of as f64).sqrt());
    assert!((share - p).abs() <= 4.0 * error, "{what}: {share} of {of}, expected {p} ± {error}");
}

/// In the dark a bud dies of itself with .1 and of shade with .3 more, in one draw; in the open with .1.
#[test]
fn a_bud_dies_of_itself_or_of_shade_in_one_draw() {
    let order = |death: &str| Order { death: expression(death), ..Order::default() };
    let stated = Buds { order: vec![order("0.1 + 0.3 * (1 - light)")], ..Buds::default() };
    // A hazard q joins as p + q − p q = .4.
    let hazard = response(&[Target::Death], "(1 - light) / 3");
    let joined = Buds { order: vec![order("0.1")], response: vec![hazard], ..Buds::default() };
    for buds in [stated, joined] {
        let model = compiled(&buds, 1);
        let numbers: Vec<u32> = (0..4_000).collect();
        let fates = |lighting| {
            let plants = grown(&[&model], &numbers, 1, lighting);
            for plant in &plants {
                let fate = plant.axes.apex_fate[0];
                assert_eq!(fate == ApexFate::Shaded, fate.cause() == Cause::Shaded);
                let event = plant.events.as_ref().and_then(|events| events.last()).map(|event| event.kind);
                assert_eq!(fate == ApexFate::Shaded, event == Some(EventKind::Shaded));
            }
            [ApexFate::Died, ApexFate::Shaded].map(|fate| plants.iter().filter(|p| p.axes.apex_fate[0] == fate).count())
        };
        // A bud or two a voxel, and few directions: light is whole or none here.
        let coarse =
            || Lighting { voxel_m: 1.0, sky: Sky { rings: 1, azimuths: 3, ..Sky::default() }, ..Lighting::default() };
        let [died, shaded] = fates(Some(Lighting { opaque: vec![roof()], ..coarse() }));
        assert_share(died, 4_000, 0.1, "of itself");
        assert_share(shaded, 4_000, 0.3, "of shade");
        assert_eq!(fates(Some(coarse())), [died, 0], "in the open the same buds die of themselves");
        assert_eq!(fates(None), [died, 0]);
    }
}

/// A bush with large leaves whose buds die in shade, and a tree that is only slowed.
fn thicket() -> [BudModel; 2] {
    let slowed = response(&[Target::Nodes, Target::InternodeLength], "0.2 + 0.8 * light");
    [bush("0.02 + 0.5 * (1 - light)", Vec::new()), bush("0.02", vec![slowed])]
}

/// A bush with large leaves whose buds die by this law, with these responses.
fn bush(death: &str, response: Vec<Response>) -> BudModel {
    let leafy = |death: &str| Order {
        death: expression(death),
        growth_unit: GrowthUnit { nodes: Count::from(2), ..GrowthUnit::default() },
        internode: Internode {
            length_cm: Variate::from(6.0),
            thickening_mm: expression("0.5 * dimension"),
            ..Internode::default()
        },
        leaf: Leaf {
            per_node: Count::from(2),
            length_cm: Variate::from(15.0),
            width_cm: Variate::from(9.0),
            ..Leaf::default()
        },
        axillary: Axillary { buds: Count::from(2), ramification: Law::from(0.7), ..Axillary::default() },
        insertion_deg: Variate::from(60.0),
        ..Order::default()
    };
    compiled(&Buds { order: vec![leafy(death), leafy(death), leafy(death)], response, ..Buds::default() }, 9)
}

#[test]
fn neither_threads_nor_the_order_of_plants_show() {
    let [bush, tree] = thicket();
    let models: [&dyn GrowthModel; 2] = [&bush, &tree];
    let sky = Sky { rings: 3, azimuths: 5, ..Sky::default() };
    let lighting = || Some(Lighting { voxel_m: 0.2, sky, ..Lighting::default() });
    let numbers: Vec<u32> = (0..12).collect();
    let known = grown(&models, &numbers, 9, lighting());
    let shaded = |plant: &Plant| plant.axes.apex_fate.iter().filter(|fate| **fate == ApexFate::Shaded).count();
    assert!(known.iter().map(shaded).sum::<usize>() > 20, "buds die of shade");
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let mut order = numbers.clone();
        order.rotate_left(threads);
        order.reverse();
        let mut again = pool.install(|| grown(&models, &order, 9, lighting()));
        again.sort_by_key(|plant| plant.id);
        for (plant, same) in known.iter().zip(&again) {
            assert!(columns(plant) == columns(same), "plant {} on {threads} threads", plant.id);
            assert!(plant.frames.base == same.frames.base && plant.shade == same.shade);
        }
    }
}

/// Buds that read the light and do not answer it are the same alone and among neighbours. The beams that meet a voxel
/// of one plant are the same ones, and meet all that they met and more: so no bud has more light than alone, and those
/// that die of shade do so the sooner.
#[test]
fn no_bud_has_more_light_among_neighbours() {
    let deaf = bush("0.02", vec![response(&[Target::Death], "0 * light")]);
    let sky = Sky { rings: 3, azimuths: 5, ..Sky::default() };
    let light = || Some(Lighting { voxel_m: 0.2, sky, ..Lighting::default() });
    let numbers: Vec<u32> = (0..12).collect();
    let together = grown(&[&deaf], &numbers, 7, light());
    let (mut all, mut darker) = (0, 0);
    for (number, among) in numbers.iter().zip(&together) {
        let alone = &grown(&[&deaf], &[*number], 7, light())[0];
        assert_eq!(format!("{:?}", alone.axes), format!("{:?}", among.axes), "plant {number}");
        for axis in (0..alone.axes.len()).map(|axis| AxisId(axis as u32)) {
            let [alone, among] = [alone, among].map(|plant| plant.shade.of(axis));
            assert!(among >= alone, "plant {number}, {axis:?}: {among} below {alone} hundredths of shade");
            all += 1;
            darker += u32::from(among > alone);
        }
    }
    // They stand a metre apart, and the lowest ring of the sky is 6.5° above the ground.
    println!("{darker} of {all} buds have less light than alone");
    assert!(4 * darker > all, "{darker} of {all} buds have less light");
}

/// One plant shades itself; in a stand more of its buds die, and less grows.
#[test]
fn a_plant_shades_itself_and_its_neighbours() {
    let [bush, _] = thicket();
    let sky = Sky { rings: 3, azimuths: 5, ..Sky::default() };
    let light = || Some(Lighting { voxel_m: 0.2, sky, ..Lighting::default() });
    let numbers: Vec<u32> = (0..12).collect();
    let alone: Vec<Plant> = numbers.iter().flat_map(|number| grown(&[&bush], &[*number], 9, light())).collect();
    let together = grown(&[&bush], &numbers, 9, light());
    let shaded = |plants: &[Plant]| {
        let of = |plant: &Plant| plant.axes.apex_fate.iter().filter(|fate| **fate == ApexFate::Shaded).count();
        plants.iter().map(of).sum::<usize>()
    };
    let made = |plants: &[Plant]| plants.iter().map(Plant::components).sum::<u32>();
    let shaded = [shaded(&alone), shaded(&together)];
    let made = [made(&alone), made(&together)];
    assert!(shaded[0] > 100 && shaded[1] > shaded[0], "{shaded:?} die of shade, alone and together");
    assert!(made[1] < made[0], "{made:?} components, alone and together");
}

/// Leaf area that is kept from tick to tick is that of all leaves added anew: of leaves that grow for some ticks, fall
/// with their branches or before them; of leaves that turn, too.
#[test]
fn leaf_area_that_is_kept_is_that_of_all_leaves() {
    let tree = |trend: serde_json::Value| {
        let leaf = serde_json::json!({
            "per_node": 2, "length_cm": 15, "width_cm": 9, "life": {"binomial": {"n": 6, "p": 0.5}}, "trend": trend,
            "expansion": {"linear": {"over": "dimension", "start": 0.25, "slope": 0.25, "max": 1}},
        });
        let order = |insertion: f64, death: f64| {
            serde_json::json!({
                "insertion_deg": insertion, "death": death, "shed_after": 1, "leaf": leaf,
                "axillary": {"buds": 1, "ramification": 0.6}, "internode": {"length_cm": 6, "diameter_mm": 3},
            })
        };
        let response = serde_json::json!([{"acts_on": ["nodes"], "law": {"expression": "light"}, "reference": 1}]);
        super::tests_contact::compiled(
            serde_json::json!({"response": response, "order": [order(5.0, 0.0), order(60.0, 0.2), order(50.0, 0.3)]}),
            20,
        )
    };
    let turning = serde_json::json!({"inclination_deg": 150, "share": 0.2});
    for (model, kept) in [(tree(serde_json::Value::Null), true), (tree(turning), false)] {
        for projection in [Projection::Even(0.5), Projection::OfLeaves] {
            let sowing = |number: u32| Sowing {
                species: 0,
                seed: seed_of(3, number),
                place: [0.4 * f64::from(number), 0.1, 0.0],
                sown: number,
            };
            let mut plot = Plot::new(0, vec![&model], &(0..5).map(sowing).collect::<Vec<_>>());
            let sky = Sky { rings: 1, azimuths: 3, ..Sky::default() };
            plot.site.light = Some(Light::of(Lighting { voxel_m: 0.2, projection, sky, ..Lighting::default() }));
            plot.ask_light();
            let (mut gone, mut is_kept) = (0, false);
            for tick in 1..=16 {
                plot.site.begin(tick);
                plot.grow_to(tick).expect("room to grow");
                plot.stand(tick);
                let ages: Vec<Option<Tick>> = plot.members.iter().map(|member| member.age_at(tick)).collect();
                let standing = Standing { plants: &plot.plants, ages: &ages, wood: false, feel: &[true; 5] };
                let light = plot.site.light.as_ref().expect("light");
                let fresh = grid_of(&light.lighting, &standing);
                assert!(light.found.as_ref().expect("it was found").grid == fresh, "tick {tick}");
                is_kept = light.counted.counts();
                let organs = |plant: &Plant| plant.organs.death.iter().filter(|death| **death == tick).count();
                gone += plot.plants.iter().map(organs).sum::<usize>();
            }
            assert!(gone > 50 && is_kept == kept, "{gone}, {is_kept}");
        }
    }
}

/// Where nothing asks for diameters, plants in light stand without them until the last tick: all is as if they had been
/// thickened at each.
#[test]
fn plants_that_are_thickened_at_the_last_tick_alone_are_the_same() {
    let [bush, tree] = thicket();
    let models: [&dyn GrowthModel; 2] = [&bush, &tree];
    let lighting = || Lighting { voxel_m: 0.2, ..Lighting::default() };
    let late = grown(&models, &[0, 1, 2, 3], 9, Some(lighting()));
    let sowing = |number: u32| Sowing {
        species: number as usize % 2,
        seed: seed_of(12, number),
        place: [f64::from(number % 4), f64::from(number / 4), 0.0],
        sown: 0,
    };
    let mut plot = Plot::new(0, models.to_vec(), &(0..4).map(sowing).collect::<Vec<_>>());
    plot.site.light = Some(Light::of(lighting()));
    plot.ask_light();
    for tick in 0..=9 {
        plot.site.begin(tick);
        if tick > 0 {
            plot.grow_to(tick).expect("room to grow");
        }
        plot.stand(tick);
    }
    for (late, each) in late.iter().zip(&plot.plants) {
        let thickened = |node: &usize| late.nodes.diameter[*node] > late.nodes.primary_diameter[*node];
        assert!((0..late.nodes.len()).filter(thickened).count() > 50);
        assert!(late.nodes == each.nodes && late.axes == each.axes && late.organs == each.organs);
        let frames = |plant: &Plant| (plant.frames.base.clone(), plant.frames.heading.clone(), plant.frames.up.clone());
        assert_eq!(frames(late), frames(each));
    }
}

/// What is foretold is told of full light for responses, and of no light law.
#[test]
fn a_law_of_light_has_no_forecast() {
    let [bush, tree] = thicket();
    assert!(bush.expectation(9).is_none() && tree.expectation(9).is_some());
    assert!(bush.sees_light() && tree.sees_light() && !compiled(&chimera(), 3).sees_light());
}
