//! Macros: `#define` with and without arguments, and their expansion, as the C preprocessor does it.
//!
//! A name is expanded where it stands as a word of its own, so `A` is not expanded in `AXIOM` or `FA`. A macro is not
//! expanded within itself. What a macro makes stands at the place of its name. Absent: `#` and `##` in bodies, where
//! `#` is a module.

use crate::fault::{Fault, Place};
use crate::letters::Letter;
use std::collections::BTreeMap;

/// The most letters of a program: beyond them a macro grows without end.
pub(super) const MOST_LETTERS: usize = 1_000_000;
/// The most macros within macros.
const DEEPEST: usize = 100;

/// What a name stands for.
#[derive(Debug, Clone)]
pub(super) struct Macro {
    /// The names of the arguments; `None` for a macro without parentheses.
    pub parameters: Option<Vec<String>>,
    pub body: Vec<Letter>,
    /// A constant that the caller has set: a `#define` of its name has no effect.
    pub fixed: bool,
}

/// The macros that are defined at a place of the text.
#[derive(Debug, Default)]
pub(super) struct Macros {
    table: BTreeMap<String, Macro>,
    /// The names that were expanded or defined.
    pub met: std::collections::BTreeSet<String>,
    /// The letters made so far, in all expansions.
    made: usize,
    /// The arguments that are expanded within one another.
    within: usize,
}

/// Why an expansion ends: a fault, and whether nothing more is to be read.
pub(super) struct Broken {
    pub fault: Fault,
    pub exhausted: bool,
}

impl Macros {
    pub fn define(&mut self, name: String, definition: Macro) {
        self.met.insert(name.clone());
        if !self.table.get(&name).is_some_and(|old| old.fixed) {
            self.table.insert(name, definition);
        }
    }

    /// Sets a constant that no `#define` changes.
    pub fn fix(&mut self, name: &str, value: f64) {
        let body = format!("({value})").chars().map(|c| Letter { c, place: Place::default() }).collect();
        self.table.insert(name.to_owned(), Macro { parameters: None, body, fixed: true });
    }

    pub fn remove(&mut self, name: &str) {
        if !self.table.get(name).is_some_and(|old| old.fixed) {
            self.table.remove(name);
        }
    }

    pub fn is_defined(&mut self, name: &str) -> bool {
        let defined = self.table.contains_key(name);
        if defined {
            self.met.insert(name.to_owned());
        }
        defined
    }

    /// Whether the last call of a macro in these letters has arguments that do not end in them.
    pub fn is_open(&self, letters: &[Letter]) -> bool {
        let mut at = 0;
        while at < letters.len() {
            let end = word_end(letters, at);
            let name: String = letters[at..end].iter().map(|letter| letter.c).collect();
            at = end;
            if self.table.get(&name).is_some_and(|found| found.parameters.is_some())
                && let Some(open) = opening(letters, at)
            {
                let Some((_, close)) = arguments(letters, open) else { return true };
                at = close;
            }
        }
        false
    }

    /// Appends the letters with all macros expanded.
    pub fn expand(&mut self, letters: &[Letter], out: &mut Vec<Letter>) -> Result<(), Broken> {
        self.within = 0;
        self.expand_within(letters, &mut Vec::new(), out)
    }

    fn expand_within(
        &mut self,
        letters: &[Letter],
        hidden: &mut Vec<String>,
        out: &mut Vec<Letter>,
    ) -> Result<(), Broken> {
        let mut at = 0;
        while at < letters.len() {
            let end = word_end(letters, at);
            let word = &letters[at..end];
            if !word[0].c.is_alphabetic() && word[0].c != '_' {
                self.keep(word, out)?;
                at = end;
                continue;
            }
            let name: String = word.iter().map(|letter| letter.c).collect();
            // A call is as long as the macro, of which it makes a copy.
            let length = |found: &Macro| 1 + found.body.len() + found.parameters.as_ref().map_or(0, Vec::len);
            let called = self.table.get(&name).filter(|_| !hidden.contains(&name));
            let length = called.map_or(0, length);
            self.count(length, word)?;
            at = match self.table.get(&name).filter(|_| !hidden.contains(&name)).cloned() {
                Some(found) => self.call(&name, found, letters, (at, end), hidden, out)?,
                None => {
                    self.keep(word, out)?;
                    end
                }
            };
        }
        Ok(())
    }

    fn keep(&mut self, letters: &[Letter], out: &mut Vec<Letter>) -> Result<(), Broken> {
        self.count(letters.len(), letters)?;
        out.extend_from_slice(letters);
        Ok(())
    }

    /// Counts what is made, and calls, which may make nothing.
    fn count(&mut self, more: usize, at: &[Letter]) -> Result<(), Broken> {
        self.made += more;
        if self.made <= MOST_LETTERS {
            return Ok(());
        }
        let problem = format!("the text has more than {MOST_LETTERS} letters when its macros are expanded");
        let place = at.first().map_or(Place::default(), |letter| letter.place);
        Err(Broken { fault: Fault::new(place, problem, "macros that do not multiply one another"), exhausted: true })
    }

    /// Expands the macro `name`, which stands at a range of the letters; returns where to go on.
    fn call(
        &mut self,
        name: &str,
        found: Macro,
        letters: &[Letter],
        (start, end): (usize, usize),
        hidden: &mut Vec<String>,
        out: &mut Vec<Letter>,
    ) -> Result<usize, Broken> {
        let place = letters[start].place;
        let broken = |problem: String, expected: String| Broken {
            fault: Fault::new(place, problem, expected),
            exhausted: false,
        };
        self.met.insert(name.to_owned());
        if hidden.len() + self.within >= DEEPEST {
            return Err(broken(format!("`{name}` stands within {DEEPEST} macros"), "fewer".to_owned()));
        }
        let (mut given, mut next) = (Vec::new(), end);
        if let Some(parameters) = &found.parameters {
            let Some(open) = opening(letters, end) else {
                self.keep(&letters[start..end], out)?;
                return Ok(end);
            };
            let Some((list, close)) = arguments(letters, open) else {
                return Err(broken(format!("the arguments of `{name}` do not end"), "`)`".to_owned()));
            };
            let count = if parameters.is_empty() && list.iter().all(|a| a.iter().all(|l| l.c.is_whitespace())) {
                0
            } else {
                list.len()
            };
            if count != parameters.len() {
                let expected =
                    format!("{}: `{name}({})`", parameters.len(), parameters[..parameters.len().min(12)].join(", "));
                return Err(broken(format!("`{name}` has {count} arguments"), expected));
            }
            self.within += 1;
            for argument in list.iter().take(count) {
                let mut expanded = Vec::new();
                self.expand_within(argument, hidden, &mut expanded)?;
                given.push(expanded);
            }
            self.within -= 1;
            next = close;
        }
        let mut body = substituted(&found, &given);
        body.iter_mut().for_each(|letter| letter.place = place);
        if body.len() > MOST_LETTERS {
            self.keep(&body, out)?;
        }
        hidden.push(name.to_owned());
        let result = self.expand_within(&body, hidden, out);
        hidden.pop();
        result.map(|()| next)
    }
}

/// The body of a macro with its arguments in their places.
fn substituted(found: &Macro, given: &[Vec<Letter>]) -> Vec<Letter> {
    let Some(parameters) = &found.parameters else { return found.body.clone() };
    let (mut body, mut at) = (Vec::new(), 0);
    while at < found.body.len() && body.len() <= MOST_LETTERS {
        let end = word_end(&found.body, at);
        let word = &found.body[at..end];
        let name: String = word.iter().map(|letter| letter.c).collect();
        match parameters.iter().position(|parameter| *parameter == name).and_then(|number| given.get(number)) {
            Some(argument) => body.extend_from_slice(argument),
            None => body.extend_from_slice(word),
        }
        at = end;
    }
    body
}

/// Where the word, the number, the text in quotation marks or the single letter at `at` ends.
pub(super) fn word_end(letters: &[Letter], at: usize) -> usize {
    let is_word = |letter: &Letter| letter.c.is_alphanumeric() || letter.c == '_';
    let from = |start: usize, goes_on: &dyn Fn(&Letter) -> bool| {
        letters[start..].iter().position(|letter| !goes_on(letter)).map_or(letters.len(), |length| start + length)
    };
    match letters[at].c {
        '"' => {
            let close = letters[at + 1..].iter().position(|letter| letter.c == '"' || letter.c == '\n');
            close.map_or(at + 1, |length| at + length + 2)
        }
        c if c.is_ascii_digit() => from(at, &|letter| is_word(letter) || letter.c == '.'),
        c if c.is_alphanumeric() || c == '_' => from(at, &is_word),
        _ => at + 1,
    }
}

/// Where the parenthesis behind a macro's name opens.
fn opening(letters: &[Letter], after: usize) -> Option<usize> {
    let blanks = letters[after..].iter().take_while(|letter| matches!(letter.c, ' ' | '\t')).count();
    letters.get(after + blanks).filter(|letter| letter.c == '(').map(|_| after + blanks)
}

/// The arguments in the parentheses that open at `open`, and where to go on behind them.
fn arguments(letters: &[Letter], open: usize) -> Option<(Vec<Vec<Letter>>, usize)> {
    let (mut list, mut depth) = (vec![Vec::new()], 0_usize);
    for (number, &letter) in letters[open..].iter().enumerate() {
        match letter.c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        match letter.c {
            ')' if depth == 0 => return Some((list, open + number + 1)),
            '(' if depth == 1 => {}
            ',' if depth == 1 => list.push(Vec::new()),
            _ => list.last_mut()?.push(letter),
        }
    }
    None
}
