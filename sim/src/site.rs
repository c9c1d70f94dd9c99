//! The site around the plants of a plot: what its date brings, its fields of force, and whether it feeds anything back
//! to the buds.
//!
//! Today a site is open ground under gravity and a steady wind. Light, obstacles and events of the date belong here.

use crate::clock::Tick;
use crate::math::{pow, sincos};
use crate::plant::Drag;
use crate::vector::Vector;

/// The acceleration of gravity by convention, m/s².
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// The density of air at 15 °C and sea level, kg/m³ (International Standard Atmosphere).
pub const AIR_DENSITY: f64 = 1.225;

/// The ground that the plants of one plot share.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// The age of the plot: the last tick that has begun.
    pub age: Tick,
    /// The acceleration of gravity, m/s²; 0 leaves every plant in its pose at rest.
    pub gravity: f64,
    /// The steady wind.
    pub wind: Wind,
}

/// A steady wind, level and the same at every height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wind {
    /// Its speed, m/s; 0 is calm.
    pub speed: f64,
    /// The direction towards which it blows, radians from the X axis.
    pub towards: f64,
}

/// The forces that a site exerts on what stands in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fields {
    /// On a kilogram, N.
    pub gravity: Vector,
    /// Of the wind, on a square metre of leaf or wood, N.
    pub drag: Vector,
}

impl Default for Site {
    fn default() -> Self {
        Self { age: 0, gravity: STANDARD_GRAVITY, wind: Wind::default() }
    }
}

impl Site {
    /// Opens a tick.
    pub fn begin(&mut self, age: Tick) {
        self.age = age;
    }

    /// Whether the buds feel what stands around them, so that growth must follow the clock. Nothing does so yet.
    pub fn feeds_back(&self) -> bool {
        false
    }

    /// Gravity, and the drag of the wind: ½ ρ C_d U² a square metre with C_d = c U⁻ⁿ.
    pub(crate) fn fields(&self, drag: &Drag) -> Fields {
        let gravity = Vector::new(0.0, 0.0, -self.gravity);
        Fields { gravity, drag: self.wind.pressure(drag) }
    }
}

impl Wind {
    /// The force on a square metre, N.
    pub(crate) fn pressure(&self, drag: &Drag) -> Vector {
        if self.speed <= 0.0 {
            return Vector::default();
        }
        let coefficient = f64::from(drag.coefficient) * pow(self.speed, -f64::from(drag.exponent));
        let (sin, cos) = sincos(self.towards);
        Vector::new(cos, sin, 0.0) * (0.5 * AIR_DENSITY * coefficient * self.speed * self.speed)
    }
}

impl Fields {
    /// Neither weight nor wind.
    pub const NONE: Self = Self { gravity: Vector { x: 0.0, y: 0.0, z: 0.0 }, drag: Vector { x: 0.0, y: 0.0, z: 0.0 } };
}
