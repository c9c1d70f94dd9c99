//! `sensitivity` as a person uses it: indices of a species against closed forms and a full grid, the same bytes on any
//! threads and after a kill, formats, and the ways in which it refuses.
//!
//! Absent: designs and estimators by themselves, which `analysis/fits` holds to Ishigami's function.

mod program;

use phytomer::simulate::Simulator;
use phytomer::simulate::summaries;
use program::{program, run, write};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::time::Duration;
use tempfile::tempdir;

/// A trunk of internodes of one size, a node a tick.
const POLE: &str = "name = \"pole\"\nmodel = \"buds\"\ntick = \"a day\"\n[[order]]\npause = 0\n\
    [order.internode]\nlength_cm = 3\ndiameter_mm = 5\n";

/// A bud that pauses, with a prior.
const PAUSING: &str = "name = \"pausing\"\nmodel = \"buds\"\ntick = \"a day\"\n[[order]]\n\
    pause = { value = 0.3, prior = { value = [0.1, 0.5] } }\n[order.internode]\nlength_cm = 3\ndiameter_mm = 5\n";

fn lay(folder: &Path) {
    write(folder, "pole.toml", POLE);
    write(folder, "pausing.toml", PAUSING);
}

fn number<'a>(told: &'a Value, name: &str) -> &'a Value {
    let numbers = told["of"][0]["numbers"].as_array().unwrap();
    numbers.iter().find(|own| own["number"] == name).unwrap_or_else(|| panic!("{name} in {told}"))
}

const VARIED: [&str; 4] =
    ["--vary", "order.1.internode.length_cm=1..5", "--vary", "order.1.internode.diameter_mm=2..10"];

/// The volume is that of L d²: with L on (1, 5) and d on (2, 10) closed forms give .2180 and .6811, in all .3189 and
/// .7820; and a grid of 40 by 40 middles of cells, simulated one by one, gives the same.
#[test]
fn indices_are_those_of_closed_forms_and_of_a_grid() {
    let folder = tempdir().unwrap();
    lay(folder.path());
    let words =
        ["sensitivity", "pole.toml", "--of", "wood_volume_m3@10", "--points", "2048", "--plants", "1", "--json"];
    let told = run(folder.path(), &[&words[..], &VARIED].concat()).ending(0).json();
    let of = |name: &str, key: &str| number(&told, name)[key].as_f64().unwrap();
    let expected = [("order.1.internode.length_cm", 0.2180, 0.3189), ("order.1.internode.diameter_mm", 0.6811, 0.7820)];
    for (name, first, total) in expected {
        let (found, found_total) = (of(name, "first_order"), of(name, "total"));
        println!("{name}: {found} {found_total}");
        assert!((found - first).abs() < 0.02 && (found_total - total).abs() < 0.02, "{name}: {found} {found_total}");
        assert!(of(name, "first_order_low") < first && first < of(name, "first_order_high"), "{name}");
        assert!(of(name, "total_low") < total && total < of(name, "total_high"), "{name}");
    }
    assert!(told["of"][0]["noise_share"].as_f64().unwrap().abs() < 1e-12);
    // By brute force.
    let summary = summaries::read("wood_volume_m3@10").unwrap();
    let path = folder.path().join("pole.toml").display().to_string();
    let mut simulator = Simulator::of(&path, vec![summary], 1).unwrap();
    simulator.vary("order.1.internode.length_cm", [1.0, 5.0]).unwrap();
    simulator.vary("order.1.internode.diameter_mm", [2.0, 10.0]).unwrap();
    let middle = |k: usize| (k as f64 + 0.5) / 40.0;
    let at = |a: usize, b: usize| simulator.simulate(&simulator.values(&[middle(a), middle(b)]), 1).unwrap()[0];
    let grid: Vec<Vec<f64>> = (0..40).map(|a| (0..40).map(|b| at(a, b)).collect()).collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let square = |value: f64| value * value;
    let variance = |values: &[f64]| mean(&values.iter().map(|v| square(v - mean(values))).collect::<Vec<_>>());
    let all = variance(&grid.concat());
    let rows = variance(&grid.iter().map(|row| mean(row)).collect::<Vec<_>>()) / all;
    let columns: Vec<f64> = (0..40).map(|b| mean(&grid.iter().map(|row| row[b]).collect::<Vec<_>>())).collect();
    let columns = variance(&columns) / all;
    println!("grid: {rows} {columns}");
    assert!((rows - of(expected[0].0, "first_order")).abs() < 0.02, "{rows}");
    assert!((columns - of(expected[1].0, "first_order")).abs() < 0.02, "{columns}");
}

/// 20 ticks at pause p on (.1, .5): the variance of the mean is 20² · .16/12 = 5.333, that of the seed 20 · .19667 =
/// 3.933, so the seed has .4244. With shared draws a tick grows where its draw is at least p: the total share is
/// (9.267 − 20 · .14333)/9.267 = .6906. Errors of 4096 points are about .012 and .014.
#[test]
fn the_seed_has_its_share_and_plants_share_their_draws() {
    let folder = tempdir().unwrap();
    lay(folder.path());
    let words = ["sensitivity", "pausing.toml", "--of", "internodes@20", "--points", "4096", "--plants", "1", "--json"];
    let told = run(folder.path(), &words).ending(0).json();
    let noise = told["of"][0]["noise_share"].as_f64().unwrap();
    let total = number(&told, "order.1.pause.value")["total"].as_f64().unwrap();
    println!("{noise} {total}");
    assert!((noise - 0.4244).abs() < 0.05, "{noise}");
    assert!((total - 0.6906).abs() < 0.056, "{total}");
    // Effects over the whole range: 20 nodes by .4 of pause are 8, with shared draws.
    let effect = number(&told, "order.1.pause.value")["effect_size"].as_f64().unwrap();
    assert!((effect - 8.0).abs() < 4.0, "{effect}");
}

#[test]
fn the_same_bytes_on_any_threads_and_in_each_format() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    lay(folder);
    let words = |out: &'static str, threads: &'static str| {
        let design = ["--points", "16", "--ways", "5", "--threads", threads, "--out", out, "--quiet"];
        let of = ["sensitivity", "pausing.toml", "--of", "internodes@20", "--of", "sd(height_m)@15"];
        [&of[..], &design, &["--vary", "order.1.pause=0.1..0.4"], &VARIED].concat()
    };
    run(folder, &words("one.csv", "1")).ending(0);
    run(folder, &words("three.csv", "3")).ending(0);
    let text = fs::read_to_string(folder.join("one.csv")).unwrap();
    assert_eq!(text, fs::read_to_string(folder.join("three.csv")).unwrap());
    assert_eq!(text.lines().count(), 1 + 2 * 3, "{text}");
    assert!(text.starts_with("summary,number,low,high,effect_size,"), "{text}");
    assert!(!folder.join("one.csv.journal").exists());
    run(folder, &words("one.parquet", "2")).ending(0);
    let (names, rows) = phytomer::outputs::cells::read(&folder.join("one.parquet")).unwrap();
    assert_eq!(names.join(","), text.lines().next().unwrap());
    let first: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
    assert_eq!((rows.len(), rows[0][0].as_str(), rows[0][4].as_str()), (6, first[0], first[4]));
    run(folder, &words("one.json", "2")).ending(0);
    let json: Value = serde_json::from_slice(&fs::read(folder.join("one.json")).unwrap()).unwrap();
    let size = json["of"][0]["numbers"][0]["effect_size"].as_f64().unwrap();
    assert_eq!(size.to_string(), first[4]);
}

/// Killed while it simulates, then resumed: the bytes of an analysis that was not.
#[test]
fn killed_and_resumed() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    lay(folder);
    let words = |out: &'static str| {
        let of = ["sensitivity", "coffee", "--of", "height_m@30", "--points", "16", "--plants", "3", "--quiet"];
        let vary = ["--vary", "order.1.pause=0.02..0.3", "--vary", "order.2.pause=0.3..0.7", "--out", out];
        [&of[..], &vary].concat()
    };
    run(folder, &words("whole.csv")).ending(0);
    let journal = folder.join("killed.csv.journal");
    let mut child = program(folder, &words("killed.csv")).spawn().unwrap();
    let lines = || fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
    for _ in 0..6000 {
        if lines() > 12 || child.try_wait().unwrap().is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(journal.exists() && !folder.join("killed.csv").exists(), "it was killed before its end");
    // It is not begun anew by mistake, nor gone on with for other numbers.
    let refused = run(folder, &words("killed.csv")).ending(1);
    assert!(refused.stderr.contains("--resume goes on"), "{}", refused.stderr);
    let other = [&words("killed.csv")[..], &["--resume", "--seed", "7"]].concat();
    let refused = run(folder, &other).ending(1);
    assert!(
        refused.stderr.contains("killed.csv.journal") && refused.stderr.contains("other numbers"),
        "{}",
        refused.stderr
    );
    run(folder, &[&words("killed.csv")[..], &["--resume"]].concat()).ending(0);
    assert_eq!(fs::read(folder.join("whole.csv")).unwrap(), fs::read(folder.join("killed.csv")).unwrap());
    assert!(!journal.exists());
}

/// Measures of recorded runs are summaries too: those of a run in memory are those of a run folder.
#[test]
fn measures_are_those_of_a_run_folder() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    let scenario =
        "name = \"trial\"\nspecies = \"coffee\"\nplants = 3\nseed = 77\nages = { until = 24, record = [12, 24] }\n";
    write(folder, "trial.toml", scenario);
    run(folder, &["grow", "trial.toml", "--quiet"]).ending(0);
    let names = [
        "height_m@24",
        "sd(leaves)@12",
        "living@24",
        "nodes-per-axis(order=2)@24",
        "activity(order=1)@24",
        "bud-life(order=2)@24",
        "branching@24",
        "divergence@24",
        "clear-bole@24",
    ];
    let asked: Vec<_> = names.iter().map(|name| summaries::read(name).unwrap()).collect();
    let simulator = Simulator::of("coffee", asked.clone(), 3).unwrap();
    let observed = phytomer::simulate::observed::Observed::open(&folder.join("runs/trial")).unwrap();
    let mut told = 0;
    for (place, summary) in asked.iter().enumerate() {
        let Ok(of_run) = observed.of(summary) else {
            // Where a run has no value, its simulation has none.
            let alone = Simulator::of("coffee", vec![summary.clone()], 3).unwrap();
            assert!(alone.simulate(&[], 77).unwrap()[0].is_nan(), "{}", summary.name);
            continue;
        };
        let alone = Simulator::of("coffee", vec![summary.clone()], 3).unwrap();
        let simulated = alone.simulate(&[], 77).unwrap()[0];
        println!("{}: {simulated} {of_run}", names[place]);
        assert!((simulated - of_run).abs() <= 1e-6 * of_run.abs(), "{}: {simulated} {of_run}", summary.name);
        told += 1;
    }
    assert!(told >= 8, "{told}");
    assert_eq!(observed.plants().unwrap(), 3);
    assert_eq!(simulator.asked().len(), names.len());
    let missing = observed.of(&summaries::read("height_m@18").unwrap()).unwrap_err();
    assert!(missing.contains("recorded: 12, 24"), "{missing}");
    let early = observed.of(&summaries::read("branching@12").unwrap()).unwrap_err();
    assert!(early.contains("ask for @24"), "{early}");
}

/// Any growth model whose species has numbers.
#[test]
fn every_model_can_be_asked() {
    let folder = tempdir().unwrap();
    for (species, of, vary) in [
        ("gmt1/5a", "height_m@5", None),
        ("wp/quaking_aspen", "height_m@1", None),
        ("poplar", "height_m@4", Some("order.1.internode")),
    ] {
        let mut words =
            vec!["sensitivity", species, "--of", of, "--ways", "4", "--points", "0", "--plants", "1", "--json"];
        if vary.is_some() {
            words.extend(["--keep", "3"]);
        }
        let told = run(folder.path(), &words).ending(0).json();
        assert!(!told["of"][0]["numbers"].as_array().unwrap().is_empty(), "{species}");
        assert!(told["notes"][0].as_str().unwrap().contains("every number is varied"), "{species}");
    }
}

#[test]
fn what_cannot_be_asked_is_told() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    lay(folder);
    write(folder, "wrong.toml", &PAUSING.replace("[0.1, 0.5]", "[0.5, 0.1]"));
    write(folder, "unknown.toml", &PAUSING.replace("{ value = [0.1", "{ vaule = [0.1"));
    write(folder, "beyond.toml", &PAUSING.replace("[0.1, 0.5]", "[0.1, 1.5]"));
    let of = |species: &'static str, more: &[&'static str]| {
        [&["sensitivity", species, "--of", "height_m@9"][..], more].concat()
    };
    let whole = |words: &[&'static str]| words.to_vec();
    for (words, code, told) in [
        (of("pole.toml", &["--vary", "order.1.internode.lenght_cm=1..5"]), 2, "`order.1.internode.length_cm`"),
        (of("pole.toml", &["--vary", "order.7.pause=0..0.5"]), 2, "the species has no number `order.7.pause`"),
        (of("pole.toml", &["--vary", "order.1.pause"]), 2, "a path and two numbers are expected"),
        (of("pole.toml", &["--vary", "order.1.pause=0.5..0.1"]), 2, "below the second"),
        (of("pole.toml", &["--vary", "order.1.pause=0..NaN"]), 2, "two numbers are expected"),
        (of("pole.toml", &["--vary", "order.1.pause=0..2"]), 2, "order.1.pause = 2: order[0].pause"),
        (of("pole.toml", &["--vary", "order.1.pause=0..0.1", "--vary", "order.1.pause=0..0.2"]), 2, "varied twice"),
        (of("pole.toml", &["--out", "table.xlsx"]), 2, "cannot write `.xlsx`"),
        (of("pole.toml", &["--out", "-"]), 2, "name a file"),
        (of("pole.toml", &["--resume"]), 2, "--out"),
        (of("pole.toml", &["--ways", "2"]), 2, "--ways"),
        (of("pole.toml", &["--points", "2", "--vary", "order.1.pause=0..0.5"]), 2, "at least 4 are needed"),
        (of("pole.toml", &["--plants", "0"]), 2, "--plants"),
        (of("wrong.toml", &[]), 3, "wrong.toml:5"),
        (of("unknown.toml", &[]), 3, "unknown number `vaule`"),
        (of("beyond.toml", &[]), 3, "beyond.toml:5"),
        (of("absent.toml", &[]), 3, "absent.toml"),
        (whole(&["sensitivity", "pole.toml", "--of", "heigth_m@9"]), 2, "the nearest is `height_m`"),
        (whole(&["sensitivity", "pole.toml", "--of", "height_m"]), 2, "names no age"),
        (whole(&["sensitivity", "pole.toml", "--of", "height_m@70000"]), 2, "a whole age"),
        (whole(&["sensitivity", "pole.toml", "--of", "crown-profile@9"]), 2, "more than one number"),
        (whole(&["sensitivity", "pole.toml"]), 2, "--of"),
    ] {
        let said = run(folder, &words);
        assert_eq!(said.code, Some(code), "{words:?}\n{}", said.stderr);
        assert!(said.stderr.contains(told), "{words:?}: {told}\n{}", said.stderr);
    }
    #[cfg(not(feature = "sql"))]
    {
        let said = run(folder, &["sensitivity", "pole.toml", "--of", "SELECT max(age) FROM summary@9"]).ending(2);
        assert!(said.stderr.contains("--features sql"), "{}", said.stderr);
    }
    // A summary that no plant has: told, and nothing is NaN.
    let words = of("pole.toml", &["--vary", "order.1.pause=0..0.5", "--of", "fruits@9", "--of", "diameter_at_1_3_m@9"]);
    let said = run(folder, &words).ending(0);
    assert!(said.stdout.contains("no plant has a value of diameter_at_1_3_m@9"), "{}", said.stdout);
    assert!(!said.stdout.contains("NaN"), "{}", said.stdout);
}
