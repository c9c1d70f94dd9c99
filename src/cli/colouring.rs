//! The plants of a picture or a mesh coloured by a column: its values, found for plants that were grown again.
//!
//! Absent: the values of columns (`phytomer_outputs::colouring`), the colours (`phytomer_outputs::pictures`).

use super::Misuse;
use super::regrown::Regrown;
use phytomer::run::picturing::Pictured;
use phytomer_outputs::colouring::{Belonging, ColouringError, colouring};
use phytomer_outputs::pictures::{Colouring, Scale, colours};
use phytomer_sim::between::Moment;
use std::sync::Arc;

/// The values of a column for all components of what was grown again.
///
/// # Errors
/// A column in which nothing that is shown has a value.
pub fn values(column: &str, pictured: &Pictured, regrown: &Regrown) -> Result<Colouring, ColouringError> {
    let treatments: Vec<String> = regrown.trial.treatments().iter().map(|treatment| treatment.name.clone()).collect();
    let (members, lights) = (pictured.memberships(), pictured.lights());
    let species: Vec<String> = regrown.species().iter().map(|species| species.about.name.clone()).collect();
    let of = Belonging { members: &members, treatments: &treatments, species: &species, lights: &lights };
    colouring(column, &pictured.subjects(), of)
}

/// Colours of components by their numbers, for a mesh.
pub type Painted = Arc<Vec<[u8; 3]>>;

/// The colours of each plant of a mesh, and what they mean in words.
///
/// # Errors
/// As [`values`].
pub fn painted(column: &str, pictured: &Pictured, regrown: &Regrown) -> Result<(Vec<Painted>, String), ColouringError> {
    let colouring = values(column, pictured, regrown)?;
    let all = || colouring.values.iter().flatten().copied().filter(|value| !value.is_nan());
    let meaning = match &colouring.scale {
        Scale::Classes { .. } => String::new(),
        Scale::Amounts => {
            let ends = [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)];
            format!(" from {:.3} (violet) to {:.3} (yellow)", ends[0], ends[1])
        }
    };
    let (colours, _) = colours(&colouring);
    Ok((colours.into_iter().map(Arc::new).collect(), format!(", by {column}{meaning}")))
}

/// Refuses to colour plants between two ticks by a table that has whole ticks.
///
/// # Errors
/// The age, with the nearest that can be.
pub fn whole(option: &str, ages: &[Moment], column: Option<&String>) -> Result<(), Misuse> {
    let between = ages.iter().find(|age| age.share().is_some());
    let Some((age, column)) = between.zip(column) else { return Ok(()) };
    let age = age.age();
    Err(Misuse(format!(
        "{option} {age}: `records` has whole ticks, so --colour-by {column} needs an age such as {} or {}",
        age.floor(),
        age.ceil()
    )))
}
