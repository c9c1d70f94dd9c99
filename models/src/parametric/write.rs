//! A parametric tree in the columns of a plant: a stem is an axis, a segment an internode that states how it is turned
//! in the frame of the one before, a clone a fork of its twin's order, a leaf an organ that states its frame.
//!
//! A child states how far behind the tip of its bearing internode it begins. Lengths and radii are scaled to the age of
//! the tree; leaves keep their size. Absent: where all of this comes from (`grow`, `leaves`).

use super::generation::Family;
use super::numbers::Numbers;
use super::path::Path;
use super::radius::{flare, radius_at};
use super::sections::Sections;
use phytomer_looks::Paints;
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::math;
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::{AxisId, Cause, EventKind, Kind, NewAxis, NewNode, NewOrgan, NodeId, Origin, Plant, Rest};
use phytomer_sim::rotation::Rotation;
use std::f64::consts::PI;

/// Where and how a stem leaves its parent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaving {
    pub bearer: NodeId,
    /// How far behind the tip of the bearing segment, metres.
    pub behind: f64,
    /// How the first segment is turned in the frame of the bearing segment.
    pub turn: Rotation,
    /// Around the parent, and away from it, degrees.
    pub rotate: f64,
    pub down: f64,
    /// The number among the children of the parent.
    pub position: u16,
}

/// A leaf at its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct LeafInPlace {
    pub node: NodeId,
    /// Its number among the leaves of its internode.
    pub position: u16,
    /// How far behind the tip of the internode it begins, metres.
    pub behind: f64,
    /// How it is turned in the frame of the internode.
    pub turn: Rotation,
    /// The azimuth around the stem from its upper side, and the angle away from it, radians.
    pub around: f64,
    pub insertion: f64,
}

/// Writes the tree of one age into a plant.
pub(super) struct Writer<'a> {
    tree: &'a Numbers,
    sections: &'a Sections,
    plant: &'a mut Plant,
    /// The size of stems over their full size.
    scale: f64,
}

impl<'a> Writer<'a> {
    pub fn new(tree: &'a Numbers, sections: &'a Sections, plant: &'a mut Plant, age: Tick) -> Self {
        Self { tree, sections, plant, scale: tree.ages.scale_at(age) }
    }

    /// How many components the plant may still have.
    pub fn room(&self) -> u64 {
        u64::from(self.plant.component_limit().saturating_sub(self.plant.components()))
    }

    pub fn has_room_for(&self, more: u64) -> Result<(), Overgrown> {
        if more > self.room() { Err(Overgrown::of(self.plant)) } else { Ok(()) }
    }

    /// Adds a stem with its clones; `written` gets the axis and the first internode of each.
    pub fn family(
        &mut self,
        family: &Family,
        path: &Path,
        leaving: Option<Leaving>,
        written: &mut Vec<(AxisId, NodeId)>,
    ) -> Result<(), Overgrown> {
        let axes = path.members.len() - usize::from(leaving.is_none());
        self.has_room_for((path.segments.len() + axes) as u64)?;
        let res = self.tree.of(family.level).curve_res;
        for (place, member) in path.members.iter().enumerate() {
            let twin = path.members[member.twin as usize].before;
            let bearer = match place {
                0 => leaving.map(|leaving| leaving.bearer),
                _ => Some(NodeId(written[member.twin as usize].1.0 + member.before - twin - 1)),
            };
            let axis = bearer.map_or(AxisId::TRUNK, |bearer| self.axis(family, path, place, bearer, leaving));
            let before = match place {
                0 => None,
                _ => path.segments_of(member.twin as usize, res).get((member.before - twin - 1) as usize),
            };
            let segments = path.segments_of(place, res);
            let turns = segments.iter().scan(before.map(|segment| segment.frame), |last, segment| {
                let first = || leaving.map_or(segment.frame, |leaving| leaving.turn);
                let turn = last.map_or_else(first, |last: Rotation| last.inverse().then(segment.frame));
                *last = Some(segment.frame);
                Some(turn)
            });
            let node = self.nodes(family, axis, bearer, member.before, turns);
            if let (0, Some(leaving)) = (place, leaving) {
                self.plant.state_start(node, [(-leaving.behind * self.scale) as f32, 0.0, 0.0]);
            }
            written.push((axis, node));
        }
        Ok(())
    }

    /// Adds the axis of a stem, or of a clone.
    fn axis(&mut self, family: &Family, path: &Path, place: usize, bearer: NodeId, leaving: Option<Leaving>) -> AxisId {
        let (member, birth) = (&path.members[place], self.tree.ages.births[usize::from(family.level)]);
        let is_clone = place > 0;
        let (around, insertion, position) = match leaving {
            Some(leaving) if !is_clone => (leaving.rotate, leaving.down, leaving.position),
            _ => (member.spread, member.split, member.position),
        };
        let axis = self.plant.add_axis(NewAxis {
            bearer: Some(bearer),
            key: member.key,
            order: family.level + 1,
            origin: if is_clone { Origin::Fork } else { Origin::Axillary },
            position,
            follows: is_clone && position > 0,
            appearance: birth,
            birth,
            azimuth: azimuth(around) as f32,
            insertion: insertion.abs().to_radians() as f32,
            ..NewAxis::OF_THE_SEED
        });
        self.plant.note(birth, axis, if is_clone { EventKind::Forked } else { EventKind::Branched }, 1);
        axis
    }

    /// Adds the internodes of a stem; returns the first.
    fn nodes(
        &mut self,
        family: &Family,
        axis: AxisId,
        bearer: Option<NodeId>,
        before: u32,
        turns: impl Iterator<Item = Rotation>,
    ) -> NodeId {
        let birth = self.tree.ages.births[usize::from(family.level)];
        let (res, first) = (self.tree.of(family.level).curve_res, NodeId(self.plant.nodes.len() as u32));
        let mut below = bearer.unwrap_or(NodeId::NONE);
        let mut rank = 0;
        for turn in turns {
            let radius = radius_of(self.tree, family, f64::from(before + rank) / f64::from(res));
            rank += 1;
            below = self.plant.add_node(NewNode {
                parent: below,
                axis,
                birth,
                rank,
                unit_rank: 1,
                short: false,
                neoformed: false,
                trend: 0,
                length: (family.length * self.scale / f64::from(res)) as f32,
                diameter: (2.0 * radius * self.scale) as f32,
                azimuth: 0.0,
            });
            self.plant.state_rest(below, Rest::Turned(turn));
            let section = self.sections.at(family.level, family.radius / family.length, before + rank - 1);
            if let Some(section) = section {
                let tip = radius_of(self.tree, family, f64::from(before + rank) / f64::from(res));
                let solid = Paints::of(&self.plant.habit).sections().get(usize::from(section));
                let bulk = solid.map_or(1.0, |solid| solid.bulk([radius, tip], family.length / f64::from(res)));
                self.plant.give_section(below, section);
                self.plant.state_bulk(below, bulk as f32);
            }
        }
        self.plant.note(birth, axis, EventKind::Grew, rank);
        first
    }

    /// Adds a leaf that appears and falls at the given ticks.
    pub fn leaf(&mut self, leaf: &LeafInPlace, size: [f64; 2], area: f64, (birth, fall): (Tick, Tick)) {
        let organ = self.plant.add_organ(NewOrgan {
            node: leaf.node,
            kind: Kind::Leaf,
            position: leaf.position,
            birth,
            death: fall,
            cause: if fall == NEVER { Cause::None } else { Cause::Season },
            form: self.tree.leaf_form.form(),
            length: size[0] as f32,
            width: size[1] as f32,
            area: area as f32,
            azimuth: leaf.around.rem_euclid(2.0 * PI) as f32,
            insertion: leaf.insertion as f32,
        });
        self.plant.state_organ(organ, leaf.turn, [(-leaf.behind * self.scale) as f32, 0.0, 0.0]);
    }
}

/// The radius of a stem at the share `z` of its length, metres, with the flare of the trunk and without its lobes.
pub(super) fn radius_of(tree: &Numbers, family: &Family, z: f64) -> f64 {
    let tapered = radius_at(z, tree.of(family.level).taper, family.radius, family.length);
    if family.level == 0 { tapered * flare(tree.flare, z) } else { tapered }
}

/// The azimuth in [0, 2π) of a stem that is turned about its parent by `rotate` degrees. The stem leans away from its
/// y-axis, and azimuths count from the direction of the parent's y-axis.
fn azimuth(rotate: f64) -> f64 {
    let around = math::fmod(rotate + 180.0, 360.0);
    (if around < 0.0 { around + 360.0 } else { around }) * (PI / 180.0)
}
