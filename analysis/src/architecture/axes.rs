//! The axes of one recorded plant, put together from the rows of `components`: which axis bears which, with its nodes
//! and flowers.
//!
//! Axes that are leaves, inflorescences or parts of flowers by the kind of their internodes are organs and no branches.
//! Reiterates are told apart here. A reiterate repeats the plant's model on the plant and says nothing of the model
//! itself (Hallé, Oldeman & Tomlinson 1978), so all that it bears is left aside; but an axis of order 1 out of the base
//! of another of order 1 is a basal shoot, of which Tomlinson's and McClure's models are made. Absent: any judgement.

use super::tolerance::PLAGIOTROPIC_DEG;
use phytomer_outputs::rows::ComponentRow;
use phytomer_sim::Tick;
use phytomer_sim::plant::{Cause, Class, Kind, Origin, PartOfPlant};
use std::collections::BTreeMap;

/// The share of the nodes of an axis that are its base, and the least number of them.
const BASE_SHARE: f64 = 0.2;
const LEAST_BASE: u32 = 5;

/// One internode.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// Its rank in its growth unit, from 1.
    pub unit_rank: u32,
    /// The inclination that its axis tends to there, degrees.
    pub trend: Option<f32>,
}

/// What an axis is to the plant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It belongs to the plant's own architecture.
    Own,
    /// It arose from the base of another trunk.
    Basal,
    /// It is a reiterate, or borne by one.
    Reiterate,
    /// It is a leaf, an inflorescence or a part of one that is drawn as an axis.
    Organ,
}

/// One axis.
#[derive(Debug, Clone)]
pub struct Axis {
    /// The component of its bud.
    pub id: u32,
    /// From 1.
    pub order: u32,
    /// How it came to be.
    pub origin: Origin,
    /// What it is to the plant.
    pub role: Role,
    /// The axis that bears it, as a place in the list.
    pub bearing: Option<usize>,
    /// The rank of the bearing node.
    pub bearer_rank: u32,
    /// When its bud appeared.
    pub birth: Tick,
    /// When its apex ended, and how.
    pub end: Option<(Tick, Cause)>,
    /// When its wood left the plant.
    pub shed: Option<Tick>,
    /// Its internodes by rank.
    pub nodes: Vec<Node>,
    /// Flowers and inflorescences that stand on its sides.
    pub lateral_flowers: u32,
    /// Whether it became an inflorescence, or one took the place of its apex.
    pub blooms: bool,
    /// The kind of its first internode.
    kind: Kind,
    /// The axes that it bears, as places in the list.
    pub bears: Vec<usize>,
}

impl Axis {
    /// Whether it says something of the model: it is the plant's own, or a basal shoot.
    pub fn is_judged(&self) -> bool {
        matches!(self.role, Role::Own | Role::Basal)
    }

    /// Whether its apex became a flower.
    pub fn flowered(&self) -> bool {
        self.blooms || self.end.is_some_and(|(_, cause)| cause == Cause::Flowered)
    }

    /// Whether its apex came to the end that its architecture gives it: a flower, or the last of its growth units.
    pub fn finished(&self) -> bool {
        self.flowered() || self.end.is_some_and(|(_, cause)| cause == Cause::Completed)
    }

    /// Whether its apex lived at `age`, or later.
    pub fn lives_past(&self, age: Tick) -> bool {
        self.end.is_none_or(|(end, _)| end > age)
    }

    /// The inclination that it tends to at first, degrees.
    pub fn first_trend(&self) -> Option<f32> {
        self.nodes.first().and_then(|node| node.trend)
    }

    /// The inclination that it tends to at last, degrees.
    pub fn last_trend(&self) -> Option<f32> {
        self.nodes.last().and_then(|node| node.trend)
    }
}

/// Whether an axis that tends to such an angle to the vertical, in degrees, is plagiotropic.
pub fn is_plagiotropic(trend_deg: f32) -> bool {
    trend_deg > PLAGIOTROPIC_DEG
}

/// The axes of a plant by their numbers, those among them that are buds still: a bearing axis comes before those that
/// it bears.
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

/// Tells the bearing axis of what it bears. An inflorescence that is an axis is a flower to it.
fn attach(axes: &mut [Axis], place: usize, bearing: usize) {
    let Axis { role, origin, kind, .. } = axes[place];
    match role {
        Role::Organ if !is_of_flower(kind) || axes[bearing].role == Role::Organ => {}
        Role::Organ if matches!(origin, Origin::Relay | Origin::Fork) => axes[bearing].blooms = true,
        Role::Organ => axes[bearing].lateral_flowers += 1,
        _ => axes[bearing].bears.push(place),
    }
}

/// Whether an axis of such internodes is a flower, an inflorescence or a part of one.
fn is_of_flower(kind: Kind) -> bool {
    kind.class() == Class::Internode && kind.part() == PartOfPlant::Flower
}

/// Whether an axis of such internodes is a leaf or a part of one.
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

/// Rows are in the order of their numbers, in which the nodes of an axis climb.
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
