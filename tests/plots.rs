//! The tables of plots of several plants: two species of two models, sown at different ticks.
//!
//! Tables are read by the parquet crate alone. Rows are sorted by plot, tick, plant and component, also where a model
//! rewrites its plants in mid-axis; each plant has its own age; and the summary is a count of the records.

mod mixed;
mod program;
mod read;

use mixed::{MEMBERS, PLOTS, SPECIES, TREATMENTS};
use program::run;
use read::Columns;
use std::collections::BTreeMap;

const TABLES: [&str; 5] = ["components", "records", "events", "summary", "plants"];

/// The columns by which the rows of a table are sorted.
fn order_of(table: &str) -> Vec<&'static str> {
    let lacks = |column: &str| match column {
        "tick" => ["components", "plants"].contains(&table),
        "component_id" => ["summary", "plants"].contains(&table),
        _ => false,
    };
    ["plot_id", "tick", "plant_id", "component_id"].into_iter().filter(|column| !lacks(column)).collect()
}

#[test]
fn rows_are_sorted_by_plot_tick_plant_and_component() {
    let home = tempfile::tempdir().unwrap();
    mixed::write(home.path());
    for name in TABLES {
        let table = Columns::of(home.path(), name);
        let keys: Vec<&[f64]> = order_of(name).into_iter().map(|column| table.numbers(column)).collect();
        let rows = keys[0].len();
        let row = |row: usize| keys.iter().map(|key| key[row] as u32).collect::<Vec<_>>();
        let unsorted = (1..rows).find(|at| row(at - 1) > row(*at));
        assert!(unsorted.is_none(), "{name}: {:?}", unsorted.map(|at| [row(at - 1), row(at)]));
        let repeated = (1..rows).find(|at| row(at - 1) == row(*at)).filter(|_| name != "events");
        assert!(rows >= 9 && repeated.is_none(), "{name}: {:?}", repeated.map(row));
    }
    // A new internode stands between two old ones: its number is above that of the internode that it bears.
    let records = Columns::of(home.path(), "records");
    let (numbers, parents) = (records.numbers("component_id"), records.numbers("parent_id"));
    assert!(numbers.iter().zip(parents).any(|(number, parent)| parent > number));
}

#[test]
fn each_plant_has_its_own_age_and_none_before_it_is_sown() {
    let home = tempfile::tempdir().unwrap();
    mixed::write(home.path());
    let plants = Columns::of(home.path(), "plants");
    let number = |column: &str, row: usize| plants.numbers(column)[row] as u32;
    let mut sown = BTreeMap::new();
    for row in 0..plants.numbers("plant_id").len() {
        let (plot, plant) = (number("plot_id", row), number("plant_id", row));
        let (species, _, tick) = *MEMBERS.iter().find(|of| of.1 == plant - 3 * plot).unwrap();
        assert_eq!((plants.words("species")[row].as_str(), number("sown_tick", row)), (SPECIES[species], tick));
        assert_eq!(
            (plants.words("treatment")[row].as_str(), number("replicate", row)),
            (TREATMENTS[plot as usize % 2], plot / 2)
        );
        sown.insert(plant, (plot, tick));
    }
    assert_eq!(sown.len(), PLOTS as usize * MEMBERS.len());
    for name in TABLES {
        let table = Columns::of(home.path(), name);
        for (row, plant) in table.numbers("plant_id").iter().enumerate() {
            let (plot, sown) = sown[&(*plant as u32)];
            assert_eq!(table.numbers("plot_id")[row], f64::from(plot));
            assert_eq!(table.words("treatment")[row], TREATMENTS[plot as usize % 2]);
            if order_of(name).contains(&"tick") {
                assert_eq!(table.numbers("tick")[row], table.numbers("age")[row] + f64::from(sown), "{name}");
            }
        }
    }
    let summary = Columns::of(home.path(), "summary");
    for (plant, (_, sown)) in sown {
        let rows = summary.numbers("plant_id").iter().zip(summary.numbers("tick"));
        let ticks: Vec<u32> = rows.filter(|row| *row.0 == f64::from(plant)).map(|row| *row.1 as u32).collect();
        assert_eq!(ticks, [0, 2, 3, 4, 8, 12].into_iter().filter(|tick| *tick >= sown).collect::<Vec<_>>());
    }
}

/// Of each plant and tick the summary counts the rows of `records`.
#[test]
fn the_summary_of_each_member_is_a_count_of_its_records() {
    let home = tempfile::tempdir().unwrap();
    mixed::write(home.path());
    let (records, summary) = (Columns::of(home.path(), "records"), Columns::of(home.path(), "summary"));
    let key = |table: &Columns, row: usize| ["plant_id", "tick"].map(|column| table.numbers(column)[row] as u32);
    let mut counts: BTreeMap<[u32; 2], BTreeMap<&str, f64>> = BTreeMap::new();
    for (row, kind) in records.words("kind").iter().enumerate() {
        let alive = records.numbers("alive")[row] == 1.0;
        let counted = match kind.as_str() {
            "apical_bud" => "buds",
            "leaf" => "leaves",
            kind if kind.ends_with("internode") && alive => "internodes",
            kind if kind.ends_with("internode") => "dead_internodes",
            _ => continue,
        };
        *counts.entry(key(&records, row)).or_default().entry(counted).or_default() += 1.0;
    }
    for row in 0..summary.numbers("tick").len() {
        let counted = counts.get(&key(&summary, row)).cloned().unwrap_or_default();
        for column in ["buds", "leaves", "internodes", "dead_internodes"] {
            let told = summary.numbers(column)[row];
            assert_eq!(told, counted.get(column).copied().unwrap_or_default(), "{column} of {:?}", key(&summary, row));
        }
    }
}

#[test]
fn such_a_run_is_verified_and_described() {
    let home = tempfile::tempdir().unwrap();
    mixed::write(&home.path().join("run"));
    run(home.path(), &["verify", "run"]).ending(0);
    let told = run(home.path(), &["describe", "run", "--json"]).ending(0).json();
    assert_eq!((&told["living"], &told["dead"]), (&9.into(), &0.into()), "{told}");
    assert_eq!(told["tables"]["plants"]["rows"], 9);
}
