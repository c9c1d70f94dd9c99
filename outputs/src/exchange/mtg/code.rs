//! The code of an entity: signs and labels, such as `^/A1+U2/E1<<E35`.
//!
//! `/` begins the parts of a complex, `<` follows, `+` branches; `<<` and `++` stand for all entities with an index up
//! to that after them, the last of which has the features of the line; of `<.<` and `+.+` each has them. `^` goes on
//! from the entity above in the same column, `(name)` from the entity with this alias.

/// How an entity is related to the one before it in its code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// `/`
    Decomposes,
    /// `<`
    Follows,
    /// `+`
    Branches,
    /// `<<`, and `<.<` where each has the features.
    FollowTo { each: bool },
    /// `++`, and `+.+` where each has the features.
    BranchTo { each: bool },
}

/// An entity of a code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Labelled<'t> {
    pub sign: Sign,
    /// Its symbol and index, as they stand there.
    pub label: &'t str,
}

/// Where a code goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum From<'t> {
    /// From the entity of the column on its left.
    Left,
    /// From the entity above in its column (`^`).
    Above,
    /// From the entity with an alias.
    Alias(&'t str),
}

/// What is wrong with a code: the part that is, and what is expected.
pub type Wrong<'t> = (&'t str, &'static str);

/// Where a code goes on.
pub fn from(code: &str) -> Result<(From<'_>, &str), Wrong<'_>> {
    if let Some(rest) = code.strip_prefix('^') {
        return Ok((From::Above, rest));
    }
    let Some(rest) = code.strip_prefix('(') else { return Ok((From::Left, code)) };
    match rest.split_once(')') {
        Some((alias, rest)) => Ok((From::Alias(alias.trim()), rest)),
        None => Err((code, "a closing parenthesis after the alias")),
    }
}

/// The next entity of a code, and the rest of the code; `None` at its end.
pub fn next(code: &str) -> Result<Option<(Labelled<'_>, &str)>, Wrong<'_>> {
    let code = code.trim_start();
    if code.is_empty() {
        return Ok(None);
    }
    const SIGNS: [(&str, Sign); 7] = [
        ("<.<", Sign::FollowTo { each: true }),
        ("+.+", Sign::BranchTo { each: true }),
        ("<<", Sign::FollowTo { each: false }),
        ("++", Sign::BranchTo { each: false }),
        ("/", Sign::Decomposes),
        ("<", Sign::Follows),
        ("+", Sign::Branches),
    ];
    let Some((sign, rest)) = SIGNS.iter().find_map(|(text, sign)| Some((*sign, code.strip_prefix(text)?))) else {
        return Err((code, "a sign before each label: `/`, `<`, `+`, `<<`, `++`, `<.<` or `+.+`"));
    };
    let rest = rest.trim_start();
    let end = rest.find(['/', '<', '+', '^', '(', ')', '*', ' ']).unwrap_or(rest.len());
    if end == 0 {
        return Err((code, "a label after the sign, such as `U1`"));
    }
    Ok(Some((Labelled { sign, label: &rest[..end] }, &rest[end..])))
}

/// Symbol and index of a label, and the letters behind the index, as `A2a` has one in measured files. The index may be
/// missing, and may have decimals. `None` where it is no number.
pub fn symbol_and_index(label: &str) -> Option<(&str, Option<f64>, &str)> {
    let digits = label.find(|c: char| c.is_ascii_digit()).unwrap_or(label.len());
    let (symbol, index) = label.split_at(digits);
    if index.is_empty() {
        return Some((symbol, None, ""));
    }
    let (index, letters) = index.split_at(index.trim_end_matches(|c: char| c.is_ascii_alphabetic()).len());
    let plain = index.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.') && index.len() <= 18;
    let number = if plain { index.parse::<f64>().ok() } else { None };
    number.map(|number| (symbol, Some(number), letters))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(mut code: &str) -> Vec<(Sign, String)> {
        let mut found = Vec::new();
        while let Some((entity, rest)) = next(code).unwrap() {
            found.push((entity.sign, entity.label.to_owned()));
            code = rest;
        }
        found
    }

    #[test]
    fn codes_are_signs_and_labels() {
        let (start, rest) = from("^/A1+U2/E1<<E35").unwrap();
        assert_eq!(start, From::Above);
        let last = (Sign::FollowTo { each: false }, "E35".to_owned());
        assert_eq!(labels(rest).len(), 4);
        assert_eq!(labels(rest)[3], last);
        assert_eq!(labels("+.+A3"), [(Sign::BranchTo { each: true }, "A3".to_owned())]);
        assert_eq!(from("(Z)+A1").unwrap(), (From::Alias("Z"), "+A1"));
        assert!(from("(Z+A1").is_err());
        assert!(next("A1").is_err());
        assert!(next("/+A1").is_err());
    }

    #[test]
    fn an_index_may_be_missing_or_have_decimals_or_letters() {
        assert_eq!(symbol_and_index("Metamer12"), Some(("Metamer", Some(12.0), "")));
        assert_eq!(symbol_and_index("A"), Some(("A", None, "")));
        assert_eq!(symbol_and_index("U1.5"), Some(("U", Some(1.5), "")));
        assert_eq!(symbol_and_index("U1x"), Some(("U", Some(1.0), "x")));
        assert_eq!(symbol_and_index("U1x2"), None);
        assert_eq!(symbol_and_index("U1..5"), None);
    }
}
