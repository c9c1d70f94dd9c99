//! An error with its causes, each told once, and what to do where the disk is the cause.
//!
//! A message of this house does not repeat its cause. Those of other crates may, in their words and as their source;
//! such a cause is not told again. Absent: the messages.

use anyhow::Error;
use std::io;

/// The message of an error and those of its causes, from the outside to the inside.
pub fn in_words(error: &Error) -> String {
    let mut told: Vec<String> = Vec::new();
    for cause in error.chain().map(ToString::to_string) {
        if !told.iter().any(|earlier| earlier.ends_with(&cause)) {
            told.push(cause);
        }
    }
    let text = told.join(": ");
    if is_full_disk(error) { text + "\nfree some space; what is complete is kept" } else { text }
}

/// Whether a disk without room is the cause.
pub fn is_full_disk(error: &Error) -> bool {
    let full = |kind: io::ErrorKind| matches!(kind, io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded);
    error.chain().any(|cause| cause.downcast_ref::<io::Error>().is_some_and(|error| full(error.kind())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::Context;
    use phytomer_outputs::tables::TableError;
    use std::path::PathBuf;

    /// Says its cause itself and has it as its source, as many crates do.
    #[derive(Debug, thiserror::Error)]
    #[error("External: {0}")]
    struct Doubling(#[source] io::Error);

    #[test]
    fn each_cause_is_told_once() {
        let full = || io::Error::from(io::ErrorKind::StorageFull);
        let once = |error: &Error| {
            let text = in_words(error);
            assert_eq!(text.matches(&full().to_string()).count(), 1, "{text}");
            text
        };
        let ours = phytomer_outputs::FileError::Io { doing: "write", path: PathBuf::from("a/b"), source: full() };
        let told = once(&Error::new(ours).context("cannot finish"));
        assert!(told.starts_with("cannot finish: cannot write a/b: "), "{told}");
        assert!(told.ends_with("free some space; what is complete is kept"), "{told}");
        let table = TableError::Write { path: PathBuf::from("c"), source: Box::new(Doubling(full())) };
        assert!(once(&Error::new(table)).starts_with("cannot write the table c: External: "));
        once(&Err::<(), _>(full()).with_context(|| "cannot write the mesh d").unwrap_err());
        assert_eq!(in_words(&anyhow::anyhow!("plain")), "plain");
    }
}
