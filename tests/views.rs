//! `phytomer query --views` of one run and of two, and what `query` says where the program has no SQL engine.
//!
//! DuckDB of `.venv` reads the views from another folder, so that their paths must be whole; where it is missing the
//! test skips and says so, but never in CI. Absent: the engine (`query`), and the views in the run folder
//! (`external_readers`).

#[path = "program/absent.rs"]
mod absent;
mod program;

use program::{data, run};
use std::path::Path;
use std::process::Command;
use tempfile::{TempDir, tempdir};

/// Reads the views and tells of each run its plants by `plants` and by `summary`, and the rows of three macros.
const PYTHON: &str = "
import sys, duckdb
con = duckdb.connect()
con.execute(open(sys.argv[1], encoding='utf-8').read())
print(con.sql('select run, count(*) from plants group by run order by run').fetchall())
print(con.sql('select run, count(distinct plant_id) from summary group by run order by run').fetchall())
print(con.sql('select count(distinct run) from at_age(12)').fetchall())
print(con.sql('select count(*) = (select count(*) from components where kind = \\'apical_bud\\') from axes()').fetchall())
print(con.sql('select count(*) = (select count(*) from records) from records_world').fetchall())
print(con.sql('select count(*) from events where axis_order is null').fetchall())
";

/// A folder with two runs below runs/, one of which has a name that SQL and patterns of files must escape.
fn grown() -> TempDir {
    let folder = tempdir().expect("a temporary folder");
    for (plants, name) in [("3", "runs/small"), ("2", "runs/it's [a] second*")] {
        let words = ["grow", &data("small.toml"), "--plants", plants, "--out", name, "--quiet"];
        run(folder.path(), &words).ending(0);
    }
    folder
}

#[test]
fn duckdb_reads_the_views_of_several_runs_in_any_folder() {
    let folder = grown();
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join(".venv/bin/python");
    if !python.exists() {
        assert!(!absent::in_ci(), "CI must have DuckDB");
        return absent::skip("no DuckDB here; .ci/run installs it");
    }
    for (words, told) in [
        (&["query", "--views", "small"][..], "[('small', 3)]\n[('small', 3)]\n[(1,)]\n[(True,)]\n[(True,)]\n[(0,)]\n"),
        (
            &["query", "--views", "runs/small", "runs/it's [a] second*"],
            "[(\"it's [a] second*\", 2), ('small', 3)]\n[(\"it's [a] second*\", 2), ('small', 3)]\n[(2,)]\n[(True,)]\n[(True,)]\n[(0,)]\n",
        ),
    ] {
        let views = folder.path().join("views.sql");
        std::fs::write(&views, run(folder.path(), words).ending(0).stdout).expect("a file");
        let done = Command::new(&python).args(["-c", PYTHON]).arg(views).output().expect("python starts");
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        assert_eq!(String::from_utf8_lossy(&done.stdout), told, "{words:?}");
    }
}

#[test]
fn runs_that_are_not_there_are_named() {
    let folder = grown();
    for (words, told) in [
        (&["query", "--views", "smal"][..], "there is no run `smal`"),
        (&["query", "small"], "`small` is given alone"),
        (&["query", "--views", "small", "runs/small"], "named twice"),
        (&["query"], "required"),
        (&["query", "--views", "small", "--json"], "cannot be used with"),
        (&["query", "small", "SELECT 1", "--memory", "3"], "at least 1MB"),
    ] {
        let said = run(folder.path(), words).ending(2);
        assert!(said.stderr.contains(told) && said.stdout.is_empty(), "{words:?}: {}", said.stderr);
    }
}

#[cfg(not(feature = "sql"))]
#[test]
fn a_program_without_sql_prints_the_line_for_duckdb() {
    let folder = grown();
    let sql = "SELECT kind FROM at_age(3) WHERE kind = 'leaf'";
    let said = run(folder.path(), &["query", "small", "it's [a] second*", sql, "--out", "kinds.csv"]).ending(2);
    assert!(said.stderr.contains("--features sql"), "{}", said.stderr);
    let expected = "phytomer query --views runs/small 'runs/it'\\''s [a] second*' > views.sql && duckdb -csv -init views.sql \
                    -c 'SELECT kind FROM at_age(3) WHERE kind = '\\''leaf'\\'''\n";
    assert_eq!(said.stdout, expected);
    assert!(!folder.path().join("kinds.csv").exists());
}
