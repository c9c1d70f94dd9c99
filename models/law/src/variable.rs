//! The variables of laws: each declared once with its name, its meaning and its range, and which of them can be known
//! where a law is asked.
//!
//! In de Reffye et al. 1988 §3 the age of a bud or a node is the tick at which it was born, counted from the seed, and
//! its dimension the same tick counted from the birth of its axis, so neither moves while the bud pauses. Those are
//! `bud_birth` and `bud_dimension` here; `age` and `dimension` are read from the clock at the moment of the draw and
//! move with every tick. For a node that is being made both meanings agree, because it is born at that tick.

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
    /// The same in ticks since the birth of the axis, from 0: de Reffye's dimension of a bud.
    BudDimension,
    /// The growth units that the axis has made before the one that is being made, from 0.
    Unit,
}

impl Variable {
    /// Every variable, in the order of the lists that people see.
    pub const ALL: [Self; 7] =
        [Self::Age, Self::Dimension, Self::Cycle, Self::Rank, Self::BudBirth, Self::BudDimension, Self::Unit];

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
            Self::BudDimension => "the same counted from the birth of the axis, from 0: his dimension of a bud",
            Self::Unit => "growth units that the axis has made before this one, from 0",
        }
    }

    /// Whether it is one that moves only when the bud makes a growth unit.
    pub const fn is_of_the_bud(self) -> bool {
        matches!(self, Self::BudBirth | Self::BudDimension | Self::Unit)
    }

    /// Whether its range is longer in a longer run.
    pub const fn goes_on_with_time(self) -> bool {
        !matches!(self, Self::Rank)
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

/// What a law is asked for, and so what can be known where it is asked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Asked {
    /// An apical bud at a step of its clock, or a node that it makes: every variable, and the rank where there is a
    /// node.
    #[default]
    Bud,
    /// An axis at its birth, for what it draws once: the age of the plant and the state of the axis.
    Birth,
    /// An internode that thickens: the age of the plant, its own age as `dimension` and `cycle`, and the state in which
    /// its axis started.
    Internode,
    /// A thing that knows its own age alone, as `dimension` and `cycle`: how an organ expands and turns, what wood is.
    OwnAge,
    /// A plant, for what it draws once: nothing.
    Once,
}

impl Asked {
    /// Whether the variable is known there, in a growth unit with ranks or not.
    pub(super) fn knows(self, variable: Variable, has_ranks: bool) -> bool {
        use Variable::{Age, Cycle, Dimension, Rank};
        match self {
            Self::Bud => variable != Rank || has_ranks,
            Self::Birth => variable == Age,
            Self::Internode => matches!(variable, Age | Dimension | Cycle),
            Self::OwnAge => matches!(variable, Dimension | Cycle),
            Self::Once => false,
        }
    }

    /// Whether the state of the axis is known there.
    pub(super) fn knows_state(self) -> bool {
        matches!(self, Self::Bud | Self::Birth | Self::Internode)
    }

    /// Whether the order of the axis is known there.
    pub(super) fn knows_order(self) -> bool {
        self != Self::Once
    }

    /// The fault of a law that names `what`, which is not known there.
    pub(super) fn fault(self, what: &str, path: &Path) -> Fault {
        let (why, expected) = match self {
            Self::Bud => ("which does not apply here", "a law of age, dimension or cycle"),
            Self::Birth => (
                "which is not counted yet where this is drawn, once at the birth of the axis",
                "`age`, that of the plant at the birth of the axis",
            ),
            Self::Internode => ("which an internode does not know", "`dimension`, its own age, or `age`, the plant's"),
            Self::OwnAge if what == Variable::Age.name() => {
                ("which is the plant's age and not known here", "`dimension`, its own age in ticks")
            }
            Self::OwnAge => ("which is not known here", "`dimension`, its own age in ticks"),
            Self::Once => ("which does not apply here", "a number, or a formula without variables"),
        };
        Fault::new(path, format!("the law depends on {what}, {why}"), expected)
    }
}
