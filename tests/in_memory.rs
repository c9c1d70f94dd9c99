//! A run in memory against the same run in files: the same rows and the same schema, batch against batch.
//!
//! The files are read back by the Parquet reader, which does not share code with the batches in memory.

use arrow_array::RecordBatch;
use phytomer::outputs::Table;
use phytomer::outputs::read::Run;
use phytomer::run::{self, Progress, RunError, Settings};
use phytomer_config::{Resolved, validate_texts};
use std::collections::{BTreeMap, VecDeque};

/// Seven plants of a preset in parts of two, so that several parts are joined.
fn scenario(species: &str, more: &str) -> Resolved {
    let text = format!(
        "name = \"trial\"\nspecies = \"{species}\"\nplants = 7\nseed = 3\nspacing_m = 2\n\
         ages = {{ until = 14, record = [3, 9, 14] }}\n{more}"
    );
    validate_texts("trial", &[("trial", &text)]).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

/// Compares two lists of batches, however each is cut.
fn assert_same_rows(table: Table, memory: &[RecordBatch], files: &[RecordBatch]) -> usize {
    let rows = |batches: &[RecordBatch]| batches.iter().map(RecordBatch::num_rows).sum::<usize>();
    assert_eq!(rows(memory), rows(files), "rows of {}", table.name());
    let mut left: VecDeque<RecordBatch> = files.iter().cloned().collect();
    for batch in memory {
        let mut start = 0;
        while start < batch.num_rows() {
            let read = left.pop_front().expect("as many rows");
            let both = read.num_rows().min(batch.num_rows() - start);
            let (mine, theirs) = (batch.slice(start, both), read.slice(0, both));
            assert_eq!(mine.schema().fields(), theirs.schema().fields(), "schema of {}", table.name());
            for (place, field) in mine.schema().fields().iter().enumerate() {
                assert_eq!(mine.column(place), theirs.column(place), "{}.{}", table.name(), field.name());
            }
            if both < read.num_rows() {
                left.push_front(read.slice(both, read.num_rows() - both));
            }
            start += both;
        }
    }
    rows(memory)
}

#[test]
fn batches_in_memory_are_those_of_the_files() {
    let home = tempfile::tempdir().unwrap();
    let rounded = "output = { plants_per_part = 2, float_precision_m = 1e-4 }\n";
    let bending = "output = { plants_per_part = 3, mechanics = true }\n";
    for (number, (species, more)) in [("coffee", rounded), ("willow", bending), ("gmt1/5b", "")].into_iter().enumerate()
    {
        let resolved = scenario(species, more);
        let folder = home.path().join(number.to_string());
        run::run(&resolved, &Settings::in_folder(&folder), &Progress::default()).unwrap();
        let files = Run::open(&folder).unwrap();
        for threads in [1, 3] {
            let memory = run::in_memory(&resolved, threads, &Progress::default()).unwrap();
            assert_eq!(memory.batches.len(), Table::ALL.len());
            for table in Table::ALL {
                let read: Vec<RecordBatch> = files.batches(table).unwrap().map(Result::unwrap).collect();
                let rows = assert_same_rows(table, &memory.batches[&table], &read);
                assert!(rows > 0 || table == Table::Events, "{species}: no rows of {}", table.name());
                // The reader of a file leaves the metadata of the file out of its batches; the file has them.
                let mut metadata = files.metadata(table).unwrap();
                metadata.retain(|key, _| key.starts_with("phytomer."));
                for batch in &memory.batches[&table] {
                    let kept: BTreeMap<String, String> = batch.schema().metadata().clone().into_iter().collect();
                    assert_eq!(kept, metadata, "metadata of {}", table.name());
                }
            }
            assert!(memory.overgrown.is_empty());
        }
    }
}

#[test]
fn a_plant_that_outgrows_its_limit_is_told() {
    let home = tempfile::tempdir().unwrap();
    let mut resolved = scenario("coffee", "");
    resolved.scenario.limits.max_components = 60;
    let folder = home.path().join("run");
    let written = run::run(&resolved, &Settings::in_folder(&folder), &Progress::default()).unwrap().report;
    let memory = run::in_memory(&resolved, 2, &Progress::default()).unwrap();
    assert!(!memory.overgrown.is_empty());
    assert_eq!(memory.overgrown, written.overgrown);
}

#[test]
fn a_run_in_memory_can_be_stopped() {
    let progress = Progress::default();
    progress.stop();
    let stopped = run::in_memory(&scenario("coffee", ""), 1, &progress);
    assert!(matches!(stopped, Err(RunError::Stopped)));
}
