//! Grown plants as descriptions, and their way through a format and back, for tests of files of other programs.

use phytomer::outputs::exchange::{Description, InMemory, Incoming, Losses, Observation, Report, by_word, grown};
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer_config::{Kind, presets, validate_species};

/// The first plant of a species as it is shown.
pub fn plant_of(name: &str) -> Description {
    plant_at(name, None)
}

/// The first plant of a species at an age, or as it is shown.
pub fn plant_at(name: &str, age: Option<Tick>) -> Description {
    let species = validate_species(name, age.unwrap_or(1)).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let age = age.unwrap_or_else(|| species.shown_at());
    let resolved = species.alone(name);
    let mut description = grown::of_grown(None);
    let told = grown::Told { name: None, species: Some(name.to_owned()), place: None };
    Regrowth::of(&resolved)
        .show(0, &[age], &mut |age, plant| {
            grown::add(&mut description, plant, age, &told);
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    description
}

/// The species of the trips: trees, palms, grasses, shrubs, a geometric tree, and all architectural models.
pub fn species() -> Vec<&'static str> {
    let all = presets(Kind::Species).iter().map(|(name, _)| *name);
    let geometric = all.clone().find(|name| name.starts_with("gmt1/"));
    let models = all.filter(|name| name.starts_with("halle/"));
    let named = ["coffee", "fir", "oil_palm", "bamboo", "dog_rose"];
    let found: Vec<&str> = named.into_iter().chain(geometric).chain(models).collect();
    assert_eq!(found.len(), 6 + 23);
    found
}

pub fn written(description: &Description, format: &str) -> (InMemory, Losses) {
    let (mut out, mut losses) = (InMemory { stem: "plant".to_owned(), ..InMemory::default() }, Losses::default());
    by_word(format).unwrap().write(description, &mut out, &mut losses).unwrap();
    (out, losses)
}

pub fn read(files: &InMemory, format: &str) -> Description {
    let mut report = Report::new("plant");
    let beside = |name: &str| files.beside.get(name).cloned().ok_or_else(|| std::io::Error::other(name.to_owned()));
    let incoming = Incoming { name: "plant", bytes: &files.main, units: None, beside: &beside };
    let description = by_word(format).unwrap().read(&incoming, &mut report);
    assert!(report.faults().is_empty() && report.warnings().is_empty(), "{report:?}");
    description
}

/// Holds the sizes, places and directions of two observations against each other, to a millionth of a metre.
pub fn near(told: &str, seen: &Observation, again: &Observation) {
    let close = |x: Option<f64>, y: Option<f64>, what: &str| {
        let apart = x.zip(y).map_or(0.0, |(x, y)| (x - y).abs());
        assert!(x.is_some() == y.is_some() && apart <= 1e-6, "{told}: {what} {x:?} {y:?}");
    };
    close(seen.length, again.length, "length");
    close(seen.base_diameter, again.base_diameter, "diameter");
    close(seen.tip_diameter, again.tip_diameter, "diameter at the tip");
    close(seen.area, again.area, "area");
    for k in 0..3 {
        let of = |vector: Option<[f64; 3]>| vector.map(|vector| vector[k]);
        close(of(seen.place), of(again.place), "place");
        close(of(seen.direction), of(again.direction), "direction");
        close(of(seen.up), of(again.up), "upper side");
    }
}
