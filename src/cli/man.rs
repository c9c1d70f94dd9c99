//! `man`: the manual pages of the program and of each verb, as files of roff in a folder.
//!
//! They have the words of `--help`, and the examples as they stand there, line by line. Pages that are there already
//! are replaced. Absent: where a system keeps its pages, which the person who installs them knows.

use super::{Cli, Verdict, terminal};
use anyhow::{Context, Result};
use clap::builder::Resettable;
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};
use phytomer_outputs::Destination;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;

/// Write the manual pages of the program and of each verb.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer man pages
  phytomer man my_pages --quiet

`man -l pages/phytomer-grow.1` shows one; a system looks for them in /usr/local/share/man/man1.")]
pub struct ManVerb {
    /// The folder for the pages, made if it is not there.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Do not name the files.
    #[arg(long)]
    quiet: bool,
}

impl ManVerb {
    pub fn obey(self) -> Result<Verdict> {
        fs::create_dir_all(&self.folder).with_context(|| format!("cannot create {}", self.folder.display()))?;
        let mut all = Cli::command().disable_help_subcommand(true);
        all.build();
        for command in std::iter::once(&all).chain(all.get_subcommands()) {
            let (name, page) = page(command)?;
            let path = self.folder.join(name);
            let mut file = Destination::create(&path)?;
            file.write_all(&page).with_context(|| format!("cannot write {}", path.display()))?;
            file.finish()?;
            if !self.quiet {
                terminal::put(&path.display().to_string())?;
            }
        }
        Ok(Verdict::Done)
    }
}

/// The name and the content of a command's page. The examples come last, in lines that roff must not fill.
fn page(command: &Command) -> Result<(String, Vec<u8>)> {
    let version = concat!("phytomer ", env!("CARGO_PKG_VERSION"));
    let man = Man::new(command.clone().after_help(Resettable::Reset)).source(version).manual("phytomer");
    let mut page = Vec::new();
    man.render(&mut page)?;
    if let Some(after) = command.get_after_help() {
        let mut roff = Roff::new();
        roff.control("SH", ["EXAMPLES"]).control("nf", []);
        let told = after.to_string();
        let lines = told.lines().skip_while(|line| *line == "Examples:");
        lines.for_each(|line| {
            roff.text([roman(if line.is_empty() { " " } else { line })]);
        });
        roff.control("fi", []);
        page.extend(roff.render().bytes());
    }
    Ok((man.get_filename(), page))
}
