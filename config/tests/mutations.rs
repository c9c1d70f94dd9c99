//! Ten thousand mutations of correct files: for each text the answer is a checked file or a report.
//!
//! No mutation may panic, and none may take long. A failure names its number and shows its text. Species are checked by
//! themselves, over more ages than the root package's `tests/mutations.rs` has time to grow them; that test takes each
//! mutation on to a run folder.

mod mutate;

use mutate::{Draw, broken, corpus};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use phytomer_config::{Kind, kind_of, validate, validate_species};

const MUTATIONS: u64 = 10_000;
const UNTIL: u32 = 40;
/// The longest time for one answer, in the slowest build on a busy machine.
const LONGEST: Duration = Duration::from_secs(20);

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
    let corpus = corpus(Path::new("tests/good"), folder.path());
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
    // Some mutations change a comment or a number and leave the file correct. If all did, or none, the test would be
    // empty.
    assert!((MUTATIONS / 50..MUTATIONS * 9 / 10).contains(&right), "{right} of {MUTATIONS} stayed right");
}

fn survives(folder: &Path, corpus: &[(String, Vec<u8>)], number: u64) -> bool {
    let mut draw = Draw::of_mutation(number);
    let (_, text) = &corpus[draw.below(corpus.len())];
    let text = broken(text, &mut draw);
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
