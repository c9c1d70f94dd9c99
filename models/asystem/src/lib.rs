//! The command language of the A-system, the first for trees (Aono & Kunii, *Botanical Tree Image Generation*, IEEE
//! CG&A 4(5), 1984, appendix): a script is read into statements, and its names are checked.
//!
//! [`read`] takes a whole script and tells all that is wrong with it at once; [`Typing`] takes what is typed, statement
//! by statement, with the names that a script has left. `words` cuts a text, `grammar` and `operands` read statements,
//! `names` follows what exists. Absent: what statements do; trees, views and files are the program's.

mod commands;
mod fault;
mod grammar;
mod names;
mod operands;
mod statement;
#[cfg(test)]
mod tests;
mod words;

pub use commands::{COMMANDS, Command, command_of};
pub use fault::{Fault, MOST_FAULTS, Place, Refused};
pub use operands::MOST_LEVELS;
pub use statement::{
    Angles, Colour, Controller, Deformation, Device, GirthForm, Name, Part, Statement, TreeDescriptor, TreeType,
    ViewType, Viewing, WorkstationType,
};

use names::Names;

/// A statement with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The statement.
    pub statement: Statement,
    /// Where it begins.
    pub place: Place,
}

/// A script that can run.
#[derive(Debug, Clone)]
pub struct Script {
    /// Its statements, in their order.
    pub steps: Vec<Step>,
    /// What is typed goes on with its names.
    pub typing: Typing,
}

/// What is typed after a script, with the names that there are.
#[derive(Debug, Clone, Default)]
pub struct Typing {
    names: Names,
}

impl Typing {
    /// Takes some statements. Linear in the text, but for the search of the nearest spelling of a wrong word.
    ///
    /// # Errors
    /// All that is wrong with them; nothing of them is then taken.
    pub fn take(&mut self, text: &str) -> Result<Vec<Step>, Refused> {
        let mut names = self.names.clone();
        names.go_on();
        let (steps, faults) = steps(text, &mut names);
        match Refused::of(faults) {
            Some(refused) => Err(refused),
            None => {
                self.names = names;
                Ok(steps)
            }
        }
    }

    /// Whether the last statement was `exit` or `local`.
    pub fn has_ended(&self) -> bool {
        self.names.have_ended()
    }
}

/// Reads a script. Linear in the text, but for the search of the nearest spelling of a wrong word.
///
/// # Errors
/// All that is wrong with it, in the order of the text.
pub fn read(text: &str) -> Result<Script, Refused> {
    let mut names = Names::default();
    let (steps, faults) = steps(text, &mut names);
    match Refused::of(faults) {
        Some(refused) => Err(refused),
        None => Ok(Script { steps, typing: Typing { names } }),
    }
}

fn steps(text: &str, names: &mut Names) -> (Vec<Step>, Vec<Fault>) {
    let (sentences, mut faults) = words::sentences(text);
    let mut steps = Vec::with_capacity(sentences.len());
    for sentence in &sentences {
        let place = sentence.words[0].place;
        match grammar::statement(sentence) {
            Ok(statement) => {
                faults.extend(names.take(&statement, place));
                steps.push(Step { statement, place });
            }
            Err(fault) => faults.push(fault),
        }
    }
    (steps, faults)
}
