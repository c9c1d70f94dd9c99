//! Where a law is asked: the variables that it may depend on, the range of each, and the grid of a compiled table.
//!
//! Words as in de Reffye et al. 1988 §3: `age` counts from the seed, `dimension` from the birth of the axis. A
//! variable that a law does not use has stride 0, so a constant is one cell. Points outside the range are clamped.
//! An axis is never older than its plant, so a point with dimension > age cannot occur; it is read as dimension = age.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

use super::MAX_CELLS;

/// The point at which a law is asked, as of the moment of the draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct At {
    /// Age of the plant: ticks since the seed, from 1.
    pub age: u32,
    /// Ticks since the birth of the axis, from 0.
    pub dimension: u32,
    /// Steps of the axis's own clock, from 0.
    pub cycle: u32,
    /// Rank of the node in its growth unit, from 1; 0 where it does not apply.
    pub rank: u32,
    /// Index of the physiological state in [`Domain::states`].
    pub state: u8,
}

/// The points at which a law can be asked: the order and the range of each variable.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Domain {
    /// Order of the axis, trunk = 1; 0 where the law is of no axis, as of what a plant draws once: no variable applies.
    pub order: u8,
    /// Last tick: age runs over 1..=until, dimension over 0..=until.
    pub until: u32,
    /// Last step of the axis's own clock, from 0.
    pub max_cycle: u32,
    /// Highest rank of a node in its growth unit, from 1; 0 where rank does not apply.
    pub max_rank: u32,
    /// Names of the physiological states; empty means one unnamed state.
    pub states: Vec<String>,
}

/// A variable that a law is a function of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Variable {
    /// Ticks since the seed, from 1.
    Age,
    /// Ticks since the birth of the axis, from 0.
    Dimension,
    /// Steps of the axis's own clock, from 0.
    Cycle,
    /// Rank of the node in its growth unit, from 1.
    Rank,
}

impl JsonSchema for Variable {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Variable".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "string",
            "enum": ["age", "dimension", "cycle", "rank"],
            "description": "A variable: `age`, ticks since the seed, from 1; `dimension`, ticks since the birth of the \
                axis, from 0; `cycle`, steps of the axis's own clock, from 0; `rank`, rank of the node in its growth \
                unit, from 1.",
        })
    }
}

/// The number of variables of a grid: the four of [`Variable`] and the state.
const AXES: usize = 5;
/// The place of the state among the variables of a grid.
const STATE: usize = 4;
const NAMES: [&str; STATE] = ["age", "dimension", "cycle", "rank"];

/// Which variables a law depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Uses([bool; AXES]);

impl Uses {
    pub fn add(&mut self, variable: Variable) {
        self.0[variable as usize] = true;
    }

    pub fn add_state(&mut self) {
        self.0[STATE] = true;
    }

    pub fn has(&self, variable: Variable) -> bool {
        self.0[variable as usize]
    }

    /// The first of the variables that the law depends on.
    pub fn first(&self) -> Option<&'static str> {
        NAMES.into_iter().zip(self.0).find_map(|(name, used)| used.then_some(name))
    }

    pub fn join(&mut self, other: Uses) {
        self.0.iter_mut().zip(other.0).for_each(|(mine, theirs)| *mine |= theirs);
    }
}

impl At {
    /// The value of `variable` at this point.
    pub fn get(&self, variable: Variable) -> u32 {
        self.all()[variable as usize]
    }

    #[inline]
    fn all(&self) -> [u32; AXES] {
        [self.age, self.dimension, self.cycle, self.rank, u32::from(self.state)]
    }

    /// "age 3, dimension 27, state adult": the variables in `uses` only; empty where there is none.
    pub(super) fn describe(&self, uses: Uses, domain: &Domain) -> String {
        let mut words: Vec<String> = (0..STATE)
            .filter(|&axis| uses.0[axis])
            .map(|axis| format!("{} {}", NAMES[axis], self.all()[axis]))
            .collect();
        if let (true, Some(state)) = (uses.0[STATE], domain.states.get(usize::from(self.state))) {
            words.push(format!("state {state}"));
        }
        words.join(", ")
    }
}

impl Domain {
    /// Where a law of no axis is asked: once, and of no variable.
    pub const ONCE: Self = Self { order: 0, until: 0, max_cycle: 0, max_rank: 0, states: Vec::new() };

    /// First and last value of `variable`.
    pub fn range(&self, variable: Variable) -> (u32, u32) {
        match variable {
            Variable::Age => (1, self.until.max(1)),
            Variable::Dimension => (0, self.until),
            Variable::Cycle => (0, self.max_cycle),
            Variable::Rank => (self.max_rank.min(1), self.max_rank),
        }
    }
}

/// The cells of a compiled table: a range and a stride for each variable.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Grid {
    first: [u32; AXES],
    span: [u32; AXES],
    stride: [u32; AXES],
    len: u32,
}

impl Grid {
    /// The grid of a constant: one cell.
    pub fn single() -> Self {
        Self { len: 1, ..Self::default() }
    }

    /// The grid over the variables in `uses`, or the number of cells where it exceeds [`MAX_CELLS`].
    pub fn over(uses: Uses, domain: &Domain) -> Result<Self, u64> {
        let mut grid = Self::single();
        let mut cells: u64 = 1;
        let ranges = [Variable::Age, Variable::Dimension, Variable::Cycle, Variable::Rank].map(|v| domain.range(v));
        let states = (0, u32::try_from(domain.states.len().saturating_sub(1)).unwrap_or(u32::MAX));
        let [age, dimension, cycle, rank] = ranges;
        // The rank runs fastest and the state slowest.
        for (axis, (first, last)) in [(3, rank), (2, cycle), (1, dimension), (0, age), (STATE, states)] {
            if !uses.0[axis] {
                continue;
            }
            grid.first[axis] = first;
            grid.span[axis] = last - first;
            grid.stride[axis] = u32::try_from(cells).unwrap_or(0);
            cells = cells.saturating_mul(u64::from(last - first) + 1);
        }
        grid.len = u32::try_from(cells).unwrap_or(0);
        if cells > MAX_CELLS { Err(cells) } else { Ok(grid) }
    }

    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// Whether the rank does not matter.
    pub fn is_rankless(&self) -> bool {
        self.stride[Variable::Rank as usize] == 0
    }

    /// Whether nothing but the state and the variables `known` matters.
    pub fn asks_only(&self, known: &[Variable]) -> bool {
        let is_known = |axis: usize| axis == STATE || known.iter().any(|&variable| variable as usize == axis);
        (0..AXES).all(|axis| self.stride[axis] == 0 || is_known(axis))
    }

    /// Whether a cell has points in a state.
    pub fn is_in(&self, cell: usize, state: u8) -> bool {
        self.stride[STATE] == 0 || self.point(cell).state == state
    }

    /// The cell of a point, clamped to the grid.
    #[inline]
    pub fn cell(&self, at: At) -> usize {
        if self.len == 1 {
            return 0;
        }
        let mut cell = 0;
        for (axis, x) in at.all().into_iter().enumerate() {
            cell += x.saturating_sub(self.first[axis]).min(self.span[axis]) * self.stride[axis];
        }
        cell as usize
    }

    /// The point of a cell. Unused variables stand at 0; a dimension above the age is lowered to it.
    pub fn point(&self, cell: usize) -> At {
        let cell = u32::try_from(cell).unwrap_or(u32::MAX);
        let value = |axis: usize| match self.stride[axis] {
            0 => 0,
            stride => self.first[axis] + cell / stride % (self.span[axis] + 1),
        };
        let (age, mut dimension) = (value(0), value(1));
        if self.stride[0] != 0 {
            dimension = dimension.min(age);
        }
        let state = u8::try_from(value(STATE)).unwrap_or(u8::MAX);
        At { age, dimension, cycle: value(2), rank: value(3), state }
    }
}
