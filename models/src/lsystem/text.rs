//! Strings as people write them: letters of cells, and branches in parentheses (Aono & Kunii 1984, drawing rules 1 and
//! 4). White space means nothing.
//!
//! A branch stands behind a cell of its axis, so that there is something that bears it; it is not empty.

/// A symbol of a string.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Symbol {
    /// A cell, by the place of its letter.
    Cell(u8),
    /// The beginning of a branch.
    Open,
    /// The end of a branch.
    Close,
}

/// The symbols of a text, and where not: what is wrong with it and what was expected.
pub(super) fn parse(text: &str, letters: &[char]) -> Result<Vec<Symbol>, (String, String)> {
    let mut symbols = Vec::new();
    let mut open = 0_usize;
    for (column, character) in (1..).zip(text.chars()).filter(|(_, character)| !character.is_whitespace()) {
        let symbol = match character {
            '(' => Symbol::Open,
            ')' => Symbol::Close,
            letter => match letters.iter().position(|known| *known == letter) {
                Some(place) => Symbol::Cell(place as u8),
                None => {
                    let known: Vec<String> = letters.iter().map(|letter| format!("`{letter}`")).collect();
                    let problem = format!("`{letter}` at column {column} is no cell");
                    return Err((
                        problem,
                        format!("a parenthesis or a cell of the table `cell`: {}", known.join(", ")),
                    ));
                }
            },
        };
        let behind_cell = !matches!(symbols.last(), None | Some(Symbol::Open));
        match symbol {
            Symbol::Open if !behind_cell => {
                return Err((
                    format!("the branch at column {column} is borne by nothing"),
                    "a cell before it".to_owned(),
                ));
            }
            Symbol::Open => open += 1,
            Symbol::Close if open == 0 => {
                return Err((format!("no branch begins before column {column}"), "a `(` for each `)`".to_owned()));
            }
            Symbol::Close if !behind_cell => {
                return Err((format!("the branch that ends at column {column} is empty"), "a cell in it".to_owned()));
            }
            Symbol::Close => open -= 1,
            Symbol::Cell(_) => {}
        }
        symbols.push(symbol);
    }
    match symbols.first() {
        None => Err(("the string is empty".to_owned(), "at least one cell".to_owned())),
        Some(_) if open > 0 => Err((format!("{open} branches do not end"), "a `)` for each `(`".to_owned())),
        Some(_) => Ok(symbols),
    }
}
