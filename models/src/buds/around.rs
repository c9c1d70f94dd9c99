//! What is around a bud that grows, and how its next internode lies in it.
//!
//! [`Around`] follows the tip of an axis through one tick, from the pose in which it stood at the end of the last one.
//! As long as nothing is near it knows the place alone from which the tip has grown on; its frame is found when it is
//! asked. Absent: what the bud does about it (`contact`), the surfaces (`phytomer_sim::site::solids`) and the stems of
//! plants (`phytomer_sim::site::stems`).

use super::compile::ContactLaws;
use super::params::Answer;
use super::start::Start;
use phytomer_sim::plant::{AxisId, NodeId, Plant};
use phytomer_sim::pose::Ahead;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::site::Site;
use phytomer_sim::site::solids::{CLEARANCE, Solids, Surface};
use phytomer_sim::site::stems::{Beside, Spared, Stems};
use phytomer_sim::site::way::{Hold, Step};

/// What is around a bud that grows.
pub(super) struct Around<'a> {
    pub solids: &'a Solids,
    /// The stems of the plot, where shoots meet any.
    stems: Option<&'a Stems>,
    /// Those near the bud.
    beside: Beside,
    spared: Spared,
    laws: ContactLaws,
    /// The place of the plant in the plot, metres.
    place: [f64; 3],
    /// The last node that is posed, and its tip, in the plot.
    posed: (Option<NodeId>, [f64; 3]),
    /// The end of the axis from which the next node grows, where it is known.
    ahead: Option<Ahead>,
    /// The distance that is known to be free of surfaces about the tip, metres.
    free: f64,
    /// The length that the axis has grown in this tick while its end was not known, metres.
    grown: f64,
    /// How far about the bud stems are asked beyond what one internode asks, metres.
    further: f64,
    /// How many of the next internodes are known to touch no stem.
    past: u32,
    /// The direction out of the surface that the bud feels at this step.
    felt: Option<[f64; 3]>,
    /// Whether there was no way for a node of this step.
    pub stuck: bool,
}

/// An internode that is to grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Next {
    /// Its length, metres.
    pub length: f64,
    /// Its radius, metres.
    pub radius: f64,
    /// The trend that it names.
    pub trend: u8,
    /// The side to which it turns where both are equal.
    pub left: bool,
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
    /// Whether there is anything on a site that a shoot meets.
    pub fn meets(site: &Site) -> bool {
        !site.solids().is_empty() || site.stems.as_deref().is_some_and(|stems| !stems.is_empty())
    }

    /// Whether buds feel what is at a distance from them before they grow, ahead or beside them.
    pub fn feels(laws: &ContactLaws) -> bool {
        laws.cone.length > 0.0 || laws.answer == Answer::Fasten
    }

    /// What is around the bud of an axis which stood at `start` at the end of the last tick.
    pub fn of(site: &'a Site, laws: ContactLaws, plant: &Plant, axis: AxisId, start: Start) -> Self {
        let solids = site.solids();
        let stems = site.stems.as_deref().filter(|stems| !stems.is_empty());
        let (place, posed, grown) = (plant.place, (start.node, start.tip), start.grown);
        let spared = Spared { plant: plant.id, axis: axis.0 };
        let (beside, ahead, free, further) = (Beside::default(), None, 0.0, start.further);
        let past = if solids.is_empty() { start.past } else { 0 };
        let (felt, stuck) = (None, false);
        let mut around =
            Self { solids, stems, beside, spared, laws, place, posed, ahead, free, grown, further, past, felt, stuck };
        around.free = if solids.is_empty() { f64::INFINITY } else { around.free_about(posed.1, 0.0) - grown };
        around
    }

    /// The distance that is free of surfaces about a place, at least `reach` or as far as was looked.
    fn free_about(&self, place: [f64; 3], reach: f64) -> f64 {
        let looked = 2.0 * reach + 0.5;
        self.solids.nearest(place, looked).map_or(looked, |near| near.distance)
    }

    /// The end of the axis, found where it was not known.
    pub fn end(&mut self, plant: &Plant) -> &mut Ahead {
        let axis = AxisId(self.spared.axis);
        self.ahead.get_or_insert_with(|| Ahead::of_growing(plant, axis, self.posed.0))
    }

    /// The tip in the plot, where the end of the axis is known; else where it was at the start of the tick.
    pub fn tip(&self) -> [f64; 3] {
        self.ahead.map_or(self.posed.1, |ahead| {
            let base = ahead.base();
            [0, 1, 2].map(|k| self.place[k] + base[k])
        })
    }

    /// The direction out of the surface that is nearest to the tip; upward where none is within `reach`.
    pub fn outward(&self, reach: f64) -> [f64; 3] {
        let near = self.solids.nearest(self.tip(), reach + CLEARANCE);
        near.map_or([0.0, 0.0, 1.0], |near| self.solids.outward(near.surface, self.tip()))
    }

    /// Whether no surface is within `reach` of the tip. What is far away is asked for again when the shoot has grown
    /// through the distance that was free.
    pub fn is_far(&mut self, plant: &Plant, reach: f64) -> bool {
        if self.free > reach {
            return true;
        }
        self.end(plant);
        self.free = self.free_about(self.tip(), reach);
        self.free > reach
    }

    /// Whether no stem is within `reach` of the tip; those that are, and some that are not, are known then. What the
    /// bud has felt turns its next internode wherever some stem is known.
    fn is_far_from_stems(&mut self, plant: &Plant, reach: f64) -> bool {
        let Some(stems) = self.stems else { return true };
        // A long growth unit is followed to its tip: the ball about its start would hold most of the plant. Buds that
        // feel or look around keep to the ball, since what they know depends on it.
        let alone = self.laws.cone.length == 0.0 && self.laws.answer != Answer::Fasten;
        if alone && self.ahead.is_none() && self.grown > reach {
            self.end(plant);
        }
        let (tip, more) = (self.tip(), if self.ahead.is_none() { self.grown } else { 0.0 });
        let reach = reach + more;
        // A climber looks for what it holds to wherever some stem is known. Rounding is far less than the clearance.
        let looks = self.felt.is_some() || self.laws.answer == Answer::Fasten;
        match looks {
            true => !self.beside.look(stems, tip, reach, self.spared),
            false => !self.beside.glance(stems, tip, [reach, CLEARANCE, self.further], self.spared),
        }
    }

    /// Whether the next internode is known to lie as it wants, without its way: there is nothing but stems, the bud has
    /// felt none and holds to none, and the internode comes too near to none.
    fn passes_all_stems(&self, [from, wanted]: [[f64; 3]; 2], next: &Next) -> bool {
        let alone = self.solids.is_empty() && self.felt.is_none() && self.laws.answer != Answer::Fasten;
        let end = [0, 1, 2].map(|k| from[k] + wanted[k] * next.length);
        alone && self.beside.touched([from, end], CLEARANCE + next.radius, next.left).is_none()
    }

    /// The distance at which a climber holds; 0 of other plants.
    fn held(&self) -> f64 {
        if self.laws.answer == Answer::Fasten { self.laws.hold } else { 0.0 }
    }

    /// Feels what is ahead of the bud; whether it meets something.
    pub fn feel(&mut self, plant: &Plant) -> bool {
        (self.felt, self.stuck) = (None, false);
        let reach = self.laws.cone.length.max(self.held());
        let (far, far_from_stems) = (self.is_far(plant, reach), reach == 0.0 || self.is_far_from_stems(plant, reach));
        if far && far_from_stems {
            return false;
        }
        let [heading, _] = self.end(plant).directions();
        let tip = self.tip();
        let surface = if far { None } else { self.solids.met(tip, heading, self.laws.cone) };
        self.felt = match surface {
            Some((surface, at)) => Some(self.solids.outward(surface, at)),
            None if far_from_stems => None,
            None => self.beside.met(tip, heading, self.laws.cone),
        };
        self.felt.is_some() || self.hold(tip, 0.0).is_some()
    }

    /// What a climber of this radius holds to at the tip: the surface or the wood that is nearest.
    fn hold(&self, tip: [f64; 3], radius: f64) -> Option<Hold> {
        if self.laws.answer != Answer::Fasten {
            return None;
        }
        // A little more than the reach, so that a tip whose place was rounded still counts as one that holds.
        let reach = self.laws.hold + 0.01 * CLEARANCE;
        let solid = self.solids.nearest_that_holds(tip, reach).map(|near| (near.distance, near.surface));
        let wood = (self.spared, self.laws.support);
        let (distance, surface) = match self.beside.support(tip, self.spared, self.laws.support) {
            Some((distance, _)) if solid.is_none_or(|(nearest, _)| distance < nearest) => (distance, Surface::Wood),
            _ => solid?,
        };
        let cling = self.laws.cling.max(radius + CLEARANCE);
        (distance < reach).then_some(Hold { surface, cling, reach: self.laws.hold.max(cling), wood })
    }

    /// Tries the next internode, which is to turn towards the trend that it names; `None` where there is no way for it.
    pub fn try_next(&mut self, plant: &Plant, next: Next) -> Option<Lie> {
        let Next { length, radius, trend, left } = next;
        let axis = AxisId(self.spared.axis);
        if self.past > 0 {
            self.past -= 1;
            let ahead = self.end(plant);
            ahead.tend(plant, axis, trend);
            ahead.grow(length);
            return Some(Lie::Free);
        }
        let reach = length + radius + self.held().max(CLEARANCE);
        let (far, far_from_stems) = (self.is_far(plant, reach), self.is_far_from_stems(plant, reach));
        self.free -= length;
        if far && far_from_stems {
            match &mut self.ahead {
                Some(ahead) => {
                    ahead.tend(plant, axis, trend);
                    ahead.grow(length);
                }
                None => self.grown += length,
            }
            return Some(Lie::Free);
        }
        let ahead = self.end(plant);
        let stood = *ahead;
        ahead.tend(plant, axis, trend);
        let [wanted, up] = ahead.directions();
        let from = self.tip();
        if self.passes_all_stems([from, wanted], &next) {
            self.end(plant).grow(length);
            return Some(Lie::Free);
        }
        let turned = self.felt.filter(|_| matches!(self.laws.answer, Answer::Deflect | Answer::Fasten));
        let heading = turned.and_then(|outward| along_surface(wanted, outward)).unwrap_or(wanted);
        let step = Step { from, heading, up, length, radius, hold: self.hold(from, radius), left, stems: &self.beside };
        let found = match self.laws.answer {
            Answer::Deflect | Answer::Fasten => self.solids.way(&step),
            Answer::Pause | Answer::Die => self.solids.is_free(&step, heading).then_some(heading),
        };
        let Some(found) = found else {
            (self.stuck, self.ahead) = (true, Some(stood));
            return None;
        };
        let found =
            upright(found).filter(|upright| found != wanted && self.solids.is_free(&step, *upright)).unwrap_or(found);
        let ahead = self.end(plant);
        let lie = if found == wanted { Lie::Free } else { Lie::Turned(ahead.turn(found)) };
        ahead.grow(length);
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
