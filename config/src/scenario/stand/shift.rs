//! What is drawn for the place of each plant: anywhere on the ground of a random layout, and within the jitter of its
//! marked place.

use super::{Layout, Stand};
use phytomer_sim::math::sincos;
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose};
use std::f64::consts::TAU;

impl Stand {
    /// How far a plant stands from the place of its member, metres eastward and northward; `draws` are those of the
    /// plant. In a disc the distance is R √u, so that each part of it is met as often as it is large.
    pub(in crate::scenario) fn shift(&self, draws: &PlantRandom) -> [f64; 2] {
        if !self.is_drawn() {
            return [0.0; 2];
        }
        let mut stream = draws.stream(LineageKey(0), Purpose::Place);
        let [u, v, distance, turn] = std::array::from_fn(|_| stream.share());
        let [x, y] = match &self.layout {
            Layout::Random(random) => [u * random.size_m[0], v * random.size_m[1]],
            _ => [0.0; 2],
        };
        let (sin, cos) = sincos(TAU * turn);
        let distance = self.jitter_m * distance.sqrt();
        [x + distance * sin, y + distance * cos]
    }
}
