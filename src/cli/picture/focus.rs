//! `picture --focus`: the organ that fills the picture, and what is wrong where it is not there.

use super::super::Misuse;
use super::super::regrown::Regrown;
use anyhow::Result as Outcome;
use phytomer::run::drawing::options_of;
use phytomer::run::picturing::Pictured;
use phytomer_outputs::meshes::MeshOptions;
use phytomer_outputs::pictures::{Focus, Wanted};
use phytomer_sim::plant::Class;
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
    let options = MeshOptions { detail, ..options_of(8, &own) };
    let what = match wanted {
        Wanted::Component(number) => format!("component {number}"),
        Wanted::Largest(Class::Leaf) => "leaf".to_owned(),
        Wanted::Largest(Class::Fruit) => "fruit".to_owned(),
        Wanted::Largest(_) => "flower".to_owned(),
    };
    let missing = || {
        Misuse(format!(
            "--focus: plant {} has no {what} at age {}; choose another --age, another --plant or another organ",
            member.number, member.age
        ))
    };
    Ok(Arc::new(Focus::of(plant, member.age, &options, wanted).ok_or_else(missing)?))
}
