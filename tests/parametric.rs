//! The shipped species of Weber & Penn 1995 against the appendix of their paper, and the numbers of stems and leaves
//! that follow from its equations.
//!
//! Absent: the equations (`models/src/parametric`), and how the trees look (`docs/gallery.md`).

use phytomer_config::{Model, validate_species};
use phytomer_sim::Plot;
use phytomer_sim::plant::{MOST_COMPONENTS, Origin, Plant, Seed};
use serde_json::Value;

/// The appendix, row by row: the parameters, and their values for the Quaking Aspen, the Black Tupelo, the Weeping
/// Willow and the California Black Oak. Of a row with ZScale and ZScaleV, 1 and 0 in each, the first two.
const APPENDIX: [(&str, [&str; 4]); 33] = [
    ("Shape", ["7", "4", "3", "2"]),
    ("BaseSize", ["0.4", "0.2", "0.05", "0.05"]),
    ("Scale,ScaleV", ["13, 3", "23, 5", "15, 5", "10, 10"]),
    ("Levels", ["3", "4", "4", "3"]),
    ("Ratio,RatioPower", ["0.015, 1.2", "0.015, 1.3", "0.03, 2", "0.018, 1.3"]),
    ("Lobes,LobeDepth", ["5, 0.07", "3, 0.1", "9, 0.03", "5, 0.1"]),
    ("Flare", ["0.6", "1", "0.75", "1.2"]),
    ("0Scale,0ScaleV", ["1, 0", "1, 0", "1, 0", "1, 0"]),
    ("0Length,0LengthV,0Taper", ["1, 0, 1", "1, 0, 1.1", "0.8, 0, 1", "1, 0, 0.95"]),
    ("0BaseSplits", ["0", "0", "2", "2"]),
    ("0SegSplits,0SplitAngle,0SplitAngleV", ["0, 0, 0", "0, 0, 0", "0.1, 3, 0", "0.4, 10, 0"]),
    ("0CurveRes,0Curve,0CurveBack,0CurveV", ["3, 0, 0, 20", "10, 0, 0, 40", "8, 0, 20, 120", "8, 0, 0, 90"]),
    ("1DownAngle,1DownAngleV", ["60, -50", "60, -40", "20, 10", "30, -30"]),
    ("1Rotate,1RotateV,1Branches", ["140, 0, 50", "140, 0, 50", "-120, 30, 25", "80, 0, 40"]),
    ("1Length,1LengthV,1Taper", ["0.3, 0, 1", "0.3, 0.05, 1", "0.5, 0.1, 1", "0.8, 0.1, 1"]),
    ("1SegSplits,1SplitAngle,1SplitAngleV", ["0, 0, 0", "0, 0, 0", "0.2, 30, 10", "0.2, 10, 10"]),
    ("1CurveRes,1Curve,1CurveBack,1CurveV", ["5, -40, 0, 50", "10, 0, 0, 90", "16, 40, 80, 90", "10, 40, -70, 150"]),
    ("2DownAngle,2DownAngleV", ["45, 10", "30, 10", "30, 10", "45, 10"]),
    ("2Rotate,2RotateV,2Branches", ["140, 0, 30", "140, 0, 25", "-120, 30, 10", "140, 0, 120"]),
    ("2Length,2LengthV,2Taper", ["0.6, 0, 1", "0.6, 0.1, 1", "1.5, 0, 1", "0.2, 0.05, 1"]),
    ("2SegSplits,2SplitAngle,2SplitAngleV", ["0, 0, 0", "0, 0, 0", "0.2, 45, 20", "0.1, 10, 10"]),
    ("2CurveRes,2Curve,2CurveBack,2CurveV", ["3, -40, 0, 75", "10, -10, 0, 150", "12, 0, 0, 0", "3, 0, 0, -30"]),
    ("3DownAngle,3DownAngleV", ["45, 10", "45, 10", "20, 10", "45, 10"]),
    ("3Rotate,3RotateV,3Branches", ["77, 0, 10", "140, 0, 12", "140, 0, 300", "140, 0, 0"]),
    ("3Length,3LengthV,3Taper", ["0, 0, 1", "0.4, 0, 1", "0.1, 0, 1", "0.4, 0, 1"]),
    ("3SegSplits,3SplitAngle,3SplitAngleV", ["0, 0, 0", "0, 0, 0", "0, 0, 0", "0, 0, 0"]),
    ("3CurveRes,3Curve,3CurveBack,3CurveV", ["1, 0, 0, 0", "1, 0, 0, 0", "1, 0, 0, 0", "1, 0, 0, 0"]),
    ("Leaves,LeafShape", ["25, 0", "6, 0", "15, 0", "25, 0"]),
    ("LeafScale,LeafScaleX", ["0.17, 1", "0.3, 0.5", "0.12, 0.2", "0.12, 0.66"]),
    ("AttractionUp", ["0.5", "0.5", "-3", "0.8"]),
    ("PruneRatio", ["0", "0", "1", "0"]),
    ("PruneWidth,PruneWidthPeak", ["0.5, 0.5", "0.5, 0.5", "0.4, 0.6", "0.5, 0.5"]),
    ("PrunePowerLow,PrunePowerHigh", ["0.5, 0.5", "0.5, 0.5", "0.001, 0.5", "0.5, 0.5"]),
];

const SPECIES: [&str; 4] = ["wp/quaking_aspen", "wp/black_tupelo", "wp/weeping_willow", "wp/black_oak"];

fn keys(species: &str) -> Value {
    let resolved = validate_species(species, 1).unwrap_or_else(|report| panic!("{}", report.render(false)));
    match &resolved.species.model {
        Model::Parametric(tree) => serde_json::to_value(tree).expect("keys"),
        other => panic!("{species} is of the model {}", other.name().word()),
    }
}

#[test]
fn the_shipped_species_have_the_numbers_of_the_appendix() {
    for (column, species) in SPECIES.into_iter().enumerate() {
        let keys = keys(species);
        for (names, values) in APPENDIX {
            let printed = values[column].split(", ").map(|value| value.parse::<f64>().expect("a number"));
            for (name, printed) in names.split(',').zip(printed) {
                let stated = keys[name].get("value").unwrap_or(&keys[name]);
                assert_eq!(stated.as_f64(), Some(printed), "{name} of {species}");
                assert!(keys[name]["source"].is_string(), "{name} of {species} has a source");
            }
        }
    }
}

fn grown(species: &str, number: u32) -> Plant {
    let model = validate_species(species, 1).unwrap_or_else(|report| panic!("{}", report.render(false))).model;
    let [plant, draws] = [number, number];
    let seed =
        Seed { plant, draws: draws.into(), run_seed: 1995, component_limit: MOST_COMPONENTS, keep_events: false };
    let mut plot = Plot::of_one(&*model, &seed);
    plot.grow_to(1).expect("room");
    plot.plants.remove(0)
}

/// The stems of each level, clones apart, and the leaves.
fn counts(plant: &Plant) -> (Vec<usize>, usize) {
    let axes = &plant.axes;
    let of = |order: u8| {
        (0..axes.len()).filter(|&axis| axes.order[axis] == order && axes.origin[axis] != Origin::Fork).count()
    };
    ((1..=axes.order.iter().copied().max().unwrap_or(0)).map(of).collect(), plant.organs.len())
}

#[test]
fn the_shipped_species_have_the_numbers_of_the_equations() {
    for number in [0, 1] {
        assert_eq!(counts(&grown(SPECIES[0], number)), (vec![1, 30, 739], 13_498));
        assert_eq!(counts(&grown(SPECIES[1], number)), (vec![1, 40, 820, 7_760], 31_324));
    }
    let (stems, leaves) = counts(&grown(SPECIES[2], 0));
    assert_eq!(&stems[..2], [1, 24], "of 25 the first is on the bare part");
    assert!(stems[3] < 54_000 && leaves < 580_000, "the willow is pruned: {stems:?} {leaves}");
}
