//! Lines and files keep to the project's limits: lines of 120 columns and files of 400 lines at most.
//!
//! `cargo fmt` neither wraps comments, which is an option of nightly alone, nor formats macros. Only a line with a part
//! of a text in quotes may be wider, since a message or a table of letters is not broken for its width. Absent:
//! nesting, the length of functions, and files of data.

use std::fs;
use std::path::{Path, PathBuf};

const WIDEST: usize = 120;
const LONGEST: usize = 400;

/// The kind of text at a place of a source file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Within {
    Code,
    /// A comment that ends with its line.
    Comment,
    /// A text that ends at a quote.
    Text,
    /// A raw text that ends at a quote and as many `#`.
    Raw(usize),
}

/// The source files below a folder, without what is built, fetched or made.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && !name.starts_with('.') && name != "target" && name != "runs" {
            files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// The numbers of the lines that are too wide, from 1.
fn too_wide(source: &str) -> Vec<usize> {
    let (mut within, mut wide) = (Within::Code, Vec::new());
    for (number, line) in (1..).zip(source.lines()) {
        let mut quoted = within != Within::Code;
        within = line_end(line, within, &mut quoted);
        if line.chars().count() > WIDEST && !quoted {
            wide.push(number);
        }
        if within == Within::Comment {
            within = Within::Code;
        }
    }
    wide
}

/// Where the end of a line is, and whether any of it is text in quotes.
fn line_end(line: &str, mut within: Within, quoted: &mut bool) -> Within {
    let mut rest = line;
    while let Some(next) = rest.chars().next() {
        let mut taken = next.len_utf8();
        match within {
            Within::Comment => return within,
            Within::Code if rest.starts_with("//") => within = Within::Comment,
            Within::Code if rest.starts_with("'\"'") || rest.starts_with("'\\\"'") => taken = rest.len().min(4),
            Within::Code if next == '"' => (within, *quoted) = (Within::Text, true),
            Within::Code => {
                if let Some(hashes) = raw(rest) {
                    (within, *quoted, taken) = (Within::Raw(hashes), true, hashes + 2);
                }
            }
            Within::Text if next == '\\' => taken += rest[1..].chars().next().map_or(0, char::len_utf8),
            Within::Text if next == '"' => within = Within::Code,
            Within::Text => {}
            Within::Raw(hashes) => {
                let end = format!("\"{}", "#".repeat(hashes));
                if rest.starts_with(&end) {
                    (within, taken) = (Within::Code, end.len());
                }
            }
        }
        rest = &rest[taken..];
    }
    within
}

/// The `#` before the quote with which a raw text begins here.
fn raw(rest: &str) -> Option<usize> {
    let marks = rest.strip_prefix('r')?;
    let hashes = marks.len() - marks.trim_start_matches('#').len();
    marks[hashes..].starts_with('"').then_some(hashes)
}

#[test]
fn lines_and_files_are_as_long_as_the_house_has_them() {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut paths, mut wrong) = (Vec::new(), Vec::new());
    files(project, &mut paths);
    paths.sort();
    assert!(paths.len() > 200, "{} files: this is not the whole project", paths.len());
    for path in paths {
        let source = fs::read_to_string(&path).expect("text");
        let name = path.strip_prefix(project).unwrap_or(&path).display();
        wrong.extend(too_wide(&source).iter().map(|line| format!("{name}:{line}: wider than {WIDEST} columns")));
        let lines = source.lines().count();
        if lines > LONGEST {
            wrong.push(format!("{name}: {lines} lines, at most {LONGEST}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn text_in_quotes_may_be_wide_and_nothing_else() {
    let w = "w".repeat(WIDEST);
    assert_eq!(too_wide(&format!("{w}\nx{w}\n// {w}\n/// a \"{w}\"\n")), [2, 3, 4]);
    assert_eq!(too_wide(&format!("f(\"{w}\");\nlet it = r#\"a \" b\n{w} x\n\"#;\nx{w}\n")), [5]);
    assert_eq!(too_wide(&format!("f(\"\\\"{w}\");\nf('\"'); // {w}\nf(\"a \\\n  {w}\");\n{w}x")), [2, 5]);
}
