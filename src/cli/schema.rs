//! `schema`: the JSON Schemas of species, scenario, forest and plan files, for editors and for programs that write such
//! files.
//!
//! Absent: the schemas themselves, which `phytomer-config` makes from the types.

use super::{Verdict, terminal};
use anyhow::Result;
use clap::{Args, ValueEnum};
use phytomer_config::forest::forest_schema;
use phytomer_config::plan::plan_schema;
use phytomer_config::{Kind, schema_of};

/// Print the JSON Schema of a kind of file.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer schema species
  phytomer schema scenario
  phytomer schema forest
  phytomer schema plan

An editor with taplo obeys a schema that the first line of a file names:
  #:schema ./species.schema.json")]
pub struct Schema {
    /// Which kind of file.
    kind: FileKind,
}

/// A kind of file.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum FileKind {
    /// One species and its laws.
    Species,
    /// One run.
    Scenario,
    /// One forest.
    Forest,
    /// One plan, for hours of shade.
    Plan,
}

impl Schema {
    pub fn obey(self) -> Result<Verdict> {
        match self.kind {
            FileKind::Species => terminal::put_json(&schema_of(Kind::Species)),
            FileKind::Scenario => terminal::put_json(&schema_of(Kind::Scenario)),
            FileKind::Forest => terminal::put_json(forest_schema()),
            FileKind::Plan => terminal::put_json(plan_schema()),
        }?;
        Ok(Verdict::Done)
    }
}
