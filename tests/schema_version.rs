//! The policy of `docs/schema-version.md`: no column of a table goes or changes unless `SCHEMA_VERSION` is raised.
//!
//! `tests/data/columns.txt` has the columns of the version that it names. A new column is added to it by
//! `UPDATE_EXPECTED=1`, which takes a line out only where the version is another. Absent: what columns mean, which the
//! policy asks of those who change it.

use phytomer::outputs::Table;
use phytomer::outputs::tables::columns::{PLANTS, SCHEMA_VERSION};
use phytomer::outputs::tables::schema::{Column, Type};
use std::fs;
use std::path::Path;

const LIST: &str = "tests/data/columns.txt";
const POLICY: &str = "docs/schema-version.md";

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A column in a line: table, name, type, whether it may be null, unit.
fn line(table: Table, column: &Column) -> String {
    let holds = match column.holds {
        Type::Word(_) => "word".to_owned(),
        Type::Name(_) => "name".to_owned(),
        other => format!("{other:?}").to_lowercase(),
    };
    let null = if column.nullable { "nullable" } else { "never null" };
    format!(
        "{}.{}: {holds}, {null}, {}",
        table.name(),
        column.name,
        if column.unit.is_empty() { "no unit" } else { column.unit }
    )
}

/// The columns of all tables, with those that only some runs have, and the order of their rows.
fn lines() -> Vec<String> {
    let of = |table: Table| {
        let columns = if table == Table::Plants { &PLANTS[..] } else { table.columns_in_light() };
        let sorted = format!("{}: sorted by {}", table.name(), table.sorted_by().join(", "));
        columns.iter().map(move |column| line(table, column)).chain([sorted])
    };
    Table::ALL.into_iter().flat_map(of).collect()
}

#[test]
fn no_column_goes_or_changes_without_another_version() {
    let (now, path) = (lines(), Path::new(env!("CARGO_MANIFEST_DIR")).join(LIST));
    let listed = fs::read_to_string(&path).unwrap_or_default();
    let (version, listed) = listed.split_once('\n').unwrap_or_default();
    let listed: Vec<&str> = listed.lines().collect();
    let gone: Vec<_> = listed.iter().filter(|line| !now.iter().any(|now| now == *line)).collect();
    let is_same = version == format!("schema_version {SCHEMA_VERSION}");
    assert!(!is_same || gone.is_empty(), "SCHEMA_VERSION is still {SCHEMA_VERSION}, and these are gone: {gone:#?}");
    if std::env::var_os("UPDATE_EXPECTED").is_some() {
        fs::write(&path, format!("schema_version {SCHEMA_VERSION}\n{}\n", now.join("\n"))).expect("a list");
        return;
    }
    assert!(is_same, "{LIST} is of {version}; UPDATE_EXPECTED=1 makes it of {SCHEMA_VERSION}");
    let new: Vec<_> = now.iter().filter(|line| !listed.contains(&line.as_str())).collect();
    assert!(new.is_empty(), "{LIST} lacks these; UPDATE_EXPECTED=1 adds them: {new:#?}");
}

/// The page tells every version up to this one, each with what came with it.
#[test]
fn the_policy_tells_what_each_version_changed() {
    let page = read(POLICY);
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| `schema_version` ")).collect();
    let number: usize = SCHEMA_VERSION.parse().expect("a whole number");
    let told = |version: usize| rows.iter().any(|row| row.starts_with(&format!("| `schema_version` {version} |")));
    assert!((1..=number).all(told) && rows.len() == number, "{POLICY} has {rows:#?}");
}
