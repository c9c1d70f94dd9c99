//! Laws of a thing's own age, as tables: how an organ expands and turns, how stiff and how heavy wood is.
//!
//! Such a law depends on the age of the thing in ticks, which it names `dimension` or `cycle`, and on the order of its
//! axis. A law that names the age of the plant, a rank or a state is a fault: the table has one row, which could hold
//! such a law for a single age of the plant alone. Absent: thickening, whose law may depend on the age of the plant.

use super::domain::{At, Domain};
use super::form::Law;
use super::range::ValueRange;
use crate::fault::{Fault, Path};

impl Law {
    /// The values of the law by the own age of a thing of an axis of `order`, for ages from 0 to `until` ticks: entry i
    /// is the value at age i, and ages past the last entry have the value of the last. At least one entry.
    ///
    /// # Errors
    /// Every fault of the law: a value outside `range`, and a variable other than the own age.
    pub fn by_own_age(&self, order: u8, until: u32, path: &Path, range: ValueRange) -> Result<Vec<f32>, Vec<Fault>> {
        let table = self.compile_value(&Domain::of_own_age(order, until), path, range)?;
        let at = |own| At { dimension: own, cycle: own, ..At::default() };
        let mut values: Vec<f32> = (0..=until).map(|own| table.value(at(own))).collect();
        while values.len() > 1 && values[values.len() - 1] == values[values.len() - 2] {
            values.pop();
        }
        Ok(values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LawForm;
    use std::collections::BTreeMap;

    const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a share" };

    fn tabulated(law: LawForm, until: u32) -> Result<Vec<f32>, String> {
        let found = Law::from(law).by_own_age(2, until, &Path::root().key("law"), SHARE);
        found.map_err(|faults| faults.iter().map(Fault::to_string).collect::<Vec<_>>().join("\n"))
    }

    fn expression(text: &str) -> LawForm {
        LawForm { expression: Some(text.to_owned()), ..LawForm::default() }
    }

    #[test]
    fn a_thing_knows_its_own_age_and_its_order_at_any_length_of_run() {
        for text in ["min(1, 0.25 * dimension)", "min(1, 0.25 * cycle)", "min(1, order * dimension / 8)"] {
            for until in [4, 5, 40] {
                assert_eq!(tabulated(expression(text), until).unwrap(), [0.0, 0.25, 0.5, 0.75, 1.0], "{text}");
            }
        }
    }

    #[test]
    fn what_it_cannot_know_is_a_fault_that_names_what_was_meant() {
        for name in ["age", "rank", "bud_birth", "bud_dimension", "unit"] {
            let told = tabulated(expression(&format!("0.001 * {name}")), 10).unwrap_err();
            assert!(told.starts_with(&format!("law: the law depends on {name}, which is ")), "{told}");
            assert!(told.ends_with("expected `dimension`, its own age in ticks"), "{told}");
        }
        let by_state = BTreeMap::from([("long".to_owned(), Law::from(1.0))]);
        let told = tabulated(LawForm { by_state: Some(by_state), ..LawForm::default() }, 10).unwrap_err();
        assert!(told.contains("the law depends on the state of the axis, which is not known here"), "{told}");
    }
}
