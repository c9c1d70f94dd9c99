//! What degradation at range asks of a tree (Weber & Penn 1995 §5): its quality, and whether its leaves hide its stems.
//!
//! The paper tells evergreens, and trees in summer and fall, from others, and spring from the rest of the year. Here a
//! tree without a season is an evergreen, or stands in summer, if it bears leaves; the first quarter of the time in
//! leaf is spring. Absent: the curves, which meshes have.

use super::params::Whole;
use crate::parameters::Levelled;
use phytomer_sim::Tick;

/// A tree as it is at an age.
pub(super) fn levelled(tree: &Whole, age: Tick) -> Levelled {
    let quality = tree.quality.value();
    let Some(season) = &tree.season else {
        return Levelled { quality, in_leaf: tree.leaves.value() != 0.0, spring: false };
    };
    let [year, out, fall] = [&season.ticks_per_year, &season.leaf_out, &season.leaf_fall].map(|ticks| ticks.value());
    let tick = age % year.max(1);
    let leafy = (out..fall).contains(&tick);
    let spring = leafy && 4 * u64::from(tick - out) < u64::from(fall - out);
    Levelled { quality, in_leaf: leafy && !spring, spring }
}
