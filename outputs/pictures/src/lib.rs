//! Pictures of plants, without a graphics processor: the meshes of [`phytomer_meshes`], drawn by a small rasteriser.
//!
//! The rasteriser is the project's own: crates in pure Rust draw flat shapes only, or keep whole meshes in a memory
//! layout of their own. Plants are put side by side (`placed`), a camera is fitted to them (`camera`, `extent`), the
//! light of sun and sky on each is computed (`shadow`, `sky`), triangles are turned into samples (`raster`, `film`),
//! samples are shaded and averaged (`shade`, `ground`, `draw`), and the caption is written (`caption`). Equal plants
//! and an equal [`Picture`] give equal bytes on any number of threads. Pictures of a film share a camera (`framing`).
//! Absent: textures.

mod body;
mod camera;
mod canvas;
mod caption;
pub mod cards;
mod cast;
mod colouring;
mod costs;
mod develop;
mod draw;
mod extent;
mod film;
mod focus;
mod framing;
mod free;
mod gaze;
mod ground;
mod letters;
pub mod levels;
mod placed;
mod png;
mod raster;
mod search;
mod shade;
mod shadow;
mod sides;
pub mod silhouette;
mod sky;
mod spans;
mod survey;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_framing;
mod tone;
mod value_colours;

pub use self::png::write_png;
pub use canvas::Canvas;
pub use colouring::{Colouring, Colours, Scale, colours};
pub use focus::{Focus, Wanted};
pub use framing::Framing;
pub use phytomer_png::Compression;
pub use sides::{Apart, Outline, Sides};
pub use survey::Survey;

use cast::Cast;
use gaze::Gaze;
use glam::Vec3;
use phytomer_meshes::{Mesh, OwnForms, Seen};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// The most plants, or plots, that stand side by side in one picture. The number of plants in each plot is not limited.
pub const MOST_SUBJECTS: usize = 64;

/// The direction from which plants are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// From an eye a little above the ground, in perspective.
    Perspective,
    /// From above, the Y axis (north) up the picture.
    Top,
    /// From the front, towards the Y axis.
    Front,
    /// From the right, against the X axis.
    Side,
    /// From the front, the right and above, in parallel projection.
    Oblique,
}

impl View {
    /// The gaze of the view, turned to the left by an angle, radians.
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

    /// Azimuth and elevation of a sun over the left shoulder of the viewer, radians.
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

/// Options for a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The direction of view.
    pub view: View,
    /// The angle, radians, by which the viewer moves around the plants, counterclockwise from above. If not given, a
    /// flat plant is seen in perspective from its wide side, any other plant from the front.
    pub turn: Option<f32>,
    /// Whether the background is transparent.
    pub transparent: bool,
    /// Whether ground and shadow are drawn.
    pub ground: bool,
    /// Whether scale bar and text are drawn.
    pub caption: bool,
    /// Azimuth of the sun, from the X axis to the Y axis, and its elevation, radians. Over the left shoulder of the
    /// viewer if not given.
    pub sun: Option<[f32; 2]>,
    /// The number of sides of the tube that each internode is drawn as. If not given, wood is drawn in tubes along its
    /// axes, within half a pixel, unless values colour it.
    pub sides: Option<u8>,
    /// The mesh files that the species names as forms, for pictures of single plants.
    pub own: Arc<OwnForms>,
    /// How finely organs are drawn, from 0 to 3; an organ that is small on the film has less.
    pub detail: u8,
    /// The organ that fills the picture; the whole of the plants if not given.
    pub focus: Option<Arc<Focus>>,
    /// Values that colour the components of the picture's plants; natural colours if not given.
    pub colour_by: Option<Colouring>,
}

impl Default for Picture {
    /// Perspective, sunshine, ground and caption, 1600 by 1200 pixels.
    fn default() -> Self {
        Self {
            size: [1600, 1200],
            view: View::Perspective,
            turn: None,
            transparent: false,
            ground: true,
            caption: true,
            sun: None,
            sides: None,
            own: Arc::default(),
            detail: 0,
            focus: None,
            colour_by: None,
        }
    }
}

/// A plant at an age, to be drawn.
#[derive(Debug, Clone)]
pub struct Subject<'a> {
    /// The plant, with the frames and diameters of the age.
    pub plant: &'a Plant,
    /// Its age.
    pub age: Tick,
    /// The text below it.
    pub label: String,
}

/// Plants that stand together, such as those of a plot, to be drawn in their places.
#[derive(Debug, Clone)]
pub struct Stand<'a> {
    /// The plants; any number. A plant that stands at several places is in the list once per place, as the same
    /// reference, and its mesh is made once.
    pub plants: Vec<Placed<'a>>,
    /// Closed meshes of what stands among them, metres from the origin of the stand: the obstacles of a plot.
    pub obstacles: Vec<Arc<Mesh>>,
    /// The text below them.
    pub label: String,
}

/// A plant of a stand.
#[derive(Debug, Clone)]
pub struct Placed<'a> {
    /// The plant, with the frames and diameters of the age.
    pub plant: &'a Plant,
    /// Its age.
    pub age: Tick,
    /// The place of its seed, metres from the origin of the stand.
    pub place: [f32; 3],
    /// The mesh files that its species names as forms.
    pub own: Arc<OwnForms>,
    /// What of it is drawn, where it is a tree of stems.
    pub seen: Seen,
}

/// Draws plants side by side, in one scale on one ground, with `title` in the corner. All plants are in memory, but
/// their triangles are made in blocks and dropped. The triangles are made several times: for the box, the light, the
/// depths and the colours. Subjects after the first [`MOST_SUBJECTS`] are left out.
pub fn draw(subjects: &[Subject], title: &str, picture: &Picture) -> Canvas {
    draw_stands(&alone(subjects, picture), title, picture)
}

/// Draws stands side by side, in one scale on one ground, each plant in its place and in the shade of its stand. See
/// [`draw()`] for memory and the largest number of stands.
pub fn draw_stands(stands: &[Stand], title: &str, picture: &Picture) -> Canvas {
    let mut cast = Cast::of(stands, picture);
    let camera = cast.aim(picture, f32::INFINITY);
    cast.draw(picture, &camera, title)
}

/// Draws a stand by a camera that holds what several pictures of it need. The `turn` of the picture, if given, is where
/// the viewer has gone; a sun that is not given stays over the left shoulder of the viewer of the first picture.
pub fn draw_framed(stand: &Stand, title: &str, picture: &Picture, framing: &Framing) -> Canvas {
    let mut cast = Cast::of(std::slice::from_ref(stand), picture);
    let camera = cast.hold(picture, framing);
    cast.draw(picture, &camera, title)
}

/// A stand for each plant.
fn alone<'a>(subjects: &[Subject<'a>], picture: &Picture) -> Vec<Stand<'a>> {
    let placed = |subject: &Subject<'a>| {
        let own = Arc::clone(&picture.own);
        Placed { plant: subject.plant, age: subject.age, place: [0.0; 3], own, seen: Seen::default() }
    };
    let alone = |subject: &Subject<'a>| Stand {
        plants: vec![placed(subject)],
        obstacles: Vec::new(),
        label: subject.label.clone(),
    };
    subjects.iter().map(alone).collect()
}

/// Draws the four parallel views of plants on one sheet, in one scale: front and side above, top and oblique below.
pub fn sheet(subjects: &[Subject], title: &str, picture: &Picture) -> Canvas {
    sheet_of_stands(&alone(subjects, picture), title, picture)
}

/// Draws the four parallel views of stands on one sheet, in one scale, as [`sheet`] does for plants.
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
