//! Which line continues the one before it.
//!
//! cpfg joins a line that begins with a tab to the last. Lines that begin with spaces are joined too, as the papers
//! print them, unless they are a production or an item of their own.

use super::keyword::keyword;
use crate::letters::Letter;

/// Where the text goes on behind the end of a line at `at`, if the next line with text continues this one. `complete`
/// tells that what stands before has its arrow already, or needs none.
pub(super) fn continued(letters: &[Letter], at: usize, complete: bool) -> Option<usize> {
    let mut start = at + 1;
    loop {
        let blanks = letters.get(start..)?.iter().take_while(|letter| is_blank(letter.c)).count();
        let first = letters.get(start + blanks)?;
        if first.c == '\n' {
            start += blanks + 1;
            continue;
        }
        let line = &letters[start + blanks..];
        let arrow = arrow_length(line).is_some();
        let joined = if complete {
            blanks > 0 && !has_arrow(line) && keyword(line).is_none()
        } else {
            arrow || (blanks > 0 && keyword(line).is_none())
        };
        return joined.then_some(start + blanks);
    }
}

/// Whether a character is a blank within a line.
pub(super) fn is_blank(c: char) -> bool {
    c != '\n' && c.is_whitespace()
}

/// The length of the arrow with which the letters begin: `-->`, `-o>`, `->` or `→`.
pub(super) fn arrow_length(letters: &[Letter]) -> Option<usize> {
    let c = |at: usize| letters.get(at).map(|letter| letter.c);
    match (c(0)?, c(1), c(2)) {
        ('→' | '⟶', ..) => Some(1),
        ('-', Some('-' | 'o'), Some('>')) => Some(3),
        ('-', Some('>'), _) => Some(2),
        _ => None,
    }
}

/// Whether an arrow stands in a line outside parentheses.
fn has_arrow(line: &[Letter]) -> bool {
    let mut depth = 0_i64;
    for (at, letter) in line.iter().enumerate().take_while(|(_, letter)| letter.c != '\n') {
        match letter.c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ if depth <= 0 && arrow_length(&line[at..]).is_some() => return true,
            _ => {}
        }
    }
    false
}
