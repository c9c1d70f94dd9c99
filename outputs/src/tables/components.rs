//! The rows of `components`: the identity, birth and fate of every component that ever lived.
//!
//! Fates later than the last age are null, even where the plant was grown ahead and they are computed already.

use super::buffers::{NULL, columns, known};
use super::component_index::{Component, ComponentIndex, inclination};
use super::membership::{Membership, name_of};
use super::records::{area_of, number_of};
use phytomer_sim::Tick;
use phytomer_sim::plant::{
    AxisId, BUDS_NOT_TOLD, Cause, Class, Departed, Kind, LineageKey, NOT_TOLD, NodeId, Nodes, OrganId, Origin, Plant,
};
use std::ops::Range;

columns! {
    /// The buffers of `components`.
    ComponentColumns of row: ComponentRow, of: &OfPlant<'_> {
        treatment: Name(i32) = of.of.treatment as i32,
        plot: Int(i32) = of.of.plot as i32,
        plant: Int(i32) = of.plant.id as i32,
        component: Int(i32) = row.component as i32,
        key: Key(i64) = row.key.0 as i64,
        parent: Int(i32) = row.parent,
        axis: Int(i32) = row.axis.component as i32,
        bearing_axis: Int(i32) = row.axis.bearing,
        order: Int(i32) = i32::from(row.axis.order),
        kind: Word(i8) = row.kind as i8,
        origin: Word(i8) = row.axis.origin as i8,
        state: Int(i32) = i32::from(row.axis.state),
        state_name: Name(i32) = name_of(of.states, row.axis.state),
        position: Int(i32) = row.position,
        rank: Int(i32) = row.rank,
        unit_rank: Int(i32) = row.unit_rank,
        growth_unit: Int(i32) = row.making.growth_unit,
        cycle: Int(i32) = row.making.cycle,
        neoformed: Bool(i8) = row.neoformed,
        axillary_buds: Int(i32) = row.making.axillary_buds,
        birth: Int(i32) = row.birth as i32,
        birth_dimension: Int(i32) = row.birth_dimension,
        delay: Int(i32) = row.delay,
        length: Float(f32) = row.length,
        birth_diameter: Float(f32) = row.birth_diameter,
        area: Float(f32) = row.area,
        death: Int(i32) = known(row.death, of.last),
        shed: Int(i32) = known(row.shed, of.last),
        // Causes are numbered from 1; 0 stands for a living component.
        cause: Word(i8) = if known(row.death, of.last) == NULL { -1 } else { row.cause as i8 - 1 },
        trend: Float(f32) = row.trend,
    }
}

/// The values that all rows of one plant share.
struct OfPlant<'a> {
    of: Membership,
    plant: &'a Plant,
    /// The names of the states of its model.
    states: &'a [i32],
    /// The last recorded age of the plant.
    last: Tick,
}

/// The values of one row; −1 and NaN stand for null.
pub struct ComponentRow {
    component: u32,
    key: LineageKey,
    parent: i32,
    axis: OfAxis,
    kind: Kind,
    position: i32,
    rank: i32,
    unit_rank: i32,
    making: Making,
    neoformed: i8,
    birth: Tick,
    birth_dimension: i32,
    delay: i32,
    length: f32,
    birth_diameter: f32,
    area: f32,
    death: Tick,
    shed: Tick,
    cause: Cause,
    trend: f32,
}

/// How a bud made an internode and its node.
#[derive(Clone, Copy)]
struct Making {
    growth_unit: i32,
    cycle: i32,
    axillary_buds: i32,
}

impl Making {
    /// Of organs and buds, and where the model has no growth units.
    const NOT_TOLD: Self = Self { growth_unit: NULL, cycle: NULL, axillary_buds: NULL };

    #[inline]
    fn of(nodes: &Nodes, i: usize) -> Self {
        let told = |number: u16| if number == NOT_TOLD { NULL } else { i32::from(number) };
        let buds = nodes.axillary_buds[i];
        Self {
            growth_unit: told(nodes.growth_unit[i]),
            cycle: told(nodes.cycle[i]),
            axillary_buds: if buds == BUDS_NOT_TOLD { NULL } else { i32::from(buds) },
        }
    }
}

/// The values that a component has of its axis.
struct OfAxis {
    component: u32,
    bearing: i32,
    order: u8,
    origin: Origin,
    state: u8,
}

impl ComponentColumns {
    /// Adds a row for each component in `numbers` that lived by the plant's age `last`. `rows` is working memory, kept
    /// between calls.
    pub fn fill(
        &mut self,
        of: Membership,
        (plant, index, states): (&Plant, &ComponentIndex, &[i32]),
        numbers: Range<u32>,
        last: Tick,
        rows: &mut Vec<ComponentRow>,
    ) {
        rows.clear();
        let row_of = |number| {
            let row = match index.component(number) {
                Component::Node(node) => of_node(plant, node, index),
                Component::Organ(organ) => of_organ(plant, organ),
                Component::Bud(axis) => of_bud(plant, axis),
                Component::Departed(place) => of_departed(&plant.ledger[place]),
            };
            let parent = plant.bearer_at_birth(number).map(number_or_null);
            ComponentRow { parent: parent.unwrap_or(row.parent), ..row }
        };
        let lived = |row: &ComponentRow| row.birth <= last && (row.kind == Kind::ApicalBud || row.birth < row.death);
        rows.extend(numbers.map(row_of).filter(lived));
        self.extend(rows, &OfPlant { of, plant, states, last });
    }
}

#[inline]
fn of_node(plant: &Plant, node: NodeId, index: &ComponentIndex) -> ComponentRow {
    let Plant { nodes, axes, .. } = plant;
    let i = node.index();
    let axis = nodes.axis[i];
    ComponentRow {
        component: nodes.component[i],
        key: plant.node_key(node),
        parent: number_of(plant, nodes.parent[i]),
        axis: of_axis(plant, axis),
        kind: plant.kind_of(node),
        position: NULL,
        rank: nodes.rank[i] as i32,
        unit_rank: i32::from(nodes.unit_rank[i]),
        making: Making::of(nodes, i),
        neoformed: i8::from(nodes.formation[i].is_neoformed()),
        birth: nodes.birth[i],
        birth_dimension: nodes.birth[i].saturating_sub(axes.birth[axis.index()]) as i32,
        delay: NULL,
        length: nodes.length[i],
        birth_diameter: nodes.primary_diameter[i],
        area: f32::NAN,
        death: plant.death_of(node),
        shed: plant.shed_of(node),
        cause: plant.cause_of_death(node),
        trend: index.trend(plant, node),
    }
}

#[inline]
fn of_organ(plant: &Plant, organ: OrganId) -> ComponentRow {
    let Plant { organs, nodes, axes, .. } = plant;
    let i = organ.index();
    let node = organs.node[i].index();
    let axis = nodes.axis[node];
    let end = plant.organ_end(organ);
    ComponentRow {
        component: organs.component[i],
        key: plant.organ_key(organ),
        parent: nodes.component[node] as i32,
        axis: of_axis(plant, axis),
        kind: organs.kind[i],
        // The greatest position marks an organ at the end of an axis, which has no position among laterals.
        position: if organs.position[i] == u16::MAX { NULL } else { i32::from(organs.position[i]) },
        rank: nodes.rank[node] as i32,
        unit_rank: i32::from(nodes.unit_rank[node]),
        making: Making::NOT_TOLD,
        neoformed: -1,
        birth: organs.birth[i],
        birth_dimension: organs.birth[i].saturating_sub(axes.birth[axis.index()]) as i32,
        delay: NULL,
        length: organs.length[i],
        birth_diameter: organs.width[i],
        area: area_of(organs.area[i]),
        death: end,
        shed: end,
        cause: organs.cause[i],
        trend: f32::NAN,
    }
}

#[inline]
fn of_bud(plant: &Plant, axis: AxisId) -> ComponentRow {
    let axes = &plant.axes;
    let i = axis.index();
    let bearer = axes.bearer[i].some().map(NodeId::index);
    // A dead bud does not stand: the organ that the apex became, and the axis that it left, are components of their
    // own.
    let end = plant.bud_end(axis);
    ComponentRow {
        component: axes.component[i],
        key: axes.key[i],
        parent: number_of(plant, axes.bearer[i]),
        axis: of_axis(plant, axis),
        kind: Kind::ApicalBud,
        position: i32::from(axes.position[i]),
        rank: bearer.map_or(NULL, |node| plant.nodes.rank[node] as i32),
        unit_rank: bearer.map_or(NULL, |node| i32::from(plant.nodes.unit_rank[node])),
        making: Making::NOT_TOLD,
        neoformed: -1,
        birth: axes.appearance[i],
        birth_dimension: NULL,
        delay: axes.birth[i].saturating_sub(axes.appearance[i]) as i32,
        length: f32::NAN,
        birth_diameter: f32::NAN,
        area: f32::NAN,
        death: end,
        shed: end,
        cause: axes.apex_fate[i].cause(),
        trend: f32::NAN,
    }
}

/// The row of a component of the ledger, as it last stood: of an internode, an organ, or the apical bud of an axis.
fn of_departed(departed: &Departed) -> ComponentRow {
    let is_bud = departed.kind == Kind::ApicalBud;
    let size = |size: f32| if is_bud { f32::NAN } else { size };
    let is_internode = departed.kind.class() == Class::Internode;
    ComponentRow {
        component: departed.component,
        key: departed.key,
        parent: number_or_null(departed.parent),
        axis: OfAxis {
            component: departed.axis,
            bearing: number_or_null(departed.bearing_axis),
            order: departed.order,
            origin: departed.origin,
            state: departed.state,
        },
        kind: departed.kind,
        position: departed.position.map_or(NULL, i32::from),
        rank: number_or_null(departed.rank),
        unit_rank: departed.unit_rank.map_or(NULL, i32::from),
        making: Making::NOT_TOLD,
        neoformed: departed.neoformed.map_or(-1, i8::from),
        birth: departed.birth,
        birth_dimension: number_or_null(departed.birth_dimension),
        delay: if is_bud { 0 } else { NULL },
        length: size(departed.length),
        birth_diameter: size(departed.birth_diameter),
        area: if is_bud || is_internode { f32::NAN } else { area_of(departed.area) },
        death: departed.death,
        shed: departed.death,
        cause: departed.cause,
        trend: departed.trend.as_ref().map_or(f32::NAN, inclination),
    }
}

fn number_or_null(number: Option<u32>) -> i32 {
    number.map_or(NULL, |number| number as i32)
}

#[inline]
fn of_axis(plant: &Plant, axis: AxisId) -> OfAxis {
    let axes = &plant.axes;
    let i = axis.index();
    let bearer = axes.bearer[i].some();
    OfAxis {
        component: axes.component[i],
        bearing: bearer.map_or(NULL, |node| axes.component[plant.nodes.axis[node.index()].index()] as i32),
        order: axes.order[i],
        origin: axes.origin[i],
        state: axes.state[i],
    }
}
