//! Progress for programs (`--progress json`): events on stderr, a JSON object a line.
//!
//! Each has `event` and `seconds`. `checking` has the bytes that were read of the files that a resumed run or a merge
//! keeps; `begin`, `progress` (each second) and `end` have a [`Reading`]; `end` has the status too, in the words of
//! `--json`. Lines of stderr that are no events do not begin with `{`. Keys may be added, and none changes its meaning.
//! docs/clusters.md lists them.

use super::bar::meanwhile;
use super::terminal;
use phytomer::run::{Progress, Reading};
use phytomer_outputs::Checking;
use serde::Serialize;
use std::time::{Duration, Instant};

const PAUSE: Duration = Duration::from_secs(1);

#[derive(Serialize)]
struct Checked {
    event: &'static str,
    seconds: f64,
    bytes: u64,
    bytes_in_all: u64,
}

#[derive(Serialize)]
struct Grown {
    event: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    status: Option<&'static str>,
    #[serde(flatten)]
    now: Reading,
}

/// Does `work` and tells each second how far growth has come; `status` tells in a word how it ended.
pub fn growing<T>(progress: &Progress, status: impl Fn(&T) -> &'static str, work: impl FnOnce() -> T) -> T {
    let tell = |event, status| say(&Grown { event, status, now: progress.reading() });
    tell("begin", None);
    let result = meanwhile(PAUSE, || tell("progress", None), work);
    tell("end", Some(status(&result)));
    result
}

/// Does `work` and tells each second how much of the files has been read.
pub fn checking<T>(checking: &Checking, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let tell = || {
        let (bytes, bytes_in_all) = (checking.bytes(), checking.in_all());
        say(&Checked { event: "checking", seconds: start.elapsed().as_secs_f64(), bytes, bytes_in_all });
    };
    meanwhile(PAUSE, tell, work)
}

fn say(event: &impl Serialize) {
    if let Ok(line) = serde_json::to_string(event) {
        terminal::say(&line);
    }
}
