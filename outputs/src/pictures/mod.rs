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
mod colouring;
mod draw;
mod extent;
mod film;
mod ground;
mod letters;
mod palette;
mod png;
mod raster;
mod shade;
mod shadow;
mod sky;
mod stand;
#[cfg(test)]
mod tests;
mod tone;

pub use self::png::write_png;
pub use ::png::Compression;
pub use canvas::Canvas;
pub use colouring::colour_columns;

use crate::Error;
use crate::meshes::MeshOptions;
use camera::{Camera, Frame, Gaze, tangents};
use caption::{Align, letter_size, scale_bar, write, write_row};
use colouring::{Legend, colours};
use draw::Set;
use extent::Extent;
use glam::Vec3;
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use stand::Standing;
use std::f32::consts::{FRAC_PI_2, PI};

/// The most plants of one picture.
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
    /// The column of `records` whose values colour the components; their own colours if not given.
    pub colour_by: Option<String>,
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
///
/// # Errors
/// Where the plants cannot be coloured by the column that is asked for.
pub fn draw(subjects: &[Subject], title: &str, picture: &Picture) -> Result<Canvas, Error> {
    let mut cast = Cast::of(subjects, picture)?;
    let camera = cast.aim(picture, f32::INFINITY);
    Ok(cast.draw(picture, &camera, title))
}

/// Draws the four parallel views of plants on one sheet, in one scale: front and side above, top and oblique below.
///
/// # Errors
/// As [`draw`].
pub fn sheet(subjects: &[Subject], title: &str, picture: &Picture) -> Result<Canvas, Error> {
    let [width, height] = picture.size;
    let mut cast = Cast::of(subjects, picture)?;
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
    Ok(canvas)
}

/// The plants of a picture with what is written of them.
struct Cast<'a> {
    plants: Vec<Standing<'a>>,
    labels: Vec<&'a str>,
    legend: Option<Legend>,
}

impl<'a> Cast<'a> {
    fn of(subjects: &'a [Subject], picture: &Picture) -> Result<Self, Error> {
        let options = MeshOptions { sides: picture.sides, ..MeshOptions::default() };
        let subjects = &subjects[..subjects.len().min(MOST_SUBJECTS)];
        let coloured = picture.colour_by.as_ref().map(|column| colours(column, subjects)).transpose()?;
        let (colours, legend) = coloured.unzip();
        let mut colours = colours.map(Vec::into_iter);
        let plants = subjects.iter().zip(0_u8..).map(|(subject, number)| {
            let colours = colours.as_mut().and_then(Iterator::next);
            Standing::new(subject.plant, subject.age, &options, colours, number)
        });
        let labels = subjects.iter().map(|subject| subject.label.as_str()).collect();
        Ok(Self { plants: plants.collect(), labels, legend })
    }

    /// Puts the plants side by side, the first at the left, and finds the camera that sees them all, at no more than
    /// `most` pixels a metre.
    fn aim(&mut self, picture: &Picture, most: f32) -> Camera {
        let gaze = picture.view.gaze();
        let height = picture.size[1] as f32;
        let frame = self.frame(picture);
        let tangents = tangents(&frame, height, picture.view == View::Perspective);
        let extents: Vec<Extent> = self.plants.iter().map(|plant| plant.extent(gaze, tangents)).collect();
        let widest = extents.iter().map(|extent| extent.across[1] - extent.across[0]).fold(0.0, f32::max);
        let mut all = Extent::new(gaze, tangents);
        let mut edge = 0.0;
        for (number, (plant, extent)) in self.plants.iter_mut().zip(&extents).enumerate() {
            let home = -plant.place();
            let own = extent.moved(home);
            let along = if number == 0 { 0.0 } else { edge + 0.08 * widest - own.across[0] };
            edge = along + own.across[1];
            plant.offset = home + gaze.right * along;
            all = all.join(&own.moved(gaze.right * along));
        }
        Camera::fitting(&all, &frame, height, most)
    }

    fn draw(&self, picture: &Picture, camera: &Camera, title: &str) -> Canvas {
        let sun = picture.sun.unwrap_or_else(|| picture.view.sun());
        let lights: Vec<_> = self.plants.iter().map(|plant| plant.light(sun)).collect();
        let Picture { ground, transparent, .. } = *picture;
        let set = Set { plants: &self.plants, lights: &lights, camera: *camera, ground, transparent };
        let mut canvas = draw::draw(&set, picture.size);
        if picture.caption {
            self.write_below(&mut canvas, title, camera);
        }
        canvas
    }

    /// The part of a picture that plants fill.
    fn frame(&self, picture: &Picture) -> Frame {
        let [width, height] = picture.size.map(|side| side as f32);
        let margin = 0.045 * width.min(height);
        let size = letter_size(picture.size[1]);
        let lines = if self.plants.len() > 1 { 7.6 } else { 4.6 };
        let (below, aside) = if picture.caption { (lines * size, self.legend_width(size)) } else { (0.0, 0.0) };
        Frame { left: margin, top: margin, right: width - margin.max(aside), bottom: height - margin.max(below) }
    }

    fn legend_width(&self, size: f32) -> f32 {
        if self.legend.is_some() { (colouring::WIDTH + 1.0) * size } else { 0.0 }
    }

    fn write_below(&self, canvas: &mut Canvas, title: &str, camera: &Camera) {
        let size = letter_size(canvas.height);
        let (width, height) = (canvas.width as f32, canvas.height as f32);
        let line = height - 1.4 * size;
        let scale = self.plants.first().map_or(1.0, |plant| camera.scale_at(plant.foot()));
        scale_bar(canvas, scale, 0.16 * width, size, [1.6 * size, line]);
        write(canvas, title, size, [width - 1.6 * size, line], Align::Right);
        let feet = self.plants.iter().map(|plant| camera.project(plant.foot()).map_or(0.0, |foot| foot.x));
        let labels: Vec<(f32, &str)> = feet.zip(self.labels.iter().copied()).collect();
        if let [(x, label)] = labels[..] {
            write(canvas, label, size, [x, line], Align::Middle);
        } else {
            write_row(canvas, &labels, size, line - 2.9 * size);
        }
        self.legend.iter().for_each(|legend| legend.draw(canvas, size));
    }
}
