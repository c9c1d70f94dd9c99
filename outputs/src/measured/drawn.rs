//! Measured plants of a run folder as plants that can be drawn: each internode and organ where it was measured.
//!
//! An internode without a place is not seen; what it bears stands in its own place all the same. An internode without
//! one diameter has the other, and without both the diameter of what bears it; one without any is drawn as a line of
//! the least diameter of its plant. So drawn plants are for pictures, meshes and pages, and no table is made of them.

use super::recorded::{MeasuredPlants, Row};
use phytomer_sim::plant::{
    AxisId, Form, Habit, Kind, Looks, NewAxis, NewNode, NewOrgan, NodeId, Plant, Seed, Shape, Trend,
};
use phytomer_sim::pose::pose;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::{NEVER, Tick};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The diameter of wood of which none is told, metres.
const THIN: f64 = 0.001;

impl MeasuredPlants {
    /// The plants at a tick, by number, each with its parts where they were measured, under the numbers that they have
    /// in the tables. Those without any place are left out.
    pub fn at(&self, tick: Tick) -> BTreeMap<u32, Plant> {
        let has_places = |rows: &[Row]| rows.iter().any(|row| row.place.is_some() && row.heading.is_some());
        let seen = self.rows(tick).filter(|(_, rows)| has_places(rows));
        seen.map(|(number, rows)| (number, drawn(number, rows, tick))).collect()
    }
}

/// Where a component ends, and how it is turned.
#[derive(Debug, Clone, Copy)]
struct End {
    place: [f64; 3],
    turn: Rotation,
}

impl End {
    const GROUND: [[f64; 3]; 2] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];

    /// How something of these directions is turned in this frame, and where it begins there.
    fn within(&self, place: [f64; 3], turn: Rotation) -> (Rotation, [f32; 3]) {
        let back = self.turn.inverse();
        let apart = [0, 1, 2].map(|k| place[k] - self.place[k]);
        (back.then(turn), back.turned(apart).map(|x| x as f32))
    }
}

fn drawn(number: u32, rows: &[Row], tick: Tick) -> Plant {
    let habit = Habit { trends: vec![Trend::STRAIGHT], looks: Looks::of_shape(Shape::Cylinder), ..Habit::default() };
    let seed = Seed { plant: number, draws: 0, run_seed: 0, component_limit: u32::MAX, keep_events: false };
    let mut drawing = Drawing {
        plant: Plant::new(&seed, Arc::new(habit)),
        axes: BTreeMap::new(),
        nodes: BTreeMap::new(),
        thin: rows.iter().filter_map(|row| row.base.or(row.tip)).fold(f64::INFINITY, f64::min),
    };
    if !drawing.thin.is_finite() {
        drawing.thin = THIN;
    }
    rows.iter().for_each(|row| drawing.add(row));
    let Drawing { mut plant, nodes, .. } = drawing;
    plant.age = tick;
    let most = rows.iter().map(|row| row.number.max(row.axis)).max().unwrap_or_default();
    while plant.components() <= most {
        plant.next_number();
    }
    for (node, _, [base, tip]) in nodes.values() {
        plant.nodes.diameter[node.index()] = *base as f32;
        plant.nodes.diameter_tip[node.index()] = *tip as f32;
    }
    pose(&mut plant, tick);
    plant
}

struct Drawing {
    plant: Plant,
    /// The axes by their numbers, with how many internodes each has.
    axes: BTreeMap<u32, (AxisId, u32)>,
    /// The node of each component, its end and its diameters.
    nodes: BTreeMap<u32, (NodeId, End, [f64; 2])>,
    thin: f64,
}

impl Drawing {
    /// The end of what bears a component; the ground for what stands on it.
    fn bearing(&self, row: &Row) -> (Option<NodeId>, End, [f64; 2]) {
        match row.parent.and_then(|parent| self.nodes.get(&parent)) {
            Some((node, end, diameters)) => (Some(*node), *end, *diameters),
            None => {
                let [heading, up] = End::GROUND;
                (None, End { place: [0.0; 3], turn: Rotation::to(heading, up) }, [self.thin; 2])
            }
        }
    }

    fn add(&mut self, row: &Row) {
        let (node, end, diameters) = self.bearing(row);
        let told = row.place.zip(row.heading).map(|(place, heading)| (place, turn_of(heading, row.up)));
        if row.kind == Kind::Internode {
            self.internode(row, node, (end, diameters), told);
        } else if let (Some(node), Some((place, turn))) = (node, told) {
            self.organ(row, node, end.within(place, turn));
        }
    }

    fn internode(
        &mut self,
        row: &Row,
        bearer: Option<NodeId>,
        (end, before): (End, [f64; 2]),
        told: Option<([f64; 3], Rotation)>,
    ) {
        let plant = &mut self.plant;
        let known = self.axes.entry(row.axis).or_insert_with(|| {
            let order = u8::try_from(row.order.max(1)).unwrap_or(u8::MAX);
            (plant.place_axis(NewAxis { bearer, order, ..NewAxis::OF_THE_SEED }, row.axis), 0)
        });
        known.1 += 1;
        let (axis, rank) = *known;
        // What has no place takes none, and what it bears begins where it stands itself.
        let length = if told.is_some() { row.length.unwrap_or(0.0) } else { 0.0 };
        let base = row.base.or(row.tip).unwrap_or(before[1]);
        let tip = row.tip.unwrap_or(base);
        let new = NewNode {
            parent: bearer.unwrap_or(NodeId::NONE),
            axis,
            birth: 0,
            rank,
            unit_rank: 1,
            short: false,
            neoformed: false,
            trend: 0,
            length: length as f32,
            diameter: base as f32,
            azimuth: 0.0,
        };
        let node = plant.place_node(new, row.number);
        let (place, turn) = told.unwrap_or((end.place, end.turn));
        let (within, offset) = end.within(place, turn);
        plant.state_frame(node, within, offset);
        let along = turn.turned([length, 0.0, 0.0]);
        let end = End { place: [0, 1, 2].map(|k| place[k] + along[k]), turn };
        self.nodes.insert(row.number, (node, end, [base, tip]));
    }

    fn organ(&mut self, row: &Row, node: NodeId, (turn, offset): (Rotation, [f32; 3])) {
        let length = row.length.unwrap_or(0.0);
        let width = row.base.or(row.area.filter(|_| length > 0.0).map(|area| area / length)).unwrap_or(length / 2.0);
        let new = NewOrgan {
            node,
            kind: row.kind,
            position: 0,
            birth: 0,
            death: NEVER,
            cause: phytomer_sim::plant::Cause::None,
            form: Form(0),
            length: length as f32,
            width: width as f32,
            area: row.area.unwrap_or(0.0) as f32,
            azimuth: 0.0,
            insertion: 0.0,
        };
        let organ = self.plant.place_organ(new, row.number);
        self.plant.state_organ(organ, turn, offset);
    }
}

/// The rotation to a direction and an upper side; where none is told any upper side will do.
fn turn_of(heading: [f64; 3], up: Option<[f64; 3]>) -> Rotation {
    let level = if heading[2].abs() > 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
    Rotation::to(heading, up.unwrap_or(level))
}
