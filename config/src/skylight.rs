//! The share of the sky in the light of each tick of a calendar, from the solar radiation of the weather.
//!
//! Every day of the run must have its radiation: nothing is guessed for a day without. A tick without days of its own
//! has the share of the tick before; tick 0 has that of tick 1. Absent: the formula (`phytomer_sim::site::light::sun`).

use phytomer_law::fault::Fault;
use phytomer_sim::site::calendar::{Calendar, Skylight};
use phytomer_sim::site::date::Date;
use phytomer_sim::site::light::sun::share_of_days;
use phytomer_weather::Weather;

use crate::load::path_of;

/// What else would do.
const STATED: &str = "or a stated share, such as `diffuse = 0.4`";

/// The light of the sky in the ticks of a calendar.
///
/// # Errors
/// The latitude is not known, or the weather lacks the radiation of a day.
pub(crate) fn of(weather: Option<&Weather>, latitude: Option<f64>, calendar: &Calendar) -> Result<Skylight, Fault> {
    let fault = |problem: String, expected: &str| {
        Fault::new(&path_of(&["light", "sun", "diffuse"]), problem, format!("{expected}, {STATED}"))
    };
    let Some(weather) = weather else {
        let problem = "the share of the sky is to follow from the weather, and there is none".to_owned();
        return Err(fault(problem, "`[weather]` with a `file` that has solar radiation"));
    };
    let Some(latitude) = latitude else {
        let problem = "neither the weather file nor the scenario has a latitude".to_owned();
        return Err(fault(problem, "`site.latitude_deg`"));
    };
    let ticks = calendar.ticks();
    let mut lacking: Vec<(usize, Date)> = Vec::new();
    let mut of_sky = vec![1.0; ticks.len()];
    for (tick, two) in (1..).zip(ticks.windows(2)) {
        let dates = (0..two[1].days as i32).map(|day| two[0].date.plus(day));
        let days: Vec<(Date, Option<f64>)> =
            dates.map(|date| (date, weather.day(date).and_then(|day| day.radiation))).collect();
        lacking.extend(days.iter().filter(|(_, radiation)| radiation.is_none()).map(|(date, _)| (tick, *date)));
        let known = days.iter().filter_map(|(date, radiation)| Some((*date, (*radiation)?)));
        of_sky[tick] = if days.is_empty() { of_sky[tick - 1] } else { share_of_days(latitude, known) };
    }
    if let Some((tick, date)) = lacking.first() {
        let (count, last) = (lacking.len(), ticks[ticks.len() - 1].date);
        let all = last.since(ticks[0].date);
        let problem = format!(
            "the weather has no solar radiation on {count} of the {all} days of the run, first on {date}, of tick {tick}"
        );
        return Err(fault(problem, "a file that has it for every day (`SRAD`, in `.met` `radn`)"));
    }
    if let [_, first, ..] = of_sky[..] {
        of_sky[0] = first;
    }
    Ok(Skylight { latitude, of_sky })
}
