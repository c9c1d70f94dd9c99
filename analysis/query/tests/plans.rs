//! What the engine changes in the plans of DataFusion changes no row: joins by the plant go part file by part file, and
//! words are grouped by numbers.
//!
//! Each query is held against one that says the same and that the rules do not know. Absent: other engines (`engine`).

mod grown;

use grown::{engine_over, grown};
use phytomer_query::{Engine, Settings, Stop, Table};
use std::path::Path;

fn over(folder: &Path, runs: &[&str]) -> [Engine; 2] {
    [1, 3].map(|threads| engine_over(folder, runs, &Settings { memory_bytes: 1 << 30, threads }))
}

fn text(engine: &Engine, sql: &str) -> String {
    let mut table = Table::of(10_000);
    engine.query(sql, &Stop::default(), &mut table).unwrap_or_else(|error| panic!("{sql}: {error}"));
    table.text().expect("a table").text
}

/// Both texts of a query on each engine; the rows of the first.
fn equal(engines: &[Engine], sql: &str, other: &str) -> String {
    let rows = text(&engines[0], sql);
    assert!(rows.lines().count() > 4, "{sql}: no rows\n{rows}");
    for engine in engines {
        assert_eq!(text(engine, sql), rows, "{sql}");
        assert_eq!(text(engine, other), rows, "{sql}\nand\n{other}");
    }
    rows
}

const KEYED: &str = "Keyed";

#[test]
fn joins_by_the_plant_go_part_by_part() {
    let Some(folder) = grown() else { return };
    let engines = over(folder, &["one"]);
    let of_joins = |join: &str, zero: &str| {
        format!(
            "SELECT p.plant_id AS plant, p.sown_tick, s.age, s.internodes FROM (SELECT * FROM plants WHERE plant_id % 3 < 2) p \
             {join} (SELECT * FROM summary WHERE age > 6 AND plant_id % 5 < 3) s ON p.plant_id{zero} = s.plant_id{zero} \
             ORDER BY plant, age, internodes"
        )
    };
    for join in ["JOIN", "LEFT JOIN", "RIGHT JOIN", "FULL JOIN"] {
        let (by_parts, whole) = (of_joins(join, ""), of_joins(join, " + 0"));
        equal(&engines, &by_parts, &whole);
        let plans = [&by_parts, &whole].map(|sql| text(&engines[1], &format!("EXPLAIN {sql}")));
        assert!(plans[0].contains(KEYED) && !plans[1].contains(KEYED), "{join}:\n{}", plans[0]);
    }
    let exists = |not: &str, zero: &str| {
        format!(
            "SELECT plant_id, age FROM summary s WHERE {not} EXISTS (SELECT 1 FROM plants p WHERE p.plant_id{zero} = \
             s.plant_id{zero} AND p.plant_id % 2 = 0) ORDER BY plant_id, age"
        )
    };
    for not in ["", "NOT"] {
        equal(&engines, &exists(not, ""), &exists(not, " + 0"));
    }
}

/// A view that is a join itself is one side of a join: all three tables are read part by part.
#[test]
fn joins_of_joins_go_part_by_part() {
    let Some(folder) = grown() else { return };
    let engines = over(folder, &["one"]);
    let sql = |zero: &str| {
        format!(
            "SELECT c.neoformed, r.kind, count(*) AS n, min(r.length_m) AS length_m FROM at_age(8) r JOIN components c ON \
             r.plant_id{zero} = c.plant_id{zero} AND r.component_id = c.component_id GROUP BY c.neoformed, r.kind ORDER BY 1, 2"
        )
    };
    equal(&engines, &sql(""), &sql(" + 0"));
    let plan = text(&engines[1], &format!("EXPLAIN {}", sql("")));
    assert_eq!(plan.matches(KEYED).count(), 4, "{plan}");
}

/// What is called `plant_id` and is not, rows that are no longer all rows of a plant, and several runs.
#[test]
fn other_joins_meet_as_a_whole() {
    let Some(folder) = grown() else { return };
    let one = over(folder, &["one"]);
    for sql in [
        "SELECT count(*) AS n FROM (SELECT component_id AS plant_id FROM components) c JOIN plants p ON c.plant_id = p.plant_id",
        "SELECT count(*) AS n FROM summary s JOIN (SELECT plant_id FROM plants LIMIT 3) p ON s.plant_id = p.plant_id",
        "SELECT count(*) AS n FROM summary s JOIN plants p ON s.plot_id = p.plot_id",
        "SELECT count(*) AS n FROM summary s JOIN (SELECT plant_id, max(age) AS age FROM summary GROUP BY plant_id) l ON \
         s.plant_id = l.plant_id AND s.age = l.age",
    ] {
        let plan = text(&one[0], &format!("EXPLAIN {sql}"));
        assert!(!plan.contains(KEYED), "{sql}:\n{plan}");
        equal(&one, sql, &sql.replace("plant_id = ", "plant_id + 0 = "));
    }
    let both = over(folder, &["one", "the other's"]);
    let sql =
        "SELECT a.run, count(*) AS n FROM summary a JOIN plants b ON a.plant_id = b.plant_id GROUP BY a.run ORDER BY 1";
    assert!(!text(&both[0], &format!("EXPLAIN {sql}")).contains(KEYED));
    equal(&both, sql, &sql.replace("plant_id = ", "plant_id + 0 = "));
}

#[test]
fn words_are_grouped_by_numbers() {
    let Some(folder) = grown() else { return };
    let engines = over(folder, &["one", "the other's"]);
    let told = |word: &str, rest: &str| format!("SELECT {word}, count(*) AS n{rest}");
    for (table, word) in
        [("records", "kind"), ("components", "cause_of_death"), ("events", "event"), ("plants", "treatment")]
    {
        let as_text = format!("CAST({word} AS VARCHAR)");
        let order = " ORDER BY 2, 1";
        let rest = format!(" FROM {table} GROUP BY {word}{order}");
        let other = format!(" FROM {table} GROUP BY {as_text}{order}");
        equal(&engines, &told(word, &rest), &told(&format!("{as_text} AS {word}"), &other));
    }
    let two = "SELECT kind, axis_order, sum(area_m2) AS area_m2 FROM at_age(8) GROUP BY kind, axis_order ORDER BY 1, 2";
    let as_text = two
        .replace("SELECT kind,", "SELECT CAST(kind AS VARCHAR) AS kind,")
        .replace("BY kind,", "BY CAST(kind AS VARCHAR),");
    equal(&engines, two, &as_text);
    let rolled =
        "SELECT kind, axis_order, count(*) AS n FROM at_age(8) GROUP BY ROLLUP (kind, axis_order) ORDER BY 1, 2";
    let as_text = rolled
        .replace("SELECT kind,", "SELECT CAST(kind AS VARCHAR) AS kind,")
        .replace("(kind,", "(CAST(kind AS VARCHAR),");
    equal(&engines, rolled, &as_text);
    let distinct = "SELECT DISTINCT kind FROM records ORDER BY kind";
    equal(&engines, distinct, &distinct.replace("kind FROM", "CAST(kind AS VARCHAR) AS kind FROM"));
    let plan = text(&engines[0], "EXPLAIN SELECT kind, count(*) FROM records GROUP BY kind");
    assert!(plan.contains("__code"), "{plan}");
}

/// The plants of a part file come before those of the next, so sorts by the plant need no merge.
#[test]
fn sorts_by_the_plant_go_part_by_part() {
    let Some(folder) = grown() else { return };
    let engines = over(folder, &["one"]);
    let sql = |zero: &str| {
        format!(
            "SELECT plant_id, component_id, area_m2, place FROM (SELECT plant_id, component_id, area_m2, row_number() OVER \
             (PARTITION BY plant_id{zero} ORDER BY area_m2 DESC, component_id) AS place FROM at_age(8) WHERE kind = 'leaf') \
             ranked WHERE place <= 3 ORDER BY 1, 4"
        )
    };
    equal(&engines, &sql(""), &sql(" + 0"));
    let sorted = |order: &str, zero: &str| {
        format!("SELECT plant_id, age, internodes FROM summary ORDER BY plant_id{zero} {order}, age, internodes")
    };
    for order in ["", "DESC"] {
        equal(&engines, &sorted(order, ""), &sorted(order, " + 0"));
    }
}
