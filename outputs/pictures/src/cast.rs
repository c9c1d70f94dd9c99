//! The plants, or plots, of one picture: put side by side, framed by a camera, drawn, and labelled.
//!
//! The first plant stands at the left, its foot at the origin of the picture; the others follow to the right of the
//! gaze, as far apart as their crowns need. The plants of a plot are put as one, each in its place. Absent: pixels
//! (`draw`).

use super::body::Body;
use super::camera::{Camera, Frame, tangents};
use super::canvas::Canvas;
use super::caption::{Align, fitting, letter_size, lone_label, scale_bar, write, write_row};
use super::colouring::{self, Legend, colours};
use super::develop::Set;
use super::draw;
use super::extent::Extent;
use super::focus::Focus;
use super::framing::{Framing, wide_side};
use super::placed::PlacedStand;
use super::{MOST_SUBJECTS, Picture, Placed, Stand, View, letters};
use glam::Vec3;
use phytomer_meshes::MeshOptions;
use phytomer_sim::Tick;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The plants of a picture, with their labels.
pub struct Cast<'a> {
    stands: Vec<PlacedStand<'a>>,
    labels: Vec<&'a str>,
    legend: Option<Legend>,
    /// The angle, radians, by which the viewer has moved around them.
    turn: f32,
    /// What the camera holds, where that is known before.
    held: Option<Framing>,
}

impl<'a> Cast<'a> {
    /// The plants of a picture, not yet put in their places.
    pub fn of(stands: &'a [Stand], picture: &Picture) -> Self {
        let stands = &stands[..stands.len().min(MOST_SUBJECTS)];
        let (colours, legend) = picture.colour_by.as_ref().map(colours).unzip();
        let mut colours = colours.map(Vec::into_iter);
        let mut coloured =
            |count: usize| -> Vec<_> { (0..count).map(|_| colours.as_mut().and_then(Iterator::next)).collect() };
        let placed = stands.iter().zip(0_u8..).map(|(stand, number)| {
            PlacedStand::new(bodies(stand, picture, coloured(stand.plants.len())), &stand.obstacles, number)
        });
        let labels = stands.iter().map(|stand| stand.label.as_str()).collect();
        Self { stands: placed.collect(), labels, legend: legend.flatten(), turn: 0.0, held: None }
    }

    /// Puts the plants side by side, the first at the left, and returns the camera that sees all of them, at no more
    /// than `most` pixels per metre.
    pub fn aim(&mut self, picture: &Picture, most: f32) -> Camera {
        if let Some(focus) = &picture.focus {
            return self.aim_at(focus, picture);
        }
        self.turn = picture.turn.unwrap_or_else(|| self.wide(picture.view));
        let gaze = picture.view.gaze(self.turn);
        let height = picture.size[1] as f32;
        let frame = self.frame(picture);
        let tangents = tangents(&frame, height, picture.view == View::Perspective);
        // Below a ground that is seen as a surface nothing is visible.
        let buried = !picture.ground || gaze.forward.z == 0.0;
        let extents: Vec<Extent> = self.stands.iter().map(|stand| stand.extent(gaze, tangents, buried)).collect();
        let widest = extents.iter().map(|extent| extent.across[1] - extent.across[0]).fold(0.0, f32::max);
        let mut all = Extent::new(gaze, tangents);
        let mut edge = 0.0;
        for (number, (stand, extent)) in self.stands.iter_mut().zip(&extents).enumerate() {
            let along = if number == 0 { 0.0 } else { edge + 0.08 * widest - extent.across[0] };
            edge = along + extent.across[1];
            stand.offset = gaze.right * along;
            all = all.join(&extent.moved(stand.offset));
        }
        Camera::fitting(&all, &frame, height, most)
    }

    /// The camera that an organ of the first plant fills.
    fn aim_at(&mut self, focus: &Focus, picture: &Picture) -> Camera {
        self.turn = picture.turn.unwrap_or_default();
        let (frame, height) = (self.frame(picture), picture.size[1] as f32);
        let mut extent = Extent::new(focus.gaze(self.turn), tangents(&frame, height, true));
        focus.points().for_each(|point| extent.add(point));
        Camera::fitting(&extent, &frame, height, f32::INFINITY)
    }

    /// Leaves the first stand, which is to be the only one, in its place, and returns the camera that holds what is to
    /// be held. The viewer goes around from the place of the framing to the `turn` of the picture.
    pub fn hold(&mut self, picture: &Picture, framing: &Framing) -> Camera {
        self.held = Some(*framing);
        self.turn = framing.turn;
        let gaze = picture.view.gaze(picture.turn.unwrap_or(framing.turn));
        let extent = Extent { gaze, ..framing.extent }.moved(framing.pivot.unwrap_or_default());
        Camera::fitting(&extent, &self.frame(picture), picture.size[1] as f32, f32::INFINITY)
    }

    /// Draws the plants as a camera sees them, with their labels.
    pub fn draw(&self, picture: &Picture, camera: &Camera, title: &str) -> Canvas {
        let from = || picture.focus.as_ref().map_or_else(|| picture.view.sun(self.turn), |focus| focus.sun(self.turn));
        let sun = picture.sun.unwrap_or_else(from);
        let seen = picture.focus.as_ref().map(|focus| focus.bounds());
        let full = is_full(picture);
        let near: Vec<PlacedStand> = self.stands.iter().filter(|_| !full).map(|stand| stand.near(camera)).collect();
        let stands = if full { &self.stands } else { &near };
        let lights: Vec<_> = stands.iter().map(|stand| stand.light(sun, seen)).collect();
        let Picture { ground, transparent, .. } = *picture;
        let around = self
            .stands
            .iter()
            .map(|stand| self.held.map_or_else(|| draw::ground_of(stand), |held| (held.middle, held.size)));
        let around: Vec<_> = around.collect();
        let set = Set { stands, lights: &lights, camera: *camera, ground, transparent, around: &around };
        let mut canvas = draw::draw(&set, picture.size);
        if picture.caption {
            let focus = picture.focus.as_ref().map(|focus| focus.middle());
            self.write_below(&mut canvas, title, camera, focus);
        }
        canvas
    }

    /// The angle around the first plant, radians, from which it is seen wide; 0 for a plant that is not flat.
    fn wide(&self, view: View) -> f32 {
        let stand = self.stands.first().filter(|_| view == View::Perspective);
        stand.map_or(0.0, |stand| wide_side(stand, view))
    }

    /// The part of a picture that is free for plants.
    fn frame(&self, picture: &Picture) -> Frame {
        frame(picture, self.stands.len(), self.legend_width(letter_size(picture.size[1])))
    }

    fn legend_width(&self, size: f32) -> f32 {
        if self.legend.is_some() { (colouring::WIDTH + 1.0) * size } else { 0.0 }
    }

    /// Writes the scale bar, which holds in the middle of an organ in focus or else of the first stand, and the words.
    fn write_below(&self, canvas: &mut Canvas, title: &str, camera: &Camera, focus: Option<Vec3>) {
        let size = letter_size(canvas.height);
        let (width, height) = (canvas.width as f32, canvas.height as f32);
        let line = height - 1.4 * size;
        let middle = |stand: &PlacedStand| self.held.map_or(stand.offset + stand.middle(), |held| held.middle);
        let held = focus.or_else(|| self.stands.first().map(middle));
        let scale = held.map_or(1.0, |point| camera.scale_at(point));
        scale_bar(canvas, scale, 0.16 * width, size, [1.6 * size, line]);
        let (title, edge) = (fitting(title, size, 0.78 * width), width - 1.6 * size);
        write(canvas, &title, size, [edge, line], Align::Right);
        let foot = |stand: &PlacedStand| camera.project(middle(stand)).map_or(0.0, |foot| foot.x);
        let feet = self.stands.iter().map(foot);
        let labels: Vec<(f32, &str)> = feet.zip(self.labels.iter().copied()).collect();
        if let [(x, label)] = labels[..] {
            // A label among others keeps its beginning, which is that of the widest in the middle.
            let half = 0.5 * self.held.map_or_else(|| letters::width(label, size), |held| held.label);
            let x = x.max(half + size).min(width - half - size);
            let free = [2.6 * size + 0.16 * width, edge - letters::width(&title, size) - size];
            let [x, line] = lone_label(x, half, free, (line, size));
            write(canvas, label, size, [x - half, line], Align::Left);
        } else {
            write_row(canvas, &labels, size, line - 2.9 * size);
        }
        self.legend.iter().for_each(|legend| legend.draw(canvas, size));
    }
}

/// Whether plants are drawn with all internodes and organs, however small: a colour that stands for a value is that of
/// each internode by itself.
fn is_full(picture: &Picture) -> bool {
    picture.sides.is_some() || picture.colour_by.is_some()
}

/// The part of a picture of so many stands that is free for plants, beside a legend of this width.
pub fn frame(picture: &Picture, stands: usize, legend: f32) -> Frame {
    let [width, height] = picture.size.map(|side| side as f32);
    let margin = 0.045 * width.min(height);
    let size = letter_size(picture.size[1]);
    let lines = if stands > 1 { 7.6 } else { 4.6 };
    let (below, aside) = if picture.caption { (lines * size, legend) } else { (0.0, 0.0) };
    Frame { left: margin, top: margin, right: width - margin.max(aside), bottom: height - margin.max(below) }
}

/// A stand in its natural colours, as the first of a picture.
pub fn placed<'a>(stand: &'a Stand, picture: &Picture) -> PlacedStand<'a> {
    PlacedStand::new(bodies(stand, picture, vec![None; stand.plants.len()]), &stand.obstacles, 0)
}

/// The plants of a stand, each once with all places where it stands. Two plants are the same if they are one reference
/// at one age.
fn bodies<'a>(stand: &'a Stand, picture: &Picture, colours: Vec<Option<Vec<[u8; 3]>>>) -> Vec<Body<'a>> {
    let key = |placed: &Placed| (std::ptr::from_ref(placed.plant).addr(), placed.age);
    let mut places: BTreeMap<(usize, Tick), Vec<Vec3>> = BTreeMap::new();
    for placed in &stand.plants {
        places.entry(key(placed)).or_default().push(Vec3::from_array(placed.place));
    }
    let mut bodies = Vec::new();
    for (placed, colours) in stand.plants.iter().zip(colours) {
        let Some(places) = places.remove(&key(placed)) else { continue };
        let mut options = MeshOptions { own: Arc::clone(&placed.own), seen: placed.seen, ..MeshOptions::default() };
        options.sides = picture.sides.unwrap_or(options.sides);
        // The camera is placed by the few polygons of detail 0: which detail an organ has follows from it.
        options.detail = if is_full(picture) { picture.detail } else { 0 };
        let body = Body::new((placed.plant, placed.age), (&options, picture.detail), colours, places);
        // The organ in focus is one of the first plant.
        let left_out = picture.focus.as_ref().filter(|_| bodies.is_empty()).map(|focus| focus.left_out());
        bodies.push(body.without(left_out.unwrap_or_default()));
    }
    bodies
}
