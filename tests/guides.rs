//! The commands of the README and of the guides, run as they stand on the page; what they answer is compared.
//!
//! A block of `console` has commands after `$ `, each followed by what it answers on both streams. `…` in a line stands
//! for what differs from run to run, and a line `…` for any lines. A command that answers with `error:` ends with exit
//! code 3, any other with 0. Absent: `docs/from-counts-to-report.md`, which needs measured data (`worked_loop`).

#![cfg(unix)]

#[path = "program/absent.rs"]
mod absent;
mod program;

use program::PROGRAM;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::tempdir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A command of a page with the lines that it answers.
#[derive(Debug, Default, PartialEq)]
struct Step {
    command: String,
    answer: Vec<String>,
}

/// The commands of all console blocks of a page. A command goes on over lines while a quotation or a text up to `END`
/// is open.
fn steps(page: &str) -> Vec<Step> {
    let mut steps = Vec::<Step>::new();
    let blocks = page.split("\n```console\n").skip(1).map(|block| block.split("\n```").next().expect("an end"));
    for line in blocks.flat_map(str::lines) {
        let last = steps.last_mut();
        match (last, line.strip_prefix("$ ")) {
            (Some(open), _) if is_open(&open.command) => open.command = format!("{}\n{line}", open.command),
            (_, Some(command)) => steps.push(Step { command: command.to_owned(), answer: Vec::new() }),
            (Some(step), None) => step.answer.push(line.to_owned()),
            (None, None) => panic!("a block begins with `$ `, not with {line}"),
        }
    }
    // Empty lines keep commands apart.
    steps.iter_mut().for_each(|step| while step.answer.pop_if(|line| line.is_empty()).is_some() {});
    steps
}

fn is_open(command: &str) -> bool {
    let text = command.contains("<<'END'") && !command.ends_with("\nEND");
    text || command.matches('"').count() % 2 == 1 && !command.contains("<<'END'")
}

/// Whether what was told is what the page has.
fn answers(told: &[&str], expected: &[String]) -> bool {
    match expected.split_first() {
        None => told.is_empty(),
        Some((any, rest)) if any == "…" => (0..=told.len()).any(|skipped| answers(&told[skipped..], rest)),
        Some((line, rest)) => {
            told.split_first().is_some_and(|(first, later)| fits(first, line) && answers(later, rest))
        }
    }
}

/// Whether a line is as expected, with anything in the place of each `…`.
fn fits(line: &str, expected: &str) -> bool {
    let (line, expected) = (line.trim_end(), expected.trim_end());
    let Some((begin, rest)) = expected.split_once('…') else { return line == expected };
    let Some(left) = line.strip_prefix(begin) else { return false };
    left.char_indices().map(|(at, _)| at).chain([left.len()]).any(|at| fits(&left[at..], rest))
}

/// A folder with the names that the pages call, the program and `duckdb`, which is that of Python where there is one;
/// and whether there is any `duckdb`.
fn tools(folder: &Path) -> (PathBuf, bool) {
    let tools = folder.join("tools");
    fs::create_dir(&tools).expect("a folder");
    std::os::unix::fs::symlink(PROGRAM, tools.join("phytomer")).expect("a link");
    let python = Path::new(ROOT).join(".venv/bin/python");
    let can = |command: &mut Command| {
        command.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|end| end.success())
    };
    if !can(Command::new(&python).args(["-c", "import duckdb"])) {
        assert!(!absent::in_ci(), "CI must have DuckDB: .ci/run installs it into .venv");
        return (tools, can(Command::new("duckdb").arg("--version")));
    }
    let script = "import duckdb, sys; print(duckdb.sql(sys.argv[1]))";
    let text = format!("#!/bin/sh\nexec '{}' -c '{script}' \"$2\"\n", python.display());
    fs::write(tools.join("duckdb"), text).expect("a script");
    fs::set_permissions(tools.join("duckdb"), fs::Permissions::from_mode(0o755)).expect("a script");
    (tools, true)
}

/// Runs the commands of a page one after the other in one folder.
fn follow(page: &str) -> usize {
    let text = fs::read_to_string(Path::new(ROOT).join(page)).unwrap_or_else(|error| panic!("{page}: {error}"));
    let folder = tempdir().expect("a folder");
    let (tools, has_duckdb) = tools(folder.path());
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths([tools].into_iter().chain(std::env::split_paths(&path))).expect("a path");
    let desk = folder.path().join("desk");
    fs::create_dir(&desk).expect("a folder");
    let steps = steps(&text);
    for Step { command, answer } in &steps {
        if command.starts_with("duckdb") && !has_duckdb {
            absent::skip(&format!("{page}: no DuckDB here; .ci/run installs it"));
            continue;
        }
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("exec 2>&1\n{command}")]).current_dir(&desk).env("PATH", &path).env("NO_COLOR", "1");
        let done = shell.output().expect("a shell");
        let told = String::from_utf8(done.stdout).expect("UTF-8");
        let lines: Vec<&str> = told.trim_end().lines().collect();
        assert!(answers(&lines, answer), "{page}: `{command}` answers\n{told}\ninstead of\n{}", answer.join("\n"));
        let code = if answer.iter().any(|line| line.starts_with("error:")) { 3 } else { 0 };
        assert_eq!(done.status.code(), Some(code), "{page}: `{command}`\n{told}");
    }
    steps.len()
}

fn guide(name: &str) {
    let page = format!("docs/guide/{name}.md");
    let text = fs::read_to_string(Path::new(ROOT).join(&page)).expect("a page");
    let fences: Vec<&str> = text.lines().filter(|line| line.starts_with("```")).collect();
    assert!(fences.chunks(2).all(|pair| pair == ["```console", "```"]), "a block that no test runs: {fences:?}");
    assert!(follow(&page) >= 8, "{page} has few commands");
}

#[test]
fn the_guide_of_agronomists_answers_as_it_says() {
    guide("agronomist");
}

#[test]
fn the_guide_of_artists_answers_as_it_says() {
    guide("artist");
}

#[test]
fn the_guide_of_statisticians_answers_as_it_says() {
    guide("statistician");
}

#[test]
fn every_guide_has_a_test() {
    let folder = Path::new(ROOT).join("docs/guide");
    let mut names: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["agronomist.md", "artist.md", "statistician.md"]);
}

#[test]
fn the_readme_answers_as_it_says() {
    assert!(follow("README.md") >= 5);
}

#[test]
fn pages_are_read_and_compared_as_they_say() {
    let page = "text\n```console\n$ one \"a\nb\"\n1\n$ cat > f <<'END'\n$ no command\nEND\n$ two\n2\n\n3\n```\n```sh\n$ no\n```\n";
    let step = |command: &str, answer: &[&str]| Step {
        command: command.to_owned(),
        answer: answer.iter().map(|line| (*line).to_owned()).collect(),
    };
    let expected =
        [step("one \"a\nb\"", &["1"]), step("cat > f <<'END'\n$ no command\nEND", &[]), step("two", &["2", "", "3"])];
    assert_eq!(steps(page), expected);
    let lines = |lines: &[&str]| lines.iter().map(|line| (*line).to_owned()).collect::<Vec<_>>();
    assert!(answers(&["a", "b"], &lines(&["a", "b"])) && answers(&[], &[]));
    assert!(!answers(&["a"], &lines(&["a", "b"])) && !answers(&["a", "b"], &lines(&["a"])));
    assert!(answers(&["took 3 s", "x", "y", "end"], &lines(&["took … s", "…", "end"])));
    assert!(answers(&["end"], &lines(&["…", "end"])) && !answers(&["end", "x"], &lines(&["…", "end"])));
    assert!(!answers(&["took 3 min"], &lines(&["took … s"])));
    assert!(fits("1 of 2 in 3 s", "… of 2 in … s") && !fits("1 of 3 in 3 s", "… of 2 in … s"));
}
