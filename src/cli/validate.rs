//! `validate`: every fault of scenarios and species, none of them run.
//!
//! Of a species that states what was published of such plants a sample is grown too, once its file is without fault.
//! Absent: the checks, which are `phytomer-config`'s, `phytomer::sample`'s and
//! `phytomer::architecture`'s.

use super::constants::Constants;
use super::grow::{clock, species_in_words};
use super::named::{self, Named};
use super::{Verdict, amounts, terminal};
use anyhow::Result;
use clap::Args;
use phytomer::{architecture, sample};
use phytomer_config::{Report, Species};
use phytomer_models::fault::Fault;
use phytomer_models::parameters::Surroundings;
use serde_json::{Value, json};

type Found = std::result::Result<Named, Report>;

/// Check scenarios and species, and tell every fault at once.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer validate coffee
  phytomer validate my_plant/scenario.toml my_plant/species.toml
  phytomer validate my_plant/scenario.toml --json
  phytomer validate abop/2.8a -D lr=1.2

Where a species states published ranges (`[[published]]`), a sample of it is grown and held against them; where it
names its architectural model, plants grown to the age `shown_at` must qualify for it.
Exit code 3 where anything is wrong.")]
pub struct Validate {
    /// Files by their paths, shipped scenarios and species by their names.
    #[arg(required = true, value_name = "FILE|NAME")]
    names: Vec<String>,
    #[command(flatten)]
    constants: Constants,
    /// All faults as one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

impl Validate {
    pub fn obey(self) -> Result<Verdict> {
        let around = self.constants.surroundings();
        let mut found: Vec<(&String, Found)> = Vec::new();
        for name in &self.names {
            let one = find(name, &around);
            if let Ok(one) = &one {
                self.constants.check(name, one)?;
            }
            found.push((name, one));
        }
        let wrong = found.iter().filter(|(_, found)| found.is_err()).count();
        if self.json {
            let files: Vec<Value> = found.iter().map(|(name, found)| as_json(name, found)).collect();
            terminal::put_json(&json!({"status": if wrong == 0 { "valid" } else { "invalid" }, "files": files}))?;
        } else {
            for (name, found) in &found {
                tell(name, found)?;
            }
        }
        Ok(if wrong == 0 { Verdict::Done } else { Verdict::Invalid })
    }
}

/// Finds what a name stands for, and holds plants grown from it against what was published of its species, and against
/// the architectural model that it names.
fn find(name: &str, around: &Surroundings) -> Found {
    let found = named::find_with(name, around)?;
    let report = match &found {
        Named::Run(_) => None,
        Named::Scenario(scenario) => {
            let all = scenario.all_species().into_iter().enumerate();
            all.filter_map(|(place, species)| Some(scenario.report_of(place, wrong(species)?))).next()
        }
        Named::Species(species) => wrong(&species.species).map(|faults| species.report(faults)),
    };
    report.map_or(Ok(found), Err)
}

fn wrong(species: &Species) -> Option<Vec<Fault>> {
    let (mut faults, others) = rayon::join(|| sample::faults(species), || architecture::faults(species));
    faults.extend(others);
    Some(faults).filter(|faults| !faults.is_empty())
}

fn tell(name: &str, found: &Found) -> Result<()> {
    match found {
        Ok(Named::Run(_)) => terminal::put(&format!("{name}: a run folder, whose scenario was valid when it began")),
        Ok(Named::Scenario(scenario)) => {
            let (species, clock) = (species_in_words(scenario), clock(scenario));
            let plants = amounts::of(scenario.trial().plants().into(), "plant");
            let until = scenario.scenario.ages.until;
            terminal::put(&format!("{name}: a valid scenario: {plants} of `{species}` to {clock} {until}"))
        }
        Ok(Named::Species(species)) => {
            let model = species.species.model.name().word();
            terminal::put(&format!("{name}: a valid species of the model `{model}`"))
        }
        Err(report) => {
            terminal::say(report.render(terminal::stderr_has_colour()).trim_end());
            Ok(())
        }
    }
}

fn as_json(name: &str, found: &Found) -> Value {
    let (kind, faults) = match found {
        Ok(Named::Run(_)) => ("run", Vec::new()),
        Ok(Named::Scenario(_)) => ("scenario", Vec::new()),
        Ok(Named::Species(_)) => ("species", Vec::new()),
        Err(report) => ("unknown", report.records()),
    };
    let kind = if faults.is_empty() { Some(kind) } else { None };
    json!({"name": name, "kind": kind, "valid": faults.is_empty(), "faults": faults})
}
