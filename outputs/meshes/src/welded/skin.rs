//! The skin of limbs: points in closed lines around them, and triangles between the lines.
//!
//! A line is closed and its angles rise, so that the triangles between two lines are a merge of both. A ring with holes
//! is two lines that share what is between the holes. The border of a hole is the first line of the limb that stands in
//! it. Each edge has two triangles, and each limb is a disc that fills the hole of its bearer: all limbs together are a
//! sphere. Absent: vertices as files have them (`mod`).

use super::bands::{Row, turned};
use super::course::{Course, Station};
use super::foot::Foot;
use super::outline::Outline;
use glam::DVec3;
use phytomer_sim::math::sincos;
use phytomer_sim::plant::NodeId;
use std::f64::consts::TAU;

/// A radius below which a tip is a point, metres.
const POINT: f64 = 5e-5;
/// The part of a side of an outline that its corner keeps from a hole.
const CLEAR: f64 = 0.25;

/// A point of the skin.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    /// The place, metres.
    pub at: [f32; 3],
    /// The point at the same place that has the normal of all of them: itself, or an earlier one.
    pub one: u32,
    /// The angle around its limb, and the length along it, metres.
    pub angle: f32,
    /// The length along it.
    pub z: f32,
    /// The internode that it belongs to.
    pub node: NodeId,
}

/// A closed line around a limb: the numbers of its points, and their angles; the first point again at the end.
#[derive(Debug, Default)]
pub struct Line {
    points: Vec<u32>,
    angles: Vec<f64>,
}

impl Line {
    fn clear(&mut self) {
        self.points.clear();
        self.angles.clear();
    }

    /// Adds a point, whose angle is above that of the last.
    pub fn push(&mut self, point: u32, angle: f64) {
        self.points.push(point);
        self.angles.push(angle);
    }
}

/// The skin of all limbs.
#[derive(Debug, Default)]
pub struct Skin {
    /// Its points.
    pub points: Vec<Point>,
    /// Its triangles, counterclockwise from outside.
    pub faces: Vec<[u32; 3]>,
    /// The borders of holes by the limbs that stand in them.
    borders: Vec<Vec<u32>>,
    /// Whether a line begins and ends with a point of its own, so that a texture goes around it.
    seams: bool,
    lines: [Line; 3],
    holed: [Line; 2],
    cuts: Vec<[usize; 2]>,
}

impl Skin {
    /// No skin yet of so many limbs; with seams a texture goes around each limb.
    pub fn of(limbs: usize, seams: bool) -> Self {
        Self { borders: vec![Vec::new(); limbs], seams, ..Self::default() }
    }

    /// Adds a limb, whose bearer has been added before; `first` is the internode with which it begins.
    pub fn add(&mut self, limb: usize, course: &Course, rows: &[Row], feet: &[Foot], outlines: &[Outline]) {
        let [mut below, mut low, mut high] = std::mem::take(&mut self.lines);
        let border = std::mem::take(&mut self.borders[limb]);
        let mut is_open = border.is_empty();
        if !is_open {
            self.begin(border, course, &mut below);
        }
        for row in rows {
            match row {
                Row::Plain(place) => {
                    let station = &course.stations()[*place];
                    if *place + 1 == course.stations().len() && station.radius < POINT {
                        self.apex(station, &below);
                        (self.lines, is_open) = ([below, low, high], false);
                        debug_assert!(!is_open);
                        return;
                    }
                    let outline = &outlines[station.outline as usize];
                    self.ring(station, outline, &mut low);
                    if is_open && outline.is_lobed() {
                        self.fan(station, &low);
                    } else if is_open {
                        self.cap(&low, true)
                    } else {
                        join(&below, &low, &mut self.faces)
                    }
                    std::mem::swap(&mut below, &mut low);
                }
                Row::At(z) => {
                    self.ring_at(course, *z, outlines, &mut low);
                    join(&below, &low, &mut self.faces);
                    std::mem::swap(&mut below, &mut low);
                }
                Row::Feet(range) => {
                    self.holes(course, &feet[range.clone()], outlines, [&mut low, &mut high]);
                    join(&below, &low, &mut self.faces);
                    std::mem::swap(&mut below, &mut high);
                }
            }
            is_open = false;
        }
        self.cap(&below, false);
        self.lines = [below, low, high];
    }

    /// Makes the border of a hole the first line of a limb.
    fn begin(&mut self, border: Vec<u32>, course: &Course, line: &mut Line) {
        line.clear();
        let first = &course.stations()[0];
        let place = |point: u32| DVec3::from_array(self.points[point as usize].at.map(f64::from));
        let start = course.angle(first.z, place(border[0]) - first.at).unwrap_or(0.0);
        let count = border.len();
        let each = TAU / count as f64;
        let skip = (0..count).min_by(|a, b| {
            let from_zero = |k: usize| turned(0.0, start + each * k as f64).abs();
            from_zero(*a).total_cmp(&from_zero(*b))
        });
        let skip = skip.unwrap_or(0);
        let from = turned(0.0, start + each * skip as f64);
        for k in 0..count {
            let angle = from + each * k as f64;
            let mut point = border[(skip + k) % count];
            if self.seams {
                let Point { at, one, .. } = self.points[point as usize];
                point = self.point(Point { at, one, angle: angle as f32, z: first.z as f32, node: first.node });
            }
            line.push(point, angle);
        }
        self.close(line);
    }

    fn point(&mut self, point: Point) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    fn new_point(&mut self, at: DVec3, angle: f64, z: f64, node: NodeId) -> u32 {
        let one = self.points.len() as u32;
        self.point(Point { at: at.as_vec3().to_array(), one, angle: angle as f32, z: z as f32, node })
    }

    /// Ends a line with its first point, or with another one at the same place.
    pub fn close(&mut self, line: &mut Line) {
        let (first, angle) = (line.points[0], line.angles[0] + TAU);
        let last = if self.seams {
            let point = Point { angle: angle as f32, ..self.points[first as usize] };
            self.point(point)
        } else {
            first
        };
        line.push(last, angle);
    }

    /// Adds the triangles between two lines.
    pub fn join(&mut self, low: &Line, high: &Line) {
        join(low, high, &mut self.faces);
    }

    /// Makes a line of the ring of a station.
    pub fn ring(&mut self, station: &Station, outline: &Outline, line: &mut Line) {
        line.clear();
        let station = &station.at_least(POINT);
        for corner in outline.corners() {
            let at = station.corner(corner.turned, corner.reach);
            let point = self.new_point(at, corner.angle, station.z, station.node);
            line.push(point, corner.angle);
        }
        self.close(line);
    }

    /// A ring between two stations.
    fn ring_at(&mut self, course: &Course, z: f64, outlines: &[Outline], line: &mut Line) {
        line.clear();
        let station = course.below(z);
        for corner in outlines[station.outline as usize].corners() {
            let at = course.point(outlines, [corner.angle, z], corner.turned);
            let point = self.new_point(at, corner.angle, z, station.node);
            line.push(point, corner.angle);
        }
        self.close(line);
    }

    fn apex(&mut self, station: &Station, below: &Line) {
        let top = self.new_point(station.at, 0.0, station.z, station.node);
        let pairs = below.points.windows(2).map(|pair| [pair[0], pair[1], top]);
        self.faces.extend(pairs);
    }

    /// Closes the lower end of a limb around its middle.
    fn fan(&mut self, station: &Station, line: &Line) {
        let middle = self.new_point(station.at, 0.0, station.z, station.node);
        let pairs = line.points.windows(2).map(|pair| [pair[1], pair[0], middle]);
        self.faces.extend(pairs);
    }

    /// Closes the lower or the upper end of a limb.
    fn cap(&mut self, line: &Line, lower: bool) {
        let points = &line.points[..line.points.len() - 1];
        let fan = (2..points.len()).map(|k| {
            let [a, b] = if lower { [k, k - 1] } else { [k - 1, k] };
            [points[0], points[a], points[b]]
        });
        self.faces.extend(fan);
    }

    /// A ring with holes: the lines below and above them.
    fn holes(&mut self, course: &Course, feet: &[Foot], outlines: &[Outline], [low, high]: [&mut Line; 2]) {
        let [mut lower, mut upper] = std::mem::take(&mut self.holed);
        let mut cuts = std::mem::take(&mut self.cuts);
        lower.clear();
        upper.clear();
        cuts.clear();
        for (place, foot) in feet.iter().enumerate() {
            cuts.push([lower.points.len(), upper.points.len()]);
            self.border(course, foot, outlines, [&mut lower, &mut upper]);
            let next = feet.get(place + 1).unwrap_or(&feet[0]);
            let turn = if place + 1 < feet.len() { 0.0 } else { TAU };
            let (left, right) = (foot.angle + foot.border[foot.right()][0], next.angle + turn + next.border[0][0]);
            let [from, to] = [foot.z + foot.border[foot.right()][1], next.z + next.border[0][1]];
            let node = course.below(foot.z).node;
            self.gap(course, ([left, right], [from, to]), outlines, feet.len() == 1, &mut |skin, [angle, z], at| {
                let point = skin.new_point(at, angle, z, node);
                cuts.push([lower.points.len(), upper.points.len()]);
                lower.push(point, angle);
                upper.push(point, angle);
            });
        }
        let near = |cut: &[usize; 2]| turned(0.0, lower.angles[cut[0]]).abs();
        let start = cuts.iter().copied().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or([0; 2]);
        let from = turned(0.0, lower.angles[start[0]]);
        for (line, whole, start) in [(&mut *low, &lower, start[0]), (&mut *high, &upper, start[1])] {
            line.clear();
            let count = whole.points.len();
            let base = whole.angles[start];
            for k in 0..count {
                let at = (start + k) % count;
                let turn = if start + k < count { 0.0 } else { TAU };
                let angle = from + whole.angles[at] + turn - base;
                self.points[whole.points[at] as usize].angle = angle as f32;
                line.push(whole.points[at], angle);
            }
        }
        self.close(low);
        let (last, angle) = (low.points[low.points.len() - 1], low.angles[low.angles.len() - 1]);
        high.push(last, angle);
        (self.holed, self.cuts) = ([lower, upper], cuts);
    }

    /// The border of a hole: its lower and its upper edge, from the left corner to the right one.
    fn border(&mut self, course: &Course, foot: &Foot, outlines: &[Outline], [lower, upper]: [&mut Line; 2]) {
        let node = course.below(foot.z).node;
        let first = self.points.len() as u32;
        for [angle, along] in &foot.border {
            let (angle, z) = (foot.angle + angle, foot.z + along);
            let (sin, cos) = sincos(angle);
            self.new_point(course.point(outlines, [angle, z], [cos, sin]), angle, z, node);
        }
        let (count, right) = (foot.border.len(), foot.right());
        let angle = |k: usize| foot.angle + foot.border[k % count][0];
        (0..=right).for_each(|k| lower.push(first + k as u32, angle(k)));
        (right..=count).rev().for_each(|k| upper.push(first + (k % count) as u32, angle(k)));
        self.borders[foot.limb as usize] = (first..first + count as u32).collect();
    }

    /// Calls `put` with the points between two holes: the corners of the outline there, at least one where the limb has
    /// but one hole.
    fn gap(
        &mut self,
        course: &Course,
        ([left, right], [from, to]): ([f64; 2], [f64; 2]),
        outlines: &[Outline],
        alone: bool,
        put: &mut dyn FnMut(&mut Self, [f64; 2], DVec3),
    ) {
        let outline = &outlines[course.below(from).outline as usize];
        let count = outline.corners().len();
        let clear = CLEAR * TAU / count as f64;
        let mut put_at = |skin: &mut Self, angle: f64, [cos, sin]: [f64; 2]| {
            let z = from + (to - from) * ((angle - left) / (right - left)).clamp(0.0, 1.0);
            put(skin, [angle, z], course.point(outlines, [angle, z], [cos, sin]));
        };
        let turns = (left / TAU).floor() as i64;
        let mut none = true;
        for turn in turns..=turns + 2 {
            for corner in outline.corners() {
                let angle = corner.angle + TAU * turn as f64;
                if angle > left + clear && angle < right - clear {
                    put_at(self, angle, corner.turned);
                    none = false;
                }
            }
        }
        if none && alone {
            let angle = left.midpoint(right);
            let (sin, cos) = sincos(angle);
            put_at(self, angle, [cos, sin]);
        }
    }
}

/// Adds the triangles between two lines. The line goes on whose next edge has its middle at the smaller angle.
fn join(low: &Line, high: &Line, faces: &mut Vec<[u32; 3]>) {
    let [n, m] = [low, high].map(|line| line.points.len() - 1);
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        let lower = i < n && (j == m || low.angles[i] + low.angles[i + 1] <= high.angles[j] + high.angles[j + 1]);
        if lower {
            faces.push([low.points[i], low.points[i + 1], high.points[j]]);
            i += 1;
        } else {
            faces.push([low.points[i], high.points[j + 1], high.points[j]]);
            j += 1;
        }
    }
}
