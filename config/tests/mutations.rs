//! Ten thousand mutations of files that are right: whatever somebody types, the answer is a run or a report.
//!
//! Bytes, lines, tokens and values are deleted, doubled, swapped and replaced by extremes. No mutation may panic, and
//! none may take long. The draws are fixed: a failure names its number and shows its text.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use phytomer_config::{Kind, kind_of, presets, validate, validate_species};

const MUTATIONS: u64 = 10_000;
const UNTIL: u32 = 40;
/// No answer may be waited for longer than this, in the slowest build on a busy machine.
const LONGEST: Duration = Duration::from_secs(20);

const EXTREMES: &[&str] = &[
    "0",
    "-1",
    "1",
    "2",
    "64",
    "65535",
    "65536",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "99999999999999999999",
    "0.0",
    "-0.0",
    "0.5",
    "1.0000001",
    "1e-308",
    "1e308",
    "1e999",
    "nan",
    "inf",
    "-inf",
    "true",
    "\"\"",
    "\"all\"",
    "\"2/3\"",
    "\"1/0\"",
    "\"4294967295/1\"",
    "\"min(1, age)\"",
    "\"age^age^age\"",
    "\"((((((((1\"",
    "[]",
    "{}",
    "[[]]",
    "[1, 2, 3]",
    "[0]",
    "[\"a\", \"a\"]",
    "1988-08-01",
    "{ value = 1 }",
    "{ expression = \"0.5\" }",
    "{ poisson = { mean = 1e6 } }",
    "{ by_state = { long = 1 } }",
    "{ mixture = [] }",
    "{ empirical = [1] }",
    "{ binomial = { n = 65535, p = 1 } }",
    "\"\"\"\n\"\"\"",
    "'",
    "\"",
    "\"\\u0000\"",
    "\"\u{1F333}\"",
    "[[[[[[[[[[[[[[[[[[[[0]]]]]]]]]]]]]]]]]]]]",
];

const KEYS: &[&str] = &[
    "name",
    "model",
    "order",
    "every_order",
    "inherits",
    "species",
    "ages",
    "until",
    "death",
    "by_state",
    "states",
    "value",
    "expression",
    "x",
    "\"\"",
    "\"a.b\"",
    "a.b.c",
    "growth_unit.nodes",
    "[order]",
    "[[order]]",
    "[every_order]",
];

/// splitmix64: enough to choose where to break things.
struct Draw(u64);

impl Draw {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    }

    fn of<'a>(&mut self, choices: &[&'a str]) -> &'a str {
        choices[self.below(choices.len())]
    }
}

fn mutate(text: &mut Vec<u8>, draw: &mut Draw) {
    match draw.below(8) {
        0 => drop_bytes(text, draw),
        1 => double_bytes(text, draw),
        2 => {
            let at = draw.below(text.len());
            if let Some(byte) = text.get_mut(at) {
                *byte = draw.below(256) as u8;
            }
        }
        3 => lines(text, draw),
        4 => replace_token(text, draw, |b| b.is_ascii_alphanumeric() || b == b'_', KEYS),
        _ => replace_value(text, draw),
    }
}

fn drop_bytes(text: &mut Vec<u8>, draw: &mut Draw) {
    let start = draw.below(text.len());
    let end = (start + 1 + draw.below(12)).min(text.len());
    text.drain(start.min(end)..end);
}

fn double_bytes(text: &mut Vec<u8>, draw: &mut Draw) {
    let start = draw.below(text.len());
    let end = (start + 1 + draw.below(40)).min(text.len());
    let copy = text[start.min(end)..end].to_vec();
    text.splice(start..start, copy);
}

/// Deletes, doubles or moves a line.
fn lines(text: &mut Vec<u8>, draw: &mut Draw) {
    let mut lines: Vec<Vec<u8>> = text.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    let (from, to) = (draw.below(lines.len()), draw.below(lines.len()));
    match draw.below(3) {
        0 => _ = lines.remove(from),
        1 => lines.insert(to, lines[from].clone()),
        _ => lines.swap(from, to),
    }
    *text = lines.join(&b'\n');
}

fn replace_token(text: &mut Vec<u8>, draw: &mut Draw, part: fn(u8) -> bool, by: &[&str]) {
    let at = draw.below(text.len());
    let Some(start) = (at..text.len()).find(|i| part(text[*i])) else { return };
    let end = (start..text.len()).find(|i| !part(text[*i])).unwrap_or(text.len());
    let by = draw.of(by).as_bytes().to_vec();
    text.splice(start..end, by);
}

/// Replaces a number, a text or what follows an equals sign up to the end of its line or its comma.
fn replace_value(text: &mut Vec<u8>, draw: &mut Draw) {
    if draw.below(2) == 0 {
        return replace_token(text, draw, |b| b.is_ascii_digit() || b"+-.eE".contains(&b), EXTREMES);
    }
    let at = draw.below(text.len());
    let Some(equals) = (at..text.len()).find(|i| text[*i] == b'=') else { return };
    let end = (equals..text.len()).find(|i| b",\n}".contains(&text[*i])).unwrap_or(text.len());
    let by = format!(" {} ", draw.of(EXTREMES)).into_bytes();
    text.splice(equals + 1..end, by);
}

/// The fixtures and the presets, each written into `folder` as a file.
fn corpus(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in fs::read_dir("tests/good").expect("the folder of good files") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        files.push((name, fs::read(&path).expect("a good file")));
    }
    for kind in [Kind::Species, Kind::Scenario] {
        let named =
            |(name, text): &(&str, &str)| (format!("{}.toml", name.replace('/', "_")), text.as_bytes().to_vec());
        files.extend(presets(kind).iter().map(named));
    }
    files.sort();
    for (name, text) in &files {
        fs::write(folder.join(name), text).expect("a copy");
    }
    files
}

fn check(file: &str) -> bool {
    let report = match kind_of(file) {
        Kind::Scenario => validate(file).map(drop),
        Kind::Species => validate_species(file, UNTIL).map(drop),
    };
    let Err(report) = report else { return true };
    assert!(!report.faults.is_empty(), "a report without faults");
    assert_eq!(report.records().len(), report.faults.len());
    assert!(report.render(false).ends_with(&format!("{}\n", report.summary())));
    false
}

#[test]
fn no_mutation_panics_or_hangs() {
    let folder = tempfile::tempdir().expect("a folder");
    let corpus = corpus(folder.path());
    let threads = 2;
    let right: u64 = std::thread::scope(|scope| {
        let work = |part| {
            let (folder, corpus) = (folder.path(), &corpus);
            scope.spawn(move || {
                (part..MUTATIONS).step_by(threads).filter(|n| survives(folder, corpus, *n)).count() as u64
            })
        };
        let parts: Vec<_> = (0..threads as u64).map(work).collect();
        parts.into_iter().map(|part| part.join().expect("no mutation fails")).sum()
    });
    // Some mutations change a comment or a number and stay right; if all did, or none, this would test nothing.
    assert!((MUTATIONS / 50..MUTATIONS * 9 / 10).contains(&right), "{right} of {MUTATIONS} stayed right");
}

fn survives(folder: &Path, corpus: &[(String, Vec<u8>)], number: u64) -> bool {
    let mut draw = Draw(number.wrapping_mul(0x2545_F491_4F6C_DD1D));
    let (_, text) = &corpus[draw.below(corpus.len())];
    let mut text = text.clone();
    for _ in 0..=draw.below(3) {
        mutate(&mut text, &mut draw);
    }
    let path = folder.join(format!("mutant_{}.toml", number % 2));
    fs::write(&path, &text).expect("the mutant is written");
    let file = path.to_string_lossy();
    let begin = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| check(&file)));
    let spent = begin.elapsed();
    let shown = String::from_utf8_lossy(&text);
    assert!(spent < LONGEST, "mutation {number} took {spent:?}:\n{shown}");
    outcome.unwrap_or_else(|_| panic!("mutation {number} panicked:\n{shown}"))
}
