//! The 23 architectural models of Hallé, Oldeman & Tomlinson 1978: each shipped one grows plants of its model and of no other,
//! and the qualifiers see what a plant lacks.
//!
//! The confusion matrix has a row a shipped model, several plants each, and a column a qualifier. Pairs that are not told
//! apart are listed with their reasons, and `docs/architecture-models.md` shows the matrix (`UPDATE_EXPECTED=1` writes it).

use phytomer::analysis::architecture::{ARCHITECTURES, Characters, architecture};
use phytomer::architecture::{characters, faults};
use phytomer::config::{ArchitecturalModel, Kind, Resolved, presets, validate};
use std::fs;
use std::path::Path;

/// Plants of each model, each from a seed of its own.
const PLANTS: u32 = 6;

/// Pairs of which plants of the first also qualify for the second, with the reason.
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
        assert_eq!(plants.len(), PLANTS as usize, "{}", model.word());
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

/// The matrix of the docs is this one.
fn shown_in_the_docs(matrix: &[(&str, Vec<usize>)]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/architecture-models.md");
    let heads: Vec<&str> = ARCHITECTURES.iter().map(|model| &model.name[..model.name.len().min(5)]).collect();
    let mut table = format!("| | {} |\n|---{}|\n", heads.join(" | "), "|---".repeat(heads.len()));
    for (grown, qualified) in matrix {
        let cells: Vec<String> = qualified.iter().map(|n| if *n == 0 { "·".to_owned() } else { n.to_string() }).collect();
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
    let folder = presets(Kind::Species).iter().filter(|(name, _)| name.starts_with("halle/")).count();
    assert_eq!(folder, 23);
}

#[test]
fn every_shipped_species_is_of_the_model_that_it_names() {
    let (mut named, mut wrong) = (0, String::new());
    for (name, _) in presets(Kind::Species) {
        let species = phytomer::config::validate_species(name, 100).unwrap_or_else(|report| panic!("{report}"));
        named += usize::from(species.species.about.architectural_model.is_some());
        let faults = faults(&species.species);
        if !faults.is_empty() {
            wrong += &species.report(faults).render(false);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(named >= 28, "only {named} species name their model");
}
