//! Two processes and one run folder, and one process and a disk that fills up.
//!
//! The second process is refused with a message that names the first, and touches nothing, whatever its command; a
//! process that is killed leaves no lock. The disk is simulated by its free space.

mod program;

use phytomer::outputs::{Checking, Depth, FreeSpace, Mode, Space, State, check};
use phytomer::run::{self, Progress, RunError, Settings};
use program::{data, hashes, program as phytomer, run as tell, said};
use std::error::Error;
use std::fs;
use std::io;
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Enough plants to keep a process busy for longer than the test runs.
const PLANTS: &str = "600";

/// A process that grows many plants into the folder `run`.
fn growing(home: &Path, more: &[&str]) -> Child {
    let scenario = data("parts.toml");
    let words =
        [&["grow", &scenario, "--plants", PLANTS, "--threads", "1", "--quiet", "--out", "run"][..], more].concat();
    phytomer(home, &words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Waits until some shards are in the journal.
fn begun(home: &Path) {
    let start = Instant::now();
    let entered = || fs::read_to_string(home.join("run/journal.jsonl")).is_ok_and(|text| text.lines().count() >= 3);
    while !entered() {
        assert!(start.elapsed() < Duration::from_secs(60), "nothing is grown");
        sleep(Duration::from_millis(2));
    }
}

#[test]
fn a_run_in_progress_is_not_touched() {
    let home = tempfile::tempdir().unwrap();
    let first = growing(home.path(), &["--seed", "1"]);
    sleep(Duration::from_millis(20));
    let early = said(growing(home.path(), &["--seed", "2", "--overwrite"]).wait_with_output().unwrap());
    // Twenty milliseconds may be too short for the first process: then the second has the folder.
    let first = match early.code {
        Some(0) => {
            said(first.wait_with_output().unwrap()).ending(1);
            let path = home.path().join("run");
            fs::remove_dir_all(path).unwrap();
            growing(home.path(), &["--seed", "1"])
        }
        _ => {
            let told = early.ending(1);
            assert!(told.stderr.contains(&format!("being filled by process {}", first.id())), "{}", told.stderr);
            first
        }
    };
    begun(home.path());
    let process = format!("process {}", first.id());
    for mode in [&["--seed", "2", "--overwrite"][..], &["--seed", "1", "--resume"], &["--seed", "1"]] {
        let told = said(growing(home.path(), mode).wait_with_output().unwrap()).ending(1).stderr;
        for word in [process.as_str(), "started", " UTC", "--out", "nothing was touched"] {
            assert!(told.contains(word), "`{word}` is missing in {told}");
        }
    }
    let described = tell(home.path(), &["describe", "run", "--json"]).ending(0).json();
    assert_eq!(
        (&described["status"], &described["check"]["holder"]["process"]),
        (&"in progress".into(), &first.id().into())
    );
    let verified = tell(home.path(), &["verify", "run"]).ending(1).stdout;
    assert!(verified.contains("a run in progress") && verified.contains(&process), "{verified}");
    said(first.wait_with_output().unwrap()).ending(0);
    let verified = tell(home.path(), &["verify", "run", "--json"]).ending(0).json();
    assert_eq!((&verified["status"], &verified["holder"]), (&"complete".into(), &serde_json::Value::Null));
    assert_eq!(tell(home.path(), &["describe", "run", "--json"]).ending(0).json()["seed"], 1);
}

#[test]
fn of_two_that_resume_one_goes_on() {
    let home = tempfile::tempdir().unwrap();
    said(growing(home.path(), &[]).wait_with_output().unwrap()).ending(0);
    let whole = hashes(&home.path().join("run"));
    fs::remove_dir_all(home.path().join("run")).unwrap();
    let mut killed = growing(home.path(), &[]);
    begun(home.path());
    killed.kill().unwrap();
    killed.wait().unwrap();
    let left = tell(home.path(), &["describe", "run", "--json"]).ending(0).json();
    assert_eq!(left["status"], "unfinished", "a process that was killed leaves no lock");
    let both = [growing(home.path(), &["--resume"]), growing(home.path(), &["--resume"])];
    let mut codes = both.map(|process| {
        let told = said(process.wait_with_output().unwrap());
        assert!(told.code == Some(0) || told.stderr.contains("being filled by process"), "{}", told.stderr);
        told.code
    });
    codes.sort_unstable();
    assert_eq!(codes, [Some(0), Some(1)]);
    assert_eq!(hashes(&home.path().join("run")), whole);
    tell(home.path(), &["verify", "run"]).ending(0);
}

/// Whether a disk without room is among the causes of a failure.
fn is_full(error: &RunError) -> bool {
    let mut cause: Option<&dyn Error> = Some(error);
    while let Some(now) = cause {
        if now.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::StorageFull) {
            return true;
        }
        cause = now.source();
    }
    false
}

/// A disk that has room for the given number of queries.
#[derive(Debug)]
struct Filling(AtomicU64);

impl FreeSpace for Filling {
    fn space(&self, _: &Path) -> Option<Space> {
        let left = self.0.fetch_update(Relaxed, Relaxed, |left| Some(left.saturating_sub(1))).unwrap();
        Some(Space { free: if left > 0 { 10_000_000 } else { 1_000_000 }, total: 100_000_000 })
    }
}

#[test]
fn a_run_that_cannot_fit_is_refused_and_one_that_fills_the_disk_can_be_resumed() {
    let home = tempfile::tempdir().unwrap();
    let resolved =
        phytomer::config::validate(&data("parts.toml")).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let folder = home.path().join("run");
    let on = |looks: u64, mode: Mode, ignore_disk: bool| {
        let space = Arc::new(Filling(AtomicU64::new(looks)));
        Settings { space, mode, ignore_disk, threads: 1, ..Settings::in_folder(&folder) }
    };
    let run = |settings: &Settings| run::run(&resolved, settings, &Progress::default());
    let refused = run(&on(0, Mode::New, false)).unwrap_err();
    let told = refused.to_string();
    let RunError::TooSmall(too_small) = refused else { panic!("a forecast above the free space: {told}") };
    assert!(too_small.free.0 == 1_000_000 && told.contains("--ignore-disk"), "{told}");
    assert!(!folder.exists());
    // This number of queries is enough for the first part with its mesh, and too small for the last.
    let full = run(&on(12, Mode::New, true)).unwrap_err();
    assert!(is_full(&full), "{full:?}");
    let left = check(&folder, Depth::Bytes, &Checking::default()).unwrap();
    assert_eq!(left.state, State::Unfinished);
    assert!(left.findings.is_empty() && !left.sound.is_empty(), "{left:?}");
    assert!(is_full(&run(&on(0, Mode::Resume, true)).unwrap_err()));
    run(&on(u64::MAX, Mode::Resume, true)).unwrap();
    let whole = home.path().join("whole");
    run::run(&resolved, &Settings::in_folder(&whole), &Progress::default()).unwrap();
    assert_eq!(hashes(&folder), hashes(&whole));
}
