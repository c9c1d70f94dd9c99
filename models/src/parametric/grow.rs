//! One tree, level by level (Weber & Penn 1995 §4): the trunk with its clones, then the children of each level, then
//! the leaves.
//!
//! The tree is made in its full size; `Writer` scales it to its age. Each family of stems is followed, pruned, written
//! into the plant and kept until its children have been made. Absent: equations (`equations`), leaves (`leaves`) and
//! columns (`write`).

use super::dealt::{Dealt, Place, Plan};
use super::drawn::{Drawn, bare};
use super::draws::{self, signed};
use super::equations::{children, down_angle_deg, fan_deg, rotate_deg, shape_ratio, stems};
use super::generation::{Family, Generation};
use super::leaves::Foliage;
use super::numbers::{Level, Numbers};
use super::path::{Base, Path, Splits, leaving};
use super::prune::pruned;
use super::radius::{branch_radius, flare, radius_at};
use super::sections::Sections;
use super::write::{Leaving, Writer};
use phytomer_sim::clock::Tick;
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::{AxisId, LineageKey, NodeId, Plant, key};
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use phytomer_sim::rotation::Rotation;

/// The length below which a stem is left out, metres: shapes 5 and 8 reach 0.
const LEAST_LENGTH: f64 = 1e-3;

/// A child at its place.
struct Child {
    key: LineageKey,
    level: u8,
    place: Place,
    stream: Stream,
    /// How it is turned in the frame of its parent, degrees.
    rotate: f64,
    /// In a fan: its turn about the y-axis of its parent.
    fan: Option<f64>,
}

/// A tree while it is made.
pub(super) struct Growth<'a> {
    pub tree: &'a Numbers,
    pub drawn: Drawn,
    pub writer: Writer<'a>,
    random: PlantRandom,
    path: Path,
    dealt: Dealt,
    splits: Splits,
    written: Vec<(AxisId, NodeId)>,
}

/// Writes the tree at an age into a plant that has nothing but the axis of its seed.
pub(super) fn grow(tree: &Numbers, sections: &Sections, plant: &mut Plant, age: Tick) -> Result<(), Overgrown> {
    let random = plant.random.clone();
    let drawn = Drawn::of(tree, &random);
    let writer = Writer::new(tree, sections, plant, age);
    let (path, dealt) = Default::default();
    let mut growth =
        Growth { tree, drawn, writer, random, path, dealt, splits: Splits::default(), written: Vec::new() };
    let (mut parents, mut born) = (Generation::default(), Generation::default());
    for level in (0..tree.levels).take_while(|level| tree.ages.births[usize::from(*level)] <= age) {
        growth.splits = Splits::default();
        born.clear();
        match level {
            0 => growth.trunk(&mut born)?,
            _ => growth.level(&parents, &mut born)?,
        }
        std::mem::swap(&mut parents, &mut born);
    }
    let foliage = Foliage::new(tree, drawn, &growth.random);
    for (nth, (birth, fall)) in tree.ages.generations(age).into_iter().enumerate() {
        foliage.grow(&parents, &mut growth.writer, &mut growth.dealt, nth as u32, (birth, fall))?;
    }
    Ok(())
}

impl Growth<'_> {
    fn trunk(&mut self, born: &mut Generation) -> Result<(), Overgrown> {
        let (tree, drawn) = (self.tree, self.drawn);
        let base = Base { key: LineageKey::SEED, level: 0, frame: Rotation::NONE };
        let whole = drawn.length * drawn.scale;
        let length = self.follow(&base, [0.0; 3], whole)?.max(LEAST_LENGTH);
        let family = Family {
            level: 0,
            key: base.key,
            length,
            radius: length * tree.ratio * drawn.radius,
            base: [0.0; 3],
            share: 0.0,
            ratio: [1.0, 1.0],
            members: 0..0,
        };
        self.add(family, None, born)
    }

    /// The stems that all families of a level bear.
    fn level(&mut self, parents: &Generation, born: &mut Generation) -> Result<(), Overgrown> {
        for parent in &parents.families {
            let of = *self.tree.of(parent.level + 1);
            let most = children(parent.level, of.branches.abs(), parent.ratio[0], parent.ratio[1], parent.share);
            let plan = Plan {
                number: stems(most),
                fan: of.branches < 0.0,
                bare: bare(self.tree, self.drawn, parent),
                above: self.tree.above_base,
                curve_res: self.tree.of(parent.level).curve_res,
            };
            let mut dealt = std::mem::take(&mut self.dealt);
            dealt.deal(&plan, &parents.stems[parent.members.clone()]);
            let done = self.children(parents, parent, &of, &plan, &dealt, born);
            self.dealt = dealt;
            done?;
        }
        Ok(())
    }

    /// The children of a family, stem by stem, each from the base to the tip. A clone goes on turning its children
    /// where its twin stood when they parted.
    fn children(
        &mut self,
        parents: &Generation,
        parent: &Family,
        of: &Level,
        plan: &Plan,
        dealt: &Dealt,
        born: &mut Generation,
    ) -> Result<(), Overgrown> {
        let members = &parents.stems[parent.members.clone()];
        let mut turned: Vec<Vec<(u32, f64)>> = Vec::with_capacity(members.len());
        for (place, stem) in members.iter().enumerate() {
            let (mut nth, mut last) = started(dealt, &turned, stem.twin as usize, stem.before, place);
            let mut trail = vec![(nth, last)];
            for at in dealt.on(place) {
                let key = parent.key.child(key::Place::Axillary(at.number as u16).on(0));
                let mut stream = self.random.stream(key, Purpose::Node);
                let varied = of.rotate_v * signed(&mut stream, draws::ROTATE);
                let fan = plan.fan.then(|| fan_deg(of.rotate, at.number, plan.number) + varied);
                let rotate = if plan.fan { 0.0 } else { rotate_deg(of.rotate, of.rotate + varied, nth, last) };
                (nth, last) = (nth + 1, rotate);
                trail.push((nth, last));
                let child = Child { key, level: parent.level + 1, place: *at, stream, rotate, fan };
                self.child(parents, parent, place, child, born)?;
            }
            turned.push(trail);
        }
        Ok(())
    }

    fn child(
        &mut self,
        parents: &Generation,
        parent: &Family,
        stem: usize,
        mut child: Child,
        born: &mut Generation,
    ) -> Result<(), Overgrown> {
        let (tree, of) = (self.tree, self.tree.of(child.level));
        let Place { share, segment, within, .. } = child.place;
        let ratio = (1.0 - share) / (1.0 - bare(tree, self.drawn, parent));
        let greatest = of.length + of.length_v * signed(&mut child.stream, draws::LENGTH);
        let whole = match parent.level {
            0 => parent.length * greatest * shape_ratio(tree.shape, ratio, &tree.envelope),
            _ => greatest * parent.length * (1.0 - 0.6 * share),
        };
        if whole < LEAST_LENGTH {
            return Ok(());
        }
        let down = down_angle_deg(of, ratio, signed(&mut child.stream, draws::DOWN_ANGLE));
        let curve_res = tree.of(parent.level).curve_res;
        let on = &parents.stems[parent.members.start + stem];
        let (bearing, point) = parents.point(parent, on, segment, within, curve_res);
        let turn = leaving(child.rotate, child.fan, down);
        let base = Base { key: child.key, level: child.level, frame: bearing.frame.then(turn).normalized() };
        let length = self.follow(&base, point, whole)?;
        if length < LEAST_LENGTH {
            return Ok(());
        }
        let there = radius_at(share, tree.of(parent.level).taper, parent.radius, parent.length);
        let there = if parent.level == 0 { there * flare(tree.flare, share) } else { there };
        let family = Family {
            level: child.level,
            key: child.key,
            length,
            radius: branch_radius(parent.radius, length / parent.length, tree.ratio_power, there),
            base: point,
            share,
            ratio: [length / parent.length, greatest],
            members: 0..0,
        };
        let behind = (1.0 - within) * parent.length / f64::from(curve_res);
        let (rank, on) = (segment - on.before, on.first);
        let position = child.place.number as u16;
        let turn = bearing.frame.inverse().then(self.path.segments[0].frame).normalized();
        let leaving = Leaving { bearer: NodeId(on.0 + rank), behind, turn, rotate: child.rotate, down, position };
        self.add(family, Some(leaving), born)
    }

    /// Follows a stem from its base, and returns its length after pruning.
    fn follow(&mut self, base: &Base, at: [f64; 3], whole: f64) -> Result<f64, Overgrown> {
        let res = self.tree.of(base.level).curve_res;
        self.path.follow(self.tree, base, &self.random, &mut self.splits, self.writer.room());
        self.writer.has_room_for(self.path.segments.len().max(self.path.members.len()) as u64)?;
        Ok(pruned(self.tree, &self.path, at, whole, self.drawn.scale, base.level == 0, res))
    }

    /// Writes a family whose path was followed last, and keeps it for its children.
    fn add(&mut self, family: Family, leaving: Option<Leaving>, born: &mut Generation) -> Result<(), Overgrown> {
        self.written.clear();
        self.writer.family(&family, &self.path, leaving, &mut self.written)?;
        let curve_res = self.tree.of(family.level).curve_res;
        born.add(family, &self.path, curve_res, &self.written);
        Ok(())
    }
}

/// How many children a stem has borne before its own first child, and how far the last of them was turned: of a clone
/// those of its twin below the split.
fn started(dealt: &Dealt, turned: &[Vec<(u32, f64)>], twin: usize, before: u32, place: usize) -> (u32, f64) {
    if twin == place {
        return (0, 0.0);
    }
    turned[twin][dealt.on(twin).partition_point(|place| place.segment < before)]
}
