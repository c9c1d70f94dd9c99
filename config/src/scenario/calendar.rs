//! The calendar of a run as its scenario states it: the day of planting, how long a tick is, and the nitrogen that the
//! date decides.
//!
//! Names and units are those of the ICASA dictionary where it has them (`planting_date`, `fertilization_date`,
//! `N_in_applied_fertilizer` kg[N]/ha). Absent: weather files (`phytomer_weather`), and the calendar that is made of
//! all this (`dates`).

use super::field_plot::{FieldPlot, Spread};
use super::{Experiment, Scenario};
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::site::calendar::{Soil as SimSoil, TickLength as SimTick, season_of};
use phytomer_sim::site::date::Date;
use phytomer_weather::{DegreeDays, Years};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The most nitrogen that a soil supplies or that is applied, kg N/ha.
const MOST_NITROGEN: f64 = 10_000.0;

/// How a day is written.
const A_DAY: &str = "a day as YYYY-MM-DD, such as \"2001-09-03\"";

/// The ticks of a run on the calendar.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Calendar {
    /// The length of a tick: `{ days = 30 }` or `{ degree_days = 100 }`.
    pub tick: TickLength,
    /// How the temperatures of a day become degree-days. Not needed where neither a tick nor a law asks for them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub degree_days: Option<DegreeDays>,
}

/// The length of a tick, by one of the two keys.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TickLength {
    /// The days of a tick.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 3660))]
    pub days: Option<u32>,
    /// The sum of degree-days of a tick, °C d: tick t ends at the first midnight by which t times this sum is reached.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 100_000), extend("exclusiveMinimum" = 0))]
    pub degree_days: Option<f64>,
}

/// The nitrogen of the soil.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Soil {
    /// What the soil supplies by itself in a season, kg N/ha.
    #[schemars(range(min = 0, max = MOST_NITROGEN))]
    pub nitrogen_kg_ha: f64,
    /// The standard deviation of this supply between the blocks of the experiment, kg N/ha: the treatments of a block
    /// share its soil. 0 if not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = MOST_NITROGEN))]
    pub block_sd_kg_ha: f64,
    /// The standard deviation of this supply between field plots, each one replicate of one treatment, kg N/ha. 0 if
    /// not given.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = MOST_NITROGEN))]
    pub field_plot_sd_kg_ha: f64,
    /// The day with which each season begins, as MM-DD such as `"09-01"`: what was applied before counts no more. The
    /// day of the year of planting if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub season_begins: Option<String>,
}

/// An application of fertilizer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fertilizer {
    /// The day on which it is applied, as YYYY-MM-DD.
    pub fertilization_date: String,
    /// The nitrogen that is applied, kg N/ha.
    #[serde(rename = "N_in_applied_fertilizer")]
    #[schemars(range(min = 0, max = MOST_NITROGEN))]
    pub nitrogen: f64,
    /// Whether the same is applied on the same day of each later year. Once if not given.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub yearly: bool,
}

fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

impl TickLength {
    /// The length as the calendar takes it; `None` unless exactly one key is given.
    pub(crate) fn stated(&self) -> Option<SimTick> {
        match (self.days, self.degree_days) {
            (Some(days), None) => Some(SimTick::Days(days)),
            (None, Some(sum)) => Some(SimTick::DegreeDays(sum)),
            _ => None,
        }
    }
}

impl Soil {
    /// Whether the supply differs between the replicates of a treatment.
    pub(crate) fn differs(&self) -> bool {
        self.spread().is_any()
    }

    fn spread(&self) -> Spread {
        Spread { block_sd: self.block_sd_kg_ha, field_plot_sd: self.field_plot_sd_kg_ha }
    }

    /// What the soil of a field plot supplies beyond `nitrogen_kg_ha`, kg N/ha; the whole supply is never below 0.
    pub(crate) fn shift_in(&self, field_plot: &FieldPlot) -> f64 {
        let mean = self.nitrogen_kg_ha;
        field_plot.shifted("nitrogen of the soil", mean, self.spread(), [0.0, MOST_NITROGEN]) - mean
    }

    /// Month and day with which a season begins: those that are stated, else those of planting. `None` where what is
    /// stated is no day.
    fn season(&self, planted: Date) -> Option<(u32, u32)> {
        let Some(stated) = &self.season_begins else { return Some(planted.month_and_day()) };
        // A leap year has every day.
        Date::parse(&format!("2000-{stated}")).map(Date::month_and_day)
    }
}

impl Scenario {
    /// Whether the dates of this scenario are those of another one of the same run.
    pub(crate) fn has_the_dates_of(&self, other: &Self) -> bool {
        let of = |scenario: &Self| {
            let Self { planting_date, calendar, weather, soil, fertilizer, site, .. } = scenario.clone();
            let asks = scenario.asks_for_radiation();
            (planting_date, calendar, weather, soil, fertilizer, site.latitude_deg, asks)
        };
        of(self) == of(other)
    }

    /// The day of planting; `None` where none is stated or what is stated is no day.
    pub(crate) fn planted(&self) -> Option<Date> {
        Date::parse(self.planting_date.as_deref()?)
    }

    /// How many years after `planting_date` each replicate is planted; `None` where all are planted on that day.
    pub(crate) fn years_later(&self, replicates: u32) -> Option<Vec<i32>> {
        let planted = self.planted()?;
        match self.weather.as_ref()?.years.as_ref()? {
            Years::Word(_) => {
                Some((0..replicates).map(|replicate| i32::try_from(replicate).unwrap_or(i32::MAX)).collect())
            }
            Years::List(years) => Some(years.iter().map(|year| year - planted.year()).collect()),
        }
    }

    /// The nitrogen of the soil on the days up to `last` of plants that are planted on the day `planted`, so many years
    /// later than the scenario says: fertilizer is applied as much later. `None` without `[soil]`. Dates are those of a
    /// scenario without faults.
    pub(crate) fn soil_until(&self, planted: Date, last: Date, years_later: i32) -> Option<SimSoil> {
        let soil = self.soil.as_ref()?;
        let applied = self.fertilizer.iter().filter_map(|event| {
            let stated = Date::parse(&event.fertilization_date)?;
            Some((stated.years_later(years_later), event))
        });
        let applied = applied.flat_map(|(first, event)| {
            let years = if event.yearly { last.year().saturating_sub(first.year()).max(0) } else { 0 };
            (0..=years).map(move |year| (first.years_later(year), event.nitrogen))
        });
        let season_begins = soil.season(planted)?;
        Some(SimSoil { own: soil.nitrogen_kg_ha, applied: applied.collect(), season_begins })
    }

    /// Adds the faults of the calendar that the schema cannot state.
    pub(super) fn check_calendar(&self, faults: &mut Vec<Fault>) {
        let mut tell = |keys: &str, problem: String, expected: &str| {
            let path = keys.split('.').fold(Path::root(), |path, key| path.key(key));
            faults.push(Fault::new(&path, problem, expected));
        };
        match (&self.planting_date, &self.calendar) {
            (Some(date), _) if self.planted().is_none() => tell("planting_date", format!("`{date}` is no day"), A_DAY),
            (Some(_), None) => tell(
                "planting_date",
                "the day of planting has no effect without a calendar".to_owned(),
                "`[calendar]` with the length of a tick, such as `tick = { days = 30 }`",
            ),
            (None, Some(_)) => tell(
                "calendar",
                "the calendar has no day to begin with".to_owned(),
                "`planting_date`, the day on which tick 0 is reached",
            ),
            _ => {}
        }
        if self.calendar.is_none() {
            let given = [("weather", self.weather.is_some()), ("soil", self.soil.is_some())];
            for (key, _) in given.into_iter().filter(|(_, given)| *given) {
                let problem = format!("`{key}` has no effect without a calendar");
                tell(key, problem, "`planting_date` and `[calendar]`, or no such table");
            }
        }
        if !self.fertilizer.is_empty() && self.soil.is_none() {
            let problem = "fertilizer has no effect where the nitrogen of the soil is not stated".to_owned();
            tell("fertilizer", problem, "`[soil]` with `nitrogen_kg_ha`");
        }
        self.check_degree_days(&mut tell);
        self.check_latitude(&mut tell);
        if let Some(degree_days) = self.calendar.as_ref().and_then(|calendar| calendar.degree_days) {
            faults.extend(degree_days.faults(&Path::root().key("calendar").key("degree_days")));
        }
        self.check_soil(faults);
    }

    /// Years of the weather are those of replicates, and need what asks for the weather.
    pub(super) fn check_years(&self, experiment: &Experiment, faults: &mut Vec<Fault>) {
        let path = Path::root().key("weather").key("years");
        let mut tell = |problem: String, expected: String| faults.push(Fault::new(&path, problem, expected));
        let Some(years) = self.weather.as_ref().and_then(|weather| weather.years.as_ref()) else { return };
        let replicates = experiment.replicates;
        match years {
            Years::List(years) if years.len() != replicates as usize => {
                let noun = if years.len() == 1 { "year" } else { "years" };
                let problem = format!("{} {noun} for {replicates} replicates", years.len());
                tell(problem, "the year of planting of each replicate (`experiment.replicates`)".to_owned());
            }
            Years::Word(_) if replicates < 2 => tell(
                "there is one replicate, which grows in the year of `planting_date`".to_owned(),
                "`replicates` of at least 2 in `[experiment]`, or no `years`".to_owned(),
            ),
            _ => {}
        }
        let is_deaf = self.calendar.as_ref().is_some_and(|calendar| calendar.degree_days.is_none());
        if is_deaf && !self.asks_for_radiation() {
            let problem = "the years have no effect: nothing asks for the temperatures of the weather".to_owned();
            tell(problem, "`calendar.degree_days` with `method` and `base_celsius`".to_owned());
        }
    }

    fn check_degree_days(&self, tell: &mut impl FnMut(&str, String, &str)) {
        let Some(calendar) = &self.calendar else { return };
        if calendar.tick.stated().is_none() {
            let given = if calendar.tick.days.is_some() { "two lengths" } else { "no length" };
            let problem = format!("the tick has {given}");
            tell("calendar.tick", problem, "either `days` or `degree_days`, such as `{ days = 30 }`");
        }
        match (calendar.degree_days, calendar.tick.degree_days) {
            (None, Some(_)) => tell(
                "calendar.tick.degree_days",
                "the tick is a sum of degree-days, and how they are taken is not stated".to_owned(),
                "`calendar.degree_days` with `method` and `base_celsius`",
            ),
            (Some(_), _) if self.weather.is_none() => tell(
                "calendar.degree_days",
                "degree-days need temperatures, and there is no weather".to_owned(),
                "`[weather]` with a `file`",
            ),
            _ => {}
        }
    }

    fn check_latitude(&self, tell: &mut impl FnMut(&str, String, &str)) {
        if self.site.latitude_deg.is_some() && self.weather.as_ref().is_some_and(|of| of.latitude_deg.is_some()) {
            let problem = "the latitude is stated twice, in `[site]` and in `[weather]`".to_owned();
            tell("site.latitude_deg", problem, "one of the two");
        }
    }

    fn check_soil(&self, faults: &mut Vec<Fault>) {
        let planted = self.planted();
        let stated = self.soil.as_ref().and_then(|soil| soil.season_begins.as_ref());
        let season = self.soil.as_ref().zip(planted).and_then(|(soil, planted)| soil.season(planted));
        if let (Some(stated), Some(soil)) = (stated, &self.soil)
            && soil.season(Date::FIRST).is_none()
        {
            let path = Path::root().key("soil").key("season_begins");
            faults.push(Fault::new(
                &path,
                format!("`{stated}` is no day of a year"),
                "a day as MM-DD, such as \"09-01\"",
            ));
        }
        for (number, event) in self.fertilizer.iter().enumerate() {
            let path = Path::root().key("fertilizer").index(number).key("fertilization_date");
            let Some(date) = Date::parse(&event.fertilization_date) else {
                faults.push(Fault::new(&path, format!("`{}` is no day", event.fertilization_date), A_DAY));
                continue;
            };
            let Some((planted, season)) = planted.zip(season) else { continue };
            let first = season_of(planted, season);
            if date < first && !event.yearly {
                let problem =
                    format!("the season of planting begins on {first}: what is applied on {date} has no effect");
                faults.push(Fault::new(&path, problem, "a later day, or an earlier `soil.season_begins`"));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenario(keys: &str) -> Scenario {
        let text = format!("name = \"a\"\nspecies = \"coffee\"\nplants = 1\nages = {{ until = 12 }}\n{keys}");
        toml::from_str(&text).unwrap_or_else(|error| panic!("{error}"))
    }

    fn date(text: &str) -> Date {
        Date::parse(text).expect("a day")
    }

    #[test]
    fn applications_come_again_each_year_where_that_is_stated() {
        let of = scenario(
            "planting_date = \"2000-02-29\"\ncalendar = { tick = { days = 30 } }\n\
             soil = { nitrogen_kg_ha = 20, season_begins = \"09-01\" }\n\
             fertilizer = [{ fertilization_date = \"2000-02-29\", N_in_applied_fertilizer = 30, yearly = true },\n\
             { fertilization_date = \"2000-10-01\", N_in_applied_fertilizer = 50 }]",
        );
        assert_eq!(of.faults(), []);
        let soil = of.soil_until(date("2000-02-29"), date("2002-06-01"), 0).expect("a soil");
        let days = ["2000-02-29", "2001-02-28", "2002-02-28"].map(|day| (date(day), 30.0));
        assert_eq!(soil.applied, [days.as_slice(), &[(date("2000-10-01"), 50.0)]].concat());
        assert_eq!((soil.own, soil.season_begins), (20.0, (9, 1)));
        let later = of.soil_until(date("2001-02-28"), date("2001-12-01"), 1).expect("a soil");
        assert_eq!(later.applied, [(date("2001-02-28"), 30.0), (date("2001-10-01"), 50.0)]);
    }

    #[test]
    fn replicates_may_grow_in_years_of_their_own() {
        let of = |years: &str| {
            let weather = format!("weather = {{ file = \"a.csv\"{years} }}");
            scenario(&format!("planting_date = \"1990-04-01\"\ncalendar = {{ tick = {{ days = 30 }} }}\n{weather}"))
        };
        assert_eq!(of("").years_later(3), None);
        assert_eq!(of(", years = \"replicates\"").years_later(3), Some(vec![0, 1, 2]));
        assert_eq!(of(", years = [1995, 1988]").years_later(2), Some(vec![5, -2]));
    }

    #[test]
    fn the_soil_of_a_field_plot_supplies_no_less_than_nothing() {
        let of = scenario("soil = { nitrogen_kg_ha = 5, field_plot_sd_kg_ha = 20 }").soil.expect("a soil");
        let in_plot = |replicate| FieldPlot { seed: 1, treatment: "control", replicate, block: None };
        let shifts: Vec<f64> = (0..50).map(|replicate| of.shift_in(&in_plot(replicate))).collect();
        assert!(of.differs() && shifts.contains(&-5.0) && shifts.iter().all(|shift| *shift >= -5.0), "{shifts:?}");
    }

    #[test]
    fn without_a_calendar_a_scenario_is_as_before() {
        let plain = scenario("");
        assert!(plain.planted().is_none() && plain.faults().is_empty());
        let text = toml::to_string(&plain).expect("a text");
        assert!(
            ["calendar", "weather", "soil", "fertilizer", "planting"].iter().all(|key| !text.contains(key)),
            "{text}"
        );
    }
}
