//! `docs/papers.md` and `CONTRIBUTING.md` name only existing things: every path exists, every `file.rs::name` is
//! declared in that file, every proof of that form is a test, and no figure, photo, table or numbered section lacks its
//! row.
//!
//! The pages are read as text: words in backticks, outside of fenced code, are a path where they have no space and have
//! a slash or end in `.rs`, `.toml` or `.md`. `NAME` stands for a name that the reader chooses. Absent: whether a file
//! does what the page says.

use std::fs;
use std::path::Path;

const PAPERS: &str = "docs/papers.md";
const PAGES: [&str; 2] = [PAPERS, "CONTRIBUTING.md"];

/// The first words of a row's first cell, and the numbers that follow them.
type Part = (&'static str, &'static [u32]);

/// The heading of each paper's table, with the figures, photos, tables and sections that must have a row there.
const PARTS: [(&str, &[Part]); 5] = [
    (
        "De Reffye",
        &[
            ("§", &[1, 2, 3, 4, 5, 6, 7]),
            ("Fig. ", &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]),
            ("Photo ", &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]),
            ("§3, Example ", &[0, 1, 2, 3, 4]),
        ],
    ),
    (
        "Aono & Kunii",
        &[
            ("Fig. ", &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26]),
            ("Table ", &[1, 2, 3, 4]),
            ("Eq. ", &[1, 2, 3]),
            ("GMT1, rule ", &[1, 2, 3, 4]),
        ],
    ),
    (
        "Weber & Penn",
        &[
            ("§", &[1, 2, 3, 4, 5, 6, 7]),
            ("§4.", &[1, 2, 3, 4, 5, 6, 7, 8, 9]),
            ("Fig. ", &[1, 2]),
            ("Table ", &[2]),
            ("Plate ", &[1, 2, 3, 4, 5, 6, 7]),
        ],
    ),
    (
        "Prusinkiewicz, James",
        &[
            ("§", &[1, 2, 3, 4, 5, 6, 7]),
            ("Fig. ", &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]),
            ("Eq. ", &[1]),
            ("§2, L-system ", &[1]),
            ("§3, L-system ", &[2, 3, 4]),
            ("§4, L-system ", &[5]),
            ("§5, L-system ", &[6]),
        ],
    ),
    ("Prusinkiewicz & Lindenmayer", &[("Fig. 2.", &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]), ("Table 2.", &[1, 2, 3])]),
];

/// What a file declares by a name.
const DECLARATIONS: [&str; 9] =
    ["fn ", "struct ", "enum ", "trait ", "type ", "const ", "static ", "mod ", "macro_rules! "];

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The paths that a line names, each with the name that follows it after `::`, if any.
fn named(line: &str) -> impl Iterator<Item = (&str, Option<&str>)> {
    let in_backticks = line.split('`').skip(1).step_by(2);
    let paths =
        in_backticks.map(|words| words.split_once("::").map_or((words, None), |(path, name)| (path, Some(name))));
    paths.filter(|(path, _)| {
        let looks = path.contains('/') || [".rs", ".toml", ".md"].iter().any(|end| path.ends_with(end));
        looks && !path.contains(char::is_whitespace) && !path.contains("NAME")
    })
}

/// The lines of a page outside of fenced code, with their numbers from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fenced = false;
    (1..).zip(text.lines()).filter(move |(_, line)| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        !fenced && !fence
    })
}

/// The line of a file that declares `name`.
fn declared(text: &str, name: &str) -> Option<usize> {
    let goes_on = |rest: &str| rest.starts_with(|next: char| next.is_alphanumeric() || next == '_');
    let declares = |line: &str| {
        let found = DECLARATIONS.iter().find_map(|word| line.split_once(&format!("{word}{name}")));
        found.is_some_and(|(before, rest)| !goes_on(rest) && !before.contains("//"))
    };
    text.lines().position(declares)
}

/// Whether the function declared on a line has the attribute of a test among the lines just above it.
fn is_test(text: &str, line: usize) -> bool {
    let above: Vec<&str> = text.lines().take(line).collect();
    let mut attributes = above.iter().rev().map(|line| line.trim()).take_while(|line| line.starts_with(['#', '/']));
    attributes.any(|line| line == "#[test]")
}

#[test]
fn every_path_is_there_and_every_name_is_declared_in_its_file() {
    let (mut seen, mut wrong) = (0, Vec::new());
    for page in PAGES {
        let text = read(page);
        for (number, (path, name)) in lines(&text).flat_map(|(number, line)| named(line).map(move |of| (number, of))) {
            seen += 1;
            if !root().join(path).exists() {
                wrong.push(format!("{page}:{number}: there is no `{path}`"));
            } else if name.is_some_and(|name| declared(&read(path), name).is_none()) {
                wrong.push(format!("{page}:{number}: `{path}` declares no `{}`", name.unwrap_or_default()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen > 200, "only {seen} paths are found");
}

#[test]
fn every_proof_that_names_a_function_is_a_test() {
    let (mut seen, mut wrong) = (0, Vec::new());
    let text = read(PAPERS);
    for (number, line) in lines(&text).filter(|(_, line)| line.starts_with('|')) {
        let proof = line.trim_end_matches([' ', '|']).rsplit('|').next().unwrap_or_default();
        for (path, name) in named(proof).filter_map(|(path, name)| Some((path, name?))) {
            seen += 1;
            let file = read(path);
            if !declared(&file, name).is_some_and(|line| is_test(&file, line)) {
                wrong.push(format!("{PAPERS}:{number}: `{path}::{name}` is no test"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen > 80, "only {seen} proofs are found");
}

/// The first cells of the rows below the heading of a paper.
fn rows<'a>(text: &'a str, heading: &str) -> Vec<&'a str> {
    let below = text.lines().skip_while(|line| !line.starts_with(&format!("## {heading}"))).skip(1);
    let rows = below.take_while(|line| !line.starts_with("## ")).filter_map(|line| line.strip_prefix("| "));
    rows.filter_map(|row| row.split(" | ").next()).collect()
}

#[test]
fn each_figure_photo_table_and_section_has_its_row() {
    let text = read(PAPERS);
    let mut missing = Vec::new();
    for (heading, parts) in PARTS {
        let rows = rows(&text, heading);
        for part in parts.iter().flat_map(|(word, numbers)| numbers.iter().map(move |number| format!("{word}{number}")))
        {
            let is_of = |row: &&str| {
                row.strip_prefix(&part).is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
            };
            if !rows.iter().any(is_of) {
                missing.push(format!("{heading}: {part}"));
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}
