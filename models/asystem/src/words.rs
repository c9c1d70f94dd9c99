//! The words of a script: names, numbers and braces, in statements that a semicolon ends.
//!
//! Words stand apart by blanks, tabs and ends of lines. `//` begins a remark to the end of its line, `/*` one up to
//! `*/`. Absent: what words mean (`operands`).

use super::fault::{Fault, Place};

/// The longest word, in characters.
const LONGEST: usize = 200;

/// A word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Word<'a> {
    /// Its text: `{`, `}`, or neither.
    pub text: &'a str,
    /// Where it begins.
    pub place: Place,
}

/// The words of a statement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sentence<'a> {
    /// The words; at least one.
    pub words: Vec<Word<'a>>,
    /// Where its semicolon stands.
    pub end: Place,
}

/// Cuts a script into statements; those that are not well formed are left out, and told.
pub fn sentences(script: &str) -> (Vec<Sentence<'_>>, Vec<Fault>) {
    let mut reading = Reading { rest: script, at: Place { line: 1, column: 1 }, faults: Vec::new() };
    let (mut sentences, mut words) = (Vec::new(), Vec::new());
    while let Some((text, place)) = reading.next() {
        if text != ";" {
            words.push(Word { text, place });
        } else if !words.is_empty() {
            let sentence = Sentence { words: std::mem::take(&mut words), end: place };
            if balanced(&sentence, &mut reading.faults) {
                sentences.push(sentence);
            }
        }
    }
    if let Some(first) = words.first() {
        let problem = format!("the statement `{}` does not end", clip(first.text));
        reading.faults.push(Fault::new(first.place, problem, "a semicolon after its last word"));
    }
    (sentences, reading.faults)
}

/// Tells braces that are not closed, or close nothing.
fn balanced(sentence: &Sentence, faults: &mut Vec<Fault>) -> bool {
    let (mut open, before) = (Vec::new(), faults.len());
    for word in &sentence.words {
        match word.text {
            "{" => open.push(word.place),
            "}" if open.pop().is_none() => {
                faults.push(Fault::new(word.place, "this brace closes nothing", "an opening brace before it"));
            }
            _ => {}
        }
    }
    let unclosed = |place| Fault::new(place, "this brace is not closed", "a closing brace before the semicolon");
    faults.extend(open.into_iter().map(unclosed));
    faults.len() == before
}

/// The beginning of a text, for a message.
pub fn clip(text: &str) -> String {
    let mut clipped: String = text.chars().take(40).collect();
    if clipped.len() < text.len() {
        clipped.push('…');
    }
    clipped
}

struct Reading<'a> {
    rest: &'a str,
    at: Place,
    faults: Vec<Fault>,
}

impl<'a> Reading<'a> {
    /// The next word, brace or semicolon.
    fn next(&mut self) -> Option<(&'a str, Place)> {
        self.skip();
        let place = self.at;
        let first = self.rest.chars().next()?;
        let ends = |c: char| c.is_whitespace() || "{};".contains(c);
        let length = if "{};".contains(first) { 1 } else { self.rest.find(ends).unwrap_or(self.rest.len()) };
        // A remark may follow a word at once.
        let remark = self.rest[..length].find("//").into_iter().chain(self.rest[..length].find("/*")).min();
        let text = self.pass(remark.filter(|at| *at > 0).unwrap_or(length));
        if text.chars().count() > LONGEST {
            self.faults.push(Fault::new(place, "this word is very long", format!("at most {LONGEST} characters")));
        }
        Some((text, place))
    }

    /// Goes on by some bytes.
    fn pass(&mut self, bytes: usize) -> &'a str {
        let (passed, rest) = self.rest.split_at(bytes);
        for c in passed.chars() {
            self.at = match c {
                '\n' => Place { line: self.at.line + 1, column: 1 },
                _ => Place { column: self.at.column + 1, ..self.at },
            };
        }
        self.rest = rest;
        passed
    }

    /// Goes on to the next character that is neither blank nor part of a remark.
    fn skip(&mut self) {
        loop {
            let blank = self.rest.len() - self.rest.trim_start().len();
            self.pass(blank);
            if self.rest.starts_with("//") {
                self.pass(self.rest.find('\n').unwrap_or(self.rest.len()));
            } else if self.rest.starts_with("/*") {
                let place = self.at;
                let end = self.rest.find("*/").map(|at| at + 2);
                self.pass(end.unwrap_or(self.rest.len()));
                if end.is_none() {
                    self.faults.push(Fault::new(place, "this remark does not end", "`*/` after it"));
                }
            } else {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(script: &str) -> Vec<Vec<&str>> {
        sentences(script).0.iter().map(|s| s.words.iter().map(|word| word.text).collect()).collect()
    }

    #[test]
    fn a_script_is_cut_into_statements_with_places() {
        let script = "exit;\n /* two\nlines */ defer 0.5 ; // last\n;;color{a}#0f0;";
        assert_eq!(texts(script), [vec!["exit"], vec!["defer", "0.5"], vec!["color", "{", "a", "}", "#0f0"]]);
        let (all, faults) = sentences(script);
        assert!(faults.is_empty(), "{faults:?}");
        assert_eq!(all[1].words[0].place, Place { line: 3, column: 10 });
        assert_eq!(all[2].words[2].place, Place { line: 4, column: 9 });
        assert_eq!(texts("exit//now\n;"), [["exit"]]);
    }

    #[test]
    fn what_is_not_well_formed_is_told_with_its_place() {
        let told = |script| sentences(script).1.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        assert!(told("exit").contains("1:1: the statement `exit` does not end"));
        assert!(told("exit; /* ").contains("1:7: this remark does not end"));
        assert!(told("color { a 1 2 3;").contains("1:7: this brace is not closed"));
        assert!(told("color a } 1 2 3;").contains("1:9: this brace closes nothing"));
        assert!(told(&format!("{};", "x".repeat(300))).contains("1:1: this word is very long"));
    }
}
