//! Measures of the crown at an age, from the leaves in `records`: the profile of leaf area by height, and the clear
//! bole.
//!
//! Profile: the leaf area of a plant, one side, in each layer of height above its seed; means of plants, a plant
//! without a leaf in a layer counts 0 there. Clear bole: the height of the lowest leaf, of plants that have one; it
//! stands for the base of the living crown. Intervals are Student's of plants. A leaf belongs to the layer of its base.
//! Unit: m², m.

use super::columns::Columns;
use super::fault::Fault;
use super::groups::Groups;
use super::result::{Cells, Column, Measured, Sheet};
use super::source::Source;
use super::stream::{RowOf, Unit, each_plant, of_group};
use phytomer_measures::moments::Moments;
use phytomer_outputs::Table;
use std::collections::{BTreeMap, BTreeSet};

/// The leaves of plants at an age.
pub(super) struct Leaves {
    pub age: u32,
    /// The thickness of a layer, metres.
    pub layer_m: f64,
}

/// The leaf area of a plant by layer, and its lowest leaf.
#[derive(Default)]
pub(super) struct OfPlant {
    layers: BTreeMap<i64, f64>,
    lowest_m: Option<f64>,
}

impl Unit for Leaves {
    type Row = Option<(f64, f64)>;
    type OfPlant = OfPlant;

    fn table(&self) -> Table {
        Table::Records
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["age", "kind", "z_m", "area_m2"]
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Self::Row>, Fault> {
        let kinds = columns.words("kind")?;
        let is_leaf: Vec<bool> = kinds.words.iter().map(|kind| kind == "leaf" || kind == "leaflet").collect();
        let (ages, z, area) = (columns.ints("age")?, columns.numbers("z_m")?, columns.numbers("area_m2")?);
        Ok(Box::new(move |row| {
            let kind = kinds.at(row).filter(|_| ages[row].unsigned_abs() == self.age)?;
            // Other components keep a plant without leaves among the plants.
            Some(z[row].zip(area[row]).filter(|_| is_leaf[kind]))
        }))
    }

    fn add(&self, own: &mut OfPlant, row: Self::Row) {
        let Some((z, area)) = row else { return };
        *own.layers.entry((z / self.layer_m).floor() as i64).or_default() += area;
        own.lowest_m = Some(own.lowest_m.map_or(z, |lowest| lowest.min(z)));
    }
}

/// Sums of plants in a group.
#[derive(Default)]
struct Found {
    plants: u64,
    layers: BTreeMap<i64, Moments>,
    lowest: Moments,
}

fn found(unit: &Leaves, sources: &[Source], groups: &mut Groups) -> Result<Vec<Found>, Fault> {
    let mut found: Vec<Found> = Vec::new();
    for source in sources {
        each_plant(unit, source, groups, |of, own| {
            let group = of_group(&mut found, of.group);
            group.plants += 1;
            own.layers.iter().for_each(|(layer, area)| group.layers.entry(*layer).or_default().add(*area));
            own.lowest_m.into_iter().for_each(|lowest| group.lowest.add(lowest));
        })?;
    }
    Ok(found)
}

/// The leaf area of plants by height.
pub(super) fn profile(unit: &Leaves, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let found = found(unit, sources, groups)?;
    let columns: [Column; 8] = [
        ("group", ""),
        ("from", "m"),
        ("to", "m"),
        ("plants", ""),
        ("leaf_area", "m2"),
        ("monte_carlo_error", "m2"),
        ("low", "m2"),
        ("high", "m2"),
    ];
    let (mut sheet, mut notes) = (Sheet::new("profile", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some(of) = found.get(number as usize) else { continue };
        for (layer, areas) in &of.layers {
            let mut areas = *areas;
            // The plants without a leaf in the layer.
            (areas.n..of.plants).for_each(|_| areas.add(0.0));
            let estimate = areas.mean_of_plants(level);
            let row = Cells::of(name, &mut notes).real(*layer as f64 * unit.layer_m);
            let row = row.real((*layer + 1) as f64 * unit.layer_m).count(areas.n).real(areas.mean);
            let row = row.estimate("interval", estimate.map(|of| of.standard_error));
            let row = row.maybe(estimate.ok().map(|of| of.interval.low));
            sheet.rows.push(row.maybe(estimate.ok().map(|of| of.interval.high)).done());
        }
    }
    if sheet.rows.is_empty() {
        notes.insert(format!("no profile: no plant has a leaf at age {}", unit.age));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}

/// The height of the lowest leaf.
pub(super) fn clear_bole(
    unit: &Leaves,
    sources: &[Source],
    groups: &mut Groups,
    level: f64,
) -> Result<Measured, Fault> {
    let found = found(unit, sources, groups)?;
    let columns: [Column; 7] = [
        ("group", ""),
        ("plants", ""),
        ("mean", "m"),
        ("sd", "m"),
        ("monte_carlo_error", "m"),
        ("low", "m"),
        ("high", "m"),
    ];
    let (mut sheet, mut notes) = (Sheet::new("clear_bole", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some(of) = found.get(number as usize).filter(|of| of.lowest.n > 0) else { continue };
        let estimate = of.lowest.mean_of_plants(level);
        let row = Cells::of(name, &mut notes).count(of.lowest.n).real(of.lowest.mean);
        let row = row.maybe(of.lowest.standard_deviation()).estimate("interval", estimate.map(|of| of.standard_error));
        let row = row.maybe(estimate.ok().map(|of| of.interval.low));
        sheet.rows.push(row.maybe(estimate.ok().map(|of| of.interval.high)).done());
    }
    if sheet.rows.is_empty() {
        notes.insert(format!("no clear bole: no plant has a leaf at age {}", unit.age));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}
