//! Scenarios with a calendar: the table `site` against closed forms, growth that starts by the date, what a run keeps
//! of its weather, and the exit code of a scenario whose weather is missing.
//!
//! Absent: the readers of weather files and their faults (`config/weather`, `config/tests`).

mod program;
mod read;

use phytomer::sim::site::sun::day_length_h;
use program::{program, run, write};
use read::Columns;
use sha2::{Digest, Sha256};
use std::fs;
use std::path::Path;

const SPECIES: &str = include_str!("../config/tests/weather/dated.toml");
const WEATHER: &str = include_str!("../config/tests/weather/steady.csv");
/// Days from 1970-01-01 to the day of planting, 2001-02-01.
const PLANTED: f64 = 11_354.0;
const SCENARIO: &str = "name = \"dated\"\nspecies = \"species.toml\"\nplants = 9\nages = { until = 12 }\n\
    planting_date = \"2001-02-01\"\noutput = { plants_per_part = 4 }\n\
    [calendar]\ntick = { days = 10 }\ndegree_days = { method = \"average\", base_celsius = 10 }\n\
    [weather]\nfile = \"steady.csv\"\n[soil]\nnitrogen_kg_ha = 40\n\
    [[fertilizer]]\nfertilization_date = \"2001-03-13\"\nN_in_applied_fertilizer = 30\n";

fn home(scenario: &str) -> tempfile::TempDir {
    let home = tempfile::tempdir().expect("a temporary folder");
    write(home.path(), "species.toml", SPECIES);
    write(home.path(), "steady.csv", WEATHER);
    write(home.path(), "dated.toml", scenario);
    home
}

fn grown(home: &Path, name: &str, threads: &str) {
    run(home, &["grow", "dated.toml", "--name", name, "--threads", threads, "--quiet"]).ending(0);
}

/// Ten days at 25 °C are 150 °C d above 10 °C; the day of the fertilizer, 13 March, is the first of tick 5.
#[test]
fn the_site_of_each_tick_is_that_of_its_date() {
    let home = home(SCENARIO);
    grown(home.path(), "dated", "2");
    let folder = home.path().join("runs/dated");
    let (site, summary) = (Columns::of(&folder, "site"), Columns::of(&folder, "summary"));
    let column = |name: &str, row: usize| site.numbers(name)[row];
    assert_eq!(site.numbers("tick").len(), 3 * 12, "three parts of twelve ticks");
    for row in 0..36 {
        let (part, tick) = (row / 12, (row % 12 + 1) as f64);
        assert_eq!((column("tick", row), column("date", row)), (tick, PLANTED + 10.0 * tick));
        assert_eq!((column("degree_days", row), column("degree_day_sum", row)), (150.0, 150.0 * tick));
        assert_eq!(column("nitrogen_kg_ha", row), if tick < 5.0 { 40.0 } else { 70.0 }, "tick {tick}");
        assert_eq!((column("plot_id", row), column("plots", row)), (4.0 * part as f64, [4.0, 4.0, 1.0][part]));
        let (ticks, alive) = (summary.numbers("tick"), summary.numbers("alive"));
        let plots = column("plot_id", row)..column("plot_id", row) + column("plots", row);
        let of_part = |at: &usize| ticks[*at] == tick && plots.contains(&summary.numbers("plot_id")[*at]);
        let living: f64 = (0..ticks.len()).filter(of_part).map(|at| alive[at]).sum();
        assert_eq!(column("living_plants", row), living);
        let hours = day_length_h(-20.0_f64.to_radians(), 32 + 10 * tick as u32);
        assert_eq!(column("day_length_h", row), hours, "tick {tick}");
    }
}

/// The buds of the species wait for more than 300 °C d, so for tick 3 (3 March), and rest when a day is of 11 hours
/// or less: at 20° S from 19 May on (FAO-56), which tick 10 (12 May) is before and tick 11 after. From day 60 of the
/// year on a growth unit has two nodes.
#[test]
fn growth_begins_by_the_date_on_any_number_of_threads() {
    let home = home(SCENARIO);
    grown(home.path(), "one", "1");
    grown(home.path(), "three", "3");
    let [one, three] = ["one", "three"].map(|name| program::hashes(&home.path().join("runs").join(name)));
    assert!(one == three && one.len() == 6 * 3 + 1, "six tables of three parts, and the treatments");
    let components = Columns::of(&home.path().join("runs/one"), "components");
    let of_trunk = |at: &usize| components.words("kind")[*at] == "internode" && components.numbers("order")[*at] == 1.0;
    let births: Vec<f64> = (0..components.numbers("order").len())
        .filter(|at| of_trunk(at) && components.numbers("plant_id")[*at] == 0.0)
        .map(|at| components.numbers("birth_age")[at])
        .collect();
    let expected: Vec<f64> = (3..=10).flat_map(|tick| [f64::from(tick); 2]).collect();
    assert_eq!(births, expected);
}

#[test]
fn a_run_keeps_its_weather_and_draws_its_plants_without_the_file() {
    let home = home(SCENARIO);
    grown(home.path(), "dated", "1");
    let text = fs::read_to_string(home.path().join("runs/dated/run.json")).expect("run.json");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let hash: String = Sha256::digest(WEATHER).iter().map(|byte| format!("{byte:02x}")).collect();
    let inputs = json["inputs"].as_array().expect("inputs");
    assert!(inputs.contains(&serde_json::json!({"path": "steady.csv", "sha256": hash})), "{inputs:?}");
    let resolved = &json["resolved_scenario"];
    assert_eq!(resolved["weather"]["first"], "2001-01-01");
    assert_eq!(resolved["weather"]["notes"]["filled"], serde_json::json!([]));
    assert_eq!(resolved["calendar"]["date"][12], "2001-06-01");
    let described = run(home.path(), &["describe", "dated.toml"]).ending(0).stdout;
    for told in ["from 2001-02-01 to 2001-06-01, in ticks of 10 days", "steady.csv, 2001-01-01 to 2001-12-31, 20.00° S"]
    {
        assert!(described.contains(told), "{told}: {described}");
    }
    let mesh = |name: &str, from: &str| {
        run(home.path(), &["mesh", from, "--plant", "3", "--age", "9", "--out", name]).ending(0);
        fs::read(home.path().join(name)).expect("a mesh")
    };
    let before = mesh("before.ply", "dated.toml");
    for name in ["steady.csv", "dated.toml", "species.toml"] {
        fs::remove_file(home.path().join(name)).expect("a file");
    }
    assert_eq!(mesh("after.ply", "runs/dated"), before);
}

#[test]
fn weather_that_is_missing_or_ends_is_invalid_input() {
    for (from, to, told) in [
        ("steady.csv", "none.csv", "cannot read the weather file `none.csv`: there is no such file"),
        (
            "until = 12",
            "until = 34",
            "the weather goes from 2001-01-01 to 2001-12-31, and tick 34 needs that of 2002-01-01",
        ),
        ("[weather]\nfile = \"steady.csv\"\n", "", "degree-days need temperatures, and there is no weather"),
    ] {
        let home = home(&SCENARIO.replace(from, to));
        for verb in ["validate", "grow"] {
            let said = program(home.path(), &[verb, "dated.toml"]).output().expect("the program starts");
            let stderr = String::from_utf8_lossy(&said.stderr) + String::from_utf8_lossy(&said.stdout);
            assert!(said.status.code() == Some(3) && stderr.contains(told), "{verb}, {told}: {stderr}");
        }
        assert!(!home.path().join("runs").exists());
    }
    let repeated = home(
        &SCENARIO.replace("until = 12", "until = 40").replace("steady.csv\"", "steady.csv\"\nbeyond = \"repeat\""),
    );
    run(repeated.path(), &["validate", "dated.toml"]).ending(0);
}

/// Without a calendar a tick has no date, and its plants are counted all the same.
#[test]
fn without_a_calendar_the_columns_of_the_date_are_null() {
    let folder = program::grown();
    let site = Columns::of(&folder.path().join("runs/small"), "site");
    let rows = site.numbers("tick").len();
    assert!(rows > 0 && site.numbers("living_plants").iter().all(|living| *living > 0.0));
    for name in ["date", "degree_days", "degree_day_sum", "day_length_h", "nitrogen_kg_ha"] {
        assert!(site.numbers(name).iter().all(|value| value.is_nan()), "{name}");
    }
}
