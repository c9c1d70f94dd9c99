//! Ctrl-C: what is running is told to stop, so that it ends with what it has done.
//!
//! Absent: how each verb stops, which asks now and then whether it was told to.

use super::{Verdict, terminal};
use anyhow::{Context, Result};

/// At the first Ctrl-C stops what is running and says `words`, where there are any; at the second ends the program, if
/// `is_stopped` tells that the first has not ended it yet.
///
/// # Errors
/// Where the system does not let Ctrl-C be heard.
pub fn listen(
    is_stopped: impl Fn() -> bool + Send + 'static,
    stop: impl Fn() + Send + 'static,
    words: &'static str,
) -> Result<()> {
    let obey = move || {
        if is_stopped() {
            std::process::exit(Verdict::Interrupted as i32);
        }
        stop();
        if !words.is_empty() {
            terminal::say(&format!("\n{words} (once more to end at once)"));
        }
    };
    ctrlc::set_handler(obey).context("cannot listen for Ctrl-C")
}
