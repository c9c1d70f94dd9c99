//! The records of a plant up to an age do not depend on how long the run lasts: for every shipped species, every good
//! fixture and the species of the whole-program tests.
//!
//! This clause is part of the contract of growth models. Absent: conditions on a single run.

#[path = "../../tests/program/side_by_side.rs"]
mod side_by_side;

use std::fs;
use std::path::Path;

use phytomer_config::{Kind, Model, kind_of, presets, validate_species};
use phytomer_models::contract::{seed_of, sown, the_length_of_the_run_leaves_no_trace};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::Seed;
use side_by_side::each;
use std::sync::Arc;

/// The last compared age, where plants stay small enough: past the life of most herbs, in ticks.
const LAST: Tick = 72;
/// The largest number of components of a compared plant.
const MOST: u32 = 6_000;

/// Every species: the shipped ones, and those in the folders of fixtures.
fn species() -> Vec<(String, Model)> {
    let mut names: Vec<String> = presets(Kind::Species).iter().map(|(name, _)| (*name).to_owned()).collect();
    for folder in ["tests/good", "../tests/data/runs"] {
        let entries = fs::read_dir(Path::new(folder)).expect("the folder of fixtures");
        let paths = entries.map(|entry| entry.expect("an entry").path().to_string_lossy().replace('\\', "/"));
        names.extend(paths.filter(|path| path.ends_with(".toml") && kind_of(path) == Kind::Species));
    }
    names.sort();
    let read = |name: String| {
        let found = validate_species(&name, 1).unwrap_or_else(|report| panic!("{name}\n{}", report.render(false)));
        (name, found.species.model)
    };
    names.into_iter().map(read).collect()
}

fn stays_small(model: &dyn GrowthModel, age: Tick) -> bool {
    (0..2).all(|number| sown(model, &Seed { component_limit: MOST, ..seed_of(5, number) }).grow_to(age).is_ok())
}

/// The largest age that is compared, with the model compiled for it.
fn compiled(name: &str, species: &Model) -> (Tick, Arc<dyn GrowthModel>) {
    let mut age = LAST;
    loop {
        match species.compile(age) {
            Ok(model) if stays_small(model.as_ref(), age) => return (age, model),
            // A tree of stems without a law of growth is whole, and large, from its first tick.
            Ok(model) if age == 2 && matches!(species, Model::Parametric(_)) => return (age, model),
            _ => age = age * 3 / 4,
        }
        assert!(age > 1, "{name} grows for some ticks");
    }
}

#[test]
fn every_species_grows_alike_in_runs_of_any_length() {
    let all = species();
    assert!(all.len() > 70, "{} species", all.len());
    each(all, |(name, species)| {
        let (age, short) = compiled(&name, &species);
        // A law may be refused for a longer run, as a table that ends is.
        let longer = [age + 1, age + 11, 3 * age + 5].into_iter().filter_map(|until| species.compile(until).ok());
        for long in longer {
            for number in 0..2 {
                println!("{name}, age {age}, plant {number}");
                the_length_of_the_run_leaves_no_trace(short.as_ref(), long.as_ref(), age, &seed_of(5, number));
            }
        }
        // A young plant must not depend on `until`: equal whether `until` is near or far.
        let young = age / 4;
        if let (Ok(short), 1..) = (species.compile(young), young) {
            let long = species.compile(age).expect("it compiles for its age");
            the_length_of_the_run_leaves_no_trace(short.as_ref(), long.as_ref(), young, &seed_of(5, 2));
        }
    });
}
