//! The runs test: the number of runs of equal fates along shoots, against shoots of the same lengths drawn from a law.
//!
//! Independent buds have more runs than buds that are alike in zones of random length. The law is refused where z is
//! beyond ±3. Absent: the law itself.

use super::Shoots;
use crate::draws::Draws;

/// Runs that were counted, and those of the law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Runs {
    /// Runs of the measured shoots.
    pub measured: f64,
    /// Mean of the drawn ones.
    pub mean: f64,
    /// Their standard deviation.
    pub sd: f64,
}

impl Runs {
    /// (measured − mean) / sd.
    pub fn z(&self) -> f64 {
        (self.measured - self.mean) / self.sd
    }
}

/// Draws all shoots `times` times; `draw` makes the fates of one of so many buds.
pub fn runs(shoots: &Shoots, seed: u64, times: u32, draw: impl Fn(usize, &mut Draws) -> Vec<usize>) -> Runs {
    let drawn = (0..u64::from(times)).map(|time| {
        let mut draws = Draws::new(seed, time);
        let drawn = shoots.shoots.iter().map(|shoot| draw(shoot.len(), &mut draws)).collect();
        Shoots { fates: shoots.fates, shoots: drawn }.runs() as f64
    });
    let drawn: Vec<f64> = drawn.collect();
    let n = drawn.len() as f64;
    let mean = drawn.iter().sum::<f64>() / n;
    let variance = drawn.iter().map(|runs| (runs - mean) * (runs - mean)).sum::<f64>() / (n - 1.0);
    Runs { measured: shoots.runs() as f64, mean, sd: variance.sqrt() }
}
