//! The welded surface is a sphere, whatever stands where, and has the volume of what is welded.
//!
//! How the surface hangs together is counted: each edge is passed once either way, vertices − edges + triangles = 2,
//! all is in one piece, and no two vertices are at one place. Volumes are those of closed forms.

use super::super::{Joints, Mesh, MeshOptions, Tolerance, mesh_plant};
use phytomer_sim::math::{cos, sin};
use phytomer_sim::plant::*;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A plant whose internodes state where they are.
pub struct Sketch {
    pub plant: Plant,
}

impl Sketch {
    pub fn new() -> Self {
        let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 100_000, keep_events: false };
        let habit = Habit { looks: Looks::of_shape(Shape::Cone), ..Habit::default() };
        Self { plant: Plant::new(&seed, Arc::new(habit)) }
    }

    pub fn axis(&mut self, bearer: Option<NodeId>) -> AxisId {
        self.plant.add_axis(NewAxis { bearer, order: 1 + u8::from(bearer.is_some()), ..NewAxis::OF_THE_SEED })
    }

    /// An internode from a place to another, with its radii.
    pub fn internode(&mut self, axis: AxisId, parent: Option<NodeId>, ends: [[f64; 3]; 2], radii: [f64; 2]) -> NodeId {
        let [from, to] = ends;
        let way: [f64; 3] = [0, 1, 2].map(|k| to[k] - from[k]);
        let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
        let heading = if length > 0.0 { way.map(|x| (x / length) as f32) } else { [0.0, 0.0, 1.0] };
        let rank = 1 + parent
            .filter(|p| self.plant.nodes.axis[p.index()] == axis)
            .map_or(0, |p| self.plant.nodes.rank[p.index()]);
        let parent = parent.unwrap_or(NodeId::NONE);
        let node = NewNode {
            parent,
            axis,
            birth: 1,
            rank,
            length: length as f32,
            diameter: 2.0 * radii[0] as f32,
            ..NewNode::OF_THE_TRUNK
        };
        let id = self.plant.add_node(node);
        self.plant.nodes.diameter_tip[id.index()] = 2.0 * radii[1] as f32;
        self.plant.frames.base.push(from.map(|x| x as f32));
        self.plant.frames.heading.push(heading);
        let flat = if heading[2].abs() > 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let along: f32 = (0..3).map(|k| flat[k] * heading[k]).sum();
        let up: [f32; 3] = [0, 1, 2].map(|k| flat[k] - along * heading[k]);
        let norm = up.iter().map(|x| x * x).sum::<f32>().sqrt();
        self.plant.frames.up.push(up.map(|x| x / norm));
        id
    }

    pub fn welded(&self, sides: u8, tolerance: Option<f32>) -> Mesh {
        let tolerance = tolerance.map(Tolerance::of);
        let options = MeshOptions { sides, joints: Joints::Welded, tolerance, ..MeshOptions::default() };
        let mesh = mesh_plant(&self.plant, 1, &options);
        assert_sphere(&mesh);
        mesh
    }
}

/// Counts how a mesh hangs together.
pub fn assert_sphere(mesh: &Mesh) {
    let mut edges = BTreeMap::new();
    for face in &mesh.faces {
        let corners = face.indices();
        for k in 0..3 {
            *edges.entry((corners[k], corners[(k + 1) % 3])).or_insert(0) += 1;
        }
    }
    assert!(
        edges.iter().all(|((a, b), count)| *count == 1 && edges.get(&(*b, *a)) == Some(&1)),
        "an edge is not two-sided"
    );
    let used: BTreeSet<u32> = mesh.faces.iter().flat_map(|face| face.indices()).collect();
    assert_eq!(used.len(), mesh.vertices.len(), "a vertex without a triangle");
    assert_eq!(mesh.vertices.len() + mesh.faces.len(), edges.len() / 2 + 2, "Euler's number is not 2");
    let mut piece: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
    fn root(piece: &mut [u32], mut at: u32) -> u32 {
        while piece[at as usize] != at {
            piece[at as usize] = piece[piece[at as usize] as usize];
            at = piece[at as usize];
        }
        at
    }
    for (a, b) in edges.keys() {
        let [a, b] = [*a, *b].map(|corner| root(&mut piece, corner));
        piece[a as usize] = b;
    }
    let roots: BTreeSet<u32> = (0..piece.len() as u32).map(|at| root(&mut piece, at)).collect();
    assert_eq!(roots.len(), 1, "pieces");
    let places: BTreeSet<[u32; 3]> =
        mesh.vertices.iter().map(|vertex| vertex.position().map(|x| (x + 0.0).to_bits())).collect();
    assert_eq!(places.len(), mesh.vertices.len(), "two vertices at one place");
    assert!(mesh.vertices.iter().flat_map(|vertex| vertex.position()).all(f32::is_finite));
    for vertex in &mesh.vertices {
        let square: f32 = vertex.normal().iter().map(|x| x * x).sum();
        assert!((square - 1.0).abs() < 1e-4, "a normal of {square}");
    }
}

pub fn volume(mesh: &Mesh) -> f64 {
    super::super::measure::volume(&mesh.vertices, &mesh.faces)
}

/// A trunk of 2 m along z, with a node at every tenth.
pub fn trunk(sketch: &mut Sketch, radius: f64) -> Vec<NodeId> {
    let axis = sketch.axis(None);
    let mut parent = None;
    (0..20)
        .map(|k| {
            let [from, to] = [k, k + 1].map(|k| [0.0, 0.0, 0.1 * f64::from(k)]);
            let node = sketch.internode(axis, parent, [from, to], [radius; 2]);
            parent = Some(node);
            node
        })
        .collect()
}

fn branch(
    sketch: &mut Sketch,
    bearer: NodeId,
    at: [f64; 3],
    [azimuth, insertion]: [f64; 2],
    [length, radius]: [f64; 2],
) -> NodeId {
    let axis = sketch.axis(Some(bearer));
    let way = [sin(insertion) * cos(azimuth), sin(insertion) * sin(azimuth), cos(insertion)];
    let to = [0, 1, 2].map(|k| at[k] + length * way[k]);
    sketch.internode(axis, Some(bearer), [at, to], [radius; 2])
}

/// Two equal cylinders that cross at a right angle share Steinmetz' 16/3 r³; one that ends in the other's axis, half.
#[test]
fn a_branch_as_thick_as_its_bearer_has_the_volume_of_a_t() {
    let (r, length) = (0.1, 1.0);
    for azimuth in [0.0, 0.4, 2.0, 3.1, 5.5] {
        let mut sketch = Sketch::new();
        let nodes = trunk(&mut sketch, r);
        branch(&mut sketch, nodes[9], [0.0, 0.0, 1.0], [azimuth, PI / 2.0], [length, r]);
        let expected = PI * r * r * (2.0 + length) - 8.0 / 3.0 * r * r * r;
        let measured = volume(&sketch.welded(48, None));
        assert!((measured / expected - 1.0).abs() < 0.004, "{azimuth}: {measured} {expected}");
    }
}

/// Of a thin branch the first R is inside the trunk.
#[test]
fn thin_branches_begin_where_they_come_out() {
    for insertion in [0.5, 1.0, PI / 2.0, 2.2] {
        let mut sketch = Sketch::new();
        let nodes = trunk(&mut sketch, 0.1);
        branch(&mut sketch, nodes[9], [0.0, 0.0, 1.0], [1.0, insertion], [1.0, 0.02]);
        let expected = PI * (0.1 * 0.1 * 2.0 + 0.02 * 0.02 * (1.0 - 0.1 / sin(insertion)));
        let measured = volume(&sketch.welded(32, None));
        assert!((measured / expected - 1.0).abs() < 1e-3, "{insertion}: {measured} {expected}");
    }
}

/// A bend has no more than the volume of both tubes, and no less than what their ends share.
#[test]
fn bends_keep_the_volume() {
    for turned in [0.2_f64, 0.8, 1.4] {
        let mut sketch = Sketch::new();
        let axis = sketch.axis(None);
        let first = sketch.internode(axis, None, [[0.0; 3], [0.0, 0.0, 1.0]], [0.1; 2]);
        let to = [sin(turned), 0.0, 1.0 + cos(turned)];
        sketch.internode(axis, Some(first), [[0.0, 0.0, 1.0], to], [0.1; 2]);
        let half = 0.5 * turned;
        let expected = PI * 0.1 * 0.1 * 2.0 - 4.0 / 3.0 * 0.001 * sin(half) / cos(half);
        let measured = volume(&sketch.welded(48, None));
        assert!((measured / expected - 1.0).abs() < 0.003, "{turned}: {measured} {expected}");
    }
}

/// Many branches at one node, also of one azimuth, also twins at one place, also as thick as the trunk.
#[test]
fn any_number_of_branches_leaves_one_node() {
    for count in [1_u32, 2, 3, 5, 8, 40, 200] {
        for radius in [0.001, 0.03, 0.1, 0.3] {
            for spread in [TAU, 1.0, 0.0] {
                let mut sketch = Sketch::new();
                let nodes = trunk(&mut sketch, 0.1);
                for k in 0..count {
                    let azimuth = spread * f64::from(k) / f64::from(count);
                    branch(&mut sketch, nodes[9], [0.0, 0.0, 1.0], [azimuth, 1.0], [1.0, radius]);
                }
                sketch.welded(8, None);
                sketch.welded(3, None);
                sketch.welded(8, Some(0.005));
            }
        }
    }
}

/// Whatever a file states: internodes without length or width, branches beside their bearers, within them, along them
/// and back, far away, and thicker. The draws are those of a fixed sequence.
#[test]
fn whatever_stands_is_a_sphere() {
    let mut state = 1_u64;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31)
    };
    for _ in 0..300 {
        let mut sketch = Sketch::new();
        let mut stood: Vec<(NodeId, AxisId, [f64; 3])> = Vec::new();
        for _ in 0..(3.0 + 40.0 * draw()) as u32 {
            let chosen = (draw() * stood.len() as f64) as usize;
            let bearer = stood.get(chosen).copied();
            let goes_on = draw() < 0.5;
            let axis = match bearer {
                Some((node, axis, _)) if goes_on && sketch.plant.axes.last_node[axis.index()] == node => axis,
                _ => sketch.axis(bearer.map(|(node, ..)| node)),
            };
            let size = [0.0, 0.01, 0.1, 1.0, 10.0][(draw() * 5.0) as usize];
            let mut from = bearer.map_or([0.0; 3], |(.., tip)| tip);
            if draw() < 0.2 {
                from = from.map(|x| x + 0.3 * (draw() - 0.5));
            }
            let to = from.map(|x| x + size * (draw() - 0.5));
            let mut radius = || [0.0, 1e-7, 1e-3, 0.02, 0.1, 0.5][(draw() * 6.0) as usize];
            let radii = [radius(), radius()];
            let node = sketch.internode(axis, bearer.map(|(node, ..)| node), [from, to], radii);
            stood.push((node, axis, to));
        }
        let has_wood =
            sketch.plant.nodes.diameter.iter().chain(&sketch.plant.nodes.diameter_tip).any(|width| *width > 0.0);
        if has_wood {
            let options = MeshOptions { joints: Joints::Welded, ..MeshOptions::default() };
            let apart =
                |node: usize| sketch.plant.nodes.diameter[node].max(sketch.plant.nodes.diameter_tip[node]) <= 0.0;
            // Internodes without a width are drawn by themselves, as ever.
            if (0..sketch.plant.nodes.len()).any(apart) {
                assert!(!mesh_plant(&sketch.plant, 1, &options).faces.is_empty());
            } else {
                sketch.welded(8, None);
                sketch.welded(5, Some(0.01));
            }
        }
    }
}

/// With bark the seam of its texture has vertices of its own at the same places, and u goes once around.
#[test]
fn seams_are_at_the_same_places() {
    let mut sketch = Sketch::new();
    let nodes = trunk(&mut sketch, 0.1);
    branch(&mut sketch, nodes[9], [0.0, 0.0, 1.0], [0.1, 1.0], [1.0, 0.05]);
    let options = MeshOptions { joints: Joints::Welded, bark_m: Some(0.2), ..MeshOptions::default() };
    let mut mesh = mesh_plant(&sketch.plant, 1, &options);
    let shared = sketch.welded(8, None);
    assert_eq!(mesh.faces.len(), shared.faces.len());
    let mut places: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    let ones: Vec<u32> = (mesh.vertices.iter().enumerate())
        .map(|(k, vertex)| *places.entry(vertex.position().map(f32::to_bits)).or_insert(k as u32))
        .collect();
    let mut numbers = BTreeMap::new();
    let faces: Vec<_> = mesh
        .faces
        .iter()
        .map(|face| {
            face.indices().map(|corner| {
                let next = numbers.len() as u32;
                *numbers.entry(ones[corner as usize]).or_insert(next)
            })
        })
        .collect();
    let mut vertices = vec![mesh.vertices[0]; numbers.len()];
    numbers.iter().for_each(|(old, new)| vertices[*new as usize] = mesh.vertices[*old as usize]);
    mesh.vertices = vertices;
    mesh.faces = faces.into_iter().map(super::super::Face::new).collect();
    assert_sphere(&mesh);
}
