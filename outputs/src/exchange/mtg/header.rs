//! The sections before the entities: CODE, CLASSES, DESCRIPTION and FEATURES; and lines with their cells.
//!
//! Sections may be missing but for CLASSES, and their order is free. What DESCRIPTION allows is not checked: measured
//! plants break it often, and their topology is told by the codes.

use super::names::{Meaning, meaning};
use super::values::Declared;
use crate::exchange::description::FeatureType;
use crate::exchange::report::Report;
use crate::exchange::text::said;
use std::collections::HashMap;

/// The most classes, and the most features, of a file.
const MOST_NAMES: usize = 10_000;

/// A class as the file declares it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DeclaredClass {
    pub symbol: String,
    pub scale: u32,
}

/// What the sections before MTG say.
#[derive(Debug, Default)]
pub struct Header {
    pub classes: Vec<DeclaredClass>,
    pub features: Vec<(String, Declared)>,
    by_symbol: HashMap<String, usize>,
    has_classes: bool,
}

/// Where the reader stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// Before the first.
    None,
    Code,
    Classes,
    Description,
    Features,
    Mtg,
}

impl Section {
    /// The section that a first cell begins, and what stands after the colon.
    pub fn begun_by(cell: &str) -> Option<(Self, &str)> {
        let (word, rest) = cell.split_once(':')?;
        let section = match word.trim().to_ascii_uppercase().as_str() {
            "CODE" => Self::Code,
            "CLASSES" => Self::Classes,
            "DESCRIPTION" => Self::Description,
            "FEATURES" => Self::Features,
            "MTG" => Self::Mtg,
            _ => return None,
        };
        Some((section, rest.trim()))
    }
}

/// A cell without its comment, which goes from `#` to the next tab, and without spaces around it.
pub fn cell(text: &str) -> &str {
    // Most cells are plain.
    let is_plain = |byte: u8| byte.is_ascii_graphic() && byte != b'#' && byte != b'"';
    if text.bytes().all(is_plain) {
        return text;
    }
    text.split('#').next().unwrap_or_default().trim_matches([' ', '\r', '\u{a0}', '"'])
}

/// The cells of a line, up to the tabs between them.
#[derive(Debug, Clone)]
pub struct Cells<'l>(Option<&'l str>);

impl<'l> Cells<'l> {
    /// All cells of a line.
    pub fn of(line: &'l str) -> Self {
        Self(Some(line))
    }
}

impl<'l> Iterator for Cells<'l> {
    type Item = &'l str;

    #[inline]
    fn next(&mut self) -> Option<&'l str> {
        let rest = self.0?;
        // Cells are short, so looking at each byte is faster than searching.
        match rest.bytes().position(|byte| byte == b'\t') {
            Some(tab) => {
                self.0 = Some(&rest[tab + 1..]);
                Some(&rest[..tab])
            }
            None => self.0.take(),
        }
    }
}

/// The column of a part of a line, from 1, in characters.
pub fn column(line: &str, part: &str) -> usize {
    let offset = (part.as_ptr() as usize).saturating_sub(line.as_ptr() as usize).min(line.len());
    line[..line.floor_char_boundary(offset)].chars().count() + 1
}

impl Header {
    /// The class of a symbol.
    pub fn class(&self, symbol: &str) -> Option<usize> {
        self.by_symbol.get(symbol).copied()
    }

    /// Whether a section CLASSES has begun.
    pub fn has_classes(&self) -> bool {
        self.has_classes
    }

    /// Takes note of the beginning of a section.
    pub fn begin(&mut self, section: Section) {
        self.has_classes |= section == Section::Classes;
    }

    /// Reads a line of CODE.
    pub fn code(&self, (number, line): (usize, &str), said_there: &str, report: &mut Report) {
        let words = Cells::of(line).map(cell);
        let form = Some(said_there).filter(|form| !form.is_empty());
        let form = form.or_else(|| words.skip(1).find(|word| !word.is_empty()));
        match form {
            Some(form) if form.eq_ignore_ascii_case("FORM-A") => {}
            None => report.warn((number, 0), "", "CODE names no form; it is read as FORM-A"),
            Some(form) => {
                let problem = format!("the code is of the form `{}`", said(form));
                let help = "Write it as FORM-A, with openalea.mtg or by hand: other forms are not read";
                report.fault_with_help((number, column(line, form)), problem, "FORM-A", help);
            }
        }
    }

    /// Reads a line of CLASSES: a symbol and its scale.
    pub fn class_line(&mut self, (number, line): (usize, &str), report: &mut Report) {
        let mut cells = Cells::of(line);
        let (symbol, scale_cell) = (cell(cells.next().unwrap_or_default()), cells.next().unwrap_or_default());
        if symbol.is_empty() || symbol.eq_ignore_ascii_case("SYMBOL") || symbol == "$" {
            return;
        }
        let scale = cell(scale_cell);
        let Ok(scale) = scale.parse::<u32>() else {
            let at = column(line, if scale_cell.is_empty() { line } else { scale_cell });
            let problem = format!("the class `{}` has the scale `{}`", said(symbol), said(scale));
            return report.fault((number, at), problem, "a whole number from 0, such as 1 for plants");
        };
        if symbol.contains(|c: char| c.is_ascii_digit() || "/<+^()*".contains(c)) {
            let problem = format!("a class is called `{}`", said(symbol));
            return report.fault((number, column(line, symbol)), problem, "a symbol of letters");
        }
        match self.class(symbol) {
            Some(known) if self.classes[known].scale != scale => {
                let before = self.classes[known].scale;
                let problem = format!("the class `{}` has the scale {scale}, and {before} before", said(symbol));
                report.fault((number, column(line, symbol)), problem, "one scale for a class");
            }
            Some(_) => report.warn((number, 0), "", format!("the class `{}` is declared twice", said(symbol))),
            None if self.classes.len() < MOST_NAMES => {
                self.by_symbol.insert(symbol.to_owned(), self.classes.len());
                self.classes.push(DeclaredClass { symbol: symbol.to_owned(), scale });
            }
            None => report.fault((number, 0), "there are too many classes", format!("at most {MOST_NAMES}")),
        }
    }

    /// Reads a line of FEATURES: a name and its type.
    pub fn feature_line(&mut self, (number, line): (usize, &str), report: &mut Report) {
        let mut cells = Cells::of(line).map(cell);
        let name = cells.next().unwrap_or_default();
        let kind = cells.find(|cell| !cell.is_empty()).unwrap_or_default();
        if name.is_empty() || (name.eq_ignore_ascii_case("NAME") && kind.eq_ignore_ascii_case("TYPE")) {
            return;
        }
        let declared = Declared::of_word(kind).unwrap_or_else(|| {
            let told =
                format!("the feature `{}` is of no known type (`{}`) and is read as text", said(name), said(kind));
            report.warn((number, 0), "", told);
            Declared::of(FeatureType::Text)
        });
        if self.features.iter().any(|(known, _)| known == name) {
            report.warn((number, 0), "", format!("the feature `{}` is declared twice", said(name)));
        } else if self.features.len() < MOST_NAMES {
            self.features.push((name.to_owned(), declared));
        } else {
            report.fault((number, 0), "there are too many features", format!("at most {MOST_NAMES}"));
        }
    }
}

/// A column of the section MTG that holds a feature.
#[derive(Debug, Clone)]
pub struct FeatureColumn {
    pub name: Box<str>,
    pub declared: Declared,
    pub meaning: Meaning,
    /// Its place among the features of the description, where the description has no field for it.
    pub feature: u32,
}

/// What the columns of the section MTG hold: first the codes, then features.
#[derive(Debug, Default)]
pub struct Columns {
    /// The number of columns of codes.
    pub codes: usize,
    /// What the columns after them hold; `None` for a column without a name.
    pub features: Vec<Option<FeatureColumn>>,
}

impl Columns {
    /// Reads the line of names. `place` gives a feature its place in the description.
    pub fn of(
        (number, line): (usize, &str),
        header: &Header,
        marked: bool,
        place: &mut dyn FnMut(&str, FeatureType) -> u32,
        report: &mut Report,
    ) -> Self {
        let cells: Vec<&str> = Cells::of(line).map(cell).collect();
        let codes = cells.iter().skip(1).position(|cell| !cell.is_empty()).map(|first| first + 1);
        let Some(codes) = codes else { return Self { codes: usize::MAX, features: Vec::new() } };
        if cells.len() - codes > MOST_NAMES {
            report.fault((number, 0), "there are too many columns", format!("at most {MOST_NAMES} features"));
            return Self { codes, features: Vec::new() };
        }
        let known: HashMap<&str, Declared> =
            header.features.iter().map(|(name, kind)| (name.as_str(), *kind)).collect();
        let mut seen: HashMap<&str, ()> = HashMap::new();
        let mut features = Vec::with_capacity(cells.len() - codes);
        for &name in &cells[codes..] {
            if name.is_empty() {
                features.push(None);
                continue;
            }
            if seen.insert(name, ()).is_some() {
                report.warn(
                    (number, 0),
                    "",
                    format!("the feature `{}` has two columns; the later is left out", said(name)),
                );
                features.push(None);
                continue;
            }
            let declared = known.get(name).copied().unwrap_or_else(|| {
                report.warn(
                    (number, 0),
                    "",
                    format!("the feature `{}` is not declared and is read as text", said(name)),
                );
                Declared::of(FeatureType::Text)
            });
            let is_date = declared.kind == FeatureType::Date && name.eq_ignore_ascii_case("date");
            let meaning = if is_date { Meaning::Date } else { meaning(name, marked) };
            let feature = if meaning == Meaning::Other { place(name, declared.kind) } else { 0 };
            features.push(Some(FeatureColumn { name: name.into(), declared, meaning, feature }));
        }
        // Where no feature is called so, the first that is a date is the date of observation.
        let is_date = |column: &FeatureColumn| column.meaning == Meaning::Date;
        if !features.iter().flatten().any(is_date) {
            let first = features.iter_mut().flatten().find(|column| column.declared.kind == FeatureType::Date);
            first.into_iter().for_each(|column| column.meaning = Meaning::Date);
        }
        Self { codes, features }
    }
}
