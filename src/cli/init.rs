//! `init`: a small species and a scenario that run, with comments, beside the two schemas that an editor obeys.
//!
//! Nothing is overwritten: where one of the files is there already, none is written.

use super::{Misuse, Verdict, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer_config::{Kind, schema_of};
use std::fs::{self, File};
use std::io::Write;
use std::path::PathBuf;

const SPECIES: &str = include_str!("init/species.toml");
const SCENARIO: &str = include_str!("init/scenario.toml");

/// Write a species and a scenario to begin with.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer init my_plant
  phytomer grow my_plant/scenario.toml

Nothing is ever overwritten.")]
pub struct Init {
    /// The folder for the files, made if it is not there.
    #[arg(default_value = ".", value_name = "DIR")]
    folder: PathBuf,
}

impl Init {
    pub fn obey(self) -> Result<Verdict> {
        let files = [
            ("species.toml", SPECIES.to_owned()),
            ("scenario.toml", SCENARIO.to_owned()),
            ("species.schema.json", serde_json::to_string_pretty(&schema_of(Kind::Species))? + "\n"),
            ("scenario.schema.json", serde_json::to_string_pretty(&schema_of(Kind::Scenario))? + "\n"),
        ];
        let files = files.map(|(name, text)| (self.folder.join(name), text));
        self.refuse_to_overwrite(&files.each_ref().map(|(path, _)| path))?;
        fs::create_dir_all(&self.folder).with_context(|| format!("cannot create {}", self.folder.display()))?;
        for (path, text) in &files {
            let doing = || format!("cannot write {}", path.display());
            let mut file = File::create_new(path).with_context(doing)?;
            file.write_all(text.as_bytes()).with_context(doing)?;
            terminal::put(&path.display().to_string())?;
        }
        let scenario = self.folder.join("scenario.toml");
        terminal::say(&format!("\nNext:\n  phytomer grow {}", scenario.display()));
        Ok(Verdict::Done)
    }

    fn refuse_to_overwrite(&self, paths: &[&PathBuf]) -> Result<()> {
        let there: Vec<String> = paths
            .iter()
            .filter(|path| path.symlink_metadata().is_ok())
            .map(|path| path.display().to_string())
            .collect();
        if there.is_empty() {
            return Ok(());
        }
        Err(Misuse(format!("already there: {}; nothing was written, choose another folder", there.join(", "))).into())
    }
}
