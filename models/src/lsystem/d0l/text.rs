//! Strings as people write them: letters of cells, and branches in parentheses (Aono & Kunii 1984, drawing rules 1 and
//! 4). White space is ignored.
//!
//! A branch stands behind a cell of its axis, which bears it; a branch is not empty. A cell that bears a branch, or at
//! which an axis ends, may never vanish ([`bearing`]). Absent: the meaning of a string (`draw`).

/// Replaces a cell whose name is no letter; the name has a fault of its own.
pub(super) const UNREADABLE: char = char::REPLACEMENT_CHARACTER;

/// A symbol of a string.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Symbol {
    /// A cell, by the place of its letter.
    Cell(u8),
    /// The beginning of a branch.
    Open(Branching),
    /// The end of a branch.
    Close,
}

/// The kind of a branch, which is settled when it appears.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Branching {
    /// A branch of the next order.
    Lateral,
    /// A branch of the same order: one of two or more into which its axis divides, behind its last cell.
    Fork,
    /// A fork if no cell follows on the axis behind the cell that becomes this string; otherwise lateral.
    ForkAtEnd,
}

/// The symbols of a text; or an error of two parts, the problem and what was expected.
pub(super) fn parse(text: &str, letters: &[char]) -> Result<Vec<Symbol>, (String, String)> {
    let mut symbols = Vec::new();
    let mut open = 0_usize;
    for (column, character) in (1..).zip(text.chars()).filter(|(_, character)| !character.is_whitespace()) {
        let symbol = match character {
            '(' => Symbol::Open(Branching::Lateral),
            ')' => Symbol::Close,
            letter => match letters.iter().position(|known| *known == letter) {
                Some(place) => Symbol::Cell(place as u8),
                None => {
                    let known: Vec<String> = letters
                        .iter()
                        .filter(|known| **known != UNREADABLE)
                        .map(|known| format!("`{known}`"))
                        .collect();
                    let problem = format!("`{letter}` at column {column} is no cell");
                    return Err((
                        problem,
                        format!("a parenthesis or a cell of the table `cell`: {}", known.join(", ")),
                    ));
                }
            },
        };
        let behind_cell = !matches!(symbols.last(), None | Some(Symbol::Open(_)));
        match symbol {
            Symbol::Open(_) if !behind_cell => {
                return Err((
                    format!("the branch at column {column} is borne by nothing"),
                    "a cell before it".to_owned(),
                ));
            }
            Symbol::Open(_) => open += 1,
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
        Some(_) => {
            mark_forks(&mut symbols);
            Ok(symbols)
        }
    }
}

/// The cells of a string that something else rests on: the last cell of each axis, which its apex stands on, and each
/// cell that bears a branch. Of the string's own axis the last cell is among them only if `ends`.
pub(super) fn bearing(symbols: &[Symbol], ends: bool) -> Vec<u8> {
    let mut found = Vec::new();
    let mut axes: Vec<Option<u8>> = vec![None];
    for symbol in symbols {
        match symbol {
            Symbol::Cell(letter) => axes.iter_mut().last().into_iter().for_each(|last| *last = Some(*letter)),
            Symbol::Open(_) => {
                found.extend(axes.last().copied().flatten());
                axes.push(None);
            }
            Symbol::Close => found.extend(axes.pop().flatten()),
        }
    }
    found.extend(axes.pop().flatten().filter(|_| ends));
    found
}

/// The last cell of the string's own axis.
pub(super) fn last_cell(symbols: &[Symbol]) -> Option<u8> {
    let mut depth = 0_usize;
    let mut last = None;
    for symbol in symbols {
        match symbol {
            Symbol::Cell(letter) if depth == 0 => last = Some(*letter),
            Symbol::Cell(_) => {}
            Symbol::Open(_) => depth += 1,
            Symbol::Close => depth = depth.saturating_sub(1),
        }
    }
    last
}

/// Marks the branches that are forks: two or more behind the last cell of an axis.
fn mark_forks(symbols: &mut [Symbol]) {
    // For each open axis, the places of the branches behind its last cell.
    let mut axes: Vec<Vec<usize>> = vec![Vec::new()];
    for place in 0..symbols.len() {
        match symbols[place] {
            Symbol::Cell(_) => axes.iter_mut().last().into_iter().for_each(Vec::clear),
            Symbol::Open(_) => {
                axes.iter_mut().last().into_iter().for_each(|branches| branches.push(place));
                axes.push(Vec::new());
            }
            Symbol::Close => mark(symbols, axes.pop(), Branching::Fork),
        }
    }
    mark(symbols, axes.pop(), Branching::ForkAtEnd);
}

fn mark(symbols: &mut [Symbol], branches: Option<Vec<usize>>, as_: Branching) {
    for place in branches.into_iter().filter(|branches| branches.len() > 1).flatten() {
        symbols[place] = Symbol::Open(as_);
    }
}
