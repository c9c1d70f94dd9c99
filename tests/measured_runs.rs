//! Measured plants in tables: what the file says is there, and what it does not say is null.

use phytomer::outputs::exchange::{Incoming, Report, Units, by_word};
use phytomer::outputs::measured::{Source, write};
use phytomer::outputs::read::Run;
use phytomer::outputs::{Input, Mode, Table};

const TEXT: &str = "CODE:\tFORM-A\nCLASSES:\nP\t1\nAxis\t2\nGU\t3\nInternode\t4\nLeaf\t4\nDESCRIPTION:\nFEATURES:\nLength\tREAL\nDate\tDD/MM/YY\n\
    MTG:\nENTITY-CODE\t\tLength\tDate\n/P1\n^/Axis1/GU1/Internode1\t\t2\t01/02/2003\n*\t\t3\t01/03/2003\n\t+Leaf1\n\
    ^<Internode2\t\t1\t01/03/2003\n\t+Axis2/GU1/Internode1\n\t^<GU2/Internode2\n^<GU2/Internode3\n/P2\n";

fn taken(text: &str) -> (tempfile::TempDir, Run) {
    let folder = tempfile::tempdir().unwrap();
    let mut report = Report::new("plant.mtg");
    let beside = |name: &str| Err(std::io::Error::other(name.to_owned()));
    let incoming =
        Incoming { name: "plant.mtg", bytes: text.as_bytes(), units: Some(Units::default()), beside: &beside };
    let description = by_word("mtg").unwrap().read(&incoming, &mut report);
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    let file = Input { path: "plant.mtg".to_owned(), sha256: "00".to_owned() };
    let source = Source {
        name: "plant".to_owned(),
        file,
        format: "mtg".to_owned(),
        version: "1".to_owned(),
        git_hash: String::new(),
    };
    let path = folder.path().join("run");
    let taken = write(&path, &description, source, Mode::New).unwrap();
    assert_eq!(taken.without_places, description.individuals.len() as u64);
    let run = Run::open(&path).unwrap();
    (folder, run)
}

/// The cells of some columns of a table; an empty cell is null.
fn cells(run: &Run, table: Table, columns: &[&str]) -> Vec<Vec<String>> {
    let (names, rows) = phytomer::outputs::cells::of_run(run, table, columns).unwrap();
    let at = |name: &&str| names.iter().position(|known| known == name).unwrap();
    rows.iter().map(|row| columns.iter().map(|name| row[at(name)].clone()).collect()).collect()
}

#[test]
fn axes_ranks_and_growth_units_follow_from_the_topology() {
    let (_folder, run) = taken(TEXT);
    assert!(run.is_complete());
    let columns = [
        "component_id",
        "kind",
        "axis_id",
        "bearing_axis_id",
        "order",
        "parent_id",
        "rank",
        "growth_unit",
        "unit_rank",
    ];
    let rows = cells(&run, Table::Components, &columns);
    let rows: Vec<String> = rows.into_iter().map(|row| row.join(" ")).collect();
    let expected = [
        "0 apical_bud 0  1    ",
        "1 internode 0  1  1 1 1",
        "2 leaf 0  1 1 1  1",
        "3 internode 0  1 1 2 1 2",
        "4 apical_bud 4 0 2 3 2  2",
        "5 internode 4 0 2 3 1 1 1",
        "6 internode 4 0 2 5 2 2 1",
        "7 internode 0  1 3 3 2 1",
    ];
    assert_eq!(rows, expected);
    let unsaid = cells(&run, Table::Components, &["birth_age", "death_age", "state", "delay", "birth_diameter_m"]);
    assert!(unsaid.iter().flatten().all(String::is_empty), "{unsaid:?}");
}

#[test]
fn dates_are_ticks_and_what_is_not_said_is_null() {
    let (_folder, run) = taken(TEXT);
    let rows = cells(&run, Table::Records, &["plant_id", "tick", "component_id", "length_m", "x_m", "diameter_m"]);
    let first: Vec<&Vec<String>> = rows.iter().filter(|row| row[1] == "0").collect();
    let later: Vec<&Vec<String>> = rows.iter().filter(|row| row[1] == "28").collect();
    assert_eq!(first.len() + later.len(), rows.len());
    // The second internode is seen on the later date alone.
    assert_eq!((first.len(), later.len()), (5, 6));
    let length =
        |rows: &[&Vec<String>], number: &str| rows.iter().find(|row| row[2] == number).map(|row| row[3].clone());
    assert_eq!(length(&first, "1").as_deref(), Some("2"));
    assert_eq!((length(&later, "1").as_deref(), length(&first, "3")), (Some("3"), None));
    assert!(rows.iter().all(|row| row[4].is_empty() && row[5].is_empty()));
    let summary = run.summary().unwrap();
    assert_eq!(
        summary.iter().map(|row| (row.plant_id, row.tick, row.internodes)).collect::<Vec<_>>(),
        [(0, 0, 4), (1, 0, 0), (0, 28, 5), (1, 28, 0)]
    );
    assert!(summary.iter().all(|row| row.height_m.is_none()));
    assert_eq!(run.json()["resolved_scenario"]["measured"]["plants_without_places"], 2);
    assert_eq!(run.json()["inputs"][0]["sha256"], "00");
}
