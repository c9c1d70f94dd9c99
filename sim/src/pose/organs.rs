//! The frames of organs, which are asked for and never stored: on the node, by insertion and trend or as stated.
//!
//! Between two ticks an organ is on the way from its frame at the one to that at the other, and an organ that drops on
//! its way to the ground. The base lies on the line of the axis, at the node; a mesh moves it to the surface of the
//! stem.

use super::{course, node_frame, rest};
use crate::clock::Tick;
use crate::plant::placing::toward;
use crate::plant::{Frame, OrganId, Plant};
use crate::vector::Vector;
use std::f64::consts::TAU;

/// How far a leaf or a petal drifts while it drops, as a share of the height.
const DRIFT: f64 = 0.15;

/// How high above the ground an organ comes to lie, metres.
const LITTER_M: f64 = 0.002;

/// The pose at `age` of an organ on its node, which must have a frame: its insertion, turned by the habit's trend for
/// its kind as far as the ticks since its birth go, and twisted to face the sky where leaves do.
#[inline]
pub fn organ_frame(plant: &Plant, organ: OrganId, age: Tick) -> Frame {
    if let Some(stated) = stated_organ_frame(plant, organ) {
        return stated;
    }
    if let Some(share) = plant.partway() {
        return between(plant, organ, age, share);
    }
    let inserted = inserted(plant, organ);
    if plant.habit.organ_trends.is_empty() { inserted } else { turned(plant, organ, inserted, age) }
}

/// All that the pose of an organ and its size follow from, to be compared with that of another age.
pub type OrganInputs = [f32; 17];

/// What the pose of an organ and its size follow from at an age; `None` where organs state frames or forms, and between
/// two ticks, where more decides.
#[inline]
pub fn organ_follows_from(plant: &Plant, organ: OrganId, age: Tick) -> Option<OrganInputs> {
    let stated = !plant.stated_organs.keep_insertion() || !plant.stated_organs.have_forms();
    if stated || plant.partway().is_some() {
        return None;
    }
    let Plant { organs, nodes, axes, habit, frames, .. } = plant;
    let (share, organ) = (plant.expanded(organ, age), organ.index());
    let node = organs.node[organ];
    let turned = if habit.organ_trends.is_empty() {
        0.0
    } else {
        let order = axes.order[nodes.axis[node.index()].index()];
        let trend = habit.organ_trend(order, organs.kind[organ]);
        trend.map_or(0.0, |trend| trend.at(age.saturating_sub(organs.birth[organ])).share as f32)
    };
    let ([x, y, z], [u, v, w]) = (frames.base[node.index()], frames.heading[node.index()]);
    let [a, b, c] = frames.up[node.index()];
    let (azimuth, insertion) = (organs.azimuth[organ], organs.insertion[organ]);
    let (length, width) = (organs.length[organ], organs.width[organ]);
    let tip = nodes.diameter_tip[node.index()];
    Some([x, y, z, u, v, w, a, b, c, plant.posed_length(node), tip, azimuth, insertion, length, width, share, turned])
}

/// The frame of an organ by its insertion.
#[inline]
fn inserted(plant: &Plant, organ: OrganId) -> Frame {
    let (organs, organ) = (&plant.organs, organ.index());
    node_frame(plant, organs.node[organ]).inserted(organs.azimuth[organ], organs.insertion[organ])
}

/// The frame of an organ turned by the trend of its kind, as far as it has by `age`.
fn turned(plant: &Plant, organ: OrganId, inserted: Frame, age: Tick) -> Frame {
    let Plant { organs, nodes, axes, habit, .. } = plant;
    let organ = organ.index();
    let order = axes.order[nodes.axis[organs.node[organ].index()].index()];
    let kind = organs.kind[organ];
    let turned = match habit.organ_trend(order, kind) {
        Some(trend) => course::turned(inserted, &trend.at(age.saturating_sub(organs.birth[organ]))),
        None => inserted,
    };
    if habit.faces_the_sky(order, kind) { course::facing_the_sky(turned) } else { turned }
}

/// The frame of an organ between two ticks, where its place on its node is kept.
fn kept(plant: &Plant, organ: OrganId) -> Option<Frame> {
    let placed = plant.partway.as_ref()?.organs.get(organ.index())?;
    Some(placed.on(&node_frame(plant, plant.organs.node[organ.index()])))
}

/// The frame of an organ a share of the tick before `age`.
fn between(plant: &Plant, organ: OrganId, age: Tick, share: f32) -> Frame {
    let frame = kept(plant, organ).unwrap_or_else(|| {
        let inserted = inserted(plant, organ);
        if plant.habit.organ_trends.is_empty() {
            return inserted;
        }
        let [from, to] = [age - 1, age].map(|age| turned(plant, organ, inserted, age));
        if from == to { to } else { toward(&from, &to, f64::from(share)) }
    });
    dropped(plant, organ, frame)
}

/// The frame that an organ states: the same at all ages, at its own start.
#[inline]
pub fn stated_organ_frame(plant: &Plant, organ: OrganId) -> Option<Frame> {
    if plant.stated_organs.keep_insertion() {
        return None;
    }
    let (rotation, start) = plant.stated_organs.frame(organ)?;
    if let Some(kept) = kept(plant, organ) {
        return Some(dropped(plant, organ, kept));
    }
    let bearing = node_frame(plant, plant.organs.node[organ.index()]);
    let directions = [bearing.heading, bearing.up].map(Vector::from);
    let base = Vector::from(bearing.base) + rest::placed(directions, start.map(f64::from));
    let [heading, up] = rest::within(directions, rotation).map(Vector::single);
    Some(dropped(plant, organ, Frame { base: base.single(), heading, up }))
}

/// The frame of an organ that drops: it falls as far as it has dropped, drifts in a direction of its own and comes to
/// lie with its upper side to the sky, heading as it did. What grows below the ground does not drop.
fn dropped(plant: &Plant, organ: OrganId, frame: Frame) -> Frame {
    let share = f64::from(plant.dropped(organ));
    let height = f64::from(frame.base[2]) - LITTER_M;
    if share == 0.0 || height <= 0.0 {
        return frame;
    }
    // The time since it came loose, of the whole fall: it falls with the square of it.
    let time = share.sqrt();
    let number = plant.organs.component[organ.index()].wrapping_mul(2_654_435_761) >> 16;
    let (sin, cos) = crate::math::sincos(TAU * f64::from(number) / 65_536.0);
    let drift = DRIFT * height * time;
    let base = Vector::from(frame.base) + Vector::new(drift * cos, drift * sin, -height * share);
    let [x, y, _] = frame.heading;
    let level = (x * x + y * y).sqrt();
    let heading = if level > 1e-3 { [x / level, y / level, 0.0] } else { [cos as f32, sin as f32, 0.0] };
    let lying = Frame { base: frame.base, heading, up: [0.0, 0.0, 1.0] };
    Frame { base: base.single(), ..toward(&frame, &lying, time) }
}
