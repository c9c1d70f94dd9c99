//! The species file of a fitted geometric tree: each number with its source, how many branchings it is of, and its
//! interval.
//!
//! Numbers have twelve digits, so that a tree that was grown is grown again. Absent: whether the model takes them,
//! which whoever writes the file asks.

use phytomer_fits::Estimate;
use phytomer_fits::gmt::{Course, Fitted, Mean, TreeModel};
use phytomer_fits::proportions::{Measures, Proportions};
use std::fmt::Write as _;

/// The ratio of diameters where none was measured: that of the paper.
const TAPER: f64 = 0.7;
/// The diameter of a first branch over its length, where none was measured.
const SLENDER: f64 = 0.06;
/// Angles below this, degrees, are none.
const NOTHING: f64 = 1e-9;

/// What a file says of itself.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// The name of the species.
    pub name: &'a str,
    /// Where the data come from.
    pub data: &'a str,
}

/// A number of twelve digits.
fn number(value: f64) -> String {
    if value.abs() < 1e-12 {
        return "0".to_owned();
    }
    let rounded: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    format!("{rounded}")
}

/// A text in quotes.
fn text(words: &str) -> String {
    serde_json::Value::from(words.chars().filter(|letter| !letter.is_control()).collect::<String>()).to_string()
}

fn head(source: &Source<'_>, about: &str, model: &str) -> String {
    let mut file = format!("# Fitted by phytomer fit gmt: {}.\n", about.replace(['\n', '\r'], " "));
    let _ = writeln!(file, "name = {}\nmodel = \"{model}\"\ntick = \"one growth level\"\n", text(source.name));
    file
}

fn assumed(file: &mut String, key: &str, value: f64) {
    let _ = writeln!(file, "{key} = {{ value = {}, assumed = true }}", number(value));
}

/// A key with its interval, which is of 95 % in species files.
fn key(file: &mut String, key: &str, estimate: &Estimate, n: usize, source: &str) {
    let interval = match (estimate.low, estimate.high) {
        (Some(low), Some(high)) => {
            format!("interval = {{ value = [{}, {}] }}, ", number(low), number(high))
        }
        _ => String::new(),
    };
    let value = number(estimate.value);
    let _ = writeln!(file, "{key} = {{ value = {value}, {interval}n = {n}, source = {} }}", text(source));
}

fn first(file: &mut String, name: &str, mean: Option<Mean>, otherwise: f64, source: &str) {
    let Some(mean) = mean else { return assumed(file, name, otherwise) };
    let mut estimate = Estimate::bare(name, mean.value);
    if let Some([low, high]) = mean.interval {
        estimate = estimate.within(low, high);
    }
    key(file, name, &estimate, mean.n, source);
}

/// The species of a tree that was fitted to branches, with intervals of 95 %.
pub fn of_branches(fitted: &Fitted, source: &Source<'_>) -> String {
    let taken = fitted.taken();
    let model = match fitted.model {
        TreeModel::Gmt1 => "gmt1",
        TreeModel::Gmt2 => "gmt2",
        TreeModel::Gmt3 => "gmt3",
        TreeModel::Gmt4 => "gmt4",
    };
    let told = format!("{}: {}", taken.law, source.data);
    let mut file = head(source, &told, model);
    if let Course::Category(category) = fitted.course {
        let _ = writeln!(file, "category = {category}");
    }
    let keys = ["h1_deg", "h1_max_deg", "h1_min_deg", "h2_deg", "h2_max_deg", "h2_min_deg", "r0", "r1", "r2"];
    for name in keys {
        let Some(estimate) = taken.estimate(name) else { continue };
        if name.starts_with('r') && estimate.value > 1.0 {
            let _ = writeln!(file, "# {} was measured; a ratio of contraction is at most 1.", number(estimate.value));
            key(&mut file, name, &Estimate { value: 1.0, ..estimate.clone() }, taken.n, &told);
        } else {
            key(&mut file, name, estimate, taken.n, &told);
        }
    }
    match taken.estimate("diameter_ratio") {
        Some(estimate) => {
            let own = Estimate { value: estimate.value.min(1.0), ..estimate.clone() };
            key(&mut file, "diameter_ratio", &own, taken.n, &told);
        }
        None => assumed(&mut file, "diameter_ratio", TAPER),
    }
    for name in ["divergence_deg", "delta_deg"] {
        if let Some(estimate) = taken.estimate(name).filter(|estimate| estimate.value.abs() > NOTHING) {
            key(&mut file, name, estimate, taken.n, &told);
        }
    }
    let deviation = ["deviation_x", "deviation_y", "deviation_z"].map(|name| taken.estimate(name));
    if let [Some(x), Some(y), Some(z)] = deviation {
        for own in [x, y, z] {
            if let (Some(low), Some(high)) = (own.low, own.high) {
                let _ = writeln!(file, "# {}: 95 %: {} to {}", own.name, number(low), number(high));
            }
        }
        let [x, y, z] = [x, y, z].map(|own| number(own.value));
        let _ = writeln!(file, "deviation_m = [{x}, {y}, {z}]");
    }
    let _ = writeln!(file, "levels = {}", fitted.levels);
    let [long, wide] = fitted.first;
    first(&mut file, "first_length_m", long, 1.0, &told);
    first(&mut file, "first_diameter_m", wide, SLENDER * long.map_or(1.0, |long| long.value), &told);
    if let Some(direction) = fitted.direction {
        let [x, y, z] = direction.map(number);
        let _ = writeln!(file, "first_direction = [{x}, {y}, {z}]");
    }
    file
}

/// The species of the ratios of a tree whose height, first branch and lateral branch were measured; `angles` are h1 and
/// h2, degrees, and assumed where the person gave none.
pub fn of_proportions(
    (measures, found): (&Measures, &Proportions),
    level: u32,
    ternary: bool,
    angles: Option<[f64; 2]>,
    source: &Source<'_>,
) -> String {
    let mut file = head(source, source.data, if ternary { "gmt3" } else { "gmt1" });
    let [h1, h2] = angles.unwrap_or(if ternary { [50.0, -50.0] } else { [0.0, -50.0] });
    for (name, angle) in [("h1_deg", h1), ("h2_deg", h2)] {
        match angles {
            Some(_) => drop(writeln!(file, "{name} = {}", number(angle))),
            None => assumed(&mut file, name, angle),
        }
    }
    let names: &[(&str, f64)] = match ternary {
        true => &[("r0", found.main), ("r1", found.lateral), ("r2", found.lateral)],
        false => &[("r1", found.main), ("r2", found.lateral)],
    };
    for (name, value) in names {
        let _ = writeln!(file, "{name} = {{ value = {}, source = {} }}", number(*value), text(source.data));
    }
    assumed(&mut file, "diameter_ratio", TAPER);
    let _ = writeln!(file, "levels = {level}");
    let _ = writeln!(file, "first_length_m = {}", number(measures.first_branch));
    assumed(&mut file, "first_diameter_m", SLENDER * measures.first_branch);
    file
}
