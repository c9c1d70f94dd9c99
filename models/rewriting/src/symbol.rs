//! The names of modules: one character, or `@x`, `@Gs`, `?P`, `~p`. Each name of a file has a number, in the order in
//! which the file names them; the symbols that a turtle knows are no part of this table.
//!
//! A name with a number of parameters is a [`Kind`]: productions fit modules of a kind.

use std::collections::BTreeMap;

/// The number of a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol(pub u16);

/// The number of a name with a number of parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Kind(pub u16);

/// The opening bracket, in every table.
pub(crate) const OPEN: Kind = Kind(0);
/// The closing bracket, in every table.
pub(crate) const CLOSE: Kind = Kind(1);
/// The cut, in every table.
pub(crate) const CUT: Kind = Kind(2);

/// The most names, and the most kinds, of a file.
pub const MOST_SYMBOLS: usize = 4096;

/// The names of the modules of one program.
#[derive(Debug, Clone)]
pub struct SymbolTable {
    names: Vec<Box<str>>,
    numbers: BTreeMap<Box<str>, Symbol>,
    kinds: Vec<(Symbol, u16)>,
    kind_numbers: BTreeMap<(Symbol, u16), Kind>,
}

impl SymbolTable {
    pub(crate) fn new() -> Self {
        let (names, numbers, kinds, kind_numbers) = Default::default();
        let mut table = Self { names, numbers, kinds, kind_numbers };
        for name in ["[", "]", "%"] {
            let symbol = table.add(name);
            table.kind(symbol, 0);
        }
        table
    }

    /// The symbol of `name`, which is added if it is new. A table that is full gives its last symbol.
    pub(crate) fn add(&mut self, name: &str) -> Symbol {
        if let Some(&symbol) = self.numbers.get(name) {
            return symbol;
        }
        let symbol = Symbol(self.names.len().min(MOST_SYMBOLS) as u16);
        if self.names.len() <= MOST_SYMBOLS {
            self.names.push(name.into());
            self.numbers.insert(name.into(), symbol);
        }
        symbol
    }

    /// The kind of a symbol with so many parameters, which is added if it is new.
    pub(crate) fn kind(&mut self, symbol: Symbol, arity: u16) -> Kind {
        let next = Kind(self.kinds.len().min(MOST_SYMBOLS) as u16);
        let kind = *self.kind_numbers.entry((symbol, arity)).or_insert(next);
        if kind == next && self.kinds.len() <= MOST_SYMBOLS {
            self.kinds.push((symbol, arity));
        }
        kind
    }

    /// Whether there is no room for more names.
    pub(crate) fn is_full(&self) -> bool {
        self.names.len() > MOST_SYMBOLS || self.kinds.len() > MOST_SYMBOLS
    }

    pub(crate) fn kinds(&self) -> &[(Symbol, u16)] {
        &self.kinds
    }

    /// How many names there are; their symbols are the numbers below.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there is no name: never, for brackets and the cut are in every table.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// The name of a symbol of this table.
    pub fn name(&self, symbol: Symbol) -> &str {
        self.names.get(usize::from(symbol.0)).map_or("", |name| name)
    }

    /// The symbol with this name, if the file names it.
    pub fn symbol(&self, name: &str) -> Option<Symbol> {
        self.numbers.get(name).copied()
    }
}
