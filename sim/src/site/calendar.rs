//! The calendar of a plot: what the date alone decides of each of its ticks, as degree-days, day length and nitrogen.
//!
//! Tick 0 is the midnight with which the day of planting begins, and every tick ends at a midnight: its *date* is the
//! day that then begins. So a tick spans whole days, from the date of the tick before up to the day before its own. A
//! tick is a fixed number of days, or it ends at the first midnight by which the degree-days since planting reach so
//! many times their sum; a hot day can then end two ticks, which have the same date. Degree-days are added up from
//! planting on; nitrogen is what the soil supplies in a season, and what was applied in it by then. Growth at tick t
//! reads the values of tick t. Days become ticks in `making`. Absent: weather files, which the caller reads; water.

mod making;

pub use making::season_of;

use crate::clock::Tick;
use crate::site::date::Date;
use crate::site::degree_days::DegreeDays;
use std::sync::Arc;

/// How long a tick is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TickLength {
    /// So many days; at least one.
    Days(u32),
    /// So many degree-days, °C d; above 0.
    DegreeDays(f64),
}

/// What a calendar is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Terms {
    /// The day of planting, with which tick 0 is reached.
    pub planted: Date,
    /// How long a tick is.
    pub tick: TickLength,
    /// How a day's temperatures become degree-days; `None` where nothing asks for them.
    pub degree_days: Option<DegreeDays>,
    /// The latitude of the site, radians, north positive; `None` where it is not known.
    pub latitude: Option<f64>,
    /// The nitrogen of the soil; `None` where it is not known.
    pub soil: Option<Soil>,
}

/// The nitrogen that plants find in the soil.
#[derive(Debug, Clone, PartialEq)]
pub struct Soil {
    /// What the soil supplies by itself in a season, kg N/ha.
    pub own: f64,
    /// What is applied, kg N/ha: each amount with its day, in any order.
    pub applied: Vec<(Date, f64)>,
    /// Month and day with which a season begins; what was applied before counts no more.
    pub season_begins: (u32, u32),
}

/// A tick of a calendar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CalendarTick {
    /// The day that begins when the tick ends.
    pub date: Date,
    /// The days that the tick spans; 0 at tick 0, and where the tick before ended at the same midnight.
    pub days: u32,
    /// The degree-days of these days, °C d; `None` where they are not known.
    pub degree_days: Option<f64>,
    /// The degree-days since planting, °C d.
    pub degree_day_sum: Option<f64>,
    /// Hours from sunrise to sunset on the date; `None` without a latitude.
    pub day_length_h: Option<f64>,
    /// The soil's own supply of the season and what was applied in it before the date, kg N/ha; `None` where the soil
    /// is not known.
    pub nitrogen_kg_ha: Option<f64>,
}

/// Why a calendar cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CalendarError {
    /// The weather has no such day, on which growth depends.
    #[error("there is no weather for {date}, which tick {tick} needs")]
    NoWeather {
        /// The tick that spans the day.
        tick: Tick,
        /// The day.
        date: Date,
    },
    /// A tick does not end, because it is too cold.
    #[error("tick {tick} begins on {from} and has not reached its degree-days after ten years")]
    Endless {
        /// The tick.
        tick: Tick,
        /// The day with which it begins.
        from: Date,
    },
    /// A tick lies beyond the dates that there are.
    #[error("tick {tick} lies beyond the year 9999")]
    BeyondDates {
        /// The tick.
        tick: Tick,
    },
}

/// What the radiation of the weather says of the light of each tick.
#[derive(Debug, Clone, PartialEq)]
pub struct Skylight {
    /// The latitude of the site, radians, north positive.
    pub latitude: f64,
    /// Of each tick, from 0, the share of the sky in the radiation of its days.
    pub of_sky: Vec<f64>,
}

/// The calendar of a plot: its ticks, from 0 to the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Calendar {
    ticks: Vec<CalendarTick>,
    /// What the weather says of the light; `None` where nothing asks for it.
    skylight: Option<Skylight>,
    length: TickLength,
    /// How many years later it lies than the days that its scenario states.
    years_later: i32,
}

impl Calendar {
    /// The calendar up to the tick `until`. `weather` gives the highest and the lowest temperature of a day, °C, or
    /// `None` where there is no weather; it is asked day by day, and not at all where nothing asks for degree-days.
    ///
    /// # Errors
    /// The first day without weather, or the first tick that does not end.
    pub fn of(
        terms: &Terms,
        until: Tick,
        mut weather: impl FnMut(Date) -> Option<[f64; 2]>,
    ) -> Result<Self, CalendarError> {
        let ticks = making::ticks(terms, until, &mut weather)?;
        Ok(Self { ticks, skylight: None, length: terms.tick, years_later: 0 })
    }

    /// A calendar of these ticks, as another one had them; `None` without any.
    pub fn of_ticks(length: TickLength, ticks: Vec<CalendarTick>) -> Option<Self> {
        (!ticks.is_empty()).then_some(Self { ticks, skylight: None, length, years_later: 0 })
    }

    /// The same calendar as one that lies so many years later than the days that its scenario states, since its plants
    /// are planted as much later.
    pub fn lying_later(mut self, years: i32) -> Self {
        self.years_later = years;
        self
    }

    /// The same calendar with what the weather says of the light of its ticks.
    pub fn lit(mut self, skylight: Option<Skylight>) -> Self {
        self.skylight = skylight;
        self
    }

    /// What the weather says of the light of its ticks; `None` where nothing asks for it.
    pub fn skylight(&self) -> Option<&Skylight> {
        self.skylight.as_ref()
    }

    /// How many years later it lies than the days that its scenario states.
    pub fn years_later(&self) -> i32 {
        self.years_later
    }

    /// The same calendar over a soil that supplies so much more in each season, kg N/ha; less where that is negative.
    pub fn supplied(mut self, more: f64) -> Self {
        for nitrogen in self.ticks.iter_mut().filter_map(|tick| tick.nitrogen_kg_ha.as_mut()) {
            *nitrogen += more;
        }
        self
    }

    /// A tick; beyond the last, the last one.
    pub fn at(&self, tick: Tick) -> &CalendarTick {
        &self.ticks[(tick as usize).min(self.ticks.len() - 1)]
    }

    /// The tick that spans a day: what is done on that day is done at that tick. `None` where the day lies before
    /// planting or after the last tick.
    pub fn tick_of(&self, day: Date) -> Option<Tick> {
        let tick = self.ticks.partition_point(|tick| tick.date <= day);
        (tick > 0 && tick < self.ticks.len()).then_some(tick as Tick)
    }

    /// All ticks, from 0.
    pub fn ticks(&self) -> &[CalendarTick] {
        &self.ticks
    }

    /// How long a tick is.
    pub fn tick_length(&self) -> TickLength {
        self.length
    }
}

/// The dates of a plant: the calendar of its plot, and the tick of the plot at which the plant is sown.
#[derive(Debug, Clone, PartialEq)]
pub struct Dates {
    /// The calendar of the plot.
    pub calendar: Arc<Calendar>,
    /// The tick of the plot at which the plant has age 0.
    pub sown: Tick,
}

impl Dates {
    /// The tick of the plot at which the plant has an age.
    pub fn at_age(&self, age: Tick) -> &CalendarTick {
        self.calendar.at(self.sown.saturating_add(age))
    }

    /// The degree-days from its sowing to an age, °C d; `None` where they are not known.
    pub fn degree_days_by(&self, age: Tick) -> Option<f64> {
        Some(self.at_age(age).degree_day_sum? - self.at_age(0).degree_day_sum?)
    }

    /// The degree-days a day in the tick of an age, °C d/d: how warm its days were. A tick that a hot day has ended
    /// with the tick before it has no days of its own, and is as warm as that one; tick 0 is as warm as tick 1.
    pub fn degree_days_per_day(&self, age: Tick) -> Option<f64> {
        let ticks = self.calendar.ticks();
        let last = (self.sown.saturating_add(age) as usize).clamp(1, ticks.len().max(2) - 1);
        let spanning = ticks.get(1..=last)?.iter().rev().find(|tick| tick.days > 0)?;
        Some(spanning.degree_days? / f64::from(spanning.days))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::site::degree_days::Method;

    const ABOVE_TEN: DegreeDays = DegreeDays { method: Method::Average, base: 10.0, upper: None };

    fn date(year: i32, month: u32, day: u32) -> Date {
        Date::new(year, month, day).expect("a day")
    }

    fn terms(tick: TickLength) -> Terms {
        Terms { planted: date(2001, 3, 1), tick, degree_days: Some(ABOVE_TEN), latitude: None, soil: None }
    }

    fn steady(_: Date) -> Option<[f64; 2]> {
        Some([25.0, 25.0])
    }

    /// 25 °C all day are 15 °C d above 10 °C: after t ticks of 30 days, 450 t.
    #[test]
    fn ticks_of_days_add_up_degree_days() {
        let calendar = Calendar::of(&terms(TickLength::Days(30)), 40, steady).expect("a calendar");
        assert_eq!(calendar.ticks().len(), 41);
        for (tick, at) in (0..).zip(calendar.ticks()) {
            assert_eq!(at.date, date(2001, 3, 1).plus(30 * tick));
            assert_eq!(at.days, if tick == 0 { 0 } else { 30 });
            assert_eq!(at.degree_days, Some(if tick == 0 { 0.0 } else { 450.0 }));
            assert_eq!(at.degree_day_sum, Some(450.0 * f64::from(tick)));
            assert_eq!((at.day_length_h, at.nitrogen_kg_ha), (None, None));
        }
    }

    /// A tick of 30 days spans the days from the date of the tick before up to the day before its own.
    #[test]
    fn a_day_lies_in_the_tick_that_spans_it() {
        let calendar = Calendar::of(&terms(TickLength::Days(30)), 3, steady).expect("a calendar");
        let planted = date(2001, 3, 1);
        let ticks = [-1, 0, 29, 30, 59, 60, 89, 90].map(|days| calendar.tick_of(planted.plus(days)));
        assert_eq!(ticks, [None, Some(1), Some(1), Some(2), Some(2), Some(3), Some(3), None]);
        // Of two ticks that a hot day ends the first spans it.
        let hot = Calendar::of(&terms(TickLength::DegreeDays(5.0)), 6, steady).expect("a calendar");
        assert_eq!(hot.tick_of(planted.plus(1)), Some(4));
    }

    /// At 15 °C d a day, tick t of 100 °C d ends at the first midnight by which 15 d ≥ 100 t: after ⌈20 t/3⌉ days.
    #[test]
    fn ticks_of_degree_days_end_at_the_midnight_that_reaches_their_sum() {
        let calendar = Calendar::of(&terms(TickLength::DegreeDays(100.0)), 60, steady).expect("a calendar");
        for (tick, at) in (0..).zip(calendar.ticks()) {
            let days = (20 * tick + 2) / 3;
            assert_eq!(at.date.since(date(2001, 3, 1)), days, "tick {tick}");
            assert_eq!(at.degree_day_sum, Some(15.0 * f64::from(days)));
        }
        let spans: Vec<u32> = calendar.ticks().iter().map(|at| at.days).collect();
        assert_eq!(spans[..7], [0, 7, 7, 6, 7, 7, 6]);
    }

    #[test]
    fn a_hot_day_can_end_several_ticks() {
        let calendar = Calendar::of(&terms(TickLength::DegreeDays(6.0)), 5, steady).expect("a calendar");
        let days: Vec<u32> = calendar.ticks().iter().map(|at| at.days).collect();
        assert_eq!(
            days,
            [0, 1, 0, 1, 0, 0],
            "15 °C d a day: the sums 6, 12, 18, 24 and 30 after 1, 1, 2, 2 and 2 days"
        );
        assert_eq!(calendar.at(99), calendar.at(5), "beyond the last tick, the last");
        let dates = Dates { calendar: Arc::new(calendar), sown: 1 };
        let warm = [0, 1, 2, 4, 99].map(|age| dates.degree_days_per_day(age));
        assert_eq!(warm, [Some(15.0); 5], "a tick without days is as warm as the one before it");
    }

    /// Days of 20 °C and of 14 °C in turn: ten of them are on average 7 °C d a day above 10 °C, a single one 10 or 4.
    #[test]
    fn a_tick_is_as_warm_as_the_mean_of_its_days() {
        let in_turn = |day: Date| Some([if day.since(date(2001, 3, 1)) % 2 == 0 { 20.0 } else { 14.0 }; 2]);
        let of = |days| {
            let calendar = Calendar::of(&terms(TickLength::Days(days)), 9, in_turn).expect("a calendar");
            let dates = Dates { calendar: Arc::new(calendar), sown: 0 };
            [0, 1, 2, 3].map(|age| dates.degree_days_per_day(age).expect("degree-days"))
        };
        assert_eq!((of(10), of(1)), ([7.0; 4], [10.0, 10.0, 4.0, 10.0]), "tick 0 is as warm as tick 1");
    }

    #[test]
    fn what_the_weather_does_not_have_is_told() {
        let last = date(2001, 4, 9);
        let ends = |day: Date| (day <= last).then_some([25.0, 25.0]);
        let told = Calendar::of(&terms(TickLength::Days(30)), 2, ends).expect_err("no weather");
        assert_eq!(told, CalendarError::NoWeather { tick: 2, date: date(2001, 4, 10) });
        let cold = Calendar::of(&terms(TickLength::DegreeDays(100.0)), 3, |_| Some([9.0, 1.0]));
        assert_eq!(cold, Err(CalendarError::Endless { tick: 1, from: date(2001, 3, 1) }));
        let without = Terms { degree_days: None, ..terms(TickLength::Days(1)) };
        assert!(Calendar::of(&without, 9, |_| None).is_ok(), "nothing asks for weather");
        let late = Terms { planted: date(9999, 12, 1), ..without };
        assert_eq!(Calendar::of(&late, 40, steady), Err(CalendarError::BeyondDates { tick: 31 }));
    }

    /// FAO-56, example 9: 20° S on 3 September has a day of 11.7 hours; days are longest at midsummer.
    #[test]
    fn day_length_is_that_of_the_date() {
        let south = Terms {
            planted: date(2001, 9, 3),
            latitude: Some((-20.0_f64).to_radians()),
            degree_days: None,
            ..terms(TickLength::Days(1))
        };
        let calendar = Calendar::of(&south, 365, |_| None).expect("a calendar");
        let length = |tick| calendar.at(tick).day_length_h.expect("a latitude");
        assert!((length(0) - 11.7).abs() < 0.05, "{}", length(0));
        let longest = (0..=365).max_by(|a, b| length(*a).total_cmp(&length(*b))).expect("a tick");
        let solstice = calendar.at(longest).date;
        assert!((19..=24).contains(&solstice.month_and_day().1) && solstice.month_and_day().0 == 12, "{solstice}");
    }

    #[test]
    fn nitrogen_is_the_soils_and_what_the_season_was_given_so_far() {
        let applied = vec![(date(2001, 3, 1), 40.0), (date(2001, 5, 1), 20.0), (date(2002, 3, 2), 5.0)];
        let soil = Soil { own: 20.0, applied, season_begins: (3, 1) };
        let fed = Terms { soil: Some(soil), degree_days: None, ..terms(TickLength::Days(1)) };
        let calendar = Calendar::of(&fed, 800, |_| None).expect("a calendar");
        let by = |day: Date| calendar.at(day.since(date(2001, 3, 1)) as u32).nitrogen_kg_ha.expect("a soil");
        assert_eq!(by(date(2001, 3, 1)), 20.0, "nothing has been applied yet when the day begins");
        assert_eq!([by(date(2001, 3, 2)), by(date(2001, 5, 1)), by(date(2001, 5, 2))], [60.0, 60.0, 80.0]);
        assert_eq!(by(date(2002, 3, 1)), 80.0, "the last day of the season");
        assert_eq!([by(date(2002, 3, 2)), by(date(2002, 3, 3)), by(date(2003, 3, 2))], [20.0, 25.0, 20.0]);
    }

    #[test]
    fn seasons_begin_each_year_on_their_day() {
        assert_eq!(season_of(date(2001, 8, 31), (9, 1)), date(2000, 9, 1));
        assert_eq!(season_of(date(2001, 9, 1), (9, 1)), date(2001, 9, 1));
        assert_eq!(season_of(date(2001, 2, 28), (2, 29)), date(2001, 2, 28));
        assert_eq!(season_of(date(2004, 2, 28), (2, 29)), date(2003, 2, 28));
    }
}
