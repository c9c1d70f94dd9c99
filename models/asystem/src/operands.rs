//! The operands of a statement, one after the other: names, numbers, growth levels, flags, colours, places and words of
//! a list, and the groups that the grammar has in braces.
//!
//! Braces may stand around an operand, or a list of operands, that may be left out; they say the same as none. Absent:
//! which operands a statement has (`grammar`).

use super::fault::{Fault, Place};
use super::statement::{Colour, Device, Name, TreeType, ViewType, WorkstationType};
use super::words::{Sentence, Word, clip};
use std::ops::RangeInclusive;

/// The most growth levels of a tree; one of two children then has 2²⁹ − 1 branches.
pub const MOST_LEVELS: u32 = 28;

/// The longest name, in characters.
const LONGEST_NAME: usize = 64;

/// A flag's words.
const FLAGS: [(&str, bool); 4] = [("on", true), ("off", false), ("1", true), ("0", false)];

pub const TREE_TYPES: [(&str, TreeType); 4] =
    [("gmt1", TreeType::Gmt1), ("gmt2", TreeType::Gmt2), ("gmt3", TreeType::Gmt3), ("gmt4", TreeType::Gmt4)];
pub const VIEW_TYPES: [(&str, ViewType); 5] = [
    ("top", ViewType::Top),
    ("front", ViewType::Front),
    ("side", ViewType::Side),
    ("oblique", ViewType::Oblique),
    ("perspective", ViewType::Perspective),
];
pub const WORKSTATION_TYPES: [(&str, WorkstationType); 3] =
    [("display", WorkstationType::Display), ("plotter", WorkstationType::Plotter), ("model", WorkstationType::Model)];
pub const DEVICES: [(&str, Device); 5] = [
    ("pick", Device::Pick),
    ("keyboard", Device::Keyboard),
    ("locator", Device::Locator),
    ("valuator", Device::Valuator),
    ("display", Device::Display),
];

/// What is read, or the fault that stands in its way.
pub type Read<T> = Result<T, Fault>;

/// A reader of the operands of one statement.
pub struct Operands<'s, 'a> {
    words: &'s [Word<'a>],
    end: Place,
}

impl<'s, 'a> Operands<'s, 'a> {
    /// The operands of a statement: all its words but the first.
    pub fn of(sentence: &'s Sentence<'a>) -> Self {
        Self { words: &sentence.words[1..], end: sentence.end }
    }

    /// The operands of some words before an end.
    pub fn among(words: &'s [Word<'a>], end: Place) -> Self {
        Self { words, end }
    }

    /// The words that are left, without braces.
    pub fn flat(&self) -> Vec<Word<'a>> {
        self.words.iter().filter(|word| !is_brace(word.text)).cloned().collect()
    }

    /// Where the next word stands, or the end of the statement.
    pub fn place(&self) -> Place {
        self.words.first().map_or(self.end, |word| word.place)
    }

    /// The next word, which stays.
    pub fn peek(&self) -> Option<&'a str> {
        self.words.first().map(|word| word.text)
    }

    /// Whether a word is left in the present group.
    pub fn more(&self) -> bool {
        self.peek().is_some_and(|text| text != "}")
    }

    /// Goes on to the end of the statement.
    pub fn skip(&mut self) {
        self.words = &[];
    }

    /// Goes on by one word.
    pub fn skip_word(&mut self) {
        self.words = self.words.get(1..).unwrap_or_default();
    }

    /// Tells words that are left.
    pub fn finish(&self) -> Read<()> {
        match self.words.first() {
            None => Ok(()),
            Some(word) => {
                let problem = format!("`{}` is more than the statement takes", clip(word.text));
                Err(Fault::new(word.place, problem, "a semicolon"))
            }
        }
    }

    fn word(&mut self, what: &str) -> Read<&'s Word<'a>> {
        match self.words.split_first() {
            Some((word, rest)) if !is_brace(word.text) => {
                self.words = rest;
                Ok(word)
            }
            found => {
                let problem = found.map_or_else(
                    || "the statement ends here".to_owned(),
                    |(word, _)| format!("here is `{}`", word.text),
                );
                Err(Fault::new(self.place(), problem, what))
            }
        }
    }

    /// What may be left out: nothing where no word is left in the present group.
    pub fn optional<T>(&mut self, read: impl FnOnce(&mut Self) -> Read<T>) -> Read<Option<T>> {
        if !self.more() {
            return Ok(None);
        }
        if self.peek() != Some("{") {
            return read(self).map(Some);
        }
        self.words = &self.words[1..];
        let value = if self.more() { Some(read(self)?) } else { None };
        match self.words.split_first() {
            Some((word, rest)) if word.text == "}" => self.words = rest,
            _ => {
                return Err(Fault::new(self.place(), "the braces hold more than belongs into them", "a closing brace"));
            }
        }
        Ok(value)
    }

    /// What may be repeated, as often as words are left in the present group.
    pub fn many<T>(&mut self, mut read: impl FnMut(&mut Self) -> Read<T>) -> Read<Vec<T>> {
        let mut all = Vec::new();
        while self.more() {
            all.extend(self.optional(&mut read)?);
        }
        Ok(all)
    }

    /// A name: at most 64 letters, digits and underscores, the first no digit, and no flag.
    pub fn name(&mut self, what: &str) -> Read<Name> {
        let word = self.word(what)?;
        if is_name(word.text) {
            return Ok(Name { text: word.text.to_owned(), place: word.place });
        }
        let problem = format!("`{}` is no name", clip(word.text));
        let expected = format!("{what}: at most {LONGEST_NAME} letters, digits and underscores, the first no digit");
        Err(Fault::new(word.place, problem, expected))
    }

    /// A number.
    pub fn number(&mut self, what: &str) -> Read<f64> {
        let word = self.word(what)?;
        let number = word.text.parse::<f64>().ok().filter(|number| number.abs() <= 1e9);
        number.ok_or_else(|| {
            let problem = format!("`{}` is no number between −10⁹ and 10⁹", clip(word.text));
            Fault::new(word.place, problem, what)
        })
    }

    /// A number in a range.
    pub fn number_in(&mut self, what: &str, range: RangeInclusive<f64>) -> Read<f64> {
        let place = self.place();
        let number = self.number(what)?;
        if range.contains(&number) {
            return Ok(number);
        }
        Err(Fault::new(
            place,
            format!("{number} is out of bounds"),
            format!("{what}, {} to {}", range.start(), range.end()),
        ))
    }

    /// A whole number in a range.
    pub fn whole(&mut self, what: &str, range: RangeInclusive<u32>) -> Read<u32> {
        let word = self.word(what)?;
        word.text.parse().ok().filter(|number| range.contains(number)).ok_or_else(|| {
            let problem = format!("`{}` is no whole number in bounds", clip(word.text));
            Fault::new(word.place, problem, format!("{what}, {} to {}", range.start(), range.end()))
        })
    }

    /// A growth level.
    pub fn level(&mut self, what: &str) -> Read<u32> {
        self.whole(what, 0..=MOST_LEVELS)
    }

    /// The first and the last of some growth levels.
    pub fn levels(&mut self) -> Read<[u32; 2]> {
        let place = self.place();
        let levels = [self.level("the first growth level")?, self.level("the last growth level")?];
        if levels[0] > levels[1] {
            let problem = format!("the first growth level, {}, is above the last, {}", levels[0], levels[1]);
            return Err(Fault::new(place, problem, "the lower level first"));
        }
        Ok(levels)
    }

    /// A place: x, y and z.
    pub fn place3(&mut self, what: &str) -> Read<[f64; 3]> {
        Ok([
            self.number(&format!("{what}, its x"))?,
            self.number(&format!("{what}, its y"))?,
            self.number(&format!("{what}, its z"))?,
        ])
    }

    /// A flag: `on` or `off`, 1 or 0.
    pub fn flag(&mut self, what: &str) -> Read<bool> {
        self.choice(what, &FLAGS)
    }

    /// Whether the next word is a flag.
    pub fn at_flag(&self) -> bool {
        FLAGS.iter().any(|(text, _)| Some(*text) == self.peek())
    }

    /// A word of a list.
    pub fn choice<T: Copy>(&mut self, what: &str, list: &[(&str, T)]) -> Read<T> {
        let word = self.word(what)?;
        list.iter().find(|(text, _)| *text == word.text).map(|(_, value)| *value).ok_or_else(|| {
            let words: Vec<&str> = list.iter().map(|(text, _)| *text).collect();
            let problem = format!("`{}` is none of {}", clip(word.text), words.join(", "));
            Fault::spelling(word.place, problem, (word.text, words), what)
        })
    }

    /// A colour: red, green and blue from 0 to 255, or `#rrggbb`.
    pub fn colour(&mut self) -> Read<Colour> {
        const WHAT: &str = "a colour: red, green and blue from 0 to 255, or #rrggbb";
        if self.peek().is_some_and(|text| text.starts_with('#')) {
            let word = self.word(WHAT)?;
            let digits = &word.text[1..];
            let valid = digits.len() == 6 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
            let number = u32::from_str_radix(digits, 16).ok().filter(|_| valid);
            let bytes = number.map(|number| [number >> 16, number >> 8 & 255, number & 255].map(|part| part as u8));
            return bytes.ok_or_else(|| Fault::new(word.place, format!("`{}` is no colour", clip(word.text)), WHAT));
        }
        let mut part = || self.whole(WHAT, 0..=255).map(|part| part as u8);
        Ok([part()?, part()?, part()?])
    }
}

fn is_brace(text: &str) -> bool {
    text == "{" || text == "}"
}

/// Whether a word is a name.
pub fn is_name(text: &str) -> bool {
    let first = text.chars().next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    let letters = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    first && letters && text.len() <= LONGEST_NAME && !FLAGS.iter().any(|(flag, _)| *flag == text)
}
