//! Modules as they are written: the names of symbols, arguments of successors, parameters of predecessors.
//!
//! A symbol is one character, or two where the first is `@`, `?` or `~`, or three in the groups `@G…` and `@T…` of
//! cpfg.

use super::expression::Parser;
use super::tree::{Expression, Name};
use crate::fault::{Fault, Place};

/// The most parameters of a module.
pub(crate) const MOST_PARAMETERS: usize = 32;

/// A module of an axiom or a successor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ModuleText {
    pub symbol: String,
    pub place: Place,
    pub arguments: Vec<Expression>,
}

/// A module of a predecessor or a context; `=` in a right context is the rest of its branch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Formal {
    pub symbol: String,
    pub place: Place,
    pub parameters: Vec<Name>,
}

impl Parser<'_> {
    /// The name of a symbol.
    pub(super) fn symbol(&mut self) -> Result<String, Fault> {
        let place = self.place();
        let Some(first) = self.peek() else { return Err(self.unexpected("a module")) };
        if matches!(first, '(' | ')' | '<' | '>' | ':' | '=' | '*' | '"') || first.is_control() {
            return Err(self.unexpected("a module"));
        }
        self.at += 1;
        let mut symbol = String::from(first);
        if !matches!(first, '@' | '?' | '~') {
            return Ok(symbol);
        }
        match self.peek().filter(|c| !c.is_whitespace()) {
            Some('(') if first == '?' => {
                let problem = "a sub-L-system is called with `?(…)`";
                Err(Fault::new(place, problem, "one L-system: sub-L-systems are not derived"))
            }
            Some(second) if !matches!(second, '(' | ')') => {
                self.at += 1;
                symbol.push(second);
                if first == '@'
                    && matches!(second, 'G' | 'T')
                    && let Some(third) = self.peek().filter(char::is_ascii_lowercase)
                {
                    self.at += 1;
                    symbol.push(third);
                }
                Ok(symbol)
            }
            _ => Err(self.unexpected(&format!("a character behind `{first}`, with which it is one symbol"))),
        }
    }

    /// The bracket that a parenthesis stands for, where parentheses are branches.
    fn branch(&mut self) -> Option<String> {
        let bracket = match self.peek().filter(|_| self.cells)? {
            '(' => "[",
            ')' => "]",
            _ => return None,
        };
        self.at += 1;
        Some(bracket.to_owned())
    }

    /// The modules of an axiom or a successor, up to the end of the line or a colon.
    pub(super) fn modules(&mut self) -> Result<Vec<ModuleText>, Fault> {
        let mut modules = Vec::new();
        loop {
            self.blanks();
            match self.peek() {
                None | Some('\n' | ':') => return Ok(modules),
                Some('*' | 'ε') if modules.is_empty() => {
                    self.at += 1;
                    self.blanks();
                    return match self.peek() {
                        None | Some('\n' | ':') => Ok(modules),
                        Some(_) => Err(self.unexpected("the end of the line: `*` is an empty successor")),
                    };
                }
                _ => {}
            }
            let place = self.place();
            if let Some(symbol) = self.branch() {
                modules.push(ModuleText { symbol, place, arguments: Vec::new() });
                continue;
            }
            let symbol = self.symbol()?;
            self.blanks();
            let arguments = if self.peek() == Some('(') && !self.cells { self.list('(', ')')? } else { Vec::new() };
            self.check_count(arguments.len(), &symbol, place)?;
            modules.push(ModuleText { symbol, place, arguments });
        }
    }

    /// The modules of a predecessor or a context, up to `<`, `>`, `:` or an arrow.
    pub(super) fn formals(&mut self) -> Result<Vec<Formal>, Fault> {
        let mut formals = Vec::new();
        loop {
            self.blanks();
            match self.peek() {
                None | Some('\n' | '<' | '>' | ':') => return Ok(formals),
                Some('*') if formals.is_empty() => {
                    self.at += 1;
                    return Ok(formals);
                }
                _ if self.arrow().is_some() => return Ok(formals),
                _ => {}
            }
            let place = self.place();
            if self.peek() == Some('=') {
                self.at += 1;
                formals.push(Formal { symbol: "=".to_owned(), place, parameters: Vec::new() });
                continue;
            }
            if let Some(symbol) = self.branch() {
                formals.push(Formal { symbol, place, parameters: Vec::new() });
                continue;
            }
            let symbol = self.symbol()?;
            self.blanks();
            let parameters = if self.peek() == Some('(') && !self.cells { self.parameters()? } else { Vec::new() };
            self.check_count(parameters.len(), &symbol, place)?;
            formals.push(Formal { symbol, place, parameters });
        }
    }

    fn check_count(&self, count: usize, symbol: &str, place: Place) -> Result<(), Fault> {
        if count > MOST_PARAMETERS {
            let problem = format!("`{symbol}` has {count} parameters");
            return Err(Fault::new(place, problem, format!("at most {MOST_PARAMETERS}")));
        }
        Ok(())
    }

    /// Names in parentheses. A number is a slip of a reader of print, who took the letter l for 1.
    pub(super) fn parameters(&mut self) -> Result<Vec<Name>, Fault> {
        self.expects('(')?;
        let mut names: Vec<Name> = Vec::new();
        if self.takes(')') {
            return Ok(names);
        }
        loop {
            self.blanks();
            let Some(name) = self.name() else {
                return Err(match self.peek() {
                    Some('1') => self.unexpected("the name of a parameter, such as the letter `l`"),
                    _ => self.unexpected("the name of a parameter"),
                });
            };
            if names.iter().any(|known| known.name == name.name) {
                let problem = format!("two parameters of a module are named `{}`", name.name);
                return Err(Fault::new(name.place, problem, "another name for each"));
            }
            if names.len() == MOST_PARAMETERS {
                return Err(Fault::new(
                    name.place,
                    "there are too many parameters",
                    format!("at most {MOST_PARAMETERS}"),
                ));
            }
            names.push(name);
            if self.takes(')') {
                return Ok(names);
            }
            if !self.takes(',') {
                return Err(self.unexpected("`,` or `)`"));
            }
        }
    }
}
