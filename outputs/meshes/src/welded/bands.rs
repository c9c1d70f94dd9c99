//! Which rings a limb has, and which of them have holes: the feet of other limbs.
//!
//! Feet that are near one another along a limb share one ring where they are apart around it. In a ring the feet are
//! moved and narrowed until they are apart, so that the ring is two closed lines around the limb, one below its holes
//! and one above, in which angles rise: how the skin hangs together does not depend on lengths or roundings. Stations
//! that lie between the lower and the upper line of a ring are left out. Absent: vertices and triangles (`skin`).

use super::course::Course;
use super::foot::Foot;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// The least angle between two feet of a ring.
const APART: f64 = 0.04;
/// The most feet of a ring.
const MOST: usize = 64;
/// The share of a limb that stays free of feet at either end.
const FREE: f64 = 0.02;
/// Feet at one side of a limb share a ring, where their middles are nearer to one another than this share of what they
/// reach towards each other.
const ONE_PLACE: f64 = 0.25;

/// How far from what feet cover a ring at its edge is, in parts of what is free there.
const EDGE: f64 = 0.02;
/// How far a station that is left out may lie off the skin, in radii.
const STRAIGHT: f64 = 0.02;

/// A ring of a limb.
#[derive(Debug, Clone)]
pub enum Row {
    /// A station, by its place.
    Plain(usize),
    /// Between two stations, by the length along the limb.
    At(f64),
    /// Feet, by their places, in the order of their angles.
    Feet(Range<usize>),
}

/// The rings of a limb from base to tip; puts the feet, which are those on this limb, in the order of the rings.
pub fn rows(course: &Course, feet: &mut [Foot]) -> Vec<Row> {
    let last = course.stations().len() - 1;
    if feet.is_empty() {
        return (0..=last).map(Row::Plain).collect();
    }
    let [base, tip] = course.ends();
    let free = FREE * (tip - base);
    for foot in feet.iter_mut() {
        foot.z = foot.z.clamp(base + 2.0 * free, tip - 2.0 * free);
        fit(foot, [base + free - foot.z, tip - free - foot.z]);
    }
    feet.sort_by(|one, other| one.z.total_cmp(&other.z).then(one.limb.cmp(&other.limb)));
    let groups = grouped(feet);
    for pair in groups.windows(2) {
        let (lower, upper) = feet[pair[0].start..pair[1].end].split_at_mut(pair[0].len());
        part(lower, upper);
    }
    groups.iter().for_each(|group| pack(&mut feet[group.clone()]));
    between(course, feet, groups)
}

/// Lets the border of a foot reach no farther below and above its middle.
fn fit(foot: &mut Foot, [below, above]: [f64; 2]) {
    let [low, high] = foot.extent();
    let share = |room: f64, reach: f64| if reach.abs() > room.abs() { (room / reach).abs() } else { 1.0 };
    let [down, up] = [share(below, low), share(above, high)];
    foot.border.iter_mut().for_each(|[_, along]| *along *= if *along < 0.0 { down } else { up });
}

/// Whether two feet meet or cross around their bearer.
fn meet(one: &Foot, other: &Foot) -> bool {
    let turned = (one.angle - other.angle).rem_euclid(TAU);
    turned.min(TAU - turned) < one.half() + other.half() + APART
}

/// The feet in groups, each of which shares a ring.
fn grouped(feet: &[Foot]) -> Vec<Range<usize>> {
    let (mut groups, mut start, mut high) = (Vec::new(), 0, f64::NEG_INFINITY);
    for (place, foot) in feet.iter().enumerate() {
        let [low, up] = foot.extent();
        let of_one_place = |other: &Foot| foot.z - other.z < ONE_PLACE * (other.extent()[1] - low);
        let shares = foot.z + low < high
            && place - start < MOST
            && feet[start..place].iter().all(|other| !meet(foot, other) || of_one_place(other));
        if place > start && !shares {
            groups.push(start..place);
            (start, high) = (place, f64::NEG_INFINITY);
        }
        high = high.max(foot.z + up);
    }
    groups.push(start..feet.len());
    groups
}

/// Lets feet of neighbouring rings that meet around their bearer end halfway between their middles.
fn part(lower: &mut [Foot], upper: &mut [Foot]) {
    for one in lower {
        for other in upper.iter_mut() {
            if !meet(one, other) {
                continue;
            }
            let half = 0.45 * (other.z - one.z).max(0.0);
            let [[low, _], [_, high]] = [one.extent(), other.extent()];
            fit(one, [low, half]);
            fit(other, [-half, high]);
        }
    }
}

/// Moves and narrows the feet of a ring until they are apart, and puts them in the order of their angles.
fn pack(feet: &mut [Foot]) {
    feet.iter_mut().for_each(|foot| foot.angle = foot.angle.rem_euclid(TAU));
    feet.sort_by(|one, other| one.angle.total_cmp(&other.angle).then(one.limb.cmp(&other.limb)));
    let count = feet.len();
    if count == 1 {
        return;
    }
    let gap = APART.min(0.5 * TAU / count as f64);
    let wanted: f64 = feet.iter().map(|foot| 2.0 * foot.half()).sum();
    let room = 0.95 * (TAU - gap * count as f64);
    if wanted > room {
        feet.iter_mut().flat_map(|foot| &mut foot.border).for_each(|[angle, _]| *angle *= room / wanted);
    }
    // Beginning after the widest gap, each is moved on as far as the one before it asks.
    let free = |feet: &[Foot], k: usize| {
        let before = (k + count - 1) % count;
        (feet[k].angle - feet[before].angle).rem_euclid(TAU) - feet[k].half() - feet[before].half()
    };
    let first = (0..count).max_by(|a, b| free(feet, *a).total_cmp(&free(feet, *b)).then(b.cmp(a))).unwrap_or(0);
    feet.rotate_left(first);
    let turn = feet[0].angle;
    feet.iter_mut().for_each(|foot| foot.angle = turn + (foot.angle - turn).rem_euclid(TAU));
    let mut moved = Vec::with_capacity(count);
    for foot in feet.iter() {
        let least =
            moved.last().map_or(f64::NEG_INFINITY, |(angle, half): &(f64, f64)| angle + half + foot.half() + gap);
        moved.push((foot.angle.max(least), foot.half()));
    }
    let over = moved[count - 1].0 + moved[count - 1].1 + gap - (moved[0].0 - moved[0].1 + TAU);
    if over > 0.0 {
        // They fill the whole ring: one after another, with equal gaps.
        let filled: f64 = feet.iter().map(|foot| 2.0 * foot.half()).sum();
        let (each, mut at) = ((TAU - filled) / count as f64, turn - feet[0].half());
        for (place, foot) in moved.iter_mut().zip(feet.iter()) {
            *place = (at + foot.half(), foot.half());
            at += 2.0 * foot.half() + each;
        }
    } else {
        // Half of what the moves made is taken back, so that a pair parts to both sides.
        let shift = feet.iter().zip(&moved).map(|(foot, (angle, _))| angle - foot.angle).sum::<f64>() / count as f64;
        moved.iter_mut().for_each(|(angle, _)| *angle -= shift);
    }
    feet.iter_mut().zip(moved).for_each(|(foot, (angle, _))| foot.angle = angle);
}

/// The stations that no ring with feet covers, and these rings, from base to tip.
fn between(course: &Course, feet: &[Foot], groups: Vec<Range<usize>>) -> Vec<Row> {
    let middle = |group: &Range<usize>| feet[group.clone()].iter().map(|foot| foot.z).sum::<f64>() / group.len() as f64;
    let reach = |group: &Range<usize>, side: usize| {
        let ends = feet[group.clone()].iter().map(|foot| foot.z + foot.extent()[side]);
        if side == 0 { ends.fold(f64::INFINITY, f64::min) } else { ends.fold(f64::NEG_INFINITY, f64::max) }
    };
    // Below each group, the lowest that it or a later one reaches.
    let mut lowest: Vec<f64> = groups.iter().map(|group| reach(group, 0)).collect();
    (0..lowest.len().saturating_sub(1)).rev().for_each(|k| lowest[k] = lowest[k].min(lowest[k + 1]));
    let stations = course.stations();
    let last = stations.len() - 1;
    let mut sought =
        Sought { course, rows: vec![Row::Plain(0)], station: 1, last: Ring::at(stations[0].z, stations[0].radius) };
    let mut covered = f64::NEG_INFINITY;
    for (group, lowest) in groups.into_iter().zip(lowest) {
        let (z, edges) = (middle(&group), [0, 1].map(|side| reach(&group, side)));
        let next = Ring { z, radii: edges.map(|edge| course.radius(edge)) };
        sought.until(next, [covered, lowest]);
        sought.rows.push(Row::Feet(group));
        sought.last = next;
        covered = covered.max(edges[1]);
    }
    sought.until(Ring::at(stations[last].z, stations[last].radius), [covered, f64::INFINITY]);
    sought.rows.push(Row::Plain(last));
    sought.rows
}

/// A ring: the length along the limb, and the radii at its lower and its upper edge.
#[derive(Debug, Clone, Copy)]
struct Ring {
    z: f64,
    radii: [f64; 2],
}

impl Ring {
    fn at(z: f64, radius: f64) -> Self {
        Self { z, radii: [radius; 2] }
    }
}

/// The rings that have been found, from base to tip.
struct Sought<'c> {
    course: &'c Course,
    rows: Vec<Row>,
    /// The next station.
    station: usize,
    last: Ring,
}

impl Sought<'_> {
    /// Adds the stations up to the next ring, but those up to `from` and from `to` on, which feet cover. Where the limb
    /// bends or steps at what is covered, the edge of it gets a ring.
    fn until(&mut self, next: Ring, [from, to]: [f64; 2]) {
        let stations = self.course.stations();
        let count = |z: f64| stations[self.station..stations.len() - 1].partition_point(|station| station.z <= z);
        let [begin, end, stop] = [from, to.next_down(), next.z].map(|z| self.station + count(z));
        let kept = begin.min(stop)..end.min(stop).max(begin.min(stop));
        self.station = stop;
        let above = stations[kept.clone()].first().map_or(next, |station| Ring::at(station.z, station.radius));
        self.edge(from + EDGE * (above.z - from), from, above);
        for place in kept {
            self.rows.push(Row::Plain(place));
            self.last = Ring::at(stations[place].z, stations[place].radius);
        }
        self.edge(to - EDGE * (to - self.last.z), to, next);
    }

    /// Adds a ring at a length beside an edge of what feet cover, where the skin would else be off between the last
    /// ring and the next.
    fn edge(&mut self, z: f64, edge: f64, next: Ring) {
        if edge <= self.last.z || edge >= next.z || !edge.is_finite() || !self.is_off(edge, next) {
            return;
        }
        self.rows.push(Row::At(z));
        self.last = Ring::at(z, self.course.radius(z));
    }

    /// Whether the limb at a length is off the straight skin between the last ring and the next.
    fn is_off(&self, z: f64, next: Ring) -> bool {
        let share = (z - self.last.z) / (next.z - self.last.z);
        let radius = self.course.radius(z);
        let line = self.course.line(self.last.z).lerp(self.course.line(next.z), share);
        let apart: f64 = (self.course.line(z) - line).length();
        let off = |low: f64, high: f64| (low + share * (high - low) - radius).abs();
        let radii = self.last.radii.iter().flat_map(|low| next.radii.map(|high| off(*low, high)));
        apart + radii.fold(0.0, f64::max) > STRAIGHT * radius
    }
}

/// The angle from one to another, from −π to π.
pub fn turned(from: f64, to: f64) -> f64 {
    (to - from + PI).rem_euclid(TAU) - PI
}
