//! Two hundred damaged copies of a run: a flipped bit, a cut, a missing and a foreign file, a damaged line of the
//! journal, at places drawn from a fixed seed.
//!
//! `verify`, `describe` and `--resume` must report the same for each copy, and `--resume` must end with the files of
//! the undamaged run. All copies go through the library; some of them through the program too.

mod program;

use phytomer::config::{Resolved, validate};
use phytomer::outputs::read::Run;
use phytomer::outputs::{Checking, Checkup, Depth, FileReport, Mode, State, Table, Trouble, check};
use phytomer::run::{self, Progress, Settings};
use program::{data, run as phytomer};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

const COPIES: u64 = 200;
/// One copy in this number goes through the program.
const THROUGH_PROGRAM: u64 = 10;
const SHARDS: u32 = 6;
const SCENARIO: &str = "damage.toml";
/// Six tables of each shard, `treatments`, three meshes, and the three documents that `run.json` names.
const NAMED: usize = 6 * SHARDS as usize + 1 + 3 + 3;

/// Draws of SplitMix64 (Steele, Lea & Flood 2014): the draws of neighbouring seeds are unrelated.
struct Draw(u64);

impl Draw {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((word ^ (word >> 31)) % end as u64) as usize
    }

    fn among<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        &all[self.below(all.len())]
    }
}

/// Every file below a folder but the lock, with its bytes, by its path there.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for path in fs::read_dir(next).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if !path.ends_with("run.lock") {
                let name = path.strip_prefix(folder).unwrap().display().to_string().replace('\\', "/");
                files.insert(name, fs::read(path).unwrap());
            }
        }
    }
    files
}

/// The files of [`contents`], with the timings and therefore the check of `run.json` removed.
fn compared(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = contents(folder);
    let mut json: serde_json::Value = serde_json::from_slice(&files["run.json"]).unwrap();
    json["timings_s"] = serde_json::Value::Null;
    json["check"] = serde_json::Value::Null;
    files.insert("run.json".to_owned(), serde_json::to_vec(&json).unwrap());
    files
}

/// The damage done to a copy.
struct Damage {
    path: String,
    /// A file of another program was added.
    foreign: bool,
    /// The shards that must be grown again, where the damage determines them.
    shards: Option<Vec<u32>>,
}

fn damage(number: u64, folder: &Path, whole: &BTreeMap<String, Vec<u8>>) -> Damage {
    let mut draw = Draw(1988 + number);
    let names: Vec<&String> = whole.keys().collect();
    let path = (*draw.among(&names)).clone();
    let mut bytes = whole[&path].clone();
    let place = draw.below(bytes.len());
    match number % 5 {
        0 => {
            bytes[place] ^= 1 << draw.below(8);
            write(folder, &path, &bytes)
        }
        1 => write(folder, &path, &bytes[..place]),
        2 => {
            fs::remove_file(folder.join(&path)).unwrap();
            damaged(path)
        }
        3 => foreign(&mut draw, folder, whole),
        _ => line_of_journal(&mut draw, folder, &whole["journal.jsonl"]),
    }
}

fn write(folder: &Path, path: &str, bytes: &[u8]) -> Damage {
    fs::write(folder.join(path), bytes).unwrap();
    damaged(path.to_owned())
}

/// For a damaged part or mesh the shard that has it must be grown again.
fn damaged(path: String) -> Damage {
    let shards = match path.as_str() {
        "run.json" | "datapackage.json" | "views.sql" => Some(vec![]),
        "journal.jsonl" => None,
        part => part.split_once("/part-").map(|(_, number)| vec![number[..5].parse().unwrap()]),
    };
    Damage { path, foreign: false, shards }
}

fn foreign(draw: &mut Draw, folder: &Path, whole: &BTreeMap<String, Vec<u8>>) -> Damage {
    let own = ["records/part-00099.parquet", "meshes/plant-00001_age-0003.ply", "events/.part-00001.parquet.tmp"];
    let others = ["notes.txt", "records/part.csv", "mine/part-00000.txt", "meshes/leaf.obj"];
    let foreign = draw.below(2) == 0;
    let path = if foreign { *draw.among(&others) } else { *draw.among(&own) };
    fs::create_dir_all(folder.join(path).parent().unwrap()).unwrap();
    let bytes = &whole["records/part-00000.parquet"];
    fs::write(folder.join(path), &bytes[..draw.below(bytes.len())]).unwrap();
    Damage { path: path.to_owned(), foreign, shards: Some(vec![]) }
}

fn line_of_journal(draw: &mut Draw, folder: &Path, journal: &[u8]) -> Damage {
    let lines: Vec<&[u8]> = journal.split_inclusive(|byte| *byte == b'\n').collect();
    let line = draw.below(lines.len());
    let before: usize = lines[..line].iter().map(|line| line.len()).sum();
    let mut bytes = journal.to_vec();
    bytes[before + draw.below(lines[line].len() - 1)] ^= 0x01;
    let damaged = write(folder, "journal.jsonl", &bytes);
    Damage { shards: Some(vec![line as u32]), ..damaged }
}

fn copy(whole: &BTreeMap<String, Vec<u8>>, folder: &Path) {
    for (name, bytes) in whole {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
}

fn verify(folder: &Path) -> Checkup {
    check(folder, Depth::Bytes, &Checking::default()).unwrap()
}

fn same(one: &Checkup, other: &Checkup) {
    assert_eq!((one.state, &one.findings, &one.to_grow), (other.state, &other.findings, &other.to_grow));
}

/// The words that a check must report for the damage.
fn assert_found(found: &Checkup, done: &Damage) {
    let paths: Vec<&str> = found.findings.iter().map(|finding| finding.path.as_str()).collect();
    assert_eq!(paths, [done.path.as_str()]);
    let is_foreign = found.findings[0].trouble == Trouble::Foreign;
    assert_eq!((found.state == State::Complete, is_foreign), (done.foreign, done.foreign), "{:?}", found.findings);
    if let Some(shards) = &done.shards {
        assert_eq!(&found.to_grow, shards);
    }
    assert!(found.to_grow.len() <= SHARDS as usize);
    // Without `run.json` nothing names the other documents.
    assert_eq!(found.files, if done.path == "run.json" { NAMED - 3 } else { NAMED });
}

/// The program's report of a damaged copy: the code of `verify`, and the same words by each verb.
fn assert_told(home: &Path, folder: &Path, found: &Checkup) {
    let name = folder.display().to_string();
    let verified = phytomer(home, &["verify", &name, "--json"]).ending(1).json();
    let code = i32::from(found.state != State::Complete);
    let described = phytomer(home, &["describe", &name, "--json"]).ending(code).json();
    let check = if code == 1 { &described } else { &described["check"] };
    for key in ["status", "findings", "parts_to_grow"] {
        assert_eq!(verified[key], check[key], "{key}");
    }
    assert_eq!(verified["findings"][0]["path"], found.findings[0].path.as_str());
    let scenario = home.join(SCENARIO).display().to_string();
    let words = ["grow", &scenario, "--out", &name, "--resume", "--json", "--threads", "1"];
    let resumed = phytomer(home, &words).ending(0);
    assert!(resumed.stderr.contains(&found.findings[0].path), "{}", resumed.stderr);
    assert_eq!(resumed.json()["found"]["findings"], verified["findings"]);
    assert_eq!(resumed.json()["parts_grown_now"], found.to_grow.len());
    let left = phytomer(home, &["verify", &name]).ending(i32::from(found.state == State::Complete)).stdout;
    assert!(left.contains("a complete run"), "{left}");
}

fn settings(folder: &Path, mode: Mode) -> Settings {
    Settings { mode, threads: 1, ..Settings::in_folder(folder) }
}

fn resume(resolved: &Resolved, folder: &Path, found: &Checkup) {
    let progress = Progress::default();
    let begun = run::begin(resolved, &settings(folder, Mode::Resume), &progress).unwrap();
    same(begun.found().unwrap(), found);
    let outcome = begun.grow(&progress).unwrap();
    assert_eq!(outcome.grown_now as usize, found.to_grow.len());
}

/// A scenario of as many parts as `parts.toml`, each smaller, and an undisturbed run of it.
fn undisturbed(home: &Path, folder: &Path) -> Resolved {
    let mut text = fs::read_to_string(data("parts.toml")).unwrap();
    for (there, here) in [
        ("plants = 24", "plants = 12"),
        ("plants_per_part = 4", "plants_per_part = 2"),
        ("[0, 11, 23]", "[0, 5, 11]"),
        ("until = 24", "until = 12"),
        ("\"bush.toml\"", &format!("'{}'", data("bush.toml"))),
    ] {
        assert!(text.contains(there), "{there}");
        text = text.replace(there, here);
    }
    let scenario = home.join(SCENARIO);
    fs::write(&scenario, text).unwrap();
    let name = scenario.to_str().unwrap();
    let resolved = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
    run::run(&resolved, &settings(folder, Mode::New), &Progress::default()).unwrap();
    resolved
}

#[test]
fn two_hundred_damaged_copies_are_told_alike_and_mended() {
    let home = tempfile::tempdir().unwrap();
    let reference = home.path().join("reference");
    let resolved = undisturbed(home.path(), &reference);
    assert!(verify(&reference).is_clean());
    let (whole, expected) = (contents(&reference), compared(&reference));
    let mend = |number| {
        let folder: PathBuf = home.path().join(format!("copy-{number}"));
        copy(&whole, &folder);
        let done = damage(number, &folder, &whole);
        let found = verify(&folder);
        assert_found(&found, &done);
        if (number / 5) % THROUGH_PROGRAM == 0 || number % 53 == 0 {
            assert_told(home.path(), &folder, &found);
        } else {
            resume(&resolved, &folder, &found);
        }
        if done.foreign {
            same(&verify(&folder), &found);
            fs::remove_file(folder.join(&done.path)).unwrap();
        }
        assert!(verify(&folder).is_clean(), "{:?}", verify(&folder).findings);
        assert!(compared(&folder) == expected, "copy {number}, {}: other files", done.path);
        fs::remove_dir_all(&folder).unwrap();
        u64::from(done.foreign)
    };
    let foreign = on_all_threads(COPIES, &mend);
    assert!((10..40).contains(&foreign), "{foreign} foreign files");
}

/// The sum of a function of the numbers below `end`, over threads of the system and not of a pool: a run has a pool of
/// its own, and a worker of one pool that waits for another would begin with the next number meanwhile, on the same
/// stack.
fn on_all_threads(end: u64, of: &(impl Fn(u64) -> u64 + Sync)) -> u64 {
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let (next, sum) = (AtomicU64::new(0), AtomicU64::new(0));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Relaxed);
                    if number >= end {
                        break;
                    }
                    sum.fetch_add(of(number), Relaxed);
                }
            });
        }
    });
    sum.into_inner()
}

/// Every byte of the small documents is damaged once.
#[test]
fn every_byte_of_the_documents_is_checked() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("run");
    undisturbed(home.path(), &folder);
    let whole = contents(&folder);
    let documents = ["run.json", "journal.jsonl", "datapackage.json", "views.sql"];
    let few = |path: &str| whole[path].len().div_ceil(60);
    for path in documents {
        for at in (0..whole[path].len()).step_by(few(path)) {
            let mut bytes = whole[path].clone();
            bytes[at] ^= 0x20;
            fs::write(folder.join(path), &bytes).unwrap();
            let found = check(&folder, Depth::Lengths, &Checking::default()).unwrap();
            // A changed length shows damage to documents that have a check of their own.
            let own = path == "run.json" || path == "journal.jsonl";
            assert_eq!(found.state == State::Damaged, own, "byte {at} of {path}");
        }
        fs::write(folder.join(path), &whole[path]).unwrap();
    }
}

/// A part that is missing or damaged in two places of the run is reported and mended in one run.
#[test]
fn several_kinds_of_damage_at_once() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("run");
    let resolved = undisturbed(home.path(), &folder);
    let expected = compared(&folder);
    fs::remove_file(folder.join("records/part-00001.parquet")).unwrap();
    fs::write(folder.join("summary/part-00004.parquet"), b"cut").unwrap();
    fs::write(folder.join("views.sql"), b"").unwrap();
    fs::write(folder.join("notes.txt"), b"mine").unwrap();
    let found = verify(&folder);
    assert_eq!((found.findings.len(), found.to_grow.as_slice()), (4, [1, 4].as_slice()));
    resume(&resolved, &folder, &found);
    assert_eq!(fs::read(folder.join("notes.txt")).unwrap(), b"mine");
    fs::remove_file(folder.join("notes.txt")).unwrap();
    assert!(compared(&folder) == expected);
    // Two documents that contradict each other: the list of `run.json` and a line that is whole, of another part.
    let json: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("run.json")).unwrap()).unwrap();
    let listed: Vec<FileReport> = serde_json::from_value(json["documents"].clone()).unwrap();
    assert_eq!(
        listed.iter().map(|file| file.path.as_str()).collect::<Vec<_>>(),
        ["journal.jsonl", "datapackage.json", "views.sql"]
    );
    let journal = fs::read_to_string(folder.join("journal.jsonl")).unwrap();
    let shorter: String = journal.lines().skip(1).map(|line| format!("{line}\n")).collect();
    fs::write(folder.join("journal.jsonl"), shorter).unwrap();
    let found = verify(&folder);
    assert_eq!((found.state, found.to_grow.as_slice()), (State::Damaged, [0].as_slice()));
    resume(&resolved, &folder, &found);
    assert!(compared(&folder) == expected);
}

/// The column types that a part states may be damaged in any way: the rows are refused, and nothing panics.
#[test]
fn damaged_types_of_columns_are_errors() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("run");
    undisturbed(home.path(), &folder);
    let part = folder.join("summary/part-00000.parquet");
    let whole = fs::read(&part).unwrap();
    let key = b"ARROW:schema";
    let start = key.len() + whole.windows(key.len()).position(|bytes| bytes == key).unwrap();
    let mut refused = 0;
    for at in start..start + 1500 {
        let mut bytes = whole.clone();
        bytes[at] = if bytes[at] == b'A' { b'z' } else { b'A' };
        fs::write(&part, bytes).unwrap();
        let run = Run::open(&folder).unwrap();
        let read = run.batches(Table::Summary).unwrap().collect::<Result<Vec<_>, _>>();
        refused += u32::from(read.is_err());
    }
    assert!(refused > 20, "{refused} refused");
}
