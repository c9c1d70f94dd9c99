//! From the keys of a file to those of the paper, with what became of each.
//!
//! A program's table says for a key which key of the paper it is, or why the paper has none. What a file leaves out has
//! the value that its program would give it, and the written file says so. Absent: the tables (`arbaro`, `tree_gen`,
//! `sapling`, `helios`).

use crate::fault::{Wrong, place, said};
use crate::paper::{Key, LEVELS, Setting};
use crate::value::{Entry, Node, Value};
use std::collections::BTreeMap;

/// So many keys may a tree have; the largest of the programs has some 120.
const MOST_KEYS: usize = 500;

/// What became of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It is the paper's, with its value.
    Taken,
    /// It has another name, another unit or another value here.
    Mapped,
    /// The paper has nothing like it.
    Without,
}

impl Fate {
    /// In words.
    pub fn word(self) -> &'static str {
        match self {
            Self::Taken => "taken",
            Self::Mapped => "mapped",
            Self::Without => "without counterpart",
        }
    }
}

/// A key of the file, and what became of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Told {
    /// The key as the file has it.
    pub key: String,
    /// Its line, from 1.
    pub line: usize,
    /// Its column, from 1, in characters.
    pub column: usize,
    /// What became of it.
    pub fate: Fate,
    /// What was written for it: "1Length = 0.3, 2Length = 0.6".
    pub written: String,
    /// What has to be known of it.
    pub note: Option<String>,
}

/// What a key of a program is.
#[derive(Clone, Copy)]
pub(crate) enum Rule {
    /// The key of the paper that has the same name.
    Same,
    /// A key of the paper.
    Is(&'static str),
    /// A list with a value a level, of the key of a level.
    Each(&'static str),
    /// Nothing of the paper; at these values it has no effect.
    Nothing(&'static str, &'static [f64]),
    /// What a function makes of it.
    By(fn(&mut Mapping<'_>, &Entry) -> Result<(), Wrong>),
}

/// A value with where it came from.
pub(crate) struct Stated {
    pub setting: Setting,
    /// Said behind the value in the file.
    pub comment: Option<String>,
}

/// The keys of the paper as they are found.
pub(crate) struct Mapping<'t> {
    text: &'t str,
    entries: &'t [Entry],
    /// Levels of stems.
    pub levels: usize,
    /// Whether there are leaves.
    pub leaves: bool,
    /// What will be written.
    pub values: BTreeMap<Key, Stated>,
    /// What became of each key.
    pub told: Vec<Told>,
}

impl<'t> Mapping<'t> {
    /// None yet, of a file that calls levels and leaves by these keys.
    pub fn of(text: &'t str, entries: &'t [Entry], keys: [&str; 2], default: usize) -> Result<Self, Wrong> {
        if let Some(entry) = entries.get(MOST_KEYS) {
            let expected = format!("at most {MOST_KEYS} keys");
            return Err(Wrong::new(entry.at.clone(), "the tree has too many keys", expected));
        }
        let mut mapping =
            Self { text, entries, levels: default, leaves: true, values: BTreeMap::new(), told: Vec::new() };
        if let Some(entry) = mapping.entry(keys[0]) {
            let levels = mapping.whole(&entry.node)?;
            if !(1.0..=8.0).contains(&levels) {
                let problem = format!("`{}` is {levels}", entry.key);
                return Err(Wrong::new(entry.node.bytes.clone(), problem, "1 to 8 levels of stems"));
            }
            mapping.levels = levels as usize;
        }
        if let Some(entry) = mapping.entry(keys[1]) {
            mapping.leaves = mapping.number(&entry.node)? != 0.0;
        }
        Ok(mapping)
    }

    /// The last entry with a key.
    pub fn entry(&self, key: &str) -> Option<&'t Entry> {
        self.entries.iter().rev().find(|entry| entry.key == key)
    }

    /// The number of a key; `default` where the file leaves it out.
    pub fn number_of(&self, key: &str, default: f64) -> Result<f64, Wrong> {
        self.entry(key).map_or(Ok(default), |entry| self.number(&entry.node))
    }

    /// The numbers of a key by level; `default` where the file leaves it out.
    pub fn each_of(&self, key: &str, default: [f64; LEVELS]) -> Result<[f64; LEVELS], Wrong> {
        match self.entry(key) {
            Some(entry) => {
                let mut numbers = default;
                for (number, stated) in numbers.iter_mut().zip(self.numbers(&entry.node)?) {
                    *number = stated;
                }
                Ok(numbers)
            }
            None => Ok(default),
        }
    }

    /// A number; texts that are written like one, as Sapling's choices are, count.
    pub fn number(&self, node: &Node) -> Result<f64, Wrong> {
        let number = match &node.value {
            Value::Number(number) => Some(*number),
            Value::Text(text) => text.trim().parse().ok().filter(|number: &f64| number.is_finite()),
            _ => None,
        };
        number.ok_or_else(|| self.wrong(node, "a number"))
    }

    /// A number as programs take a whole one of it: without what stands behind the point.
    pub fn whole(&self, node: &Node) -> Result<f64, Wrong> {
        Ok(self.number(node)?.trunc())
    }

    /// The numbers of a list, a single number being a list of one.
    pub fn numbers(&self, node: &Node) -> Result<Vec<f64>, Wrong> {
        match &node.value {
            Value::List(list) => list.iter().map(|item| self.number(item)).collect(),
            _ => Ok(vec![self.number(node)?]),
        }
    }

    /// A value of another sort than is asked for.
    pub fn wrong(&self, node: &Node, expected: &str) -> Wrong {
        let stated = self.text.get(node.bytes.clone()).unwrap_or("");
        let problem = match node.value {
            Value::Text(_) => format!("`{}` is no number", said(stated)),
            _ => format!("{} stands here", node.value.sort()),
        };
        Wrong::new(node.bytes.clone(), problem, expected)
    }

    /// Goes through the file by a table of its keys.
    pub fn follow(&mut self, rule: impl Fn(&str) -> Option<Rule>) -> Result<(), Wrong> {
        let entries = self.entries;
        for (number, entry) in entries.iter().enumerate() {
            if let Some(later) = entries[number + 1..].iter().find(|later| later.key == entry.key) {
                let line = place(self.text, later.at.start).0;
                self.without(entry, &format!("it is stated again in line {line}"));
                continue;
            }
            match rule(&entry.key) {
                None => self.without(entry, "this program has no such key"),
                Some(Rule::By(function)) => function(self, entry)?,
                Some(Rule::Nothing(why, neutral)) => self.nothing(entry, why, neutral),
                Some(Rule::Same) => self.is(entry, &entry.key)?,
                Some(Rule::Is(name)) => self.is(entry, name)?,
                Some(Rule::Each(name)) => self.each(entry, name)?,
            }
        }
        Ok(())
    }

    /// A key that is one of the paper's.
    pub fn is(&mut self, entry: &Entry, name: &str) -> Result<(), Wrong> {
        let stated = self.number(&entry.node)?;
        self.give(entry, &[(name.to_owned(), stated)], None);
        Ok(())
    }

    /// A list of values by level.
    pub fn each(&mut self, entry: &Entry, name: &str) -> Result<(), Wrong> {
        let numbers = self.numbers(&entry.node)?;
        let named = numbers.iter().enumerate().map(|(level, number)| (format!("{level}{name}"), *number));
        let named: Vec<_> = named.filter(|(name, _)| Key::named(name).is_some()).collect();
        self.give(entry, &named, None);
        Ok(())
    }

    /// Gives keys of the paper their values, and tells it.
    pub fn give(&mut self, entry: &Entry, values: &[(String, f64)], note: Option<&str>) {
        let mut written = Vec::new();
        let (mut same, mut cut) = (true, false);
        for (name, stated) in values {
            let Some(key) = Key::named(name).filter(|key| key.is_used(self.levels, self.leaves)) else { continue };
            let number = if key.is_whole() { stated.trunc() } else { *stated };
            cut |= number != *stated;
            same &= *name == entry.key;
            let setting = Setting::Number(number);
            written.push(format!("{key} = {setting}"));
            self.values.insert(key, Stated { setting, comment: None });
        }
        if written.is_empty() {
            let note =
                note.map_or_else(|| format!("a tree of {} levels does not ask for it", self.levels), str::to_owned);
            return self.without(entry, &note);
        }
        let note = note.map(str::to_owned).or(cut.then(|| "what stands behind the point is left out".to_owned()));
        let fate = if same && note.is_none() { Fate::Taken } else { Fate::Mapped };
        self.tell(entry, fate, written.join(", "), note);
    }

    /// Gives a key of the paper a value that no key of the file stands for.
    pub fn set(&mut self, name: &str, setting: Setting, comment: &str) {
        if let Some(key) = Key::named(name).filter(|key| key.is_used(self.levels, self.leaves)) {
            self.values.entry(key).or_insert_with(|| Stated { setting, comment: Some(comment.to_owned()) });
        }
    }

    /// Tells that the paper has nothing like a key, and whether it has an effect at all.
    pub fn nothing(&mut self, entry: &Entry, why: &str, neutral: &[f64]) {
        let value = match &entry.node.value {
            Value::List(list) => list.iter().map(|item| self.number(item).ok()).collect::<Option<Vec<f64>>>(),
            Value::Bool(stated) => Some(vec![f64::from(u8::from(*stated))]),
            _ => self.number(&entry.node).ok().map(|number| vec![number]),
        };
        let idle = !neutral.is_empty() && value.is_some_and(|all| all.iter().all(|number| neutral.contains(number)));
        let note = if idle { format!("{why}; at this value it has no effect") } else { why.to_owned() };
        self.without(entry, &note);
    }

    /// Tells that a key has no counterpart.
    pub fn without(&mut self, entry: &Entry, note: &str) {
        self.tell(entry, Fate::Without, String::new(), Some(note.to_owned()));
    }

    /// Tells that a key is the paper's.
    pub fn take(&mut self, entry: &Entry, written: &str) {
        self.tell(entry, Fate::Taken, written.to_owned(), None);
    }

    fn tell(&mut self, entry: &Entry, fate: Fate, written: String, note: Option<String>) {
        let (line, column) = place(self.text, entry.at.start);
        self.told.push(Told { key: said(&entry.key), line, column, fate, written, note });
    }

    /// Leaves out an envelope that nothing is pruned by, where the model could not have it as it is.
    pub fn drop_idle_envelope(&mut self) {
        let of = |mapping: &Self, name: &str| {
            let stated = Key::named(name).and_then(|key| mapping.values.get(&key));
            match stated.map(|stated| &stated.setting) {
                Some(Setting::Number(number)) => Some(*number),
                _ => None,
            }
        };
        if of(self, "PruneRatio").unwrap_or(0.0) != 0.0 || of(self, "Shape") == Some(8.0) {
            return;
        }
        for name in ["PruneWidth", "PruneWidthPeak", "PrunePowerLow", "PrunePowerHigh"] {
            let most = if name == "PruneWidthPeak" { 1.0 } else { f64::INFINITY };
            if of(self, name).is_some_and(|number| number <= 0.0 || number >= most) {
                self.values.retain(|key, _| key.to_string() != name);
                for told in self.told.iter_mut().filter(|told| told.written.starts_with(&format!("{name} ="))) {
                    told.fate = Fate::Without;
                    told.written.clear();
                    told.note = Some("nothing is pruned, and there is no such envelope".to_owned());
                }
            }
        }
    }

    /// What the file leaves out, as its program has it.
    pub fn fill(&mut self, program: &str, default: impl Fn(Key) -> Option<f64>) {
        let comment = format!("not stated; the default of {program}");
        let levels =
            (0..LEVELS).flat_map(|level| crate::paper::OF_LEVEL.iter().map(move |name| format!("{level}{name}")));
        let names = crate::paper::GENERAL.iter().map(|name| (*name).to_owned()).chain(levels);
        for key in names.filter_map(|name| Key::named(&name)).collect::<Vec<_>>() {
            if let Some(number) = default(key) {
                self.set(&key.to_string(), Setting::Number(number), &comment);
            }
        }
    }
}
