//! `completions`: the script by which a shell completes the verbs and options of the program, and the values of those
//! that have a list.
//!
//! It is made of the table of arguments that the program itself reads, so it knows every verb of this version. Absent:
//! names of species and scenarios, which `phytomer list` tells.

use super::{Cli, Verdict, terminal};
use anyhow::Result;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print the completions of a shell.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer completions bash
  phytomer completions fish

Where the shells look for them:
  bash         ~/.local/share/bash-completion/completions/phytomer
  fish         ~/.config/fish/completions/phytomer.fish
  zsh          a file `_phytomer` in a folder of $fpath
  elvish       at the end of ~/.config/elvish/rc.elv
  powershell   at the end of the file that $PROFILE names")]
pub struct Completions {
    /// Which shell.
    shell: Shell,
}

impl Completions {
    pub fn obey(self) -> Result<Verdict> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "phytomer", &mut script);
        terminal::put(String::from_utf8(script)?.trim_end())?;
        Ok(Verdict::Done)
    }
}
