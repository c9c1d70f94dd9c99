//! How the branches of one growth level are borne, with the numbers of one plant: the ways of the children and the
//! turns of the branchings.
//!
//! A level that has grown by a share has that share of its ratios, angles and turns. Absent: the branches (`tree`).

use super::descriptor::TreeType;
use super::laws::{DELTA, DIAMETER, DIVERGENCE, H1, NUMBERS, R0, R1};
use super::plan::{Plan, PlannedLevel};
use crate::law::VariateTable;
use phytomer_sim::math;
use std::f64::consts::PI;

/// How the branches of a growth level are borne.
pub(super) struct Level<'a> {
    /// Its number, from 1.
    pub number: u32,
    pub planned: &'a PlannedLevel,
    /// Left, centre, right.
    pub ways: Vec<Way>,
    /// By the rank of the mother, from 1.
    turns: Vec<Turn>,
    pub diameter_ratio: f64,
    /// The laws of the angles that each branching draws: left and right.
    pub scatter: [Option<&'a VariateTable>; 2],
    /// How much of it has grown, in (0, 1].
    pub share: f64,
}

/// The way in which a child leaves its mother.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    /// The child's length over the mother's.
    pub ratio: f64,
    /// The angle between the child and the mother, signed: left is above 0.
    pub angle_deg: f64,
    pub sincos: (f64, f64),
    /// 0 left, 1 right; `None` of the centre child.
    pub side: Option<usize>,
    /// Whether the child continues the mother's axis.
    pub continues: bool,
    /// Whether it stands beside a centre child.
    pub beside_centre: bool,
}

/// By how much a branching is turned out of the maximal gradient plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    pub deg: f64,
    pub sincos: (f64, f64),
}

impl<'a> Level<'a> {
    /// Level `number` of a plan, with the numbers of its rule, grown by `share`.
    pub fn of(plan: &'a Plan, number: u32, rules: &[[f64; NUMBERS]], share: f64) -> Self {
        let planned = &plan.levels[number as usize - 1];
        let (numbers, scatter) = (&rules[planned.rule], plan.scatter(planned));
        // Where branchings draw an angle, that of the category is without the draw.
        let angles: [f64; 2] = [0, 1].map(|side| match scatter[side] {
            Some(_) => planned.course_deg[side],
            None if planned.of != TreeType::Gmt4 => numbers[H1 + side],
            None => planned.course_deg[side] + plan.angle_law(planned, side).map_or(0.0, |_| numbers[H1 + side]),
        });
        let has_centre = planned.of == TreeType::Gmt3;
        let leads = usize::from(plan.nominal(planned, 0, angles).abs() > plan.nominal(planned, 1, angles).abs());
        let lateral = |side: usize| {
            let angle_deg = angles[side] * share;
            let ratio = numbers[R1 + side] * share;
            let continues = !has_centre && side == leads;
            let sincos = math::sincos(radians(angle_deg));
            Way { ratio, angle_deg, sincos, side: Some(side), continues, beside_centre: has_centre }
        };
        let mut ways = vec![lateral(0), lateral(1)];
        if has_centre {
            let ratio = numbers[R0] * share;
            let (sincos, side) = ((0.0, 1.0), None);
            ways.insert(1, Way { ratio, angle_deg: 0.0, sincos, side, continues: true, beside_centre: false });
        }
        let turn = |rank: u32| {
            let deg = turn_deg(rank, numbers) * share;
            Turn { deg, sincos: math::sincos(radians(deg)) }
        };
        let diameter_ratio = numbers[DIAMETER] * share;
        Self { number, planned, ways, turns: (1..=number).map(turn).collect(), diameter_ratio, scatter, share }
    }
}

impl Level<'_> {
    /// The turn of the branching above the branch of `rank`.
    #[inline]
    pub fn turn(&self, rank: u32) -> &Turn {
        &self.turns[rank as usize - 1]
    }
}

/// By how much the branching above the branch of `rank` is turned out of the maximal gradient plane, degrees in (−720,
/// 720). Each branching along an axis adds the divergence angle, and the first of an axis is not turned by it (Figs. 4
/// and 10); δ turns all alike.
pub(super) fn turn_deg(rank: u32, numbers: &[f64; NUMBERS]) -> f64 {
    let by_divergence = math::fmod(f64::from(rank - 1) * numbers[DIVERGENCE], 360.0);
    // Adding 0 would change the sign of −0, and with it the bits of a tree without δ.
    if numbers[DELTA] == 0.0 { by_divergence } else { by_divergence + numbers[DELTA] }
}

pub(super) fn radians(degrees: f64) -> f64 {
    degrees * (PI / 180.0)
}

/// An angle of at least −720 degrees, reduced to [0, 360).
pub(super) fn around(degrees: f64) -> f64 {
    math::fmod(degrees + 720.0, 360.0)
}
