//! The seven tables of a run, from the plant's columns to Parquet part files, or to Arrow record batches in memory.
//!
//! [`columns`] declares the columns of each table; `records`, `components`, `events`, `summary`, `plants` and `site`
//! fill column buffers from plants; `recording` decides which rows are written when, for files and for memory. `part`
//! writes full buffers as row groups of a file, encoded column by column on as many threads as there are (`encode`);
//! `memory` keeps them as Arrow record batches. The bytes do not depend on the number of threads: a row group has a
//! fixed number of rows, and its columns are put into the file in their order. `treatments` is small, follows from the
//! plan alone, and is written once a run.

pub mod arrow;
mod buffers;
pub mod columns;
mod component_index;
mod components;
mod encode;
mod error;
mod events;
mod light;
mod membership;
mod memory;
mod of_species;
mod pages;
mod part;
mod plan;
mod plants;
mod recording;
mod records;
mod sample;
pub mod schema;
mod single;
mod sink;
mod site;
mod summary;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_mechanics;
#[cfg(test)]
mod tests_plots;
pub mod treatments;

pub(crate) use buffers::{NO_DATE, NULL, Values};
pub(crate) use component_index::ComponentIndex;
pub(crate) use components::{ComponentColumns, ComponentRow};
pub(crate) use encode::Queue;
pub use error::{Cause, TableError};
pub(crate) use events::{EventColumns, SortedEvents};
pub use membership::Membership;
pub(crate) use membership::by_number;
pub use memory::{MemoryTables, Room, TableBatches};
pub(crate) use of_species::OfSpecies;
pub(crate) use part::{Part, PartReport};
pub use plan::{Factor, Input, OfMember, Provenance, RunPlan};
pub(crate) use plants::{PlantColumns, Standing};
pub(crate) use recording::Recording;
pub(crate) use records::{PlantAtAge, RecordColumns, RecordRow};
pub use sample::{Sample, Stated};
pub(crate) use single::{each_record, light_values, record_values};
pub(crate) use sink::Sink;
pub(crate) use site::{Group, SiteColumns};
pub use summary::Summary;
pub(crate) use summary::{SummaryColumns, summarise};

use schema::Column;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Rows in a row group.
pub const ROW_GROUP: usize = 122_880;

/// One of the seven tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Table {
    /// A row per component that ever lived.
    Components,
    /// A row per component that stands at a recorded tick.
    Records,
    /// A row per fate of a bud or a branch.
    Events,
    /// A row per plant and recorded tick.
    Summary,
    /// A row per plant.
    Plants,
    /// A row per treatment.
    Treatments,
    /// A row per treatment, replicate and recorded tick.
    Site,
}

impl Table {
    /// Every table.
    pub const ALL: [Self; 7] =
        [Self::Components, Self::Records, Self::Events, Self::Summary, Self::Plants, Self::Treatments, Self::Site];

    /// The name of the table, and of its folder in the run.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Components => "components",
            Self::Records => "records",
            Self::Events => "events",
            Self::Summary => "summary",
            Self::Plants => "plants",
            Self::Treatments => "treatments",
            Self::Site => "site",
        }
    }

    /// The content of a row, in one sentence.
    pub const fn description(self) -> &'static str {
        match self {
            Self::Components => "A row per component that ever lived, by the last tick of the run.",
            Self::Records => "A row per component that stands at a recorded tick, with its pose.",
            Self::Events => "A row per fate of a bud or a branch.",
            Self::Summary => "A row per plant and recorded tick.",
            Self::Plants => "A row per plant, with its species, its sowing and its place in the plot.",
            Self::Treatments => "A row per treatment, with its level of each factor.",
            Self::Site => {
                "A row per treatment, replicate and recorded tick in each part, with its date and living plants."
            }
        }
    }

    /// Its columns in a run with or without those of mechanics. Those of factors, which `treatments` has too, are the
    /// run's own ([`treatments`]).
    pub fn columns(self, mechanics: bool) -> &'static [Column] {
        match self {
            Self::Components => &columns::COMPONENTS,
            Self::Records if mechanics => &columns::RECORDS,
            Self::Records => &columns::RECORDS[..columns::RECORDS_OF_POSE],
            Self::Events => &columns::EVENTS,
            Self::Summary => &columns::SUMMARY,
            Self::Plants => &columns::PLANTS[..columns::PLANTS_WITHOUT_GUARDS],
            Self::Treatments => &columns::TREATMENTS,
            Self::Site => &columns::SITE,
        }
    }

    /// Its columns where the plants were measured: those of every run, any of which may be null.
    pub fn columns_of_measured(self) -> &'static [Column] {
        static COLUMNS: LazyLock<[Vec<Column>; Table::ALL.len()]> = LazyLock::new(|| {
            let nullable = |column: &Column| Column { nullable: true, ..*column };
            Table::ALL.map(|table| table.columns(false).iter().map(nullable).collect())
        });
        &COLUMNS[self as usize]
    }

    /// Its columns in a run with those of light; such a run has the columns of mechanics too.
    pub fn columns_in_light(self) -> &'static [Column] {
        match self {
            Self::Records => &columns::RECORDS_IN_LIGHT,
            Self::Summary => &columns::SUMMARY_IN_LIGHT,
            Self::Site => &columns::SITE_IN_LIGHT,
            other => other.columns(true),
        }
    }

    /// The columns by which the rows are sorted, most significant first: plot, tick where the table has one, plant,
    /// component. Their values are unique to a row, except in `events`.
    pub const fn sorted_by(self) -> &'static [&'static str] {
        match self {
            Self::Components => &["plot_id", "plant_id", "component_id"],
            Self::Records => &["plot_id", "tick", "plant_id", "component_id"],
            Self::Events => &["plot_id", "tick", "plant_id", "component_id"],
            Self::Summary => &["plot_id", "tick", "plant_id"],
            Self::Plants => &["plot_id", "plant_id"],
            Self::Treatments => &["treatment_index"],
            Self::Site => &["plot_id", "tick"],
        }
    }
}
