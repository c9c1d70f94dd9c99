//! The expressions of `#if` and `#elif`: numbers, operators and `defined(NAME)`; a name that is no macro is 0.
//!
//! Macros are expanded first, but for the names in `defined`. A call or an element of an array is 0 too. Absent: which
//! lines are such conditions (`directives`).

use super::macros::{Broken, Macros, word_end};
use crate::fault::{Fault, Place};
use crate::letters::Letter;
use crate::syntax::{Expression, Parser};

/// Whether the expression in these letters is not 0.
pub(super) fn holds(letters: &[Letter], place: Place, macros: &mut Macros) -> Result<bool, Broken> {
    let mut expanded = Vec::new();
    let asked = with_defined(letters, macros)?;
    macros.expand(&asked, &mut expanded)?;
    expanded.retain(|letter| letter.c != '\n');
    let mut parser = Parser::new(&expanded, place);
    let broken = |fault| Broken { fault, exhausted: false };
    let expression = parser.expression().map_err(broken)?;
    parser.ends().map_err(broken)?;
    Ok(value(&expression) != 0.0)
}

/// The letters with `defined NAME` and `defined(NAME)` replaced by 1 or 0.
fn with_defined(letters: &[Letter], macros: &mut Macros) -> Result<Vec<Letter>, Broken> {
    let (mut out, mut at) = (Vec::new(), 0);
    while at < letters.len() {
        let end = word_end(letters, at);
        let word: String = letters[at..end].iter().map(|letter| letter.c).collect();
        if word != "defined" {
            out.extend_from_slice(&letters[at..end]);
            at = end;
            continue;
        }
        let c = |at: usize| letters.get(at).map(|letter| letter.c);
        let start = behind_blanks(letters, end);
        let opened = c(start) == Some('(');
        let start = if opened { behind_blanks(letters, start + 1) } else { start };
        let inside = letters[start..].iter().map(|letter| letter.c);
        let name: String = inside.take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let behind = start + name.chars().count();
        let close = behind_blanks(letters, behind);
        if name.is_empty() || (opened && c(close) != Some(')')) {
            let place = letters[if name.is_empty() { at } else { close.min(letters.len() - 1) }].place;
            let fault = Fault::new(place, "`defined` asks for one name", "`defined(NAME)`, or `defined NAME`");
            return Err(Broken { fault, exhausted: false });
        }
        out.push(Letter { c: if macros.is_defined(&name) { '1' } else { '0' }, place: letters[at].place });
        at = if opened { close + 1 } else { behind };
    }
    Ok(out)
}

fn behind_blanks(letters: &[Letter], at: usize) -> usize {
    at + letters[at..].iter().take_while(|letter| letter.c.is_whitespace()).count()
}

fn value(expression: &Expression) -> f64 {
    match expression {
        Expression::Number(number) => *number,
        Expression::Negative(inner) => -value(inner),
        Expression::Not(inner) => f64::from(value(inner) == 0.0),
        Expression::Binary(operator, pair) => operator.apply(value(&pair.0), value(&pair.1)),
        Expression::Choice(three) => value(if value(&three.0) != 0.0 { &three.1 } else { &three.2 }),
        _ => 0.0,
    }
}
