//! What is drawn once for a tree: its size, the length of its trunk, and the factor of the trunk's radius (Weber & Penn
//! 1995 §4.3, §4.4); and the bare part of the trunk, which follows from the size.
//!
//! Absent: draws of single stems (`path`, `grow`).

use super::draws::{self, signed};
use super::generation::Family;
use super::numbers::Numbers;
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose};

/// What is drawn once for a tree.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawn {
    /// scale_tree, metres.
    pub scale: f64,
    /// 0Length ± 0LengthV.
    pub length: f64,
    /// 0Scale ± 0ScaleV.
    pub radius: f64,
}

impl Drawn {
    /// A size under a tenth of Scale is drawn again, as of the black oak, whose ScaleV equals its Scale.
    pub fn of(tree: &Numbers, random: &PlantRandom) -> Self {
        let mut words = random.stream(LineageKey::SEED, Purpose::Plant);
        let sizes =
            std::iter::once(0).chain(draws::AGAIN..).map(|place| tree.scale + tree.scale_v * signed(&mut words, place));
        let scale = sizes.take(1000).find(|scale| *scale >= 0.1 * tree.scale).unwrap_or(tree.scale);
        let trunk = tree.of(0);
        let length = trunk.length + trunk.length_v * signed(&mut words, draws::TRUNK_LENGTH);
        let radius = tree.radius_scale + tree.radius_scale_v * signed(&mut words, draws::RADIUS);
        Self { scale, length, radius }
    }
}

/// length_base over length_trunk on the trunk, with length_base = BaseSize·scale_tree as the text has it; 0 on
/// branches. A trunk that pruning has made shorter than its base bears next to nothing.
pub(super) fn bare(tree: &Numbers, drawn: Drawn, of: &Family) -> f64 {
    if of.level == 0 { (tree.base_size * drawn.scale / of.length).min(1.0 - 1e-6) } else { 0.0 }
}
