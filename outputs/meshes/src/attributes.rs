//! Numbers of a vertex for shaders: order, radius, path length from the ground, and a phase.
//!
//! The path goes along the axis lines from the seed to the place beside the vertex; of an organ it goes on from its
//! node straight to the vertex. The phase is a number from 0 to 1 made of the lineage key: of an internode that of
//! its axis, so that a branch moves as one, of an organ its own. It is equal at every age. Absent: how vertices get
//! them (`columns`).

use phytomer_sim::plant::{LineageKey, NodeId, OrganId, Plant};

/// Their names.
pub const NAMES: [&str; 4] = ["order", "radius_m", "path_m", "phase"];

/// The numbers of the components of a plant.
#[derive(Debug, Clone)]
pub struct Attributes {
    /// For each internode the length of the path from the ground to its base, metres.
    path: Vec<f32>,
    /// For each component its phase, and whether it is an organ.
    phases: Vec<(f32, bool)>,
}

impl Attributes {
    /// Those of a posed plant. Takes O(n) for n components.
    pub fn of(plant: &Plant) -> Self {
        let nodes = &plant.nodes;
        let mut path = vec![0.0; nodes.len()];
        for node in 0..nodes.len() {
            let Some(bearer) = nodes.parent[node].some() else { continue };
            let (below, length) = (plant.frames.at(bearer), plant.posed_length(bearer));
            let base = plant.frames.base[node];
            let along: f32 = (0..3).map(|k| (base[k] - below.base[k]) * below.heading[k]).sum();
            path[node] = path[bearer.index()] + along.clamp(0.0, length);
        }
        let mut phases = vec![(0.0, false); plant.components() as usize];
        for (node, component) in nodes.component.iter().enumerate() {
            phases[*component as usize] = (phase(plant.axes.key[nodes.axis[node].index()]), false);
        }
        for (organ, component) in plant.organs.component.iter().enumerate() {
            phases[*component as usize] = (phase(plant.organ_key(OrganId(organ as u32))), true);
        }
        Self { path, phases }
    }

    /// The numbers of a vertex of a component on an internode, `along` metres from its base, at a place.
    pub fn at(&self, plant: &Plant, (component, node): (usize, NodeId), (along, place): (f32, [f32; 3])) -> [f32; 4] {
        let (phase, is_organ) = self.phases.get(component).copied().unwrap_or_default();
        let nodes = &plant.nodes;
        let (at, length) = (node.index(), plant.posed_length(node));
        let order = f32::from(plant.axes.order[nodes.axis[at].index()]);
        if is_organ {
            let tip = plant.frames.at(node).advanced(length).base;
            let apart = (0..3).map(|k| (place[k] - tip[k]) * (place[k] - tip[k])).sum::<f32>().sqrt();
            return [order, 0.0, self.path[at] + length + apart, phase];
        }
        let share = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 0.0 };
        let radius = 0.5 * (nodes.diameter[at] + share * (nodes.diameter_tip[at] - nodes.diameter[at]));
        [order, radius, self.path[at] + share * length, phase]
    }
}

/// A number from 0 to 1 of a key: its upper 24 bits, which single precision holds.
fn phase(key: LineageKey) -> f32 {
    (key.0 >> 40) as f32 / (1_u32 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::super::columns::Columns;
    use super::super::tests::specimen;
    use super::super::{MeshOptions, Scene, mesh_plant};
    use super::*;

    /// Internodes of 0.1 m, 0.03 m wide at the base and 0.02 m at the tip; the branch leaves the third of the trunk.
    #[test]
    fn vertices_tell_order_radius_and_path() {
        let mut plant = specimen();
        plant.axes.key[1] = LineageKey(!plant.axes.key[0].0);
        let options = MeshOptions { attributes: true, ..MeshOptions::default() };
        let scene = Scene::new(&plant, 6, &options);
        let columns = scene.columns().expect("columns");
        assert_eq!(columns.names(), NAMES);
        let mut phases = std::collections::BTreeMap::new();
        for vertex in mesh_plant(&plant, 6, &MeshOptions::default()).vertices {
            let mut row = Vec::new();
            Columns::put(columns, &vertex, &mut row);
            let component = vertex.tag().component as u32;
            let Some(node) = plant.nodes.component.iter().position(|number| *number == component) else {
                assert_eq!((row[0], row[1]), (1.0, 0.0));
                assert!(row[2] >= 0.5 - 1e-6 && (0.0..1.0).contains(&row[3]), "{row:?}");
                continue;
            };
            let rank = plant.nodes.rank[node] - 1;
            let (order, before) = if plant.nodes.axis[node].index() == 0 { (1.0, 0) } else { (2.0, 3) };
            let frame = plant.frames.at(NodeId(node as u32));
            let along: f32 = (0..3).map(|k| (vertex.position()[k] - frame.base[k]) * frame.heading[k]).sum();
            let path = 0.1 * (before + rank) as f32 + along;
            assert_eq!(row[0], order);
            assert!((row[1] - (0.015 - 0.05 * along)).abs() < 1e-5, "{row:?} {along}");
            assert!((row[2] - path).abs() < 1e-5, "{row:?} {path}");
            phases.entry(plant.nodes.axis[node].index()).or_insert_with(Vec::new).push(row[3]);
        }
        assert!(phases.values().all(|of| of.iter().all(|phase| *phase == of[0])));
        assert!(phases[&0][0] != phases[&1][0]);
    }
}
