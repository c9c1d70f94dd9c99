//! A run that is grown in shards, on any number of threads and killed at any moment, and then merged is the run that
//! was grown at once, byte for byte; and what is told of shards that do not make up a run.

mod program;

use program::{Said, contents, data, program as phytomer, run};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::{TempDir, tempdir};

/// Killed starts of shards and merges.
const KILLS: u32 = 8;

fn grow(folder: &Path, more: &[&str]) -> Said {
    run(folder, &[&["grow", &data("parts.toml"), "--quiet"], more].concat())
}

/// A home with the undisturbed run in `runs/parts` and its shards beside it, grown on 1, 2, 3 and 8 threads.
fn shared() -> TempDir {
    let home = tempdir().unwrap();
    grow(home.path(), &[]).ending(0);
    for (share, threads) in [("1/4", "1"), ("2/4", "2"), ("3/4", "3"), ("4/4", "8")] {
        grow(home.path(), &["--shard", share, "--threads", threads]).ending(0);
    }
    home
}

const SHARES: [&str; 4] =
    ["runs/parts-shard-1-of-4", "runs/parts-shard-2-of-4", "runs/parts-shard-3-of-4", "runs/parts-shard-4-of-4"];

fn merge(home: &Path, out: &str, parts: &[&str], more: &[&str]) -> Said {
    run(home, &[&["merge", out], parts, more].concat())
}

#[test]
fn merged_shards_are_the_run_that_was_grown_at_once() {
    let home = shared();
    let told = merge(home.path(), "merged", &SHARES, &["--json"]).ending(0).json();
    assert_eq!((&told["parts"], &told["plants"], &told["folders"]), (&6.into(), &24.into(), &4.into()));
    let [whole, merged] = ["runs/parts", "merged"].map(|run| contents(&home.path().join(run)));
    assert!(whole.contains_key("run.json") && whole.contains_key("journal.jsonl"), "{:?}", whole.keys());
    assert!(whole == merged, "a file of the merged run differs");
    run(home.path(), &["verify", "merged"]).ending(0);
    let refused = merge(home.path(), "merged", &SHARES, &[]).ending(1).stderr;
    assert!(refused.contains("already holds files"), "{refused}");
    merge(home.path(), "merged", &SHARES, &["--overwrite", "--quiet"]).ending(0);
    merge(home.path(), "linked", &SHARES, &["--link", "--quiet"]).ending(0);
    assert!(contents(&home.path().join("linked")) == whole);
    // A mended run is that run too, and so is one whose merge is gone through again.
    fs::remove_file(home.path().join("merged/records/part-00004.parquet")).unwrap();
    let told = merge(home.path(), "merged", &SHARES, &["--resume"]).ending(0).stdout;
    assert!(told.contains("a complete run of 4 folders: 6 parts, 24 plants"), "{told}");
    assert!(contents(&home.path().join("merged")) == whole);
}

#[test]
fn a_shard_is_told_as_what_it_is() {
    let home = shared();
    let verified = run(home.path(), &["verify", SHARES[0]]).ending(0).stdout;
    assert!(verified.contains("a complete shard 1/4;"), "{verified}");
    let described = run(home.path(), &["describe", SHARES[1]]).ending(0).stdout;
    assert!(described.contains("a complete shard 2/4 of the scenario `parts`"), "{described}");
    assert!(described.contains("8 of the 24 of the run"), "{described}");
    let json = run(home.path(), &["verify", SHARES[0], "--json"]).ending(0).json();
    assert_eq!((&json["shard"], &json["parts"], &json["status"]), (&"1/4".into(), &2.into(), &"complete".into()));
    fs::remove_file(home.path().join(SHARES[0]).join("events/part-00004.parquet")).unwrap();
    let verified = run(home.path(), &["verify", SHARES[0]]).ending(1).stdout;
    assert!(verified.contains("--shard 1/4") && verified.contains("1 part to grow again"), "{verified}");
    let other = grow(home.path(), &["--resume", "--shard", "3/4", "--out", SHARES[0]]).ending(1).stderr;
    assert!(other.contains("shard: 1/4 in the run, 3/4 now"), "{other}");
    grow(home.path(), &["--resume", "--out", SHARES[0]]).ending(1);
    grow(home.path(), &["--resume", "--shard", "1/4"]).ending(0);
    run(home.path(), &["verify", SHARES[0]]).ending(0);
}

#[test]
fn shards_that_are_no_run_are_told_with_what_to_do() {
    let home = shared();
    let missing = merge(home.path(), "merged", &SHARES[..2], &[]).ending(1).stderr;
    assert!(missing.contains("the parts 2, 3 of 6") && missing.contains("--shard 3/4, --shard 4/4"), "{missing}");
    let twice = merge(home.path(), "merged", &[&SHARES[..], &SHARES[..1]].concat(), &[]).ending(1).stderr;
    assert!(twice.contains("both hold the parts 0, 4: leave out one of the two folders"), "{twice}");
    grow(home.path(), &["--seed", "12", "--shard", "4/4", "--out", "other"]).ending(0);
    let other = merge(home.path(), "merged", &[SHARES[0], SHARES[1], SHARES[2], "other"], &[]).ending(1).stderr;
    assert!(
        other.contains("other is of another run") && other.contains("scenario.seed: 12, and 11 in the first"),
        "{other}"
    );
    let none = merge(home.path(), "merged", &["nothing"], &[]).ending(2).stderr;
    assert!(none.contains("there is no folder nothing"), "{none}");
    assert!(!home.path().join("merged").exists());
    let many = grow(home.path(), &["--shard", "7/7"]).ending(1).stderr;
    assert!(many.contains("the run has 6 part files") && many.contains("plants_per_part"), "{many}");
    let bad = grow(home.path(), &["--shard", "0/7"]).ending(2).stderr;
    assert!(bad.contains("such as 3/16"), "{bad}");
    let dry = run(home.path(), &["grow", &data("parts.toml"), "--dry-run", "--json"]).ending(0).json();
    assert_eq!(dry["parts"], 6);
}

/// A share of the whole in [0, 1) for each kill; a linear congruential generator is random enough.
fn moments() -> impl Iterator<Item = f64> {
    let mut state = 2026_u64;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    })
}

/// Starts the program and kills it at a share of `time`; whether it was killed before its end.
fn killed(home: &Path, words: &[&str], time: Duration) -> bool {
    let mut child = phytomer(home, words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    sleep(time);
    child.kill().unwrap();
    !child.wait().unwrap().success()
}

#[cfg(unix)]
#[test]
fn killed_shards_and_merges_go_on_to_the_same_bytes() {
    let home = tempdir().unwrap();
    let start = Instant::now();
    grow(home.path(), &[]).ending(0);
    let (time, whole) = (start.elapsed(), contents(&home.path().join("runs/parts")));
    let (mut moments, mut kills) = (moments(), 0);
    for _ in 0..KILLS / 4 {
        for share in ["1/2", "2/2"] {
            let scenario = data("parts.toml");
            let words = ["grow", &scenario, "--quiet", "--resume", "--shard", share];
            kills += u32::from(killed(home.path(), &words, time.mul_f64(moments.next().unwrap())));
            run(home.path(), &words).ending(0);
        }
        let shares = ["runs/parts-shard-1-of-2", "runs/parts-shard-2-of-2"];
        let words = [&["merge", "merged"][..], &shares, &["--resume", "--quiet"]].concat();
        for _ in 0..2 {
            kills += u32::from(killed(home.path(), &words, time.mul_f64(moments.next().unwrap() / 4.0)));
        }
        run(home.path(), &words).ending(0);
        assert!(contents(&home.path().join("merged")) == whole);
        ["merged", shares[0], shares[1]].iter().for_each(|run| fs::remove_dir_all(home.path().join(run)).unwrap());
    }
    assert!(kills >= KILLS / 4, "only {kills} of {KILLS} were killed in time");
}
