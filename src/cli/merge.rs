//! `merge`: the folders of all shards of a run, grown on several machines, become the folder of the run.
//!
//! Every file is compared while it is copied, or before, where a run is replaced and where files are linked; the
//! folders themselves stay as they are. What is wrong with them is told all at once. Absent: the merging
//! (`phytomer_outputs::merge`).

use super::{Misuse, Verdict, amounts, bar, interrupt, terminal};
use anyhow::Result;
use clap::Args;
use phytomer_outputs::{Checking, Error, Files, Merged, Mode, Opening, SystemSpace, merge_by};
use serde_json::json;
use std::path::PathBuf;
use std::sync::Arc;

/// Merge the folders of all shards of a run (`grow --shard`) into one, with the bytes of a run that was grown at once.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer merge merged runs/coffee-shard-1-of-2 runs/coffee-shard-2-of-2
  phytomer merge merged runs/coffee-shard-1-of-2 runs/coffee-shard-2-of-2 --overwrite --json
  phytomer merge merged runs/coffee-shard-1-of-2 runs/coffee-shard-2-of-2 --link

A shell lists the folders: `phytomer merge runs/coffee runs/coffee-shard-*`. They must be of one scenario, seed and
program, and hold each part of the run once. Exit code 1 where they do not, where a file is damaged or could not be
written, 130 after Ctrl-C; --resume then goes on. The folders of the shards are not changed, and can be removed after
`phytomer verify` has found the merged run complete.")]
pub struct Merge {
    /// The folder of the run that is made.
    out: PathBuf,
    /// The folders of its shards, in any order.
    #[arg(required = true, value_name = "PART")]
    parts: Vec<PathBuf>,
    /// Go on with an interrupted merge.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Replace the run that is in the folder.
    #[arg(long)]
    overwrite: bool,
    /// Give each file a second name in the run (a hard link) in place of a copy, where one disk has both: the folders
    /// of the shards are then best removed. Files are checked all the same, and are copied where there are no links.
    #[arg(long)]
    link: bool,
    /// Tell what came of it as one JSON object on stdout.
    #[arg(long)]
    json: bool,
    /// Show no progress, and at the end nothing but trouble.
    #[arg(long, short)]
    quiet: bool,
}

impl Merge {
    pub fn obey(self) -> Result<Verdict> {
        if let Some(missing) = self.parts.iter().find(|part| !part.is_dir()) {
            return Err(
                Misuse(format!("there is no folder {}: the folder of a shard is expected", missing.display())).into()
            );
        }
        let checking = Arc::new(Checking::default());
        let (asked, told) = (Arc::clone(&checking), Arc::clone(&checking));
        interrupt::listen(move || asked.is_stopped(), move || told.stop(), "stopping; what is merged is kept")?;
        let hidden = self.quiet || self.json;
        match bar::checking(&checking, hidden, || self.merge(&checking)) {
            Err(Error::Stopped) => {
                terminal::say("stopped; the same command with --resume goes on");
                Ok(Verdict::Interrupted)
            }
            merged => {
                self.tell(&merged?)?;
                Ok(Verdict::Done)
            }
        }
    }

    fn merge(&self, checking: &Checking) -> std::result::Result<Merged, Error> {
        let mode = match (self.resume, self.overwrite) {
            (true, _) => Mode::Resume,
            (_, true) => Mode::Overwrite,
            _ => Mode::New,
        };
        let opening = Opening { checking, space: Arc::new(SystemSpace), share: None };
        let files = if self.link { Files::Linked } else { Files::Copied };
        merge_by(files, &self.out, &self.parts, (mode, &opening))
    }

    fn tell(&self, merged: &Merged) -> Result<()> {
        let Merged { report, shards, copied } = merged;
        if self.json {
            return terminal::put_json(&json!({
                "status": "complete",
                "run": self.out.display().to_string(),
                "folders": self.parts.len(),
                "plants": report.living + report.dead,
                "living": report.living,
                "dead": report.dead,
                "components": report.components,
                "rows": report.rows,
                "files": report.files.len(),
                "bytes": report.bytes,
                "parts": shards,
                "parts_copied_now": copied,
                "overgrown": report.overgrown,
            }));
        }
        if self.quiet {
            return Ok(());
        }
        let [folders, parts] = [(self.parts.len() as u64, "folder"), (u64::from(*shards), "part")]
            .map(|(number, word)| amounts::of(number, word));
        let files = amounts::of(report.files.len() as u64, "file");
        let plants = amounts::of(report.living + report.dead, "plant");
        let out = self.out.display();
        terminal::put(&format!(
            "{out}: a complete run of {folders}: {parts}, {plants}, {files}, {}\n\nNext:\n  phytomer verify {out}",
            amounts::bytes(report.bytes as f64)
        ))
    }
}
