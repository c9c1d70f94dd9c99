//! The place on the lines of axes at which each line and each part begins: its host.
//!
//! What appears between two ages grows from its host, which the page moves with the line that bears it. A host is a
//! point of a line, and a share of the way from it to the next point that stands at that age: the place of the bearing
//! axis that is nearest to the base. Absent: how the page uses it (`states.js`).

use super::streams::{Last, Stream};
use phytomer_life::{Life, between};
use std::collections::BTreeMap;
use std::ops::Range;

/// The parts into which the way between two points is divided.
pub const SHARES: f32 = 255.0;
/// The points to either side of the last host that are looked at first, on a line of many.
const AROUND: usize = 64;

/// A place on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Host {
    /// The point before it, among those of the life.
    pub point: u32,
    /// The share of the way to the next point, in 255ths.
    pub share: u8,
    /// How far what it bears is from it, metres.
    far: f32,
}

/// The lines of a life by their axes.
#[derive(Debug)]
pub struct Hosts<'a> {
    life: &'a Life,
    of_axis: BTreeMap<u32, Vec<u32>>,
    near: f32,
    /// The point of the last host on each line.
    last: Vec<usize>,
}

impl<'a> Hosts<'a> {
    /// The hosts of a life within a distance, metres.
    pub fn of(life: &'a Life, near: f32) -> Self {
        let mut of_axis: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (number, line) in (0..).zip(&life.lines) {
            of_axis.entry(line.axis).or_default().push(number);
        }
        let last = life.lines.iter().map(|line| line.points.start).collect();
        Self { life, of_axis, near, last }
    }

    /// The host of what an axis bears and whose base is at a place when it appears, if a line of the axis stands then;
    /// lines from `before` on are none.
    pub fn find(&mut self, axis: u32, at: [f32; 3], age: f32, before: u32) -> Option<Host> {
        let lines = self.of_axis.get(&axis).cloned().unwrap_or_default();
        let found = lines.into_iter().filter(|line| *line < before).filter_map(|line| self.on(line, at, age));
        found.min_by(|a, b| a.far.total_cmp(&b.far))
    }

    /// The place of the point of a host when the point first stood.
    pub fn first_of(&self, host: Option<&Host>) -> Option<[f32; 3]> {
        let point = self.life.points.get(host?.point as usize)?;
        self.life.places(point).first().map(|(_, [x, y, z, _])| [*x, *y, *z])
    }

    fn on(&mut self, line: u32, at: [f32; 3], age: f32) -> Option<Host> {
        let points = self.life.lines[line as usize].points.clone();
        let last = self.last[line as usize];
        let around = last.saturating_sub(AROUND).max(points.start)..(last + AROUND).min(points.end);
        let mut found = self.among(around.clone(), at, age);
        if around != points && found.is_none_or(|found| found.far > self.near) {
            found = self.among(points, at, age);
        }
        if let Some(found) = found {
            self.last[line as usize] = found.point as usize;
        }
        found
    }

    /// The nearest place among some neighbouring points of a line.
    fn among(&self, points: Range<usize>, at: [f32; 3], age: f32) -> Option<Host> {
        let mut nearest: Option<Host> = None;
        let mut before: Option<(usize, [f32; 4])> = None;
        for number in points {
            let point = &self.life.points[number];
            if !point.stands(age) {
                continue;
            }
            let place = between(self.life.places(point), age);
            let (from, [start, end]) = before.map_or((number, [place; 2]), |(from, start)| (from, [start, place]));
            let (share, far) = nearest_share(start, end, at);
            if nearest.is_none_or(|nearest| far < nearest.far) {
                nearest = Some(Host { point: from as u32, share: (share * SHARES + 0.5) as u8, far });
            }
            before = Some((number, place));
        }
        nearest
    }
}

/// The share of the way between two places that is nearest to a third, and its distance from there.
fn nearest_share(start: [f32; 4], end: [f32; 4], at: [f32; 3]) -> (f32, f32) {
    let along: [f32; 3] = [0, 1, 2].map(|k| end[k] - start[k]);
    let seen: [f32; 3] = [0, 1, 2].map(|k| at[k] - start[k]);
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let square = dot(along, along);
    let share = if square > 0.0 { (dot(seen, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let off = [0, 1, 2].map(|k| seen[k] - share * along[k]);
    (share, dot(off, off).sqrt())
}

/// The streams of hosts: the point, counted from 1, as the difference to the one before, and the share; 0 for none.
#[derive(Debug, Default)]
pub struct HostStreams {
    last: Last,
    /// The points.
    pub points: Stream,
    /// The shares.
    pub shares: Stream,
}

impl HostStreams {
    /// Adds a host.
    pub fn put(&mut self, host: Option<&Host>) {
        self.points.put(self.last.step(host.map_or(0, |host| i64::from(host.point) + 1)));
        if let Some(host) = host {
            self.shares.put(i64::from(host.share));
        }
    }
}
