//! The systems K1 and K2 of Aono & Kunii 1984 against their printed strings and drawing rules, a system that rewrites
//! in mid-axis, and strings that are refused.
//!
//! Absent: plants of other models, and the contract's own tests (`contract`).

use super::string::Module;
use super::{Cell, D0l, D0lModel};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::clock::Tick;
use phytomer_sim::model::Grow as _;
use phytomer_sim::plant::{ApexFate, Cause, NodeId, Origin, Plant};
use phytomer_sim::pose::{bud_frame, node_frame, pose};
use std::collections::BTreeMap;

fn system(axiom: &str, productions: &[(&str, &str)], cells: &[(&str, f64)]) -> D0l {
    let owned = |(letter, becomes): &(&str, &str)| ((*letter).to_owned(), (*becomes).to_owned());
    let cell = |(letter, length): &(&str, f64)| {
        ((*letter).to_owned(), Cell { length_m: (*length).into(), diameter_mm: 10.0.into() })
    };
    D0l {
        axiom: axiom.to_owned(),
        production: productions.iter().map(owned).collect(),
        cell: cells.iter().map(cell).collect(),
        branching_deg: 45.0.into(),
    }
}

fn k(becomes: &str) -> D0l {
    system("g", &[("g", becomes)], &[("g", 1.0), ("d", 2.0)])
}

fn compiled(system: &D0l) -> D0lModel {
    system.compile(20, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn grown(system: &D0l, age: Tick) -> Plant {
    let mut plant = contract::grown(&compiled(system), age, &contract::seed_of(1, 0));
    pose(&mut plant, age);
    plant
}

/// The string of a plant at an age, in the letters of the paper.
fn string(system: &D0l, age: Tick) -> String {
    let model = compiled(system);
    let letters: Vec<&String> = system.cell.keys().collect();
    let mut plot = contract::sown(&model, &contract::seed_of(1, 0));
    plot.grow_to(age).expect("room to grow");
    let living: &super::string::Living = plot.lives[0].get();
    let write = |module: &Module| match module {
        Module::Cell(letter, _) => letters[usize::from(*letter)].clone(),
        Module::Open(..) => "(".to_owned(),
        Module::Close => ")".to_owned(),
    };
    living.modules.iter().map(write).collect()
}

/// Of level 4 of K2 the paper prints half; the other half is the same again.
#[test]
fn the_strings_of_four_levels_are_those_of_the_paper() {
    let printed = ["g", "d(g)g", "d(d(g)g)d(g)g", "d(d(d(g)g)d(g)g)d(d(g)g)d(g)g"];
    for (age, string_) in (0..).zip(printed) {
        assert_eq!(string(&k("d(g)g"), age), string_, "K1, level {}", age + 1);
    }
    let printed = ["g", "d(g)(g)", "d(d(g)(g))(d(g)(g))", "d(d(d(g)(g))(d(g)(g)))(d(d(g)(g))(d(g)(g)))"];
    for (age, string_) in (0..).zip(printed) {
        assert_eq!(string(&k("d(g)(g)"), age), string_, "K2, level {}", age + 1);
    }
}

/// The mean of the ends of the axes that grow on, x to the right and z up, by the drawing rules with |d| = 2 |g| and
/// 45°.
fn mean_of_ends(plant: &Plant) -> [f64; 3] {
    let growing = |axis: &usize| plant.axes.apex_fate[*axis] == ApexFate::Alive;
    let ends =
        (0..plant.axes.len()).filter(growing).map(|axis| bud_frame(plant, phytomer_sim::plant::AxisId(axis as u32)));
    let ends: Vec<[f32; 3]> = ends.map(|frame| frame.base).collect();
    assert_eq!(ends.len(), 8, "level 4 has eight ends");
    [0, 1, 2].map(|k| ends.iter().map(|end| f64::from(end[k])).sum::<f64>() / ends.len() as f64)
}

#[test]
fn level_4_is_drawn_as_figure_2_shows_it() {
    for (becomes, mean) in [("d(g)g", [-1.508883, 0.0, 5.465990]), ("d(g)(g)", [0.0, 0.0, 4.767767])] {
        let found = mean_of_ends(&grown(&k(becomes), 3));
        for (found, mean) in found.iter().zip(mean) {
            assert!((found - mean).abs() < 1e-5, "{becomes}: {found} is not {mean}");
        }
    }
}

/// Rules 5 and 6: along every axis branches stand left and right by turns, the first on the left, all in one plane.
#[test]
fn branches_stand_on_opposite_sides() {
    let plant = grown(&k("d(g)g"), 4);
    let mut sides: BTreeMap<usize, Vec<f32>> = BTreeMap::new();
    for axis in 1..plant.axes.len() {
        let bearer = plant.axes.bearer[axis];
        let (h, from) = (plant.frames.at(bearer).heading, node_frame(&plant, bearer).base);
        let first = (0..plant.nodes.len()).find(|&node| plant.nodes.axis[node].index() == axis).expect("a cell");
        let b = plant.frames.heading[first];
        assert_eq!(plant.frames.base[first], from, "a branch begins at the tip of its cell");
        assert!((h[0] * b[0] + h[2] * b[2] - 0.5_f32.sqrt()).abs() < 1e-5, "45° off its axis");
        assert!(b[1].abs() < 1e-5, "in the plane");
        sides.entry(plant.nodes.axis[bearer.index()].index()).or_default().push(h[0] * b[2] - h[2] * b[0]);
    }
    assert!(sides.values().any(|sides| sides.len() > 2));
    for sides in sides.values() {
        // Axes stand in the order of their numbers, and the lowest branch of an axis is its first.
        assert!(sides[0] > 0.0, "the left side is drawn first: {sides:?}");
        assert!(sides.windows(2).all(|pair| pair[0] * pair[1] < 0.0), "by turns: {sides:?}");
    }
    let origins = |plant: &Plant| plant.axes.origin[1..].to_vec();
    assert!(origins(&plant).iter().all(|origin| *origin == Origin::Axillary), "K1 is monopodial");
    let dichotomous = grown(&k("d(g)(g)"), 4);
    assert!(origins(&dichotomous).iter().all(|origin| *origin == Origin::Fork), "K2 is dichotomous");
    assert!(dichotomous.axes.order.iter().all(|order| *order == 1));
}

/// `F → F F` puts an internode between any two: the first keeps its number for ten steps, and each keeps its birth.
#[test]
fn a_cell_keeps_its_number_where_a_system_rewrites_in_mid_axis() {
    let doubling = system("F", &[("F", "FF")], &[("F", 0.1)]);
    let mut births: BTreeMap<u32, Tick> = BTreeMap::new();
    for age in 0..=10 {
        let plant = grown(&doubling, age);
        let nodes = &plant.nodes;
        assert_eq!(nodes.len(), 1 << age);
        assert_eq!((nodes.component[0], nodes.birth[0], nodes.rank[0]), (1, 0, 1), "age {age}");
        for node in 0..nodes.len() {
            let birth = *births.entry(nodes.component[node]).or_insert(age);
            assert_eq!(nodes.birth[node], birth, "a component has one birth: {} at age {age}", nodes.component[node]);
            let parent = plant.nodes.parent[node].some().map(NodeId::index);
            assert_eq!(parent, node.checked_sub(1), "a parent comes before its child at each age");
        }
        assert_eq!(births.len(), nodes.len(), "no number is given twice");
    }
}

/// `F → F e F`, `e →`: at age n there are 2ⁿ cells F, and 2ⁿ⁻¹ cells e, which are gone a tick later.
#[test]
fn a_cell_that_vanishes_stays_in_the_ledger() {
    let fleeting = system("F", &[("F", "FeF"), ("e", "")], &[("F", 0.1), ("e", 0.02)]);
    for age in 1..=8_u32 {
        let plant = grown(&fleeting, age);
        let (lasting, short_lived) = (1_usize << age, 1_usize << (age - 1));
        let short = plant.nodes.length.iter().filter(|length| **length < 0.05).count();
        assert_eq!((plant.nodes.len(), short), (lasting + short_lived, short_lived), "age {age}");
        assert_eq!(plant.ledger.len(), short_lived - 1, "age {age}: 1 + 2 + … cells came and went");
        for gone in &plant.ledger {
            assert_eq!((gone.death - gone.birth, gone.length), (1, 0.02), "it stood for one tick: {gone:?}");
            assert_eq!((gone.axis, gone.bearing_axis, gone.order, gone.cause), (0, None, 1, Cause::Rewritten));
            assert!(gone.parent.is_some_and(|parent| parent < gone.component), "it stood on its F: {gone:?}");
        }
        assert_eq!(plant.lived_by(age), u64::from(plant.components()), "all are counted");
        assert_eq!(plant.lived_by(age - 1), u64::from(grown(&fleeting, age - 1).components()));
    }
}

/// Whatever ages are looked at, numbers, births and deaths are those of a plant that is looked at each tick.
#[test]
fn the_ledger_does_not_depend_on_the_ages_looked_at() {
    let slow = system("Fe", &[("F", "FxFx"), ("x", "y"), ("y", ""), ("e", "Fe")], &cells_of("Fxye"));
    let branched = system("F", &[("F", "xF(F)F"), ("x", "")], &cells_of("Fx"));
    for system in [slow, branched] {
        let by_clock = contract::grown_by_the_clock(&compiled(&system), 7, &contract::seed_of(1, 0));
        let model = compiled(&system);
        let mut plot = contract::sown(&model, &contract::seed_of(1, 0));
        for age in [2, 5, 7] {
            plot.grow_to(age).expect("room to grow");
        }
        assert_eq!(contract::components(&by_clock), contract::components(&plot.plants[0]));
        assert_eq!(by_clock.ledger, plot.plants[0].ledger);
        assert_eq!(by_clock.ledger, grown(&system, 7).ledger);
    }
}

fn cells_of(letters: &str) -> Vec<(&str, f64)> {
    (0..letters.len()).map(|at| (&letters[at..=at], 0.1)).collect()
}

/// Neither an apex nor a branch is left in the air.
#[test]
fn a_cell_that_bears_something_may_not_vanish() {
    let told = |axiom: &str, productions: &[(&str, &str)]| {
        let faults = system(axiom, productions, &cells_of("abe")).compile(5, &Path::root()).err().unwrap_or_default();
        faults.iter().map(|fault| format!("{}: {}", fault.path, fault.problem)).collect::<Vec<_>>().join("; ")
    };
    let gone = [("e", "")];
    assert_eq!(told("ea", &gone), "");
    assert_eq!(told("e", &gone), "axiom: `e` ends an axis or bears a branch, and it vanishes");
    assert_eq!(told("e(a)a", &gone), "axiom: `e` ends an axis or bears a branch, and it vanishes");
    assert_eq!(told("a(ae)a", &gone), "axiom: `e` ends an axis or bears a branch, and it vanishes");
    let later = [("e", ""), ("b", "ae")];
    let becomes = "axiom: `b` ends an axis or bears a branch, and it becomes `e`, which vanishes";
    assert_eq!(told("ab", &later), becomes);
    assert_eq!(told("ba", &later), "");
    let borne = [("e", ""), ("a", "e(b)a")];
    assert_eq!(told("a", &borne), "production.a: `e` ends an axis or bears a branch, and it vanishes");
}

#[test]
fn systems_keep_the_contract_of_growth_models() {
    let fleeting = system("F", &[("F", "FxF(F)xF"), ("x", "y"), ("y", "")], &cells_of("Fxy"));
    contract::check(&compiled(&fleeting), 4, 3);
    let mixed = system("ab(a)", &[("a", "b(a)a"), ("b", "bb")], &[("a", 0.1), ("b", 0.2)]);
    for (system, until) in
        [(k("d(g)g"), 6), (k("d(g)(g)"), 6), (system("F", &[("F", "FF")], &[("F", 0.1)]), 7), (mixed, 4)]
    {
        contract::check(&compiled(&system), until, 3);
    }
}

#[test]
fn what_is_no_string_is_told_with_its_column() {
    let told = |axiom: &str| {
        let faults = system(axiom, &[], &[("g", 1.0)]).compile(5, &Path::root()).err().unwrap_or_default();
        faults.iter().map(|fault| fault.problem.clone()).collect::<Vec<_>>().join("; ")
    };
    for (axiom, problem) in [
        ("", "the string is empty"),
        ("gxg", "`x` at column 2 is no cell"),
        ("(g)g", "the branch at column 1 is borne by nothing"),
        ("g((g)g)", "the branch at column 3 is borne by nothing"),
        ("g()g", "the branch that ends at column 3 is empty"),
        ("g)g", "no branch begins before column 2"),
        ("g(g(g)", "1 branches do not end"),
        ("g (g) g", ""),
    ] {
        assert_eq!(told(axiom), problem, "{axiom}");
    }
    let unknown = system("g", &[("x", "g"), ("g", "g(h)")], &[("g", 1.0), ("long", 2.0)]);
    let faults = unknown.compile(70_000, &Path::root()).err().unwrap_or_default();
    let told: Vec<String> = faults.iter().map(|fault| fault.path.to_string()).collect();
    assert_eq!(told, ["", "cell.long", "production.x", "production.g"]);
}

#[test]
fn a_string_that_explodes_stops_at_the_limit_of_components() {
    let model = compiled(&system("g", &[("g", "g(g)(g)(g)g")], &[("g", 1.0)]));
    let seed = phytomer_sim::plant::Seed { component_limit: 10_000, ..contract::seed_of(1, 0) };
    let mut plot = contract::sown(&model, &seed);
    assert!(plot.grow_to(20).is_err());
}

/// The forecast numbers are those of the strings, order by order, also where branches behind the last cell of an axis
/// are a fork and the same branches in mid-axis are not.
#[test]
fn the_forecast_counts_every_string() {
    let cells = [("a", 0.1), ("b", 0.2)];
    let systems = [
        k("d(g)g"),
        k("d(g)(g)"),
        system("F", &[("F", "FF")], &[("F", 0.1)]),
        system("ab(a)", &[("a", "b(a)a"), ("b", "bb")], &cells),
        system("a(b)(a)", &[("a", "b(a)(a)"), ("b", "ab")], &cells),
        system("ab", &[("a", "b(a(b)(b))(a)"), ("b", "b(a)")], &cells),
        system("a", &[("a", "abca"), ("b", "ca(a)"), ("c", "")], &cells_of("abc")),
    ];
    for system in systems {
        let expected = compiled(&system).expectation(5).expect("a forecast");
        for age in 0..=5 {
            let plant = grown(&system, age);
            for (order, foretold) in (1..).zip(&expected.orders) {
                let axes = plant.axes.order.iter().filter(|of| **of == order).count() as f64;
                let on = |axis: &&phytomer_sim::plant::AxisId| plant.axes.order[axis.index()] == order;
                let gone = plant.ledger.iter().filter(|gone| gone.order == order).count();
                let nodes = (plant.nodes.axis.iter().filter(on).count() + gone) as f64;
                let at = age as usize;
                let (of, string) = ((foretold.axes[at], foretold.nodes[at]), string(&system, age));
                assert_eq!(of, (axes, nodes), "axes and cells of order {order} at age {age}: {string}");
            }
            assert_eq!(expected.components(age), f64::from(plant.components()), "age {age}");
        }
    }
    let doubling = compiled(&system("F", &[("F", "FF")], &[("F", 0.1)]));
    assert_eq!(doubling.expectation(65_535).expect("a forecast").components(65_535), f64::INFINITY);
}
