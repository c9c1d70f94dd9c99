//! The rows of `components`: the identity, the birth and the fate of everything that ever lived.
//!
//! Fates later than the last age are not known, whichever way the plant was grown: they are null.

use super::buffers::{NULL, columns, known};
use super::records::{area_of, number_of};
use super::standing::{Component, Standing};
use phytomer_sim::plant::{AxisId, Cause, Kind, LineageKey, NodeId, OrganId, Plant};
use phytomer_sim::shed::cause_of;
use phytomer_sim::{Plot, Tick};
use std::ops::Range;

columns! {
    /// The buffers of `components`.
    ComponentColumns {
        treatment: Word(i8), plot: Int(i32), plant: Int(i32), component: Int(i32), key: Key(i64),
        parent: Int(i32), axis: Int(i32), bearing_axis: Int(i32), order: Int(i32), kind: Word(i8), origin: Word(i8),
        state: Int(i32), position: Int(i32), rank: Int(i32), unit_rank: Int(i32), neoformed: Bool(i8),
        birth: Int(i32), birth_dimension: Int(i32), delay: Int(i32),
        length: Float(f32), birth_diameter: Float(f32), area: Float(f32),
        death: Int(i32), shed: Int(i32), cause: Word(i8), trend: Float(f32),
    }
}

/// What one component puts into a row; numbers of −1 and NaN are nulls.
pub struct Row {
    component: u32,
    key: LineageKey,
    parent: i32,
    axis: AxisId,
    kind: Kind,
    position: i32,
    rank: i32,
    unit_rank: i32,
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

impl ComponentColumns {
    /// Adds a row for each of the components `numbers` of `plant` that lived by the age `last`; `rows` is memory to
    /// work in.
    pub fn fill(
        &mut self,
        plot: &Plot,
        (plant, standing): (&Plant, &Standing),
        numbers: Range<u32>,
        last: Tick,
        rows: &mut Vec<Row>,
    ) {
        rows.clear();
        let row_of = |number| match standing.component(number) {
            Component::Node(node) => of_node(plant, node, standing),
            Component::Organ(organ) => of_organ(plant, organ),
            Component::Bud(axis) => of_bud(plant, axis),
        };
        let lived = |row: &Row| row.birth <= last && (row.kind == Kind::ApicalBud || row.birth < row.death);
        rows.extend(numbers.map(row_of).filter(lived));
        self.push_identity(rows, plant);
        self.push_life(rows, last);
        let rows = self.component.len();
        self.treatment.resize(rows, 0);
        self.plot.resize(rows, plot.id as i32);
        self.plant.resize(rows, plant.id as i32);
    }

    fn push_identity(&mut self, rows: &[Row], plant: &Plant) {
        let axes = &plant.axes;
        self.component.extend(rows.iter().map(|row| row.component as i32));
        self.key.extend(rows.iter().map(|row| row.key.0 as i64));
        self.parent.extend(rows.iter().map(|row| row.parent));
        self.axis.extend(rows.iter().map(|row| axes.component[row.axis.index()] as i32));
        self.bearing_axis.extend(rows.iter().map(|row| bearing_axis(plant, row.axis)));
        self.order.extend(rows.iter().map(|row| i32::from(axes.order[row.axis.index()])));
        self.kind.extend(rows.iter().map(|row| row.kind as i8));
        self.origin.extend(rows.iter().map(|row| axes.origin[row.axis.index()] as i8));
        self.state.extend(rows.iter().map(|row| i32::from(axes.state[row.axis.index()])));
        self.position.extend(rows.iter().map(|row| row.position));
        self.rank.extend(rows.iter().map(|row| row.rank));
        self.unit_rank.extend(rows.iter().map(|row| row.unit_rank));
        self.neoformed.extend(rows.iter().map(|row| row.neoformed));
    }

    fn push_life(&mut self, rows: &[Row], last: Tick) {
        self.birth.extend(rows.iter().map(|row| row.birth as i32));
        self.birth_dimension.extend(rows.iter().map(|row| row.birth_dimension));
        self.delay.extend(rows.iter().map(|row| row.delay));
        self.length.extend(rows.iter().map(|row| row.length));
        self.birth_diameter.extend(rows.iter().map(|row| row.birth_diameter));
        self.area.extend(rows.iter().map(|row| row.area));
        self.death.extend(rows.iter().map(|row| known(row.death, last)));
        self.shed.extend(rows.iter().map(|row| known(row.shed, last)));
        // Causes are numbered from 1; 0 is "lives".
        let cause = |row: &Row| if known(row.death, last) == NULL { -1 } else { row.cause as i8 - 1 };
        self.cause.extend(rows.iter().map(cause));
        self.trend.extend(rows.iter().map(|row| row.trend));
    }
}

#[inline]
fn of_node(plant: &Plant, node: NodeId, standing: &Standing) -> Row {
    let Plant { nodes, axes, .. } = plant;
    let i = node.index();
    let axis = nodes.axis[i];
    Row {
        component: nodes.component[i],
        key: plant.node_key(node),
        parent: number_of(plant, nodes.parent[i]),
        axis,
        kind: plant.kind_of(node),
        position: NULL,
        rank: nodes.rank[i] as i32,
        unit_rank: i32::from(nodes.unit_rank[i]),
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
        trend: standing.trend(plant, node),
    }
}

#[inline]
fn of_organ(plant: &Plant, organ: OrganId) -> Row {
    let Plant { organs, nodes, axes, .. } = plant;
    let i = organ.index();
    let node = organs.node[i].index();
    let axis = nodes.axis[node];
    let end = plant.organ_end(organ);
    Row {
        component: organs.component[i],
        key: plant.organ_key(organ),
        parent: nodes.component[node] as i32,
        axis,
        kind: organs.kind[i],
        // That of what stands at the end of an axis is the greatest, which is no place among laterals.
        position: if organs.position[i] == u16::MAX { NULL } else { i32::from(organs.position[i]) },
        rank: nodes.rank[node] as i32,
        unit_rank: i32::from(nodes.unit_rank[node]),
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
fn of_bud(plant: &Plant, axis: AxisId) -> Row {
    let axes = &plant.axes;
    let i = axis.index();
    let bearer = axes.bearer[i].some().map(NodeId::index);
    // A dead bud does not stand: what the apex became, and the axis that it left, are components of their own.
    let end = plant.bud_end(axis);
    Row {
        component: axes.component[i],
        key: axes.key[i],
        parent: number_of(plant, axes.bearer[i]),
        axis,
        kind: Kind::ApicalBud,
        position: i32::from(axes.position[i]),
        rank: bearer.map_or(NULL, |node| plant.nodes.rank[node] as i32),
        unit_rank: bearer.map_or(NULL, |node| i32::from(plant.nodes.unit_rank[node])),
        neoformed: -1,
        birth: axes.appearance[i],
        birth_dimension: NULL,
        delay: axes.birth[i].saturating_sub(axes.appearance[i]) as i32,
        length: f32::NAN,
        birth_diameter: f32::NAN,
        area: f32::NAN,
        death: end,
        shed: end,
        cause: cause_of(axes.apex_fate[i]),
        trend: f32::NAN,
    }
}

fn bearing_axis(plant: &Plant, axis: AxisId) -> i32 {
    let bearer = plant.axes.bearer[axis.index()].some();
    bearer.map_or(NULL, |bearer| plant.axes.component[plant.nodes.axis[bearer.index()].index()] as i32)
}
