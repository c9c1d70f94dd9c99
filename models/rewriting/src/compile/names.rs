//! What the names of expressions mean: parameters, variables, arrays, functions of the file, of every program, and of
//! the world outside.
//!
//! A name is the parameter of a production before it is a variable of a block, and that before it is `Q`, the step. A
//! variable that only a production assigns is its own.

use super::functions::{builtin, forbidden};
use crate::code::{Act, Builtin, Code};
use crate::fault::{Fault, Place};
use crate::outside::Outside;
use crate::syntax::{Expression, Name, Statement};
use std::collections::BTreeMap;

/// The most variables of a file, and of a production beside its parameters.
const MOST_VARIABLES: usize = 500;
/// The most names that a fault lists, and the most faults that are told.
const MOST_NAMED: usize = 12;
const MOST_TOLD: usize = 1000;
/// The most functions within functions.
const DEEPEST: u32 = 3;

/// An array or a function of the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    pub number: u16,
    /// Dimensions, or arguments.
    pub count: usize,
    /// Functions within one another.
    pub level: u32,
}

/// The names of a whole file.
pub(super) struct Names<'o> {
    variables: BTreeMap<String, u16>,
    pub arrays: BTreeMap<String, Known>,
    pub functions: BTreeMap<String, Known>,
    outside: &'o dyn Outside,
    /// `Z`: the number of steps that the file states.
    pub steps: f64,
}

/// The names of a production, a function or a block.
#[derive(Debug, Default)]
pub(super) struct Scope {
    pub locals: Vec<String>,
    /// Whether a name that nothing binds is 0, as in the queries of a successor, which interpretation fills.
    pub open: bool,
    /// Whether what is assigned is a variable of the file.
    blocks: bool,
}

impl Scope {
    /// That of the blocks: what they assign are variables of the file.
    pub fn of_blocks() -> Self {
        Self { blocks: true, ..Self::default() }
    }

    pub fn of(locals: Vec<String>) -> Self {
        Self { locals, ..Self::default() }
    }

    fn local(&self, name: &str) -> Option<u16> {
        self.locals.iter().position(|local| local == name).map(|number| number as u16)
    }
}

impl<'o> Names<'o> {
    pub fn new(outside: &'o dyn Outside) -> Self {
        Self { variables: BTreeMap::new(), arrays: BTreeMap::new(), functions: BTreeMap::new(), outside, steps: 0.0 }
    }

    pub fn globals(&self) -> usize {
        self.variables.len()
    }

    /// Makes the names that statements assign variables of the file.
    pub fn declare(&mut self, statements: &[Statement], faults: &mut Vec<Fault>) {
        assigned(statements, &mut |name| {
            let number = self.variables.len();
            if self.variables.contains_key(&name.name) || self.arrays.contains_key(&name.name) {
                return;
            }
            if number >= MOST_VARIABLES {
                faults.push(too_many(name.place));
            } else {
                self.variables.insert(name.name.clone(), number as u16);
            }
        });
    }

    /// Adds to a scope the names that its statements assign and that are no variables of the file.
    pub fn declare_local(&self, statements: &[Statement], scope: &mut Scope, faults: &mut Vec<Fault>) {
        assigned(statements, &mut |name| {
            let known = scope.local(&name.name).is_some() || self.variables.contains_key(&name.name);
            if known {
                return;
            }
            if scope.locals.len() >= MOST_VARIABLES {
                faults.push(too_many(name.place));
            } else {
                scope.locals.push(name.name.clone());
            }
        });
    }

    /// The value of an expression that names no variable; `of` is the place of what it is the value of.
    pub fn constant(&self, expression: &Expression, of: Place, faults: &mut Vec<Fault>) -> f64 {
        match self.code(expression, &Scope::default(), faults) {
            Code::Number(number) => number,
            _ => {
                let name = first_name(expression);
                let problem = match name {
                    Some(_) => "a value that may change stands here",
                    None => "the value is not a finite number",
                };
                faults.push(Fault::new(name.map_or(of, |name| name.place), problem, "a number"));
                0.0
            }
        }
    }

    /// The code of an expression; 0 where there is a fault.
    pub fn code(&self, expression: &Expression, scope: &Scope, faults: &mut Vec<Fault>) -> Code {
        match expression {
            Expression::Number(number) => Code::Number(*number),
            // What is written beside a plant is no number.
            Expression::Text(_) => Code::Number(0.0),
            Expression::Name(name) => self.name(name, scope, faults),
            Expression::Negative(inner) => match self.code(inner, scope, faults) {
                Code::Number(number) => Code::Number(-number),
                inner => Code::Negative(Box::new(inner)),
            },
            Expression::Not(inner) => Code::Not(Box::new(self.code(inner, scope, faults))),
            Expression::Binary(operator, pair) => {
                let (left, right) = (self.code(&pair.0, scope, faults), self.code(&pair.1, scope, faults));
                match (&left, &right) {
                    (Code::Number(a), Code::Number(b)) if operator.apply(*a, *b).is_finite() => {
                        Code::Number(operator.apply(*a, *b))
                    }
                    _ => Code::Binary(*operator, Box::new((left, right))),
                }
            }
            Expression::Choice(three) => {
                let code = |part, faults: &mut Vec<Fault>| self.code(part, scope, faults);
                let condition = code(&three.0, faults);
                Code::Choice(Box::new((condition, code(&three.1, faults), code(&three.2, faults))))
            }
            Expression::Call(name, arguments) => self.call(name, arguments, scope, faults),
            Expression::Element(name, index) => self.element(name, index, scope, faults),
        }
    }

    fn name(&self, name: &Name, scope: &Scope, faults: &mut Vec<Fault>) -> Code {
        if let Some(local) = scope.local(&name.name) {
            return Code::Local(local);
        }
        if let Some(&global) = self.variables.get(&name.name) {
            return Code::Global(global);
        }
        match name.name.as_str() {
            "Q" => return Code::Step,
            "Z" => return Code::Number(self.steps),
            _ if scope.open => return Code::Number(0.0),
            _ => {}
        }
        if faults.len() >= MOST_TOLD {
            return Code::Number(0.0);
        }
        let known = scope.locals.iter().chain(self.variables.keys()).map(String::as_str);
        let known: Vec<&str> = known.take(MOST_NAMED).collect();
        let expected = match known.len() {
            0 => "a number, or a name that a `#define` or a block before it states".to_owned(),
            _ => format!("one of {}, or a name that a `#define` states", known.join(", ")),
        };
        faults.push(Fault::new(name.place, format!("nothing is named `{}`", name.name), expected));
        Code::Number(0.0)
    }

    fn element(&self, name: &Name, index: &[Expression], scope: &Scope, faults: &mut Vec<Fault>) -> Code {
        let codes = self.list(index, scope, faults);
        match self.arrays.get(&name.name) {
            Some(array) if array.count == index.len() => Code::Element(array.number, codes, name.place),
            Some(array) => {
                let problem = format!("`{}` is asked for an element by {} indices", name.name, index.len());
                faults.push(Fault::new(name.place, problem, format!("{}", array.count)));
                Code::Number(0.0)
            }
            None => {
                let expected = "an array of the block `define:`";
                faults.push(Fault::new(name.place, format!("no array is named `{}`", name.name), expected));
                Code::Number(0.0)
            }
        }
    }

    fn list(&self, expressions: &[Expression], scope: &Scope, faults: &mut Vec<Fault>) -> Box<[Code]> {
        expressions.iter().map(|expression| self.code(expression, scope, faults)).collect()
    }

    fn call(&self, name: &Name, arguments: &[Expression], scope: &Scope, faults: &mut Vec<Fault>) -> Code {
        if let Some(problem) = forbidden(&name.name) {
            let problem = format!("`{}` {problem}", name.name);
            faults.push(Fault::new(name.place, problem, "a program that only derives strings"));
            return Code::Number(0.0);
        }
        if let Some((builtin, least, most)) = builtin(&name.name) {
            if arguments.len() < least || arguments.len() > most {
                faults.push(arity(name, arguments.len(), least, most));
            }
            // What only prints is not even looked at.
            let codes =
                if builtin == Some(Builtin::Silent) { Box::default() } else { self.list(arguments, scope, faults) };
            return match (builtin, name.name.as_str()) {
                (Some(builtin), _) => Code::Call(builtin, codes, name.place),
                (None, "GetDerivationLength") => Code::Number(self.steps),
                (None, _) => Code::Seed(Box::new(codes.into_iter().next().unwrap_or(Code::Number(0.0)))),
            };
        }
        if let Some(function) = self.functions.get(&name.name) {
            if function.count != arguments.len() {
                faults.push(arity(name, arguments.len(), function.count, function.count));
            }
            return Code::Function(function.number, self.list(arguments, scope, faults), name.place);
        }
        self.outside_call(name, arguments, scope, faults)
    }

    fn outside_call(&self, name: &Name, arguments: &[Expression], scope: &Scope, faults: &mut Vec<Fault>) -> Code {
        let Some(function) = self.outside.function(&name.name, arguments.len()) else {
            if faults.len() >= MOST_TOLD {
                return Code::Number(0.0);
            }
            let others = self.outside.names();
            let all: Vec<&str> = self.functions.keys().chain(&others).take(MOST_NAMED).map(String::as_str).collect();
            let more = if all.is_empty() { String::new() } else { format!(", or one of {}", all.join(", ")) };
            let problem = format!("no function of {} arguments is named `{}`", arguments.len(), name.name);
            let expected = self.outside.missing(&name.name);
            let expected = expected.unwrap_or_else(|| format!("a function of the language, such as `sqrt(x)`{more}"));
            faults.push(Fault::new(name.place, problem, expected));
            return Code::Number(0.0);
        };
        // The first argument of a curve may be its name.
        let curve = match arguments.first() {
            Some(Expression::Name(first))
                if scope.local(&first.name).is_none() && !self.variables.contains_key(&first.name) =>
            {
                self.outside.curve(&first.name)
            }
            _ => None,
        };
        let mut codes = Vec::from_iter(curve.map(Code::Number));
        codes.extend(arguments.iter().skip(codes.len()).map(|argument| self.code(argument, scope, faults)));
        Code::Outside(function, codes.into(), name.place)
    }

    /// The code of statements.
    pub fn acts(&self, statements: &[Statement], scope: &mut Scope, faults: &mut Vec<Fault>) -> Box<[Act]> {
        statements.iter().filter_map(|statement| self.act(statement, scope, faults)).collect()
    }

    fn act(&self, statement: &Statement, scope: &mut Scope, faults: &mut Vec<Fault>) -> Option<Act> {
        Some(match statement {
            Statement::Assign(name, index, value) => {
                let value = self.code(value, scope, faults);
                if !index.is_empty() || self.arrays.contains_key(&name.name) {
                    return match self.element(name, index, scope, faults) {
                        Code::Element(array, index, place) => Some(Act::Element(array, index, value, place)),
                        _ => None,
                    };
                }
                match (scope.local(&name.name), self.variables.get(&name.name)) {
                    (Some(local), _) => Act::Local(local, value),
                    (None, global) => Act::Global(*global?, value),
                }
            }
            Statement::Call(call) => Act::Do(self.code(call, scope, faults)),
            Statement::If(condition, yes, no) => {
                let condition = self.code(condition, scope, faults);
                Act::If(condition, self.acts(yes, scope, faults), self.acts(no, scope, faults))
            }
            Statement::While(condition, body, place) => {
                Act::While(self.code(condition, scope, faults), self.acts(body, scope, faults), *place)
            }
            Statement::Repeat(body, condition, place) => {
                Act::Repeat(self.acts(body, scope, faults), self.code(condition, scope, faults), *place)
            }
            Statement::Array(name, ..) => {
                let expected = "the block `define:`, in which arrays are stated";
                if !scope.blocks {
                    faults.push(Fault::new(
                        name.place,
                        format!("the array `{}` stands in a production", name.name),
                        expected,
                    ));
                }
                return None;
            }
        })
    }

    /// How many functions lie within the functions that an expression calls.
    pub fn level(&self, expression: &Expression, place: Place, faults: &mut Vec<Fault>) -> u32 {
        let level = self.deepest(expression);
        if level > DEEPEST {
            faults.push(Fault::new(place, "too many functions within one another", format!("at most {DEEPEST}")));
        }
        level
    }

    fn deepest(&self, expression: &Expression) -> u32 {
        let all = |list: &[Expression]| list.iter().map(|inner| self.deepest(inner)).max().unwrap_or(0);
        match expression {
            Expression::Number(_) | Expression::Text(_) | Expression::Name(_) => 0,
            Expression::Negative(inner) | Expression::Not(inner) => self.deepest(inner),
            Expression::Binary(_, pair) => self.deepest(&pair.0).max(self.deepest(&pair.1)),
            Expression::Choice(three) => self.deepest(&three.0).max(self.deepest(&three.1)).max(self.deepest(&three.2)),
            Expression::Call(name, arguments) => {
                all(arguments).max(self.functions.get(&name.name).map_or(0, |function| function.level))
            }
            Expression::Element(_, index) => all(index),
        }
    }
}

fn too_many(place: Place) -> Fault {
    Fault::new(place, "too many variables", format!("at most {MOST_VARIABLES}"))
}

fn arity(name: &Name, found: usize, least: usize, most: usize) -> Fault {
    let expected = if least == most { format!("{least}") } else { format!("at least {least}") };
    Fault::new(name.place, format!("`{}` has {found} arguments", name.name), expected)
}

/// Tells every variable that statements assign.
fn assigned<'s>(statements: &'s [Statement], tell: &mut dyn FnMut(&'s Name)) {
    for statement in statements {
        match statement {
            Statement::Assign(name, index, _) if index.is_empty() => tell(name),
            Statement::If(_, yes, no) => {
                assigned(yes, tell);
                assigned(no, tell);
            }
            Statement::While(_, body, _) | Statement::Repeat(body, ..) => assigned(body, tell),
            // That it reads a file is told; what follows from that is not.
            Statement::Call(Expression::Call(name, list)) if name.name == "fscanf" => {
                list.iter().filter_map(first_name).for_each(&mut *tell);
            }
            _ => {}
        }
    }
}

fn first_name(expression: &Expression) -> Option<&Name> {
    match expression {
        Expression::Number(_) | Expression::Text(_) => None,
        Expression::Name(name) | Expression::Call(name, _) | Expression::Element(name, _) => Some(name),
        Expression::Negative(inner) | Expression::Not(inner) => first_name(inner),
        Expression::Binary(_, pair) => first_name(&pair.0).or_else(|| first_name(&pair.1)),
        Expression::Choice(three) => first_name(&three.0).or_else(|| first_name(&three.1)),
    }
}
