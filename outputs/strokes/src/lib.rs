//! Line drawings of trees, as the figures of Aono & Kunii 1984 are: branches as lines or with a girth, leaves, and the
//! shadows that a light at a place throws on the ground.
//!
//! A [`Drawing`] holds what is drawn, in metres, z up; a star marks a point that pulls at a tree (their Fig. 23). A
//! [`Sheet`] shows it in ports, each a view with its part of the sheet, as [`Sheet::svg`] or [`Sheet::pixels`]; both
//! draw the same shapes (`flat`), the farther first. `views` leads from space to a plane, `ports` from that plane to
//! the sheet. Equal drawings give equal bytes on every platform. Absent: how trees grow, and pictures with light and
//! air (`phytomer-pictures`).

mod flat;
mod pixels;
mod ports;
mod svg;
#[cfg(test)]
mod tests;
mod views;

pub use ports::{Port, Window};
pub use views::View;

use flat::Flat;
use phytomer_pictures::Canvas;

/// A place, metres, z up.
pub type Place = [f64; 3];
/// A colour of a screen.
pub type Colour = [u8; 3];

/// A branch from its base to its tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Base and tip.
    pub ends: [Place; 2],
    /// The diameters there, metres; `None`: a line as wide as the pen.
    pub girth: Option<[f64; 2]>,
    /// Its colour.
    pub colour: Colour,
    /// How a girth is filled.
    pub fill: Fill,
}

/// How a branch with a girth is filled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fill {
    /// From 0, its outline alone, to 1, its colour.
    pub dense: f64,
    /// Whether its right half is darker.
    pub shaded: bool,
}

impl Fill {
    /// Its colour alone.
    pub const FULL: Self = Self { dense: 1.0, shaded: false };
}

/// A plane part of a leaf.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Its corners, in their order.
    pub corners: Vec<Place>,
    /// Its colour.
    pub colour: Colour,
}

/// A shadow of a branch or of a leaf on the ground, z = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shadow {
    /// Where the light is.
    pub emitter: Place,
    /// Its colour.
    pub colour: Colour,
    /// Whether shadows that lie over one another are one; else each darkens the ground.
    pub merged: bool,
}

/// A point that pulls at a tree or pushes it away, as a star that has its size on the sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Star {
    /// Where it is.
    pub place: Place,
    /// Its colour.
    pub colour: Colour,
    /// Whether it is filled, as one that pulls is; else it is an outline.
    pub filled: bool,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// The branches.
    pub branches: Vec<Branch>,
    /// The leaves.
    pub patches: Vec<Patch>,
    /// The shadows, each with the numbers of its first branch and of the one after its last, and the same of patches.
    pub shadows: Vec<(Shadow, [usize; 2], [usize; 2])>,
    /// The stars, which lie over all else.
    pub stars: Vec<Star>,
}

/// A sheet on which a drawing is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Its background.
    pub background: Colour,
    /// Its ports, of which later ones lie over earlier ones.
    pub ports: Vec<Port>,
    /// Whether it shows the stars of a drawing.
    pub stars: bool,
}

impl Sheet {
    /// The drawing as SVG 1.1: one path for each shape, clipped to its port.
    pub fn svg(&self, drawing: &Drawing) -> String {
        svg::written(self, &self.flat(drawing))
    }

    /// The drawing as pixels, each the mean of 16 samples.
    pub fn pixels(&self, drawing: &Drawing) -> Canvas {
        pixels::drawn(self, &self.flat(drawing))
    }

    /// The same sheet with the windows that show all of a drawing, for drawings of parts of it.
    #[must_use]
    pub fn framed(&self, drawing: &Drawing) -> Self {
        let windows = ports::windows(self, drawing);
        let ports = self.ports.iter().zip(windows).map(|(port, window)| Port { window: Some(window), ..*port });
        Self { ports: ports.collect(), ..self.clone() }
    }

    /// The stars that it shows of a drawing.
    fn shown<'a>(&self, drawing: &'a Drawing) -> &'a [Star] {
        if self.stars { &drawing.stars } else { &[] }
    }

    /// The shapes in each port.
    fn flat(&self, drawing: &Drawing) -> Vec<(Port, Vec<Flat>)> {
        let windows = ports::windows(self, drawing);
        let shapes = self.ports.iter().zip(windows).map(|(port, window)| {
            let way = ports::Way::of(self, port, &window);
            (*port, flat::shapes(drawing, self, port.view, &way))
        });
        shapes.collect()
    }
}
