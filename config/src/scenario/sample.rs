//! The sample of a run: how many of its plants have rows in the large tables.
//!
//! A million plants are compared by their summaries; the components of two hundred show what they look like. Absent:
//! which plants are chosen (`phytomer_outputs`).

use super::{Scenario, Table};
use phytomer_law::fault::{Fault, Path};

/// The tables that have rows of the chosen plants alone.
const OF_THE_CHOSEN: [Table; 3] = [Table::Components, Table::Records, Table::Events];

impl Scenario {
    /// The number of plants with rows in `components`, `records` and `events`: at most that of `sample`.
    pub fn sampled(&self) -> u32 {
        self.sample.map_or(self.plants, |sample| sample.min(self.plants))
    }

    /// Adds the fault of a sample for tables that are not written.
    pub(super) fn check_sample(&self, faults: &mut Vec<Fault>) {
        if self.sample.is_some() && !OF_THE_CHOSEN.iter().any(|table| self.tables.contains(table)) {
            let problem =
                "a sample is of the plants in `components`, `records` and `events`, and none of them is written";
            let expected = "one of these tables in `tables`, or no `sample`";
            faults.push(Fault::new(&Path::root().key("sample"), problem, expected));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenario(lines: &str) -> Scenario {
        toml::from_str(&format!("name = \"a\"\nspecies = \"coffee\"\nplants = 50\nages = {{ until = 12 }}\n{lines}"))
            .unwrap()
    }

    #[test]
    fn a_sample_is_at_most_all_plants_and_has_a_table() {
        assert_eq!(
            [("sample = 7", 7), ("sample = 70", 50), ("", 50)].map(|(lines, _)| scenario(lines).sampled()),
            [7, 50, 50]
        );
        assert!(scenario("sample = 7\ntables = [\"summary\", \"events\"]").faults().is_empty());
        let faults = scenario("sample = 7\ntables = [\"summary\"]").faults();
        assert!(faults.len() == 1 && faults[0].problem.contains("none of them is written"), "{faults:?}");
    }
}
