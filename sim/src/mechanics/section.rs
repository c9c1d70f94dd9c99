//! The cross-section of internodes: round, or the flat rectangle of a blade.
//!
//! A blade of width b and thickness t lies across its `up`. Out of its plane, about `heading × up`, it bends with
//! b t³/12; in its plane, about `up`, with t b³/12 (Euler–Bernoulli). A round stem has π d⁴/64 about either. Absent:
//! torsion, and stems that are hollow.

use crate::plant::{InternodeLook, NodeId, Plant, Shape};
use std::f64::consts::PI;

/// The cross-section of the internodes of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Section {
    /// Round, of the internode's diameters.
    Round,
    /// As wide as the internode's diameters, of this thickness, m.
    Blade(f64),
}

impl Section {
    #[inline]
    pub fn of(look: &InternodeLook) -> Self {
        match look.shape {
            Shape::Blade => Self::Blade(f64::from(look.thickness)),
            Shape::Cylinder | Shape::Cone => Self::Round,
        }
    }

    /// The cross-section of one node; `self` is the cross-section of its axis, which holds unless the node has a look
    /// of its own.
    #[inline]
    pub fn at(self, plant: &Plant, node: usize) -> Self {
        if plant.own_looks.is_empty() { self } else { Self::of(plant.look_of_node(NodeId(node as u32))) }
    }

    /// The second moments of area about `up` and about `heading × up`, m⁴, at a diameter or width `across`, m.
    #[inline]
    pub fn second_moments(self, across: f64) -> [f64; 2] {
        let square = across * across;
        match self {
            Self::Round => [PI / 64.0 * square * square; 2],
            Self::Blade(thickness) => {
                let area = thickness * across / 12.0;
                [area * square, area * thickness * thickness]
            }
        }
    }

    /// The volume of a length between two diameters or widths, m³: a frustum, or a slab.
    #[inline]
    pub fn volume(self, length: f64, base: f64, tip: f64) -> f64 {
        match self {
            Self::Round => PI / 12.0 * length * (base * base + base * tip + tip * tip),
            Self::Blade(thickness) => 0.5 * thickness * length * (base + tip),
        }
    }

    /// Four times the radius of gyration √(I / A) of the weak axis, m: for a round stem its diameter.
    #[inline]
    pub fn gyration(self, across: f64) -> f64 {
        match self {
            Self::Round => across,
            Self::Blade(thickness) => 2.0 * thickness / 3_f64.sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pow;

    #[test]
    fn sections_are_those_of_the_textbook() {
        let (blade, near) = (Section::Blade(0.002), |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12);
        let [edge, flat] = blade.second_moments(0.05);
        assert!(near(flat, 0.05 * pow(0.002, 3.0) / 12.0) && near(edge, 0.002 * pow(0.05, 3.0) / 12.0));
        assert!(near(blade.volume(0.1, 0.05, 0.03), 0.04 * 0.002 * 0.1));
        assert!(near(blade.gyration(0.05), 4.0 * (flat / (0.05 * 0.002)).sqrt()));
        let [about_up, about_side] = Section::Round.second_moments(0.05);
        assert!(near(about_up, PI * pow(0.05, 4.0) / 64.0) && about_up == about_side);
        assert!(near(Section::Round.gyration(0.05), 4.0 * (about_up / (PI / 4.0 * 0.05 * 0.05)).sqrt()));
    }
}
