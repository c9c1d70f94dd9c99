//! `picture --focus`: the organ that fills the picture, and what is wrong where it is not there.

use super::super::Misuse;
use super::super::regrown::Regrown;
use anyhow::Result as Outcome;
use phytomer::run::drawing::options_of;
use phytomer::run::picturing::Pictured;
use phytomer_outputs::meshes::MeshOptions;
use phytomer_outputs::pictures::{Focus, Wanted};
use phytomer_sim::Tick;
use phytomer_sim::plant::{Class, Plant};
use std::sync::Arc;

/// What is asked for, by a word or by the number of a component.
pub fn wanted(text: &str) -> Result<Wanted, String> {
    match text {
        "leaf" => Ok(Wanted::Largest(Class::Leaf)),
        "flower" => Ok(Wanted::Largest(Class::Flower)),
        "fruit" => Ok(Wanted::Largest(Class::Fruit)),
        number => number
            .parse()
            .map(Wanted::Component)
            .map_err(|_| "`leaf`, `flower`, `fruit` or the number of a component is expected".to_owned()),
    }
}

/// The organ of the first plant.
///
/// # Errors
/// Several plants, or a plant without such an organ at its age.
pub fn of(wanted: Wanted, pictured: &Pictured, regrown: &Regrown, detail: u8) -> Outcome<Arc<Focus>> {
    let [stand] = pictured.stands.as_slice() else {
        return Err(Misuse("--focus: this is for one plant at one age; leave out the others".to_owned()).into());
    };
    let Some((plant, member)) = stand.plants.first().zip(stand.members.first()) else {
        return Err(Misuse("--focus: no plant stands at this age".to_owned()).into());
    };
    let own = regrown.forms.get(member.species).cloned().unwrap_or_default();
    on(wanted, (plant, member.number, member.age), &MeshOptions { detail, ..options_of(8, &own) })
}

/// The organ of a plant of a number at an age.
///
/// # Errors
/// A plant without such an organ at its age.
pub fn on(wanted: Wanted, (plant, number, age): (&Plant, u32, Tick), options: &MeshOptions) -> Outcome<Arc<Focus>> {
    let what = match wanted {
        Wanted::Component(number) => format!("component {number}"),
        Wanted::Largest(Class::Leaf) => "leaf".to_owned(),
        Wanted::Largest(Class::Fruit) => "fruit".to_owned(),
        Wanted::Largest(_) => "flower".to_owned(),
    };
    let missing = || {
        Misuse(format!(
            "--focus: plant {number} has no {what} at age {age}; choose another --age, another --plant or another organ"
        ))
    };
    Ok(Arc::new(Focus::of(plant, age, options, wanted).ok_or_else(missing)?))
}
