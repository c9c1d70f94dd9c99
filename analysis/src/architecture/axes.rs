//! The axes of one recorded plant, put together from the rows of `components`: which axis bears which, with its nodes
//! and flowers.
//!
//! Axes whose internodes are of leaves, inflorescences or flowers are organs and not branches. A reiterate repeats the
//! plant's own model on the plant and tells nothing new of it (Hallé, Oldeman & Tomlinson 1978), so reiterates and all
//! that they bear are left out. An axis of order 1 from the base of another axis of order 1 is a basal shoot, as in
//! Tomlinson's and McClure's models, and is kept. Absent: the qualifiers of the models (`models`).

use super::tolerance::PLAGIOTROPIC_DEG;
use phytomer_outputs::rows::ComponentRow;
use phytomer_sim::Tick;
use phytomer_sim::plant::{Cause, Class, Kind, Origin, PartOfPlant};
use std::collections::BTreeMap;

/// The share of the nodes of an axis, from below, that count as its base; at least [`LEAST_BASE`] nodes do.
const BASE_SHARE: f64 = 0.2;
const LEAST_BASE: u32 = 5;

/// One internode.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// The rank of the internode in its growth unit, from 1.
    pub unit_rank: u32,
    /// The inclination of the axis's trend at this internode, degrees from the upward vertical.
    pub trend: Option<f32>,
}

/// The part that an axis has in the architecture of the plant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The axis belongs to the plant's own architecture.
    Own,
    /// The axis arose from the base of another trunk.
    Basal,
    /// The axis is a reiterate, or is borne by a reiterate.
    Reiterate,
    /// The axis is a leaf, an inflorescence or a part of an inflorescence, drawn as an axis.
    Organ,
}

/// One axis of a plant.
#[derive(Debug, Clone)]
pub struct Axis {
    /// The component number of its apical bud.
    pub id: u32,
    /// Its order, from 1 for the trunk.
    pub order: u32,
    /// From which kind of bud or event the axis arose.
    pub origin: Origin,
    /// Its part in the architecture of the plant.
    pub role: Role,
    /// The index in the list of the axis that bears it.
    pub bearing: Option<usize>,
    /// The rank of the node that bears it.
    pub bearer_rank: u32,
    /// The age of the plant at which its bud appeared.
    pub birth: Tick,
    /// The age of the plant at which its apex ended, and the cause.
    pub end: Option<(Tick, Cause)>,
    /// The age of the plant at which its wood fell.
    pub shed: Option<Tick>,
    /// Its internodes by rank.
    pub nodes: Vec<Node>,
    /// The number of flowers and inflorescences on its sides.
    pub lateral_flowers: u32,
    /// Whether the axis became an inflorescence, or an inflorescence took the place of its apex.
    pub blooms: bool,
    /// The kind of its first internode.
    kind: Kind,
    /// The indices in the list of the axes that it bears.
    pub bears: Vec<usize>,
}

impl Axis {
    /// Whether the qualifiers look at the axis: it is the plant's own, or a basal shoot.
    pub fn is_judged(&self) -> bool {
        matches!(self.role, Role::Own | Role::Basal)
    }

    /// Whether its apex became a flower.
    pub fn flowered(&self) -> bool {
        self.blooms || self.end.is_some_and(|(_, cause)| cause == Cause::Flowered)
    }

    /// Whether its apex ended as its architecture has it: by a flower, or after the last of its growth units.
    pub fn finished(&self) -> bool {
        self.flowered() || self.end.is_some_and(|(_, cause)| cause == Cause::Completed)
    }

    /// Whether its apex was still alive after `age`.
    pub fn lives_past(&self, age: Tick) -> bool {
        self.end.is_none_or(|(end, _)| end > age)
    }

    /// The inclination of its trend at its first internode, degrees from the upward vertical.
    pub fn first_trend(&self) -> Option<f32> {
        self.nodes.first().and_then(|node| node.trend)
    }

    /// The inclination of its trend at its last internode, degrees from the upward vertical.
    pub fn last_trend(&self) -> Option<f32> {
        self.nodes.last().and_then(|node| node.trend)
    }
}

/// Whether a trend at this angle to the upward vertical, in degrees, is plagiotropic.
pub fn is_plagiotropic(trend_deg: f32) -> bool {
    trend_deg > PLAGIOTROPIC_DEG
}

/// The axes of one plant in the order of their numbers, from its rows of `components`. Axes that are still buds are
/// included. A bearing axis comes before the axes that it bears. Takes O(n log a) for n rows and a axes.
pub fn axes_of(rows: &[ComponentRow]) -> Vec<Axis> {
    let mut axes: BTreeMap<u32, Axis> = BTreeMap::new();
    let mut bearing: BTreeMap<u32, u32> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.kind == Kind::ApicalBud) {
        axes.insert(row.axis_id, begun(row));
        bearing.extend(row.bearing_axis_id.map(|bearer| (row.axis_id, bearer)));
    }
    for row in rows {
        if let Some(axis) = axes.get_mut(&row.axis_id) {
            add(axis, row);
        }
    }
    let places: BTreeMap<u32, usize> = axes.keys().copied().zip(0..).collect();
    let mut axes: Vec<Axis> = axes.into_values().collect();
    for place in 0..axes.len() {
        axes[place].bearing = bearing.get(&axes[place].id).and_then(|bearer| places.get(bearer)).copied();
        axes[place].role = role(&axes, place);
        if let Some(bearing) = axes[place].bearing {
            attach(&mut axes, place, bearing);
        }
    }
    axes
}

/// Enters an axis at the axis that bears it. An inflorescence that is an axis counts there as a flower.
fn attach(axes: &mut [Axis], place: usize, bearing: usize) {
    let Axis { role, origin, kind, .. } = axes[place];
    match role {
        Role::Organ if !is_of_flower(kind) || axes[bearing].role == Role::Organ => {}
        Role::Organ if matches!(origin, Origin::Relay | Origin::Fork) => axes[bearing].blooms = true,
        Role::Organ => axes[bearing].lateral_flowers += 1,
        _ => axes[bearing].bears.push(place),
    }
}

/// Whether an axis of internodes of this kind is a flower, an inflorescence or a part of an inflorescence.
fn is_of_flower(kind: Kind) -> bool {
    kind.class() == Class::Internode && kind.part() == PartOfPlant::Flower
}

/// Whether an axis of internodes of this kind is a leaf or a part of a leaf.
fn is_of_leaf(kind: Kind) -> bool {
    kind.class() == Class::Internode && kind.part() == PartOfPlant::Leaf
}

fn begun(bud: &ComponentRow) -> Axis {
    Axis {
        id: bud.axis_id,
        order: bud.order,
        origin: bud.origin,
        role: Role::Own,
        bearing: None,
        bearer_rank: bud.rank.unwrap_or_default(),
        birth: bud.birth_age,
        end: bud.death_age.zip(bud.cause_of_death),
        shed: None,
        nodes: Vec::new(),
        lateral_flowers: 0,
        blooms: false,
        kind: Kind::Internode,
        bears: Vec::new(),
    }
}

/// Adds a row to its axis. Rows come in the order of component numbers, in which the nodes of an axis climb.
fn add(axis: &mut Axis, row: &ComponentRow) {
    match row.kind.class() {
        Class::Internode => {
            if axis.nodes.is_empty() {
                axis.kind = row.kind;
            }
            axis.blooms |= is_of_flower(row.kind) && !is_of_flower(axis.kind);
            axis.shed = row.shed_age;
            axis.nodes.push(Node { unit_rank: row.unit_rank.unwrap_or(1), trend: row.trend_deg });
        }
        Class::Flower if row.position.is_some() => axis.lateral_flowers += 1,
        _ => {}
    }
}

fn role(axes: &[Axis], place: usize) -> Role {
    let axis = &axes[place];
    if is_of_leaf(axis.kind) || is_of_flower(axis.kind) {
        return Role::Organ;
    }
    let Some(bearing) = axis.bearing.map(|bearing| &axes[bearing]) else {
        return Role::Own;
    };
    let base = LEAST_BASE.max((BASE_SHARE * bearing.nodes.len() as f64) as u32);
    let trunks = axis.order == 1 && bearing.order == 1;
    match axis.origin {
        _ if matches!(bearing.role, Role::Reiterate | Role::Organ) => bearing.role,
        Origin::Adaptive if trunks && axis.bearer_rank <= base => Role::Basal,
        Origin::Adaptive | Origin::Traumatic => Role::Reiterate,
        Origin::Seed | Origin::Axillary | Origin::Relay | Origin::Fork => Role::Own,
    }
}
