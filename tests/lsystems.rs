//! The tables of an L-system of a file: the life table of Synthetic Topiary's L-system 4, the rows that stand at each
//! age, and a file of the user's with what lies beside it, by the command line.
//!
//! Absent: the strings (`tests/derive.rs`), and the language and the turtle, which have tests of their own.

mod program;

use arrow_array::RecordBatch;
use arrow_array::cast::AsArray;
use arrow_array::types::{Int8Type, Int32Type};
use phytomer::outputs::Table;
use phytomer::run::{self, Progress};
use phytomer_config::validate_texts;
use std::collections::BTreeMap;

/// The batches of a run of one plant of a species that records every age.
fn grown(species: &str, until: u32) -> BTreeMap<Table, Vec<RecordBatch>> {
    let scenario = format!(
        "name = \"life\"\nspecies = \"{species}\"\nplants = 1\nages = {{ until = {until}, record = \"all\" }}\n"
    );
    let resolved =
        validate_texts("life", &[("life", &scenario)]).unwrap_or_else(|report| panic!("{}", report.render(false)));
    run::in_memory(&resolved, 1, &Progress::default()).unwrap().batches
}

/// A column of numbers, with `None` for null.
fn column(batches: &[RecordBatch], name: &str) -> Vec<Option<i32>> {
    let columns = batches.iter().map(|batch| batch.column_by_name(name).expect("a column").clone());
    let numbers = |array: arrow_array::ArrayRef| array.as_primitive::<Int32Type>().iter().collect::<Vec<_>>();
    columns.flat_map(numbers).collect()
}

/// A column of words, with an empty word for null.
fn words(batches: &[RecordBatch], name: &str) -> Vec<String> {
    let mut words = Vec::new();
    for batch in batches {
        let column = batch.column_by_name(name).expect("a column").as_dictionary::<Int8Type>();
        let (keys, list) = (column.keys(), column.values().as_string::<i32>());
        words.extend(keys.iter().map(|key| key.map_or(String::new(), |key| list.value(key as usize).to_owned())));
    }
    words
}

/// 39 internodes, of which 19 die when they are two steps old; 19 buds, each with its time of waiting; what bears a
/// component at its birth has a smaller number; and a row of `records` is a component that stands.
#[test]
fn the_life_table_of_a_tree_that_is_pruned() {
    let batches = grown("topiary/4", 94);
    let components = &batches[&Table::Components];
    let kinds = words(components, "kind");
    let causes = words(components, "cause_of_death");
    let [births, deaths, numbers, parents] =
        ["birth_age", "death_age", "component_id", "parent_id"].map(|name| column(components, name));
    let of = |kind: &str| (0..kinds.len()).filter(|row| kinds[*row] == kind).collect::<Vec<_>>();
    let life = |row: usize| deaths[row].zip(births[row]).map(|(death, birth)| death - birth);
    let internodes: Vec<Option<i32>> = of("internode").into_iter().map(life).collect();
    assert_eq!(internodes.len(), 39);
    assert_eq!(internodes.iter().flatten().collect::<Vec<_>>(), vec![&2; 19]);
    let mut waited: Vec<i32> = of("axillary_bud").into_iter().filter_map(life).collect();
    waited.sort_unstable();
    let expected = [vec![3; 10], vec![8; 4], vec![13, 18, 23, 48, 93]].concat();
    assert_eq!(waited, expected);
    let dead = (0..kinds.len()).filter(|row| deaths[*row].is_some());
    assert!(dead.clone().count() > 38 && dead.clone().all(|row| causes[row] == "rewritten"), "{causes:?}");
    assert!((0..numbers.len()).all(|row| parents[row].is_none_or(|parent| Some(parent) < numbers[row])));
    let records = &batches[&Table::Records];
    let (ages, kinds_of_rows) = (column(records, "age"), words(records, "kind"));
    for (age, internodes, buds) in [(6, 6, 5), (8, 6, 4), (40, 12, 3), (94, 20, 0)] {
        let count =
            |kind: &str| (0..ages.len()).filter(|row| ages[*row] == Some(age) && kinds_of_rows[*row] == kind).count();
        assert_eq!((count("internode"), count("axillary_bud")), (internodes, buds), "age {age}");
    }
}

const SURFACE: &str = "-1 1 0 2 0 1\nCONTACT POINT  X: 0 Y: 0 Z: 0\nEND POINT  X: 0 Y: 1 Z: 0\nHEADING  X: 0 Y: 1 Z: 0\n\
    UP  X: 0 Y: 0 Z: 1\nSIZE: 2\nblade\nTOP COLOR: 0 DIFFUSE: 0.00 BOTTOM COLOR: 0 DIFFUSE: 0.00\nAL: ~ A: ~ AR: ~\n\
    L: ~ R: ~\nBL: ~ B: ~ BR: ~\n-1 0 0  -0.3 0 0  0.3 0 0  1 0 0\n-1 0.7 0  -0.3 0.7 0  0.3 0.7 0  1 0.7 0\n\
    -1 1.3 0  -0.3 1.3 0  0.3 1.3 0  1 1.3 0\n-1 2 0  -0.3 2 0  0.3 2 0  1 2 0\n";

/// A file of one's own is validated, grown, drawn and pictured by its name, with what lies beside it.
#[test]
fn a_file_of_ones_own_is_taken_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    put("plant.l", b"#define n 5\nLsystem: 1\nderivation length: n\nAxiom: !(0.1);(2)A\nA --> F(1)[+(50)~l]/(137.5)A\nendlsystem\n");
    put("plant.v", b"line style: cylinder\nsurface: l leaf.s 0.5\n");
    put("leaf.s", SURFACE.as_bytes());
    put("plant.map", &[10, 20, 30, 40, 50, 60, 200, 100, 50]);
    let run = |words: &[&str], code: i32| program::run(folder.path(), words).ending(code);
    run(&["validate", "plant.l"], 0);
    run(&["mesh", "plant.l", "--out", "plant.ply"], 0);
    let mesh = std::fs::read(folder.path().join("plant.ply")).unwrap();
    assert!(mesh.starts_with(b"ply") && mesh.len() > 1000);
    run(&["grow", "plant.l", "--out", "run"], 0);
    let json = std::fs::read_to_string(folder.path().join("run/run.json")).unwrap();
    assert!(json.contains("derivation length: n"), "the run carries the texts of its species");
    put("plant.l", b"Axiom: F(\n");
    let told = run(&["validate", "plant.l"], 3);
    assert!(told.stderr.contains("plant.l:1"), "{}", told.stderr);
}

/// An L-system to begin with: its files run as they are, and the herb flowers.
#[test]
fn init_writes_an_l_system() {
    let folder = tempfile::tempdir().unwrap();
    program::run(folder.path(), &["init", "herb", "--model", "lsystem"]).ending(0);
    program::run(folder.path(), &["validate", "herb/scenario.toml", "herb/species.toml", "herb/plant.l"]).ending(0);
    let json = program::run(folder.path(), &["grow", "herb/scenario.toml", "--plants", "6", "--json"]).ending(0).json();
    assert_eq!(json["plants"], 6);
    let counts = |plant: &str| {
        let words = ["derive", "herb/species.toml", "--step", "24", "--counts", "--plant", plant];
        program::run(folder.path(), &words).ending(0).stdout
    };
    assert!(counts("0").contains("P\t"), "it flowers");
    program::run(folder.path(), &["init", "herb", "--model", "buds"]).ending(2);
    program::run(folder.path(), &["init", "tree", "--model", "gmt1"]).ending(2);
}
