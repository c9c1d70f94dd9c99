//! How a component stands in the frame of its bearer, and on the way from one such place to another.
//!
//! Between two places the offset goes linearly and the rotation by the shortest way at an even speed (slerp, Shoemake
//! 1985). Absent: what bears what.

use super::frames::Frame;
use crate::rotation::Rotation;
use crate::vector::Vector;

/// A rotation and an offset in the coordinates of the bearer's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed {
    pub turn: Rotation,
    pub offset: Vector,
}

/// The rotation of a frame in the coordinates of the plant.
fn turn_of(frame: &Frame) -> Rotation {
    Rotation::to(frame.heading.map(f64::from), frame.up.map(f64::from))
}

impl Placed {
    /// How `frame` stands in the frame `bearer`.
    pub fn of(frame: &Frame, bearer: &Frame) -> Self {
        let back = turn_of(bearer).inverse();
        let apart = Vector::from(frame.base) - Vector::from(bearer.base);
        Self { turn: back.then(turn_of(frame)), offset: back.of(apart) }
    }

    /// The frame that stands so on `bearer`.
    pub fn on(&self, bearer: &Frame) -> Frame {
        let borne = turn_of(bearer);
        let turn = borne.then(self.turn).normalized();
        let base = Vector::from(bearer.base) + borne.of(self.offset);
        let [heading, up] = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.0, 1.0)].map(|axis| turn.of(axis).single());
        Frame { base: base.single(), heading, up }
    }

    /// The place a share of the way to another.
    pub fn toward(&self, other: &Self, share: f64) -> Self {
        let offset = self.offset + (other.offset - self.offset) * share;
        Self { turn: self.turn.toward(other.turn, share), offset }
    }
}

/// The frame a share of the way to another, both in the coordinates of the plant.
pub(crate) fn toward(from: &Frame, to: &Frame, share: f64) -> Frame {
    let ground = Frame::GROUND;
    Placed::of(from, &ground).toward(&Placed::of(to, &ground), share).on(&ground)
}
