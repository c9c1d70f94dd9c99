//! What is broken: the species and scenarios that ship, the good and the bad fixtures of `config`, small meshes, small
//! weather files, trees of other programs, forests, and the files of a small run.
//!
//! Absent: a corpus that grows by coverage, which libFuzzer keeps by itself.

use super::answered::choice;
use super::{ENDINGS_OF_TREES, RESUMED, SEALED, files_of_a_run};
use phytomer::outputs::exchange::{FORMATS, Format};
use phytomer_weather::Format as WeatherFormat;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "../../config/tests/mutate/mod.rs"]
pub(crate) mod mutate;

/// The scenario of the run whose files are broken: every table, one mesh, two shards.
pub const BASE: &str = r#"
name = "base"
species = "coffee"
plants = 2
seed = 7
ages = { until = 6, record = { every = 3 } }
meshes = { sides = 3, plants = [1] }
output = { plants_per_part = 1 }
"#;

/// The folder of the project. This file is compiled both in the package `fuzz` and in the example of that name.
fn project() -> PathBuf {
    let mut around = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    around.find(|folder| folder.join("config/tests/good").is_dir()).expect("the project").to_path_buf()
}

/// Lays what ships and the good fixtures into a folder, where a broken file finds them beside it.
pub fn lay(folder: &Path) {
    mutate::corpus(&project().join("config/tests/good"), folder);
}

/// The seeds of a target, in an order that is always the same.
pub fn of(target: &str) -> Vec<Vec<u8>> {
    match target {
        "run_folder" => of_run_folder(),
        "species" | "scenario" => of_config(target == "scenario"),
        "weather" => of_weather(),
        "lsystem" => of_lsystems(),
        "tree" => of_trees(),
        "asystem" => of_folder(&project().join("docs/asystem"), "asys"),
        "plan" => of_plans(),
        "exchange" => of_exchange(),
        ending => of_folder(&project().join("fuzz/seeds"), ending),
    }
}

/// The contents of the files in a folder that end so, sorted by their names.
fn of_folder(folder: &Path, ending: &str) -> Vec<Vec<u8>> {
    paths(folder, ending).iter().map(|path| fs::read(path).expect("a seed")).collect()
}

/// The files in a folder that end so, sorted by their names.
fn paths(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of seeds");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|is| is == ending));
    paths.sort();
    paths
}

/// The L-systems that ship, each with its view file, and those of the folder of seeds, which hold what no shipped file
/// has: files beside, a species with shapes and an environment, a ring.
fn of_lsystems() -> Vec<Vec<u8>> {
    let mut seeds = of_folder(&project().join("fuzz/seeds"), "lsystem");
    let folders = ["topiary", "abop"].map(|name| project().join("config/presets/species").join(name));
    for path in folders.iter().flat_map(|folder| paths(folder, "l")) {
        let read = |ending: &str| fs::read_to_string(path.with_extension(ending)).unwrap_or_default();
        let (text, view) = (read("l"), read("v"));
        seeds.push(format!("=== plant.l\n{text}=== plant.v\n{view}=== kinds\nA apical_bud\n").into_bytes());
    }
    seeds
}

/// The trees of other programs that the tests of their readers have, each by the ending of its file.
fn of_trees() -> Vec<Vec<u8>> {
    let folder = project().join("config/peers/tests/data");
    let of = |(place, ending)| of_folder(&folder, ending).into_iter().map(move |file| [&[place], &*file].concat());
    (0..).zip(ENDINGS_OF_TREES).flat_map(of).collect()
}

/// The files that the tests of weather have, each by its format.
fn of_weather() -> Vec<Vec<u8>> {
    let endings = [
        ("WTH", WeatherFormat::Dssat),
        ("AgMIP", WeatherFormat::Agmip),
        ("met", WeatherFormat::Apsim),
        ("csv", WeatherFormat::Csv),
    ];
    let folder = project().join("config/weather/tests/data");
    let of =
        |(ending, format)| of_folder(&folder, ending).into_iter().map(move |file| [&[choice(format)], &*file].concat());
    endings.into_iter().flat_map(of).collect()
}

/// A small plant in each format, which its ending names.
fn of_exchange() -> Vec<Vec<u8>> {
    let folder = project().join("fuzz/seeds");
    let of = |(place, format): (u8, &dyn Format)| {
        of_folder(&folder, format.word()).into_iter().map(move |file| [&[place], &*file].concat())
    };
    (0..).zip(FORMATS).filter(|(_, format)| format.reads()).flat_map(of).collect()
}

/// The court that the documentation has, and those of the folder of seeds, with keys that the court leaves out.
fn of_plans() -> Vec<Vec<u8>> {
    [of_folder(&project().join("docs/shade"), "toml"), of_folder(&project().join("fuzz/seeds"), "plan")].concat()
}

/// Scenarios name a species or state ages; all else is a species.
fn of_config(scenarios: bool) -> Vec<Vec<u8>> {
    let home = tempfile::tempdir().expect("a folder");
    let mut files = mutate::corpus(&project().join("config/tests/good"), home.path());
    let bad = of_folder(&project().join("config/tests/bad"), "toml");
    files.extend(bad.into_iter().map(|text| (String::new(), text)));
    let is_scenario = |text: &[u8]| {
        text.split(|byte| *byte == b'\n').any(|line| line.starts_with(b"species") || line.starts_with(b"ages"))
    };
    files.into_iter().map(|(_, text)| text).filter(|text| is_scenario(text) == scenarios).collect()
}

/// Each file of a run: one in four to be resumed, documents also with checks made right again. And a `run.json` of a
/// program that wrote no checks.
fn of_run_folder() -> Vec<Vec<u8>> {
    let mut seeds = Vec::new();
    for (place, (name, bytes)) in files_of_a_run().iter().enumerate() {
        let place = u8::try_from(place).expect("few files");
        let is_sealed = name == "run.json" || name == "journal.jsonl";
        let bits = if is_sealed { [0, SEALED, SEALED, SEALED | RESUMED] } else { [0, 0, 0, RESUMED] };
        seeds.extend(bits.map(|bits| [&[place | bits], bytes.as_slice()].concat()));
        if name == "run.json" {
            seeds.push([&[place], unsealed(bytes).as_slice()].concat());
        }
    }
    seeds
}

/// Without its check and the version of its format.
fn unsealed(document: &[u8]) -> Vec<u8> {
    let is_kept = |line: &&[u8]| !line.starts_with(b"  \"check\"") && !line.starts_with(b"  \"format_version\"");
    let lines: Vec<&[u8]> = document.split_inclusive(|byte| *byte == b'\n').filter(is_kept).collect();
    String::from_utf8_lossy(&lines.concat()).trim_end().replace(",\n}", "\n}").into_bytes()
}
