//! The rows of `components`: the identity, the birth and the fate of everything that ever lived.
//!
//! Fates later than the last age are not known, whichever way the plant was grown: they are null.

use super::buffers::{NULL, columns, known};
use super::records::{area_of, number_of};
use super::standing::{Component, Standing};
use phytomer_sim::plant::{AxisId, Cause, Kind, LineageKey, NodeId, OrganId, Plant};
use phytomer_sim::shed::cause_of;
use phytomer_sim::{NEVER, Plot, Tick};

columns! {
    /// The buffers of `components`.
    ComponentColumns {
        treatment: Word(i8), plot: Int(i32), plant: Int(i32), component: Int(i32), key: Key(i64),
        parent: Int(i32), axis: Int(i32), bearing_axis: Int(i32), order: Int(i32), kind: Word(i8), origin: Word(i8),
        state: Int(i32), position: Int(i32), rank: Int(i32), unit_rank: Int(i32), neoformed: Bool(i8),
        birth: Int(i32), birth_dimension: Int(i32), delay: Int(i32),
        length: Float(f32), birth_diameter: Float(f32), area: Float(f32),
        death: Int(i32), shed: Int(i32), cause: Word(i8),
    }
}

/// What one component puts into a row; numbers of −1 and NaN are nulls.
struct Row {
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
}

impl ComponentColumns {
    /// Adds the row of component `number` of `plant`, if it ever lived by the age `last`.
    #[inline]
    pub fn add(&mut self, plot: &Plot, plant: &Plant, standing: &Standing, number: u32, last: Tick) {
        let row = match standing.component(number) {
            Component::Node(node) => of_node(plant, node),
            Component::Organ(organ) => of_organ(plant, organ),
            Component::Bud(axis) => of_bud(plant, axis),
        };
        let never_lived = row.kind != Kind::ApicalBud && row.birth >= row.death;
        if row.birth <= last && !never_lived {
            self.push(plot, plant, &row, last);
        }
    }

    fn push(&mut self, plot: &Plot, plant: &Plant, row: &Row, last: Tick) {
        let axes = &plant.axes;
        let axis = row.axis.index();
        let death = known(row.death, last);
        self.treatment.push(0);
        self.plot.push(plot.id as i32);
        self.plant.push(plant.id as i32);
        self.component.push(row.component as i32);
        self.key.push(row.key.0 as i64);
        self.parent.push(row.parent);
        self.axis.push(axes.component[axis] as i32);
        self.bearing_axis.push(bearing_axis(plant, row.axis));
        self.order.push(i32::from(axes.order[axis]));
        self.kind.push(row.kind as i8);
        self.origin.push(axes.origin[axis] as i8);
        self.state.push(i32::from(axes.state[axis]));
        self.position.push(row.position);
        self.rank.push(row.rank);
        self.unit_rank.push(row.unit_rank);
        self.neoformed.push(row.neoformed);
        self.birth.push(row.birth as i32);
        self.birth_dimension.push(row.birth_dimension);
        self.delay.push(row.delay);
        self.length.push(row.length);
        self.birth_diameter.push(row.birth_diameter);
        self.area.push(row.area);
        self.death.push(death);
        self.shed.push(known(row.shed, last));
        // Causes are numbered from 1; 0 is "lives".
        self.cause.push(if death == NULL { -1 } else { row.cause as i8 - 1 });
    }
}

#[inline]
fn of_node(plant: &Plant, node: NodeId) -> Row {
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
        death: nodes.death[i],
        shed: nodes.shed[i],
        cause: Cause::Branch,
    }
}

#[inline]
fn of_organ(plant: &Plant, organ: OrganId) -> Row {
    let Plant { organs, nodes, axes, .. } = plant;
    let i = organ.index();
    let node = organs.node[i].index();
    let axis = nodes.axis[node];
    let end = super::standing::organ_end(plant, organ);
    Row {
        component: organs.component[i],
        key: plant.organ_key(organ),
        parent: nodes.component[node] as i32,
        axis,
        kind: organs.kind[i],
        position: i32::from(organs.position[i]),
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
    }
}

#[inline]
fn of_bud(plant: &Plant, axis: AxisId) -> Row {
    let axes = &plant.axes;
    let i = axis.index();
    let bearer = axes.bearer[i].some().map(NodeId::index);
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
        death: axes.apex_end[i],
        shed: if axes.apex_end[i] == NEVER { NEVER } else { axes.shed[i] },
        cause: cause_of(axes.apex_fate[i]),
    }
}

fn bearing_axis(plant: &Plant, axis: AxisId) -> i32 {
    let bearer = plant.axes.bearer[axis.index()].some();
    bearer.map_or(NULL, |bearer| plant.axes.component[plant.nodes.axis[bearer.index()].index()] as i32)
}
