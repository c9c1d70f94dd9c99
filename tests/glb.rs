//! `mesh` into GLB and STL on the command line: what is written, by readers that know nothing of phytomer, and what is
//! told of what cannot be.
//!
//! The Khronos validator and three.js run on node; `.ci/run` installs both into `.venv/node` from
//! `tests/readers/package.json`. Where they are missing these tests skip and say so, but never in CI. Absent: accessors
//! byte by byte, which are tests of `phytomer-gltf`.

#[path = "program/absent.rs"]
mod absent;
mod program;

use program::{data, grown, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::tempdir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Plants with branches, leaves, flowers and dead wood.
const SCENARIO: &str = r#"
name = "lives"
species = "frangipani"
plants = 2
seed = 7
ages = { until = 10, record = "all" }
"#;

/// The folder of node's modules with the readers; `None`, with the reason printed, where there is none.
fn modules() -> Option<PathBuf> {
    let modules = Path::new(ROOT).join(".venv/node/node_modules");
    let node = Command::new("node").arg("--version").output();
    let reason = match node {
        Ok(_) if modules.join("three").is_dir() && modules.join("gltf-validator").is_dir() => return Some(modules),
        Ok(_) => format!("no three and gltf-validator in {}", modules.display()),
        Err(error) => format!("node: {error}"),
    };
    assert!(!absent::in_ci(), "CI must have the readers: {reason}");
    absent::skip(&format!("no readers of GLB here ({reason}); .ci/run installs them"));
    None
}

/// What the readers say of a file, and of a life at some ages of which PLY meshes are given.
fn read(modules: &Path, file: &Path, ages: &[String]) -> serde_json::Value {
    let done = Command::new("node")
        .arg(Path::new(ROOT).join("tests/readers/glb.mjs"))
        .arg(modules)
        .arg(file)
        .args(ages)
        .output()
        .expect("node runs");
    let told = format!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{}: {told}", file.display());
    serde_json::from_slice(&done.stdout).unwrap_or_else(|error| panic!("{error}: {told}"))
}

/// Each way to write a GLB file gives one that the validator has nothing to say of and three.js loads.
#[test]
fn every_glb_is_valid() {
    let Some(modules) = modules() else { return };
    let folder = tempdir().expect("a temporary folder");
    let bending = data("bending.toml");
    for (name, words, animations) in [
        ("full", vec!["coffee", "--age", "12"], 0),
        ("near", vec!["coffee", "--age", "18", "--tolerance", "2mm"], 0),
        ("seed", vec!["coffee", "--age", "0"], 0),
        ("levels", vec!["coffee", "--age", "18", "--lods", "4"], 0),
        ("cards", vec!["wp/quaking_aspen", "--lods", "3", "--cards"], 0),
        ("levels of nothing", vec!["coffee", "--age", "0", "--lods", "4"], 0),
        ("plot", vec!["under_a_roof", "--plot", "--age", "4", "--tolerance", "5mm"], 0),
        ("surfaces", vec!["borchert_slade", "--age", "5", "--tolerance", "2mm"], 0),
        ("surfaces that grow", vec!["borchert_slade", "--ages", "1..5", "--keys", "3"], 1),
        ("life", vec!["gmt1", "--ages", "0..8", "--keys", "4"], 1),
        ("plots", vec!["under_a_roof", "--plot", "--ages", "1..5", "--keys", "3", "--tolerance", "5mm"], 1),
        ("ranges", vec!["wp/quaking_aspen", "--range", "200", "--wind-data", "--bark", "0.5"], 0),
        ("sway of stems", vec!["wp/quaking_aspen", "--levels", "0-1", "--wind", "5", "--rig", "20"], 1),
        ("sway", vec![&bending, "--age", "12", "--wind", "8", "--rig", "20", "--tolerance", "2mm"], 1),
    ] {
        let file = format!("{name}.glb");
        run(folder.path(), &[&["mesh"], &words[..], &["--out", &file]].concat()).ending(0);
        let read = read(&modules, &folder.path().join(&file), &[]);
        assert_eq!(read["animations"].as_array().map(Vec::len), Some(animations), "{name}: {read}");
    }
}

/// Organs as instances stand where the PLY mesh of the same age has them, each once with its number.
#[test]
fn instances_are_the_organs_of_the_mesh() {
    let Some(modules) = modules() else { return };
    let folder = tempdir().expect("a temporary folder");
    for (name, words) in [
        ("coffee", &["coffee", "--age", "18", "--tolerance", "2mm"][..]),
        ("surfaces", &["borchert_slade", "--age", "5"]),
        ("between", &["coffee", "--age", "12.5"]),
        ("seed", &["coffee", "--age", "0"]),
        ("petals", &["dog_rose", "--tolerance", "2mm"]),
    ] {
        let [glb, ply] = ["glb", "ply"].map(|ending| format!("{name}.{ending}"));
        run(folder.path(), &[&["mesh"], words, &["--leaves", "instances", "--out", &glb]].concat()).ending(0);
        run(folder.path(), &[&["mesh"], words, &["--out", &ply]].concat()).ending(0);
        let still = format!("still={}", folder.path().join(&ply).display());
        let read = read(&modules, &folder.path().join(&glb), &[still]);
        // The petals of the rose are blades, which are wood.
        assert_eq!(read["instances"] == 0, ["seed", "petals"].contains(&name), "{name}: {read}");
    }
    let plot = ["mesh", "under_a_roof", "--plot", "--age", "4", "--tolerance", "5mm", "--leaves"];
    let count = |leaves: &str, name: &str| {
        run(folder.path(), &[&plot[..], &[leaves, "--out", name]].concat()).ending(0);
        fs::metadata(folder.path().join(name)).expect("a file").len()
    };
    let [merged, instances] = [count("merged", "merged.glb"), count("instances", "instances.glb")];
    assert!(instances < merged, "{instances} {merged}");
    assert!(read(&modules, &folder.path().join("instances.glb"), &[])["instances"].as_u64() > Some(50));
}

/// At five ages a life has the organs of the records and of the PLY meshes, each where it is there.
#[test]
fn a_life_has_the_organs_of_the_records() {
    let Some(modules) = modules() else { return };
    let python = Path::new(ROOT).join(".venv/bin/python");
    let folder = tempdir().expect("a temporary folder");
    let here = |words: &[&str]| run(folder.path(), words).ending(0).stdout;
    program::write(folder.path(), "lives.toml", SCENARIO);
    here(&["grow", "lives.toml", "--quiet"]);
    let told = here(&["mesh", "runs/lives", "--plant", "1", "--ages", "2..10/2", "--keys", "5", "--out", "life.glb"]);
    assert!(told.contains("5 keys in 12 s, wood within 1 mm, places to 0.0"), "{told}");
    let ages = ["2", "4", "6", "8", "10"].map(|age| {
        let name = format!("{age}.ply");
        here(&["mesh", "runs/lives", "--plant", "1", "--age", age, "--out", &name]);
        format!("{age}={}", folder.path().join(name).display())
    });
    let read = read(&modules, &folder.path().join("life.glb"), &ages);
    // The tables are read by what `external_readers` reads them with.
    if !python.is_file() {
        assert!(!absent::in_ci(), "CI must have {}", python.display());
        return absent::skip("no readers of tables here; .ci/run installs them");
    }
    let done = Command::new(python)
        .arg(Path::new(ROOT).join("tests/readers/lives.py"))
        .args([&folder.path().join("runs/lives").display().to_string(), "1", &read["counts"].to_string()])
        .output()
        .expect("python runs");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}

/// A rig of more joints is nearer to the full solution, and what it is off is told.
#[test]
fn a_rig_of_more_joints_is_nearer() {
    let folder = tempdir().expect("a temporary folder");
    let bending = data("bending.toml");
    let off = |joints: &str| {
        let words =
            ["mesh", &bending, "--age", "12", "--tolerance", "2mm", "--wind", "8", "--rig", joints, "--out", "r.glb"];
        let told = run(folder.path(), &words).ending(0).stdout;
        let off = told.split("at most ").nth(1).and_then(|rest| rest.split(" mm").next()).map(str::to_owned);
        off.and_then(|off| off.parse::<f64>().ok()).unwrap_or_else(|| panic!("{told}"))
    };
    let [few, more, many] = ["3", "20", "120"].map(off);
    assert!(few > more && more > many && many < 0.5 * few, "{few} {more} {many}");
}

#[test]
fn what_cannot_be_written_is_told_and_leaves_nothing() {
    let folder = grown();
    let before = fs::read_dir(folder.path()).expect("a folder").count();
    let bending = data("bending.toml");
    let small = ["mesh", "runs/small", "--plant", "7"];
    let blown = ["mesh", &bending, "--wind", "8"];
    for (words, more, out, told) in [
        (&small[..], &[][..], "m.gltf", "the formats that it has: PLY (.ply), GLB (.glb), STL (.stl), USD (.usdc)"),
        (&small, &["--ages", "1..12"], "m.ply", "--ages: PLY (.ply) holds a plant that stands still at one age"),
        (&small, &["--ages", "1..12"], "m.stl", "the formats that hold more: GLB (.glb), USD (.usdc)"),
        (&small, &["--ages", "1..12", "--keys", "5"], "m.usdc", "--keys: this is for a life as GLB"),
        (&small, &["--ages", "1..12", "--leaves", "instances"], "m.glb", "whose vertices move has its organs merged"),
        (&blown, &["--rig", "9", "--leaves", "instances"], "m.glb", "whose vertices move has its organs merged"),
        (&small, &["--leaves", "instances"], "m.ply", "--leaves: this is for USD and GLB"),
        (&small, &["--leaves", "merged"], "m.stl", "--leaves: this is for USD and GLB"),
        (&small, &["--leaf-normals", "crown", "--leaves", "instances"], "m.glb", "crown: instances show every leaf"),
        (&small, &["--leaves", "single"], "m.glb", "possible values: instances, merged"),
        (&small, &["--plot", "9"], "m.glb", "cannot be used with"),
        (&blown, &["--rig", "9", "--age", "3.5"], "m.glb", "a skeleton is that of a plant at a whole age"),
        (&blown[..2], &["--plot", "99999"], "m.glb", "--plot 99999: the run has the plots 0 to"),
        (&blown[..2], &["--plot", "0", "--triangles", "5"], "m.glb", "--triangles 5: plot 0 at tick"),
        (&blown, &["--rig", "9"], "m.usdc", "--rig: USD (.usdc) holds a plant that stands still at one age"),
        (&small, &["--ages", "1..99"], "m.glb", "99"),
        (&small, &["--ages", "9..9"], "m.glb", "--ages 9: a life has two ages at least"),
        (&small, &["--ages", "9..1"], "m.glb", "the first age, 9, is after the last, 1"),
        (&small, &["--ages", "1..12", "--keys", "1"], "m.glb", "1 is not in 2..=256"),
        (&small, &["--ages", "1..12", "--keys", "257"], "m.glb", "257 is not in 2..=256"),
        (&small, &["--keys", "5"], "m.glb", "--ages <FIRST..LAST[/STEP]>"),
        (&small, &["--ages", "1..12", "--seconds", "0"], "m.glb", "a length above 0"),
        (&small, &["--ages", "1..12", "--age", "3"], "m.glb", "cannot be used with"),
        (&small, &["--ages", "1..12", "--triangles", "9k"], "m.glb", "cannot be used with"),
        (&small, &["--rig", "9"], "m.glb", "--wind <M/S>"),
        (&small, &["--rig", "9", "--wind", "8"], "m.glb", "no wood that bends"),
        (&small, &["--rig", "9", "--wind", "0"], "m.glb", "a calm moves nothing"),
        (&blown, &["--rig", "0"], "m.glb", "0 is not in 2..=255"),
        (&blown, &["--rig", "256"], "m.glb", "256 is not in 2..=255"),
        (&blown, &["--rig", "9", "--time", "1"], "m.glb", "cannot be used with"),
        (&blown, &["--rig", "9", "--plot"], "m.glb", "cannot be used with"),
        (&blown, &["--rig", "9", "--age", "0"], "m.glb", "plant 0 at age 0 has no wood that a skeleton could follow"),
        (&blown, &["--rig", "9"], "m.ply", "--rig: PLY (.ply) holds a plant that stands still at one age"),
    ] {
        let said = run(folder.path(), &[words, more, &["--out", out]].concat()).ending(2);
        assert!(said.stderr.contains(told), "{more:?} {out}: {}", said.stderr);
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), before, "no file is left");
    if Path::new("/dev/full").exists() {
        for more in [&["--age", "12"][..], &["--ages", "1..12"]] {
            // A device has no ending, and so gets PLY; a link to it has one.
            #[cfg(unix)]
            let _ = std::os::unix::fs::symlink("/dev/full", folder.path().join("full.glb"));
            let said = run(folder.path(), &[&small[..], more, &["--out", "full.glb"]].concat()).ending(1);
            assert!(said.stderr.contains("cannot write full.glb"), "{more:?}: {}", said.stderr);
        }
    }
}
