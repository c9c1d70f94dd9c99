//! The command line: parse, dispatch, exit code.
//!
//! 0 ok, 1 the run failed, 2 usage, 3 invalid input, 130 interrupted. stdout carries data, stderr messages and
//! progress; a reader that closes stdout early (`| head`) ends the program quietly.

mod cli;

use clap::Parser;
use cli::{Cli, Misuse, Verdict};
use std::io;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    match cli.obey() {
        Ok(verdict) => verdict.into(),
        Err(error) if is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            cli::terminal::say(&format!("error: {}", cli::causes::in_words(&error)));
            let misuse = error.is::<Misuse>();
            if misuse { Verdict::Usage.into() } else { Verdict::Failed.into() }
        }
    }
}

fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let closed = |cause: &(dyn std::error::Error + 'static)| {
        cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
    };
    error.chain().any(closed)
}
