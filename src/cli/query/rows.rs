//! `query` with its engine: the rows as a table, as JSON, or as a file.
//!
//! Absent: the engine (`phytomer_query`).

use super::super::{Misuse, Verdict, amounts, interrupt, out, terminal};
use super::{NamedRun, Query};
use anyhow::Result;
use phytomer_query::{Engine, Error, Format, Settings, Stop, Table, open};
use std::path::Path;

const FORMATS: [out::Format; 3] = [
    out::Format { name: "CSV", extension: "csv" },
    out::Format { name: "JSON", extension: "json" },
    out::Format { name: "Parquet", extension: "parquet" },
];

impl Query {
    /// Asks the runs and shows or writes the rows.
    pub(super) fn ask(&self, runs: &[NamedRun], sql: &str) -> Result<Verdict> {
        let target = self.target()?;
        let stop = Stop::default();
        let (asked, told) = (stop.clone(), stop.clone());
        interrupt::listen(move || asked.is_stopped(), move || told.stop(), "stopping")?;
        let engine = Engine::over(runs, &Settings { memory_bytes: self.memory, threads: self.threads.unwrap_or(0) });
        let done = engine.and_then(|engine| match target {
            Some((path, format)) => {
                let mut rows = open(path, format)?;
                let count = engine.query(sql, &stop, rows.as_mut())?;
                rows.finish().map(|()| (count, None))
            }
            None => {
                let mut table = Table::of(self.rows);
                let count = engine.query(sql, &stop, &mut table)?;
                table.text().map(|text| (count, Some(text)))
            }
        });
        match done {
            Ok((count, table)) => self.tell(count, table.map(|table| (table.text, table.left_out))),
            Err(Error::Interrupted) => {
                terminal::say("stopped before all rows were there");
                Ok(Verdict::Interrupted)
            }
            Err(error @ (Error::Sql(_) | Error::ReadOnly(_))) => {
                terminal::say(&format!("error: {error}"));
                Ok(Verdict::Invalid)
            }
            Err(error) => Err(error.into()),
        }
    }

    /// The file to write and its format; stdout for JSON; `None` for a table.
    fn target(&self) -> Result<Option<(&Path, Format)>> {
        if self.json {
            return Ok(Some((Path::new("-"), Format::Json)));
        }
        let Some(path) = self.out.as_deref() else { return Ok(None) };
        out::check(path, "query", &FORMATS)?;
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let format = match ending.as_deref() {
            Some("csv") => Format::Csv,
            Some("json") => Format::Json,
            Some("parquet") => Format::Parquet,
            _ => {
                let shown = path.display();
                return Err(Misuse(format!("--out {shown}: an ending is expected, .csv, .json or .parquet")).into());
            }
        };
        Ok(Some((path, format)))
    }

    fn tell(&self, count: u64, table: Option<(String, usize)>) -> Result<Verdict> {
        let rows = amounts::of(count, "row");
        match (&self.out, table) {
            (Some(path), _) => out::tell(path, &rows)?,
            (None, Some((text, left_out))) => {
                terminal::put(&text)?;
                terminal::say(&match left_out {
                    0 => rows,
                    _ => format!("{rows}, the first {} shown; --rows shows more, --out writes all", self.rows),
                });
            }
            (None, None) => {}
        }
        Ok(Verdict::Done)
    }
}
