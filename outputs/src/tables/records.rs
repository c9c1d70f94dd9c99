//! The rows of `records`: de Reffye's record (1988 §6) of each component that stands at an age, with its pose.
//!
//! Positions and directions are those of the pose; diameters those of the recorded age. The columns of mechanics are
//! filled where a run asks for them. Absent: any formula of growth or of bending.

use super::buffers::{NULL, columns};
use super::columns::KINDS;
use super::standing::{Component, Standing};
use phytomer_sim::Tick;
use phytomer_sim::mechanics::wood_volume;
use phytomer_sim::plant::{AxisId, InternodeLook, Kind, NodeId, OrganId, Plant};
use phytomer_sim::pose::{Frame, node_frame, organ_frame, start_frame};

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
        wood_volume: Float(f32), fresh_mass: Float(f32), curvature: Float(f32), moment: Float(f32),
    }
}

/// What one component puts into a row; NaN and −1 are nulls.
pub struct Row {
    component: u32,
    parent: i32,
    axis: u32,
    order: u8,
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
    /// Whether the columns of mechanics are wanted.
    pub mechanics: bool,
}

/// What one component puts into the columns of mechanics; NaN is null.
#[derive(Debug, Clone, Copy)]
struct Loaded {
    wood_volume: f32,
    fresh_mass: f32,
    curvature: f32,
    moment: f32,
}

impl Loaded {
    const NONE: Self = Self { wood_volume: f32::NAN, fresh_mass: f32::NAN, curvature: f32::NAN, moment: f32::NAN };
}

impl RecordColumns {
    /// Adds a row for each of the components `numbers` of a plant in the plot of a number; `rows` is memory to work in.
    pub fn fill(&mut self, plot: u32, scene: &Scene<'_>, numbers: &[u32], rows: &mut Vec<Row>) {
        rows.clear();
        let mut bearing = Bearing::of(scene, AxisId::TRUNK);
        rows.extend(numbers.iter().map(|&number| match scene.standing.component(number) {
            Component::Node(node) => scene.of_node(node, &mut bearing),
            Component::Organ(organ) => scene.of_organ(organ, &mut bearing),
            Component::Bud(axis) => scene.of_bud(axis),
        }));
        // Column by column out of the cache, which is several times as fast as pushing row by row to 25 columns.
        self.push_identity(rows);
        self.push_pose(rows);
        if scene.mechanics {
            self.push_mechanics(scene, numbers);
        }
        let rows = self.component.len();
        self.treatment.resize(rows, 0);
        self.plot.resize(rows, plot as i32);
        self.plant.resize(rows, scene.plant.id as i32);
        self.age.resize(rows, scene.age as i32);
    }

    fn push_identity(&mut self, rows: &[Row]) {
        self.component.extend(rows.iter().map(|row| row.component as i32));
        self.parent.extend(rows.iter().map(|row| row.parent));
        self.axis.extend(rows.iter().map(|row| row.axis as i32));
        self.order.extend(rows.iter().map(|row| i32::from(row.order)));
        self.kind.extend(rows.iter().map(|row| row.kind as i8));
        self.rank.extend(rows.iter().map(|row| row.rank as i32));
        self.birth.extend(rows.iter().map(|row| row.birth as i32));
        self.alive.extend(rows.iter().map(|row| i8::from(row.alive)));
    }

    fn push_pose(&mut self, rows: &[Row]) {
        self.x.extend(rows.iter().map(|row| row.frame.base[0]));
        self.y.extend(rows.iter().map(|row| row.frame.base[1]));
        self.z.extend(rows.iter().map(|row| row.frame.base[2]));
        self.dir_x.extend(rows.iter().map(|row| row.frame.heading[0]));
        self.dir_y.extend(rows.iter().map(|row| row.frame.heading[1]));
        self.dir_z.extend(rows.iter().map(|row| row.frame.heading[2]));
        self.up_x.extend(rows.iter().map(|row| row.frame.up[0]));
        self.up_y.extend(rows.iter().map(|row| row.frame.up[1]));
        self.up_z.extend(rows.iter().map(|row| row.frame.up[2]));
        self.length.extend(rows.iter().map(|row| row.length));
        self.diameter.extend(rows.iter().map(|row| row.diameter));
        self.diameter_tip.extend(rows.iter().map(|row| row.diameter_tip));
        self.area.extend(rows.iter().map(|row| row.area));
    }

    fn push_mechanics(&mut self, scene: &Scene<'_>, numbers: &[u32]) {
        for number in numbers {
            let loaded = scene.loaded(scene.standing.component(*number));
            self.wood_volume.push(loaded.wood_volume);
            self.fresh_mass.push(loaded.fresh_mass);
            self.curvature.push(loaded.curvature);
            self.moment.push(loaded.moment);
        }
    }
}

/// What the components of one axis share. Most follow one of the same axis.
struct Bearing<'a> {
    axis: AxisId,
    component: u32,
    order: u8,
    look: &'a InternodeLook,
    alive: bool,
}

impl<'a> Bearing<'a> {
    fn of(scene: &Scene<'a>, axis: AxisId) -> Self {
        let axes = &scene.plant.axes;
        Self {
            axis,
            component: axes.component[axis.index()],
            order: axes.order[axis.index()],
            look: scene.plant.look_of(axis),
            alive: scene.age < axes.death[axis.index()],
        }
    }

    /// The look of one of its internodes.
    #[inline]
    fn look_of(&self, plant: &'a Plant, node: NodeId) -> &'a InternodeLook {
        if plant.own_looks.is_empty() { self.look } else { plant.look_of_node(node) }
    }

    #[inline]
    fn turn_to(&mut self, scene: &Scene<'a>, axis: AxisId) {
        if self.axis != axis {
            *self = Self::of(scene, axis);
        }
    }
}

impl<'a> Scene<'a> {
    #[inline]
    fn of_node(&self, node: NodeId, bearing: &mut Bearing<'a>) -> Row {
        let nodes = &self.plant.nodes;
        let i = node.index();
        bearing.turn_to(self, nodes.axis[i]);
        Row {
            component: nodes.component[i],
            parent: number_of(self.plant, nodes.parent[i]),
            axis: bearing.component,
            order: bearing.order,
            kind: bearing.look_of(self.plant, node).kind(nodes.formation[i].is_short()),
            rank: nodes.rank[i],
            birth: nodes.birth[i],
            frame: self.plant.frames.at(node),
            length: self.plant.posed_length(node),
            diameter: nodes.diameter[i],
            diameter_tip: nodes.diameter_tip[i],
            area: f32::NAN,
            alive: bearing.alive,
        }
    }

    #[inline]
    fn of_organ(&self, organ: OrganId, bearing: &mut Bearing<'a>) -> Row {
        let Plant { organs, nodes, .. } = self.plant;
        let i = organ.index();
        let node = organs.node[i];
        bearing.turn_to(self, nodes.axis[node.index()]);
        let share = self.plant.expanded(organ, self.age);
        Row {
            component: organs.component[i],
            parent: nodes.component[node.index()] as i32,
            axis: bearing.component,
            order: bearing.order,
            kind: organs.kind[i],
            rank: nodes.rank[node.index()],
            birth: organs.birth[i],
            frame: organ_frame(self.plant, organ, self.age),
            length: organs.length[i] * share,
            diameter: organs.width[i] * share,
            diameter_tip: f32::NAN,
            area: area_of(self.plant.organ_area(organ, self.age)),
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
            axis: axes.component[axis.index()],
            order: axes.order[axis.index()],
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

impl Scene<'_> {
    fn loaded(&self, component: Component) -> Loaded {
        match component {
            Component::Node(node) => self.loaded_node(node),
            Component::Organ(organ) => self.loaded_organ(organ),
            Component::Bud(_) => Loaded::NONE,
        }
    }

    fn loaded_node(&self, node: NodeId) -> Loaded {
        let Plant { nodes, axes, strain, .. } = self.plant;
        let i = node.index();
        let volume = wood_volume(self.plant, node);
        let wood = self.plant.habit.wood.as_ref();
        let tissue = wood.map(|wood| wood.tissue(axes.order[nodes.axis[i].index()]));
        let density = tissue.filter(|tissue| !tissue.density.is_empty());
        let mass = density.map(|tissue| (volume * tissue.density(self.age - nodes.birth[i])) as f32);
        let bends = wood.is_some_and(|wood| wood.bends);
        Loaded {
            wood_volume: volume as f32,
            fresh_mass: mass.unwrap_or(f32::NAN),
            curvature: if bends { strain.curvature_of(i) } else { f32::NAN },
            moment: if bends { strain.moment_of(i) } else { f32::NAN },
        }
    }

    fn loaded_organ(&self, organ: OrganId) -> Loaded {
        let mass =
            self.plant.habit.wood.as_ref().map(|wood| wood.organs.of(self.plant, organ.index(), self.age) as f32);
        Loaded { fresh_mass: mass.unwrap_or(f32::NAN), ..Loaded::NONE }
    }
}

/// The component number of a node, or null.
#[inline]
pub fn number_of(plant: &Plant, node: NodeId) -> i32 {
    node.some().map_or(NULL, |node| plant.nodes.component[node.index()] as i32)
}

/// An area, or what stands for null where area means nothing.
#[inline]
pub fn area_of(area: f32) -> f32 {
    if area > 0.0 { area } else { f32::NAN }
}

// A kind's number is its place in the list of words.
const _: () = assert!(KINDS.len() == Kind::ALL.len() && Kind::Strobilus as usize == KINDS.len() - 1);
