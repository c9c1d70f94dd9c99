//! What is drawn from a law that was taken and fitted again: data of the same design.
//!
//! Counts keep their number of axes, deaths their ages, pairs the nodes above them, waits the first node and the last
//! day of each axis, fates the lengths of their shoots. A chain is refitted by EM from the chain that was drawn from.
//! Absent: what comes of the refits.

use super::Material;
use crate::activity::counts::Moments;
use crate::activity::waiting::waiting;
use crate::branching::Shoots;
use crate::branching::chain::{self, Chain};
use crate::branching::zones::{self, Zones};
use crate::crown;
use crate::data::Data;
use crate::data::columns::{emissions, made, waits};
use crate::draws::Draws;
use crate::fit::{Estimate, Fit};
use crate::mortality::{self, Followed, Hazard, Observed, SeenOnce};
use crate::nodes::laws::Counts;
use crate::nodes::{self, Family, Part, fit_mixture, fit_single};
use crate::outcome;
use crate::special::proportion_interval;
use phytomer_sim::math;
use std::collections::BTreeMap;

/// What is drawn and fitted again.
pub(super) enum Design<'a> {
    Counts { n: usize, b: f64, ticks: f64, days: Option<f64> },
    Days { axes: &'a [BTreeMap<u32, u32>], before: u32, at: [f64; 3] },
    Mortality { observed: &'a Observed, hazard: Hazard, at: Vec<f64> },
    Nodes { law: Counts, units: usize },
    Crown { pairs: &'a [crown::Pair], at: [f64; 3] },
    Zones { zones: Zones, lengths: Vec<usize>, words: &'a [String] },
    Chain { chain: Chain, lengths: Vec<usize>, words: &'a [String] },
}

/// Fates whose share in a zone is between these are told: rarer ones need more shoots than can be drawn.
const TOLD: [f64; 2] = [0.05, 0.95];

impl<'a> Design<'a> {
    /// The design of a fit; `None` where the law that was taken cannot be drawn from.
    pub fn of(material: &Material<'a>) -> Option<Self> {
        let taken = material.outcome.taken();
        Some(match material.data {
            Data::Counts { nodes, days } => Self::of_counts(taken, nodes.len(), *days),
            Data::Days(axes) => match material.wanted.window {
                Some((from, to)) => Self::of_counts(taken, made(axes, from, to).len(), Some(f64::from(to - from))),
                None => {
                    let before = material.wanted.begun_before(axes);
                    Self::Days { axes, before, at: ["b", "days_per_tick", "sd"].map(|name| taken.value(name)) }
                }
            },
            Data::Mortality(observed) => {
                let hazard = mortality::HAZARDS.into_iter().find(|hazard| hazard.words() == taken.law)?;
                Self::Mortality { observed, hazard, at: taken.estimates.iter().map(|e| e.value).collect() }
            }
            Data::Nodes(counts) => Self::Nodes { law: law_of(taken)?, units: counts.iter().sum::<f64>() as usize },
            Data::Crown(pairs) => Self::Crown { pairs, at: ["b1", "b2", "w"].map(|name| taken.value(name)) },
            Data::Branching(shoots, words) => Self::of_fates(material, shoots, words)?,
        })
    }

    fn of_counts(taken: &Fit, n: usize, days: Option<f64>) -> Self {
        Self::Counts { n, b: taken.value("b"), ticks: taken.value("ticks"), days }
    }

    fn of_fates(material: &Material<'a>, shoots: &Shoots, words: &'a [String]) -> Option<Self> {
        let lengths = shoots.shoots.iter().map(Vec::len).collect();
        let law = &material.outcome.taken().law;
        if law.starts_with("zones") {
            return Some(Self::Zones { zones: zones::fit(shoots, material.wanted.zone).0, lengths, words });
        }
        let latent = words.iter().position(|word| *word == material.wanted.latent);
        let ends = latent.filter(|_| law.contains("alone at both ends"));
        let asked = outcome::asked_chain(material.wanted, ends);
        chain::fit(shoots, &asked).ok().map(|(chain, _)| Self::Chain { chain, lengths, words })
    }

    /// What is drawn from: the values that refits should find.
    pub fn truth(&self, taken: &Fit) -> Vec<Estimate> {
        match self {
            Self::Zones { zones, words, .. } => {
                let named = |(zone, shares): (usize, &Vec<f64>)| {
                    let told = shares.iter().enumerate().filter(|(_, share)| (TOLD[0]..=TOLD[1]).contains(*share));
                    told.map(|(fate, share)| Estimate::bare(&of_zone(zone, &words[fate]), *share)).collect::<Vec<_>>()
                };
                zones.shares.iter().enumerate().flat_map(named).collect()
            }
            Self::Chain { chain, words, .. } => of_chain(chain, words),
            _ => taken.estimates.clone(),
        }
    }

    /// Data of the design.
    pub fn draw(&self, draws: &mut Draws) -> Data {
        match self {
            // A part of a tick is a tick that some axes have.
            Self::Counts { n, b, ticks, days } => {
                let whole = ticks.floor();
                let ticks = |draws: &mut Draws| whole as u32 + u32::from(draws.happens(ticks - whole));
                let nodes = (0..*n).map(|_| {
                    let ticks = ticks(draws);
                    draws.binomial(ticks, *b)
                });
                Data::Counts { nodes: nodes.collect(), days: *days }
            }
            Self::Days { axes, at, .. } => Data::Days(axes.iter().map(|days| drawn_days(days, *at, draws)).collect()),
            Self::Mortality { observed, hazard, at } => Data::Mortality(drawn_deaths(observed, *hazard, at, draws)),
            Self::Nodes { law, units } => {
                let masses = law.masses(4096);
                let mut counts = Vec::new();
                for _ in 0..*units {
                    let nodes = draws.among(&masses);
                    counts.resize(counts.len().max(nodes + 1), 0.0);
                    counts[nodes] += 1.0;
                }
                Data::Nodes(counts)
            }
            Self::Crown { pairs, at } => Data::Crown(crown::drawn(pairs, *at, draws)),
            Self::Zones { zones, lengths, words } => {
                let shoots = lengths.iter().map(|buds| zones.draw(*buds, draws)).collect();
                Data::Branching(Shoots { fates: words.len(), shoots }, words.to_vec())
            }
            Self::Chain { chain, lengths, words } => {
                let shoots = lengths.iter().map(|buds| chain.draw(*buds, draws)).collect();
                Data::Branching(Shoots { fates: words.len(), shoots }, words.to_vec())
            }
        }
    }

    /// The estimates of the same law; `None` where the drawn data do not have it.
    pub fn refit(&self, drawn: &Data) -> Option<Vec<Estimate>> {
        let fit = match (self, drawn) {
            (Self::Counts { .. }, Data::Counts { nodes, days }) => Moments::of(nodes).activity(*days).ok(),
            (Self::Days { before, .. }, Data::Days(axes)) => waiting(&waits(axes, *before)).ok(),
            (Self::Mortality { hazard, .. }, Data::Mortality(observed)) => mortality::fit(observed, *hazard).ok(),
            (Self::Nodes { law, .. }, Data::Nodes(counts)) => same_law(law, counts).map(|fitted| fitted.1),
            (Self::Crown { .. }, Data::Crown(pairs)) => crown::fit(pairs).ok(),
            (Self::Zones { zones, words, .. }, Data::Branching(shoots, _)) => {
                return Some(of_zones(shoots, zones.width, words));
            }
            (Self::Chain { chain, words, .. }, Data::Branching(shoots, _)) => {
                return Some(of_chain(&chain.refitted(shoots)?, words));
            }
            _ => None,
        };
        fit.map(|fit| fit.estimates)
    }
}

fn of_zone(zone: usize, word: &str) -> String {
    format!("zone {}: {word}", zone + 1)
}

/// Shares of the fates in each zone, with exact intervals of buds.
fn of_zones(shoots: &Shoots, width: usize, words: &[String]) -> Vec<Estimate> {
    let mut counts = vec![vec![0.0; words.len()]; shoots.longest().div_ceil(width)];
    for shoot in &shoots.shoots {
        shoot.iter().enumerate().for_each(|(rank, fate)| counts[rank / width][*fate] += 1.0);
    }
    let named = |(zone, counts): (usize, &Vec<f64>)| {
        let n: f64 = counts.iter().sum();
        let estimate = |(fate, count): (usize, &f64)| {
            let [low, high] = proportion_interval(*count, n, 0.05);
            Estimate::bare(&of_zone(zone, &words[fate]), count / n).within(low, high)
        };
        counts.iter().enumerate().map(estimate).collect::<Vec<_>>()
    };
    counts.iter().enumerate().flat_map(named).collect()
}

/// Mean lengths of the zones of a chain, and the shares of fates in them; EM gives them no intervals.
fn of_chain(chain: &Chain, words: &[String]) -> Vec<Estimate> {
    let length = |zone: usize| Estimate::bare(&format!("length of zone {}", zone + 1), chain.mean_length(zone));
    let share = |(zone, shares): (usize, &Vec<f64>)| {
        let told = shares.iter().enumerate().filter(|(_, share)| **share > 0.0);
        told.map(|(fate, share)| Estimate::bare(&of_zone(zone, &words[fate]), *share)).collect::<Vec<_>>()
    };
    (0..chain.zones() - 1).map(length).chain(chain.shares.iter().enumerate().flat_map(share)).collect()
}

/// Days of an axis with the first node and the last day of another one, and waits between nodes by the law.
fn drawn_days(days: &BTreeMap<u32, u32>, [b, tick, sd]: [f64; 3], draws: &mut Draws) -> BTreeMap<u32, u32> {
    let (Some(first), Some(last)) = (days.keys().next(), days.keys().next_back()) else { return days.clone() };
    let mut drawn = BTreeMap::from([(*first, 0)]);
    let (mut nodes, mut next) = (0, emissions(days).first().copied());
    while let Some(day) = next.filter(|day| day <= last) {
        nodes += 1;
        drawn.insert(day, nodes);
        let ticks = f64::from(draws.geometric(b));
        let wait = (ticks * tick + sd * ticks.sqrt() * draws.normal()).round().max(1.0);
        next = day.checked_add(wait as u32);
    }
    drawn.insert(*last, nodes);
    drawn
}

/// The law of counts by the names of its estimates.
fn law_of(fit: &Fit) -> Option<Counts> {
    let part = |mark: &str| {
        let of = |name: &str| fit.estimate(&format!("{name}{mark}")).map(|e| e.value);
        match (of("mean"), of("n"), of("r"), of("p")) {
            (Some(mean), ..) => Some(Part::Poisson { mean }),
            (_, Some(n), _, Some(p)) => Some(Part::Binomial { n: n as u32, p }),
            (_, _, Some(r), Some(p)) => Some(Part::NegativeBinomial { r, p }),
            _ => None,
        }
    };
    let shift = fit.estimate("shift").map_or(0, |shift| shift.value as u32);
    let parts = match fit.estimate("weight_1").map(|weight| weight.value) {
        Some(weight) => vec![(weight, part("_1")?), (1.0 - weight, part("_2")?)],
        None => vec![(1.0, part("")?)],
    };
    Some(Counts { parts, shift })
}

fn same_law(law: &Counts, counts: &[f64]) -> Option<nodes::laws::Fitted> {
    let families: Vec<Family> = law.parts.iter().map(|(_, part)| part.family()).collect();
    match families.as_slice() {
        [alone] => fit_single(counts, *alone, law.shift).ok(),
        [first, second] => fit_mixture(counts, [*first, *second]).ok(),
        _ => None,
    }
}

fn drawn_deaths(observed: &Observed, hazard: Hazard, at: &[f64], draws: &mut Draws) -> Observed {
    let dead_by = |age: f64| -math::expm1(-hazard.cumulative(at, age));
    match observed {
        Observed::SeenOnce(ages) => {
            let seen = |age: &SeenOnce| {
                let dead = draws.binomial(age.axes as u32, dead_by(age.age));
                SeenOnce { dead: f64::from(dead), ..*age }
            };
            Observed::SeenOnce(ages.iter().map(seen).collect())
        }
        Observed::Followed(axes) => {
            // What died is known to have been followed to the last age at least of those that did not.
            let last = axes.iter().map(|axis| axis.age).fold(0.0, f64::max);
            let life = |axis: &Followed| {
                let end = if axis.died { last } else { axis.age };
                let share = draws.share();
                let age = (1..=end as u32).map(f64::from).find(|age| dead_by(*age) > share);
                Followed { age: age.unwrap_or(end), died: age.is_some() }
            };
            Observed::Followed(axes.iter().map(life).collect())
        }
    }
}
