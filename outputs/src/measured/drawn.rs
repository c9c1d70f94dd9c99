//! Measured plants of a run folder as plants that can be drawn: each internode and organ where it was measured.
//!
//! An internode without a place is not seen; what it bears stands in its own place all the same. An internode without
//! one diameter has the other, and without both the diameter of what bears it; one without any is drawn as a line of
//! the least diameter of its plant. So drawn plants are for pictures, and no table is made of them.

use crate::cells::of_run;
use crate::read::Run;
use crate::tables::Table;
use phytomer_sim::plant::{
    AxisId, Form, Habit, Kind, Looks, NewAxis, NewNode, NewOrgan, NodeId, Plant, Seed, Shape, Trend,
};
use phytomer_sim::pose::pose;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::{NEVER, Tick};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The columns that are read.
const COLUMNS: [&str; 21] = [
    "plant_id",
    "tick",
    "component_id",
    "parent_id",
    "axis_id",
    "order",
    "kind",
    "x_m",
    "y_m",
    "z_m",
    "dir_x",
    "dir_y",
    "dir_z",
    "up_x",
    "up_y",
    "up_z",
    "length_m",
    "diameter_m",
    "diameter_tip_m",
    "area_m2",
    "rank",
];

/// The diameter of wood of which none is told, metres.
const THIN: f64 = 0.001;

/// A row of `records`.
#[derive(Debug, Clone, Copy)]
struct Row {
    number: u32,
    parent: Option<u32>,
    axis: u32,
    order: u32,
    kind: Kind,
    place: Option<[f64; 3]>,
    heading: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    length: Option<f64>,
    base: Option<f64>,
    tip: Option<f64>,
    area: Option<f64>,
}

/// The plants of a run of measured plants at a tick, the last at which they are recorded if none is given, by number.
/// Those without any place are left out.
///
/// # Errors
/// In words: a table that cannot be read, or a tick without rows.
pub fn plants_of(run: &Run, tick: Option<Tick>) -> Result<(Tick, BTreeMap<u32, Plant>), String> {
    let (names, rows) = of_run(run, Table::Records, &COLUMNS)?;
    if rows.is_empty() {
        return Ok((tick.unwrap_or(0), BTreeMap::new()));
    }
    let mut at = [usize::MAX; COLUMNS.len()];
    for (place, name) in at.iter_mut().zip(COLUMNS) {
        let found = names.iter().position(|known| known == name);
        *place = found.ok_or_else(|| format!("records has no column {name}"))?;
    }
    let number = |row: &[String], column: usize| row[at[column]].parse::<f64>().ok();
    let ticks: Vec<Tick> = rows.iter().filter_map(|row| number(row, 1)).map(|tick| tick as Tick).collect();
    let last = ticks.iter().copied().max().ok_or("records has no rows")?;
    let tick = tick.unwrap_or(last);
    if !ticks.contains(&tick) {
        return Err(format!("nothing was measured at the age {tick}; the last is {last}"));
    }
    let mut plants: BTreeMap<u32, Vec<Row>> = BTreeMap::new();
    for row in rows.iter().filter(|row| number(row, 1) == Some(f64::from(tick))) {
        let vector = |first: usize| {
            let [x, y, z] = [0, 1, 2].map(|k| number(row, first + k));
            Some([x?, y?, z?])
        };
        let kind = Kind::ALL.into_iter().find(|kind| kind.tag() == row[at[6]]).unwrap_or(Kind::Internode);
        let own = Row {
            number: number(row, 2).unwrap_or_default() as u32,
            parent: number(row, 3).map(|parent| parent as u32),
            axis: number(row, 4).unwrap_or_default() as u32,
            order: number(row, 5).unwrap_or(1.0) as u32,
            kind,
            place: vector(7),
            heading: vector(10),
            up: vector(13),
            length: number(row, 16),
            base: number(row, 17),
            tip: number(row, 18),
            area: number(row, 19),
        };
        plants.entry(number(row, 0).unwrap_or_default() as u32).or_default().push(own);
    }
    let has_places = |rows: &Vec<Row>| rows.iter().any(|row| row.place.is_some() && row.heading.is_some());
    let plants = plants.into_iter().filter(|(_, rows)| has_places(rows));
    Ok((tick, plants.map(|(number, rows)| (number, drawn(number, &rows, tick))).collect()))
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
            (plant.add_axis(NewAxis { bearer, order, ..NewAxis::OF_THE_SEED }), 0)
        });
        known.1 += 1;
        let (axis, rank) = *known;
        // What has no place takes none, and what it bears begins where it stands itself.
        let length = if told.is_some() { row.length.unwrap_or(0.0) } else { 0.0 };
        let base = row.base.or(row.tip).unwrap_or(before[1]);
        let tip = row.tip.unwrap_or(base);
        let node = plant.add_node(NewNode {
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
        });
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
        let organ = self.plant.add_organ(NewOrgan {
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
        });
        self.plant.state_organ(organ, turn, offset);
    }
}

/// The rotation to a direction and an upper side; where none is told any upper side will do.
fn turn_of(heading: [f64; 3], up: Option<[f64; 3]>) -> Rotation {
    let level = if heading[2].abs() > 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
    Rotation::to(heading, up.unwrap_or(level))
}
