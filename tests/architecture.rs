//! The 23 architectural models of Hallé, Oldeman & Tomlinson 1978: each shipped species of a model grows plants of its
//! model and of no other, and the qualifiers see which characters a plant lacks.
//!
//! The confusion matrix has a row for each shipped model, several plants each, and a column for each qualifier. Pairs
//! that cannot be distinguished are listed with their reasons, and `docs/architecture-models.md` shows the matrix
//! (`UPDATE_EXPECTED=1` writes it).

mod program;

use phytomer::analysis::architecture::{ARCHITECTURES, Characters, architecture};
use phytomer::architecture::{characters, faults};
use phytomer::config::{self, ArchitecturalModel, Resolved, presets, validate, validate_species};
use phytomer::run::seed_of;
use phytomer::sim::plant::{Kind, Origin};
use phytomer::sim::{Plot, grow};
use program::run as program;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Plants of each model, each from a seed of its own.
const PLANTS: u32 = 6;

/// Pairs of models: plants of the first also qualify for the second, for the given reason.
const COMPATIBLE: [(&str, &str, &str); 0] = [];

fn shipped(name: &str) -> Resolved {
    validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn plants_of(name: &str) -> Vec<Characters> {
    let resolved = shipped(name);
    characters(resolved.model.as_ref(), resolved.scenario.ages.until, PLANTS).unwrap()
}

/// How many plants of each shipped model qualify for each model.
fn matrix() -> Vec<(&'static str, Vec<usize>)> {
    let row = |model: ArchitecturalModel| {
        let plants = plants_of(&format!("halle/{}", model.word()));
        assert_eq!(plants.len(), PLANTS as usize, "{}: small plants", model.word());
        let qualify = |of: &phytomer::analysis::architecture::Architecture| {
            plants.iter().filter(|plant| of.qualify(plant).is_ok()).count()
        };
        (model.word(), ARCHITECTURES.iter().map(qualify).collect())
    };
    ArchitecturalModel::ALL.map(row).into()
}

#[test]
fn each_model_is_itself_and_no_other() {
    let matrix = matrix();
    let mut wrong = Vec::new();
    for (grown, qualified) in &matrix {
        for (model, &found) in ARCHITECTURES.iter().zip(qualified) {
            let compatible = COMPATIBLE.iter().any(|(plant, of, _)| plant == grown && *of == model.name);
            let expected = if *grown == model.name || compatible { PLANTS as usize } else { 0 };
            if found != expected {
                let lacks = plants_of(&format!("halle/{grown}")).iter().find_map(|plant| model.qualify(plant).err());
                wrong.push(format!("{found} of {PLANTS} plants of {grown} qualify for {}: {lacks:?}", model.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    shown_in_the_docs(&matrix);
}

/// The matrix of the docs is the tested matrix.
fn shown_in_the_docs(matrix: &[(&str, Vec<usize>)]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/architecture-models.md");
    let heads: Vec<&str> = ARCHITECTURES.iter().map(|model| &model.name[..model.name.len().min(5)]).collect();
    let mut table = format!("| | {} |\n|---{}|\n", heads.join(" | "), "|---".repeat(heads.len()));
    for (grown, qualified) in matrix {
        let cells: Vec<String> =
            qualified.iter().map(|n| if *n == 0 { "·".to_owned() } else { n.to_string() }).collect();
        table += &format!("| {grown} | {} |\n", cells.join(" | "));
    }
    let text = fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once("<!-- matrix -->\n").expect("a place for the matrix");
    let (shown, after) = rest.split_once("<!-- end -->").expect("an end of the matrix");
    if std::env::var_os("UPDATE_EXPECTED").is_some() {
        fs::write(&path, format!("{before}<!-- matrix -->\n{table}<!-- end -->{after}")).unwrap();
    } else {
        assert_eq!(shown, table, "{} shows another matrix", path.display());
    }
}

#[test]
fn the_program_has_one_list_of_models() {
    let words: Vec<&str> = ArchitecturalModel::ALL.iter().map(|model| model.word()).collect();
    let qualifiers: Vec<&str> = ARCHITECTURES.iter().map(|model| model.name).collect();
    assert_eq!(words, qualifiers);
    for word in words {
        let resolved = shipped(&format!("halle/{word}"));
        assert_eq!(resolved.species.about.architectural_model.map(ArchitecturalModel::word), Some(word));
        assert!(architecture(word).is_some());
    }
    let folder = presets(config::Kind::Species).iter().filter(|(name, _)| name.starts_with("halle/")).count();
    assert_eq!(folder, 23);
}

#[test]
fn every_shipped_species_is_of_the_model_that_it_names() {
    let (mut named, mut wrong) = (0, String::new());
    for (name, _) in presets(config::Kind::Species) {
        let species = validate_species(name, 100).unwrap_or_else(|report| panic!("{report}"));
        named += usize::from(species.species.about.architectural_model.is_some());
        let faults = faults(&species.species);
        if !faults.is_empty() {
            wrong += &species.report(faults).render(false);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(named >= 28, "only {named} species name their model");
}

/// Leeuwenberg's model without chance: with k relays a module there are (kⁿ − 1)/(k − 1) modules in n generations.
#[test]
fn modules_of_leeuwenberg_are_counted_by_generations() {
    let resolved = shipped("halle/leeuwenberg");
    let plot = grown(&resolved);
    let axes = &plot.plants[0].axes;
    for generations in 1..=6_u32 {
        // A module grows at one tick and flowers at the next, and its relays grow at the third.
        let modules = axes.birth.iter().filter(|birth| **birth < 2 * generations - 1).count();
        assert_eq!(modules, (3_usize.pow(generations) - 1) / 2, "{generations} generations");
    }
}

/// Koriba's model: the siblings of a fork are equal at birth, one is orthotropic for life and the others lie down.
#[test]
fn exactly_one_sibling_at_a_fork_of_koriba_becomes_the_trunk() {
    let resolved = shipped("halle/koriba");
    let plot = grown(&resolved);
    let until = resolved.scenario.ages.until;
    let rows = phytomer::outputs::rows::components_of(&plot, 0, until).unwrap();
    let trends = |axis: u32| -> Vec<f32> {
        rows.iter().filter(|row| row.axis_id == axis).filter_map(|row| row.trend_deg).collect()
    };
    let relays = rows.iter().filter(|row| row.kind == Kind::ApicalBud && row.origin == Origin::Relay);
    let mut forks: BTreeMap<(Option<u32>, u32), Vec<Vec<f32>>> = BTreeMap::new();
    for relay in relays {
        forks.entry((relay.bearing_axis_id, relay.birth_age)).or_default().push(trends(relay.axis_id));
    }
    let upright = |trends: &Vec<f32>| trends[0] == 0.0;
    // Two growth units show which kind of axis a module has become.
    let differentiated = |fork: &&Vec<Vec<f32>>| fork.iter().all(|trends| trends.len() >= 16 && upright(trends));
    let mut seen = 0;
    for fork in forks.values().filter(differentiated) {
        assert_eq!(fork.len(), 4);
        let lying = fork.iter().filter(|trends| trends.last() != Some(&0.0)).count();
        assert_eq!(lying, 3, "one goes on: {fork:?}");
        seen += 1;
    }
    assert!(seen >= 3, "{seen} forks");
}

fn grown(resolved: &Resolved) -> Plot<'_> {
    let mut plot = Plot::of_one(resolved.model.as_ref(), &seed_of(&resolved.scenario, 0));
    grow(&mut plot, resolved.scenario.ages.until, &mut ()).unwrap();
    plot
}

/// The purpose of each qualifier: a shipped model with one law changed lacks the character that the law makes. The
/// first entry is the model, the second the changed text of the species file, the third words of the missing character.
const CRIPPLED: [(&str, &str, &str); 23] = [
    ("holttum", "[[order]]\nflower = { terminal = 0 }", "ends in a flower"),
    ("corner", "[[order]]\nflower = { lateral = 0 }", "flowers are lateral"),
    ("tomlinson", "[[order]]\nreiteration = { probability = 0 }", "from the bases of others"),
    ("schoute", "[[order]]\napex = { fork = { axes = 3 } }", "into two equal axes"),
    ("chamberlain", "[[order]]\nrelay = { count = 2 }", "second relay"),
    ("mcclure", "[[order]]\nreiteration = { probability = 0 }", "from the bases of others"),
    ("leeuwenberg", "[[order]]\nrelay = { count = 1 }", "two relays or more"),
    (
        "koriba",
        "[[order]]\ntransition = [{ from = \"module\", to = \"branch\", probability = 0.3, sibling = \"others\" }]",
        "goes on as the trunk",
    ),
    ("prevost", "[[order]]\nrelay = { below = 0 }", "later than its branches and below them"),
    ("fagerlind", "[[order]]\n[[order]]\nflower = { terminal = 0 }", "branches end in flowers"),
    ("petit", "[[order]]\n[[order]]\ntrend = \"orthotropic\"", "branches are plagiotropic"),
    ("nozeran", "[[order]]\napex = { units = 9 }\nflower = { terminal = 1 }", "its modules are relayed"),
    ("aubreville", "[[order]]\n[[order]]\ntransition = []", "branch modules are relayed"),
    ("massart", "[[order]]\naxillary = { ramification = 0.4, pattern = \"diffuse\" }", "in tiers"),
    ("roux", "[[order]]\n[[order]]\napex = { units = 5 }", "long-lived"),
    ("cook", "[[order]]\n[[order]]\nshed_after = 1000", "shed whole"),
    (
        "scarrone",
        "[[order]]\nflower = { terminal = { expression = \"if(age < 18, 0, 1)\" } }",
        "does not end in a flower",
    ),
    ("stone", "[[order]]\n[[order]]\nrelay = { on = [] }", "are relayed"),
    ("rauh", "[[order]]\n[[order]]\nrelay = { on = [\"death\"] }", "no axis is relayed"),
    ("attims", "[[order]]\n[[order]]\ntrend = \"plagiotropic\"", "branches are orthotropic"),
    ("mangenot", "[[order]]\nrelay = { below = 9 }", "relayed from there"),
    ("champagnat", "[wood]\nmodulus_gpa = 300", "lowered past the horizontal"),
    ("troll", "[[order]]\nwood = { uprighting = { strain = 0 } }", "erected later"),
];

#[test]
fn a_species_with_one_law_changed_lacks_the_character_that_the_law_makes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("crippled.toml");
    let file = path.to_str().unwrap();
    let mut wrong = String::new();
    for (model, laws, lacks) in CRIPPLED {
        fs::write(&path, format!("inherits = \"halle/{model}\"\nname = \"crippled\"\n{laws}\n")).unwrap();
        let species = validate_species(file, 1).unwrap_or_else(|report| panic!("{model}: {}", report.render(false)));
        let faults = faults(&species.species);
        let told = faults.first().map_or(String::new(), |fault| fault.expected.clone());
        if !told.contains(lacks) {
            wrong += &format!("{model}: {lacks:?} is not in {told:?}\n");
        }
        assert!(
            faults.is_empty() || species.report(faults).render(false).contains("architectural_model = "),
            "{model}"
        );
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_species_by_itself_is_one_plant_at_the_age_at_which_it_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let grown = program(folder.path(), &["grow", "halle/massart", "--json"]).ending(0).json();
    let run_json: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("runs/halle-massart/run.json")).unwrap()).unwrap();
    let scenario = &run_json["resolved_scenario"]["scenario"];
    assert_eq!((&scenario["plants"], &scenario["species"]), (&1.into(), &"halle/massart".into()), "{grown}");
    let ages: Vec<_> = run_json["recorded_ages"].as_array().unwrap().iter().map(|age| age.as_u64().unwrap()).collect();
    assert_eq!(ages.last(), scenario["ages"]["until"].as_u64().as_ref());
    program(folder.path(), &["mesh", "halle/massart", "--out", "m.ply"]).ending(0);
    assert!(folder.path().join("m.ply").is_file());
    program(folder.path(), &["init", "mine"]).ending(0);
    program(folder.path(), &["grow", "mine/species.toml", "--quiet"]).ending(0);
}

/// `validate` grows a sample of a species that names its architectural model; `grow` does not.
#[test]
fn a_species_must_be_of_the_architectural_model_that_it_names() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("no_massart.toml"),
        "inherits = \"halle/rauh\"\nname = \"x\"\narchitectural_model = \"massart\"\n",
    )
    .unwrap();
    let told = program(folder.path(), &["validate", "no_massart.toml"]).ending(3);
    for part in ["no_massart.toml:3:23", "5 of 5 plants", "branches are plagiotropic", "of rauh"] {
        assert!(told.stderr.contains(part), "{part} is not in {}", told.stderr);
    }
    program(folder.path(), &["grow", "no_massart.toml", "--out", "grown", "--quiet"]).ending(0);
    let json = program(folder.path(), &["describe", "grown", "--json"]).ending(0).json();
    assert_eq!(json["architecture"], serde_json::json!({"plants": 1, "models": {"rauh": 1}}));
    assert!(program(folder.path(), &["describe", "grown"]).ending(0).stdout.contains("rauh (1), of 1 plant looked at"));
}
