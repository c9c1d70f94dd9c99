//! The time of twelve named queries over a run, against DuckDB on the same files, each with as many threads as are
//! asked for.
//!
//! `cargo run --release -p phytomer-query --features engine --example queries -- RUN [THREADS [NAME…]]`, where names
//! choose among the queries. Each runs three times by turns in both engines; the best times are told, their ratios, the
//! geometric mean of the ratios, and on Linux the most memory that phytomer's side has had. DuckDB is that of `.venv`,
//! which `.ci/run` fills. In the dev profile the ratios mean nothing. Absent: growing the run, such as `phytomer grow
//! poplar --plants 300`.

use phytomer_outputs::read::Run;
use phytomer_query::{Engine, Settings, Stop, Table};
use phytomer_sim::math::{exp, log};
use std::error::Error;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

const TURNS: usize = 3;

/// The queries: a name, and SQL with `LAST` for the last age.
const QUERIES: [(&str, &str); 12] = [
    ("kinds", "SELECT kind, count(*) AS n FROM records GROUP BY kind"),
    ("kinds at an age", "SELECT kind, count(*) AS n, avg(length_m) AS length_m FROM at_age(LAST) GROUP BY kind"),
    ("orders at an age", "SELECT * FROM orders_at(LAST)"),
    ("heights", "SELECT plant_id, age, max(z_m) AS top_m FROM records GROUP BY plant_id, age"),
    ("leaf area", "SELECT age, sum(area_m2) AS area_m2 FROM records WHERE kind = 'leaf' GROUP BY age"),
    (
        "crown profile",
        "SELECT age, floor(z_m * 4) AS layer, sum(area_m2) AS area_m2 FROM records GROUP BY age, floor(z_m * 4)",
    ),
    (
        "thickest",
        "SELECT plant_id, component_id, diameter_m FROM records WHERE age = LAST ORDER BY diameter_m DESC, plant_id, component_id LIMIT 10",
    ),
    ("axes", "SELECT plant_id, age, count(DISTINCT axis_id) AS axes FROM records GROUP BY plant_id, age"),
    (
        "neoformed",
        "SELECT c.neoformed, count(*) AS n, avg(r.length_m) AS length_m FROM at_age(LAST) r JOIN components c USING (plant_id, component_id) GROUP BY c.neoformed",
    ),
    (
        "a cube",
        "SELECT count(*) AS n FROM records WHERE z_m BETWEEN 1 AND 1.5 AND x_m BETWEEN 0 AND 0.5 AND y_m BETWEEN 0 AND 0.5",
    ),
    (
        "largest leaves",
        "SELECT plant_id, component_id, area_m2 FROM (SELECT plant_id, component_id, area_m2, row_number() OVER (PARTITION BY plant_id ORDER BY area_m2 DESC, component_id) AS place FROM records WHERE age = LAST AND kind = 'leaf') ranked WHERE place <= 3",
    ),
    (
        "all columns",
        "SELECT sum(x_m) AS x, sum(y_m) AS y, sum(z_m) AS z, sum(dir_x) AS dx, sum(dir_y) AS dy, sum(dir_z) AS dz, sum(length_m) AS l, sum(diameter_m) AS d, max(component_id) AS c FROM records",
    ),
];

/// Reads a line of SQL at a time and answers with its seconds.
const PYTHON: &str = "
import sys, time, duckdb
con = duckdb.connect(config={'threads': int(sys.argv[2])})
con.execute('SET enable_progress_bar = false')
con.execute(open(sys.argv[1], encoding='utf-8').read())
for sql in sys.stdin:
    begun = time.perf_counter()
    con.sql(sql).fetchall()
    print(time.perf_counter() - begun, flush=True)
";

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let folder = words.first().ok_or("expected the path of a run folder")?;
    let threads: usize = words.get(1).map_or(Ok(2), |word| word.parse())?;
    let named = words.get(2..).unwrap_or_default();
    let chosen = |name: &str| named.is_empty() || named.iter().any(|word| word == name);
    let run = Run::open(Path::new(folder))?;
    let rows = run.rows()?.get(&phytomer_outputs::Table::Records).copied().unwrap_or_default();
    let last = run.json()["until"].as_u64().ok_or("run.json tells no last tick")?;
    let engine = Engine::over(&[("run".to_owned(), run)], &Settings { threads, ..Settings::default() })?;
    let views = std::env::temp_dir().join(format!("queries-{}.sql", std::process::id()));
    std::fs::write(&views, views_of(folder)?)?;
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut duckdb = Command::new(here.join(".venv/bin/python"))
        .args(["-c", PYTHON, &views.display().to_string(), &threads.to_string()])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()?;
    let mut questions = duckdb.stdin.take().ok_or("a pipe")?;
    let mut answers = BufReader::new(duckdb.stdout.take().ok_or("a pipe")?);
    println!("{rows} rows of records, {threads} threads of each, the best of {TURNS} turns");
    let (mut logs, mut count) = (0.0, 0.0);
    for (name, sql) in QUERIES.into_iter().filter(|(name, _)| chosen(name)) {
        let sql = sql.replace("LAST", &last.to_string());
        let (mut ours, mut theirs) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..TURNS {
            let begun = Instant::now();
            engine.query(&sql, &Stop::default(), &mut Table::of(usize::MAX))?;
            ours = ours.min(begun.elapsed().as_secs_f64());
            writeln!(questions, "{sql}")?;
            questions.flush()?;
            let mut line = String::new();
            answers.read_line(&mut line)?;
            theirs = theirs.min(line.trim().parse().map_err(|_| format!("DuckDB gave no rows of {sql}"))?);
        }
        (logs, count) = (logs + log(ours / theirs), count + 1.0);
        println!("{name:>18}: {ours:8.3} s, DuckDB {theirs:8.3} s, ratio {:.2}", ours / theirs);
    }
    println!("geometric mean of the ratios: {:.2}", exp(logs / count));
    if let Some(most) = most_memory() {
        println!("the most memory of phytomer: {most}");
    }
    drop(questions);
    std::fs::remove_file(&views)?;
    if duckdb.wait()?.success() { Ok(()) } else { Err("DuckDB failed".into()) }
}

/// The most memory that this process has had, as Linux tells it.
fn most_memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    status.lines().find_map(|line| Some(line.strip_prefix("VmHWM:")?.trim().to_owned()))
}

/// The views of the run, as `phytomer query --views` prints them.
fn views_of(folder: &str) -> Result<String, Box<dyn Error>> {
    use phytomer_outputs::views::for_duckdb;
    use phytomer_outputs::views_of_run::{duckdb_source, tables_of};
    let folder = std::path::absolute(folder)?;
    let tables = tables_of(&Run::open(&folder)?, "run", |table| duckdb_source(&folder, table))?;
    Ok(for_duckdb("A run.", &[tables]))
}
