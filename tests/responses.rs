//! Responses of a species through the whole program: at their reference they change no byte of any table.
//!
//! Absent: what responses do elsewhere (`models::buds`).

mod program;

use program::{data, hashes, run, sha256, write};
use std::collections::BTreeMap;
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
    assert_eq!(plain.len(), 6 * 3 + 1 + 2 * 2, "six tables of three parts and the treatments, two plants at two ages");
    assert_eq!(plain, neutral);
    let moved = plain.iter().filter(|(name, hash)| changed.get(*name) != Some(hash)).count();
    assert!(moved > 12, "only {moved} files differ under a response");
}

/// Every kind of pest, of which each plant has its own share.
const PESTS: &str = r#"
[[pest]]
name = "caterpillar"
attacks = "leaf"
larvae = { per_m2 = 40, eats_m2_per_day = 0.00144, days = 10 }
ages = [3, 6]
every = 6
aggregation = 0.2
next_season = 0.8

[[pest]]
name = "stem borer"
attacks = "apex"
probability = 0.3
ages = [5, 20]
clusters = { per_m2 = 0.05, spread_m = 2 }
plot_sd = 0.05

[[pest]]
name = "wilt"
attacks = "plant"
probability = 0.3
ages = [12, 18]
"#;

/// A pest that attacks nothing changes no byte of a plant; plants under pests are the same on any number of threads,
/// and grown again for a mesh.
#[test]
fn pests_are_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenario = fs::read_to_string(data("small.toml")).expect("the scenario");
    fs::copy(data("bush.toml"), folder.path().join("bush.toml")).expect("the species");
    let none = PESTS.replace("per_m2 = 40", "per_m2 = 0").replace("probability = 0.3", "probability = 0");
    let none = none.replace("plot_sd = 0.05", "");
    let runs = [("plain", "", "2"), ("none", none.as_str(), "2"), ("one", PESTS, "1"), ("three", PESTS, "3")];
    let [plain, none, one, three] = runs.map(|(name, pests, threads)| {
        write(folder.path(), "small.toml", &format!("{scenario}\n{pests}"));
        run(folder.path(), &["grow", "small.toml", "--quiet", "--threads", threads, "--name", name]).ending(0);
        hashes(&folder.path().join("runs").join(name))
    });
    // The table of the site alone tells that a pest is there, with a pressure of 0.
    let of_plants = |hashes: &BTreeMap<String, String>| -> Vec<(String, String)> {
        let plants = hashes.iter().filter(|(name, _)| !name.starts_with("site/"));
        plants.map(|(name, hash)| (name.clone(), hash.clone())).collect()
    };
    assert_eq!(of_plants(&plain), of_plants(&none));
    assert!(of_plants(&plain).len() >= 15, "tables of plants: {:?}", plain.keys());
    assert_eq!(one, three);
    let moved = plain.iter().filter(|(name, hash)| one.get(*name) != Some(hash)).count();
    assert!(moved > 12, "only {moved} files differ under pests");
    // The run has written the mesh of plant 7 at tick 24: grown again it has the same bytes.
    run(folder.path(), &["mesh", "runs/one", "--plant", "7", "--age", "24", "--out", "again.ply"]).ending(0);
    let again = sha256(&folder.path().join("again.ply"));
    assert!(one.values().any(|hash| *hash == again) && !plain.values().any(|hash| *hash == again));
}
