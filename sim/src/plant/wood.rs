//! The mechanical properties of wood, leaves and fruits: stiffness, weight, drag, and how axes right themselves.
//!
//! All numbers are compiled: laws of age are tables, angles are sines and cosines. Absent: the sources of the numbers,
//! which are in the species file, and the equations that use them.

use super::Plant;
use super::handle::OrganId;
use super::kind::Class;
use crate::clock::Tick;

/// The mechanical side of a species.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wood {
    /// The wood of each order, from 1; orders past the last have the wood of the last.
    pub tissues: Vec<Tissue>,
    /// How internodes gain diameter.
    pub thickening: Thickening,
    /// Whether axes bend under what they bear.
    pub bends: bool,
    /// The fresh mass of organs.
    pub organs: OrganMass,
    /// The drag of leaves and wood in the wind.
    pub drag: Drag,
}

/// The wood of one order, by the age of the internode in ticks; later ages have the last entry of a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tissue {
    /// Young's modulus, Pa.
    pub modulus: Vec<f32>,
    /// Green density, kg/m³.
    pub density: Vec<f32>,
    /// How axes of the order right themselves.
    pub uprighting: Uprighting,
}

/// Gravitropic righting: the direction that an axis keeps to, and the causes that turn it there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uprighting {
    /// Cosine of the angle between the direction kept to and the upward vertical.
    pub cos_inclination: f32,
    /// Sine of the same angle.
    pub sin_inclination: f32,
    /// The difference of maturation strain between the two sides of new wood, Δε.
    pub strain: f32,
    /// The curvature that a young internode gains in a tick, where it stands at a right angle to the direction kept to,
    /// rad/m.
    pub rate: f32,
    /// For how many ticks an internode is young.
    pub young: u32,
}

impl Default for Uprighting {
    fn default() -> Self {
        Self { cos_inclination: 1.0, sin_inclination: 0.0, strain: 0.0, rate: 0.0, young: 0 }
    }
}

impl Uprighting {
    /// Whether the axes right themselves at all.
    pub fn acts(&self) -> bool {
        self.strain != 0.0 || (self.rate != 0.0 && self.young > 0)
    }
}

/// Fresh mass of organs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OrganMass {
    /// The mass of a square metre of leaf, one side, kg/m².
    pub leaf: f32,
    /// The density of a flower as the ellipsoid of its length and width, kg/m³.
    pub flower: f32,
    /// The density of a fruit as the ellipsoid of its length and width, kg/m³.
    pub fruit: f32,
}

/// Drag that falls with the speed of the wind, as crowns give way: F = ½ ρ C_d A U² with C_d = c U⁻ⁿ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drag {
    /// c of the drag law, for U in m/s.
    pub coefficient: f32,
    /// n of the drag law.
    pub exponent: f32,
}

impl Wood {
    /// The tissue of an order; orders past the last have the tissue of the last.
    #[inline]
    pub fn tissue(&self, order: u8) -> &Tissue {
        let place = usize::from(order).saturating_sub(1).min(self.tissues.len() - 1);
        &self.tissues[place]
    }

    /// Whether diameters and pose at an age depend on the ages before: through frozen curvature, rings, or pipes of
    /// fallen leaves.
    pub(crate) fn remembers(&self) -> bool {
        self.bends || self.thickening != Thickening::Law
    }

    /// Whether any order rights itself by reaction wood, for which the growth in diameter of each internode is needed.
    pub fn makes_reaction_wood(&self) -> bool {
        self.tissues.iter().any(|tissue| tissue.uprighting.strain != 0.0)
    }
}

impl Tissue {
    /// Young's modulus of an internode `age` ticks old, Pa.
    #[inline]
    pub fn modulus(&self, age: u32) -> f64 {
        at(&self.modulus, age)
    }

    /// Green density of an internode `age` ticks old, kg/m³.
    #[inline]
    pub fn density(&self, age: u32) -> f64 {
        at(&self.density, age)
    }
}

#[inline]
fn at(table: &[f32], age: u32) -> f64 {
    let last = table.len().saturating_sub(1);
    table.get((age as usize).min(last)).map_or(0.0, |&value| f64::from(value))
}

impl OrganMass {
    /// The fresh mass of an organ at `age`, kg.
    #[inline]
    pub fn of(&self, plant: &Plant, organ: usize, age: Tick) -> f64 {
        let organs = &plant.organs;
        let ellipsoid = || {
            let share = f64::from(plant.expanded(OrganId(organ as u32), age));
            let (length, width) = (share * f64::from(organs.length[organ]), share * f64::from(organs.width[organ]));
            std::f64::consts::PI / 6.0 * length * width * width
        };
        match organs.kind[organ].class() {
            Class::Leaf => f64::from(self.leaf) * plant.organ_area::<f64>(OrganId(organ as u32), age),
            Class::Flower => f64::from(self.flower) * ellipsoid(),
            Class::Fruit => f64::from(self.fruit) * ellipsoid(),
            Class::Internode | Class::Bud => 0.0,
        }
    }
}

/// How the internodes of a species gain diameter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Thickening {
    /// By the model's law of age.
    #[default]
    Law,
    /// Pipe model: the section at birth, and `per_leaf` m² for each leaf above, living or not.
    Pipe {
        /// The section of one pipe, m².
        per_leaf: f64,
        /// Whether only living leaves count; the pipes of fallen leaves stay in the wood.
        living: bool,
    },
    /// Da Vinci's rule: d^Δ of an internode is the sum of d^Δ of the internodes on its node; where there is only one,
    /// the internode is at least as thick as at its birth.
    DaVinci {
        /// Δ.
        exponent: f64,
    },
    /// A ring a tick while the axis lives.
    Rings {
        /// The width of a ring, m.
        width: f64,
        /// The section that a square metre of living leaves above adds in a tick, m²/m².
        per_foliage: f64,
    },
}
