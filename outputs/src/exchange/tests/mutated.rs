//! Files that are damaged at random: each is read or refused, and what is read can be written.
//!
//! `PHYTOMER_MUTATIONS` is the number of damaged files of each format; without it there are some hundreds.

use super::trips::{Numbers, plant};
use super::{measured, read_with, text, written};
use std::collections::BTreeMap;

const WORDS: [&str; 24] = [
    "<follow class='I' scale='3'>",
    "</follow>",
    "<decomp class='A'>",
    "<branch>",
    "<opf>",
    "<topology>",
    "&amp;",
    "&x;",
    "<!DOCTYPE a>",
    "<![CDATA[",
    "-->",
    "1e308",
    "-1",
    "NaN",
    "99999999999999999999",
    "\t",
    "\n",
    ",",
    "\"",
    "<mat>",
    "NA",
    "0 0 0 1 0 0",
    "<face>1 2 3</face>",
    "\u{0}",
];

/// A file that is damaged: its format, its bytes, the files beside it, and how often.
type Seed = (&'static str, Vec<u8>, BTreeMap<String, Vec<u8>>, usize);

/// A file with some of its bytes changed, left out, doubled or put in.
fn damaged(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut made = bytes.to_vec();
    for _ in 0..1 + (numbers.next() * 4.0) as usize {
        let at = (numbers.next() * made.len() as f64) as usize;
        let until = (at + (numbers.next() * numbers.next() * 200.0) as usize).min(made.len());
        match (numbers.next() * 5.0) as usize {
            0 => made.drain(at..until).for_each(drop),
            1 => {
                let piece = made[at..until].to_vec();
                let to = (numbers.next() * made.len() as f64) as usize;
                made.splice(to..to, piece).for_each(drop);
            }
            2 => {
                let word = WORDS[(numbers.next() * WORDS.len() as f64) as usize];
                made.splice(at..at, word.bytes()).for_each(drop);
            }
            _ if at < made.len() => made[at] = (numbers.next() * 256.0) as u8,
            _ => {}
        }
    }
    made
}

#[test]
fn damaged_files_are_read_or_refused() {
    let count: usize = std::env::var("PHYTOMER_MUTATIONS").ok().and_then(|count| count.parse().ok()).unwrap_or(400);
    let mut seeds: Vec<Seed> = Vec::new();
    // Small files are damaged more often for the time that they take.
    for (made, share) in [(plant(11, 3), count - count / 8), (plant(11, 25), count / 8)] {
        for word in ["opf", "ops", "treeqsm", "treeqsm15", "rtwig"] {
            let (out, _) = written(word, &made);
            seeds.push((word, text(&out).into_bytes(), out.beside, share));
        }
    }
    if let Some(folder) = measured() {
        seeds.push(("opf", std::fs::read(folder.join("simple_plant.opf")).unwrap(), BTreeMap::new(), count));
    }
    let mut numbers = Numbers(count as u64);
    let (mut read, mut refused) = (0, 0);
    for (word, bytes, beside, count) in &seeds {
        for _ in 0..*count {
            let mut others = beside.clone();
            let mut file = bytes.clone();
            // Of a scene either the scene or one of its plants is damaged.
            match others.values_mut().next().filter(|_| numbers.next() < 0.5) {
                Some(other) => *other = damaged(other, &mut numbers),
                None => file = damaged(&file, &mut numbers),
            }
            let (found, report) = read_with(word, &file, &others);
            if report.is_refused() {
                refused += 1;
                continue;
            }
            read += 1;
            assert!(found.entities() <= file.len() + others.values().map(Vec::len).sum::<usize>());
            let (out, _) = written(word, &found);
            let (_, report) = read_with(word, &out.main, &out.beside);
            let is_empty = report.faults().iter().all(|fault| fault.problem.contains("has no cylinders"));
            assert!(is_empty, "{word}: {:?}\n{}", report.faults(), String::from_utf8_lossy(&file));
        }
    }
    assert!(read > 0 && refused > 0, "{read} {refused}");
}
