//! The rows of `records`: de Reffye's record (1988 §6) of each component that stands at an age, with its pose.

use super::buffers::{NULL, columns};
use super::columns::KINDS;
use super::standing::{Component, Standing};
use phytomer_sim::plant::{AxisId, Kind, NodeId, OrganId, Plant};
use phytomer_sim::pose::{Frame, node_frame, organ_frame, start_frame};
use phytomer_sim::{Plot, Tick};

columns! {
    /// The buffers of `records`.
    RecordColumns {
        treatment: Word(i8), plot: Int(i32), plant: Int(i32), age: Int(i32),
        component: Int(i32), parent: Int(i32), axis: Int(i32), order: Int(i32), kind: Word(i8), rank: Int(i32),
        birth: Int(i32),
        x: Float(f32), y: Float(f32), z: Float(f32),
        dir_x: Float(f32), dir_y: Float(f32), dir_z: Float(f32),
        up_x: Float(f32), up_y: Float(f32), up_z: Float(f32),
        length: Float(f32), diameter: Float(f32), diameter_tip: Float(f32), area: Float(f32),
        alive: Bool(i8),
    }
}

/// What one component puts into a row.
struct Row {
    component: u32,
    parent: i32,
    axis: AxisId,
    kind: Kind,
    rank: u32,
    birth: Tick,
    frame: Frame,
    length: f32,
    diameter: f32,
    diameter_tip: f32,
    area: f32,
    alive: bool,
}

/// What the rows of one plant at one age share.
pub struct Scene<'a> {
    /// The plant.
    pub plant: &'a Plant,
    /// Its components by number, with the tips of its axes at the age.
    pub standing: &'a Standing,
    /// The age.
    pub age: Tick,
}

impl RecordColumns {
    /// Adds a row for each of the components `numbers`.
    pub fn fill(&mut self, plot: &Plot, scene: &Scene<'_>, numbers: &[u32]) {
        for &number in numbers {
            let row = match scene.standing.component(number) {
                Component::Node(node) => scene.of_node(node),
                Component::Organ(organ) => scene.of_organ(organ),
                Component::Bud(axis) => scene.of_bud(axis),
            };
            self.push(&row, &scene.plant.axes);
        }
        let rows = self.component.len();
        self.treatment.resize(rows, 0);
        self.plot.resize(rows, plot.id as i32);
        self.plant.resize(rows, scene.plant.id as i32);
        self.age.resize(rows, scene.age as i32);
    }

    #[inline]
    fn push(&mut self, row: &Row, axes: &phytomer_sim::plant::Axes) {
        let Frame { base, heading, up } = row.frame;
        self.component.push(row.component as i32);
        self.parent.push(row.parent);
        self.axis.push(axes.component[row.axis.index()] as i32);
        self.order.push(i32::from(axes.order[row.axis.index()]));
        self.kind.push(row.kind as i8);
        self.rank.push(row.rank as i32);
        self.birth.push(row.birth as i32);
        self.x.push(base[0]);
        self.y.push(base[1]);
        self.z.push(base[2]);
        self.dir_x.push(heading[0]);
        self.dir_y.push(heading[1]);
        self.dir_z.push(heading[2]);
        self.up_x.push(up[0]);
        self.up_y.push(up[1]);
        self.up_z.push(up[2]);
        self.length.push(row.length);
        self.diameter.push(row.diameter);
        self.diameter_tip.push(row.diameter_tip);
        self.area.push(row.area);
        self.alive.push(i8::from(row.alive));
    }
}

impl Scene<'_> {
    #[inline]
    fn of_node(&self, node: NodeId) -> Row {
        let nodes = &self.plant.nodes;
        let i = node.index();
        Row {
            component: nodes.component[i],
            parent: number_of(self.plant, nodes.parent[i]),
            axis: nodes.axis[i],
            kind: kind_of(self.plant, node),
            rank: nodes.rank[i],
            birth: nodes.birth[i],
            frame: self.plant.frames.at(node),
            length: nodes.length[i],
            diameter: nodes.diameter[i],
            diameter_tip: nodes.diameter_tip[i],
            area: f32::NAN,
            alive: self.age < nodes.death[i],
        }
    }

    #[inline]
    fn of_organ(&self, organ: OrganId) -> Row {
        let Plant { organs, nodes, .. } = self.plant;
        let i = organ.index();
        let node = organs.node[i];
        Row {
            component: organs.component[i],
            parent: nodes.component[node.index()] as i32,
            axis: nodes.axis[node.index()],
            kind: organs.kind[i],
            rank: nodes.rank[node.index()],
            birth: organs.birth[i],
            frame: organ_frame(self.plant, organ),
            length: organs.length[i],
            diameter: organs.width[i],
            diameter_tip: f32::NAN,
            area: area_of(organs.area[i]),
            alive: true,
        }
    }

    #[inline]
    fn of_bud(&self, axis: AxisId) -> Row {
        let Plant { axes, nodes, .. } = self.plant;
        let tip = self.standing.tip(axis).some();
        Row {
            component: axes.component[axis.index()],
            parent: number_of(self.plant, axes.bearer[axis.index()]),
            axis,
            kind: Kind::ApicalBud,
            rank: tip.map_or(0, |tip| nodes.rank[tip.index()]),
            birth: axes.appearance[axis.index()],
            frame: tip.map_or_else(|| start_frame(self.plant, axis), |tip| node_frame(self.plant, tip)),
            length: f32::NAN,
            diameter: f32::NAN,
            diameter_tip: f32::NAN,
            area: f32::NAN,
            alive: true,
        }
    }
}

/// The component number of a node, or null.
#[inline]
pub fn number_of(plant: &Plant, node: NodeId) -> i32 {
    node.some().map_or(NULL, |node| plant.nodes.component[node.index()] as i32)
}

/// Whether an internode is long or short.
#[inline]
pub fn kind_of(plant: &Plant, node: NodeId) -> Kind {
    if plant.nodes.formation[node.index()].is_short() { Kind::ShortInternode } else { Kind::Internode }
}

/// An area, or what stands for null where area means nothing.
#[inline]
pub fn area_of(area: f32) -> f32 {
    if area > 0.0 { area } else { f32::NAN }
}

// A kind's number is its place in the list of words.
const _: () = assert!(KINDS.len() == Kind::ALL.len() && Kind::ApicalBud as usize == KINDS.len() - 1);
