//! Python dictionaries, and JSON objects, read as data: nothing of a file is run.
//!
//! A file is a dictionary, or statements of which one gives a name a dictionary, as tree-gen's `params = {…}`. Values
//! are numbers with any signs, texts, `True`, `False`, `None`, lists, tuples and dictionaries, with commas at their
//! ends and comments. Depth and number of values are bounded. Absent: sums, calls, names, texts that are put together,
//! complex numbers; each is a fault at its place.

use crate::fault::{Wrong, said};
use crate::value::{Entry, Node, Value};
use std::ops::Range;

/// So deep may values stand in one another.
const DEEPEST: usize = 16;
/// So many values may a file have.
const MOST_VALUES: usize = 100_000;

/// The dictionary of a file.
pub(crate) fn dictionary(text: &str) -> Result<Vec<Entry>, Wrong> {
    let mut reader = Reader { text, at: 0, values: 0 };
    let mut found: Option<(String, Vec<Entry>)> = None;
    loop {
        reader.skip(true);
        if reader.at == text.len() {
            break;
        }
        let start = reader.at;
        let name = reader.assigned();
        let node = reader.value(0)?;
        reader.end_of_statement()?;
        let Value::Map(entries) = node.value else { continue };
        match &found {
            // Of several dictionaries the one that the generators read counts.
            Some((known, _)) if known == "params" => {}
            Some((known, _)) if name != "params" => {
                let problem = format!("a second dictionary, `{}`, after `{}`", said(&name), said(known));
                return Err(Wrong::new(
                    start..reader.at.min(start + 40),
                    problem,
                    "one dictionary, or one named `params`",
                ));
            }
            _ => found = Some((name, entries)),
        }
    }
    match found {
        Some((_, entries)) => Ok(entries),
        None => Err(Wrong::new(
            text.len()..text.len(),
            "the file has no dictionary",
            "a dictionary, such as `{'shape': 7}`",
        )),
    }
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
    values: usize,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// Goes past blanks and comments, and past ends of lines where they mean nothing.
    fn skip(&mut self, lines: bool) {
        while let Some(c) = self.peek() {
            match c {
                '#' => self.at += self.rest().find('\n').unwrap_or(self.rest().len()),
                '\n' | '\r' if !lines => return,
                ';' if !lines => return,
                '\\' if self.rest().starts_with("\\\n") => self.at += 2,
                c if c.is_whitespace() || (c == ';' && lines) => self.at += c.len_utf8(),
                _ => return,
            }
        }
    }

    fn take(&mut self, wanted: char) -> bool {
        let taken = self.peek() == Some(wanted);
        self.at += if taken { wanted.len_utf8() } else { 0 };
        taken
    }

    fn word(&self) -> &str {
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        &rest[..end]
    }

    /// The name that a statement gives its value, with what stands before the value; empty where it gives none.
    fn assigned(&mut self) -> String {
        let (start, name) = (self.at, self.word().to_owned());
        self.at += name.len();
        self.skip(false);
        let gives = self.rest().starts_with('=') && !self.rest().starts_with("==");
        if name.is_empty() || !gives {
            self.at = start;
            return String::new();
        }
        self.at += 1;
        self.skip(false);
        name
    }

    fn end_of_statement(&mut self) -> Result<(), Wrong> {
        self.skip(false);
        match self.peek() {
            None | Some('\n' | '\r' | ';') => Ok(()),
            Some(_) => Err(self.unexpected("the end of the line: values alone are read, and nothing is run")),
        }
    }

    fn unexpected(&self, expected: &str) -> Wrong {
        let word = self.word();
        match self.peek() {
            None => Wrong::new(self.at..self.at, "the file ends in the middle of a value", expected),
            Some(c) => {
                let word = if word.is_empty() { self.rest().get(..c.len_utf8()).unwrap_or("") } else { word };
                Wrong::new(self.at..self.at + word.len(), format!("`{}` stands here", said(word)), expected)
            }
        }
    }

    fn value(&mut self, depth: usize) -> Result<Node, Wrong> {
        let start = self.at;
        self.values += 1;
        if depth > DEEPEST || self.values > MOST_VALUES {
            let expected = format!("at most {MOST_VALUES} values, at most {DEEPEST} deep");
            let problem =
                if depth > DEEPEST { "values stand too deep in one another" } else { "there are too many values" };
            return Err(Wrong::new(start..start, problem, expected));
        }
        let value = match self.peek() {
            Some('{') => self.map(depth)?,
            Some('[') => self.list(depth, ']')?,
            Some('(') => self.list(depth, ')')?,
            Some('\'' | '"') => Value::Text(self.quoted(false)?),
            Some('+' | '-' | '.' | '0'..='9') => Value::Number(self.number()?),
            _ => self.named()?,
        };
        Ok(Node { value, bytes: start..self.at })
    }

    fn named(&mut self) -> Result<Value, Wrong> {
        let word = self.word().to_owned();
        let after = self.text[self.at + word.len()..].chars().next();
        if matches!(after, Some('\'' | '"')) && ["r", "R", "u", "U"].contains(&word.as_str()) {
            self.at += word.len();
            return Ok(Value::Text(self.quoted(word.eq_ignore_ascii_case("r"))?));
        }
        let value = match word.as_str() {
            "True" | "true" => Value::Bool(true),
            "False" | "false" => Value::Bool(false),
            "None" | "null" => Value::Nothing,
            _ => return Err(self.unexpected("a number, a text, a list or a dictionary: nothing of the file is run")),
        };
        self.at += word.len();
        Ok(value)
    }

    /// A list, a tuple, or a value in parentheses.
    fn list(&mut self, depth: usize, close: char) -> Result<Value, Wrong> {
        self.at += 1;
        let mut items = Vec::new();
        let mut comma = false;
        loop {
            self.skip(true);
            if self.take(close) {
                break;
            }
            items.push(self.value(depth + 1)?);
            self.skip(true);
            comma |= self.peek() == Some(',');
            if !self.take(',') && self.peek() != Some(close) {
                return Err(self.unexpected(&format!("`,` or `{close}`")));
            }
        }
        match items.pop() {
            Some(only) if close == ')' && !comma && items.is_empty() => Ok(only.value),
            last => {
                items.extend(last);
                Ok(Value::List(items))
            }
        }
    }

    fn map(&mut self, depth: usize) -> Result<Value, Wrong> {
        self.at += 1;
        let mut entries: Vec<Entry> = Vec::new();
        loop {
            self.skip(true);
            if self.take('}') {
                return Ok(Value::Map(entries));
            }
            let start = self.at;
            let node = self.value(depth + 1)?;
            let (at, Value::Text(key)) = (start..self.at, node.value) else {
                return Err(Wrong::new(node.bytes, "this key is no text", "a key in quotes"));
            };
            self.skip(true);
            if !self.take(':') {
                return Err(self.unexpected("`:` after a key"));
            }
            self.skip(true);
            let node = self.value(depth + 1)?;
            entries.push(Entry { key, at, node });
            self.skip(true);
            if !self.take(',') && self.peek() != Some('}') {
                return Err(self.unexpected("`,` or `}`"));
            }
        }
    }

    /// A number with any signs before it, such as `-0`, `1.`, `1_000` or `0x1F`.
    fn number(&mut self) -> Result<f64, Wrong> {
        let start = self.at;
        let mut negative = false;
        while let Some(sign @ ('+' | '-')) = self.peek() {
            negative ^= sign == '-';
            self.at += 1;
            self.skip(false);
        }
        let digits = self.digits();
        let written = self.text[digits.clone()].to_owned();
        self.at = digits.end;
        match parsed(&written) {
            Some(number) => Ok(if negative { -number } else { number }),
            None => {
                let problem = format!("`{}` is no finite number", said(&self.text[start..digits.end]));
                Err(Wrong::new(start..digits.end.max(start + 1), problem, "a number, such as `0.5`"))
            }
        }
    }

    /// The bytes of what is written like a number.
    fn digits(&self) -> Range<usize> {
        let rest = self.rest().as_bytes();
        let hexadecimal = rest.get(1).is_some_and(|c| matches!(c, b'x' | b'X'));
        let mut end = 0;
        while let Some(&c) = rest.get(end) {
            let exponent = !hexadecimal && end > 0 && matches!(rest[end - 1], b'e' | b'E');
            if !(c.is_ascii_alphanumeric() || c == b'.' || c == b'_' || (exponent && matches!(c, b'+' | b'-'))) {
                break;
            }
            end += 1;
        }
        self.at..self.at + end
    }

    fn quoted(&mut self, raw: bool) -> Result<String, Wrong> {
        let start = self.at;
        let quote = if self.rest().starts_with("'''") || self.rest().starts_with("\"\"\"") { 3 } else { 1 };
        let quote = self.rest()[..quote].to_owned();
        self.at += quote.len();
        let mut text = String::new();
        loop {
            if self.rest().starts_with(&quote) {
                self.at += quote.len();
                return Ok(text);
            }
            match self.peek() {
                Some('\\') => self.escape(raw, &mut text)?,
                Some('\n') | None if quote.len() == 1 || self.peek().is_none() => {
                    return Err(Wrong::new(start..self.at, "this text has no end", format!("`{quote}` at its end")));
                }
                Some(c) => {
                    text.push(c);
                    self.at += c.len_utf8();
                }
                None => {}
            }
        }
    }

    /// A character that is written with a backslash.
    fn escape(&mut self, raw: bool, text: &mut String) -> Result<(), Wrong> {
        let start = self.at;
        self.at += 1;
        let Some(c) = self.peek() else { return Ok(()) };
        self.at += c.len_utf8();
        let digits = match c {
            _ if raw => {
                text.extend(['\\', c]);
                return Ok(());
            }
            'x' => 2,
            'u' => 4,
            'U' => 8,
            _ => 0,
        };
        if digits == 0 {
            let known = [('n', '\n'), ('t', '\t'), ('r', '\r'), ('0', '\0'), ('b', '\u{8}'), ('f', '\u{c}')];
            let meant = known.iter().find(|(letter, _)| *letter == c).map(|(_, meant)| *meant);
            // A backslash at the end of a line joins the lines.
            text.extend((c != '\n').then_some(meant.unwrap_or(c)));
            return Ok(());
        }
        let code = self.rest().get(..digits).and_then(|hex| u32::from_str_radix(hex, 16).ok());
        // Halves of pairs of JSON stand for no character; names of trees that have them keep a mark.
        let character = code.map(|code| char::from_u32(code).unwrap_or('\u{fffd}'));
        let Some(character) = character else {
            return Err(Wrong::new(
                start..self.at,
                "this character has no number",
                format!("{digits} hexadecimal digits"),
            ));
        };
        self.at += digits;
        text.push(character);
        Ok(())
    }
}

/// The finite number of such letters.
fn parsed(written: &str) -> Option<f64> {
    let plain = written.replace('_', "");
    let lower = plain.to_ascii_lowercase();
    let number = match lower.strip_prefix("0x") {
        Some(hex) => u32::from_str_radix(hex, 16).ok().map(f64::from),
        // Names such as `inf` and `nan` begin with a letter, and numbers of Rust may end in none.
        None => lower.parse().ok().filter(|_| lower.starts_with(|c: char| c.is_ascii_digit() || c == '.')),
    };
    number.filter(|number: &f64| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<Entry> {
        dictionary(text).unwrap_or_else(|wrong| panic!("{:?}", wrong.placed(text)))
    }

    fn number(text: &str) -> f64 {
        match &read(&format!("{{'a': {text}}}"))[0].node.value {
            Value::Number(number) => *number,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn numbers_are_those_of_python() {
        let written = ["-0", "--2", "+ .5", "1.", "1_000", "0x1F", "1e-3", "-1E+2", "( (3) )"];
        assert_eq!(written.map(number), [0.0, 2.0, 0.5, 1.0, 1000.0, 31.0, 0.001, -100.0, 3.0]);
        assert!(number("-0").is_sign_negative());
        for bad in ["1e999", "1j", "1.2.3", "-", "0x", "nan", "inf", "1+2", "f(1)", "-inf", "__import__('os')"] {
            let text = format!("{{'a': {bad}}}");
            assert_eq!(dictionary(&text).expect_err(bad).placed(&text).line, 1, "{bad}");
        }
    }

    #[test]
    fn tuples_lists_comments_and_commas_at_the_end() {
        let text = "\"\"\" A\nTREE \"\"\"\n# before\nother = 3; params = {  # in\n\
            'a': (1, -2,),\n \"b\": [ ], 'c': (4,),\n}\n";
        let entries = read(text);
        let lists: Vec<usize> = entries
            .iter()
            .map(|entry| match &entry.node.value {
                Value::List(list) => list.len(),
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(lists, [2, 0, 1]);
        assert_eq!(&text[entries[1].at.clone()], "\"b\"");
        assert_eq!(read("{'a\\x41\\u00e9\\n': r'\\n', 'b': True, 'c': null}")[0].key, "aAé\n");
    }

    #[test]
    fn what_is_no_dictionary_is_told_with_its_place() {
        let deep = format!("{{'a': {}", "[".repeat(200_000));
        let wide = format!("{{'a': [{}]}}", "1,".repeat(200_000));
        let bad = [
            ("{'a': 1", (1, 8)),
            ("{'a': 1,\n 'b' 2}", (2, 6)),
            ("{'a': 'x\n'}", (1, 7)),
            ("import os\n", (1, 1)),
            ("x = 3\n", (2, 1)),
            ("a = {}\nb = {}\n", (2, 1)),
            ("{1: 2}", (1, 2)),
            ("", (1, 1)),
            (&deep, (1, 23)),
            (&wide, (1, 200_002)),
        ];
        for (text, place) in bad {
            let fault = dictionary(text).expect_err(said(text).as_str()).placed(text);
            assert_eq!((fault.line, fault.column), place, "{fault:?}");
        }
    }
}
