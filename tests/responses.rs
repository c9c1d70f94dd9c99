//! Responses of a species through the whole program: at their reference they change no byte of any table.
//!
//! Absent: what responses do elsewhere (`models::buds`).

mod program;

use program::{data, hashes, run, write};
use std::fs;

/// Every target, by a law that is at its reference at all ages and by another that leaves it after the run.
const NEUTRAL: &str = r#"
[[response]]
acts_on = ["death", "pause", "ramification", "flowering", "fruit_set", "nodes", "internode_length", "leaf_area"]
law = 0.3
reference = 120

[[response]]
acts_on = ["death", "pause", "ramification", "flowering", "fruit_set", "nodes", "internode_length", "leaf_area"]
law = { step = { over = "age", at = 25, before = 0.2, after = 0.7 } }
reference = 1
"#;

/// One that leaves its reference at tick 12.
const CHANGED: &str = r#"
[[response]]
acts_on = ["nodes"]
law = { step = { over = "age", at = 12, before = 0.2, after = 0.1 } }
reference = 1
"#;

#[test]
fn responses_at_their_reference_change_no_byte_of_any_table() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let species = fs::read_to_string(data("bush.toml")).expect("the species");
    let scenario = fs::read_to_string(data("small.toml")).expect("the scenario");
    let grown = [("plain", ""), ("neutral", NEUTRAL), ("changed", CHANGED)].map(|(name, responses)| {
        write(folder.path(), "bush.toml", &format!("{species}\n{responses}"));
        write(folder.path(), "small.toml", &scenario);
        run(folder.path(), &["grow", "small.toml", "--quiet", "--name", name]).ending(0);
        hashes(&folder.path().join("runs").join(name))
    });
    let [plain, neutral, changed] = grown;
    assert_eq!(plain.len(), 5 * 3 + 2 * 2, "five tables of three parts, two plants at two ages");
    assert_eq!(plain, neutral);
    let moved = plain.iter().filter(|(name, hash)| changed.get(*name) != Some(hash)).count();
    assert!(moved > 12, "only {moved} files differ under a response");
}
