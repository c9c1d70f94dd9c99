//! The nearest spelling of a name that nobody knows: of a variable or a function in an expression, of a state.
//!
//! Edit distance over characters, at most a third of the name's length (2 for short names). Absent on purpose:
//! unknown keys of a file, which `config` finds by itself.

/// The candidate nearest to `name`, if any is near; the first of equals.
pub(super) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Names are short; a longer one resembles none, and the distance costs the product of the lengths.
    let name: Vec<char> = name.to_lowercase().chars().take(64).collect();
    let limit = (name.len() / 3).max(2);
    candidates
        .into_iter()
        .map(|candidate| (distance(&name, &candidate.to_lowercase()), candidate))
        .filter(|&(edits, candidate)| edits <= limit && edits < candidate.chars().count())
        .min_by_key(|&(edits, _)| edits)
        .map(|(_, candidate)| candidate)
}

fn distance(a: &[char], b: &str) -> usize {
    let b: Vec<char> = b.chars().take(64).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

/// What was expected in place of an unknown name: the nearest spelling where there is one, else `otherwise`.
pub(super) fn expected<'a>(
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
pub(super) fn clip(text: &str) -> String {
    let mut clipped: String = text.chars().take(40).collect();
    if clipped.len() < text.len() {
        clipped.push('…');
    }
    clipped
}
