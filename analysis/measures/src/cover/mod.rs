//! Effective leaf area: what discs in a plane cover together, what lies above another counted once (Honda & Fisher
//! 1978; Aono & Kunii 1984, "Optimal branching pattern of a real plant").
//!
//! `exact` has the area by the arcs that no other disc covers, `lines` by the paper's increments of scan lines, and
//! `shade` projects leaves along a direction. Unit: the square of that of the places. Absent: leaves that let light
//! through, and light that comes from more than one side.

mod exact;
mod lines;
mod neighbours;
mod shade;

pub use exact::area;
pub use lines::area_by_lines;
pub use shade::Direction;

/// A disc in a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Its centre.
    pub centre: [f64; 2],
    /// Its radius; a disc without a radius above 0 covers nothing, and so does one of whose
    /// numbers one is none, or beyond 10¹⁵⁰.
    pub radius: f64,
}

impl Disc {
    /// A disc of an area.
    pub fn of_area(centre: [f64; 2], area: f64) -> Self {
        Self { centre, radius: (area.max(0.0) / std::f64::consts::PI).sqrt() }
    }

    /// Its own area.
    pub fn area(self) -> f64 {
        std::f64::consts::PI * self.radius * self.radius
    }

    /// Whether it covers anything, and the squares of its numbers are numbers.
    fn is_there(&self) -> bool {
        (1e-150..1e150).contains(&self.radius) && self.centre.iter().all(|place| place.abs() < 1e150)
    }
}

#[cfg(test)]
mod tests;
