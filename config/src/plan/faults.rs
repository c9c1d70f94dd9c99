//! What contradicts itself in a plan though each of its values is sound.
//!
//! Zones must not cross themselves, names of zones, spots and candidates must tell them apart, no two trees may have
//! one place, and none may stand inside a building. Absent: what no arrangement can satisfy, which solving it tells.

use phytomer_law::fault::{Fault, Path};
use phytomer_sim::math::sincos;

use super::polygon::{Flaw, flaw};
use super::{Arrange, Building, Plan, Zone};

/// Trees nearer than this stand in one place, metres.
const ONE_PLACE_M: f64 = 0.01;

impl Plan {
    pub(super) fn faults(&self) -> Vec<Fault> {
        let root = Path::root();
        let mut faults = Vec::new();
        for (k, zone) in self.zone.iter().enumerate() {
            of_zone(zone, &root.key("zone").index(k), &mut faults);
        }
        names(self.zone.iter().map(|zone| zone.name.as_str()), "zone", &root.key("zone"), &mut faults);
        for (k, building) in self.building.iter().enumerate() {
            if building.from_m >= building.size_m[2] {
                let (from, top) = (building.from_m, building.size_m[2]);
                let problem = format!("the underside is at {from} m and the top at {top} m");
                faults.push(Fault::new(
                    &root.key("building").index(k).key("from_m"),
                    problem,
                    "an underside below the top",
                ));
            }
        }
        if let Some(arrange) = &self.arrange {
            let path = root.key("arrange");
            names(arrange.spot.iter().map(|spot| spot.name.as_str()), "spot", &path.key("spot"), &mut faults);
            let candidates = arrange.candidate.iter().map(|candidate| candidate.name.as_str());
            names(candidates, "candidate", &path.key("candidate"), &mut faults);
        }
        self.places(&mut faults);
        faults
    }

    /// Trees and spots, each in a place of its own and none inside a building.
    fn places(&self, faults: &mut Vec<Fault>) {
        let root = Path::root();
        let trees = self.tree.iter().enumerate().map(|(k, tree)| (tree.place_m, "tree", root.key("tree").index(k)));
        let spots = self.arrange.iter().flat_map(|Arrange { spot, .. }| spot.iter().enumerate());
        let spots = spots.map(|(k, spot)| (spot.place_m, "spot", root.key("arrange").key("spot").index(k)));
        let mut before: Vec<([f64; 2], &str)> = Vec::new();
        for (place, kind, path) in trees.chain(spots) {
            let path = path.key("place_m");
            let near = |other: &[f64; 2]| (0..2).all(|k| (other[k] - place[k]).abs() < ONE_PLACE_M);
            let [x, y] = place;
            if let Some((_, other)) = before.iter().find(|(other, _)| near(other)) {
                let problem = format!("a {other} has this place already: {x}, {y}");
                faults.push(Fault::new(&path, problem, "a place of its own for each tree and spot"));
            }
            if let Some(number) = self.building.iter().position(|building| holds(building, place)) {
                let problem = format!("the {kind} at {x}, {y} stands inside building {}", number + 1);
                faults.push(Fault::new(&path, problem, "a place outside of every building that reaches the ground"));
            }
            before.push((place, kind));
        }
    }
}

fn of_zone(zone: &Zone, path: &Path, faults: &mut Vec<Fault>) {
    let corners = path.key("corners_m");
    let (problem, expected) = match flaw(&zone.corners_m) {
        None => (None, ""),
        Some(Flaw::Same(first, second)) => {
            (Some(format!("the corners {} and {} are the same place", first + 1, second + 1)), "each corner once")
        }
        Some(Flaw::Cross(first, second)) => {
            let edge = |k: usize| format!("{} to {}", k + 1, (k + 1) % zone.corners_m.len() + 1);
            let problem =
                format!("the edges from corner {} and from corner {} cross or touch", edge(first), edge(second));
            (Some(problem), "an outline that does not cross itself, its corners in their order")
        }
        Some(Flaw::Flat) => {
            (Some("the outline has next to no area".to_owned()), "three corners or more around some ground")
        }
    };
    faults.extend(problem.map(|problem| Fault::new(&corners, problem, expected)));
    for (k, allowed) in zone.allow.iter().enumerate() {
        let path = path.key("allow").index(k);
        match (allowed.least_h, allowed.most_h) {
            (None, None) => faults.push(Fault::new(&path, "neither bound is given", "`least_h`, `most_h` or both")),
            (Some(least), Some(most)) if least > most => {
                let problem = format!("at least {least} hours and at most {most}");
                faults.push(Fault::new(&path.key("least_h"), problem, "a least that is not above the most"));
            }
            _ => {}
        }
    }
}

/// Each name once.
fn names<'a>(of: impl Iterator<Item = &'a str>, kind: &str, path: &Path, faults: &mut Vec<Fault>) {
    let mut known: Vec<&str> = Vec::new();
    for (k, name) in of.enumerate() {
        if known.contains(&name) {
            let problem = format!("a second {kind} has the name `{name}`");
            faults.push(Fault::new(&path.index(k).key("name"), problem, "a name of its own"));
        }
        known.push(name);
    }
}

/// Whether a place lies inside a building that reaches the ground.
fn holds(building: &Building, place: [f64; 2]) -> bool {
    let (sin, cos) = sincos(building.turn_deg.to_radians());
    let [x, y] = [0, 1].map(|k| place[k] - building.place_m[k]);
    // The depth points to the azimuth: east by its sine and north by its cosine.
    let (across, along) = (x * cos - y * sin, x * sin + y * cos);
    building.from_m == 0.0 && across.abs() < building.size_m[0] / 2.0 && along.abs() < building.size_m[1] / 2.0
}
