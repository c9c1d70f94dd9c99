//! Ways to break a file as people do when they type, delete or paste by mistake, drawn from a number.
//!
//! Bytes, lines, tokens and values are deleted, doubled, swapped and replaced by extremes. The draws are fixed: an
//! equal number breaks an equal text in an equal way. Absent: the expected result, which each test states.

#![allow(dead_code, reason = "each test program uses a part of it")]

use std::fs;
use std::path::Path;

use phytomer_config::{Kind, presets};

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
    "\"last\"",
    "\"coffee\"",
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
    "{ every = 1 }",
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

/// splitmix64, which is good enough to choose where to break a text.
pub struct Draw(u64);

impl Draw {
    /// The draws of a mutation.
    pub fn of_mutation(number: u64) -> Self {
        Self(number.wrapping_mul(0x2545_F491_4F6C_DD1D))
    }

    /// A number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
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

/// A text broken in one to three ways.
pub fn broken(text: &[u8], draw: &mut Draw) -> Vec<u8> {
    let mut text = text.to_vec();
    for _ in 0..=draw.below(3) {
        mutate(&mut text, draw);
    }
    text
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

/// Replaces a number, a text, or the rest of a value after an equals sign.
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

/// The good fixtures in `good` and the presets, each written into `folder` as a file, in the order of their names; that
/// of a preset in a folder has a plus sign after the folder.
pub fn corpus(good: &Path, folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in fs::read_dir(good).expect("the folder of good files") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        files.push((name, fs::read(&path).expect("a good file")));
    }
    // A species and a scenario may share a name, and a file beside a scenario would be found before the preset.
    for (kind, prefix) in [(Kind::Species, "species"), (Kind::Scenario, "scenario")] {
        let named = |(name, text): &(&str, &str)| {
            (format!("{prefix}_of_{}.toml", name.replace('/', "+")), text.as_bytes().to_vec())
        };
        files.extend(presets(kind).iter().map(named));
    }
    files.sort();
    assert!(files.windows(2).all(|pair| pair[0].0 != pair[1].0), "two files of one name");
    for (name, text) in &files {
        fs::write(folder.join(name), text).expect("a copy");
    }
    files
}
