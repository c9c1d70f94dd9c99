//! The columns of each law, and its rows as the estimators take them.
//!
//! Names are exact. An empty cell, a count below 0 or with a fraction, NaN and an unknown word are faults with their
//! line. Absent: estimates.

use super::table::{Fault, MOST_FAULTS, Table};
use crate::activity::waiting::Wait;
use crate::branching::Shoots;
use crate::crown::Pair;
use crate::mortality::{Followed, Observed, SeenOnce};
use std::collections::BTreeMap;

/// The largest count and age that are read.
const MOST: f64 = 1e6;
/// The most nodes of a growth unit, as in species.
const MOST_NODES: f64 = 65_535.0;

/// A law that can be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// The activity of a bud.
    Activity,
    /// Mortality by age.
    Mortality,
    /// Nodes per growth unit.
    Nodes,
    /// b₁, b₂ and w of a crown.
    Crown,
    /// Fates of axillary buds.
    Branching,
}

/// All laws, with their words, columns and sample files.
pub const LAWS: [(Law, &str, &str, &str); 7] = [
    (Law::Activity, "activity", "nodes (made in one window); days (of the window) may be left out", ACTIVITY),
    (Law::Activity, "activity, day by day", "axis, day, nodes (cumulative)", ACTIVITY_DAYS),
    (Law::Mortality, "mortality, seen once", "age, axes, dead", MORTALITY_SEEN),
    (Law::Mortality, "mortality, followed", "age (at death or when last seen), died (0 or 1)", MORTALITY_FOLLOWED),
    (Law::Nodes, "nodes", "nodes (of a growth unit); count (of such units) may be left out", NODES),
    (Law::Crown, "crown", "above (nodes above the pair), first, second (nodes of its branches)", CROWN),
    (Law::Branching, "branching", "axis, rank (from 1), fate (a word)", BRANCHING),
];

const ACTIVITY: &str = include_str!("../../samples/activity.csv");
const ACTIVITY_DAYS: &str = include_str!("../../samples/activity_days.csv");
const MORTALITY_SEEN: &str = include_str!("../../samples/mortality_seen.csv");
const MORTALITY_FOLLOWED: &str = include_str!("../../samples/mortality_followed.csv");
const NODES: &str = include_str!("../../samples/nodes.csv");
const CROWN: &str = include_str!("../../samples/crown.csv");
const BRANCHING: &str = include_str!("../../samples/branching.csv");

/// The rows of a law.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Nodes made in one window, and its days.
    Counts {
        /// Nodes of each axis.
        nodes: Vec<u32>,
        /// The length of the window.
        days: Option<f64>,
    },
    /// Cumulative nodes of each axis, by day.
    Days(Vec<BTreeMap<u32, u32>>),
    /// Deaths.
    Mortality(Observed),
    /// Growth units by their number of nodes.
    Nodes(Vec<f64>),
    /// Pairs of branches.
    Crown(Vec<Pair>),
    /// Fates along shoots, with the words of their numbers.
    Branching(Shoots, Vec<String>),
}

/// Reads the columns of a law.
///
/// # Errors
/// Every fault, at most 20.
pub fn read(law: Law, table: &Table) -> Result<Data, Vec<Fault>> {
    let mut cells = Cells { table, faults: Vec::new() };
    let data = match law {
        Law::Activity if table.find("day").is_some() => cells.days(),
        Law::Activity => cells.counts(),
        Law::Mortality if table.find("died").is_some() => cells.followed(),
        Law::Mortality => cells.seen_once(),
        Law::Nodes => cells.nodes(),
        Law::Crown => cells.crown(),
        Law::Branching => cells.branching(),
    };
    cells.faults.truncate(MOST_FAULTS);
    match data {
        Some(data) if cells.faults.is_empty() => Ok(data),
        _ => Err(cells.faults),
    }
}

struct Cells<'a> {
    table: &'a Table,
    faults: Vec<Fault>,
}

/// A row: its line and the place of its cells.
type Row<'a> = (u64, &'a [String]);

impl<'a> Cells<'a> {
    fn places<const N: usize>(&mut self, names: [&str; N]) -> Option<[usize; N]> {
        let found = names.map(|name| self.table.column(name));
        let mut places = [0; N];
        for (place, found) in places.iter_mut().zip(found) {
            match found {
                Ok(found) => *place = found,
                Err(fault) => self.faults.push(fault),
            }
        }
        self.faults.is_empty().then_some(places)
    }

    fn rows(&self) -> impl Iterator<Item = Row<'a>> + use<'a> {
        self.table.rows.iter().map(|(line, cells)| (*line, cells.as_slice()))
    }

    /// A whole number of 0 or more.
    fn count(&mut self, (line, cells): Row<'_>, place: usize) -> Option<f64> {
        let (name, text) = (&self.table.names[place], cells[place].as_str());
        let problem = match text.parse::<f64>() {
            _ if text.is_empty() => format!("`{name}` is empty"),
            Ok(number) if number.is_nan() => format!("`{name}` is not a number (NaN)"),
            Ok(number) if number < 0.0 => format!("`{name}` is {text}, which is below 0"),
            Ok(number) if number > MOST => format!("`{name}` is {text}, which is above {MOST}"),
            Ok(number) if number.fract() != 0.0 => format!("`{name}` is {text}, which is not whole"),
            Ok(number) => return Some(number),
            Err(_) => format!("`{name}` is `{}`, which is no number", clip(text)),
        };
        self.faults.push(self.table.fault(Some(line), problem, "a whole number of 0 or more"));
        None
    }

    /// A number above 0.
    fn length(&mut self, (line, cells): Row<'_>, place: usize) -> Option<f64> {
        let (name, text) = (&self.table.names[place], cells[place].as_str());
        match text.parse::<f64>() {
            Ok(number) if number > 0.0 && number <= MOST => Some(number),
            _ => {
                let problem = format!("`{name}` is `{}`", clip(text));
                self.faults.push(self.table.fault(Some(line), problem, "a number above 0"));
                None
            }
        }
    }

    fn counts(&mut self) -> Option<Data> {
        let [nodes] = self.places(["nodes"])?;
        let days = self.table.find("days");
        let (mut made, mut window) = (Vec::new(), None);
        for row in self.rows() {
            made.extend(self.count(row, nodes).map(|count| count as u32));
            let Some(length) = days.and_then(|place| self.length(row, place)) else { continue };
            if *window.get_or_insert(length) != length {
                let problem = format!("the window has {length} days, and other rows another length");
                self.faults.push(self.table.fault(Some(row.0), problem, "one window for all axes; see --where"));
            }
        }
        Some(Data::Counts { nodes: made, days: window })
    }

    fn days(&mut self) -> Option<Data> {
        let [axis, day, nodes] = self.places(["axis", "day", "nodes"])?;
        let mut axes: BTreeMap<&str, BTreeMap<u32, u32>> = BTreeMap::new();
        for row in self.rows() {
            let (Some(on), Some(made)) = (self.count(row, day), self.count(row, nodes)) else { continue };
            let days = axes.entry(row.1[axis].as_str()).or_default();
            let before = days.range(..on as u32).next_back().map(|before| *before.1);
            if before.is_some_and(|before| f64::from(before) > made) {
                let problem = format!("axis `{}` has fewer nodes than on a day before", clip(&row.1[axis]));
                self.faults.push(self.table.fault(Some(row.0), problem, "cumulative numbers, which never fall"));
            }
            if days.insert(on as u32, made as u32).is_some() {
                let problem = format!("axis `{}` has day {on} twice", clip(&row.1[axis]));
                self.faults.push(self.table.fault(Some(row.0), problem, "one row for each axis and day"));
            }
        }
        Some(Data::Days(axes.into_values().collect()))
    }

    fn followed(&mut self) -> Option<Data> {
        let [age, died] = self.places(["age", "died"])?;
        let mut axes = Vec::new();
        for row in self.rows() {
            let (age, died) = (self.count(row, age), self.count(row, died));
            let (Some(age), Some(died)) = (age, died) else { continue };
            if died > 1.0 || (died == 1.0 && age == 0.0) {
                let problem = format!("`died` is {died} at age {age}");
                self.faults.push(self.table.fault(Some(row.0), problem, "0 or 1, and a death at age 1 or later"));
            }
            axes.push(Followed { age, died: died == 1.0 });
        }
        Some(Data::Mortality(Observed::Followed(axes)))
    }

    fn seen_once(&mut self) -> Option<Data> {
        let [age, axes, dead] = self.places(["age", "axes", "dead"])?;
        let mut ages = Vec::new();
        for row in self.rows() {
            let numbers = [age, axes, dead].map(|place| self.count(row, place));
            let [Some(age), Some(axes), Some(dead)] = numbers else { continue };
            if dead > axes || axes == 0.0 || (age == 0.0 && dead > 0.0) {
                let problem = format!("{dead} of {axes} axes are dead at age {age}");
                let expected = "at least one axis, at most all of them dead, and none at age 0";
                self.faults.push(self.table.fault(Some(row.0), problem, expected));
            }
            ages.push(SeenOnce { age, axes, dead });
        }
        Some(Data::Mortality(Observed::SeenOnce(ages)))
    }

    fn nodes(&mut self) -> Option<Data> {
        let [nodes] = self.places(["nodes"])?;
        let count = self.table.find("count");
        let mut counts = Vec::new();
        for row in self.rows() {
            let units = count.map_or(Some(1.0), |place| self.count(row, place));
            let (Some(nodes), Some(units)) = (self.count(row, nodes), units) else { continue };
            if nodes > MOST_NODES {
                let problem = format!("a growth unit has {nodes} nodes");
                self.faults.push(self.table.fault(Some(row.0), problem, "at most 65535"));
                continue;
            }
            counts.resize(counts.len().max(nodes as usize + 1), 0.0);
            counts[nodes as usize] += units;
        }
        Some(Data::Nodes(counts))
    }

    fn crown(&mut self) -> Option<Data> {
        let places = self.places(["above", "first", "second"])?;
        let mut pairs = Vec::new();
        for row in self.rows() {
            let [Some(above), Some(first), Some(second)] = places.map(|place| self.count(row, place)) else { continue };
            if above > 500.0 || first > 500.0 || second > 500.0 {
                self.faults.push(self.table.fault(
                    Some(row.0),
                    "a number above 500",
                    "nodes of a young axis, at most 500",
                ));
                continue;
            }
            pairs.push(Pair { above: above as u32, nodes: [first as u32, second as u32] });
        }
        Some(Data::Crown(pairs))
    }

    fn branching(&mut self) -> Option<Data> {
        let [axis, rank, fate] = self.places(["axis", "rank", "fate"])?;
        let mut words: Vec<String> = Vec::new();
        let mut shoots: Vec<(&str, Vec<usize>)> = Vec::new();
        for row in self.rows() {
            let (name, word) = (row.1[axis].as_str(), row.1[fate].as_str());
            let Some(rank) = self.count(row, rank) else { continue };
            if word.is_empty() {
                self.faults.push(self.table.fault(Some(row.0), "`fate` is empty", "a word, such as latent"));
                continue;
            }
            let number = words.iter().position(|own| own == word).unwrap_or_else(|| {
                words.push(word.to_owned());
                words.len() - 1
            });
            if shoots.last().is_none_or(|last| last.0 != name) {
                shoots.push((name, Vec::new()));
            }
            let Some((_, fates)) = shoots.last_mut() else { continue };
            if rank != fates.len() as f64 + 1.0 {
                let problem = format!("rank {rank} of axis `{}` follows rank {}", clip(name), fates.len());
                self.faults.push(self.table.fault(Some(row.0), problem, "the ranks of an axis in order, from 1"));
            }
            fates.push(number);
        }
        let shoots = Shoots::new(words.len(), shoots.into_iter().map(|shoot| shoot.1).collect()).ok()?;
        Some(Data::Branching(shoots, words))
    }
}

/// The first letters of a text, for a message.
fn clip(text: &str) -> String {
    let clipped: String = text.chars().take(40).collect();
    if clipped.len() < text.len() { format!("{clipped}…") } else { clipped }
}

/// The days at which an axis was seen with more nodes than before. Two nodes on one day cannot be: a bud makes one at a
/// tick.
pub fn emissions(days: &BTreeMap<u32, u32>) -> Vec<u32> {
    let each = days.iter().zip(days.iter().skip(1));
    each.filter(|(earlier, later)| later.1 > earlier.1).map(|(_, later)| *later.0).collect()
}

/// The days between the nodes of each axis, for waits begun before a day.
pub fn waits(axes: &[BTreeMap<u32, u32>], before: u32) -> Vec<Wait> {
    let mut waits = Vec::new();
    for days in axes {
        let Some(last) = days.keys().next_back() else { continue };
        let emitted = emissions(days);
        for (place, day) in emitted.iter().enumerate().filter(|(_, day)| **day < before) {
            let next = emitted.get(place + 1);
            waits.push(Wait { days: f64::from(next.unwrap_or(last) - day), ended: next.is_some() });
        }
    }
    waits
}

/// The nodes that each axis made between two days, of those seen on or before the first and on or after the second.
/// What was last counted by a day holds for it.
pub fn made(axes: &[BTreeMap<u32, u32>], from: u32, to: u32) -> Vec<u32> {
    let by = |days: &BTreeMap<u32, u32>, day: u32| days.range(..=day).next_back().map(|counted| *counted.1);
    let seen = axes.iter().filter(|days| days.keys().next_back().is_some_and(|last| *last >= to));
    seen.filter_map(|days| Some(by(days, to)? - by(days, from)?)).collect()
}
