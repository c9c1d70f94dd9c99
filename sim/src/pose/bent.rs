//! The forward scan of a plant that bends: the pose at rest, turned internode by internode by its curvature.
//!
//! Curvature is stated in the axes of the material at rest. With R the rotation by all internodes before and w = L (κ₁
//! up + κ₂ heading × up) the turn of this internode, all at rest, its chord stands at R exp(w/2) and the frame at its
//! tip at R exp(w): second order in the length of internodes. From chord to chord half of one turn and half of the next
//! are combined as exp((w + w')/2), since the two axes nearly agree. The axes at rest are followed as they would stand
//! without load, so trends act at rest and are turned along.

use super::rest::{Course, Way};
use crate::clock::Tick;
use crate::plant::borne::{Borne, Up};
use crate::plant::frames::{Directions, Frame, LastInsertion, Plane, Stated, Trended};
use crate::plant::standing::{Run, Standing};
use crate::plant::{Axes, Plant};
use crate::rotation::Rotation;
use crate::vector::Vector;

/// The source of the curvature, called while the scan goes from the base to the tips. Its state along an axis is passed
/// and returned by value, so that it stays in registers.
pub(crate) trait Curvature {
    /// The state along a run.
    type Carried: Copy;

    /// Starts a run of `axis`; [`Curvature::leave`] was called for the axis before, at its bearer or at the end of its
    /// last run.
    fn enter(&mut self, axis: usize) -> Self::Carried;

    /// The curvature of the next internode of the run, rad/m. `node` had this length, heading and `up` before the step.
    fn next(
        &mut self,
        carried: Self::Carried,
        node: usize,
        length: f64,
        heading: [f32; 3],
        up: [f32; 3],
    ) -> (Self::Carried, [f32; 2]);

    /// The last internode bears `axis`, or the run of `axis` is at its end.
    fn leave(&mut self, carried: Self::Carried, axis: usize);
}

/// The end of an axis, from which it continues: at rest, and as it stands.
#[derive(Debug, Clone, Copy)]
struct Stance<C> {
    course: C,
    tip: Tip,
}

/// Scratch of the scan, one entry an axis; a plant fills the list of its own kind of course.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stances {
    trended: Vec<Stance<Trended>>,
    stated: Vec<Stance<Stated>>,
}

/// The end of an axis as it stands.
#[derive(Debug, Clone, Copy)]
struct Tip {
    base: Vector,
    /// The rotation at the middle of the last internode.
    turned: Rotation,
    /// The turn of the other half of that internode, at rest.
    half: Vector,
}

/// The columns that the scan walks along.
struct Columns<'a> {
    trend: &'a [u8],
    base: &'a mut [[f32; 3]],
    heading: &'a mut [[f32; 3]],
    up: &'a mut [[f32; 3]],
}

/// Poses every internode that stands at `age`, bent by the curvature that `curvature` returns on the way. Linear in the
/// internodes.
pub(crate) fn follow_bends(
    plant: &mut Plant,
    age: Tick,
    (standing, laterals): (&Standing, &Borne),
    stances: &mut Stances,
    curvature: &mut impl Curvature,
) {
    if plant.stated.is_empty() {
        follow(plant, age, (standing, laterals), &mut stances.trended, curvature);
    } else {
        follow(plant, age, (standing, laterals), &mut stances.stated, curvature);
    }
}

fn follow<C: Course>(
    plant: &mut Plant,
    age: Tick,
    (standing, laterals): (&Standing, &Borne),
    stances: &mut Vec<Stance<C>>,
    curvature: &mut impl Curvature,
) {
    plant.frames.bend(plant.nodes.len(), age);
    let Plant { axes, nodes, frames, habit, own_trends, stated, .. } = plant;
    if !axes.is_empty() {
        // What other plants left in it is written over before it is read: by the bearer of the axis, or below for an
        // axis without a bearer.
        stances.resize(axes.len(), ground_left(axes, 0));
    }
    let (mut borne, mut insertion) = (Up::new(laterals, &axes.bearer), LastInsertion::default());
    let lengths = std::mem::take(&mut frames.lengths);
    let mut columns =
        Columns { trend: &nodes.trend, base: &mut frames.base, heading: &mut frames.heading, up: &mut frames.up };
    for run in &standing.runs {
        let axis = run.axis.index();
        if run.begins && axes.bearer[axis].some().is_none() {
            stances[axis] = ground_left(axes, axis);
        }
        let way = Way {
            axes,
            axis: run.axis,
            trends: own_trends.of(run.axis).unwrap_or(&habit.trends),
            stated,
            lengths: if lengths.is_empty() { &nodes.length } else { &lengths },
            age,
        };
        follow_run(&mut columns, &way, run, (&mut borne, &mut insertion), stances, curvature);
    }
    frames.lengths = lengths;
}

#[inline]
fn follow_run<C: Course>(
    columns: &mut Columns<'_>,
    way: &Way<'_>,
    run: &Run,
    (borne, insertion): (&mut Up<'_>, &mut LastInsertion),
    stances: &mut [Stance<C>],
    curvature: &mut impl Curvature,
) {
    let axis = run.axis.index();
    // Part by part: a whole stance is longer than what is copied in registers.
    let (mut course, mut tip) = (stances[axis].course, stances[axis].tip);
    let mut carried = curvature.enter(axis);
    let mut begins = run.begins;
    for node in run.nodes() {
        if let Some(start) = course.start(way, node, begins) {
            tip = tip.beside(course.directions(), course.length(), start);
        }
        course.next(way, node, columns.trend[node], begins);
        begins = false;
        let length = f64::from(way.lengths[node]);
        let curved;
        (carried, curved) = curvature.next(carried, node, length, columns.heading[node], columns.up[node]);
        let frame;
        (tip, frame) = tip.extended(course.directions(), length, curved);
        (columns.base[node], columns.heading[node], columns.up[node]) = (frame.base, frame.heading, frame.up);
        while let Some(lateral) = borne.on(node) {
            let leaving = || insertion.leaving(way.axes.azimuth[lateral], way.axes.insertion[lateral]);
            let start = &mut stances[lateral];
            start.course = C::leaving(course.directions(), length, leaving);
            start.tip = if C::STATED { tip } else { tip.ended() };
            curvature.leave(carried, lateral);
        }
    }
    (stances[axis].course, stances[axis].tip) = (course, tip);
    curvature.leave(carried, axis);
}

/// The start of an axis without a bearer.
fn ground_left<C: Course>(axes: &Axes, axis: usize) -> Stance<C> {
    let tip = Tip { base: Vector::default(), turned: Rotation::NONE, half: Vector::default() };
    let (plane, slope) = Plane::of(&Frame::GROUND);
    let leaving = || LastInsertion::default().leaving(axes.azimuth[axis], axes.insertion[axis]);
    Stance { course: C::leaving([plane.heading(slope), plane.up(slope)], 0.0, leaving), tip }
}

impl Tip {
    /// The start at the end of the last internode, with the whole turn of that internode.
    #[inline]
    fn ended(self) -> Self {
        let turned = self.turned.by(self.half).normalized();
        Self { turned, half: Vector::default(), ..self }
    }

    /// The start beside the end of the last internode, with these directions at rest and this length, at an offset in
    /// its frame. A start on the internode itself lies on its chord, turned as far as the internode has turned there.
    fn beside(self, [heading, up]: Directions, length: f64, [x, y, z]: [f64; 3]) -> Self {
        let share = if length > 0.0 { (1.0 + x / length).clamp(0.0, 1.0) } else { 1.0 };
        let turned = self.turned.by(self.half * (2.0 * share - 1.0)).normalized();
        let along = if x < 0.0 { self.turned.of(heading) } else { turned.of(heading) };
        let across = turned.of(up.cross(heading) * y + up * z);
        Self { base: self.base + along * x + across, turned, half: Vector::default() }
    }

    /// Continues to the tip of the next internode, whose heading and `up` at rest are given. Returns the internode's
    /// frame as well.
    #[inline]
    fn extended(self, [heading, up]: Directions, length: f64, curvature: [f32; 2]) -> (Self, Frame) {
        let curvature = |k: usize| 0.5 * f64::from(curvature[k]) * length;
        let half = up * curvature(0) + heading.cross(up) * curvature(1);
        let turned = self.turned.by(self.half + half);
        let (heading, up) = (turned.of(heading), turned.of(up));
        let frame = Frame { base: self.base.single(), heading: heading.single(), up: up.single() };
        (Self { base: self.base + heading * length, turned, half }, frame)
    }
}
