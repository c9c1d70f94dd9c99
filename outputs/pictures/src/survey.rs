//! A survey: what one camera must hold is measured over all pictures of a stand before the first of them is drawn.
//!
//! It takes the stand at each age, with the label that its picture has. Where the viewer walks around the plants, each
//! point counts at every place to which a turn around the axis brings it. The survey of one picture alone gives the
//! camera of that picture. Blocks of a plant that lie within what is held already are not looked at again.

use super::extent::Extent;
use super::framing::{Framing, Side, angles, widest};
use super::{Picture, Stand, View, camera, caption, cast, letters};
use glam::Vec3;

/// What a camera has to hold of a stand over several pictures.
#[derive(Debug, Clone)]
pub struct Survey {
    picture: Picture,
    /// The point around which the viewer walks, if so.
    pivot: Option<Vec3>,
    /// The sides that come into question: the angle, the largest width, and the extent.
    sides: Vec<Side>,
    bounds: Option<[Vec3; 2]>,
    places: Option<[Vec3; 2]>,
    label: f32,
}

impl Survey {
    /// A survey for pictures with these options, whose `colour_by` is left out. With a pivot the viewer walks around
    /// it.
    pub fn new(picture: &Picture, pivot: Option<[f32; 3]>) -> Self {
        let picture = Picture { colour_by: None, ..picture.clone() };
        let frame = cast::frame(&picture, 1, 0.0);
        let tangents = camera::tangents(&frame, picture.size[1] as f32, picture.view == View::Perspective);
        let turns: Vec<f32> = match picture.turn {
            Some(turn) => vec![turn],
            None if picture.view != View::Perspective => vec![0.0],
            None => angles().collect(),
        };
        let side = |turn: f32| (turn, 0.0, Extent::new(picture.view.gaze(turn), tangents));
        let sides = turns.into_iter().map(side).collect();
        Self { picture, pivot: pivot.map(Vec3::from_array), sides, bounds: None, places: None, label: 0.0 }
    }

    /// Adds the stand of one picture.
    pub fn add(&mut self, stand: &Stand) {
        let placed = cast::placed(stand, &self.picture);
        // Below a ground that is seen as a surface nothing is visible.
        let buried = !self.picture.ground || self.sides.iter().all(|(.., extent)| extent.gaze.forward.z == 0.0);
        for (_, width, extent) in &mut self.sides {
            *width = width.max(placed.width(extent.gaze.right));
            *extent = placed.extent_beyond(extent, self.pivot, buried);
        }
        let join = |[low, high]: [Vec3; 2], [a, b]: [Vec3; 2]| [low.min(a), high.max(b)];
        let own = placed.bounds();
        self.bounds = Some(self.bounds.map_or(own, |bounds| join(bounds, own)));
        if let Some(own) = placed.feet() {
            self.places = Some(self.places.map_or(own, |places| join(places, own)));
        }
        self.label = self.label.max(letters::width(&stand.label, caption::letter_size(self.picture.size[1])));
    }

    /// What the camera holds of all stands that were added; `None` if there was none.
    pub fn framing(&self) -> Option<Framing> {
        let [low, high] = self.bounds?;
        let middle = self.places.map_or(Vec3::ZERO, |[low, high]| 0.5 * (low + high));
        let &(turn, _, extent) = self.sides.get(widest(&self.sides))?;
        Some(Framing { turn, extent, pivot: self.pivot, size: (high - low).length(), middle, label: self.label })
    }
}
