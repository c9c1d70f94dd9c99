//! Cross-validation: parts of the plants are left out in turn and predicted by the laws of the others.
//!
//! Data whose rows name plants (`plant`, else `axis` where a law has that column) are divided by these names, never by
//! rows; each followed axis without a name is one by itself. What is told is the mean ln L of an observation that was
//! left out, by each law that all parts could be fitted with. Absent: data without names, whose rows may be of one
//! plant.

use super::Material;
use crate::activity::counts::Moments;
use crate::activity::waiting::{self, Wait, waiting};
use crate::branching::chain::{self, Asked};
use crate::branching::{Shoots, zones};
use crate::crown;
use crate::data::columns::{made, waits};
use crate::data::{Data, Table, read};
use crate::mortality::{self, Observed};
use crate::nodes::{self, laws::Counts};
use crate::special::{ln_choose, ln_factorial, x_ln_y};
use crate::wanted::Wanted;
use phytomer_sim::math;
use std::collections::BTreeMap;

/// The parts into which plants are divided.
const PARTS: usize = 5;

/// What a law cannot make is given so much, so that one such value does not decide everything.
const LEAST: f64 = 1e-6;

/// Laws with ln L of what was left out.
type Told = Vec<(String, f64)>;

/// Laws with the mean ln L of an observation that was left out; empty where the data are not divided.
pub(super) fn left_out(material: &Material<'_>) -> Told {
    let parts = parts(material);
    if parts.is_empty() {
        return Vec::new();
    }
    let mut sums: BTreeMap<String, (f64, usize)> = BTreeMap::new();
    let mut names: Vec<String> = Vec::new();
    let mut observations = 0.0;
    for (own, others) in &parts {
        observations += size(own, material.wanted);
        for (law, ln) in predicted(own, others, material.wanted) {
            if !names.contains(&law) {
                names.push(law.clone());
            }
            let sum = sums.entry(law).or_default();
            *sum = (sum.0 + ln, sum.1 + 1);
        }
    }
    let told = names.into_iter().filter_map(|law| {
        let (sum, fitted) = sums[&law];
        (fitted == parts.len() && sum.is_finite()).then_some((law, sum / observations))
    });
    told.collect()
}

/// Each part with all others; none where there are too few plants.
fn parts(material: &Material<'_>) -> Vec<(Data, Data)> {
    let (Some(law), table) = (material.outcome.law, material.table) else { return Vec::new() };
    let of_axes = matches!(material.data, Data::Days(_) | Data::Branching(..));
    let column = table.find("plant").or_else(|| if of_axes { table.find("axis") } else { None });
    let Some(column) = column else {
        return match material.data {
            Data::Mortality(Observed::Followed(axes)) if axes.len() >= 10 * PARTS => {
                let of = |axes| Data::Mortality(Observed::Followed(axes));
                (0..PARTS).map(|part| divided(axes, part)).map(|(own, others)| (of(own), of(others))).collect()
            }
            _ => Vec::new(),
        };
    };
    let mut plants: Vec<&str> = Vec::new();
    for (_, cells) in &table.rows {
        if !plants.contains(&cells[column].as_str()) {
            plants.push(&cells[column]);
        }
    }
    if plants.len() < 2 * PARTS {
        return Vec::new();
    }
    let number: BTreeMap<&str, usize> = plants.into_iter().zip(0..).collect();
    let rows = |part: usize, own: bool| {
        let is_own = |cells: &[String]| (number[cells[column].as_str()] % PARTS == part) == own;
        let rows = table.rows.iter().filter(|(_, cells)| is_own(cells)).cloned().collect();
        read(law, &Table { file: table.file.clone(), names: table.names.clone(), rows })
    };
    let both = |part: usize| Some(with_words_of(rows(part, true).ok()?, rows(part, false).ok()?));
    (0..PARTS).map(both).collect::<Option<Vec<_>>>().unwrap_or_default()
}

/// Fates have one number in both parts.
fn with_words_of(own: Data, others: Data) -> (Data, Data) {
    let (Data::Branching(own, own_words), Data::Branching(mut others, mut words)) = (own.clone(), others.clone())
    else {
        return (own, others);
    };
    let number = |word: &String, words: &mut Vec<String>| {
        words.iter().position(|known| known == word).unwrap_or_else(|| {
            words.push(word.clone());
            words.len() - 1
        })
    };
    let numbers: Vec<usize> = own_words.iter().map(|word| number(word, &mut words)).collect();
    others.fates = words.len();
    let shoots = own.shoots.iter().map(|shoot| shoot.iter().map(|fate| numbers[*fate]).collect()).collect();
    (Data::Branching(Shoots { fates: words.len(), shoots }, words.clone()), Data::Branching(others, words))
}

/// Those of a part, and the others.
fn divided<T: Clone>(all: &[T], part: usize) -> (Vec<T>, Vec<T>) {
    let of =
        |own: bool| all.iter().enumerate().filter(move |(k, _)| (k % PARTS == part) == own).map(|(_, x)| x.clone());
    (of(true).collect(), of(false).collect())
}

/// The observations of a part.
fn size(own: &Data, wanted: &Wanted) -> f64 {
    match own {
        Data::Counts { nodes, .. } => nodes.len() as f64,
        Data::Days(axes) => match wanted.window {
            Some((from, to)) => made(axes, from, to).len() as f64,
            None => waits(axes, wanted.begun_before(axes)).len() as f64,
        },
        Data::Mortality(Observed::Followed(axes)) => axes.len() as f64,
        Data::Mortality(Observed::SeenOnce(ages)) => ages.len() as f64,
        Data::Nodes(counts) => counts.iter().sum(),
        Data::Crown(pairs) => pairs.len() as f64,
        Data::Branching(shoots, _) => shoots.buds() as f64,
    }
}

/// ln L of a part by the laws of the others.
fn predicted(own: &Data, others: &Data, wanted: &Wanted) -> Told {
    match (own, others) {
        (Data::Counts { nodes: own, .. }, Data::Counts { nodes: others, .. }) => of_counts(own, others),
        (Data::Days(own), Data::Days(others)) => match wanted.window {
            Some((from, to)) => of_counts(&made(own, from, to), &made(others, from, to)),
            None => {
                let before = wanted.begun_before(if others.len() > own.len() { others } else { own });
                of_waits(&waits(own, before), &waits(others, before))
            }
        },
        (Data::Mortality(own), Data::Mortality(others)) => of_deaths(own, others),
        (Data::Nodes(own), Data::Nodes(others)) => of_nodes(own, others),
        (Data::Crown(own), Data::Crown(others)) => {
            let fit = crown::fit(others).ok().map(|fit| ["b1", "b2", "w"].map(|name| fit.value(name)));
            fit.map(|at| ("b1, b2 and w".to_owned(), crown::log_likelihood(own, at))).into_iter().collect()
        }
        (Data::Branching(own, _), Data::Branching(others, _)) => of_shoots(own, others),
        _ => Vec::new(),
    }
}

/// A bud that grows with one probability at each tick, and a number without any clock.
fn of_counts(own: &[u32], others: &[u32]) -> Told {
    let mut told = Vec::new();
    let ln = |mass: f64| math::log(mass.max(LEAST));
    if let Ok(fit) = Moments::of(others).activity(None) {
        let (b, ticks) = (fit.value("b"), fit.value("ticks"));
        let binomial = |n: f64, k: f64| {
            if k > n { 0.0 } else { math::exp(ln_choose(n, k) + x_ln_y(k, b) + x_ln_y(n - k, 1.0 - b)) }
        };
        // A part of a tick is a tick that some axes have.
        let (whole, part) = (ticks.floor(), ticks - ticks.floor());
        let mass = |k: f64| (1.0 - part) * binomial(whole, k) + part * binomial(whole + 1.0, k);
        told.push(("a bud of one activity".to_owned(), own.iter().map(|k| ln(mass(f64::from(*k)))).sum()));
    }
    let mean = others.iter().map(|k| f64::from(*k)).sum::<f64>() / others.len() as f64;
    if mean > 0.0 {
        let mass = |k: f64| math::exp(k * math::log(mean) - mean - ln_factorial(k));
        told.push(("a Poisson number".to_owned(), own.iter().map(|k| ln(mass(f64::from(*k)))).sum()));
    }
    told
}

/// Whole ticks with jitter, and a constant probability of a day.
fn of_waits(own: &[Wait], others: &[Wait]) -> Told {
    let mut told = Vec::new();
    if let Ok(fit) = waiting(others) {
        let at: Vec<f64> = ["b", "days_per_tick", "sd"].map(|name| fit.value(name)).to_vec();
        told.push(("whole ticks with jitter".to_owned(), waiting::log_likelihood_of(own, &at)));
    }
    let (ended, days) = others
        .iter()
        .fold((0.0, 0.0), |(ended, days), wait| (ended + f64::from(u8::from(wait.ended)), days + wait.days));
    let p: f64 = ended / days;
    if p > 0.0 && p < 1.0 {
        let ln = |wait: &Wait| match wait.ended {
            true => (wait.days - 1.0) * math::log1p(-p) + math::log(p),
            false => wait.days * math::log1p(-p),
        };
        told.push(("a constant probability of a day".to_owned(), own.iter().map(ln).sum()));
    }
    told
}

fn of_deaths(own: &Observed, others: &Observed) -> Told {
    let of = |hazard: mortality::Hazard| {
        let fit = mortality::fit(others, hazard).ok()?;
        let at: Vec<f64> = fit.estimates.iter().map(|e| e.value).collect();
        Some((hazard.words().to_owned(), own.log_likelihood(&|age| hazard.cumulative(&at, age))))
    };
    mortality::HAZARDS.into_iter().filter_map(of).collect()
}

fn of_nodes(own: &[f64], others: &[f64]) -> Told {
    let Ok((laws, _)) = nodes::fit_all(others) else { return Vec::new() };
    let named = |law: &Counts| {
        let parts: Vec<&str> = law.parts.iter().map(|(_, part)| part.family().letter()).collect();
        format!("{}{}", parts.join("+"), if law.shift > 0 { ", shifted" } else { "" })
    };
    let ln = |law: &Counts| {
        let masses = law.masses(own.len().max(1) - 1);
        own.iter().zip(masses).filter(|(count, _)| **count > 0.0).map(|(n, mass)| n * math::log(mass.max(LEAST))).sum()
    };
    laws.iter().map(|law| (named(law), ln(law))).collect()
}

/// Zones of several widths and chains of several zones. A fate that a zone never had is given a thousandth.
fn of_shoots(own: &Shoots, others: &Shoots) -> Told {
    let zones =
        [4, 6, 9].map(|width| (format!("zones of {width} ranks"), zones::fit(others, width).0.log_likelihood(own)));
    let chains = [4, 6].map(|zones| {
        let asked = Asked { zones, ends: None, seed: 1988, beginnings: 6 };
        let ln = chain::fit(others, &asked).map_or(f64::NAN, |(chain, _)| chain.softened().log_likelihood(own));
        (format!("chain of {zones} zones"), ln)
    });
    zones.into_iter().chain(chains).collect()
}
