//! The draws of one event, one after another.
//!
//! Parameters are checked here: within these ranges every sampler of `rand_distr` ends, and none returns NaN. Absent:
//! what is drawn (`aggregation`, `clusters`).

use super::key::Key;
use super::real::Real;
use super::{DrawError, within};
use rand::RngExt;
use rand::distr::{Distribution, StandardUniform};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Beta, Gamma, Normal, Poisson};

/// The least and the largest shape of Beta and Gamma.
const SHAPE: [f64; 2] = [1e-3, 1e9];
/// The largest mean of a Poisson draw.
const MOST_MEAN: f64 = 1e9;
/// The largest mean, standard deviation and scale, by absolute value.
const MOST: f64 = 1e12;

/// The stream of draws of one event.
#[derive(Debug, Clone)]
pub struct Draws {
    words: ChaCha8Rng,
}

impl Draws {
    /// The draws of an event, from its first.
    pub fn of(key: &Key) -> Self {
        Self { words: key.generator() }
    }

    /// A number of [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.words.sample::<Real, _>(StandardUniform).0
    }

    /// Whether an event of probability `p` happens.
    pub fn happens(&mut self, p: f64) -> bool {
        self.uniform() < p
    }

    /// A number of [0, 1] with the density xᵃ⁻¹ (1 − x)ᵇ⁻¹ / B(a, b).
    ///
    /// # Errors
    /// Where a shape is outside [0.001, 10⁹].
    pub fn beta(&mut self, a: f64, b: f64) -> Result<f64, DrawError> {
        let [least, most] = SHAPE;
        let shapes = [within("the first shape", a, least, most)?, within("the second shape", b, least, most)?];
        self.sample(Beta::new(Real(shapes[0]), Real(shapes[1])), shapes[0])
    }

    /// A number above 0 with mean shape × scale and variance shape × scale².
    ///
    /// # Errors
    /// Where the shape is outside [0.001, 10⁹] or the scale outside [10⁻¹², 10¹²].
    pub fn gamma(&mut self, shape: f64, scale: f64) -> Result<f64, DrawError> {
        let [least, most] = SHAPE;
        let (shape, scale) = (within("the shape", shape, least, most)?, within("the scale", scale, 1.0 / MOST, MOST)?);
        self.sample(Gamma::new(Real(shape), Real(scale)), scale)
    }

    /// A number of events of which `mean` are expected.
    ///
    /// # Errors
    /// Where the mean is outside [0, 10⁹].
    pub fn poisson(&mut self, mean: f64) -> Result<u64, DrawError> {
        if within("the mean", mean, 0.0, MOST_MEAN)? == 0.0 {
            return Ok(0);
        }
        // A whole number below 2⁵³: the cast is exact.
        Ok(self.sample(Poisson::new(Real(mean)), mean)? as u64)
    }

    /// A normal deviate.
    ///
    /// # Errors
    /// Where the mean or the standard deviation is above 10¹² by absolute value, or the latter negative.
    pub fn normal(&mut self, mean: f64, sd: f64) -> Result<f64, DrawError> {
        let (mean, sd) = (within("the mean", mean, -MOST, MOST)?, within("the standard deviation", sd, 0.0, MOST)?);
        self.sample(Normal::new(Real(mean), Real(sd)), sd)
    }

    /// A site variable of which a block or a plot has its own value: `value` plus a normal deviate of standard
    /// deviation `sd`, kept within `least..=most` (N supply cannot be negative, a probability not above 1).
    ///
    /// # Errors
    /// Those of [`Draws::normal`].
    pub fn shifted(&mut self, value: f64, sd: f64, [least, most]: [f64; 2]) -> Result<f64, DrawError> {
        Ok(self.normal(value, sd)?.max(least).min(most))
    }

    /// A draw from a distribution whose parameters have been checked. `value` stands in the error that rand_distr
    /// would have to return in spite of that.
    fn sample<D: Distribution<Real>, E>(&mut self, of: Result<D, E>, value: f64) -> Result<f64, DrawError> {
        let refused = DrawError::Outside { name: "a parameter", value, least: -MOST, most: MOST };
        Ok(of.map_err(|_| refused)?.sample(&mut self.words).0)
    }
}
