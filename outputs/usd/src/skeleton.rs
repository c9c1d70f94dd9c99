//! Where the points of the lines of a life are at a state of its course, and what is to come waits.
//!
//! A point that the line does not need yet lies on the line, as far from the point before it as it will be, at most at
//! the next one. An axis that is to come waits where it will stand on the line of its bearer, at most at the end of it,
//! so that it is carried along by a shoot that grows; an organ likewise. What is cut off goes as a whole, so the end of
//! a line of which something goes stays where it was until then.

use super::course::{Course, Span, State};
use glam::{Vec3, Vec4, Vec4Swizzles};
use phytomer_life::{Life, Line, Part, Point, between};
use std::collections::BTreeMap;
use std::ops::Range;

/// The lines of a life along its course.
#[derive(Debug)]
pub struct Skeleton<'a> {
    /// The life.
    pub life: &'a Life,
    course: &'a Course,
    /// Where each point waits before the line has it, and its radius there.
    waiting: Vec<Vec4>,
    /// Where each part waits before it is there.
    parts: Vec<Vec3>,
    lines_of_axis: BTreeMap<u32, Vec<usize>>,
    /// The parts among which those of each span are.
    windows: Vec<Range<usize>>,
}

impl<'a> Skeleton<'a> {
    /// The lines of a life.
    pub fn of(life: &'a Life, course: &'a Course) -> Self {
        let mut lines_of_axis: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (place, line) in life.lines.iter().enumerate() {
            lines_of_axis.entry(line.axis).or_default().push(place);
        }
        let (waiting, parts) = (vec![Vec4::ZERO; life.points.len()], vec![Vec3::ZERO; life.parts.len()]);
        let windows = (0..course.spans.len()).map(|span| window(life, course, span)).collect();
        let mut skeleton = Self { life, course, waiting, parts, lines_of_axis, windows };
        for span in 0..course.spans.len() {
            skeleton.let_wait(span);
        }
        skeleton
    }

    fn ages(&self) -> &'a [f32] {
        &self.life.ages
    }

    /// Whether a point is in the topology of a span.
    pub fn has_point(&self, span: usize, point: &Point) -> bool {
        self.course.has(span, self.ages(), (point.from, point.death))
    }

    /// Whether a part is in the topology of a span.
    pub fn has_part(&self, span: usize, part: &Part) -> bool {
        self.course.has(span, self.ages(), (part.from, part.death))
    }

    /// The parts of a span, with their places in the life.
    pub fn parts_of(&self, span: usize) -> impl Iterator<Item = (usize, &'a Part)> {
        let window = self.windows.get(span).cloned().unwrap_or_default();
        window.map(|place| (place, &self.life.parts[place])).filter(move |(_, part)| self.has_part(span, part))
    }

    /// The points of a line in a span, by their places in the life.
    pub fn members(&self, line: &Line, span: usize) -> impl Iterator<Item = usize> {
        line.points.clone().filter(move |place| self.has_point(span, &self.life.points[*place]))
    }

    /// Where a point of a span is at a state, and its radius.
    pub fn place(&self, place: usize, state: State, goes: bool) -> Vec4 {
        let point = &self.life.points[place];
        let Span { first, last } = self.course.spans[state.span];
        if point.from > self.ages()[state.age] {
            return self.waiting[place];
        }
        let stays = goes && point.tip && state.age == last && last > first;
        Vec4::from_array(between(self.life.places(point), self.ages()[state.age - usize::from(stays)]))
    }

    /// Whether something of a line goes at the end of a span, while its end stays.
    pub fn goes(&self, line: &Line, span: usize) -> bool {
        let end = self.ages()[self.course.spans[span].last];
        let points = &self.life.points[line.points.clone()];
        points.last().is_some_and(|tip| tip.death > end) && points.iter().any(|point| point.death == end)
    }

    /// Where a part waits before it is there.
    pub fn waits(&self, part: usize) -> [f32; 3] {
        self.parts[part].to_array()
    }

    /// Finds where what is to come in a span waits at the beginning.
    fn let_wait(&mut self, span: usize) {
        let Span { first, last } = self.course.spans[span];
        if first == last {
            return;
        }
        let (age, next) = (self.ages()[first], self.ages()[first + 1]);
        let life = self.life;
        for line in &life.lines {
            let members: Vec<usize> = self.members(line, span).collect();
            if members.iter().all(|place| life.points[*place].from <= age) {
                continue;
            }
            let at_next = |place: &usize| Vec4::from_array(between(life.places(&life.points[*place]), next));
            if members.iter().all(|place| life.points[*place].from > age) {
                let base = members.first().map_or(Vec4::ZERO, at_next).xyz();
                let root = line.bearer.map_or(base, |bearer| self.carried(bearer, base, State { span, age: first }));
                members.iter().for_each(|place| self.waiting[*place] = root.extend(0.0));
            } else {
                self.wait_along(&members, (age, next));
            }
        }
        let coming: Vec<(usize, &Part)> = self.parts_of(span).filter(|(_, part)| part.from > age).collect();
        for (place, part) in coming {
            let base = Vec3::from_array(life.pose_at(part, next).base);
            self.parts[place] = self.carried(part.axis, base, State { span, age: first });
        }
    }

    /// Lets the points of a line that are to come wait among those that are there.
    fn wait_along(&mut self, members: &[usize], (age, next): (f32, f32)) {
        let life = self.life;
        let at = |place: usize, age: f32| Vec4::from_array(between(life.places(&life.points[place]), age));
        let is_there = |place: &usize| life.points[*place].from <= age;
        let (mut before, mut gone): (Option<usize>, f32) = (None, 0.0);
        for (number, &place) in members.iter().enumerate() {
            if number > 0 {
                gone += (at(place, next) - at(members[number - 1], next)).xyz().length();
            }
            if is_there(&place) {
                (before, gone) = (Some(place), 0.0);
                continue;
            }
            let after = members[number..].iter().copied().find(is_there);
            let [from, to] = [before.or(after), after.or(before)].map(|end| end.map_or(Vec4::ZERO, |end| at(end, age)));
            let length = (to - from).xyz().length();
            let share = if length > 0.0 { (gone / length).min(1.0) } else { 1.0 };
            self.waiting[place] = from + share * (to - from);
        }
    }

    /// Where, at the first age of a span, the place of an axis is that is going to be nearest to another place.
    fn carried(&self, axis: u32, to: Vec3, state: State) -> Vec3 {
        let next = self.ages()[state.age + 1];
        let mut nearest = (f32::INFINITY, None);
        for &line in self.lines_of_axis.get(&axis).into_iter().flatten() {
            let mut along = 0.0;
            let mut last: Option<Vec3> = None;
            for place in self.members(&self.life.lines[line], state.span) {
                let at = Vec4::from_array(between(self.life.places(&self.life.points[place]), next)).xyz();
                let from = last.unwrap_or(at);
                let share = share_of(from, at, to);
                let apart = (from + share * (at - from) - to).length();
                if apart < nearest.0 {
                    nearest = (apart, Some((line, along + share * (at - from).length())));
                }
                along += (at - from).length();
                last = Some(at);
            }
        }
        nearest.1.map_or(to, |(line, along)| self.walked(line, along, state))
    }

    /// The place so far along a line at a state, at most its end.
    fn walked(&self, line: usize, mut along: f32, state: State) -> Vec3 {
        let mut last: Option<Vec3> = None;
        for place in self.members(&self.life.lines[line], state.span) {
            let at = self.place(place, state, false).xyz();
            if let Some(from) = last {
                let length = (at - from).length();
                if along <= length && length > 0.0 {
                    return from + along / length * (at - from);
                }
                along -= length;
            }
            last = Some(at);
        }
        last.unwrap_or(Vec3::ZERO)
    }
}

/// The parts of a life among which those of a span are. Parts mostly stand in the order in which they appear, and fall
/// in much the same order.
fn window(life: &Life, course: &Course, span: usize) -> Range<usize> {
    let Span { first, last } = course.spans[span];
    let (Some(first), Some(last)) = (life.ages.get(first), life.ages.get(last)) else { return 0..0 };
    let begin = life.parts.iter().position(|part| part.death > *first);
    let end = life.parts.iter().rposition(|part| part.from <= *last);
    begin.zip(end).map_or(0..0, |(begin, end)| begin..end + 1)
}

/// The share of a piece of a line at which it is nearest to a place.
fn share_of(from: Vec3, to: Vec3, place: Vec3) -> f32 {
    let along = to - from;
    let square = along.length_squared();
    if square > 0.0 { ((place - from).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 }
}
