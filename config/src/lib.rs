//! Scenario and species files: reading, inheritance, and a check that reports every fault at once with its place in the
//! file.
//!
//! A file becomes a tree with spans (`document`), the tree is checked against the schema of its types (`schema`),
//! species inherit (`inherit`), and faults that the growth models find are shown at the values in the file (`report`).
//! [`validate`] does all of this and returns a run that is ready to start. Absent: growth formulas, and running.

mod about;
mod alone;
mod architectural_model;
mod beside;
mod checked;
mod cohorts;
mod dates;
mod document;
mod expansion;
mod explosion;
pub mod forest;
mod forms;
mod inherit;
mod library;
mod load;
mod making;
mod material;
mod meaning;
mod models;
mod numbers;
mod places;
pub mod plan;
pub mod published;
mod report;
mod resolved;
pub mod scenario;
mod schema;
mod seeds;
mod skylight;
mod solids;
mod source;
mod species;
mod species_of_run;
mod treatments;
mod trial;
mod validate;
mod woods;

pub use about::About;
pub use alone::recorded_alone;
pub use architectural_model::ArchitecturalModel;
pub use cohorts::Cohort;
pub use dates::{Dated, WeatherRead, calendars_of_run};
pub use library::{Kind, presets};
pub use material::{Covered, Material, path_of as path_of_material};
pub use models::{MODELS, Model, ModelName, Reads};
pub use numbers::{Estimated, Number, Numbers, Prior, Unknown};
pub use published::Published;
pub use report::{Fault, FaultRecord, Report};
pub use resolved::{OtherSpecies, Resolved, Uncompiled, compiled};
pub use scenario::Scenario;
pub use source::{Origin, Source, SourceId, Sources, Span};
pub use species::Species;
pub use trial::{PlantPlace, PlotPlace, Treatment, Trial};
pub use validate::{
    ResolvedSpecies, SPECIES_ALONE_UNTIL, kind_of, schema_of, validate, validate_species, validate_species_with,
    validate_texts, validate_with,
};
pub use woods::{ShippedWood, woods};
