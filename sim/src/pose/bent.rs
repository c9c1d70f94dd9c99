//! The forward scan of a plant that bends: the pose at rest, turned internode by internode by the curvature that
//! mechanics states.
//!
//! Curvature is stated in the axes of the material at rest. With R the rotation that all internodes before have made
//! and w = L (κ₁ up + κ₂ heading × up) the turn of this one, all at rest, its chord stands where half of w has turned
//! it, R exp(w/2), and what it bears stands on R exp(w): second order in the length of internodes. From chord to chord
//! half of one turn and half of the next are taken as one, exp((w + w')/2): the two axes nearly agree. The axes of the
//! plant at rest are followed as they would stand without load, so trends are felt at rest and carried along.

use super::course::{Plane, Slope};
use super::{Frame, GROUND};
use crate::math::sincos;
use crate::plant::borne::{Borne, Up};
use crate::plant::standing::{Run, Standing};
use crate::plant::{Axes, Plant, Trend};
use crate::vector::Vector;

/// The square of the turn from which on it is no longer small, rad².
const FAR: f64 = 0.25;

/// Who states the curvature, while the scan goes from the base to the tips. What it carries along an axis goes from
/// hand to hand by value, so that it stays in registers.
pub(crate) trait Curvature {
    /// What is carried along a run.
    type Carried: Copy;

    /// The scan comes to a run of `axis`, which was borne, or left, before.
    fn enter(&mut self, axis: usize) -> Self::Carried;

    /// The curvature of the next internode of that run, rad/m, which was of this length, heading and `up` before.
    fn next(
        &mut self,
        carried: Self::Carried,
        node: usize,
        length: f64,
        heading: [f32; 3],
        up: [f32; 3],
    ) -> (Self::Carried, [f32; 2]);

    /// The internode just asked for bears `axis`, or the run of `axis` is at its end.
    fn leave(&mut self, carried: Self::Carried, axis: usize);
}

/// Where an axis goes on from: at rest, and as it stands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stance {
    plane: Plane,
    slope: Slope,
    tip: Tip,
}

/// The end of an axis as it stands.
#[derive(Debug, Clone, Copy)]
struct Tip {
    base: Vector,
    /// At the middle of the internode that it has come to.
    turned: Rotation,
    /// The other half of that internode's turn, at rest.
    half: Vector,
}

/// A rotation as a unit quaternion.
#[derive(Debug, Clone, Copy)]
struct Rotation {
    scalar: f64,
    vector: Vector,
}

/// The columns that the scan walks along.
struct Columns<'a> {
    length: &'a [f32],
    trend: &'a [u8],
    base: &'a mut [[f32; 3]],
    heading: &'a mut [[f32; 3]],
    up: &'a mut [[f32; 3]],
}

impl Rotation {
    const NONE: Self = Self { scalar: 1.0, vector: Vector { x: 0.0, y: 0.0, z: 0.0 } };

    /// This, and then within it the rotation by a small vector w. Of tan(θ/2) θ/2 + θ³/24 is taken, and of the length
    /// of the product, which is √(1 + tan²(θ/2)), the first terms of its series: together they are 10⁻⁵ rad short for a
    /// turn of half a radian.
    #[inline]
    fn then(self, turn: Vector) -> Self {
        let square = turn.dot(turn);
        if square > FAR {
            return self.then_far(turn, square);
        }
        let vector = turn * (0.5 + square * (1.0 / 24.0));
        let t = vector.dot(vector);
        let shrink = 1.0 - t * (0.5 - t * (0.375 - t * 0.3125));
        self.within(shrink, vector * shrink)
    }

    /// The same for any turn.
    #[cold]
    fn then_far(self, turn: Vector, square: f64) -> Self {
        let angle = square.sqrt();
        let (sin, cos) = sincos(0.5 * angle);
        self.within(cos, turn * (sin / angle))
    }

    #[inline]
    fn within(self, scalar: f64, vector: Vector) -> Self {
        Self {
            scalar: self.scalar * scalar - self.vector.dot(vector),
            vector: vector * self.scalar + self.vector * scalar + self.vector.cross(vector),
        }
    }

    #[inline]
    fn of(self, direction: Vector) -> Vector {
        let across = self.vector.cross(direction) * 2.0;
        direction + across * self.scalar + self.vector.cross(across)
    }

    /// With its length, from which rounding has moved it, back at 1.
    fn normalized(self) -> Self {
        let scale = 1.0 / (self.scalar * self.scalar + self.vector.dot(self.vector)).sqrt();
        Self { scalar: self.scalar * scale, vector: self.vector * scale }
    }
}

/// Poses every internode that stands, bent by the curvature that is stated on the way. `stances` is scratch, one entry
/// an axis.
pub(crate) fn follow_bends(
    plant: &mut Plant,
    standing: &Standing,
    laterals: &Borne,
    stances: &mut Vec<Stance>,
    curvature: &mut impl Curvature,
) {
    let ground = Stance::from_rest(&GROUND, Vector::default(), Rotation::NONE);
    stances.clear();
    stances.resize(plant.axes.len(), ground);
    plant.frames.resize_nodes(plant.nodes.len());
    let Plant { axes, nodes, frames, habit, own_trends, .. } = plant;
    let mut borne = Up::new(laterals, &axes.bearer);
    let mut columns = Columns {
        length: &nodes.length,
        trend: &nodes.trend,
        base: &mut frames.base,
        heading: &mut frames.heading,
        up: &mut frames.up,
    };
    for run in &standing.runs {
        let axis = run.axis.index();
        if run.begins && axes.bearer[axis].some().is_none() {
            stances[axis] = ground.leaving(axes, axis);
        }
        let trends = own_trends.of(run.axis).unwrap_or(&habit.trends);
        follow_run(&mut columns, axes, trends, run, &mut borne, stances, curvature);
    }
}

#[inline]
fn follow_run(
    columns: &mut Columns<'_>,
    axes: &Axes,
    trends: &[Trend],
    run: &Run,
    borne: &mut Up<'_>,
    stances: &mut [Stance],
    curvature: &mut impl Curvature,
) {
    let axis = run.axis.index();
    let (Stance { plane, mut slope, mut tip }, mut carried) = (stances[axis], curvature.enter(axis));
    let mut straight = run.begins;
    for node in run.nodes() {
        let trend = trends.get(usize::from(columns.trend[node])).filter(|trend| trend.share > 0.0 && !straight);
        if let Some(trend) = trend {
            slope = slope.turned(trend);
        }
        straight = false;
        let length = f64::from(columns.length[node]);
        let curved;
        (carried, curved) = curvature.next(carried, node, length, columns.heading[node], columns.up[node]);
        let rest = [plane.heading(slope), plane.up(slope)];
        let frame;
        (tip, frame) = tip.extended(rest, length, curved);
        (columns.base[node], columns.heading[node], columns.up[node]) = (frame.base, frame.heading, frame.up);
        while let Some(lateral) = borne.on(node) {
            stances[lateral] = Stance { plane, slope, tip }.leaving(axes, lateral);
            curvature.leave(carried, lateral);
        }
    }
    stances[axis] = Stance { plane, slope, tip };
    curvature.leave(carried, axis);
}

impl Stance {
    fn from_rest(rest: &Frame, base: Vector, turned: Rotation) -> Self {
        let (plane, slope) = Plane::of(rest);
        Self { plane, slope, tip: Tip { base, turned, half: Vector::default() } }
    }

    /// Where `axis` starts, which leaves the internode that this stance has come to.
    fn leaving(self, axes: &Axes, axis: usize) -> Self {
        let (heading, up) = (self.plane.heading(self.slope), self.plane.up(self.slope));
        let rest = Frame { base: [0.0; 3], heading: heading.single(), up: up.single() };
        let rest = rest.inserted(axes.azimuth[axis], axes.insertion[axis]);
        Self::from_rest(&rest, self.tip.base, self.tip.turned.then(self.tip.half).normalized())
    }
}

impl Tip {
    /// At the tip of the next internode, whose heading and `up` at rest are given, and that internode's frame.
    #[inline]
    fn extended(self, [heading, up]: [Vector; 2], length: f64, curvature: [f32; 2]) -> (Self, Frame) {
        let curvature = |k: usize| 0.5 * f64::from(curvature[k]) * length;
        let half = up * curvature(0) + heading.cross(up) * curvature(1);
        let turned = self.turned.then(self.half + half);
        let (heading, up) = (turned.of(heading), turned.of(up));
        let frame = Frame { base: self.base.single(), heading: heading.single(), up: up.single() };
        (Self { base: self.base + heading * length, turned, half }, frame)
    }
}
