//! The lines of axes while a life is made: which samples of an axis are points, and how they move.
//!
//! A line has its first base and its end, which moves on from tip to tip as the axis grows, and between them the
//! samples that are needed at some age: a sample becomes a point at the first age at which the line of the other points
//! is farther from it than half of the tolerance, and stays one while its internode stands; the other half is that of
//! the keyframes. Points are known again by the numbers of their internodes, so an axis may be written anew at each
//! age, with internodes put in between. What comes back in another order is a new point.

use super::kept::{Kept, Keyed};
use super::lists::Blocks;
use super::still::Still;
use super::{Life, Line, Nearness, Point};
use phytomer_meshes::{Found, Keeping, Sample, Stems, Tolerance, fits, simplify};
use phytomer_sim::plant::{NodeId, Stretch};
use std::collections::BTreeMap;

const NONE: u32 = u32::MAX;

/// The lines of a plant, up to the last age that was shown.
#[derive(Debug, Clone, Default)]
pub struct Lines {
    lines: Vec<Growing>,
    points: Blocks<State>,
    /// The line of an axis by the number of its bud, and which of its lines it is.
    known: BTreeMap<(u32, u32), u32>,
    /// The point at the base and at the tip of each internode by its number.
    of_internode: Vec<[u32; 2]>,
    places: Kept<4>,
    tints: Kept<3>,
    still: Still,
    scratch: Scratch,
}

/// A line, with its points but for the end.
#[derive(Debug, Clone)]
struct Growing {
    axis: u32,
    bearer: Option<u32>,
    order: u8,
    points: Vec<u32>,
    end: u32,
    seen: f32,
    stands: bool,
}

/// A point.
#[derive(Debug, Clone)]
struct State {
    point: Point,
    line: u32,
    /// The place among the points of the line.
    rank: u32,
    /// Its tracks while it stands.
    moving: Option<Box<Moving>>,
}

/// A point that stands.
#[derive(Debug, Clone)]
struct Moving {
    seen: f32,
    /// Its internode, at the age at which it was last seen.
    node: NodeId,
    place: Keyed<4>,
    tint: Keyed<3>,
}

#[derive(Debug, Clone, Default)]
struct Scratch {
    /// The samples that are points, with the point where it is known.
    kept: Vec<(u32, u32)>,
    between: Vec<u32>,
    order: Vec<u32>,
}

/// What one age shows.
pub struct Showing<'a, 's> {
    pub stems: &'a Stems<'s>,
    pub age: f32,
    pub nearness: Nearness,
    pub lines: &'a mut Lines,
    /// The internodes that are in no line.
    pub apart: Vec<NodeId>,
    /// The axis of the last chain, and how many lines of it came before.
    pub last: (u32, u32),
}

impl Found for Showing<'_, '_> {
    fn chain(&mut self, samples: &[Sample], _: usize) {
        let Some(first) = samples.first() else { return };
        let plant = self.stems.plant();
        let axis = plant.nodes.axis[first.node.index()];
        let bud = plant.axes.component[axis.index()];
        let next = (bud, if self.last.0 == bud { self.last.1 + 1 } else { 0 });
        let bearer = plant.nodes.parent[first.node.index()].some().map(|node| plant.nodes.axis[node.index()]);
        let bearer = bearer.map(|bearer| plant.axes.component[bearer.index()]).filter(|bearer| *bearer != bud);
        let line;
        (line, self.last) = self.lines.line(next, bearer, plant.axes.order[axis.index()], self.age);
        self.lines.still.has_line(axis, line);
        self.choose(line, samples);
        self.begin_points(line, samples);
        self.put_in_order(line);
        self.take(line, samples);
    }

    fn apart(&mut self, node: NodeId) {
        self.lines.still.is_apart(self.stems.plant().nodes.axis[node.index()]);
        self.apart.push(node);
    }

    fn is_known(&mut self, axis: &[Stretch]) -> bool {
        let lines = self.lines.still.look(self.stems.plant(), axis, self.age);
        let known = lines.is_some();
        lines.into_iter().flatten().for_each(|line| self.hold(line));
        known
    }
}

impl Showing<'_, '_> {
    /// A line stands as it stood; its bark goes on to change its colour.
    fn hold(&mut self, line: u32) {
        let (age, colour) = (self.age, [self.nearness.colour; 3]);
        let Lines { lines, points, .. } = &mut *self.lines;
        let line = &mut lines[line as usize];
        (line.seen, line.stands) = (age, true);
        for &number in line.points.iter().chain([&line.end]) {
            if let Some(moving) = &mut points[number].moving {
                moving.seen = age;
                moving.place.hold(age);
                let tint = self.stems.colour(moving.node).map(f32::from);
                moving.tint.take((age, tint), &colour);
            }
        }
    }

    /// Half of the tolerance.
    fn half(&self) -> Tolerance {
        let Nearness { distance, share, .. } = self.nearness;
        Tolerance {
            distance: 0.5 * distance,
            share: 0.5 * share,
            colour: u8::MAX,
            keeps: Keeping::Section,
            organs: false,
        }
    }

    fn number(&self, sample: &Sample) -> usize {
        self.stems.plant().nodes.component[sample.node.index()] as usize
    }

    /// Finds the samples that are points, and those that become points.
    fn choose(&mut self, line: u32, samples: &[Sample]) {
        let mut scratch = std::mem::take(&mut self.lines.scratch);
        scratch.kept.clear();
        let last = samples.len() - 1;
        let mut rank = None;
        for (place, sample) in samples[..last].iter().enumerate() {
            let known =
                self.lines.of_internode.get(self.number(sample)).map_or(NONE, |ends| ends[usize::from(sample.end)]);
            let state = self.lines.points.get(known);
            let goes_on = state.filter(|state| {
                state.line == line && state.moving.is_some() && rank.is_none_or(|rank| rank < state.rank)
            });
            rank = goes_on.map(|state| state.rank).or(rank);
            if goes_on.is_some() || place == 0 {
                scratch.kept.push((place as u32, if goes_on.is_some() { known } else { NONE }));
            }
        }
        scratch.kept.push((last as u32, NONE));
        let tolerance = self.half();
        for gap in 1..scratch.kept.len() {
            let [from, to] = [gap - 1, gap].map(|k| scratch.kept[k].0 as usize);
            let samples = &samples[from..=to];
            if samples.len() > 2 && !fits(samples, &tolerance) {
                simplify(samples, &tolerance, &mut scratch.between);
                let inner = &scratch.between[1..scratch.between.len() - 1];
                scratch.kept.extend(inner.iter().map(|place| (from as u32 + place, NONE)));
            }
        }
        scratch.kept.sort_unstable_by_key(|(place, _)| *place);
        self.lines.scratch = scratch;
    }

    /// Begins the points that are new.
    fn begin_points(&mut self, line: u32, samples: &[Sample]) {
        let mut kept = std::mem::take(&mut self.lines.scratch.kept);
        if let Some(((last, tip), others)) = kept.split_last_mut() {
            for (place, point) in others.iter_mut().filter(|(_, point)| *point == NONE) {
                let sample = &samples[*place as usize];
                *point = self.begin(line, sample, false, sample.node);
                let number = self.number(sample);
                let numbers = &mut self.lines.of_internode;
                numbers.resize(numbers.len().max(number + 1), [NONE; 2]);
                numbers[number][usize::from(sample.end)] = *point;
            }
            let known = self.lines.lines[line as usize].end;
            *tip =
                if known == NONE { self.begin(line, &samples[*last as usize], true, samples[0].node) } else { known };
            self.lines.lines[line as usize].end = *tip;
        }
        self.lines.scratch.kept = kept;
    }

    fn begin(&mut self, line: u32, sample: &Sample, tip: bool, born: NodeId) -> u32 {
        let (plant, age) = (self.stems.plant(), self.age);
        let point = Point {
            component: plant.nodes.component[sample.node.index()],
            kind: plant.kind_of(sample.node),
            end: sample.end,
            tip,
            birth: plant.nodes.birth[born.index()] as f32,
            from: age,
            death: f32::INFINITY,
            places: 0..0,
            tints: 0..0,
        };
        let (place, tint) = (Keyed::begin((age, place_of(sample))), Keyed::begin((age, tint_of(sample))));
        let moving = Some(Box::new(Moving { seen: age, node: sample.node, place, tint }));
        self.lines.points.push(State { point, line, rank: NONE, moving })
    }

    /// Puts new points among those of the line; points that have ended keep their places.
    fn put_in_order(&mut self, line: u32) {
        let Lines { lines, points, scratch, .. } = &mut *self.lines;
        let Scratch { kept, order, .. } = scratch;
        let others = &kept[..kept.len() - 1];
        if others.iter().all(|(_, point)| points[*point].rank != NONE) {
            return;
        }
        order.clear();
        let old = &mut lines[line as usize].points;
        let mut next = 0;
        for (_, point) in others {
            let rank = points[*point].rank;
            if rank == NONE {
                order.push(*point);
            } else {
                order.extend_from_slice(&old[next..=rank as usize]);
                next = rank as usize + 1;
            }
        }
        order.extend_from_slice(&old[next..]);
        std::mem::swap(old, order);
        old.iter().enumerate().for_each(|(rank, point)| points[*point].rank = rank as u32);
    }

    /// Takes the places of the points at this age.
    fn take(&mut self, line: u32, samples: &[Sample]) {
        let half = self.half();
        // Within half of the tolerance in three coordinates together.
        let part = half.distance / 3.0_f32.sqrt();
        let colour = [self.nearness.colour; 3];
        let (plant, age) = (self.stems.plant(), self.age);
        let Lines { lines, points, scratch, .. } = &mut *self.lines;
        (lines[line as usize].seen, lines[line as usize].stands) = (age, true);
        for &(place, number) in &scratch.kept {
            let (sample, State { point, moving, .. }) = (&samples[place as usize], &mut points[number]);
            let Some(moving) = moving else { continue };
            (moving.seen, moving.node) = (age, sample.node);
            if point.tip {
                point.component = plant.nodes.component[sample.node.index()];
                point.kind = plant.kind_of(sample.node);
            }
            if point.from < age {
                let near = [part, part, part, half.of_radius(sample.radius)];
                moving.place.take((age, place_of(sample)), &near);
                moving.tint.take((age, tint_of(sample)), &colour);
            }
        }
    }
}

impl Lines {
    /// The line of an axis, which is begun where it does not stand: that of the key, or the next one that was not seen
    /// at this age, since what has gone from an axis may be shown beside what takes its place.
    fn line(&mut self, mut key: (u32, u32), bearer: Option<u32>, order: u8, age: f32) -> (u32, (u32, u32)) {
        let known = loop {
            let known = self.known.get(&key).copied().filter(|line| self.lines[*line as usize].stands);
            if known.is_none_or(|line| self.lines[line as usize].seen != age) {
                break known;
            }
            key.1 += 1;
        };
        if let Some(line) = known {
            return (line, key);
        }
        let line = self.lines.len() as u32;
        self.known.insert(key, line);
        self.lines.push(Growing {
            axis: key.0,
            bearer,
            order,
            points: Vec::new(),
            end: NONE,
            seen: f32::NAN,
            stands: true,
        });
        (line, key)
    }

    /// Ends the points that were not seen at an age.
    pub fn end_unseen(&mut self, age: f32) {
        let Self { lines, points, places, tints, .. } = self;
        for line in lines.iter_mut().filter(|line| line.stands) {
            line.stands = line.seen == age;
            for &number in line.points.iter().chain([&line.end]) {
                let state = &mut points[number];
                if state.moving.as_ref().is_some_and(|moving| moving.seen != age) {
                    state.end(age, (places, tints));
                }
            }
        }
    }

    /// Writes all lines into a life.
    pub fn finish(mut self, life: &mut Life) {
        let Self { lines, points, places, tints, .. } = &mut self;
        points.iter_mut().for_each(|state| state.end(f32::INFINITY, (places, tints)));
        life.points = Vec::with_capacity(points.len());
        for Growing { axis, bearer, order, points: own, end, .. } in std::mem::take(lines) {
            let start = life.points.len();
            life.points.extend(own.iter().chain([&end]).map(|number| points[*number].point.clone()));
            life.lines.push(Line { axis, bearer, order, points: start..life.points.len() });
        }
        (life.places, life.tints_of_points) = (self.places, self.tints);
    }
}

impl State {
    /// Ends a point that stands at an age; its keys have their places from then on.
    fn end(&mut self, age: f32, (places, tints): (&mut Kept<4>, &mut Kept<3>)) {
        if let Some(Moving { place, tint, .. }) = self.moving.take().map(|moving| *moving) {
            self.point.death = age;
            (self.point.places, self.point.tints) = (places.end(place), tints.end(tint));
        }
    }
}

fn place_of(sample: &Sample) -> [f32; 4] {
    let [x, y, z] = sample.at.to_array();
    [x, y, z, sample.radius]
}

fn tint_of(sample: &Sample) -> [f32; 3] {
    sample.colour.map(f32::from)
}
