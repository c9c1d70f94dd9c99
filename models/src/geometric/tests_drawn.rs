//! GMT1 with parameters that are drawn: each has the distribution that is stated, a plant has one value of each for its
//! whole life, and a constant is the same tree however it is written.
//!
//! Every value is read back from the columns of a grown plant. Seeds are fixed; bounds are 4 standard errors of the
//! stated distribution. Absent: the draws themselves, which stand with the laws.

use super::tests::heading as stated_heading;
use super::{GeometricModel, Gmt1};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::Plant;
use serde_json::{Value, json};

const KEYS: [&str; 8] =
    ["h1_deg", "h2_deg", "r1", "r2", "diameter_ratio", "divergence_deg", "first_length_m", "first_diameter_m"];

fn compiled(stated: Value) -> GeometricModel {
    let tree: Gmt1 = serde_json::from_value(stated).expect("it reads");
    tree.compile(20, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Means and standard deviations that keep far from every bound, so that no draw is clamped.
const STATED: [(f64, f64); 8] =
    [(10.0, 1.0), (-60.0, 3.0), (0.8, 0.02), (0.6, 0.01), (0.7, 0.03), (100.0, 5.0), (2.0, 0.2), (0.1, 0.01)];

/// A tree whose parameters are all drawn, each of another kind than the one before.
fn drawn(levels: u32) -> Value {
    let mut tree = json!({ "levels": { "value": levels, "source": "a choice" } });
    for (i, (key, (mean, sd))) in KEYS.into_iter().zip(STATED).enumerate() {
        let half = sd * 3_f64.sqrt();
        tree[key] = match i % 3 {
            0 => json!({ "normal": { "mean": mean, "sd": sd }, "source": "a field book" }),
            1 => json!({ "uniform": { "min": mean - half, "max": mean + half }, "assumed": true }),
            _ => json!({ "empirical": [mean - sd, mean + sd], "source": "a field book" }),
        };
    }
    tree
}

/// The parameters of a plant of two levels or more, in the order of [`KEYS`].
fn found(plant: &Plant) -> [f64; 8] {
    let nodes = &plant.nodes;
    let [length, thick] = [&nodes.length, &nodes.primary_diameter].map(|column| |i: usize| f64::from(column[i]));
    let heading = |i: usize| stated_heading(plant, i).map(f64::from);
    // A child of the upright trunk leans by h in the front plane, left where h is above 0.
    let lean = |i: usize| phytomer_sim::math::atan2(-heading(i)[0], heading(i)[2]).to_degrees();
    // The trunk is carried on by the left child here; azimuths count the divergence at its next branching.
    let azimuth =
        (0..nodes.birth.len()).find(|&i| nodes.axis[i].0 == 0 && nodes.rank[i] == 2).map(|i| nodes.azimuth[i]);
    [
        lean(1),
        lean(2),
        length(1) / length(0),
        length(2) / length(0),
        thick(1) / thick(0),
        f64::from(azimuth.expect("a trunk of two branches")).to_degrees(),
        length(0),
        thick(0),
    ]
}

fn plants(model: &GeometricModel, count: u32) -> Vec<[f64; 8]> {
    (0..count).map(|number| found(&contract::grown(model, 3, &contract::seed_of(5, number)))).collect()
}

#[test]
fn each_parameter_has_the_mean_and_the_variance_that_are_stated() {
    const N: u32 = 20_000;
    let found = plants(&compiled(drawn(2)), N);
    for (i, (key, (mean, sd))) in KEYS.into_iter().zip(STATED).enumerate() {
        let n = f64::from(N);
        let m = found.iter().map(|values| values[i]).sum::<f64>() / n;
        let v = found.iter().map(|values| (values[i] - mean) * (values[i] - mean)).sum::<f64>() / n;
        assert!((m - mean).abs() < 4.0 * sd / n.sqrt(), "{key}: the mean is {m}");
        // Var (x − μ)² = (κ − 1) σ⁴ with κ = 3 normal, 9/5 uniform, 1 of two values alike, where rounding is left.
        let kurtosis = [3.0, 1.8, 1.0][i % 3];
        let bound = 4.0 * sd * sd * f64::sqrt((kurtosis - 1.0) / n) + 1e-5 * mean.abs() * sd;
        assert!((v - sd * sd).abs() < bound, "{key}: the variance is {v}, not {} ± {bound}", sd * sd);
    }
}

/// Each parameter has its own word: two parameters are uncorrelated within the bound, and stating a third changes
/// neither.
#[test]
fn parameters_are_drawn_apart() {
    let n = 4_000;
    let all = plants(&compiled(drawn(2)), n);
    let score = |values: &[f64; 8], k: usize| (values[k] - STATED[k].0) / STATED[k].1;
    for (i, one) in KEYS.into_iter().enumerate() {
        for (j, other) in KEYS.into_iter().enumerate().take(i) {
            let r = all.iter().map(|values| score(values, i) * score(values, j)).sum::<f64>() / f64::from(n);
            assert!(r.abs() < 4.5 / f64::from(n).sqrt(), "{one} and {other}: correlation {r}");
        }
    }
    let mut fewer = drawn(2);
    (fewer["h1_deg"], fewer["r2"]) = (json!(10), json!(0.6));
    for (all, fewer) in all.iter().zip(plants(&compiled(fewer), 50)) {
        assert!((fewer[0] - 10.0).abs() < 1e-5 && (fewer[3] - 0.6).abs() < 1e-6);
        for k in [4, 6, 7] {
            assert_eq!(all[k], fewer[k], "{}", KEYS[k]);
        }
    }
}

#[test]
fn a_plant_keeps_its_parameters_at_each_level_and_another_has_others() {
    let model = compiled(drawn(6));
    let seed = contract::seed_of(9, 4);
    let whole = contract::grown(&model, 7, &seed);
    for age in 3..7 {
        let young = contract::grown(&model, age, &seed);
        let n = young.nodes.len();
        assert_eq!(young.nodes.length, whole.nodes.length[..n], "at age {age}");
        assert!((0..n).all(|i| stated_heading(&young, i) == stated_heading(&whole, i)), "at age {age}");
        assert_eq!(young.nodes.primary_diameter, whole.nodes.primary_diameter[..n], "at age {age}");
    }
    let other = contract::grown(&model, 7, &contract::seed_of(9, 5));
    assert!(found(&whole).iter().zip(found(&other)).filter(|(a, b)| **a != *b).count() >= 5);
}

/// Where the draw decides which angle is smaller, each plant's own angles decide which child continues the axis.
#[test]
fn drawn_angles_decide_which_child_carries_the_axis_on() {
    let mut tree = drawn(2);
    tree["h1_deg"] = json!({ "uniform": { "min": 10, "max": 50 } });
    tree["h2_deg"] = json!(-30);
    let model = compiled(tree);
    let mut left = 0;
    for number in 0..400 {
        let plant = contract::grown(&model, 3, &contract::seed_of(2, number));
        let continues = plant.nodes.axis[1].0 == 0;
        let [x, _, z] = stated_heading(&plant, 1).map(f64::from);
        assert_eq!(continues, phytomer_sim::math::atan2(-x, z).to_degrees() < 30.0);
        left += u32::from(continues);
    }
    assert!((left.abs_diff(200)) < 40, "4 standard errors of a fair coin: {left} of 400");
}

#[test]
fn drawn_trees_keep_the_contract_of_growth_models() {
    contract::check(&compiled(drawn(6)), 8, 11);
}

#[test]
fn what_is_expected_of_drawn_trees_is_what_grows() {
    let model = compiled(drawn(5));
    let expected = model.expectation(7).expect("counts without chance");
    for number in 0..5 {
        let plant = contract::grown(&model, 7, &contract::seed_of(1, number));
        assert_eq!(expected.components(7), f64::from(plant.components()));
    }
}

#[test]
fn a_constant_is_the_same_tree_however_it_is_written() {
    let mut bare = json!({ "levels": 5 });
    let mut sourced = json!({ "levels": { "value": 5, "source": "Table 1" } });
    let mut degenerate = json!({ "levels": 5 });
    for (key, (x, _)) in KEYS.into_iter().zip(STATED) {
        bare[key] = json!(x);
        sourced[key] = json!({ "value": x, "assumed": true });
        degenerate[key] = json!({ "uniform": { "min": x, "max": x } });
    }
    let seed = contract::seed_of(1, 0);
    let one = contract::grown(&compiled(bare), 6, &seed);
    for other in [sourced, degenerate] {
        let other = contract::grown(&compiled(other), 6, &seed);
        assert_eq!(one.nodes.length, other.nodes.length);
        assert_eq!(one.stated, other.stated);
        assert_eq!(one.nodes.primary_diameter, other.nodes.primary_diameter);
    }
}
