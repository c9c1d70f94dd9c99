//! Random draws of a program. A draw is a function of the plant, the module, the step and the purpose, and of what
//! `seed:` and `srand` have set; so a plant does not depend on its neighbours, nor a module on the modules before it.
//!
//! Normal: polar method (Marsaglia & Bray 1964). Gamma, for beta: Marsaglia & Tsang 2000. Binomial: as many trials.

use phytomer_sim::key::{LineageKey, mix, scramble};
use phytomer_sim::math;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};

/// What the draws of a module are for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum For {
    Rewriting = 1,
    Decomposition = 2,
    Homomorphism = 3,
    Block = 4,
}

/// The draws of one module for one purpose at one step.
#[derive(Debug)]
pub(crate) struct Draws<'r> {
    random: &'r PlantRandom,
    key: u64,
    stream: Option<Stream>,
}

/// Trials after which a rejection is given up: no rejection comes near it.
const MOST_TRIALS: u32 = 1000;

impl<'r> Draws<'r> {
    pub fn new(random: &'r PlantRandom) -> Self {
        Self { random, key: 0, stream: None }
    }

    /// Turns to the draws of a module.
    #[inline]
    pub fn turn_to(&mut self, key: LineageKey, step: u32, purpose: For) {
        self.key = key.0 ^ (u64::from(step) << 8 | purpose as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.stream = None;
    }

    /// Begins anew: the seed has changed.
    pub fn begin_anew(&mut self) {
        self.stream = None;
    }

    /// Uniform in [0, 1), with 53 bits.
    pub fn uniform(&mut self, seed: u64) -> f64 {
        let (random, key) = (self.random, self.key);
        let name = || random.stream(LineageKey(mix(scramble(key), scramble(seed))), Purpose::Rewriting);
        let stream = self.stream.get_or_insert_with(name);
        let (high, low) = (u64::from(stream.word()), u64::from(stream.word()));
        ((high << 32 | low) >> 11) as f64 / 9_007_199_254_740_992.0
    }

    /// Normal, with mean 0 and standard deviation 1.
    pub fn normal(&mut self, seed: u64) -> f64 {
        for _ in 0..MOST_TRIALS {
            let (u, v) = (2.0 * self.uniform(seed) - 1.0, 2.0 * self.uniform(seed) - 1.0);
            let square = u * u + v * v;
            if square > 0.0 && square < 1.0 {
                return u * (-2.0 * math::log(square) / square).sqrt();
            }
        }
        0.0
    }

    /// Gamma of a shape above 0, with scale 1.
    fn gamma(&mut self, seed: u64, shape: f64) -> f64 {
        let boost = if shape < 1.0 { math::pow(1.0 - self.uniform(seed), 1.0 / shape) } else { 1.0 };
        let d = if shape < 1.0 { shape + 1.0 } else { shape } - 1.0 / 3.0;
        let c = 1.0 / (9.0 * d).sqrt();
        for _ in 0..MOST_TRIALS {
            let x = self.normal(seed);
            let v = (1.0 + c * x) * (1.0 + c * x) * (1.0 + c * x);
            let u = 1.0 - self.uniform(seed);
            if v > 0.0 && math::log(u) < 0.5 * x * x + d - d * v + d * math::log(v) {
                return boost * d * v;
            }
        }
        boost * d
    }

    /// Beta of two shapes; NaN where one of them is not above 0.
    pub fn beta(&mut self, seed: u64, a: f64, b: f64) -> f64 {
        if !(a > 0.0 && b > 0.0 && a.is_finite() && b.is_finite()) {
            return f64::NAN;
        }
        let (x, y) = (self.gamma(seed, a), self.gamma(seed, b));
        if x + y > 0.0 { x / (x + y) } else { 0.5 }
    }

    /// How many of so many trials succeed.
    pub fn binomial(&mut self, seed: u64, trials: u32, share: f64) -> f64 {
        f64::from((0..trials).filter(|_| self.uniform(seed) < share).count() as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means and variances of 40,000 draws within five standard errors of the closed forms.
    #[test]
    fn moments_are_those_of_the_distributions() {
        const N: usize = 40_000;
        let random = PlantRandom::new(1, 2);
        let holds = |name: &str, mean: f64, variance: f64, draw: &mut dyn FnMut(&mut Draws<'_>) -> f64| {
            let mut draws = Draws::new(&random);
            let mut sums = [0.0; 2];
            for module in 0..N as u64 {
                draws.turn_to(LineageKey(scramble(module)), 3, For::Rewriting);
                let value = draw(&mut draws) - mean;
                sums = [sums[0] + value, sums[1] + value * value];
            }
            let [bias, square] = sums.map(|sum| sum / N as f64);
            assert!(bias.abs() < 5.0 * (variance / N as f64).sqrt(), "{name}: mean off by {bias}");
            // The fourth moment of each of them is below 6 variances squared.
            assert!((square - variance).abs() < 5.0 * variance * (5.0 / N as f64).sqrt(), "{name}: {square}");
        };
        holds("uniform", 0.5, 1.0 / 12.0, &mut |draws| draws.uniform(0));
        holds("normal", 0.0, 1.0, &mut |draws| draws.normal(0));
        holds("beta", 0.25, 0.25 * 0.75 / 9.0, &mut |draws| draws.beta(0, 2.0, 6.0));
        holds("beta below 1", 0.5, 0.25 / 2.0, &mut |draws| draws.beta(0, 0.5, 0.5));
        holds("binomial", 3.0, 2.1, &mut |draws| draws.binomial(0, 10, 0.3));
    }

    #[test]
    fn a_draw_depends_on_plant_module_step_purpose_and_seed() {
        let draw = |plant, module, step, purpose, seed| {
            let random = PlantRandom::new(7, plant);
            let mut draws = Draws::new(&random);
            draws.turn_to(LineageKey(module), step, purpose);
            draws.uniform(seed)
        };
        let one = draw(1, 1, 1, For::Rewriting, 0);
        assert_eq!(one, draw(1, 1, 1, For::Rewriting, 0));
        let others = [
            draw(2, 1, 1, For::Rewriting, 0),
            draw(1, 2, 1, For::Rewriting, 0),
            draw(1, 1, 2, For::Rewriting, 0),
            draw(1, 1, 1, For::Decomposition, 0),
            draw(1, 1, 1, For::Rewriting, 1),
        ];
        assert!(others.iter().all(|&other| other != one));
    }
}
