//! Mutations of good files, each taken from its text to a run folder: the result is a list of faults and no folder at
//! all, or a whole run; never a panic, never a part of a run.
//!
//! Here are 2,500 of them, or as many as `PHYTOMER_MUTATIONS` says: the whole campaign is
//! `PHYTOMER_MUTATIONS=10000 cargo test --test mutations`. The tests of the package `phytomer-config` check ten
//! thousand without growth.
//!
//! The way is that of `phytomer grow`: `config::validate`, then `run::run`. A panic anywhere fails the test and shows
//! the mutation. The files are the good fixtures and all shipped files. A broken species grows under a small sound
//! scenario. A broken scenario without faults may still ask for a long run: then the numbers of plants, ages and
//! components are lowered in the checked scenario, as `--plants` does it, and the result is checked again before it
//! grows.

#[path = "../config/tests/mutate/mod.rs"]
mod mutate;
mod program;
#[path = "program/tried.rs"]
mod tried;

use mutate::{Draw, broken, corpus};
use phytomer::config::{Kind, Resolved, kind_of, validate};
use phytomer::outputs::read::Run;
use phytomer::outputs::{FileReport, ShardReport, Table};
use phytomer::run::Outcome;
use phytomer::run::plots::Plots;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};
use tried::{SCENARIO, assert_tells, cap, grown};

/// The mutations that are tried where no number is asked for.
const MUTATIONS: u64 = 2_500;
/// The longest time of one mutation, in the slowest build on a busy machine.
const LONGEST: Duration = Duration::from_secs(20);

/// How often mutations had each result.
#[derive(Default)]
struct Counts {
    refused: AtomicU64,
    grown: AtomicU64,
    capped: AtomicU64,
    overgrown: AtomicU64,
}

/// Prints the mutation at which its thread panics.
struct Shown<'a>(u64, &'a str, &'a [u8]);

impl Drop for Shown<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("mutation {} of {}:\n{}", self.0, self.1, String::from_utf8_lossy(self.2));
        }
    }
}

#[test]
fn a_mutation_is_refused_or_leaves_a_whole_run() {
    let home = memory_backed();
    let good = Path::new(env!("CARGO_MANIFEST_DIR")).join("config/tests/good");
    let files = corpus(&good, home.path());
    let families: Vec<&[(String, Vec<u8>)]> = files.chunk_by(|a, b| family(&a.0) == family(&b.0)).collect();
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let mutations = mutations();
    let (next, counts) = (AtomicU64::new(0), Counts::default());
    std::thread::scope(|scope| {
        for thread in 0..threads {
            let bench = Bench::new(home.path(), thread);
            let (files, next, counts) = (&families, &next, &counts);
            scope.spawn(move || {
                while let Some(number) = Some(next.fetch_add(1, Relaxed)).filter(|number| *number < mutations) {
                    bench.try_mutation(files, number, counts);
                }
            });
        }
    });
    let [refused, grown, capped, overgrown] =
        [&counts.refused, &counts.grown, &counts.capped, &counts.overgrown].map(|count| count.load(Relaxed));
    println!("{refused} refused, {grown} grown; of these {capped} capped, {overgrown} came to their limit");
    assert_eq!(refused + grown, mutations);
    // If nearly all mutants were refused, or none, or all reached their limits, this test would show little.
    assert!(refused > mutations / 4 && grown > mutations / 8, "{refused} refused, {grown} grown");
    assert!(overgrown < grown / 2, "{overgrown} of {grown} came to their limit");
}

fn mutations() -> u64 {
    let asked = std::env::var("PHYTOMER_MUTATIONS").ok();
    asked.map_or(MUTATIONS, |asked| asked.parse().expect("PHYTOMER_MUTATIONS is a number"))
}

/// The presets of one folder are much alike, and drawn as often together as any other file: of many trees with the same
/// keys a mutation shows little more than of one.
fn family(name: &str) -> &str {
    name.split_once('+').map_or(name, |(folder, _)| folder)
}

/// A folder in memory where the system has one: a run syncs every file, which is slow on a disk.
fn memory_backed() -> tempfile::TempDir {
    let memory = Path::new("/dev/shm");
    let folder = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() };
    folder.expect("a temporary folder")
}

/// The folder in which one thread tries mutations, one after another.
struct Bench {
    mutant: PathBuf,
    scenario: PathBuf,
    out: PathBuf,
}

impl Bench {
    /// The mutants lie among the good files, which name one another.
    fn new(home: &Path, thread: usize) -> Self {
        let mutant = home.join(format!("mutant_{thread}.toml"));
        let scenario = home.join(format!("scenario_of_mutant_{thread}.toml"));
        fs::write(&scenario, format!("species = 'mutant_{thread}.toml'\n{SCENARIO}")).expect("a scenario");
        Self { mutant, scenario, out: home.join(format!("out_{thread}")) }
    }

    fn try_mutation(&self, families: &[&[(String, Vec<u8>)]], number: u64, counts: &Counts) {
        let mut draw = Draw::of_mutation(number);
        let files = families[draw.below(families.len())];
        let (name, text) = &files[draw.below(files.len())];
        let kind = kind_of(&self.mutant.with_file_name(name).to_string_lossy());
        let text = broken(text, &mut draw);
        let _shown = Shown(number, name, &text);
        fs::write(&self.mutant, &text).expect("the mutant is written");
        let begin = Instant::now();
        self.grow(if kind == Kind::Scenario { &self.mutant } else { &self.scenario }, counts);
        let spent = begin.elapsed();
        assert!(spent < LONGEST, "{spent:?}");
    }

    /// The steps of `phytomer grow`, in one thread.
    fn grow(&self, scenario: &Path, counts: &Counts) {
        let folder = self.out.join("run");
        let mut resolved = match validate(&scenario.to_string_lossy()) {
            Ok(resolved) => resolved,
            Err(report) => {
                assert_tells(&report);
                assert!(!self.out.exists(), "a refused scenario leaves something behind");
                counts.refused.fetch_add(1, Relaxed);
                return;
            }
        };
        counts.capped.fetch_add(u64::from(cap(&mut resolved)), Relaxed);
        let outcome = grown(&resolved, &folder);
        assert_whole(&folder, &resolved, &outcome);
        counts.grown.fetch_add(1, Relaxed);
        counts.overgrown.fetch_add(u64::from(!outcome.report.overgrown.is_empty()), Relaxed);
        fs::remove_dir_all(&self.out).expect("the run goes");
    }
}

/// Whether a folder holds a finished run, and nothing else.
fn assert_whole(folder: &Path, resolved: &Resolved, outcome: &Outcome) {
    let run = Run::open(folder).expect("run.json");
    assert!(run.is_complete() && !outcome.is_interrupted(), "{}", run.json());
    let (scenario, report) = (&resolved.scenario, &outcome.report);
    let (trial, plots) = (resolved.trial(), Plots::of(resolved.trial(), resolved.models()));
    // Whether and when a successor is planted is not known before the run.
    let (later, sown): (Vec<u32>, Vec<u32>) = (0..trial.plants()).partition(|plant| trial.is_successor(*plant));
    let sown: Vec<u32> = sown.into_iter().filter(|plant| plots.germinates(*plant)).collect();
    let planted = (report.living + report.dead).checked_sub(sown.len() as u64).expect("all that are sown");
    assert!(planted <= later.len() as u64, "{planted} of {} successors", later.len());
    assert_eq!(run.rows().expect("whole Parquet files"), report.rows);
    assert_eq!(report.rows.len(), scenario.written_tables().len());
    if let (Some(rows), true) = (report.rows.get(&Table::Summary), report.overgrown.is_empty()) {
        // A row a plant and recorded tick from its sowing on.
        let recorded = scenario.ages.recorded();
        let of = |plant: u32| recorded.iter().filter(|tick| **tick >= trial.sown_at(plant)).count() as u64;
        let has_rows = |plant: &u32| !trial.member_of(*plant).guard;
        let of_sown = sown.into_iter().filter(has_rows).map(of).sum::<u64>();
        let most = of_sown + planted * recorded.len() as u64;
        assert!((of_sown..=most).contains(rows), "{rows} rows, {of_sown} of what is sown, at most {most}");
    }
    let files = listed(run.json());
    assert_eq!(files, entered(folder, outcome.shards), "run.json and the journal name other files");
    for file in &files {
        let path = folder.join(&file.path);
        assert_eq!(fs::metadata(&path).expect("a file").len(), file.bytes, "{}", file.path);
        assert_eq!(program::sha256(&path), file.sha256, "{}", file.path);
    }
    let own = ["datapackage.json", "journal.jsonl", "run.json", "run.lock", "views.sql"].map(str::to_owned);
    let expected: BTreeSet<String> = files.into_iter().map(|file| file.path).chain(own).collect();
    assert_eq!(there(folder), expected, "the files that are there, and those that should be");
    let package = fs::read(folder.join("datapackage.json")).expect("datapackage.json");
    serde_json::from_slice::<BTreeMap<String, serde_json::Value>>(&package).expect("JSON");
}

/// The files that `run.json` lists.
fn listed(json: &serde_json::Value) -> Vec<FileReport> {
    serde_json::from_value(json["files"].clone()).expect("a list of files")
}

/// The files of all shards in the journal, which names each shard once, in order.
fn entered(folder: &Path, shards: u32) -> Vec<FileReport> {
    let journal = fs::read_to_string(folder.join("journal.jsonl")).expect("the journal");
    assert!(journal.ends_with('\n'), "{journal}");
    let read = |line| serde_json::from_str::<ShardReport>(line).expect("a whole line");
    let done: Vec<ShardReport> = journal.lines().map(read).collect();
    assert_eq!(done.iter().map(|shard| shard.shard).collect::<Vec<_>>(), Vec::from_iter(0..shards));
    done.into_iter().flat_map(|shard| shard.files).collect()
}

/// Every file below a folder, by its path there.
fn there(folder: &Path) -> BTreeSet<String> {
    let mut files = BTreeSet::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for path in fs::read_dir(next).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).expect("below the run").display().to_string();
                files.insert(name.replace('\\', "/"));
            }
        }
    }
    files
}
