//! The rows that go to the executors and those that come back: one of each for a part.
//!
//! A part is named by its row alone, never by the number of a task or a partition, which change when tasks are given to
//! others. So a plan that made its own rows, and was then run whole by each task, would be noticed: every task must
//! find exactly one row, and every part must be answered exactly once ([`counted`]).

use super::fault::{Fault, Kind};
use arrow_array::cast::AsArray;
use arrow_array::types::UInt32Type;
use arrow_array::{ArrayRef, RecordBatch, StringArray, UInt32Array};
use arrow_schema::{ArrowError, DataType, Field, Schema, SchemaRef};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, LazyLock};

/// The columns of the rows that go out: the part, its first plot, and the plot after its last.
pub static ROWS: LazyLock<SchemaRef> = LazyLock::new(|| {
    let column = |name: &str| Field::new(name, DataType::UInt32, false);
    Arc::new(Schema::new(vec![column("shard"), column("lo"), column("hi")]))
});

/// The column of the rows that come back, with an [`Answer`] as JSON.
pub static ANSWERS: LazyLock<SchemaRef> =
    LazyLock::new(|| Arc::new(Schema::new(vec![Field::new("answer", DataType::Utf8, false)])));

/// A part as its row names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// The number of the part.
    pub shard: u32,
    /// Its plots.
    pub plots: Range<u32>,
}

impl Piece {
    /// Its row.
    ///
    /// # Errors
    /// None that Arrow could have with three columns of one row.
    pub fn row(&self) -> Result<RecordBatch, ArrowError> {
        let column = |value: u32| Arc::new(UInt32Array::from(vec![value])) as ArrayRef;
        let columns = [self.shard, self.plots.start, self.plots.end].map(column).to_vec();
        RecordBatch::try_new(Arc::clone(&ROWS), columns)
    }

    /// The one row of a task.
    ///
    /// # Errors
    /// [`Kind::WrongRow`] where there is none, or several, or where its columns are others.
    pub fn only(batches: &[RecordBatch]) -> Result<Self, Fault> {
        let rows: usize = batches.iter().map(RecordBatch::num_rows).sum();
        let Some(batch) = batches.iter().find(|batch| batch.num_rows() > 0).filter(|_| rows == 1) else {
            return Err(Fault::new(
                Kind::WrongRow,
                format!(
                    "a task has {rows} rows, and one row with its part is expected: the plan was not dealt out row by row"
                ),
            ));
        };
        let value = |name: &str| {
            let column = batch.column_by_name(name).and_then(|column| column.as_primitive_opt::<UInt32Type>());
            column.map(|column| column.value(0)).ok_or_else(|| {
                Fault::new(Kind::WrongRow, format!("the row of a task has no column `{name}` of whole numbers"))
            })
        };
        Ok(Self { shard: value("shard")?, plots: value("lo")?..value("hi")? })
    }
}

/// What an executor answers for a part.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Answer {
    /// The part; `None` where its row could not be understood.
    pub shard: Option<u32>,
    /// The name of the executor.
    pub executor: String,
    /// What came of it.
    pub outcome: Result<Grown, Fault>,
}

/// A part that is in its folder.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Grown {
    /// Whether it was grown by this task; else it was there already.
    pub now: bool,
    /// The rows of each of its tables, by the table's name.
    pub rows: BTreeMap<String, u64>,
    /// The size of its files, bytes.
    pub bytes: u64,
}

impl Answer {
    /// Its row.
    ///
    /// # Errors
    /// None that Arrow could have with one text.
    pub fn row(&self) -> Result<RecordBatch, ArrowError> {
        let text = serde_json::to_string(self).map_err(|error| ArrowError::JsonError(error.to_string()))?;
        RecordBatch::try_new(Arc::clone(&ANSWERS), vec![Arc::new(StringArray::from(vec![text]))])
    }

    /// The answers of some rows.
    ///
    /// # Errors
    /// Where a row is no answer.
    pub fn all(batch: &RecordBatch) -> Result<Vec<Self>, ArrowError> {
        let column = batch.column_by_name("answer").and_then(|column| column.as_string_opt::<i32>());
        let texts = column.ok_or_else(|| ArrowError::SchemaError("a row without an answer".to_owned()))?;
        let read = |text: &str| serde_json::from_str(text).map_err(|error| ArrowError::JsonError(error.to_string()));
        texts.iter().flatten().map(read).collect()
    }
}

/// Whether each part that was asked for is answered once, and no other.
///
/// # Errors
/// [`Kind::WrongRow`] with the parts that are missing, answered several times, or were not asked for.
pub fn counted(asked: &[Piece], answers: &[Answer]) -> Result<(), Fault> {
    let mut times: BTreeMap<u32, usize> = asked.iter().map(|piece| (piece.shard, 0)).collect();
    let mut foreign = Vec::new();
    for shard in answers.iter().filter_map(|answer| answer.shard) {
        match times.get_mut(&shard) {
            Some(times) => *times += 1,
            None => foreign.push(shard),
        }
    }
    let with = |wrong: &dyn Fn(usize) -> bool| -> Vec<u32> {
        times.iter().filter(|(_, times)| wrong(**times)).map(|(shard, _)| *shard).collect()
    };
    let (missing, several) = (with(&|times| times == 0), with(&|times| times > 1));
    let unnamed = answers.iter().any(|answer| answer.shard.is_none());
    // A task that could not read its row has told so, and the part is missing for this reason.
    if several.is_empty() && foreign.is_empty() && (missing.is_empty() || unnamed) {
        return Ok(());
    }
    let listed = |what: &str, parts: Vec<u32>| {
        let numbers: Vec<String> = parts.iter().take(10).map(u32::to_string).collect();
        let more = if parts.len() > 10 { ", …" } else { "" };
        (!parts.is_empty()).then(|| format!("{what}: {}{more}", numbers.join(", ")))
    };
    let told =
        [listed("not answered", missing), listed("answered several times", several), listed("not asked for", foreign)];
    let told: Vec<String> = told.into_iter().flatten().collect();
    Err(Fault::new(
        Kind::WrongRow,
        format!("{} parts were asked for and {} answers came; {}", asked.len(), answers.len(), told.join("; ")),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(shard: u32) -> Piece {
        Piece { shard, plots: 3 * shard..3 * shard + 3 }
    }

    fn answer(shard: u32) -> Answer {
        let rows = BTreeMap::from([("summary".to_owned(), 7)]);
        Answer { shard: Some(shard), executor: "a".to_owned(), outcome: Ok(Grown { now: true, rows, bytes: 1 << 40 }) }
    }

    #[test]
    fn rows_are_read_as_they_were_written() {
        let row = piece(4).row().unwrap();
        assert_eq!(Piece::only(&[row.slice(0, 0), row.clone()]).unwrap(), piece(4));
        let fault = Answer { outcome: Err(Fault::new(Kind::FullDisk, "full")), shard: None, ..answer(0) };
        for answer in [answer(7), fault] {
            assert_eq!(Answer::all(&answer.row().unwrap()).unwrap(), [answer]);
        }
    }

    #[test]
    fn a_task_has_one_row() {
        let [a, b] = [4, 5].map(|shard| piece(shard).row().unwrap());
        for (rows, told) in [(vec![], "0 rows"), (vec![a.clone(), b], "2 rows"), (vec![a.slice(0, 0)], "0 rows")] {
            let fault = Piece::only(&rows).unwrap_err();
            assert_eq!(fault.kind, Kind::WrongRow);
            assert!(fault.text.contains(told), "{fault}");
        }
        let foreign = answer(1).row().unwrap();
        assert!(Piece::only(&[foreign]).unwrap_err().text.contains("no column `shard`"));
    }

    #[test]
    fn each_part_is_answered_once() {
        let asked = [1, 2, 3].map(piece);
        assert!(counted(&asked, &[answer(3), answer(1), answer(2)]).is_ok());
        for (answers, told) in [
            (vec![answer(1), answer(2)], "not answered: 3"),
            (vec![answer(1), answer(2), answer(3), answer(2)], "answered several times: 2"),
            (vec![answer(1), answer(2), answer(3), answer(9)], "not asked for: 9"),
            (vec![], "not answered: 1, 2, 3"),
        ] {
            let fault = counted(&asked, &answers).unwrap_err();
            assert!(fault.text.contains(told) && fault.kind == Kind::WrongRow, "{fault}");
        }
        // Every task of a plan that makes its own rows would have all of them.
        let thrice: Vec<Answer> = [1, 2, 3].repeat(3).into_iter().map(answer).collect();
        assert!(counted(&asked, &thrice).unwrap_err().text.contains("3 parts were asked for and 9 answers came"));
    }
}
