//! Which keys each type of tree takes, and which it needs (Aono & Kunii 1984, Tables 1 and 4).
//!
//! The schema of a type is that of all trees without the keys that the type does not take, so that a file with such a
//! key is refused where it is read. A tree that is glued to another, and a range of levels of another type, are checked
//! here. Absent: the values of the keys (`compile`).

use super::descriptor::{Rule, TreeType};
use crate::fault::{Fault, Path};
use serde_json::Value as Json;

/// The keys that move tips: of the types 2 to 4.
const DEVIATING: [&str; 2] = ["deviation_m", "controller"];
/// The keys of angles that change with the growth level: of type 4.
const CHANGING: [&str; 8] =
    ["category", "curve", "phi_deg", "peak", "h1_max_deg", "h1_min_deg", "h2_max_deg", "h2_min_deg"];
/// The keys of a branching that every tree needs.
const NEEDED: [&str; 5] = ["h1_deg", "h2_deg", "r1", "r2", "diameter_ratio"];

impl TreeType {
    /// Whether the type takes a key of a branching.
    pub fn takes(self, key: &str) -> bool {
        match key {
            "r0" => self == Self::Gmt3,
            _ if DEVIATING.contains(&key) => self != Self::Gmt1,
            _ if CHANGING.contains(&key) => self == Self::Gmt4,
            _ => true,
        }
    }

    /// The keys of a branching that the type needs. The angles of a type 4 may be stated in two ways, so that none of
    /// their keys is needed in all files.
    pub fn needs(self) -> impl Iterator<Item = &'static str> {
        let centre = (self == Self::Gmt3).then_some("r0");
        NEEDED.into_iter().filter(move |key| self != Self::Gmt4 || !key.starts_with('h')).chain(centre)
    }

    /// The schema of a species of this type from that of all trees.
    pub(super) fn narrow(self, schema: &mut Json) {
        if let Some(keys) = schema.get_mut("properties").and_then(Json::as_object_mut) {
            keys.retain(|key, _| self.takes(key));
        }
        let required: Vec<&str> = self.needs().chain(["levels"]).collect();
        schema["required"] = required.into();
        schema["additionalProperties"] = false.into();
    }
}

impl Rule {
    /// The keys that are stated.
    fn stated(&self) -> impl Iterator<Item = &'static str> {
        let keys = [
            ("r0", self.r0.is_some()),
            ("deviation_m", self.deviation_m.is_some()),
            ("controller", self.controller.is_some()),
            ("category", self.category.is_some()),
            ("curve", self.curve.is_some()),
            ("phi_deg", self.phi_deg.is_some()),
            ("peak", self.peak.is_some()),
            ("h1_max_deg", self.h1_max_deg.is_some()),
            ("h1_min_deg", self.h1_min_deg.is_some()),
            ("h2_max_deg", self.h2_max_deg.is_some()),
            ("h2_min_deg", self.h2_min_deg.is_some()),
        ];
        keys.into_iter().filter(|(_, stated)| *stated).map(|(key, _)| key)
    }

    /// A fault for each stated key that a type does not take.
    pub(super) fn foreign(&self, of: TreeType, path: &Path, faults: &mut Vec<Fault>) {
        for key in self.stated().filter(|key| !of.takes(key)) {
            let takers: Vec<&str> =
                TreeType::ALL.into_iter().filter(|other| other.takes(key)).map(TreeType::word).collect();
            let problem = format!("a tree of {} takes no {key}", of.word());
            faults.push(Fault::new(&path.key(key), problem, format!("it in a tree of {}", takers.join(", "))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_type_takes_its_keys() {
        let taken = |key: &str| TreeType::ALL.map(|of| of.takes(key));
        assert_eq!(taken("r0"), [false, false, true, false]);
        assert_eq!(taken("controller"), [false, true, true, true]);
        assert_eq!(taken("category"), [false, false, false, true]);
        assert_eq!(taken("delta_deg"), [true; 4]);
        for of in TreeType::ALL {
            assert!(of.needs().all(|key| of.takes(key)), "{of:?}");
        }
    }
}
