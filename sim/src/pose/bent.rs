//! The forward scan of a plant that bends: the pose at rest, turned internode by internode by the curvature that
//! mechanics has written.
//!
//! Curvature is stated in the axes of the material at rest. With R the rotation that all internodes before have made and
//! w = L (κ₁ up + κ₂ heading × up) the turn of this one, all at rest, its chord stands where half of w has turned it,
//! R exp(w/2), and what it bears stands on R exp(w): second order in the length of internodes. The axes of the plant at
//! rest are followed as they would stand without load, so trends are felt at rest and carried along.

use super::course::{Plane, Slope};
use super::{Frame, ground_frame};
use crate::plant::borne::{Borne, Up};
use crate::plant::standing::{Run, Standing};
use crate::plant::{AxisId, Plant};
use crate::vector::Vector;

/// Where an axis goes on from: at rest, and as it stands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stance {
    plane: Plane,
    slope: Slope,
    base: Vector,
    turned: Rotation,
}

/// A rotation as a unit quaternion.
#[derive(Debug, Clone, Copy)]
struct Rotation {
    scalar: f64,
    vector: Vector,
}

impl Rotation {
    const NONE: Self = Self { scalar: 1.0, vector: Vector { x: 0.0, y: 0.0, z: 0.0 } };

    /// By the angle of the rotation vector `turn`, of which tan(θ/2) is taken as θ/2 + θ³/24: for a turn of 1 rad that is
    /// 0.002 rad short.
    #[inline]
    fn by(turn: Vector) -> Self {
        let square = turn.dot(turn);
        let vector = turn * (0.5 + square / 24.0);
        let scalar = 1.0 / (1.0 + vector.dot(vector)).sqrt();
        Self { scalar, vector: vector * scalar }
    }

    #[inline]
    fn then(self, inner: Self) -> Self {
        Self {
            scalar: self.scalar * inner.scalar - self.vector.dot(inner.vector),
            vector: inner.vector * self.scalar + self.vector * inner.scalar + self.vector.cross(inner.vector),
        }
    }

    #[inline]
    fn of(self, direction: Vector) -> Vector {
        let across = self.vector.cross(direction) * 2.0;
        direction + across * self.scalar + self.vector.cross(across)
    }
}

/// Poses every internode that stands, bent by the plant's curvature. `stances` is scratch, one entry an axis.
pub(crate) fn follow_bends(plant: &mut Plant, standing: &Standing, laterals: &Borne, stances: &mut Vec<Stance>) {
    let ground = Stance::from_rest(&ground_frame(plant.place), Vector::from(plant.place), Rotation::NONE);
    stances.clear();
    stances.resize(plant.axes.len(), ground);
    plant.frames.resize_nodes(plant.nodes.len());
    let bearers = std::mem::take(&mut plant.axes.bearer);
    let mut borne = Up::new(laterals, &bearers);
    for run in &standing.runs {
        if run.begins && bearers[run.axis.index()].some().is_none() {
            stances[run.axis.index()] = ground.leaving(plant, run.axis);
        }
        follow_run(plant, run, &mut borne, stances);
    }
    plant.axes.bearer = bearers;
}

#[inline]
fn follow_run(plant: &mut Plant, run: &Run, borne: &mut Up<'_>, stances: &mut [Stance]) {
    let mut stance = stances[run.axis.index()];
    let mut straight = run.begins;
    for node in run.nodes() {
        if !straight {
            let trends = plant.own_trends.of(run.axis).unwrap_or(&plant.habit.trends);
            if let Some(trend) = trends.get(usize::from(plant.nodes.trend[node])) {
                stance.slope = if trend.share > 0.0 { stance.slope.turned(trend) } else { stance.slope };
            }
        }
        straight = false;
        stance.extend(plant, node);
        while let Some(axis) = borne.on(node) {
            stances[axis] = stance.leaving(plant, AxisId(axis as u32));
        }
    }
    stances[run.axis.index()] = stance;
}

impl Stance {
    fn from_rest(rest: &Frame, base: Vector, turned: Rotation) -> Self {
        let (plane, slope) = Plane::of(rest);
        Self { plane, slope, base, turned }
    }

    /// Where `axis` starts, which leaves the internode that this stance has come to.
    fn leaving(&self, plant: &Plant, axis: AxisId) -> Self {
        let (heading, up) = (self.plane.heading(self.slope), self.plane.up(self.slope));
        let rest = Frame { base: [0.0; 3], heading: heading.single(), up: up.single() };
        let rest = rest.inserted(plant.axes.azimuth[axis.index()], plant.axes.insertion[axis.index()]);
        Self::from_rest(&rest, self.base, self.turned)
    }

    /// Writes the frame of the next internode and goes on to its tip.
    #[inline]
    fn extend(&mut self, plant: &mut Plant, node: usize) {
        let (heading, up) = (self.plane.heading(self.slope), self.plane.up(self.slope));
        let length = f64::from(plant.nodes.length[node]);
        let [about_up, about_side] = plant.strain.curvature[node].map(|curvature| f64::from(curvature) * length);
        let half = Rotation::by((up * about_up + heading.cross(up) * about_side) * 0.5);
        let middle = self.turned.then(half);
        let (heading, up) = (middle.of(heading), middle.of(up));
        plant.frames.base[node] = self.base.single();
        plant.frames.heading[node] = heading.single();
        plant.frames.up[node] = up.single();
        self.base = self.base + heading * length;
        self.turned = middle.then(half);
    }
}
