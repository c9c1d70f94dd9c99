//! The stands of `coffee_density`, the fan of `coffee_fan`, and `two_species`, held to what their page says of density.
//!
//! Each tree of a treatment has the draws of the tree with its number in any other one, so differences between
//! treatments are those of pairs. All seeds are those of the scenarios; bounds are 4 standard errors, computed from the
//! trees. The reciprocal law 1/w = A + B ρ is fitted by DuckDB with the query of the page and again with numpy
//! (`tests/readers/density.py`). Absent: how light is found (`sim`), and responses to it (`buds`).

#[path = "program/absent.rs"]
mod absent;
mod program;
mod read;

use program::{run, write};
use read::Columns;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use tempfile::{TempDir, tempdir};

/// Trees a hectare, as the levels of the factor are named.
const DENSITIES: [u32; 4] = [1000, 2500, 5000, 10_000];
const NITROGEN: [u32; 3] = [0, 60, 120];
/// The trees of a treatment: three stands of twelve.
const TREES: usize = 36;

/// The run of `coffee_density`, grown once for all tests of this program.
static STANDS: LazyLock<(TempDir, PathBuf)> = LazyLock::new(|| grown("coffee_density"));

fn grown(name: &str) -> (TempDir, PathBuf) {
    let home = tempdir().expect("a temporary folder");
    run(home.path(), &["grow", name, "--quiet"]).ending(0);
    let folder = home.path().join("runs").join(name.trim_end_matches(".toml"));
    (home, folder)
}

fn shipped(name: &str) -> &'static str {
    let presets = phytomer::config::presets(phytomer::config::Kind::Scenario);
    presets.iter().find(|(known, _)| *known == name).expect("it ships").1
}

/// The fan with 120 kg alone.
fn fan() -> (TempDir, PathBuf) {
    let home = tempdir().expect("a temporary folder");
    let (before, after) = shipped("coffee_fan").split_once("[experiment]").expect("a trial");
    let (_, output) = after.split_once("[output]").expect("its output");
    let fed = "[[fertilizer]]\nfertilization_date = \"2016-04-01\"\nN_in_applied_fertilizer = 120\nyearly = true\n";
    write(home.path(), "fan.toml", &format!("{before}{fed}\n[output]{output}"));
    run(home.path(), &["grow", "fan.toml", "--quiet", "--name", "fan"]).ending(0);
    let folder = home.path().join("runs/fan");
    (home, folder)
}

/// Mean and squared standard error of numbers.
fn mean(numbers: &[f64]) -> (f64, f64) {
    let n = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / n;
    let squares: f64 = numbers.iter().map(|number| (number - mean) * (number - mean)).sum();
    (mean, squares / (n - 1.0) / n)
}

/// The clusters of berries that each plant of a run has set.
fn berries(run: &Path) -> BTreeMap<u32, f64> {
    let components = Columns::of(run, "components");
    let (plants, kinds) = (components.numbers("plant_id"), components.words("kind"));
    let mut berries = BTreeMap::new();
    for (plant, _) in plants.iter().zip(kinds).filter(|(_, kind)| *kind == "fruit") {
        *berries.entry(*plant as u32).or_default() += 1.0;
    }
    berries
}

/// The berries of the trees of each treatment, in the order of their numbers, so that places pair.
fn by_treatment(run: &Path) -> BTreeMap<String, Vec<f64>> {
    let (plants, berries) = (Columns::of(run, "plants"), berries(run));
    let mut by_treatment = BTreeMap::<String, Vec<f64>>::new();
    for (plant, treatment) in plants.numbers("plant_id").iter().zip(plants.words("treatment")) {
        let of_plant = berries.get(&(*plant as u32)).copied().unwrap_or(0.0);
        by_treatment.entry(treatment.clone()).or_default().push(of_plant);
    }
    by_treatment
}

fn treatment(density: u32, nitrogen: u32) -> String {
    format!("{density} a ha + {nitrogen} kg")
}

/// Combines the trees of several treatments place by place.
fn paired<const N: usize>(of: [&Vec<f64>; N], combine: impl Fn([f64; N]) -> f64) -> (f64, f64) {
    assert!(of.iter().all(|trees| trees.len() == TREES));
    let each: Vec<f64> = (0..TREES).map(|tree| combine(of.map(|trees| trees[tree]))).collect();
    mean(&each)
}

#[track_caller]
fn is_above_zero((mean, variance): (f64, f64), what: &str) {
    println!("{what}: {mean:.4} with a standard error of {:.4}", variance.sqrt());
    assert!(mean > 4.0 * variance.sqrt(), "{what}: {mean} with a standard error of {}", variance.sqrt());
}

/// A tree bears less where it has less ground; a hectare bears more, but each further tree adds less to it; and
/// nitrogen acts at each density. Without nitrogen trees are so small that only the ends of the trial tell.
#[test]
fn yields_bend_with_density_and_rise_with_nitrogen() {
    let all = by_treatment(&STANDS.1);
    assert_eq!(all.len(), 12);
    let of = |density, nitrogen| &all[&treatment(density, nitrogen)];
    let hectares = DENSITIES.map(f64::from);
    for nitrogen in NITROGEN {
        let ends = [of(1000, nitrogen), of(10_000, nitrogen)];
        is_above_zero(paired(ends, |[wide, dense]| wide - dense), &format!("{nitrogen} kg, a tree, from end to end"));
        for (pair, density) in DENSITIES.windows(2).zip(hectares.windows(2)) {
            let trees = [of(pair[0], nitrogen), of(pair[1], nitrogen)];
            let more = paired(trees, |w| w[1] * density[1] - w[0] * density[0]);
            is_above_zero(more, &format!("{nitrogen} kg, a hectare, {pair:?}"));
            if nitrogen > 0 {
                is_above_zero(paired(trees, |w| w[0] - w[1]), &format!("{nitrogen} kg, a tree, {pair:?}"));
            }
        }
        // What a further tree adds to a hectare, from three densities.
        for (three, rho) in DENSITIES.windows(3).zip(hectares.windows(3)).filter(|_| nitrogen > 0) {
            let trees = [of(three[0], nitrogen), of(three[1], nitrogen), of(three[2], nitrogen)];
            let adds = |w: [f64; 3], k: usize| (w[k + 1] * rho[k + 1] - w[k] * rho[k]) / (rho[k + 1] - rho[k]);
            is_above_zero(
                paired(trees, |w| adds(w, 0) - adds(w, 1)),
                &format!("{nitrogen} kg, a further tree, {three:?}"),
            );
        }
    }
    for density in DENSITIES {
        for pair in NITROGEN.windows(2) {
            let trees = [of(density, pair[0]), of(density, pair[1])];
            is_above_zero(paired(trees, |[less, more]| more - less), &format!("{density} a ha, {pair:?} kg"));
        }
    }
}

/// A tree of the fan bears what a tree of a stand of its density does.
#[test]
fn the_fan_and_the_stands_agree() {
    let (_home, fan) = fan();
    let (plants, berries) = (Columns::of(&fan, "plants"), berries(&fan));
    let mut arcs = BTreeMap::<u32, Vec<f64>>::new();
    for (row, plant) in plants.numbers("plant_id").iter().enumerate() {
        if plants.numbers("guard")[row] == 0.0 {
            let density = (1e4 / plants.numbers("ground_area_m2")[row]).round() as u32;
            arcs.entry(density).or_default().push(berries.get(&(*plant as u32)).copied().unwrap_or(0.0));
        }
    }
    assert_eq!(arcs.keys().copied().collect::<Vec<_>>(), [1074, 1678, 2621, 4096, 6400, 10_000]);
    let all = by_treatment(&STANDS.1);
    let stands = DENSITIES.map(|density| mean(&all[&treatment(density, 120)]));
    for (density, trees) in &arcs {
        let after = (1..3).find(|k| DENSITIES[*k] > *density).unwrap_or(3);
        let [low, high] = [after - 1, after].map(|k| f64::from(DENSITIES[k]));
        let share = (f64::from(*density) - low) / (high - low);
        let expected = stands[after - 1].0 * (1.0 - share) + stands[after].0 * share;
        let stand = stands[after - 1].1 * (1.0 - share) * (1.0 - share) + stands[after].1 * share * share;
        let (found, arc) = mean(trees);
        let error = (arc + stand).sqrt();
        println!("{density} a ha: {found:.1} in the fan, {expected:.1} in stands, standard error {error:.1}");
        assert!((found - expected).abs() < 4.0 * error, "{density} a ha: {found} and {expected}, {error}");
    }
}

/// Light of neighbours: a tree that is alone keeps what it would keep alone, and the closer trees stand, the smaller is
/// the share of it that they keep.
#[test]
fn competition_is_one_for_a_lone_tree_and_falls_with_density() {
    let home = tempdir().expect("a temporary folder");
    let lone = "name = \"lone\"\nspecies = \"coffee_fed\"\nplants = 1\nages = { until = 24 }\n\
        [light]\nvoxel_m = 0.2\n[output]\nlight = true\n";
    write(home.path(), "lone.toml", lone);
    run(home.path(), &["grow", "lone.toml", "--quiet", "--name", "lone"]).ending(0);
    let alone = Columns::of(&home.path().join("runs/lone"), "summary").numbers("light_competition").to_vec();
    assert!(alone.len() == 24 && alone.iter().all(|share| (share - 1.0).abs() < 1e-9), "{alone:?}");
    let summary = Columns::of(&STANDS.1, "summary");
    let of = |density, nitrogen| {
        let name = treatment(density, nitrogen);
        let rows = (0..summary.words("treatment").len())
            .filter(|row| summary.words("treatment")[*row] == name && summary.numbers("age")[*row] == 60.0);
        rows.map(|row| summary.numbers("light_competition")[row]).collect::<Vec<f64>>()
    };
    for nitrogen in NITROGEN {
        let shares = DENSITIES.map(|density| of(density, nitrogen));
        assert!(shares.iter().flatten().all(|share| *share > 0.0 && *share <= 1.0 + 1e-9), "{shares:?}");
        for pair in 0..3 {
            let trees = [&shares[pair], &shares[pair + 1]];
            is_above_zero(paired(trees, |[wide, dense]| wide - dense), &format!("{nitrogen} kg, light, {pair}"));
        }
    }
}

/// Coffee under palms makes fewer nodes and berries than the same coffee alone, and is none the shorter.
#[test]
fn coffee_under_palms_grows_less_than_alone() {
    let (_home, run) = grown("two_species");
    let (plants, summary, berries) = (Columns::of(&run, "plants"), Columns::of(&run, "summary"), berries(&run));
    let mut coffees = BTreeMap::<[bool; 2], Vec<[f64; 4]>>::new();
    for row in (0..summary.numbers("age").len()).filter(|row| summary.numbers("tick")[*row] == 156.0) {
        let plant = summary.numbers("plant_id")[row] as usize;
        let [under, coffee] =
            [plants.words("treatment")[plant] == "under palms", plants.words("species")[plant] == "coffee"];
        let of = |name: &str| summary.numbers(name)[row];
        let set = berries.get(&(plant as u32)).copied().unwrap_or(0.0);
        let told = [set, of("internodes"), of("intercepted_light_m2"), of("height_m")];
        coffees.entry([under, coffee]).or_default().push(told);
    }
    let (under, alone) = (&coffees[&[true, true]], &coffees[&[false, true]]);
    assert_eq!((under.len(), alone.len(), coffees[&[true, false]].len(), coffees.len()), (32, 32, 4, 3));
    // The coffee of a place has the same draws in both.
    let less = |column: usize| mean(&alone.iter().zip(under).map(|(a, b)| a[column] - b[column]).collect::<Vec<_>>());
    for (column, what) in ["berries", "internodes", "light"].into_iter().enumerate() {
        is_above_zero(less(column), what);
    }
    let (shorter, variance) = less(3);
    assert!(shorter < 4.0 * variance.sqrt(), "coffee in the shade is no shorter: {shorter} m");
}

/// The fit of the page by DuckDB, and the same by numpy: slopes, their errors, and what is left over.
#[test]
fn the_reciprocal_law_is_fitted_alike_by_readers_of_their_own() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python = root.join(".venv/bin/python");
    if !python.exists() {
        assert!(!absent::in_ci(), "CI must have the readers");
        return absent::skip("no independent readers here; .ci/run installs them");
    }
    let told = Command::new(python)
        .arg(root.join("tests/readers/density.py"))
        .args([root.join("docs/density.md"), STANDS.1.clone()])
        .output()
        .expect("Python starts");
    let said = String::from_utf8_lossy(&told.stdout);
    println!("{said}");
    assert!(told.status.success(), "{said}\n{}", String::from_utf8_lossy(&told.stderr));
}
