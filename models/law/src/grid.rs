//! The grid of a compiled table: which cell holds the parameters of a law at a point.
//!
//! A variable that a law does not use has stride 0, so a constant is one cell. Points outside the range are clamped.
//! Absent: the ranges of the variables (`domain`).

use super::MAX_CELLS;
use super::domain::{AXES, At, Domain, STATE, Uses, axis_of};
use super::variable::Variable;
use super::varies::Varies;

/// The place of the first of the variables that few laws name: those of the bud, the height of the plant, contact and
/// the light.
const RARE: usize = 4;

/// The cells of a compiled table: a range and a stride for each variable.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Grid {
    first: [u32; AXES],
    span: [u32; AXES],
    stride: [u32; AXES],
    len: u32,
    /// Whether one of its variables moves only when the bud makes a growth unit.
    asks_the_bud: bool,
    /// Whether one of its variables is among those that few laws name.
    asks_rare: bool,
    /// Its variables, where they are but one or two.
    few: Few,
}

/// The variables of a grid that has few of them, by their places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Few {
    #[default]
    No,
    One(usize),
    Two(usize, usize),
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
        let states = (0, u32::try_from(domain.states.len().saturating_sub(1)).unwrap_or(u32::MAX));
        // The rank runs fastest and the state slowest.
        use Variable::{Age, BudBirth, BudDimension, Contact, Cycle, Dimension, HeightM, Light, Rank, Unit};
        let of_time = [Rank, Contact, Light, HeightM, Cycle, Unit, BudDimension, Dimension, BudBirth, Age];
        let ranges = of_time.map(|variable| (axis_of(variable), domain.cells(variable)));
        for (axis, (first, last)) in ranges.into_iter().chain([(STATE, states)]) {
            if !uses.axes[axis] {
                continue;
            }
            grid.first[axis] = first;
            grid.span[axis] = last - first;
            grid.stride[axis] = u32::try_from(cells).unwrap_or(0);
            cells = cells.saturating_mul(u64::from(last - first) + 1);
        }
        grid.len = u32::try_from(cells).unwrap_or(0);
        grid.asks_the_bud = uses.variables().any(Variable::is_of_the_bud);
        grid.asks_rare = (RARE..STATE).any(|axis| uses.axes[axis]);
        let mut used = (0..AXES).filter(|axis| uses.axes[*axis]);
        grid.few = match [(); 3].map(|()| used.next()) {
            [Some(only), None, _] => Few::One(only),
            [Some(one), Some(other), None] => Few::Two(one, other),
            _ => Few::No,
        };
        if cells > MAX_CELLS { Err(cells) } else { Ok(grid) }
    }

    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// Whether one of its variables moves only when the bud makes a growth unit.
    pub fn asks_the_bud(&self) -> bool {
        self.asks_the_bud
    }

    /// Whether one of its variables is the height of the plant.
    pub fn asks_height(&self) -> bool {
        self.stride[Variable::HeightM as usize] != 0
    }

    /// Whether one of its variables is the light of the bud.
    pub fn asks_light(&self) -> bool {
        self.stride[Variable::Light as usize] != 0
    }

    /// Whether the rank does not matter.
    pub fn is_rankless(&self) -> bool {
        self.stride[Variable::Rank as usize] == 0
    }

    /// Its one variable, if any, and the first value of it; `None` where there are more, or the state is among them.
    pub fn only_variable(&self) -> Option<(Option<Variable>, u32)> {
        match (self.len, self.few) {
            (1, _) => Some((None, 0)),
            (_, Few::One(axis)) => {
                let variable = Variable::ALL.into_iter().find(|variable| axis_of(*variable) == axis)?;
                (axis != STATE).then_some((Some(variable), self.first[axis]))
            }
            _ => None,
        }
    }

    /// How often the cell can change along the nodes of an axis.
    pub fn varies(&self) -> Varies {
        match (self.len, self.is_rankless()) {
            (1, _) => Varies::Never,
            (_, true) => Varies::ByUnit,
            (_, false) => Varies::ByNode,
        }
    }

    /// Whether the cells differ by the state and the variables `known` at most.
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
        self.cell_at(&at)
    }

    /// As [`Self::cell`], of a point that stays where it is.
    #[inline(always)]
    pub fn cell_at(&self, at: &At) -> usize {
        match (self.len, self.few) {
            (1, _) => 0,
            (_, Few::One(axis)) => self.cells_along(axis, at) as usize,
            (_, Few::Two(one, other)) => (self.cells_along(one, at) + self.cells_along(other, at)) as usize,
            (_, Few::No) => self.cell_among(at),
        }
    }

    /// How many cells lie before those of a point along one of the variables.
    #[inline(always)]
    fn cells_along(&self, axis: usize, at: &At) -> u32 {
        at.along(axis).saturating_sub(self.first[axis]).min(self.span[axis]) * self.stride[axis]
    }

    fn cell_among(&self, at: &At) -> usize {
        let at = at.all();
        let along = |axis: usize| at[axis].saturating_sub(self.first[axis]).min(self.span[axis]) * self.stride[axis];
        let mut cell = along(STATE);
        (0..RARE).for_each(|axis| cell += along(axis));
        if self.asks_rare {
            (RARE..STATE).for_each(|axis| cell += along(axis));
        }
        cell as usize
    }

    /// The point of a cell. Unused variables are 0. A point that cannot occur is moved to one that can: an axis and its
    /// bud are not older than the plant, nor the bud than its axis.
    pub fn point(&self, cell: usize) -> At {
        let cell = u32::try_from(cell).unwrap_or(u32::MAX);
        let value = |axis: usize| match self.stride[axis] {
            0 => 0,
            stride => self.first[axis] + cell / stride % (self.span[axis] + 1),
        };
        let used = |variable: Variable| self.stride[variable as usize] != 0;
        let [age, mut dimension, cycle, rank, mut bud_birth, mut bud_dimension, unit, height, contact, shade, state] =
            std::array::from_fn(value);
        if used(Variable::Age) {
            dimension = dimension.min(age);
            bud_birth = bud_birth.min(age);
            if used(Variable::Dimension) && used(Variable::BudBirth) {
                bud_birth = bud_birth.max(age - dimension);
            }
        }
        if used(Variable::Dimension) {
            bud_dimension = bud_dimension.min(dimension);
        }
        if used(Variable::BudBirth) {
            bud_dimension = bud_dimension.min(bud_birth);
        }
        let state = u8::try_from(state).unwrap_or(u8::MAX);
        At { age, dimension, cycle, rank, bud_birth, bud_dimension, unit, height, contact, shade, state }
    }
}
