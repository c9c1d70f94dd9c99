//! Texture coordinates of bark in metres, and leaf normals that point out of the crown.
//!
//! A mesh has texture coordinates from 0 to 1 around and along each internode, so that a bark texture would be as fine
//! on a twig as it is coarse on the trunk. Here it covers the same length everywhere. Leaf normals that point out of
//! the crown shade it as one round body, without the noise of single leaves. Absent: textures themselves.

use super::chunk::Vertex;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{Class, NodeId, OrganId, Plant};

/// Bark of the same density on all stems.
#[derive(Debug, Clone)]
pub struct Bark {
    /// The length that the texture covers, metres.
    metres: f32,
    /// For each internode, how far its base is from the base of its axis, metres.
    along: Vec<f32>,
    /// For each axis, how often the texture goes around it.
    around: Vec<f32>,
}

impl Bark {
    /// The bark of `plant` at `age`, of which `metres` have one texture.
    ///
    /// Around an axis the texture stands a whole number of times, the nearest to its circumference, so that no seam is
    /// seen; on an axis that is thinner than the texture it is a part of it, with a seam. The circumference is the mean
    /// of the axis, each part by its surface.
    pub fn of(plant: &Plant, age: Tick, metres: f32) -> Self {
        let mut along = vec![0.0; plant.nodes.len()];
        let mut axes = vec![[0.0_f64; 3]; plant.axes.len()];
        for node in (0..plant.nodes.len()).filter(|node| plant.stands(NodeId(*node as u32), age)) {
            let length = f64::from(plant.posed_length(NodeId(node as u32)));
            let diameter = 0.5 * (f64::from(plant.nodes.diameter[node]) + f64::from(plant.nodes.diameter_tip[node]));
            let [before, surface, squares] = &mut axes[plant.nodes.axis[node].index()];
            along[node] = *before as f32;
            *before += length;
            *surface += diameter * length;
            *squares += diameter * diameter * length;
        }
        let around = axes.iter().map(|[_, surface, squares]| {
            let mean = if *surface > 0.0 { std::f64::consts::PI * squares / surface } else { 0.0 };
            let times = mean / f64::from(metres);
            (if times < 1.0 { times } else { times.round() }) as f32
        });
        Self { metres, around: around.collect(), along }
    }

    /// The length that the texture covers, metres.
    pub fn metres(&self) -> f32 {
        self.metres
    }

    /// Writes the texture coordinates of the sides of an internode, which have 0 at its base and 1 at its tip.
    pub fn dress(&self, plant: &Plant, node: NodeId, sides: &mut [Vertex]) {
        let length = plant.posed_length(node);
        sides.iter_mut().for_each(|vertex| self.put(plant, node, vertex.texture()[1] * length, vertex));
    }

    /// Writes the texture coordinates of a ring at the base of an internode, or at its tip.
    pub fn dress_ring(&self, plant: &Plant, node: NodeId, end: bool, ring: &mut [Vertex]) {
        let above = if end { plant.posed_length(node) } else { 0.0 };
        ring.iter_mut().for_each(|vertex| self.put(plant, node, above, vertex));
    }

    fn put(&self, plant: &Plant, node: NodeId, above: f32, vertex: &mut Vertex) {
        let around = self.around[plant.nodes.axis[node.index()].index()];
        vertex.set_texture([vertex.texture()[0] * around, (self.along[node.index()] + above) / self.metres]);
    }
}

/// The crown of a plant: the ellipsoid that its leaves fill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crown {
    /// Its middle, metres.
    middle: [f32; 3],
    /// Half of its extent along each axis, metres.
    half: [f32; 3],
}

impl Crown {
    /// The crown in the box around the bases of its leaves; `None` where there are none.
    pub fn around(bases: impl Iterator<Item = [f32; 3]>) -> Option<Self> {
        let boxed = bases.fold(None, |found: Option<[[f32; 3]; 2]>, at| {
            let [low, high] = found.unwrap_or([at, at]);
            Some([std::array::from_fn(|k| low[k].min(at[k])), std::array::from_fn(|k| high[k].max(at[k]))])
        });
        boxed.map(|[low, high]| Self {
            middle: std::array::from_fn(|k| 0.5 * (low[k] + high[k])),
            half: std::array::from_fn(|k| (0.5 * (high[k] - low[k])).max(f32::EPSILON)),
        })
    }

    /// Points the normals of a leaf out of the crown: across the ellipsoid through each vertex.
    pub fn dress(&self, out: &mut [Vertex]) {
        for vertex in out {
            let at = vertex.position();
            let across: [f32; 3] = std::array::from_fn(|k| (at[k] - self.middle[k]) / (self.half[k] * self.half[k]));
            let length = across.iter().map(|x| x * x).sum::<f32>().sqrt();
            if length > f32::MIN_POSITIVE && length.is_finite() {
                vertex.set_normal(across.map(|x| x / length));
            }
        }
    }
}

/// Whether an organ is a leaf or a part of one.
pub fn is_leaf(plant: &Plant, organ: OrganId) -> bool {
    plant.organs.kind[organ.index()].class() == Class::Leaf
}

#[cfg(test)]
mod tests {
    use super::super::chunk::Tag;
    use super::*;

    #[test]
    fn normals_stand_across_the_ellipsoid() {
        let crown = Crown { middle: [0.0, 0.0, 5.0], half: [2.0, 2.0, 4.0] };
        let tag = Tag { colour: [9; 4], birth: 1.0, death: f32::INFINITY, component: 0, kind: 0 };
        let mut out = [[0.0, 0.0, 9.0], [1.0, 0.0, 5.0], [1.0, 0.0, 7.0], [0.0, 0.0, 5.0]]
            .map(|at| Vertex::new(at, [0.0, 1.0, 0.0], [0.0; 2], &tag));
        crown.dress(&mut out);
        // x/4 : z/16 at (1, 2) is 2 : 1.
        let (along, up) = (2.0 / 5.0_f32.sqrt(), 1.0 / 5.0_f32.sqrt());
        for (vertex, normal) in out.iter().zip([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [along, 0.0, up], [0.0, 1.0, 0.0]]) {
            assert!((0..3).all(|k| (vertex.normal()[k] - normal[k]).abs() < 1e-6), "{:?}", vertex.normal());
        }
    }
}
