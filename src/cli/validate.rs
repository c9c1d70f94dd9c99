//! `validate`: every fault of scenarios and species, none of them run; a small sample of a species that names its
//! architectural model is grown in memory, and must qualify for it.
//!
//! Absent: the checks, which are `phytomer-config`'s.

use super::named::{self, Named};
use super::{Verdict, amounts, terminal};
use anyhow::Result;
use clap::Args;
use phytomer::sample::check_architecture;
use phytomer_config::Report;
use serde_json::{Value, json};

type Found = std::result::Result<Named, Report>;

/// Finds and checks a name, and grows a small sample of a species that names its architectural model.
fn check(name: &str) -> Found {
    let found = named::find(name)?;
    match &found {
        Named::Scenario(scenario) => check_architecture(scenario.species_alone(), name)?,
        Named::Species(species) => check_architecture((**species).clone(), name)?,
        Named::Run(_) => {}
    }
    Ok(found)
}

/// Check scenarios and species, and tell every fault at once.
///
/// A species that names its architectural model must have plants of that model: five are grown in memory, to the age that
/// its key `shown_at` says, and looked at.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer validate coffee
  phytomer validate my_plant/scenario.toml my_plant/species.toml
  phytomer validate my_plant/scenario.toml --json

Exit code 3 where anything is wrong.")]
pub struct Validate {
    /// Files by their paths, shipped scenarios and species by their names.
    #[arg(required = true, value_name = "FILE|NAME")]
    names: Vec<String>,
    /// All faults as one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

impl Validate {
    pub fn obey(self) -> Result<Verdict> {
        let found: Vec<(&String, Found)> = self.names.iter().map(|name| (name, check(name))).collect();
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

fn tell(name: &str, found: &Found) -> Result<()> {
    match found {
        Ok(Named::Run(_)) => terminal::put(&format!("{name}: a run folder, whose scenario was valid when it began")),
        Ok(Named::Scenario(scenario)) => {
            let about = &scenario.species.about;
            let plants = amounts::of(scenario.scenario.plants.into(), "plant");
            let until = scenario.scenario.ages.until;
            terminal::put(&format!("{name}: a valid scenario: {plants} of `{}` to age {until}", about.name))
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
