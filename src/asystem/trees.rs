//! The trees of a stage: what a script has said of each, and where it stands.
//!
//! Growth levels, ratios, angles, deviators, cuts and leaves become keys of a [`GeometricTree`] when it is asked for; a
//! zoom multiplies every length in it. Places and turns belong to the stage. Absent: growth (`grown`), and how trees
//! are drawn (`drawn`).

use super::foliage::Leaves;
use phytomer_asystem::{Angles, Colour, Controller, Deformation, GirthForm, Part, TreeDescriptor, TreeType as Word};
use phytomer_looks::FormName;
use phytomer_models::fault::{Fault, Path};
use phytomer_models::geometric::{
    self as models, CombinedLevels, CutLateral, Descriptor, Falloff, GeometricTree, GluedTree, Rule, TreeType,
};
use phytomer_models::law::{Constant, Quantity, Variate};
use phytomer_sim::rotation::Rotation;

/// The first branch where a script states none, metres: its height above the origin. The controllers of Table 4 stand
/// three times as far away.
const FIRST_M: f64 = 10.0;
/// The diameter of the first branch over its length, where a script states no girth.
const SLENDER: f64 = 0.1;
/// The ratio of diameters where a script states no girth.
const TAPER: f64 = 0.7;
/// The length and the width of a leaf over the length of the first branch, where a script states none.
const LEAF: [f64; 2] = [0.05, 0.025];

/// How trees are made that are created from now on: the modes of the appendix.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Modes {
    /// The colour of trees; black if not given.
    pub colour: Option<Colour>,
    /// The girth of their branches, where it is on.
    pub girth: Option<Option<GirthForm>>,
    /// The steps of a growth level in frames.
    pub steps: Option<u32>,
    /// The growth level from which the main axis is cut.
    pub cut_axis: Option<u32>,
    /// The growth level from which lateral branches are cut, and the last levels that grow on them, one after another.
    pub cut_lateral: Option<(u32, Vec<u32>)>,
    /// The divergence, degrees.
    pub divergence: Option<f64>,
}

/// Where a tree stands (`SEGMENT`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// How many times it is as large as it was created.
    pub zoom: f64,
    /// How far it is turned about its main axis, degrees.
    pub degrees: f64,
    /// How far its root is moved, metres.
    pub place: [f64; 3],
}

impl Default for Segment {
    fn default() -> Self {
        Self { zoom: 1.0, degrees: 0.0, place: [0.0; 3] }
    }
}

/// The shadow of a tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shade {
    /// Where the light is.
    pub emitter: [f64; 3],
    /// The colour of the shadow.
    pub colour: Colour,
    /// Whether overlapping shadows are one.
    pub merged: bool,
}

/// One of the trees that stand on a root.
#[derive(Debug, Clone, PartialEq)]
struct Stem {
    level: u32,
    /// How growth levels branch, from level 1 on; at least one.
    parts: Vec<Part>,
    /// The first branch, and its diameter.
    way: [f64; 3],
    thick: f64,
    taper: f64,
    /// How many times it is as large as all this says.
    zoom: f64,
    divergence: Option<f64>,
    cut_axis: Option<u32>,
    cut_lateral: Option<(u32, Vec<u32>)>,
    deviator: Option<[f64; 3]>,
    controllers: Vec<Controller>,
    /// From where controllers are measured.
    root: [f64; 3],
    leaves: Option<Leaves>,
}

/// A tree of a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct Tree {
    stems: Vec<Stem>,
    /// Where its root was created.
    root: [f64; 3],
    /// Where it stands.
    pub segment: Segment,
    /// The colour that `color` has given it.
    pub colour: Option<Colour>,
    /// Whether it is seen.
    pub appears: bool,
    /// How its branches have a girth: `None`, they are lines.
    pub girth: Option<GirthForm>,
    /// Its shadow.
    pub shade: Option<Shade>,
    /// The steps of a growth level in its frames.
    pub steps: u32,
}

impl Tree {
    /// The tree of `create`.
    pub fn created(tree_type: Word, level: u32, descriptor: &TreeDescriptor, modes: &Modes) -> Self {
        let part = Part { tree_type, levels: [1, level], descriptor: descriptor.clone() };
        Self::combined(level, vec![part], modes)
    }

    /// The tree of `combine`, of at least one range.
    pub fn combined(level: u32, parts: Vec<Part>, modes: &Modes) -> Self {
        let init = parts.first().and_then(|part| part.descriptor.init);
        let [root, end] = init.unwrap_or([[0.0; 3], [0.0, 0.0, FIRST_M]]);
        let way = [0, 1, 2].map(|k| end[k] - root[k]);
        let stem = Stem {
            level,
            parts,
            way,
            thick: SLENDER * length(way),
            taper: TAPER,
            zoom: 1.0,
            divergence: modes.divergence,
            cut_axis: modes.cut_axis,
            cut_lateral: modes.cut_lateral.clone(),
            deviator: None,
            controllers: Vec::new(),
            root,
            leaves: None,
        };
        let mut tree = Self {
            stems: vec![stem],
            root,
            segment: Segment::default(),
            colour: modes.colour,
            appears: true,
            girth: None,
            shade: None,
            steps: modes.steps.unwrap_or(1),
        };
        if let Some(form) = modes.girth {
            tree.give_girth(true, form);
        }
        tree
    }

    /// The tree of `glue`: the second on the root of the first, each as large as it stands.
    pub fn glued(first: &Self, second: &Self) -> Self {
        let larger = |tree: &Self| {
            let zoom = tree.segment.zoom;
            tree.stems.iter().cloned().map(move |stem| Stem { zoom: stem.zoom * zoom, ..stem }).collect::<Vec<Stem>>()
        };
        let mut stems = larger(first);
        stems.extend(larger(second));
        Self { stems, segment: Segment { zoom: 1.0, ..first.segment }, ..first.clone() }
    }

    /// Gives every branch a girth, or takes it.
    pub fn give_girth(&mut self, on: bool, form: Option<GirthForm>) {
        if !on {
            self.girth = None;
            return;
        }
        let first = self.stems.first();
        let assumed = GirthForm {
            first: first.map_or(1.0, |stem| stem.thick),
            ratio: first.map_or(TAPER, |stem| stem.taper),
            dense: 1.0,
            shaded: false,
            main_axis: false,
            corners: 8,
        };
        let form = form.unwrap_or(assumed);
        self.girth = Some(form);
        self.stems.iter_mut().for_each(|stem| (stem.thick, stem.taper) = (form.first, form.ratio));
    }

    /// Gives the tree what `deform` states anew.
    pub fn deform(&mut self, deformation: &Deformation) {
        let Deformation { deviator, controllers, start } = deformation;
        for stem in &mut self.stems {
            stem.deviator = deviator.or(stem.deviator);
            if let Some(controllers) = controllers {
                stem.controllers.clone_from(controllers);
            }
        }
        if let Some((root, more)) = start {
            self.root = *root;
            if let Some(stem) = self.stems.first_mut() {
                let long = length(stem.way);
                // A branch that would be shorter than nothing has no length, which the models refuse.
                let share = ((long + more) / long).max(0.0);
                stem.way = stem.way.map(|x| x * share);
            }
            self.stems.iter_mut().for_each(|stem| stem.root = *root);
        }
    }

    /// Gives the tree leaves from a growth level on.
    pub fn bear(&mut self, form: FormName, level: u32, colour: Colour, size: Option<[f64; 2]>) {
        for stem in &mut self.stems {
            let size = size.unwrap_or_else(|| LEAF.map(|share| share * length(stem.way)));
            stem.leaves = Some(Leaves { form, level: level.min(stem.level), colour, size });
        }
    }

    /// The colour of its lines: black where `color` has given it none.
    pub fn ink(&self) -> Colour {
        self.colour.unwrap_or([0; 3])
    }

    /// The length of its first branch, as large as it stands.
    pub fn first_m(&self) -> f64 {
        self.stems.first().map_or(1.0, |stem| length(stem.way) * stem.zoom * self.segment.zoom)
    }

    /// Its controllers, each once: where they stand, and whether they pull.
    pub fn controllers(&self) -> Vec<([f64; 3], bool)> {
        let Some(first) = self.stems.first() else { return Vec::new() };
        let turn = Rotation::about(first.way, (self.segment.degrees % 360.0).to_radians());
        let root = self.stands_at();
        let mut all = Vec::new();
        for stem in &self.stems {
            let zoom = stem.zoom * self.segment.zoom;
            for one in &stem.controllers {
                let from_root = turn.turned([0, 1, 2].map(|k| (one.at[k] - stem.root[k]) * zoom));
                let star = ([0, 1, 2].map(|k| root[k] + from_root[k]), one.factor >= 0.0);
                if !all.contains(&star) {
                    all.push(star);
                }
            }
        }
        all
    }

    /// The colour of its leaves.
    pub fn leaf_colour(&self) -> Colour {
        self.stems.iter().find_map(|stem| stem.leaves).map_or(self.ink(), |leaves| leaves.colour)
    }

    /// Its type: that of its first range, but what deviates is no gmt1.
    pub fn tree_type(&self) -> TreeType {
        self.stems.first().map_or(TreeType::Gmt1, Stem::tree_type)
    }

    /// Its growth level.
    pub fn level(&self) -> u32 {
        self.stems.iter().map(|stem| stem.level).max().unwrap_or(0)
    }

    /// What grows, as large as it stands, in so many steps a growth level.
    pub fn grows(&self, steps: u32) -> Option<GeometricTree> {
        let (first, others) = self.stems.split_first()?;
        let glued = |stem: &Stem| GluedTree { model: stem.tree_type(), tree: stem.descriptor(self.segment.zoom) };
        Some(GeometricTree {
            tree: first.descriptor(self.segment.zoom),
            glue: others.iter().map(glued).collect(),
            ticks_per_level: (steps > 1).then(|| Quantity::from(steps)),
        })
    }

    /// Every fault of meaning in its numbers.
    pub fn check(&self) -> Vec<Fault> {
        self.grows(self.steps).map(|grows| grows.check(self.tree_type(), &Path::root())).unwrap_or_default()
    }

    /// Where its root stands.
    pub fn stands_at(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.root[k] + self.segment.place[k])
    }
}

impl Stem {
    fn deviates(&self) -> bool {
        self.deviator.is_some() || !self.controllers.is_empty()
    }

    fn tree_type(&self) -> TreeType {
        self.type_of(self.parts.first().map_or(Word::Gmt1, |part| part.tree_type))
    }

    fn type_of(&self, word: Word) -> TreeType {
        match word {
            Word::Gmt1 if self.deviates() => TreeType::Gmt2,
            Word::Gmt1 => TreeType::Gmt1,
            Word::Gmt2 => TreeType::Gmt2,
            Word::Gmt3 => TreeType::Gmt3,
            Word::Gmt4 => TreeType::Gmt4,
        }
    }

    fn descriptor(&self, zoom: f64) -> Descriptor {
        let zoom = zoom * self.zoom;
        let rule = self.parts.first().map(|part| self.rule(part, zoom)).unwrap_or_default();
        let mut tree = Descriptor::new(rule, self.level);
        tree.first_length_m = Variate::from(length(self.way) * zoom);
        tree.first_diameter_m = Variate::from(self.thick * zoom);
        let leans = self.way[0] != 0.0 || self.way[1] != 0.0 || self.way[2] < 0.0;
        tree.first_direction = leans.then_some(self.way);
        tree.cut_axis = self.cut_axis.map(|level| Quantity::from(level.max(1)));
        tree.cut_lateral = self.cuts();
        let combined = |part: &Part| {
            let [from_level, to_level] = part.levels.map(Quantity::from);
            let model = Some(self.type_of(part.tree_type));
            CombinedLevels { model, from_level, to_level, rule: self.rule(part, zoom) }
        };
        tree.combine = self.parts.iter().skip(1).map(combined).collect();
        tree.leaf = self.leaves.map(|leaves| leaves.stated(zoom));
        tree
    }

    fn rule(&self, part: &Part, zoom: f64) -> Rule {
        let number = |value: f64| Some(Variate::from(value));
        let TreeDescriptor { r0, ratios: [r1, r2], angles, .. } = part.descriptor;
        let mut rule = Rule {
            r0: r0.map(Variate::from),
            r1: number(r1),
            r2: number(r2),
            diameter_ratio: number(self.taper),
            divergence_deg: self.divergence.map(Variate::from),
            deviation_m: self.deviator.map(|way| way.map(|x| x * zoom)),
            ..Rule::default()
        };
        let controllers: Vec<_> = self.controllers.iter().map(|one| self.controller(one, zoom)).collect();
        rule.controller = (!controllers.is_empty()).then_some(controllers);
        match angles {
            Angles::Constant([h1, h2]) => (rule.h1_deg, rule.h2_deg) = (number(h1), number(h2)),
            Angles::Changing { category, left, right } => {
                rule.category = Some(Quantity::from(category));
                let [h1_max, h1_min] = left.map(|angle| Some(Constant::Number(angle)));
                let [h2_max, h2_min] = right.map(|angle| Some(Constant::Number(angle)));
                (rule.h1_max_deg, rule.h1_min_deg) = (h1_max, h1_min);
                (rule.h2_max_deg, rule.h2_min_deg) = (h2_max, h2_min);
            }
        }
        rule
    }

    fn controller(&self, stated: &Controller, zoom: f64) -> models::Controller {
        let [from_level, to_level] = stated.levels.map(|level| Some(Quantity::from(level.max(1))));
        models::Controller {
            factor: Constant::Number(stated.factor * zoom),
            at_m: [0, 1, 2].map(|k| (stated.at[k] - self.root[k]) * zoom),
            from_level,
            to_level,
            falloff: Falloff::None,
        }
    }

    /// The lateral branches that are cut: those of the main axis from a level on; each of a list of last levels is for
    /// the next of them. Without a list none of them grows.
    fn cuts(&self) -> Vec<CutLateral> {
        let Some((from, until)) = &self.cut_lateral else { return Vec::new() };
        let levels = (*from).max(1)..=self.level;
        let cut = |level: u32, to: Option<u32>| CutLateral {
            level: Quantity::from(level),
            to_level: to.map(|to| Quantity::from(to.max(level).min(self.level))),
        };
        match until.is_empty() {
            true => levels.map(|level| cut(level, None)).collect(),
            // A branch whose last level is below its own does not grow.
            false => levels.zip(until).map(|(level, to)| cut(level, (*to >= level).then_some(*to))).collect(),
        }
    }
}

fn length(way: [f64; 3]) -> f64 {
    way.iter().map(|x| x * x).sum::<f64>().sqrt()
}
