//! Creation, journal, resuming and refusals of run folders, and equal bytes on any number of threads.
//!
//! A crash is simulated by its remains: torn lines, parts without an entry, files beside their names.

use super::*;
use crate::Table;
use crate::read::Run;
use crate::specimen::{grow_shard, plan, plot, run};
use crate::specimen_plots::{grow_missing, mixed_plan, run_mixed};
use phytomer_sim::grow;
use serde_json::Value;
use std::collections::BTreeMap;
use tempfile::tempdir;

/// Every file under a folder but `run.json`, which holds timings.
pub(super) fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for path in durable::files_in(folder).unwrap() {
        if path.is_dir() {
            all.extend(contents(&path).into_iter().map(|(name, bytes)| (path.join(name), bytes)));
        } else if path.file_name().unwrap() != "run.json" {
            all.insert(path.clone(), fs::read(&path).unwrap());
        }
    }
    all.into_iter().map(|(path, bytes)| (path.strip_prefix(folder).unwrap().to_path_buf(), bytes)).collect()
}

#[test]
fn a_run_folder_holds_what_it_says() {
    let home = tempdir().unwrap();
    let path = home.path().join("runs/sapling");
    let report = run(&path, plan(5, 2));
    assert_eq!(
        (report.living, report.dead, report.files.len()),
        (0, 5, 19),
        "six tables of three parts, and `treatments`"
    );
    let run = Run::open(&path).unwrap();
    assert!(run.is_complete());
    assert_eq!(run.rows().unwrap(), report.rows);
    assert_eq!(run.json()["seed"], 42);
    assert_eq!(run.json()["timings_s"]["growth"], 0.5);
    assert_eq!(run.json()["resolved_scenario"]["species"], "sapling");
    for file in &report.files {
        assert_eq!(durable::sync_and_hash(&path.join(&file.path)).unwrap(), (file.bytes, file.sha256.clone()));
    }
    let package: Value = serde_json::from_slice(&fs::read(path.join("datapackage.json")).unwrap()).unwrap();
    assert_eq!(package["name"], "sapling");
    assert_eq!(package["resources"][1]["path"][2], "records/part-00002.parquet");
    assert_eq!(package["resources"][1]["schema"]["fields"][12]["unit"], "m");
    let views = fs::read_to_string(path.join("views.sql")).unwrap();
    assert!(views.contains("MACRO at_age(a) AS TABLE SELECT * FROM records_world"));
}

/// Two shards, the first with more rows than a row group holds.
#[test]
fn the_bytes_do_not_depend_on_the_number_of_threads() {
    let written = [1, 2, 7].map(|threads| {
        let home = tempdir().unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let report = pool.install(|| run(&home.path().join("run"), plan(1600, 1500)));
        assert!(report.files[1].rows > Some(crate::tables::ROW_GROUP as u64));
        contents(&home.path().join("run"))
    });
    assert_eq!(written[0], written[1]);
    assert_eq!(written[0], written[2]);
}

/// Three plants per plot, of two species and sown at three ticks: equal bytes on any number of threads, whether or not
/// the run was interrupted.
#[test]
fn plots_of_several_plants_are_checked_and_resumed_as_those_of_one() {
    let written = [1, 2, 7].map(|threads| {
        let home = tempdir().unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run_mixed(home.path(), mixed_plan(7, 2)));
        assert_eq!(check(home.path(), Depth::Bytes, &Checking::default()).unwrap().state, State::Complete);
        contents(home.path())
    });
    assert!(written[0] == written[1] && written[0] == written[2]);
    let home = tempdir().unwrap();
    run_mixed(home.path(), mixed_plan(7, 2));
    fs::remove_file(home.path().join("events/part-00001.parquet")).unwrap();
    fs::write(home.path().join("summary/part-00003.parquet"), b"cut").unwrap();
    let found = check(home.path(), Depth::Bytes, &Checking::default()).unwrap();
    assert_eq!((found.state, found.to_grow), (State::Damaged, vec![1, 3]));
    let folder = RunFolder::create(home.path(), mixed_plan(7, 2), Mode::Resume).unwrap();
    grow_missing(&folder);
    folder.finish(&[]).unwrap();
    drop(folder);
    assert!(contents(home.path()) == written[0]);
}

/// A mesh that was renamed but not entered, a mesh that was half written, and a file that does not belong to the run.
fn unentered_meshes(run: &Path) {
    fs::create_dir_all(run.join("meshes")).unwrap();
    for name in ["plant-00003_age-0012.ply", ".plant-00004_age-0012.ply.tmp", "notes.txt"] {
        fs::write(run.join("meshes").join(name), b"ply").unwrap();
    }
}

fn names_in(folder: &Path) -> Vec<String> {
    let files = durable::files_in(folder).unwrap();
    files.iter().map(|file| file.file_name().unwrap().to_string_lossy().into_owned()).collect()
}

#[test]
fn an_interrupted_run_ends_with_the_same_bytes() {
    let home = tempdir().unwrap();
    let (whole, broken) = (home.path().join("whole"), home.path().join("broken"));
    run(&whole, plan(7, 2));
    let folder = RunFolder::create(&broken, plan(7, 2), Mode::New).unwrap();
    grow_shard(&folder, 2, 100_000);
    grow_shard(&folder, 0, 100_000);
    // A shard that was renamed but not entered, a shard that was half written, and a torn line.
    fs::copy(broken.join("records/part-00000.parquet"), broken.join("records/part-00001.parquet")).unwrap();
    fs::write(broken.join("events/.part-00003.parquet.tmp"), b"half").unwrap();
    unentered_meshes(&broken);
    let journal = fs::OpenOptions::new().append(true).open(broken.join("journal.jsonl"));
    std::io::Write::write_all(&mut journal.unwrap(), b"{\"shard\":1,\"fil").unwrap();
    drop(folder);

    let folder = RunFolder::create(&broken, plan(7, 2), Mode::Resume).unwrap();
    assert_eq!(folder.missing_shards(), [1, 3]);
    assert!(!broken.join("records/part-00001.parquet").exists());
    assert!(!broken.join("events/.part-00003.parquet.tmp").exists());
    assert_eq!(names_in(&broken.join("meshes")), ["notes.txt"]);
    fs::remove_file(broken.join("meshes/notes.txt")).unwrap();
    assert!(matches!(folder.finish(&[]), Err(Error::MissingShards { missing: 2, .. })));
    for shard in folder.missing_shards() {
        grow_shard(&folder, shard, 100_000);
    }
    folder.finish(&[]).unwrap();
    drop(folder);
    assert_eq!(contents(&whole), contents(&broken));
    let again = RunFolder::create(&broken, plan(7, 2), Mode::Resume).unwrap();
    assert!(again.missing_shards().is_empty());
}

#[test]
fn a_shard_whose_file_is_lost_is_grown_again() {
    let home = tempdir().unwrap();
    run(home.path(), plan(4, 2));
    fs::remove_file(home.path().join("events/part-00001.parquet")).unwrap();
    let folder = RunFolder::create(home.path(), plan(4, 2), Mode::Resume).unwrap();
    assert_eq!(folder.missing_shards(), [1]);
    grow_shard(&folder, 1, 100_000);
    folder.finish(&[]).unwrap();
    assert_eq!(fs::read_to_string(home.path().join("journal.jsonl")).unwrap().lines().count(), 2);
}

#[test]
fn a_damaged_journal_costs_the_shards_of_its_damaged_lines_and_can_be_overwritten() {
    let home = tempdir().unwrap();
    run(home.path(), plan(4, 2));
    let journal = home.path().join("journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    let (first, second) = text.split_once('\n').unwrap();
    fs::write(&journal, format!("{}\n{second}", first.replacen("dead", "daed", 1))).unwrap();
    let folder = RunFolder::create(home.path(), plan(4, 2), Mode::Resume).unwrap();
    assert_eq!(folder.missing_shards(), [0]);
    let found = folder.found().unwrap();
    assert_eq!((found.state, found.to_grow.as_slice()), (State::Damaged, [0].as_slice()));
    assert_eq!(found.findings.len(), 1, "{found:?}");
    drop(folder);
    fs::write(&journal, "nonsense\n").unwrap();
    let folder = RunFolder::create(home.path(), plan(4, 2), Mode::Overwrite).unwrap();
    assert_eq!(folder.missing_shards(), [0, 1]);
    assert!(durable::files_in(&home.path().join("records")).unwrap().is_empty());
}

#[test]
fn a_check_that_is_told_to_stop_says_so_and_changes_nothing() {
    let home = tempdir().unwrap();
    run(home.path(), plan(4, 2));
    let before = contents(home.path());
    let checking = Checking::default();
    checking.stop();
    assert!(matches!(check(home.path(), Depth::Bytes, &checking), Err(Error::Stopped)));
    let opening = Opening { checking: &checking, space: Arc::new(SystemSpace), share: None };
    let stopped = RunFolder::open(home.path(), plan(4, 2), Mode::Resume, &opening);
    assert!(matches!(stopped, Err(Error::Stopped)), "{stopped:?}");
    assert_eq!(contents(home.path()), before);
    assert_eq!(check(home.path(), Depth::Bytes, &Checking::default()).unwrap().state, State::Complete);
}

/// A run of the first format is refused with its own message, and replaced by `Overwrite`.
#[test]
fn a_run_without_checks_is_told_kindly() {
    let home = tempdir().unwrap();
    run(home.path(), plan(2, 1));
    let file = home.path().join("run.json");
    let mut old: Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
    for key in ["check", "format_version", "fingerprint", "documents"] {
        old.as_object_mut().unwrap().remove(key);
    }
    fs::write(&file, serde_json::to_vec_pretty(&old).unwrap()).unwrap();
    fs::write(home.path().join("journal.jsonl"), "{\"shard\":0,\"files\":[]}\n").unwrap();
    let refused = RunFolder::create(home.path(), plan(2, 1), Mode::Resume).unwrap_err();
    assert!(refused.to_string().contains("format_version: nothing in the run, 2 now"), "{refused}");
    let checked = check(home.path(), Depth::Bytes, &Checking::default());
    assert!(matches!(checked, Err(Error::OlderFormat { .. })));
    assert!(Run::open(home.path()).unwrap().is_complete());
    RunFolder::create(home.path(), plan(2, 1), Mode::Overwrite).unwrap();
}

#[test]
fn a_run_json_that_is_lost_is_made_anew_for_the_same_run_alone() {
    let home = tempdir().unwrap();
    run(home.path(), plan(4, 2));
    let file = home.path().join("run.json");
    let text = fs::read_to_string(&file).unwrap();
    let mut other = plan(4, 2);
    other.provenance.seed = 43;
    for damaged in [None, Some(text.replace("\"seed\": 42", "\"seed\": 43"))] {
        match &damaged {
            None => fs::remove_file(&file).unwrap(),
            Some(text) => fs::write(&file, text).unwrap(),
        }
        assert!(Run::open(home.path()).is_err());
        assert_eq!(check(home.path(), Depth::Bytes, &Checking::default()).unwrap().state, State::Damaged);
        let refused = RunFolder::create(home.path(), other.clone(), Mode::Resume);
        assert!(matches!(refused, Err(Error::Unrecognised { .. })), "{refused:?}");
        let folder = RunFolder::create(home.path(), plan(4, 2), Mode::Resume).unwrap();
        assert!(folder.missing_shards().is_empty());
        folder.finish(&[("growth", 0.5)]).unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), text);
    }
}

#[test]
fn one_process_at_a_time_has_a_folder() {
    let home = tempdir().unwrap();
    let folder = RunFolder::create(home.path(), plan(2, 1), Mode::New).unwrap();
    grow_shard(&folder, 0, 100_000);
    let before = contents(home.path());
    for mode in [Mode::New, Mode::Resume, Mode::Overwrite] {
        let refused = RunFolder::create(home.path(), plan(2, 1), mode);
        assert!(matches!(refused, Err(Error::InProgress { .. })), "{refused:?}");
    }
    assert_eq!(contents(home.path()), before);
    let found = check(home.path(), Depth::Bytes, &Checking::default()).unwrap();
    assert_eq!((found.state, found.findings.len(), found.files), (State::InProgress, 0, 7));
    drop(folder);
    assert_eq!(check(home.path(), Depth::Bytes, &Checking::default()).unwrap().state, State::Unfinished);
    RunFolder::create(home.path(), plan(2, 1), Mode::Overwrite).unwrap();
}

#[test]
fn folders_that_are_not_this_run_are_left_alone() {
    let home = tempdir().unwrap();
    fs::write(home.path().join("letter.txt"), b"dear").unwrap();
    let mode = |mode| RunFolder::create(home.path(), plan(1, 1), mode).map(|_| ());
    assert!(matches!(mode(Mode::New), Err(Error::Occupied { .. })));
    assert!(matches!(mode(Mode::Resume), Err(Error::NotARun { .. })));
    assert!(matches!(mode(Mode::Overwrite), Err(Error::NotARun { .. })));
    let run_home = tempdir().unwrap();
    run(run_home.path(), plan(1, 1));
    let mut other = plan(1, 1);
    other.provenance.resolved["share"] = serde_json::json!(0.2);
    let error = RunFolder::create(run_home.path(), other, Mode::Resume).unwrap_err();
    assert!(error.to_string().ends_with("What differs:\n  share: 0.1 in the run, 0.2 now"), "{error}");
    let mut other = plan(1, 1);
    other.provenance.seed = 43;
    assert!(matches!(RunFolder::create(run_home.path(), other, Mode::Resume), Err(Error::Foreign { .. })));
}

#[test]
fn an_overwritten_run_leaves_what_is_not_its_own() {
    let home = tempdir().unwrap();
    run(home.path(), plan(3, 1));
    fs::write(home.path().join("notes.txt"), b"mine").unwrap();
    fs::write(home.path().join(".run.json.tmp"), b"half").unwrap();
    unentered_meshes(home.path());
    let folder = RunFolder::create(home.path(), plan(1, 1), Mode::Overwrite).unwrap();
    grow_shard(&folder, 0, 100_000);
    folder.finish(&[]).unwrap();
    assert!(home.path().join("notes.txt").exists());
    assert!(!home.path().join(".run.json.tmp").exists());
    assert_eq!(names_in(&home.path().join("meshes")), ["notes.txt"]);
    assert_eq!(Run::open(home.path()).unwrap().parts(Table::Records).unwrap().len(), 1);
}

#[test]
fn an_overgrown_plot_keeps_the_ages_before_its_limit() {
    let home = tempdir().unwrap();
    let folder = RunFolder::create(home.path(), plan(2, 1), Mode::New).unwrap();
    let report = grow_shard(&folder, 0, 40);
    let tick = report.overgrown[0].tick;
    assert_eq!(report.overgrown, [OvergrownPlot { plot: 0, plant: 0, tick, limit: 40, stopped: None }]);
    assert_eq!((report.living, report.dead), (1, 0));
    grow_shard(&folder, 1, 100_000);
    folder.finish(&[]).unwrap();
    let run = Run::open(home.path()).unwrap();
    assert_eq!(run.json()["overgrown"][0]["tick"], tick);
    let rows = run.summary().unwrap();
    let ages: Vec<u32> = rows.iter().filter(|row| row.plant_id == 0).map(|row| row.age).collect();
    let expected: Vec<u32> = plan(2, 1).recorded.into_iter().filter(|&recorded| recorded < tick).collect();
    assert_eq!(ages, expected);
}

#[test]
fn a_further_file_is_named_hashed_and_journalled() {
    let home = tempdir().unwrap();
    let folder = RunFolder::create(home.path(), plan(1, 1), Mode::New).unwrap();
    let mut shard = folder.shard(0).unwrap();
    let staged = shard.stage("meshes/plant-0.ply").unwrap();
    fs::write(&staged, b"ply").unwrap();
    let mut plot = plot(0, 100_000);
    let ending = grow(&mut plot, 12, &mut shard).unwrap();
    shard.end_plot(&plot, ending).unwrap();
    let report = shard.commit().unwrap();
    assert_eq!(report.files[7].path, "meshes/plant-0.ply");
    assert_eq!(report.files[7].sha256, durable::sha256_of(b"ply"));
    assert!(home.path().join("meshes/plant-0.ply").exists() && !staged.exists());
    drop(folder);
    RunFolder::create(home.path(), plan(1, 1), Mode::Resume).unwrap();
    assert!(home.path().join("meshes/plant-0.ply").exists(), "the journal names it");
}

#[test]
fn an_unfinished_shard_is_not_committed_and_leaves_nothing() {
    let home = tempdir().unwrap();
    let folder = RunFolder::create(home.path(), plan(2, 2), Mode::New).unwrap();
    let mut shard = folder.shard(0).unwrap();
    let mut late = plot(1, 100_000);
    assert!(grow(&mut late, 12, &mut shard).is_err());
    let mut first = plot(0, 100_000);
    let ending = grow(&mut first, 12, &mut shard).unwrap();
    shard.end_plot(&first, ending).unwrap();
    assert!(matches!(shard.commit(), Err(Error::UnfinishedShard { ended: 1, plots: 2, .. })));
    assert!(durable::files_in(&home.path().join("records")).unwrap().is_empty());
    assert!(matches!(folder.shard(1), Err(Error::NoSuchShard { shard: 1, shards: 1 })));
}
