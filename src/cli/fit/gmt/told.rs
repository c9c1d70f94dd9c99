//! What `fit gmt` tells: ratios and estimates in words, the means of growth levels, and `fit.json`.

use phytomer_fits::gmt::{Course, Fitted, LevelMeans, Mean};
use phytomer_fits::outcome::Outcome;
use phytomer_fits::proportions::{Measures, Proportions};
use phytomer_fits::{Estimate, json};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// The names of the ratios.
pub fn names(ternary: bool) -> [&'static str; 2] {
    if ternary { ["r0", "r1 = r2"] } else { ["r1", "r2"] }
}

/// The ratios, and the tree that grows with them.
pub fn in_words(found: &Proportions, names: [&str; 2], grown: &Measures, measured: &Measures, level: u32) -> String {
    let [main, lateral] = names;
    format!(
        "{main} {:.6}\n{lateral} {:.6}\nat growth level {level} the tree is {:.4} high, measured {:.4}; its lateral \
         branch reaches {:.4}, measured {:.4}",
        found.main, found.lateral, grown.height, measured.height, grown.lateral, measured.lateral
    )
}

fn shown(estimate: &Estimate, percent: f64) -> String {
    let mut line = format!("  {:<15} {:.6}", estimate.name, estimate.value);
    if let (Some(low), Some(high)) = (estimate.low, estimate.high) {
        let _ = write!(line, "  ({percent} %: {low:.6} to {high:.6})");
    }
    line
}

fn mean(mean: Option<Mean>) -> String {
    match mean {
        None => "-".to_owned(),
        Some(Mean { value, interval: Some([low, high]), .. }) => format!("{value:.3} ± {:.3}", 0.5 * (high - low)),
        Some(Mean { value, .. }) => format!("{value:.3}"),
    }
}

/// The estimates, and the means of each growth level as Figs. 14 and 16 have them.
pub fn told(found: &Fitted) -> String {
    let taken = found.taken();
    let percent = 100.0 * found.confidence;
    let mut text = format!("{}  (n {} branchings, growth level {})\n", taken.law, taken.n, found.levels);
    taken.estimates.iter().for_each(|estimate| text += &format!("{}\n", shown(estimate, percent)));
    for (name, own) in ["first branch", "its diameter"].iter().zip(found.first) {
        let _ = writeln!(text, "  {name:<15} {}", mean(own));
    }
    let _ = writeln!(
        text,
        "level  branches  {:<20} {:<20} {:<20} {:<18} {:<18}",
        "height", "left, degrees", "right, degrees", "length", "ratios"
    );
    for own in &found.by_level {
        let ratios: Vec<String> = own.ratios.iter().flatten().map(|ratio| mean(Some(*ratio))).collect();
        let cells = [own.height, own.left_deg, own.right_deg].map(mean);
        let line = format!(
            "{:>5}  {:>8}  {:<20} {:<20} {:<20} {:<18} {}",
            own.level,
            own.branches,
            cells[0],
            cells[1],
            cells[2],
            mean(own.length),
            ratios.join(", ")
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    for fit in found.fits.iter().filter(|fit| fit.law != taken.law) {
        let bic = fit.bic().map_or_else(String::new, |bic| format!(", BIC {bic:.2}"));
        let _ = writeln!(text, "other: {}{bic}", fit.law);
    }
    taken.notes.iter().for_each(|note| text += &format!("note: {note}\n"));
    text.truncate(text.trim_end().len());
    text
}

fn mean_json(mean: Option<Mean>) -> Value {
    mean.map_or(
        Value::Null,
        |own| json!({"n": own.n, "value": own.value, "deviation": own.deviation, "interval": own.interval}),
    )
}

fn level_json(own: &LevelMeans) -> Value {
    json!({
        "level": own.level, "branches": own.branches, "height": mean_json(own.height),
        "left_deg": mean_json(own.left_deg), "right_deg": mean_json(own.right_deg),
        "ratios": own.ratios.iter().map(|ratio| mean_json(*ratio)).collect::<Vec<_>>(),
        "length": mean_json(own.length), "fitted_deg": own.fitted_deg,
    })
}

/// The contents of fit.json.
pub fn object(found: &Fitted, data: &str, hash: &str) -> Value {
    let (fits, taken, rivals) = (found.fits.clone(), found.taken, found.rivals);
    let outcome = Outcome { law: None, fits, taken, rivals, tests: Vec::new(), stated: Vec::new() };
    let mut object = json::object(&outcome, data, hash);
    object["confidence"] = found.confidence.into();
    object["category"] = match found.course {
        Course::Constant => Value::Null,
        Course::Category(category) => category.into(),
    };
    object["first_length"] = mean_json(found.first[0]);
    object["first_diameter"] = mean_json(found.first[1]);
    object["levels"] = found.by_level.iter().map(level_json).collect();
    object
}
