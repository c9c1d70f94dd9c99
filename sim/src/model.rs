//! What a growth model is to the loop: a checked, immutable species that sows plants and grows each to an age.
//!
//! What a model remembers of a plant between ticks (living buds, a string of modules, stems) is the plant's [`Life`].
//! It belongs to the model, is boxed once a plant and stands beside the plant, which knows nothing of it. A model is
//! written by its own type of life ([`Grow`]); the loop and everything above it see a [`GrowthModel`], in which that
//! type is erased. Both are called once a tick and plant, never once a node. Absent: parameters, species and files.

use crate::cells::Claims;
use crate::clock::Tick;
use crate::expectation::Expectation;
use crate::gusts::{Gusts, Swing};
use crate::plant::{Habit, Plant};
use crate::site::{Site, View};
use std::any::Any;
use std::fmt::{self, Debug};
use std::sync::Arc;

/// How a model goes from one age to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Growth {
    /// It adds to the plant that stands there (buds); many ticks at once, or tick by tick, with the same result.
    Extends,
    /// It makes the plant anew at any age, directly (geometric and parametric models).
    Rebuilds,
    /// It takes its own state from tick to tick and writes the plant anew from it (L-systems). What it puts between two
    /// nodes of an axis is numbered after both; a component keeps its number.
    Rewrites,
}

impl Growth {
    /// Whether a plant grown to an age can be read at every age before, so that growth may run ahead. Else the plant is
    /// grown to each age at which something looks at it.
    pub fn keeps_its_past(self) -> bool {
        self == Self::Extends
    }
}

/// A plant cannot be grown on: it came to its limit of components, or its model came to a stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Overgrown {
    /// The plant's number in the run.
    pub plant: u32,
    /// The limit.
    pub limit: u32,
    /// Why its model came to a stop; `None` where the plant came to its limit.
    pub stopped: Option<Arc<str>>,
}

impl Overgrown {
    /// A plant came to its limit.
    pub fn of(plant: &Plant) -> Self {
        Self { plant: plant.id, limit: plant.component_limit(), stopped: None }
    }

    /// The model of a plant came to a stop, for this reason.
    pub fn stopped(plant: &Plant, why: &str) -> Self {
        Self { stopped: Some(why.into()), ..Self::of(plant) }
    }
}

impl fmt::Display for Overgrown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.stopped {
            Some(why) => write!(f, "plant {} came to a stop: {why}", self.plant),
            None => write!(f, "plant {} came to its limit of {} components", self.plant, self.limit),
        }
    }
}

impl std::error::Error for Overgrown {}

/// A growth model with its parameters, compiled and checked: what the author of a model writes.
///
/// The growth of a plant may depend on the plant, its life and the view of the site, on nothing else: plants of a plot
/// grow side by side in any order. Draws are keyed (`Plant::random`).
pub trait Grow: Send + Sync {
    /// What the model remembers of one plant between ticks; `()` where the plant itself tells everything.
    type Life: Clone + Debug + PartialEq + Send + Sync + 'static;

    /// How it goes from one age to the next.
    fn growth(&self) -> Growth;

    /// What its plants carry of their species.
    fn habit(&self) -> Arc<Habit>;

    /// Puts the first axis into an empty plant, at its age 0; the plant's life.
    fn sow(&self, plant: &mut Plant) -> Self::Life;

    /// Puts the first axis into a plant that is empty again, with the same result as [`Grow::sow`]; a model may use the
    /// memory of the life before again.
    fn sow_again(&self, plant: &mut Plant, life: &mut Self::Life) {
        *life = self.sow(plant);
    }

    /// Grows a plant from its age to `age`: topology, rest geometry, fates of buds and organs.
    ///
    /// # Errors
    /// [`Overgrown`] where the plant would pass its limit of components; it then holds part of its growth.
    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Self::Life, view: &View<'_>) -> Result<(), Overgrown>;

    /// Whether growth depends on the height of the plant at the end of the last tick ([`Plant::height`]). The plant
    /// then grows tick by tick, and stands at each.
    fn sees_height(&self) -> bool {
        false
    }

    /// Whether growth depends on the light of buds at the end of the last tick ([`Plant::shade`]). In a site that tells
    /// it the plant then grows tick by tick, and stands at each.
    fn sees_light(&self) -> bool {
        false
    }

    /// Writes the diameters of each internode as they are at `age`, by the model's law; where the species states
    /// another rule of secondary growth, the loop applies that one after it.
    fn thicken(&self, age: Tick, plant: &mut Plant);

    /// The edge of the cells of space that its plants claim from the others of their plot, metres; `None` where they
    /// claim none.
    fn cell_m(&self) -> Option<f64> {
        None
    }

    /// Claims the cells of space that the plant wants at the next tick, before any plant of the plot grows, and may
    /// remember what for; what is granted stands in the view of that tick. Asked only where the site shares cells:
    /// there plants grow tick by tick.
    fn claim(&self, plant: &Plant, life: &mut Self::Life, site: &Site, claims: &mut Claims) {
        let _ = (plant, life, site, claims);
    }

    /// Answers the cuts that were made at the plant's age `age`, of which [`Plant::stumps`] tells the ends, before the
    /// plant grows to that age: what a cut releases appears at `age`. Nothing grows from a cut where a model says
    /// nothing.
    ///
    /// # Errors
    /// [`Overgrown`], as [`Grow::grow_to`].
    fn answer_cuts(&self, age: Tick, plant: &mut Plant, life: &mut Self::Life) -> Result<(), Overgrown> {
        let _ = (age, plant, life);
        Ok(())
    }

    /// Whether its plants sway by a law of the model's own; else mechanics move them.
    fn sways(&self) -> bool {
        false
    }

    /// How each axis of a grown plant sways by the law of the model, one entry an axis; empty where it has none.
    fn swings(&self, plant: &Plant) -> Vec<Swing> {
        let _ = plant;
        Vec::new()
    }

    /// Turns the rest frames of a grown plant to those in these gusts, by the law of the model; the plant is then to be
    /// posed. Air at rest changes nothing.
    fn sway(&self, plant: &mut Plant, gusts: &Gusts) {
        let _ = (plant, gusts);
    }

    /// The means of what a plant makes up to `until`, or bounds or estimates of them, as it says; `None` where the
    /// model has none.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        let _ = until;
        None
    }
}

/// A growth model whose type of life is erased; every [`Grow`] is one. The methods are those of [`Grow`].
#[expect(missing_docs, reason = "the methods are described in Grow")]
pub trait GrowthModel: Send + Sync {
    fn growth(&self) -> Growth;
    fn habit(&self) -> Arc<Habit>;
    fn sow(&self, plant: &mut Plant) -> Life;

    /// As [`Grow::sow_again`].
    ///
    /// # Panics
    /// Where `life` is that of another model's plant.
    fn sow_again(&self, plant: &mut Plant, life: &mut Life);

    /// As [`Grow::grow_to`].
    ///
    /// # Errors
    /// As there.
    ///
    /// # Panics
    /// Where `life` is that of another model's plant.
    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Life, view: &View<'_>) -> Result<(), Overgrown>;

    fn sees_height(&self) -> bool;

    fn sees_light(&self) -> bool;

    fn thicken(&self, age: Tick, plant: &mut Plant);

    fn cell_m(&self) -> Option<f64>;

    /// As [`Grow::claim`].
    ///
    /// # Panics
    /// Where `life` is that of another model's plant.
    fn claim(&self, plant: &Plant, life: &mut Life, site: &Site, claims: &mut Claims);

    /// As [`Grow::answer_cuts`].
    ///
    /// # Errors
    /// As there.
    ///
    /// # Panics
    /// Where `life` is that of another model's plant.
    fn answer_cuts(&self, age: Tick, plant: &mut Plant, life: &mut Life) -> Result<(), Overgrown>;

    fn sways(&self) -> bool;

    fn swings(&self, plant: &Plant) -> Vec<Swing>;

    fn sway(&self, plant: &mut Plant, gusts: &Gusts);

    fn expectation(&self, until: Tick) -> Option<Expectation>;
}

impl<M: Grow> GrowthModel for M {
    fn growth(&self) -> Growth {
        Grow::growth(self)
    }

    fn habit(&self) -> Arc<Habit> {
        Grow::habit(self)
    }

    fn sow(&self, plant: &mut Plant) -> Life {
        Life::of(Grow::sow(self, plant))
    }

    fn sow_again(&self, plant: &mut Plant, life: &mut Life) {
        Grow::sow_again(self, plant, life.get_mut());
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Life, view: &View<'_>) -> Result<(), Overgrown> {
        Grow::grow_to(self, age, plant, life.get_mut(), view)
    }

    fn sees_height(&self) -> bool {
        Grow::sees_height(self)
    }

    fn sees_light(&self) -> bool {
        Grow::sees_light(self)
    }

    fn thicken(&self, age: Tick, plant: &mut Plant) {
        Grow::thicken(self, age, plant);
    }

    fn cell_m(&self) -> Option<f64> {
        Grow::cell_m(self)
    }

    fn claim(&self, plant: &Plant, life: &mut Life, site: &Site, claims: &mut Claims) {
        Grow::claim(self, plant, life.get_mut(), site, claims);
    }

    fn answer_cuts(&self, age: Tick, plant: &mut Plant, life: &mut Life) -> Result<(), Overgrown> {
        Grow::answer_cuts(self, age, plant, life.get_mut())
    }

    fn sways(&self) -> bool {
        Grow::sways(self)
    }

    fn swings(&self, plant: &Plant) -> Vec<Swing> {
        Grow::swings(self, plant)
    }

    fn sway(&self, plant: &mut Plant, gusts: &Gusts) {
        Grow::sway(self, plant, gusts);
    }

    fn expectation(&self, until: Tick) -> Option<Expectation> {
        Grow::expectation(self, until)
    }
}

/// What a model remembers of one plant, with its type erased: two pointers a plant.
#[derive(Debug)]
pub struct Life(Box<dyn Remembered>);

/// What the erased life must still be able to do.
trait Remembered: Any + Debug + Send + Sync {
    fn boxed(&self) -> Box<dyn Remembered>;
    fn equals(&self, other: &dyn Any) -> bool;
    fn as_any(&self) -> &dyn Any;
    fn as_any_mut(&mut self) -> &mut dyn Any;
}

impl<T: Clone + Debug + PartialEq + Send + Sync + 'static> Remembered for T {
    fn boxed(&self) -> Box<dyn Remembered> {
        Box::new(self.clone())
    }

    fn equals(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<T>() == Some(self)
    }

    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }
}

impl Life {
    /// Erases the type of a life.
    pub fn of<T: Clone + Debug + PartialEq + Send + Sync + 'static>(life: T) -> Self {
        Self(Box::new(life))
    }

    /// The life by its type.
    ///
    /// # Panics
    /// Where it is of another type: the plant was sown by another model.
    pub fn get<T: 'static>(&self) -> &T {
        (*self.0).as_any().downcast_ref().expect("a plant is grown by the model that sowed it")
    }

    /// The life by its type, to be changed.
    ///
    /// # Panics
    /// As [`Life::get`].
    pub fn get_mut<T: 'static>(&mut self) -> &mut T {
        (*self.0).as_any_mut().downcast_mut().expect("a plant is grown by the model that sowed it")
    }
}

impl Clone for Life {
    fn clone(&self) -> Self {
        Self((*self.0).boxed())
    }
}

impl PartialEq for Life {
    fn eq(&self, other: &Self) -> bool {
        (*self.0).equals((*other.0).as_any())
    }
}
