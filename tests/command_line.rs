//! The program as people and scripts use it: every verb, every exit code, the two streams.
//!
//! Only files, streams and exit codes are tested. Absent: damaged folders (`trouble`), destinations (`written`) and the
//! examples of `--help` (`examples_of_help`).

mod program;

use program::{data, grown, program as phytomer, run, write};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// A scenario of one fast plant, with these lines added.
fn scenario(folder: &Path, lines: &str) {
    let species = data("bush.toml");
    write(
        folder,
        "s.toml",
        &format!("name = \"s\"\nspecies = '{species}'\nplants = 2\nages = {{ until = 12 }}\n{lines}"),
    );
}

#[test]
fn grow_tells_what_a_person_wants_to_know() {
    let folder = tempdir().unwrap();
    let told = run(folder.path(), &["grow", &data("small.toml")]).ending(0);
    for word in
        ["12 plants", "living", "dead", "components", "records", "a second", "seed", "runs/small", "Next:", "duckdb"]
    {
        assert!(told.stdout.contains(word), "`{word}` is missing in\n{}", told.stdout);
    }
    assert!(told.stderr.is_empty(), "no progress where nobody looks: {}", told.stderr);
    for file in
        ["run.json", "datapackage.json", "views.sql", "records/part-00000.parquet", "meshes/plant-00007_age-0012.ply"]
    {
        assert!(folder.path().join("runs/small").join(file).is_file(), "{file}");
    }
}

#[test]
fn grow_json_has_the_same_figures() {
    let folder = tempdir().unwrap();
    let json = run(folder.path(), &["grow", &data("small.toml"), "--json", "--threads", "2"]).ending(0).json();
    assert_eq!((&json["status"], &json["plants"], &json["seed"]), (&"complete".into(), &12.into(), &7.into()));
    assert_eq!(json["rows"]["summary"], 12 * 4);
    assert_eq!(json["living"].as_u64().unwrap() + json["dead"].as_u64().unwrap(), 12);
    assert!(json["components_per_second"].as_f64().unwrap() > 0.0);
    if cfg!(target_os = "linux") {
        assert!(json["peak_memory_bytes"].as_u64().unwrap() > 1_000_000);
    }
}

#[test]
fn seed_plants_out_and_name_override_the_scenario() {
    let folder = tempdir().unwrap();
    let words = ["grow", &data("small.toml"), "--seed", "99", "--plants", "8", "--out", "a/b"];
    run(folder.path(), &words).ending(0);
    let held = run(folder.path(), &["describe", "a/b", "--json"]).ending(0).json();
    assert_eq!((&held["seed"], &held["plants"]), (&99.into(), &8.into()));
    run(folder.path(), &["grow", &data("small.toml"), "--name", "x/../y"]).ending(0);
    assert!(folder.path().join("runs/x-..-y/run.json").is_file());
}

#[test]
fn a_folder_that_is_taken_is_kept_unless_told_otherwise() {
    let folder = grown();
    let refused = run(folder.path(), &["grow", &data("small.toml")]).ending(1);
    assert!(refused.stderr.contains("--resume") && refused.stderr.contains("--overwrite"), "{}", refused.stderr);
    run(folder.path(), &["grow", &data("small.toml"), "--overwrite", "--quiet"]).ending(0);
    fs::create_dir(folder.path().join("mine")).unwrap();
    write(folder.path(), "mine/letter.txt", "dear");
    run(folder.path(), &["grow", &data("small.toml"), "--overwrite", "--out", "mine"]).ending(1);
    assert_eq!(fs::read_to_string(folder.path().join("mine/letter.txt")).unwrap(), "dear");
}

#[test]
fn dry_run_foretells_and_writes_nothing() {
    let folder = tempdir().unwrap();
    let json = run(folder.path(), &["grow", "example1", "--dry-run", "--json"]).ending(0).json();
    assert!(json["expected"]["components"].as_f64().unwrap() > 0.0 && json["free_bytes"].is_u64());
    let told = run(folder.path(), &["grow", "gmt1", "--dry-run"]).ending(0);
    assert!(told.stdout.contains("records") && told.stdout.contains("nothing was written"), "{}", told.stdout);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_plant_at_its_limit_is_recorded_and_the_run_goes_on() {
    let folder = tempdir().unwrap();
    scenario(folder.path(), "limits = { max_components = 100 }\noutput = { plants_per_part = 1 }\n");
    let faults = run(folder.path(), &["grow", "s.toml"]).ending(3);
    assert!(faults.stderr.contains("explodes"), "{}", faults.stderr);
    // A limit between the expectation and the largest plant.
    scenario(folder.path(), "limits = { max_components = 300 }\nseed = 3\n");
    fs::write(
        folder.path().join("s.toml"),
        fs::read_to_string(folder.path().join("s.toml")).unwrap().replace("plants = 2", "plants = 60"),
    )
    .unwrap();
    let limited = run(folder.path(), &["grow", "s.toml"]).ending(1);
    assert!(limited.stderr.contains("limit"), "{}", limited.stderr);
    let held = run(folder.path(), &["describe", "runs/s", "--json"]).ending(0).json();
    let overgrown = held["overgrown"].as_array().unwrap().len();
    assert!((1..60).contains(&overgrown), "{overgrown} plants came to the limit");
    assert_eq!(held["living"].as_u64().unwrap() + held["dead"].as_u64().unwrap(), 60);
}

#[test]
fn bad_input_ends_with_3_and_all_faults() {
    let folder = tempdir().unwrap();
    scenario(folder.path(), "seeed = 1\ntables = [\"recods\"]\n");
    for words in [["grow", "s.toml"], ["validate", "s.toml"], ["describe", "s.toml"]] {
        let told = run(folder.path(), &words).ending(3);
        assert!(
            told.stdout.is_empty() && told.stderr.contains("seed") && told.stderr.contains("2 faults"),
            "{}",
            told.stderr
        );
    }
    let json = run(folder.path(), &["grow", "s.toml", "--json"]).ending(3).json();
    assert_eq!(json["faults"].as_array().unwrap().len(), 2);
    assert!(!folder.path().join("runs").exists());
}

#[test]
fn unknown_names_get_the_nearest_spelling() {
    let folder = tempdir().unwrap();
    for (words, meant) in [
        (["grow", "coffe"], "coffee"),
        (["describe", "frangipany"], "frangipani"),
        (["describe", "poplar_30"], "poplar_30y"),
        (["validate", "gmt1/5q"], "gmt1/5"),
        (["grow", "massart"], "halle/massart"),
    ] {
        let told = run(folder.path(), &words).ending(3);
        assert!(told.stderr.contains("did you mean") && told.stderr.contains(meant), "{words:?}: {}", told.stderr);
    }
    for (words, meant) in
        [(["gro", "coffee"], "grow"), (["list", "specis"], "species"), (["schema", "scenaro"], "scenario")]
    {
        let told = run(folder.path(), &words).ending(2);
        assert!(told.stderr.contains(meant), "{words:?}: {}", told.stderr);
    }
}

#[test]
fn misuse_ends_with_2() {
    let folder = grown();
    for words in [
        vec!["grow"],
        vec!["grow", "coffee", "--threads", "0"],
        vec!["grow", "coffee", "--resume", "--overwrite"],
        vec!["grow", "small", "--plants", "many"],
        vec!["mesh", "runs/small", "--plant", "12", "--out", "m.ply"],
        vec!["mesh", "runs/small", "--age", "25", "--out", "m.ply"],
    ] {
        let told = run(folder.path(), &words).ending(2);
        assert!(told.stdout.is_empty() && !told.stderr.is_empty());
    }
    assert!(!folder.path().join("m.ply").exists());
}

#[test]
fn init_writes_what_runs_and_overwrites_nothing() {
    let folder = tempdir().unwrap();
    run(folder.path(), &["init", "mine"]).ending(0);
    run(folder.path(), &["validate", "mine/scenario.toml", "mine/species.toml"]).ending(0);
    let species = fs::read_to_string(folder.path().join("mine/species.toml")).unwrap();
    assert!(species.starts_with("#:schema ./species.schema.json\n"));
    for kind in ["species", "scenario"] {
        let schema = run(folder.path(), &["schema", kind]).ending(0);
        let written = fs::read_to_string(folder.path().join(format!("mine/{kind}.schema.json"))).unwrap();
        assert_eq!(schema.stdout, written);
        schema.json();
    }
    let json = run(folder.path(), &["grow", "mine/scenario.toml", "--plants", "3", "--json"]).ending(0).json();
    assert_eq!(json["plants"], 3);
    write(folder.path(), "mine/species.toml", "mine");
    fs::remove_file(folder.path().join("mine/scenario.toml")).unwrap();
    run(folder.path(), &["init", "mine"]).ending(2);
    assert!(!folder.path().join("mine/scenario.toml").exists());
    assert_eq!(fs::read_to_string(folder.path().join("mine/species.toml")).unwrap(), "mine");
}

#[test]
fn describe_knows_runs_scenarios_and_species() {
    let folder = grown();
    let held = run(folder.path(), &["describe", "small"]).ending(0).stdout;
    for word in ["a complete run", "12:", "records", "seed", "bush", "meshes"] {
        assert!(held.contains(word), "`{word}` is missing in\n{held}");
    }
    let json = run(folder.path(), &["describe", "runs/small", "--json"]).ending(0).json();
    assert_eq!((&json["kind"], &json["tables"]["summary"]["rows"]), (&"run".into(), &48.into()));
    assert_eq!(json["meshes"]["files"], 4);
    let species = run(folder.path(), &["describe", &data("bush.toml")]).ending(0).stdout;
    assert!(species.contains("order 3") && species.contains("robusta"), "{species}");
    let scenario = run(folder.path(), &["describe", &data("small.toml"), "--json"]).ending(0).json();
    assert_eq!(scenario["kind"], "scenario");
    assert_eq!(run(folder.path(), &["describe", "gmt1/5a", "--json"]).ending(0).json()["kind"], "species");
}

#[test]
fn a_mesh_is_that_of_the_run() {
    let folder = grown();
    let words = ["mesh", "runs/small", "--plant", "7", "--age", "12", "--out", "seven.ply"];
    run(folder.path(), &words).ending(0);
    let (alone, of_run) =
        (folder.path().join("seven.ply"), folder.path().join("runs/small/meshes/plant-00007_age-0012.ply"));
    assert_eq!(program::sha256(&alone), program::sha256(&of_run));
    // For a plant that bends: the last plant of its part, grown in the memory of the plants before it.
    run(folder.path(), &["grow", &data("bending.toml"), "--quiet"]).ending(0);
    run(folder.path(), &["mesh", "runs/bending", "--plant", "11", "--out", "eleven.ply"]).ending(0);
    let of_run = folder.path().join("runs/bending/meshes/plant-00011_age-0020.ply");
    assert_eq!(program::sha256(&folder.path().join("eleven.ply")), program::sha256(&of_run));
    run(folder.path(), &["mesh", "runs/small", "--out", "no/such/folder.ply"]).ending(1);
}

#[test]
fn a_calm_moves_nothing_and_a_wind_moves_vertices_alone() {
    let folder = tempdir().unwrap();
    let bending = data("bending.toml");
    let mesh = |out: &str, more: &[&str]| {
        let words = [&["mesh", &bending, "--age", "12", "--out", out][..], more].concat();
        run(folder.path(), &words).ending(0);
        fs::read(folder.path().join(out)).unwrap()
    };
    let still = mesh("still.ply", &[]);
    assert_eq!(still, mesh("calm.ply", &["--wind", "0", "--time", "3"]));
    let frame =
        |out: &str, towards: &str, time: &str| mesh(out, &["--wind", "8", "--wind-towards", towards, "--time", time]);
    let blown = frame("blown.ply", "90", "0.40");
    assert_eq!(blown, frame("again.ply", "90", "0.40"));
    let header = |ply: &[u8]| {
        let end = ply.windows(11).position(|words| words == b"end_header\n").unwrap();
        String::from_utf8(ply[..end].to_vec()).unwrap()
    };
    for other in [&blown, &frame("turned.ply", "-90", "0.40"), &frame("later.ply", "90", "1.60")] {
        assert_eq!((header(&still), still.len()), (header(other), other.len()), "as many vertices and faces");
        assert_ne!(&still, other);
    }
    assert_ne!(blown, frame("turned.ply", "-90", "0.40"));
    assert_eq!(frame("start.ply", "90", "0"), frame("round.ply", "90", "8"), "the motion repeats with the gusts");
}

#[test]
fn wind_that_can_move_nothing_is_refused_with_words() {
    let folder = tempdir().unwrap();
    let wind = |name: &str, more: &[&str], code: i32| {
        let words = [&["mesh", name, "--out", "m.ply"][..], more].concat();
        run(folder.path(), &words).ending(code).stderr
    };
    let told = wind("coffee", &["--wind", "8"], 2);
    for word in ["coffee", "no wood that bends", "`[wood]`", "list woods", "inherits"] {
        assert!(told.contains(word), "`{word}` is missing in {told}");
    }
    assert!(wind("gmt1", &["--wind", "8"], 2).contains("only `buds`"));
    let species =
        format!("name = \"heavy\"\ninherits = '{}'\n[wood]\ndrag = {{ c = 0, n = 0 }}\n", data("sallow.toml"));
    write(folder.path(), "heavy.toml", &species);
    write(folder.path(), "s.toml", "name = \"s\"\nspecies = \"heavy.toml\"\nplants = 1\nages = { until = 4 }\n");
    let told = wind("s.toml", &["--wind", "8"], 2);
    assert!(told.contains("heavy.toml") && told.contains("drag"), "{told}");
    assert!(wind("s.toml", &["--wind", "-1"], 2).contains("from 0 to 100"));
    assert!(wind("s.toml", &["--wind", "8", "--time", "soon"], 2).contains("a number is expected"));
    assert!(wind("s.toml", &["--time", "1"], 2).contains("--wind"));
    assert!(!folder.path().join("m.ply").exists());
    wind("s.toml", &["--wind", "0"], 0);
}

#[test]
fn describe_tells_the_wood() {
    let folder = tempdir().unwrap();
    let told = run(folder.path(), &["describe", &data("sallow.toml")]).ending(0).stdout;
    assert!(told.contains("dimension, start 1") && told.contains("GPa, 900 kg/m³, it bends"), "{told}");
    assert!(told.contains("rule pipe, mm2_per_leaf 0.8"), "{told}");
    run(folder.path(), &["init", "mine"]).ending(0);
    let told = run(folder.path(), &["describe", "mine/species.toml"]).ending(0).stdout;
    assert!(told.contains("like birch, 9.9 GPa, 900 kg/m³, it bends"), "{told}");
    let told = run(folder.path(), &["describe", &data("bush.toml")]).ending(0).stdout;
    assert!(!told.contains("wood"), "{told}");
}

#[test]
fn meshes_per_plant_and_per_age_hold_every_scene() {
    let folder = tempdir().unwrap();
    for (per, parts, files) in [
        ("plant", 1, vec!["plant-00000.ply", "plant-00001.ply"]),
        ("age", 2, vec!["age-0006.ply", "age-0012.ply"]),
        (
            "age",
            1,
            vec![
                "age-0006_part-00000.ply",
                "age-0006_part-00001.ply",
                "age-0012_part-00000.ply",
                "age-0012_part-00001.ply",
            ],
        ),
    ] {
        let meshes = format!("[meshes]\nages = [6, 12]\nplants = \"all\"\nper = \"{per}\"\n");
        scenario(folder.path(), &format!("output = {{ plants_per_part = {parts} }}\n{meshes}"));
        run(folder.path(), &["grow", "s.toml", "--overwrite", "--quiet"]).ending(0);
        let found = fs::read_dir(folder.path().join("runs/s/meshes")).unwrap().map(|file| file.unwrap().file_name());
        let mut found: Vec<String> = found.map(|name| name.to_string_lossy().into_owned()).collect();
        found.sort();
        assert_eq!(found, files);
    }
}

#[test]
fn lists_have_everything_that_ships() {
    let folder = tempdir().unwrap();
    let all = run(folder.path(), &["list", "--json"]).ending(0).json();
    for (list, name) in [
        ("scenarios", "coffee"),
        ("species", "gmt1/5a"),
        ("models", "halle/massart"),
        ("growth-models", "buds"),
        ("woods", "scots_pine"),
        ("kinds", "apical_bud"),
    ] {
        let names: Vec<_> = all[list].as_array().unwrap().iter().map(|entry| entry["name"].as_str().unwrap()).collect();
        assert!(names.contains(&name), "{name} is not in {list}: {names:?}");
        let alone = run(folder.path(), &["list", list]).ending(0).stdout;
        assert!(alone.starts_with(list) && alone.contains(name), "{alone}");
    }
}

#[test]
fn validate_tells_of_each_file() {
    let folder = tempdir().unwrap();
    let json = run(folder.path(), &["validate", &data("small.toml"), &data("bush.toml"), "nothing", "--json"])
        .ending(3)
        .json();
    let kinds: Vec<_> = json["files"].as_array().unwrap().iter().map(|file| file["kind"].as_str()).collect();
    assert_eq!(kinds, [Some("scenario"), Some("species"), None]);
}

#[test]
fn a_closed_pipe_is_no_failure() {
    let folder = tempdir().unwrap();
    let mut child =
        phytomer(folder.path(), &["schema", "species"]).stdout(std::process::Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert!(child.wait().unwrap().success());
}
