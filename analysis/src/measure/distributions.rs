//! Distributions of what grew, plant by plant: nodes per growth unit, how long apical buds live until their mortality
//! test, and the fates of axillary buds along growth units.
//!
//! One pass over `components`. Growth units without nodes leave no internode and are not counted. A bud that ended by
//! anything but its mortality test is censored there. Fates are counted by zones of equally many ranks from an end of
//! the growth unit, as `phytomer_fits::branching` reads measured shoots; growth units so young that a bud of theirs
//! may still wait (the longest delay that the plant has shown) are left out. Intervals are of plants. Absent: laws and
//! measured plants, which are held against these.

use super::columns::Columns;
use super::fault::Fault;
use super::groups::{By, Groups};
use super::source::Source;
use super::stream::{RowOf, Unit, each_plant, of_group};
use phytomer_measures::Moments;
use phytomer_measures::ratio::Ratio;
use phytomer_measures::shares::Shares;
use phytomer_measures::survival::{Fate, Lives};
use phytomer_outputs::Table;
use phytomer_sim::plant::{Cause, Origin};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;

/// The fate of an axillary bud that made no axis.
pub const LATENT: &str = "latent";
/// The fate of one that made an axis, of a species without states.
const BRANCH: &str = "branch";

/// What is counted.
#[derive(Debug, Clone)]
pub struct Sought {
    /// The orders along whose growth units fates are counted.
    pub fates: Vec<u32>,
    /// The ranks of a zone.
    pub zone: usize,
    /// Whether ranks are counted from the youngest node.
    pub from_tip: bool,
}

/// The distributions of a run, by the species and the order of axes.
#[derive(Debug, Default)]
pub struct Distributions {
    /// Growth units by their nodes; also by whether they are of the short type.
    pub nodes: BTreeMap<(String, u32, bool), Shares>,
    /// Lives of apical buds.
    pub lives: BTreeMap<(String, u32), Lives>,
    /// Fates of axillary buds, by the order of the axes that bear them.
    pub fates: BTreeMap<(String, u32), Fates>,
}

/// The fates of axillary buds.
#[derive(Debug, Clone, Default)]
pub struct Fates {
    /// The words of the fates, by their numbers; the first is [`LATENT`].
    pub words: Vec<String>,
    /// The shares of the fates in each zone.
    pub zones: Vec<Shares>,
    /// Growth units.
    pub units: u64,
    /// Runs of equal fates along those of one bud a node.
    pub runs: Ratio,
}

/// Counts along a run.
///
/// # Errors
/// A run that is not finished or has no `components`.
pub fn distributions(folder: &Path, sought: &Sought) -> Result<Distributions, Fault> {
    let sources = Source::open(&[folder])?;
    let mut groups = Groups::new(By::Species);
    let reader = Reader { sought, words: RefCell::new(vec![LATENT.to_owned()]) };
    let mut found: Vec<Found> = Vec::new();
    for source in &sources {
        each_plant(&reader, source, &mut groups, |of, plant| {
            let last = source.plants.get(of.plant as usize).and_then(|plant| plant.last).unwrap_or(0);
            of_group(&mut found, of.group).add(of.plant, plant, last, sought);
        })?;
    }
    let words = reader.words.into_inner();
    let mut all = Distributions::default();
    for (number, species) in groups.sorted() {
        let Some(found) = found.get_mut(number as usize) else { continue };
        let Found { nodes, lives, fates } = std::mem::take(found);
        all.nodes.extend(nodes.into_iter().map(|((order, short), of)| ((species.to_owned(), order, short), of)));
        all.lives.extend(lives.into_iter().map(|(order, of)| ((species.to_owned(), order), of)));
        let told = |(order, of): (u32, Fates)| ((species.to_owned(), order), Fates { words: words.clone(), ..of });
        all.fates.extend(fates.into_iter().map(told));
    }
    Ok(all)
}

/// An internode, or an apical bud.
enum Row {
    Node { axis: i32, order: u32, short: bool, unit: i32, unit_rank: i32, node: Node },
    Bud { order: u32, life: (u32, Fate), lateral: Option<Lateral> },
}

/// A node with axillary buds.
#[derive(Clone, Copy)]
struct Node {
    rank: i32,
    buds: i32,
    birth: i32,
}

/// An axis out of an axillary bud that is counted.
struct Lateral {
    bearer: i32,
    rank: i32,
    delay: i32,
    word: usize,
}

/// What is kept of a plant until all of its rows are read.
#[derive(Default)]
struct OfPlant {
    counting: BTreeMap<i32, (u32, bool, usize)>,
    units: BTreeMap<(u32, bool), Vec<u64>>,
    lives: Vec<(u32, u32, Fate)>,
    along: BTreeMap<(u32, i32, i32), Vec<Node>>,
    laterals: BTreeMap<(i32, i32), Vec<usize>>,
    longest_delay: BTreeMap<u32, i32>,
}

impl OfPlant {
    fn end_unit(&mut self, (order, short, nodes): (u32, bool, usize)) {
        let counts = self.units.entry((order, short)).or_default();
        counts.resize(counts.len().max(nodes + 1), 0);
        counts[nodes] += 1;
    }
}

struct Reader<'a> {
    sought: &'a Sought,
    words: RefCell<Vec<String>>,
}

impl Reader<'_> {
    /// The numbers of the words of states, as fates.
    fn numbers(&self, states: &[String]) -> Vec<usize> {
        states.iter().map(|state| self.number(state)).collect()
    }

    fn number(&self, word: &str) -> usize {
        let mut words = self.words.borrow_mut();
        words.iter().position(|known| known == word).unwrap_or_else(|| {
            words.push(word.to_owned());
            words.len() - 1
        })
    }
}

impl Unit for Reader<'_> {
    type Row = Row;
    type OfPlant = OfPlant;

    fn table(&self) -> Table {
        Table::Components
    }

    fn columns(&self) -> Vec<&'static str> {
        let of_nodes = ["kind", "axis_id", "order", "rank", "unit_rank", "growth_unit", "axillary_buds", "birth_age"];
        let of_buds = ["bearing_axis_id", "origin", "state_name", "delay", "death_age", "cause_of_death"];
        [&of_nodes[..], &of_buds].concat()
    }

    fn rows<'a>(&'a self, source: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Row>, Fault> {
        let kinds = columns.words("kind")?;
        let internode: Vec<Option<bool>> = kinds.words.iter().map(|kind| short(kind)).collect();
        let ints = |name| columns.ints(name);
        let (axis, order, rank) = (ints("axis_id")?, ints("order")?, ints("rank")?);
        let (unit, unit_rank, buds) = (ints("growth_unit")?, ints("unit_rank")?, ints("axillary_buds")?);
        let (bearer, delay, birth) = (ints("bearing_axis_id")?, ints("delay")?, ints("birth_age")?);
        let (origins, states) = (columns.words("origin")?, columns.words("state_name")?);
        let fates = self.numbers(&states.words);
        let lives = Ends::of(source, columns)?;
        Ok(Box::new(move |row| {
            let order = order[row].unsigned_abs();
            let (axis, rank, birth) = (axis[row], rank[row], birth[row]);
            match internode[kinds.at(row)?] {
                Some(short) => {
                    let node = Node { rank, buds: buds[row], birth };
                    Some(Row::Node { axis, order, short, unit: unit[row], unit_rank: unit_rank[row], node })
                }
                None if kinds.words[kinds.at(row)?] != "apical_bud" => None,
                None => {
                    let is_axillary = origins.at(row).is_some_and(|at| origins.words[at] == Origin::Axillary.tag());
                    let counts = is_axillary && order > 1 && self.sought.fates.contains(&(order - 1));
                    let lateral = counts.then(|| {
                        let word = states.at(row).map_or_else(|| self.number(BRANCH), |at| fates[at]);
                        Lateral { bearer: bearer[row], rank, delay: delay[row], word }
                    });
                    Some(Row::Bud { order, life: lives.of_row(row, birth.saturating_add(delay[row].max(0))), lateral })
                }
            }
        }))
    }

    fn add(&self, own: &mut OfPlant, row: Row) {
        match row {
            Row::Node { axis, order, short, unit, unit_rank, node } => {
                let before = own.counting.get(&axis).copied();
                let ended = before.filter(|_| unit_rank == 1);
                ended.into_iter().for_each(|unit| own.end_unit(unit));
                let nodes = if unit_rank == 1 { 0 } else { before.map_or(0, |(_, _, nodes)| nodes) };
                own.counting.insert(axis, (order, short, nodes + 1));
                if self.sought.fates.contains(&order) && unit > 0 {
                    own.along.entry((order, axis, unit)).or_default().push(node);
                }
            }
            Row::Bud { order, life: (ticks, fate), lateral } => {
                own.lives.push((order, ticks, fate));
                let Some(Lateral { bearer, rank, delay, word }) = lateral else { return };
                own.laterals.entry((bearer, rank)).or_default().push(word);
                let longest = own.longest_delay.entry(order - 1).or_default();
                *longest = (*longest).max(delay);
            }
        }
    }
}

/// Whether an internode is of a short growth unit; `None` of what is no internode.
fn short(kind: &str) -> Option<bool> {
    kind.ends_with("internode").then(|| kind.starts_with("short"))
}

/// How buds ended, by the rows of a batch.
struct Ends<'a> {
    source: &'a Source,
    plant: Cow<'a, [i32]>,
    death: Cow<'a, [i32]>,
    causes: super::columns::Words<'a>,
}

impl<'a> Ends<'a> {
    fn of(source: &'a Source, columns: &Columns<'a>) -> Result<Self, Fault> {
        let (plant, death) = (columns.ints("plant_id")?, columns.ints("death_age")?);
        Ok(Self { source, plant, death, causes: columns.words("cause_of_death")? })
    }

    /// The ticks that a bud lived since the birth of its axis, and whether its mortality test ended it.
    fn of_row(&self, row: usize, birth: i32) -> (u32, Fate) {
        let last = self.source.plants.get(self.plant[row].unsigned_abs() as usize).and_then(|plant| plant.last);
        let born = birth.unsigned_abs();
        let Ok(died) = u32::try_from(self.death[row]) else {
            return (last.unwrap_or(born).saturating_sub(born), Fate::Censored);
        };
        let ticks = died.saturating_sub(born);
        let cause = self.causes.at(row).map(|at| self.causes.words[at].as_str());
        match cause {
            cause if cause == Cause::Mortality.tag() => (ticks, Fate::Ended(0)),
            // Any other end came before or after the test of its tick: the bud is known to have passed the one before.
            _ => (ticks.saturating_sub(1), Fate::Censored),
        }
    }
}

/// What was found of a species.
#[derive(Default)]
struct Found {
    nodes: BTreeMap<(u32, bool), Shares>,
    lives: BTreeMap<u32, Lives>,
    fates: BTreeMap<u32, Fates>,
}

impl Found {
    fn add(&mut self, number: u32, mut own: OfPlant, last: u32, sought: &Sought) {
        let counting = std::mem::take(&mut own.counting);
        counting.into_values().for_each(|unit| own.end_unit(unit));
        for (key, counts) in &own.units {
            self.nodes.entry(*key).or_default().add(counts);
        }
        for (order, ticks, fate) in &own.lives {
            self.lives.entry(*order).or_default().add(number, *ticks, *fate);
        }
        for order in &sought.fates {
            let of_plant = FatesOfPlant::of(&mut own, *order, last, sought);
            if of_plant.units > 0 {
                of_plant.give(self.fates.entry(*order).or_default());
            }
        }
    }
}

/// The fates of a plant: buds by zone and fate.
#[derive(Default)]
struct FatesOfPlant {
    zones: Vec<Vec<u64>>,
    units: u64,
    runs: Moments,
}

impl FatesOfPlant {
    fn of(own: &mut OfPlant, order: u32, last: u32, sought: &Sought) -> Self {
        let wait = own.longest_delay.get(&order).copied().unwrap_or(0);
        let old_enough = i64::from(last) - i64::from(wait);
        let mut all = Self::default();
        for ((_, axis, _), nodes) in own.along.range_mut((order, i32::MIN, 0)..=(order, i32::MAX, i32::MAX)) {
            nodes.sort_by_key(|node| node.rank);
            if nodes.iter().any(|node| i64::from(node.birth) > old_enough) {
                continue;
            }
            if sought.from_tip {
                nodes.reverse();
            }
            all.unit(nodes, |rank| own.laterals.get(&(*axis, rank)).map_or(&[][..], Vec::as_slice), sought.zone.max(1));
        }
        all
    }

    /// Adds a growth unit, its nodes from the end at which ranks begin.
    fn unit<'a>(&mut self, nodes: &[Node], laterals: impl Fn(i32) -> &'a [usize], zone: usize) {
        let mut along: Vec<usize> = Vec::new();
        for (place, node) in nodes.iter().enumerate() {
            let made = laterals(node.rank);
            let latent = (node.buds.max(0) as usize).saturating_sub(made.len());
            (0..latent).map(|_| 0).chain(made.iter().copied()).for_each(|word| {
                self.count(place / zone, word);
                along.push(word);
            });
        }
        self.units += u64::from(!along.is_empty());
        if !along.is_empty() && nodes.iter().all(|node| node.buds == 1) {
            self.runs.add((1 + along.windows(2).filter(|pair| pair[0] != pair[1]).count()) as f64);
        }
    }

    fn count(&mut self, zone: usize, word: usize) {
        self.zones.resize(self.zones.len().max(zone + 1), Vec::new());
        let counts = &mut self.zones[zone];
        counts.resize(counts.len().max(word + 1), 0);
        counts[word] += 1;
    }

    fn give(self, to: &mut Fates) {
        to.zones.resize(to.zones.len().max(self.zones.len()), Shares::default());
        to.zones.iter_mut().zip(&self.zones).for_each(|(zone, counts)| zone.add(counts));
        to.units += self.units;
        to.runs.add(&self.runs);
    }
}
