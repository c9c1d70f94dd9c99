//! Wind as a growth model's own law of sway sees it, and what such a law says of each axis.
//!
//! A model without a law of its own is moved by `mechanics::sway`. Absent: the laws, which are the models'.

/// A gusty wind at a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gusts {
    /// The speed of the steady wind, m/s.
    pub speed: f64,
    /// By how much gusts are faster, m/s.
    pub gust: f64,
    /// The moment, seconds.
    pub time: f64,
    /// The length of a film that closes, seconds: every axis is then, at its end, as at its beginning.
    pub closes: Option<f64>,
}

/// How an axis sways.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// By how much its angle b grows, radians a second.
    pub rate: f64,
    /// b at the time 0, about x and about y, radians.
    pub phases: [f64; 2],
    /// The length of its stem, metres; of a clone that of the whole stem of which it is a part.
    pub length: f64,
    /// The radius at the base of that stem, metres.
    pub radius: f64,
    /// The number of segments of that stem.
    pub segments: u32,
    /// How many of them are below the axis.
    pub before: u32,
}

impl Swing {
    /// The place on the stem, from 0 at its base to 1 at its tip, of a point at a share of the length of the internode
    /// of a rank, from 1.
    pub fn place(&self, rank: u32, share: f32) -> f32 {
        let below = self.before + rank.saturating_sub(1);
        ((below as f32 + share.clamp(0.0, 1.0)) / self.segments.max(1) as f32).clamp(0.0, 1.0)
    }
}
