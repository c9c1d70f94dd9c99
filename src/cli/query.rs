//! `query`: SQL over runs, and the views of runs for DuckDB.
//!
//! `--views` needs no SQL engine. The engine itself is DataFusion, with the feature `sql`; a program without it says
//! how to get it, and prints the line that asks the same of DuckDB. Absent: the views (`phytomer_outputs::views`) and
//! the engine (`phytomer_query`).

#[cfg(feature = "sql")]
mod rows;
#[cfg(not(feature = "sql"))]
mod without;

use super::named::{RUNS, run_folder};
use super::{Misuse, Verdict, terminal};
use anyhow::Result;
use clap::Args;
use phytomer_outputs::read::Run;
use phytomer_outputs::views::for_duckdb;
use phytomer_outputs::views_of_run::{duckdb_source, tables_of};
use std::path::{Path, PathBuf};

/// Ask runs by SQL: the tables of one run or several, with views and functions such as at_age(10).
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer query runs/coffee \"SELECT kind, count(*) AS n FROM at_age(12) GROUP BY kind ORDER BY n DESC\"
  phytomer query runs/coffee \"SELECT age, avg(height_m) AS m FROM summary GROUP BY age ORDER BY age\" --out height.csv
  phytomer query runs/coffee \"SELECT axis_order, event, count(*) FROM events GROUP BY axis_order, event\" --json
  phytomer query runs/coffee \"SELECT * FROM treatments_at(12)\" --out means.parquet --memory 500MB
  phytomer query runs/coffee \"SHOW TABLES\"
  phytomer query --views runs/coffee

Every row has the name of its run in the column `run`. Tables: components, records, records_world, events, summary,
plants, treatments, site. Functions: at_age(a), at_tick(t), orders_at(a), alive_at(a), axes(), fates(), sites(),
growth(), treatments_at(a), pairs_at(a), mechanics_at(a). `DESCRIBE records` tells the columns. docs/queries.md has more.

A query only reads, and reads nothing but the runs. --out writes by the ending of its name: .csv, .json, .parquet. Rows
of equal rank come in any order: say ORDER BY. SQL needs a program that was built with `--features sql`; any program
prints the views for DuckDB: `phytomer query --views runs/coffee > coffee.sql`, then `duckdb -init coffee.sql`. Exit code
3 where the SQL is wrong or would change something, 1 where a run cannot be read or the memory is too small.")]
pub struct Query {
    /// The runs, by path or by name below runs/, and then the SQL in one argument; with --views the runs alone.
    #[arg(required = true, num_args = 1.., value_name = "RUN… SQL")]
    words: Vec<String>,
    /// Print the views and macros of the runs for DuckDB, with whole paths.
    #[arg(long, conflicts_with_all = ["out", "json", "memory", "rows", "threads"])]
    views: bool,
    /// The file to write: .csv, .json or .parquet.
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    out: Option<PathBuf>,
    /// Write the rows as a JSON array on stdout.
    #[arg(long)]
    json: bool,
    /// The memory that sorting, joining and grouping may take before they write to the folder for temporary files.
    #[arg(long, value_name = "BYTES", default_value = "2GiB", value_parser = bytes)]
    memory: usize,
    /// Threads; as many as the machine has, at most 8, if not given. No row depends on it.
    #[arg(long, value_name = "N", value_parser = threads)]
    threads: Option<usize>,
    /// The most rows that a table on the terminal shows.
    #[arg(long, value_name = "N", default_value_t = 1000)]
    rows: usize,
}

impl Query {
    pub fn obey(mut self) -> Result<Verdict> {
        if self.views {
            terminal::put(views(&named(&self.words)?)?.trim_end())?;
            return Ok(Verdict::Done);
        }
        let sql = self.words.pop().unwrap_or_default();
        if self.words.is_empty() {
            let words = format!(
                "`{sql}` is given alone: expected runs and then SQL, as in `query runs/coffee \"SHOW TABLES\"`"
            );
            return Err(Misuse(words).into());
        }
        self.ask(&named(&self.words)?, &sql)
    }
}

/// A run with its name in the column `run`.
type NamedRun = (String, Run);

/// The runs of some words, each with the name of its folder; with the word itself where two folders have one name.
fn named(words: &[String]) -> Result<Vec<NamedRun>> {
    let mut runs: Vec<NamedRun> = Vec::new();
    for word in words {
        let below = Path::new(RUNS).join(word);
        let folder = run_folder(word).or_else(|| run_folder(&below.display().to_string())).ok_or_else(|| {
            Misuse(format!("there is no run `{word}`: a run folder or a run below {RUNS}/ is expected, and then SQL"))
        })?;
        let whole = std::path::absolute(&folder)?;
        let is_there =
            |(known, run): &NamedRun| known == word || std::path::absolute(run.path()).is_ok_and(|at| at == whole);
        if runs.iter().any(is_there) {
            return Err(Misuse(format!("the run `{word}` is named twice")).into());
        }
        let name = whole.file_name().unwrap_or_default().display().to_string();
        let name = if runs.iter().any(|(known, _)| *known == name) { word.clone() } else { name };
        runs.push((name, Run::open(&folder)?));
    }
    Ok(runs)
}

/// The views and macros of runs for DuckDB.
fn views(runs: &[NamedRun]) -> Result<String> {
    let mut tables = Vec::new();
    for (name, run) in runs {
        let folder = std::path::absolute(run.path())?;
        tables.push(tables_of(run, name, |table| duckdb_source(&folder, table))?);
    }
    Ok(for_duckdb("Paths are whole: `.read` it in any folder, or start `duckdb -init` with it.", &tables))
}

/// A number of threads.
fn threads(text: &str) -> Result<usize, String> {
    let expected = || format!("`{text}` is no number of threads; expected a whole number from 1 to 1024");
    text.parse().ok().filter(|threads| (1..=1024).contains(threads)).ok_or_else(expected)
}

/// A number of bytes as people write it: `500MB`, `2GiB`.
fn bytes(text: &str) -> Result<usize, String> {
    let expected = || format!("`{text}` is no number of bytes; expected one such as 500MB or 2GiB, at least 1MB");
    let digits = text.find(|character: char| !character.is_ascii_digit() && character != '.').unwrap_or(text.len());
    let number: f64 = text[..digits].parse().map_err(|_| expected())?;
    let unit = match text[digits..].trim().to_ascii_lowercase().as_str() {
        "kb" => 1e3,
        "mb" => 1e6,
        "gb" => 1e9,
        "kib" => 1024.0,
        "mib" => f64::from(1 << 20),
        "gib" => f64::from(1 << 30),
        _ => return Err(expected()),
    };
    let bytes = number * unit;
    if (1e6..1e15).contains(&bytes) { Ok(bytes as usize) } else { Err(expected()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_read_as_people_write_them() {
        assert_eq!(bytes("500MB"), Ok(500_000_000));
        assert_eq!(bytes("2GiB"), Ok(2 << 30));
        assert_eq!(bytes("1.5 mib"), Ok(3 << 19));
        for bad in ["", "2", "GiB", "-1GB", "1e9", "1.2.3MB", "2 parsecs", "1kB", "999999999999GB", "NaNMB", "∞GB"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }
}
