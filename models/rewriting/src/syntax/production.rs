//! Productions: `left < predecessor > right : {statements} condition {statements} --> successor : weight`.
//!
//! Everything but predecessor and arrow may be absent. A label before the production, such as `p1 :`, is passed over.
//! Absent: modules (`module`), statements (`statement`) and expressions (`expression`).

use super::expression::Parser;
use super::module::{Formal, ModuleText};
use super::statement::Statement;
use super::tree::Expression;
use crate::fault::{Fault, Place};

/// A production as it is written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Production {
    pub place: Place,
    pub left: Vec<Formal>,
    pub strict: Vec<Formal>,
    pub right: Vec<Formal>,
    pub before: Vec<Statement>,
    pub condition: Option<Expression>,
    pub after: Vec<Statement>,
    pub successor: Vec<ModuleText>,
    pub weight: Option<(Place, Expression)>,
}

impl Parser<'_> {
    pub(super) fn production(&mut self) -> Result<Production, Fault> {
        self.complete = false;
        let production = self.whole_production();
        self.complete = true;
        production
    }

    fn whole_production(&mut self) -> Result<Production, Fault> {
        self.label();
        self.blanks();
        let place = self.place();
        let (left, strict, right) = self.predecessor()?;
        let (before, condition, after) = if self.takes(':') { self.guards()? } else { Default::default() };
        self.blanks();
        let Some(arrow) = self.arrow() else { return Err(self.unexpected("an arrow `-->` and a successor")) };
        self.at += arrow;
        self.complete = true;
        let successor = self.modules()?;
        self.blanks();
        let at = self.place();
        let weight = if self.takes(':') { Some((at, self.expression()?)) } else { None };
        self.ends()?;
        Ok(Production { place, left, strict, right, before, condition, after, successor, weight })
    }

    /// Passes over the label of a production: `p1 :`, as the papers write.
    fn label(&mut self) {
        self.blanks();
        let start = self.at;
        let is_label = self.name().is_some_and(|name| {
            let number = name.name.strip_prefix('p').map(|rest| rest.trim_start_matches('_'));
            number.is_some_and(|number| !number.is_empty() && number.chars().all(char::is_numeric))
        });
        if !(is_label && self.takes(':')) {
            self.at = start;
            return;
        }
        self.blanks();
        // `p1 : * --> …` and `p1 : 1 --> …` are productions of the modules p and 1 with a condition.
        if self.peek().is_none_or(|c| c.is_ascii_digit() || c == '{' || (c == '*' && !self.has_left_context())) {
            self.at = start;
        }
    }

    fn has_left_context(&self) -> bool {
        self.rest().iter().skip(1).find(|letter| !letter.c.is_whitespace()).is_some_and(|letter| letter.c == '<')
    }

    #[expect(clippy::type_complexity, reason = "the three parts of a predecessor, used once")]
    fn predecessor(&mut self) -> Result<(Vec<Formal>, Vec<Formal>, Vec<Formal>), Fault> {
        let first = self.formals()?;
        let (left, strict) = if self.takes('<') { (first, self.formals()?) } else { (Vec::new(), first) };
        let right = if self.takes('>') { self.formals()? } else { Vec::new() };
        if strict.is_empty() {
            return Err(self.unexpected("the predecessor of a production before this"));
        }
        if let Some(rest) = left.iter().chain(&strict).find(|module| module.symbol == "=") {
            return Err(Fault::new(rest.place, "`=` stands outside a right context", "a module"));
        }
        Ok((left, strict, right))
    }

    #[expect(clippy::type_complexity, reason = "the three parts of a condition, used once")]
    fn guards(&mut self) -> Result<(Vec<Statement>, Option<Expression>, Vec<Statement>), Fault> {
        self.blanks();
        let before = if self.peek() == Some('{') { self.block()? } else { Vec::new() };
        self.blanks();
        let condition = if self.peek() == Some('*') {
            self.at += 1;
            None
        } else if self.arrow().is_some() {
            None
        } else {
            Some(self.expression()?)
        };
        self.blanks();
        let after = if self.peek() == Some('{') { self.block()? } else { Vec::new() };
        Ok((before, condition, after))
    }
}
