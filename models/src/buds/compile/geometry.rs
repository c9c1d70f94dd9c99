//! Phyllotaxis from names and degrees (de Reffye 1988 §2, Fig. 3), and the shape of internodes.
//!
//! The named fractions are those of the paper and of Aono & Kunii 1984; the opposite-decussate and the whorled
//! arrangement are the botanists' common terms. Absent: trends (`trend`), and the turning of
//! nodes, which is the pose's.

use super::compiler::Compiler;
use crate::buds::params::{Order, Phyllotaxis, ShapeName};
use crate::law::VariateTable;
use crate::turns::{GOLDEN_ANGLE_DEG, fibonacci};
use phytomer_sim::plant::Shape;

/// Radians in a degree.
pub const DEGREE: f32 = std::f32::consts::PI / 180.0;

impl From<ShapeName> for Shape {
    fn from(name: ShapeName) -> Self {
        match name {
            ShapeName::Cylinder => Self::Cylinder,
            ShapeName::Cone => Self::Cone,
            ShapeName::Blade => Self::Blade,
        }
    }
}

/// The divergence from node to node, degrees, where a node bears at most `most_borne` leaves or axillary buds.
pub fn divergence(order: &Order, most_borne: u32, compiler: &mut Compiler) -> VariateTable {
    match &order.phyllotaxis {
        Phyllotaxis::Degrees(degrees) => compiler.angle(degrees, "phyllotaxis"),
        Phyllotaxis::Divergence(stated) => compiler.angle(&stated.divergence_deg, "phyllotaxis.divergence_deg"),
        Phyllotaxis::Named(name) => VariateTable::always(named(name, "phyllotaxis", most_borne, compiler)),
        Phyllotaxis::Sourced(stated) => {
            VariateTable::always(named(&stated.named, "phyllotaxis.named", most_borne, compiler))
        }
    }
}

/// The azimuth of an axis's first leaf, degrees.
pub fn first_azimuth(order: &Order, compiler: &mut Compiler) -> VariateTable {
    match &order.phyllotaxis {
        Phyllotaxis::Divergence(stated) => compiler.angle(&stated.first_deg, "phyllotaxis.first_deg"),
        Phyllotaxis::Named(_) | Phyllotaxis::Sourced(_) | Phyllotaxis::Degrees(_) => VariateTable::always(90.0),
    }
}

/// The degrees of a name that stands at `keys` below the order.
fn named(name: &str, keys: &str, most_borne: u32, compiler: &mut Compiler) -> f64 {
    match name {
        "spiral" => GOLDEN_ANGLE_DEG,
        "distichous" => 180.0,
        "opposite-decussate" => 90.0,
        "whorled" => 180.0 / f64::from(most_borne.max(1)),
        fraction => fibonacci(fraction).unwrap_or_else(|| {
            let expected = "\"spiral\", \"distichous\", \"opposite-decussate\", \"whorled\", a Fibonacci fraction of a \
                            turn such as \"2/5\" or \"3/8\", or a divergence in degrees";
            compiler.fault(keys, format!("the phyllotaxis is \"{fraction}\""), expected);
            0.0
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fractions_of_schimper_and_braun_are_known() {
        let known = [("1/2", 180.0), ("1/3", 120.0), ("2/5", 144.0), ("3/8", 135.0), ("5/13", 138.461_538)];
        for (fraction, degrees) in known {
            assert!((fibonacci(fraction).unwrap() - degrees).abs() < 1e-6, "{fraction}");
        }
        let limit = fibonacci("6765/17711").unwrap();
        assert!((limit - GOLDEN_ANGLE_DEG).abs() < 1e-5, "{limit}");
        for wrong in ["2/6", "1/4", "0/1", "3/5", "x/8", "2", "", "4/10"] {
            assert_eq!(fibonacci(wrong), None, "{wrong}");
        }
    }
}
