//! Free expressions, for the "arbitrary, strange" laws of de Reffye et al. 1988 §4: the parsed form and its evaluation.
//!
//! The parser emits postfix code, so evaluation and dropping need no recursion, and an expression can do nothing but
//! these operations. The names that an expression may use are a vocabulary of its own: the variables of laws here, the
//! columns of plants and wood in conditions (`condition`). min and max return NaN where an operand is NaN, so that a
//! logarithm of a negative number is found at the check.

use phytomer_sim::math;

use super::domain::{At, Domain, Uses};
use super::variable::Variable;

/// The names that an expression may use.
pub(super) trait Vocabulary {
    /// What a name stands for.
    type Name: Copy;

    /// What this name stands for.
    fn named(&self, name: &str) -> Option<Self::Name>;

    /// Every name.
    fn names(&self) -> Vec<&'static str>;

    /// The words that the value of a name can be, with their numbers; empty where it is a number.
    fn words(&self, _name: Self::Name) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// What a name is called in messages.
    fn noun(&self) -> &'static str;
}

/// A name in a law: the order of the axis, or a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loaded {
    Order,
    Variable(Variable),
}

/// The vocabulary of laws.
pub(super) struct OfLaws;

impl Vocabulary for OfLaws {
    type Name = Loaded;

    fn named(&self, name: &str) -> Option<Loaded> {
        let variable = Variable::ALL.into_iter().find(|variable| variable.name() == name).map(Loaded::Variable);
        if name == ORDER { Some(Loaded::Order) } else { variable }
    }

    fn names(&self) -> Vec<&'static str> {
        std::iter::once(ORDER).chain(Variable::ALL.into_iter().map(Variable::name)).collect()
    }

    fn noun(&self) -> &'static str {
        "variable"
    }
}

/// One step of the postfix code.
#[derive(Clone, Copy, Debug)]
pub(super) enum Op<Name> {
    Number(f64),
    Load(Name),
    Unary(fn(f64) -> f64),
    Binary(fn(f64, f64) -> f64),
    /// if(condition, then, else)
    Choose,
}

/// A parsed expression.
#[derive(Clone, Debug)]
pub(super) struct Expression<Name> {
    pub code: Vec<Op<Name>>,
}

impl Expression<Loaded> {
    /// The variables that the expression depends on.
    pub fn uses(&self) -> Uses {
        let mut uses = Uses::default();
        for op in &self.code {
            if let Op::Load(Loaded::Variable(variable)) = op {
                uses.add(*variable);
            }
        }
        uses
    }

    /// Whether the expression depends on the order of its axis.
    pub fn names_order(&self) -> bool {
        self.code.iter().any(|op| matches!(op, Op::Load(Loaded::Order)))
    }

    /// The variables that the expression names.
    pub fn named(&self) -> impl Iterator<Item = Variable> {
        self.code.iter().filter_map(|op| match op {
            Op::Load(Loaded::Variable(variable)) => Some(*variable),
            _ => None,
        })
    }

    /// The value at a point of a domain; NaN where the expression is undefined. `stack` is scratch memory. Linear in
    /// the steps of the code.
    pub fn value(&self, domain: &Domain, at: At, stack: &mut Vec<f64>) -> f64 {
        let known = |name| match name {
            Loaded::Order => f64::from(domain.order),
            Loaded::Variable(variable) => domain.read(variable, at),
        };
        self.value_with(known, stack)
    }
}

impl<Name: Copy> Expression<Name> {
    /// The value where `known` tells the values of names; NaN where the expression is undefined.
    pub fn value_with(&self, mut known: impl FnMut(Name) -> f64, stack: &mut Vec<f64>) -> f64 {
        stack.clear();
        for &op in &self.code {
            let value = match op {
                Op::Number(number) => number,
                Op::Load(name) => known(name),
                Op::Unary(f) => f(pop(stack)),
                Op::Binary(f) => {
                    let right = pop(stack);
                    f(pop(stack), right)
                }
                Op::Choose => {
                    let (otherwise, then) = (pop(stack), pop(stack));
                    choose(pop(stack), then, otherwise)
                }
            };
            stack.push(value);
        }
        pop(stack)
    }
}

fn pop(stack: &mut Vec<f64>) -> f64 {
    stack.pop().unwrap_or(f64::NAN)
}

fn choose(condition: f64, then: f64, otherwise: f64) -> f64 {
    match condition {
        c if c.is_nan() => f64::NAN,
        0.0 => otherwise,
        _ => then,
    }
}

/// A function of the language.
pub(super) enum Function {
    Unary(fn(f64) -> f64),
    /// Exactly two arguments.
    Binary(fn(f64, f64) -> f64),
    /// Two arguments or more, folded from the left.
    Fold(fn(f64, f64) -> f64),
    If,
}

/// The functions by name.
pub(super) const FUNCTIONS: [(&str, Function); 9] = [
    ("min", Function::Fold(|a, b| if a.is_nan() || a < b { a } else { b })),
    ("max", Function::Fold(|a, b| if a.is_nan() || a > b { a } else { b })),
    ("exp", Function::Unary(math::exp)),
    ("log", Function::Unary(math::log)),
    ("pow", Function::Binary(math::pow)),
    ("sqrt", Function::Unary(f64::sqrt)),
    ("abs", Function::Unary(f64::abs)),
    ("floor", Function::Unary(f64::floor)),
    ("if", Function::If),
];

/// The name of the order.
const ORDER: &str = "order";

/// An operator between two operands.
pub(super) struct Infix {
    pub symbol: &'static str,
    /// Binds tighter when higher.
    pub precedence: u8,
    pub apply: fn(f64, f64) -> f64,
}

/// Precedence of comparisons, which do not chain.
pub(super) const COMPARISON: u8 = 4;
/// Precedence of an operand of `not`: comparisons and all that binds tighter.
pub(super) const NOT: u8 = 3;
/// Precedence of an operand of unary minus: only powers bind tighter.
pub(super) const MINUS: u8 = 7;
/// Precedence of powers, which group from the right.
pub(super) const POWER: u8 = 8;

/// The operators between two operands.
pub(super) const INFIXES: [Infix; 13] = [
    Infix { symbol: "or", precedence: 1, apply: |a, b| truth(is_true(a) || is_true(b)) },
    Infix { symbol: "and", precedence: 2, apply: |a, b| truth(is_true(a) && is_true(b)) },
    Infix { symbol: "<", precedence: COMPARISON, apply: |a, b| truth(a < b) },
    Infix { symbol: "<=", precedence: COMPARISON, apply: |a, b| truth(a <= b) },
    Infix { symbol: ">", precedence: COMPARISON, apply: |a, b| truth(a > b) },
    Infix { symbol: ">=", precedence: COMPARISON, apply: |a, b| truth(a >= b) },
    Infix { symbol: "==", precedence: COMPARISON, apply: |a, b| truth(a == b) },
    Infix { symbol: "!=", precedence: COMPARISON, apply: |a, b| truth(a != b) },
    Infix { symbol: "+", precedence: 5, apply: |a, b| a + b },
    Infix { symbol: "-", precedence: 5, apply: |a, b| a - b },
    Infix { symbol: "*", precedence: 6, apply: |a, b| a * b },
    Infix { symbol: "/", precedence: 6, apply: |a, b| a / b },
    Infix { symbol: "^", precedence: POWER, apply: math::pow },
];

pub(super) fn is_true(value: f64) -> bool {
    value != 0.0
}

pub(super) fn truth(condition: bool) -> f64 {
    f64::from(u8::from(condition))
}
