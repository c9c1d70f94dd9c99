//! A recorded run as the table that a law is fitted to: what a person would have counted on its plants.
//!
//! Axes of one order are counted from `components`, each with its plant. Days are ticks. A growth unit without nodes
//! leaves no internode, so its zero is not counted. What was cut or harvested is censored before the tick of the cut.
//! Absent: estimates, and the tables of people.

use phytomer_fits::data::{Law, Table};
use phytomer_outputs::cells;
use phytomer_outputs::read::Run;
use std::collections::BTreeMap;
use std::path::Path;

/// A component, as far as laws are counted from it.
struct Component {
    plant: u32,
    axis: u32,
    /// The axis that bears this one.
    bearer: Option<u32>,
    order: u32,
    kind: Kind,
    rank: Option<u32>,
    unit: Option<u32>,
    state: String,
    birth: u32,
    death: Option<u32>,
    cut: bool,
}

#[derive(PartialEq)]
enum Kind {
    Internode,
    Bud,
    Other,
}

/// The columns that are read.
const COLUMNS: [&str; 11] = [
    "plant_id",
    "axis_id",
    "bearing_axis_id",
    "order",
    "kind",
    "rank",
    "growth_unit",
    "state_name",
    "birth_age",
    "death_age",
    "cause_of_death",
];

/// The table of a law from the axes of an order of a run.
///
/// # Errors
/// In words: no run, one that is not finished, without `components`, or without axes of the order.
pub fn table(folder: &Path, law: Law, order: u32) -> Result<Table, String> {
    let shown = folder.display();
    let run = Run::open(folder).map_err(|error| error.to_string())?;
    if !run.is_complete() {
        return Err(format!("{shown}: the run is not finished; `phytomer grow --resume` ends it"));
    }
    let last = run.json()["until"].as_u64().unwrap_or_default() as u32;
    let components = components(&run).map_err(|problem| format!("{shown}: {problem}"))?;
    if components.iter().all(|own| own.order != order) {
        return Err(format!("{shown}: no plant has an axis of order {order}; --order names another"));
    }
    let own: Vec<&Component> = components.iter().filter(|own| own.order == order).collect();
    let (names, rows): (&[&str], Vec<Vec<String>>) = match law {
        Law::Activity => (&["plant", "axis", "day", "nodes"], activity(&own, last)),
        Law::Mortality => (&["plant", "axis", "age", "died"], mortality(&own, last)),
        Law::Nodes => (&["plant", "axis", "nodes"], nodes(&own)),
        Law::Crown => (&["plant", "above", "first", "second"], crown(&components, order)),
        Law::Branching => (&["plant", "axis", "rank", "fate"], branching(&components, order)),
    };
    if rows.is_empty() {
        return Err(format!("{shown}: axes of order {order} have nothing that the law is counted from"));
    }
    let names = names.iter().map(|name| (*name).to_owned()).collect();
    Ok(Table { file: shown.to_string(), names, rows: (1..).zip(rows).collect() })
}

fn components(run: &Run) -> Result<Vec<Component>, String> {
    let (names, rows) = cells::of_run(run, phytomer_outputs::Table::Components, &COLUMNS)?;
    if rows.is_empty() {
        return Err("the run has no rows of components".to_owned());
    }
    let mut places = [0; COLUMNS.len()];
    for (place, name) in places.iter_mut().zip(COLUMNS) {
        let found = names.iter().position(|own| own == name);
        *place = found.ok_or_else(|| format!("components has no column {name}: grow the run again"))?;
    }
    let of = |row: &Vec<String>| {
        let number = |place: usize| row[places[place]].parse::<u32>().ok();
        let kind = match row[places[4]].as_str() {
            "apical_bud" => Kind::Bud,
            kind if kind.ends_with("internode") => Kind::Internode,
            _ => Kind::Other,
        };
        Component {
            plant: number(0).unwrap_or_default(),
            axis: number(1).unwrap_or_default(),
            bearer: number(2),
            order: number(3).unwrap_or_default(),
            kind,
            rank: number(5),
            unit: number(6),
            state: row[places[7]].clone(),
            birth: number(8).unwrap_or_default(),
            death: number(9),
            cut: ["pruned", "harvested"].contains(&row[places[10]].as_str()),
        }
    };
    Ok(rows.iter().map(of).collect())
}

/// The name of an axis.
fn named(own: &Component) -> String {
    format!("{}/{}", own.plant, own.axis)
}

/// Buds of the axes with the growth units that they have made, tick by tick.
fn activity(own: &[&Component], last: u32) -> Vec<Vec<String>> {
    let mut made: BTreeMap<(u32, u32), BTreeMap<u32, u32>> = BTreeMap::new();
    for internode in own.iter().filter(|own| own.kind == Kind::Internode) {
        let units = made.entry((internode.plant, internode.axis)).or_default();
        // Where a model has no growth units, each internode is one.
        units.entry(internode.unit.or(internode.rank).unwrap_or(1)).or_insert(internode.birth);
    }
    let mut rows = Vec::new();
    for bud in own.iter().filter(|own| own.kind == Kind::Bud) {
        let end = bud.death.map_or(last, |death| death.saturating_sub(1)).max(bud.birth);
        let mut days: BTreeMap<u32, u32> = BTreeMap::from([(bud.birth, 0)]);
        let mut births: Vec<u32> =
            made.get(&(bud.plant, bud.axis)).map(|units| units.values().copied().collect()).unwrap_or_default();
        births.sort_unstable();
        (1..).zip(&births).for_each(|(count, birth)| _ = days.insert((*birth).max(bud.birth), count));
        days.entry(end.max(days.keys().next_back().copied().unwrap_or(0))).or_insert(births.len() as u32);
        rows.extend(
            days.iter().map(|(day, count)| vec![bud.plant.to_string(), named(bud), day.to_string(), count.to_string()]),
        );
    }
    rows
}

fn mortality(own: &[&Component], last: u32) -> Vec<Vec<String>> {
    let life = |bud: &&Component| {
        let (age, died) = match bud.death {
            Some(death) if bud.cut => (death.saturating_sub(bud.birth).saturating_sub(1), 0),
            Some(death) => (death.saturating_sub(bud.birth).max(1), 1),
            None => (last.saturating_sub(bud.birth), 0),
        };
        vec![bud.plant.to_string(), named(bud), age.to_string(), died.to_string()]
    };
    own.iter().copied().filter(|own| own.kind == Kind::Bud).map(|bud| life(&bud)).collect()
}

fn nodes(own: &[&Component]) -> Vec<Vec<String>> {
    let mut units: BTreeMap<(u32, u32, u32), u32> = BTreeMap::new();
    for internode in own.iter().filter(|own| own.kind == Kind::Internode) {
        let Some(unit) = internode.unit else { continue };
        *units.entry((internode.plant, internode.axis, unit)).or_default() += 1;
    }
    let row = |((plant, axis, _), nodes): (&(u32, u32, u32), &u32)| {
        vec![plant.to_string(), format!("{plant}/{axis}"), nodes.to_string()]
    };
    units.iter().map(row).collect()
}

/// The nodes of each axis.
fn lengths(components: &[Component]) -> BTreeMap<(u32, u32), u32> {
    let mut lengths: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for internode in components.iter().filter(|own| own.kind == Kind::Internode) {
        *lengths.entry((internode.plant, internode.axis)).or_default() += 1;
    }
    lengths
}

/// Nodes of living axes that bear two living branches alone, with the nodes above them.
fn crown(components: &[Component], order: u32) -> Vec<Vec<String>> {
    let lengths = lengths(components);
    let living = |own: &&Component| own.kind == Kind::Bud && own.death.is_none();
    let bearers: BTreeMap<(u32, u32), u32> = components
        .iter()
        .filter(|own| own.order == order)
        .filter(living)
        .map(|own| ((own.plant, own.axis), lengths.get(&(own.plant, own.axis)).copied().unwrap_or(0)))
        .collect();
    let mut pairs: BTreeMap<(u32, u32, u32), Vec<u32>> = BTreeMap::new();
    for branch in components.iter().filter(|own| own.order == order + 1).filter(living) {
        let (Some(bearer), Some(rank)) = (branch.bearer, branch.rank) else { continue };
        let nodes = lengths.get(&(branch.plant, branch.axis)).copied().unwrap_or(0);
        pairs.entry((branch.plant, bearer, rank)).or_default().push(nodes);
    }
    let row = |((plant, bearer, rank), nodes): (&(u32, u32, u32), &Vec<u32>)| {
        let above = bearers.get(&(*plant, *bearer))?.checked_sub(*rank)?;
        let [first, second] = nodes.as_slice() else { return None };
        Some([plant, &above, first, second].map(u32::to_string).to_vec())
    };
    pairs.iter().filter_map(row).collect()
}

/// The fate of each node of an axis: the state of the axis that it bears, `axis` where the species names no states, or
/// `latent`.
fn branching(components: &[Component], order: u32) -> Vec<Vec<String>> {
    let mut borne: BTreeMap<(u32, u32, u32), &str> = BTreeMap::new();
    for bud in components.iter().filter(|own| own.order == order + 1 && own.kind == Kind::Bud) {
        let (Some(bearer), Some(rank)) = (bud.bearer, bud.rank) else { continue };
        let state = if bud.state.is_empty() { "axis" } else { bud.state.as_str() };
        borne.entry((bud.plant, bearer, rank)).or_insert(state);
    }
    let lengths = lengths(components);
    let axes = components.iter().filter(|own| own.order == order && own.kind == Kind::Bud);
    let of = |axis: &Component| {
        let nodes = lengths.get(&(axis.plant, axis.axis)).copied().unwrap_or(0);
        let (plant, number, name) = (axis.plant, axis.axis, named(axis));
        let borne = &borne;
        let row = move |rank: u32| {
            let fate = borne.get(&(plant, number, rank)).copied().unwrap_or("latent");
            vec![plant.to_string(), name.clone(), rank.to_string(), fate.to_owned()]
        };
        (1..=nodes).map(row).collect::<Vec<_>>()
    };
    axes.flat_map(of).collect()
}
