//! Branching ratios: botanical, between the orders that botanists count from the trunk, and Strahler's, between those
//! that are counted from the tips (Horton 1945; Strahler 1957; for trees McMahon & Kronauer 1976, Borchert & Slade
//! 1981).
//!
//! Strahler: a tip is of order 1; where two or more branches of the highest order k among those at a node meet, the
//! parent is of order k + 1, else of order k. A stream is a chain of one order. The bifurcation ratio is the
//! antilogarithm of the slope of log N over the order, with the sign turned (Horton), by least squares over all orders
//! that occur.

use crate::Lack;
use phytomer_sim::math::{exp, log};

/// The number of streams of each Strahler order, from order 1, in a forest of segments. `parent` has, for each segment,
/// the index of the segment that bears it, which is smaller than its own; `None` for the first. Linear in the segments.
pub fn strahler_streams(parent: &[Option<usize>]) -> Vec<u64> {
    let n = parent.len();
    // The highest order among the children of each segment, and how many of them have it.
    let (mut highest, mut of_highest) = (vec![0_u8; n], vec![0_u32; n]);
    let mut order = vec![1_u8; n];
    for at in (0..n).rev() {
        order[at] = match (highest[at], of_highest[at]) {
            (0, _) => 1,
            (k, 1) => k,
            (k, _) => k.saturating_add(1),
        };
        if let Some(below) = parent[at].filter(|below| *below < at) {
            match order[at].cmp(&highest[below]) {
                std::cmp::Ordering::Greater => (highest[below], of_highest[below]) = (order[at], 1),
                std::cmp::Ordering::Equal => of_highest[below] += 1,
                std::cmp::Ordering::Less => {}
            }
        }
    }
    let mut streams = Vec::new();
    for at in 0..n {
        let begins = parent[at].is_none_or(|below| below >= at || order[below] != order[at]);
        let place = usize::from(order[at]) - 1;
        if streams.len() <= place {
            streams.resize(place + 1, 0);
        }
        streams[place] += u64::from(begins);
    }
    streams
}

/// The bifurcation ratio of counts by order, lowest first, by least squares of their logarithms over the order. With
/// weights of a bootstrap the counts are any positive numbers; orders without a stream are left out.
///
/// # Errors
/// [`Lack::Groups`] with fewer than two orders.
pub fn bifurcation_ratio(counts: &[f64]) -> Result<f64, Lack> {
    let points: Vec<(f64, f64)> =
        (1_u32..).zip(counts).filter(|(_, n)| **n > 0.0).map(|(order, n)| (f64::from(order), log(*n))).collect();
    if points.len() < 2 {
        return Err(Lack::Groups { found: points.len() as u64, needed: 2 });
    }
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (xx, xy) =
        points.iter().fold((0.0, 0.0), |(xx, xy), (px, py)| (xx + (px - x) * (px - x), xy + (px - x) * (py - y)));
    Ok(exp(-xy / xx))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A perfect binary tree of five levels has 16, 8, 4, 2 and 1 streams.
    #[test]
    fn a_binary_tree_bifurcates_by_two() {
        let parent: Vec<Option<usize>> = (0..31).map(|i: usize| i.checked_sub(1).map(|i| i / 2)).collect();
        let streams = strahler_streams(&parent);
        assert_eq!(streams, [16, 8, 4, 2, 1]);
        let counts: Vec<f64> = streams.iter().map(|n| *n as f64).collect();
        assert!((bifurcation_ratio(&counts).unwrap() - 2.0).abs() < 1e-12);
    }

    /// A fishbone: a stem with a twig at each node is of order 2, however many twigs it has.
    #[test]
    fn a_stem_with_twigs_is_of_order_two() {
        // Stem 0, 1, 2, 3; twigs 4, 5, 6 on its first three segments; the last segment is a tip.
        let parent = [None, Some(0), Some(1), Some(2), Some(0), Some(1), Some(2)];
        assert_eq!(strahler_streams(&parent), [4, 1]);
        assert_eq!(strahler_streams(&[None, Some(0), Some(1)]), [1]);
        assert!(strahler_streams(&[]).is_empty());
    }

    #[test]
    fn what_is_missing_is_said() {
        assert_eq!(bifurcation_ratio(&[5.0]), Err(Lack::Groups { found: 1, needed: 2 }));
        assert_eq!(bifurcation_ratio(&[5.0, 0.0]), Err(Lack::Groups { found: 1, needed: 2 }));
    }
}
