//! The variables of laws: each is declared once with its name, its meaning and its range, and the purposes for which a
//! law that names it can be evaluated.
//!
//! In de Reffye et al. 1988 §3 the age of a bud or a node is the tick at which it was born, counted from the seed, and
//! its dimension the same tick counted from the birth of its axis, so neither moves while the bud pauses. These two are
//! `bud_birth` and `bud_dimension` here; `age` and `dimension` are read from the clock at the moment of the draw and
//! move with every tick. For a node that is being made both meanings agree, because it is born at that tick.
//!
//! `nitrogen`, `degree_days`, `degree_days_per_day`, `day_length_h` and `date` are known where the scenario has a
//! calendar that tells them, at the tick of the draw (`dates`). Where a law names `height_m`, or
//! `light` in a scenario with `[light]`, growth goes tick by tick.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

use crate::fault::{Fault, Path};

/// A variable that a law is a function of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Variable {
    /// Ticks since the seed, from 1.
    Age,
    /// Ticks since the birth of the axis, from 0.
    Dimension,
    /// Steps of the axis's own clock, from 0.
    Cycle,
    /// Rank of the node in its growth unit, from 1.
    Rank,
    /// The tick at which the apical bud came to be, from 0: de Reffye's age of a bud (1988 §3). A growth unit leaves a
    /// new bud at its tip; before its first, an axis has the bud that it was born with.
    BudBirth,
    /// The tick at which the apical bud came to be, counted from the birth of the axis, from 0: de Reffye's dimension
    /// of a bud.
    BudDimension,
    /// The growth units that the axis has made before the one that is being made, from 0.
    Unit,
    /// The height of the plant at the end of the last tick, metres.
    HeightM,
    /// Whether the bud meets an obstacle at this step: 1 or 0.
    Contact,
    /// The share of the light of open ground that reached the bud at the end of the last tick, from 0 to 1.
    Light,
    /// The nitrogen of the season, kg/ha: the soil's own supply and what was applied since the season began.
    Nitrogen,
    /// Degree-days since the plant was sown, °C d.
    DegreeDays,
    /// Degree-days a day in the tick, °C d/d: how warm its days were, above the base.
    DegreeDaysPerDay,
    /// Hours from sunrise to sunset.
    DayLengthH,
    /// The day of the year, from 1 (1 January).
    Date,
}

impl Variable {
    /// Every variable, in the order of the lists that people see.
    pub const ALL: [Self; 15] = [
        Self::Age,
        Self::Dimension,
        Self::Cycle,
        Self::Rank,
        Self::BudBirth,
        Self::BudDimension,
        Self::Unit,
        Self::HeightM,
        Self::Contact,
        Self::Light,
        Self::Nitrogen,
        Self::DegreeDays,
        Self::DegreeDaysPerDay,
        Self::DayLengthH,
        Self::Date,
    ];

    /// The variables that the date alone decides.
    pub const OF_THE_DATE: [Self; 5] =
        [Self::Nitrogen, Self::DegreeDays, Self::DegreeDaysPerDay, Self::DayLengthH, Self::Date];

    /// The name in files and expressions.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Age => "age",
            Self::Dimension => "dimension",
            Self::Cycle => "cycle",
            Self::Rank => "rank",
            Self::BudBirth => "bud_birth",
            Self::BudDimension => "bud_dimension",
            Self::Unit => "unit",
            Self::HeightM => "height_m",
            Self::Contact => "contact",
            Self::Light => "light",
            Self::Nitrogen => "nitrogen",
            Self::DegreeDays => "degree_days",
            Self::DegreeDaysPerDay => "degree_days_per_day",
            Self::DayLengthH => "day_length_h",
            Self::Date => "date",
        }
    }

    /// What it counts and from where, for people.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Age => {
                "ticks since the seed, from 1; it moves while the bud pauses, as de Reffye's age of a bud does not"
            }
            Self::Dimension => "ticks since the birth of the axis, from 0; it moves while the bud pauses",
            Self::Cycle => "steps of the axis's own clock, from 0; pauses are steps too",
            Self::Rank => "rank of the node in its growth unit, from 1",
            Self::BudBirth => {
                "the tick at which the apical bud came to be, with the last growth unit of its axis or at the birth of the \
                 axis: the age of a bud in de Reffye 1988 §3"
            }
            Self::BudDimension => {
                "the tick at which the apical bud came to be, counted from the birth of the axis, from 0: the dimension of \
                 a bud in de Reffye 1988 §3"
            }
            Self::Unit => "growth units that the axis has made before this one, from 0",
            Self::HeightM => {
                "the height of the plant at the end of the last tick, metres, in steps of 5 cm: that of the highest tip of \
                 an internode above the seed"
            }
            Self::Contact => {
                "1 where the bud meets an obstacle or the ground within the cone that its species states, else 0"
            }
            Self::Light => {
                "the share of the light of open ground that reached the bud at the end of the last tick, from 0 to 1, in \
                 steps of 0.01; 1 where the scenario has no `[light]`"
            }
            Self::Nitrogen => {
                "the nitrogen of the season, kg/ha: the soil's own supply and what was applied since the season began"
            }
            Self::DegreeDays => "degree-days since the plant was sown, °C d",
            Self::DegreeDaysPerDay => "degree-days a day in the tick, °C d/d: how warm its days were, above the base",
            Self::DayLengthH => "hours from sunrise to sunset on the date, from 0 to 24",
            Self::Date => "the day of the year, from 1 (1 January) to 366",
        }
    }

    /// The least and the largest value that a variable of the date can have in any scenario; `None` for the others.
    pub const fn bounds(self) -> Option<(f64, f64)> {
        match self {
            Self::Nitrogen => Some((0.0, 100_000.0)),
            Self::DegreeDays => Some((0.0, 1e9)),
            Self::DegreeDaysPerDay => Some((0.0, 200.0)),
            Self::DayLengthH => Some((0.0, 24.0)),
            Self::Date => Some((1.0, 366.0)),
            _ => None,
        }
    }

    /// Whether the date alone decides the variable, so that it is a function of the age of the plant.
    pub const fn is_of_the_date(self) -> bool {
        self.bounds().is_some()
    }

    /// Whether the variable moves only when the bud makes a growth unit.
    pub const fn is_of_the_bud(self) -> bool {
        matches!(self, Self::BudBirth | Self::BudDimension | Self::Unit)
    }

    /// Whether the range of the variable is longer in a longer run.
    pub const fn goes_on_with_time(self) -> bool {
        !matches!(self, Self::Rank | Self::Contact | Self::Light)
    }
}

impl JsonSchema for Variable {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Variable".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let meanings = Self::ALL.map(|variable| format!("`{}`, {}", variable.name(), variable.meaning()));
        json_schema!({
            "type": "string",
            "enum": Self::ALL.map(Self::name),
            "description": format!("A variable: {}.", meanings.join("; ")),
        })
    }
}

/// The purpose for which a law is evaluated, which decides the variables that it may depend on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Asked {
    /// For an apical bud at a step of its clock, or a node that it makes: every variable, and the rank where there is a
    /// node.
    #[default]
    Bud,
    /// For an axis at its birth, for quantities that it draws once: the age of the plant and the state of the axis.
    Birth,
    /// For an internode that thickens: the age of the plant, its own age as `dimension` and `cycle`, and the state in
    /// which its axis started.
    Internode,
    /// For a thing whose laws depend on its own age alone, as `dimension` and `cycle`: how an organ expands and turns,
    /// the stiffness and density of wood.
    OwnAge,
    /// For a response of the buds of a plant to what the site brings: the age of the plant, which decides the date, or
    /// the light of the bud.
    Response,
    /// For a plant, for quantities that it draws once: no variable.
    Once,
}

impl Asked {
    /// Whether a law for this purpose may depend on `variable`; `has_ranks` tells whether nodes have ranks there.
    pub(super) fn knows(self, variable: Variable, has_ranks: bool) -> bool {
        use Variable::{Age, Cycle, Dimension, Light, Rank};
        match self {
            _ if variable.is_of_the_date() => self.knows(Age, has_ranks),
            Self::Bud => variable != Rank || has_ranks,
            Self::Birth => variable == Age,
            Self::Response => matches!(variable, Age | Light),
            Self::Internode => matches!(variable, Age | Dimension | Cycle),
            Self::OwnAge => matches!(variable, Dimension | Cycle),
            Self::Once => false,
        }
    }

    /// Whether a law for this purpose may depend on the state of the axis.
    pub(super) fn knows_state(self) -> bool {
        matches!(self, Self::Bud | Self::Birth | Self::Internode)
    }

    /// Whether a law for this purpose may depend on the order of the axis.
    pub(super) fn knows_order(self) -> bool {
        self != Self::Once
    }

    /// The fault of a law that names `what` and may not depend on it for this purpose.
    pub(super) fn fault(self, what: &str, path: &Path) -> Fault {
        let (why, expected) = match self {
            Self::Bud => ("which does not apply here", "a law of age, dimension or cycle"),
            Self::Birth => (
                "which is not counted yet where this is drawn, once at the birth of the axis",
                "`age`, that of the plant at the birth of the axis",
            ),
            Self::Internode => {
                ("which is not known of an internode", "`dimension`, its own age, or `age`, the plant's")
            }
            Self::OwnAge if what == Variable::Age.name() => {
                ("which is the plant's age and not known here", "`dimension`, its own age in ticks")
            }
            Self::OwnAge => ("which is not known here", "`dimension`, its own age in ticks"),
            Self::Response => ("on which no response can depend", "a variable of the date, `light`, or `age`"),
            Self::Once => ("which does not apply here", "a number, or a formula without variables"),
        };
        Fault::new(path, format!("the law depends on {what}, {why}"), expected)
    }
}
