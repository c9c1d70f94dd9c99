//! A law made ready for evaluation: its kind chosen, its parameters checked, one term for each physiological state.
//!
//! Faults of form (no kind, two kinds, a table too short, an unknown state) are found here, faults of value (outside
//! the range at some point) at the evaluation. Absent on purpose: the tables that the values go to.

use std::collections::{BTreeMap, BTreeSet};

use super::curves::Curve;
use super::domain::{At, Domain, Uses};
use super::expression::{Expression, Loaded, OfLaws};
use super::form::{Law, LawForm};
use super::grid::Grid;
use super::range::ValueRange;
use super::variable::Variable;
use super::{MAX_CELLS, MAX_WORK, dates, parser, spelling};
use crate::fault::{Fault, Path};

/// The most steps of evaluation spent on a law's values beyond the run at hand: a few milliseconds.
const MOST_LOOKING_AHEAD: u64 = 1 << 23;

/// What gives a law's value at a point of one state.
enum Term {
    Value(f64),
    Curve(Box<dyn Curve>),
    Code(Expression<Loaded>),
    /// Independent causes of one end.
    Hazards(Vec<Self>),
}

impl Term {
    fn uses(&self) -> Uses {
        match self {
            Self::Value(_) => Uses::default(),
            Self::Curve(curve) => {
                let mut uses = Uses::default();
                uses.add(curve.over());
                uses
            }
            Self::Code(code) => code.uses(),
            Self::Hazards(terms) => {
                let mut uses = Uses::default();
                terms.iter().for_each(|term| uses.join(term.uses()));
                uses
            }
        }
    }

    fn value(&self, domain: &Domain, at: At, stack: &mut Vec<f64>) -> f64 {
        match self {
            Self::Value(value) => *value,
            Self::Curve(curve) => curve.at(domain.read(curve.over(), at)),
            Self::Code(code) => code.value(domain, at, stack),
            Self::Hazards(terms) => {
                let outlives = |term: &Self| 1.0 - term.value(domain, at, &mut *stack);
                1.0 - terms.iter().map(outlives).product::<f64>()
            }
        }
    }

    /// Adds the variables that the term names; not the age for a variable of the date.
    fn name(&self, named: &mut BTreeSet<Variable>) {
        match self {
            Self::Value(_) => {}
            Self::Curve(curve) => _ = named.insert(curve.over()),
            Self::Code(code) => named.extend(code.named()),
            Self::Hazards(terms) => terms.iter().for_each(|term| term.name(named)),
        }
    }

    fn names_order(&self) -> bool {
        match self {
            Self::Code(code) => code.names_order(),
            Self::Hazards(terms) => terms.iter().any(Self::names_order),
            Self::Value(_) | Self::Curve(_) => false,
        }
    }

    fn steps(&self) -> u64 {
        match self {
            Self::Code(code) => code.code.len() as u64,
            Self::Hazards(terms) => terms.iter().map(|term| 2 + term.steps()).sum(),
            Self::Value(_) | Self::Curve(_) => 8,
        }
    }

    /// The fault of a variable, or the order, that the term depends on and that is not known in this domain.
    fn unknown(&self, domain: &Domain, path: &Path) -> Option<Fault> {
        let (has_ranks, uses) = (domain.max_rank > 0, self.uses());
        let is_unknown = |variable: &Variable| !domain.asked.knows(*variable, has_ranks);
        // A law of the date depends on the age too: what was written is told.
        let variable = uses.of_the_date().find(is_unknown).or_else(|| uses.variables().find(is_unknown));
        let of_order = self.names_order() && !domain.asked.knows_order();
        let name = variable.map(Variable::name).or(of_order.then_some("order"));
        let here = name.map(|name| domain.asked.fault(name, path));
        here.or_else(|| uses.of_the_date().find_map(|variable| dates::fault_of(variable, domain, path)))
    }
}

struct Part {
    term: Term,
    path: Path,
}

/// A law ready for evaluation: one part, or one for each state.
pub(super) struct Formula<'a> {
    parts: Vec<Part>,
    domain: &'a Domain,
    /// The variables that the law depends on.
    pub uses: Uses,
}

impl<'a> Formula<'a> {
    /// Checks the form of a law and makes it ready.
    pub fn new(law: &Law, domain: &'a Domain, path: &Path) -> Result<Self, Vec<Fault>> {
        let mut formula = Self { parts: Vec::new(), domain, uses: Uses::default() };
        let mut faults = Vec::new();
        match law {
            Law::Form(form) => match (form.check_kind(path), &form.by_state) {
                (Err(fault), _) => faults.push(fault),
                (Ok(()), Some(laws)) => formula.add_states(laws, &path.key("by_state"), &mut faults),
                (Ok(()), None) => formula.add(law, path, &mut faults),
            },
            Law::Number(_) => formula.add(law, path, &mut faults),
        }
        if faults.is_empty() { Ok(formula) } else { Err(faults) }
    }

    /// Checks the form of a law and its value at every point, and makes it ready.
    pub fn checked(
        law: &Law,
        domain: &'a Domain,
        path: &Path,
        range: &ValueRange,
        whole: bool,
    ) -> Result<Self, Vec<Fault>> {
        let formula = Self::new(law, domain, path)?;
        formula.tabulate(path, range, whole, |_| ())?;
        Ok(formula)
    }

    fn add_states(&mut self, laws: &BTreeMap<String, Law>, path: &Path, faults: &mut Vec<Fault>) {
        let states = &self.domain.states;
        if !self.domain.asked.knows_state() && self.domain.asked.knows_order() {
            let problem = "the law depends on the state of the axis, which is not known here";
            return faults.push(Fault::new(path, problem, "a law without by_state"));
        }
        if states.is_empty() {
            return faults.push(Fault::new(path, "the species has no states", "a law without by_state"));
        }
        for name in laws.keys().filter(|name| !states.contains(name)) {
            let problem = format!("unknown state `{}`", spelling::clip(name));
            let expected = spelling::expected(name, states.iter().map(String::as_str), "a state of this species");
            faults.push(Fault::new(&path.key(name), problem, expected));
        }
        for name in states {
            match laws.get(name) {
                Some(law) => self.add(law, &path.key(name), faults),
                None => faults.push(Fault::new(path, format!("no law for state `{name}`"), "a law for each state")),
            }
        }
        self.uses.add_state();
    }

    fn add(&mut self, law: &Law, path: &Path, faults: &mut Vec<Fault>) {
        let before = faults.len();
        let term = match law {
            Law::Number(value) => Some(Term::Value(*value)),
            Law::Form(form) => self.term(form, path, faults),
        };
        let Some(term) = term else { return };
        let uses = term.uses();
        faults.extend(term.unknown(self.domain, path));
        self.uses.join(uses);
        if faults.len() == before {
            self.parts.push(Part { term, path: path.clone() });
        }
    }

    fn term(&self, form: &LawForm, path: &Path, faults: &mut Vec<Fault>) -> Option<Term> {
        if let Err(fault) = form.check_kind(path) {
            faults.push(fault);
        } else if let Some(value) = form.value {
            return Some(Term::Value(value));
        } else if let Some((kind, curve)) = form.curve() {
            curve.check(self.domain, &path.key(kind), faults);
            return Some(Term::Curve(curve));
        } else if let Some(laws) = &form.hazards {
            return self.hazards(laws, &path.key("hazards"), faults);
        } else if let Some(text) = &form.expression {
            match parser::parse(text, &OfLaws) {
                Ok(code) => return Some(Term::Code(code)),
                Err(e) => {
                    let problem = format!("column {} of the expression: {}", e.column, e.problem);
                    faults.push(Fault::new(&path.key("expression"), problem, e.expected));
                }
            }
        } else {
            faults.push(Fault::new(&path.key("by_state"), "by_state inside by_state", "a law of the state"));
        }
        None
    }

    /// The terms of several causes, each a law of its own without another sum of hazards.
    fn hazards(&self, laws: &[Law], path: &Path, faults: &mut Vec<Fault>) -> Option<Term> {
        let before = faults.len();
        if laws.len() < 2 {
            faults.push(Fault::new(path, format!("{} hazards", laws.len()), "a list of at least two laws"));
        }
        let mut terms = Vec::with_capacity(laws.len());
        for (place, law) in laws.iter().enumerate() {
            let path = path.index(place);
            match law {
                Law::Number(value) if (0.0..=1.0).contains(value) => terms.push(Term::Value(*value)),
                Law::Number(value) => {
                    faults.push(Fault::new(&path, format!("the hazard is {value}"), "a probability in [0, 1]"));
                }
                Law::Form(form) if form.hazards.is_some() || form.by_state.is_some() => {
                    let inner = if form.hazards.is_some() { "hazards" } else { "by_state" };
                    let problem = format!("{inner} inside hazards");
                    faults.push(Fault::new(&path.key(inner), problem, "a law of one cause, the same in all states"));
                }
                Law::Form(form) => terms.extend(self.term(form, &path, faults)),
            }
        }
        (faults.len() == before).then_some(Term::Hazards(terms))
    }

    /// The value at a point; `stack` is scratch memory.
    pub fn value(&self, at: At, stack: &mut Vec<f64>) -> f64 {
        let Some(part) = self.part(at) else { return f64::NAN };
        part.term.value(self.domain, at, stack)
    }

    /// The values at every point of the law's own grid, or the first fault of each state: a value outside the range,
    /// or one that is not whole where it must be.
    pub fn tabulate<T>(
        &self,
        path: &Path,
        range: &ValueRange,
        whole: bool,
        mut convert: impl FnMut(f64) -> T,
    ) -> Result<(Grid, Vec<T>), Vec<Fault>> {
        let grid = grid(&[self], self.domain, path)?;
        let mut cells = Vec::with_capacity(grid.len());
        let mut faults: Vec<(usize, Fault)> = Vec::new();
        let mut stack = Vec::new();
        for at in (0..grid.len()).map(|cell| grid.point(cell)) {
            let value = self.value(at, &mut stack);
            if range.holds(value) && !(whole && value.fract() != 0.0) {
                cells.push(convert(value));
            // The states run slowest: only the last fault can be of this state.
            } else if faults.last().is_none_or(|(state, _)| *state != self.state(at)) {
                faults.push((self.state(at), self.fault(at, value, range)));
            }
        }
        if faults.is_empty() { Ok((grid, cells)) } else { Err(faults.into_iter().map(|(_, fault)| fault).collect()) }
    }

    /// "the law is 1.04 at dimension 27".
    fn fault(&self, at: At, value: f64, range: &ValueRange) -> Fault {
        let place = at.describe(self.uses, self.domain);
        let shown = range.show(value);
        let problem = match place.as_str() {
            "" => format!("the value is {shown}"),
            place => format!("the law is {shown} at {place}"),
        };
        match self.part(at) {
            Some(part) => Fault::new(&part.path, problem, range.expected()),
            None => Fault::new(&Path::root(), problem, range.expected()),
        }
    }

    fn part(&self, at: At) -> Option<&Part> {
        self.parts.get(self.state(at))
    }

    /// The variables that the law names, each once; not the age for a variable of the date.
    pub fn named(&self) -> BTreeSet<Variable> {
        let mut named = BTreeSet::new();
        self.parts.iter().for_each(|part| part.term.name(&mut named));
        named
    }

    /// The index of the part that holds at a point.
    fn state(&self, at: At) -> usize {
        usize::from(at.state).min(self.parts.len().saturating_sub(1))
    }

    /// Whether the law can have other values in a longer run.
    pub fn goes_on(&self) -> bool {
        self.domain.goes_on(self.uses)
    }

    /// The least and the largest value in the longest run that there can be; `None` where there are too many points to
    /// look at. Points without a value are passed over.
    pub fn extremes_in_any_run(&self) -> Option<(f64, f64)> {
        if self.uses.of_the_date().next().is_some() {
            return self.extremes_on_any_date();
        }
        let grid = Grid::over(self.uses, &self.domain.in_the_longest_run()).ok()?;
        if self.steps().saturating_mul(grid.len() as u64) > MOST_LOOKING_AHEAD {
            return None;
        }
        let mut stack = Vec::new();
        let values = (0..grid.len()).map(|cell| self.value(grid.point(cell), &mut stack));
        Some(
            values
                .filter(|value| !value.is_nan())
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value))),
        )
    }

    /// The least and the largest value whatever the date: a longer run has other dates, which its scenario tells.
    /// `None` where no bounds are known.
    fn extremes_on_any_date(&self) -> Option<(f64, f64)> {
        let of_part = |part: &Part| match &part.term {
            Term::Value(value) => Some((*value, *value)),
            Term::Curve(curve) => curve.over().bounds().and_then(|(low, high)| curve.extremes(low, high)),
            Term::Hazards(_) => Some((0.0, 1.0)),
            Term::Code(_) => None,
        };
        self.parts.iter().try_fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), part| {
            of_part(part).map(|(least, largest)| (low.min(least), high.max(largest)))
        })
    }

    fn steps(&self) -> u64 {
        self.parts.iter().map(|part| part.term.steps()).max().unwrap_or(1)
    }
}

/// The common grid of formulas, refused where the table would be too large or take too long to fill.
pub(super) fn grid(formulas: &[&Formula], domain: &Domain, path: &Path) -> Result<Grid, Vec<Fault>> {
    let mut uses = Uses::default();
    formulas.iter().for_each(|formula| uses.join(formula.uses));
    let too_large = |problem: String| vec![Fault::new(path, problem, "a law of fewer variables, or a shorter run")];
    if domain.states.len() > 256 {
        return Err(too_large(format!("{} states", domain.states.len())));
    }
    let grid = Grid::over(uses, domain)
        .map_err(|cells| too_large(format!("the law takes {cells} points; the limit is {MAX_CELLS}")))?;
    let steps: u64 = formulas.iter().map(|formula| formula.steps()).sum();
    if steps.saturating_mul(grid.len() as u64) > MAX_WORK {
        return Err(too_large(format!("the law takes {} points of {steps} steps each to compile", grid.len())));
    }
    Ok(grid)
}

impl LawForm {
    /// The curve of one variable that is given, with its key.
    fn curve(&self) -> Option<(&'static str, Box<dyn Curve>)> {
        fn boxed<C: Curve + Clone + 'static>(curve: &Option<C>) -> Option<Box<dyn Curve>> {
            curve.clone().map(|curve| Box::new(curve) as Box<dyn Curve>)
        }
        let curves = [
            ("table", boxed(&self.table)),
            ("step", boxed(&self.step)),
            ("linear", boxed(&self.linear)),
            ("exponential", boxed(&self.exponential)),
            ("logistic", boxed(&self.logistic)),
            ("weibull", boxed(&self.weibull)),
            ("robusta", boxed(&self.robusta)),
            ("gompertz", boxed(&self.gompertz)),
            ("mitscherlich", boxed(&self.mitscherlich)),
            ("linear_plateau", boxed(&self.linear_plateau)),
            ("quadratic_plateau", boxed(&self.quadratic_plateau)),
        ];
        curves.into_iter().find_map(|(kind, curve)| curve.map(|curve| (kind, curve)))
    }
}
