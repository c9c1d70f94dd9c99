//! What plants of a plot meet in benches: blocks, a ground, stems. Absent: the plants.

use phytomer::sim::Plot;
use phytomer::sim::shape::{Cuboid, Shape};
use phytomer::sim::site::stems::Whose;
use phytomer::sim::site::{Manner, Obstacle, Side};
use std::sync::Arc;

/// What plants of a plot meet.
#[derive(Clone, Default)]
pub struct Met {
    pub obstacles: Vec<Obstacle>,
    pub ground: Option<f64>,
    pub stems: Whose,
}

impl Met {
    /// Lays it out on a plot.
    pub fn lie_on(&self, plot: &mut Plot<'_>) {
        let Self { obstacles, ground, stems } = self.clone();
        (plot.site.obstacles, plot.site.ground, plot.site.whose_stems) = (obstacles, ground, stems);
    }
}

/// A box that no shoot enters, and to which climbers hold.
pub fn blocks(low: [f64; 3], size: [f64; 3]) -> Obstacle {
    let high = [0, 1, 2].map(|k| low[k] + size[k]);
    solid(Shape::Cuboid(Cuboid { low, high }))
}

/// A shape that no shoot enters, and to which climbers hold.
pub fn solid(shape: Shape) -> Obstacle {
    Obstacle { shape: Arc::new(shape), kills: Side::Inside, manner: Manner::Blocks { holds: true } }
}
