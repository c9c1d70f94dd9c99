//! Pictures of plants, without a graphics processor: the meshes of [`phytomer_meshes`] through a small rasteriser of
//! our own.
//!
//! No kept crate serves: those in pure Rust draw flat shapes, or are studies of one person that fix their own mesh in
//! memory. What happens: plants are put side by side (`placed`), a camera is fitted to them (`camera`, `extent`), sun
//! and sky are let fall on each (`shadow`, `sky`), triangles are covered with samples (`raster`, `film`), samples
//! are shaded and averaged (`shade`, `ground`, `draw`), and what they show is written below (`caption`).
//! The same plants and the same [`Picture`] give the same bytes on any number of threads. Absent: films; textures.

mod camera;
mod canvas;
mod caption;
mod cast;
mod colouring;
mod draw;
mod extent;
mod film;
mod gaze;
mod ground;
mod letters;
mod placed;
mod png;
mod raster;
mod shade;
mod shadow;
mod sky;
#[cfg(test)]
mod tests;
mod tone;
mod value_colours;

pub use self::png::write_png;
pub use ::png::Compression;
pub use canvas::Canvas;
pub use colouring::{Colouring, Scale};

use cast::Cast;
use gaze::Gaze;
use glam::Vec3;
use phytomer_meshes::OwnForms;
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// The most plants of one picture that stand side by side, or plots; in each plot there may be any number of plants.
pub const MOST_SUBJECTS: usize = 64;

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
    /// Which way it looks, turned to the left by an angle, radians.
    fn gaze(self, turn: f32) -> Gaze {
        let degrees = |degrees: f32| degrees * PI / 180.0;
        match self {
            Self::Perspective => Gaze::towards(degrees(110.0) + turn, degrees(7.0)),
            Self::Top => Gaze::down(turn),
            Self::Front => Gaze::towards(FRAC_PI_2 + turn, 0.0),
            Self::Side => Gaze::towards(PI + turn, 0.0),
            Self::Oblique => Gaze::towards(degrees(120.0) + turn, degrees(30.0)),
        }
    }

    /// The sun over the left shoulder of whoever looks, radians.
    fn sun(self, turn: f32) -> [f32; 2] {
        let azimuth: f32 = match self {
            Self::Perspective => 110.0 + 180.0 - 52.0,
            Self::Top => 135.0,
            Self::Front => 270.0 - 48.0,
            Self::Side => 360.0 - 48.0,
            Self::Oblique => 120.0 + 180.0 - 60.0,
        };
        [azimuth * PI / 180.0 + turn, 46.0 * PI / 180.0]
    }
}

/// How plants are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// From where.
    pub view: View,
    /// The angle, radians, by which whoever looks goes on around the plants, counterclockwise from above. If not given,
    /// a flat plant is seen in perspective from where it is wide, any other from the front.
    pub turn: Option<f32>,
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
    /// The meshes of its own that the species names, where the picture is of single plants.
    pub own: Arc<OwnForms>,
    /// What colours the components, its plants those of the picture; their own colours if not given.
    pub colour_by: Option<Colouring>,
}

impl Default for Picture {
    /// In perspective and sunshine, on ground, with its captions, 1600 by 1200 pixels.
    fn default() -> Self {
        Self {
            size: [1600, 1200],
            view: View::Perspective,
            turn: None,
            transparent: false,
            ground: true,
            caption: true,
            sun: None,
            sides: 8,
            own: Arc::default(),
            colour_by: None,
        }
    }
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

/// Plants that stand together, as those of a plot do, to be drawn in their places.
#[derive(Debug, Clone)]
pub struct Stand<'a> {
    /// The plants; any number. One that stands at several places is told several times, as the same plant in memory,
    /// and its mesh is made once.
    pub plants: Vec<Placed<'a>>,
    /// What is written below them.
    pub label: String,
}

/// A plant of a stand.
#[derive(Debug, Clone)]
pub struct Placed<'a> {
    /// The plant, its frames and diameters those of the age.
    pub plant: &'a Plant,
    /// The age.
    pub age: Tick,
    /// Where its seed lies, metres from the origin of the stand.
    pub place: [f32; 3],
    /// The meshes of its own that its species names.
    pub own: Arc<OwnForms>,
}

/// Draws plants side by side, in one scale on one ground, `title` written in the corner.
/// All plants are in memory, but of their triangles only some blocks at a time.
pub fn draw(subjects: &[Subject], title: &str, picture: &Picture) -> Canvas {
    draw_stands(&alone(subjects, picture), title, picture)
}

/// Draws plots side by side, in one scale on one ground, each plant in its place and in the shade of the others of its
/// plot.
pub fn draw_stands(stands: &[Stand], title: &str, picture: &Picture) -> Canvas {
    let mut cast = Cast::of(stands, picture);
    let camera = cast.aim(picture, f32::INFINITY);
    cast.draw(picture, &camera, title)
}

/// Each plant as a stand of its own.
fn alone<'a>(subjects: &[Subject<'a>], picture: &Picture) -> Vec<Stand<'a>> {
    let placed = |subject: &Subject<'a>| {
        let own = Arc::clone(&picture.own);
        Placed { plant: subject.plant, age: subject.age, place: [0.0; 3], own }
    };
    subjects.iter().map(|subject| Stand { plants: vec![placed(subject)], label: subject.label.clone() }).collect()
}

/// Draws the four parallel views of plants on one sheet, in one scale: front and side above, top and oblique below.
pub fn sheet(subjects: &[Subject], title: &str, picture: &Picture) -> Canvas {
    sheet_of_stands(&alone(subjects, picture), title, picture)
}

/// The same of plots.
pub fn sheet_of_stands(stands: &[Stand], title: &str, picture: &Picture) -> Canvas {
    let [width, height] = picture.size;
    let mut cast = Cast::of(stands, picture);
    let mut canvas = Canvas::new(width, height);
    let halves = [[width / 2, height / 2], [width - width / 2, height - height / 2]];
    let views = [View::Front, View::Side, View::Top, View::Oblique];
    let parts = [0, 1, 2, 3].map(|number| {
        let size = [halves[number % 2][0], halves[number / 2][1]];
        Picture { size, view: views[number], ..picture.clone() }
    });
    let scale = parts.each_ref().map(|part| cast.aim(part, f32::INFINITY).scale_at(Vec3::ZERO));
    let scale = scale.into_iter().fold(f32::INFINITY, f32::min);
    for (number, part) in parts.iter().enumerate() {
        let camera = cast.aim(part, scale);
        let drawn = cast.draw(part, &camera, if number == 3 { title } else { "" });
        canvas.put(&drawn, [0, width / 2][number % 2], [0, height / 2][number / 2]);
    }
    canvas
}
