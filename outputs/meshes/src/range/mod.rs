//! Degradation at range (Weber & Penn 1995 §5): what of a tree of stems is drawn at which range, element by element.
//!
//! Far away stems are lines instead of polygons, leaves points, and both become fewer, one at a time. Every element has
//! the range from which and the range until which it is drawn, so that what is drawn at a range is what these two
//! include ([`Span`]), and what is drawn farther away is part of what is drawn nearer, but for the lines of the trunk,
//! which begin at 100 m. Levels are those of the paper: 0 is the trunk; beyond 2 all are as 2. Absent: the elements of
//! a plant (`detail`), and how lines and points are drawn, which are the scene's.

mod laws;
mod masses;
#[cfg(test)]
mod tests;

pub use laws::{Elements, Scales, TRUNK_LINES_FROM};

/// How large a tree is seen: the lines of a picture, and the angle that they cover.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zoom {
    /// The height of the picture, pixels.
    pub height: f64,
    /// The angle from its lower to its upper edge, degrees.
    pub field_of_view_deg: f64,
}

impl Default for Zoom {
    /// The paper's: 1,000 lines over 60 degrees.
    fn default() -> Self {
        Self { height: 1000.0, field_of_view_deg: 60.0 }
    }
}

impl Zoom {
    /// The range of the formulas for a distance in metres: r₂ = range · 1000/height · field of view/60 (§5).
    pub fn calibrated(&self, metres: f64) -> f64 {
        metres * self.factor()
    }

    /// The distance, m, at which a tree is seen as at the range `r` of the formulas.
    pub fn metres(&self, r: f64) -> f64 {
        r / self.factor()
    }

    fn factor(&self) -> f64 {
        1000.0 / self.height * self.field_of_view_deg / 60.0
    }
}

/// The ranges between which an element is drawn, in the formulas' metres; both limits belong to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The range from which it is drawn.
    pub from: f64,
    /// The range until which it is drawn; +∞ where it is drawn at any.
    pub until: f64,
}

impl Span {
    /// The span of the element at `place` of a list of `total` of its kind.
    pub fn of(scales: &Scales, elements: Elements, place: u32, total: u32) -> Self {
        let least = elements.least_share(place, total);
        let from = if elements == Elements::TrunkLines { TRUNK_LINES_FROM } else { 0.0 };
        Self { from, until: if least > 0.0 { scales.until(elements, least) } else { f64::INFINITY } }
    }

    /// Whether the element is drawn at the range `r`.
    pub fn holds(&self, r: f64) -> bool {
        self.from <= r && r <= self.until
    }
}
