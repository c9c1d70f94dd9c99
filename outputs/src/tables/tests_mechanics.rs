//! The columns of mechanics: present where a run states them, with the values of a plant that bends.
//!
//! The moment is computed again from the masses and places in the rows, without the code of the mechanics.

use super::Table;
use super::columns::RECORDS_OF_POSE;
use crate::read::Run;
use crate::specimen::{Wooden, plan, run, run_of};
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Int8Type, Int32Type};
use arrow_array::{Array, RecordBatch};
use phytomer_sim::mechanics::{OrganMass, Tissue, Wood};
use phytomer_sim::site::STANDARD_GRAVITY;
use std::f64::consts::PI;
use tempfile::{TempDir, tempdir};

const MODULUS: f64 = 2e9;
const COLUMNS: [&str; 4] = ["wood_volume_m3", "fresh_mass_kg", "curvature_per_m", "bending_moment_N_m"];

/// Wood that is heavier from its second tick on.
fn wood(bends: bool) -> Wood {
    let tissue = Tissue { modulus: vec![MODULUS as f32], density: vec![800.0, 900.0], ..Tissue::default() };
    let organs = OrganMass { leaf: 0.25, flower: 200.0, fruit: 1000.0 };
    Wood { tissues: vec![tissue], bends, organs, ..Wood::default() }
}

fn grown(wood: Option<Wood>) -> (TempDir, Run) {
    let home = tempdir().unwrap();
    let mut plan = plan(1, 1);
    plan.mechanics = true;
    run_of(&Wooden(wood), home.path(), plan);
    let run = Run::open(home.path()).unwrap();
    (home, run)
}

/// The values of a row of `records` that these tests use.
#[derive(Debug, Clone)]
struct MechanicsRow {
    age: i32,
    birth: i32,
    kind: String,
    order: i32,
    rank: i32,
    base: [f64; 3],
    dir: [f64; 3],
    length: Option<f64>,
    diameters: [Option<f64>; 2],
    area: Option<f64>,
    mechanics: [Option<f64>; 4],
}

impl MechanicsRow {
    fn of(batch: &RecordBatch, row: usize) -> Self {
        let column = |name: &str| batch.column_by_name(name).unwrap();
        let int = |name: &str| column(name).as_primitive::<Int32Type>().value(row);
        let float = |name: &str| {
            let column = column(name).as_primitive::<Float32Type>();
            column.is_valid(row).then(|| f64::from(column.value(row)))
        };
        let kinds = column("kind").as_dictionary::<Int8Type>();
        let words = kinds.values().as_string::<i32>();
        Self {
            age: int("age"),
            birth: int("birth_age"),
            kind: words.value(kinds.keys().value(row) as usize).to_owned(),
            order: int("order"),
            rank: int("rank"),
            base: ["x_m", "y_m", "z_m"].map(|name| float(name).unwrap()),
            dir: ["dir_x", "dir_y", "dir_z"].map(|name| float(name).unwrap()),
            length: float("length_m"),
            diameters: ["diameter_m", "diameter_tip_m"].map(float),
            area: float("area_m2"),
            mechanics: COLUMNS.map(float),
        }
    }

    fn is_internode(&self) -> bool {
        self.kind.ends_with("internode")
    }

    /// A point on the internode's own line, as a share of its length.
    fn point(&self, share: f64) -> [f64; 3] {
        [0, 1, 2].map(|k| self.base[k] + self.dir[k] * self.length.unwrap() * share)
    }
}

fn rows(run: &Run) -> Vec<MechanicsRow> {
    let batches = run.batches(Table::Records).unwrap().map(Result::unwrap);
    batches
        .flat_map(|batch| (0..batch.num_rows()).map(|row| MechanicsRow::of(&batch, row)).collect::<Vec<_>>())
        .collect()
}

fn close(found: f64, expected: f64, share: f64) -> bool {
    (found - expected).abs() <= share * expected.abs()
}

#[test]
fn they_stand_at_the_end_where_they_are_asked_for() {
    let (_home, run) = grown(Some(wood(true)));
    let schema = run.schema(Table::Records).unwrap().unwrap();
    let names: Vec<&str> = schema.fields()[RECORDS_OF_POSE..].iter().map(|field| field.name().as_str()).collect();
    assert_eq!(names, COLUMNS);
    let units: Vec<&str> = schema.fields()[RECORDS_OF_POSE..].iter().map(|f| f.metadata()["unit"].as_str()).collect();
    assert_eq!(units, ["m3", "kg", "1/m", "N m"]);
    assert!(run.metadata(Table::Records).unwrap()["phytomer.units"].contains("newton metres"));
    let views = std::fs::read_to_string(_home.path().join("views.sql")).unwrap();
    assert!(views.contains("mechanics_at(a)"));
    assert_eq!(run.json()["mechanics"], true);
}

#[test]
fn without_the_key_nothing_tells_of_them() {
    let home = tempdir().unwrap();
    run(home.path(), plan(1, 1));
    let run = Run::open(home.path()).unwrap();
    assert_eq!(run.schema(Table::Records).unwrap().unwrap().fields().len(), RECORDS_OF_POSE);
    for file in ["run.json", "datapackage.json", "views.sql"] {
        let text = std::fs::read_to_string(home.path().join(file)).unwrap();
        assert!(!text.contains("mechanics") && !text.contains("\"fresh_mass_kg\""), "{file}");
    }
}

#[test]
fn volumes_and_masses_are_those_of_the_measures() {
    let (_home, run) = grown(Some(wood(true)));
    for row in rows(&run) {
        let [volume, mass, curvature, moment] = row.mechanics;
        match (row.is_internode(), row.kind.as_str()) {
            (true, _) => {
                let [base, tip] = row.diameters.map(Option::unwrap);
                let frustum = PI / 12.0 * row.length.unwrap() * (base * base + base * tip + tip * tip);
                let density = if row.age > row.birth { 900.0 } else { 800.0 };
                assert!(close(volume.unwrap(), frustum, 1e-5) && close(mass.unwrap(), frustum * density, 1e-5));
                assert!(curvature.is_some() && moment.is_some());
            }
            (_, "leaf") => assert!(close(mass.unwrap(), 0.25 * row.area.unwrap(), 1e-5)),
            (_, "flower") => assert!(close(mass.unwrap(), 200.0 * PI / 6.0 * 0.08 * 0.03 * 0.03, 1e-5)),
            _ => assert!(row.kind == "apical_bud" && mass.is_none()),
        }
        assert!(row.is_internode() || [volume, curvature, moment].iter().all(Option::is_none));
    }
}

/// The moment of the first internode is the weight of everything beyond its middle, times its horizontal distance.
#[test]
fn the_moment_is_that_of_the_masses_beyond() {
    let (_home, run) = grown(Some(wood(true)));
    for age in [4, 7, 8] {
        let rows: Vec<MechanicsRow> = rows(&run).into_iter().filter(|row| row.age == age).collect();
        let first = rows.iter().find(|row| row.is_internode() && row.order == 1 && row.rank == 1).unwrap();
        let middle = first.point(0.5);
        let mut hanging = [0.0; 2];
        for row in rows.iter().filter(|row| row.mechanics[1].is_some()) {
            let (share, at) = match (row.is_internode(), std::ptr::eq(row, first)) {
                (true, true) => (0.5, row.point(0.75)),
                (true, false) => (1.0, row.point(0.5)),
                // An organ hangs at its node, which is where it stands.
                (false, _) => (1.0, row.base),
            };
            (0..2).for_each(|k| hanging[k] += share * row.mechanics[1].unwrap() * (at[k] - middle[k]));
        }
        let expected = STANDARD_GRAVITY * (hanging[0] * hanging[0] + hanging[1] * hanging[1]).sqrt();
        let found = first.mechanics[3].unwrap();
        assert!(expected > 1e-5 && close(found, expected, 0.03), "age {age}: {found} N m, by hand {expected}");
    }
}

/// An internode in its first tick has no history: its curvature is the moment over its stiffness.
#[test]
fn the_curvature_of_new_wood_is_the_moment_over_the_stiffness() {
    let (_home, run) = grown(Some(wood(true)));
    let rows = rows(&run);
    let new: Vec<&MechanicsRow> = rows.iter().filter(|row| row.is_internode() && row.birth == row.age).collect();
    assert!(new.len() >= 5);
    for row in new {
        let [base, tip] = row.diameters.map(Option::unwrap);
        let middle: f64 = (base + tip) / 2.0;
        let square = middle * middle;
        let flexural = MODULUS * PI / 64.0 * square * square;
        assert!(close(row.mechanics[2].unwrap() * flexural, row.mechanics[3].unwrap(), 1e-4), "{row:?}");
    }
    assert!(rows.iter().any(|row| row.mechanics[2].is_some_and(|curvature| curvature > 1e-4)));
}

#[test]
fn null_where_there_is_no_wood_or_it_does_not_bend() {
    let (_home, run) = grown(Some(wood(false)));
    let stiff = rows(&run);
    assert!(stiff.iter().all(|row| row.mechanics[2].is_none() && row.mechanics[3].is_none()));
    assert!(stiff.iter().filter(|row| row.is_internode()).all(|row| row.mechanics[1].is_some()));
    let (_home, run) = grown(None);
    for row in rows(&run) {
        assert_eq!(row.mechanics[0].is_some(), row.is_internode());
        assert!(row.mechanics[1..].iter().all(Option::is_none));
    }
}
