//! From the descriptor of a tree to the model: every law compiled and every fault of meaning found before the first
//! tick.
//!
//! Checked are the keys of each type, ranges of growth levels, cuts and leaves within the tree, and what `checks` has.
//! Absent on purpose: the parameters (`descriptor`, `parts`), the draws (`laws`) and the tree (`tree`).

use super::checks;
use super::courses::{Courses, changes, courses, has_ends};
use super::descriptor::{CombinedLevels, Descriptor, GeometricTree, MOST_LEVELS, Rule, TreeType};
use super::deviators::{Deviators, Pull};
use super::foliage::Wardrobe;
use super::laws::{H1, H2, NUMBERS, R0, RuleLaws, STATED, table};
use super::model::GeometricModel;
use super::parts::Controller;
use super::plan::{Plan, PlannedLevel};
use crate::fault::{Fault, Path};
use crate::law::{Quantity, ValueRange};
use phytomer_sim::clock::{LAST_TICK, Tick};
use phytomer_sim::plant::MOST_COMPONENTS;

const METRES: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1000.0, what: "metres" };
const FACTOR: ValueRange = ValueRange { min: -1000.0, max: 1000.0, what: "a strength" };
const DEVIATION: ValueRange = ValueRange { min: -1000.0, max: 1000.0, what: "metres" };
const PLACE: ValueRange = ValueRange { min: -1e6, max: 1e6, what: "metres" };
const DIRECTION: ValueRange = ValueRange { min: -1e6, max: 1e6, what: "a number" };
/// The most ticks of a growth level, trees on one root, and controllers of a rule.
const MOST_TICKS: u32 = 1000;
const MOST_GLUED: usize = 100;
const MOST_CONTROLLERS: usize = 1000;

/// A rule in the making: what it states, where, and for which growth levels.
struct Stated<'a> {
    rule: &'a Rule,
    of: TreeType,
    levels: [u32; 2],
    path: Path,
    laws: RuleLaws,
    courses: Option<Courses>,
    deviation: [f64; 3],
    pulls: Vec<([u32; 2], Pull)>,
}

impl GeometricTree {
    /// The most growth levels of its trees.
    fn last(&self) -> u32 {
        let glued = self.glue.iter().map(|glued| glued.tree.levels.value());
        glued.chain([self.tree.levels.value()]).max().unwrap_or(0)
    }

    /// The ticks in which a growth level grows.
    pub fn pace(&self) -> Tick {
        self.ticks_per_level.as_ref().map_or(1, Quantity::value).clamp(1, MOST_TICKS)
    }

    /// The full growth level is reached at this age: as in the figures of the paper, growth level 0 is age 1 where a
    /// level grows in one tick.
    pub fn full_grown_at(&self) -> Tick {
        (self.last().min(MOST_LEVELS) + 1) * self.pace()
    }

    /// Every fault of meaning in a tree of a type, whose parameters stand at `path` in their file.
    pub fn check(&self, of: TreeType, path: &Path) -> Vec<Fault> {
        self.model(of, path).err().unwrap_or_default()
    }

    /// The model of a tree of a type, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault that [`GeometricTree::check`] finds, and an age past the last tick.
    pub fn compile(&self, of: TreeType, until: Tick, path: &Path) -> Result<GeometricModel, Vec<Fault>> {
        let model = self.model(of, path);
        if until <= LAST_TICK {
            return model;
        }
        let late = Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}"));
        Err(model.err().into_iter().flatten().chain([late]).collect())
    }

    fn model(&self, of: TreeType, path: &Path) -> Result<GeometricModel, Vec<Fault>> {
        let (mut faults, mut wardrobe) = (Vec::new(), Wardrobe::new());
        let mut plans = vec![self.tree.plan(of, 0, path, &mut wardrobe, &mut faults)];
        for (i, glued) in self.glue.iter().take(MOST_GLUED).enumerate() {
            let path = path.key("glue").index(i);
            plans.push(glued.tree.plan(glued.model, i + 1, &path, &mut wardrobe, &mut faults));
        }
        let ticks = self.ticks_per_level.as_ref().map_or(1, Quantity::value);
        if !(1..=MOST_TICKS).contains(&ticks) {
            let path = path.key("ticks_per_level");
            faults.push(Fault::new(&path, format!("a growth level takes {ticks} ticks"), format!("1 to {MOST_TICKS}")));
        }
        if self.glue.len() > MOST_GLUED {
            let problem = format!("{} trees are glued", self.glue.len());
            faults.push(Fault::new(&path.key("glue"), problem, format!("at most {MOST_GLUED}")));
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let model = GeometricModel::new(plans, self.pace(), wardrobe.habit());
        let all = model.components_at(LAST_TICK);
        if all > u64::from(MOST_COMPONENTS) {
            let problem = format!("the trees on one root have {all} components together");
            let expected = format!("at most {MOST_COMPONENTS}: fewer growth levels, or fewer trees");
            return Err(vec![Fault::new(&path.key("glue"), problem, expected)]);
        }
        Ok(model)
    }
}

impl Descriptor {
    /// The plan of the tree at `place` on its root; what is wrong is added to `faults`, and the plan is then of no use.
    fn plan(&self, of: TreeType, place: usize, path: &Path, wardrobe: &mut Wardrobe, faults: &mut Vec<Fault>) -> Plan {
        let before = faults.len();
        let levels = self.levels.value().min(MOST_LEVELS);
        let rules = self.rules(of, levels, path, faults);
        let leaf = path.key("leaf");
        let leaves = self.leaf.as_ref().and_then(|stated| wardrobe.leaves(stated, (levels, place), &leaf, faults));
        let [length, diameter] =
            [("first_length_m", &self.first_length_m), ("first_diameter_m", &self.first_diameter_m)]
                .map(|(key, law)| table(law, &path.key(key), METRES, faults));
        let mut plan = Plan {
            levels: planned(&rules, levels),
            first: [length, diameter],
            direction: self.direction(path, faults),
            main_until: levels,
            leaves,
            place: place as u64,
            rules: rules.iter().map(|stated| stated.laws.clone()).collect(),
        };
        self.cut(&mut plan, path, faults);
        let sound = faults.len() == before;
        checks::angles(&plan, &rules.iter().map(|stated| stated.path.clone()).collect::<Vec<_>>(), faults);
        let levels_path = match self.levels {
            Quantity::Number(_) => path.key("levels"),
            Quantity::Form(_) => path.key("levels").key("value"),
        };
        let is_plain = self.combine.is_empty() && self.cut_axis.is_none() && self.cut_lateral.is_empty();
        let most = checks::levels_with_room(&plan);
        faults.extend(checks::explosion(of, is_plain, self.levels.value(), most, &levels_path));
        if sound && faults.len() == before {
            checks::sizes(&plan, path, faults);
        }
        plan
    }

    /// The rules: the tree's own, then those of ranges of levels.
    fn rules<'a>(&'a self, of: TreeType, levels: u32, path: &Path, faults: &mut Vec<Fault>) -> Vec<Stated<'a>> {
        let mut rules = vec![stated(&self.rule, of, [1, levels.max(1)], path.clone(), None, faults)];
        let mut taken = vec![false; levels as usize + 1];
        for (i, part) in self.combine.iter().enumerate() {
            let path = path.key("combine").index(i);
            let Some(range) = part.range(levels, &mut taken, &path, faults) else { continue };
            let rule = stated(&part.rule, part.model.unwrap_or(of), range, path, Some(&rules[0]), faults);
            rules.push(rule);
        }
        rules
    }

    fn direction(&self, path: &Path, faults: &mut Vec<Fault>) -> [f64; 3] {
        let path = path.key("first_direction");
        let Some(stated) = self.first_direction else { return [0.0, 0.0, 1.0] };
        let [x, y, z] = within(stated, DIRECTION, &path, faults);
        let long = (x * x + y * y + z * z).sqrt();
        if long.is_nan() || long <= 1e-9 {
            faults.push(Fault::new(&path, "the direction has no length", "at least one number that is not 0"));
            return [0.0, 0.0, 1.0];
        }
        [x / long, y / long, z / long]
    }

    /// What is cut of the tree.
    fn cut(&self, plan: &mut Plan, path: &Path, faults: &mut Vec<Fault>) {
        let levels = plan.last();
        let within = |level: u32, path: &Path, faults: &mut Vec<Fault>| {
            let is_level = (1..=levels).contains(&level);
            if !is_level {
                let expected = format!("a growth level of the tree, 1 to {levels}");
                faults.push(Fault::new(path, format!("the growth level is {level}"), expected));
            }
            is_level
        };
        if let Some(level) = self.cut_axis.as_ref().map(Quantity::value)
            && within(level, &path.key("cut_axis"), faults)
        {
            plan.main_until = level - 1;
        }
        for (i, cut) in self.cut_lateral.iter().enumerate() {
            let path = path.key("cut_lateral").index(i);
            let level = cut.level.value();
            if !within(level, &path.key("level"), faults) {
                continue;
            }
            let to = cut.to_level.as_ref().map(Quantity::value);
            if to.is_some_and(|to| to < level || to > levels) {
                let problem = format!("to_level is {}", to.unwrap_or_default());
                let expected = format!("a growth level of the branch, {level} to {levels}");
                faults.push(Fault::new(&path.key("to_level"), problem, expected));
            }
            plan.levels[level as usize - 1].reach = to.unwrap_or(level - 1);
        }
    }
}

impl CombinedLevels {
    /// The first and the last level, where both are of the tree and in no range before; `taken` are those of the
    /// ranges.
    fn range(&self, levels: u32, taken: &mut [bool], path: &Path, faults: &mut Vec<Fault>) -> Option<[u32; 2]> {
        let [from, to] = [self.from_level.value(), self.to_level.value()];
        if from < 1 || from > to || to > levels {
            let problem = format!("the range is from growth level {from} to {to}");
            let expected = format!("1 ≤ from_level ≤ to_level ≤ {levels}, the last of the tree");
            faults.push(Fault::new(&path.key("to_level"), problem, expected));
            return None;
        }
        let range = &mut taken[from as usize..=to as usize];
        if range.contains(&true) {
            let problem = format!("the growth levels {from} to {to} are in another range too");
            faults.push(Fault::new(&path.key("from_level"), problem, "each growth level in one range"));
        }
        range.fill(true);
        Some([from, to])
    }
}

/// A rule at `path` that holds for a range of levels, with what it takes from the rule of the tree.
fn stated<'a>(
    rule: &'a Rule,
    of: TreeType,
    levels: [u32; 2],
    path: Path,
    tree: Option<&Stated<'_>>,
    faults: &mut Vec<Fault>,
) -> Stated<'a> {
    rule.foreign(of, &path, faults);
    let laws = RuleLaws::compile(rule, of, &path, faults);
    let courses = match tree {
        _ if of != TreeType::Gmt4 => None,
        Some(tree) if !changes(rule) && rule.h1_deg.is_none() && rule.h2_deg.is_none() => tree.courses,
        _ if !changes(rule) => None,
        tree => courses(rule, tree.map(|tree| tree.rule), &path, faults),
    };
    let takes = of.takes("deviation_m");
    let deviation = match (rule.deviation_m.filter(|_| takes), tree) {
        (Some(by), _) => within(by, DEVIATION, &path.key("deviation_m"), faults),
        (None, Some(tree)) if takes => tree.deviation,
        (None, _) => [0.0; 3],
    };
    let pulls = match (rule.controller.as_ref().filter(|_| takes), tree) {
        (Some(all), _) => pulls(all, &path.key("controller"), faults),
        (None, Some(tree)) if takes => tree.pulls.clone(),
        (None, _) => Vec::new(),
    };
    let stated = Stated { rule, of, levels, path, laws, courses, deviation, pulls };
    stated.missing(tree, faults);
    stated
}

impl Stated<'_> {
    /// Adds a fault for each key that the rule needs and neither it nor the tree states, and for angles that can be too
    /// great together.
    fn missing(&self, tree: Option<&Stated<'_>>, faults: &mut Vec<Fault>) {
        let needs = |place: usize| self.of.needs().any(|key| key == STATED[place].0) || place <= H2;
        for place in (0..NUMBERS).filter(|&place| needs(place) && (place != R0 || self.of == TreeType::Gmt3)) {
            let has_course = place <= H2 && self.has_course(place, tree);
            let inherited = tree.is_some_and(|tree| tree.laws.tables[place].is_some());
            if self.laws.tables[place].is_none() && !inherited && !has_course {
                let key = STATED[place].0;
                let problem = format!("{key} is missing");
                let expected = format!("it: a tree of {} has one", self.of.word());
                faults.push(Fault::new(&self.path.key(key), problem, expected));
            }
        }
        for side in [H1, H2] {
            let of_category = self.courses.map_or(0.0, |courses| courses.greatest(side));
            let [least, most] = self.laws.extent(side);
            if of_category > 0.0 && of_category + least.abs().max(most.abs()) > 180.0 {
                let problem = "with the angle of the category it can be above 180 degrees";
                let expected = "an angle in [-180, 180] together with that of the category";
                faults.push(Fault::new(&self.path.key(STATED[side].0), problem, expected));
            }
        }
    }

    /// Whether the angle of a side follows the category, its own or the tree's; where the keys of the category are
    /// wrong, it would.
    fn has_course(&self, side: usize, tree: Option<&Stated<'_>>) -> bool {
        let of_tree = tree.is_some_and(|tree| self.of == TreeType::Gmt4 && has_ends(tree.rule)[side]);
        self.courses.is_some_and(|courses| courses.has(side)) || has_ends(self.rule)[side] || of_tree
    }
}

/// The controllers of a rule, each with its range of growth levels.
fn pulls(all: &[Controller], path: &Path, faults: &mut Vec<Fault>) -> Vec<([u32; 2], Pull)> {
    if all.len() > MOST_CONTROLLERS {
        let problem = format!("there are {} controllers", all.len());
        faults.push(Fault::new(path, problem, format!("at most {MOST_CONTROLLERS}")));
        return Vec::new();
    }
    let mut pulls = Vec::with_capacity(all.len());
    for (i, stated) in all.iter().enumerate() {
        let path = path.index(i);
        let factor = stated.factor.within(&path.key("factor"), FACTOR).map_err(|fault| faults.push(fault));
        let at = within(stated.at_m, PLACE, &path.key("at_m"), faults);
        let level = |stated: &Option<Quantity>, other: u32| stated.as_ref().map_or(other, Quantity::value);
        let (from, to) = (level(&stated.from_level, 1), level(&stated.to_level, MOST_LEVELS));
        if from < 1 || from > to || to > MOST_LEVELS {
            let problem = format!("the controller acts on the growth levels {from} to {to}");
            let expected = format!("1 ≤ from_level ≤ to_level ≤ {MOST_LEVELS}");
            let key = if stated.to_level.is_some() { "to_level" } else { "from_level" };
            faults.push(Fault::new(&path.key(key), problem, expected));
        }
        pulls.push(([from, to], Pull { factor: factor.unwrap_or(0.0), at, falloff: stated.falloff }));
    }
    pulls
}

/// Three numbers within a range; those that are not are faults.
fn within(numbers: [f64; 3], range: ValueRange, path: &Path, faults: &mut Vec<Fault>) -> [f64; 3] {
    for (i, number) in numbers.into_iter().enumerate().filter(|(_, number)| !range.holds(*number)) {
        faults.push(Fault::new(&path.index(i), format!("the value is {number}"), range.expected()));
    }
    numbers
}

/// The growth levels of the rules: each has the rule of its range, or that of the tree.
fn planned(rules: &[Stated<'_>], levels: u32) -> Vec<PlannedLevel> {
    let of_level = |level: u32| {
        let place = rules.iter().skip(1).position(|stated| (stated.levels[0]..=stated.levels[1]).contains(&level));
        let rule = place.map_or(0, |place| place + 1);
        let stated = &rules[rule];
        let [from, to] = stated.levels;
        // s runs from 0 at the first branching of the rule to 1 at the last.
        let s = if to > from { f64::from(level - from) / f64::from(to - from) } else { 0.0 };
        let pulls = stated.pulls.iter().filter(|([from, to], _)| (*from..=*to).contains(&level)).map(|(_, pull)| *pull);
        PlannedLevel {
            rule,
            of: stated.of,
            course_deg: stated.courses.map_or([0.0; 2], |courses| courses.at(s)),
            has_own_course: [H1, H2].map(|side| stated.courses.is_some_and(|courses| courses.has(side))),
            deviators: Deviators::new(stated.deviation, pulls),
            reach: levels,
        }
    };
    (1..=levels).map(of_level).collect()
}
