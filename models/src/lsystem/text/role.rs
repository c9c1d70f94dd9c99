//! What each module is to a plant: the kinds that a species names, and what a turtle draws.
//!
//! A line is an internode; a polygon or a surface is a leaf. A module that the species names is a component of that
//! kind, whatever is drawn for it. Absent: drawing (`turtle`).

use crate::lsystem::turtle::{Command, Spline};
use phytomer_rewriting::{Symbol, SymbolTable};
use phytomer_sim::plant::{Class, Kind};
use std::collections::BTreeMap;

/// What a module is to a plant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// What the turtle draws.
    AsDrawn,
    /// The apex of its axis.
    Apex,
    /// An organ, or a bud in an axil.
    Organ(Kind),
    /// Where it draws a line, an internode of this kind.
    Internode(Kind),
}

/// The roles of all modules of a program, and what they tell the turtle.
#[derive(Debug, Clone)]
pub(super) struct Roles {
    by_symbol: Vec<(Command, Role)>,
    /// Whether any module is an apex, so that the buds of axes live as their apices do.
    pub states_apices: bool,
}

/// A kind that a module cannot have, by the name of the module: what is wrong, and what would be right.
pub(super) type Refused = (String, String, String);

impl Roles {
    /// The roles of the modules of a program, of which a species names the `kinds` of some.
    pub fn of(symbols: &SymbolTable, kinds: &BTreeMap<String, Kind>) -> Result<Self, Vec<Refused>> {
        let names = (0..symbols.len()).map(|number| symbols.name(Symbol(number as u16)));
        let mut by_symbol: Vec<(Command, Role)> = names.map(|name| (Command::of(name), Role::AsDrawn)).collect();
        let mut refused = Vec::new();
        for (name, &kind) in kinds {
            let Some(symbol) = symbols.symbol(name) else {
                let problem = format!("no production and no axiom has a module `{name}`");
                refused.push((name.clone(), problem, "the name of a module of the file".to_owned()));
                continue;
            };
            let (command, role) = &mut by_symbol[usize::from(symbol.0)];
            if matches!(command, Command::Open | Command::Close) {
                let problem = format!("`{name}` is a bracket, which is no part of a plant");
                refused.push((name.clone(), problem, "a module that is no bracket".to_owned()));
                continue;
            }
            let draws = matches!(command, Command::Line { .. } | Command::Spline(Spline::Continue | Spline::End));
            *role = match kind.class() {
                Class::Internode => Role::Internode(kind),
                Class::Bud if kind == Kind::ApicalBud => Role::Apex,
                _ => Role::Organ(kind),
            };
            if draws != matches!(role, Role::Internode(_)) {
                let (is, may) = if draws { ("draws", "a kind of internode") } else { ("draws no", "another kind") };
                refused.push((
                    name.clone(),
                    format!("`{name}` {is} a line, and cannot be `{}`", kind.tag()),
                    may.into(),
                ));
            }
        }
        // A polygon is drawn where it ends.
        if let (Some(start), Some(end)) = (symbols.symbol("{"), symbols.symbol("}")) {
            let stated = std::mem::replace(&mut by_symbol[usize::from(start.0)].1, Role::AsDrawn);
            if stated != Role::AsDrawn {
                by_symbol[usize::from(end.0)].1 = stated;
            }
        }
        let states_apices = by_symbol.iter().any(|(_, role)| *role == Role::Apex);
        if refused.is_empty() { Ok(Self { by_symbol, states_apices }) } else { Err(refused) }
    }

    /// What a module tells the turtle, and its role.
    #[inline]
    pub fn get(&self, symbol: Symbol) -> (Command, Role) {
        self.by_symbol.get(usize::from(symbol.0)).copied().unwrap_or((Command::Nothing, Role::AsDrawn))
    }
}
