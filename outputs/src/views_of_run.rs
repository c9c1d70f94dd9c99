//! The views of run folders: which tables a folder has, where their files are, and what their rows tell in years.
//!
//! All is read from the footers of the part files, so it holds for runs in progress and for runs of older programs,
//! whose files state no year. Absent: the bodies of the views (`views`).

use crate::read::Run;
use crate::run_folder::Error;
use crate::tables::Table;
use crate::views::{Tables, Year, quoted};
use std::path::Path;

/// The tables of a run folder that have a part file. `name` is the value of the column `run`, and `source` makes what
/// stands for a table after `FROM`.
///
/// # Errors
/// Where a part cannot be read.
pub fn tables_of(run: &Run, name: &str, mut source: impl FnMut(Table) -> String) -> Result<Tables, Error> {
    let mut sources = Vec::new();
    let (mut mechanics, mut year) = (false, Year::NotStated);
    for table in Table::ALL {
        let Some(schema) = run.schema(table)? else { continue };
        mechanics |= table == Table::Records && schema.field_with_name("fresh_mass_kg").is_ok();
        if sources.is_empty() {
            let stated = run.metadata(table)?.remove("phytomer.ticks_per_year");
            let ticks: Option<Vec<Option<f64>>> = stated.and_then(|text| serde_json::from_str(&text).ok());
            year = Year::of(&ticks.unwrap_or_default());
        }
        sources.push((table, source(table)));
    }
    Ok(Tables { run: Some(name.to_owned()), sources, mechanics, year })
}

/// What stands for a table of a run folder after `FROM` in DuckDB, by its path.
pub fn duckdb_source(folder: &Path, table: Table) -> String {
    let escaped = |text: &str| text.replace('[', "[[]").replace('*', "[*]").replace('?', "[?]");
    let folder = escaped(&folder.join(table.name()).display().to_string());
    format!("read_parquet({})", quoted(&format!("{folder}/part-*.parquet")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::specimen::{plan, run};

    #[test]
    fn a_path_is_quoted_and_names_no_other_file() {
        let source = duckdb_source(Path::new("/a/it's [1]"), Table::Site);
        assert_eq!(source, "read_parquet('/a/it''s [[]1]/site/part-*.parquet')");
    }

    #[test]
    fn a_folder_tells_its_tables_and_its_year() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run");
        run(&path, plan(2, 1));
        let tables = tables_of(&Run::open(&path).unwrap(), "sapling", |table| table.name().to_owned()).unwrap();
        assert_eq!(tables.sources.len(), Table::ALL.len());
        assert_eq!((tables.mechanics, tables.year), (false, Year::Of(4.0)));
    }
}
