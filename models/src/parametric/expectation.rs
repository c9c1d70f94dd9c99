//! The numbers of stems, segments and leaves of a tree in closed form, before it grows (Weber & Penn 1995 §4.2, §4.3,
//! §4.5).
//!
//! They do not depend on what is drawn but for the length of the trunk, whose bare part is then a smaller or greater
//! share of it; pruning and stems under a millimetre make fewer. So a tree is told its size, and an explosion refused,
//! before the first stem is made. Where nSegSplits is no whole number, the means of its clones are estimates. Absent:
//! the stems (`grow`).

use super::dealt::Plan;
use super::equations::{children, leaves, leaves_on, shape_ratio, stems};
use super::numbers::Numbers;
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};
use std::collections::BTreeMap;

/// The families of a level by the number of their children, and the leaves on all of them.
struct Level {
    families: f64,
    by_children: BTreeMap<u32, f64>,
    leaves: f64,
}

/// More than any plant has: numbers above this are told as this.
const MOST: f64 = 1e30;
/// Where a level has more families than this, no plant has room for them, and later levels are not counted.
const MOST_FAMILIES: f64 = 1e12;

/// The expected numbers by order and age.
pub(super) fn of(tree: &Numbers, until: Tick) -> Expectation {
    let levels = levels(tree);
    let generations = tree.ages.generations(until);
    let orders = levels.iter().enumerate().map(|(level, of)| {
        let mut order = OrderExpectation::zero(until);
        let [axes, segments] = of_a_family(tree, level as u8);
        if level == 0 {
            order.axes[0] = 1.0;
        }
        let seeds = if level == 0 { 1.0 } else { 0.0 };
        if let Some(birth) = tree.ages.births.get(level).filter(|birth| **birth <= until) {
            let birth = *birth as usize;
            order.axes[birth] = (of.families * axes - seeds).min(MOST);
            order.nodes[birth] = (of.families * segments).min(MOST);
            order.units[birth] = order.nodes[birth];
        }
        generations.iter().for_each(|(birth, _)| order.organs[*birth as usize] += of.leaves);
        order.accumulate();
        order
    });
    Expectation { orders: orders.collect(), axes: certainty(tree), organs: certainty(tree) }
}

fn certainty(tree: &Numbers) -> Certainty {
    let used = 0..tree.levels;
    if used.clone().any(|level| tree.of(level).seg_splits.fract() != 0.0) {
        return Certainty::About;
    }
    // Shapes 5 and 8 come down to 0; a variation as great as a length does too.
    let vanish = used.skip(1).any(|level| tree.of(level).length_v >= tree.of(level).length);
    let fewer = tree.prune_ratio > 0.0 || matches!(tree.shape, 5 | 8) || vanish;
    if fewer || tree.level[0].length_v > 0.0 { Certainty::AtMost } else { Certainty::Exact }
}

/// The axes and the segments of a stem with its clones.
fn of_a_family(tree: &Numbers, level: u8) -> [f64; 2] {
    let of = tree.of(level);
    let (more, last) = (1.0 + of.seg_splits, of.curve_res);
    let at_base = if level == 0 && tree.base_splits > 0 { 1.0 + f64::from(tree.base_splits) } else { more };
    let (mut stems, mut segments) = (1.0, 0.0);
    for nth in 1..=last {
        segments += stems;
        if nth < last {
            stems *= if nth == 1 { at_base } else { more };
        }
    }
    [f64::min(stems, MOST), f64::min(segments, MOST)]
}

/// The families of each level.
fn levels(tree: &Numbers) -> Vec<Level> {
    let mut levels = vec![trunk(tree)];
    for level in 1..tree.levels {
        let before = &levels[usize::from(level) - 1];
        if before.families > MOST_FAMILIES {
            break;
        }
        let mut next = Level { families: 0.0, by_children: BTreeMap::new(), leaves: 0.0 };
        for (number, parents) in &before.by_children {
            let plan = plan_of(tree, level - 1, *number);
            for share in (0..*number).filter_map(|nth| plan.place(nth)).map(|place| place.share) {
                next.add(tree, level, share, plan.bare, *parents);
            }
        }
        levels.push(next);
    }
    levels
}

/// The trunk. The longest that can be drawn has the least bare part.
fn trunk(tree: &Numbers) -> Level {
    let mut trunk = Level { families: 1.0, by_children: BTreeMap::new(), leaves: 0.0 };
    if tree.levels == 1 {
        let most = leaves(leaves_on(0, tree.leaves.abs(), 0.0, tree.quality));
        let plan = Plan { fan: tree.leaves < 0.0, ..plan_of(tree, 0, most) };
        trunk.leaves = (0..most).filter_map(|nth| plan.place(nth)).count() as f64;
    } else {
        trunk.by_children.insert(stems(children(0, tree.of(1).branches.abs(), 1.0, 1.0, 0.0)), 1.0);
    }
    trunk
}

fn plan_of(tree: &Numbers, level: u8, number: u32) -> Plan {
    let longest = tree.level[0].length + tree.level[0].length_v;
    let bare = if level == 0 { tree.base_size / longest } else { 0.0 };
    let fan = tree.of(level + 1).branches < 0.0;
    Plan { number, fan, bare, above: tree.above_base, curve_res: tree.of(level).curve_res }
}

impl Level {
    /// Adds as many families at a place of their parents as there are parents.
    fn add(&mut self, tree: &Numbers, level: u8, share: f64, bare: f64, parents: f64) {
        self.families += parents;
        if level + 1 == tree.levels {
            let number = leaves(leaves_on(level, tree.leaves.abs(), share, tree.quality));
            self.leaves += parents * f64::from(number);
            return;
        }
        // Of a branch of the trunk the length over the greatest length is the ratio of the crown's shape.
        let length = shape_ratio(tree.shape, (1.0 - share) / (1.0 - bare), &tree.envelope);
        let number = stems(children(level, tree.of(level + 1).branches.abs(), length, 1.0, share));
        *self.by_children.entry(number).or_insert(0.0) += parents;
    }
}
