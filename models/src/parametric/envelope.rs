//! The envelope to which a tree is pruned (Weber & Penn 1995 §4.6), also the curve of Shape 8.
//!
//! Two slips of the paper are mended. Its r has z² in it, with which no point above the middle of the tree could be
//! inside; the text calls the envelope a figure about the trunk, and r is √(x² + y²) here. Its second case divides by 1
//! − PruneWidthPeak, with which the curve jumps at the peak unless the peak is 0.5; here it divides by PruneWidthPeak.
//! PruneWidth is a radius, as the formula has it, and not the width that Figure 2 marks. Absent: the shortening of
//! stems (`prune`).

use super::numbers::Envelope;
use phytomer_sim::math;

/// ShapeRatio(8, ratio), in which ratio is 0 at the top of the envelope and 1 at its bottom; 0 outside of them.
pub(super) fn shape_8(envelope: &Envelope, ratio: f64) -> f64 {
    if !(0.0..=1.0).contains(&ratio) {
        return 0.0;
    }
    let above = 1.0 - envelope.peak;
    if ratio < above {
        math::pow(ratio / above, envelope.high)
    } else {
        math::pow((1.0 - ratio) / envelope.peak, envelope.low)
    }
}

/// By how much a point is outside of the envelope, over the size of the tree: its distance from the axis beyond the
/// radius of the envelope at its height, of which `height` and `out` are also over the size. Below 0 inside; a point
/// over the top or under the bottom is outside by its distance from the axis, and at least by that from the envelope's
/// end.
pub(super) fn beyond(envelope: &Envelope, base_size: f64, height: f64, out: f64) -> f64 {
    let ratio = (1.0 - height) / (1.0 - base_size);
    let over = (height - 1.0).max(base_size - height).max(0.0);
    (out - envelope.width * shape_8(envelope, ratio)).max(if over > 0.0 { over.max(out) } else { f64::NEG_INFINITY })
}
