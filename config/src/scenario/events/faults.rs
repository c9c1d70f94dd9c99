//! The faults of events that the schema cannot state: keys that belong to other operations, and times that never come.
//!
//! Absent: the faults of conditions, which the reading of a condition finds (`phytomer_law::condition`).

use super::Event;
use phytomer_law::fault::{Fault, Path};

impl Event {
    pub(super) fn check_keys(&self, path: &Path, faults: &mut Vec<Fault>) {
        let (keys, word) = (self.operation.keys(), self.operation.word());
        let stated = self.stated();
        for key in stated.iter().filter(|key| keys.all().all(|known| known != **key)) {
            let known = keys.all().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
            let problem = format!("`{key}` has no effect on the operation `{word}`");
            faults.push(Fault::new(&path.key(key), problem, format!("one of {known}")));
        }
        let of = |needed: &[&str]| stated.iter().copied().filter(|key| needed.contains(key)).collect::<Vec<&str>>();
        let list = |needed: &[&str]| needed.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(" or ");
        match of(keys.one)[..] {
            [] if !keys.one.is_empty() => {
                let what = if self.operation.trains() { "where the wood is held" } else { "what it leaves" };
                let problem = format!("the operation `{word}` does not say {what}");
                faults.push(Fault::new(&path.key("operation"), problem, list(keys.one)));
            }
            [first, second, ..] => {
                let problem = format!("`{first}` and `{second}` say the same twice");
                faults.push(Fault::new(&path.key(second), problem, format!("{}, one of them", list(keys.one))));
            }
            _ => {}
        }
        if of(keys.some).is_empty() && !keys.some.is_empty() {
            let problem = format!("the operation `{word}` does not say how the wood stands from then on");
            faults.push(Fault::new(&path.key("operation"), problem, format!("{}, or both", list(keys.some))));
        }
        if self.first.is_some() && self.share.is_none() && self.at_most.is_none() {
            let problem = "`first` ranks what is taken, and all of it is taken";
            faults.push(Fault::new(&path.key("first"), problem, "`share` or `at_most` beside it"));
        }
        if let (Some(_), Some(_)) = (self.ripe_share, self.harvest_cut_height) {
            let problem = "a harvest at a height takes fruits whether they are ripe or not";
            faults.push(Fault::new(&path.key("ripe_share"), problem, "`ripe_share` or `harvest_cut_height`"));
        }
        for (number, plane) in self.planes.iter().enumerate().filter(|(_, plane)| plane.normal == [0.0; 3]) {
            let problem = format!("the normal of the plane through {:?} has the length 0", plane.point_m);
            let path = path.key("planes").index(number).key("normal");
            faults.push(Fault::new(&path, problem, "a direction, such as [0, 1, 0]"));
        }
    }

    pub(super) fn check_times(&self, until: u32, path: &Path, faults: &mut Vec<Fault>) {
        let first = self.tick.or(self.age);
        if let (Some(_), Some(_)) = (self.tick, self.age) {
            let problem = "the event is stated by a tick of the plot and by an age of the plant";
            faults.push(Fault::new(&path.key("age"), problem, "`tick` or `age`"));
        }
        if first.is_none() && self.when.is_none() {
            faults.push(Fault::new(path, "the event has no time", "`tick`, `age` or `when`"));
        }
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
            Some(_) if self.every.is_none() && self.when.is_none() => {
                let problem = "`until` ends what is done once";
                faults.push(Fault::new(&path.key("until"), problem, "`every` beside it, the ticks between two times"));
            }
            _ => {}
        }
    }
}

fn article(key: &str) -> &'static str {
    if key == "age" { "an age" } else { "a tick" }
}
