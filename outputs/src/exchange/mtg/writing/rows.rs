//! The lines of a plant.

use super::Written;
use super::order::{self, Tie};
use crate::exchange::decimals::{push, push_shortest, push_whole};
use crate::exchange::description::{Date, Description, Entity, Individual, Observation, Value};
use crate::exchange::losses::Losses;
use crate::exchange::mtg::names::Meaning;
use std::io::{self, Write};

/// Places after the point: of lengths a nanometre, of areas a square micrometre.
const LENGTH: usize = 9;
const AREA: usize = 12;

/// The symbols of all classes, as they are written, each once, with their scales.
pub fn symbols(description: &Description) -> impl Iterator<Item = (String, u32)> {
    let mut taken = std::collections::BTreeSet::new();
    description.classes.iter().map(move |class| {
        let mut symbol = symbol(&class.symbol);
        while !taken.insert(symbol.clone()) {
            symbol.push('x');
        }
        (symbol, class.scale)
    })
}

/// A symbol of letters alone.
fn symbol(name: &str) -> String {
    let kept: String = name.chars().filter(char::is_ascii_alphabetic).collect();
    if kept.is_empty() { "X".to_owned() } else { kept }
}

/// A text of letters, digits, `_`, `.` and `-`.
pub fn word(text: &str) -> String {
    text.chars().map(|c| if u8::try_from(c).is_ok_and(is_kept) { c } else { '_' }).collect()
}

/// Whether a sign of a text cuts no line.
fn is_kept(sign: u8) -> bool {
    sign.is_ascii_alphanumeric() || matches!(sign, b'_' | b'.' | b'-')
}

/// Whether any line of an entity has a value of a meaning.
pub fn has(individual: &Individual, entity: &Entity, meaning: Meaning) -> bool {
    let seen = |is: fn(&Observation) -> bool| entity.observations.iter().any(is);
    match meaning {
        Meaning::Length => seen(|seen| seen.length.is_some()),
        Meaning::BaseDiameter => seen(|seen| seen.base_diameter.is_some()),
        Meaning::TipDiameter => seen(|seen| seen.tip_diameter.is_some()),
        Meaning::Area => seen(|seen| seen.area.is_some()),
        Meaning::Place(_) => seen(|seen| seen.place.is_some()),
        Meaning::Direction(_) => seen(|seen| seen.direction.is_some()),
        Meaning::Up(_) => seen(|seen| seen.up.is_some()),
        Meaning::State => entity.dead.is_some(),
        Meaning::Birth => entity.birth.is_some(),
        Meaning::Death => entity.death.is_some(),
        Meaning::Age => individual.age.is_some(),
        Meaning::Date | Meaning::Alias | Meaning::Other => false,
    }
}

/// Writes the lines of a plant.
pub fn write(
    description: &Description,
    individual: &Individual,
    (written, columns): (&Written, usize),
    file: &mut dyn Write,
    losses: &mut Losses,
) -> io::Result<()> {
    let symbols: Vec<String> = symbols(description).map(|(symbol, _)| symbol).collect();
    let mut line = String::new();
    order::each(individual, |at| {
        let entity = &individual.entities[at.entity as usize];
        line.clear();
        tabs(at.column, &mut line);
        match at.tie {
            Tie::Root => line.push('/'),
            Tie::Above(sign) => line.extend(['^', sign]),
            Tie::Left(sign) => line.push(sign),
        }
        line.push_str(&symbols[entity.class as usize]);
        if let Some(index) = entity.index.filter(|index| index.is_finite()) {
            push(&mut line, index.abs(), 6);
        }
        let mut observations = entity.observations.iter();
        let first = observations.next();
        values(individual, (at.entity, entity, first), (written, columns - at.column), &mut line, losses);
        file.write_all(line.as_bytes())?;
        for seen in observations {
            line.clear();
            tabs(at.column, &mut line);
            line.push('*');
            again(seen, (written, columns - at.column), &mut line, losses);
            file.write_all(line.as_bytes())?;
        }
        Ok(())
    })
}

/// Columns count branchings, so half of a file may be tabs.
fn tabs(mut count: usize, line: &mut String) {
    const MANY: &str = "\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t";
    while count > 0 {
        let some = count.min(MANY.len());
        line.push_str(&MANY[..some]);
        count -= some;
    }
}

/// The cells of the first line of an entity, and the end of the line.
fn values(
    individual: &Individual,
    (place, entity, seen): (u32, &Entity, Option<&Observation>),
    (written, tabs): (&Written, usize),
    line: &mut String,
    losses: &mut Losses,
) {
    let mut cells = Cells { line, waiting: tabs };
    for (.., meaning) in &written.fields {
        match meaning {
            Meaning::Birth => cells.whole(entity.birth),
            Meaning::Death => cells.whole(entity.death),
            Meaning::Age => cells.whole(individual.age.filter(|_| place == 0)),
            Meaning::State => cells.text(entity.dead.map(|dead| if dead { "dead" } else { "alive" })),
            _ => cells.number(seen, *meaning),
        }
    }
    rest(seen, written, &mut cells, losses);
}

/// The cells of a further observation.
fn again(seen: &Observation, (written, tabs): (&Written, usize), line: &mut String, losses: &mut Losses) {
    let mut cells = Cells { line, waiting: tabs };
    written.fields.iter().for_each(|(.., meaning)| cells.number(Some(seen), *meaning));
    rest(Some(seen), written, &mut cells, losses);
}

fn rest(seen: Option<&Observation>, written: &Written, cells: &mut Cells<'_>, losses: &mut Losses) {
    if written.has_dates {
        let date = seen.and_then(|seen| seen.date);
        losses.add(
            "times of day",
            u64::from(date.is_some_and(|date| date.minute.is_some())),
            "dates are written without",
        );
        cells.text(date.map(day).as_deref());
    }
    let mut told = seen.map(|seen| seen.values.as_slice()).unwrap_or_default().iter().peekable();
    for (feature, ..) in &written.others {
        while told.next_if(|(known, _)| known < feature).is_some() {}
        let value = told.next_if(|(known, _)| known == feature).map(|(_, value)| value);
        match value {
            None => cells.skip(),
            Some(Value::Int(number)) => push_whole(cells.begin(), *number),
            Some(Value::Real(number)) if number.is_finite() => push_shortest(cells.begin(), *number),
            Some(Value::Real(_)) => cells.skip(),
            Some(Value::Truth(truth)) => cells.text(Some(if *truth { "true" } else { "false" })),
            Some(Value::Date(date)) => cells.text(Some(&day(*date))),
            Some(Value::Text(text)) if text.bytes().all(is_kept) => cells.text(Some(text)),
            Some(Value::Text(text)) => {
                losses.add("signs in texts", 1, "`_` stands for each that cuts a line");
                cells.text(Some(&word(text)));
            }
        }
    }
    cells.line.push('\n');
}

/// A date as most readers take it.
fn day(date: Date) -> String {
    format!("{:02}/{:02}/{:04}", date.day, date.month, date.year)
}

/// The cells of a line. Empty cells at its end are not written.
struct Cells<'l> {
    line: &'l mut String,
    waiting: usize,
}

impl Cells<'_> {
    /// Begins a cell with something in it, which goes to the end of the line.
    fn begin(&mut self) -> &mut String {
        tabs(self.waiting, self.line);
        self.waiting = 1;
        self.line
    }

    /// Leaves a cell empty.
    fn skip(&mut self) {
        self.waiting += 1;
    }

    fn text(&mut self, text: Option<&str>) {
        match text.filter(|text| !text.is_empty()) {
            Some(text) => self.begin().push_str(text),
            None => self.skip(),
        }
    }

    fn whole(&mut self, number: Option<u32>) {
        match number {
            Some(number) => push_whole(self.begin(), number),
            None => self.skip(),
        }
    }

    fn number(&mut self, seen: Option<&Observation>, meaning: Meaning) {
        let number = seen.and_then(|seen| match meaning {
            Meaning::Length => seen.length,
            Meaning::BaseDiameter => seen.base_diameter,
            Meaning::TipDiameter => seen.tip_diameter,
            Meaning::Area => seen.area,
            Meaning::Place(k) => seen.place.map(|place| place[k]),
            Meaning::Direction(k) => seen.direction.map(|direction| direction[k]),
            Meaning::Up(k) => seen.up.map(|up| up[k]),
            _ => None,
        });
        let places = if meaning == Meaning::Area { AREA } else { LENGTH };
        match number.filter(|number| number.is_finite()) {
            Some(number) => push(self.begin(), number, places),
            None => self.skip(),
        }
    }
}
