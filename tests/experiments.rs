//! Experiments: treatments × replicates in one run.
//!
//! Equal treatments must give equal plants, the first replicate the plants of a run without treatments, and other
//! replicates other plants. The files are read by the parquet crate alone; what is compared is what they hold, column
//! by column.

mod program;
mod read;

use phytomer::config::{Resolved, validate_texts};
use phytomer::run::regrowth::Regrowth;
use phytomer::run::{self, Progress, Settings};
use phytomer::sim::plant::NodeId;
use program::{hashes, run as program};
use read::Columns;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

const BASE: &str = "name = \"trial\"\nspecies = \"coffee\"\nplants = 3\nspacing_m = 2\nseed = 11\n\
                    ages = { until = 14, record = [7, 14] }\noutput = { plants_per_part = 2 }\n";

/// Two levels that set nothing, one that sets wind, and one of another species.
const FACTOR: &str = "[experiment]\nreplicates = 2\nexperimental_design = \"randomised_blocks\"\n\
                      [[experiment.factor]]\nname = \"site\"\nlevel = [{ name = \"here\" }, { name = \"there\" }, \
                      { name = \"windy\", site = { wind = { speed_m_s = 9 } } }, \
                      { name = \"other\", genotype_name = \"example1\", plants = 2 }]\n";

fn resolved(text: &str) -> Resolved {
    validate_texts("trial", &[("trial", text)]).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn written(folder: &Path, text: &str) {
    run::run(&resolved(text), &Settings::in_folder(folder), &Progress::default()).unwrap();
}

/// The treatment, the replicate and the number in it of each plant.
fn places(folder: &Path) -> BTreeMap<u32, (String, u32, u32)> {
    let plants = Columns::of(folder, "plants");
    let mut seen: BTreeMap<(String, u32), u32> = BTreeMap::new();
    let rows = plants.numbers("plant_id").iter().enumerate();
    let places = rows.map(|(row, plant)| {
        let of = (plants.words("treatment")[row].clone(), plants.numbers("replicate")[row] as u32);
        let next = seen.entry(of.clone()).or_default();
        *next += 1;
        (*plant as u32, (of.0, of.1, *next - 1))
    });
    places.collect()
}

/// The rows of a table by the place of their plant, without what names the plant.
fn by_place(folder: &Path, table: &str, columns: &[&str]) -> BTreeMap<(String, u32, u32), Vec<Vec<u64>>> {
    let places = places(folder);
    let rows = Columns::of(folder, table);
    let plants = rows.numbers("plant_id");
    let mut found: BTreeMap<_, Vec<Vec<u64>>> = BTreeMap::new();
    for (row, plant) in plants.iter().enumerate() {
        let values = columns.iter().map(|column| rows.numbers(column)[row].to_bits()).collect();
        found.entry(places[&(*plant as u32)].clone()).or_default().push(values);
    }
    found
}

const RECORDS: [&str; 9] =
    ["tick", "component_id", "birth_age", "x_m", "y_m", "z_m", "length_m", "diameter_m", "area_m2"];

#[test]
fn equal_treatments_have_equal_plants_and_the_first_replicate_those_of_a_run_without() {
    let home = tempfile::tempdir().unwrap();
    let (trial, lone) = (home.path().join("trial"), home.path().join("lone"));
    written(&trial, &(BASE.to_owned() + FACTOR));
    written(&lone, BASE);
    let (records, alone) = (by_place(&trial, "records", &RECORDS), by_place(&lone, "records", &RECORDS));
    let of = |treatment: &str, replicate, number| &records[&(treatment.to_owned(), replicate, number)];
    for number in 0..3 {
        assert_eq!(of("here", 0, number), &alone[&("control".to_owned(), 0, number)], "plant {number}");
        for replicate in [0, 1] {
            assert_eq!(of("here", replicate, number), of("there", replicate, number), "{replicate}, {number}");
        }
        assert_ne!(of("here", 0, number), of("here", 1, number), "a replicate has draws of its own");
        assert_ne!(of("here", 0, number), of("here", 0, (number + 1) % 3));
    }
    // Not even a number of one replicate has the draws of another of the other.
    let plants: BTreeSet<_> = (0..2).flat_map(|r| (0..3).map(move |n| (r, n))).map(|(r, n)| of("here", r, n)).collect();
    assert_eq!(plants.len(), 6);
}

#[test]
fn the_tables_tell_treatments_replicates_and_blocks() {
    let home = tempfile::tempdir().unwrap();
    written(home.path(), &(BASE.to_owned() + FACTOR));
    let treatments = Columns::of(home.path(), "treatments");
    assert_eq!(treatments.numbers("treatment_index"), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(treatments.words("treatment"), ["here", "there", "windy", "other"]);
    assert_eq!(treatments.words("site"), treatments.words("treatment"));
    let plants = Columns::of(home.path(), "plants");
    let numbers: Vec<f64> = (0..22).map(f64::from).collect();
    assert_eq!(plants.numbers("plant_id"), numbers, "three treatments of 2 × 3 plants and one of 2 × 2");
    assert_eq!(plants.numbers("plot_id"), numbers);
    assert_eq!(plants.numbers("block"), plants.numbers("replicate"));
    assert_eq!(plants.numbers("replicate")[..8], [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
    let species: BTreeSet<(&str, &str)> =
        plants.words("treatment").iter().zip(plants.words("species")).map(|(t, s)| (t.as_str(), s.as_str())).collect();
    assert_eq!(
        species,
        BTreeSet::from([("here", "coffee"), ("there", "coffee"), ("windy", "coffee"), ("other", "example1")])
    );
    let places: BTreeSet<[u64; 2]> =
        (0..22).map(|row| ["x_m", "y_m"].map(|axis| plants.numbers(axis)[row].to_bits())).collect();
    assert_eq!(places.len(), 22, "no two plants stand at one place");
}

#[test]
fn a_lone_control_has_a_row_and_no_block() {
    let home = tempfile::tempdir().unwrap();
    written(home.path(), BASE);
    assert_eq!(Columns::of(home.path(), "treatments").words("treatment"), ["control"]);
    assert!(Columns::of(home.path(), "plants").numbers("block").iter().all(|block| block.is_nan()), "null");
}

/// A plant that is grown again is the recorded plant, of whichever treatment, from the scenario and from the run.
#[test]
fn plants_of_all_treatments_grow_again() {
    let home = tempfile::tempdir().unwrap();
    let text = BASE.to_owned() + FACTOR;
    fs::write(home.path().join("trial.toml"), &text).unwrap();
    program(home.path(), &["grow", "trial.toml", "--quiet"]).ending(0);
    let records = Columns::of(&home.path().join("runs/trial"), "records");
    let resolved = resolved(&text);
    let regrowth = Regrowth::of(&resolved);
    for plant in [0, 4, 13, 17, 18, 21] {
        let rows = (0..records.numbers("plant_id").len()).filter(|row| {
            records.numbers("plant_id")[*row] == f64::from(plant)
                && records.numbers("tick")[*row] == 14.0
                && records.words("kind")[*row].ends_with("internode")
        });
        let recorded: f64 = rows.map(|row| records.numbers("length_m")[row]).sum();
        let mut again = 0.0;
        regrowth
            .show(plant, &[14], &mut |_, plant| {
                let nodes = (0..plant.nodes.len()).map(|k| NodeId(k as u32));
                let standing = nodes.filter(|node| plant.stands(*node, 14));
                again += standing.map(|node| f64::from(plant.nodes.length[node.index()])).sum::<f64>();
                Ok(())
            })
            .unwrap();
        assert!((recorded - again).abs() < 1e-9 && again > 0.0, "plant {plant}: {again} m of {recorded}");
        for (name, file) in [("trial.toml", "a.ply"), ("runs/trial", "b.ply")] {
            program(home.path(), &["mesh", name, "--plant", &plant.to_string(), "--out", file]).ending(0);
        }
        assert_eq!(fs::read(home.path().join("a.ply")).unwrap(), fs::read(home.path().join("b.ply")).unwrap());
    }
}

#[test]
fn a_run_that_lost_a_part_is_mended_to_the_same_bytes_on_any_number_of_threads() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("trial.toml"), BASE.to_owned() + FACTOR).unwrap();
    for threads in ["1", "3"] {
        program(home.path(), &["grow", "trial.toml", "--quiet", "--name", threads, "--threads", threads]).ending(0);
    }
    let whole = hashes(&home.path().join("runs/1"));
    assert_eq!(whole, hashes(&home.path().join("runs/3")));
    for lost in ["treatments/part-00000.parquet", "records/part-00004.parquet"] {
        fs::remove_file(home.path().join("runs/1").join(lost)).unwrap();
        program(home.path(), &["verify", "runs/1"]).ending(1);
        program(home.path(), &["grow", "trial.toml", "--quiet", "--name", "1", "--resume"]).ending(0);
        assert_eq!(whole, hashes(&home.path().join("runs/1")), "{lost}");
    }
    program(home.path(), &["verify", "runs/1"]).ending(0);
}

/// Of 400 seeds of which half germinate 200 do, with a standard error of 10. Those that do are the same plants; the
/// others have a row in `plants` alone.
#[test]
fn a_seed_that_does_not_germinate_has_no_rows_but_its_own() {
    let home = tempfile::tempdir().unwrap();
    let text = "name = \"t\"\nspecies = \"example1\"\nplants = 200\nages = { until = 4 }\ntables = [\"records\", \"summary\"]\n\
                [experiment]\nreplicates = 2\n";
    let (all, half) = (home.path().join("all"), home.path().join("half"));
    written(&all, text);
    written(&half, &format!("{text}[planting]\ngermination = 50\n"));
    let plants = Columns::of(&half, "plants");
    let sown = plants.numbers("sown_tick");
    let germinated = sown.iter().filter(|tick| !tick.is_nan()).count();
    assert_eq!(sown.len(), 400);
    assert!((germinated as f64 - 200.0).abs() <= 40.0, "{germinated} germinated");
    let (some, every) = (by_place(&half, "records", &RECORDS), by_place(&all, "records", &RECORDS));
    assert_eq!((some.len(), every.len()), (germinated, 400));
    assert!(some.iter().all(|(place, rows)| every[place] == *rows));
    let first =
        [0, 1].map(|replicate| sown[200 * replicate..][..200].iter().map(|tick| tick.is_nan()).collect::<Vec<_>>());
    assert_ne!(first[0], first[1], "a replicate has draws of its own");
}

/// The squares of the errors of the mean difference between two heights, paired and unpaired: pairs have common draws.
#[test]
fn paired_differences_vary_less_than_unpaired_ones() {
    let home = tempfile::tempdir().unwrap();
    let text = "name = \"t\"\nspecies = \"coffee\"\nplants = 40\nages = { until = 20, record = [20] }\ntables = [\"summary\"]\n\
                [[experiment.factor]]\nname = \"roof\"\nlevel = [{ name = \"open\" }, { name = \"roofed\", site = { plane = [\
                { point_m = [0, 0, 1.2], normal = [0, 0, 1] }] } }]\n";
    written(home.path(), text);
    let heights = by_place(home.path(), "summary", &["internodes"]);
    let of = |treatment: &str| -> Vec<f64> {
        (0..40).map(|number| f64::from_bits(heights[&(treatment.to_owned(), 0, number)][0][0])).collect()
    };
    let variance = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (values.len() - 1) as f64
    };
    let (open, roofed) = (of("open"), of("roofed"));
    let differences: Vec<f64> = open.iter().zip(&roofed).map(|(a, b)| a - b).collect();
    assert!(differences.iter().sum::<f64>() > 0.0, "the roof kills buds");
    let (paired, unpaired) = (variance(&differences), variance(&open) + variance(&roofed));
    assert!(paired < unpaired, "{paired} against {unpaired}");
}
