//! `verify`: whether a run folder holds what it says, byte for byte, and nothing else.
//!
//! Every file that the journal and `run.json` name is read and hashed; each that is damaged, missing, left over or
//! foreign is named. The exit code is 0 where the run is complete and nothing of this was found. Absent: mending, which
//! is `grow
//! --resume`'s.

use super::named::run_folder;
use super::{Misuse, Verdict, amounts, bar, findings, terminal};
use anyhow::Result;
use clap::Args;
use phytomer_outputs::{Checking, Checkup, Depth, check};
use std::path::Path;

/// Read every file of a run and tell which is damaged, missing or foreign.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer verify runs/coffee
  phytomer verify runs/coffee --json

Exit code 0 where the run is complete and every file is as it was written, 1 where a file is damaged, missing, left over
or foreign, or where the run is unfinished or in progress. `phytomer grow` with --resume mends what is damaged or missing
and removes what is left over; a foreign file is left alone.")]
pub struct Verify {
    /// A run folder by its path, or a run below runs/ by its name.
    #[arg(value_name = "RUN")]
    run: String,
    /// Tell it as one JSON object on stdout.
    #[arg(long)]
    json: bool,
    /// Show no progress, and tell nothing but trouble.
    #[arg(long, short)]
    quiet: bool,
}

impl Verify {
    pub fn obey(self) -> Result<Verdict> {
        let Some(folder) = run_folder(&self.run) else {
            return Err(Misuse(format!(
                "there is no run `{}`: a run folder or a run below runs/ is expected",
                self.run
            ))
            .into());
        };
        let checking = Checking::default();
        let hidden = self.quiet || self.json;
        let found = bar::checking(&checking, hidden, || check(&folder, Depth::Bytes, &checking))?;
        if self.json {
            let mut json = findings::as_json(&found);
            json["run"] = folder.display().to_string().into();
            terminal::put_json(&json)?;
        } else if !(self.quiet && found.is_clean()) {
            terminal::put(&in_words(&folder, &found))?;
        }
        Ok(if found.is_clean() { Verdict::Done } else { Verdict::Failed })
    }
}

fn in_words(folder: &Path, found: &Checkup) -> String {
    let files = amounts::of(found.files as u64, "file");
    let bytes = amounts::bytes(found.bytes as f64);
    let kind = findings::kind_of(found.state, found.share);
    let mut text = format!("{}: {kind}; {files}, {bytes}, read and compared", folder.display());
    text += &match found.findings.len() as u64 {
        0 => ": all as they were written".to_owned(),
        troubled => format!("; {} not as it should be", amounts::of(troubled, "file")),
    };
    text += &findings::lines(found, usize::MAX);
    findings::advice(found).map(|advice| format!("{text}\n{advice}")).unwrap_or(text)
}
