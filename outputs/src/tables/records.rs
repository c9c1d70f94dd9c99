//! The rows of `records`: de Reffye's record (1988 §6) of each component that stands at an age, with its pose.
//!
//! Positions and directions are those of the pose; diameters those of the recorded age. The columns of mechanics are
//! filled for runs that have them. Absent: any formula of growth or of bending.

use super::buffers::{NULL, columns};
use super::component_index::{Component, ComponentIndex};
use super::membership::Membership;
use phytomer_sim::Tick;
use phytomer_sim::mechanics::wood_volume;
use phytomer_sim::plant::{AxisId, InternodeLook, Kind, NodeId, OrganId, Plant};
use phytomer_sim::pose::{Frame, bud_frame, node_frame, organ_frame, start_frame};
use phytomer_sim::site::light::{Field, Lit};

columns! {
    /// The buffers of `records`.
    RecordColumns of row: RecordRow, shown: &PlantAtAge<'_> {
        treatment: Name(i32) = shown.of.treatment as i32,
        plot: Int(i32) = shown.of.plot as i32,
        plant: Int(i32) = shown.plant.id as i32,
        tick: Int(i32) = shown.of.tick_at(shown.age) as i32,
        age: Int(i32) = shown.age as i32,
        component: Int(i32) = row.component as i32,
        parent: Int(i32) = row.parent,
        axis: Int(i32) = row.axis as i32,
        order: Int(i32) = i32::from(row.order),
        kind: Word(i8) = row.kind as i8,
        rank: Int(i32) = row.rank as i32,
        birth: Int(i32) = row.birth as i32,
        x: Float(f32) = row.frame.base[0],
        y: Float(f32) = row.frame.base[1],
        z: Float(f32) = row.frame.base[2],
        dir_x: Float(f32) = row.frame.heading[0],
        dir_y: Float(f32) = row.frame.heading[1],
        dir_z: Float(f32) = row.frame.heading[2],
        up_x: Float(f32) = row.frame.up[0],
        up_y: Float(f32) = row.frame.up[1],
        up_z: Float(f32) = row.frame.up[2],
        length: Float(f32) = row.length,
        diameter: Float(f32) = row.diameter,
        diameter_tip: Float(f32) = row.diameter_tip,
        area: Float(f32) = row.area,
        alive: Bool(i8) = i8::from(row.alive),
        wood_volume: Float(f32),
        fresh_mass: Float(f32),
        curvature: Float(f32),
        moment: Float(f32),
        light: Float(f32),
    }
}

/// The values of one row; NaN and −1 stand for null.
pub struct RecordRow {
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

/// The values that the rows of one plant at one age share.
pub struct PlantAtAge<'a> {
    /// The membership of the plant.
    pub of: Membership,
    /// The plant.
    pub plant: &'a Plant,
    /// Its components by number, with the tips of its axes at the age.
    pub index: &'a ComponentIndex,
    /// Its age.
    pub age: Tick,
    /// Whether the columns of mechanics are filled.
    pub mechanics: bool,
    /// Its light, where the column of light is filled.
    pub lit: Option<LitBy<'a>>,
}

/// The light of a plot; `None` where it has none.
pub type LitBy<'a> = Option<&'a Field>;

/// The values of one row in the columns of mechanics; NaN stands for null.
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
    /// Adds a row for each component in `numbers` of a plant at an age. `rows` is working memory, kept between calls.
    pub fn fill(&mut self, shown: &PlantAtAge<'_>, numbers: &[u32], rows: &mut Vec<RecordRow>) {
        rows.clear();
        let mut bearing = Bearing::of(shown, AxisId::TRUNK);
        rows.reserve(numbers.len());
        rows.extend(numbers.iter().filter_map(|&number| match shown.index.component(number) {
            Component::Node(node) => Some(shown.of_node(node, &mut bearing)),
            Component::Organ(organ) => Some(shown.of_organ(organ, &mut bearing)),
            Component::Bud(axis) => Some(shown.of_bud(axis)),
            // What has left the plant does not stand at the age of its columns.
            Component::Departed(_) => None,
        }));
        // The rows are copied column by column while they are in the cache: several times as fast as pushing to 26
        // columns per row.
        self.extend(rows, shown);
        if shown.mechanics {
            self.push_mechanics(shown, numbers);
        }
        if let Some(lit) = shown.lit {
            self.light.extend(numbers.iter().map(|number| shown.light_of(shown.index.component(*number), lit)));
        }
    }

    fn push_mechanics(&mut self, shown: &PlantAtAge<'_>, numbers: &[u32]) {
        for number in numbers {
            let loaded = shown.loaded(shown.index.component(*number));
            self.wood_volume.push(loaded.wood_volume);
            self.fresh_mass.push(loaded.fresh_mass);
            self.curvature.push(loaded.curvature);
            self.moment.push(loaded.moment);
        }
    }
}

/// The values that the components of one axis share; consecutive components are mostly of one axis.
struct Bearing<'a> {
    axis: AxisId,
    component: u32,
    order: u8,
    look: &'a InternodeLook,
    alive: bool,
}

impl<'a> Bearing<'a> {
    fn of(shown: &PlantAtAge<'a>, axis: AxisId) -> Self {
        let axes = &shown.plant.axes;
        Self {
            axis,
            component: axes.component[axis.index()],
            order: axes.order[axis.index()],
            look: shown.plant.look_of(axis),
            alive: shown.age < axes.death[axis.index()],
        }
    }

    /// The look of one of the axis's internodes.
    #[inline]
    fn look_of(&self, plant: &'a Plant, node: NodeId) -> &'a InternodeLook {
        if plant.own_looks.is_empty() { self.look } else { plant.look_of_node(node) }
    }

    #[inline]
    fn turn_to(&mut self, shown: &PlantAtAge<'a>, axis: AxisId) {
        if self.axis != axis {
            *self = Self::of(shown, axis);
        }
    }
}

impl<'a> PlantAtAge<'a> {
    /// The share of light of a leaf or a bud; NaN of the others, and where the plot has no light.
    pub(super) fn light_of(&self, component: Component, lit: LitBy<'_>) -> f32 {
        let Some(field) = lit else { return f32::NAN };
        let plant = self.plant;
        let place = |frame: &Frame, along: f32| {
            [0, 1, 2].map(|k| plant.place[k] + f64::from(frame.base[k]) + f64::from(frame.heading[k] * along))
        };
        let place = match component {
            Component::Organ(organ) if plant.organs.kind[organ.index()].is_foliage() => {
                let length = plant.organs.length[organ.index()] * plant.expanded(organ, self.age);
                place(&organ_frame(plant, organ, self.age), length / 2.0)
            }
            Component::Bud(axis) => place(&bud_frame(plant, axis), 0.0),
            _ => return f32::NAN,
        };
        field.share_at(place) as f32
    }

    #[inline]
    fn of_node(&self, node: NodeId, bearing: &mut Bearing<'a>) -> RecordRow {
        let nodes = &self.plant.nodes;
        let i = node.index();
        bearing.turn_to(self, nodes.axis[i]);
        RecordRow {
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
    fn of_organ(&self, organ: OrganId, bearing: &mut Bearing<'a>) -> RecordRow {
        let Plant { organs, nodes, .. } = self.plant;
        let i = organ.index();
        let node = organs.node[i];
        bearing.turn_to(self, nodes.axis[node.index()]);
        let share = self.plant.expanded(organ, self.age);
        RecordRow {
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
    fn of_bud(&self, axis: AxisId) -> RecordRow {
        let Plant { axes, nodes, .. } = self.plant;
        let tip = self.index.tip(axis).some();
        RecordRow {
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

impl PlantAtAge<'_> {
    fn loaded(&self, component: Component) -> Loaded {
        match component {
            Component::Node(node) => self.loaded_node(node),
            Component::Organ(organ) => self.loaded_organ(organ),
            Component::Bud(_) | Component::Departed(_) => Loaded::NONE,
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

/// The component number of a node; −1 (null) for no node.
#[inline]
pub fn number_of(plant: &Plant, node: NodeId) -> i32 {
    node.some().map_or(NULL, |node| plant.nodes.component[node.index()] as i32)
}

/// An area, or NaN (null) for a component that has none.
#[inline]
pub fn area_of(area: f32) -> f32 {
    if area > 0.0 { area } else { f32::NAN }
}
