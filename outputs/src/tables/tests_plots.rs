//! Tables of plots of several plants of two species, sown at different ticks: the values of each row, and the order of
//! rows.
//!
//! Rows are read back cell by cell. The rows of a plant are compared with a run of that plant alone, sown at tick 0,
//! whose ticks are the ages of the plant in the plot.

use super::*;
use crate::read::Run;
use crate::specimen::{grow_plots, plan};
use crate::specimen_plots::{MEMBERS, SPECIES, mixed, mixed_plan, model, number_of, run_mixed, seed};
use crate::tables::Factor;
use crate::{Mode, RunFolder};
use ::arrow_array::cast::AsArray;
use ::arrow_array::types::{Date32Type, Float32Type, Float64Type, Int8Type, Int32Type, Int64Type};
use ::arrow_array::{Array, RecordBatch};
use ::arrow_schema::DataType;
use phytomer_sim::plant::{AxisId, EventKind, NewAxis};
use phytomer_sim::site::calendar::{Calendar, CalendarTick, TickLength};
use phytomer_sim::site::calendars::Calendars;
use phytomer_sim::site::date::Date;
use phytomer_sim::{Ending, Plot, Tick, grow};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tempfile::tempdir;

const PLOTS: u32 = 5;

/// A row by the names of its columns; null as the empty text.
type Row = BTreeMap<String, String>;

fn cell(array: &dyn Array, row: usize) -> String {
    if array.is_null(row) {
        return String::new();
    }
    match array.data_type() {
        DataType::Boolean => array.as_boolean().value(row).to_string(),
        DataType::Int32 => array.as_primitive::<Int32Type>().value(row).to_string(),
        DataType::Date32 => array.as_primitive::<Date32Type>().value(row).to_string(),
        DataType::Int64 => array.as_primitive::<Int64Type>().value(row).to_string(),
        DataType::Float32 => array.as_primitive::<Float32Type>().value(row).to_string(),
        DataType::Float64 => array.as_primitive::<Float64Type>().value(row).to_string(),
        DataType::Utf8 => array.as_string::<i32>().value(row).to_owned(),
        DataType::Dictionary(key, _) if **key == DataType::Int8 => {
            let words = array.as_dictionary::<Int8Type>();
            cell(words.values(), words.keys().value(row) as usize)
        }
        _ => {
            let names = array.as_dictionary::<Int32Type>();
            cell(names.values(), names.keys().value(row) as usize)
        }
    }
}

fn rows_in(batches: &[RecordBatch]) -> Vec<Row> {
    let of = |batch: &RecordBatch, row: usize| {
        let schema = batch.schema();
        let cells = schema.fields().iter().zip(batch.columns());
        cells.map(|(field, array)| (field.name().clone(), cell(array, row))).collect::<Row>()
    };
    batches.iter().flat_map(|batch| (0..batch.num_rows()).map(move |row| of(batch, row))).collect()
}

fn rows(path: &Path, table: Table) -> Vec<Row> {
    let batches = Run::open(path).unwrap().batches(table).unwrap();
    rows_in(&batches.map(Result::unwrap).collect::<Vec<_>>())
}

#[track_caller]
fn int(row: &Row, column: &str) -> i64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {:?}", row[column]))
}

/// For each plant by its number: its plot, its species, and the tick at which it is sown.
fn sown() -> BTreeMap<i64, (u32, usize, Tick)> {
    let plots = (0..PLOTS).flat_map(|plot| MEMBERS.map(|member| (plot, member)));
    let of = |(plot, (species, in_plot, sown))| (i64::from(number_of(plot, in_plot, PLOTS)), (plot, species, sown));
    plots.map(of).collect()
}

/// The tables whose rows are of plants.
const OF_PLANTS: [Table; 5] = [Table::Components, Table::Records, Table::Events, Table::Summary, Table::Plants];

#[test]
fn rows_are_in_the_order_that_their_files_state() {
    let home = tempdir().unwrap();
    run_mixed(home.path(), mixed_plan(PLOTS, 2));
    let run = Run::open(home.path()).unwrap();
    for table in OF_PLANTS {
        let order = ["plot_id", "tick", "plant_id", "component_id"];
        let has = |name: &&str| table.columns(false).iter().any(|column| column.name == *name);
        let order: Vec<&str> = order.into_iter().filter(has).collect();
        for part in run.parquet(table).unwrap() {
            let names = part.file_metadata().schema_descr().columns().to_vec();
            for group in part.row_groups() {
                let stated = group.sorting_columns().unwrap();
                let stated: Vec<&str> = stated.iter().map(|by| names[by.column_idx as usize].name()).collect();
                assert_eq!(stated, order, "{table:?}");
            }
        }
        let keys: Vec<Vec<i64>> =
            rows(home.path(), table).iter().map(|row| order.iter().map(|name| int(row, name)).collect()).collect();
        let repeats = table == Table::Events;
        assert!(keys.is_sorted_by(|a, b| a < b || repeats && a == b), "{table:?}");
        assert!(keys.len() >= 15);
    }
    // Where a model rewrites, the columns are in another order than the component numbers, so that sorting has an
    // effect.
    let mut plot = mixed(0, PLOTS, 100_000);
    plot.grow_to(7).unwrap();
    assert!(!plot.plants[1].nodes.component.is_sorted());
}

#[test]
fn ticks_are_those_of_the_plot_and_ages_those_of_the_plant() {
    let home = tempdir().unwrap();
    let report = run_mixed(home.path(), mixed_plan(PLOTS, 2));
    let (recorded, sown) = (mixed_plan(PLOTS, 2).recorded, sown());
    let treatments = ["control", "shade"];
    for table in OF_PLANTS {
        let mut ticks: BTreeMap<i64, BTreeSet<Tick>> = BTreeMap::new();
        for row in rows(home.path(), table) {
            let (plot, _, sown) = sown[&int(&row, "plant_id")];
            assert_eq!(int(&row, "plot_id"), i64::from(plot));
            assert_eq!(row["treatment"], treatments[plot as usize % 2]);
            if let Some(tick) = row.get("tick") {
                assert_eq!(tick.parse::<i64>().unwrap(), int(&row, "age") + i64::from(sown));
                ticks.entry(int(&row, "plant_id")).or_default().insert(tick.parse().unwrap());
            }
        }
        if [Table::Records, Table::Summary].contains(&table) {
            for (plant, (_, _, sown)) in &sown {
                let expected = recorded.iter().copied().filter(|tick| tick >= sown).collect();
                assert_eq!(ticks[plant], expected, "{table:?}: plant {plant}");
            }
        }
    }
    let plants = rows(home.path(), Table::Plants);
    assert_eq!(plants.len(), sown.len());
    for row in plants {
        let (plot, species, sown) = sown[&int(&row, "plant_id")];
        assert_eq!((row["species"].as_str(), int(&row, "sown_tick")), (SPECIES[species], sown.into()));
        assert_eq!(int(&row, "replicate"), i64::from(plot / 2));
        assert_eq!(row["x_m"].parse::<u32>().unwrap(), int(&row, "plant_id") as u32 / PLOTS);
    }
    // The saplings die at the age of 10; those that were sown at tick 5 live at tick 12.
    assert_eq!((report.living, report.dead), (10, 5));
    assert_eq!(report.components, rows(home.path(), Table::Components).len() as u64);
}

/// The rows of one plant without the columns that place it among others.
fn own(rows: Vec<Row>, plant: i64, last: Option<i64>) -> Vec<Row> {
    let mine = |row: &Row| int(row, "plant_id") == plant && last.is_none_or(|last| int(row, "age") <= last);
    let mut own: Vec<Row> = rows.into_iter().filter(mine).collect();
    for row in &mut own {
        row.retain(|column, _| !["plot_id", "tick", "treatment"].contains(&column.as_str()));
    }
    own
}

#[test]
fn a_plant_sown_later_has_the_rows_of_one_sown_first() {
    let home = tempdir().unwrap();
    let all = mixed_plan(PLOTS, 2);
    run_mixed(&home.path().join("plots"), all.clone());
    for (plant, (_, species, sown)) in sown() {
        let alone = home.path().join(format!("plant-{plant}"));
        let mut plan = plan(1, 1);
        plan.until = all.until - sown;
        plan.recorded = all.recorded.iter().filter_map(|tick| tick.checked_sub(sown)).collect();
        let folder = RunFolder::create(&alone, plan, Mode::New).unwrap();
        grow_plots(&folder, 0, |_| Plot { id: 0, ..Plot::of_one(model(species), &seed(plant as u32, 100_000)) });
        folder.finish(&[]).unwrap();
        for table in [Table::Components, Table::Records, Table::Events, Table::Summary] {
            let [here, there] =
                [home.path().join("plots"), alone.clone()].map(|path| own(rows(&path, table), plant, None));
            assert!(!here.is_empty() && here == there, "{table:?} of plant {plant}");
        }
    }
}

#[test]
fn tables_in_memory_have_the_rows_of_the_files() {
    let home = tempdir().unwrap();
    let plan = mixed_plan(2, 2);
    run_mixed(home.path(), plan.clone());
    let mut tables = MemoryTables::of(&plan, &std::sync::Arc::default());
    for id in 0..2 {
        let mut plot = mixed(id, 2, 100_000);
        let ending = grow(&mut plot, plan.until, &mut tables).unwrap();
        tables.end_plot(&plot, &ending).unwrap();
    }
    let batches = tables.finish().unwrap();
    for table in OF_PLANTS {
        assert_eq!(rows_in(&batches[&table]), rows(home.path(), table), "{table:?}");
    }
}

/// A sapling reaches its limit at a tick at which another plant is not sown yet. The ticks before are kept, for all
/// plants, and the plant that never was sown has a row in `plants` only.
#[test]
fn a_plot_that_outgrows_its_limit_keeps_the_ticks_before_of_all_its_plants() {
    let home = tempdir().unwrap();
    let folder = RunFolder::create(home.path(), mixed_plan(1, 1), Mode::New).unwrap();
    let (report, endings) = grow_plots(&folder, 0, |id| mixed(id, 1, 30));
    folder.finish(&[]).unwrap();
    let Ending::Overgrown { age: tick, limit } = endings[0].clone() else { panic!("{endings:?}") };
    assert!(limit.plant == 2 && (4..=5).contains(&tick), "{endings:?}");
    assert_eq!((report.overgrown[0].plant, report.overgrown[0].tick), (2, tick));
    assert_eq!((report.living, report.dead), (2, 0), "the third is not sown");
    assert_eq!(rows(home.path(), Table::Plants).len(), 3);
    let components = rows(home.path(), Table::Components);
    assert_eq!(report.components, components.len() as u64);
    let whole = tempdir().unwrap();
    run_mixed(whole.path(), mixed_plan(1, 1));
    let last = |plant: i64| i64::from(tick) - 1 - i64::from(MEMBERS.iter().find(|of| of.1 == plant as u32).unwrap().2);
    for table in [Table::Records, Table::Events, Table::Summary] {
        let of = |path: &Path, plant| own(rows(path, table), plant, Some(last(plant)));
        for plant in 0..3 {
            assert_eq!(of(home.path(), plant), of(whole.path(), plant), "{table:?} of plant {plant}");
        }
        assert!(rows(home.path(), table).iter().all(|row| int(row, "tick") < i64::from(tick)), "{table:?}");
    }
    for row in &components {
        let last = last(int(row, "plant_id"));
        assert!(int(row, "birth_age") <= last && (row["death_age"].is_empty() || int(row, "death_age") <= last));
    }
}

/// Numbers of plants that do not rise from plot to plot, and rows that are sorted by tick before plant.
#[test]
fn the_first_plants_are_found_wherever_their_rows_are() {
    let home = tempdir().unwrap();
    run_mixed(home.path(), mixed_plan(PLOTS, 2));
    let run = Run::open(home.path()).unwrap();
    let components = rows(home.path(), Table::Components);
    let records = rows(home.path(), Table::Records);
    for plants in [0, 1, 3, 8, 15, 40] {
        let below = |row: &&Row| int(row, "plant_id") < plants;
        let expected: Vec<_> =
            components.iter().filter(below).map(|row| (int(row, "plant_id"), int(row, "component_id"))).collect();
        let found = run.components(plants as u32).unwrap();
        let found: Vec<_> = found.iter().map(|row| (i64::from(row.plant_id), i64::from(row.component_id))).collect();
        assert_eq!(found, expected, "components of the plants below {plants}");
        let is_stem = |row: &&Row| row["kind"].ends_with("internode");
        let of = |row: &Row| ["plant_id", "age", "axis_id", "rank"].map(|name| int(row, name));
        let expected: Vec<_> = records.iter().filter(below).filter(is_stem).map(of).collect();
        let found = run.poses(plants as u32).unwrap();
        let of = |row: &crate::rows::PoseRow| [row.plant_id, row.age, row.axis_id, row.rank].map(i64::from);
        assert_eq!(found.iter().map(of).collect::<Vec<_>>(), expected, "poses of the plants below {plants}");
    }
}

/// A model may keep the axes of its plants in another order than that of their buds' numbers.
#[test]
fn events_follow_the_numbers_of_buds_whatever_the_order_of_axes() {
    let mut plot = Plot::of_one(model(0), &seed(0, 100));
    let plant = &mut plot.plants[0];
    plant.begin_rewriting();
    for number in [0, 7, 4] {
        plant.place_axis(NewAxis::OF_THE_SEED, number);
    }
    for (tick, axis) in [(2, 1), (1, 2), (1, 1), (1, 0)] {
        plant.note(tick, AxisId(axis), EventKind::Grew, 1);
    }
    let mut sorted = SortedEvents::default();
    sorted.sort(&plot, 2);
    let events: Vec<_> = sorted.stretches().flat_map(|(_, events)| events).map(|of| (of.tick, of.axis.0)).collect();
    assert_eq!(events, [(1, 0), (1, 2), (1, 1), (2, 1)], "the third axis has a lower number than the second");
}

/// A day each tick from 1969-12-30 on, which is two days before day 0 of the tables.
fn dated(until: Tick) -> Calendar {
    let tick = |tick: Tick| CalendarTick {
        date: Date::EPOCH.plus(tick as i32 - 2),
        days: u32::from(tick > 0),
        degree_days: Some(0.5),
        degree_day_sum: Some(0.5 * f64::from(tick)),
        day_length_h: None,
        nitrogen_kg_ha: Some(60.0),
    };
    Calendar::of_ticks(TickLength::Days(1), (0..=until).map(tick).collect()).unwrap()
}

/// The plots of a treatment have its calendar; each plot is of another treatment or replicate, so each has its rows.
#[test]
fn the_site_has_the_calendar_of_its_treatment_and_counts_the_living() {
    let home = tempdir().unwrap();
    let mut plan = mixed_plan(PLOTS, 2);
    plan.calendars = vec![Calendars::default(), Calendars::from(dated(plan.until))];
    run_mixed(home.path(), plan.clone());
    let (site, summary) = (rows(home.path(), Table::Site), rows(home.path(), Table::Summary));
    assert_eq!(site.len(), PLOTS as usize * plan.recorded.len());
    for (place, row) in site.iter().enumerate() {
        let (plot, tick) = (place / plan.recorded.len(), plan.recorded[place % plan.recorded.len()]);
        let numbers = ["plot_id", "tick", "plots", "replicate"].map(|name| int(row, name));
        assert_eq!(numbers, [plot as i64, tick.into(), 1, plot as i64 / 2]);
        assert_eq!(row["treatment"], ["control", "shade"][plot % 2]);
        let told = ["date", "degree_day_sum", "day_length_h", "nitrogen_kg_ha"].map(|name| row[name].as_str());
        let (date, sum) = ((i64::from(tick) - 2).to_string(), (0.5 * f64::from(tick)).to_string());
        assert_eq!(told, [["", "", "", ""], [date.as_str(), sum.as_str(), "", "60"]][plot % 2]);
        let is_here = |of: &&Row| int(of, "plot_id") == plot as i64 && int(of, "tick") == i64::from(tick);
        let living = summary.iter().filter(is_here).filter(|of| of["alive"] == "true").count();
        assert_eq!(int(row, "living_plants"), living as i64, "plot {plot}, tick {tick}");
    }
}

/// The table of treatments is in part 0 alone, with a column for each factor.
#[test]
fn treatments_are_written_once_with_their_factors() {
    let home = tempdir().unwrap();
    let mut plan = mixed_plan(PLOTS, 2);
    plan.provenance.factors =
        vec![Factor { name: "light".to_owned(), levels: vec!["sun".to_owned(), "half".to_owned()] }];
    run_mixed(home.path(), plan);
    let run = Run::open(home.path()).unwrap();
    assert!(PLOTS > 2 && run.parts(Table::Treatments).unwrap().len() == 1, "one part of several");
    let rows = rows(home.path(), Table::Treatments);
    let of = |row: usize| ["treatment_index", "treatment", "light"].map(|column| rows[row][column].clone());
    assert_eq!(
        (rows.len(), of(0), of(1)),
        (2, ["0", "control", "sun"].map(str::to_owned), ["1", "shade", "half"].map(str::to_owned))
    );
    let package = std::fs::read_to_string(home.path().join("datapackage.json")).unwrap();
    assert!(package.contains("The level of the factor `light`."));
}
