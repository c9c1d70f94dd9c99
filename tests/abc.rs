//! `fit --law abc` as a person uses it: a textbook posterior from plants that grow, what a run was grown with found
//! again, ranks that are uniform, the same bytes on any threads and after a kill, and the ways in which it refuses.
//!
//! Absent: the sampler by itself, which `analysis/fits` tests.

mod program;

use program::{program, run, write};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::time::Duration;
use tempfile::tempdir;

/// A bud that pauses, whose prior is flat.
const PAUSING: &str = "name = \"pausing\"\nmodel = \"buds\"\ntick = \"a day\"\n[[order]]\n\
    pause = { value = 0.3, prior = { value = [0, 1] } }\n[order.internode]\nlength_cm = 3\ndiameter_mm = 5\n";

fn estimate<'a>(told: &'a Value, name: &str) -> &'a Value {
    let all = told["fits"][0]["estimates"].as_array().unwrap();
    all.iter().find(|own| own["name"] == name).unwrap_or_else(|| panic!("{name} in {told}"))
}

/// A bud that grew in 552 of 600 ticks: its activity has the posterior Beta(553, 49), mean .9186, sd .01114. The mean
/// is held within 4 errors of as many draws as the particles are worth, the deviation likewise.
#[test]
fn a_textbook_posterior_from_a_bud_that_grows() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    write(folder, "pausing.toml", PAUSING);
    write(folder, "seen.csv", "summary,value,plants\ninternodes@600,552,1\n");
    let words = ["fit", "seen.csv", "--law", "abc", "--base", "pausing.toml", "--out", "fitted.toml", "--json"];
    let told = run(folder, &[&words[..], &["--particles", "600", "--generations", "9"]].concat()).ending(0).json();
    let own = estimate(&told, "order.1.pause.value");
    let n = told["abc"]["effective"].as_f64().unwrap();
    let (value, sd) = (1.0 - own["value"].as_f64().unwrap(), own["error"].as_f64().unwrap());
    println!("{value} {sd} {n}");
    assert!(n > 150.0, "{n}");
    // The estimate is the median, .9191 of this beta distribution; its error is 1.2533 of that of the mean.
    assert!((value - 0.9191).abs() < 4.0 * 1.2533 * 0.01114 / n.sqrt(), "{value} of {n}");
    assert!((sd / 0.01114 - 1.0).abs() < 4.0 / (2.0 * n).sqrt(), "{sd} of {n}");
    // The species that is written holds the estimate with its interval, and grows.
    let species = fs::read_to_string(folder.join("fitted.toml")).unwrap();
    assert!(species.contains("inherits = \"pausing.toml\"") && species.contains("n = 1"), "{species}");
    assert!(species.contains("interval") && species.contains("source = \"ABC on 1 summary: seen.csv\""), "{species}");
    assert!(!species.contains("prior"), "{species}");
    let json: Value = serde_json::from_slice(&fs::read(folder.join("fit.json")).unwrap()).unwrap();
    assert_eq!(json["abc"], told["abc"]);
    write(folder, "trial.toml", "name = \"trial\"\nspecies = \"fitted.toml\"\nplants = 2\nages = { until = 9 }\n");
    run(folder, &["grow", "trial.toml", "--quiet"]).ending(0);
    // A table and a run folder are told apart; a run of the fitted species is data in its turn.
    let words = ["fit", "runs/trial", "--law", "abc", "--base", "pausing.toml", "--summary", "internodes@9", "--json"];
    let told = run(folder, &[&words[..], &["--particles", "40", "--generations", "3", "--quiet"]].concat());
    assert_eq!(told.ending(0).json()["abc"]["plants"], 2);
}

/// Two numbers of plants that a run was grown with: both lie in their intervals.
#[test]
fn what_a_run_was_grown_with_is_found_again() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    let varied = PAUSING.replace("length_cm = 3", "length_cm = { normal = { mean = 4, sd = 1 }, min = 1, max = 8 }");
    write(folder, "truth.toml", &varied.replace("value = 0.3", "value = 0.2"));
    let scenario =
        "name = \"trial\"\nspecies = \"truth.toml\"\nplants = 40\nseed = 5\nages = { until = 30, record = [30] }\n";
    write(folder, "trial.toml", scenario);
    run(folder, &["grow", "trial.toml", "--quiet"]).ending(0);
    write(folder, "base.toml", &varied);
    let words = ["fit", "runs/trial", "--law", "abc", "--base", "base.toml", "--json", "--quiet", "--particles", "150"];
    let of = ["--summary", "height_m@30", "--summary", "internodes@30", "--summary", "sd(internodes)@30"];
    let vary = ["--vary", "order.1.pause=0.05..0.6", "--vary", "order.1.internode.length_cm.normal.mean=2..7"];
    let told = run(folder, &[&words[..], &of, &vary].concat()).ending(0).json();
    for (name, truth) in [("order.1.pause.value", 0.2), ("order.1.internode.length_cm.normal.mean", 4.0)] {
        let own = estimate(&told, name);
        let [low, high] = ["low", "high"].map(|limit| own[limit].as_f64().unwrap());
        println!("{name}: {low} to {high}");
        assert!(low < truth && truth < high && high - low < 0.5 * truth.max(0.4), "{own}");
    }
}

/// 60 sets of the prior: ranks in three equal cells, χ² with 2 df is above 18.4 once in ten thousand.
#[test]
fn ranks_are_uniform() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    write(folder, "pausing.toml", PAUSING);
    write(folder, "seen.csv", "summary,value\ninternodes@30,20\n");
    let words =
        ["fit", "seen.csv", "--law", "abc", "--base", "pausing.toml", "--plants", "1", "--check", "60", "--json"];
    let told = run(folder, &[&words[..], &["--particles", "60", "--generations", "3"]].concat()).ending(0).json();
    let test = &told["check"]["tests"][0];
    println!("{test}");
    assert_eq!((told["check"]["ranks"].as_array().unwrap().len(), test["df"].as_f64()), (60, Some(2.0)));
    assert!(test["statistic"].as_f64().unwrap() < 18.4, "{test}");
}

/// The words of a fit that takes some seconds.
fn long(out: &'static str, threads: &'static str) -> Vec<&'static str> {
    let words = ["fit", "seen.csv", "--law", "abc", "--base", "coffee", "--vary", "order.1.pause=0.02..0.4"];
    let more = ["--vary", "order.1.internode.diameter_mm.value.exponential.start=2..8", "--particles", "24"];
    [&words[..], &more, &["--generations", "3", "--plants", "2", "--quiet", "--threads", threads, "--out", out]]
        .concat()
}

fn written(folder: &Path, out: &str) -> [Vec<u8>; 2] {
    [fs::read(folder.join(out)).unwrap(), fs::read(folder.join(out).with_file_name("fit.json")).unwrap()]
}

#[test]
fn the_same_bytes_on_any_threads_and_after_a_kill() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    write(folder, "seen.csv", "summary,value\nheight_m@24,1.5\nbasal_diameter_m@24,0.02\n");
    for name in ["a", "b", "c"] {
        fs::create_dir(folder.join(name)).unwrap();
    }
    run(folder, &long("a/mine.toml", "1")).ending(0);
    run(folder, &long("b/mine.toml", "3")).ending(0);
    let whole = written(folder, "a/mine.toml");
    assert_eq!(whole, written(folder, "b/mine.toml"));
    let journal = folder.join("c/mine.toml.journal");
    let mut child = program(folder, &long("c/mine.toml", "2")).spawn().unwrap();
    let lines = || fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
    for _ in 0..6000 {
        if lines() > 30 || child.try_wait().unwrap().is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(journal.exists() && !folder.join("c/mine.toml").exists(), "it was killed before its end");
    let refused = run(folder, &long("c/mine.toml", "2")).ending(1);
    assert!(refused.stderr.contains("--resume goes on"), "{}", refused.stderr);
    run(folder, &[&long("c/mine.toml", "2")[..], &["--resume"]].concat()).ending(0);
    assert_eq!(whole, written(folder, "c/mine.toml"));
    assert!(!journal.exists());
}

#[test]
fn what_cannot_be_fitted_is_told_and_nothing_is_written() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    write(folder, "pausing.toml", PAUSING);
    write(folder, "bare.toml", &PAUSING.replace("{ value = 0.3, prior = { value = [0, 1] } }", "0.3"));
    for (name, text) in [
        ("good.csv", "summary,value\ninternodes@9,5\n"),
        ("misspelt.csv", "summary,value\ninternodes@9,5\nheigth_m@9,2\n"),
        ("empty.csv", "summary,value\ninternodes@9,\n"),
        ("twice.csv", "summary,value\ninternodes@9,5\ninternodes@9,6\n"),
        ("nan.csv", "summary,value\ninternodes@9,NaN\n"),
        ("columns.csv", "sumary,value\ninternodes@9,5\n"),
        ("plants.csv", "summary,value,plants\ninternodes@9,5,0\n"),
        ("ageless.csv", "summary,value\ninternodes,5\n"),
        ("ragged.csv", "summary,value\ninternodes@9\n"),
        ("never.csv", "summary,value\nfruits@9,5\ndiameter_at_1_3_m@9,1\n"),
        ("query.csv", "summary,value\nSELECT max(age) FROM summary,5\n"),
    ] {
        write(folder, name, text);
    }
    fs::create_dir(folder.join("nothing")).unwrap();
    let fit = |data: &'static str, base: &'static str, more: &[&'static str]| {
        [&["fit", data, "--law", "abc", "--base", base, "--out", "mine.toml"][..], more].concat()
    };
    let few = ["--particles", "20", "--generations", "2"];
    let cases = [
        (fit("misspelt.csv", "pausing.toml", &[]), 3, "misspelt.csv:3: there is no measure `heigth_m`"),
        (fit("empty.csv", "pausing.toml", &[]), 3, "empty.csv:2: `value` is ``"),
        (fit("twice.csv", "pausing.toml", &[]), 3, "twice.csv:3: `internodes@9` stands in line 2 too"),
        (fit("nan.csv", "pausing.toml", &[]), 3, "nan.csv:2: `value` is `NaN`"),
        (fit("columns.csv", "pausing.toml", &[]), 3, "columns.csv: there is no column `summary`"),
        (fit("plants.csv", "pausing.toml", &[]), 3, "plants.csv:2: `plants` is `0`"),
        (fit("ageless.csv", "pausing.toml", &[]), 3, "ageless.csv:2: `internodes` names no age"),
        (fit("ragged.csv", "pausing.toml", &[]), 3, "ragged.csv:2"),
        (fit("never.csv", "pausing.toml", &few), 3, "no plant has a value of diameter_at_1_3_m@9"),
        (fit("good.csv", "bare.toml", &[]), 2, "bare.toml: no number has a prior"),
        (fit("good.csv", "absent.toml", &[]), 3, "absent.toml"),
        (fit("good.csv", "pausing.toml", &["--vary", "order.1.pasue=0..1"]), 2, "the nearest is `order.1.pause.value`"),
        (fit("good.csv", "pausing.toml", &["--vary", "order.1.pause=0..3"]), 2, "pausing: order.1.pause.value = 3"),
        (fit("good.csv", "pausing.toml", &["--summary", "height_m@9"]), 2, "--summary is for a run folder"),
        (fit("good.csv", "pausing.toml", &["--particles", "3"]), 2, "--particles"),
        (fit("nothing", "pausing.toml", &[]), 2, "--summary height_m@60"),
        (fit("nothing", "pausing.toml", &["--summary", "height_m@9"]), 1, "nothing"),
        (fit("good.csv", "pausing.toml", &["--where", "plot=3"]), 3, "there is no column `plot`"),
        (vec!["fit", "good.csv", "--law", "abc"], 2, "--base SPECIES"),
        (vec!["fit", "good.csv", "--law", "nodes", "--particles", "50"], 2, "--particles is for --law abc"),
        (vec!["fit", "good.csv", "--law", "nodes", "--vary", "a=0..1"], 2, "--vary is for --law abc"),
    ];
    for (words, code, told) in cases {
        let said = run(folder, &words);
        assert_eq!(said.code, Some(code), "{words:?}\n{}", said.stderr);
        assert!(said.stderr.contains(told), "{words:?}: {told}\n{}", said.stderr);
        assert!(!folder.join("mine.toml").exists() && !folder.join("fit.json").exists(), "{words:?}");
        let _ = fs::remove_file(folder.join("mine.toml.journal"));
    }
    if !cfg!(feature = "sql") {
        let said = run(folder, &fit("query.csv", "pausing.toml", &[])).ending(3);
        assert!(said.stderr.contains("query.csv:2") && said.stderr.contains("--features sql"), "{}", said.stderr);
    }
}
