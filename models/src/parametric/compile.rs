//! The checks of the parameters of a parametric tree: each number in its range, variations that leave a length above 0,
//! a trunk that is longer than its bare part.
//!
//! Absent: the meaning of the parameters (`equations`).

use super::model::TreeModel;
use super::tree::{Branches, Tree, Trunk};
use crate::fault::{Fault, Path};
use crate::law::{Constant, Quantity, ValueRange};
use phytomer_sim::clock::{LAST_TICK, Tick};

const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a share" };
const SIZE: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1000.0, what: "a size in m" };
const RATIO: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1.0, what: "a radius over a length" };
const POWER: ValueRange = ValueRange { min: 0.0, max: 10.0, what: "a power" };
const LENGTH: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 10.0, what: "a length over another" };
const TAPER: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a taper" };
const ANGLE: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };
const SIGNED_ANGLE: ValueRange = ValueRange { min: -180.0, ..ANGLE };
const TURN: ValueRange = ValueRange { min: -360.0, max: 360.0, what: "an angle in degrees" };
const TURN_V: ValueRange = ValueRange { min: 0.0, ..TURN };
const CURVE: ValueRange = ValueRange { min: -3600.0, max: 3600.0, what: "an angle in degrees" };
const CURVE_V: ValueRange = ValueRange { min: 0.0, ..CURVE };

/// The largest numbers of levels, of segments, of splits and of branches.
const MOST_LEVELS: usize = 1;
const MOST_SEGMENTS: u32 = 100;
const MOST_SPLITS: u32 = 20;
const MOST_BRANCHES: u32 = 10_000;

/// Numbers of one table with their keys and ranges.
type Numbers<'a> = &'a [(&'static str, &'a Constant, ValueRange)];

impl Tree {
    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<TreeModel, Vec<Fault>> {
        let mut faults = Vec::new();
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        let numbers: Numbers<'_> = &[
            ("base_size", &self.base_size, SHARE),
            ("scale_m", &self.scale_m, SIZE),
            ("scale_v_m", &self.scale_v_m, variation_of("scale_m", &self.scale_m)),
            ("ratio", &self.ratio, RATIO),
            ("ratio_power", &self.ratio_power, POWER),
        ];
        check(numbers, path, &mut faults);
        self.trunk.check(&path.key("trunk"), &mut faults);
        let branches = path.key("branches");
        if self.branches.len() > MOST_LEVELS {
            let problem = format!("there are {} levels of branches", self.branches.len());
            faults.push(Fault::new(&branches, problem, format!("at most {MOST_LEVELS}")));
        }
        (0..).zip(&self.branches).for_each(|(level, table)| table.check(&branches.index(level), &mut faults));
        if faults.is_empty() {
            self.check_room(path, &mut faults);
        }
        if faults.is_empty() { Ok(TreeModel::new(self)) } else { Err(faults) }
    }

    /// Adds a fault unless the shortest trunk reaches above the bare part.
    fn check_room(&self, path: &Path, faults: &mut Vec<Fault>) {
        let (base, shortest) = (self.base_size.value(), self.trunk.length.value() - self.trunk.length_v.value());
        if !self.branches.is_empty() && base >= shortest {
            let problem = format!("base_size is {base}, and the shortest trunk has {shortest} of the tree's size");
            let expected = "a bare part that is shorter than `length` less `length_v` of the trunk".to_owned();
            faults.push(Fault::new(&path.key("base_size"), problem, expected));
        }
    }
}

impl Trunk {
    fn check(&self, path: &Path, faults: &mut Vec<Fault>) {
        let numbers: Numbers<'_> = &[
            ("length", &self.length, LENGTH),
            ("length_v", &self.length_v, variation_of("length", &self.length)),
            ("taper", &self.taper, TAPER),
            ("split_angle_deg", &self.split_angle_deg, ANGLE),
            ("split_angle_v_deg", &self.split_angle_v_deg, ANGLE),
            ("curve_deg", &self.curve_deg, CURVE),
            ("curve_back_deg", &self.curve_back_deg, CURVE),
            ("curve_v_deg", &self.curve_v_deg, CURVE_V),
        ];
        check(numbers, path, faults);
        count("base_splits", &self.base_splits, 0, MOST_SPLITS, path, faults);
        count("curve_res", &self.curve_res, 1, MOST_SEGMENTS, path, faults);
    }
}

impl Branches {
    fn check(&self, path: &Path, faults: &mut Vec<Fault>) {
        let numbers: Numbers<'_> = &[
            ("down_angle_deg", &self.down_angle_deg, ANGLE),
            ("down_angle_v_deg", &self.down_angle_v_deg, SIGNED_ANGLE),
            ("rotate_deg", &self.rotate_deg, TURN),
            ("rotate_v_deg", &self.rotate_v_deg, TURN_V),
            ("length", &self.length, LENGTH),
            ("length_v", &self.length_v, variation_of("length", &self.length)),
            ("taper", &self.taper, TAPER),
            ("curve_deg", &self.curve_deg, CURVE),
            ("curve_back_deg", &self.curve_back_deg, CURVE),
            ("curve_v_deg", &self.curve_v_deg, CURVE_V),
        ];
        check(numbers, path, faults);
        count("number", &self.number, 0, MOST_BRANCHES, path, faults);
        count("curve_res", &self.curve_res, 1, MOST_SEGMENTS, path, faults);
    }
}

/// The range of the variation of a length: at most the length.
fn variation_of(key: &'static str, length: &Constant) -> ValueRange {
    let what = match key {
        "scale_m" => "a variation not above `scale_m`,",
        _ => "a variation not above `length`,",
    };
    ValueRange { min: 0.0, max: length.value().max(0.0), what }
}

fn check(numbers: Numbers<'_>, path: &Path, faults: &mut Vec<Fault>) {
    for (key, number, range) in numbers {
        faults.extend(number.within(&path.key(key), *range).err());
    }
}

fn count(key: &str, number: &Quantity, least: u32, most: u32, path: &Path, faults: &mut Vec<Fault>) {
    let value = number.value();
    if !(least..=most).contains(&value) {
        let path = match number {
            Quantity::Number(_) => path.key(key),
            Quantity::Form(_) => path.key(key).key("value"),
        };
        faults.push(Fault::new(&path, format!("{key} is {value}"), format!("a whole number in [{least}, {most}]")));
    }
}
