//! A tree, checked: its laws by growth level, what moves its tips, what is cut, its leaves, and how much of all there
//! will be.
//!
//! Absent on purpose: how the plan comes of the parameters (`compile`), and the branches (`tree`).

use super::counts::{Added, Outline, added};
use super::descriptor::TreeType;
use super::deviators::Deviators;
use super::laws::{DIAMETER, H1, NUMBERS, R0, R1, R2, RuleLaws, WORDS};
use crate::law::{At, VariateTable};
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{Form, LineageKey};
use phytomer_sim::random::{PlantRandom, Purpose};
use std::ops::RangeInclusive;

/// The words that a tree has in the stream of a plant: those of its rules.
const WORDS_OF_A_TREE: u64 = 64 * WORDS;
/// The words of the length and of the diameter of the first branch, among those of the first rule.
const FIRST_WORDS: [u64; 2] = [6, 7];

/// The shortest and the thinnest branch that a tree may have, metres: less than any cell, and single precision still
/// holds all its digits. A shorter branch is nothing.
pub(super) const SMALLEST_M: f64 = 1e-9;

/// The leaves at the tips.
#[derive(Debug, Clone)]
pub(super) struct Leaves {
    /// The growth levels of the branches that bear them.
    pub levels: RangeInclusive<u32>,
    pub number: u32,
    pub form: Form,
    /// Length and width, metres.
    pub size_m: [f64; 2],
    /// The area of one side, m².
    pub area_m2: f64,
    /// Radians.
    pub insertion: f64,
    /// The ticks after which a leaf falls, if it does.
    pub life: Option<Tick>,
    /// The place among the looks of single organs, if they have not the look of the species' leaves.
    pub look: Option<u16>,
}

/// One growth level: how its branches are borne.
#[derive(Debug, Clone)]
pub(super) struct PlannedLevel {
    /// The place of its rule.
    pub rule: usize,
    /// The type of its rule.
    pub of: TreeType,
    /// The angles of the category, left and right, degrees with their sign; 0 where there is none.
    pub course_deg: [f64; 2],
    /// Whether the level's own rule states the range of the angle, left and right.
    pub has_own_course: [bool; 2],
    pub deviators: Deviators,
    /// The last growth level that grows on the lateral branches that leave the main axis here.
    pub reach: u32,
}

/// One tree, checked.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    /// Its rules: the tree's own, then those of ranges of levels.
    pub rules: Vec<RuleLaws>,
    /// From level 1.
    pub levels: Vec<PlannedLevel>,
    /// Length and diameter of the first branch.
    pub first: [VariateTable; 2],
    /// The direction of the first branch, a unit vector.
    pub direction: [f64; 3],
    /// The last growth level of the main axis.
    pub main_until: u32,
    pub leaves: Option<Leaves>,
    /// Its place among the trees on one root.
    pub place: u64,
}

/// The numbers of the tree of one plant.
pub(super) struct DrawnNumbers {
    /// Those of each rule, in the order of the rules.
    pub rules: Vec<[f64; NUMBERS]>,
    /// Length and diameter of the first branch, metres.
    pub first_m: [f64; 2],
}

impl Plan {
    /// The largest growth level.
    pub fn last(&self) -> u32 {
        self.levels.len() as u32
    }

    /// The numbers of a plant.
    pub fn draw(&self, random: &PlantRandom) -> DrawnNumbers {
        let is_random = self.rules.iter().any(RuleLaws::is_random) || self.first.iter().any(VariateTable::is_random);
        let mut stream = is_random.then(|| random.stream(LineageKey::SEED, Purpose::Plant));
        let begin = self.place * WORDS_OF_A_TREE;
        let mut rules: Vec<[f64; NUMBERS]> = Vec::with_capacity(self.rules.len());
        for (place, rule) in (0..).zip(&self.rules) {
            let words = stream.as_mut().map(|stream| (stream, begin + place * WORDS));
            rules.push(rule.draw(words, rules.first()));
        }
        let mut first_m = [0.0; 2];
        for ((value, law), word) in first_m.iter_mut().zip(&self.first).zip(FIRST_WORDS) {
            let word = stream.as_mut().map_or(0, |stream| {
                stream.seek(begin + word);
                stream.word()
            });
            *value = law.draw_f64(word, At::default());
        }
        DrawnNumbers { rules, first_m }
    }

    /// What each growth level adds, from level 0, where nothing is moved to nothing.
    pub fn added(&self) -> Vec<Added> {
        let children: Vec<u32> = self.levels.iter().map(|level| level.of.children()).collect();
        let reach: Vec<u32> = self.levels.iter().map(|level| level.reach).collect();
        added(&Outline { children: &children, main_until: self.main_until, reach: &reach })
    }

    /// The leaves of a branch of a growth level.
    pub fn leaves_at(&self, level: u32) -> u64 {
        self.leaves.as_ref().filter(|leaves| leaves.levels.contains(&level)).map_or(0, |leaves| leaves.number.into())
    }

    /// Whether no branch can be moved to nothing, whatever is drawn: a child of a mother of length l is at least
    /// r l − m long, where r is its smallest ratio and m the furthest that its tip is moved.
    pub fn loses_nothing(&self) -> bool {
        if self.levels.iter().all(|level| level.deviators.is_none()) {
            return true;
        }
        let mut least = self.first[0].extent()[0];
        self.levels.iter().all(|level| {
            least = least * self.least_ratio(level) - level.deviators.most();
            least > SMALLEST_M
        })
    }

    /// The smallest ratio of lengths of a level.
    pub fn least_ratio(&self, level: &PlannedLevel) -> f64 {
        let places: &[usize] = if level.of == TreeType::Gmt3 { &[R0, R1, R2] } else { &[R1, R2] };
        places.iter().map(|&place| self.least(level, place)).fold(f64::INFINITY, f64::min)
    }

    /// The smallest ratio of diameters of a level.
    pub fn least_diameter_ratio(&self, level: &PlannedLevel) -> f64 {
        self.least(level, DIAMETER)
    }

    /// The smallest value of a number in a level: that of the tree's own rule where the level's rule states none.
    fn least(&self, level: &PlannedLevel, place: usize) -> f64 {
        let own = self.rules[level.rule].extent(place)[0];
        if own.is_nan() { self.rules[0].extent(place)[0] } else { own }
    }

    /// The laws of the angles that each branching of a level draws, left and right: those of its rule, or of the tree's
    /// own rule where the level's states none.
    pub fn scatter(&self, level: &PlannedLevel) -> [Option<&VariateTable>; 2] {
        let drawn = |side: usize| self.angle_law(level, side).filter(|law| law.is_random());
        [0, 1].map(|side| drawn(side).filter(|_| level.of == TreeType::Gmt4))
    }

    /// The law of an angle of a level, left or right, that is not of the category.
    pub fn angle_law(&self, level: &PlannedLevel, side: usize) -> Option<&VariateTable> {
        let own = self.rules[level.rule].tables[H1 + side].as_ref();
        let has_own = own.is_some() || level.has_own_course[side];
        if has_own { own } else { self.rules[0].tables[H1 + side].as_ref() }
    }

    /// The angle of a side by which it is decided which child continues an axis: with the mean of what branchings draw.
    pub fn nominal(&self, level: &PlannedLevel, side: usize, angles: [f64; 2]) -> f64 {
        angles[side] + self.scatter(level)[side].map_or(0.0, |law| law.mean(At::default()))
    }
}
