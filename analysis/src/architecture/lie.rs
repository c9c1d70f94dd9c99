//! How axes lie under their weight: whether their tips hang, where relays stand on an arch, and whether the base of a
//! trunk was erected.
//!
//! Two models are defined by directions. Champagnat's axes are upright by their trend and hang by their weight alone;
//! Troll's are laid by their trend, and their bases are erected later (Hallé, Oldeman & Tomlinson 1978). Both need the
//! recorded columns of mechanics: without them no bending is recorded.

use super::axes::{Axis, is_plagiotropic};
use super::share::Share;
use super::tolerance::{ERECT, RISEN};
use phytomer_outputs::rows::PoseRow;
use phytomer_sim::plant::Origin;
use std::collections::BTreeMap;

/// How the axes of a plant lie at the recorded ages.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Lie {
    /// Of the relayed axes that still stand and bend: the share whose tip has pointed below the horizontal.
    pub tips_lowered: Share,
    /// Of the relays of axes that bend over: the share below the part that hangs, up to a few nodes past the summit of
    /// the arch.
    pub before_the_fall: Share,
    /// Whether the base of the first axis was laid by its trend and is now erect.
    pub base_erected: bool,
}

/// The vertical parts of the directions of one axis: by age, then by rank.
type Course = BTreeMap<u32, BTreeMap<u32, f32>>;

/// How the axes of one plant lie at the recorded ages. Empty where no pose has a curvature.
pub fn lie_of(axes: &[Axis], poses: &[PoseRow]) -> Lie {
    let mut courses: BTreeMap<u32, Course> = BTreeMap::new();
    for pose in poses.iter().filter(|pose| pose.curvature_per_m.is_some()) {
        courses.entry(pose.axis_id).or_default().entry(pose.age).or_default().insert(pose.rank, pose.dir_z);
    }
    let mut lie = Lie::default();
    for axis in axes.iter().filter(|axis| axis.is_judged()) {
        let Some(course) = courses.get(&axis.id) else { continue };
        let relays = axis.bears.iter().map(|&place| &axes[place]).filter(|relay| relay.origin == Origin::Relay);
        let ranks: Vec<u32> = relays.map(|relay| relay.bearer_rank).collect();
        if !ranks.is_empty() {
            lie.judge(course, &ranks);
        }
        if axis.origin == Origin::Seed {
            lie.base_erected = ranks.first().is_some_and(|rank| base_erected(axis, course, *rank));
        }
    }
    lie
}

impl Lie {
    fn judge(&mut self, course: &Course, relays: &[u32]) {
        let hangs = |ranks: &&BTreeMap<u32, f32>| ranks.last_key_value().is_some_and(|(_, dir_z)| *dir_z < 0.0);
        let hanging = course.values().rev().find(hangs);
        self.tips_lowered.add(hanging.is_some());
        if let Some(ranks) = hanging {
            // The summit is the last internode that does not point down: all after it do.
            let summit = ranks.iter().rev().find(|(_, dir_z)| **dir_z >= 0.0).map_or(0, |(rank, _)| *rank);
            relays.iter().for_each(|relay| self.before_the_fall.add(*relay <= summit + NEAR));
        }
    }
}

/// The number of nodes past the summit of an arch that still count as near it.
const NEAR: u32 = 6;

/// Whether the part of an axis below its relay was laid by its trend, has risen, and stands erect at the last age. The
/// internode that bears the relay is looked at, since the first internode of an axis keeps the direction of the seed.
fn base_erected(axis: &Axis, course: &Course, relay: u32) -> bool {
    let laid = axis.first_trend().is_some_and(is_plagiotropic);
    let mut directions = course.values().filter_map(|ranks| ranks.get(&relay));
    let Some(first) = directions.next() else { return false };
    let last = directions.next_back().unwrap_or(first);
    laid && *last >= ERECT && last - first >= RISEN
}
