//! The scratch of mechanics, which thickening and bending overwrite at each tick.
//!
//! Each thread has one and uses it for plant after plant, so that its memory is allocated once. Absent: the state that
//! lasts from tick to tick, which is the plant's ([`crate::plant::Strain`]).

use super::loads::{Load, Response};
use crate::plant::borne::Borne;
use crate::plant::standing::Standing;
use crate::pose::bent::Stances;
use crate::vector::Vector;

/// Scratch memory of the bending of one plant after another.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    pub(super) standing: Standing,
    pub(super) laterals: Borne,
    pub(super) organs: Borne,
    pub(super) natural: Vec<[f32; 2]>,
    pub(super) responses: Vec<Response>,
    pub(super) loads: Vec<Load>,
    pub(super) stances: Stances,
    pub(super) turns: Vec<Vector>,
    /// The diameters of the last tick, where reaction wood is made.
    pub(super) before: Vec<f32>,
    pub(super) above: Vec<Above>,
}

/// The sums over the internodes and leaves above a node.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Above {
    pub sum: f64,
    /// How many internodes stand on the node.
    pub branches: u32,
}
