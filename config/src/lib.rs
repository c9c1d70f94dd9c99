//! Scenario and species files: reading them, inheritance, and every fault at once with its place in the file.
//!
//! A file becomes a tree with spans (`document`), the tree is held against the schema of its types (`schema`), species
//! inherit (`inherit`), and what the models find wrong is shown where it was typed (`report`). [`validate`] does all of
//! it and gives a run that can begin.
//! Absent: growth formulas, and anything that runs.

mod about;
mod alone;
mod architectural_model;
mod document;
mod explosion;
mod forms;
mod inherit;
mod library;
mod load;
mod meaning;
mod models;
pub mod published;
mod report;
mod resolved;
pub mod scenario;
mod schema;
mod source;
mod species;
mod validate;
mod woods;

pub use about::About;
pub use alone::recorded_alone;
pub use architectural_model::ArchitecturalModel;
pub use library::{Kind, presets};
pub use models::{MODELS, Model, ModelName};
pub use published::Published;
pub use report::{Fault, FaultRecord, Report};
pub use resolved::{OtherSpecies, Resolved};
pub use scenario::Scenario;
pub use source::{Origin, Source, SourceId, Sources, Span};
pub use species::Species;
pub use validate::{
    ResolvedSpecies, SPECIES_ALONE_UNTIL, kind_of, schema_of, validate, validate_species, validate_texts,
};
pub use woods::{ShippedWood, woods};
