//! What pictures, films and pages say of what they show: species, ages, dates and seasons in words.
//!
//! Absent: the writing of words into a picture, which is `phytomer_outputs::pictures`'.

use phytomer_config::{About, Species, Trial};
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use phytomer_sim::site::calendar::Calendar;
use phytomer_sim::site::date::DAYS_OF_A_YEAR;
use std::collections::BTreeSet;

/// Ages as a list in words.
pub(super) fn list(ages: &[Moment]) -> String {
    format!("[{}]", ages.iter().map(|age| told(*age)).collect::<Vec<_>>().join(", "))
}

/// An age to be read: to a hundredth of a tick.
fn told(age: Moment) -> String {
    ((age.age() * 100.0).round() / 100.0).to_string()
}

/// The age of a plant in words, with years or the date.
pub(super) fn label_of_plant(trial: &Trial, species: &[&Species], number: u32, age: Moment) -> String {
    let of = trial.plant(number);
    let years = match trial.calendar_of(of.treatment, of.replicate) {
        Some(calendar) => on_the_calendar(calendar, trial.sown_at(number), age),
        None => species[trial.species_of_plant(number)]
            .ticks_per_year()
            .map(|ticks| in_years(age, ticks))
            .unwrap_or_default(),
    };
    format!("age {}{years}", told(age))
}

/// The age of a plant in words, with years or the date, and with its season.
pub(super) fn caption_of_plant(trial: &Trial, species: &[&Species], number: u32, age: Moment) -> String {
    let mut label = label_of_plant(trial, species, number, age);
    let season = species[trial.species_of_plant(number)].about.season(age.age() as Tick);
    label.extend(season.into_iter().flat_map(|season| [" · ", season]));
    label
}

/// The tick of a plot in words, with years or the date.
pub(super) fn caption_of_plot(trial: &Trial, species: &[&Species], plot: u32, tick: Moment) -> String {
    let of_plot = trial.plot(plot);
    let calendar = trial.calendar_of(of_plot.treatment, of_plot.replicate);
    let years = calendar.map_or_else(|| years_of(species, tick), |calendar| on_the_calendar(calendar, 0, tick));
    format!("tick {}{years}", told(tick))
}

/// What the species that are shown are called below their picture, each once.
pub(super) fn titles_of(species: &[&Species], shown: &BTreeSet<usize>) -> String {
    let mut titles: Vec<String> = Vec::new();
    for title in shown.iter().map(|place| title_of(&species[*place].about)) {
        titles.extend(Some(title).filter(|title| !titles.contains(title)));
    }
    titles.join(", ")
}

/// What a species is called below its picture: by its scientific name, if it is one and no list of examples.
fn title_of(about: &About) -> String {
    let one = about.scientific_name.as_ref().filter(|name| !name.contains(", "));
    let model = || about.architectural_model.map(|model| format!("{model:?}'s model"));
    one.or(about.common_name.as_ref()).cloned().or_else(model).unwrap_or_else(|| about.name.clone())
}

/// A tick in years, where all species have the same year.
fn years_of(species: &[&Species], tick: Moment) -> String {
    let mut years = species.iter().map(|species| species.ticks_per_year());
    let first = years.next().flatten();
    first.filter(|first| years.all(|year| year == Some(*first))).map(|ticks| in_years(tick, ticks)).unwrap_or_default()
}

/// The date at which the ticks of an age are over, and the years from sowing to it: ticks of degree-days are not of one
/// length.
fn on_the_calendar(calendar: &Calendar, sown: Tick, age: Moment) -> String {
    let [from, date] = [sown, sown.saturating_add(age.age() as Tick)].map(|tick| calendar.at(tick).date);
    format!(" · {date}{}", years_in_words(f64::from(date.since(from)) / DAYS_OF_A_YEAR))
}

/// An age in years, where a tick is not one itself.
fn in_years(age: Moment, ticks_per_year: f64) -> String {
    let of_a_year = (ticks_per_year - 1.0).abs() < 1e-9;
    if of_a_year { String::new() } else { years_in_words(age.age() / ticks_per_year) }
}

fn years_in_words(years: f64) -> String {
    match years {
        years if (years - years.round()).abs() < 0.05 && (years - 1.0).abs() < 0.05 => " · 1 year".to_owned(),
        years if (years - years.round()).abs() < 0.05 => format!(" · {years:.0} years"),
        years => format!(" · {years:.1} years"),
    }
}
