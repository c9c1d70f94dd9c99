//! The curves of degradation (Weber & Penn 1995 §5): which share of the elements of each kind is drawn at a range, and
//! the last range at which a share is drawn.
//!
//! The scan of the paper has lost most of these formulas; they are those of the printed one. A range here is the
//! paper's r₂, which holds for a picture of 1,000 lines over 60 degrees ([`super::Zoom`]). Shares are clamped to [0,
//! 1], and the limits of a formula belong to it. Absent: which elements make up a share (`masses`).

use phytomer_sim::math::pow;

/// The range from which the lines of the trunk are drawn, m: nearer they could be seen as a seam (§5).
pub const TRUNK_LINES_FROM: f64 = 100.0;

/// The elements of one kind: a primitive of stems of a level, or of leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Elements {
    /// Polygons of level 0: around each segment of the trunk.
    TrunkPolygons,
    /// Lines of level 0.
    TrunkLines,
    /// Polygons of level 1.
    BranchPolygons,
    /// Lines of level 1.
    BranchLines,
    /// Polygons of level 2 and all beyond.
    TwigPolygons,
    /// Lines of level 2 and all beyond.
    TwigLines,
    /// Leaves as polygons.
    LeafPolygons,
    /// Leaves as points.
    LeafPoints,
}

/// When in the year a tree is looked at, and how fine it is: what scales the ranges of §5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// The quality, above 0; 1 is the paper's own.
    pub quality: f64,
    /// Whether leaves hide the stems: an evergreen, or a tree in summer or in fall.
    pub in_leaf: bool,
    /// Whether it is spring, when leaves are small.
    pub spring: bool,
}

impl Scales {
    /// A tree in summer.
    pub const SUMMER: Self = Self { quality: 1.0, in_leaf: true, spring: false };

    /// The paper's s, which scales the ranges of stems.
    fn s(&self) -> f64 {
        if self.in_leaf { self.quality / 2.0 } else { self.quality }
    }

    /// The paper's d, which scales the ranges of leaves, m.
    fn d(&self) -> f64 {
        if self.spring { 100.0 } else { 200.0 }
    }

    /// The share of the elements that is drawn at the range `r`, m, in [0, 1] (§5).
    pub fn share(&self, elements: Elements, r: f64) -> f64 {
        let (s, d) = (self.s(), self.d());
        let share = match elements {
            _ if r > self.last(elements) => 0.0,
            Elements::TrunkPolygons if r <= 300.0 => 1.0,
            Elements::TrunkPolygons | Elements::BranchPolygons => 1.5 - r / 600.0,
            Elements::TrunkLines => f64::from(u8::from(r >= TRUNK_LINES_FROM)),
            Elements::BranchLines if r <= 200.0 * s => 1.0,
            Elements::BranchLines => 2.2 - 1.2 * pow(r / (200.0 * s), 0.3),
            Elements::TwigPolygons => 2.0 - r / (50.0 * s),
            Elements::TwigLines => 2.0 - (r / (100.0 * s)).sqrt(),
            Elements::LeafPolygons => 4.0 / 3.0 - r / (0.75 * d),
            Elements::LeafPoints => 1.5 - r / (2.0 * d),
        };
        share.clamp(0.0, 1.0)
    }

    /// The last range at which at least the share `least`, in (0, 1], is drawn, m: the inverse of [`Scales::share`].
    pub fn until(&self, elements: Elements, least: f64) -> f64 {
        let (s, d) = (self.s(), self.d());
        let until = match elements {
            Elements::TrunkPolygons | Elements::BranchPolygons => 600.0 * (1.5 - least),
            Elements::TrunkLines => f64::INFINITY,
            Elements::BranchLines => 200.0 * s * pow((2.2 - least) / 1.2, 1.0 / 0.3),
            Elements::TwigPolygons => 50.0 * s * (2.0 - least),
            Elements::TwigLines => 100.0 * s * (2.0 - least) * (2.0 - least),
            Elements::LeafPolygons => 0.75 * d * (4.0 / 3.0 - least),
            Elements::LeafPoints => 2.0 * d * (1.5 - least),
        };
        until.min(self.last(elements))
    }

    /// The range beyond which none is drawn, m.
    fn last(&self, elements: Elements) -> f64 {
        let (s, d) = (self.s(), self.d());
        match elements {
            Elements::TrunkPolygons => 800.0,
            Elements::TrunkLines | Elements::LeafPoints => f64::INFINITY,
            Elements::BranchPolygons => 200.0 * s,
            Elements::BranchLines => 2000.0 * s,
            Elements::TwigPolygons => 100.0 * s,
            Elements::TwigLines => 500.0 * s,
            Elements::LeafPolygons => d,
        }
    }
}
