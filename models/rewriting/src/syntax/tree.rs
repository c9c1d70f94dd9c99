//! Expressions as they are written, and what their operators do.
//!
//! A truth is 1 or 0, and every number other than 0 is true. Absent: reading expressions (`expression`), and what their
//! names mean (`compile`).

use crate::fault::Place;
use phytomer_sim::math;

/// A name and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Name {
    pub name: String,
    pub place: Place,
}

/// An expression as it is written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Expression {
    Number(f64),
    /// A text in quotation marks, which only functions without a value take.
    Text(String),
    Name(Name),
    Negative(Box<Expression>),
    Not(Box<Expression>),
    Binary(Operator, Box<(Expression, Expression)>),
    Choice(Box<(Expression, Expression, Expression)>),
    Call(Name, Vec<Expression>),
    Element(Name, Vec<Expression>),
}

/// An operator between two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Operator {
    Or,
    And,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
}

impl Operator {
    /// The value; a truth is 1 or 0.
    #[inline]
    pub fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Or => f64::from(a != 0.0 || b != 0.0),
            Self::And => f64::from(a != 0.0 && b != 0.0),
            Self::Equal => f64::from(a == b),
            Self::NotEqual => f64::from(a != b),
            Self::Less => f64::from(a < b),
            Self::LessEqual => f64::from(a <= b),
            Self::Greater => f64::from(a > b),
            Self::GreaterEqual => f64::from(a >= b),
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            // Of whole numbers, as in cpfg.
            Self::Remainder => math::fmod(a.trunc(), b.trunc()),
            Self::Power if b == 2.0 => a * a,
            Self::Power => math::pow(a, b),
        }
    }

    /// How closely it binds.
    pub(super) fn rank(self) -> u8 {
        match self {
            Self::Or => 1,
            Self::And => 2,
            Self::Equal | Self::NotEqual => 3,
            Self::Less | Self::LessEqual | Self::Greater | Self::GreaterEqual => 4,
            Self::Add | Self::Subtract => 5,
            Self::Multiply | Self::Divide | Self::Remainder => 6,
            Self::Power => 7,
        }
    }
}
