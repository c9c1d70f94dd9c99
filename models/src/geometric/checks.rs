//! What must hold of a planned tree before it grows: children that do not coincide, branches that are not too small,
//! and growth levels for which a plant has room (Aono & Kunii 1984: h1² + h2² ≠ 0).
//!
//! Each is checked over all values that can be drawn. Absent: the range of each number by itself (`laws`).

use super::descriptor::{MOST_LEVELS, TreeType};
use super::laws::{DIAMETER, R0, R1, R2, STATED};
use super::plan::{Plan, PlannedLevel, SMALLEST_M};
use crate::fault::{Fault, Path};
use crate::law::VariateTable;
use phytomer_sim::plant::MOST_COMPONENTS;

/// Adds a fault for the first growth level of each rule at which both lateral branching angles can be 0: the children
/// would coincide. `paths` are those of the rules.
pub(super) fn angles(plan: &Plan, paths: &[Path], faults: &mut Vec<Fault>) {
    let mut told = vec![false; plan.rules.len()];
    for (number, level) in (1..).zip(&plan.levels) {
        if told[level.rule] || ![0, 1].iter().all(|&side| can_be_straight(plan, level, side)) {
            continue;
        }
        told[level.rule] = true;
        let is_random = [0, 1].iter().any(|&side| plan.angle_law(level, side).is_some_and(VariateTable::is_random));
        let how = if is_random { "can both be 0" } else { "are both 0" };
        let (key, problem) = match level.of {
            TreeType::Gmt4 => ("h2_deg", format!("the angles of growth level {number} {how}")),
            _ => ("h2_deg", format!("h1_deg and h2_deg {how}")),
        };
        let key = if level.has_own_course[1] { "h2_min_deg" } else { key };
        let expected = "h1² + h2² ≠ 0: at least one branching angle that is not 0";
        faults.push(Fault::new(&paths[level.rule].key(key), problem, expected));
    }
}

/// Whether an angle of a level can be 0; not where it is missing, which is a fault of its own.
fn can_be_straight(plan: &Plan, level: &PlannedLevel, side: usize) -> bool {
    let of_category = level.course_deg[side];
    let without_law = level.has_own_course[side] && of_category == 0.0;
    plan.angle_law(level, side).map_or(without_law, |law| law.can_be(0.0 - of_category))
}

/// Adds a fault where branches of the last level can be too small: their length by the smaller ratio of lengths,
/// their diameter by the ratio of diameters, each with the smallest values that can be drawn. Where tips are moved, a
/// short branch is nothing, and no fault.
pub(super) fn sizes(plan: &Plan, path: &Path, faults: &mut Vec<Fault>) {
    let own = &plan.rules[0];
    let lengths: &[usize] = if own.of == TreeType::Gmt3 { &[R1, R2, R0] } else { &[R1, R2] };
    let smaller = |a: usize, b: usize| if own.extent(b)[0] < own.extent(a)[0] { b } else { a };
    let length = lengths.iter().copied().reduce(smaller).unwrap_or(R1);
    let [first_length, first_diameter] = &plan.first;
    let mut check = |place: usize, first: &VariateTable, ratio: &dyn Fn(&PlannedLevel) -> f64, word: &str| {
        let size = plan.levels.iter().fold(first.extent()[0], |size, level| size * ratio(level));
        if size < SMALLEST_M {
            let is_random = first.is_random() || own.tables[place].as_ref().is_some_and(VariateTable::is_random);
            let (how, bounded) = if is_random { ("can be", "; `min` bounds what is drawn") } else { ("is", "") };
            let problem = format!("after {} levels a branch {how} {size:.1e} m {word}", plan.last());
            let expected = format!("branches of at least {SMALLEST_M:e} m{bounded}");
            faults.push(Fault::new(&path.key(STATED[place].0), problem, expected));
        }
    };
    if plan.levels.iter().all(|level| level.deviators.is_none()) {
        check(length, first_length, &|level| plan.least_ratio(level), "long");
    }
    check(DIAMETER, first_diameter, &|level| plan.least_diameter_ratio(level), "thick");
}

/// The fault of a tree of `levels` growth levels, which its file states at `path`, where a plant has no room for it.
/// `most` is the number of levels that it has room for, and `branches` the number of branches of so many levels.
pub(super) fn explosion(of: TreeType, is_plain: bool, levels: u32, most: u32, path: &Path) -> Option<Fault> {
    if levels <= most {
        return None;
    }
    let next = u64::from(levels) + 1;
    let problem = match (of.children(), is_plain) {
        (2, true) => format!("levels is {levels}: a tree of 2^{next} branches"),
        (3, true) => format!("levels is {levels}: a tree of (3^{next} − 1)/2 branches"),
        _ => format!("levels is {levels}: a tree of more branches than a plant can have"),
    };
    Some(Fault::new(path, problem, format!("at most {most} growth levels")))
}

/// The growth levels of a plan that a plant has room for.
pub(super) fn levels_with_room(plan: &Plan) -> u32 {
    let mut sum: u64 = 1;
    for (level, added) in (0..).zip(plan.added()) {
        let leaves = plan.leaves_at(level);
        let more = |n: &u64| n.saturating_mul(1 + leaves);
        let all = added.branches.iter().map(more).chain(added.axes.iter().copied());
        sum = all.fold(sum, u64::saturating_add);
        if sum > u64::from(MOST_COMPONENTS) {
            return level.max(1) - 1;
        }
    }
    MOST_LEVELS
}
