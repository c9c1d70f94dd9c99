//! The stands of the forester that ship: a stand that thins itself, a street of planes, tomatoes under glass.
//!
//! Each is grown smaller than it ships, and looked at in the tables that a run writes. The slope of self-thinning is
//! found again by a Python reader (`tests/readers/thinning.py`). Absent: the light itself (`tests/light.rs`), what a
//! bud does at an obstacle (`tests/obstacles.rs`), and layouts (`tests/stands.rs`).

mod program;
mod read;

use phytomer::config::{Kind, presets, validate};
use phytomer::run::picturing::pictured_plot;
use phytomer::run::plots::Plots;
use phytomer::run::regrowth::Regrowth;
use phytomer_measures::line::Pairs;
use phytomer_sim::math;
use program::{hashes, run, write};
use read::Columns;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::tempdir;

/// The text of a shipped scenario with other words at some places, each of which must be there.
fn altered(name: &str, changes: &[(&str, &str)]) -> String {
    let (_, text) = presets(Kind::Scenario).iter().find(|(known, _)| *known == name).expect("it ships");
    changes.iter().fold((*text).to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{name} has no `{from}`");
        text.replace(from, to)
    })
}

fn grow(folder: &Path, text: &str, name: &str) -> PathBuf {
    grow_on(folder, text, name, "2")
}

fn grow_on(folder: &Path, text: &str, name: &str, threads: &str) -> PathBuf {
    write(folder, "grown.toml", text);
    run(folder, &["grow", "grown.toml", "--quiet", "--threads", threads, "--name", name]).ending(0);
    folder.join("runs").join(name)
}

/// The stand that ships with fewer trees on as much less ground, for so many years, with the components of all.
fn stand(trees: u32, side_m: u32, years: u32, record: &str) -> String {
    altered(
        "poplar_stand",
        &[
            ("sample = 20\n", ""),
            ("plants = 400, size_m = [20, 20]", &format!("plants = {trees}, size_m = [{side_m}, {side_m}]")),
            ("until = 30", &format!("until = {years}")),
            ("record = { every = 1 }", &format!("record = {record}")),
        ],
    )
}

/// The mean and its standard error.
fn mean(of: &[f64]) -> (f64, f64) {
    let n = of.len() as f64;
    let mean = of.iter().sum::<f64>() / n;
    let squares = of.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    (mean, (squares / (n - 1.0) / n).sqrt())
}

/// Whether the first mean is above the second by four standard errors of the difference.
#[track_caller]
fn assert_above(what: &str, more: &[f64], less: &[f64]) {
    let ((high, a), (low, b)) = (mean(more), mean(less));
    let error = (a * a + b * b).sqrt();
    println!("{what}: {high:.3} of {} above {low:.3} of {}, standard error {error:.3}", more.len(), less.len());
    assert!(high - low > 4.0 * error, "{what}: {high} is not above {low} by four times {error}");
}

/// Rows of `summary` of the living plants at a tick: of each a column over another.
fn ratios(run: &Path, tick: f64, over: [&str; 2]) -> Vec<f64> {
    let summary = Columns::of(run, "summary");
    let [above, below] = over.map(|column| summary.numbers(column));
    let (ticks, alive) = (summary.numbers("tick"), summary.numbers("alive"));
    let rows = (0..ticks.len()).filter(|row| ticks[*row] == tick && alive[*row] == 1.0);
    rows.map(|row| above[row] / below[row]).collect()
}

/// Twenty-five trees, ten years: trees die, the small ones, of shade, with every bud that they have; the bytes are the
/// same on any number of threads. In full light nobody dies.
#[test]
fn a_stand_thins_itself_by_whole_trees() {
    let folder = tempdir().unwrap();
    let text = stand(25, 5, 10, "{ every = 1 }");
    let grown = ["1", "3"].map(|threads| grow_on(folder.path(), &text, threads, threads));
    assert_eq!(hashes(&grown[0]), hashes(&grown[1]));
    let summary = Columns::of(&grown[0], "summary");
    let number = |column: &str| summary.numbers(column);
    let (plant, tick, alive, volume) = (number("plant_id"), number("tick"), number("alive"), number("wood_volume_m3"));
    let living = |at: f64| (0..tick.len()).filter(move |row| tick[*row] == at && alive[*row] == 1.0);
    let numbers: Vec<usize> = (3..=10).map(|at| living(f64::from(at)).count()).collect();
    assert!(numbers.is_sorted_by(|before, after| before >= after), "nobody comes back: {numbers:?}");
    let survivors = numbers[7];
    assert!((3..=15).contains(&survivors), "{survivors} of 25 live after ten years");
    // Of each tree that dies: its wood in its last year, over the mean of those that then lived.
    let mut shares = Vec::new();
    for at in 1..10 {
        let all: Vec<usize> = living(f64::from(at)).collect();
        let next: Vec<f64> = living(f64::from(at + 1)).map(|row| plant[row]).collect();
        let wood = all.iter().map(|row| volume[*row]).sum::<f64>() / all.len() as f64;
        shares.extend(all.iter().filter(|row| !next.contains(&plant[**row])).map(|row| volume[*row] / wood));
    }
    let (share, error) = mean(&shares);
    assert!(shares.len() > 8 && share + 4.0 * error < 1.0, "{} die, with {share} of the mean wood", shares.len());
    // Every part of a dead tree is dead, and shade is among the causes.
    let components = Columns::of(&grown[0], "components");
    let (of, death) = (components.numbers("plant_id"), components.numbers("death_age"));
    let cause = components.words("cause_of_death");
    let last: Vec<f64> = living(10.0).map(|row| plant[row]).collect();
    let mut shaded = 0;
    for row in (0..of.len()).filter(|row| !last.contains(&of[*row])) {
        assert!(!death[row].is_nan(), "a part of the dead tree {} lives", of[row]);
        shaded += usize::from(cause[row] == "shaded");
    }
    assert!(shaded > 50, "{shaded} buds of the dead died of shade");
    let open = text.replace("[light]\nvoxel_m = 0.5\n", "").replace("\"periodic\"", "\"open\"");
    assert_ne!(open, text);
    let open = grow(folder.path(), &open, "open");
    assert_eq!(ratios(&open, 10.0, ["tick", "tick"]).len(), 25, "all live in full light");
}

/// Trees of a stand are slim and have no leaf low on their trunk, the same trees alone are broad and leafy to the foot.
#[test]
fn trees_of_a_stand_are_slim_and_clear_of_branches_below() {
    let folder = tempdir().unwrap();
    let among = grow(folder.path(), &stand(49, 7, 10, "[10]"), "among");
    let (before, _) = stand(1, 1, 10, "[10]").split_once("[stand]").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let alone = grow(folder.path(), &before.replace("seed = 7\n", "seed = 7\nplants = 12\nspacing_m = 30\n"), "alone");
    let pair = |over| [&among, &alone].map(|run| ratios(run, 10.0, over));
    let [low_among, low_alone] = pair(["lowest_leaf_m", "height_m"]);
    assert_above("the lowest leaf over the height", &low_among, &low_alone);
    let [wide_among, wide_alone] = pair(["crown_width_m", "height_m"]);
    assert_above("the width of the crown over the height, alone", &wide_alone, &wide_among);
}

/// Where open ground begins, crowns grow out into it: the foliage of the outer trees lies outward of their trunks.
#[test]
fn crowns_at_the_edge_of_a_stand_lean_out() {
    let folder = tempdir().unwrap();
    let text = stand(100, 10, 10, "[10]").replace("\"periodic\"", "\"open\"");
    let grown = grow(folder.path(), &text, "edge");
    let plants = Columns::of(&grown, "plants");
    let (x, y) = (plants.numbers("x_m"), plants.numbers("y_m"));
    let records = Columns::of(&grown, "records");
    let (of, area, kind) = (records.numbers("plant_id"), records.numbers("area_m2"), records.words("kind"));
    let (lean_x, lean_y) = (records.numbers("x_m"), records.numbers("y_m"));
    let mut foliage = BTreeMap::<usize, [f64; 3]>::new();
    for row in (0..of.len()).filter(|row| kind[*row] == "leaf") {
        let sums = foliage.entry(of[row] as usize).or_default();
        let part = [area[row], area[row] * lean_x[row], area[row] * lean_y[row]];
        (0..3).for_each(|k| sums[k] += part[k]);
    }
    // Trees within 1.2 m of a side: how far their foliage lies towards it.
    let outward = |(plant, sums): (&usize, &[f64; 3])| {
        let from_middle = [x[*plant] - 5.0, y[*plant] - 5.0];
        let k = usize::from(from_middle[1].abs() > from_middle[0].abs());
        (from_middle[k].abs() > 3.8).then(|| sums[k + 1] / sums[0] * from_middle[k].signum())
    };
    let lean: Vec<f64> = foliage.iter().filter_map(outward).collect();
    let (mean, error) = mean(&lean);
    println!("the foliage of {} outer trees lies {mean:.2} m outward, standard error {error:.2}", lean.len());
    assert!(lean.len() > 15 && mean > 4.0 * error, "{mean} m outward, standard error {error}");
}

/// The slope of log mean wood on log density of the survivors, by the standardised major axis of this program and by a
/// reader of its own in Python.
#[test]
fn an_independent_reader_finds_the_same_slope_of_self_thinning() {
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join(".venv/bin/python");
    if !python.is_file() {
        assert!(std::env::var_os("CI").is_none(), "the readers are installed by .ci/run");
        return;
    }
    let folder = tempdir().unwrap();
    let grown = grow(folder.path(), &stand(64, 8, 14, "{ every = 1 }"), "stand");
    let summary = Columns::of(&grown, "summary");
    let (tick, alive, wood) = (summary.numbers("tick"), summary.numbers("alive"), summary.numbers("wood_volume_m3"));
    let mut pairs = Pairs::default();
    for at in 1..=14 {
        let living: Vec<usize> =
            (0..tick.len()).filter(|row| tick[*row] == f64::from(at) && alive[*row] == 1.0).collect();
        if at > 3 && living.len() as f64 <= 0.8 * 64.0 {
            let mean = living.iter().map(|row| wood[*row]).sum::<f64>() / living.len() as f64;
            pairs.add(math::log(living.len() as f64 / 64.0), math::log(mean));
        }
    }
    let line = pairs.major_axis(0.95).expect("a slope");
    let reader = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers/thinning.py");
    let arguments = [reader, grown, "64".into(), "0.8".into()];
    let output = Command::new(python).args(arguments).output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    let told: Vec<f64> = told.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let ours = [line.n as f64, line.slope.value, line.slope.interval.low, line.slope.interval.high, line.r2];
    println!("years, slope, interval of 95 %, r2: {ours:?}");
    assert_eq!(told.len(), ours.len());
    assert!(
        ours.iter().zip(&told).all(|(ours, theirs)| (ours - theirs).abs() < 1e-6 * theirs.abs()),
        "{ours:?} {told:?}"
    );
    assert!(line.n > 5 && line.slope.value < 0.0 && line.r2 > 0.8, "{line:?}");
}

/// The street: no shoot and no leaf has its base or its tip in a house, leaves on the side of the houses have less
/// light, and the shears are at work on their dates alone.
#[test]
fn planes_of_the_avenue_keep_out_of_the_houses() {
    let folder = tempdir().unwrap();
    let text = altered("avenue", &[("until = 48", "until = 31"), ("[12, 24, 36, 47, 48]", "[31]")]);
    let lit = format!("{text}\n[output]\nlight = true\n");
    let grown = grow(folder.path(), &lit, "avenue");
    let plants = Columns::of(&grown, "plants");
    let x = plants.numbers("x_m");
    let records = Columns::of(&grown, "records");
    let number = |column: &str| records.numbers(column);
    let (of, from, along, up) = (number("plant_id"), number("x_m"), number("dir_x"), number("z_m"));
    let (length, light, kind) = (number("length_m"), number("light"), records.words("kind"));
    // The light of the leaves of each tree towards its house and towards the street.
    let mut sides = [[[0.0_f64; 2]; 2]; 10];
    for row in 0..of.len() {
        let plant = of[row] as usize;
        let base = x[plant] + from[row];
        let tip = base + if kind[row] == "apical_bud" { 0.0 } else { length[row] * along[row] };
        assert!(
            base.abs() < 8.0 && tip.abs() < 8.0 && up[row] > -1e-6,
            "{} of tree {plant} at {base}, {tip}",
            kind[row]
        );
        if kind[row] == "leaf" {
            let side = &mut sides[plant][usize::from(from[row] * x[plant] > 0.0)];
            *side = [side[0] + light[row], side[1] + 1.0];
        }
    }
    let gap: Vec<f64> = sides.iter().map(|[street, house]| street[0] / street[1] - house[0] / house[1]).collect();
    assert_above("light of leaves towards the street, less that towards the house", &gap, &[0.0; 2]);
    let components = Columns::of(&grown, "components");
    let (death, cause) = (components.numbers("death_age"), components.words("cause_of_death"));
    let pruned = (0..death.len()).filter(|row| cause[*row] == "pruned").map(|row| death[row] as u32);
    let mut cuts = BTreeMap::<u32, u32>::new();
    pruned.for_each(|tick| *cuts.entry(tick).or_default() += 1);
    // Fifteenth of February: each winter, the even ticks, from the fourth year on.
    assert!(cuts.len() >= 3 && cuts.keys().all(|tick| tick % 2 == 0 && *tick >= 8), "{cuts:?}");
}

/// Under glass: nothing is in the glass, outside, or over the path; light goes through the glass as through air, and
/// none through the same house where its walls are opaque.
#[test]
fn tomatoes_stay_under_glass_and_out_of_the_path() {
    let folder = tempdir().unwrap();
    let text = altered("greenhouse", &[("until = 60", "until = 50"), ("[20, 40, 60]", "[8, 50]")]);
    let grown = grow(folder.path(), &text, "glass");
    let plants = Columns::of(&grown, "plants");
    let (px, py) = (plants.numbers("x_m"), plants.numbers("y_m"));
    let records = Columns::of(&grown, "records");
    let [of, x, y, z] = ["plant_id", "x_m", "y_m", "z_m"].map(|column| records.numbers(column));
    let [dx, dy, dz] = ["dir_x", "dir_y", "dir_z"].map(|column| records.numbers(column));
    let (length, kind, tick) = (records.numbers("length_m"), records.words("kind"), records.numbers("age"));
    let (mut seen, mut under_the_roof) = (0, 0);
    for row in (0..of.len()).filter(|row| kind[*row].ends_with("internode") || kind[*row] == "leaf") {
        let plant = of[row] as usize;
        let tip = [
            px[plant] + x[row] + length[row] * dx[row],
            py[plant] + y[row] + length[row] * dy[row],
            z[row] + length[row] * dz[row],
        ];
        let roof = 3.4 - 0.4 * tip[0].abs();
        let within = tip[0].abs() < 2.0 && tip[1].abs() < 2.8 && tip[2] < roof && tip[2] > 0.0;
        assert!(within, "a {} of plant {plant} ends at {tip:?}", kind[row]);
        assert!(tip[0].abs() > 0.4 || tip[2] > 2.2, "a {} of plant {plant} hangs over the path: {tip:?}", kind[row]);
        seen += 1;
        under_the_roof += usize::from(tick[row] == 50.0 && kind[row] == "internode" && tip[2] > roof - 0.05);
    }
    assert!(seen > 3000 && under_the_roof > 20, "{seen} parts, {under_the_roof} internodes along the roof");
    // Eight leaves old the plants touch nothing but the path; with walls and path away they have the same light.
    let young = |text: &str, name: &str| {
        let run = grow(folder.path(), &text.replace("until = 50", "until = 8").replace("[8, 50]", "[8]"), name);
        let records = Columns::of(&run, "records");
        let (light, kind) = (records.numbers("light"), records.words("kind"));
        let lit = (0..kind.len()).filter(|row| kind[*row] == "leaf").map(|row| light[row]);
        lit.collect::<Vec<f64>>()
    };
    let glass = young(&text, "young");
    let (light, _) = mean(&glass);
    let frame = text.find("[site.shape.outside]").zip(text.find("# The frame.")).expect("glass, path and frame");
    let air = young(&(text[..frame.0].to_owned() + &text[frame.1..]), "air");
    assert_eq!(glass.len(), air.len());
    assert!((light - mean(&air).0).abs() < 0.02 && light > 0.5, "{light} under glass, {} in the air", mean(&air).0);
    let dark = young(&text.replacen("opaque = false", "opaque = true", 1), "dark");
    assert!(dark.iter().all(|light| *light < 1e-9), "light comes through walls of stone");
}

/// A picture of a stand has each plant where it grew, though its place is drawn.
#[test]
fn a_stand_is_drawn_where_it_grew() {
    let folder = tempdir().unwrap();
    write(folder.path(), "grown.toml", &stand(12, 4, 3, "[3]"));
    let file = folder.path().join("grown.toml").display().to_string();
    let resolved = validate(&file).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let pictured = pictured_plot(&Regrowth::of(&resolved), &resolved.all_species(), (0, &[3]), true).expect("it grows");
    let plots = Plots::of(resolved.trial(), resolved.models());
    let corner = plots.plot_place(0);
    let mut places = BTreeSet::new();
    for member in &pictured.stands[0].members {
        let grown = plots.place_of(member.number);
        assert!((0..3).all(|k| (corner[k] + member.place[k] - grown[k]).abs() < 1e-9), "plant {}", member.number);
        places.insert(member.place.map(f64::to_bits));
    }
    assert!(places.len() > 8 && places.len() == pictured.stands[0].members.len(), "{} places", places.len());
}
