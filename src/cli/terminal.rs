//! The two streams: data to stdout, messages to stderr, and whether a stream has colour.
//!
//! `NO_COLOR` (no-color.org) and `TERM=dumb` switch colour off. Nothing here panics where a stream is closed.

use anyhow::Result;
use serde::Serialize;
use std::io::{self, IsTerminal, Write};

/// Data for stdout, with a line end.
///
/// # Errors
/// Where stdout cannot be written; a closed one too.
pub fn put(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.write_all(b"\n")?;
    Ok(out.flush()?)
}

/// A value as JSON for stdout.
///
/// # Errors
/// As [`put`].
pub fn put_json(value: &impl Serialize) -> Result<()> {
    put(&serde_json::to_string_pretty(value)?)
}

/// A message for stderr. A failure to write it does not end the program.
pub fn say(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Whether messages may have colour.
pub fn stderr_has_colour() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|value| value == "dumb");
    io::stderr().is_terminal() && !refused && !dumb
}
