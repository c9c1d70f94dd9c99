//! A run that is killed at any moment and resumed ends with the bytes of a run that was not interrupted.
//!
//! SIGKILL at moments drawn from a fixed seed, over the time that an undisturbed run takes. At each of them every file
//! under its final name must already be whole.
#![cfg(unix)]

mod program;

use program::{data, hashes, program as phytomer, run, said};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

const KILLS: u32 = 20;
/// The number of kills for a scenario without cuts and pests, and for the one whose plants bend.
const FEWER_KILLS: u32 = 6;
/// The number of kills of a stand in light; `examples/kill_campaign.rs` has as many as are asked for.
const KILLS_IN_LIGHT: u32 = 4;

/// The files of an undisturbed run, and the time that it takes.
fn undisturbed(folder: &Path, scenario: &str) -> (BTreeMap<String, String>, Duration) {
    let start = Instant::now();
    run(folder, &["grow", &data(scenario), "--name", "undisturbed", "--quiet"]).ending(0);
    (hashes(&folder.join("runs/undisturbed")), start.elapsed())
}

/// A share of the whole in [0, 1) for each kill; a linear congruential generator is random enough.
fn moments() -> impl Iterator<Item = f64> {
    let mut state = 1988_u64;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    })
}

/// Plants that are cut, trained, replaced and attacked.
#[test]
fn killed_at_twenty_moments_and_resumed() {
    kill_and_resume("orchard.toml", 6 * 6 + 1 + 3, KILLS);
}

#[test]
fn plants_that_nobody_touches_are_resumed_too() {
    kill_and_resume("parts.toml", 6 * 6 + 1 + 3, FEWER_KILLS);
}

#[test]
fn plants_that_bend_are_resumed_too() {
    kill_and_resume("bending.toml", 6 * 3 + 1 + 2 * 2, FEWER_KILLS);
}

/// Buds that have read the light of the last tick, and tables that tell it.
#[test]
fn plants_in_light_are_resumed_too() {
    kill_and_resume("lit_coffee.toml", 6 * 4 + 1, KILLS_IN_LIGHT);
}

/// The bytes of stands in light on any number of threads.
#[test]
fn stands_in_light_are_the_same_on_any_threads() {
    for scenario in ["lit_coffee.toml", "lit_poplar.toml"] {
        let folder = tempfile::tempdir().unwrap();
        let grown = |threads: &str| {
            let name = format!("on-{threads}");
            let words = ["grow", &data(scenario), "--name", &name, "--quiet", "--threads", threads];
            run(folder.path(), &words).ending(0);
            hashes(&folder.path().join("runs").join(&name))
        };
        let known = grown("1");
        assert!(known.len() > 12, "{known:?}");
        for threads in ["2", "3", "8"] {
            assert_eq!(grown(threads), known, "{scenario} on {threads} threads");
        }
    }
}

fn kill_and_resume(scenario: &str, files: usize, kills: u32) {
    let folder = tempfile::tempdir().unwrap();
    let (whole, time) = undisturbed(folder.path(), scenario);
    assert_eq!(whole.len(), files);
    let mut cut_short = 0;
    for (kill, moment) in (0..kills).zip(moments()) {
        let name = format!("kill-{kill}");
        let words = ["grow", &data(scenario), "--name", &name, "--quiet", "--resume"];
        let mut child = phytomer(folder.path(), &words).stdout(Stdio::null()).spawn().unwrap();
        sleep(time.mul_f64(moment));
        child.kill().unwrap();
        cut_short += u32::from(!child.wait().unwrap().success());
        let there = hashes(&folder.path().join("runs").join(&name));
        there
            .iter()
            .for_each(|(file, hash)| assert_eq!(Some(hash), whole.get(file), "{file} is broken after {moment}"));
        run(folder.path(), &words).ending(0);
        assert_eq!(hashes(&folder.path().join("runs").join(&name)), whole, "killed at {moment} of the run");
    }
    assert!(cut_short >= kills / 4, "only {cut_short} of {kills} were killed in time");
}

#[test]
fn ctrl_c_stops_cleanly_and_tells_how_to_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, time) = undisturbed(folder.path(), "parts.toml");
    let words = ["grow", &data("parts.toml"), "--name", "stopped", "--threads", "1"];
    let child = phytomer(folder.path(), &words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while !folder.path().join("runs/stopped/journal.jsonl").exists() && start.elapsed() < 10 * time {
        sleep(Duration::from_millis(1));
    }
    let process = child.id().to_string();
    std::process::Command::new("kill").args(["-INT", &process]).status().unwrap();
    let stopped = said(child.wait_with_output().unwrap()).ending(130);
    assert!(stopped.stdout.is_empty(), "{}", stopped.stdout);
    assert!(stopped.stderr.contains("--name stopped --resume"), "{}", stopped.stderr);
    assert!(leftovers(&folder.path().join("runs/stopped")).is_empty());
    run(folder.path(), &["grow", &data("parts.toml"), "--name", "stopped", "--resume"]).ending(0);
    assert_eq!(hashes(&folder.path().join("runs/stopped")), whole);
}

/// Files of shards that were not finished.
fn leftovers(run: &Path) -> Vec<String> {
    let folders = ["components", "records", "events", "summary", "meshes"].map(|name| run.join(name));
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).into_iter().flatten().flatten());
    let names = files.map(|file| file.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.ends_with(".tmp")).collect()
}

#[test]
fn another_run_is_not_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["grow", &data("small.toml"), "--plants", "8"];
    run(folder.path(), &words).ending(0);
    let other =
        run(folder.path(), &["grow", &data("small.toml"), "--plants", "8", "--seed", "2", "--resume"]).ending(1);
    assert!(other.stderr.contains("\n  scenario.seed: 7 in the run, 2 now\n"), "{}", other.stderr);
    fs::copy(data("bush.toml"), folder.path().join("bush.toml")).unwrap();
    let text = fs::read_to_string(data("small.toml")).unwrap();
    fs::write(folder.path().join("other.toml"), text.replace("every = 6", "every = 8")).unwrap();
    let other = run(folder.path(), &["grow", "other.toml", "--plants", "8", "--resume"]).ending(1).stderr;
    assert!(other.contains("\n  scenario.ages.record.every: 6 in the run, 8 now\n"), "{other}");
    assert!(other.contains("  inputs.") && !other.contains("scenario_sha256"), "{other}");
    run(folder.path(), &["grow", &data("small.toml"), "--plants", "8", "--resume"]).ending(0);
}
