//! Measure of branching: the branches of each order for one of the order before, and Strahler's bifurcation ratio.
//!
//! Botanical: axes of order k + 1 over axes of order k, of those that made an internode by the end of the run; relays
//! of an axis stand in its order and count as axes. Strahler: streams of internodes by their order from the tips
//! (Strahler 1957). Intervals are BCa bootstraps by plant with a fixed seed. At most 4,096 plants of a group are drawn
//! again: the counts of more are added to theirs in turn. Absent: the numbers at other ages.

use super::columns::Columns;
use super::fault::Fault;
use super::groups::Groups;
use super::result::{Cells, Column, Measured, Sheet};
use super::source::Source;
use super::stream::{RowOf, Unit, each_plant, of_group};
use phytomer_measures::branching::{bifurcation_ratio, strahler_streams};
use phytomer_measures::{Lack, bootstrap};
use phytomer_outputs::Table;
use std::collections::{BTreeMap, BTreeSet};

/// The most clusters of plants that are drawn again.
const CLUSTERS: u32 = 4096;

/// The seed of the bootstrap.
const SEED: u64 = 1988;

/// The axes of a plant.
pub(super) struct Axes;

/// Orders of axes and the internodes of a plant.
#[derive(Default)]
pub(super) struct OfPlant {
    orders: BTreeMap<i32, u64>,
    parents: Vec<Option<usize>>,
    places: BTreeMap<i32, usize>,
}

/// An internode.
pub(super) struct Internode {
    component: i32,
    parent: i32,
    order: i32,
    rank: i32,
}

impl Unit for Axes {
    type Row = Internode;
    type OfPlant = OfPlant;

    fn table(&self) -> Table {
        Table::Components
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["kind", "component_id", "parent_id", "order", "rank"]
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Internode>, Fault> {
        let kinds = columns.words("kind")?;
        let wanted: Vec<bool> = kinds.words.iter().map(|kind| kind.ends_with("internode")).collect();
        let int = |name: &str| columns.ints(name);
        let (component, parent, order, rank) = (int("component_id")?, int("parent_id")?, int("order")?, int("rank")?);
        Ok(Box::new(move |row| {
            let of = |column: &[i32]| column[row];
            kinds.at(row).filter(|kind| wanted[*kind]).map(|_| Internode {
                component: of(&component),
                parent: of(&parent),
                order: of(&order),
                rank: of(&rank),
            })
        }))
    }

    fn add(&self, own: &mut OfPlant, row: Internode) {
        if row.rank == 1 {
            *own.orders.entry(row.order).or_default() += 1;
        }
        // A parent has a smaller number than what it bears, so it has been met.
        own.parents.push(own.places.get(&row.parent).copied());
        own.places.insert(row.component, own.parents.len() - 1);
    }
}

/// Counts by order of clusters of plants; order 1 first.
#[derive(Default)]
struct Found {
    botanical: Vec<Vec<f64>>,
    strahler: Vec<Vec<f64>>,
    plants: u64,
}

fn put(into: &mut Vec<f64>, at: usize, count: u64) {
    if into.len() <= at {
        into.resize(at + 1, 0.0);
    }
    into[at] += count as f64;
}

impl Found {
    fn add(&mut self, own: &OfPlant) {
        let cluster = (self.plants % u64::from(CLUSTERS)) as usize;
        self.plants += 1;
        let (botanical, strahler) =
            (of_group(&mut self.botanical, cluster as u32), of_group(&mut self.strahler, cluster as u32));
        for (order, axes) in own.orders.iter().filter(|(order, _)| **order > 0) {
            put(botanical, *order as usize - 1, *axes);
        }
        let streams = strahler_streams(&own.parents);
        (0..).zip(streams).for_each(|(at, streams)| put(strahler, at, streams));
    }
}

fn summed(clusters: &[Vec<f64>], weights: &[u32]) -> Vec<f64> {
    let mut sum = vec![0.0; clusters.iter().map(Vec::len).max().unwrap_or(0)];
    for (counts, weight) in clusters.iter().zip(weights) {
        sum.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count * f64::from(*weight));
    }
    sum
}

/// The branching ratios of each group.
pub(super) fn measure(sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let mut found: Vec<Found> = Vec::new();
    for source in sources {
        each_plant(&Axes, source, groups, |of, own| of_group(&mut found, of.group).add(&own))?;
    }
    let columns: [Column; 8] = [
        ("group", ""),
        ("ratio", ""),
        ("of_order", ""),
        ("plants", ""),
        ("count", ""),
        ("value", ""),
        ("low", ""),
        ("high", ""),
    ];
    let (mut sheet, mut notes) = (Sheet::new("branching", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some(of) = found.get(number as usize).filter(|of| of.plants > 0) else { continue };
        botanical(&mut sheet, name, of, level, &mut notes);
        strahler(&mut sheet, name, of, level, &mut notes);
    }
    if sheet.rows.is_empty() {
        notes.insert(format!("no ratio: {}", Lack::Empty));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}

fn botanical(sheet: &mut Sheet, name: &str, of: &Found, level: f64, notes: &mut BTreeSet<String>) {
    let counts = summed(&of.botanical, &vec![1; of.botanical.len()]);
    for order in 1..counts.len() {
        let ratio = |weights: &[u32]| {
            let counts = summed(&of.botanical, weights);
            (counts[order - 1] > 0.0).then(|| counts[order] / counts[order - 1])
        };
        let interval = bootstrap::interval(SEED, of.botanical.len(), bootstrap::REPETITIONS, level, ratio);
        let row = Cells::of(name, notes).word("axes for one of the order before").count(order as u64 + 1);
        let row = row.count(of.plants).count(counts[order] as u64).maybe(ratio(&vec![1; of.botanical.len()]));
        let row = row.estimate(&format!("interval of order {}", order + 1), interval.map(|of| of.low));
        sheet.rows.push(row.maybe(interval.ok().map(|of| of.high)).done());
    }
}

fn strahler(sheet: &mut Sheet, name: &str, of: &Found, level: f64, notes: &mut BTreeSet<String>) {
    let ones = vec![1; of.strahler.len()];
    let counts = summed(&of.strahler, &ones);
    for (at, count) in counts.iter().enumerate() {
        let row = Cells::of(name, notes).word("streams of the Strahler order").count(at as u64 + 1).count(of.plants);
        sheet.rows.push(row.count(*count as u64).maybe(None).maybe(None).maybe(None).done());
    }
    let ratio = |weights: &[u32]| bifurcation_ratio(&summed(&of.strahler, weights)).ok();
    let interval = bootstrap::interval(SEED, of.strahler.len(), bootstrap::REPETITIONS, level, ratio);
    let row = Cells::of(name, notes).word("Strahler's bifurcation ratio").maybe_count(None).count(of.plants);
    let row = row.count(counts.iter().sum::<f64>() as u64);
    let row = row.estimate("bifurcation ratio", bifurcation_ratio(&counts));
    let row = row.estimate("interval of the bifurcation ratio", interval.map(|of| of.low));
    sheet.rows.push(row.maybe(interval.ok().map(|of| of.high)).done());
}
