//! The attacks of a pest on one plant: at ages of the plant, season after season, or on days of the calendar, year
//! after year.
//!
//! A season of days belongs to the ticks that span its first and its last day. A plant that is sown in the midst of an
//! attack meets the rest of it, at the hazard of each tick that the whole attack has. Of an attack that goes on after
//! the run, the ticks are counted as in the year before. A yearly attack that is under way when the run begins has the
//! ticks that its rest has in the run, and before them as many more as its days before the run are worth at the same
//! days a tick. Absent: how severe an attack is.

use super::super::days;
use super::{Host, Pest, Run};
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::site::calendar::Calendar;
use phytomer_sim::site::date::Date;

/// One season of attacks, in ages of the plant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Attack {
    /// The number of the season, from 0, by which its draws are keyed.
    pub season: u32,
    /// The first age at which it attacks the plant.
    pub from: u32,
    /// The last age at which it attacks the plant.
    pub until: u32,
    /// The ticks of the whole attack.
    pub ticks: u32,
    /// The ages, from the first up to before the second, of the season after it; `None` where it does not come again.
    pub next: Option<[u32; 2]>,
}

/// One season of attacks, in ticks of the plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Season {
    /// Its number, from 0.
    number: u32,
    first: u32,
    last: u32,
    /// The ticks of the whole attack, of which some may lie before the run.
    ticks: u32,
}

impl Season {
    /// The rest of an attack on days of which the first lies before the run and the last in it or behind it.
    fn under_way(number: u32, [first, last]: [Date; 2], calendar: &Calendar) -> Option<Self> {
        let begun = calendar.at(0).date;
        if first >= begun || last < begun {
            return None;
        }
        let ends = calendar.tick_of(last).unwrap_or(calendar.ticks().len() as u32 - 1);
        let days = u64::from(calendar.at(ends).date.since(begun).max(1).unsigned_abs());
        let before = u64::from(begun.since(first).max(0).unsigned_abs());
        let ticks = u64::from(ends) + (before * u64::from(ends) + days / 2) / days;
        (ends > 0).then_some(Self { number, first: 1, last: ends, ticks: u32::try_from(ticks).unwrap_or(u32::MAX) })
    }
}

impl Pest {
    /// The attacks on a plant up to its last age, season by season.
    pub(super) fn attacks_on(&self, host: &Host<'_>) -> Vec<Attack> {
        match (self.ages, host.calendar) {
            (Some(ages), _) => self.at_ages(ages, host.until),
            (None, Some(calendar)) => self.on_days(host, calendar),
            (None, None) => Vec::new(),
        }
    }

    fn at_ages(&self, [first, last]: [u32; 2], until: u32) -> Vec<Attack> {
        let every = self.every.unwrap_or(u32::MAX).max(1);
        let ticks = last.saturating_sub(first) + 1;
        let season = |(season, from): (u32, u32)| {
            let next = from.saturating_add(every);
            let next = self.every.map(|every| [next, next.saturating_add(every)]);
            Attack { season, from, until: from.saturating_add(ticks - 1), ticks, next }
        };
        (0..).zip((first..=until).step_by(every as usize)).map(season).collect()
    }

    fn on_days(&self, host: &Host<'_>, calendar: &Calendar) -> Vec<Attack> {
        let seasons = self.seasons_of(calendar);
        let age = |tick: u32| tick.saturating_sub(host.sown);
        let end = host.sown.saturating_add(host.until).saturating_add(1);
        let of_plant = |(place, season): (usize, &Season)| {
            let begins = |later: usize| seasons.get(place + later).map_or(end, |season| season.first);
            let next = self.yearly.then(|| [age(begins(1)), age(begins(2))]);
            let Season { number, first, last, ticks } = *season;
            let (from, until) = (age(first).max(1), age(last));
            (last > host.sown).then_some(Attack { season: number, from, until, ticks, next })
        };
        seasons.iter().enumerate().filter_map(of_plant).collect()
    }

    /// The seasons that lie in the run or reach into it.
    fn seasons_of(&self, calendar: &Calendar) -> Vec<Season> {
        let Some([first, last]) = self.days() else { return Vec::new() };
        let mut seasons: Vec<Season> = Vec::new();
        let lasts = days::years_on(days::lying_in(last, calendar));
        let years = days::years(first, self.yearly, calendar).zip(lasts);
        for (number, (first, last)) in (0..).zip(years) {
            let under_way = Season::under_way(number, [first, last], calendar).filter(|_| self.yearly);
            if let Some(under_way) = under_way {
                seasons.push(under_way);
                continue;
            }
            let Some(first) = calendar.tick_of(first) else { continue };
            let as_before = || seasons.last().map_or(first, |season| first + (season.ticks - 1));
            let last = calendar.tick_of(last).unwrap_or_else(as_before).max(first);
            seasons.push(Season { number, first, last, ticks: last - first + 1 });
        }
        seasons
    }

    /// Its first and its last day; `None` where they are not stated, or are no days.
    fn days(&self) -> Option<[Date; 2]> {
        let [first, last] = self.dates.as_ref()?;
        Some([Date::parse(first)?, Date::parse(last)?])
    }

    /// The fault of an attack whose days do not lie in the run.
    pub(super) fn fault_of_days(&self, calendar: &Calendar, path: &Path) -> Option<Fault> {
        let [first, last] = self.days()?;
        let outside = || days::fault_of(first, self.yearly, calendar, &path.key("dates").index(0));
        let is_in_the_run = !self.seasons_of(calendar).is_empty();
        let outside = if is_in_the_run { None } else { outside() };
        outside.or_else(|| days::fault_of(last, self.yearly, calendar, &path.key("dates").index(1)))
    }

    /// Adds the faults of its ages and days that need no calendar.
    pub(super) fn check_times(&self, path: &Path, run: Run, faults: &mut Vec<Fault>) {
        let mut fault = |key: &str, problem: &str, expected: &str| {
            faults.push(Fault::new(&path.key(key), problem, expected));
        };
        match (self.ages, &self.dates) {
            (Some(_), Some(_)) => fault("dates", "the attack has ages of the plants and days", "`ages` or `dates`"),
            (None, None) => fault("name", "the attack has no time", "`ages` or `dates` beside it"),
            _ => {}
        }
        if self.yearly && self.dates.is_none() {
            fault("yearly", "`yearly` repeats days, and none are given", "`dates`, or `every` beside `ages`");
        }
        if self.every.is_some() && self.ages.is_none() {
            fault("every", "`every` repeats ages, and none are given", "`ages`, or `yearly` beside `dates`");
        }
        self.check_ages(path, run.until, faults);
        self.check_dates(path, run, faults);
    }

    fn check_ages(&self, path: &Path, until: u32, faults: &mut Vec<Fault>) {
        let Some([first, last]) = self.ages else { return };
        let mut fault = |key: &str, problem: String, expected: &str| {
            faults.push(Fault::new(&path.key(key), problem, expected));
        };
        if first > last {
            fault("ages", format!("the attack ends at age {last} before it begins at {first}"), "[first, last]");
        } else if first > until {
            fault("ages", format!("the attack begins at age {first}, after the run"), &format!("an age up to {until}"));
        }
        if let Some(every) = self.every.filter(|every| first <= last && *every <= last - first) {
            let problem = format!("an attack of {} ticks begins again after {every}", last - first + 1);
            fault("every", problem, &format!("at least {} ticks", last - first + 1));
        }
    }

    fn check_dates(&self, path: &Path, run: Run, faults: &mut Vec<Fault>) {
        let Some(stated) = &self.dates else { return };
        let path = path.key("dates");
        let texts = stated.iter().enumerate();
        let told = faults.len();
        faults.extend(texts.filter_map(|(k, day)| days::fault_of_text(day, run.has_calendar, &path.index(k))));
        let Some([first, last]) = self.days().filter(|_| faults.len() == told) else { return };
        if first > last {
            let problem = format!("the attack ends on {last}, before it begins on {first}");
            faults.push(Fault::new(&path, problem, "[first, last]"));
        } else if self.yearly && last >= first.years_later(1) {
            let problem = format!("an attack from {first} to {last} begins again before it has ended");
            faults.push(Fault::new(&path, problem, "less than a year"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::field_plot::FieldPlot;
    use super::super::exposure;
    use super::*;
    use phytomer_sim::site::calendar::{Terms, TickLength};

    /// Days of each year are the ticks of 30 days that span them; a plant that is sown in an attack meets the rest of
    /// it, at the hazard that the whole attack has a tick.
    #[test]
    fn attacks_on_days_come_in_the_ticks_that_span_them() {
        let terms = Terms {
            planted: Date::parse("2020-01-01").expect("a day"),
            tick: TickLength::Days(30),
            degree_days: None,
            latitude: None,
            soil: None,
        };
        let calendar = Calendar::of(&terms, 26, |_| None).expect("a calendar");
        // Days 120 to 229 of each year: the ticks 5 to 8, and 17 to 20 (days 485 to 594).
        let text = "name = \"miner\"\nattacks = \"leaf\"\nprobability = 0.4\nnext_season = 0.5\nyearly = true\n\
                    dates = [\"2020-04-30\", \"2020-08-17\"]";
        let yearly: Pest = toml::from_str(text).expect("a pest");
        let host = Host {
            field_plot: FieldPlot { seed: 7, treatment: "control", replicate: 0, block: None },
            plot: 1,
            plant: 1,
            place: [0.0; 2],
            until: 26,
            sown: 0,
            calendar: Some(&calendar),
        };
        let met = |sown: u32| {
            let host = Host { until: 26 - sown, sown, ..host };
            yearly.attacks_on(&host)
        };
        let attack = |season, from, until, next| Attack { season, from, until, ticks: 4, next: Some(next) };
        assert_eq!(met(0), [attack(0, 5, 8, [17, 27]), attack(1, 17, 20, [27, 27])]);
        assert_eq!(met(6), [attack(0, 1, 2, [11, 21]), attack(1, 11, 14, [21, 21])]);
        assert_eq!(met(8), [attack(1, 9, 12, [19, 19])]);
        // Planted in the midst of the attack, 61 days after its first day: its rest has the ticks 1 and 2, which span
        // 60 days, so two more ticks lie before the run. The next season has what it always has.
        let planted = Terms { planted: Date::parse("2020-06-30").expect("a day"), ..terms };
        let midst = Calendar::of(&planted, 26, |_| None).expect("a calendar");
        let in_the_midst = Host { calendar: Some(&midst), ..host };
        assert_eq!(
            yearly.attacks_on(&in_the_midst),
            [
                attack(0, 1, 2, [11, 23]),
                attack(1, 11, 14, [23, 27]),
                Attack { season: 2, from: 23, until: 26, ticks: 4, next: Some([27, 27]) },
            ]
        );
        // A run that ends before the next season still meets the rest, and its days are no fault; those of an attack
        // that is over are, and so are those of one that does not come again.
        let short = Calendar::of(&planted, 5, |_| None).expect("a calendar");
        let path = Path::root();
        assert_eq!(yearly.attacks_on(&Host { calendar: Some(&short), until: 5, ..host }).len(), 1);
        assert_eq!(yearly.fault_of_days(&short, &path), None);
        assert!(Pest { yearly: false, ..yearly.clone() }.fault_of_days(&short, &path).is_some());
        let over = Terms { planted: Date::parse("2020-08-18").expect("a day"), ..planted };
        let over = Calendar::of(&over, 5, |_| None).expect("a calendar");
        assert!(yearly.fault_of_days(&over, &path).is_some());
        let exposed = exposure(std::slice::from_ref(&yearly), &host).expect("an exposure");
        let at_ages = Pest { ages: Some([5, 8]), dates: None, yearly: false, every: Some(12), ..yearly.clone() };
        let by_age = exposure(&[at_ages], &host).expect("an exposure");
        assert_eq!((exposed.leaf.end(1, 0), exposed.leaf.end(9, 0)), (by_age.leaf.end(1, 0), by_age.leaf.end(9, 0)));
        assert!((exposed.growth_at(17) - 0.8).abs() < 1e-12 && exposed.growth_at(16) == 1.0);
    }
}
