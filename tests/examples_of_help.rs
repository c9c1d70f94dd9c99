//! The examples that `--help` shows: there is one for each verb, and each runs as it stands.
//!
//! Runs and films of the examples are made small, so that the test stays short. Absent: what the verbs tell
//! (`command_line`).

mod program;
#[path = "program/side_by_side.rs"]
mod side_by_side;

use program::{program as phytomer, run, small_film};
use side_by_side::each;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

const VERBS: [&str; 24] = [
    "init",
    "grow",
    "merge",
    "validate",
    "derive",
    "convert",
    "verify",
    "describe",
    "measure",
    "list",
    "schema",
    "mesh",
    "picture",
    "animate",
    "view",
    "fit",
    "query",
    "forest",
    "sensitivity",
    "report",
    "asystem",
    "shade",
    "completions",
    "man",
];

/// The examples of a verb's help: the lines that begin with the program's name.
fn examples(help: &str) -> Vec<Vec<&str>> {
    let commands = help.lines().filter_map(|line| line.strip_prefix("  phytomer "));
    commands.map(|line| words_of(line.split("   ").next().unwrap_or(line))).collect()
}

/// The words of a line; what stands in quotes is one word.
fn words_of(line: &str) -> Vec<&str> {
    let pieces = line.split('"').enumerate();
    pieces
        .flat_map(|(place, piece)| if place % 2 == 1 { vec![piece] } else { piece.split_whitespace().collect() })
        .collect()
}

/// Every example as it stands, but with fewer plants for `grow`, so that the tests stay short.
#[test]
fn every_example_of_help_runs() {
    let folder = tempdir().unwrap();
    let top = run(folder.path(), &["--help"]).ending(0).stdout;
    let shown = examples(&top);
    assert_eq!(shown.iter().map(|words| words[0]).collect::<Vec<_>>(), VERBS, "an example for each verb");
    run(folder.path(), &["init", "my_plant"]).ending(0);
    run(folder.path(), &["init", "my_herb", "--model", "lsystem"]).ending(0);
    lay_trees_of_others(folder.path());
    lay_site(folder.path());
    lay_court(folder.path());
    lay_counts(folder.path());
    let script = "open paper plotter; create gmt1 oak 4 .9 .7 20 -40; exit;";
    fs::write(folder.path().join("my_trees.asys"), script).unwrap();
    run(folder.path(), &["grow", "coffee", "--plants", "4", "--quiet"]).ending(0);
    for run_of_report in ["runs/dry", "runs/wet"] {
        run(folder.path(), &["grow", "coffee", "--plants", "3", "--quiet", "--out", run_of_report]).ending(0);
    }
    fs::write(folder.path().join("field.csv"), "age,height_m\n12,0.8\n12,0.9\n").unwrap();
    for share in ["1/2", "2/2"] {
        run(folder.path(), &["grow", "coffee", "--plants", DEALT, "--quiet", "--shard", share]).ending(0);
    }
    let mut helps = vec![top.clone()];
    helps.extend(VERBS.map(|verb| run(folder.path(), &["help", verb]).ending(0).stdout));
    let all = helps.iter().enumerate().flat_map(|(number, help)| {
        let examples = examples(help);
        assert!(!examples.is_empty(), "no example in\n{help}");
        examples.into_iter().map(move |words| (number, words))
    });
    // What only draws runs side by side, after all that makes the runs that it draws.
    let (drawn, run): (Vec<_>, Vec<_>) = all.partition(|(_, words)| ["mesh", "picture", "animate"].contains(&words[0]));
    run.into_iter().for_each(|(number, words)| obey_example(folder.path(), number, &words));
    each(drawn, |(number, words)| obey_example(folder.path(), number, &words));
}

/// So many plants of coffee that there are several parts to be dealt into shards.
const DEALT: &str = "24";

/// The files of other programs that the examples name.
fn lay_trees_of_others(folder: &Path) {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("config/peers/tests/data");
    let files = [
        ("hill_larch.xml", "my_tree.xml"),
        ("pond_alder.py", "my_tree.py"),
        ("field_maple.py", "preset.txt"),
        ("thorn.json", "my_tree.json"),
    ];
    for (from, to) in files {
        fs::copy(data.join(from), folder.join(to)).unwrap();
    }
    let library = fs::read_to_string(data.join("orchard.xml")).unwrap().replace("\"Quince\"", "\"Almond\"");
    fs::write(folder.join("library.xml"), library).unwrap();
    let walnut = "CODE:\tFORM-A\nCLASSES:\nP\t1\nA\t2\nS\t3\nFEATURES:\nLength\tREAL\nBottomDiameter\tREAL\nXX\tREAL\nYY\tREAL\n\
                  ZZ\tREAL\nMTG:\nENTITY-CODE\t\tLength\tBottomDiameter\tXX\tYY\tZZ\n/P1\n^/A1\t\t\t\t0\t0\t0\n\
                  ^/S1\t\t149\t6\t0\t0\t149\n";
    fs::write(folder.join("walnut.mtg"), walnut).unwrap();
}

/// The tables that the examples of `fit` and `report` name.
fn lay_counts(folder: &Path) {
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("analysis/fits/samples");
    let tables =
        ["nodes", "activity_days", "mortality_seen", "abc"].into_iter().zip(["nodes", "days", "mortality", "seen"]);
    for (from, to) in tables.map(|(from, to)| (format!("{from}.csv"), format!("{to}.csv"))) {
        fs::copy(samples.join(from), folder.join(to)).unwrap();
    }
    let prior =
        "inherits = \"coffee\"\nname = \"mine\"\n[[order]]\npause = { value = 0.1, prior = { value = [0.02, 0.3] } }\n";
    for name in ["priors.toml", "my_species.toml"] {
        fs::write(folder.join(name), prior).unwrap();
    }
}

/// A site of four cells.
fn lay_site(folder: &Path) {
    let site = folder.join("my_site");
    fs::create_dir(&site).unwrap();
    let text = "name = \"wood\"\ncover = { file = \"cover.asc\" }\n[[tree]]\nbit = 0\nspecies = \"coffee\"\nage = 6\n";
    fs::write(site.join("site.toml"), text).unwrap();
    let cells = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n1 0\n1 1\n";
    fs::write(site.join("cover.asc"), cells).unwrap();
}

fn lay_court(folder: &Path) {
    let court = folder.join("my_court");
    fs::create_dir(&court).unwrap();
    let text = "name = \"court\"\nlatitude_deg = 48\nsun = { days_a_month = 1, step_min = 60 }\n\
                zone = [{ name = \"bench\", corners_m = [[0, 0], [3, 0], [3, 2]] }]\n\
                building = [{ place_m = [1, -3], size_m = [4, 2, 3] }]\n\
                [arrange]\nspot = [{ name = \"a\", place_m = [1, -1] }]\n\
                candidate = [{ name = \"bush\", species = \"coffee\", age = 12, cost = 1 }]\n";
    fs::write(court.join("site.toml"), text).unwrap();
}

fn obey_example(folder: &Path, number: usize, words: &[&str]) {
    let mut words = words.to_vec();
    let name = format!("example-{}-{number}", words.len());
    match words[0] {
        "init" | "merge" => words[1] = &name,
        "grow" => {
            let plants = if words.contains(&"--shard") { DEALT } else { "4" };
            let few = ["--plants", plants, "--quiet", "--overwrite"];
            let kept = if words.contains(&"--plants") || words.contains(&"--dry-run") { 2..2 } else { 0..2 };
            words.extend(&few[kept]);
            words.extend((!words.contains(&"--resume")).then_some("--overwrite"));
        }
        "animate" => words = small_film(&words),
        "sensitivity" => {
            words = words.iter().map(|word| if *word == "256" { "4" } else { *word }).collect();
            words.extend(["--ways", "4", "--plants", "1", "--quiet"]);
            words.extend(if words.contains(&"--points") { &[][..] } else { &["--points", "4"] });
        }
        "fit" if words.contains(&"abc") && words.contains(&"--base") => {
            words.extend(["--particles", "20", "--generations", "2", "--plants", "2", "--quiet"]);
        }
        "forest" | "shade" => words.extend((!words.contains(&"--overwrite")).then_some("--overwrite")),
        _ => {}
    }
    // A film that goes into a pipe is no text.
    let output = phytomer(folder, &words).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    // Without an engine the answer is the line for DuckDB.
    let is_sql = words[0] == "query" && !words.contains(&"--views");
    let code = if is_sql && !cfg!(feature = "sql") { 2 } else { 0 };
    assert_eq!(output.status.code(), Some(code), "{words:?}\n{told}");
}
