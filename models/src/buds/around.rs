//! What is around a bud that grows, and how its next internode lies in it.
//!
//! [`Around`] follows the tip of an axis through one tick, from the pose in which it stood at the end of the last one.
//! Absent: what the bud does about it (`contact`), and the surfaces (`phytomer_sim::site::solids`).

use super::compile::ContactLaws;
use super::params::Answer;
use phytomer_sim::plant::{AxisId, Plant};
use phytomer_sim::pose::Ahead;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::site::Site;
use phytomer_sim::site::solids::{CLEARANCE, Solids};
use phytomer_sim::site::way::{Hold, Step};

/// What is around a bud that grows.
pub(super) struct Around<'a> {
    pub solids: &'a Solids,
    laws: ContactLaws,
    /// The place of the plant in the plot, metres.
    place: [f64; 3],
    pub ahead: Ahead,
    /// The distance that is known to be free about the tip, metres.
    pub free: f64,
    /// The direction out of the surface that the bud feels at this step.
    felt: Option<[f64; 3]>,
    /// Whether there was no way for a node of this step.
    pub stuck: bool,
}

/// How the next internode lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lie {
    /// As its species lets it grow.
    Free,
    /// Turned in the frame of the node before.
    Turned(Rotation),
}

impl<'a> Around<'a> {
    /// What is around the bud of an axis, as it stood at the end of the last tick; `None` where nothing can be met.
    pub fn of(site: &'a Site, laws: ContactLaws, plant: &Plant, axis: AxisId) -> Option<Self> {
        let solids = site.solids();
        if solids.is_empty() {
            return None;
        }
        let ahead = Ahead::of_bud(plant, axis);
        Some(Self { solids, laws, place: plant.place, ahead, free: 0.0, felt: None, stuck: false })
    }

    /// The tip in the plot.
    pub fn tip(&self) -> [f64; 3] {
        let base = self.ahead.base();
        [0, 1, 2].map(|k| self.place[k] + base[k])
    }

    /// The direction out of the surface that is nearest to the tip; upward where none is within `reach`.
    pub fn outward(&self, reach: f64) -> [f64; 3] {
        let near = self.solids.nearest(self.tip(), reach + CLEARANCE);
        near.map_or([0.0, 0.0, 1.0], |near| self.solids.outward(near.surface, self.tip()))
    }

    /// Whether no surface is within `reach` of the tip. What is far away is asked for again when the shoot has grown
    /// through the distance that was free.
    pub fn is_far(&mut self, reach: f64) -> bool {
        if self.free > reach {
            return true;
        }
        let looked = 2.0 * reach + 0.5;
        self.free = self.solids.nearest(self.tip(), looked).map_or(looked, |near| near.distance);
        self.free > reach
    }

    /// Feels what is ahead of the bud; whether it meets something.
    pub fn feel(&mut self) -> bool {
        (self.felt, self.stuck) = (None, false);
        let held = if self.laws.answer == Answer::Fasten { self.laws.hold } else { 0.0 };
        if self.is_far(self.laws.cone.length.max(held)) {
            return false;
        }
        let (tip, [heading, _]) = (self.tip(), self.ahead.directions());
        if let Some((surface, at)) = self.solids.met(tip, heading, self.laws.cone) {
            self.felt = Some(self.solids.outward(surface, at));
        }
        self.felt.is_some() || self.hold(tip).is_some()
    }

    /// What a climber holds to at the tip.
    fn hold(&self, tip: [f64; 3]) -> Option<Hold> {
        if self.laws.answer != Answer::Fasten {
            return None;
        }
        // A little less than the reach, so that a tip whose place was rounded still counts as one that holds.
        let near = self.solids.nearest_that_holds(tip, self.laws.hold + 0.01 * CLEARANCE)?;
        Some(Hold { surface: near.surface, cling: self.laws.cling, reach: self.laws.hold })
    }

    /// Tries the next internode, of this length; `None` where there is no way for it.
    pub fn try_next(&mut self, length: f64, left: bool) -> Option<Lie> {
        let held = if self.laws.answer == Answer::Fasten { self.laws.hold } else { 0.0 };
        if self.is_far(length + held.max(CLEARANCE)) {
            self.free -= length;
            self.ahead.grow(length);
            return Some(Lie::Free);
        }
        self.free = 0.0;
        let (from, [wanted, up]) = (self.tip(), self.ahead.directions());
        let turned = self.felt.filter(|_| matches!(self.laws.answer, Answer::Deflect | Answer::Fasten));
        let heading = turned.and_then(|outward| along_surface(wanted, outward)).unwrap_or(wanted);
        let step = Step { from, heading, up, length, hold: self.hold(from), left };
        let found = match self.laws.answer {
            Answer::Deflect | Answer::Fasten => self.solids.way(&step),
            Answer::Pause | Answer::Die => self.solids.is_free(&step, heading).then_some(heading),
        };
        let Some(found) = found else {
            self.stuck = true;
            return None;
        };
        let found =
            upright(found).filter(|upright| found != wanted && self.solids.is_free(&step, *upright)).unwrap_or(found);
        let lie = if found == wanted { Lie::Free } else { Lie::Turned(self.ahead.turn(found)) };
        self.ahead.grow(length);
        Some(lie)
    }
}

/// The vertical next to a heading that is all but vertical. The plane in which such an axis turns on follows from its
/// level part, of which rounding leaves nothing; that of a vertical axis follows from its upper side.
fn upright([x, y, z]: [f64; 3]) -> Option<[f64; 3]> {
    const LEVEL: f64 = 1e-3;
    let level = x * x + y * y;
    (level > 0.0 && level < LEVEL * LEVEL).then(|| [0.0, 0.0, z.signum()])
}

/// A heading without its part into a surface, a unit vector; `None` where it leads out of it, or straight in.
fn along_surface(heading: [f64; 3], outward: [f64; 3]) -> Option<[f64; 3]> {
    let into = (0..3).map(|k| heading[k] * outward[k]).sum::<f64>();
    let across = [0, 1, 2].map(|k| heading[k] - into * outward[k]);
    let length = across.iter().map(|x| x * x).sum::<f64>().sqrt();
    (into < 0.0 && length > 1e-3).then(|| across.map(|x| x / length))
}
