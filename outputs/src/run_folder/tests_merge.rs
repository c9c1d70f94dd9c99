//! Shares of a run, grown into folders of their own, checked, resumed and merged: the bytes of a run that was grown at
//! once, and what is told of folders that do not make up one run.

use super::tests::contents;
use super::*;
use crate::specimen::{grow_shard, plan, run};
use serde_json::Value;
use tempfile::{TempDir, tempdir};

/// Seven plots in parts of two: four parts.
fn seven() -> RunPlan {
    plan(7, 2)
}

fn opening(checking: &Checking, share: Option<Share>) -> Opening<'_> {
    Opening { checking, space: Arc::new(SystemSpace), share }
}

/// The folder of a share that is being filled.
fn share_of(path: &Path, plan: RunPlan, share: &str, mode: Mode) -> Result<RunFolder, Error> {
    RunFolder::open(path, plan, mode, &opening(&Checking::default(), share.parse().ok()))
}

fn grow_share(path: &Path, plan: RunPlan, share: &str) {
    let folder = share_of(path, plan, share, Mode::New).unwrap();
    folder.missing_shards().into_iter().for_each(|shard| _ = grow_shard(&folder, shard, 100_000));
    folder.finish(&[("growth", 0.25)]).unwrap();
}

fn merge_into(path: &Path, parts: &[PathBuf], mode: Mode) -> Result<Merged, Error> {
    merge(path, parts, mode, &opening(&Checking::default(), None))
}

/// A home with the two shares of a run and the whole run.
fn shared() -> (TempDir, [PathBuf; 2], PathBuf) {
    let home = tempdir().unwrap();
    let parts = ["1/2", "2/2"].map(|share| {
        let path = home.path().join(share.replace('/', "-"));
        grow_share(&path, seven(), share);
        path
    });
    let whole = home.path().join("whole");
    run(&whole, seven());
    (home, parts, whole)
}

fn faults(error: Error) -> Vec<String> {
    let Error::Merge(MergeFaults(faults)) = error else { panic!("{error}") };
    faults.iter().map(ToString::to_string).collect()
}

fn told(path: &Path, parts: &[PathBuf]) -> Vec<String> {
    let told = faults(merge_into(path, parts, Mode::New).unwrap_err());
    assert!(!path.exists(), "nothing is written");
    told
}

#[test]
fn shares_that_are_merged_are_the_run_that_was_grown_at_once() {
    let (home, [first, second], whole) = shared();
    for part in [&first, &second] {
        let found = check(part, Depth::Bytes, &Checking::default()).unwrap();
        assert_eq!((found.state, found.shards, found.sound.len()), (State::Complete, Some(2), 2), "{found:?}");
    }
    let merged = home.path().join("merged");
    // In any order of the folders.
    let told = merge_into(&merged, &[second, first], Mode::New).unwrap();
    assert_eq!((told.shards, told.copied), (4, 4));
    assert!(contents(&merged) == contents(&whole), "every file but run.json");
    let [merged, whole] = [merged, whole].map(|folder| fs::read(folder.join("run.json")).unwrap());
    let [mut merged, mut whole] = [merged, whole].map(|text| serde_json::from_slice::<Value>(&text).unwrap());
    assert_eq!(merged["timings_s"]["growth"], 0.5, "the sum of both");
    for run in [&mut merged, &mut whole] {
        ["timings_s", "check"].iter().for_each(|key| _ = run.as_object_mut().unwrap().remove(*key));
    }
    assert_eq!(merged.to_string(), whole.to_string());
}

#[test]
fn an_interrupted_share_and_an_interrupted_merge_go_on() {
    let (home, [first, second], whole) = shared();
    fs::remove_file(second.join("events/part-00003.parquet")).unwrap();
    let other = share_of(&second, seven(), "1/2", Mode::Resume).unwrap_err().to_string();
    assert!(
        other.ends_with("shard: \"2/2\" in the run, \"1/2\" now") || other.ends_with("shard: 2/2 in the run, 1/2 now"),
        "{other}"
    );
    let folder = share_of(&second, seven(), "2/2", Mode::Resume).unwrap();
    assert_eq!((folder.missing_shards(), folder.found().unwrap().to_grow.clone()), (vec![3], vec![3]));
    let merged = home.path().join("merged");
    let busy = faults(merge_into(&merged, &[first.clone(), second.clone()], Mode::New).unwrap_err());
    assert!(busy[0].contains("is being filled by"), "{busy:?}");
    drop(folder);
    let left = told(&merged, &[first.clone(), second.clone()]);
    assert_eq!(left.len(), 1, "{left:?}");
    assert!(left[0].contains("lacks part 3") && left[0].contains("--shard 2/2"), "{left:?}");
    let folder = share_of(&second, seven(), "2/2", Mode::Resume).unwrap();
    grow_shard(&folder, 3, 100_000);
    folder.finish(&[("growth", 0.25)]).unwrap();
    drop(folder);
    merge_into(&merged, &[first.clone(), second.clone()], Mode::New).unwrap();
    fs::write(merged.join("records/part-00002.parquet"), b"cut").unwrap();
    let again = merge_into(&merged, &[first, second], Mode::Resume).unwrap();
    assert_eq!(again.copied, 1);
    assert!(contents(&merged) == contents(&whole));
}

#[test]
fn linked_shares_are_the_run_without_a_copy() {
    let (home, [first, second], whole) = shared();
    let merged = home.path().join("merged");
    let link = |mode| {
        let checking = Checking::default();
        merge_by(Files::Linked, &merged, &[first.clone(), second.clone()], (mode, &opening(&checking, None)))
    };
    assert_eq!(link(Mode::New).unwrap().copied, 4);
    assert!(contents(&merged) == contents(&whole));
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let inode = |folder: &Path| fs::metadata(folder.join("records/part-00001.parquet")).unwrap().ino();
        assert_eq!(inode(&merged), inode(&second));
    }
    // A merge that was interrupted between two names has left one beside; the shares are as they were.
    fs::remove_file(merged.join("records/part-00002.parquet")).unwrap();
    fs::hard_link(first.join("records/part-00002.parquet"), merged.join("records/.part-00002.parquet.tmp")).unwrap();
    assert_eq!(link(Mode::Resume).unwrap().copied, 1);
    assert!(contents(&merged) == contents(&whole));
    [first, second].iter().for_each(|share| fs::remove_dir_all(share).unwrap());
    assert!(contents(&merged) == contents(&whole));
    assert!(check(&merged, Depth::Bytes, &Checking::default()).unwrap().is_clean());
}

#[test]
fn gaps_overlaps_damage_and_other_runs_are_told_together() {
    let (home, [first, second], whole) = shared();
    let merged = home.path().join("merged");
    let gap = told(&merged, std::slice::from_ref(&first));
    assert_eq!(gap.len(), 1);
    assert!(gap[0].starts_with("no folder holds the parts 1, 3 of 4") && gap[0].contains("--shard 2/2"), "{gap:?}");
    let twice = told(&merged, &[first.clone(), second.clone(), whole.clone()]);
    assert_eq!(twice.len(), 2, "{twice:?}");
    assert!(
        twice.iter().all(|fault| fault.contains("both hold the parts") && fault.contains("leave out")),
        "{twice:?}"
    );
    let mut other = seven();
    other.provenance.seed = 43;
    let third = home.path().join("third");
    grow_share(&third, other, "2/2");
    let file = first.join("summary/part-00002.parquet");
    let mut bytes = fs::read(&file).unwrap();
    bytes[40] ^= 1;
    fs::write(&file, bytes).unwrap();
    let letter = home.path().join("letter");
    fs::create_dir(&letter).unwrap();
    let all = told(&merged, &[second.clone(), first, third, letter, merged.clone()]);
    let expected = ["summary/part-00002.parquet: its SHA-256", "no run.json", "merged into", "seed: 43, and 42 in"];
    for words in expected {
        assert!(all.iter().any(|fault| fault.contains(words)), "`{words}` is not told: {all:#?}");
    }
    assert_eq!(all.len(), expected.len(), "{all:#?}");
}

/// Only the bytes of two files tell that they are damaged: their lengths and the documents are sound.
#[test]
fn a_damaged_file_is_found_on_the_way_and_what_is_sound_is_merged() {
    let (home, [first, second], whole) = shared();
    let merged = home.path().join("merged");
    let parts = [first.clone(), second.clone()];
    let files = [first.join("summary/part-00002.parquet"), second.join("summary/part-00001.parquet")];
    let sound = files.clone().map(|file| fs::read(file).unwrap());
    let damage = || {
        for (file, sound) in files.iter().zip(&sound) {
            let mut bytes = sound.clone();
            bytes[40] ^= 1;
            fs::write(file, bytes).unwrap();
        }
    };
    damage();
    let told = merge_into(&merged, &parts, Mode::New).unwrap_err();
    let words = told.to_string();
    let Error::Shares(MergeFaults(damaged)) = told else { panic!("{words}") };
    assert_eq!(damaged.len(), 2, "{words}");
    assert!(words.contains("part-00001.parquet: its SHA-256") && words.contains("part-00002.parquet: its SHA-256"));
    let left = check(&merged, Depth::Bytes, &Checking::default()).unwrap();
    assert_eq!((left.state, left.to_grow), (State::Unfinished, vec![1, 2]));
    assert!(left.findings.is_empty(), "{:?}", left.findings);

    for (file, sound) in files.iter().zip(&sound) {
        fs::write(file, sound).unwrap();
    }
    assert_eq!(merge_into(&merged, &parts, Mode::Resume).unwrap().copied, 2);
    assert!(contents(&merged) == contents(&whole));

    // A whole run is not replaced by a damaged one.
    damage();
    assert_eq!(faults(merge_into(&merged, &parts, Mode::Overwrite).unwrap_err()).len(), 2);
    assert!(contents(&merged) == contents(&whole));
}

/// Nobody has closed the second share, though all its parts are there.
#[test]
fn a_share_without_its_end_and_an_empty_share_are_told() {
    let home = tempdir().unwrap();
    let parts = ["1-2", "2-2"].map(|name| home.path().join(name));
    grow_share(&parts[0], seven(), "1/2");
    let folder = share_of(&parts[1], seven(), "2/2", Mode::New).unwrap();
    folder.missing_shards().into_iter().for_each(|shard| _ = grow_shard(&folder, shard, 100_000));
    drop(folder);
    let left = told(&home.path().join("merged"), &parts);
    assert!(left.len() == 1 && left[0].contains("lacks its end: it is unfinished"), "{left:?}");
    let empty = share_of(&home.path().join("fifth"), seven(), "5/5", Mode::New).unwrap_err().to_string();
    assert!(empty.contains("at most 4 shards") && empty.contains("plants_per_part"), "{empty}");
    assert!(!home.path().join("fifth").exists());
}

#[test]
fn a_merge_is_not_resumed_with_another_run_nor_in_the_folder_of_a_share() {
    let (home, parts, _) = shared();
    let merged = home.path().join("merged");
    let mut other = seven();
    other.provenance.seed = 43;
    run(&merged, other);
    let refused = merge_into(&merged, &parts, Mode::Resume).unwrap_err().to_string();
    assert!(refused.contains("seed: 43 in the run, 42 now"), "{refused}");
    let third = home.path().join("third");
    grow_share(&third, seven(), "1/2");
    let refused = merge_into(&third, &parts, Mode::Resume).unwrap_err().to_string();
    assert!(refused.contains("shard: 1/2 in the run, the whole run now"), "{refused}");
}
