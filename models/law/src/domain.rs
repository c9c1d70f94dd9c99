//! Where a law is evaluated: the ranges of the variables that it may depend on.
//!
//! An axis is never older than its plant, so a point with dimension > age cannot occur; it is read as dimension = age.
//! What the date alone decides has no axis of its own in a table: a law that names it is a function of the age.
//! Absent: the cells of a compiled table (`grid`), what the variables mean and which laws may depend on them
//! (`variable`).

use super::steps::{HEIGHT_STEP, MOST_HEIGHT, SHADE_STEPS, height_in_steps};
use super::variable::{Asked, Variable};
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::site::calendar::Dates;

/// The point at which a law is evaluated, as of the moment of the draw.
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
    /// The tick at which the apical bud came to be.
    pub bud_birth: u32,
    /// The tick at which the apical bud came to be, in ticks since the birth of the axis.
    pub bud_dimension: u32,
    /// The growth units that the axis has made.
    pub unit: u32,
    /// The height of the plant at the end of the last tick, in steps of [`HEIGHT_STEP`].
    pub height: u32,
    /// Whether the bud meets an obstacle: 1 or 0.
    pub contact: u32,
    /// What the bud lacks of the light of open ground, in steps of [`LIGHT_STEP`](super::LIGHT_STEP): 0 in full light.
    pub shade: u32,
    /// Index of the physiological state in [`Domain::states`].
    pub state: u8,
}

/// The points at which a law can be evaluated: the order and the range of each variable.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Domain {
    /// Order of the axis, trunk = 1; 0 where the law belongs to no axis, as a quantity that a plant draws once.
    pub order: u8,
    /// Last tick: age runs over 1..=until, dimension over 0..=until.
    pub until: u32,
    /// Last step of the axis's own clock, from 0.
    pub max_cycle: u32,
    /// The most growth units that an axis can have made.
    pub max_unit: u32,
    /// Highest rank of a node in its growth unit, from 1; 0 where rank does not apply.
    pub max_rank: u32,
    /// Names of the physiological states; empty means one unnamed state.
    pub states: Vec<String>,
    /// The purpose for which laws are evaluated, which decides the variables that they may depend on.
    pub asked: Asked,
    /// The longest run that there can be.
    pub longest: Longest,
    /// The dates of the plant's ages; `None` without a calendar.
    pub dates: Option<Dates>,
    /// The value at which every variable is held, for a law of one variable whose value at a reference is asked for.
    pub held: Option<f64>,
}

/// How far variables go in the longest run that there can be. The places in a stream of words follow these limits and
/// not the length of the run at hand: otherwise the same plant would grow differently in a longer run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Longest {
    /// The most steps of an axis's own clock.
    pub max_cycle: u32,
    /// The most growth units of an axis.
    pub max_unit: u32,
    /// The highest rank; where it is above that of the domain, the ranks that occur depend on the length of the run.
    pub max_rank: u32,
    /// Whether the number of nodes of a growth unit depends on a variable that goes on with time.
    pub ranks_go_on: bool,
}

/// The number of variables of a grid: those of [`Variable`] that the date does not decide, and the state.
pub(super) const AXES: usize = 11;
/// The place of the state among the variables of a grid.
pub(super) const STATE: usize = 10;

/// Which variables a law depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Uses {
    /// The variables of the grid.
    pub(super) axes: [bool; AXES],
    /// Those of [`Variable::OF_THE_DATE`], each of which also uses the age.
    dates: [bool; Variable::OF_THE_DATE.len()],
}

impl Uses {
    pub fn add(&mut self, variable: Variable) {
        self.axes[axis_of(variable)] = true;
        if let Some(place) = place_among_dates(variable) {
            self.dates[place] = true;
        }
    }

    pub fn add_state(&mut self) {
        self.axes[STATE] = true;
    }

    pub fn has(&self, variable: Variable) -> bool {
        place_among_dates(variable).map_or_else(|| self.axes[axis_of(variable)], |place| self.dates[place])
    }

    /// The variables of the date that the law depends on.
    pub fn of_the_date(self) -> impl Iterator<Item = Variable> {
        Variable::OF_THE_DATE.into_iter().filter(move |variable| self.has(*variable))
    }

    /// The variables that the law depends on, without the state.
    pub fn variables(self) -> impl Iterator<Item = Variable> {
        Variable::ALL.into_iter().filter(move |variable| self.has(*variable))
    }

    pub fn join(&mut self, other: Uses) {
        self.axes.iter_mut().zip(other.axes).for_each(|(mine, theirs)| *mine |= theirs);
        self.dates.iter_mut().zip(other.dates).for_each(|(mine, theirs)| *mine |= theirs);
    }
}

/// The place of a variable in a grid; that of the age for those of the date.
pub(super) fn axis_of(variable: Variable) -> usize {
    (if variable.is_of_the_date() { Variable::Age } else { variable }) as usize
}

fn place_among_dates(variable: Variable) -> Option<usize> {
    Variable::OF_THE_DATE.iter().position(|known| *known == variable)
}

impl At {
    /// The value of `variable` at this point, of the height and the light their steps; of a variable of the date the
    /// age, which decides it.
    pub fn get(&self, variable: Variable) -> u32 {
        self.all()[axis_of(variable)]
    }

    /// The value of one variable, by its place in [`Self::all`].
    #[inline]
    pub(super) fn along(&self, axis: usize) -> u32 {
        match axis {
            0 => self.age,
            1 => self.dimension,
            2 => self.cycle,
            3 => self.rank,
            4 => self.bud_birth,
            5 => self.bud_dimension,
            6 => self.unit,
            7 => self.height,
            8 => self.contact,
            9 => self.shade,
            _ => self.state.into(),
        }
    }

    #[inline]
    pub(super) fn all(&self) -> [u32; AXES] {
        let (bud_birth, bud_dimension) = (self.bud_birth, self.bud_dimension);
        let (height, contact, shade, state) = (self.height, self.contact, self.shade, u32::from(self.state));
        let Self { age, dimension, cycle, rank, unit, .. } = *self;
        [age, dimension, cycle, rank, bud_birth, bud_dimension, unit, height, contact, shade, state]
    }

    /// The variables in `uses` with their values, such as "age 3, dimension 27, state adult"; empty where there are
    /// none.
    pub(super) fn describe(&self, uses: Uses, domain: &Domain) -> String {
        let shown = |variable: Variable| format!("{} {}", variable.name(), domain.read(variable, *self));
        let mut words: Vec<String> = uses.variables().map(shown).collect();
        if let (true, Some(state)) = (uses.axes[STATE], domain.states.get(usize::from(self.state))) {
            words.push(format!("state {state}"));
        }
        words.join(", ")
    }
}

impl Domain {
    /// The domain of a law that belongs to no axis: it is evaluated once and depends on no variable.
    pub const ONCE: Self = Self {
        order: 0,
        until: 0,
        max_cycle: 0,
        max_unit: 0,
        max_rank: 0,
        states: Vec::new(),
        asked: Asked::Once,
        longest: Longest { max_cycle: 0, max_unit: 0, max_rank: 0, ranks_go_on: false },
        dates: None,
        held: None,
    };

    /// The domain of a thing of an axis of `order` whose laws depend on its own age alone, from 0 to `until` ticks.
    pub fn of_own_age(order: u8, until: u32) -> Self {
        Self { order, until, max_cycle: until, asked: Asked::OwnAge, ..Self::default() }
    }

    /// First and last value of `variable`.
    pub fn range(&self, variable: Variable) -> (u32, u32) {
        match variable {
            Variable::Age => (1, self.until.max(1)),
            Variable::Dimension | Variable::BudBirth | Variable::BudDimension => (0, self.until),
            Variable::Cycle => (0, self.max_cycle),
            Variable::Rank => (self.max_rank.min(1), self.max_rank),
            Variable::Unit => (0, self.max_unit),
            Variable::HeightM => (0, MOST_HEIGHT),
            Variable::Contact => (0, 1),
            Variable::Light => (0, 1),
            _ => self.range_of_dates(variable),
        }
    }

    /// The first and the last cell of `variable` in a grid.
    pub(super) fn cells(&self, variable: Variable) -> (u32, u32) {
        match variable {
            Variable::HeightM => (0, height_in_steps(f64::from(MOST_HEIGHT))),
            Variable::Light => (0, SHADE_STEPS),
            _ => self.range(variable),
        }
    }

    /// The whole numbers between which a variable of the date stays in the run.
    fn range_of_dates(&self, variable: Variable) -> (u32, u32) {
        let values = (1..=self.until.max(1)).filter_map(|age| self.on_date(variable, age));
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        // The casts saturate.
        (low.min(high).floor() as u32, high.ceil() as u32)
    }

    /// The value of a variable at a point; not a number where it is of the date and not known.
    pub(super) fn read(&self, variable: Variable, at: At) -> f64 {
        if let Some(held) = self.held {
            return held;
        }
        match variable {
            Variable::HeightM => f64::from(at.height) * HEIGHT_STEP,
            Variable::Light => f64::from(SHADE_STEPS.saturating_sub(at.shade)) / f64::from(SHADE_STEPS),
            _ if variable.is_of_the_date() => self.on_date(variable, at.age).unwrap_or(f64::NAN),
            _ => f64::from(at.get(variable)),
        }
    }

    /// The value of a variable of the date at an age of the plant; `None` where it is not known.
    pub(super) fn on_date(&self, variable: Variable, age: u32) -> Option<f64> {
        if self.held.is_some() {
            return self.held;
        }
        let dates = self.dates.as_ref()?;
        match variable {
            Variable::Nitrogen => dates.at_age(age).nitrogen_kg_ha,
            Variable::DegreeDays => dates.degree_days_by(age),
            Variable::DegreeDaysPerDay => dates.degree_days_per_day(age),
            Variable::DayLengthH => dates.at_age(age).day_length_h,
            Variable::Date => Some(f64::from(dates.at_age(age).date.day_of_year())),
            _ => None,
        }
    }

    /// The same domain in the longest run that there can be.
    pub(super) fn in_the_longest_run(&self) -> Self {
        let Longest { max_cycle, max_unit, max_rank, .. } = self.longest;
        Self {
            until: LAST_TICK.max(self.until),
            max_cycle: max_cycle.max(self.max_cycle),
            max_unit: max_unit.max(self.max_unit),
            max_rank: max_rank.max(self.max_rank),
            ..self.clone()
        }
    }

    /// Whether a law of the variables in `uses` can have other values in a longer run.
    pub(super) fn goes_on(&self, uses: Uses) -> bool {
        uses.variables().any(|variable| variable.goes_on_with_time() || self.longest.ranks_go_on)
    }
}
