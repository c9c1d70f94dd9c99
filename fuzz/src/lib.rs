//! What is fuzzed: one function a target, which takes any bytes and must not panic, overflow, hang or ask for much
//! memory.
//!
//! A species and a scenario go the whole way of `phytomer grow`; a mesh is read as a form, a weather file as its days,
//! an L-system is grown with the files beside it (`lsystem`); a forest is read with its rasters (`forest`), a tree of
//! another program is converted, and plants of others are read and written (`exchange`); a script of the A-system is
//! run; the plan of a ground is checked; a run folder, one of whose files is replaced, is checked, read and resumed.
//! `fuzz_targets` hands these functions to libFuzzer, and `examples/fuzz` runs them on stable over broken copies of
//! what ships (`seeds`, `broken`). Absent: files that are right, which the tests have.

#![forbid(unsafe_code)]

pub mod broken;
mod documents;
mod exchange;
mod forest;
mod lsystem;
pub mod seeds;
mod several;

#[path = "../../config/weather/tests/answered/mod.rs"]
mod answered;
#[path = "../../tests/program/tried.rs"]
mod tried;

pub use exchange::exchange;
pub use lsystem::lsystem;
use phytomer::analysis::architecture::qualified;
use phytomer::analysis::population;
use phytomer::asystem::{Stage, Written};
use phytomer::config::{Resolved, validate, validate_species};
use phytomer::outputs::meshes::{OwnForms, check_form};
use phytomer::outputs::read::Run;
use phytomer::outputs::{Checking, Depth, Mode, State, Table, check};
use phytomer::run::{Progress, Settings, begin};
use phytomer_asystem::{Statement, Step};
use phytomer_peers::{Asked, convert};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tempfile::TempDir;

/// A species by itself is checked over this many ticks.
const UNTIL: u32 = 40;

/// The endings of files of trees of other programs.
pub const ENDINGS_OF_TREES: [&str; 3] = ["py", "xml", "json"];

/// A target: any bytes in, nothing out.
pub type Target = fn(&[u8]);

/// Every target by its name.
pub const TARGETS: [(&str, Target); 13] = [
    ("run_folder", run_folder),
    ("species", species),
    ("scenario", scenario),
    ("ply", ply),
    ("obj", obj),
    ("glb", glb),
    ("weather", weather),
    ("lsystem", lsystem),
    ("forest", forest),
    ("tree", tree),
    ("asystem", asystem),
    ("plan", plan),
    ("exchange", exchange),
];

/// A temporary folder, in memory where there is some: a disk would be waited for at each input.
pub fn folder() -> TempDir {
    let memory = Path::new("/dev/shm");
    let folder = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() };
    folder.expect("a temporary folder")
}

static HOME: OnceLock<PathBuf> = OnceLock::new();

/// Lays what ships and the good fixtures, which name one another, into a folder where the targets then write what they
/// try. Without it each process makes a temporary folder, which stays when a fuzzer ends the process.
pub fn lay_in(folder: &Path) {
    HOME.get_or_init(|| {
        seeds::lay(folder);
        folder.to_path_buf()
    });
}

fn home() -> &'static Path {
    HOME.get_or_init(|| {
        let folder = folder().keep();
        seeds::lay(&folder);
        folder
    })
}

/// A species file: checked by itself, and grown where it is right.
pub fn species(data: &[u8]) {
    let (file, scenario) = (home().join("mutant.toml"), home().join("scenario_of_mutant.toml"));
    fs::write(&file, data).expect("the species is written");
    match validate_species(&file.to_string_lossy(), UNTIL) {
        Err(report) => tried::assert_tells(&report),
        Ok(species) => {
            species.species.to_json().expect("a species that is right has its JSON");
            fs::write(&scenario, format!("species = 'mutant.toml'\n{}", tried::SCENARIO)).expect("a scenario");
            grow(&scenario);
        }
    }
}

/// A scenario file: checked, and grown where it is right.
pub fn scenario(data: &[u8]) {
    let file = home().join("mutant.toml");
    fs::write(&file, data).expect("the scenario is written");
    grow(&file);
}

/// What `phytomer grow` does, of few plants and ages.
fn grow(scenario: &Path) {
    let mut resolved = match validate(&scenario.to_string_lossy()) {
        Ok(resolved) => resolved,
        Err(report) => return tried::assert_tells(&report),
    };
    tried::cap(&mut resolved);
    let out = tempfile::tempdir_in(home()).expect("a folder");
    let outcome = tried::grown(&resolved, &out.path().join("run"));
    assert!(!outcome.is_interrupted());
}

/// The file of a forest with its rasters.
pub fn forest(data: &[u8]) {
    forest::read(home(), data);
}

/// A tree of another program, converted and checked as a species. The first byte tells the ending of its file.
pub fn tree(data: &[u8]) {
    let Some((&choice, content)) = data.split_first() else { return };
    let name = format!("tree.{}", ENDINGS_OF_TREES[usize::from(choice) % ENDINGS_OF_TREES.len()]);
    if let Ok(converted) = convert(&name, content, Asked::default()) {
        let file = home().join("converted.toml");
        fs::write(&file, converted.species).expect("the species is written");
        if let Err(report) = validate_species(&file.to_string_lossy(), UNTIL) {
            tried::assert_tells(&report);
        }
    }
}

/// A script of the A-system: checked, and run where its trees are small, into a folder beside which nothing appears.
pub fn asystem(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let steps = match phytomer::asystem::checked(&text) {
        Err(refused) => return assert!(!refused.faults.is_empty()),
        Ok(checked) => checked.steps,
    };
    let is_small = |step: &Step| match &step.statement {
        Statement::Create { level, .. } | Statement::Combine { level, .. } => *level <= 6,
        Statement::Animate { level, .. } => *level <= 2,
        Statement::Cont { on, steps } => !*on || steps.is_some_and(|steps| steps <= 2),
        _ => true,
    };
    if steps.len() > 40 || !steps.iter().all(is_small) {
        return;
    }
    let around = tempfile::tempdir_in(home()).expect("a folder");
    let mut stage = Stage::new(&around.path().join("out"));
    let mut last = Written::default();
    // A tree may be too far away for its growth; that is told.
    let _ = steps.iter().try_for_each(|step| stage.take(step).map(drop)).and_then(|()| stage.end(&mut last));
    let beside = fs::read_dir(around.path()).expect("a folder").filter_map(Result::ok);
    assert!(beside.map(|entry| entry.file_name()).all(|name| name == "out"), "a file outside of its folder");
}

/// The plan of a ground: checked with the species that it names. Growing them is what the target `species` does.
pub fn plan(data: &[u8]) {
    let file = home().join("mutant_plan.toml");
    fs::write(&file, data).expect("the plan is written");
    if let Err(report) = phytomer_config::plan::plan(&file.to_string_lossy()) {
        tried::assert_tells(&report);
    }
}

/// A PLY as a form.
pub fn ply(data: &[u8]) {
    form("form.ply", data);
}

/// An OBJ as a form.
pub fn obj(data: &[u8]) {
    form("form.obj", data);
}

/// A GLB as a form.
pub fn glb(data: &[u8]) {
    form("form.glb", data);
}

/// A weather file. The first byte tells its format, whether gaps are filled and whether it comes again.
pub fn weather(data: &[u8]) {
    answered::answer(data);
}

fn form(name: &str, data: &[u8]) {
    let checked = check_form(name, data);
    match OwnForms::read([(name, data)]) {
        Err(fault) => assert_eq!(checked, Err(fault)),
        Ok(forms) => {
            assert_eq!(checked, Ok(()));
            let share = forms.area_share(0).expect("a form");
            assert!(share >= 0.0, "an area of {share}");
        }
    }
}

/// The bit of a choice by which checks are made right again.
pub const SEALED: u8 = 0x80;
/// The bit of a choice by which a run is resumed, which takes ten times as long as to read it.
pub const RESUMED: u8 = 0x40;

/// A whole run of which files are replaced.
struct Base {
    resolved: Resolved,
    /// Its files by their paths in the run folder.
    files: Vec<(String, Vec<u8>)>,
}

fn base() -> &'static Base {
    static BASE: OnceLock<Base> = OnceLock::new();
    BASE.get_or_init(|| {
        let scenario = home().join("base.toml");
        fs::write(&scenario, seeds::BASE).expect("a scenario");
        let resolved =
            validate(&scenario.to_string_lossy()).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let folder = home().join("base");
        tried::grown(&resolved, &folder);
        Base { resolved, files: documents::read(&folder) }
    })
}

/// The files of the run folder that `run_folder` breaks, in its order.
pub fn files_of_a_run() -> &'static [(String, Vec<u8>)] {
    &base().files
}

/// A run folder one of whose files is replaced. The first byte tells which one, and whether the checks within that file
/// are made right again ([`SEALED`]) and the run is then resumed ([`RESUMED`]); the rest is the file.
pub fn run_folder(data: &[u8]) {
    let Base { resolved, files } = base();
    let Some((&choice, content)) = data.split_first() else { return };
    let replaced = usize::from(choice & !(SEALED | RESUMED)) % files.len();
    let home = tempfile::tempdir_in(home()).expect("a folder");
    let folder: PathBuf = home.path().join("run");
    for (place, (name, bytes)) in files.iter().enumerate() {
        let sealed = documents::sealed(name, content);
        let bytes = match place == replaced {
            true if choice & SEALED != 0 => &sealed,
            true => content,
            false => bytes,
        };
        documents::put(&folder, name, bytes);
    }
    read(&folder);
    if choice & RESUMED == 0 {
        return;
    }
    let settings = Settings { mode: Mode::Resume, threads: 1, ..Settings::in_folder(&folder) };
    let progress = Progress::default();
    if begin(resolved, &settings, &progress).and_then(|begun| begun.grow(&progress)).is_ok() {
        let found = check(&folder, Depth::Bytes, &Checking::default()).expect("a run that was resumed");
        assert_eq!(found.state, State::Complete, "{:?}", found.findings);
    }
}

/// Everything that reads a run back; an error is an answer.
fn read(folder: &Path) {
    for depth in [Depth::Lengths, Depth::Bytes] {
        let _ = check(folder, depth, &Checking::default());
    }
    let Ok(run) = Run::open(folder) else { return };
    let _ = (run.is_complete(), run.rows(), run.summary(), population(&run), qualified(&run, 2));
    for table in Table::ALL {
        let _ = (run.schema(table), run.metadata(table), run.parquet(table));
        if let Ok(batches) = run.batches(table) {
            batches.for_each(drop);
        }
    }
}
