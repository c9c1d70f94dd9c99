//! Values of expressions, and the carrying out of statements. Angles are degrees, numbers f64, a truth 1 or 0.
//!
//! `trunc` rounds to the nearest whole number, as cpfg does. Indices of arrays are cut to whole numbers.

use crate::code::{Act, Array, Builtin, Code};
use crate::derived::Variables;
use crate::draws::Draws;
use crate::fault::Place;
use crate::outside::Outside;
use phytomer_sim::math;

/// Why something cannot be carried out.
#[derive(Debug)]
pub(crate) struct Halt {
    pub place: Place,
    pub problem: String,
    pub expected: String,
}

pub(crate) type Result<T> = std::result::Result<T, Box<Halt>>;

/// A halt at a place.
pub(crate) fn halt<T>(place: Place, problem: impl Into<String>, expected: impl Into<String>) -> Result<T> {
    Err(Box::new(Halt { place, problem: problem.into(), expected: expected.into() }))
}

/// The most trials of `biran`.
const MOST_TRIALS: f64 = 1e6;
/// What a round of a loop or a call costs of the rounds that a step may have; a module passed over costs 1.
const ROUND: u64 = 16;

/// What expressions and statements work with.
pub(crate) struct Machine<'m> {
    pub functions: &'m [Code],
    pub arrays: &'m [Array],
    pub outside: &'m dyn Outside,
    pub variables: &'m mut Variables,
    pub draws: Draws<'m>,
    pub step: u32,
    /// What is left of the rounds of this step.
    pub rounds: u64,
}

impl Machine<'_> {
    /// Spends rounds.
    #[inline]
    pub fn spend(&mut self, rounds: u64, place: Place, what: &str) -> Result<()> {
        match self.rounds.checked_sub(rounds) {
            Some(left) => {
                self.rounds = left;
                Ok(())
            }
            None => halt(place, format!("{what} come to no end"), "an end within a step"),
        }
    }

    /// The value of an expression.
    #[inline]
    pub fn value(&mut self, code: &Code, frame: &[f64]) -> Result<f64> {
        match code {
            Code::Number(number) => Ok(*number),
            Code::Local(local) => Ok(frame.get(usize::from(*local)).copied().unwrap_or(0.0)),
            Code::Binary(operator, pair) => {
                let left = self.value(&pair.0, frame)?;
                // The second part of `||` and `&&` is asked where the first does not decide.
                match operator {
                    crate::syntax::Operator::Or if left != 0.0 => return Ok(1.0),
                    crate::syntax::Operator::And if left == 0.0 => return Ok(0.0),
                    _ => {}
                }
                let right = self.value(&pair.1, frame)?;
                Ok(operator.apply(left, right))
            }
            _ => self.other_value(code, frame),
        }
    }

    fn other_value(&mut self, code: &Code, frame: &[f64]) -> Result<f64> {
        match code {
            Code::Global(global) => Ok(self.variables.values.get(usize::from(*global)).copied().unwrap_or(0.0)),
            Code::Step => Ok(f64::from(self.step)),
            Code::Negative(inner) => Ok(-self.value(inner, frame)?),
            Code::Not(inner) => Ok(f64::from(self.value(inner, frame)? == 0.0)),
            Code::Choice(three) => {
                let chosen = if self.value(&three.0, frame)? != 0.0 { &three.1 } else { &three.2 };
                self.value(chosen, frame)
            }
            Code::Call(builtin, arguments, place) => self.builtin(*builtin, arguments, *place, frame),
            Code::Seed(seed) => {
                self.variables.seed = self.value(seed, frame)?.to_bits();
                self.draws.begin_anew();
                Ok(0.0)
            }
            Code::Element(array, index, place) => {
                let at = self.element(*array, index, *place, frame)?;
                Ok(self
                    .variables
                    .arrays
                    .get(usize::from(*array))
                    .and_then(|values| values.get(at))
                    .copied()
                    .unwrap_or(0.0))
            }
            Code::Function(function, arguments, place) => {
                self.spend(ROUND, *place, "the calls of functions")?;
                let inner = self.values(arguments, frame)?;
                let functions = self.functions;
                match functions.get(usize::from(*function)) {
                    Some(body) => self.value(body, &inner),
                    None => Ok(0.0),
                }
            }
            Code::Outside(function, arguments, place) => {
                let work = ROUND.saturating_add(self.outside.parts(*function) / ROUND);
                self.spend(work, *place, "the calls of functions")?;
                let values = self.values(arguments, frame)?;
                let result = self.outside.call(*function, &values);
                result.or_else(|(problem, expected)| halt(*place, problem, expected))
            }
            Code::Number(_) | Code::Local(_) | Code::Binary(..) => self.value(code, frame),
        }
    }

    fn values(&mut self, codes: &[Code], frame: &[f64]) -> Result<Vec<f64>> {
        codes.iter().map(|code| self.value(code, frame)).collect()
    }

    fn builtin(&mut self, builtin: Builtin, arguments: &[Code], place: Place, frame: &[f64]) -> Result<f64> {
        let values = self.values(arguments, frame)?;
        let (a, b) = (values.first().copied().unwrap_or(0.0), values.get(1).copied().unwrap_or(0.0));
        let seed = self.variables.seed;
        Ok(match builtin {
            Builtin::Sin => math::sin(a.to_radians()),
            Builtin::Cos => math::cos(a.to_radians()),
            Builtin::Tan => math::tan(a.to_radians()),
            Builtin::Asin => math::asin(a).to_degrees(),
            Builtin::Acos => math::acos(a).to_degrees(),
            Builtin::Atan => math::atan(a).to_degrees(),
            Builtin::Atan2 => math::atan2(a, b).to_degrees(),
            Builtin::Exp => math::exp(a),
            Builtin::Log => math::log(a),
            Builtin::Sqrt => a.sqrt(),
            Builtin::Floor => a.floor(),
            Builtin::Ceil => a.ceil(),
            Builtin::Round => (a + 0.5).floor(),
            Builtin::Absolute => a.abs(),
            Builtin::Sign => f64::from(i8::from(a > 0.0) - i8::from(a < 0.0)),
            Builtin::Min => values.iter().copied().fold(f64::INFINITY, f64::min),
            Builtin::Max => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            Builtin::Uniform => a * self.draws.uniform(seed),
            Builtin::Normal => a + b * self.draws.normal(seed),
            Builtin::Beta => self.draws.beta(seed, a, b),
            Builtin::Binomial => {
                let trials = a.clamp(0.0, MOST_TRIALS) as u32;
                self.spend(u64::from(trials), place, "the trials of `biran`")?;
                self.draws.binomial(seed, trials, b)
            }
            Builtin::Silent => 0.0,
        })
    }

    /// The number of an element within its array.
    fn element(&mut self, array: u16, index: &[Code], place: Place, frame: &[f64]) -> Result<usize> {
        let index = self.values(index, frame)?;
        let arrays = self.arrays;
        let Some(of) = arrays.get(usize::from(array)) else { return Ok(0) };
        let mut at = 0;
        for (value, &size) in index.iter().zip(&of.dimensions) {
            if !(*value > -1.0 && value.trunc() < size as f64) {
                let problem = format!("`{}` is asked for its element {value}", of.name);
                return halt(place, problem, format!("an element from 0 to {}", size - 1));
            }
            at = at * size + value.trunc() as usize;
        }
        Ok(at)
    }

    /// Carries out statements.
    pub fn run(&mut self, acts: &[Act], frame: &mut [f64]) -> Result<()> {
        // A loop with a long body spends more.
        self.rounds = self.rounds.saturating_sub(acts.len() as u64);
        for act in acts {
            match act {
                Act::Local(local, code) => {
                    let value = self.value(code, frame)?;
                    if let Some(variable) = frame.get_mut(usize::from(*local)) {
                        *variable = value;
                    }
                }
                Act::Global(global, code) => {
                    let value = self.value(code, frame)?;
                    if let Some(variable) = self.variables.values.get_mut(usize::from(*global)) {
                        *variable = value;
                    }
                }
                Act::Element(array, index, code, place) => {
                    let value = self.value(code, frame)?;
                    let at = self.element(*array, index, *place, frame)?;
                    let values = self.variables.arrays.get_mut(usize::from(*array));
                    if let Some(element) = values.and_then(|values| values.get_mut(at)) {
                        *element = value;
                    }
                }
                Act::Do(code) => drop(self.value(code, frame)?),
                Act::If(condition, yes, no) => {
                    let chosen = if self.value(condition, frame)? != 0.0 { yes } else { no };
                    self.run(chosen, frame)?;
                }
                Act::While(condition, body, place) => {
                    while self.value(condition, frame)? != 0.0 {
                        self.spend(ROUND, *place, "the rounds of `while`")?;
                        self.run(body, frame)?;
                    }
                }
                Act::Repeat(body, condition, place) => loop {
                    self.spend(ROUND, *place, "the rounds of `do`")?;
                    self.run(body, frame)?;
                    if self.value(condition, frame)? == 0.0 {
                        break;
                    }
                },
            }
        }
        Ok(())
    }
}
