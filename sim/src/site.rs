//! The site around the plants of a plot: what its date brings, its fields of force, and what it feeds back to growth.
//!
//! At each tick the site reads all plants as they stood at the end of the last one, the plants grow side by side and
//! see the site unchanged ([`View`]), and what they did is gathered in the order of the plot. So no result depends on
//! the threads. Three things feed back today: light, which buds read; obstacles, shapes that kill the buds that are in
//! them or out of them, or that shoots meet ([`solids`], with the ground and the [`stems`] of plants, and the [`way`]
//! past them); and cells of space that plants claim in the first half of a tick and are granted or refused in the
//! second. What the date alone decides is the [`calendar`], made of [`date`], [`sun`] and [`degree_days`]; replicates
//! may have [`calendars`] of their own.

pub mod calendar;
pub mod calendars;
pub mod date;
pub mod degree_days;
pub mod light;
pub mod solids;
pub mod stems;
pub mod sun;
pub mod way;

use crate::cells::Cells;
use crate::clock::Tick;
use crate::math::{pow, sincos};
use crate::plant::Drag;
use crate::shape::Shape;
use crate::vector::Vector;
use light::Light;
use solids::Solids;
use std::sync::{Arc, OnceLock};
use stems::{Stems, Whose};

/// The acceleration of gravity by convention, m/s².
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// The density of air at 15 °C and sea level, kg/m³ (International Standard Atmosphere).
pub const AIR_DENSITY: f64 = 1.225;

/// The ground that the plants of one plot share.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// The tick of the plot: the last one that has begun.
    pub tick: Tick,
    /// The acceleration of gravity, m/s²; 0 leaves every plant in its pose at rest.
    pub gravity: f64,
    /// The steady wind.
    pub wind: Wind,
    /// Shapes that kill buds, or that shoots meet.
    pub obstacles: Vec<Obstacle>,
    /// The height of the ground in the plot, metres, where shoots meet it; `None` where they do not.
    pub ground: Option<f64>,
    /// What shoots meet, made of the obstacles and the ground when [`Site::solids`] is first called.
    pub made_solids: OnceLock<Arc<Solids>>,
    /// Whose stems shoots meet.
    pub whose_stems: Whose,
    /// The stems that shoots meet, as they stood at the end of the last tick; made by [`crate::Plot::grow_to`] where
    /// they meet any.
    pub stems: Option<Arc<Stems>>,
    /// The cells of space that plants claim, where they do.
    pub cells: Cells,
    /// The light in the plot, where something asks for it.
    pub light: Option<Light>,
}

/// A shape in the plot that kills buds or blocks their way: a roof, a wall, a mown height, a form that is clipped all
/// the time.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// The shape, in the coordinates of the plot, metres.
    pub shape: Arc<Shape>,
    /// Where buds die, or where shoots do not enter.
    pub kills: Side,
    /// Whether it kills or blocks.
    pub manner: Manner,
}

/// What an obstacle does to buds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Manner {
    /// It kills each bud that has come there.
    #[default]
    Kills,
    /// Shoots do not enter it, and answer the contact as their species does.
    Blocks {
        /// Whether climbers hold to it.
        holds: bool,
    },
}

/// A side of the surface of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Within the shape and on its surface.
    Inside,
    /// Outside the shape.
    Outside,
}

impl Obstacle {
    /// Whether no bud lives at this point of the plot, metres: it is killed there, or does not come there.
    pub fn bars_at(&self, point: [f64; 3]) -> bool {
        self.shape.inside(point) == (self.kills == Side::Inside)
    }

    /// Whether it kills a bud at this point of the plot, metres.
    pub fn kills_at(&self, point: [f64; 3]) -> bool {
        self.manner == Manner::Kills && self.bars_at(point)
    }
}

/// What a plant sees of its site while it grows.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// The site as it was at the end of the last tick.
    pub site: &'a Site,
    /// Of each of the plant's claims whether it is granted; empty where it claimed nothing.
    pub granted: &'a [bool],
}

impl<'a> View<'a> {
    /// A view without claims.
    pub fn of(site: &'a Site) -> Self {
        Self { site, granted: &[] }
    }
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
        Self {
            tick: 0,
            gravity: STANDARD_GRAVITY,
            wind: Wind::default(),
            obstacles: Vec::new(),
            ground: None,
            made_solids: OnceLock::new(),
            whose_stems: Whose::Nobody,
            stems: None,
            cells: Cells::default(),
            light: None,
        }
    }
}

impl Site {
    /// Opens a tick.
    pub fn begin(&mut self, tick: Tick) {
        self.tick = tick;
    }

    /// Takes the site back to tick 0.
    pub fn restart(&mut self) {
        self.tick = 0;
        self.stems = None;
        self.cells.clear();
        if let Some(light) = &mut self.light {
            (light.found, light.counted) = (None, Default::default());
        }
    }

    /// Whether growth depends on what stands around the plants, so that it must follow the clock.
    pub fn feeds_back(&self) -> bool {
        self.cells.shared || self.sees_buds() || self.light.as_ref().is_some_and(|light| light.felt)
    }

    /// Whether growth depends on where buds stand, so that plants must be posed at every tick.
    pub fn sees_buds(&self) -> bool {
        !self.obstacles.is_empty() || self.ground.is_some() || self.whose_stems != Whose::Nobody
    }

    /// Whether shoots may meet something: an obstacle that blocks, the ground or stems.
    pub fn blocks(&self) -> bool {
        self.whose_stems != Whose::Nobody || !self.solids().is_empty()
    }

    /// Whether some obstacle kills buds.
    pub fn kills(&self) -> bool {
        self.obstacles.iter().any(|obstacle| obstacle.manner == Manner::Kills)
    }

    /// Whether a bud at this point of the plot, metres, is killed by what it has reached.
    pub fn kills_at(&self, point: [f64; 3]) -> bool {
        self.obstacles.iter().any(|obstacle| obstacle.kills_at(point))
    }

    /// Whether nothing can grow at this point of the plot, metres, since an obstacle kills there or blocks the way.
    pub fn bars_at(&self, point: [f64; 3]) -> bool {
        self.obstacles.iter().any(|obstacle| obstacle.bars_at(point))
    }

    /// What shoots meet. Obstacles that are added after the first call are not among them.
    pub fn solids(&self) -> &Solids {
        self.made_solids.get_or_init(|| Arc::new(Solids::of(&self.obstacles, self.ground)))
    }

    /// The site of a plot at another place: its obstacles and its cells stand `by` metres farther.
    pub fn moved(&self, by: [f64; 3]) -> Self {
        let moved = |obstacle: &Obstacle| Obstacle { shape: Arc::new(obstacle.shape.moved(by)), ..*obstacle };
        let obstacles = self.obstacles.iter().map(moved).collect();
        let ground = self.ground.map(|height| height + by[2]);
        let light = self.light.as_ref().map(|light| light.moved(by));
        let cells = self.cells.moved(by);
        Self { obstacles, ground, cells, light, made_solids: OnceLock::new(), stems: None, ..self.clone() }
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
