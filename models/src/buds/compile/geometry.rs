//! Phyllotaxis and trends, from names and degrees to radians and ratios (de Reffye 1988 §4, Fig. 3 and Fig. 15).
//!
//! The named phyllotaxes are those of the paper and of Aono & Kunii 1984; the smoothed shape of Fig. 15 becomes a share
//! of the way to the trend that each internode turns. Absent: the turning itself, which is the pose's.

use super::compiler::Compiler;
use crate::buds::law::{Variate, VariateTable};
use crate::buds::params::{Order, Orientation, Phyllotaxis, ShapeName, Trend};
use phytomer_sim::math;
use phytomer_sim::plant::{Shape, Trend as Tendency};

/// Radians in a degree.
pub const DEGREE: f32 = std::f32::consts::PI / 180.0;

/// The golden angle, degrees: the limit of the divergences 1/2, 1/3, 2/5, 3/8, 5/13 … of Schimper and Braun (Aono &
/// Kunii 1984, "Phyllotaxis").
const GOLDEN_ANGLE_DEG: f64 = 137.507_764_050_037_85;

/// The share of the way to its trend that an internode of a plainly named trend turns. The paper draws the smoothed
/// shape (Fig. 15) and gives no number; a tenth brings an axis nine tenths of the way in 22 internodes.
const NAMED_SHARE: f64 = 0.1;

impl From<ShapeName> for Shape {
    fn from(name: ShapeName) -> Self {
        match name {
            ShapeName::Cylinder => Self::Cylinder,
            ShapeName::Cone => Self::Cone,
        }
    }
}

/// The divergence from node to node in degrees, and the azimuth of an axis's first leaf in radians.
pub fn phyllotaxis(order: &Order, compiler: &mut Compiler) -> (VariateTable, f32) {
    let (degrees, first_deg) = match &order.phyllotaxis {
        Phyllotaxis::Degrees(degrees) => (Variate::from(*degrees), 90.0),
        Phyllotaxis::Divergence(divergence) => {
            let table = compiler.angle(&divergence.divergence_deg, "phyllotaxis.divergence_deg");
            return (table, divergence.first_deg as f32 * DEGREE);
        }
        Phyllotaxis::Named(name) => (Variate::from(named(name, order, compiler)), 90.0),
    };
    (compiler.angle(&degrees, "phyllotaxis"), first_deg * DEGREE)
}

fn named(name: &str, order: &Order, compiler: &mut Compiler) -> f64 {
    match name {
        "spiral" => GOLDEN_ANGLE_DEG,
        "distichous" => 180.0,
        "opposite-decussate" => 90.0,
        "whorled" => {
            let leaves = compiler.count(&order.leaf.per_node, "leaf.per_node", 64).max();
            let buds = compiler.count(&order.axillary.buds, "axillary.buds", 32).max();
            180.0 / f64::from(leaves.max(buds).max(1))
        }
        fraction => fibonacci(fraction).unwrap_or_else(|| {
            let expected = "\"spiral\", \"distichous\", \"opposite-decussate\", \"whorled\", a Fibonacci fraction of a \
                            turn such as \"2/5\" or \"3/8\", or a divergence in degrees";
            compiler.fault("phyllotaxis", format!("the phyllotaxis is \"{fraction}\""), expected);
            0.0
        }),
    }
}

/// The degrees of a Fibonacci fraction of a turn, F(n)/F(n+2): 1/2, 1/3, 2/5, 3/8, 5/13, 8/21, 13/34 … (Aono & Kunii
/// 1984, "Phyllotaxis").
fn fibonacci(fraction: &str) -> Option<f64> {
    let (turns, leaves) = fraction.split_once('/')?;
    let (turns, leaves): (u64, u64) = (turns.trim().parse().ok()?, leaves.trim().parse().ok()?);
    let (mut a, mut b) = (1, 1);
    while a <= turns && b < 1_000_000 {
        if (turns, leaves) == (a, a + b) {
            return Some(360.0 * turns as f64 / leaves as f64);
        }
        (a, b) = (b, a + b);
    }
    None
}

/// The trends of an axis by the rank of the node.
#[derive(Debug, Clone)]
pub struct Trends {
    /// From which rank on, and the place in the habit's trends.
    phases: Vec<(u32, u8)>,
}

impl Trends {
    /// Adds the order's trends to the habit's.
    pub fn compile(trend: &Trend, compiler: &mut Compiler, habit: &mut Vec<Tendency>) -> Self {
        let phases = match trend {
            Trend::Simple(name) => vec![(1, simple(*name))],
            Trend::Tended(tended) => vec![(1, checked(tended.inclination_deg, tended.share, "trend", compiler))],
            Trend::Composite(phases) => {
                let ascending = phases.windows(2).all(|pair| pair[0].from_rank < pair[1].from_rank);
                if phases.first().is_none_or(|phase| phase.from_rank != 1) || !ascending || phases.len() > 64 {
                    let found = "the phases do not start at rank 1 and ascend".to_owned();
                    compiler.fault("trend", found, "at most 64 phases, the first from rank 1, in ascending order");
                }
                let tendency = |(place, phase): (usize, &crate::buds::params::Phase)| {
                    let keys = format!("trend.{place}");
                    (phase.from_rank, checked(phase.inclination_deg, phase.share, &keys, compiler))
                };
                phases.iter().take(64).enumerate().map(tendency).collect()
            }
        };
        Self { phases: phases.into_iter().map(|(rank, tendency)| (rank, place(tendency, habit, compiler))).collect() }
    }

    /// The trend of the node at `rank` along the axis.
    #[inline]
    pub fn at(&self, rank: u32) -> u8 {
        match self.phases.as_slice() {
            [only] => only.1,
            phases => phases.iter().rev().find(|phase| phase.0 <= rank).map_or(0, |phase| phase.1),
        }
    }
}

fn simple(name: Orientation) -> Tendency {
    match name {
        Orientation::Straight => Tendency::STRAIGHT,
        Orientation::Orthotropic => tendency(0.0, NAMED_SHARE),
        Orientation::Plagiotropic => tendency(90.0, NAMED_SHARE),
    }
}

fn checked(inclination_deg: f64, share: f64, keys: &str, compiler: &mut Compiler) -> Tendency {
    if !(0.0..=180.0).contains(&inclination_deg) {
        let found = format!("the inclination is {inclination_deg}");
        compiler.fault(&format!("{keys}.inclination_deg"), found, "an angle from 0 to 180 degrees");
    }
    if !(0.0..=1.0).contains(&share) {
        compiler.fault(&format!("{keys}.share"), format!("the share is {share}"), "a share in [0, 1]");
    }
    tendency(inclination_deg, share)
}

fn tendency(inclination_deg: f64, share: f64) -> Tendency {
    let (sin, cos) = match inclination_deg {
        90.0 => (1.0, 0.0),
        degrees => math::sincos(degrees * std::f64::consts::PI / 180.0),
    };
    Tendency { cos_inclination: cos as f32, sin_inclination: sin as f32, share: share as f32 }
}

fn place(tendency: Tendency, habit: &mut Vec<Tendency>, compiler: &mut Compiler) -> u8 {
    let found = habit.iter().position(|known| *known == tendency).unwrap_or_else(|| {
        habit.push(tendency);
        habit.len() - 1
    });
    u8::try_from(found).unwrap_or_else(|_| {
        compiler.fault("trend", "the species has more than 256 trends".to_owned(), "at most 256 trends in all");
        0
    })
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
