//! What a check of a run folder found, in the words and the JSON that `verify`, `describe` and `grow --resume` share.
//!
//! Absent: the check, which is `phytomer_outputs::check`, and what each verb makes of it.

use super::amounts;
use phytomer_outputs::{Checkup, Depth, Finding, Share, State};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// One word for programs.
pub fn word(state: State) -> &'static str {
    match state {
        State::InProgress => "in progress",
        State::Damaged => "damaged",
        State::Unfinished => "unfinished",
        State::Complete => "complete",
    }
}

/// "a damaged run"; "a complete shard 3/16".
pub fn kind_of(state: State, share: Option<Share>) -> String {
    let what = share.map_or("run".to_owned(), |share| format!("shard {share}"));
    match state {
        State::InProgress => format!("a {what} in progress"),
        State::Damaged => format!("a damaged {what}"),
        State::Unfinished => format!("an unfinished {what}"),
        State::Complete => format!("a complete {what}"),
    }
}

/// Everything that was found.
pub fn as_json(found: &Checkup) -> Value {
    let finding = |finding: &Finding| {
        let (problem, detail) = (finding.trouble.word(), finding.trouble.in_words());
        json!({"path": finding.path, "problem": problem, "detail": detail})
    };
    json!({
        "status": word(found.state),
        "bytes_checked": found.depth == Depth::Bytes,
        "files": found.files,
        "bytes": found.bytes,
        "shard": found.share,
        "parts": found.shards,
        "parts_sound": found.sound.len(),
        "parts_to_grow": found.to_grow,
        "holder": found.holder,
        "findings": found.findings.iter().map(finding).collect::<Vec<_>>(),
    })
}

/// A line each, for at most so many files.
pub fn lines(found: &Checkup, most: usize) -> String {
    let mut text = String::new();
    for Finding { path, trouble } in found.findings.iter().take(most) {
        let _ = write!(text, "\n  {path}: {}", trouble.in_words());
    }
    match found.findings.len().saturating_sub(most) {
        0 => text,
        more => text + &format!("\n  and {more} more"),
    }
}

/// What is the matter and what to do, in a sentence; `None` where nothing is.
pub fn advice(found: &Checkup) -> Option<String> {
    let parts = amounts::of(found.to_grow.len() as u64, "part");
    let again = match found.share {
        Some(share) => {
            &format!("`phytomer grow` with --resume, --shard {share}, the scenario and the folder of the shard")
        }
        None => "`phytomer grow` with --resume, and with the scenario and the folder of the run,",
    };
    match found.state {
        State::InProgress => {
            let holder = found.holder.as_ref().map(ToString::to_string).unwrap_or_default();
            Some(format!("it is being filled by {holder}; its complete parts alone were looked at"))
        }
        State::Damaged => Some(format!("{again} mends it: {parts} to grow again")),
        State::Unfinished => Some(format!("what is there is sound; {again} goes on: {parts} to grow")),
        State::Complete if found.findings.is_empty() => None,
        State::Complete => Some("all that the run names is sound; foreign files are left alone".to_owned()),
    }
}
