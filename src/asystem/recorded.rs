//! The trees of a stage as species files, and as one plot in the tables of a run.
//!
//! A plot has places on the ground: how high a tree was lifted, and how far it was turned, is not in the tables.

use super::cast::Cast;
use crate::run::{self, Progress, Settings};
use phytomer_config::{Species, validate_texts};
use serde_json::json;
use std::fmt::Write;
use std::path::Path;

/// Why trees are not recorded.
#[derive(Debug, thiserror::Error)]
pub enum RecordedError {
    /// There are none.
    #[error("the script leaves no tree; expected at least one that it does not delete")]
    Nothing,
    /// The trees make no scenario.
    #[error("{0}")]
    Refused(String),
    /// The run fails.
    #[error(transparent)]
    Run(#[from] run::RunError),
}

/// A tree as the text of a species file; nothing where there is no tree of that name.
pub fn species_of(cast: &Cast, name: &str) -> String {
    let Some((tree, grows)) = cast.trees.get(name).and_then(|tree| Some((tree, tree.grows(1)?))) else {
        return String::new();
    };
    let mut species = serde_json::to_value(&grows).unwrap_or_default();
    if let Some(keys) = species.as_object_mut() {
        keys.insert("name".to_owned(), json!(name));
        keys.insert("model".to_owned(), json!(tree.tree_type().word()));
        keys.insert("tick".to_owned(), json!("one growth level"));
    }
    Species::from_json(&species).ok().and_then(|species| species.to_toml().ok()).unwrap_or_default()
}

/// Grows the trees that there are as one plot, into the tables of a run folder.
///
/// # Errors
/// Where there is no tree, and those of the run.
pub fn record(cast: &Cast, folder: &Path) -> Result<(), RecordedError> {
    let names: Vec<&String> = cast.trees.keys().collect();
    let Some(first) = names.first() else { return Err(RecordedError::Nothing) };
    let species: Vec<String> = names.iter().map(|name| species_of(cast, name)).collect();
    let until = cast.trees.values().filter_map(|tree| Some(tree.grows(1)?.full_grown_at())).max().unwrap_or(1);
    let mut scenario = format!(
        "name = \"asystem\"\nspecies = \"{first}\"\nplants = {}\nages = {{ until = {until} }}\nmember = [\n",
        names.len()
    );
    for (name, tree) in &cast.trees {
        let [x, y, _] = tree.stands_at();
        // A text takes everything.
        let _ = writeln!(scenario, "  {{ species = \"{name}\", at_m = [{x:?}, {y:?}] }},");
    }
    scenario.push_str("]\n");
    let mut texts = vec![("asystem script", scenario.as_str())];
    texts.extend(names.iter().map(|name| name.as_str()).zip(species.iter().map(String::as_str)));
    let refused = |report: phytomer_config::Report| RecordedError::Refused(report.render(false));
    let resolved = validate_texts("asystem script", &texts).map_err(refused)?;
    run::run(&resolved, &Settings::in_folder(folder), &Progress::default())?;
    Ok(())
}
