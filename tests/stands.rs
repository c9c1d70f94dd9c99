//! Stands: what is laid out is sown, guards are in no summary and in no measure, and each plot draws its own places.

mod program;
mod read;

use program::{data, hashes, run, write};
use read::Columns;
use std::collections::BTreeSet;
use std::path::Path;
use tempfile::tempdir;

fn scenario(folder: &Path, lines: &str) {
    let species = data("bush.toml");
    let text =
        format!("name = \"s\"\nspecies = '{species}'\nseed = 3\nages = {{ until = 6, record = [3, 6] }}\n{lines}\n");
    write(folder, "s.toml", &text);
}

fn grow(folder: &Path, lines: &str, name: &str) -> std::path::PathBuf {
    scenario(folder, lines);
    run(folder, &["grow", "s.toml", "--quiet", "--name", name]).ending(0);
    folder.join("runs").join(name)
}

const ROWS: &str =
    "[stand]\nlayout = { form = \"rows\", plant_spacing_m = 2, row_spacing_m = 3, rows = 4, plants = 5 }\n";

fn whole(run: &Path, table: &str, column: &str) -> Vec<i64> {
    Columns::of(run, table).numbers(column).iter().map(|value| *value as i64).collect()
}

#[test]
fn a_stand_is_sown_as_it_is_laid_out() {
    let home = tempdir().unwrap();
    let stand = grow(home.path(), ROWS, "rows");
    let plants = Columns::of(&stand, "plants");
    let (x, y, ground) = (plants.numbers("x_m"), plants.numbers("y_m"), plants.numbers("ground_area_m2"));
    assert_eq!(x.len(), 20, "one plot, without a word of its plants");
    for plant in 0..20 {
        let expected = [1.5 + 3.0 * (plant / 5) as f64, 1.0 + 2.0 * (plant % 5) as f64];
        assert!((x[plant] - expected[0]).abs() < 1e-12 && (y[plant] - expected[1]).abs() < 1e-12, "{plant}");
        assert!((ground[plant] - 6.0).abs() < 1e-12);
    }
    let told = run(home.path(), &["describe", "s.toml"]).ending(0).stdout;
    assert!(told.contains("20, in 1 plot of 20 plants"), "{told}");
}

/// Guards have components, records and events, and neither a summary nor a part in any measure.
#[test]
fn guards_are_left_out() {
    let home = tempdir().unwrap();
    let all = grow(home.path(), ROWS, "all");
    let guarded = grow(home.path(), &format!("{ROWS}guard_rows = 1\n"), "guarded");
    let inner: BTreeSet<i64> = [6, 7, 8, 11, 12, 13].into();
    let guards = whole(&guarded, "plants", "guard");
    let open = |guard: &(usize, &i64)| *guard.1 == 0;
    assert_eq!(guards.iter().enumerate().filter(open).map(|(plant, _)| plant as i64).collect::<BTreeSet<_>>(), inner);
    let of = |run: &Path, table: &str| whole(run, table, "plant_id").into_iter().collect::<BTreeSet<i64>>();
    assert_eq!(of(&guarded, "summary"), inner);
    for table in ["components", "records", "events"] {
        assert!(of(&guarded, table) == of(&all, table) && of(&all, table).len() > 15, "{table}");
    }
    // The plants that are no guards are the same as without any.
    let heights = |run: &Path| {
        let summary = Columns::of(run, "summary");
        let plants = summary.numbers("plant_id").iter().map(|plant| *plant as i64).collect::<Vec<_>>();
        let rows = plants.into_iter().zip(summary.numbers("height_m").iter().map(|height| height.to_bits()));
        rows.filter(|(plant, _)| inner.contains(plant)).collect::<Vec<_>>()
    };
    assert_eq!(heights(&guarded), heights(&all));
    for measure in ["height", "divergence", "nodes-per-axis"] {
        let tables = |name: &str| {
            let told = run(home.path(), &["measure", name, measure, "--json"]).ending(0).json();
            assert!(told["tables"].as_object().is_some_and(|tables| !tables.is_empty()), "{told}");
            told["tables"].clone()
        };
        assert_ne!(tables("runs/guarded"), tables("runs/all"), "{measure} has the guards in it");
    }
}

/// Each plot and replicate draws where its plants stand; all share what is late and which species stands where.
#[test]
fn plots_draw_their_places_and_share_their_emergence() {
    let home = tempdir().unwrap();
    let lines = "plants = 24\nspacing_m = 40\nexperiment = { replicates = 2 }\n[stand]\njitter_m = 0.5\nemergence = [1, 1]\n\
        layout = { form = \"rows\", plant_spacing_m = 2, rows = 3, plants = 4 }\n";
    let stand = grow(home.path(), lines, "drawn");
    let plants = Columns::of(&stand, "plants");
    let (x, y, sown) = (plants.numbers("x_m"), plants.numbers("y_m"), plants.numbers("sown_tick"));
    assert_eq!(x.len(), 48);
    let mut shifts = BTreeSet::new();
    for plot in x.chunks(12).zip(y.chunks(12)).zip(sown.chunks(12)) {
        let ((x, y), late) = plot;
        assert_eq!(late, &sown[..12], "emergence is that of the member");
        // The corner of the plot is not told; plants stand within their discs of it.
        let corner = [x[0] - 1.0, y[0] - 1.0];
        for plant in 0..12 {
            let mark = [1.0 + 2.0 * (plant / 4) as f64, 1.0 + 2.0 * (plant % 4) as f64];
            let away = [x[plant] - corner[0] - mark[0], y[plant] - corner[1] - mark[1]];
            assert!(away.iter().all(|axis| axis.abs() <= 1.0), "{plant}: {away:?}");
        }
        shifts.insert((x[1] - x[0]).to_bits());
    }
    assert_eq!(shifts.len(), 4, "each plot has places of its own");
    assert!(sown.contains(&0.0) && sown.contains(&1.0));
    let again = grow(home.path(), lines, "again");
    assert_eq!(hashes(&stand), hashes(&again));
}

/// A level changes the stand, and each treatment has the plants of its own ground.
#[test]
fn densities_are_treatments() {
    let home = tempdir().unwrap();
    let lines = "[stand]\nlayout = { form = \"rows\", plant_spacing_m = 2, size_m = [8, 8] }\n[experiment]\n\
        factor = [{ name = \"density\", level = [{ name = \"wide\" }, { name = \"dense\", stand = { layout = { form = \"rows\", \
        plant_spacing_m = 1, size_m = [8, 8] } } }] }]\n";
    let stand = grow(home.path(), lines, "densities");
    let ground = Columns::of(&stand, "plants").numbers("ground_area_m2").to_vec();
    assert_eq!(ground.iter().filter(|area| **area == 4.0).count(), 16);
    assert_eq!(ground.iter().filter(|area| **area == 1.0).count(), 64);
}
