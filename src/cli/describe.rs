//! `describe`: what a run folder, a scenario or a species holds, for a person or as JSON.
//!
//! What the name stands for decides: a run folder, a scenario, or a species. Of a run folder every file is checked
//! before it is told as complete. Absent: what each of them tells, in a file each.

mod dates;
mod levels;
mod measured;
mod run;
mod scenario;
mod species;

use super::named::{self, Named, Recorded};
use super::{Verdict, bar, refuse, terminal};
use anyhow::Result;
use clap::Args;
use phytomer_outputs::read::Run;
use phytomer_outputs::{Checking, Depth, Error, State, check};
use serde_json::Value;
use std::path::PathBuf;

/// Tell what a run folder, a scenario or a species holds.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer describe coffee
  phytomer describe runs/coffee
  phytomer describe runs/coffee --quick
  phytomer describe my_plant/species.toml --json

A bare name is a shipped scenario, else a shipped species, else a run below runs/. Exit code 1 where a run is damaged.")]
pub struct Describe {
    /// A run folder, a scenario or a species, by path or by name.
    #[arg(value_name = "RUN|SCENARIO|SPECIES")]
    name: String,
    /// Of a run, look whether its files are there and how long they are, and do not read them all; its effective leaf
    /// area is then not told.
    #[arg(long)]
    quick: bool,
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
            Named::Run(folder) => return self.tell_run(folder),
            Named::Scenario(resolved) => {
                let mut text = scenario::as_text(&resolved);
                for species in resolved.distinct_species() {
                    text = text + "\n" + &species::as_text(species)?;
                }
                (text, scenario::as_json(&resolved)?)
            }
            Named::Species(resolved) => {
                let species = &resolved.species;
                (species::as_text(species)?, species::as_json(species)?)
            }
        };
        self.tell(&text, &json)?;
        Ok(Verdict::Done)
    }

    fn tell_run(&self, folder: PathBuf) -> Result<Verdict> {
        let depth = if self.quick { Depth::Lengths } else { Depth::Bytes };
        let checking = Checking::default();
        let found = match bar::checking(&checking, self.json, || check(&folder, depth, &checking)) {
            // Kept no checks; its tables can be told all the same.
            Err(Error::OlderFormat { .. }) => None,
            found => Some(found?),
        };
        let recorded = Recorded::of(&folder);
        match found {
            Some(found) if found.state == State::Damaged => {
                let damaged = run::Damaged { recorded: recorded.ok(), folder, found };
                self.tell(&damaged.as_text(), &damaged.as_json())?;
                Ok(Verdict::Failed)
            }
            found if Run::open(&folder).is_ok_and(|run| measured::stated(&run).is_some()) => {
                drop(found);
                let (text, json) = measured::told(&Run::open(&folder)?, &folder)?;
                self.tell(&text, &json)?;
                Ok(Verdict::Done)
            }
            found => {
                let held = run::Held::of(recorded?, folder, found, depth)?;
                self.tell(&held.as_text(), &held.as_json())?;
                Ok(Verdict::Done)
            }
        }
    }

    fn tell(&self, text: &str, json: &Value) -> Result<()> {
        if self.json { terminal::put_json(json) } else { terminal::put(text.trim_end()) }
    }
}
