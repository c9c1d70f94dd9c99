//! Laws of the height of the plant: closed forms of a trunk that stops, one plant on any number of threads, and what a
//! cut does to a law.
//!
//! Absent: other variables (`tests_variables`).

use super::params::GrowthUnit;
use super::{BudModel, Buds, Order};
use crate::contract::{components, seed_of};
use crate::law::{Count, Law, LawForm, Variate};
use phytomer_sim::management::{Act, Choice, Management, Operation, Region, Start, When};
use phytomer_sim::plant::Plant;
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::{Tick, grow};

/// A node of 1 cm a tick, unless the trunk pauses; none dies.
fn pausing(pause: &str) -> Order {
    let pause = Law::from(LawForm { expression: Some(pause.to_owned()), ..LawForm::default() });
    Order { pause, growth_unit: GrowthUnit { nodes: Count::from(1), ..GrowthUnit::default() }, ..Order::default() }
}

fn compiled(order: Order, until: Tick) -> BudModel {
    let buds = Buds { order: vec![order], ..Buds::default() };
    buds.compile(until, &crate::fault::Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn grown(model: &BudModel, until: Tick, operations: &[Operation]) -> Vec<Plant> {
    let sowing = |number| Sowing { species: 0, seed: seed_of(2, number), place: [0.0; 3], sown: number };
    let mut plot = Plot::new(0, vec![model], &(0..4).map(sowing).collect::<Vec<_>>());
    plot.manage(Management::of(operations.to_vec().into()));
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.plants
}

/// A law reads the height at the end of the last tick, in steps of 5 cm that have been reached.
#[test]
fn a_trunk_stops_at_the_height_that_its_law_names() {
    for (pause, nodes) in
        [("height_m >= 0.1", 10), ("height_m > 0.1", 15), ("height_m >= 0.12", 15), ("min(1, 20 * height_m)", 5)]
    {
        let model = compiled(pausing(pause), 40);
        for plant in grown(&model, 40, &[]) {
            assert_eq!(plant.nodes.len(), nodes, "{pause}");
            assert!((plant.height - 0.01 * nodes as f32).abs() < 1e-6);
        }
    }
    // Where no law asks, nobody measures.
    assert!(grown(&compiled(pausing("age > 9"), 40), 40, &[]).iter().all(|plant| plant.height == 0.0));
}

/// A trunk that is topped below the height is free to grow again: at each topping to 5 cm it grows back to 10 cm.
#[test]
fn a_law_answers_what_a_cut_has_made_of_the_height() {
    let mut order = pausing("height_m >= 0.1");
    order.axillary.buds = Count::from(1);
    order.axillary.ramification = Law::from(0.0);
    order.traumatic.probability = Law::from(1.0);
    order.traumatic.insertion_deg = Variate::from(0.0);
    let model = compiled(order, 60);
    let top = Operation {
        act: Act::Clear(Region::Above(0.055), u8::MAX),
        when: When::once(Start::Age(20)),
        plants: None,
        choice: Choice::default(),
    };
    for plant in grown(&model, 60, &[top]) {
        assert_eq!((plant.axes.len(), plant.nodes.len()), (2, 10 + 5), "a shoot of the stump");
        assert!((plant.height - 0.1).abs() < 1e-6, "{}", plant.height);
    }
}

#[test]
fn plants_that_see_their_height_are_one_on_any_number_of_threads() {
    let mut buds = super::tests::hydra();
    for order in &mut buds.order {
        order.pause =
            Law::from(LawForm { expression: Some("min(0.9, 0.5 * height_m)".to_owned()), ..LawForm::default() });
    }
    let model = buds.compile(24, &crate::fault::Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"));
    let all = [1, 2, 7].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| grown(&model, 24, &[]))
    });
    for (one, other) in all[1..].iter().flat_map(|plants| plants.iter().zip(&all[0])) {
        assert_eq!(one.height.to_bits(), other.height.to_bits());
        assert!(components(one) == components(other));
    }
    assert!(all[0].iter().any(|plant| plant.height > 0.2), "they grow");
}
