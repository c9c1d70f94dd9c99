//! Why folders do not make up one run: what is wrong, in which folder, and what to do.
//!
//! A merge looks for faults before it writes anything, and tells all of a kind together. Absent: looking for them
//! (`merge`).

use super::difference::{Difference, Differences};
use super::holder::Holder;
use super::share::Share;
use std::fmt;
use std::path::PathBuf;

/// A reason why folders do not make up one run.
#[derive(Debug, thiserror::Error)]
pub enum MergeFault {
    /// The folder cannot be checked.
    #[error("{0}")]
    Unreadable(String),
    /// A file of the folder is missing or damaged.
    #[error(
        "{}: {file}: {how}; `phytomer grow` with --resume, and with the scenario, the shard and the folder, mends it",
        folder.display()
    )]
    Damaged {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: String,
        /// The fault of the file.
        how: String,
    },
    /// A process fills the folder.
    #[error("{} is being filled by {holder}: wait for its end", folder.display())]
    InProgress {
        /// The folder.
        folder: PathBuf,
        /// The process.
        holder: Holder,
    },
    /// The folder is of another run than the first folder.
    #[error("{} is of another run than {}. What differs:\n{}", folder.display(), first.display(), side_by_side(differences))]
    OtherRun {
        /// The folder.
        folder: PathBuf,
        /// The first folder.
        first: PathBuf,
        /// The differences.
        differences: Differences,
    },
    /// The folder was written by a program whose run folders this program does not know.
    #[error(
        "{} was written by phytomer {version} ({git_hash}), whose run folders have another format: merge with that program",
        folder.display()
    )]
    OtherProgram {
        /// The folder.
        folder: PathBuf,
        /// The version of the program that wrote it.
        version: String,
        /// The commit of that program.
        git_hash: String,
    },
    /// The folder is the one that is to be made.
    #[error("{} is the folder that the parts are merged into: name another folder for it", folder.display())]
    Target {
        /// The folder.
        folder: PathBuf,
    },
    /// Two folders have the same parts.
    #[error(
        "{} and {} both hold {}: leave out one of the two folders",
        first.display(), second.display(), in_words(parts)
    )]
    Overlap {
        /// The folder that was named first.
        first: PathBuf,
        /// The other folder.
        second: PathBuf,
        /// The parts.
        parts: Vec<u32>,
    },
    /// A folder lacks parts of its own.
    #[error(
        "{} lacks {}: it is unfinished; go on with it by `phytomer grow` with --resume, and with the scenario{}",
        folder.display(), in_words(parts), share.map(|share| format!(" and --shard {share}")).unwrap_or_default()
    )]
    Unfinished {
        /// The folder.
        folder: PathBuf,
        /// The share that it has.
        share: Option<Share>,
        /// The parts.
        parts: Vec<u32>,
    },
    /// No folder has some parts.
    #[error("no folder holds {} of {of}{}", in_words(parts), advice(shares))]
    Gap {
        /// The parts.
        parts: Vec<u32>,
        /// The number of parts of the run.
        of: u32,
        /// The shares that they are, where all folders have shares of one number.
        shares: Vec<Share>,
    },
}

/// All reasons why folders do not make up one run.
#[derive(Debug)]
pub struct MergeFaults(pub Vec<MergeFault>);

impl fmt::Display for MergeFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> =
            self.0.iter().map(|fault| format!("  {}", fault.to_string().replace('\n', "\n  "))).collect();
        f.write_str(&lines.join("\n"))
    }
}

/// "part 3", "the parts 1 to 4, 7"; of a folder that was not closed when all its parts were there, "its end".
fn in_words(parts: &[u32]) -> String {
    const SHOWN: usize = 8;
    if parts.is_empty() {
        return "its end".to_owned();
    }
    let mut ranges: Vec<(u32, u32)> = Vec::new();
    for part in parts {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == *part => *last = *part,
            _ => ranges.push((*part, *part)),
        }
    }
    let word = |(first, last): &(u32, u32)| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first} to {last}"),
    };
    let words: Vec<String> = ranges.iter().take(SHOWN).map(word).collect();
    let more = if ranges.len() > SHOWN { format!(" … ({} in all)", parts.len()) } else { String::new() };
    format!("{} {}{more}", if parts.len() == 1 { "part" } else { "the parts" }, words.join(", "))
}

/// A line for each difference between a folder and the first folder.
fn side_by_side(Differences(differences): &Differences) -> String {
    const SHOWN: usize = 6;
    let value = |value: &Option<String>| value.clone().unwrap_or_else(|| "nothing".to_owned());
    let line = |of: &Difference| format!("  {}: {}, and {} in the first", of.key, value(&of.run), value(&of.now));
    let mut lines: Vec<String> = differences.iter().take(SHOWN).map(line).collect();
    lines.extend((differences.len() > SHOWN).then(|| format!("  and {} more", differences.len() - SHOWN)));
    lines.join("\n")
}

fn advice(shares: &[Share]) -> String {
    const SHOWN: usize = 8;
    if shares.is_empty() {
        return ": name the folders that hold them, or grow them".to_owned();
    }
    let words: Vec<String> = shares.iter().take(SHOWN).map(|share| format!("--shard {share}")).collect();
    let more = if shares.len() > SHOWN { format!(" … ({} in all)", shares.len()) } else { String::new() };
    format!(": name the folders of {}{more}, or grow them", words.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_told_as_ranges() {
        assert_eq!(in_words(&[3]), "part 3");
        assert_eq!(in_words(&[1, 2]), "the parts 1, 2");
        assert_eq!(in_words(&[0, 1, 2, 5, 7, 8]), "the parts 0 to 2, 5, 7, 8");
        let odd: Vec<u32> = (0..40).map(|part| 2 * part + 1).collect();
        assert_eq!(in_words(&odd), "the parts 1, 3, 5, 7, 9, 11, 13, 15 … (40 in all)");
    }
}
