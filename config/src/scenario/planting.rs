//! How the plots stand on the field: rows, by the names and units of the ICASA dictionary.
//!
//! The plants of a row stand `plant_spacing` apart, the rows `row_spacing`, and a row runs towards `row_direction`. The
//! density `plant_pop_at_planting` takes the place of one of the two distances; alone it makes a square grid. Without
//! any of these keys the grid is that of `spacing_m`. Absent: which plot stands where (`run::field`).

use phytomer_law::fault::{Fault, Path};
use phytomer_sim::math;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Scenario;

/// The share by which the density may differ from that of the distances, which are printed in whole centimetres.
const ROUNDED: f64 = 0.01;

/// Rows of plants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Planting {
    /// Plants at planting per square metre, number/m² (ICASA `plant_pop_at_planting`). With `row_spacing` it gives the
    /// distance in the row; alone a square grid.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 10_000.0), extend("exclusiveMinimum" = 0))]
    pub plant_pop_at_planting: Option<f64>,
    /// The distance between rows, cm (ICASA `row_spacing`).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 100_000.0), extend("exclusiveMinimum" = 0))]
    pub row_spacing: Option<f64>,
    /// The distance between plants in a row, cm (ICASA `plant_spacing`).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 100_000.0), extend("exclusiveMinimum" = 0))]
    pub plant_spacing: Option<f64>,
    /// The direction of the rows, degrees from north to east (ICASA `row_direction`): 0 is north–south, 90 east–west.
    #[serde(skip_serializing_if = "is_north")]
    #[schemars(range(min = 0, max = 360))]
    pub row_direction: f64,
    /// The share of seeds that germinate, % (ICASA `germination`). All if not given. A seed that does not germinate has
    /// its row in `plants` and no other.
    #[serde(skip_serializing_if = "is_whole")]
    #[schemars(range(min = 0, max = 100))]
    pub germination: f64,
}

fn is_north(direction: &f64) -> bool {
    *direction == 0.0
}

fn is_whole(percent: &f64) -> bool {
    *percent == 100.0
}

impl Default for Planting {
    fn default() -> Self {
        Self {
            plant_pop_at_planting: None,
            row_spacing: None,
            plant_spacing: None,
            row_direction: 0.0,
            germination: 100.0,
        }
    }
}

impl Planting {
    /// Whether nothing is stated.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Whether a distance or a density is stated.
    pub(super) fn has_distances(&self) -> bool {
        self.plant_pop_at_planting.is_some() || self.row_spacing.is_some() || self.plant_spacing.is_some()
    }

    /// The distances between rows and in a row, metres; `None` where the keys give none.
    fn distances(&self) -> Option<(f64, f64)> {
        const CM: f64 = 0.01;
        let area = self.plant_pop_at_planting.map(|density| 1.0 / density);
        match (self.row_spacing, self.plant_spacing, area) {
            (Some(rows), Some(plants), _) => Some((rows * CM, plants * CM)),
            (Some(rows), None, Some(area)) => Some((rows * CM, area / (rows * CM))),
            (None, Some(plants), Some(area)) => Some((area / (plants * CM), plants * CM)),
            (None, None, Some(area)) => Some((area.sqrt(), area.sqrt())),
            _ => None,
        }
    }
}

/// A grid of plots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// From a row to the next, metres eastward and northward.
    pub across: [f64; 2],
    /// From a plot to the next in its row, metres eastward and northward.
    pub along: [f64; 2],
}

impl Grid {
    /// The larger of the distances between rows and in a row, metres.
    pub fn widest_step(&self) -> f64 {
        let squared = |step: [f64; 2]| step[0] * step[0] + step[1] * step[1];
        squared(self.across).max(squared(self.along)).sqrt()
    }

    /// A place of the grid, by its row and its rank in the row.
    pub fn place(&self, row: u32, rank: u32) -> [f64; 2] {
        [0, 1].map(|axis| f64::from(row) * self.across[axis] + f64::from(rank) * self.along[axis])
    }
}

impl Scenario {
    /// The grid on which the plots stand; `None` where each has an origin of its own.
    ///
    /// A row runs towards the azimuth a, degrees from north to east: along it is (sin a, cos a), and the next row lies
    /// to the right of it, towards (cos a, −sin a). Rows that run north are columns of the square grid of `spacing_m`.
    pub fn grid(&self) -> Option<Grid> {
        let (rows, plants) = self.planting.distances().or(self.spacing_m.map(|spacing| (spacing, spacing)))?;
        let (sin, cos) = turned(self.planting.row_direction);
        Some(Grid { across: [rows * cos, -rows * sin + 0.0], along: [plants * sin, plants * cos] })
    }

    /// Adds the faults of planting that the schema cannot state.
    pub(super) fn check_planting(&self, faults: &mut Vec<Fault>) {
        let planting = &self.planting;
        let path = Path::root().key("planting");
        let stated = [
            ("row_spacing", planting.row_spacing),
            ("plant_spacing", planting.plant_spacing),
            ("plant_pop_at_planting", planting.plant_pop_at_planting),
        ];
        let first = stated.iter().find_map(|(key, value)| value.map(|_| *key));
        if let (Some(key), true) = (first, self.spacing_m.is_some()) {
            let problem = format!("`{key}` and `spacing_m` both say how far the plants stand apart");
            faults.push(Fault::new(&path.key(key), problem, "one of them: `spacing_m` for a square grid, else rows"));
        }
        if let (Some(key), true) = (first, self.stand.is_none() && self.member.len() > 1) {
            let problem =
                format!("`{key}` sets single plants in rows, and each plot has {} members", self.member.len());
            faults.push(Fault::new(&path.key(key), problem, "`spacing_m` between plots, and `at_m` of each member"));
        }
        if let (Some(key), None) = (first, planting.distances()) {
            let other = if key == "row_spacing" { "plant_spacing" } else { "row_spacing" };
            let problem = format!("`{key}` is given alone");
            let expected = format!("`{other}` or `plant_pop_at_planting` beside it");
            faults.push(Fault::new(&path.key(key), problem, expected));
        }
        self.check_density(&path, faults);
        if planting.row_direction != 0.0 && self.grid().is_none() {
            let problem = "there are no rows that could run in this direction";
            faults.push(Fault::new(&path.key("row_direction"), problem, "`row_spacing` and `plant_spacing` beside it"));
        }
    }

    /// Where distances and density are given they must agree.
    fn check_density(&self, path: &Path, faults: &mut Vec<Fault>) {
        let Planting { plant_pop_at_planting, row_spacing, plant_spacing, .. } = self.planting;
        let (Some(density), Some(rows), Some(plants)) = (plant_pop_at_planting, row_spacing, plant_spacing) else {
            return;
        };
        let of_distances = 10_000.0 / (rows * plants);
        if (density / of_distances - 1.0).abs() > ROUNDED {
            let problem = format!(
                "{density} plants/m² do not stand at {rows} × {plants} cm, which are {of_distances:.4} plants/m²"
            );
            let expected = "two of `row_spacing`, `plant_spacing` and `plant_pop_at_planting`, or three that agree";
            faults.push(Fault::new(&path.key("plant_pop_at_planting"), problem, expected));
        }
    }
}

/// The sine and the cosine of an angle in degrees; exact at right angles, so that rows to the east are level.
pub(super) fn turned(degrees: f64) -> (f64, f64) {
    match degrees {
        0.0 | 360.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => (math::sin(other.to_radians()), math::cos(other.to_radians())),
    }
}
