//! The faults of a stand that its schema cannot state.

use super::layout::{Lattice, Layout, Place};
use super::{Borders, MOST_PLANTS, Mixed, Stand};
use crate::scenario::Scenario;
use crate::scenario::member::too_late;
use phytomer_law::fault::{Fault, Path};

impl Scenario {
    /// Adds the faults of the stand.
    pub(in crate::scenario) fn check_stand(&self, faults: &mut Vec<Fault>) {
        let Some(stand) = &self.stand else { return };
        let path = Path::root().key("stand");
        if !self.member.is_empty() {
            let problem = "`stand` and `member` both say which plants a plot has";
            faults.push(Fault::new(&path, problem, "one of them"));
        }
        if self.planting.has_distances() {
            let problem = "`stand` and `planting` both say how far the plants stand apart";
            faults.push(Fault::new(&path, problem, "the distances in the layout of the stand alone"));
        }
        if let Some(spacing) = self.spacing_m
            && stand.ground().sides().iter().any(|side| *side > spacing)
            && self.plots() > 1
        {
            let [east, north] = stand.ground().sides();
            let problem = format!("plots {spacing} m apart overlap: the ground of the stand is {east} × {north} m");
            let expected = format!("at least {} m, or no `spacing_m`", east.max(north));
            faults.push(Fault::new(&Path::root().key("spacing_m"), problem, expected));
        }
        stand.check(&path, faults);
        self.check_sowing(stand, &path, faults);
    }

    /// What is sown, or emerges, when the run has ended.
    fn check_sowing(&self, stand: &Stand, path: &Path, faults: &mut Vec<Fault>) {
        let until = self.ages.until;
        for (number, part) in stand.plant.iter().enumerate().filter(|(_, part)| part.sown >= until) {
            faults.push(too_late(&path.key("plant").index(number).key("sown"), "the species is", part.sown, until));
        }
        if let Layout::Places(places) = &stand.layout {
            let late = |place: &Place| place.sown.filter(|sown| *sown >= until);
            if let Some((number, sown)) = places.at.iter().enumerate().find_map(|(n, place)| Some((n, late(place)?))) {
                let path = path.key("layout").key("at").index(number).key("sown");
                faults.push(too_late(&path, "the plant is", sown, until));
            }
        }
        let latest = stand.emergence.len().saturating_sub(1) as u32;
        if latest >= until {
            let problem = format!("plants emerge up to {latest} ticks after sowing, and the run ends at tick {until}");
            let expected = format!("at most {until} shares, or a longer run");
            faults.push(Fault::new(&path.key("emergence"), problem, expected));
        }
    }
}

impl Stand {
    fn check(&self, path: &Path, faults: &mut Vec<Fault>) {
        let layout = path.key("layout");
        if let Layout::Rows(lattice) | Layout::Triangular(lattice) = &self.layout {
            check_extent(lattice, &layout, faults);
        }
        if let Layout::Places(places) = &self.layout {
            if places.at.is_empty() && places.file.is_none() {
                faults.push(Fault::new(&layout, "the stand has no places", "`file` or `at` with one place at least"));
            }
            if let Some(sides) = places.ground_m.filter(|ground| ground[2] <= 0.0 || ground[3] <= 0.0) {
                let problem = format!("the ground is {} × {} m", sides[2], sides[3]);
                faults.push(Fault::new(&layout.key("ground_m"), problem, "sides above 0"));
            }
        }
        let plants = self.plants();
        if plants > MOST_PLANTS {
            let problem = format!("the stand has {plants} plants");
            faults.push(Fault::new(&layout, problem, format!("at most {MOST_PLANTS} in a plot")));
            return;
        }
        self.check_fan(&layout, faults);
        self.check_borders(path, faults);
        self.check_guards(path, faults);
        if !self.emergence.is_empty() && self.emergence.iter().sum::<f64>() <= 0.0 {
            let problem = "no plant emerges: each share is 0";
            faults.push(Fault::new(&path.key("emergence"), problem, "one share above 0 at least"));
        }
        let parts = self.plant.iter().enumerate().filter(|_| self.mixed != Mixed::Chance);
        for (number, part) in parts.filter(|(_, part)| part.share.fract() != 0.0) {
            let problem = format!("a share of {} is no number of places", part.share);
            let path = path.key("plant").index(number).key("share");
            faults.push(Fault::new(&path, problem, "a whole number, or `mixed = \"chance\"`"));
        }
    }

    fn check_fan(&self, path: &Path, faults: &mut Vec<Fault>) {
        let Layout::Nelder(fan) = &self.layout else { return };
        if let Some(angle) = fan.spoke_angle_deg.filter(|angle| angle * f64::from(fan.spokes) > 360.0 + 1e-9) {
            let problem = format!("{} spokes {angle} degrees apart go beyond a circle", fan.spokes);
            let expected = format!("at most {} degrees", 360.0 / f64::from(fan.spokes));
            faults.push(Fault::new(&path.key("spoke_angle_deg"), problem, expected));
        }
        let outermost = fan.innermost_m * phytomer_sim::math::pow(fan.ratio, f64::from(fan.arcs - 1));
        if outermost.is_nan() || outermost > 100_000.0 {
            let problem = format!("the outermost arc has a radius of {outermost} m");
            faults.push(Fault::new(&path.key("arcs"), problem, "fewer arcs: at most 100,000 m"));
        }
    }

    /// A stand that is repeated must fit to itself on all sides.
    fn check_borders(&self, path: &Path, faults: &mut Vec<Fault>) {
        if self.borders != Borders::Periodic {
            return;
        }
        let mut fault = |problem: String, expected: &str| {
            faults.push(Fault::new(&path.key("borders"), problem, expected));
        };
        match &self.layout {
            Layout::Nelder(_) => fault("a fan cannot be repeated without end".to_owned(), "open borders"),
            Layout::Places(places) if places.ground_m.is_none() => {
                fault("the ground of the places is not known".to_owned(), "`ground_m` in the layout");
            }
            Layout::Triangular(_) if self.layout.rows().is_some_and(|rows| rows % 2 == 1) => {
                fault("an odd number of rows in turn does not fit to itself".to_owned(), "an even number of rows");
            }
            layout if layout.direction() % 90.0 != 0.0 => {
                let problem = format!("rows towards {} degrees do not fit to themselves", layout.direction());
                fault(problem, "rows towards 0, 90, 180 or 270 degrees");
            }
            _ => {}
        }
    }

    fn check_guards(&self, path: &Path, faults: &mut Vec<Fault>) {
        if self.guard_rows == 0 {
            return;
        }
        let path = path.key("guard_rows");
        if let Layout::Random(_) | Layout::Places(_) = self.layout {
            let problem = "the layout has no rows";
            faults.push(Fault::new(&path, problem, "places with `guard`, or a layout with rows"));
            return;
        }
        if (0..self.plants()).all(|number| self.layout.is_outer(number, self.guard_rows)) {
            let problem = format!("with {} guard rows all plants are guards, and `summary` is empty", self.guard_rows);
            faults.push(Fault::new(&path, problem, "fewer guard rows, or a larger stand"));
        }
    }
}

fn check_extent(lattice: &Lattice, path: &Path, faults: &mut Vec<Fault>) {
    let counted = [("rows", lattice.rows), ("plants", lattice.plants)];
    match lattice.size_m {
        Some(_) => {
            for (key, _) in counted.iter().filter(|(_, count)| count.is_some()) {
                let problem = format!("`{key}` and `size_m` both say how large the stand is");
                faults.push(Fault::new(&path.key(key), problem, "one of them"));
            }
        }
        None => {
            if let Some((key, _)) = counted.iter().find(|(_, count)| count.is_none()) {
                let problem = format!("the size of the stand is not known: `{key}` is missing");
                faults.push(Fault::new(path, problem, "`rows` and `plants`, or `size_m`"));
            }
        }
    }
}

impl Layout {
    fn rows(&self) -> Option<u32> {
        self.cells().map(|cells| cells.rows)
    }

    fn direction(&self) -> f64 {
        self.cells().map_or(0.0, |cells| cells.direction)
    }
}
