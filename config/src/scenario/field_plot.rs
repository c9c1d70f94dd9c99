//! A field plot, one replicate of one treatment: how its block and the field plot itself shift what the site has.
//!
//! A block is a piece of ground: its shift is the same for all treatments that stand in it, and in every season. The
//! shift of a field plot is its own: it is drawn by the name of the treatment, so that it stays when another treatment
//! is added. Both are normal deviates. Absent: the plots within a field plot, which differ by the plants alone
//! (`pests` has a shift of these too).

use phytomer_draws::{Draws, Event, Key, NONE};
use phytomer_law::fault::{Fault, Path};

use super::{Experiment, Scenario};

/// A field plot of a run.
#[derive(Debug, Clone, Copy)]
pub struct FieldPlot<'a> {
    /// The seed of the run.
    pub seed: u64,
    /// The name of its treatment.
    pub treatment: &'a str,
    /// Its replicate.
    pub replicate: u32,
    /// Its block; `None` where the field has no blocks.
    pub block: Option<u32>,
}

/// The standard deviations by which a variable of the site differs between blocks and between field plots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spread {
    pub block_sd: f64,
    pub field_plot_sd: f64,
}

impl Spread {
    /// Whether anything differs.
    pub fn is_any(&self) -> bool {
        self.block_sd > 0.0 || self.field_plot_sd > 0.0
    }
}

impl FieldPlot<'_> {
    /// A variable of the site in this field plot: its mean, shifted by the block and then by the field plot. Either
    /// value is kept within the range.
    pub(super) fn shifted(&self, variable: &str, mean: f64, spread: Spread, range: [f64; 2]) -> f64 {
        let Self { seed, treatment, replicate, block } = *self;
        let of = |replicate, event| Key { seed, replicate, plot: NONE, event, plant: NONE, season: NONE };
        let shifted = |value: f64, sd: f64, key: Key| match sd > 0.0 {
            true => Draws::of(&key).shifted(value, sd, range).unwrap_or(value),
            false => value,
        };
        let of_block = block.map(|block| of(block, Event::named("block", variable)));
        let of_block = of_block.map_or(mean, |key| shifted(mean, spread.block_sd, key));
        let event = Event::named(&format!("field plot, {variable}"), treatment);
        shifted(of_block, spread.field_plot_sd, of(replicate, event))
    }
}

impl Scenario {
    /// Adds the faults of differences between blocks in a field without blocks.
    pub(super) fn check_blocks(&self, experiment: &Experiment, faults: &mut Vec<Fault>) {
        if experiment.block_of(0).is_some() {
            return;
        }
        let of_soil = self.soil.iter().filter(|soil| soil.block_sd_kg_ha > 0.0);
        let of_soil = of_soil.map(|_| Path::root().key("soil").key("block_sd_kg_ha"));
        let of_pests = self.pest.iter().enumerate().filter(|(_, pest)| pest.block_sd > 0.0);
        let of_pests = of_pests.map(|(number, _)| Path::root().key("pest").index(number).key("block_sd"));
        faults.extend(of_soil.chain(of_pests).map(|path| {
            let problem = "the field has no blocks that could differ";
            let expected = "`experimental_design = \"randomised_blocks\"` in `[experiment]`, or a difference between \
                            field plots";
            Fault::new(&path, problem, expected)
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OF_BLOCKS: Spread = Spread { block_sd: 2.0, field_plot_sd: 0.0 };
    const OF_FIELD_PLOTS: Spread = Spread { block_sd: 0.0, field_plot_sd: 3.0 };

    fn drawn(treatment: &str, spread: Spread) -> Vec<f64> {
        let of = |replicate| FieldPlot { seed: 7, treatment, replicate, block: Some(replicate) };
        (0..4000).map(|replicate| of(replicate).shifted("soil", 50.0, spread, [0.0, 1e4]) - 50.0).collect()
    }

    fn covariance(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / a.len() as f64
    }

    /// The bounds are five standard errors: of a variance v from n draws √(2/n) v, of a covariance of independent
    /// draws v/√n, of a mean √(v/n).
    #[test]
    fn treatments_share_their_blocks_and_not_their_field_plots() {
        let root_n = f64::sqrt(4000.0);
        let [a, b] = ["a", "b"].map(|treatment| drawn(treatment, OF_BLOCKS));
        assert_eq!(a, b, "a block is the same for all treatments");
        assert!((covariance(&a, &a) - 4.0).abs() < 5.0 * f64::sqrt(2.0) / root_n * 4.0);
        assert!((a.iter().sum::<f64>() / 4000.0).abs() < 5.0 * 2.0 / root_n);
        let [c, d] = ["a", "b"].map(|treatment| drawn(treatment, OF_FIELD_PLOTS));
        assert!((covariance(&c, &c) - 9.0).abs() < 5.0 * f64::sqrt(2.0) / root_n * 9.0);
        assert!(covariance(&c, &d).abs() < 5.0 * 9.0 / root_n && covariance(&a, &c).abs() < 5.0 * 6.0 / root_n);
        let both = drawn("a", Spread { block_sd: 2.0, field_plot_sd: 3.0 });
        assert!((covariance(&both, &both) - 13.0).abs() < 5.0 * f64::sqrt(2.0) / root_n * 13.0);
    }

    #[test]
    fn a_shift_stays_within_its_range_and_needs_what_shifts() {
        let of = |block, spread| {
            let field_plot = |replicate| FieldPlot { seed: 7, treatment: "a", replicate, block };
            (0..100).map(|replicate| field_plot(replicate).shifted("soil", 1.0, spread, [0.0, 2.0])).collect::<Vec<_>>()
        };
        let shifted = of(None, Spread { block_sd: 0.0, field_plot_sd: 9.0 });
        assert!(shifted.iter().all(|value| (0.0..=2.0).contains(value)));
        assert!([0.0, 2.0].iter().all(|end| shifted.contains(end)));
        assert!(of(None, OF_BLOCKS).iter().all(|value| *value == 1.0), "no block");
        assert!(of(Some(3), Spread { block_sd: 0.0, field_plot_sd: 0.0 }).iter().all(|value| *value == 1.0));
    }
}
