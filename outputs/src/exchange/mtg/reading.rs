//! From the bytes of a file to a description: line by line, with what stands above in each column.
//!
//! The entity of a code springs from the entity before it in the code or above it in its column, the finest that the
//! file names there; the complex that it belongs to is the nearest whole of a coarser scale around that. So a leap of
//! scales needs no rule of its own. A root that is not declared stands for the file and is left out. A line that begins
//! with `#` is a comment as a whole.

use super::code::{self, From};
use super::header::{Cells, Columns, Header, Section, cell, column};
use super::names::{MARK, Meaning, role};
use super::values::Cell;
use crate::exchange::contract::{Incoming, Units};
use crate::exchange::description::Description;
use crate::exchange::report::Report;
use crate::exchange::text::{decoded, said};
use std::collections::HashMap;

mod ends;
mod entities;
mod sizes;

/// The most entities that ranges of a file stand for: `A1<<A999999999` is no plant.
const MOST_RANGED: u64 = 2_000_000;
/// The most columns of codes in which an entity may stand.
const MOST_COLUMNS: usize = 100_000;

/// Where a code goes on from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Here {
    /// Nothing: what comes begins a plant.
    Nowhere,
    /// The root that is not declared.
    Scene,
    /// An entity that could not be read: what springs from it is left out, without a fault of its own.
    Lost,
    /// An entity: the place of its plant, and its own.
    At(u32, u32),
}

struct Reader<'r> {
    header: Header,
    columns: Columns,
    description: Description,
    /// The class of the description of each declared class.
    classes: Vec<u32>,
    scales: Vec<u32>,
    /// The last entity in each column.
    above: Vec<Here>,
    aliases: HashMap<String, Here>,
    marked: bool,
    units: Units,
    ranged: u64,
    entities: usize,
    /// Whether any code was read.
    begun: bool,
    report: &'r mut Report,
}

/// Reads a file.
pub fn read(incoming: &Incoming<'_>, report: &mut Report) -> Description {
    let text = decoded(incoming.bytes, report);
    let marked = text.starts_with(MARK);
    let units = if marked { Units::default() } else { incoming.units.unwrap_or_default() };
    let mut reader = Reader {
        header: Header::default(),
        columns: Columns::default(),
        description: Description::default(),
        classes: Vec::new(),
        scales: Vec::new(),
        above: Vec::new(),
        aliases: HashMap::new(),
        marked,
        units,
        ranged: 0,
        entities: 0,
        begun: false,
        report,
    };
    reader.lines(&text);
    reader.scales.sort_unstable();
    if !marked && incoming.units.is_none() && reader.tells_lengths() {
        let told = "the file states no unit: lengths, diameters and places are read as metres (--unit names another)";
        reader.report.warn((0, 0), "", told);
    }
    let mut description = reader.description;
    if !marked {
        ends::to_bases(&mut description);
    }
    description
}

impl Reader<'_> {
    fn lines(&mut self, text: &str) {
        let (mut section, mut named) = (Section::None, false);
        for (place, line) in text.split('\n').enumerate() {
            let line = (place + 1, line.strip_suffix('\r').unwrap_or(line));
            if line.1.starts_with('#') {
                continue;
            }
            let first = cell(Cells::of(line.1).next().unwrap_or_default());
            if let Some((begun, rest)) = Section::begun_by(first).filter(|_| section != Section::Mtg) {
                section = begun;
                self.header.begin(begun);
                if begun == Section::Code {
                    self.header.code(line, rest, self.report);
                }
                continue;
            }
            match section {
                Section::None | Section::Code | Section::Description => {}
                Section::Classes => self.header.class_line(line, self.report),
                Section::Features => self.header.feature_line(line, self.report),
                Section::Mtg if named => self.row(line),
                Section::Mtg => named = self.names(line),
            }
        }
        self.end(section, named);
    }

    /// What is missing at the end of the file.
    fn end(&mut self, section: Section, named: bool) {
        if !self.header.has_classes() {
            self.report.fault((0, 0), "there is no section `CLASSES:`", "an MTG in FORM-A, with its classes");
        }
        if section != Section::Mtg {
            self.report.fault((0, 0), "there is no section `MTG:`", "the entities of the plant after `MTG:`");
        } else if !named {
            let expected = "a line `ENTITY-CODE` or `TOPO` with the names of the features";
            self.report.fault((0, 0), "nothing stands after `MTG:`", expected);
        } else if self.entities == 0 && !self.report.is_refused() {
            self.report.fault((0, 0), "the file has no entity", "at least one plant, such as `/P1`");
        }
    }

    /// Reads the line of names; whether it was there.
    fn names(&mut self, line: (usize, &str)) -> bool {
        let first = cell(Cells::of(line.1).next().unwrap_or_default());
        if first.is_empty() && Cells::of(line.1).all(|text| cell(text).is_empty()) {
            return false;
        }
        if !["ENTITY-CODE", "TOPO"].iter().any(|word| first.eq_ignore_ascii_case(word)) {
            let problem = format!("the entities begin with `{}`", said(first));
            let expected = "a line that begins with `ENTITY-CODE` or `TOPO` and names the features";
            self.report.fault((line.0, column(line.1, first)), problem, expected);
        }
        let scales = || self.header.classes.iter().map(|class| class.scale).filter(|scale| *scale > 0);
        let range = (scales().min().unwrap_or(1), scales().max().unwrap_or(1));
        for class in &self.header.classes {
            let role = role(&class.symbol, class.scale, range, self.marked);
            self.classes.push(self.description.class(&class.symbol, class.scale, role));
            self.scales.push(class.scale);
        }
        let description = &mut self.description;
        let mut place = |name: &str, kind| description.feature(name, kind);
        self.columns = Columns::of(line, &self.header, self.marked, &mut place, self.report);
        true
    }

    fn tells_lengths(&self) -> bool {
        let is_length = |meaning: Meaning| {
            let sizes = [Meaning::Length, Meaning::BaseDiameter, Meaning::TipDiameter, Meaning::Area];
            sizes.contains(&meaning) || matches!(meaning, Meaning::Place(_))
        };
        self.columns.features.iter().flatten().any(|column| is_length(column.meaning))
    }

    /// Reads a line of an entity, or of another observation of one.
    fn row(&mut self, (number, line): (usize, &str)) {
        let mut cells = Cells::of(line);
        let (mut at, mut code) = (0, "");
        // The code is the first cell that is not empty; the cells of features begin after all columns of codes.
        for (place, text) in cells.by_ref().take(self.columns.codes).enumerate() {
            let text = cell(text);
            if text.is_empty() {
                continue;
            }
            if code.is_empty() {
                (at, code) = (place, text);
                continue;
            }
            let problem = format!("a second code, `{}`, stands in the line", said(text));
            self.report.fault((number, column(line, text)), problem, "one code a line");
        }
        if code.is_empty() {
            if cells.any(|text| !cell(text).is_empty()) {
                self.report.warn((number, 0), "values without entity", "values without an entity are left out");
            }
            return;
        }
        if at >= MOST_COLUMNS {
            let expected = format!("at most {MOST_COLUMNS} columns of codes");
            return self.report.fault((number, 0), "a code stands too far to the right", expected);
        }
        let values = self.observation((number, line), cells);
        if code == "*" {
            self.observe_again((number, line, code), at, values);
        } else {
            self.entity((number, line), code, at, values);
        }
    }

    /// The values of a line.
    fn observation(&mut self, (number, line): (usize, &str), mut cells: Cells<'_>) -> sizes::Row {
        let mut row = sizes::Row::default();
        for (feature, text) in self.columns.features.iter().zip(cells.by_ref()) {
            let text = cell(text);
            let Some(feature) = feature.as_ref().filter(|_| !text.is_empty()) else { continue };
            let value = match feature.declared.cell(text) {
                Cell::Fits(value) => value,
                Cell::Missing => continue,
                Cell::Kept(value) => {
                    let (name, text) = (said(&feature.name), (text, said(text)));
                    let told = format!("`{}` is not of the type of the feature `{name}`, and is kept as it is", text.1);
                    self.report.warn((number, column(line, text.0)), &format!("type of {name}"), told);
                    value
                }
            };
            row.take(feature.meaning, feature.feature, value, self.units);
        }
        if cells.any(|text| !cell(text).is_empty()) {
            self.report.warn((number, 0), "values beyond", "values beyond the last named column are left out");
        }
        row
    }

    fn observe_again(&mut self, (number, line, code): (usize, &str, &str), at: usize, row: sizes::Row) {
        match self.above.get(at).copied().unwrap_or(Here::Nowhere) {
            Here::At(plant, entity) => {
                let entity = &mut self.description.individuals[plant as usize].entities[entity as usize];
                row.observed_again(entity);
            }
            Here::Lost | Here::Scene => {}
            Here::Nowhere => {
                let problem = "`*` observes an entity again, and none stands above it in its column";
                self.report.fault((number, column(line, code)), problem, "an entity above in the same column");
            }
        }
    }

    /// Reads a code, and gives its last entity the values of its line.
    fn entity(&mut self, (number, line): (usize, &str), code: &str, at: usize, row: sizes::Row) {
        let here = self.start((number, line), code, at);
        self.above.truncate(at);
        self.above.resize(at, Here::Nowhere);
        let Some((mut here, mut rest)) = here else { return self.above.push(Here::Lost) };
        let mut each = Vec::new();
        loop {
            match code::next(rest) {
                Ok(None) => break,
                Ok(Some((entity, tail))) => {
                    rest = tail;
                    here = self.labelled((number, line), entity, here, (at == 0, &mut each));
                    if here == Here::Lost {
                        break;
                    }
                }
                Err((part, expected)) => {
                    let problem = format!("`{}` is no code of an entity", said(part));
                    self.report.fault((number, column(line, part)), problem, expected);
                    here = Here::Lost;
                    break;
                }
            }
        }
        self.begun = true;
        self.above.push(here);
        let Here::At(plant, last) = here else { return };
        if let Some(alias) = &row.alias {
            self.aliases.insert(alias.to_string(), here);
        }
        let individual = &mut self.description.individuals[plant as usize];
        for &other in each.iter().filter(|other| **other != last) {
            row.clone().observed(individual, other);
        }
        row.observed(individual, last);
    }

    /// Where a code goes on, and the rest of it; `None` after a fault.
    fn start<'t>(&mut self, (number, line): (usize, &str), code: &'t str, at: usize) -> Option<(Here, &'t str)> {
        let (start, rest) = match code::from(code) {
            Ok(found) => found,
            Err((part, expected)) => {
                self.report.fault((number, column(line, part)), "an alias is not closed", expected);
                return None;
            }
        };
        let found = match start {
            From::Above => self.above.get(at).copied().unwrap_or(Here::Nowhere),
            From::Alias(alias) => self.aliases.get(alias).copied().unwrap_or(Here::Nowhere),
            From::Left if at == 0 => return Some((Here::Nowhere, rest)),
            // Some files leave columns out: what stands nearest on the left counts.
            From::Left => {
                self.above.iter().take(at).rev().find(|here| **here != Here::Nowhere).copied().unwrap_or(Here::Nowhere)
            }
        };
        if found != Here::Nowhere {
            return Some((found, rest));
        }
        let (problem, expected) = match start {
            From::Above => ("`^` goes on from an entity, and none stands above in this column", "an entity above it"),
            From::Alias(_) => ("no entity has this alias", "an alias that an entity above has in the column `Alias`"),
            From::Left => ("no entity stands in a column on the left", "codes of plants in the first column"),
        };
        self.report.fault((number, column(line, code)), problem, expected);
        None
    }
}
