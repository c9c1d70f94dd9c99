//! The tables of a system whose cells vanish: each cell that ever was has a row of `components`, with its end and its
//! cause, whatever ages are recorded; `records` has those alone that stand.
//!
//! The system is F → F e F, e → nothing, for which both numbers are powers of 2.

use arrow_array::RecordBatch;
use arrow_array::cast::AsArray;
use arrow_array::types::{Int8Type, Int32Type};
use phytomer::outputs::Table;
use phytomer::run::{self, Progress};
use phytomer_config::validate_texts;
use std::collections::BTreeMap;

const SPECIES: &str = "name = \"fleeting\"\nmodel = \"lsystem\"\ntick = \"one rewriting\"\naxiom = \"F\"\n\
    production = { F = \"FeF\", e = \"\" }\nbranching_deg = 45\ncell = { F = { length_m = 1 }, e = { length_m = 0.5 } }\n";

/// The batches of a run that records the ages of a list.
fn grown(record: &str) -> BTreeMap<Table, Vec<RecordBatch>> {
    let scenario =
        format!("name = \"ledger\"\nspecies = \"fleeting\"\nplants = 1\nages = {{ until = 6, record = {record} }}\n");
    let texts = [("ledger", scenario.as_str()), ("fleeting", SPECIES)];
    let resolved = validate_texts("ledger", &texts).unwrap_or_else(|report| panic!("{}", report.render(false)));
    run::in_memory(&resolved, 1, &Progress::default()).unwrap().batches
}

/// A column of numbers, with `None` for null.
fn column(batches: &[RecordBatch], name: &str) -> Vec<Option<i32>> {
    let columns = batches.iter().map(|batch| batch.column_by_name(name).expect("a column").clone());
    let numbers = |array: arrow_array::ArrayRef| array.as_primitive::<Int32Type>().iter().collect::<Vec<_>>();
    columns.flat_map(numbers).collect()
}

/// A column of words.
fn words(batches: &[RecordBatch], name: &str) -> Vec<Option<String>> {
    let mut words = Vec::new();
    for batch in batches {
        let column = batch.column_by_name(name).expect("a column").as_dictionary::<Int8Type>();
        let (keys, list) = (column.keys(), column.values().as_string::<i32>());
        words.extend(keys.iter().map(|key| key.map(|key| list.value(key as usize).to_owned())));
    }
    words
}

#[test]
fn what_vanished_has_a_row_with_its_end() {
    let batches = grown("[3, 6]");
    let components = &batches[&Table::Components];
    let (birth, death) = (column(components, "birth_age"), column(components, "death_age"));
    let causes = words(components, "cause_of_death");
    // A bud, 2⁶ cells F, and 1 + 2 + … + 2⁵ cells e, of which those of the last tick still stand.
    assert_eq!(birth.len(), 1 + 64 + 63);
    let gone: Vec<usize> = (0..birth.len()).filter(|row| death[*row].is_some()).collect();
    assert_eq!(gone.len(), 31);
    for row in gone {
        assert_eq!(death[row], birth[row].map(|birth| birth + 1), "it stood for one tick");
        assert_eq!(causes[row].as_deref(), Some("rewritten"));
    }
    let numbers: Vec<Option<i32>> = (0..128).map(Some).collect();
    assert_eq!(column(components, "component_id"), numbers, "each number once, in order");
    let records = column(&batches[&Table::Records], "tick");
    let at = |tick| records.iter().filter(|found| **found == Some(tick)).count();
    assert_eq!((at(3), at(6), records.len()), (1 + 8 + 4, 1 + 64 + 32, 13 + 97), "what stands, and that alone");
}

#[test]
fn the_recorded_ages_do_not_change_what_is_told_of_a_component() {
    let (all, last) = (grown("\"all\""), grown("[6]"));
    assert_eq!(all[&Table::Components], last[&Table::Components]);
    assert_eq!(all[&Table::Events], last[&Table::Events]);
}
