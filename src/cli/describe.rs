//! `describe`: what a run folder, a scenario or a species holds, for a person or as JSON.
//!
//! What the name stands for decides: a run folder, a scenario, or a species. Absent: what each of them tells, in a file
//! each.

mod run;
mod scenario;
mod species;

use super::named::{self, Named, Recorded};
use super::{Verdict, refuse, terminal};
use anyhow::Result;
use clap::Args;

/// Tell what a run folder, a scenario or a species holds.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer describe coffee
  phytomer describe runs/coffee
  phytomer describe my_plant/species.toml --json

A bare name is a shipped scenario, else a shipped species, else a run below runs/.")]
pub struct Describe {
    /// A run folder, a scenario or a species, by path or by name.
    #[arg(value_name = "RUN|SCENARIO|SPECIES")]
    name: String,
    /// As one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

impl Describe {
    pub fn obey(self) -> Result<Verdict> {
        let found = match named::find(&self.name) {
            Ok(found) => found,
            Err(report) => return refuse(&report, self.json),
        };
        let (text, json) = match found {
            Named::Run(folder) => {
                let held = run::Held::of(Recorded::of(&folder)?, folder)?;
                (held.as_text(), held.as_json())
            }
            Named::Scenario(resolved) => {
                let text = scenario::as_text(&resolved) + "\n" + &species::as_text(&resolved.species)?;
                (text, scenario::as_json(&resolved)?)
            }
            Named::Species(resolved) => {
                let species = &resolved.species;
                (species::as_text(species)?, species::as_json(species)?)
            }
        };
        if self.json {
            terminal::put_json(&json)?
        } else {
            terminal::put(text.trim_end())?
        }
        Ok(Verdict::Done)
    }
}
