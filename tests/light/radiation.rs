//! The share of the sky from the radiation of a weather file: a year by hand, a real file beside an independent
//! computation, and the faults of weather that has none.

use crate::absent;
use phytomer_config::{Resolved, validate_texts};
use phytomer_sim::site::light::sun::places;

fn text(more: &str) -> String {
    format!(
        "name = \"lit\"\nspecies = \"coffee\"\nplants = 1\nplanting_date = \"2000-03-01\"\n\
         calendar = {{ tick = {{ days = 30 }} }}\nages = {{ until = 12 }}\n{more}\n"
    )
}

fn resolved(more: &str, weather: (&str, &str)) -> Result<Resolved, String> {
    validate_texts("lit", &[("lit", &text(more)), weather]).map_err(|report| report.render(false))
}

/// The weights of the sources of a tick that are not of the sun.
fn of_sky(resolved: &Resolved, tick: u32) -> f64 {
    let calendar = resolved.calendars[0].as_ref().and_then(|dated| dated.calendars.of(0)).expect("a calendar");
    let light = resolved.scenario.lit(Some(calendar)).expect("light");
    let sky = light.lighting.sky.sources().len();
    light.lighting.sources(tick)[..sky].iter().map(|source| source.weight).sum()
}

/// Every day at 42.03° N with so much radiation, MJ/m², from 1 March 2000; a day without where it is NaN.
fn steady(days: u32, radiation: impl Fn(u32) -> f64) -> String {
    let start = phytomer_sim::site::date::Date::new(2000, 3, 1).expect("a day");
    let row = |day: u32| {
        let told = radiation(day);
        let told = if told.is_nan() { String::new() } else { told.to_string() };
        format!("42.03,{},20,10,{told}\n", start.plus(day as i32))
    };
    format!("WST_LAT,W_DATE,TMAX,TMIN,SRAD\n{}", (0..days).map(row).collect::<String>())
}

/// Days as dark as night are all of the sky (1), days as bright as there are none have .23, by Spitters et al. 1986.
#[test]
fn the_sky_has_what_the_radiation_says() {
    let light = "site = { latitude_deg = 42.03 }\nweather = { file = \"days.csv\" }\n[light]\nsun = {}";
    for (radiation, share) in [(0.5, 1.0), (45.0, 0.23)] {
        let weather = steady(400, |_| radiation);
        let resolved = resolved(light, ("days.csv", &weather)).unwrap_or_else(|told| panic!("{told}"));
        for tick in 0..=12 {
            assert!((of_sky(&resolved, tick) - share).abs() < 1e-12, "{radiation} MJ/m², tick {tick}");
        }
    }
    // The first tick has 15 days of each: (15 · 45 · .23 + 15 · .5) / (15 · 45.5).
    let weather = steady(400, |day| if day % 2 == 0 { 45.0 } else { 0.5 });
    let resolved = resolved(light, ("days.csv", &weather)).unwrap_or_else(|told| panic!("{told}"));
    let known = (45.0 * 0.23 + 0.5) / 45.5;
    assert!([0, 1, 12].iter().all(|tick| (of_sky(&resolved, *tick) - known).abs() < 1e-12), "{known}");
}

/// Ames, Iowa, from 1 March 2000: shares worked out by another program from the numbers of the file and the formulas
/// of the papers.
#[test]
fn a_year_of_ames_is_that_of_another_program() {
    let Some(weather) = absent::measured("weather/Ames_2000_2001.met") else { return };
    let light = "weather = { file = \"ames.met\" }\n[light]\nsun = { diffuse = \"weather\", instants = 3 }";
    let resolved = resolved(light, ("ames.met", &weather)).unwrap_or_else(|told| panic!("{told}"));
    let known = [
        0.457_442, 0.426_337, 0.534_415, 0.490_562, 0.514_759, 0.504_111, 0.419_721, 0.419_680, 0.598_289, 0.529_132,
        0.447_692, 0.466_738,
    ];
    for (tick, known) in (1..).zip(known) {
        let share = of_sky(&resolved, tick);
        assert!((share - known).abs() < 1e-6, "tick {tick}: {share} {known}");
    }
    // The latitude is that of the file.
    let calendar = resolved.calendars[0].as_ref().and_then(|dated| dated.calendars.of(0)).expect("a calendar");
    let light = resolved.scenario.lit(Some(calendar)).expect("light").lighting;
    let sun = light.sources(1).pop().expect("the sun");
    let middle = calendar.at(1).date.plus(-15);
    let place = places(42.03_f64.to_radians(), middle, 3).pop().expect("the sun");
    assert!((0..3).all(|k| (sun.towards[k] - place.towards[k]).abs() < 1e-12), "{sun:?} {place:?}");
}

#[test]
fn weather_without_radiation_is_told() {
    let whole = steady(400, |_| 12.0);
    let short = steady(300, |_| 12.0);
    let holes = steady(400, |day| if (40..47).contains(&day) { f64::NAN } else { 12.0 });
    let none = whole.replace("SRAD", "OTHER");
    let place = "site = { latitude_deg = 42.03 }\n";
    let lit = "weather = { file = \"days.csv\" }\n[light]\nsun = {}";
    let nowhere = whole.replace("WST_LAT", "OTHER_LAT");
    for (more, weather, says) in [
        (format!("{place}[light]\nsun = {{}}"), &whole, "there is none"),
        (lit.to_owned(), &nowhere, "neither the weather file nor the scenario has a latitude"),
        (format!("{place}{lit}"), &none, "on 360 of the 360 days of the run, first on 2000-03-01, of tick 1"),
        (format!("{place}{lit}"), &holes, "on 7 of the 360 days of the run, first on 2000-04-10, of tick 2"),
        (format!("{place}{lit}"), &short, "on 60 of the 360 days of the run, first on 2000-12-26, of tick 11"),
        (format!("{place}[light]\nsun = {{ diffuse = \"wether\" }}"), &whole, "diffuse"),
    ] {
        let told = resolved(&more, ("days.csv", weather)).map(|_| ()).expect_err(says);
        assert!(told.contains(says), "{more}: {told}");
    }
    let stated = format!("{place}weather = {{ file = \"days.csv\" }}\n[light]\nsun = {{ diffuse = 0.4 }}");
    assert!(resolved(&stated, ("days.csv", &none)).is_ok(), "a stated share needs no radiation");
}
