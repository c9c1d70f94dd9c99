//! The forward scan of a plant at rest, whichever way its rest geometry is stated ([`super::rest`]).
//!
//! The unit of work is a run, the nodes that follow one another on one axis: base and directions stay in registers as
//! f64 and are rounded to f32 only where they are stored. An axis that grows on later continues from its
//! [`crate::plant::frames::Tip`], so that the frames are the same bits whether axes were grown one by one or tick by
//! tick. An axis starts from the stored f32 frame of its bearing node: 40 m from the seed the rounding is 2 µm, once an
//! order.

use super::bearing_frame;
use super::rest::{Course, Way, placed};
use crate::clock::Tick;
use crate::plant::frames::{Frames, LastInsertion};
use crate::plant::standing::begins_axis;
use crate::plant::{AxisId, Nodes, Plant};
use crate::vector::Vector;
use std::ops::Range;

/// Poses the nodes that appeared by `age` and have no frame yet, run by run. Those of a plant that grows by the clock
/// are the last in the columns: no others are looked at.
pub(super) fn follow<C: Course>(plant: &mut Plant, age: Tick) {
    let posed = plant.frames.begin(plant.nodes.len(), plant.axes.len(), age);
    let mut insertion = LastInsertion::default();
    let mut follow_run = |plant: &mut Plant, axis: AxisId, born: Range<usize>| {
        let birth = &plant.nodes.birth[born.clone()];
        let old = if birth[0] < posed { birth.partition_point(|&birth| birth < posed) } else { 0 };
        if old < born.len() {
            follow_axis::<C>(plant, axis, born.start + old..born.end, age, &mut insertion);
        }
    };
    let done = plant.frames.done.min(plant.nodes.len());
    if plant.nodes.birth[done..].iter().all(|birth| *birth <= age) {
        let first = plant.nodes.runs.partition_point(|first| first.index() <= done).saturating_sub(1);
        for run in first..plant.nodes.runs.len() {
            let run = plant.nodes.run(run);
            follow_run(plant, plant.nodes.axis[run.start], run);
        }
        plant.frames.done = plant.nodes.len();
        return;
    }
    let mut appeared = std::mem::take(&mut plant.appeared);
    for stretch in appeared.by(age, &plant.nodes) {
        follow_run(plant, stretch.axis, stretch.nodes());
    }
    plant.appeared = appeared;
}

#[inline]
fn follow_axis<C: Course>(
    plant: &mut Plant,
    axis: AxisId,
    run: Range<usize>,
    age: Tick,
    insertion: &mut LastInsertion,
) {
    let bearing = bearing_frame(plant, axis);
    let bearer = plant.axes.bearer[axis.index()].some();
    let length = bearer.map_or(0.0, |bearer| f64::from(plant.posed_length(bearer)));
    let Plant { axes, nodes, frames, habit, own_trends, stated, .. } = plant;
    let leaving = || insertion.leaving(axes.azimuth[axis.index()], axes.insertion[axis.index()]);
    let left = C::leaving([bearing.heading, bearing.up].map(Vector::from), length, leaving);
    let begins = begins_axis(nodes, run.start);
    let (base, course) = if begins {
        (Vector::from(bearing.base), left)
    } else {
        (frames.tips[axis.index()].base, C::resumed(frames, axis.index(), left))
    };
    let lengths = std::mem::take(&mut frames.lengths);
    let way = Way {
        axes,
        axis,
        trends: own_trends.of(axis).unwrap_or(&habit.trends),
        stated,
        lengths: if lengths.is_empty() { &nodes.length } else { &lengths },
        age,
    };
    let (base, course) = extend(frames, nodes, &way, (base, course), run, begins);
    frames.lengths = lengths;
    frames.tips[axis.index()].base = base;
    course.keep(frames, axis.index());
}

/// Writes the frames of a run that goes on from a base with a course.
#[inline]
fn extend<C: Course>(
    frames: &mut Frames,
    nodes: &Nodes,
    way: &Way<'_>,
    (mut base, mut course): (Vector, C),
    run: Range<usize>,
    mut begins: bool,
) -> (Vector, C) {
    let first = run.start;
    let [mut heading, up] = course.directions();
    let mut stored = (heading.single(), up.single());
    let columns = frames.base[run.clone()].iter_mut().zip(&mut frames.heading[run.clone()]);
    let columns = columns.zip(&mut frames.up[run.clone()]).zip(&way.lengths[run.clone()]);
    for (place, ((((at, along), up), &length), &trend)) in columns.zip(&nodes.trend[run]).enumerate() {
        if let Some(start) = course.start(way, first + place, begins) {
            base = base + placed(course.directions(), start);
        }
        if course.next(way, first + place, trend, begins) {
            let directions = course.directions();
            heading = directions[0];
            stored = (heading.single(), directions[1].single());
        }
        begins = false;
        *at = base.single();
        (*along, *up) = stored;
        base = base + heading * f64::from(length);
    }
    (base, course)
}
