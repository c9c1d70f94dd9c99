//! Lines and words of the texts beside an L-system, each word with its line and column, and what is wrong in them.
//!
//! Lines and columns count from 1, columns in characters. White space and commas part words. Absent: what the words
//! mean (`settings`, `surface`, `function`).

use std::fmt;

/// The longest text that is read, bytes: the longest public file of these kinds has some ten thousand.
pub const MOST_BYTES: usize = 1 << 20;

/// What is wrong in a text, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextFault {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1, in characters.
    pub column: u32,
    /// What is wrong, in a sentence without a full stop.
    pub problem: String,
    /// What would be right.
    pub expected: String,
}

impl fmt::Display for TextFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}; expected {}", self.line, self.column, self.problem, self.expected)
    }
}

/// A word, or the end of a line where `text` is empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Word<'t> {
    pub text: &'t str,
    pub line: u32,
    pub column: u32,
}

impl Word<'_> {
    /// A fault at this word.
    pub fn fault(&self, expected: &str) -> TextFault {
        let problem = if self.text.is_empty() {
            "the line ends here".to_owned()
        } else {
            format!("`{}` stands here", short(self.text))
        };
        TextFault { line: self.line, column: self.column, problem, expected: expected.to_owned() }
    }

    /// A finite number.
    pub fn number(&self, expected: &str) -> Result<f64, TextFault> {
        let number = self.text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| self.fault(expected))
    }
}

/// The beginning of a text, so that a message stays short.
fn short(text: &str) -> String {
    const MOST: usize = 40;
    let mut shown: String = text.chars().take(MOST).collect();
    if text.chars().count() > MOST {
        shown.push('…');
    }
    shown
}

/// A line of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Line<'t> {
    pub text: &'t str,
    pub number: u32,
    /// The column of its first character.
    pub column: u32,
}

impl<'t> Line<'t> {
    /// The part of the line behind the first `separator`, and the part before it, both trimmed.
    pub fn split(&self, separator: char) -> Option<(&'t str, Line<'t>)> {
        let (before, after) = self.text.split_once(separator)?;
        let column = self.column + before.chars().count() as u32 + 1;
        Some((before.trim(), Line { text: after, number: self.number, column }))
    }

    /// The words that `parts` separates.
    pub fn words_between(&self, parts: impl Fn(char) -> bool) -> Vec<Word<'t>> {
        let mut words: Vec<Word<'t>> = Vec::new();
        let mut start = None;
        let ends = self.text.char_indices().chain([(self.text.len(), ' ')]);
        for (column, (at, character)) in (self.column..).zip(ends) {
            match (start, at == self.text.len() || parts(character)) {
                (None, false) => start = Some((at, column)),
                (Some((from, column)), true) => {
                    words.push(Word { text: &self.text[from..at], line: self.number, column });
                    start = None;
                }
                _ => {}
            }
        }
        words
    }

    /// The words between white space and commas, one by one.
    pub fn words(&self) -> Words<'t> {
        let end = Word { text: "", line: self.number, column: self.column + self.text.chars().count() as u32 };
        let mut left = self.words_between(|character| character.is_whitespace() || character == ',');
        left.reverse();
        Words { left, end }
    }
}

/// The words of a line that are still to be read.
#[derive(Debug, Clone)]
pub(super) struct Words<'t> {
    /// The last word first.
    left: Vec<Word<'t>>,
    end: Word<'t>,
}

impl<'t> Words<'t> {
    /// The next word, or the end of the line.
    pub fn next(&mut self) -> Word<'t> {
        self.left.pop().unwrap_or(self.end)
    }

    /// The place where the line ends.
    pub fn end(&self) -> Word<'t> {
        self.end
    }

    /// The next word, which must be there.
    pub fn text(&mut self, expected: &str) -> Result<Word<'t>, TextFault> {
        let word = self.next();
        if word.text.is_empty() { Err(word.fault(expected)) } else { Ok(word) }
    }

    /// The next word as a number.
    pub fn number(&mut self, expected: &str) -> Result<f64, TextFault> {
        self.next().number(expected)
    }

    /// The next word as a whole number from `least` to `most`.
    pub fn whole(&mut self, least: i32, most: i32, expected: &str) -> Result<i32, TextFault> {
        let word = self.next();
        let number = word.text.parse().ok().filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| word.fault(expected))
    }

    /// Three numbers.
    pub fn triple(&mut self, expected: &str) -> Result<[f64; 3], TextFault> {
        Ok([self.number(expected)?, self.number(expected)?, self.number(expected)?])
    }
}

/// The lines of a text.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    (1..).zip(text.lines()).map(|(number, text)| Line { text, number, column: 1 })
}

/// The lines of a text that are not blank.
pub(super) fn full_lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    lines(text).filter(|line| !line.text.trim().is_empty())
}

/// The text with a blank in the place of each character of a comment, so that lines and columns stay: `/* … */`, and
/// `//` up to the end of its line where it begins the line or follows white space.
pub(super) fn without_comments(text: &str) -> String {
    let mut left = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    let mut before = '\n';
    // Within `/* … */`, and within `//` up to the end of the line.
    let (mut block, mut line) = (false, false);
    while let Some(character) = rest.next() {
        let pair = (character, rest.peek().copied());
        let ends = block && pair == ('*', Some('/'));
        let begins = !block && !line && pair == ('/', Some('*'));
        line = match pair {
            ('\n', _) => false,
            ('/', Some('/')) => line || (!block && before.is_whitespace()),
            _ => line,
        };
        let hidden = (block || line || begins) && character != '\n';
        left.push(if hidden { ' ' } else { character });
        before = character;
        if begins || ends {
            left.push(' ');
            before = ' ';
            rest.next();
        }
        block = (block || begins) && !ends;
    }
    left
}

/// A fault where a text is longer than [`MOST_BYTES`].
pub(super) fn bounded(length: usize) -> Result<(), TextFault> {
    if length <= MOST_BYTES {
        return Ok(());
    }
    let problem = format!("the file has {length} bytes");
    Err(TextFault { line: 1, column: 1, problem, expected: format!("at most {MOST_BYTES}") })
}
