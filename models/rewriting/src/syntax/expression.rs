//! Expressions, and the reader over letters that all other parts of the syntax read with.
//!
//! The operators and their ranks are those of cpfg: `?:`, `||`, `&&`, `== !=`, `< <= > >=`, `+ -`, `* / %`, `^` from
//! the left, and above all of these the sign and `!`, so that −2^2 is 4. The papers add `‖`, `≤`, `≥`, `≠`, `=` in
//! conditions, `2y` for a product, and `min{…}`.

use super::lines::{arrow_length, continued, is_blank};
use super::tree::{Expression, Name, Operator};
use crate::fault::{Fault, Place};
use crate::letters::Letter;

/// The most parts of an expression, and the most parentheses within parentheses.
const MOST_PARTS: u32 = 600;
const DEEPEST: u32 = 60;

/// Reads letters from the first to the last.
pub(crate) struct Parser<'l> {
    pub(super) letters: &'l [Letter],
    pub(super) at: usize,
    /// The place of what is missing behind the last letter.
    end: Place,
    /// Parentheses and braces in which the ends of lines are blanks.
    pub(super) inside: u32,
    /// Whether what is read has its arrow already, or needs none.
    pub(super) complete: bool,
    /// Whether `&` may stand before a name, as in the arguments of `fscanf`.
    addresses: bool,
    /// Whether parentheses are branches, and modules have no parameters.
    pub(super) cells: bool,
    depth: u32,
    parts: u32,
}

impl<'l> Parser<'l> {
    pub fn new(letters: &'l [Letter], end: Place) -> Self {
        let end = letters.last().map_or(end, |last| last.place);
        let (inside, complete) = (0, true);
        Self { letters, at: 0, end, inside, complete, addresses: false, cells: false, depth: 0, parts: 0 }
    }

    pub(super) fn place(&self) -> Place {
        self.letters.get(self.at).map_or(self.end, |letter| letter.place)
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.letters.get(self.at).map(|letter| letter.c)
    }

    pub(super) fn peek_after(&self, letters: usize) -> Option<char> {
        self.letters.get(self.at + letters).map(|letter| letter.c)
    }

    pub(super) fn rest(&self) -> &'l [Letter] {
        self.letters.get(self.at..).unwrap_or(&[])
    }

    /// Passes over blanks, and over the ends of lines that are continued.
    pub(super) fn blanks(&mut self) {
        while let Some(c) = self.peek() {
            if is_blank(c) || (c == '\n' && self.inside > 0) {
                self.at += 1;
            } else if c == '\n'
                && let Some(next) = continued(self.letters, self.at, self.complete)
            {
                self.at = next;
            } else {
                break;
            }
        }
    }

    /// Passes over blanks and then over `c`, if it stands there.
    pub(super) fn takes(&mut self, c: char) -> bool {
        self.blanks();
        let found = self.peek() == Some(c);
        self.at += usize::from(found);
        found
    }

    pub(super) fn expects(&mut self, c: char) -> Result<(), Fault> {
        if self.takes(c) { Ok(()) } else { Err(self.unexpected(&format!("`{c}`"))) }
    }

    /// The fault of what stands here, where something else was expected.
    pub(super) fn unexpected(&self, expected: &str) -> Fault {
        let found = match self.peek() {
            None => "the end of the file".to_owned(),
            Some('\n') => "the end of the line".to_owned(),
            Some(c) if c.is_alphanumeric() => {
                let is_word = |letter: &&Letter| letter.c.is_alphanumeric() || letter.c == '_';
                let word: String = self.rest().iter().take_while(is_word).take(30).map(|letter| letter.c).collect();
                format!("`{word}`")
            }
            Some(c) if c.is_control() => "a character that cannot be shown".to_owned(),
            Some(c) => format!("`{c}`"),
        };
        Fault::new(self.place(), format!("{found} stands here"), expected)
    }

    /// Nothing follows in the line.
    pub fn ends(&mut self) -> Result<(), Fault> {
        self.blanks();
        match self.peek() {
            None | Some('\n') => Ok(()),
            Some(_) => Err(self.unexpected("the end of the line")),
        }
    }

    /// A name of letters, digits and underscores, if one stands here.
    pub(super) fn name(&mut self) -> Option<Name> {
        self.blanks();
        let place = self.place();
        let is_word = |letter: &&Letter| letter.c.is_alphanumeric() || letter.c == '_';
        if !self.peek().is_some_and(|c| c.is_alphabetic() || c == '_') {
            return None;
        }
        let name: String = self.rest().iter().take_while(is_word).map(|letter| letter.c).collect();
        self.at += name.chars().count();
        Some(Name { name, place })
    }

    /// Whether an arrow stands here.
    pub(super) fn arrow(&self) -> Option<usize> {
        arrow_length(self.rest())
    }

    /// An expression.
    pub fn expression(&mut self) -> Result<Expression, Fault> {
        if self.depth == 0 {
            self.parts = 0;
        }
        if self.depth >= DEEPEST {
            return Err(Fault::new(
                self.place(),
                "too many parentheses within one another",
                format!("at most {DEEPEST}"),
            ));
        }
        self.depth += 1;
        let result = self.choice();
        self.depth -= 1;
        result
    }

    fn choice(&mut self) -> Result<Expression, Fault> {
        let condition = self.binary(1)?;
        if !self.takes('?') {
            return Ok(condition);
        }
        let yes = self.expression()?;
        self.expects(':')?;
        let no = self.expression()?;
        Ok(Expression::Choice(Box::new((condition, yes, no))))
    }

    /// A chain of operators of at least a rank, from the left.
    fn binary(&mut self, rank: u8) -> Result<Expression, Fault> {
        let mut left = self.unary()?;
        while let Some((operator, length)) = self.operator().filter(|(operator, _)| operator.rank() >= rank) {
            self.at += length;
            self.count_part()?;
            let right = if operator == Operator::Power { self.unary()? } else { self.binary(operator.rank() + 1)? };
            left = Expression::Binary(operator, Box::new((left, right)));
        }
        Ok(left)
    }

    fn count_part(&mut self) -> Result<(), Fault> {
        self.parts += 1;
        if self.parts > MOST_PARTS {
            return Err(Fault::new(self.place(), "the expression is too long", format!("at most {MOST_PARTS} parts")));
        }
        Ok(())
    }

    fn operator(&mut self) -> Option<(Operator, usize)> {
        self.blanks();
        if self.arrow().is_some() {
            return None;
        }
        Some(match (self.peek()?, self.peek_after(1)) {
            ('|', Some('|')) => (Operator::Or, 2),
            ('|' | '‖' | '∥', _) => (Operator::Or, 1),
            ('&', Some('&')) => (Operator::And, 2),
            ('&', _) => (Operator::And, 1),
            ('=', Some('=')) | ('!' | '<', Some('=' | '>'))
                if self.peek() != Some('<') || self.peek_after(1) == Some('>') =>
            {
                (if self.peek() == Some('=') { Operator::Equal } else { Operator::NotEqual }, 2)
            }
            ('=', _) => (Operator::Equal, 1),
            ('≠', _) => (Operator::NotEqual, 1),
            ('<', Some('=')) => (Operator::LessEqual, 2),
            ('≤', _) => (Operator::LessEqual, 1),
            ('<', _) => (Operator::Less, 1),
            ('>', Some('=')) => (Operator::GreaterEqual, 2),
            ('≥', _) => (Operator::GreaterEqual, 1),
            ('>', _) => (Operator::Greater, 1),
            ('+', _) => (Operator::Add, 1),
            ('-', _) => (Operator::Subtract, 1),
            ('*' | '×' | '·', _) => (Operator::Multiply, 1),
            ('/', _) => (Operator::Divide, 1),
            ('%', _) => (Operator::Remainder, 1),
            ('^', _) => (Operator::Power, 1),
            _ => return None,
        })
    }

    /// Signs and negations, which bind more closely than any operator.
    fn unary(&mut self) -> Result<Expression, Fault> {
        let mut signs = Vec::new();
        loop {
            self.blanks();
            match self.peek() {
                Some(sign @ ('-' | '!' | '+')) if self.arrow().is_none() => signs.push(sign),
                _ => break,
            }
            self.at += 1;
            self.count_part()?;
        }
        let mut inner = self.operand()?;
        for sign in signs.into_iter().rev() {
            inner = match sign {
                '-' => Expression::Negative(Box::new(inner)),
                '!' => Expression::Not(Box::new(inner)),
                _ => inner,
            };
        }
        Ok(inner)
    }

    fn operand(&mut self) -> Result<Expression, Fault> {
        self.count_part()?;
        if self.addresses {
            let _ = self.takes('&');
            self.blanks();
        }
        match self.peek() {
            Some('(') => self.enclosed('(', ')'),
            Some('"') => self.text(),
            Some(c) if c.is_ascii_digit() || c == '.' => self.product_of_number(),
            _ => match self.name() {
                Some(name) => self.named(name),
                None => Err(self.unexpected("a number, a name or `(`")),
            },
        }
    }

    fn enclosed(&mut self, open: char, close: char) -> Result<Expression, Fault> {
        self.expects(open)?;
        self.inside += 1;
        let inner = self.expression();
        let closed = inner.and_then(|inner| self.expects(close).map(|()| inner));
        self.inside -= 1;
        closed
    }

    fn text(&mut self) -> Result<Expression, Fault> {
        let rest = self.rest();
        let length = rest[1..].iter().position(|letter| letter.c == '"' || letter.c == '\n');
        match length.filter(|&length| rest[length + 1].c == '"') {
            Some(length) => {
                self.at += length + 2;
                Ok(Expression::Text(rest[1..=length].iter().map(|letter| letter.c).collect()))
            }
            None => {
                Err(Fault::new(self.place(), "a text begins and does not end", "`\"` at its end, in the same line"))
            }
        }
    }

    /// A number, or a number times what follows it without a sign between them.
    fn product_of_number(&mut self) -> Result<Expression, Fault> {
        let number = Expression::Number(self.number()?);
        if !self.peek().is_some_and(|c| c.is_alphabetic() || c == '(') {
            return Ok(number);
        }
        let mut factor = self.operand()?;
        if self.takes('^') {
            self.count_part()?;
            factor = Expression::Binary(Operator::Power, Box::new((factor, self.unary()?)));
        }
        Ok(Expression::Binary(Operator::Multiply, Box::new((number, factor))))
    }

    /// A number with point and exponent.
    fn number(&mut self) -> Result<f64, Fault> {
        let place = self.place();
        let digits = |from: usize| self.rest()[from..].iter().take_while(|letter| letter.c.is_ascii_digit()).count();
        let mut length = digits(0);
        if self.peek_after(length) == Some('.') {
            length += 1 + digits(length + 1);
        }
        if matches!(self.peek_after(length), Some('e' | 'E')) {
            let sign = usize::from(matches!(self.peek_after(length + 1), Some('+' | '-')));
            let exponent = digits((length + 1 + sign).min(self.rest().len()));
            length += if exponent > 0 { 1 + sign + exponent } else { 0 };
        }
        let text: String = self.rest()[..length].iter().map(|letter| letter.c).collect();
        self.at += length;
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(Fault::new(
                place,
                format!("`{}` is no number", text.chars().take(40).collect::<String>()),
                "a number",
            )),
        }
    }

    /// What a name begins: a call, an element of an array, or the name alone.
    fn named(&mut self, name: Name) -> Result<Expression, Fault> {
        let behind = self.at;
        self.blanks();
        match self.peek() {
            Some('(') => {
                let before = std::mem::replace(&mut self.addresses, name.name == "fscanf");
                let list = self.list('(', ')');
                self.addresses = before;
                Ok(Expression::Call(name, list?))
            }
            Some('{') if matches!(name.name.as_str(), "min" | "max") => {
                Ok(Expression::Call(name, self.list('{', '}')?))
            }
            Some('[') => {
                let mut index = Vec::new();
                while self.peek() == Some('[') {
                    index.push(self.enclosed('[', ']')?);
                    self.blanks();
                }
                Ok(Expression::Element(name, index))
            }
            _ => {
                self.at = behind;
                Ok(Expression::Name(name))
            }
        }
    }

    /// Expressions between two signs, with commas between them.
    pub(super) fn list(&mut self, open: char, close: char) -> Result<Vec<Expression>, Fault> {
        self.expects(open)?;
        self.inside += 1;
        let list = self.items(close);
        self.inside -= 1;
        list
    }

    fn items(&mut self, close: char) -> Result<Vec<Expression>, Fault> {
        let mut list = Vec::new();
        if self.takes(close) {
            return Ok(list);
        }
        loop {
            list.push(self.expression()?);
            if self.takes(close) {
                return Ok(list);
            }
            if !self.takes(',') {
                return Err(self.unexpected(&format!("`,` or `{close}`")));
            }
        }
    }
}
