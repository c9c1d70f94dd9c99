//! The variables, arrays and functions that a file states before its axiom.
//!
//! Sizes and first values of arrays are constants. A function is one expression over its parameters. Absent: the code
//! of expressions and statements (`names`).

use super::names::{Known, Names, Scope};
use crate::code::{Array, Code};
use crate::fault::Fault;
use crate::syntax::{Expression, File, Name, Statement};

/// The most elements of all arrays.
const MOST_ELEMENTS: usize = 1_000_000;
/// The most functions and arrays.
const MOST: usize = 1000;

/// Takes up the variables and arrays of the blocks.
pub(super) fn declare(file: &File, names: &mut Names<'_>, faults: &mut Vec<Fault>) -> Vec<Array> {
    let mut arrays = Vec::new();
    for statement in &file.define {
        match statement {
            Statement::Array(name, dimensions, values) => {
                let array = array(name, dimensions, values, names, faults);
                let elements: usize = arrays.iter().map(|array: &Array| array.values.len()).sum();
                if elements + array.values.len() > MOST_ELEMENTS || arrays.len() >= MOST {
                    let expected = format!("at most {MOST} arrays of {MOST_ELEMENTS} elements in all");
                    faults.push(Fault::new(name.place, "the arrays are too large", expected));
                    break;
                }
                let known = Known { number: arrays.len() as u16, count: array.dimensions.len(), level: 0 };
                if names.arrays.insert(name.name.clone(), known).is_some() {
                    faults.push(Fault::new(
                        name.place,
                        format!("two arrays are named `{}`", name.name),
                        "another name",
                    ));
                }
                arrays.push(array);
            }
            _ => names.declare(std::slice::from_ref(statement), faults),
        }
    }
    for block in [&file.start, &file.start_each, &file.end_each] {
        names.declare(block, faults);
    }
    arrays
}

fn array(
    name: &Name,
    dimensions: &[Expression],
    values: &[Expression],
    names: &Names<'_>,
    faults: &mut Vec<Fault>,
) -> Array {
    let mut sizes = Vec::new();
    for dimension in dimensions {
        let size = names.constant(dimension, name.place, faults);
        if !(1.0..=MOST_ELEMENTS as f64).contains(&size) {
            faults.push(Fault::new(
                name.place,
                format!("`{}` has {size} elements", name.name),
                "1 or more, and at most a million",
            ));
        }
        sizes.push(size.clamp(1.0, MOST_ELEMENTS as f64) as usize);
    }
    let count = sizes.iter().try_fold(1_usize, |product, &size| product.checked_mul(size));
    let count = count.filter(|&count| count <= MOST_ELEMENTS).unwrap_or(MOST_ELEMENTS + 1);
    if values.len() > count {
        let problem = format!("`{}` has {count} elements and is given {} values", name.name, values.len());
        faults.push(Fault::new(name.place, problem, "no more values than elements"));
    }
    let mut first: Vec<f64> = values.iter().map(|value| names.constant(value, name.place, faults)).collect();
    if count <= MOST_ELEMENTS {
        first.resize(count, 0.0);
    } else {
        first = vec![0.0; MOST_ELEMENTS + 1];
    }
    Array { name: name.name.clone(), dimensions: sizes, values: first }
}

/// Compiles the functions of the file. A function may call those before it, so that none calls itself.
pub(super) fn functions(file: &File, names: &mut Names<'_>, faults: &mut Vec<Fault>) -> Vec<Code> {
    let mut codes = Vec::new();
    for function in file.functions.iter().take(MOST) {
        let scope = Scope::of(function.parameters.iter().map(|parameter| parameter.name.clone()).collect());
        let level = 1 + names.level(&function.body, function.name.place, faults);
        codes.push(names.code(&function.body, &scope, faults));
        let known = Known { number: codes.len() as u16 - 1, count: function.parameters.len(), level };
        if names.functions.insert(function.name.name.clone(), known).is_some() {
            let problem = format!("two functions are named `{}`", function.name.name);
            faults.push(Fault::new(function.name.place, problem, "another name"));
        }
    }
    if let Some(function) = file.functions.get(MOST) {
        faults.push(Fault::new(function.name.place, "the file has too many functions", format!("at most {MOST}")));
    }
    codes
}
