//! The leaves of a tree (Weber & Penn 1995 §4.5, §4.9): on the stems of the last level, along them or in a fan at their
//! end, turned towards the light.
//!
//! Draws of leaves are in streams of their own, so that leaves move no stem. Absent: the forms of leaves (`looks`).

use super::dealt::{Dealt, Place, Plan};
use super::drawn::{Drawn, bare};
use super::draws::{A_LEAF, signed};
use super::equations::{down_angle_deg, fan_deg, leaves, leaves_on, rotate_deg};
use super::generation::{Family, Generation, Stem};
use super::numbers::Numbers;
use super::path::{ALONG, UP, leaving, radians};
use super::write::{LeafInPlace, Writer};
use phytomer_sim::clock::Tick;
use phytomer_sim::math::{atan2, pow};
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::{Kind, NodeId, key};
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use phytomer_sim::rotation::Rotation;
use std::f64::consts::PI;

/// The leaves of a tree.
pub(super) struct Foliage<'a> {
    tree: &'a Numbers,
    drawn: Drawn,
    random: &'a PlantRandom,
}

impl<'a> Foliage<'a> {
    pub fn new(tree: &'a Numbers, drawn: Drawn, random: &'a PlantRandom) -> Self {
        Self { tree, drawn, random }
    }

    /// Adds the leaves of one year on all stems of the last level, stem by stem from the base to the tip.
    pub fn grow(
        &self,
        stems: &Generation,
        writer: &mut Writer<'_>,
        dealt: &mut Dealt,
        year: u32,
        span: (Tick, Tick),
    ) -> Result<(), Overgrown> {
        let tree = self.tree;
        if tree.leaves == 0.0 {
            return Ok(());
        }
        let long = tree.leaf_scale / pow(tree.quality, 0.5);
        let size = [long, long * tree.leaf_scale_x];
        let area = size[0] * size[1] * f64::from(tree.leaf_form.area_share());
        for family in &stems.families {
            let plan = self.plan(family);
            writer.has_room_for(plan.number.into())?;
            dealt.deal(&plan, &stems.stems[family.members.clone()]);
            let leaves = family.key.child(key::Place::Organ(Kind::Leaf as u8, 0).on(0));
            let mut words = self.random.stream(leaves, Purpose::Node);
            for (place, stem) in stems.stems[family.members.clone()].iter().enumerate() {
                let mut last = 0.0;
                for (nth, at) in (0..).zip(dealt.on(place)) {
                    let stand = Stand { stems, family, stem, plan: &plan, at };
                    let mut leaf = self.leaf(&stand, nth, &mut last, &mut words);
                    leaf.position = (year * plan.number + at.number) as u16;
                    writer.leaf(&leaf, size, area, span);
                }
            }
        }
        Ok(())
    }

    /// The leaves of a family.
    fn plan(&self, family: &Family) -> Plan {
        let tree = self.tree;
        Plan {
            number: leaves(leaves_on(family.level, tree.leaves.abs(), family.share, tree.quality)),
            fan: tree.leaves < 0.0,
            bare: bare(tree, self.drawn, family),
            above: tree.above_base,
            curve_res: tree.of(family.level).curve_res,
        }
    }

    /// Leaf `nth` of a stem; `last` is the turn of the leaf before it.
    fn leaf(&self, stand: &Stand<'_>, nth: u32, last: &mut f64, words: &mut Stream) -> LeafInPlace {
        let (tree, of) = (self.tree, self.tree.of_leaves());
        let Stand { stems, family, stem, plan, at } = *stand;
        let place = A_LEAF * u64::from(at.number);
        let ratio = (1.0 - at.share) / (1.0 - plan.bare);
        let down = down_angle_deg(of, ratio, signed(words, place));
        let varied = of.rotate_v * signed(words, place + 1);
        let fan = plan.fan.then(|| fan_deg(of.rotate, at.number, plan.number) + varied);
        if !plan.fan {
            *last = rotate_deg(of.rotate, of.rotate + varied, nth, *last);
        }
        let mut turn = leaving(*last, fan, down);
        if tree.leaf_bend > 0.0 {
            let (segment, point) = stems.point(family, stem, at.segment, at.within, plan.curve_res);
            let bent = bent(segment.frame.then(turn), point, tree.leaf_bend);
            turn = segment.frame.inverse().then(bent).normalized();
        }
        // As it stands without a bend: known from its angles, without a search for them.
        let (around, insertion) = match fan.is_none() && down >= 0.0 && tree.leaf_bend == 0.0 {
            true => (radians(*last + 180.0), radians(down)),
            false => standing(turn),
        };
        LeafInPlace {
            node: NodeId(stem.first.0 + at.segment - stem.before),
            position: 0,
            behind: (1.0 - at.within) * family.length / f64::from(plan.curve_res),
            turn,
            around,
            insertion,
        }
    }
}

/// The azimuth of a turned leaf around its stem from the upper side, and its angle to the stem, radians.
fn standing(turn: Rotation) -> (f64, f64) {
    let [along, left, up] = turn.turned(ALONG);
    (atan2(-left, up), atan2((left * left + up * up).sqrt(), along))
}

/// Where a leaf stands.
#[derive(Clone, Copy)]
struct Stand<'a> {
    stems: &'a Generation,
    family: &'a Family,
    stem: &'a Stem,
    plan: &'a Plan,
    at: &'a Place,
}

/// A leaf turned by the share `bend` towards the light (§4.9): first about the vertical, its normal outwards from the
/// trunk, then its normal upwards, about the horizontal across it.
///
/// The paper prints the last of its three turns as rotate_x; turned back by rotate_z, as the first of them asks for,
/// they are one turn about the horizontal across the normal. `leaf` and `at` are told in the frame of the ground. A
/// leaf whose normal is vertical has no direction to turn outwards.
pub(super) fn bent(leaf: Rotation, at: [f64; 3], bend: f64) -> Rotation {
    let [_, y, z] = leaf.turned(UP);
    let is_level = |y: f64, z: f64| y * y + z * z < 1e-18;
    let mut turned = leaf;
    if !is_level(y, z) && !is_level(at[1], at[2]) {
        let apart = atan2(at[2], at[1]) - atan2(z, y);
        let shortest = apart - 2.0 * PI * (apart / (2.0 * PI)).round();
        turned = Rotation::about(ALONG, bend * shortest).then(turned);
    }
    let [up, y, z] = turned.turned(UP);
    let phi = atan2((y * y + z * z).sqrt(), up);
    let across = if is_level(y, z) { turned.turned(ALONG) } else { [0.0, z, -y] };
    Rotation::about(across, bend * phi).then(turned).normalized()
}
