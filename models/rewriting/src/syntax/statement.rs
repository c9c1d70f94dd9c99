//! Statements in braces: assignments, calls, `if`, `while`, `do`, and arrays in the block `define:`.
//!
//! Blocks nest to a bounded depth, so that no text exhausts the stack. Absent: which names are variables (`compile`),
//! and the carrying out (`evaluate`).

use super::expression::Parser;
use super::tree::{Expression, Name, Operator};
use crate::fault::{Fault, Place};

/// The most blocks within blocks.
const DEEPEST: u32 = 60;

/// A statement as it is written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Statement {
    /// A variable, or the element of an array, takes a value.
    Assign(Name, Vec<Expression>, Expression),
    /// A call for what it does.
    Call(Expression),
    If(Expression, Vec<Statement>, Vec<Statement>),
    While(Expression, Vec<Statement>, Place),
    Repeat(Vec<Statement>, Expression, Place),
    /// An array with its dimensions and its first values.
    Array(Name, Vec<Expression>, Vec<Expression>),
}

impl Parser<'_> {
    /// Statements between braces.
    pub(super) fn block(&mut self) -> Result<Vec<Statement>, Fault> {
        self.block_within(0)
    }

    fn block_within(&mut self, depth: u32) -> Result<Vec<Statement>, Fault> {
        if depth > DEEPEST {
            return Err(Fault::new(self.place(), "too many blocks within one another", format!("at most {DEEPEST}")));
        }
        self.expects('{')?;
        self.inside += 1;
        let statements = self.statements(depth);
        self.inside -= 1;
        statements
    }

    fn statements(&mut self, depth: u32) -> Result<Vec<Statement>, Fault> {
        let mut statements = Vec::new();
        while !self.takes('}') {
            match self.peek() {
                None => return Err(self.unexpected("`}` at the end of the block")),
                Some(';') => self.at += 1,
                Some('{') => statements.extend(self.block_within(depth + 1)?),
                _ => self.statement(depth, &mut statements)?,
            }
        }
        Ok(statements)
    }

    /// A block, or one statement.
    fn body(&mut self, depth: u32) -> Result<Vec<Statement>, Fault> {
        self.blanks();
        if self.peek() == Some('{') {
            return self.block_within(depth + 1);
        }
        if depth > DEEPEST {
            return Err(Fault::new(
                self.place(),
                "too many statements within one another",
                format!("at most {DEEPEST}"),
            ));
        }
        let mut one = Vec::new();
        if !self.takes(';') {
            self.statement(depth + 1, &mut one)?;
        }
        Ok(one)
    }

    fn statement(&mut self, depth: u32, into: &mut Vec<Statement>) -> Result<(), Fault> {
        let (start, place) = (self.at, self.place());
        let Some(name) = self.name() else { return Err(self.unexpected("a statement or `}`")) };
        match name.name.as_str() {
            "if" => {
                let condition = self.condition()?;
                let yes = self.body(depth)?;
                let behind = self.at;
                let otherwise = self.name().is_some_and(|name| name.name == "else");
                let no = if otherwise { self.body(depth)? } else { Vec::new() };
                self.at = if otherwise { self.at } else { behind };
                into.push(Statement::If(condition, yes, no));
            }
            "while" => {
                let condition = self.condition()?;
                into.push(Statement::While(condition, self.body(depth)?, place));
            }
            "do" => {
                let body = self.body(depth)?;
                if self.name().is_none_or(|name| name.name != "while") {
                    return Err(self.unexpected("`while` behind the block of `do`"));
                }
                into.push(Statement::Repeat(body, self.condition()?, place));
                self.end_of_statement()?;
            }
            "array" => self.arrays(into)?,
            "external" => {
                let problem = "`external` takes variables of another L-system";
                return Err(Fault::new(place, problem, "one L-system: sub-L-systems are not derived"));
            }
            _ => {
                self.at = start;
                into.push(self.simple()?);
                self.end_of_statement()?;
            }
        }
        Ok(())
    }

    fn condition(&mut self) -> Result<Expression, Fault> {
        let mut list = self.list('(', ')')?;
        match list.pop().filter(|_| list.is_empty()) {
            Some(condition) => Ok(condition),
            None => Err(self.unexpected("one condition in parentheses before this")),
        }
    }

    fn end_of_statement(&mut self) -> Result<(), Fault> {
        self.blanks();
        if self.takes(';') || self.peek() == Some('}') { Ok(()) } else { Err(self.unexpected("`;`")) }
    }

    /// An assignment or a call. In it `=` is no comparison at its first place.
    fn simple(&mut self) -> Result<Statement, Fault> {
        let start = self.at;
        if let Some(name) = self.name() {
            self.blanks();
            let mut index = Vec::new();
            while self.takes('[') {
                index.push(self.expression()?);
                self.expects(']')?;
                self.blanks();
            }
            let sum = match (self.peek(), self.peek_after(1)) {
                (Some('='), next) if next != Some('=') => None,
                (Some('+'), Some('=')) => Some(Operator::Add),
                (Some('-'), Some('=')) => Some(Operator::Subtract),
                _ => {
                    self.at = start;
                    return Ok(Statement::Call(self.expression()?));
                }
            };
            self.at += if sum.is_some() { 2 } else { 1 };
            let value = self.expression()?;
            let value = match sum {
                Some(operator) => {
                    let old = if index.is_empty() {
                        Expression::Name(name.clone())
                    } else {
                        Expression::Element(name.clone(), index.clone())
                    };
                    Expression::Binary(operator, Box::new((old, value)))
                }
                None => value,
            };
            return Ok(Statement::Assign(name, index, value));
        }
        Ok(Statement::Call(self.expression()?))
    }

    /// `name[M][N] = {…}, …;` behind the word `array`.
    fn arrays(&mut self, into: &mut Vec<Statement>) -> Result<(), Fault> {
        loop {
            let Some(name) = self.name() else { return Err(self.unexpected("the name of an array")) };
            let mut dimensions = Vec::new();
            while self.takes('[') {
                dimensions.push(self.expression()?);
                self.expects(']')?;
            }
            if dimensions.is_empty() {
                return Err(self.unexpected("`[` and the number of elements"));
            }
            let values = if self.takes('=') { self.list('{', '}')? } else { Vec::new() };
            into.push(Statement::Array(name, dimensions, values));
            if !self.takes(',') {
                return self.end_of_statement();
            }
        }
    }
}
