//! Ulam's branching patterns (Ulam 1962, "On some mathematical problems connected with patterns of growth of figures";
//! ABOP ch. 2): one cell is coloured at each tick for each that a coloured cell alone faces.
//!
//! ABOP colours the cells that touch one and only one vertex of a cell coloured before. Read literally this stops at
//! ten cells, since the three that meet at a corner touch one another. Here, as in Ulam's figures, a cell is coloured
//! if of the cells that face it (the ones opposite at its corners, or beyond its edges) exactly one is coloured. Each
//! cell is an internode that ends in its middle. The axis of a cell goes straight on in a grid of squares; in one of
//! triangles, where growth turns by 60° at each cell, the turn that undoes the last one continues the axis. The other
//! cells begin axes of the next order. Absent: patterns in space, and patterns that meet: each has a
//! grid of its own, from its seed.

use super::body::{Segment, Tip, branch, habit, keep_diameters, lengthen};
use super::grid::{Cell, Tiling};
use super::stated::{DIAMETER, assumed_diameter};
use crate::fault::{Fault, Path};
use crate::law::{Constant, ValueRange};
use phytomer_sim::clock::{LAST_TICK, Tick};
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{Habit, NewAxis, Plant, Seed};
use phytomer_sim::site::{Site, View};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::sync::Arc;

const SIZE: ValueRange = ValueRange { min: 1e-6, max: 1000.0, what: "a length in m" };

/// The most components of a pattern that is foretold by growing it.
const MOST_FORETOLD: u32 = 300_000;

/// A branching pattern on a plane grid: at each tick every cell is coloured that exactly one coloured cell faces.
///
/// Age 1 shows the first cell, and age a the a-th generation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ulam {
    /// The cells of the grid.
    pub grid: Grid,
    /// The plane of the grid; upright if not given.
    #[serde(default)]
    pub plane: Plane,
    /// The edge of a cell, metres.
    #[schemars(with = "Constant", extend("minimum" = 0.000_001, "maximum" = 1000))]
    pub cell_m: Constant,
    /// The height of the middle of the first cell above the seed, metres: the length of the first internode. The
    /// distance between two cells if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("minimum" = 0.000_001, "maximum" = 1000))]
    pub stem_m: Option<Constant>,
    /// The diameter of an internode, millimetres; 10 (assumed) if not given.
    #[serde(default = "assumed_diameter")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1_000_000))]
    pub diameter_mm: Constant,
}

/// The cells of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Grid {
    /// Triangles with equal edges; cells face one another at corners.
    Triangles,
    /// Squares; cells face one another at edges.
    Squares,
}

/// The plane of a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Plane {
    /// The plane of x and z.
    #[default]
    Upright,
    /// The plane of x and y, at the height of the first cell.
    Level,
}

impl Ulam {
    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<UlamModel, Vec<Fault>> {
        let mut faults = Vec::new();
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        let mut read = |number: &Constant, key: &str, range: ValueRange| {
            number.within(&path.key(key), range).map_err(|fault| faults.push(fault)).unwrap_or_default()
        };
        let tiling = match self.grid {
            Grid::Triangles => Tiling::Triangles,
            Grid::Squares => Tiling::Squares,
        };
        let step = tiling.step() * read(&self.cell_m, "cell_m", SIZE);
        let stem = self.stem_m.as_ref().map_or(step, |stem| read(stem, "stem_m", SIZE));
        let diameter = read(&self.diameter_mm, "diameter_mm", DIAMETER) / 1000.0;
        let model = UlamModel { tiling, plane: self.plane, step, stem, diameter, habit: Arc::new(habit()) };
        if faults.is_empty() { Ok(model) } else { Err(faults) }
    }
}

/// Ulam's model, checked and compiled.
#[derive(Debug, Clone)]
pub struct UlamModel {
    tiling: Tiling,
    plane: Plane,
    /// The distance between two cells, metres.
    step: f64,
    stem: f64,
    diameter: f64,
    habit: Arc<Habit>,
}

/// The coloured cells of one plant, and those of the last tick.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pattern {
    coloured: BTreeSet<Cell>,
    last: Vec<Front>,
}

/// A cell of the last tick.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Front {
    cell: Cell,
    tip: Tip,
    /// The direction in which it was reached; `None` of the first.
    came: Option<u8>,
    /// The direction that continues the axis.
    onward: u8,
}

impl UlamModel {
    fn heading(&self, direction: u8) -> [f64; 3] {
        let [x, y] = self.tiling.vector(direction);
        match self.plane {
            Plane::Upright => [x, 0.0, y],
            Plane::Level => [x, y, 0.0],
        }
    }

    fn segment(&self, heading: [f64; 3], length: f64, birth: Tick) -> Segment {
        Segment { heading, length, diameter: self.diameter, birth }
    }

    /// The direction that continues an axis which came by `came` and then turned to `next`.
    fn after(&self, came: Option<u8>, next: u8) -> u8 {
        match (self.tiling, came) {
            // Undoes the turn: in the long run the axis is straight.
            (Tiling::Triangles, Some(came)) => came,
            (Tiling::Triangles, None) => (next + 1) % 6,
            (Tiling::Squares, _) => next,
        }
    }

    fn first_cell(&self, plant: &mut Plant, pattern: &mut Pattern, birth: Tick) -> Result<(), Overgrown> {
        let tip = lengthen(plant, &Tip::SEED, &self.segment([0.0, 0.0, 1.0], self.stem, birth))?;
        let cell = [0, 0, 0];
        pattern.coloured.insert(cell);
        pattern.last.push(Front { cell, tip, came: None, onward: self.tiling.around(cell)[0] });
        Ok(())
    }

    /// Colours the cells of a tick. Each of them is faced by one cell alone, so no two cells of the last tick colour
    /// the same.
    fn generation(&self, plant: &mut Plant, pattern: &mut Pattern, birth: Tick) -> Result<(), Overgrown> {
        let Pattern { coloured, last } = pattern;
        let faces_one = |cell: Cell| {
            let coloured = |direction: &&u8| coloured.contains(&self.tiling.facing(cell, **direction));
            self.tiling.around(cell).iter().filter(coloured).count() == 1
        };
        let mut new = Vec::new();
        for front in last.iter() {
            for (position, &direction) in (0..).zip(self.tiling.around(front.cell)) {
                let cell = self.tiling.facing(front.cell, direction);
                if coloured.contains(&cell) || !faces_one(cell) {
                    continue;
                }
                let segment = self.segment(self.heading(direction), self.step, birth);
                let tip = if direction == front.onward {
                    lengthen(plant, &front.tip, &segment)?
                } else {
                    branch(plant, &front.tip, position, &segment)?
                };
                let onward = self.after(front.came, direction);
                new.push(Front { cell, tip, came: Some(direction), onward });
            }
        }
        coloured.extend(new.iter().map(|front| front.cell));
        *last = new;
        Ok(())
    }
}

impl Grow for UlamModel {
    type Life = Pattern;

    fn growth(&self) -> Growth {
        Growth::Rebuilds
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) -> Pattern {
        plant.add_axis(NewAxis::OF_THE_SEED);
        Pattern::default()
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Pattern, _: &View<'_>) -> Result<(), Overgrown> {
        if age < plant.age {
            plant.clear();
            *life = self.sow(plant);
        }
        for tick in plant.age + 1..=age {
            if life.coloured.is_empty() {
                self.first_cell(plant, life, tick)?;
            } else {
                self.generation(plant, life, tick)?;
            }
        }
        plant.age = age;
        Ok(())
    }

    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        keep_diameters(plant);
    }

    /// Nothing is random here, so these are the numbers of a plant; none where it is large.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        let limit = MOST_FORETOLD;
        let seed = Seed { plant: 0, draws: 0, run_seed: 0, component_limit: limit, keep_events: false };
        let mut plant = Plant::new(&seed, self.habit());
        let mut life = self.sow(&mut plant);
        self.grow_to(until, &mut plant, &mut life, &View::of(&Site::default())).ok()?;
        let last = plant.axes.order.iter().copied().max().unwrap_or(1);
        let mut orders: Vec<OrderExpectation> = (0..last).map(|_| OrderExpectation::zero(until)).collect();
        for axis in 0..plant.axes.len() {
            orders[usize::from(plant.axes.order[axis]) - 1].axes[plant.axes.appearance[axis] as usize] += 1.0;
        }
        for node in 0..plant.nodes.len() {
            let order = &mut orders[usize::from(plant.axes.order[plant.nodes.axis[node].index()]) - 1];
            order.nodes[plant.nodes.birth[node] as usize] += 1.0;
            order.units[plant.nodes.birth[node] as usize] += 1.0;
        }
        orders.iter_mut().for_each(OrderExpectation::accumulate);
        Some(Expectation { orders, axes: Certainty::Exact, organs: Certainty::Exact })
    }
}
