//! The nearest spelling: the known name that an unknown name most likely means.
//!
//! Damerau–Levenshtein distance (a swap of neighbours counts once), with a cut-off of a third of the letters: beyond
//! that a guess is noise. A missing or wrong unit (`insertion` for `insertion_deg`), or a word half written, is always
//! near. The same rule serves the keys of files, the names of presets, and the variables, functions and states that
//! laws name. Absent: any dictionary; candidates are the names that would be right at that place.

use std::cmp::Reverse;

/// The candidate nearest to `typed`, if any is near enough. Of candidates at equal distance, the one that shares the
/// longest beginning with `typed`, then the shortest, then the first in alphabetical order. Cost: quadratic in the
/// length of `typed`, for each candidate.
pub fn nearest<'c>(typed: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    // A longer word is no typing error, and the cost is quadratic in its length.
    const LONGEST: usize = 64;
    if typed.is_empty() || typed.len() > LONGEST {
        return None;
    }
    let plain = fold(typed);
    let cutoff = (plain.chars().count() / 3).max(1);
    candidates
        .into_iter()
        .filter_map(|candidate| {
            let distance = distance(&plain, &fold(candidate));
            let alike = plain.chars().zip(candidate.chars()).take_while(|(a, b)| a == b).count();
            let near = distance <= cutoff && distance < candidate.chars().count();
            near.then_some((distance, Reverse(alike), candidate.len(), candidate))
        })
        .min()
        .map(|(.., candidate)| candidate)
}

/// `word` without differences that people overlook: case, hyphens and spaces.
fn fold(word: &str) -> String {
    word.trim().to_lowercase().replace(['-', ' '], "_")
}

fn distance(typed: &str, candidate: &str) -> usize {
    let unit_apart = |short: &str, long: &str| long.strip_prefix(short).is_some_and(|rest| rest.starts_with('_'));
    let begun = |short: &str, long: &str| short.len() >= 3 && 2 * short.len() >= long.len() && long.starts_with(short);
    let near = |short: &str, long: &str| unit_apart(short, long) || (short != long && begun(short, long));
    if near(typed, candidate) || near(candidate, typed) {
        return 1;
    }
    strsim::damerau_levenshtein(typed, candidate)
}

/// What was expected in place of an unknown name: the nearest spelling where there is one, else `otherwise`.
pub(crate) fn expected<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str> + Clone,
    otherwise: &str,
) -> String {
    let list: Vec<&str> = candidates.clone().into_iter().collect();
    match nearest(name, candidates) {
        Some(near) => format!("{otherwise}; the nearest is `{near}`"),
        None => format!("{otherwise}: {}", list.join(", ")),
    }
}

/// A text for a message: at most 40 characters of it.
pub(crate) fn clip(text: &str) -> String {
    let mut clipped: String = text.chars().take(40).collect();
    if clipped.len() < text.len() {
        clipped.push('…');
    }
    clipped
}

#[cfg(test)]
mod tests {
    use super::{expected, nearest};

    #[test]
    fn finds_slips_and_refuses_noise() {
        let keys = ["insertion_deg", "internode", "death", "pause"];
        assert_eq!(nearest("insertoin_deg", keys), Some("insertion_deg"));
        assert_eq!(nearest("insertion", keys), Some("insertion_deg"));
        assert_eq!(nearest("Insertion-deg", keys), Some("insertion_deg"));
        assert_eq!(nearest("deth", keys), Some("death"));
        assert_eq!(nearest("insertion_degrees", keys), Some("insertion_deg"));
        assert_eq!(nearest("colour", keys), None);
        assert_eq!(nearest("", keys), None);
        assert_eq!(nearest("x", ["a"]), None);
        assert_eq!(nearest("poplar_30", ["poplar", "poplar_30y"]), Some("poplar_30y"));
    }

    #[test]
    fn what_was_expected_names_the_nearest_or_all() {
        let states = ["juvenile", "adult"];
        assert_eq!(expected("adlut", states, "a state"), "a state; the nearest is `adult`");
        assert_eq!(expected("old", states, "a state"), "a state: juvenile, adult");
    }
}
