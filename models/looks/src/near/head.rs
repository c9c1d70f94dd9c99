//! Flowers and heads of flowers as they are seen from near, in numbers of their parts.
//!
//! A capitulum has its florets at r = c √i, θ = i · 137.508° (Vogel 1979, *A better way to construct the sunflower
//! head*): each has the same area, and the florets that touch stand in two sets of spirals whose numbers are
//! neighbouring Fibonacci numbers. Absent: triangles (`phytomer_meshes`).

use super::blade::Blade;

/// The angle between one floret and the next, degrees.
pub const GOLDEN_DEG: f32 = 137.507_77;

/// A head of florets: a capitulum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields, default))]
pub struct Capitulum {
    /// Disc florets, in [20, 1600].
    pub florets: u16,
    /// Ray florets around them, in [0, 90].
    pub rays: u8,
    /// Bracts behind them, in [0, 60].
    pub bracts: u8,
    /// The diameter of the disc as a share of that of the head with its rays, in [0.1, 0.95].
    pub disc: f32,
    /// How high the disc is vaulted, as a share of its diameter, in [0, 0.5].
    pub vault: f32,
    /// How far rays are unfolded, in [0, 1]; 0: they are gone, as over ripe seed.
    pub unfolded: f32,
    /// How far the florets have opened from the rim inwards, in [0, 1]; left out: by the age of the head.
    #[cfg_attr(feature = "files", serde(skip_serializing_if = "Option::is_none"))]
    pub opened: Option<f32>,
    /// Whether florets have become seeds.
    pub seeds: bool,
}

impl Default for Capitulum {
    fn default() -> Self {
        Self { florets: 800, rays: 34, bracts: 34, disc: 0.5, vault: 0.09, unfolded: 1.0, opened: None, seeds: false }
    }
}

impl Capitulum {
    /// The place of a floret, from 0, in the disc of radius 1: how far out and at which angle, radians.
    pub fn place(&self, floret: u16) -> [f32; 2] {
        let share = (f32::from(floret) + 0.5) / f32::from(self.florets.max(1));
        [share.sqrt(), (f32::from(floret) * GOLDEN_DEG % 360.0).to_radians()]
    }

    /// How far a floret has opened, in [0, 1], where so much of the disc has: the rim opens first.
    pub fn opening(&self, floret: u16, opened: f32) -> f32 {
        let [out, _] = self.place(floret);
        // A ring of a quarter of the radius is opening at a time.
        ((out - 1.0 + 1.25 * opened) / 0.25).clamp(0.0, 1.0)
    }
}

/// A flower of petals around a tube: a coffee's, a phlox's, a cherry's.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(deny_unknown_fields, default))]
pub struct Flower {
    /// Petals, or the lobes of a tube, in [2, 40].
    pub petals: u8,
    /// What each of them is like.
    pub petal: Blade,
    /// The width of a petal over its length, in [0.05, 2].
    pub petal_width: f32,
    /// The share of the length that is a tube or a stalk, in [0.05, 0.95].
    pub tube: f32,
    /// The width of the tube as a share of the width of the flower, in [0.01, 0.6].
    pub tube_width: f32,
    /// The angle between the axis and its open petals, degrees, in [5, 120].
    pub spread_deg: f32,
    /// Stamens, in [0, 100].
    pub stamens: u8,
    /// The length of a stamen as a share of half the width of the flower, in [0, 1].
    pub stamen: f32,
    /// Sepals below the petals, in [0, 12].
    pub sepals: u8,
    /// The length of a sepal as a share of that of a petal, in [0.05, 1.5].
    pub sepal: f32,
    /// The angle between the axis and its sepals, degrees, in [5, 170]; above 90 they are turned back.
    pub sepal_deg: f32,
}

impl Default for Flower {
    fn default() -> Self {
        Self {
            petals: 5,
            petal: Blade::default(),
            petal_width: 0.6,
            tube: 0.6,
            tube_width: 0.08,
            spread_deg: 80.0,
            stamens: 5,
            stamen: 0.3,
            sepals: 0,
            sepal: 0.5,
            sepal_deg: 100.0,
        }
    }
}
