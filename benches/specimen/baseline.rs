//! Baselines: the same bytes and the same batches, written without any code of this project.
//!
//! The parquet crate gets ready batches, the same settings and the same threads; a mesh's baseline is a write of its
//! bytes in blocks. The columns of a plant are in `columns`.

use arrow_array::{Array, RecordBatch};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::{ArrowColumnChunk, ArrowColumnWriter, compute_leaves};
use phytomer::outputs::read::Run;
use phytomer::outputs::tables::{ROW_GROUP, arrow};
use phytomer::outputs::{RunPlan, Table};
use rayon::prelude::*;
use std::fs::File;
use std::hint::black_box;
use std::io::Write;
use std::path::Path;

/// The block of a plain bulk write.
const BLOCK: usize = 1 << 20;

/// Writes bytes to a new file, block by block.
pub fn write_blocks(path: &Path, bytes: &[u8]) {
    let mut file = File::create(path).expect("a file");
    for block in bytes.chunks(BLOCK) {
        file.write_all(block).expect("a write");
    }
}

/// Writes the given number of bytes into a chunk that is filled again and again, from another chunk.
pub fn write_chunks(ready: &[u8], chunk: &mut [u8], mut bytes: usize) {
    while bytes > 0 {
        let block = bytes.min(chunk.len());
        chunk[..block].copy_from_slice(&black_box(ready)[..block]);
        black_box(&mut *chunk);
        bytes -= block;
    }
}

/// The batches of every table of a run, in memory.
pub struct Ready {
    tables: Vec<(Table, RunPlan, Vec<RecordBatch>)>,
}

/// Reads every table of a run back into batches of one row group.
pub fn ready_batches(run: &Path, plan: &RunPlan) -> Ready {
    let run = Run::open(run).expect("a run");
    let read = |table: Table| {
        let batches = run.batches_of(table, ROW_GROUP).expect("batches");
        (table, plan.clone(), batches.collect::<Result<Vec<_>, _>>().expect("batches"))
    };
    Ready { tables: plan.tables.iter().copied().map(read).collect() }
}

impl Ready {
    /// Writes each table as one file by the parquet crate, its columns on all threads.
    pub fn write(&self, folder: &Path) {
        for (table, plan, batches) in self.tables.iter().filter(|(_, _, batches)| !batches.is_empty()) {
            write_table(&folder.join(table.name()), *table, plan, batches);
        }
    }

    /// Copies every column into fresh memory.
    pub fn copy(&self) {
        for batch in self.tables.iter().flat_map(|(_, _, batches)| batches) {
            for column in batch.columns() {
                for buffer in column.to_data().buffers() {
                    black_box(buffer.as_slice().to_vec());
                }
            }
        }
    }
}

fn write_table(path: &Path, table: Table, plan: &RunPlan, batches: &[RecordBatch]) {
    let properties = arrow::properties(table, plan).expect("settings");
    let file = File::create(path).expect("a file");
    let writer = ArrowWriter::try_new(file, batches[0].schema(), Some(properties)).expect("a writer");
    let (mut file, factory) = writer.into_serialized_writer().expect("a writer");
    for (number, batch) in batches.iter().enumerate() {
        let columns = factory.create_column_writers(number).expect("column writers");
        let encoded = columns.into_par_iter().enumerate().map(|(place, writer)| encode(writer, batch, place));
        let mut group = file.next_row_group().expect("a row group");
        for chunk in encoded.collect::<Vec<_>>() {
            chunk.append_to_row_group(&mut group).expect("a write");
        }
        group.close().expect("a row group");
    }
    file.into_inner().expect("a file").sync_all().expect("a sync");
}

fn encode(mut writer: ArrowColumnWriter, batch: &RecordBatch, place: usize) -> ArrowColumnChunk {
    for leaf in compute_leaves(batch.schema().field(place), batch.column(place)).expect("leaves") {
        writer.write(&leaf).expect("a column");
    }
    writer.close().expect("a chunk")
}
