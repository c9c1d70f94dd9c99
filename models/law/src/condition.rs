//! Conditions and ranks over the columns of plants, wood and fruits, in the grammar of the expressions of laws.
//!
//! A text such as `order >= 3 and height_m > 2.5` is read once, against the columns that are known of the thing of
//! which it is asked, and then evaluated for each thing. Absent: the columns themselves (`phytomer_sim::management`).

use super::expression::{Expression, Op, Vocabulary};
use super::{parser, spelling};
use crate::fault::{Fault, Path};
use phytomer_sim::management::{Column, Formula, SharedFormula, Thing, Values};
use phytomer_sim::plant::{Class, Kind, Origin};
use std::sync::Arc;

/// The vocabulary of formulas that are asked of a thing.
struct ColumnsOf(Thing);

impl ColumnsOf {
    fn columns(&self) -> impl Iterator<Item = Column> {
        Column::ALL.iter().copied().filter(|column| column.things().contains(&self.0))
    }
}

impl Vocabulary for ColumnsOf {
    type Name = Column;

    fn named(&self, name: &str) -> Option<Column> {
        self.columns().find(|column| column.name() == name)
    }

    fn names(&self) -> Vec<&'static str> {
        self.columns().map(Column::name).collect()
    }

    fn words(&self, column: Column) -> Vec<(&'static str, f64)> {
        match column.values() {
            Values::Numbers => Vec::new(),
            Values::Kinds => {
                let class = if self.0 == Thing::Fruit { Class::Fruit } else { Class::Internode };
                let kinds = Kind::ALL.into_iter().filter(|kind| kind.class() == class);
                kinds.map(|kind| (kind.tag(), f64::from(kind as u8))).collect()
            }
            Values::Origins => Origin::ALL.into_iter().map(|origin| (origin.tag(), f64::from(origin as u8))).collect(),
        }
    }

    fn noun(&self) -> &'static str {
        "column"
    }
}

/// A formula over columns that was read from a text.
#[derive(Debug)]
struct OfColumns(Expression<Column>);

impl Formula for OfColumns {
    fn value(&self, known: &mut dyn FnMut(Column) -> f64) -> f64 {
        self.0.value_with(known, &mut Vec::new())
    }

    fn columns(&self) -> Vec<Column> {
        let loaded = |op: &Op<Column>| if let Op::Load(column) = op { Some(*column) } else { None };
        self.0.code.iter().filter_map(loaded).collect()
    }
}

/// Reads a formula that is asked of `thing`; `path` is that of its text.
///
/// # Errors
/// A fault where the text is no expression, names a column that is not known of the thing, or names none.
pub fn formula(text: &str, thing: Thing, path: &Path) -> Result<SharedFormula, Fault> {
    let code = parser::parse(text, &ColumnsOf(thing)).map_err(|error| {
        let known = Column::ALL.iter().find(|column| error.problem == format!("unknown name `{}`", column.name()));
        let problem = match known {
            Some(column) => format!("`{}` is not known of {}", column.name(), thing.name()),
            None => error.problem,
        };
        Fault::new(path, format!("column {} of the expression: {problem}", error.column), error.expected)
    })?;
    let formula = OfColumns(code);
    if formula.columns().is_empty() {
        let problem = format!("`{}` names no column, so it is the same for all", spelling::clip(text));
        let expected = format!("a column of {}, such as `{}`", thing.name(), Column::Height.name());
        return Err(Fault::new(path, problem, expected));
    }
    Ok(Arc::new(formula))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<SharedFormula, Fault> {
        formula(text, Thing::Wood, &Path::root().key("only"))
    }

    fn told(text: &str) -> String {
        read(text).map_or_else(|fault| format!("{}; {}", fault.problem, fault.expected), |_| "sound".to_owned())
    }

    #[test]
    fn a_condition_is_evaluated_for_each_thing() {
        let condition = read("order >= 3 and height_m > 2.5 and kind == 'short_internode'").unwrap();
        let at = |order: f64, height: f64, kind: Kind| {
            condition.value(&mut |column| match column {
                Column::Order => order,
                Column::Height => height,
                _ => f64::from(kind as u8),
            })
        };
        assert_eq!(at(3.0, 2.6, Kind::ShortInternode), 1.0);
        assert_eq!(at(2.0, 2.6, Kind::ShortInternode), 0.0);
        assert_eq!(at(3.0, 2.5, Kind::ShortInternode), 0.0);
        assert_eq!(at(3.0, 2.6, Kind::Internode), 0.0);
        assert_eq!(condition.columns(), [Column::Order, Column::Height, Column::Kind]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let of = |column: usize, rest: &str| format!("column {column} of the expression: {rest}");
        assert!(
            told("order > 2 and hieght_m > 1")
                .starts_with(&of(15, "unknown name `hieght_m`; a column or a function; the nearest is `height_m`"))
        );
        assert!(told("life_share > 1").starts_with(&of(1, "`life_share` is not known of a branch")));
        assert!(told("").contains("the expression ends too early"));
        assert!(told("1 > 2").contains("names no column"));
        assert!(told("kind > 2").starts_with(&of(1, "the values of `kind` are words")));
        assert!(told("kind == 'shrot_internode'").contains("the nearest is `short_internode`"));
        assert!(told("kind == 'fruit'").starts_with(&of(9, "`kind` is never 'fruit'")));
        assert!(told("origin == 'relay").contains("a text without an end"));
        assert!(told("order == 'relay'").contains("unexpected text 'relay'"));
    }
}
