//! Texture coordinates of bark in metres, and leaf normals that point out of the crown.
//!
//! A mesh has texture coordinates from 0 to 1 around and along each internode, so that a bark texture would be as fine
//! on a twig as it is coarse on the trunk. Here it covers the same length everywhere. Leaf normals that point out of
//! the crown shade it as one round body, without the noise of single leaves. Absent: textures themselves.

use super::chunk::Vertex;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{Class, NodeId, OrganId, Plant};

/// Bark of the same density on all stems.
///
/// Around an axis the texture stands a whole number of times, the nearest to its circumference and at least once, so
/// that no seam is seen. Along it the texture covers its own length; on an axis that is thinner than the texture is
/// wide it covers as much less as it does around it, so that its picture is not drawn out. The circumference is the
/// mean of the axis, each part by its surface. Where the axis has it, a picture is from 3/4 to 3/2 as wide as it should
/// be for its length.
#[derive(Debug, Clone)]
pub struct Bark {
    /// For each internode, how far its base is from the base of its axis, metres.
    along: Vec<f32>,
    /// For each axis, how often the texture goes around it, and the length that it covers along it, metres; `None`
    /// where the axis has no such bark.
    covers: Vec<Option<[f32; 2]>>,
    /// For each order the width and the length of its texture, metres.
    sizes: Vec<Option<[f32; 2]>>,
}

/// How often a texture of a width and a length goes around a stem of a mean circumference, and the length that it
/// covers along it, metres.
pub fn bark_covers([wide, long]: [f32; 2], around: f64) -> [f32; 2] {
    let times = around / f64::from(wide);
    if times >= 1.0 {
        return [times.round() as f32, long];
    }
    // Of a stem without a width any length will do.
    let shrunk = times.max(LEAST_SHARE);
    [1.0, (f64::from(long) * shrunk) as f32]
}

/// The least share of its length to which a texture shrinks on thin stems.
const LEAST_SHARE: f64 = 1e-3;

impl Bark {
    /// The bark of `plant` at `age`; `size` tells how many metres of bark of an order one texture is wide and long.
    /// `None` where no order has any.
    pub fn of(plant: &Plant, age: Tick, size: impl Fn(u8) -> Option<[f32; 2]>) -> Option<Self> {
        let last = plant.axes.order.iter().copied().max().unwrap_or(0);
        let sizes: Vec<Option<[f32; 2]>> = (0..=last).map(|order| size(order.max(1))).collect();
        if sizes.iter().all(Option::is_none) {
            return None;
        }
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
        let covers = axes.iter().zip(&plant.axes.order).map(|([_, surface, squares], order)| {
            let mean = if *surface > 0.0 { std::f64::consts::PI * squares / surface } else { 0.0 };
            sizes[usize::from(*order)].map(|size| bark_covers(size, mean))
        });
        Some(Self { covers: covers.collect(), along, sizes })
    }

    /// How many metres of bark the texture of an internode is wide and long.
    pub fn size(&self, plant: &Plant, node: NodeId) -> Option<[f32; 2]> {
        let order = plant.axes.order[plant.nodes.axis[node.index()].index()];
        self.sizes.get(usize::from(order)).copied().flatten()
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
        let Some([around, long]) = self.covers[plant.nodes.axis[node.index()].index()] else { return };
        vertex.set_texture([vertex.texture()[0] * around, (self.along[node.index()] + above) / long]);
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
