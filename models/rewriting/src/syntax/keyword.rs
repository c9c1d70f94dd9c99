//! The words with which the items of a file begin.
//!
//! `Axiom:` is such a word; `AXIOM :` are five modules and the colon of a production. Absent: what stands behind a word
//! (`file`).

use crate::letters::Letter;

/// An item of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keyword {
    System,
    Steps,
    Depth,
    Seed,
    Consider,
    Ignore,
    Axiom,
    Ring,
    Define,
    Start,
    StartEach,
    EndEach,
    End,
    Homomorphism,
    Decomposition,
    EndSystem,
}

/// Each word in small letters, and whether a colon ends it; a blank may be missing between two words.
const WORDS: [(&str, bool, Keyword); 16] = [
    ("lsystem", true, Keyword::System),
    ("derivation length", true, Keyword::Steps),
    ("maximum depth", true, Keyword::Depth),
    ("seed", true, Keyword::Seed),
    ("consider", true, Keyword::Consider),
    ("ignore", true, Keyword::Ignore),
    ("axiom", true, Keyword::Axiom),
    ("ring lsystem", false, Keyword::Ring),
    ("define", true, Keyword::Define),
    ("start each", true, Keyword::StartEach),
    ("start", true, Keyword::Start),
    ("end each", true, Keyword::EndEach),
    ("endlsystem", false, Keyword::EndSystem),
    ("end", true, Keyword::End),
    ("homomorphism", false, Keyword::Homomorphism),
    ("decomposition", false, Keyword::Decomposition),
];

/// The item that the letters begin with, and where it goes on behind its word.
pub(super) fn keyword(letters: &[Letter]) -> Option<(Keyword, usize)> {
    WORDS.iter().find_map(|&(word, colon, keyword)| {
        let end = matched(letters, word)?;
        let next = letters.get(end).map(|letter| letter.c);
        match next {
            Some(':') => Some((keyword, end + 1)),
            _ if colon => None,
            Some(c) if c.is_alphanumeric() || matches!(c, '(' | '_') => None,
            _ => Some((keyword, end)),
        }
    })
}

/// Where a word ends with which the letters begin; each part may begin with a capital.
fn matched(letters: &[Letter], word: &str) -> Option<usize> {
    let (mut at, mut first) = (0, true);
    for c in word.chars() {
        let found = letters.get(at).map(|letter| letter.c);
        match c {
            ' ' => {
                at += letters[at..].iter().take_while(|letter| matches!(letter.c, ' ' | '\t')).count();
                first = true;
                continue;
            }
            c if found == Some(c) || (first && found == Some(c.to_ascii_uppercase())) => at += 1,
            's' if word.ends_with("lsystem") && found == Some('S') => at += 1,
            'l' if word == "endlsystem" && found == Some('L') => at += 1,
            _ => return None,
        }
        first = false;
    }
    Some(at)
}
