//! The command line as a program; all of it is `phytomer_cluster::cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    phytomer_cluster::cli::main()
}
