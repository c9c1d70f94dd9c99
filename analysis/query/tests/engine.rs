//! The engine of queries: its rows are those of DuckDB on the same views, it only reads, its errors have places, memory
//! is limited.
//!
//! Absent: joins by parts and groups by words (`plans`), the command line (`tests/query.rs`
//! of the program), and speed (`examples/queries.rs`).

mod grown;

use arrow_array::{Array, Float32Array, RecordBatch};
use grown::{absent, engine_over, grown, phytomer, program, root};
use phytomer_query::{Engine, Error, Format, Rows, SchemaRef, Settings, Stop, Table, open};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

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

fn engine(folder: &Path, memory_bytes: usize) -> Engine {
    engine_of(folder, &Settings { memory_bytes, threads: 2 })
}

fn engine_of(folder: &Path, settings: &Settings) -> Engine {
    engine_over(folder, &["one", "the other's"], settings)
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

/// Queries whose rows are in no order that they state, have ties, or sum real numbers in the order of the work.
const IN_NO_ORDER: [&str; 8] = [
    "SELECT plant_id, age, sum(length_m) AS length_m, count(DISTINCT axis_id) AS axes FROM records GROUP BY plant_id, age",
    "SELECT sum(x_m) AS x, avg(diameter_m) AS d, stddev(z_m) AS z FROM records",
    "SELECT component_id, age FROM records ORDER BY age DESC LIMIT 50",
    "SELECT component_id, kind FROM records ORDER BY kind",
    "SELECT component_id, x_m FROM records LIMIT 1000",
    "SELECT c.component_id, r.age FROM components c LEFT JOIN records r ON c.run = r.run AND c.plant_id = r.plant_id AND \
     c.component_id = r.component_id AND r.z_m > 0.5",
    "SELECT p.plant_id, e.event FROM plants p FULL JOIN events e ON p.run = e.run AND p.plant_id + 1 = e.plant_id",
    "SELECT component_id, row_number() OVER (PARTITION BY kind ORDER BY age) AS place FROM records WHERE length_m > 0.1",
];

/// The rows of a query as they come, every bit of them.
#[derive(Default)]
struct Kept {
    batches: Vec<RecordBatch>,
}

impl Rows for Kept {
    fn begin(&mut self, _schema: &SchemaRef) -> Result<(), Error> {
        Ok(())
    }

    fn add(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        self.batches.push(batch.clone());
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        Ok(())
    }
}

impl Kept {
    /// The rows in one batch: where batches end is not told.
    fn rows(&self) -> RecordBatch {
        let schema = self.batches.first().expect("a batch").schema();
        datafusion::arrow::compute::concat_batches(&schema, &self.batches).expect("batches of one schema")
    }
}

/// Threads share the parts of a query, and parts meet in their order.
#[test]
fn rows_and_their_order_do_not_depend_on_threads() {
    let Some(folder) = grown() else { return };
    let engines = [1, 2, 5].map(|threads| engine_of(folder, &Settings { memory_bytes: 1 << 30, threads }));
    for sql in QUERIES.iter().chain(&IN_NO_ORDER) {
        let [one, two, five] = engines.each_ref().map(|engine| {
            let mut kept = Kept::default();
            engine.query(sql, &Stop::default(), &mut kept).unwrap_or_else(|error| panic!("{sql}: {error}"));
            kept
        });
        if one.batches.is_empty() {
            assert!(sql.contains("(-1)") || sql.contains("(0)"), "{sql}: no rows");
            continue;
        }
        assert_eq!(one.rows(), two.rows(), "{sql}");
        assert_eq!(one.rows(), five.rows(), "{sql}");
    }
    let told = text(&engines[1], "EXPLAIN SELECT kind, count(*) FROM records GROUP BY kind").expect("a plan");
    assert!(told.contains("InOrder") && !told.contains("RepartitionExec"), "{told}");
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
