//! The parser of free expressions: text to postfix code, by precedence climbing.
//!
//! Bounded in length and depth, so that no text can exhaust the stack. Precedence from loose to tight: or, and, not,
//! comparisons (which do not chain), + −, * /, unary minus, ^ (from the right; −2^2 = −4). A name whose values are
//! words is compared with a word in quotes and stands nowhere else. Errors carry the column in the text, from 1, in
//! characters.

use super::expression::{
    COMPARISON, Expression, FUNCTIONS, Function, INFIXES, Infix, MINUS, NOT, Op, POWER, Vocabulary, is_true, truth,
};
use super::spelling;

/// The longest expression, in characters.
const MAX_LENGTH: usize = 2000;
/// The deepest nesting of parentheses and operators.
const MAX_DEPTH: u32 = 64;

/// Why a text is not an expression.
#[derive(Debug, PartialEq)]
pub(super) struct ParseError {
    /// Where, in characters from 1.
    pub column: usize,
    pub problem: String,
    pub expected: String,
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64),
    Name(String),
    /// A word in quotes.
    Text(String),
    Symbol(&'static str),
    End,
}

impl Token {
    fn describe(&self) -> String {
        match self {
            Self::Number(number) => format!("unexpected number {number}"),
            Self::Name(name) => format!("unexpected name `{}`", spelling::clip(name)),
            Self::Text(text) => format!("unexpected text '{}'", spelling::clip(text)),
            Self::Symbol(symbol) => format!("unexpected `{symbol}`"),
            Self::End => "the expression ends too early".to_owned(),
        }
    }
}

fn error<T>(column: usize, problem: impl Into<String>, expected: impl Into<String>) -> Result<T, ParseError> {
    Err(ParseError { column, problem: problem.into(), expected: expected.into() })
}

/// Parses an expression over the names of a vocabulary.
pub(super) fn parse<V: Vocabulary>(text: &str, vocabulary: &V) -> Result<Expression<V::Name>, ParseError> {
    let chars: Vec<char> = text.chars().take(MAX_LENGTH + 1).collect();
    if chars.len() > MAX_LENGTH {
        return error(MAX_LENGTH, "the expression is too long", format!("at most {MAX_LENGTH} characters"));
    }
    let mut parser = Parser { tokens: tokens(&chars)?, next: 0, depth: 0, code: Vec::new(), vocabulary };
    parser.expression(0)?;
    match parser.token() {
        Token::End => Ok(Expression { code: parser.code }),
        token => error(parser.column(), token.describe(), "an operator or the end of the expression"),
    }
}

/// Longest first, so that `<=` is not read as `<`.
const SYMBOLS: [&str; 14] = ["<=", ">=", "==", "!=", "<", ">", "+", "-", "*", "/", "^", "(", ")", ","];

fn tokens(chars: &[char]) -> Result<Vec<(usize, Token)>, ParseError> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < chars.len() {
        if chars[at].is_whitespace() {
            at += 1;
            continue;
        }
        let (token, len) = token(&chars[at..], at + 1)?;
        tokens.push((at + 1, token));
        at += len;
    }
    tokens.push((chars.len() + 1, Token::End));
    Ok(tokens)
}

fn token(rest: &[char], column: usize) -> Result<(Token, usize), ParseError> {
    let first = rest[0];
    if first.is_ascii_digit() || first == '.' {
        return number(rest, column);
    }
    if first.is_alphabetic() || first == '_' {
        let name: String = rest.iter().take_while(|c| c.is_alphanumeric() || **c == '_').collect();
        let len = name.chars().count();
        return Ok((Token::Name(name), len));
    }
    if first == '\'' || first == '"' {
        let text: String = rest[1..].iter().take_while(|c| **c != first).collect();
        let len = text.chars().count() + 2;
        return match len <= rest.len() {
            true => Ok((Token::Text(text), len)),
            false => error(column, "a text without an end", format!("`{first}` at its end")),
        };
    }
    let starts = |symbol: &&&str| symbol.chars().enumerate().all(|(i, c)| rest.get(i) == Some(&c));
    match SYMBOLS.iter().find(starts) {
        Some(symbol) => Ok((Token::Symbol(symbol), symbol.len())),
        None => error(column, format!("unexpected character `{first}`"), "a number, a name or an operator"),
    }
}

fn number(rest: &[char], column: usize) -> Result<(Token, usize), ParseError> {
    let digits = |from: usize| rest[from.min(rest.len())..].iter().take_while(|c| c.is_ascii_digit()).count();
    let mut len = digits(0);
    if rest.get(len) == Some(&'.') {
        len += 1 + digits(len + 1);
    }
    if matches!(rest.get(len), Some('e' | 'E')) {
        let sign = usize::from(matches!(rest.get(len + 1), Some('+' | '-')));
        let exponent = digits(len + 1 + sign);
        len += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    let text: String = rest[..len].iter().collect();
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok((Token::Number(number), len)),
        _ => error(column, format!("`{}` is not a number", spelling::clip(&text)), "a number such as 0.05 or 8.89e-8"),
    }
}

struct Parser<'v, V: Vocabulary> {
    tokens: Vec<(usize, Token)>,
    next: usize,
    depth: u32,
    code: Vec<Op<V::Name>>,
    vocabulary: &'v V,
}

impl<V: Vocabulary> Parser<'_, V> {
    fn token(&self) -> Token {
        self.tokens.get(self.next).map_or(Token::End, |(_, token)| token.clone())
    }

    fn column(&self) -> usize {
        self.tokens.get(self.next).or(self.tokens.last()).map_or(1, |(column, _)| *column)
    }

    fn infix(&self) -> Option<&'static Infix> {
        let symbol = match self.tokens.get(self.next) {
            Some((_, Token::Symbol(symbol))) => symbol,
            Some((_, Token::Name(name))) => name.as_str(),
            _ => return None,
        };
        INFIXES.iter().find(|infix| infix.symbol == symbol)
    }

    /// An operand and all operators of at least this precedence that follow it.
    fn expression(&mut self, loosest: u8) -> Result<(), ParseError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return error(self.column(), "the expression is nested too deeply", format!("at most {MAX_DEPTH} levels"));
        }
        self.operand()?;
        let mut compared = false;
        while let Some(infix) = self.infix().filter(|infix| infix.precedence >= loosest) {
            if infix.precedence == COMPARISON && compared {
                return error(self.column(), "comparisons do not chain", "`and` between two comparisons");
            }
            compared = infix.precedence == COMPARISON;
            self.next += 1;
            self.expression(if infix.precedence == POWER { POWER } else { infix.precedence + 1 })?;
            self.code.push(Op::Binary(infix.apply));
        }
        self.depth -= 1;
        Ok(())
    }

    fn operand(&mut self) -> Result<(), ParseError> {
        let column = self.column();
        let token = self.token();
        self.next += 1;
        match token {
            Token::Number(number) => self.code.push(Op::Number(number)),
            Token::Symbol("(") => {
                self.expression(0)?;
                self.symbol(")")?;
            }
            Token::Symbol("-") => {
                self.expression(MINUS)?;
                self.code.push(Op::Unary(|x| -x));
            }
            Token::Symbol("+") => self.expression(MINUS)?,
            Token::Name(name) if name == "not" => {
                self.expression(NOT)?;
                self.code.push(Op::Unary(|x| truth(!is_true(x))));
            }
            Token::Name(name) if matches!(name.as_str(), "and" | "or") => {
                return error(column, format!("unexpected `{name}`"), self.expected_operand());
            }
            Token::Name(name) if self.token() == Token::Symbol("(") => self.call(&name, column)?,
            Token::Name(name) => self.variable(&name, column)?,
            token => return error(column, token.describe(), self.expected_operand()),
        }
        Ok(())
    }

    fn symbol(&mut self, symbol: &'static str) -> Result<(), ParseError> {
        if self.token() != Token::Symbol(symbol) {
            return error(self.column(), self.token().describe(), format!("`{symbol}`"));
        }
        self.next += 1;
        Ok(())
    }

    fn variable(&mut self, name: &str, column: usize) -> Result<(), ParseError> {
        let Some(known) = self.vocabulary.named(name) else {
            let problem = format!("unknown name `{}`", spelling::clip(name));
            return error(column, problem, self.expected_name(name));
        };
        self.code.push(Op::Load(known));
        let words = self.vocabulary.words(known);
        if words.is_empty() { Ok(()) } else { self.compared_with(name, column, &words) }
    }

    /// The word with which a name is compared whose values are words.
    fn compared_with(&mut self, name: &str, column: usize, words: &[(&'static str, f64)]) -> Result<(), ParseError> {
        let infix = self.infix().filter(|infix| matches!(infix.symbol, "==" | "!="));
        let text = self.tokens.get(self.next + 1).cloned();
        let (Some(infix), Some((at, Token::Text(text)))) = (infix, text) else {
            let (word, _) = words[0];
            let expected = format!("a comparison with a word, such as `{name} == '{word}'`");
            return error(column, format!("the values of `{name}` are words"), expected);
        };
        let Some((_, number)) = words.iter().find(|(word, _)| *word == text) else {
            let problem = format!("`{name}` is never '{}'", spelling::clip(&text));
            let all = words.iter().map(|(word, _)| *word);
            return error(at, problem, spelling::expected(&text, all, "a word"));
        };
        self.next += 2;
        self.code.push(Op::Number(*number));
        self.code.push(Op::Binary(infix.apply));
        Ok(())
    }

    fn expected_operand(&self) -> String {
        format!("a number, a {}, a function or `(`", self.vocabulary.noun())
    }

    fn expected_name(&self, name: &str) -> String {
        let all = self.vocabulary.names().into_iter().chain(FUNCTIONS.iter().map(|known| known.0));
        let noun = self.vocabulary.noun();
        spelling::expected(name, all.chain(["and", "or", "not"]), &format!("a {noun} or a function"))
    }

    fn call(&mut self, name: &str, column: usize) -> Result<(), ParseError> {
        let Some((name, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) else {
            let problem = format!("unknown function `{}`", spelling::clip(name));
            return error(column, problem, self.expected_name(name));
        };
        self.symbol("(")?;
        let mut arguments = 0;
        loop {
            self.expression(0)?;
            arguments += 1;
            if let (Function::Fold(fold), 2..) = (function, arguments) {
                self.code.push(Op::Binary(*fold));
            }
            if self.token() != Token::Symbol(",") {
                break;
            }
            self.next += 1;
        }
        self.symbol(")")?;
        self.finish_call(name, function, arguments, column)
    }

    fn finish_call(
        &mut self,
        name: &str,
        function: &Function,
        arguments: usize,
        column: usize,
    ) -> Result<(), ParseError> {
        let (op, needs) = match (function, arguments) {
            (Function::Fold(_), 2..) => return Ok(()),
            (Function::Unary(f), 1) => (Some(Op::Unary(*f)), ""),
            (Function::Binary(f), 2) => (Some(Op::Binary(*f)), ""),
            (Function::If, 3) => (Some(Op::Choose), ""),
            (Function::Unary(_), _) => (None, "1 argument"),
            (Function::Binary(_), _) => (None, "2 arguments"),
            (Function::Fold(_), _) => (None, "2 arguments or more"),
            (Function::If, _) => (None, "3 arguments: condition, then, else"),
        };
        if let Some(op) = op {
            self.code.push(op);
            return Ok(());
        }
        error(column, format!("`{name}` is given {arguments} arguments"), needs)
    }
}
