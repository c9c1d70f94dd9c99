//! `init`: a small species and a scenario that run, with comments, beside the two schemas that an editor obeys; where
//! the species is an L-system, its file and its view file too.
//!
//! Nothing is overwritten: where one of the files is there already, none is written.

use super::{Misuse, Verdict, terminal};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use phytomer_config::{Kind, schema_of};
use std::fs::{self, File};
use std::io::Write;
use std::path::PathBuf;

/// The files to begin with a model, by their names.
type Beginning = &'static [(&'static str, &'static str)];

const BUDS: Beginning =
    &[("species.toml", include_str!("init/species.toml")), ("scenario.toml", include_str!("init/scenario.toml"))];

const LSYSTEM: Beginning = &[
    ("species.toml", include_str!("init/lsystem/species.toml")),
    ("plant.l", include_str!("init/lsystem/plant.l")),
    ("plant.v", include_str!("init/lsystem/plant.v")),
    ("leaf.s", include_str!("init/lsystem/leaf.s")),
    ("scenario.toml", include_str!("init/lsystem/scenario.toml")),
];

/// What the species to begin with is.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Model {
    /// A shrub by the bud model of de Reffye et al. 1988.
    Buds,
    /// A herb that is an L-system in a file of its own (.l).
    Lsystem,
}

/// Write a species and a scenario to begin with.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer init my_plant
  phytomer grow my_plant/scenario.toml
  phytomer init my_herb --model lsystem
  phytomer picture my_herb/species.toml --out my_herb.png

Nothing is ever overwritten.")]
pub struct Init {
    /// The folder for the files, made if it is not there.
    #[arg(default_value = ".", value_name = "DIR")]
    folder: PathBuf,
    /// The model of the species.
    #[arg(long, value_enum, default_value = "buds", value_name = "MODEL")]
    model: Model,
}

impl Init {
    pub fn obey(self) -> Result<Verdict> {
        let beginning = match self.model {
            Model::Buds => BUDS,
            Model::Lsystem => LSYSTEM,
        };
        let schemas = [
            ("species.schema.json", serde_json::to_string_pretty(&schema_of(Kind::Species))? + "\n"),
            ("scenario.schema.json", serde_json::to_string_pretty(&schema_of(Kind::Scenario))? + "\n"),
        ];
        let files = beginning.iter().map(|(name, text)| (*name, (*text).to_owned())).chain(schemas);
        let files: Vec<(PathBuf, String)> = files.map(|(name, text)| (self.folder.join(name), text)).collect();
        self.refuse_to_overwrite(files.iter().map(|(path, _)| path))?;
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

    fn refuse_to_overwrite<'p>(&self, paths: impl Iterator<Item = &'p PathBuf>) -> Result<()> {
        let there: Vec<String> =
            paths.filter(|path| path.symlink_metadata().is_ok()).map(|path| path.display().to_string()).collect();
        if there.is_empty() {
            return Ok(());
        }
        Err(Misuse(format!("already there: {}; nothing was written, choose another folder", there.join(", "))).into())
    }
}
