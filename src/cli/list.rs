//! `list`: what ships with the program, and the words that files and tables use.
//!
//! Scenarios, species, the 23 architectural models with their characters, growth models, woods, forms of organs and
//! kinds of component, each a line. Absent: what they hold, which `describe` tells.

use super::{Verdict, terminal};
use anyhow::Result;
use clap::{Args, ValueEnum};
use phytomer_config::{ArchitecturalModel, Kind, MODELS, presets, validate, validate_species, woods};
use phytomer_looks::FormName;
use phytomer_sim::plant::Kind as ComponentKind;
use serde::Serialize;
use std::fmt::Write as _;

/// List what ships: scenarios, species, architectural models, growth models, woods, forms of organs, kinds of
/// components.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer list
  phytomer list species
  phytomer list models
  phytomer list kinds --json")]
pub struct List {
    /// One list alone.
    what: Option<Listed>,
    /// As one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

/// What can be listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Listed {
    /// Runs to grow by name.
    Scenarios,
    /// Plants that scenarios can name.
    Species,
    /// The 23 architectural models (Hallé, Oldeman & Tomlinson 1978): a species of each, to grow by name.
    Models,
    /// Growth models that a species can choose.
    GrowthModels,
    /// Woods that a species can be like.
    Woods,
    /// Forms that organs can be drawn with.
    Forms,
    /// Kinds of components, as the column `kind` has them, with their Plant Ontology terms.
    Kinds,
}

#[derive(Debug, Serialize)]
struct Entry {
    name: String,
    description: String,
}

impl List {
    pub fn obey(self) -> Result<Verdict> {
        let lists = Listed::value_variants().iter().copied().filter(|list| self.what.is_none_or(|what| what == *list));
        let lists: Vec<(&str, Vec<Entry>)> = lists.map(|list| (list.title(), list.entries())).collect();
        if self.json {
            let object: serde_json::Map<_, _> =
                lists.iter().map(|(title, entries)| ((*title).to_owned(), serde_json::json!(entries))).collect();
            terminal::put_json(&object)?;
        } else {
            let texts: Vec<String> = lists.iter().map(|(title, entries)| as_text(title, entries)).collect();
            terminal::put(texts.join("\n").trim_end())?;
        }
        Ok(Verdict::Done)
    }
}

impl Listed {
    fn title(self) -> &'static str {
        match self {
            Self::Scenarios => "scenarios",
            Self::Species => "species",
            Self::Models => "models",
            Self::GrowthModels => "growth-models",
            Self::Woods => "woods",
            Self::Forms => "forms",
            Self::Kinds => "kinds",
        }
    }

    fn entries(self) -> Vec<Entry> {
        match self {
            Self::Scenarios => presets(Kind::Scenario).iter().map(|(name, _)| scenario(name)).collect(),
            Self::Species => named_species().filter(|name| !is_model(name)).map(species).collect(),
            Self::Models => ArchitecturalModel::ALL.map(|model| described(&format!("halle/{}", model.word()))).into(),
            Self::GrowthModels => MODELS.map(|model| entry(model.word(), model.card().about)).into(),
            Self::Woods => woods().iter().map(|wood| entry(&wood.name, &wood.scientific_name)).collect(),
            Self::Forms => FormName::ALL.map(|form| entry(form.word(), &phrase(form.about()))).into(),
            Self::Kinds => ComponentKind::ALL.map(|kind| entry(kind.tag(), kind.ontology_term())).into(),
        }
    }
}

fn entry(name: &str, description: &str) -> Entry {
    Entry { name: name.to_owned(), description: description.to_owned() }
}

/// A sentence as a phrase: without its capital and its full stop.
fn phrase(sentence: &str) -> String {
    let (first, rest) = sentence.split_at(sentence.chars().next().map_or(0, char::len_utf8));
    first.to_lowercase() + rest.strip_suffix('.').unwrap_or(rest)
}

fn scenario(name: &str) -> Entry {
    let description = validate(name).ok().and_then(|resolved| resolved.scenario.description);
    entry(name, &first_sentence(description.as_deref().unwrap_or_default()))
}

fn named_species() -> impl Iterator<Item = &'static str> {
    presets(Kind::Species).iter().map(|(name, _)| *name)
}

/// Whether a shipped species is there for its architectural model.
fn is_model(name: &str) -> bool {
    name.starts_with("halle/")
}

/// The characters of an architectural model, and plants that follow it.
fn described(name: &str) -> Entry {
    let about = validate_species(name, 1).ok().map(|species| species.species.about);
    let characters = about.and_then(|about| about.description).unwrap_or_default();
    entry(name, &characters)
}

fn species(name: &str) -> Entry {
    // Its words do not depend on the ages for which it is compiled.
    let about = validate_species(name, 1).ok().map(|species| species.species.about);
    let words = |about: phytomer_config::About| about.scientific_name.or(about.common_name).or(about.description);
    entry(name, &first_sentence(&about.and_then(words).unwrap_or_default()))
}

/// The words up to the first full stop that a sentence follows; "Fig. 5a" is none.
fn first_sentence(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let ends = |(at, _): &(usize, &str)| line[at + 2..].starts_with(char::is_uppercase);
    let end = line.match_indices(". ").find(ends).map_or(line.len(), |(at, _)| at + 1);
    line[..end].to_owned()
}

fn as_text(title: &str, entries: &[Entry]) -> String {
    let width = entries.iter().map(|entry| entry.name.chars().count()).max().unwrap_or(0);
    let mut text = format!("{title}\n");
    for Entry { name, description } in entries {
        let _ = writeln!(text, "{}", format!("  {name:<width$}  {description}").trim_end());
    }
    text
}
