//! The string of modules held against a plain list.

use crate::origins::Origins;
use crate::string::{Identity, ModuleString, Slot};
use crate::symbol::{Kind, SymbolTable};
use phytomer_sim::key::LineageKey;

fn identity(key: u64) -> Identity {
    Identity { key: LineageKey(key), birth: (key / 3) as u32, predecessor: LineageKey(key / 5) }
}

/// Modules put in, rewritten and taken out at any place are those of a plain list, whether the string is linked both
/// ways from the beginning or from the first module on that is taken out.
#[test]
fn a_string_is_a_list() {
    for both_ways in [true, false] {
        in_any_order(both_ways);
    }
}

fn in_any_order(both_ways: bool) {
    let mut table = SymbolTable::new();
    let symbol = table.add("A");
    let kinds: Vec<Kind> = (0..3).map(|arity| table.kind(symbol, arity)).collect();
    let mut string = ModuleString::new(table.kinds(), both_ways);
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
        if step % 7 == 0 {
            string.close_up();
        }
        let told: Vec<(Slot, Vec<f64>)> = string.modules().map(|m| (m.slot, m.parameters.to_vec())).collect();
        assert_eq!(told, list);
    }
    for pair in list.windows(2) {
        assert_eq!((string.after(pair[0].0), string.before(pair[1].0)), (Some(pair[1].0), Some(pair[0].0)));
    }
    for &(slot, _) in &list {
        let Identity { key, birth, predecessor } = string.identity(slot);
        assert_eq!((u64::from(birth), predecessor.0), (key.0 / 3, key.0 / 5), "each module has its origin");
    }
    assert!(string.slots() <= 50 && string.parameter_count() <= 50 * 2, "what is free is used again");
}

/// A column of parameters that modules of other numbers of parameters have left is closed up.
#[test]
fn parameters_of_no_module_do_not_pile_up() {
    let mut table = SymbolTable::new();
    let symbol = table.add("A");
    let kinds: Vec<Kind> = (0..9).map(|arity| table.kind(symbol, arity)).collect();
    let mut string = ModuleString::new(table.kinds(), false);
    let slots: Vec<Slot> = (0..5000).map(|key| string.insert(None, kinds[0], &[], identity(key))).collect();
    for arity in (1..9).chain(1..9) {
        for (number, &slot) in slots.iter().enumerate() {
            string.rewrite(slot, kinds[arity], &vec![number as f64; arity], identity(number as u64));
        }
        string.close_up();
        assert!(string.parameter_column() <= 2 * 5000 * 8 + 4096, "{}", string.parameter_column());
        let right = |(number, &slot): (usize, &Slot)| string.parameters(slot) == vec![number as f64; arity];
        assert!(slots.iter().enumerate().all(right));
    }
}

#[test]
fn origins_are_used_again() {
    let mut origins = Origins::default();
    let key = LineageKey;
    let (a, b, c) = (origins.claim(key(1), 1), origins.claim(key(1), 1), origins.claim(key(2), 1));
    assert_eq!((a == b, a == c, origins.of(c)), (true, false, (key(2), 1)));
    origins.release(a);
    assert_eq!(origins.claim(key(3), 4), 2, "one module still has the first");
    origins.release(b);
    assert_eq!((origins.claim(key(4), 5), origins.of(0), origins.len()), (0, (key(4), 5), 3));
}
