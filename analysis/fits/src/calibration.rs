//! Simulation-based calibration of an estimation without a likelihood (Talts et al. 2018).
//!
//! Parameters are drawn from the prior, summaries from them, and the share of the posterior below each parameter is its
//! rank. Where the posterior is right, ranks are uniform on (0, 1), which χ² over equal cells tests. Absent: the
//! estimation (`abc`).

use crate::abc::{Asked, Simulator, abc, seed_of};
use crate::draws::Draws;
use crate::fit::Test;
use crate::problem::Problem;

/// The ranks of so many sets of parameters drawn from the prior, one for each parameter of a set. A set that cannot be
/// simulated is left out.
///
/// # Errors
/// As [`abc`].
pub fn ranks(simulate: Simulator<'_>, asked: &Asked, times: u32) -> Result<Vec<Vec<f64>>, Problem> {
    let mut told = Vec::new();
    for time in 0..u64::from(times) {
        let mut draws = Draws::new(asked.seed ^ 0x5bc0_0000_0000, time);
        let truth: Vec<f64> = asked.priors.iter().map(|[low, high]| low + (high - low) * draws.share()).collect();
        let Some(observed) = simulate(&truth, seed_of(asked.seed, u32::MAX, time)) else { continue };
        let posterior = abc(simulate, &observed, &Asked { seed: asked.seed.wrapping_add(1 + time), ..asked.clone() })?;
        let below =
            |(k, truth): (usize, &f64)| posterior.particles.iter().filter(|p| p.at[k] < *truth).map(|p| p.weight).sum();
        told.push(truth.iter().enumerate().map(below).collect());
    }
    Ok(told)
}

/// χ² of ranks over equal cells, as many as hold 20 ranks each, from 2 to 20; `None` for fewer than 40 ranks.
pub fn uniformity(name: &str, ranks: &[f64]) -> Option<Test> {
    let cells = (ranks.len() / 20).min(20);
    if cells < 2 {
        return None;
    }
    let mut counts = vec![0.0; cells];
    ranks.iter().for_each(|rank| counts[((rank * cells as f64) as usize).min(cells - 1)] += 1.0);
    let expected = ranks.len() as f64 / cells as f64;
    let statistic = counts.iter().map(|count| (count - expected) * (count - expected) / expected).sum();
    Some(Test::chi2(&format!("ranks of {name} in {cells} equal cells"), statistic, cells - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share of successes among 40 trials.
    fn successes(at: &[f64], seed: u64) -> Option<Vec<f64>> {
        Some(vec![f64::from(Draws::new(seed, 1).binomial(40, at[0])) / 40.0])
    }

    /// 200 ranks in ten cells: χ² with 9 df has p below 10⁻⁴ once in ten thousand.
    #[test]
    fn ranks_of_the_posterior_are_uniform() {
        let asked = Asked { priors: vec![[0.0, 1.0]], particles: 200, generations: 4, seed: 1988 };
        let told: Vec<f64> = ranks(&successes, &asked, 200).unwrap().iter().map(|ranks| ranks[0]).collect();
        let test = uniformity("p", &told).unwrap();
        println!("{test:?}");
        assert!(told.len() == 200 && test.df == 9.0 && test.p > 1e-4, "{test:?}");
        // A posterior that is too narrow has too many ranks at both ends.
        let narrow: Vec<f64> = told.iter().map(|rank| (2.0 * (rank - 0.5) + 0.5).clamp(0.0, 1.0)).collect();
        assert!(uniformity("p", &narrow).unwrap().p < 1e-6);
        assert!(uniformity("p", &told[..30]).is_none());
    }
}
