//! The faults of the keys of an event that the schema cannot state: keys that belong to other operations, and keys that
//! are missing.
//!
//! Absent: the faults of times (`times`), and those of conditions, which the reading of a condition finds
//! (`phytomer_law::condition`).

use super::Event;
use phytomer_law::fault::{Fault, Path};
use phytomer_models::shapes::length_of;
use phytomer_sim::shape::HalfSpace;

impl Event {
    pub(super) fn check_keys(&self, path: &Path, faults: &mut Vec<Fault>) {
        let (keys, word) = (self.operation.keys(), self.operation.word());
        let stated = self.stated();
        for key in stated.iter().filter(|key| keys.all().all(|known| known != **key)) {
            let known = keys.all().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
            let problem = format!("`{key}` has no effect on the operation `{word}`");
            let expected = if known.is_empty() {
                "no keys beside those of its times".to_owned()
            } else {
                format!("one of {known}")
            };
            faults.push(Fault::new(&path.key(key), problem, expected));
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
        for (number, plane) in self.planes.iter().enumerate().filter(|(_, plane)| HalfSpace::is_too_short(plane.normal))
        {
            let problem =
                format!("the normal of the plane through {:?} has {}", plane.point_m, length_of(plane.normal));
            let path = path.key("planes").index(number).key("normal");
            faults.push(Fault::new(&path, problem, "a direction, such as [0, 1, 0]"));
        }
    }
}
