//! The engine of queries: its rows are those of DuckDB on the same views, it only reads, its errors have places,
//! memory is limited.
//!
//! Two runs of one scenario with two treatments, of different seeds, so that the column `run` tells them apart. They
//! are grown by the program that `PHYTOMER_RELEASE` names, else by the one of the dev profile, so that nothing of it
//! is built again here; without one the tests skip and say so, but never in CI. Absent: the command line
//! (`tests/query.rs` of the program), and speed (`examples/queries.rs`).

#[path = "../../../tests/program/absent.rs"]
mod absent;

use arrow_array::{Array, Float32Array, RecordBatch};
use phytomer_outputs::read::Run;
use phytomer_query::{Engine, Error, Format, Rows, SchemaRef, Settings, Stop, Table, open};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use tempfile::TempDir;

const SCENARIO: &str = "
name = \"two\"
species = \"apple\"
plants = 4
seed = 7
spacing_m = 2
ages = { until = 8, record = \"all\" }
output = { mechanics = true, plants_per_part = 2 }

[[experiment.factor]]
name = \"stand\"
level = [{ name = \"wide\" }, { name = \"dense\", spacing_m = 1 }]
";

/// Queries whose rows both engines give.
const QUERIES: [&str; 26] = [
    "SELECT * FROM components",
    "SELECT * FROM events",
    "SELECT * FROM summary",
    "SELECT * FROM plants",
    "SELECT * FROM treatments",
    "SELECT * FROM site",
    "SELECT * FROM records WHERE tick = 8",
    "SELECT run, plot_id, plant_id, component_id, world_x_m, world_y_m, world_z_m FROM records_world WHERE age = 7",
    "SELECT * FROM at_age(8)",
    "SELECT * FROM at_age(0)",
    "SELECT * FROM at_age(-1)",
    "SELECT * FROM at_tick(5)",
    "SELECT * FROM orders_at(8)",
    "SELECT * FROM alive_at(6)",
    "SELECT * FROM axes()",
    "SELECT * FROM fates()",
    "SELECT * FROM sites()",
    "SELECT * FROM growth()",
    "SELECT * FROM treatments_at(8)",
    "SELECT * FROM pairs_at(8)",
    "SELECT * FROM mechanics_at(8)",
    "SELECT kind, axis_order, count(*) AS n, avg(length_m) AS length_m FROM at_age(8) GROUP BY kind, axis_order",
    "SELECT a.run, a.number, a.height_m - b.height_m AS gain_m FROM pairs_at(8) a JOIN pairs_at(8) b \
     USING (run, replicate, number) WHERE a.treatment = 'wide' AND b.treatment = 'dense'",
    "SELECT axis_order, count(*) FILTER (WHERE event = 'paused') / CAST(count(*) AS DOUBLE) AS paused FROM events \
     WHERE event IN ('grew', 'paused') GROUP BY axis_order",
    "SELECT c.run, c.axis_order, sum(c.axillary_buds) AS buds FROM components c JOIN plants p \
     USING (run, plot_id, plant_id) WHERE p.ground_area_m2 > 1 GROUP BY c.run, c.axis_order",
    "WITH per_unit AS (SELECT run, plant_id, axis_id, growth_unit, count(*) AS nodes FROM components WHERE growth_unit IS \
     NOT NULL GROUP BY run, plant_id, axis_id, growth_unit) SELECT nodes, count(*) AS units FROM per_unit GROUP BY nodes",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The program that grows the runs.
fn program() -> Option<PathBuf> {
    let named = std::env::var_os("PHYTOMER_RELEASE").map(|path| root().join(path));
    let built = named.unwrap_or_else(|| root().join("target/debug/phytomer"));
    if built.is_file() {
        return Some(built);
    }
    assert!(!absent::in_ci(), "CI must have a program that grows: {}", built.display());
    absent::skip("no program that grows runs; `cargo build` makes one");
    None
}

fn phytomer(program: &Path, folder: &Path, words: &[&str]) -> String {
    let done = Command::new(program).current_dir(folder).args(words).output().expect("the program starts");
    assert!(done.status.success(), "{words:?}: {}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).expect("UTF-8")
}

/// A folder with the runs `one` and `the other's` below runs/; grown once.
fn grown() -> Option<&'static Path> {
    static GROWN: OnceLock<Option<TempDir>> = OnceLock::new();
    let grown = GROWN.get_or_init(|| {
        let program = program()?;
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("two.toml"), SCENARIO).expect("a file");
        for (seed, name) in [("7", "runs/one"), ("8", "runs/the other's")] {
            phytomer(&program, folder.path(), &["grow", "two.toml", "--seed", seed, "--out", name, "--quiet"]);
        }
        Some(folder)
    });
    grown.as_ref().map(TempDir::path)
}

fn engine(folder: &Path, memory_bytes: usize) -> Engine {
    let runs = ["one", "the other's"].map(|name| {
        let run = Run::open(&folder.join("runs").join(name)).expect("a run");
        (name.to_owned(), run)
    });
    Engine::over(&runs, &Settings { memory_bytes }).unwrap_or_else(|error| panic!("{error}"))
}

/// The names and the sizes of the files in the folder of the runs.
fn files(folder: &Path) -> Vec<(PathBuf, u64)> {
    let (mut folders, mut found) = (vec![folder.to_path_buf()], Vec::new());
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            match path.is_dir() {
                true => folders.push(path),
                false => found.push((path.clone(), fs::metadata(&path).expect("a file").len())),
            }
        }
    }
    found.sort();
    found
}

fn text(engine: &Engine, sql: &str) -> Result<String, Error> {
    let mut table = Table::of(100);
    engine.query(sql, &Stop::default(), &mut table)?;
    Ok(table.text()?.text)
}

#[test]
fn the_rows_are_those_of_duckdb() {
    let Some(folder) = grown() else { return };
    let engine = engine(folder, 1 << 30);
    let answers = tempfile::tempdir().expect("a temporary folder");
    for (number, sql) in QUERIES.iter().enumerate() {
        let file = answers.path().join(format!("{number}.parquet"));
        let mut rows = open(&file, Format::Parquet).expect("a file");
        let count = engine.query(sql, &Stop::default(), rows.as_mut()).unwrap_or_else(|error| panic!("{sql}: {error}"));
        rows.finish().expect("a whole file");
        // Nothing lives before the seed, and the first recorded age is 1.
        let is_empty = sql.contains("(-1)") || sql.contains("(0)");
        assert_eq!(count == 0, is_empty, "{sql}: {count} rows");
        fs::write(answers.path().join(format!("{number}.sql")), sql).expect("a file");
    }
    let Some(program) = program() else { return };
    let told = phytomer(&program, folder, &["query", "--views", "runs/one", "runs/the other's"]);
    let views = answers.path().join("views.txt");
    fs::write(&views, told).expect("a file");
    let here = root();
    let python = here.join(".venv/bin/python");
    if !python.exists() {
        assert!(!absent::in_ci(), "CI must have DuckDB");
        return absent::skip("no DuckDB here; .ci/run installs it");
    }
    let done = Command::new(python).arg(here.join("tests/readers/queries.py")).arg(views).arg(answers.path()).output();
    let done = done.expect("python starts");
    let told = format!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success() && told.contains("queries ok: 26"), "{told}");
}

#[test]
fn a_query_only_reads_and_reads_nothing_else() {
    let Some(folder) = grown() else { return };
    let engine = engine(folder, 1 << 30);
    let secret = folder.join("secret.csv");
    fs::write(&secret, "a\n1\n").expect("a file");
    let before = files(folder);
    let (file, target) = (secret.display(), folder.join("out.csv").display().to_string());
    for sql in [
        "CREATE TABLE t AS SELECT 1",
        "CREATE VIEW v AS SELECT 1",
        "CREATE SCHEMA s",
        "DROP VIEW records",
        "DROP TABLE files.records_0",
        "INSERT INTO records SELECT * FROM records",
        "INSERT INTO files.records_0 SELECT * FROM files.records_0",
        "DELETE FROM files.records_0",
        "UPDATE files.plants_0 SET plant_id = 0",
        "SET datafusion.execution.batch_size = 1",
        "PREPARE p AS SELECT 1",
        &format!("COPY records TO '{target}'"),
        &format!("COPY (SELECT 1) TO '{target}' STORED AS CSV"),
        &format!("EXPLAIN ANALYZE COPY (SELECT 1) TO '{target}' STORED AS CSV"),
        &format!("CREATE EXTERNAL TABLE t (a INT) STORED AS CSV LOCATION '{file}'"),
        &format!("SELECT * FROM '{file}'"),
        &format!("SELECT * FROM read_csv('{file}')"),
        &format!("SELECT * FROM read_parquet('{file}')"),
        "SELECT 1; SELECT 2",
        "",
        "-- nothing",
    ] {
        let told = text(&engine, sql);
        assert!(matches!(told, Err(Error::Sql(_) | Error::ReadOnly(_))), "{sql}: {told:?}");
    }
    let after = files(folder);
    assert_eq!(before, after, "a refused query has changed a file");
    assert!(!Path::new(&target).exists());
    for sql in ["SHOW TABLES", "DESCRIBE summary", "EXPLAIN SELECT * FROM at_age(3)", "SELECT 1", "VALUES (1, 'a')"] {
        assert!(text(&engine, sql).is_ok_and(|text| text.lines().count() > 3), "{sql}");
    }
}

#[test]
fn an_error_has_its_place_in_the_sql() {
    let Some(folder) = grown() else { return };
    let engine = engine(folder, 1 << 30);
    let told = |sql: &str| match text(&engine, sql) {
        Err(Error::Sql(words)) => words,
        other => panic!("{sql}: {other:?}"),
    };
    let words = told("SELECT plant_id,\n  hight_m FROM summary");
    assert!(words.contains("height_m"), "{words}");
    assert!(words.ends_with(" 2 |   hight_m FROM summary\n   |   ^^^^^^^"), "{words}");
    let words = told("SELECT plant_id FROM summary WHERE AND alive");
    let marked = format!("\n   | {}^^^^^", " ".repeat("SELECT plant_id FROM summary WHERE AND ".len()));
    assert!(words.ends_with(&marked), "{words}");
    for sql in ["SELECT * FROM at_age()", "SELECT * FROM at_age(1, 2)", "SELECT * FROM axes(3)"] {
        assert!(told(sql).contains("arguments"), "{sql}: {}", told(sql));
    }
    assert!(told("SELECT * FROM at_age('old')").contains("such as at_age(10)"));
    assert!(told("SELECT * FROM record").contains("record"));
    assert!(told("SELECT grow(1)").contains("grow"));
}

/// Long and deep texts end with rows or with an error, and never take the program with them.
#[test]
fn no_text_is_too_deep() {
    let Some(folder) = grown() else { return };
    let engine = engine(folder, 1 << 30);
    let sum = format!("SELECT {} AS n", vec!["1"; 400].join(" + "));
    assert!(text(&engine, &sum).is_ok_and(|text| text.contains("400")), "a long sum");
    let longer = format!("SELECT {}", vec!["1"; 40_000].join("+"));
    assert!(matches!(text(&engine, &longer), Err(Error::Sql(words)) if words.contains("at most 65536")), "too long");
    let deep = format!("SELECT {}1{}", "(".repeat(5_000), ")".repeat(5_000));
    assert!(matches!(text(&engine, &deep), Err(Error::Sql(_))), "deep brackets");
    for odd in ["\0", "SELECT '", "SELECT \"", "/* ", "SELECT 'é' FROM 🌳", "SELECT $1", "SELECT * FROM at_age($1)"]
    {
        assert!(text(&engine, odd).is_err(), "{odd:?}");
    }
}

/// A sort of all rows in less memory than they take goes by the disk, and gives the rows of a sort in memory.
#[test]
fn little_memory_is_enough_for_a_sort() {
    let sql = "SELECT run, plant_id, component_id, tick, x_m, y_m, z_m, dir_x, dir_y, dir_z \
               FROM generate_series(1, 16) CROSS JOIN records \
               ORDER BY z_m, x_m, y_m, run, plant_id, component_id, tick";
    let Some(folder) = grown() else { return };
    let (little, enough) = (8_000_000, 1 << 30);
    let sums = [little, enough].map(|memory| {
        let mut rows = Checked::default();
        let count =
            engine(folder, memory).query(sql, &Stop::default(), &mut rows).unwrap_or_else(|error| panic!("{error}"));
        // Ten columns of four bytes and more.
        assert!(count * 40 > 2 * little as u64, "{count} rows are no test");
        rows.heights
    });
    assert_eq!(sums[0], sums[1]);
    let told = text(&engine(folder, little), &format!("EXPLAIN ANALYZE {sql}")).expect("a plan with its figures");
    let spills = told.split("spill_count=").skip(1).filter(|after| !after.starts_with('0')).count();
    assert!(spills > 0, "nothing went by the disk:\n{told}");
}

/// The heights of rows that come in their order.
#[derive(Default)]
struct Checked {
    heights: Vec<f32>,
}

impl Rows for Checked {
    fn begin(&mut self, _schema: &SchemaRef) -> Result<(), Error> {
        Ok(())
    }

    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        let heights = batch.column_by_name("z_m").and_then(|column| column.as_any().downcast_ref::<Float32Array>());
        let heights = heights.expect("heights");
        assert_eq!(heights.null_count(), 0);
        self.heights.extend_from_slice(heights.values());
        assert!(self.heights.is_sorted(), "rows out of order");
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        Ok(())
    }
}

#[test]
fn a_query_stops_when_it_is_told_to() {
    let stop = Stop::default();
    let told = stop.clone();
    let Some(folder) = grown() else { return };
    let engine = engine(folder, 1 << 30);
    let later = std::thread::spawn(move || {
        std::thread::sleep(std::time::Duration::from_millis(200));
        told.stop();
    });
    // More rows than any machine counts in an hour.
    let sql = "SELECT count(*) FROM generate_series(1, 100000000000) WHERE value % 7 = 3";
    let told = engine.query(sql, &stop, &mut Table::of(1));
    assert!(matches!(told, Err(Error::Interrupted)), "{told:?}");
    later.join().expect("the other thread");
}
