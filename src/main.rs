//! The command line as a program; all of it is `phytomer::cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    phytomer::cli::main(std::env::args_os()).into()
}
