//! External influences on the plants of a run: gravity, a steady wind, and shapes that kill buds or block their way.
//!
//! Gravity and wind act only on species whose wood bends. A plane that kills is the shorter way to state a half space.
//! The shapes that have names here also serve the events of the scenario. Absent: light (`light`) and soil.

use phytomer_law::fault::{Fault, Path};
use phytomer_models::buds::params::ColourText;
use phytomer_models::shapes::{MOST_PARTS, Named, ShapeOrName, Shapes, length_of, one};
use phytomer_sim::shape::{HalfSpace, Intersection, Shape};
use phytomer_sim::site::stems::Whose;
use phytomer_sim::site::{Manner, Obstacle as SimObstacle, STANDARD_GRAVITY, Side, Wind as SimWind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The site of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Site {
    /// The acceleration of gravity, m/s²; 0 leaves every plant in its pose at rest. 9.80665 if not given.
    #[schemars(range(min = 0, max = 100))]
    pub gravity_m_s2: f64,
    /// A steady wind; calm if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wind: Option<Wind>,
    /// The latitude, degrees, north positive. That of the weather file if not given; without either the length of a day
    /// is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -90, max = 90))]
    pub latitude_deg: Option<f64>,
    /// Whether shoots meet the ground, the plane z = 0: no tip of a shoot then grows below it. They do not if not
    /// given.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub ground: bool,
    /// Whose stems shoots meet, as `"neighbours"` or `"all"`. None if not given: shoots then grow through stems.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stems: Option<Stems>,
    /// Planes that kill every bud that reaches them, as `[[site.plane]]`: a roof, a wall, a mown height. None if not
    /// given. Each plot has these planes, placed relative to the plot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub plane: Vec<Plane>,
    /// Shapes by their names, as `[site.shape.NAME]`, for obstacles and events. None if not given.
    #[serde(skip_serializing_if = "Shapes::is_empty")]
    pub shape: Shapes,
    /// Shapes that kill buds or block their way, as `[[site.obstacle]]`: a house, a wall, or a form that is clipped all
    /// the time. None if not given. Each plot has these obstacles, placed relative to the plot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub obstacle: Vec<Obstacle>,
}

/// Whose stems shoots meet. The buds that meet one answer as their species states in `[contact]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stems {
    /// Those of the other plants of the plot.
    Neighbours,
    /// Those of all plants of the plot, and so those of other axes of the same plant too.
    All,
}

/// A shape that kills buds or blocks their way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// The shape, metres from the place of the plot: a table, or the name of a shape of the site.
    pub shape: ShapeOrName,
    /// Where buds die; inside if not given.
    #[serde(default, skip_serializing_if = "Kills::is_inside")]
    pub kills: Kills,
    /// Instead of `kills`: where shoots do not enter. The buds that meet it answer as their species states in
    /// `[contact]`; they turn along it where it states nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blocks: Option<Kills>,
    /// Whether climbers hold to an obstacle that blocks; they do if not given. Glass is a surface to which none holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holds: Option<bool>,
    /// Whether it stops light where the scenario has `[light]`; it does if not given. Glass does not.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub opaque: bool,
    /// Whether pictures and meshes of a plot show it. If not given they do where buds die or shoots are blocked inside
    /// and the shape has an end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn: Option<bool>,
    /// Its colour there; that of plaster if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<ColourText>,
}

/// An obstacle that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnObstacle {
    /// Its shape, metres from the place of the plot.
    pub shape: Arc<Shape>,
    /// Its colour, where one is stated: red, green and blue, sRGB.
    pub colour: Option<[u8; 3]>,
}

/// A side of an obstacle: where it kills buds, or where shoots do not enter.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kills {
    /// Within the shape and on its surface.
    #[default]
    Inside,
    /// Outside the shape.
    Outside,
}

impl Kills {
    fn is_inside(&self) -> bool {
        *self == Self::Inside
    }
}

/// A plane that kills the buds on it and beyond it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// A point on the plane, metres from the place of the plot.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub point_m: [f64; 3],
    /// The normal of the plane, on the side where no bud lives; any length but 0.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub normal: [f64; 3],
}

/// A steady, horizontal wind, equal at every height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wind {
    /// The speed of the wind, m/s.
    #[schemars(range(min = 0, max = 100))]
    pub speed_m_s: f64,
    /// The direction towards which it blows, degrees from the X axis (east) to the Y axis (north).
    #[serde(default)]
    #[schemars(range(min = -360, max = 360))]
    pub towards_deg: f64,
}

fn yes() -> bool {
    true
}

fn is_yes(opaque: &bool) -> bool {
    *opaque
}

impl Default for Site {
    fn default() -> Self {
        Self {
            gravity_m_s2: STANDARD_GRAVITY,
            wind: None,
            latitude_deg: None,
            ground: false,
            stems: None,
            plane: Vec::new(),
            shape: Shapes::new(),
            obstacle: Vec::new(),
        }
    }
}

impl Site {
    /// Whether the site is that of a scenario without `[site]`: open ground without wind, under gravity.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// The site of the plants of a plot at the origin. An obstacle that a fault was told of is left out.
    pub fn felt(&self) -> phytomer_sim::site::Site {
        let wind = self.wind.as_ref().map_or_else(SimWind::default, Wind::felt);
        let beyond = |plane: &Plane| SimObstacle {
            shape: Arc::new(Shape::HalfSpace(plane.side(-1.0))),
            kills: Side::Inside,
            manner: Manner::Kills,
        };
        let mut obstacles: Vec<SimObstacle> = self.plane.iter().map(beyond).collect();
        let none = &mut Vec::new();
        let named = self.shapes(none);
        obstacles.extend(self.obstacle.iter().filter_map(|obstacle| obstacle.felt(&named, &Path::root(), none)));
        let ground = self.ground.then_some(0.0);
        let whose_stems = match self.stems {
            None => Whose::Nobody,
            Some(Stems::Neighbours) => Whose::Neighbours,
            Some(Stems::All) => Whose::All,
        };
        let open = phytomer_sim::site::Site::default();
        phytomer_sim::site::Site { gravity: self.gravity_m_s2, wind, obstacles, ground, whose_stems, ..open }
    }

    /// The obstacles of a plot at the origin that pictures and meshes of it show. One that a fault was told of is left
    /// out.
    pub fn drawn(&self) -> Vec<DrawnObstacle> {
        let named = self.shapes(&mut Vec::new());
        let each =
            self.obstacle.iter().map(|obstacle| (obstacle, obstacle.felt(&named, &Path::root(), &mut Vec::new())));
        each.filter_map(|(obstacle, felt)| obstacle.drawn(felt?)).collect()
    }

    /// The obstacles of a plot at the origin that stop light: those that buds do not enter and that have an end. One
    /// that a fault was told of, or that is stated not to be opaque, is left out.
    pub(super) fn opaque(&self) -> Vec<Arc<Shape>> {
        let named = self.shapes(&mut Vec::new());
        let inside = self.obstacle.iter().filter(|obstacle| obstacle.opaque && obstacle.side().is_inside());
        let shapes = inside.filter_map(|obstacle| obstacle.felt(&named, &Path::root(), &mut Vec::new()));
        shapes.map(|felt| felt.shape).filter(|shape| has_end(shape)).collect()
    }

    /// The shapes that have names, and their faults.
    pub(super) fn shapes(&self, faults: &mut Vec<Fault>) -> Named {
        Named::of(&self.shape, &Path::root().key("site").key("shape"), faults)
    }

    /// Whether shoots meet anything: an obstacle that blocks, the ground, or stems.
    pub(crate) fn blocks_shoots(&self) -> bool {
        self.ground || self.stems.is_some() || self.obstacle.iter().any(|obstacle| obstacle.blocks.is_some())
    }

    /// Adds the faults of planes and obstacles that the schema cannot state.
    pub(super) fn check_obstacles(&self, named: &Named, path: &Path, faults: &mut Vec<Fault>) {
        let mut parts = 0;
        for (number, obstacle) in self.obstacle.iter().enumerate() {
            let path = path.key("obstacle").index(number);
            let felt = obstacle.felt(named, &path, faults);
            if matches!(obstacle.shape, ShapeOrName::Shape(_)) {
                parts += felt.as_ref().map_or(0, |felt| felt.shape.parts());
            }
            if parts > MOST_PARTS {
                let problem = format!("the obstacles up to this one have more than {MOST_PARTS} parts");
                faults.push(Fault::new(&path.key("shape"), problem, "fewer parts, or shapes by their names"));
                break;
            }
            obstacle.check_drawn(felt.as_ref(), &path, faults);
            obstacle.check_manner(&path, faults);
        }
        let is_short = |(_, plane): &(usize, &Plane)| HalfSpace::is_too_short(plane.normal);
        for (number, plane) in self.plane.iter().enumerate().filter(is_short) {
            let path = path.key("plane").index(number).key("normal");
            let problem =
                format!("the normal of the plane through {:?} has {}", plane.point_m, length_of(plane.normal));
            faults.push(Fault::new(&path, problem, "a direction, such as [0, 0, 1] for a roof"));
        }
    }
}

impl Plane {
    /// The half space from which the normal points out, if `way` is 1; that on the side of the normal, if it is −1.
    fn side(&self, way: f64) -> HalfSpace {
        HalfSpace { point: self.point_m, normal: self.normal.map(|x| way * x) }
    }

    /// What lies beyond none of some planes.
    pub(super) fn before_all(planes: &[Self]) -> Shape {
        let halves = planes.iter().map(|plane| Shape::HalfSpace(plane.side(1.0)));
        Shape::Intersection(Intersection::of(halves.collect()))
    }
}

impl Obstacle {
    /// The obstacle as `phytomer_sim` takes it; `None` where its shape has faults.
    fn felt(&self, named: &Named, path: &Path, faults: &mut Vec<Fault>) -> Option<SimObstacle> {
        let kills = match self.side() {
            Kills::Inside => Side::Inside,
            Kills::Outside => Side::Outside,
        };
        let manner = match self.blocks {
            Some(_) => Manner::Blocks { holds: self.holds.unwrap_or(true) },
            None => Manner::Kills,
        };
        Some(SimObstacle { shape: one(&self.shape, named, &path.key("shape"), faults)?, kills, manner })
    }

    /// The side on which it kills or blocks.
    fn side(&self) -> Kills {
        self.blocks.unwrap_or(self.kills)
    }

    /// Adds the faults of keys that have no effect beside others.
    fn check_manner(&self, path: &Path, faults: &mut Vec<Fault>) {
        if self.blocks.is_some() && !self.kills.is_inside() {
            let problem = "the obstacle kills on one side and blocks";
            faults.push(Fault::new(&path.key("kills"), problem, "`kills` or `blocks`, not both"));
        }
        if self.holds.is_some() && self.blocks.is_none() {
            let problem = "no shoot holds to an obstacle that kills";
            faults.push(Fault::new(&path.key("holds"), problem, "`blocks` beside it, or no `holds`"));
        }
    }

    /// Adds the faults of how it is to be drawn.
    fn check_drawn(&self, felt: Option<&SimObstacle>, path: &Path, faults: &mut Vec<Fault>) {
        if self.drawn == Some(true) && felt.is_some_and(|felt| !has_end(&felt.shape)) {
            let problem = "a shape without an end cannot be drawn";
            faults.push(Fault::new(&path.key("drawn"), problem, "`false`, or a shape that has an end on every side"));
        }
        if let Some(colour) = self.colour.as_ref().filter(|colour| colour.rgb().is_none()) {
            let problem = format!("`{}` is no colour", colour.0);
            let expected = "`#` and six hexadecimal digits, such as \"#7a8646\"";
            faults.push(Fault::new(&path.key("colour"), problem, expected));
        }
    }

    /// What is drawn of it, if anything is.
    fn drawn(&self, felt: SimObstacle) -> Option<DrawnObstacle> {
        let drawn = self.drawn.unwrap_or(self.side().is_inside()) && has_end(&felt.shape);
        let colour = self.colour.as_ref().and_then(ColourText::rgb);
        drawn.then_some(DrawnObstacle { shape: felt.shape, colour })
    }
}

/// Whether a shape reaches to infinity nowhere; that of nothing does not.
fn has_end(shape: &Shape) -> bool {
    let bounds = shape.bounds();
    (0..3).any(|k| bounds.low[k] > bounds.high[k]) || bounds.low.iter().chain(&bounds.high).all(|x| x.is_finite())
}

impl Wind {
    /// The wind as `phytomer_sim` takes it.
    pub fn felt(&self) -> SimWind {
        SimWind { speed: self.speed_m_s, towards: self.towards_deg.to_radians() }
    }
}
