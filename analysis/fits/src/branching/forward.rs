//! Forward and backward sums of a hidden semi-Markov chain along one shoot (Guédon 2003, §3), with the last zone cut
//! off by the end of the shoot.
//!
//! Products of at most some hundred probabilities stay within the range of a double where each is at least 10⁻³; a
//! shoot whose likelihood is 0 says so. Absent: estimation.

#![allow(clippy::needless_range_loop, reason = "places and zones are indices of several tables at once")]

use super::law::Chain;

/// The sums of one shoot, and of all shoots together.
#[derive(Debug, Clone)]
pub struct Expected {
    pub log_likelihood: f64,
    /// Zones that a shoot begins in.
    pub first: Vec<f64>,
    /// From zone to zone.
    pub passed: Vec<Vec<f64>>,
    /// Buds of each fate in each zone.
    pub emitted: Vec<Vec<f64>>,
    /// Zones that ended, by length from 1.
    pub ended: Vec<Vec<f64>>,
    /// Zones that the end of the shoot cut, by length from 1.
    pub cut: Vec<Vec<f64>>,
}

impl Expected {
    pub fn none(zones: usize, fates: usize, longest: usize) -> Self {
        Self {
            log_likelihood: 0.0,
            first: vec![0.0; zones],
            passed: vec![vec![0.0; zones]; zones],
            emitted: vec![vec![0.0; fates]; zones],
            ended: vec![vec![0.0; longest]; zones],
            cut: vec![vec![0.0; longest]; zones],
        }
    }
}

/// Probabilities of lengths and of at least such lengths, zone by zone.
pub struct Lengths {
    pub masses: Vec<Vec<f64>>,
    pub survivors: Vec<Vec<f64>>,
}

/// Adds the sums of a shoot; `false` where the chain cannot make it.
pub fn add(chain: &Chain, lengths: &Lengths, shoot: &[usize], sums: &mut Expected) -> bool {
    let (zones, buds) = (chain.zones(), shoot.len());
    let entered = enter(chain, lengths, shoot);
    let (begun, after) = backward(chain, lengths, shoot);
    let total: f64 = (0..zones).map(|zone| chain.first[zone] * begun[0][zone]).sum();
    if !(total > 0.0 && total.is_finite()) {
        return false;
    }
    sums.log_likelihood += phytomer_sim::math::log(total);
    for zone in 0..zones {
        sums.first[zone] += chain.first[zone] * begun[0][zone] / total;
        for start in 0..buds {
            let enter = entered[start][zone] / total;
            if enter > 0.0 {
                spend(chain, lengths, shoot, sums, (zone, start), enter, &after);
            }
        }
    }
    // A passage from `from` to `to` at a place: ended there, and begun at the next.
    let left = leave(chain, lengths, shoot, &entered);
    for place in 0..buds - 1 {
        for from in 0..zones {
            for to in chain.reach(from) {
                sums.passed[from][to] += left[place][from] * chain.next[from][to] * begun[place + 1][to] / total;
            }
        }
    }
    true
}

/// What a zone that begins at a place adds, by its length.
fn spend(
    chain: &Chain,
    lengths: &Lengths,
    shoot: &[usize],
    sums: &mut Expected,
    (zone, start): (usize, usize),
    enter: f64,
    after: &[Vec<f64>],
) {
    let buds = shoot.len();
    let mut product = enter;
    let mut shares = Vec::with_capacity(buds - start);
    for end in start..buds {
        product *= chain.shares[zone][shoot[end]];
        if product <= 0.0 {
            break;
        }
        let length = end - start;
        let share = if end + 1 == buds {
            let share = product * lengths.survivors[zone][length];
            sums.cut[zone][length] += share;
            share
        } else {
            let share = product * lengths.masses[zone][length] * after[end][zone];
            sums.ended[zone][length] += share;
            share
        };
        shares.push(share);
    }
    // A bud belongs to the zone for every length that reaches it.
    let mut reaching = 0.0;
    for (length, share) in shares.iter().enumerate().rev() {
        reaching += share;
        sums.emitted[zone][shoot[start + length]] += reaching;
    }
}

/// P(buds before the place, a zone begins at the place).
fn enter(chain: &Chain, lengths: &Lengths, shoot: &[usize]) -> Vec<Vec<f64>> {
    let zones = chain.zones();
    let mut entered = vec![vec![0.0; zones]; shoot.len()];
    entered[0].copy_from_slice(&chain.first);
    for start in 0..shoot.len() {
        for zone in 0..zones {
            let mut product = entered[start][zone];
            for end in start..shoot.len() - 1 {
                product *= chain.shares[zone][shoot[end]];
                if product <= 0.0 {
                    break;
                }
                let left = product * lengths.masses[zone][end - start];
                for to in chain.reach(zone) {
                    entered[end + 1][to] += left * chain.next[zone][to];
                }
            }
        }
    }
    entered
}

/// P(buds up to the place, a zone ends at the place).
fn leave(chain: &Chain, lengths: &Lengths, shoot: &[usize], entered: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let zones = chain.zones();
    let mut left = vec![vec![0.0; zones]; shoot.len()];
    for start in 0..shoot.len() {
        for zone in 0..zones {
            let mut product = entered[start][zone];
            for end in start..shoot.len() - 1 {
                product *= chain.shares[zone][shoot[end]];
                if product <= 0.0 {
                    break;
                }
                left[end][zone] += product * lengths.masses[zone][end - start];
            }
        }
    }
    left
}

/// P(buds from the place on, given that a zone begins there), and given that it ended there.
fn backward(chain: &Chain, lengths: &Lengths, shoot: &[usize]) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let (zones, buds) = (chain.zones(), shoot.len());
    let (mut begun, mut after) = (vec![vec![0.0; zones]; buds], vec![vec![0.0; zones]; buds]);
    for start in (0..buds).rev() {
        for zone in 0..zones {
            let (mut product, mut sum) = (1.0, 0.0);
            for end in start..buds {
                product *= chain.shares[zone][shoot[end]];
                if product <= 0.0 {
                    break;
                }
                let length = end - start;
                sum += product
                    * if end + 1 == buds {
                        lengths.survivors[zone][length]
                    } else {
                        lengths.masses[zone][length] * after[end][zone]
                    };
            }
            begun[start][zone] = sum;
        }
        if start > 0 {
            for zone in 0..zones {
                after[start - 1][zone] = chain.reach(zone).map(|to| chain.next[zone][to] * begun[start][to]).sum();
            }
        }
    }
    (begun, after)
}
