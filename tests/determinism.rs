//! The same scenario gives the same bytes in every table and mesh: on any number of threads, and optimised or not.
//!
//! Known hashes (`tests/data/*.sha256`) are of a bush in its pose at rest, and of trees that bend in a wind, with the
//! columns of mechanics. Where a change of growth or of a format is intended,
//! `PHYTOMER_BLESS=1 cargo test --test determinism` writes new hashes. Where `PHYTOMER_INSTALLED` names the program of
//! the same sources in another profile (CI has that of the wheel, which is not optimised), that program writes the
//! bytes of the one that is tested, pictures too.

#[path = "program/absent.rs"]
mod absent;
mod program;

use phytomer::config::{Kind, Resolved, presets, validate};
use phytomer::run::{self, Program, Progress, Settings, seed_of};
use phytomer::sim::Plot;
use phytomer::sim::plant::ThreadBudget;
use program::{PROGRAM, data, hashes, program_at, run as phytomer, said, sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Trees of an L-system that draws, asks where it stands and is pruned.
const CUBE: &str = r#"
name = "cube"
species = "topiary/6"
plants = 30
ages = { until = 9, record = "all" }
output = { plants_per_part = 5 }
"#;

#[test]
fn one_two_and_seven_threads_write_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let grown = ["1", "2", "7"].map(|threads| {
        phytomer(folder.path(), &["grow", &data("small.toml"), "--threads", threads, "--name", threads]).ending(0);
        hashes(&folder.path().join("runs").join(threads))
    });
    assert_eq!(
        grown[0].len(),
        6 * 3 + 1 + 2 * 2,
        "six tables of three parts and the treatments, two plants at two ages"
    );
    assert_eq!(grown[0], grown[1]);
    assert_eq!(grown[0], grown[2]);
}

#[test]
fn plants_that_bend_are_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let grown = ["1", "2", "7"].map(|threads| {
        phytomer(folder.path(), &["grow", &data("bending.toml"), "--threads", threads, "--name", threads]).ending(0);
        hashes(&folder.path().join("runs").join(threads))
    });
    assert_eq!(
        grown[0].len(),
        6 * 3 + 1 + 2 * 2,
        "six tables of three parts and the treatments, two plants at two ages"
    );
    assert_eq!(grown[0], grown[1]);
    assert_eq!(grown[0], grown[2]);
}

#[test]
fn parametric_trees_are_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let grown = ["1", "2", "7"].map(|threads| {
        phytomer(folder.path(), &["grow", &data("clump.toml"), "--threads", threads, "--name", threads]).ending(0);
        hashes(&folder.path().join("runs").join(threads))
    });
    assert_eq!(grown[0].len(), 6 * 3 + 1 + 2, "six tables of three parts and the treatments, one plant at two ages");
    assert_eq!(grown[0], grown[1]);
    assert_eq!(grown[0], grown[2]);
}

/// One plant, with so many waiting axes that threads without a part of their own help to grow it.
#[test]
fn a_single_plant_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let grown = ["1", "2", "7"].map(|threads| {
        phytomer(folder.path(), &["grow", &data("large.toml"), "--threads", threads, "--name", threads]).ending(0);
        hashes(&folder.path().join("runs").join(threads))
    });
    assert_eq!(grown[0].len(), 5, "five tables of one part");
    assert!(most_waiting("large.toml") >= ThreadBudget::default().least_axes, "axes enough to be shared out");
    assert_eq!(grown[0], grown[1]);
    assert_eq!(grown[0], grown[2]);
}

/// The most axes of one order of the first plant of a scenario. Where each order bears the next, these wait at once.
fn most_waiting(name: &str) -> usize {
    let Resolved { scenario, model, .. } =
        validate(&data(name)).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let mut plot = Plot::of_one(model.as_ref(), &seed_of(&scenario, 0));
    plot.grow_to(scenario.ages.until).unwrap();
    let orders = &plot.plants[0].axes.order;
    (1..=4).map(|order| orders.iter().filter(|of| **of == order).count()).max().unwrap()
}

/// A shipped scenario with so many plants in parts of two, so that several threads have work.
fn shipped(folder: &Path, name: &str, plants: &str) -> BTreeMap<String, String> {
    let (_, text) = presets(Kind::Scenario).iter().find(|(known, _)| *known == name).unwrap();
    let text = text.split_once("[output]").map_or(*text, |(before, _)| before);
    // A scenario file called `coffee.toml` would be read as the species of that name.
    let file = folder.join(format!("{name}_in_parts.toml"));
    std::fs::write(&file, format!("{text}\n[output]\nplants_per_part = 2\n")).unwrap();
    let file = file.to_str().unwrap();
    let grown = ["1", "2", "7"].map(|threads| {
        let run = format!("{}-{threads}", name.replace('/', "-"));
        phytomer(folder, &["grow", file, "--plants", plants, "--threads", threads, "--name", &run]).ending(0);
        hashes(&folder.join("runs").join(run))
    });
    assert_eq!(grown[0], grown[1]);
    assert_eq!(grown[0], grown[2]);
    grown[0].clone()
}

#[test]
fn the_shipped_coffee_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        shipped(folder.path(), "coffee", "8").len(),
        6 * 4 + 1 + 2 * 4,
        "four parts, the table of treatments, two plants at four ages"
    );
}

#[test]
fn the_shipped_gmt1_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        shipped(folder.path(), "gmt1", "5").len(),
        6 * 3 + 1 + 1,
        "three parts, the table of treatments, one plant at its last age"
    );
}

/// A vine follows the clock around a house; its plants, and those of a plot, are the same on any number of threads.
#[test]
fn the_shipped_vine_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("greene")).unwrap();
    assert_eq!(shipped(folder.path(), "greene/vine", "5").len(), 6 * 3 + 1, "three parts, the table of treatments");
}

#[test]
fn plants_of_an_l_system_are_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.toml"), CUBE).unwrap();
    let grown = ["1", "2", "8"].map(|threads| {
        phytomer(folder.path(), &["grow", "cube.toml", "--threads", threads, "--name", threads]).ending(0);
        hashes(&folder.path().join("runs").join(threads))
    });
    assert_eq!(grown[0].len(), 6 * 6 + 1, "six tables of six parts and the treatments");
    assert_eq!(grown[0], grown[1]);
    assert_eq!(grown[0], grown[2]);
}

/// Two vines of a plot claim their voxels from one another.
#[test]
fn vines_that_share_a_house_are_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("greene")).unwrap();
    assert_eq!(shipped(folder.path(), "greene/vines", "4").len(), 6 * 2 + 1, "two parts, the table of treatments");
}

#[test]
fn another_seed_gives_other_plants() {
    let folder = tempfile::tempdir().unwrap();
    let grown = ["7", "8"].map(|seed| {
        phytomer(folder.path(), &["grow", &data("small.toml"), "--seed", seed, "--name", seed]).ending(0);
        hashes(&folder.path().join("runs").join(seed))
    });
    assert!(grown[0].iter().all(|(file, hash)| grown[1].get(file) != Some(hash)));
}

/// The program that is tested, and that of the same sources in another profile, with other features.
fn both_programs() -> Option<[PathBuf; 2]> {
    let Some(installed) = std::env::var_os("PHYTOMER_INSTALLED") else {
        assert!(!absent::in_ci(), "PHYTOMER_INSTALLED names no program of another profile");
        absent::skip("PHYTOMER_INSTALLED names no program of another profile");
        return None;
    };
    // A relative path is one from the folder of the manifest; the program runs in another.
    Some([PathBuf::from(PROGRAM), Path::new(env!("CARGO_MANIFEST_DIR")).join(installed)])
}

/// The scenarios of both, so that buds, bending wood, parametric trees, a vine and an L-system are compared.
#[test]
fn another_profile_writes_the_same_bytes() {
    let Some(programs) = both_programs() else { return };
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.toml"), CUBE).unwrap();
    let own = ["small.toml", "bending.toml", "clump.toml", "large.toml"].map(|name| (data(name), "2"));
    let others = [("cube.toml", "10"), ("gmt1", "5"), ("greene/vine", "5"), ("coffee", "4")];
    let others = others.map(|(name, plants)| (name.to_owned(), plants));
    for (scenario, plants) in own.into_iter().chain(others) {
        let [tested, installed] = programs.each_ref().map(|program| {
            let words = ["grow", &scenario, "--plants", plants, "--name", "run"];
            said(program_at(program, folder.path(), &words).output().unwrap()).ending(0);
            let run = folder.path().join("runs/run");
            let written = hashes(&run);
            std::fs::remove_dir_all(run).unwrap();
            written
        });
        assert!(!tested.is_empty(), "{scenario}");
        assert_eq!(tested, installed, "{scenario}");
    }
}

/// The tests are built with other features of third-party crates than the program that is installed
/// (`.ci/features`): no picture may tell, which are compressed.
#[test]
fn pictures_and_charts_are_the_same_in_any_build() {
    let Some(programs) = both_programs() else { return };
    let small = data("small.toml");
    let court = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/shade/court.toml");
    let lines = [
        "picture coffee --age 12 --size 90x120 --out coffee.png".to_owned(),
        "animate coffee --ages 6..12/3 --seconds 1 --fps 2 --size 60x80 --out coffee.apng --quiet".to_owned(),
        "mesh coffee --age 12 --lods 3 --cards --out coffee.glb".to_owned(),
        format!("shade {} --out hours --quiet", court.display()),
        format!("grow {small} --plants 2 --name run --quiet"),
        "report runs/run --plants 1 --figures figures --out report.html".to_owned(),
    ];
    let folders = programs.map(|program| {
        let folder = tempfile::tempdir().unwrap();
        for line in &lines {
            let words: Vec<&str> = line.split(' ').collect();
            said(program_at(&program, folder.path(), &words).output().unwrap()).ending(0);
        }
        folder
    });
    let [tested, installed] = folders.each_ref().map(|folder| files(folder.path()));
    let ends = |end: &str| tested.keys().filter(|name| name.ends_with(end)).count();
    assert!(ends(".apng") == 1 && ends(".glb") == 1 && ends(".svg") > 1 && ends(".png") > 2, "{:?}", tested.keys());
    assert_eq!(tested.keys().collect::<Vec<_>>(), installed.keys().collect::<Vec<_>>());
    for (name, hash) in &tested {
        assert_eq!(Some(hash), installed.get(name), "{name}");
    }
}

/// The hashes of all files below a folder but those of a run that tell of time and place.
fn files(folder: &Path) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for path in std::fs::read_dir(&next).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() && !path.ends_with("runs") {
                folders.push(path);
            } else if path.is_file() {
                found.insert(path.strip_prefix(folder).unwrap().display().to_string(), sha256(&path));
            }
        }
    }
    found
}

#[test]
fn a_bush_has_the_bytes_that_are_known() {
    writes_the_known_bytes("small");
}

#[test]
fn trees_that_bend_have_the_bytes_that_are_known() {
    writes_the_known_bytes("bending");
}

fn writes_the_known_bytes(name: &str) {
    let folder = tempfile::tempdir().unwrap();
    let resolved = validate(&data(&format!("{name}.toml"))).unwrap_or_else(|report| panic!("{}", report.render(false)));
    // The files name the program and its version; a fixed name keeps the hashes from changing with every commit.
    let maker = Program { version: "0".into(), git_hash: "0".into() };
    let settings = Settings { program: maker, threads: 2, ..Settings::in_folder(folder.path().join("run")) };
    run::run(&resolved, &settings, &Progress::default()).unwrap();
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/{name}.sha256"));
    let found = hashes(&settings.folder);
    if std::env::var_os("PHYTOMER_BLESS").is_some() {
        let lines: String = found.iter().map(|(file, hash)| format!("{hash}  {file}\n")).collect();
        std::fs::write(&golden, lines).unwrap();
    }
    let text = std::fs::read_to_string(&golden).unwrap();
    let lines = text.lines().filter_map(|line| line.split_once("  "));
    let known: BTreeMap<String, String> = lines.map(|(hash, file)| (file.to_owned(), hash.to_owned())).collect();
    assert_eq!(found, known);
}
