//! The plants of a stage as line drawings: a branch for each internode, triangles for leaves, shadows, and stars
//! for controllers.

use super::trees::Tree;
use phytomer_outputs::meshes::{MeshOptions, Scene, mesh_plant};
use phytomer_sim::Tick;
use phytomer_sim::plant::{AxisId, Class, Kind, NodeId, Plant};
use phytomer_strokes::{Branch, Drawing, Fill, Patch, Shadow, Star};

/// Adds a tree, grown to a plant, to a drawing.
pub fn add(drawing: &mut Drawing, tree: &Tree, (plant, age): (&Plant, Tick)) {
    let starts = [drawing.branches.len(), drawing.patches.len()];
    let root = tree.stands_at();
    let at = |place: [f32; 3]| [0, 1, 2].map(|k| root[k] + f64::from(place[k]));
    let kinds = |wanted: fn(Class) -> bool| Kind::ALL.map(|kind| wanted(kind.class()));
    let options = MeshOptions { kinds: kinds(|class| class == Class::Internode), ..MeshOptions::default() };
    let scene = Scene::new(plant, age, &options);
    for node in (0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, age)) {
        let frustum = scene.stems().frustum(node);
        let tip = [0, 1, 2].map(|k| frustum.base[k] + frustum.heading[k] * frustum.length);
        let is_main = plant.nodes.axis[node.index()] == AxisId::TRUNK;
        let form = tree.girth.filter(|form| !form.main_axis || is_main);
        let fill = form.map_or(Fill::FULL, |form| Fill { dense: form.dense, shaded: form.shaded });
        let girth = form.map(|_| frustum.radii.map(|radius| 2.0 * f64::from(radius)));
        drawing.branches.push(Branch { ends: [at(frustum.base), at(tip)], girth, colour: tree.ink(), fill });
    }
    let options = MeshOptions { kinds: kinds(|class| class != Class::Internode), ..MeshOptions::default() };
    let mesh = mesh_plant(plant, age, &options);
    let colour = tree.leaf_colour();
    let leaf = |face: &phytomer_outputs::meshes::Face| Patch {
        corners: face.indices().map(|corner| at(mesh.vertices[corner as usize].position())).to_vec(),
        colour,
    };
    drawing.patches.extend(mesh.faces.iter().map(leaf));
    let star = |(place, filled): ([f64; 3], bool)| Star { place, colour: tree.ink(), filled };
    drawing.stars.extend(tree.controllers().into_iter().map(star));
    if let Some(shade) = tree.shade {
        let shadow = Shadow { emitter: shade.emitter, colour: shade.colour, merged: shade.merged };
        let (branches, patches) = ([starts[0], drawing.branches.len()], [starts[1], drawing.patches.len()]);
        drawing.shadows.push((shadow, branches, patches));
    }
}
