//! Laws whose intervals take long to hold against the truth: mixtures of nodes, and the crown.
//!
//! A design draws a sample of its law and fits that law again; both are keyed by the number of the repetition. The test
//! repeats a design a few times, the example `coverage` 4,000 times. Absent: what comes out, which stands in
//! `docs/statistics.md`.

use phytomer_fits::Fit;
use phytomer_fits::crown::{Pair, drawn, fit};
use phytomer_fits::draws::Draws;
use phytomer_fits::nodes::laws::Counts;
use phytomer_fits::nodes::{Family, Part, fit_mixture};

/// A law with its numbers, and how often samples of it are fitted.
pub struct Design {
    pub name: &'static str,
    /// The names of the numbers in a fit, and their true values.
    pub truths: &'static [(&'static str, f64)],
    /// The fit of the sample of a repetition.
    sample: fn(&mut Draws) -> Option<Fit>,
}

/// What came of a number in all repetitions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Held {
    /// The intervals that hold the truth; a limit that the sample does not set counts as endless.
    pub held: u64,
    /// Those with both limits.
    pub closed: u64,
}

pub const DESIGNS: [Design; 4] = [
    Design {
        name: "120 units of .215 B(10, .685) + .785 B(23, .635), as wild cherry",
        truths: &[("weight_1", 0.215), ("p_1", 0.685), ("p_2", 0.635), ("n_1", 10.0), ("n_2", 23.0)],
        sample: |draws| {
            let parts = [(0.215, Part::Binomial { n: 10, p: 0.685 }), (0.785, Part::Binomial { n: 23, p: 0.635 })];
            mixture(draws, 120, parts)
        },
    },
    Design {
        name: "348 units of .279 P(12.24) + .721 NB(22.26, .469), as poplar of order 3",
        truths: &[("weight_1", 0.279), ("mean_1", 12.24), ("r_2", 22.26), ("p_2", 0.469)],
        sample: |draws| {
            let second = Part::NegativeBinomial { r: 22.26, p: 0.469 };
            mixture(draws, 348, [(0.279, Part::Poisson { mean: 12.24 }), (0.721, second)])
        },
    },
    Design {
        name: "200 units of .4 P(4) + .6 P(15), well apart",
        truths: &[("weight_1", 0.4), ("mean_1", 4.0), ("mean_2", 15.0)],
        sample: |draws| mixture(draws, 200, [(0.4, Part::Poisson { mean: 4.0 }), (0.6, Part::Poisson { mean: 15.0 })]),
    },
    Design {
        name: "100 pairs with 20 nodes above them, b₁ .9, b₂ .7, w 1",
        truths: &[("b1", 0.9), ("b2", 0.7), ("w", 1.0)],
        sample: |draws| fit(&drawn(&[Pair { above: 20, nodes: [0, 0] }; 100], [0.9, 0.7, 1.0], draws)).ok(),
    },
];

/// A sample of a mixture, and the mixture of the same families that is fitted to it.
fn mixture(draws: &mut Draws, units: usize, parts: [(f64, Part); 2]) -> Option<Fit> {
    let masses = Counts { parts: parts.to_vec(), shift: 0 }.masses(200);
    let mut counts = vec![0.0; masses.len()];
    (0..units).for_each(|_| counts[draws.among(&masses)] += 1.0);
    let families: [Family; 2] = parts.map(|(_, part)| part.family());
    Some(fit_mixture(&counts, families).ok()?.1)
}

impl Design {
    /// What came of each number in the repetitions `from` and on.
    pub fn repeat(&self, from: u64, times: u64) -> Vec<Held> {
        let mut told = vec![Held::default(); self.truths.len()];
        for time in from..from + times {
            let Some(fit) = (self.sample)(&mut Draws::new(16, time)) else { continue };
            for ((name, truth), told) in self.truths.iter().zip(&mut told) {
                let Some(estimate) = fit.estimate(name) else { continue };
                let (low, high) = (estimate.low.unwrap_or(f64::NEG_INFINITY), estimate.high.unwrap_or(f64::INFINITY));
                told.held += u64::from(low <= *truth && *truth <= high);
                told.closed += u64::from(low.is_finite() && high.is_finite());
            }
        }
        told
    }
}
