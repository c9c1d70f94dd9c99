//! Pictures of plants, without a graphics processor: the meshes of [`crate::meshes`] through a small rasteriser of our own.
//!
//! No kept crate serves: those in pure Rust draw flat shapes, or are studies of one person that fix their own mesh in
//! memory. What happens: plants are put side by side ([`stand`]), a camera is fitted to them ([`camera`], [`extent`]), sun
//! and sky are let fall on each ([`shadow`], [`sky`]), triangles are covered with samples ([`raster`], [`film`]), samples
//! are shaded and averaged ([`shade`], [`ground`], [`draw`]), and what they show is written below ([`caption`]).
//! The same plants and the same [`Picture`] give the same bytes on any number of threads. Absent: films; textures.

mod camera;
mod canvas;
mod caption;
mod draw;
mod extent;
mod film;
mod ground;
mod letters;
mod png;
mod raster;
mod shade;
mod shadow;
mod sky;
mod stand;
mod tone;

pub use self::png::write_png;
pub use ::png::Compression;
pub use canvas::Canvas;

use crate::meshes::{MeshOptions, OwnForms};
use camera::{Camera, Frame, Gaze, tangents};
use caption::{Align, letter_size, scale_bar, write};
use draw::Set;
use extent::Extent;
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use stand::Standing;
use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// The most plants of one picture.
pub const MOST_SUBJECTS: usize = 100;

/// From where plants are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// By an eye a little above the ground, in perspective.
    Perspective,
    /// From above, the Y axis (north) up the picture.
    Top,
    /// From the front, towards the Y axis.
    Front,
    /// From the right of the front, against the X axis.
    Side,
    /// From the front, the right and above, in parallel projection.
    Oblique,
}

impl View {
    fn gaze(self) -> Gaze {
        let degrees = |degrees: f32| degrees * PI / 180.0;
        match self {
            Self::Perspective => Gaze::towards(degrees(110.0), degrees(7.0)),
            Self::Top => Gaze::down(),
            Self::Front => Gaze::towards(FRAC_PI_2, 0.0),
            Self::Side => Gaze::towards(PI, 0.0),
            Self::Oblique => Gaze::towards(degrees(120.0), degrees(30.0)),
        }
    }

    /// The sun over the left shoulder of whoever looks, radians.
    fn sun(self) -> [f32; 2] {
        let azimuth: f32 = match self {
            Self::Perspective => 110.0 + 180.0 - 52.0,
            Self::Top => 135.0,
            Self::Front => 270.0 - 48.0,
            Self::Side => 360.0 - 48.0,
            Self::Oblique => 120.0 + 180.0 - 60.0,
        };
        [azimuth * PI / 180.0, 46.0 * PI / 180.0]
    }
}

/// How plants are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// From where.
    pub view: View,
    /// Whether the background is left out.
    pub transparent: bool,
    /// Whether ground and shadow are drawn.
    pub ground: bool,
    /// Whether the scale bar and what is written are drawn.
    pub caption: bool,
    /// Azimuth from the X axis to the Y axis, and elevation of the sun, radians; over the left shoulder if not given.
    pub sun: Option<[f32; 2]>,
    /// Sides of the tube that an internode is drawn as.
    pub sides: u8,
    /// The meshes of its own that the species names.
    pub own: Arc<OwnForms>,
}

/// A plant at an age, to be drawn.
#[derive(Debug, Clone)]
pub struct Subject<'a> {
    /// The plant, its frames and diameters those of the age.
    pub plant: &'a Plant,
    /// The age.
    pub age: Tick,
    /// What is written below it.
    pub label: String,
}

/// Draws plants side by side, in one scale on one ground, `title` written in the corner.
pub fn draw(subjects: &[Subject], title: &str, picture: &Picture) -> Canvas {
    let options = MeshOptions { sides: picture.sides, own: Arc::clone(&picture.own), ..MeshOptions::default() };
    let some = subjects.iter().take(MOST_SUBJECTS).zip(0_u8..);
    let mut plants: Vec<Standing> =
        some.map(|(subject, number)| Standing::new(subject.plant, subject.age, &options, None, number)).collect();
    let camera = aim(&mut plants, picture);
    let sun = picture.sun.unwrap_or_else(|| picture.view.sun());
    let lights: Vec<_> = plants.iter().map(|plant| plant.light(sun)).collect();
    let set =
        Set { plants: &plants, lights: &lights, camera, ground: picture.ground, transparent: picture.transparent };
    let mut canvas = draw::draw(&set, picture.size);
    if picture.caption {
        write_below(&mut canvas, &plants, subjects, title, &camera);
    }
    canvas
}

/// Draws the four parallel views of plants on one sheet: front and side above, top and oblique below.
pub fn sheet(subjects: &[Subject], title: &str, picture: &Picture) -> Canvas {
    let [width, height] = picture.size;
    let mut canvas = Canvas::new(width, height);
    let halves = [[width / 2, height / 2], [width - width / 2, height - height / 2]];
    for (number, view) in [View::Front, View::Side, View::Top, View::Oblique].into_iter().enumerate() {
        let (column, row) = (number % 2, number / 2);
        let part = Picture { size: [halves[column][0], halves[row][1]], view, ..picture.clone() };
        let words = if number == 3 { title } else { "" };
        canvas.put(&draw(subjects, words, &part), [0, width / 2][column], [0, height / 2][row]);
    }
    canvas
}

/// Puts the plants side by side, the first at the left, and finds the camera that sees them all.
fn aim(plants: &mut [Standing], picture: &Picture) -> Camera {
    let gaze = picture.view.gaze();
    let height = picture.size[1] as f32;
    let frame = frame(picture);
    let tangents = tangents(&frame, height, picture.view == View::Perspective);
    let extents: Vec<Extent> = plants.iter().map(|plant| plant.extent(gaze, tangents)).collect();
    let widest = extents.iter().map(|extent| extent.across[1] - extent.across[0]).fold(0.0, f32::max);
    let mut all = Extent::new(gaze, tangents);
    let mut edge = 0.0;
    for (number, (plant, extent)) in plants.iter_mut().zip(&extents).enumerate() {
        let home = -plant.foot();
        let own = extent.moved(home);
        let along = if number == 0 { 0.0 } else { edge + 0.08 * widest - own.across[0] };
        edge = along + own.across[1];
        plant.offset = home + gaze.right * along;
        all = all.join(&own.moved(gaze.right * along));
    }
    Camera::fitting(&all, &frame, height)
}

/// The part of a picture that plants fill.
fn frame(picture: &Picture) -> Frame {
    let [width, height] = picture.size.map(|side| side as f32);
    let margin = 0.045 * width.min(height);
    let below = if picture.caption { 4.6 * letter_size(picture.size[1]) } else { margin };
    Frame { left: margin, top: margin, right: width - margin, bottom: height - margin.max(below) }
}

fn write_below(canvas: &mut Canvas, plants: &[Standing], subjects: &[Subject], title: &str, camera: &Camera) {
    let size = letter_size(canvas.height);
    let (width, height) = (canvas.width as f32, canvas.height as f32);
    let line = height - 1.4 * size;
    let scale = plants.first().map_or(1.0, |plant| camera.scale_at(plant.foot()));
    scale_bar(canvas, scale, 0.16 * width, size, [1.6 * size, line]);
    write(canvas, title, size, [width - 1.6 * size, line], Align::Right);
    for (plant, subject) in plants.iter().zip(subjects) {
        let x = camera.project(plant.foot()).map_or(0.0, |foot| foot.x);
        let line = if subjects.len() == 1 { line } else { line - 2.0 * size };
        write(canvas, &subject.label, size, [x, line], Align::Middle);
    }
}
