//! The string of modules held against a plain list.

use crate::string::{Identity, ModuleString, Slot};
use crate::symbol::{Kind, SymbolTable};
use phytomer_sim::key::LineageKey;

fn identity(key: u64) -> Identity {
    Identity { key: LineageKey(key), birth: 0, predecessor: LineageKey::SEED }
}

/// Modules put in, rewritten and taken out at any place are those of a plain list.
#[test]
fn a_string_is_a_list() {
    let mut table = SymbolTable::new();
    let symbol = table.add("A");
    let kinds: Vec<Kind> = (0..3).map(|arity| table.kind(symbol, arity)).collect();
    let mut string = ModuleString::new(table.kinds());
    let mut list: Vec<(Slot, Vec<f64>)> = Vec::new();
    let mut state = 1_u64;
    for step in 0..20_000_u64 {
        state = phytomer_sim::key::scramble(state);
        let place = (state >> 8) as usize % (list.len() + 1);
        let values: Vec<f64> = (0..(state >> 40) % 3).map(|value| (value + step) as f64).collect();
        let kind = kinds[values.len()];
        match state % 5 {
            0 | 1 if list.len() < 50 => {
                let before = place.checked_sub(1).map(|place| list[place].0);
                list.insert(place, (string.insert(before, kind, &values, identity(step)), values));
            }
            2 if place < list.len() => {
                string.rewrite(list[place].0, kind, &values, identity(step));
                list[place].1 = values;
            }
            3 if list.len() < 47 && place > 0 && string.is_dense() => {
                let row: Vec<(Kind, u32, Identity)> =
                    values.iter().zip(0..).map(|(_, first)| (kinds[1], first, identity(step))).collect();
                let first = string.insert_row(list[place - 1].0, row.into_iter(), &values);
                for (number, value) in values.iter().enumerate() {
                    list.insert(place + number, (first.later(number as u32), vec![*value]));
                }
            }
            _ if place < list.len() => {
                let before = string.remove(list.remove(place).0);
                assert_eq!(before, place.checked_sub(1).map(|place| list[place].0));
            }
            _ => {}
        }
        assert_eq!(string.len(), list.len());
        let told: Vec<(Slot, Vec<f64>)> = string.modules().map(|m| (m.slot, m.parameters.to_vec())).collect();
        assert_eq!(told, list);
    }
    assert!(string.slots() <= 50 && string.parameter_count() <= 50 * 2, "what is free is used again");
}
