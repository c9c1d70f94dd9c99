//! The forms that organs state of themselves: the outline of a polygon, or a curved surface, in metres and in the frame
//! of the organ; and what the view file names.
//!
//! The area of a surface, and of a polygon that is not plane, is that of the triangles that it is drawn with. Absent:
//! where forms stand (`draft`), and what an organ without a form of its own is drawn as (`columns`).

use crate::lsystem::turtle::{Frame, Vector};
use phytomer_looks::{Paints, polygon};
use phytomer_sim::plant::{OrganId, Plant};
use std::ops::Range;

/// The longest length, metres: a text may state any number.
const FARTHEST: f64 = 1e12;

/// What an organ is drawn as.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form {
    /// What its kind is drawn as.
    OfKind,
    /// The polygon of these among the corners.
    Outline(Range<usize>),
    /// The curved surface with this place among those of the view file, with factors along H, L and U.
    Surface(usize, [f64; 3]),
}

impl Form {
    /// Whether anything is stated that can be drawn.
    pub fn is_drawn(&self) -> bool {
        match self {
            Self::OfKind => false,
            Self::Outline(corners) => !corners.is_empty(),
            Self::Surface(..) => true,
        }
    }
}

/// What the view file names, each at its place among what the habit has for drawing.
#[derive(Debug, Clone, Default)]
pub(super) struct ViewForms {
    /// The symbols of the curved surfaces.
    pub surfaces: Vec<char>,
    /// The numbers of the contours.
    pub contours: Vec<i32>,
}

impl ViewForms {
    /// The place of the section of a contour; `None` for a circle.
    pub fn section(&self, contour: i32) -> Option<u16> {
        let place = if contour == 0 { None } else { self.contours.iter().position(|known| *known == contour) };
        place.map(|place| place as u16)
    }
}

/// The form of an organ, ready to be stated.
pub(super) enum Stated {
    /// None: that of its kind.
    OfKind,
    /// Corners, metres.
    Outline(Vec<[f32; 3]>),
    /// The place of the surface, its factors, its area and its extents along the organ and to its sides, metres.
    Surface(u32, [f32; 3], f32, [f32; 2]),
}

impl Stated {
    /// The form of an organ with a frame, for a step of so many metres and a plant whose habit has the surfaces; the
    /// corners are those of all outlines, in the coordinates of the turtle.
    pub fn of(form: &Form, frame: &Frame, corners: &[Vector], step: f64, plant: &Plant) -> Self {
        match form {
            Form::OfKind => Self::OfKind,
            Form::Outline(range) => {
                let beside = |corner: &Vector| [0, 1, 2].map(|i| corner[i] - frame.position[i]);
                let corner = |corner| frame.coordinates(beside(corner)).map(|along| metres(along * step));
                let corners: Vec<[f32; 3]> = corners[range.clone()].iter().map(corner).collect();
                if corners.len() < 3 { Self::OfKind } else { Self::Outline(corners) }
            }
            Form::Surface(place, scale) => {
                let Some(surface) = Paints::of(&plant.habit).surface(*place) else { return Self::OfKind };
                let factors = scale.map(|factor| metres(factor * step));
                let extents = [0, 1].map(|axis| metres(f64::from(factors[axis].abs() * surface.extent(axis))));
                let area = surface.area(factors.map(f64::from)).min(FARTHEST * FARTHEST);
                Self::Surface(*place as u32, factors, area as f32, extents)
            }
        }
    }

    /// How far it reaches along the organ and to its sides; `None` for the form of a kind.
    pub fn extents(&self) -> Option<[f32; 2]> {
        match self {
            Self::OfKind => None,
            Self::Outline(corners) => Some([extent(corners, 0), extent(corners, 1)]),
            Self::Surface(.., extents) => Some(*extents),
        }
    }

    /// States it of an organ; false where there is nothing to state.
    pub fn state(&self, plant: &mut Plant, organ: OrganId) -> bool {
        match self {
            Self::OfKind => return false,
            Self::Outline(corners) => {
                plant.state_outline(organ, corners);
                if !polygon::is_plane(corners) {
                    plant.organs.area[organ.index()] = polygon::area(corners) as f32;
                }
            }
            Self::Surface(place, factors, area, _) => plant.state_surface(organ, *place, *factors, *area),
        }
        true
    }
}

/// The extent of an outline along an axis of its frame.
fn extent(corners: &[[f32; 3]], axis: usize) -> f32 {
    let along = corners.iter().map(|corner| corner[axis]);
    let (least, most) = along.fold((0.0_f32, 0.0_f32), |(least, most), x| (least.min(x), most.max(x)));
    most - least
}

/// A length in single precision; none is so long that its cube is no number there.
pub(super) fn metres(length: f64) -> f32 {
    length.clamp(-FARTHEST, FARTHEST) as f32
}
