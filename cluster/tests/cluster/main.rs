//! Whole clusters on 127.0.0.1: a scheduler and executors as processes, and a run that they grow, held to the bytes of
//! the run that one process grows; executors and schedulers that are killed; and what is told where they do not fit.

mod faults;
mod home;
mod kills;
mod pieces;

use home::{Home, contents};
use std::time::{Duration, Instant};

#[test]
fn two_executors_grow_the_files_of_one_process() {
    let home = Home::new();
    let scheduler = home.scheduler();
    let executors = ["a", "b"].map(|name| home.executor(&scheduler, name));
    let told = home.grow(&["--scheduler", &scheduler.address, "--out", "run", "--json"]).ending(0).json();
    assert_eq!(
        (&told["status"], &told["parts"], &told["parts_grown_now"]),
        (&"complete".into(), &12.into(), &12.into())
    );
    let by = told["parts_by_executor"].as_object().unwrap();
    assert_eq!(by.values().filter_map(serde_json::Value::as_u64).sum::<u64>(), 12);
    assert!(by.keys().all(|name| name == "a" || name == "b"), "{by:?}");
    assert!(contents(&home.path("run")) == home.whole(), "a file of the run differs");
    assert!(!home.path("run.parts").exists());
    // What is complete is not grown again, and not replaced unasked.
    let told = home.grow(&["--scheduler", &scheduler.address, "--out", "run", "--resume"]).ending(0).stderr;
    assert!(told.contains("is complete already"), "{told}");
    let told = home.grow(&["--scheduler", &scheduler.address, "--out", "run"]).ending(1).stderr;
    assert!(told.contains("already holds files") && !home.path("run.parts").exists(), "{told}");
    let told = home.grow(&["--scheduler", &scheduler.address, "--out", "run", "--overwrite", "--seed", "5", "--quiet"]);
    told.ending(0);
    assert!(contents(&home.path("run")) != home.whole());
    drop(executors);
}

/// The cluster of one command; a part that was damaged is grown again, and no other.
#[test]
fn one_command_has_a_cluster_of_its_own() {
    let home = Home::new();
    let told = home.grow(&["--executors", "2", "--threads", "1", "--out", "run"]).ending(0);
    assert!(told.stdout.contains("a complete run: 12 parts, 48 plants"), "{}", told.stdout);
    assert!(contents(&home.path("run")) == home.whole());
    // Two threads of one executor do not share a part.
    home.grow(&["--executors", "1", "--threads", "2", "--out", "again", "--quiet"]).ending(0);
    assert!(contents(&home.path("again")) == home.whole());
}

#[cfg(unix)]
#[test]
fn a_run_that_is_stopped_goes_on() {
    let home = Home::new();
    let scheduler = home.scheduler();
    let executor = home.executor(&scheduler, "a");
    let words = ["--scheduler", &scheduler.address, "--out", "run"];
    let mut grow = home.start_grow(&words);
    let begun = Instant::now();
    while home.parts_of("run") == 0 && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
    // A second one does not disturb the first.
    let told = home.grow(&[&words[..], &["--resume"]].concat()).ending(1).stderr;
    assert!(told.contains("is used by another phytomer-cluster"), "{told}");
    home::signal(&grow.0, "INT");
    assert_eq!(grow.0.wait().unwrap().code(), Some(130));
    assert!(home.parts_of("run") < 12, "stopped after the last part");
    let told = home.grow(&words).ending(1).stderr;
    assert!(told.contains("holds parts of an interrupted run") && told.contains("--resume"), "{told}");
    let told = home.grow(&[&words[..], &["--resume", "--json"]].concat()).ending(0).json();
    assert!(told["parts_grown_now"].as_u64().unwrap() < 12, "{told}");
    assert!(contents(&home.path("run")) == home.whole());
    drop(executor);
}
