//! Numbers in a text, as they are read: words with their bytes, and their values.

/// The words of a text, each with its byte; `at` is the byte of the text itself.
pub fn words(text: &str, at: usize) -> impl Iterator<Item = (&str, usize)> {
    let start = text.as_ptr() as usize;
    text.split_ascii_whitespace().map(move |word| (word, at + (word.as_ptr() as usize - start)))
}

/// A finite number; `None` for any other word.
pub fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Whether a word stands for a value that is not known.
pub fn is_lacking(word: &str) -> bool {
    word.is_empty() || ["NA", "NaN", "null"].iter().any(|lacking| word.eq_ignore_ascii_case(lacking))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_know_their_bytes() {
        let found: Vec<_> = words(" 1\t-2.5 \n x ", 10).collect();
        assert_eq!(found, [("1", 11), ("-2.5", 13), ("x", 20)]);
        assert_eq!([number("1e-3"), number("inf"), number("NaN"), number("1,5")], [Some(1e-3), None, None, None]);
        assert!(is_lacking("na") && is_lacking("") && !is_lacking("0"));
    }
}
