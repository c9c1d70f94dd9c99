//! The lines that begin with `#`: macros, conditions and included files.
//!
//! `#` is also a module: a line is a directive if the word behind its `#` is one. Lines in a branch that is not taken
//! are passed over, but for the directives that end it.

use super::condition::holds;
use super::macros::{Broken, Macro, Macros};
use super::strange::foreign;
use crate::fault::{Fault, Place};
use crate::letters::{Letter, letters};
use std::collections::VecDeque;

/// The most files within files.
const DEEPEST: usize = 16;
/// The most bytes of a file and of all files that it includes.
const MOST_BYTES: usize = 16_000_000;
/// The most lines over which the arguments of a macro go on.
const MOST_LINES: usize = 100;

/// After so many faults the rest of a file is not read.
const MOST_BROKEN: usize = 1000;

/// What is needed to prepare a text.
pub(crate) struct Asked<'a> {
    /// The name of the file.
    pub name: &'a str,
    /// The texts of included files.
    pub include: &'a dyn Fn(&str) -> Result<String, String>,
    /// Constants that the caller sets.
    pub define: &'a [(String, f64)],
}

/// What stands in a file and in all files that it includes.
pub(crate) struct Prepared {
    /// The letters of the program.
    pub letters: Vec<Letter>,
    /// The names of the files.
    pub files: Vec<String>,
    /// The constants that were set and that no file names.
    pub unknown: Vec<String>,
}

/// The letters of a program and of all files that it includes.
pub(crate) fn prepare(text: &str, asked: &Asked<'_>, faults: &mut Vec<Fault>) -> Prepared {
    let mut reader = Reader {
        asked,
        faults,
        files: vec![asked.name.to_owned()],
        macros: Macros::default(),
        branches: Vec::new(),
        out: Vec::new(),
        open_files: 0,
        bytes: 0,
        exhausted: false,
    };
    asked.define.iter().for_each(|(name, value)| reader.macros.fix(name, *value));
    reader.file(text, 0);
    let unknown = asked.define.iter().map(|(name, _)| name).filter(|name| !reader.macros.met.contains(*name));
    let unknown = unknown.cloned().collect();
    Prepared { letters: reader.out, files: reader.files, unknown }
}

/// A branch of `#if`: whether it is taken, whether one before it was, and where it began.
struct Branch {
    taken: bool,
    done: bool,
    place: Place,
}

struct Reader<'a, 'f> {
    asked: &'a Asked<'a>,
    faults: &'f mut Vec<Fault>,
    files: Vec<String>,
    macros: Macros,
    branches: Vec<Branch>,
    out: Vec<Letter>,
    open_files: usize,
    /// How long all texts are that were read.
    bytes: usize,
    exhausted: bool,
}

impl Reader<'_, '_> {
    fn file(&mut self, text: &str, number: u32) {
        self.bytes += text.len();
        if self.bytes > MOST_BYTES {
            let place = Place { file: number, line: 1, column: 1 };
            let expected = format!("at most {MOST_BYTES} bytes in all");
            self.faults.push(Fault::new(place, "the files are too long", expected));
            self.exhausted = true;
            return;
        }
        let kept = letters(text, number, self.faults);
        let mut lines: VecDeque<Vec<Letter>> =
            kept.split_inclusive(|letter| letter.c == '\n').map(<[Letter]>::to_vec).collect();
        if let Some(fault) = lines.iter().find_map(|line| foreign(line)) {
            self.faults.push(fault);
            return;
        }
        let (before, depth) = (self.branches.len(), self.open_files);
        self.open_files += 1;
        while let Some(mut line) = lines.pop_front().filter(|_| !self.exhausted && self.faults.len() < MOST_BROKEN) {
            if let Some((word, place, rest)) = directive(&line) {
                self.directive(&word, place, &rest);
                continue;
            }
            if self.branches.last().is_some_and(|branch| !branch.taken) {
                continue;
            }
            for _ in 0..MOST_LINES {
                let goes_on = self.macros.is_open(&line) && lines.front().is_some_and(|next| directive(next).is_none());
                let Some(next) = lines.pop_front_if(|_| goes_on) else { break };
                line.iter_mut().filter(|letter| letter.c == '\n').for_each(|letter| letter.c = ' ');
                line.extend(next);
            }
            let result = self.macros.expand(&line, &mut self.out);
            self.note(result);
        }
        self.open_files = depth;
        for branch in self.branches.split_off(before.min(self.branches.len())) {
            self.faults.push(Fault::new(branch.place, "a condition begins and does not end", "`#endif` at its end"));
        }
        self.end_line();
    }

    /// A file ends its last line.
    fn end_line(&mut self) {
        if let Some(last) = self.out.last().filter(|last| last.c != '\n') {
            let place = last.place;
            self.out.push(Letter { c: '\n', place });
        }
    }

    fn note(&mut self, result: Result<(), Broken>) {
        if let Err(broken) = result {
            self.faults.push(broken.fault);
            self.exhausted |= broken.exhausted;
        }
    }

    fn directive(&mut self, word: &str, place: Place, rest: &[Letter]) {
        let passed = self.branches.last().is_some_and(|branch| !branch.taken);
        match word {
            "if" | "ifdef" | "ifndef" => {
                let taken = !passed && self.condition(word, place, rest);
                self.branches.push(Branch { taken, done: taken || passed, place });
            }
            "elif" | "else" | "endif" => self.branch(word, place, rest),
            _ if passed => {}
            "define" => self.define(place, rest),
            "undef" => self.macros.remove(&name_of(rest).0),
            "include" => self.include(place, rest),
            "error" => {
                let said: String = rest.iter().map(|letter| letter.c).collect();
                self.faults.push(Fault::new(place, format!("the file says: {}", said.trim()), "another condition"));
            }
            _ => {}
        }
    }

    fn condition(&mut self, word: &str, place: Place, rest: &[Letter]) -> bool {
        match word {
            "ifdef" => self.macros.is_defined(&name_of(rest).0),
            "ifndef" => !self.macros.is_defined(&name_of(rest).0),
            _ => holds(rest, place, &mut self.macros).unwrap_or_else(|broken| {
                self.note(Err(broken));
                false
            }),
        }
    }

    fn branch(&mut self, word: &str, place: Place, rest: &[Letter]) {
        let Some(mut branch) = self.branches.pop() else {
            self.faults.push(Fault::new(place, format!("`#{word}` ends no condition"), "`#if` before it"));
            return;
        };
        if word == "endif" {
            return;
        }
        let outer = self.branches.last().is_none_or(|branch| branch.taken);
        branch.taken = outer && !branch.done && (word == "else" || self.condition("if", place, rest));
        branch.done |= branch.taken;
        self.branches.push(branch);
    }

    fn define(&mut self, place: Place, rest: &[Letter]) {
        let (name, behind) = name_of(rest);
        if name.is_empty() {
            self.faults.push(Fault::new(place, "`#define` without a name", "a name of letters and digits"));
            return;
        }
        let (parameters, body) = match behind.first() {
            Some(letter) if letter.c == '(' => {
                let Some(close) = behind.iter().position(|letter| letter.c == ')') else {
                    let problem = format!("the arguments of `{name}` do not end");
                    self.faults.push(Fault::new(place, problem, "`)`"));
                    return;
                };
                let list: String = behind[1..close].iter().map(|letter| letter.c).collect();
                let list = list.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty());
                (Some(list.collect()), &behind[close + 1..])
            }
            _ => (None, behind),
        };
        let blank = |letter: &Letter| letter.c.is_whitespace();
        let start = body.iter().position(|letter| !blank(letter)).unwrap_or(body.len());
        let end = body.iter().rposition(|letter| !blank(letter)).map_or(start, |last| last + 1);
        self.macros.define(name, Macro { parameters, body: body[start..end].to_vec(), fixed: false });
    }

    fn include(&mut self, place: Place, rest: &[Letter]) {
        let said: String = rest.iter().map(|letter| letter.c).collect();
        let said = said.trim();
        let quoted = said.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).filter(|name| !name.is_empty());
        let Some(name) = quoted else {
            self.faults.push(Fault::new(
                place,
                format!("`#include {said}`"),
                "a file of its folder: `#include \"name\"`",
            ));
            return;
        };
        if self.open_files >= DEEPEST || self.files.len() > 1000 {
            let problem = format!("`{name}` is included within {} files", self.open_files);
            self.faults.push(Fault::new(
                place,
                problem,
                format!("at most {DEEPEST}, and no file that includes itself"),
            ));
            return;
        }
        match (self.asked.include)(name) {
            Ok(text) => {
                let number = self.files.len() as u32;
                self.files.push(name.to_owned());
                self.end_line();
                self.file(&text, number);
            }
            Err(why) => self.faults.push(Fault::new(
                place,
                format!("`{name}` cannot be included: {why}"),
                "a file that can be read",
            )),
        }
    }
}

/// The word of a directive, its place, and the letters behind it.
fn directive(line: &[Letter]) -> Option<(String, Place, Vec<Letter>)> {
    const WORDS: [&str; 11] =
        ["define", "undef", "include", "if", "ifdef", "ifndef", "elif", "else", "endif", "error", "pragma"];
    let mut letters = line.iter().skip_while(|letter| matches!(letter.c, ' ' | '\t'));
    let place = letters.next().filter(|letter| letter.c == '#')?.place;
    let rest: Vec<Letter> = letters.copied().collect();
    let (word, behind) = name_of(&rest);
    WORDS.contains(&word.as_str()).then(|| (word, place, behind.to_vec()))
}

/// The first word of some letters, and what stands behind it.
fn name_of(letters: &[Letter]) -> (String, &[Letter]) {
    let start = letters.iter().take_while(|letter| matches!(letter.c, ' ' | '\t')).count();
    let is_word = |letter: &&Letter| letter.c.is_alphanumeric() || letter.c == '_';
    let length = letters[start..].iter().take_while(is_word).count();
    let name = letters[start..start + length].iter().map(|letter| letter.c).collect();
    (name, &letters[start + length..])
}
