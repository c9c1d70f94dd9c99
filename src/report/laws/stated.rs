//! What a species states of the axes of an order, as distributions that grown and measured plants can be held against:
//! nodes per growth unit, survival of apical buds, and the fate of axillary buds by rank.
//!
//! A law that depends on what the tables do not tell (the state, the age of the plant) has no one distribution, and is
//! told so. Absent: draws.

use phytomer_models::buds::Order;
use phytomer_models::buds::params::{Chain, End, Link, Pattern, Zone, ZoneState};
use phytomer_models::fault::{Fault, Path};
use phytomer_models::law::{At, Count, Domain, Law};
use std::collections::BTreeMap;

/// The shares of each fate by rank, from rank 1.
pub type FatesByRank = BTreeMap<String, Vec<f64>>;

/// The fates along growth units: from which end ranks are counted, how many ranks, and the word of a latent bud and of
/// one that made an axis where the species names no states.
#[derive(Debug, Clone, Copy)]
pub struct Along {
    pub from_tip: bool,
    pub ranks: usize,
    pub latent: &'static str,
    pub branch: &'static str,
}

/// The probabilities of 0, 1, 2 … nodes of a growth unit that has a node, by the order (its number and its laws).
///
/// # Errors
/// Why the law is no one distribution.
pub fn nodes(number: u8, order: &Order, short: bool) -> Result<Vec<f64>, String> {
    let unit = &order.growth_unit;
    let mut shares = if short {
        let nodes = unit.short.as_ref().map(|short| &short.nodes);
        count(number, nodes.ok_or("the order has no short growth units")?)?
    } else {
        sum(&count(number, &unit.nodes)?, &count(number, &unit.neoformed)?)
    };
    let none = shares.first_mut().map_or(0.0, std::mem::take);
    if none >= 1.0 {
        return Err("its growth units have no nodes".to_owned());
    }
    shares.iter_mut().for_each(|share| *share /= 1.0 - none);
    Ok(shares)
}

/// The distribution of the sum of two independent counts.
fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; (a.len() + b.len()).saturating_sub(1)];
    for (i, p) in a.iter().enumerate() {
        b.iter().enumerate().for_each(|(j, q)| sum[i + j] += p * q);
    }
    sum
}

/// The share of apical buds that live `0..=until` ticks after the birth of their axis, as far as mortality goes.
///
/// # Errors
/// Why the law is no one curve.
pub fn survival(number: u8, order: &Order, until: u32) -> Result<Vec<f64>, String> {
    let (speeds, _) = order.speed.compile(&Path::root()).map_err(|faults| first(&faults))?.into_parts();
    let [speed] = speeds.as_slice() else { return Err("each axis draws its speed".to_owned()) };
    let last = speed.steps_by(until).max(until);
    let hazards = order.death.compile_probability(&Domain::of_own_age(number, last), &Path::root().key("death"));
    let hazards = hazards.map_err(|faults| first(&faults))?;
    let mut alive = vec![1.0];
    for tick in 1..=until {
        let steps = speed.steps_by(tick - 1) + 1..=speed.steps_by(tick);
        let hazard = |step: u32| hazards.probability(At { dimension: tick, cycle: step, ..At::default() });
        let before = alive[alive.len() - 1];
        alive.push(steps.fold(before, |alive, step| alive * (1.0 - hazard(step))));
    }
    Ok(alive)
}

/// The share of each fate by rank along the growth units of an order.
///
/// # Errors
/// Why the law is no one distribution.
pub fn fates(number: u8, order: &Order, states: &[String], along: Along) -> Result<FatesByRank, String> {
    let of = Buds { number, order, states, along };
    match &order.axillary.pattern {
        Pattern::Named(_) => {
            let own = of.fates(None, None)?;
            Ok(of.by_rank((0..along.ranks).map(|_| vec![(1.0, &own)])))
        }
        Pattern::Rhythmic(rhythmic) => of.of_zones(&rhythmic.zones),
        Pattern::Chain(chain) => of.of_chain(chain),
    }
}

/// The axillary buds of an order.
#[derive(Clone, Copy)]
struct Buds<'a> {
    number: u8,
    order: &'a Order,
    states: &'a [String],
    along: Along,
}

/// The shares of the fates of a bud.
type Shares = BTreeMap<String, f64>;

impl Buds<'_> {
    /// The fates of a bud of a zone; of the order's own laws where a zone has none.
    fn fates(&self, ramification: Option<&Law>, state: Option<&ZoneState>) -> Result<Shares, String> {
        let awake = probability(self.number, ramification.unwrap_or(&self.order.axillary.ramification))?;
        let mut shares = Shares::from([(self.along.latent.to_owned(), 1.0 - awake)]);
        let own = self.order.axillary.state.clone().map(ZoneState::Named);
        match state.or(own.as_ref()) {
            _ if awake == 0.0 => {}
            Some(ZoneState::Named(state)) => drop(shares.insert(state.clone(), awake)),
            Some(ZoneState::Shares(of)) => {
                let all: f64 = of.values().sum();
                shares.extend(of.iter().map(|(state, share)| (state.clone(), awake * share / all)));
            }
            None if self.states.len() > 1 => return Err("new axes start in the state of their bearing axis".to_owned()),
            None => {
                let word = self.states.first().map_or(self.along.branch, String::as_str);
                shares.insert(word.to_owned(), awake);
            }
        }
        Ok(shares)
    }

    /// The fates by rank of zones that each have a share of a rank; what is left of a rank is latent.
    fn by_rank<'s>(&self, ranks: impl Iterator<Item = Vec<(f64, &'s Shares)>>) -> FatesByRank {
        let mut all = FatesByRank::new();
        let of_rank = |word: &str, place: usize, all: &mut FatesByRank, share: f64| {
            let row = all.entry(word.to_owned()).or_insert_with(|| vec![0.0; self.along.ranks]);
            row[place] += share;
        };
        for (place, zones) in ranks.enumerate().take(self.along.ranks) {
            let held: f64 = zones.iter().map(|(held, _)| held).sum();
            of_rank(self.along.latent, place, &mut all, 1.0 - held);
            for (held, shares) in zones {
                shares.iter().for_each(|(word, share)| of_rank(word, place, &mut all, held * share));
            }
        }
        all
    }

    fn of_zones(&self, zones: &[Zone]) -> Result<FatesByRank, String> {
        let mut ranges = Vec::new();
        for zone in zones {
            self.same_end(zone.from)?;
            let (first, last) = (fixed(self.number, &zone.first)?, zone.last.as_ref());
            let last = last.map(|last| fixed(self.number, last)).transpose()?.unwrap_or(u32::MAX);
            ranges.push((first..=last, self.fates(zone.ramification.as_ref(), zone.state.as_ref())?));
        }
        let holding = |rank: u32| {
            let holds = ranges.iter().find(|(range, _)| range.contains(&rank));
            holds.map(|(_, shares)| (1.0, shares)).into_iter().collect()
        };
        Ok(self.by_rank((1..=self.along.ranks as u32).map(holding)))
    }

    fn same_end(&self, end: End) -> Result<(), String> {
        let is_tip = end == End::Tip;
        if is_tip == self.along.from_tip {
            return Ok(());
        }
        let name = |is_tip| if is_tip { "tip" } else { "base" };
        Err(format!("its zones are counted from the {}, the figure from the {}", name(is_tip), name(!is_tip)))
    }

    fn of_chain(&self, chain: &Chain) -> Result<FatesByRank, String> {
        self.same_end(chain.from)?;
        let fates: Result<Vec<Shares>, String> =
            chain.chain.iter().map(|link| self.fates(link.ramification.as_ref(), link.state.as_ref())).collect();
        let (fates, holds) = (fates?, self.holds(chain)?);
        let of_rank =
            |place: usize| holds.iter().zip(&fates).map(|(holds, fates)| (holds[place], fates)).collect::<Vec<_>>();
        Ok(self.by_rank((0..self.along.ranks).map(of_rank)))
    }

    /// The probability that each zone of a chain holds each rank: forwards through the zones, from the ranks at which
    /// one begins to those at which the next do.
    fn holds(&self, chain: &Chain) -> Result<Vec<Vec<f64>>, String> {
        let (ranks, zones) = (self.along.ranks, chain.chain.len());
        let mut begins = vec![vec![0.0; ranks]; zones];
        let (mut holds, weights) = (begins.clone(), shares_of(&chain.begins));
        (0..zones).zip(weights).filter(|_| ranks > 0).for_each(|(zone, share)| begins[zone][0] = share);
        for (zone, Link { length, next, .. }) in chain.chain.iter().enumerate() {
            let lengths = length.as_ref().map(|length| count(self.number, length)).transpose()?;
            let next = shares_of(next);
            for first in 0..ranks {
                let mut left = begins[zone][first];
                for rank in first..ranks {
                    holds[zone][rank] += left;
                    let Some(lengths) = &lengths else { continue };
                    // A zone that is reached has a node at least.
                    let nodes = rank - first + 1;
                    let own = |nodes: usize| lengths.get(nodes).copied().unwrap_or(0.0);
                    let ends = begins[zone][first] * (own(nodes) + if nodes == 1 { own(0) } else { 0.0 });
                    left = (left - ends).max(0.0);
                    for (on, share) in next.iter().enumerate().filter(|_| rank + 1 < ranks) {
                        if let Some(begins) = begins.get_mut(zone + 1 + on) {
                            begins[rank + 1] += ends * share;
                        }
                    }
                }
            }
        }
        Ok(holds)
    }
}

/// Weights as shares; without weights, all is of the first.
fn shares_of(weights: &[f64]) -> Vec<f64> {
    let all: f64 = weights.iter().sum();
    if all > 0.0 { weights.iter().map(|weight| weight / all).collect() } else { vec![1.0] }
}

/// The probabilities of a count that depends on nothing.
fn count(number: u8, count: &Count) -> Result<Vec<f64>, String> {
    let table = count.compile(&Domain::of_own_age(number, 1), &Path::root()).map_err(|faults| first(&faults))?;
    if table.asks_only(&[]) {
        Ok(table.pmf(At::default()))
    } else {
        Err("it depends on the age of the axis".to_owned())
    }
}

/// A whole number that depends on nothing and is not drawn.
fn fixed(number: u8, count: &Count) -> Result<u32, String> {
    let table = count.compile(&Domain::of_own_age(number, 1), &Path::root()).map_err(|faults| first(&faults))?;
    table.constant().ok_or_else(|| "the ends of its zones are drawn".to_owned())
}

/// A probability that depends on nothing.
fn probability(number: u8, law: &Law) -> Result<f64, String> {
    let table = law.compile_probability(&Domain::of_own_age(number, 1), &Path::root());
    let table = table.map_err(|faults| first(&faults))?;
    table.constant().ok_or_else(|| "the share of awake buds depends on the age of the axis".to_owned())
}

fn first(faults: &[Fault]) -> String {
    faults.first().map_or_else(|| "it cannot be read".to_owned(), |fault| fault.problem.clone())
}
