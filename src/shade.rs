//! Hours of shade on the zones of a plan, from its file to its tables and drawings.
//!
//! The trees are grown (`grown`), the sun is followed over them (`phytomer_shade`), and with an `[arrange]` the best
//! candidates for its spots are chosen by the sum of what each adds and checked by their shadows together (`arranged`).
//! Files are written beside their names and renamed (`written`). Absent: the file of the plan
//! (`phytomer_config::plan`).

mod arranged;
mod grown;
mod written;

pub use arranged::{Arranged, Check, arrange};
pub use written::{Written, write};

use crate::run::RunError;
use grown::Grown;
use phytomer_config::plan::{Plan, ResolvedPlan};
use phytomer_models::fault::{Fault, Path};
use phytomer_outputs::FileError;
use phytomer_shade::{Body, Caster, Cause, Polygon, Samples, Shade, Sky, Stopped, Watch, shade, table};

/// The months, and the place of the year after them.
const MONTHS: [&str; 13] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
    "the mean of the year",
];

/// The name of a month from 0; 12 is the year.
pub fn month_in_words(month: usize) -> &'static str {
    MONTHS[month.min(12)]
}

/// Why there are no hours.
#[derive(Debug, thiserror::Error)]
pub enum ShadeError {
    /// The plan is wrong; paths are those of its file.
    #[error("the plan is wrong")]
    Wrong(Vec<Fault>),
    /// A tree cannot be grown.
    #[error("{0} cannot be grown")]
    Tree(String, #[source] Box<RunError>),
    /// It was asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The solver gave up.
    #[error(transparent)]
    Unsolved(#[from] phytomer_shade::arrange::Unsolved),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file cannot be written to.
    #[error("cannot write {0}")]
    Write(String, #[source] std::io::Error),
    /// A table cannot be written.
    #[error(transparent)]
    Table(#[from] table::TableError),
    /// A drawing cannot be made.
    #[error("the plan cannot be drawn")]
    Drawing(#[source] std::io::Error),
}

/// A plan with its trees grown and its zones in points.
pub struct Ground<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The points of its zones.
    pub samples: Samples,
    sky: Sky,
    buildings: Vec<Body>,
    trees: Grown,
}

impl<'a> Ground<'a> {
    /// Grows the trees of a plan; `say` hears of each before it is grown.
    ///
    /// # Errors
    /// A grid of too many points, and a tree that cannot be grown or drawn.
    pub fn of(resolved: &'a ResolvedPlan, say: &mut dyn FnMut(&str), watch: &Watch) -> Result<Self, ShadeError> {
        let plan = &resolved.plan;
        let zones: Vec<Polygon> = plan.zone.iter().map(|zone| Polygon { corners: zone.corners_m.clone() }).collect();
        let samples = Samples::of(&zones, plan.grid_m).map_err(|many| {
            let expected = "points farther apart, or smaller zones";
            ShadeError::Wrong(vec![Fault::new(&Path::root().key("grid_m"), many.to_string(), expected)])
        })?;
        let box_of = |k: usize| {
            let [width, depth, top] = plan.building[k].size_m;
            Body::cuboid([width, depth], [plan.building[k].from_m, top])
        };
        let buildings = (0..plan.building.len()).map(box_of).collect();
        let trees = Grown::of(resolved, say, watch)?;
        Ok(Self { plan, samples, sky: sky(plan), buildings, trees })
    }

    /// The hours of the plan as it stands, with some candidates besides, each at a spot; and what each of the trials
    /// adds by itself.
    ///
    /// # Errors
    /// Where it was stopped.
    pub fn hours(&self, planted: &[Planted], trials: &[Planted], watch: &Watch) -> Result<Shade, Stopped> {
        let mut casters = self.standing();
        casters.extend(planted.iter().filter_map(|planted| self.candidate(*planted)));
        let trials: Vec<Caster<'_>> = trials.iter().filter_map(|trial| self.candidate(*trial)).collect();
        shade(&self.sky, &self.samples, &casters, &trials, watch)
    }

    /// How high a candidate is, metres.
    pub fn height_m(&self, candidate: usize) -> f64 {
        self.trees.body(self.plan.tree.len() + candidate).height_m()
    }

    /// Buildings and trees.
    fn standing(&self) -> Vec<Caster<'_>> {
        let buildings = self.plan.building.iter().zip(&self.buildings).map(|(building, body)| Caster {
            body,
            place: building.place_m,
            turn: clockwise(building.turn_deg),
            leafless: [false; 12],
            cause: Cause::Building,
        });
        let trees = self.plan.tree.iter().enumerate().map(|(number, tree)| Caster {
            body: self.trees.body(number),
            place: tree.place_m,
            turn: clockwise(tree.turn_deg),
            leafless: leafless(&tree.leafless_months),
            cause: Cause::Plant,
        });
        buildings.chain(trees).collect()
    }

    /// A candidate at a spot.
    fn candidate(&self, Planted { spot, candidate }: Planted) -> Option<Caster<'_>> {
        let arrange = self.plan.arrange.as_ref()?;
        Some(Caster {
            body: self.trees.body(self.plan.tree.len() + candidate),
            place: arrange.spot.get(spot)?.place_m,
            turn: 0.0,
            leafless: leafless(&arrange.candidate.get(candidate)?.leafless_months),
            cause: Cause::Plant,
        })
    }
}

/// A candidate at a spot, by their numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Planted {
    /// The spot.
    pub spot: usize,
    /// The candidate.
    pub candidate: usize,
}

fn sky(plan: &Plan) -> Sky {
    Sky {
        latitude: plan.latitude_deg.to_radians(),
        longitude: plan.longitude_deg.to_radians(),
        year: plan.sun.year,
        days_a_month: plan.sun.days_a_month,
        step_h: plan.sun.step_min / 60.0,
        lowest: plan.sun.lowest_deg.to_radians(),
    }
}

/// A turn from the north to the east, in radians from the east to the north.
fn clockwise(degrees: f64) -> f64 {
    -degrees.to_radians()
}

/// The months from January without leaves.
fn leafless(months: &[u32]) -> [bool; 12] {
    std::array::from_fn(|month| months.contains(&(month as u32 + 1)))
}
