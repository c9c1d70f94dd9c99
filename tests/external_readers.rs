//! Independent readers of the files of a run: pyarrow, DuckDB and Polars for the tables, plyfile, trimesh, Open3D,
//! meshio and PyVista for the meshes; Pillow for pictures; lifelines, statsmodels and scipy for measures; numpy for
//! sensitivities; jsonschema for the schemas of species and scenarios, and taplo, which editors use for TOML, for the
//! line by which a file names its schema.
//!
//! They are installed in `.venv`, which `.ci/run` fills from `tests/readers/requirements.txt`; where they are missing
//! the tests skip and say so, but never in CI. `PHYTOMER_RUN` names a run folder to read beside the small one grown
//! here.

mod mixed;
#[path = "program/reading.rs"]
mod reading;

use reading::{absent, python, read};
use std::path::Path;
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A small plant with branches, leaves and dead wood, drawn with eight sides.
const SCENARIO: &str = r#"
name = "readers"
species = "frangipani"
plants = 3
seed = 7
ages = { until = 10, record = "all" }
meshes = { ages = [4, 10], plants = 1, sides = 8 }

[[experiment.factor]]
name = "site"
level = [{ name = "level" }, { name = "roofed", site = { plane = [{ point_m = [0, 0, 1], normal = [0, 0, 1] }] } }]
"#;

/// Mistakes in the files of `init`: the file, its right text, and the wrong text instead.
const MISTAKES: [(&str, &str, &str); 8] = [
    ("species.toml", "\npause = ", "\npauze = "),
    ("species.toml", "model = \"buds\"", "model = \"buts\""),
    ("species.toml", "per_node = 2", "per_node = -2"),
    ("species.toml", "share = 0.1 }", "share = 1.1 }"),
    ("species.toml", "ticks_per_year = 12", "ticks_per_year = 0"),
    ("scenario.toml", "spacing_m = ", "spacing = "),
    ("scenario.toml", "plants = 100", "plants = 0"),
    ("scenario.toml", "until = 48", "until = 65_536"),
];

/// Mistakes in numbers that may have a source: the good species, its right text, and the wrong text instead.
const SOURCED: [(&str, &str, &str); 7] = [
    ("gmt1_drawn", "diameter_ratio = { value = 0.7,", "diameter_ratio = { valeu = 0.7,"),
    ("gmt1_drawn", "h2_deg = { uniform = { min = -60, max = -45 }, assumed = true }", "h2_deg = -181"),
    ("gmt1_drawn", "r2 = { empirical = [0.65, 0.7, 0.72], source = \"a field book\" }", "r2 = 0"),
    ("gmt1_drawn", "levels = { value = 9,", "levels = { poisson = 9,"),
    (
        "gmt1_drawn",
        "ticks_per_year = { value = 1, assumed = true }",
        "ticks_per_year = { normal = { mean = 1, sd = 0 } }",
    ),
    ("sourced", "{ named = \"2/5\", ", "{ named = 0.4, "),
    ("sourced", "{ named = \"distichous\", assumed = true }", "{ nammed = \"distichous\", assumed = true }"),
];

/// Grows a scenario into the folder. Returns the path of the run.
fn grow(folder: &Path, scenario: &str) -> String {
    let run = folder.join("run").to_str().expect("a path in UTF-8").to_owned();
    phytomer(&["grow", "--quiet", "--out", &run, scenario]);
    run
}

/// The stdout of the program.
fn phytomer(words: &[&str]) -> Vec<u8> {
    let done = Command::new(env!("CARGO_BIN_EXE_phytomer")).args(words).output().expect("phytomer runs");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    done.stdout
}

/// The report of taplo on a TOML file; `None` where the file passes.
fn taplo(python: &Path, file: &Path) -> Option<String> {
    let done = Command::new(python.with_file_name("taplo"))
        .args(["check", "--no-auto-config", "--colors", "never"])
        .arg(file)
        .env_remove("TAPLO_CONFIG")
        .output()
        .expect("taplo runs");
    let told = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(done.status.success() != told.contains("error: "), "{}: {told}", file.display());
    (!done.status.success()).then_some(told)
}

#[test]
fn independent_readers_agree_on_a_small_run() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenario = folder.path().join("readers.toml");
    std::fs::write(&scenario, SCENARIO).expect("a scenario file");
    let run = grow(folder.path(), scenario.to_str().expect("a path in UTF-8"));
    read(&python, "tables.py", &[&run]);
    read(&python, "meshes.py", &[&run, "tubes"]);
}

#[test]
fn independent_readers_agree_on_plants_that_bend() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = grow(folder.path(), &format!("{ROOT}/tests/data/runs/bending.toml"));
    read(&python, "tables.py", &[&run]);
    read(&python, "meshes.py", &[&run]);
}

/// Rhizome, shoots and panicle: kinds of their own, each with its Plant Ontology term.
#[test]
fn independent_readers_agree_on_herbs_on_a_rhizome() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = grow(folder.path(), "meadow_grass");
    read(&python, "tables.py", &[&run]);
    read(&python, "meshes.py", &[&run]);
}

/// Three plants a plot, of two species and sown at three ticks.
#[test]
fn independent_readers_agree_on_plots_of_several_plants() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = folder.path().join("run");
    mixed::write(&run);
    read(&python, "tables.py", &[run.to_str().expect("a path in UTF-8")]);
}

/// Coffee trees under two sites: buds, axes and leaves that die, branches of several orders.
const MEASURED: &str = r#"
name = "measured"
species = "coffee"
plants = 14
seed = 16
ages = { until = 36, record = [12, 36] }

[[experiment.factor]]
name = "site"
level = [{ name = "level" }, { name = "roofed", site = { plane = [{ point_m = [0, 0, 0.9], normal = [0, 0, 1] }] } }]
"#;

/// Each measure against lifelines, statsmodels and scipy, which take the rows from DuckDB.
#[test]
fn independent_statisticians_agree_on_the_measures_of_a_run() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenario = folder.path().join("measured.toml");
    std::fs::write(&scenario, MEASURED).expect("a scenario file");
    let run = grow(folder.path(), scenario.to_str().expect("a path in UTF-8"));
    read(&python, "measures.py", &[env!("CARGO_BIN_EXE_phytomer"), &run]);
}

/// Ishigami's function.
fn ishigami(at: &[f64]) -> f64 {
    use phytomer::sim::math;
    let [x, y, z] = [0, 1, 2].map(|k| std::f64::consts::PI * (2.0 * at[k] - 1.0));
    let (first, second) = (math::sin(x), math::sin(y));
    first + 7.0 * second * second + 0.1 * z * z * z * z * first
}

#[test]
fn an_independent_statistician_agrees_on_sensitivities() {
    use phytomer::fits::sensitivity::{morris_design, morris_effects, sobol_design, sobol_indices};
    let Some(python) = python() else {
        return;
    };
    let ways = morris_design(3, 40, 7).expect("a design");
    let results: Vec<f64> = ways.iter().map(|own| ishigami(&own.at)).collect();
    let effects = morris_effects(&ways, &results, 7).into_iter();
    let effects =
        effects.map(|e| serde_json::json!({"size": e.size, "size_within": e.size_within, "spread": e.spread}));
    let points = sobol_design(3, 1024, 7).expect("a design");
    let values: Vec<f64> = points.iter().map(|own| ishigami(&own.at)).collect();
    let sobol = sobol_indices(3, &values, 7).expect("indices");
    let indices = sobol.indices.iter();
    let indices =
        indices.map(|i| serde_json::json!({"first": i.first, "total": i.total, "total_within": i.total_within}));
    let at = |design: &[phytomer::fits::sensitivity::Evaluation]| -> Vec<Vec<f64>> {
        design.iter().map(|own| own.at.clone()).collect()
    };
    let told = serde_json::json!({
        "factors": 3,
        "morris": {"at": at(&ways), "results": results, "effects": effects.collect::<Vec<_>>()},
        "sobol": {
            "at": at(&points), "results": values, "indices": indices.collect::<Vec<_>>(), "noise": sobol.noise,
        },
    });
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("told.json");
    std::fs::write(&file, told.to_string()).expect("the file is written");
    read(&python, "sensitivity.py", &[file.to_str().expect("a path in UTF-8")]);
}

#[test]
fn independent_readers_agree_on_the_mesh_of_a_plot() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let meshes = folder.path().join("meshes");
    std::fs::create_dir(&meshes).expect("a folder");
    let file = meshes.join("plot.ply").to_str().expect("a path in UTF-8").to_owned();
    phytomer(&["mesh", "under_a_roof", "--plot", "--age", "15", "--sides", "3", "--out", &file]);
    read(&python, "meshes.py", &[folder.path().to_str().expect("a path in UTF-8")]);
}

/// Pages of plants side by side, of one that bends and of one whose rules put internodes between others, decoded from
/// what `docs/view.md` says and held against the tables of their runs.
#[test]
fn an_independent_reader_reads_pages() {
    let Some(python) = python() else {
        return;
    };
    let bush = format!("{ROOT}/tests/data/runs");
    for (name, species, until, plants) in [
        ("bush", format!("{bush}/bush.toml"), 14, "0,1"),
        ("sallow", format!("{bush}/sallow.toml"), 8, "0"),
        ("topiary", "topiary/4".to_owned(), 9, "0"),
    ] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let scenario = format!(
            "name = \"{name}\"\nspecies = {species:?}\nplants = 2\nseed = 5\nspacing_m = 2\n\
             ages = {{ until = {until}, record = \"all\" }}\noutput = {{ mechanics = true }}\n"
        );
        let file = folder.path().join("scenario.toml");
        std::fs::write(&file, scenario).expect("a scenario file");
        let run = grow(folder.path(), file.to_str().expect("a path in UTF-8"));
        let page = folder.path().join("page.html").to_str().expect("a path in UTF-8").to_owned();
        for ages in [format!("0..{until}"), format!("0..{until}/0.25")] {
            phytomer(&["view", &run, "--plants", plants, "--ages", &ages, "--quiet", "--out", &page]);
            read(&python, "pages.py", &[&page, &run]);
        }
    }
}

#[test]
fn an_independent_reader_reads_pictures() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("picture.png").to_str().expect("a path in UTF-8").to_owned();
    for (kind, option) in [("opaque", &[][..]), ("transparent", &["--transparent"])] {
        let words = ["picture", "coffee", "--ages", "12,24", "--size", "400x300", "--out", &file];
        phytomer(&[&words[..], option].concat());
        read(&python, "pictures.py", &[&file, "400", "300", kind]);
    }
}

#[test]
fn independent_readers_agree_on_the_shipped_gmt1() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = grow(folder.path(), "gmt1");
    read(&python, "tables.py", &[&run]);
    read(&python, "meshes.py", &[&run, "tubes"]);
}

#[test]
fn an_independent_validator_accepts_every_shipped_file() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [species, scenario, forest, plan] = ["species", "scenario", "forest", "plan"].map(|kind| {
        let file = folder.path().join(kind).to_str().expect("a path in UTF-8").to_owned();
        std::fs::write(&file, phytomer(&["schema", kind])).expect("a schema");
        file
    });
    let [presets, page, court] = ["config/presets", "docs/forest.md", "docs/shade/court.toml"]
        .map(|path| Path::new(ROOT).join(path).display().to_string());
    read(&python, "schemas.py", &[&species, &scenario, &presets, &forest, &page, &plan, &court]);
}

/// Each mistake is reported where the file's first line names the schema, and passes without that line: so the schema
/// was found by the line alone.
#[test]
fn an_independent_editor_obeys_the_schema_line_of_init() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let init = folder.path().join("my_plant");
    phytomer(&["init", init.to_str().expect("a path in UTF-8")]);
    for name in ["species.toml", "scenario.toml"] {
        assert_eq!(taplo(&python, &init.join(name)), None, "{name} as init has written it");
    }
    for (name, right, wrong) in MISTAKES {
        let text = std::fs::read_to_string(init.join(name)).expect("a file of init");
        let (line, rest) = text.split_once('\n').expect("several lines");
        assert_eq!(line, format!("#:schema ./{}", name.replace(".toml", ".schema.json")));
        assert!(rest.contains(right), "{name} has no `{right}`");
        let mistaken = rest.replacen(right, wrong, 1);
        let file = init.join("mistaken.toml");
        std::fs::write(&file, format!("{line}\n{mistaken}")).expect("a copy");
        assert!(taplo(&python, &file).is_some(), "{name} with `{wrong}` passes");
        std::fs::write(&file, mistaken).expect("a copy");
        assert_eq!(taplo(&python, &file), None, "{name} with `{wrong}` and without its first line");
    }
}

/// Numbers with their source, assumed or drawn, pass in every model; wrong values do not.
#[test]
fn an_independent_editor_knows_numbers_with_their_source() {
    let Some(python) = python() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("species.schema.json"), phytomer(&["schema", "species"])).expect("a schema");
    let file = folder.path().join("species.toml");
    let told = |text: &str| {
        std::fs::write(&file, format!("#:schema ./species.schema.json\n{text}")).expect("a copy");
        taplo(&python, &file)
    };
    for (name, right, wrong) in SOURCED {
        let text = std::fs::read_to_string(format!("{ROOT}/config/tests/good/{name}.toml")).expect("a good species");
        assert_eq!(told(&text), None, "{name}");
        assert!(text.contains(right), "{name} has no `{right}`");
        assert!(told(&text.replacen(right, wrong, 1)).is_some(), "{name} with `{wrong}` passes");
    }
}

#[test]
fn independent_readers_agree_on_a_given_run() {
    let Some(run) = std::env::var_os("PHYTOMER_RUN") else {
        absent::skip("PHYTOMER_RUN names no run folder to read");
        return;
    };
    let Some(python) = python() else {
        return;
    };
    let run = run.to_str().expect("a path in UTF-8").to_owned();
    read(&python, "tables.py", &[&run]);
    read(&python, "meshes.py", &[&run]);
}
