//! A program as it is carried out: names have become numbers of variables, symbols kinds of modules.
//!
//! `compile` makes this form, `evaluate` computes its expressions and `engine` applies its productions. Absent: the
//! names, which only faults need.

use crate::fault::Place;
use crate::symbol::Kind;
use crate::syntax::Operator;

/// How many parts of expressions cost a round.
const PARTS_OF_ROUND: u64 = 32;

/// An expression.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Code {
    Number(f64),
    /// A parameter of the predecessor or its contexts, or a variable of the production.
    Local(u16),
    /// A variable of the blocks.
    Global(u16),
    /// How many steps have begun.
    Step,
    Negative(Box<Code>),
    Not(Box<Code>),
    Binary(Operator, Box<(Code, Code)>),
    Choice(Box<(Code, Code, Code)>),
    Call(Builtin, Box<[Code]>, Place),
    /// The key of further draws changes.
    Seed(Box<Code>),
    Element(u16, Box<[Code]>, Place),
    /// A function that the file defines.
    Function(u16, Box<[Code]>, Place),
    /// A function that stands outside the file.
    Outside(u32, Box<[Code]>, Place),
}

/// A function that every program knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Builtin {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Exp,
    Log,
    Sqrt,
    Floor,
    Ceil,
    Round,
    Absolute,
    Sign,
    Min,
    Max,
    Uniform,
    Normal,
    Beta,
    Binomial,
    /// Does nothing and is 0.
    Silent,
}

impl Builtin {
    /// Whether its value is drawn.
    pub fn draws(self) -> bool {
        matches!(self, Self::Uniform | Self::Normal | Self::Beta | Self::Binomial)
    }
}

/// A statement.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Act {
    Local(u16, Code),
    Global(u16, Code),
    Element(u16, Box<[Code]>, Code, Place),
    Do(Code),
    If(Code, Box<[Act]>, Box<[Act]>),
    While(Code, Box<[Act]>, Place),
    Repeat(Box<[Act]>, Code, Place),
}

/// An array: its dimensions and first values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Array {
    pub name: String,
    pub dimensions: Vec<usize>,
    pub values: Vec<f64>,
}

/// A part of a predecessor or a context.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Item {
    /// A module of a kind, whose parameters become variables from this one on.
    Module(Kind, u16),
    /// What is left of a branch.
    Rest,
}

/// A module of a successor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Made {
    pub kind: Kind,
    pub arguments: Box<[Code]>,
    pub place: Place,
    /// The module of the predecessor that goes on as this one.
    pub continues: Option<u8>,
}

impl Code {
    /// Of how many parts it is made.
    pub fn parts(&self) -> u64 {
        let all = |list: &[Self]| list.iter().map(Self::parts).sum::<u64>();
        1 + match self {
            Self::Number(_) | Self::Local(_) | Self::Global(_) | Self::Step => 0,
            Self::Negative(inner) | Self::Not(inner) | Self::Seed(inner) => inner.parts(),
            Self::Binary(_, pair) => pair.0.parts() + pair.1.parts(),
            Self::Choice(three) => three.0.parts() + three.1.parts().max(three.2.parts()),
            Self::Call(_, list, _) | Self::Element(_, list, _) => all(list),
            Self::Function(_, list, _) | Self::Outside(_, list, _) => all(list),
        }
    }
}

/// A production.
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    pub place: Place,
    /// From the right to the left.
    pub left: Box<[Item]>,
    pub strict: Box<[Item]>,
    pub right: Box<[Item]>,
    pub before: Box<[Act]>,
    pub condition: Option<Code>,
    pub after: Box<[Act]>,
    pub successor: Box<[Made]>,
    pub weight: Option<Code>,
    /// How many variables it has.
    pub locals: u16,
    /// What it costs to try it and to apply it, of the rounds that a step may have.
    pub cost: u64,
    /// Its successor as columns, where it rewrites a single module into some; told once all sections are there.
    pub row: Option<Row>,
}

/// What of a successor is the same whenever its production is applied, column by column.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub kinds: Box<[Kind]>,
    /// The parameters of all modules; those that are computed are 0 here.
    pub values: Box<[f64]>,
    /// How many of them are those of the first module.
    pub of_first: usize,
    /// Where the parameters of each begin among those of all modules.
    pub first: Box<[u32]>,
    /// The parameters that are computed: their places, and by which argument of which module.
    pub computed: Box<[(u32, u32, u32)]>,
    /// The brackets behind the first module, in pairs.
    pub pairs: Box<[(u32, u32)]>,
    /// The modules behind the first that a step visits in their order, those of which it changes the parameters, and
    /// the cuts.
    pub active: Box<[u32]>,
    pub updated: Box<[u32]>,
    pub cuts: Box<[u32]>,
    /// The module as which the predecessor goes on.
    pub kept: Option<u32>,
}

impl Rule {
    /// What a production of these expressions costs: a round, and more where they are long.
    pub fn cost_of(condition: Option<&Code>, weight: Option<&Code>, successor: &[Made]) -> u64 {
        let arguments = successor.iter().flat_map(|made| made.arguments.iter());
        1 + arguments.chain(condition).chain(weight).map(Code::parts).sum::<u64>() / PARTS_OF_ROUND
    }

    /// Whether it rewrites every module of its kind, whatever stands around it.
    pub fn is_certain(&self) -> bool {
        let alone = self.left.is_empty() && self.right.is_empty() && self.strict.len() == 1;
        alone && self.condition.is_none() && self.before.is_empty() && self.weight.is_none()
    }
}

/// Productions of one section.
#[derive(Debug, Default)]
pub(crate) struct Rules {
    pub rules: Vec<Rule>,
    /// For each kind the productions of which it is the first module, in their order.
    pub by_kind: Vec<Vec<u32>>,
    /// Whether all productions that apply compete by their weights.
    pub compete: bool,
    /// Whether any production looks at contexts.
    pub looks: bool,
    /// Whether any production looks at a left context.
    pub looks_left: bool,
    /// The most productions within one another.
    pub depth: u32,
    /// What `seed:` of the section adds to the key of its draws.
    pub seed: u64,
}

impl Rules {
    #[inline]
    pub fn of(&self, kind: Kind) -> &[u32] {
        self.by_kind.get(usize::from(kind.0)).map_or(&[], Vec::as_slice)
    }
}

/// Everything that a derivation needs.
#[derive(Debug)]
pub(crate) struct Script {
    pub axiom: Box<[Made]>,
    pub rewriting: Rules,
    pub decomposition: Rules,
    pub homomorphism: Rules,
    pub start: Box<[Act]>,
    pub start_each: Box<[Act]>,
    pub end_each: Box<[Act]>,
    /// The functions of the file: expressions over their parameters.
    pub functions: Vec<Code>,
    pub globals: usize,
    pub arrays: Vec<Array>,
    /// For each kind whether contexts see it.
    pub visible: Vec<bool>,
    pub ring: bool,
}

impl Script {
    /// The place of the axiom, for what is wrong with no production alone.
    pub fn place(&self) -> Place {
        self.axiom.first().map_or(Place { file: 0, line: 1, column: 1 }, |made| made.place)
    }

    /// Whether any production looks at a left context.
    pub fn looks_left(&self) -> bool {
        [&self.rewriting, &self.decomposition, &self.homomorphism].iter().any(|rules| rules.looks_left)
    }
}
