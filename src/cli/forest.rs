//! `forest`: the plants of a landscape, from a raster that says what grows where.
//!
//! Absent: reading the file (`phytomer_config::forest`) and writing what it says (`phytomer::forest`).

use super::budget::tolerance;
use super::{Misuse, Verdict, amounts, refuse, terminal};
use anyhow::Result;
use clap::Args;
use phytomer::forest::{ForestError, Landscape, Written, write};
use phytomer_config::forest::forest;
use phytomer_outputs::meshes::Tolerance;
use serde_json::json;
use std::path::PathBuf;

/// Plant a landscape from a raster: a table of places, a mesh of each variant, and a scene.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer forest my_site/site.toml
  phytomer forest my_site/site.toml --out hillside --tolerance 5mm
  phytomer forest my_site/site.toml --out hillside --overwrite --json

A cell of the raster has 16 bits: bits 0 to 13 say which trees stand there, bits 14 and 15 which of three grasses. The
file of the site names the raster and the species of each bit; docs/forest.md has an example. The folder gets
instances.parquet, meshes/*.usdc and scene.usda. Exit code 3 where the file, a species or a raster is wrong.")]
pub struct ForestVerb {
    /// The file of the site.
    #[arg(value_name = "SITE.toml")]
    site: String,
    /// The folder that is written; the name of the forest if not given.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Write over the forest that is in the folder.
    #[arg(long)]
    overwrite: bool,
    /// How fine the wood of the meshes is; without it each internode is drawn by itself.
    #[arg(long, value_name = "LENGTH", value_parser = tolerance)]
    tolerance: Option<f32>,
    /// What was written, as one JSON object.
    #[arg(long)]
    json: bool,
}

impl ForestVerb {
    pub fn obey(self) -> Result<Verdict> {
        let resolved = match forest(&self.site) {
            Ok(resolved) => resolved,
            Err(report) => return refuse(&report, self.json),
        };
        let landscape = match Landscape::read(&resolved) {
            Ok(landscape) => landscape,
            Err(faults) => return refuse(&resolved.report(faults), self.json),
        };
        let folder = self.out.clone().unwrap_or_else(|| PathBuf::from(&resolved.forest.name));
        if folder.join("instances.parquet").exists() && !self.overwrite {
            let shown = folder.display();
            return Err(Misuse(format!("{shown} has a forest already; say --overwrite, or another --out")).into());
        }
        let [columns, rows] = landscape.size();
        terminal::say(&format!("{}: {columns} × {rows} cells", resolved.forest.name));
        let mut say = |file: &str| terminal::say(&format!("  {file}"));
        let within = self.tolerance.map(Tolerance::of);
        match write(&resolved, &landscape, &folder, within, &mut say) {
            Ok(written) => self.tell(&folder.display().to_string(), &written),
            Err(ForestError::Wrong(faults)) => refuse(&resolved.report(faults), self.json),
            Err(error) => Err(error.into()),
        }
    }

    fn tell(&self, folder: &str, written: &[Written]) -> Result<Verdict> {
        if self.json {
            let species = written.iter().map(
                |written| json!({"species": written.species, "plants": written.plants, "variants": written.files}),
            );
            let species: Vec<_> = species.collect();
            terminal::put_json(&json!({"status": "done", "folder": folder, "species": species}))?;
            return Ok(Verdict::Done);
        }
        for Written { species, plants, files } in written {
            let variants = amounts::of(files.len() as u64, "variant");
            terminal::put(&format!("{folder}: {species}: {}, {variants}", amounts::of(*plants, "plant")))?;
        }
        Ok(Verdict::Done)
    }
}
