//! A whole file: its items, its productions, and its sections for decomposition and homomorphism.
//!
//! After a fault reading goes on at the next line that begins without a blank, so that all faults are told at once. The
//! papers' notation has no head: ω is the axiom, `n = 10` the number of steps, δ the angle of turns.

use super::expression::Parser;
use super::keyword::{Keyword, keyword};
use super::module::ModuleText;
use super::production::Production;
use super::statement::Statement;
use super::tree::{Expression, Name};
use crate::fault::{Fault, Place};
use crate::letters::Letter;

/// Reading ends after so many faults.
const MOST_TOLD: usize = 1000;

/// Productions of one kind.
#[derive(Debug, Default)]
pub(crate) struct Section {
    pub productions: Vec<Production>,
    /// The most productions within one another, of decomposition and homomorphism.
    pub depth: Option<(Place, Expression)>,
    pub seed: Option<(Place, Expression)>,
}

/// A function that the file defines: `prune(x, y) = …`.
#[derive(Debug)]
pub(crate) struct Function {
    pub name: Name,
    pub parameters: Vec<Name>,
    pub body: Expression,
}

/// What a file says.
#[derive(Debug, Default)]
pub(crate) struct File {
    /// Whether it begins with `lsystem:`, as programs of cpfg do and those of papers do not.
    pub headed: bool,
    pub axiom: Option<(Place, Vec<ModuleText>)>,
    pub rewriting: Section,
    pub decomposition: Section,
    pub homomorphism: Section,
    pub steps: Option<(Place, Expression)>,
    pub angle: Option<(Place, Expression)>,
    pub ring: bool,
    pub consider: Option<Vec<Name>>,
    pub ignore: Option<Vec<Name>>,
    pub define: Vec<Statement>,
    pub start: Vec<Statement>,
    pub start_each: Vec<Statement>,
    pub end_each: Vec<Statement>,
    pub functions: Vec<Function>,
}

/// The section to which productions are added.
#[derive(Clone, Copy)]
enum Current {
    Rewriting,
    Decomposition,
    Homomorphism,
}

/// Reads the letters of a file; `cells` tells that its parentheses are branches.
pub(crate) fn parse(letters: &[Letter], cells: bool, faults: &mut Vec<Fault>) -> File {
    let mut parser = Parser::new(letters, Place { file: 0, line: 1, column: 1 });
    parser.cells = cells;
    let mut reader = Reader { parser, file: File::default(), current: Current::Rewriting, ended: false };
    while reader.parser.peek().is_some() && faults.len() < MOST_TOLD {
        if reader.parser.peek() == Some('\n') {
            reader.parser.at += 1;
            continue;
        }
        let start = reader.parser.at;
        if let Err(fault) = reader.item() {
            faults.push(fault);
            reader.recover(start);
        }
    }
    let Reader { parser, file, .. } = reader;
    if file.axiom.is_none() && faults.is_empty() {
        faults.push(Fault::new(
            parser.place(),
            "the file has no axiom",
            "`Axiom:` and modules, or `ω :` as in the papers",
        ));
    }
    file
}

struct Reader<'l> {
    parser: Parser<'l>,
    file: File,
    current: Current,
    ended: bool,
}

impl Reader<'_> {
    /// Goes on behind a fault, at the next line that begins without a blank.
    fn recover(&mut self, start: usize) {
        let parser = &mut self.parser;
        (parser.inside, parser.complete) = (0, true);
        parser.at = parser.at.max(start + 1);
        while let Some(c) = parser.peek() {
            parser.at += 1;
            if c == '\n' && parser.peek().is_some_and(|next| !next.is_whitespace()) {
                break;
            }
        }
    }

    fn section(&mut self) -> &mut Section {
        match self.current {
            Current::Rewriting => &mut self.file.rewriting,
            Current::Decomposition => &mut self.file.decomposition,
            Current::Homomorphism => &mut self.file.homomorphism,
        }
    }

    /// Reads an item or a production.
    fn item(&mut self) -> Result<(), Fault> {
        let blanks = self.parser.rest().iter().take_while(|letter| super::lines::is_blank(letter.c)).count();
        self.parser.at += blanks;
        if self.parser.peek().is_none_or(|c| c == '\n') {
            return Ok(());
        }
        if let Some((word, length)) = keyword(self.parser.rest()) {
            let place = self.parser.place();
            self.parser.at += length;
            return self.keyed(word, place);
        }
        if self.ended {
            self.parser.at = self.parser.letters.len();
            return Ok(());
        }
        if self.statement_of_paper()? {
            return Ok(());
        }
        let production = self.parser.production()?;
        self.section().productions.push(production);
        Ok(())
    }

    fn keyed(&mut self, word: Keyword, place: Place) -> Result<(), Fault> {
        if self.ended && word != Keyword::System {
            self.parser.at = self.parser.letters.len();
            return Ok(());
        }
        match word {
            Keyword::System if self.ended => {
                self.parser.at = self.parser.letters.len();
                let expected = "one L-system: sub-L-systems are not derived";
                return Err(Fault::new(place, "a second L-system begins", expected));
            }
            Keyword::System => {
                self.file.headed = true;
                self.pass_line();
            }
            Keyword::EndSystem => self.ended = true,
            Keyword::Axiom => self.axiom(place)?,
            Keyword::Ring => self.file.ring = true,
            Keyword::Steps => self.file.steps = Some((place, self.parser.expression()?)),
            Keyword::Depth => self.section().depth = Some((place, self.parser.expression()?)),
            Keyword::Seed => self.section().seed = Some((place, self.parser.expression()?)),
            Keyword::Consider => self.file.consider = Some(self.symbols()?),
            Keyword::Ignore => self.file.ignore = Some(self.symbols()?),
            Keyword::Define => self.file.define = self.parser.block()?,
            Keyword::Start => self.file.start = self.parser.block()?,
            Keyword::StartEach => self.file.start_each = self.parser.block()?,
            Keyword::EndEach => self.file.end_each = self.parser.block()?,
            // What is done after the last step changes no string.
            Keyword::End => drop(self.parser.block()?),
            Keyword::Homomorphism => self.begin(Current::Homomorphism),
            Keyword::Decomposition => self.begin(Current::Decomposition),
        }
        self.parser.ends()
    }

    /// Begins a section; behind its word may stand whether warnings are wanted.
    fn begin(&mut self, current: Current) {
        self.current = current;
        self.pass_line();
    }

    fn pass_line(&mut self) {
        while self.parser.peek().is_some_and(|c| c != '\n') {
            self.parser.at += 1;
        }
    }

    fn axiom(&mut self, place: Place) -> Result<(), Fault> {
        let modules = self.parser.modules()?;
        if self.file.axiom.is_some() {
            return Err(Fault::new(place, "the file has two axioms", "one"));
        }
        self.file.axiom = Some((place, modules));
        Ok(())
    }

    /// The symbols that contexts see, or do not see.
    fn symbols(&mut self) -> Result<Vec<Name>, Fault> {
        let mut names = Vec::new();
        loop {
            self.parser.blanks();
            if self.parser.peek().is_none_or(|c| c == '\n') {
                return Ok(names);
            }
            let place = self.parser.place();
            if let Some(c @ ('*' | ':' | '<' | '>' | '=' | '(' | ')' | '"')) = self.parser.peek() {
                self.parser.at += 1;
                names.push(Name { name: c.to_string(), place });
                continue;
            }
            // A lone `@`, `?` or `~` at the end of the line stands for itself.
            let name = match self.parser.symbol() {
                Ok(name) => name,
                Err(_) => {
                    self.parser.at += usize::from(self.parser.place() == place);
                    continue;
                }
            };
            names.push(Name { name, place });
        }
    }

    /// Reads what only the papers write: ω, `n = …`, `δ = …`, and functions.
    fn statement_of_paper(&mut self) -> Result<bool, Fault> {
        let (start, place) = (self.parser.at, self.parser.place());
        let Some(name) = self.parser.name() else { return Ok(false) };
        self.parser.blanks();
        let equals = self.parser.peek() == Some('=') && self.parser.peek_after(1) != Some('=');
        match name.name.as_str() {
            "ω" | "omega" if self.parser.peek() == Some(':') => {
                self.parser.at += 1;
                self.axiom(place)?;
                self.parser.ends()?;
                return Ok(true);
            }
            // The starting symbol of Aono & Kunii's triple of cells, start and rules.
            "w" if equals && self.parser.cells => {
                self.parser.at += 1;
                self.axiom(place)?;
                self.parser.ends()?;
                return Ok(true);
            }
            "n" | "δ" | "delta" if equals => {
                self.parser.at += 1;
                let value = Some((place, self.parser.expression()?));
                let target = if name.name == "n" { &mut self.file.steps } else { &mut self.file.angle };
                *target = value;
                let _ = self.parser.takes('°');
                let _ = self.parser.takes(',');
                return Ok(true);
            }
            _ => {}
        }
        if self.parser.peek() == Some('(') && self.function(name)? {
            return Ok(true);
        }
        self.parser.at = start;
        Ok(false)
    }

    /// Reads `name(x, y) = expression`, if it is that.
    fn function(&mut self, name: Name) -> Result<bool, Fault> {
        let Ok(parameters) = self.parser.parameters() else { return Ok(false) };
        self.parser.blanks();
        if self.parser.peek() != Some('=') || self.parser.peek_after(1) == Some('=') {
            return Ok(false);
        }
        self.parser.at += 1;
        let body = self.parser.expression()?;
        let _ = self.parser.takes(',') || self.parser.takes('.');
        self.parser.ends()?;
        self.file.functions.push(Function { name, parameters, body });
        Ok(true)
    }
}
