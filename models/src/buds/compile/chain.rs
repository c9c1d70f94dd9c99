//! A chain of zones along a growth unit: where it begins, how long each zone is, and which zone follows (Guédon et al.
//! 2001, left-to-right semi-Markov chains).
//!
//! All numbers of a chain have slots in the step's record of words, whether the unit reaches their zone or not, so that
//! no draw depends on another. The ranks that come of them are those of zones of their own. Absent: ramification.

use super::compiler::Compiler;
use super::words::{Layout, Number};
use crate::buds::params::Chain;
use crate::law::{At, Count, CountForm, CountTable, Variable};

/// The most zones of a chain.
const MOST_ZONES: usize = 64;
/// The most ranks of a unit for which the forecast follows a chain.
const MOST_RANKS: usize = 1024;
/// A zone that a unit does not reach.
const NOWHERE: (u32, u32) = (1, 0);

/// A compiled chain.
#[derive(Debug, Clone)]
pub struct ChainLaw {
    begins: Number,
    /// The length of each zone, `None`: to the end of the unit; and how many zones on the next one is, from 0.
    links: Vec<(Option<Number>, Number)>,
}

impl ChainLaw {
    /// Compiles a chain, with words for `units` growth units. A zone other than the last without a length is a fault.
    pub fn compile(chain: &Chain, compiler: &mut Compiler, words: &mut Layout, units: u32) -> Self {
        let begins = weights(&chain.begins, chain.chain.len(), "axillary.pattern.begins", compiler);
        let begins = words.number(begins, units);
        let last = chain.chain.len().saturating_sub(1);
        let links = chain.chain.iter().take(MOST_ZONES).enumerate().map(|(index, link)| {
            let keys = format!("axillary.pattern.chain.{index}");
            if link.length.is_none() && index < last {
                let expected = "a length of each zone but the last";
                compiler.fault(&keys, "the zone has no length, and other zones follow".to_owned(), expected);
            }
            let length = link.length.as_ref().map(|length| compiler.rank(length, &format!("{keys}.length")));
            let length = length.map(|table| words.number(table, units));
            let next = weights(&link.next, (last - index).max(1), &format!("{keys}.next"), compiler);
            (length, words.number(next, units))
        });
        Self { begins, links: links.collect() }
    }

    /// The ranks of the zones of the `unit`-th growth unit of a step.
    pub fn draw(&self, words: &[u32], unit: u32, at: At, ranks: &mut Vec<(u32, u32)>) {
        ranks.clear();
        ranks.resize(self.links.len(), NOWHERE);
        let (mut zone, mut first) = (self.begins.draw(words, unit, at) as usize, 1_u32);
        while let Some((length, next)) = self.links.get(zone) {
            let last = match length {
                Some(length) => first.saturating_add(length.draw(words, unit, at).max(1) - 1),
                None => u32::MAX,
            };
            ranks[zone] = (first, last);
            first = last.saturating_add(1);
            zone += 1 + next.draw(words, unit, at) as usize;
        }
    }

    /// Whether all distributions depend on the state and the variables `known` at most.
    pub fn asks_only(&self, known: &[Variable]) -> bool {
        let own = |number: &Number| number.table.asks_only(known);
        own(&self.begins) && self.links.iter().all(|(length, next)| length.as_ref().is_none_or(own) && own(next))
    }

    /// For each zone the probability that it holds the node of rank 0, 1, 2 … and no zone before it does, given that no
    /// zone before it does: zones of a chain exclude one another. Later nodes have the last probability.
    pub fn holding(&self, at: At) -> Vec<Vec<f64>> {
        let holds = self.holds(at);
        let ranks = holds.first().map_or(0, Vec::len);
        let mut free = vec![1.0; ranks];
        let given = |zone: Vec<f64>| {
            let given = zone.iter().zip(&mut free).map(|(holds, free)| {
                let given = if *free > 1e-12 { (holds / *free).clamp(0.0, 1.0) } else { 0.0 };
                *free -= holds;
                given
            });
            given.collect()
        };
        holds.into_iter().map(given).collect()
    }

    /// The probability that each zone holds the node of rank 0, 1, 2 …, up to a rank beyond which nothing changes.
    fn holds(&self, at: At) -> Vec<Vec<f64>> {
        let lengths: Vec<Option<Vec<f64>>> =
            self.links.iter().map(|(length, _)| length.as_ref().map(|length| length.table.pmf(at))).collect();
        let longest: usize = lengths.iter().flatten().map(Vec::len).sum();
        let ranks = (longest + 2).min(MOST_RANKS);
        let mut begins = vec![vec![0.0; ranks + 1]; self.links.len()];
        for (zone, p) in self.begins.table.pmf(at).into_iter().enumerate().take(self.links.len()) {
            begins[zone][1] = p;
        }
        let mut holds = vec![vec![0.0; ranks]; self.links.len()];
        for (zone, (_, next)) in self.links.iter().enumerate() {
            let (begun, next) = (begins[zone].clone(), next.table.pmf(at));
            for (first, p) in begun.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                let Some(lengths) = &lengths[zone] else {
                    holds[zone].iter_mut().skip(first).for_each(|holds| *holds += p);
                    continue;
                };
                let mut left = *p;
                for (length, share) in lengths.iter().enumerate().filter(|(length, _)| *length > 0) {
                    let rank = first + length - 1;
                    if rank < ranks {
                        holds[zone][rank] += left;
                    }
                    left -= p * share;
                    for (on, weight) in next.iter().enumerate().take_while(|_| rank < ranks) {
                        if let Some(begins) = begins.get_mut(zone + 1 + on) {
                            begins[rank + 1] += p * share * weight;
                        }
                    }
                }
            }
        }
        holds
    }
}

/// The distribution of a place among weights; always the first where none are stated.
fn weights(weights: &[f64], most: usize, keys: &str, compiler: &mut Compiler) -> CountTable {
    if weights.is_empty() {
        return CountTable::always(0);
    }
    let sum: f64 = weights.iter().sum();
    let wrong = !sum.is_finite() || sum <= 0.0 || weights.iter().any(|weight| *weight < 0.0);
    if wrong || weights.len() > most {
        let found = format!("{} weights that sum to {sum}", weights.len());
        compiler.fault(keys, found, "weights of 0 or more, one of them above 0, and no more than there are zones");
        return CountTable::always(0);
    }
    let which = Count::from(CountForm { empirical: Some(weights.to_vec()), ..CountForm::default() });
    compiler.count(&which, keys, u32::MAX)
}
