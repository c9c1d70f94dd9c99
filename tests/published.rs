//! Published measures of the shipped species hold for grown plants, and `validate` reports where they do not.
//!
//! The sample is that of `phytomer::sample`: the default seed, means over the living plants. Absent: laws, whose fit to
//! measured counts is tested apart, and the look of plants.

mod program;

use phytomer::sample::compare;
use phytomer_config::{Kind, Model, presets, validate_species};
use phytomer_models::buds::BudModel;
use phytomer_models::buds::params::Reiteration;
use phytomer_models::fault::Path;
use phytomer_sim::Plot;
use phytomer_sim::plant::Seed;
use program::run;
use std::fs;
use tempfile::tempdir;

#[test]
fn grown_plants_of_every_shipped_species_lie_in_the_published_ranges() {
    let mut wrong = Vec::new();
    for (name, _) in presets(Kind::Species) {
        let species = validate_species(name, 1).unwrap_or_else(|report| panic!("{}", report.render(false))).species;
        for compared in compare(&species).unwrap_or_else(|faults| panic!("{name}: {faults:?}")) {
            let [least, most] = compared.range;
            let (measure, unit) = (compared.measure.name(), compared.measure.unit());
            let told =
                format!("{name}, age {}: {measure} {:.3}{unit} of {least} to {most}", compared.at_age, compared.found);
            println!("{told}");
            if !compared.fits() {
                wrong.push(told);
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A stem of one internode of 10 cm a tick, whose height is easily computed by hand.
fn stem(published: &str) -> String {
    format!(
        "name = \"stem\"\nmodel = \"buds\"\ntick = \"one year\"\n{published}\n[[order]]\ninternode = {{ length_cm = 10 }}\n"
    )
}

#[test]
fn validate_tells_where_a_sample_is_not_as_published() {
    let folder = tempdir().unwrap();
    let of = |published: &str, code: i32| {
        fs::write(folder.path().join("stem.toml"), stem(published)).unwrap();
        run(folder.path(), &["validate", "stem.toml"]).ending(code)
    };
    let row = "[[published]]\nat_age = 20\nsource = \"a flora\"\n";
    of(&format!("{row}height_m = [1.99, 2.01]\nleaves = [20, 20]\nliving = [1, 1]"), 0);
    let told = of(&format!("{row}height_m = [3, 4]"), 3).stderr;
    for words in ["height of 16 plants is 2.000 m on average at age 20", "3 to 4 m: a flora", "stem.toml:7:12"] {
        assert!(told.contains(words), "`{words}` is missing in\n{told}");
    }
    let told = of(&format!("{row}living = [0.4, 0.6]"), 3).stderr;
    assert!(told.contains("share that lives of 16 plants is 1.000 on average"), "{told}");
}

#[test]
fn a_law_that_does_not_reach_the_published_age_is_a_fault_of_the_law() {
    let folder = tempdir().unwrap();
    let published = "[[published]]\nat_age = 200\nheight_m = [1, 100]\nsource = \"a flora\"\n";
    let law = "death = { linear = { over = \"age\", start = 0, slope = 0.008 } }\n";
    fs::write(folder.path().join("stem.toml"), stem(published) + law).unwrap();
    let told = run(folder.path(), &["validate", "stem.toml"]).ending(3).stderr;
    assert!(told.contains("death"), "{told}");
}

/// The trunks alone, as they die by laws of their own: half of them die within the published range of years.
#[test]
fn stems_die_at_the_ages_that_are_told() {
    let told = [
        ("apple", 30.0, 60.0),
        ("aspen", 60.0, 100.0),
        ("coffee", 4.0, 7.0),
        ("corsican_pine", 150.0, 300.0),
        ("poplar", 40.0, 70.0),
        ("wild_cherry", 70.0, 100.0),
    ];
    for (name, least, most) in told {
        let species = validate_species(name, 1).unwrap_or_else(|report| panic!("{}", report.render(false))).species;
        let year = species.about.ticks_per_year.expect("a year").value();
        let Model::Buds(mut buds) = species.model else { panic!("{name}") };
        buds.order.truncate(1);
        // Their references are the light and the soil of these stems; some name orders that are cut.
        buds.response.clear();
        buds.order[0].reiteration = Reiteration::default();
        let until = (2.0 * most * year) as u32;
        let model = buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
        let mut ends: Vec<u32> = (0..201).map(|plant| end_of_stem(&model, plant, until)).collect();
        ends.sort_unstable();
        let median = f64::from(ends[100]) / year;
        println!("{name}: half of the stems are dead at {median} years");
        assert!((least..=most).contains(&median), "{name}: {median} years");
    }
}

fn end_of_stem(model: &BudModel, plant: u32, until: u32) -> u32 {
    let seed = Seed { plant, draws: plant.into(), run_seed: 1988, component_limit: u32::MAX, keep_events: false };
    let mut plot = Plot::of_one(model, &seed);
    plot.grow_to(until).expect("within the limit");
    plot.plants[0].axes.apex_end[0]
}
