//! Types, encodings and metadata as stated; order, nulls and counts of the rows; rounding.
//!
//! The rows are those of the crate's specimen plant, whose life is known tick by tick.

use super::schema::{Encoding, Type};
use super::*;
use crate::read::Run;
use crate::specimen::{plan, run};
use ::arrow_array::types::Int8Type;
use ::arrow_array::{Array, BooleanArray, DictionaryArray, Float32Array, Int32Array, RecordBatch, StringArray};
use parquet::basic::{Compression, Encoding as ParquetEncoding};
use std::collections::BTreeMap;
use tempfile::{TempDir, tempdir};

fn specimen() -> (TempDir, Run) {
    let home = tempdir().unwrap();
    run(home.path(), plan(5, 2));
    let run = Run::open(home.path()).unwrap();
    (home, run)
}

fn batches(run: &Run, table: Table) -> Vec<RecordBatch> {
    run.batches(table).unwrap().map(Result::unwrap).collect()
}

/// A column of integers over all parts; null as −1.
fn ints(run: &Run, table: Table, column: &str) -> Vec<i32> {
    let all = batches(run, table);
    let arrays = all.iter().map(|batch| batch.column_by_name(column).unwrap().clone());
    arrays
        .flat_map(|a| a.as_any().downcast_ref::<Int32Array>().unwrap().iter().collect::<Vec<_>>())
        .map(|v| v.unwrap_or(-1))
        .collect()
}

/// A column of words over all parts; null as the empty word.
fn words(run: &Run, table: Table, column: &str) -> Vec<String> {
    let mut all = Vec::new();
    for batch in batches(run, table) {
        let array =
            batch.column_by_name(column).unwrap().as_any().downcast_ref::<DictionaryArray<Int8Type>>().unwrap().clone();
        let typed = array.downcast_dict::<StringArray>().unwrap();
        all.extend(typed.into_iter().map(|word| word.unwrap_or_default().to_owned()));
    }
    all
}

fn floats(run: &Run, column: &str) -> Vec<Option<f32>> {
    let all = batches(run, Table::Records);
    let arrays = all.iter().map(|batch| batch.column_by_name(column).unwrap().clone());
    arrays.flat_map(|a| a.as_any().downcast_ref::<Float32Array>().unwrap().iter().collect::<Vec<_>>()).collect()
}

#[test]
fn files_have_the_stated_types_encodings_and_metadata() {
    let (_home, run) = specimen();
    for table in Table::ALL {
        let (read, stated) = (run.schema(table).unwrap().unwrap(), arrow::schema(table.columns(false)));
        for (read, stated) in read.fields().iter().zip(stated.fields()) {
            assert_eq!((read.name(), read.data_type()), (stated.name(), stated.data_type()));
            assert_eq!((read.is_nullable(), read.metadata()), (stated.is_nullable(), stated.metadata()));
        }
        for part in run.parquet(table).unwrap() {
            assert_eq!(part.file_metadata().created_by(), Some("phytomer version 0.0.0"));
            check_encodings(table, &part);
        }
    }
    let metadata = run.metadata(Table::Records).unwrap();
    assert_eq!(metadata["phytomer.seed"], "42");
    assert_eq!(metadata["phytomer.scenario"], "Sapling");
    assert!(metadata["phytomer.plant_ontology"].contains("\"leaf\":\"PO:0025034\""));
}

fn check_encodings(table: Table, part: &parquet::file::metadata::ParquetMetaData) {
    for (place, column) in table.columns(false).iter().enumerate() {
        let chunk = part.row_group(0).column(place);
        assert!(matches!(chunk.compression(), Compression::ZSTD(_)));
        let encodings: Vec<_> = chunk.encodings().collect();
        let expected = match column.encoding {
            Encoding::Plain => ParquetEncoding::PLAIN,
            Encoding::Delta => ParquetEncoding::DELTA_BINARY_PACKED,
            Encoding::Dictionary | Encoding::Repeated => ParquetEncoding::RLE_DICTIONARY,
            Encoding::Split => ParquetEncoding::BYTE_STREAM_SPLIT,
        };
        let is_dictionary = matches!(column.encoding, Encoding::Dictionary | Encoding::Repeated);
        assert!(encodings.contains(&expected), "{table:?} {}: {encodings:?}", column.name);
        assert_eq!(chunk.dictionary_page_offset().is_some(), is_dictionary, "{}", column.name);
    }
}

#[test]
fn columns_are_declared_soundly() {
    for table in Table::ALL {
        for column in table.columns(true) {
            let ends = [("_per_m", "1/m"), ("_N_m", "N m"), ("_m", "m"), ("_m2", "m2"), ("_m3", "m3"), ("_kg", "kg")];
            let expected =
                ends.iter().find(|(end, _)| column.name.ends_with(end)).map_or(column.unit, |(_, unit)| unit);
            assert_eq!(column.unit, expected, "{}", column.name);
            assert!(column.description.ends_with('.') && !column.description.contains("  "), "{}", column.name);
            assert!(!matches!(column.holds, Type::Key) || !column.nullable);
            assert_eq!(column.nullable, column.description.contains("Null"), "{}", column.name);
        }
        for name in table.sorted_by() {
            assert!(table.columns(false).iter().any(|column| column.name == *name));
        }
    }
}

#[test]
fn rows_are_sorted_and_never_repeated() {
    let (_home, run) = specimen();
    for (table, keys) in [
        (Table::Records, &["plot_id", "tick", "plant_id", "component_id"][..]),
        (Table::Components, &["plot_id", "plant_id", "component_id"]),
        (Table::Summary, &["plot_id", "tick", "plant_id"]),
        (Table::Plants, &["plot_id", "plant_id"]),
    ] {
        let columns: Vec<_> = keys.iter().map(|key| ints(&run, table, key)).collect();
        let rows: Vec<Vec<i32>> = (0..columns[0].len()).map(|row| columns.iter().map(|c| c[row]).collect()).collect();
        assert!(rows.is_sorted_by(|a, b| a < b), "{table:?}");
        assert!(rows.len() >= 5);
    }
    let keys = ["plot_id", "tick", "plant_id", "component_id"].map(|key| ints(&run, Table::Events, key));
    assert!((1..keys[0].len()).all(|row| keys.each_ref().map(|k| k[row - 1]) <= keys.each_ref().map(|k| k[row])));
    // Plants that are sown at tick 0 have the ages of their plots.
    for table in [Table::Records, Table::Events, Table::Summary] {
        assert_eq!(ints(&run, table, "tick"), ints(&run, table, "age"), "{table:?}");
    }
}

#[test]
fn a_row_for_each_component_that_stands() {
    let (_home, run) = specimen();
    let counted = counts_of_records(&run);
    let rows = run.summary().unwrap();
    assert_eq!(rows.len(), 5 * 6);
    for row in rows {
        let count = |kind: &str, alive| {
            counted.get(&(row.plant_id as i32, row.age as i32, kind.to_owned(), alive)).copied().unwrap_or(0)
        };
        let internodes = |alive| count("internode", alive) + count("short_internode", alive);
        assert_eq!((row.internodes, row.dead_internodes), (internodes(true), internodes(false)));
        assert_eq!((row.leaves, row.flowers, row.fruits), (count("leaf", true), count("flower", true), 0));
        assert_eq!(row.buds, count("apical_bud", true));
        assert_eq!(row.alive, row.age < 10);
        assert_eq!(row.death_age, (row.age >= 10).then_some(10));
    }
}

fn counts_of_records(run: &Run) -> BTreeMap<(i32, i32, String, bool), u32> {
    let (plants, ages) = (ints(run, Table::Records, "plant_id"), ints(run, Table::Records, "age"));
    let kinds = words(run, Table::Records, "kind");
    let alive: Vec<bool> = batches(run, Table::Records)
        .iter()
        .flat_map(|b| {
            b.column_by_name("alive")
                .unwrap()
                .as_any()
                .downcast_ref::<BooleanArray>()
                .unwrap()
                .iter()
                .collect::<Vec<_>>()
        })
        .map(Option::unwrap)
        .collect();
    let mut counted = BTreeMap::new();
    for row in 0..plants.len() {
        *counted.entry((plants[row], ages[row], kinds[row].clone(), alive[row])).or_default() += 1;
    }
    counted
}

/// The branch that the trunk bears at tick 1 grows at ticks 2 and 3, dies at 4 and falls at 6: dead at 4, gone at 7.
#[test]
fn dead_wood_stands_until_it_falls() {
    let (_home, run) = specimen();
    let rows = run.summary().unwrap();
    let at = |age| rows.iter().find(|row| row.plant_id == 0 && row.age == age).unwrap().clone();
    assert_eq!((at(1).internodes, at(1).buds, at(1).dead_internodes, at(1).axes), (1, 2, 0, 2));
    assert_eq!((at(4).dead_internodes, at(4).internodes), (2, 4 + 3));
    assert_eq!((at(7).dead_internodes, at(7).flowers), (4, 0));
    assert!(at(4).wood_volume_m3 > 0.0 && (at(4).height_m.unwrap() - 0.4).abs() < 1e-6);
    assert!(!at(10).alive && at(10).height_m.is_none() && at(10).dead_internodes == 7 + 2 * 2);
    assert!((at(1).leaf_area_m2 - 0.0016).abs() < 1e-9);
}

#[test]
fn null_means_does_not_apply() {
    let (_home, run) = specimen();
    let kinds = words(&run, Table::Records, "kind");
    let rules: [(&str, &[&str]); 4] = [
        ("length_m", &["apical_bud"]),
        ("diameter_m", &["apical_bud"]),
        ("diameter_tip_m", &["apical_bud", "leaf", "flower"]),
        ("area_m2", &["apical_bud", "flower", "internode", "short_internode"]),
    ];
    for (column, null) in rules {
        for (value, kind) in floats(&run, column).iter().zip(&kinds) {
            assert_eq!(value.is_none(), null.contains(&kind.as_str()), "{column} of a {kind}");
            assert!(value.is_none_or(f32::is_finite));
        }
    }
    let parents = ints(&run, Table::Records, "parent_id");
    let components = ints(&run, Table::Records, "component_id");
    assert!(parents.iter().zip(&components).all(|(parent, component)| parent < component));
    assert!(parents.iter().zip(&components).all(|(parent, component)| (*parent < 0) == (*component <= 1)));
}

#[test]
fn components_tell_the_fates_that_are_over() {
    let (_home, run) = specimen();
    let kinds = words(&run, Table::Components, "kind");
    let deaths = ints(&run, Table::Components, "death_age");
    let sheds = ints(&run, Table::Components, "shed_age");
    let causes = words(&run, Table::Components, "cause_of_death");
    let axes = ints(&run, Table::Components, "axis_id");
    let (components, births) =
        (ints(&run, Table::Components, "component_id"), ints(&run, Table::Components, "birth_age"));
    let row = (0..kinds.len()).find(|&row| kinds[row] == "apical_bud" && births[row] == 1).unwrap();
    // A dead bud has no row in `records`, though the branch that it has made still stands.
    assert_eq!((deaths[row], sheds[row], causes[row].as_str(), axes[row]), (4, 4, "mortality", components[row]));
    let row = (0..kinds.len()).find(|&row| kinds[row] == "short_internode").unwrap();
    assert_eq!((births[row], deaths[row], sheds[row], causes[row].as_str()), (2, 4, 6, "branch"));
    let trunk = (0..kinds.len()).find(|&row| kinds[row] == "internode").unwrap();
    assert_eq!((deaths[trunk], sheds[trunk]), (10, -1));
    assert!(causes.iter().zip(&deaths).all(|(cause, death)| cause.is_empty() == (*death < 0)));
    assert_eq!(words(&run, Table::Events, "event").iter().filter(|event| *event == "shed").count(), 5 * 7);
}

#[test]
fn positions_are_rounded_to_the_stated_precision() {
    let (_home, exact) = specimen();
    let home = tempdir().unwrap();
    let mut rounded = plan(5, 2);
    rounded.precision_m = Some(1e-4);
    run(home.path(), rounded);
    let rounded = Run::open(home.path()).unwrap();
    for (column, step) in [("x_m", 1.0 / 16384.0), ("dir_x", 1.0 / 4096.0), ("up_z", 1.0 / 4096.0)] {
        for (a, b) in floats(&exact, column).into_iter().zip(floats(&rounded, column)) {
            let (a, b) = (a.unwrap(), b.unwrap());
            assert!((a - b).abs() <= step / 2.0);
            assert_eq!((b / step).fract(), 0.0);
        }
    }
    assert_eq!(floats(&exact, "diameter_m"), floats(&rounded, "diameter_m"));
}

/// A trunk of seven internodes is cut above the third at tick 7. Before, ten of its plant's internodes live, and four
/// are of dead branches that still stand; after, no bud lives, and the trunk's three stand with the two of the branch
/// on the third, for the branches below have fallen.
#[test]
fn what_is_cut_off_is_counted_no_more() {
    let mut plot = crate::specimen::plot(0, 1000);
    plot.grow_to(7).unwrap();
    plot.stand(7);
    let plant = &mut plot.plants[0];
    let counts = |plant: &phytomer_sim::Plant| {
        let summary = Summary::of(plant, 7).unwrap();
        (summary.internodes, summary.dead_internodes, summary.leaves > 0)
    };
    assert_eq!(counts(plant), (10, 4, true));
    plant.cut(phytomer_sim::plant::AxisId::TRUNK, 3, 7);
    phytomer_sim::shed::shed(plant);
    assert_eq!(counts(plant), (0, 5, false));
}
