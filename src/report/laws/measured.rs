//! Measured distributions that a report holds a run against: the tables that `phytomer fit` reads, of one order each.
//!
//! A table tells what it is of by its columns. A column `order` deals its rows to the orders of axes; without one all
//! are of one order. Absent: growth curves of whole plants (`super::super::field`).

use phytomer_fits::data::{Data, Fault, Law, Table, read};
use std::collections::BTreeSet;

/// What a table without other columns can be, in words.
pub const COLUMNS: &str = "a table of `phytomer fit`: nodes (count); age, axes, dead; age, died; axis, rank, fate";

/// A measured distribution.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The name of its file.
    pub file: String,
    /// The order of its axes.
    pub order: u32,
    /// What was measured.
    pub data: Data,
}

/// The law that a table is of; `None` where its columns are none that a report compares.
pub fn law_of(table: &Table) -> Option<Law> {
    let has = |name| table.find(name).is_some();
    if has("fate") {
        Some(Law::Branching)
    } else if has("died") || has("dead") {
        Some(Law::Mortality)
    } else if has("nodes") && !has("day") && !has("days") {
        Some(Law::Nodes)
    } else {
        None
    }
}

/// The distributions of a table, one for each order in it.
///
/// # Errors
/// Every fault of the table.
pub fn measured(law: Law, table: &Table, order: u32) -> Result<Vec<Measured>, Vec<Fault>> {
    let Some(place) = table.find("order") else {
        return Ok(vec![Measured { file: table.file.clone(), order, data: read(law, table)? }]);
    };
    let mut orders = BTreeSet::new();
    for (line, cells) in &table.rows {
        let order = cells[place].parse::<u32>().ok().filter(|order| (1..=64).contains(order));
        let wrong = || table.fault(Some(*line), format!("`order` is `{}`", cells[place]), "an order from 1, the trunk");
        orders.insert(order.ok_or_else(|| vec![wrong()])?);
    }
    let of_order = |order: u32| {
        let own = |(_, cells): &&(u64, Vec<String>)| cells[place].parse() == Ok(order);
        let rows = table.rows.iter().filter(own).cloned().collect();
        let table = Table { file: table.file.clone(), names: table.names.clone(), rows };
        Ok(Measured { file: table.file.clone(), order, data: read(law, &table)? })
    };
    orders.into_iter().map(of_order).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Vec<Measured>, Vec<Fault>> {
        let table = Table::from_csv("a.csv", text.as_bytes())?;
        measured(law_of(&table).expect("a law"), &table, 3)
    }

    #[test]
    fn a_table_tells_what_it_is_of_and_of_which_orders() {
        let nodes = of("order,nodes,count\n2,7,3\n4,1,2\n2,8,1\n").unwrap();
        assert_eq!(nodes.iter().map(|of| of.order).collect::<Vec<_>>(), [2, 4]);
        let Data::Nodes(counts) = &nodes[0].data else { panic!("{nodes:?}") };
        assert_eq!((counts[7], counts[8], counts.len()), (3.0, 1.0, 9));
        let lives = of("age,died\n4,1\n9,0\n").unwrap();
        assert!(lives[0].order == 3 && matches!(lives[0].data, Data::Mortality(_)));
        let fates = of("axis,rank,fate\na,1,latent\na,2,long\n").unwrap();
        assert!(matches!(fates[0].data, Data::Branching(..)));
        let heights = Table::from_csv("a.csv", b"age,height_m\n1,2\n").unwrap();
        assert_eq!(law_of(&heights), None);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let told = of("order,nodes\n2,7\ntwo,8\n").unwrap_err();
        assert_eq!(told[0].to_string(), "a.csv:3: `order` is `two`; expected an order from 1, the trunk");
        let told = of("nodes,count\n7,1\n8,-1\n").unwrap_err();
        assert!(told[0].to_string().starts_with("a.csv:3: `count` is -1"), "{told:?}");
    }
}
