//! The layouts of a stand: where its places are, which of them are outer ones, and the ground of each.
//!
//! Rows run north unless stated; the next row lies to the right of it, eastward. The ground of rows begins at the place
//! of the plot, its south-west corner, and a plant stands in the middle of its cell; a fan has its centre there.
//! Absent: what is drawn.

use super::{Ground, MOST_PLANTS};
use crate::scenario::planting::turned;
use phytomer_sim::math::{pow, sincos};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Where the plants of a stand stand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "form", rename_all = "snake_case")]
pub enum Layout {
    /// Rows: plants face one another across the rows. With equal distances a square grid.
    Rows(Lattice),
    /// Rows of which every second one is moved by half the distance in the row. Without `row_spacing_m` equilateral
    /// triangles, in which each plant has six neighbours at the same distance.
    Triangular(Lattice),
    /// Rows of hills with several plants in each, on a ring.
    Hills(Hills),
    /// Places drawn independently and evenly over the ground: a Poisson process of which the number of plants is known.
    Random(RandomPlaces),
    /// A fan of spokes and arcs, on which the ground of a plant grows from arc to arc (Nelder 1962, *Biometrics* 18,
    /// design Ia): many densities in one plot.
    Nelder(Nelder),
    /// The places of a file or of a list.
    Places(Places),
}

/// Rows of plants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lattice {
    /// The distance between the plants of a row, metres.
    #[schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0))]
    pub plant_spacing_m: f64,
    /// The distance between rows, metres; that in the row if not given, of triangles √3/2 times that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0))]
    pub row_spacing_m: Option<f64>,
    /// The number of rows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1_000_000))]
    pub rows: Option<u32>,
    /// The number of plants in a row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1_000_000))]
    pub plants: Option<u32>,
    /// Instead of `rows` and `plants`: the ground, metres across the rows and along them, which holds as many as have
    /// room, at least one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0.001, max = 100_000.0)))]
    pub size_m: Option<[f64; 2]>,
    /// The direction of the rows, degrees from north to east: 0, the default, is north–south, 90 east–west.
    #[serde(default, skip_serializing_if = "super::is_default")]
    #[schemars(range(min = 0, max = 360))]
    pub row_direction: f64,
}

/// Hills of several plants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hills {
    /// The distance between the hills of a row, metres.
    #[schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0))]
    pub hill_spacing_m: f64,
    /// The distance between rows, metres; that in the row if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0))]
    pub row_spacing_m: Option<f64>,
    /// The number of rows.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub rows: u32,
    /// The number of hills in a row.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub hills: u32,
    /// The number of plants in a hill.
    #[schemars(range(min = 1, max = 1000))]
    pub plants: u32,
    /// The radius of the ring on which the plants of a hill stand, the first one north of its centre, metres.
    #[schemars(range(min = 0, max = 1000.0))]
    pub radius_m: f64,
    /// The direction of the rows, degrees from north to east.
    #[serde(default, skip_serializing_if = "super::is_default")]
    #[schemars(range(min = 0, max = 360))]
    pub row_direction: f64,
}

/// Places drawn over the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RandomPlaces {
    /// The number of plants.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub plants: u32,
    /// The ground, metres eastward and northward.
    #[schemars(inner(range(min = 0.001, max = 100_000.0)))]
    pub size_m: [f64; 2],
}

/// A fan of spokes and arcs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Nelder {
    /// The number of spokes.
    #[schemars(range(min = 1, max = 100_000))]
    pub spokes: u32,
    /// The number of arcs.
    #[schemars(range(min = 1, max = 10_000))]
    pub arcs: u32,
    /// The radius of the innermost arc, metres.
    #[schemars(range(max = 10_000.0), extend("exclusiveMinimum" = 0))]
    pub innermost_m: f64,
    /// The radius of an arc in that of the arc within it, above 1.
    #[schemars(range(max = 10.0), extend("exclusiveMinimum" = 1))]
    pub ratio: f64,
    /// The angle from a spoke to the next, degrees clockwise from above, the first one north. If not given, the spokes
    /// fill a circle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 360.0), extend("exclusiveMinimum" = 0))]
    pub spoke_angle_deg: Option<f64>,
}

/// Places that are stated one by one.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Places {
    /// A CSV file in the folder of this file, with a line a plant: `x_m` and `y_m`, and where wanted `z_m`, `species`,
    /// `sown` and `guard` (`true` or `false`). Its places take the place of its name in `at` when it is read.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub file: Option<String>,
    /// The places.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 1_000_000))]
    pub at: Vec<Place>,
    /// The ground, as its south-west corner and its sides, metres: x, y, eastward, northward. The rectangle around the
    /// places if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = -100_000.0, max = 100_000.0)))]
    pub ground_m: Option<[f64; 4]>,
}

/// A place of a list.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Place {
    /// Metres eastward of the place of the plot.
    #[schemars(range(min = -1e5, max = 1e5))]
    pub x_m: f64,
    /// Metres northward.
    #[schemars(range(min = -1e5, max = 1e5))]
    pub y_m: f64,
    /// Metres upward.
    #[serde(skip_serializing_if = "super::is_default")]
    #[schemars(range(min = -1e5, max = 1e5))]
    pub z_m: f64,
    /// The species; of those of the stand in their turn if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub species: Option<String>,
    /// The tick of sowing; that of its species in the stand if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 65_534))]
    pub sown: Option<u32>,
    /// Whether the plant is a guard.
    #[serde(skip_serializing_if = "super::is_default")]
    pub guard: bool,
}

/// A place of a layout.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spot {
    /// Metres from the place of the plot.
    pub at: [f64; 3],
    /// The row and the rank in the row; of a fan the arc and the spoke. Plants of one hill share them.
    pub cell: [u32; 2],
    /// What the place itself states.
    pub species: Option<String>,
    /// What the place itself states.
    pub sown: Option<u32>,
    /// What the place itself states.
    pub guard: bool,
}

/// Rows of cells of one size, each with so many plants.
pub(super) struct Cells {
    pub(super) rows: u32,
    ranks: u32,
    each: u32,
    /// Metres across the rows, and along them.
    steps: [f64; 2],
    /// Whether every second row is moved by half a step.
    moved: bool,
    pub(super) direction: f64,
}

impl Lattice {
    fn cells(&self, triangular: bool) -> Cells {
        let along = self.plant_spacing_m;
        let across = self.row_spacing_m.unwrap_or(if triangular { along * 0.75_f64.sqrt() } else { along });
        let room = |axis: usize, step: f64| {
            // A hair more, so that 20 m hold ten steps of 2 m however these are rounded.
            self.size_m.map_or(1.0, |size| (size[axis] / step + 1e-9).floor()).clamp(1.0, f64::from(u32::MAX)) as u32
        };
        let rows = self.rows.unwrap_or_else(|| room(0, across));
        let ranks = self.plants.unwrap_or_else(|| room(1, along));
        Cells { rows, ranks, each: 1, steps: [across, along], moved: triangular, direction: self.row_direction }
    }
}

impl Hills {
    fn cells(&self) -> Cells {
        let steps = [self.row_spacing_m.unwrap_or(self.hill_spacing_m), self.hill_spacing_m];
        let Self { rows, hills, plants, row_direction, .. } = *self;
        Cells { rows, ranks: hills, each: plants, steps, moved: false, direction: row_direction }
    }
}

impl Cells {
    fn count(&self) -> u64 {
        u64::from(self.rows) * u64::from(self.ranks) * u64::from(self.each)
    }

    /// The row and the rank of a plant.
    fn of(&self, number: u64) -> [u32; 2] {
        let cell = number / u64::from(self.each);
        [cell / u64::from(self.ranks), cell % u64::from(self.ranks)].map(|place| place as u32)
    }

    /// The middle of a cell, metres across and along.
    fn middle(&self, [row, rank]: [u32; 2]) -> [f64; 2] {
        let moved = if self.moved && row % 2 == 1 { 0.5 } else { 0.0 };
        // The places of a moved row are a quarter of a step beyond the middle, those of the others as far before it.
        let quarter = if self.moved { 0.25 } else { 0.5 };
        [(f64::from(row) + 0.5) * self.steps[0], (f64::from(rank) + quarter + moved) * self.steps[1]]
    }

    /// From metres across and along to metres eastward and northward.
    fn turned(&self, [across, along]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = turned(self.direction);
        [across * cos + along * sin, along * cos - across * sin + 0.0]
    }

    fn sides(&self) -> [f64; 2] {
        [f64::from(self.rows) * self.steps[0], f64::from(self.ranks) * self.steps[1]]
    }

    fn ground(&self) -> Ground {
        let [across, along] = self.sides();
        let corners = [[0.0, 0.0], [across, 0.0], [0.0, along], [across, along]];
        Ground::around(corners.into_iter().map(|corner| self.turned(corner)))
    }

    fn is_outer(&self, number: u64, rows: u32) -> bool {
        let [row, rank] = self.of(number);
        let outer = |at: u32, count: u32| at < rows || count - 1 - at < rows;
        outer(row, self.rows) || outer(rank, self.ranks)
    }
}

impl Nelder {
    /// The angle between spokes, radians.
    fn angle(&self) -> f64 {
        self.spoke_angle_deg.map_or(TAU / f64::from(self.spokes), f64::to_radians)
    }

    fn radius(&self, arc: u32) -> f64 {
        self.innermost_m * pow(self.ratio, f64::from(arc))
    }

    /// Whether the last spoke stands beside the first.
    pub(super) fn is_circle(&self) -> bool {
        self.angle() * (f64::from(self.spokes) + 0.5) > TAU
    }

    fn at(&self, number: u64) -> ([u32; 2], [f64; 2]) {
        let [arc, spoke] = [number / u64::from(self.spokes), number % u64::from(self.spokes)].map(|n| n as u32);
        let (sin, cos) = sincos(self.angle() * f64::from(spoke));
        let radius = self.radius(arc);
        ([arc, spoke], [radius * sin, radius * cos])
    }

    /// The ground of a plant on an arc of radius r, m²: half-way to its neighbours on the spoke by the geometric mean
    /// of the radii, θ r² (α − 1/α)/2 (Nelder 1962, Section 3).
    fn area(&self, number: u64) -> f64 {
        let radius = self.radius((number / u64::from(self.spokes)) as u32);
        self.angle() * radius * radius * (self.ratio - 1.0 / self.ratio) / 2.0
    }

    fn is_outer(&self, number: u64, arcs: u32) -> bool {
        let ([arc, spoke], _) = self.at(number);
        let outer = |at: u32, count: u32| at < arcs || count - 1 - at < arcs;
        outer(arc, self.arcs) || (!self.is_circle() && outer(spoke, self.spokes))
    }
}

impl Layout {
    /// The rows, where there are rows.
    pub(super) fn cells(&self) -> Option<Cells> {
        match self {
            Self::Rows(lattice) => Some(lattice.cells(false)),
            Self::Triangular(lattice) => Some(lattice.cells(true)),
            Self::Hills(hills) => Some(hills.cells()),
            Self::Random(_) | Self::Nelder(_) | Self::Places(_) => None,
        }
    }

    /// The number of places.
    pub fn spots(&self) -> u64 {
        match self {
            Self::Random(random) => random.plants.into(),
            Self::Nelder(fan) => u64::from(fan.spokes) * u64::from(fan.arcs),
            Self::Places(places) => places.at.len() as u64,
            rows => rows.cells().map_or(0, |cells| cells.count()),
        }
    }

    /// The places, in their order: row by row, arc by arc, line by line; of a stand that is refused for its size only
    /// the first.
    pub(super) fn all(&self) -> Vec<Spot> {
        match self {
            Self::Places(places) => places.at.iter().zip(0..).map(|(place, number)| place.spot(number)).collect(),
            Self::Random(random) => {
                (0..random.plants).map(|number| Spot { cell: [0, number], ..Spot::default() }).collect()
            }
            Self::Nelder(fan) => {
                let spot = |number| {
                    let (cell, [x, y]) = fan.at(number);
                    Spot { at: [x, y, 0.0], cell, ..Spot::default() }
                };
                (0..self.spots().min(MOST_PLANTS)).map(spot).collect()
            }
            rows => rows.cells().map_or_else(Vec::new, |cells| rows.of_cells(&cells)),
        }
    }

    fn of_cells(&self, cells: &Cells) -> Vec<Spot> {
        let spot = |number: u64| {
            let cell = cells.of(number);
            let [x, y] = cells.turned(cells.middle(cell));
            let [beside_x, beside_y] = match self {
                Self::Hills(hills) => {
                    let place = (number % u64::from(hills.plants)) as f64 / f64::from(hills.plants);
                    let (sin, cos) = sincos(TAU * place);
                    [hills.radius_m * sin, hills.radius_m * cos]
                }
                _ => [0.0; 2],
            };
            Spot { at: [x + beside_x, y + beside_y, 0.0], cell, ..Spot::default() }
        };
        (0..cells.count().min(MOST_PLANTS)).map(spot).collect()
    }

    /// The ground of the layout.
    pub(super) fn ground(&self) -> Ground {
        match self {
            Self::Random(random) => Ground { least: [0.0; 2], most: random.size_m },
            Self::Places(Places { ground_m: Some([x, y, east, north]), .. }) => {
                Ground { least: [*x, *y], most: [x + east, y + north] }
            }
            Self::Places(places) => Ground::around(places.at.iter().map(|place| [place.x_m, place.y_m])),
            Self::Nelder(fan) => Ground::around((0..self.spots().min(MOST_PLANTS)).map(|number| fan.at(number).1)),
            rows => rows.cells().map_or(Ground { least: [0.0; 2], most: [0.0; 2] }, |cells| cells.ground()),
        }
    }

    /// The ground of a plant, m².
    pub(super) fn area(&self, number: u64) -> Option<f64> {
        let even = |[east, north]: [f64; 2]| east * north / self.spots().max(1) as f64;
        match self {
            Self::Random(random) => Some(even(random.size_m)),
            Self::Places(places) => places.ground_m.map(|[_, _, east, north]| even([east, north])),
            Self::Nelder(fan) => Some(fan.area(number)),
            rows => rows.cells().map(|cells| cells.steps[0] * cells.steps[1] / f64::from(cells.each)),
        }
    }

    /// Whether a plant stands in one of so many outer rows.
    pub(super) fn is_outer(&self, number: u64, rows: u32) -> bool {
        match self {
            Self::Nelder(fan) => fan.is_outer(number, rows),
            of_rows => of_rows.cells().is_some_and(|cells| cells.is_outer(number, rows)),
        }
    }
}

impl Place {
    fn spot(&self, number: u32) -> Spot {
        let Self { x_m, y_m, z_m, species, sown, guard } = self;
        Spot { at: [*x_m, *y_m, *z_m], cell: [0, number], species: species.clone(), sown: *sown, guard: *guard }
    }
}
