//! A fitted law as keys of a species file, each with `source`, `n` and `interval`.
//!
//! Numbers have seven digits; a law with a number that is not finite is left out. Absent: the rest of a species.

use crate::branching::Shoots;
use crate::branching::chain::Chain;
use crate::branching::zones::Zones;
use crate::fit::{Estimate, Fit};
use crate::nodes::Part;
use crate::nodes::laws::Counts;
use crate::wanted::Wanted;
use phytomer_sim::math;

/// A key of an order, with its value in TOML.
#[derive(Debug, Clone, PartialEq)]
pub struct Stated {
    /// 0: the order that was measured; 1: the one that it bears.
    pub order: usize,
    /// The key below the order.
    pub key: String,
    /// Its value.
    pub value: String,
}

/// A number as TOML has it; `None` where it is not finite.
fn number(value: f64) -> Option<String> {
    if !value.is_finite() {
        return None;
    }
    if value == 0.0 || (1e-4..1e7).contains(&value.abs()) {
        let digits = 6 - if value == 0.0 { 0 } else { math::log10(value.abs()).floor() as i32 };
        let text = format!("{value:.*}", digits.max(1) as usize);
        let trimmed = text.trim_end_matches('0');
        return Some(if trimmed.ends_with('.') { format!("{trimmed}0") } else { trimmed.to_owned() });
    }
    Some(format!("{value:.6e}"))
}

fn text(words: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in words.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            letter if letter.is_control() => quoted.push(' '),
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

/// `interval = { … }, n = …, source = "…"`; limits that the data do not set are left out.
fn measured(fit: &Fit, n: usize, estimates: &[(&str, &Estimate)], wanted: &Wanted) -> String {
    let limits = estimates.iter().filter_map(|(name, estimate)| {
        let (low, high) = (number(estimate.low?)?, number(estimate.high?)?);
        Some(format!("{name} = [{low}, {high}]"))
    });
    let limits: Vec<String> = limits.collect();
    let interval = if limits.is_empty() { String::new() } else { format!("interval = {{ {} }}, ", limits.join(", ")) };
    format!("{interval}n = {n}, source = {}", text(&format!("{}: {}", fit.law, wanted.source)))
}

/// 1 − b as a probability to pause.
fn pause(fit: &Fit, name: &str, order: usize, wanted: &Wanted) -> Option<Stated> {
    let b = fit.estimate(name)?;
    let turned =
        Estimate { value: 1.0 - b.value, low: b.high.map(|b| 1.0 - b), high: b.low.map(|b| 1.0 - b), ..b.clone() };
    let value = number(turned.value.clamp(0.0, 1.0))?;
    let value = format!("{{ value = {value}, {} }}", measured(fit, fit.n, &[("value", &turned)], wanted));
    Some(Stated { order, key: "pause".to_owned(), value })
}

/// The pause of an order.
pub fn activity(fit: &Fit, wanted: &Wanted) -> Vec<Stated> {
    pause(fit, "b", 0, wanted).into_iter().collect()
}

/// The pauses of an axis and its branches, and the speed of these.
pub fn crown(fit: &Fit, wanted: &Wanted) -> Vec<Stated> {
    let speed = fit.estimate("w").and_then(|w| {
        // The clock of an axis is an exact ratio, so that its speed has few decimals.
        let value = number((w.value * 1000.0).round() / 1000.0)?;
        let value = format!("{{ value = {value}, {} }}", measured(fit, fit.n, &[("value", w)], wanted));
        Some(Stated { order: 1, key: "speed".to_owned(), value })
    });
    pause(fit, "b1", 0, wanted).into_iter().chain(pause(fit, "b2", 1, wanted)).chain(speed).collect()
}

/// The death of an order, from so many axes.
pub fn mortality(fit: &Fit, axes: usize, wanted: &Wanted) -> Vec<Stated> {
    let of = |kind: &str, names: [&str; 2]| {
        let [a, b] = names.map(|name| number(fit.value(name)));
        Some(format!(
            "{{ {kind} = {{ over = {}, {} = {}, {} = {} }} }}",
            text(&wanted.over),
            names[0],
            a?,
            names[1],
            b?
        ))
    };
    let curve = match fit.law.split(' ').next() {
        Some("power") => of("weibull", ["scale", "shape"]),
        Some("Gompertz") => of("gompertz", ["c", "g"]),
        _ => None,
    };
    let constant = fit.estimate("constant").and_then(|rate| number(-math::expm1(-rate.value)));
    let law = match (curve, constant) {
        (Some(curve), Some(constant)) => format!("hazards = [{curve}, {{ value = {constant} }}]"),
        (Some(curve), None) => curve.trim_start_matches("{ ").trim_end_matches(" }").to_owned() + " }",
        (None, Some(constant)) => format!("value = {constant}"),
        (None, None) => return Vec::new(),
    };
    let named: Vec<(&str, &Estimate)> =
        fit.estimates.iter().map(|estimate| (estimate.name.as_str(), estimate)).collect();
    let value = format!("{{ {law}, {} }}", measured(fit, axes, &named, wanted));
    vec![Stated { order: 0, key: "death".to_owned(), value }]
}

fn part(part: Part) -> Option<String> {
    Some(match part {
        Part::Poisson { mean } => format!("poisson = {{ mean = {} }}", number(mean)?),
        Part::Binomial { n, p } => format!("binomial = {{ n = {n}, p = {} }}", number(p)?),
        Part::NegativeBinomial { r, p } => format!("negative_binomial = {{ r = {}, p = {} }}", number(r)?, number(p)?),
    })
}

/// The nodes of the growth units of an order.
pub fn nodes(law: &Counts, fit: &Fit, wanted: &Wanted) -> Vec<Stated> {
    let parts: Option<Vec<(String, String)>> =
        law.parts.iter().map(|(weight, own)| Some((number(*weight)?, part(*own)?))).collect();
    let Some(parts) = parts else { return Vec::new() };
    let mut words = match parts.as_slice() {
        [(_, alone)] => alone.clone(),
        parts => {
            let parts: Vec<String> =
                parts.iter().map(|(weight, part)| format!("{{ weight = {weight}, {part} }}")).collect();
            format!("mixture = [{}]", parts.join(", "))
        }
    };
    if law.shift > 0 {
        words.push_str(&format!(", shift = {}", law.shift));
    }
    let named: Vec<(&str, &Estimate)> =
        fit.estimates.iter().map(|estimate| (estimate.name.as_str(), estimate)).collect();
    let value = format!("{{ {words}, {} }}", measured(fit, fit.n, &named, wanted));
    vec![Stated { order: 0, key: "growth_unit.nodes".to_owned(), value }]
}

/// The zones of an order: the share of buds that bear an axis, and the states of these.
pub fn zones(zones: &Zones, shoots: &Shoots, words: &[String], wanted: &Wanted) -> Vec<Stated> {
    let source =
        text(&format!("shares counted on {} buds of {} axes: {}", shoots.buds(), shoots.shoots.len(), wanted.source));
    let latent = words.iter().position(|word| *word == wanted.latent);
    let zone = |(place, shares): (usize, &Vec<f64>)| {
        let awake = 1.0 - latent.map_or(0.0, |latent| shares[latent]);
        let states = shares.iter().enumerate().filter(|(fate, share)| Some(*fate) != latent && **share > 0.0);
        let states: Vec<String> = states
            .filter_map(|(fate, share)| Some(format!("{} = {}", text(&words[fate]), number(share / awake)?)))
            .collect();
        let state = if states.is_empty() { String::new() } else { format!(", state = {{ {} }}", states.join(", ")) };
        let (first, last) = (place * zones.width + 1, (place + 1) * zones.width);
        let value = number(awake.max(0.0))?;
        Some(format!(
            "{{ from = {}, first = {first}, last = {last}, ramification = {{ value = {value}, source = {source} }}{state} }}",
            text(&wanted.from)
        ))
    };
    let zones: Vec<String> = zones.shares.iter().enumerate().filter_map(zone).collect();
    vec![Stated {
        order: 0,
        key: "axillary.pattern".to_owned(),
        value: format!("{{ zones = [{}] }}", zones.join(", ")),
    }]
}

/// A chain of zones: where it begins, the lengths, what follows, and in each zone the share of buds that bear an axis
/// with the states of these. Shares below 10⁻⁶ are none.
pub fn chain(chain: &Chain, shoots: &Shoots, words: &[String], wanted: &Wanted) -> Vec<Stated> {
    let about = format!("chain fitted to {} buds of {} axes: {}", shoots.buds(), shoots.shoots.len(), wanted.source);
    let weights = |row: &[f64]| {
        let last = row.iter().rposition(|weight| *weight > 1e-6)?;
        let row: Option<Vec<String>> =
            row[..=last].iter().map(|weight| number(if *weight > 1e-6 { *weight } else { 0.0 })).collect();
        Some(format!("[{}]", row?.join(", ")))
    };
    let latent = words.iter().position(|word| *word == wanted.latent);
    let link = |zone: usize| {
        let shares = &chain.shares[zone];
        let awake = 1.0 - latent.map_or(0.0, |latent| shares[latent]);
        let bearing = awake > 1e-6;
        let states = shares.iter().enumerate().filter(|(fate, share)| Some(*fate) != latent && **share > 1e-6);
        let states: Option<Vec<String>> =
            states.map(|(fate, share)| Some(format!("{} = {}", text(&words[fate]), number(share / awake)?))).collect();
        let state = if bearing { format!(", state = {{ {} }}", states?.join(", ")) } else { String::new() };
        let ramification = number(if bearing { awake.min(1.0) } else { 0.0 })?;
        let source = text(&about);
        let own = format!("ramification = {{ value = {ramification}, source = {source} }}{state}");
        if zone + 1 == chain.zones() {
            return Some(format!("{{ {own} }}"));
        }
        let (r, p) = chain.lengths[zone];
        let length = format!("negative_binomial = {{ r = {}, p = {} }}, shift = 1", number(r)?, number(p)?);
        let next = weights(&chain.next[zone][zone + 1..]).map_or_else(String::new, |next| format!("next = {next}, "));
        Some(format!("{{ length = {{ {length}, source = {source} }}, {next}{own} }}"))
    };
    let links: Option<Vec<String>> = (0..chain.zones()).map(link).collect();
    let (Some(links), Some(begins)) = (links, weights(&chain.first)) else { return Vec::new() };
    let value = format!("{{ from = {}, begins = {begins}, chain = [{}] }}", text(&wanted.from), links.join(", "));
    vec![Stated { order: 0, key: "axillary.pattern".to_owned(), value }]
}

/// A species that inherits from a base and has these keys of an order (from 1) alone.
pub fn species(base: &str, name: &str, order: usize, stated: &[Stated], about: &str) -> String {
    let last = stated.iter().map(|key| order + key.order).max().unwrap_or(order);
    let mut toml =
        format!("# {about}\n# Everything else is inherited.\ninherits = {}\nname = {}\n", text(base), text(name));
    for number in 1..=last {
        toml.push_str("\n[[order]]\n");
        for key in stated.iter().filter(|key| order + key.order == number) {
            toml.push_str(&format!("{} = {}\n", key.key, key.value));
        }
    }
    toml
}
