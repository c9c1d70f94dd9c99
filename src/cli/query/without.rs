//! `query` of a program without an SQL engine: how to get one, and the line that asks DuckDB.
//!
//! Absent: the engine, which a program with the feature `sql` has.

use super::super::{Verdict, terminal};
use super::{NamedRun, Query};
use anyhow::Result;

impl Query {
    /// Says how the question can be asked; the line for DuckDB goes to stdout.
    pub(super) fn ask(&self, runs: &[NamedRun], sql: &str) -> Result<Verdict> {
        terminal::say(
            "error: this program was built without SQL. `cargo install --path . --features sql` builds one with it, in many \
             minutes. DuckDB (duckdb.org) reads the same views and answers now:",
        );
        let folders: Vec<String> = runs.iter().map(|(_, run)| in_shell(&run.path().display().to_string())).collect();
        let format = match self.out.as_ref().and_then(|path| path.extension()) {
            Some(ending) if ending.eq_ignore_ascii_case("csv") => "-csv ",
            _ if self.json || self.out.is_some() => "-json ",
            _ => "",
        };
        terminal::put(&format!(
            "phytomer query --views {} > views.sql && duckdb {format}-init views.sql -c {}",
            folders.join(" "),
            in_shell(sql)
        ))?;
        // What only the engine reads.
        let _ = (self.memory, self.rows);
        Ok(Verdict::Usage)
    }
}

/// A word as a shell of Unix reads it as one.
fn in_shell(word: &str) -> String {
    let plain = |character: char| character.is_ascii_alphanumeric() || "/._-".contains(character);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_stays_one_word_in_a_shell() {
        assert_eq!(in_shell("runs/coffee"), "runs/coffee");
        assert_eq!(in_shell("SELECT 'a' FROM t"), "'SELECT '\\''a'\\'' FROM t'");
        assert_eq!(in_shell(""), "''");
    }
}
