//! The checks of the parameters of a parametric tree: each number in its range, variations that leave a length above 0,
//! a trunk that is longer than its bare part, levels that never fall with age.
//!
//! All faults are told at once, each at its key. Absent: the meaning of the parameters (`equations` and its
//! neighbours), and whether the tree has room (`expectation`).

use super::numbers::{Ages, Envelope, Level, Numbers, Season};
use super::params::{Branches, Children, Growing, LeafSeason, Tree, Trunk, Whole};
use crate::fault::{Fault, Path};
use crate::law::{Asked, At, Constant, Domain, Law, Quantity, ValueRange};
use phytomer_looks::FormName;
use phytomer_sim::clock::{LAST_TICK, NEVER, Tick};

/// The age at which a tree without growth stands.
pub(super) const BIRTH: Tick = 1;

const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a share" };
const SIZE: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1000.0, what: "a size in m" };
const RATIO: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1.0, what: "a radius over a length" };
const POWER: ValueRange = ValueRange { min: 0.0, max: 10.0, what: "a power" };
const CURVATURE: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 10.0, what: "a power" };
const WIDTH: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 10.0, what: "a radius over the size of the tree" };
const FACTOR: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 100.0, what: "a factor" };
const FLARE: ValueRange = ValueRange { min: 0.0, max: 100.0, what: "a share of the radius" };
const LENGTH: ValueRange = ValueRange { min: 0.0, max: 10.0, what: "a length over another" };
const SOME_LENGTH: ValueRange = ValueRange { min: f64::MIN_POSITIVE, ..LENGTH };
const TAPER: ValueRange = ValueRange { min: 0.0, max: 3.0, what: "a taper" };
const SPLITS: ValueRange = ValueRange { min: 0.0, max: 20.0, what: "a number of clones a segment" };
const STEMS: ValueRange = ValueRange { min: -2000.0, max: 2000.0, what: "a number of stems" };
const LEAVES: ValueRange = ValueRange { min: -10_000.0, max: 10_000.0, what: "a number of leaves" };
const ANGLE: ValueRange = ValueRange { min: -180.0, max: 180.0, what: "an angle in degrees" };
const TURN: ValueRange = ValueRange { min: -360.0, max: 360.0, what: "an angle in degrees" };
const CURVE: ValueRange = ValueRange { min: -3600.0, max: 3600.0, what: "an angle in degrees" };
const LEAF: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 100.0, what: "a length in m" };
const LEAF_WIDTH: ValueRange = ValueRange { what: "a width over a length", ..LEAF };
const ATTRACTION: ValueRange = ValueRange { min: -100.0, max: 100.0, what: "a tendency" };
const SCALE_BY_AGE: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1.0, what: "a share of the full size" };
const LEVELS_BY_AGE: ValueRange = ValueRange { min: 1.0, max: 100.0, what: "a number of levels" };

/// The greatest numbers of levels, of segments of a stem, of clones at the base and of lobes.
const MOST_LEVELS: u32 = 8;
const MOST_SEGMENTS: u32 = 100;
const MOST_BASE_SPLITS: u32 = 20;
const MOST_LOBES: u32 = 64;

/// The faults that are found below a path, for the keys of one level.
struct Checks<'a> {
    path: &'a Path,
    digit: &'static str,
    faults: &'a mut Vec<Fault>,
}

impl Tree {
    /// The parameters as plain numbers, for ages up to `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn numbers(&self, until: Tick, path: &Path) -> Result<Numbers, Vec<Fault>> {
        let mut faults = Vec::new();
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        let mut numbers = self.whole.numbers(&mut Checks { path, digit: "", faults: &mut faults });
        let trunk = &mut Checks { path, digit: "0", faults: &mut faults };
        self.trunk.check(&mut numbers, trunk);
        for (n, (level, digit)) in self.branches.iter().zip(["1", "2", "3"]).enumerate() {
            let is_used = n + 1 < usize::from(numbers.levels);
            numbers.level[n + 1] = level.numbers(is_used, &mut Checks { path, digit, faults: &mut faults });
        }
        if faults.is_empty() {
            self.check_room(&numbers, path, &mut faults);
            numbers.ages = self.whole.ages(numbers.levels, until.min(LAST_TICK), path, &mut faults);
        }
        if faults.is_empty() { Ok(numbers) } else { Err(faults) }
    }

    /// Adds a fault unless the shortest trunk reaches above the bare part.
    fn check_room(&self, numbers: &Numbers, path: &Path, faults: &mut Vec<Fault>) {
        let (base, shortest) = (numbers.base_size, numbers.level[0].length - numbers.level[0].length_v);
        let bears = numbers.levels > 1 || numbers.leaves != 0.0;
        if bears && base >= shortest {
            let problem = format!("BaseSize is {base}, and the shortest trunk has {shortest} of the tree's size");
            let expected = "a bare part that is shorter than `0Length` less `0LengthV`".to_owned();
            faults.push(Fault::new(&path.key("BaseSize"), problem, expected));
        }
    }
}

impl Checks<'_> {
    fn key(&self, key: &str) -> Path {
        self.path.key(&format!("{}{key}", self.digit))
    }

    /// The number, with a fault where it is outside its range.
    fn number(&mut self, key: &str, number: &Constant, range: ValueRange) -> f64 {
        self.faults.extend(number.within(&self.key(key), range).err());
        number.value()
    }

    fn count(&mut self, key: &str, number: &Quantity, least: u32, most: u32) -> u32 {
        let value = number.value();
        if !(least..=most).contains(&value) {
            let path = match number {
                Quantity::Number(_) => self.key(key),
                Quantity::Form(_) => self.key(key).key("value"),
            };
            let problem = format!("{}{key} is {value}", self.digit);
            self.faults.push(Fault::new(&path, problem, format!("a whole number in [{least}, {most}]")));
        }
        value
    }

    fn fault(&mut self, key: &str, problem: String, expected: &str) {
        self.faults.push(Fault::new(&self.key(key), problem, expected));
    }

    /// A number that no equation of the paper uses, which is `expected` in all its species.
    fn unused(&mut self, key: &str, number: &Constant, expected: f64) {
        let value = number.value();
        if value != expected {
            let told = format!("{expected}, as in every species of the paper; leave the key out");
            self.fault(key, format!("{key} is {value}, and no equation of the paper uses it"), &told);
        }
    }

    /// nCurveV: a variation, or below 0 the angle of a helix.
    fn curve_v(&mut self, number: &Constant) -> f64 {
        let value = number.value();
        if value <= -90.0 {
            let problem =
                format!("{}CurveV is {value}: the segments of a helix would not rise along its axis", self.digit);
            self.fault("CurveV", problem, "an angle above -90 degrees");
        }
        self.number("CurveV", number, ValueRange { min: value.min(CURVE.max), ..CURVE })
    }
}

impl Whole {
    fn numbers(&self, checks: &mut Checks<'_>) -> Numbers {
        let scale = checks.number("Scale", &self.scale, SIZE);
        let most = ValueRange { min: 0.0, max: scale.max(0.0), what: "a variation not above `Scale`," };
        checks.unused("ZScale", &self.z_scale, 1.0);
        checks.unused("ZScaleV", &self.z_scale_v, 0.0);
        let lobe_depth = checks.number("LobeDepth", &self.lobe_depth, SHARE);
        if lobe_depth >= 1.0 {
            checks.fault("LobeDepth", "the trunk would have no width between its lobes".to_owned(), "a share below 1");
        }
        Numbers {
            shape: checks.count("Shape", &self.shape, 0, 8),
            base_size: checks.number("BaseSize", &self.base_size, SHARE),
            scale,
            scale_v: checks.number("ScaleV", &self.scale_v, most),
            levels: checks.count("Levels", &self.levels, 1, MOST_LEVELS).clamp(1, MOST_LEVELS) as u8,
            ratio: checks.number("Ratio", &self.ratio, RATIO),
            ratio_power: checks.number("RatioPower", &self.ratio_power, POWER),
            lobes: checks.count("Lobes", &self.lobes, 0, MOST_LOBES),
            lobe_depth,
            flare: checks.number("Flare", &self.flare, FLARE),
            radius_scale: 1.0,
            radius_scale_v: 0.0,
            base_splits: 0,
            leaves: checks.number("Leaves", &self.leaves, LEAVES),
            leaf_form: self.leaf_form(checks),
            leaf_scale: checks.number("LeafScale", &self.leaf_scale, LEAF),
            leaf_scale_x: checks.number("LeafScaleX", &self.leaf_scale_x, LEAF_WIDTH),
            leaf_bend: checks.number("LeafBend", &self.leaf_bend, SHARE),
            attraction_up: checks.number("AttractionUp", &self.attraction_up, ATTRACTION),
            quality: checks.number("quality", &self.quality, FACTOR),
            sway: self.sway,
            prune_ratio: checks.number("PruneRatio", &self.prune_ratio, SHARE),
            envelope: self.envelope(checks),
            above_base: self.children == Children::AboveBase,
            level: [Level::default(); 4],
            ages: Ages { scale: vec![1.0], births: Vec::new(), season: None },
        }
    }

    fn leaf_form(&self, checks: &mut Checks<'_>) -> FormName {
        self.leaf_shape.form().unwrap_or_else(|| {
            let problem = "the paper lists no shape of leaves with this number".to_owned();
            checks.fault(
                "LeafShape",
                problem,
                "a whole number in [0, 5], or the name of a form (`phytomer list forms`)",
            );
            FormName::Oval
        })
    }

    fn envelope(&self, checks: &mut Checks<'_>) -> Envelope {
        let peak = checks.number("PruneWidthPeak", &self.prune_width_peak, SHARE);
        if peak == 0.0 || peak == 1.0 {
            let problem = format!("PruneWidthPeak is {peak}, so that the envelope has no part on one side of it");
            checks.fault("PruneWidthPeak", problem, "a share above 0 and below 1");
        }
        Envelope {
            width: checks.number("PruneWidth", &self.prune_width, WIDTH),
            peak,
            low: checks.number("PrunePowerLow", &self.prune_power_low, CURVATURE),
            high: checks.number("PrunePowerHigh", &self.prune_power_high, CURVATURE),
        }
    }

    /// The tree by its age.
    fn ages(&self, levels: u8, until: Tick, path: &Path, faults: &mut Vec<Fault>) -> Ages {
        let whole = Growing { scale: Law::Number(1.0), levels: None };
        let growing = self.growth.as_ref().unwrap_or(&whole);
        let path_of = path.key("growth");
        let by_age = |law: &Law, key: &str, range, faults: &mut Vec<Fault>| {
            let domain = Domain { asked: Asked::Birth, until: until.max(BIRTH), ..Domain::default() };
            let table = law.compile_value(&domain, &path_of.key(key), range);
            let value =
                |age: Tick| table.as_ref().map_or(1.0, |table| f64::from(table.value(At { age, ..At::default() })));
            let all: Vec<f64> = (0..=until).map(|age| value(age.max(BIRTH))).collect();
            faults.extend(table.err().unwrap_or_default());
            all
        };
        let scale = by_age(&growing.scale, "scale", SCALE_BY_AGE, faults);
        let standing = match &growing.levels {
            Some(law) => by_age(law, "levels", LEVELS_BY_AGE, faults),
            None => vec![f64::from(MOST_LEVELS); until as usize + 1],
        };
        if let Some(age) = (BIRTH as usize + 1..standing.len()).find(|&age| standing[age] < standing[age - 1]) {
            let problem =
                format!("the number of levels falls at age {age}, from {} to {}", standing[age - 1], standing[age]);
            faults.push(Fault::new(&path_of.key("levels"), problem, "a law that never falls: levels do not go"));
        }
        let born = |level: u8| {
            let age = (BIRTH..=until).find(|&age| standing[age as usize] >= f64::from(level) + 1.0 - 1e-6);
            age.unwrap_or(NEVER)
        };
        let births = if until < BIRTH { vec![NEVER; levels.into()] } else { (0..levels).map(born).collect() };
        let season = self.season.as_ref().and_then(|season| season.checked(&path.key("season"), faults));
        Ages { scale, births, season }
    }
}

impl LeafSeason {
    fn checked(&self, path: &Path, faults: &mut Vec<Fault>) -> Option<Season> {
        let (year, out, fall) = (self.ticks_per_year.value(), self.leaf_out.value(), self.leaf_fall.value());
        if year < 2 {
            let problem = format!("a year has {year} ticks");
            faults.push(Fault::new(
                &path.key("ticks_per_year"),
                problem,
                "at least 2, one with leaves and one without",
            ));
        }
        if out >= fall || fall > year {
            let problem = format!("leaves appear at tick {out} of the year and fall at tick {fall}");
            let expected = format!("a fall after their appearance and at most at {year}, the ticks of the year");
            faults.push(Fault::new(&path.key("leaf_fall"), problem, expected));
        }
        faults.is_empty().then_some(Season { year, out, fall })
    }
}

impl Trunk {
    fn check(&self, numbers: &mut Numbers, checks: &mut Checks<'_>) {
        let scale = checks.number("Scale", &self.scale, FACTOR);
        let most = ValueRange { min: 0.0, max: scale.max(0.0), what: "a variation below `0Scale`," };
        let scale_v = checks.number("ScaleV", &self.scale_v, most);
        if scale_v >= scale {
            checks.fault("ScaleV", "a trunk could have no width".to_owned(), "a variation below `0Scale`");
        }
        (numbers.radius_scale, numbers.radius_scale_v) = (scale, scale_v);
        numbers.base_splits = checks.count("BaseSplits", &self.base_splits, 0, MOST_BASE_SPLITS);
        let length = checks.number("Length", &self.length, SOME_LENGTH);
        let most = ValueRange { min: 0.0, max: length.max(0.0), what: "a variation not above `0Length`," };
        numbers.level[0] = Level {
            length,
            length_v: checks.number("LengthV", &self.length_v, most),
            taper: checks.number("Taper", &self.taper, TAPER),
            seg_splits: checks.number("SegSplits", &self.seg_splits, SPLITS),
            split_angle: checks.number("SplitAngle", &self.split_angle, ANGLE),
            split_angle_v: checks.number("SplitAngleV", &self.split_angle_v, ANGLE),
            curve_res: checks.count("CurveRes", &self.curve_res, 1, MOST_SEGMENTS),
            curve: checks.number("Curve", &self.curve, CURVE),
            curve_back: checks.number("CurveBack", &self.curve_back, CURVE),
            curve_v: checks.curve_v(&self.curve_v),
            ..Level::default()
        };
    }
}

impl Branches {
    /// The parameters of a level; `is_used` tells whether the tree has stems of it.
    fn numbers(&self, is_used: bool, checks: &mut Checks<'_>) -> Level {
        let length = checks.number("Length", &self.length, LENGTH);
        let most = ValueRange { min: 0.0, max: length.max(0.0), what: "a variation not above the length," };
        let branches = checks.number("Branches", &self.branches, STEMS);
        if is_used && branches != 0.0 && length == 0.0 {
            let problem = format!("{}Length is 0, so that the stems of this level have no length", checks.digit);
            checks.fault("Length", problem, "a length above 0");
        }
        Level {
            down_angle: checks.number("DownAngle", &self.down_angle, ANGLE),
            down_angle_v: checks.number("DownAngleV", &self.down_angle_v, ANGLE),
            rotate: checks.number("Rotate", &self.rotate, TURN),
            rotate_v: checks.number("RotateV", &self.rotate_v, TURN),
            branches,
            length,
            length_v: checks.number("LengthV", &self.length_v, most),
            taper: checks.number("Taper", &self.taper, TAPER),
            seg_splits: checks.number("SegSplits", &self.seg_splits, SPLITS),
            split_angle: checks.number("SplitAngle", &self.split_angle, ANGLE),
            split_angle_v: checks.number("SplitAngleV", &self.split_angle_v, ANGLE),
            curve_res: checks.count("CurveRes", &self.curve_res, 1, MOST_SEGMENTS),
            curve: checks.number("Curve", &self.curve, CURVE),
            curve_back: checks.number("CurveBack", &self.curve_back, CURVE),
            curve_v: checks.curve_v(&self.curve_v),
        }
    }
}
