//! The times of an event: a tick, an age, a day of the calendar, or the first time that a condition holds.
//!
//! A day is done at the tick that spans it. Absent: the calendar itself, and what `when` asks.

use super::super::days;
use super::{Event, Scenario, Work};
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::management::Start;
use phytomer_sim::site::calendar::Calendar;
use phytomer_sim::site::date::Date;

impl Event {
    /// The day that is stated, with its key.
    pub(super) fn stated_day(&self) -> Option<(&'static str, &str)> {
        let by_name = self.harvest_operations_date.as_deref().map(|day| ("harvest_operations_date", day));
        self.date.as_deref().map(|day| ("date", day)).or(by_name)
    }

    /// When it begins; `None` where its day does not lie in the calendar. Without a calendar the first age of a plant
    /// stands for the day.
    pub(super) fn start(&self, calendar: Option<&Calendar>) -> Option<Start> {
        match (self.tick, self.age, self.stated_day(), calendar) {
            (Some(tick), ..) => Some(Start::Tick(tick)),
            (None, None, Some((_, day)), Some(calendar)) => {
                let ticks = days::ticks(Date::parse(day)?, self.yearly, calendar);
                let first = *ticks.first()?;
                Some(if self.yearly { Start::Each(ticks.into()) } else { Start::Tick(first) })
            }
            (None, age, ..) => Some(Start::Age(age.unwrap_or(1))),
        }
    }

    /// The youngest age at which it can be done to a plant that is sown up to the tick `last_sown`.
    pub(super) fn first_age(&self, calendar: Option<&Calendar>, last_sown: u32) -> Option<u32> {
        Some(match self.start(calendar)? {
            Start::Tick(tick) => tick.saturating_sub(last_sown),
            Start::Each(ticks) => ticks.first()?.saturating_sub(last_sown),
            Start::Age(age) => age,
        })
    }

    /// The fault of a day that does not lie in the run.
    pub(super) fn fault_of_day(&self, calendar: &Calendar, path: &Path) -> Option<Fault> {
        let (key, day) = self.stated_day()?;
        days::fault_of(Date::parse(day)?, self.yearly, calendar, &path.key(key))
    }

    pub(super) fn check_times(&self, of: &Scenario, path: &Path, faults: &mut Vec<Fault>) {
        self.check_starts(of, path, faults);
        self.check_repeats(path, faults);
        self.check_times_of_plot(path, faults);
        let until = of.ages.until;
        let first = self.tick.or(self.age);
        let key = if self.tick.is_some() { "tick" } else { "age" };
        if let Some(first) = first.filter(|first| *first > until) {
            let problem = format!("the event is of {key} {first}, and the run ends at tick {until}");
            faults.push(Fault::new(&path.key(key), problem, format!("{} in [1, {until}]", article(key))));
        }
        match self.until {
            Some(last) if first.is_some_and(|first| last < first) => {
                let problem = format!("the event ends at {last}, before it begins at {}", first.unwrap_or(1));
                faults.push(Fault::new(&path.key("until"), problem, format!("at least {}", first.unwrap_or(1))));
            }
            Some(_) if self.every.is_none() && self.when.is_none() && !self.yearly => {
                let problem = "`until` ends what is done once";
                faults.push(Fault::new(&path.key("until"), problem, "`every` beside it, the ticks between two times"));
            }
            _ => {}
        }
    }

    /// An event has one start.
    fn check_starts(&self, of: &Scenario, path: &Path, faults: &mut Vec<Fault>) {
        let day = |key: &'static str, stated: &Option<String>| stated.is_some().then_some((key, "by a day"));
        let starts = [
            self.tick.map(|_| ("tick", "by a tick of the plot")),
            self.age.map(|_| ("age", "by an age of the plant")),
            day("date", &self.date),
            day("harvest_operations_date", &self.harvest_operations_date),
        ];
        let starts: Vec<(&str, &str)> = starts.into_iter().flatten().collect();
        match starts[..] {
            [(first, one), (second, other), ..] => {
                let problem = format!("the event is stated {one} and {other}");
                faults.push(Fault::new(&path.key(second), problem, format!("`{first}` or `{second}`")));
            }
            [] if self.when.is_none() => {
                faults.push(Fault::new(path, "the event has no time", "`tick`, `age`, `date` or `when`"));
            }
            _ => {}
        }
        for (key, day) in [("date", &self.date), ("harvest_operations_date", &self.harvest_operations_date)] {
            let Some(day) = day else { continue };
            faults.extend(days::fault_of_text(day, of.calendar.is_some(), &path.key(key)));
        }
    }

    /// Replanting is work on the plot, not on a plant that has an age.
    fn check_times_of_plot(&self, path: &Path, faults: &mut Vec<Fault>) {
        let of_plants = [("age", self.age.is_some()), ("when", self.when.is_some()), ("plants", self.plants.is_some())];
        if self.operation != Work::Replanting {
            return;
        }
        for (key, _) in of_plants.into_iter().filter(|(_, stated)| *stated) {
            let problem = format!("`{key}` is asked of a plant, and `replanting` looks at the places of the plot");
            faults.push(Fault::new(&path.key(key), problem, "`tick` or `date`, with `every` or `yearly`"));
        }
    }

    /// What is done each year is done on a day.
    fn check_repeats(&self, path: &Path, faults: &mut Vec<Fault>) {
        let problem = match (self.yearly, self.stated_day(), self.every, &self.when) {
            (false, ..) => return,
            (_, None, ..) => "`yearly` repeats a day of the year, and no day is given",
            (_, _, Some(_), _) => "`yearly` and `every` both say when it is done again",
            (.., Some(_)) => "a condition is asked from a day on, and not from that day of each year",
            _ => return,
        };
        faults.push(Fault::new(&path.key("yearly"), problem, "`yearly` beside `date`, without `every` and `when`"));
    }
}

fn article(key: &str) -> &'static str {
    if key == "age" { "an age" } else { "a tick" }
}
