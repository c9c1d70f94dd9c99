//! A checked scenario: its defaults, ages and texts, and its resolved form, which reads back as an equal scenario.
//!
//! Also species and scenarios from texts in memory, and the reports for programs. Absent: faults of files
//! (`fixtures.rs`).

use std::fs;

use phytomer_config::scenario::{DEFAULT_SEED, Table};
use phytomer_config::{Kind, Model, Origin, Species, kind_of, schema_of, validate, validate_species, validate_texts};

#[test]
fn a_minimal_scenario_has_its_defaults() {
    let run = validate("tests/good/scenario_minimal.toml").expect("it is right");
    let scenario = &run.scenario;
    assert_eq!(scenario.seed, DEFAULT_SEED);
    assert_eq!(scenario.ages.recorded(), (1..=10).collect::<Vec<_>>());
    assert_eq!(scenario.tables.len(), 7);
    assert_eq!(scenario.limits.max_components, 50_000_000);
    assert!(scenario.mesh_ages().is_empty() && !scenario.draws(0));
    assert_eq!(run.expected_components(10), Some(10.0 + 10.0 + 1.0), "ten internodes, ten leaves, a bud");
    assert_eq!(run.model.habit().looks.internodes.len(), 1);
}

#[test]
fn a_full_scenario_says_what_it_writes() {
    let run = validate("tests/good/scenario_full.toml").expect("it is right");
    let scenario = &run.scenario;
    assert_eq!(scenario.ages.recorded(), [10, 15, 20, 25, 30, 35, 40]);
    assert_eq!(scenario.mesh_ages(), [10, 20, 40]);
    assert!(scenario.draws(999) && !scenario.draws(2));
    assert!(scenario.tables.contains(&Table::Records) && !scenario.tables.contains(&Table::Events));
}

/// A species has one year, stated by itself or by its season.
#[test]
fn the_year_of_a_season_is_that_of_its_species() {
    for (name, ticks) in [("states", Some(4.0)), ("sourced", Some(12.0)), ("minimal_species", None)] {
        let species = validate_species(&format!("tests/good/{name}.toml"), 40).expect("it is right").species;
        assert_eq!(species.ticks_per_year(), ticks, "{name}");
    }
}

#[test]
fn every_file_read_is_kept_for_provenance() {
    let species = validate_species("tests/good/child.toml", 40).expect("it is right");
    let names: Vec<&str> = species.sources.iter().map(|source| source.name.as_str()).collect();
    assert_eq!(names, ["tests/good/child.toml", "tests/good/coffee_like.toml"]);
    for source in species.sources.iter() {
        assert!(matches!(source.origin, Origin::File(_)));
        assert_eq!(&*source.text, fs::read_to_string(&source.name).expect("the file"));
    }
}

/// The texts of a scenario, of a species and of its ancestor, none of which is on the disk.
#[test]
fn texts_in_memory_are_read_as_files_are() {
    let text = |name: &str| fs::read_to_string(format!("tests/good/{name}.toml")).expect("the file");
    let (child, parent) = (text("child"), text("coffee_like"));
    let scenario = "name = \"trial\"\nspecies = \"child\"\nplants = 1\nages = { until = 12 }\n";
    let texts = [("trial", scenario), ("child", child.as_str()), ("coffee_like.toml", parent.as_str())];
    let resolved = validate_texts("trial", &texts).expect("it is right");
    let file = validate_species("tests/good/child.toml", 40).expect("it is right");
    let json = |species: &Species| species.to_json().expect("a species as JSON");
    assert_eq!(json(&resolved.species), json(&file.species));
    let sources: Vec<(&str, &Origin)> = resolved.sources.iter().map(|s| (s.name.as_str(), &s.origin)).collect();
    let own = ["trial", "child", "coffee_like.toml"].map(|name| (name, Origin::Memory(name.to_owned())));
    assert_eq!(sources, own.each_ref().map(|(name, origin)| (*name, origin)));
    let alone = validate_texts("child", &texts).expect("a species is one plant of it");
    assert_eq!((alone.scenario.plants, json(&alone.species)), (1, json(&file.species)));
    let shipped = validate_texts("coffee", &[]).expect("a preset");
    assert_eq!(shipped.scenario, validate("coffee").expect("a preset").scenario);
}

/// Texts in memory name other texts and presets; a path leads nowhere.
#[test]
fn texts_in_memory_read_no_file_and_faults_name_them() {
    let faults = |species: &str, own: &str| {
        let scenario = format!("name = \"trial\"\nspecies = \"{species}\"\nplants = 1\nages = {{ until = 12 }}\n");
        let report = validate_texts("trial", &[("trial", &scenario), ("own", own)]).expect_err("it is wrong");
        report.render(false)
    };
    let told = faults("tests/good/child.toml", "");
    assert!(told.contains("there is no species `tests/good/child.toml`") && told.contains("trial:2:"), "{told}");
    let told = faults("owm", "");
    assert!(told.contains("a text in memory, or of a shipped species") && told.contains("`own`"), "{told}");
    assert!(faults("own", "inherits = \"own\"").contains("`own` inherits from itself"));
    let told = faults("own", "inherits = \"coffee\"\n\n[[order]]\npause = 2\n");
    assert!(told.contains("own:4:"), "{told}");
    let told = faults("own", "inherits = \"coffee\"\n\n[[order]]\nleaf.form = { mesh = \"leaf.ply\" }\n");
    assert!(told.contains("a species in memory names the file `leaf.ply`"), "{told}");
}

#[test]
fn inheritance_is_resolved_by_order() {
    let species = validate_species("tests/good/child.toml", 40).expect("it is right").species;
    assert_eq!(species.about.name, "coffee_child");
    assert_eq!(species.about.scientific_name.as_deref(), Some("Coffea canephora"));
    let Model::Buds(buds) = species.model else { panic!("a species of the bud model") };
    assert_eq!(buds.order.len(), 3);
    let json = serde_json::to_value(&buds.order).expect("orders as JSON");
    assert_eq!(json[0]["pause"], 0.1, "the nearer [every_order] wins over the farther [[order]]");
    assert_eq!(json[0]["insertion_deg"], 0.0, "the parent's own order wins over its [every_order]");
    assert_eq!(json[1]["death"]["weibull"]["shape"], 2.0, "a law is replaced whole");
    assert!(json[1]["death"].get("robusta").is_none());
    assert_eq!(json[1]["flower"]["per_node"], 4, "a table merges");
    assert_eq!(json[2]["insertion_deg"], 60.0, "a new order starts from the parent's [every_order]");
}

#[test]
fn the_resolved_form_reads_back_as_itself() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["scenario_full", "scenario_lists", "scenario_states", "scenario_site"] {
        let run = validate(&format!("tests/good/{name}.toml")).expect("it is right");
        let species = folder.path().join("species.toml");
        fs::write(&species, run.species_toml().expect("TOML")).expect("written");
        let read = validate_species(&species.to_string_lossy(), 40).unwrap_or_else(|r| panic!("{}", r.render(false)));
        assert_eq!(read.species, run.species);
        let scenario = folder.path().join("scenario.toml");
        let text = run.scenario_toml().expect("TOML");
        fs::write(&scenario, text.replace(&format!("{:?}", run.scenario.species), "\"species\"")).expect("written");
        let read = validate(&scenario.to_string_lossy()).unwrap_or_else(|r| panic!("{}", r.render(false)));
        assert_eq!(read.scenario.ages, run.scenario.ages);
        assert_eq!(read.to_json().expect("JSON")["species"], run.to_json().expect("JSON")["species"]);
        assert_eq!(read.scenario.seed, run.scenario.seed);
    }
}

#[test]
fn faults_are_data_too() {
    let report = validate_species("tests/bad/key_misspelt.toml", 40).expect_err("it is wrong");
    let json = serde_json::to_value(report.records()).expect("JSON");
    assert_eq!(json[0]["file"], "tests/bad/key_misspelt.toml");
    assert_eq!((&json[0]["line"], &json[0]["column"]), (&6.into(), &1.into()));
    assert_eq!(json[0]["path"], "order[0].deth");
    assert_eq!(json[0]["problem"], "unknown key `deth`");
    assert_eq!(json[0]["suggestion"], "death");
    assert_eq!(report.to_string(), "3 faults in 1 file");
}

#[test]
fn a_file_tells_its_kind() {
    assert_eq!(kind_of("tests/good/child.toml"), Kind::Species);
    assert_eq!(kind_of("tests/good/scenario_minimal.toml"), Kind::Scenario);
    assert_eq!(kind_of("gmt1/5a"), Kind::Species);
}

#[test]
fn a_preset_is_found_by_its_name_and_by_a_near_one() {
    assert!(validate_species("gmt1/5a", 10).is_ok());
    let report = validate_species("gmt1/5z", 10).expect_err("there is none");
    assert_eq!(report.faults[0].suggestion.as_deref(), Some("gmt1/5a"));
    assert!(report.render(false).starts_with("error: there is no species `gmt1/5z`"));
}

#[test]
fn color_is_for_terminals_only() {
    let report = validate_species("tests/bad/key_misspelt.toml", 40).expect_err("it is wrong");
    assert!(report.render(true).contains('\u{1b}') && !report.render(false).contains('\u{1b}'));
}

#[test]
fn the_schemas_for_editors_are_of_draft_7() {
    for kind in [Kind::Species, Kind::Scenario] {
        let schema = schema_of(kind);
        assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
        assert!(!schema.to_string().contains("\"null\""), "TOML has no null");
    }
    let forms = schema_of(Kind::Species)["anyOf"].as_array().map(Vec::len);
    assert_eq!(forms, Some(phytomer_config::MODELS.len()));
}

#[test]
fn a_row_of_table_1_is_shown_at_its_growth_level() {
    for (row, level) in [("gmt1/5g", 9), ("gmt1/6a", 10), ("gmt1/7d", 10)] {
        let species = validate_species(row, 100).expect("it is right");
        assert_eq!(species.shown_at(), level + 1, "{row}: age 1 is growth level 0");
    }
}
