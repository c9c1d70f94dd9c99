//! The stems of one level of a tree, with their clones, in the order of creation (Weber & Penn 1995 §4.3): lengths,
//! radii, and where each segment is.
//!
//! A family is a stem with its clones, which share its length, its radius and its children. Absent: the path of a
//! family (`path`), the places of children on it (`dealt`), and the plant's columns (`write`).

use super::path::{ALONG, Path, Segment};
use phytomer_sim::plant::{AxisId, LineageKey, NodeId};
use std::ops::Range;

/// A stem with its clones.
#[derive(Debug, Clone)]
pub(super) struct Family {
    pub level: u8,
    pub key: LineageKey,
    /// The length of a stem from its base to its tip, metres.
    pub length: f64,
    /// The radius at the base, metres, of the trunk without its flare.
    pub radius: f64,
    /// The base in the frame of the ground, metres.
    pub base: [f64; 3],
    /// offset_child over length_parent; 0 for the trunk.
    pub share: f64,
    /// The length over that of the parent, and the greatest that was possible (length_child,max).
    pub ratio: [f64; 2],
    /// Its stems among those of the generation.
    pub members: Range<usize>,
}

/// A stem of a family.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stem {
    /// The stem from which it was cloned, among those of the family; of the first its own place.
    pub twin: u32,
    /// How many segments come before its own.
    pub before: u32,
    /// Its first segment among those of the generation.
    pub from: u32,
    /// Its first internode.
    pub first: NodeId,
}

/// The stems of a level.
#[derive(Debug, Default)]
pub(super) struct Generation {
    pub families: Vec<Family>,
    pub stems: Vec<Stem>,
    pub segments: Vec<Segment>,
}

impl Generation {
    pub fn clear(&mut self) {
        self.families.clear();
        self.stems.clear();
        self.segments.clear();
    }

    /// Adds a family whose path is known and which has been written into the plant: `written` has the axis and the
    /// first internode of each stem.
    pub fn add(&mut self, family: Family, path: &Path, curve_res: u32, written: &[(AxisId, NodeId)]) {
        let first = self.stems.len();
        for ((place, member), (_, node)) in path.members.iter().enumerate().zip(written) {
            let from = self.segments.len() as u32;
            self.segments.extend_from_slice(path.segments_of(place, curve_res));
            self.stems.push(Stem { twin: member.twin, before: member.before, from, first: *node });
        }
        self.families.push(Family { members: first..self.stems.len(), ..family });
    }

    /// Where a place on a stem is: the segment, and the point at a share of the segment's length from its base.
    pub fn point(&self, family: &Family, stem: &Stem, segment: u32, share: f64, curve_res: u32) -> (Segment, [f64; 3]) {
        let of = self.segments[(stem.from + segment - stem.before) as usize];
        let (long, heading) = (family.length / f64::from(curve_res), of.frame.turned(ALONG));
        (of, [0, 1, 2].map(|k| family.base[k] + (of.start[k] + share * heading[k]) * long))
    }
}
