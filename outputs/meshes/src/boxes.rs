//! The boxes around the blocks of a scene: exactly those of their vertices, of which few are made.
//!
//! Pictures and films ask for the box of every block of the full mesh before anything is drawn. The tube of an
//! internode lies in the box around the two balls at its ends, which takes no vertices. Of the tubes of a block those
//! that may reach farthest to each of six sides are made first, and then those that may reach beyond these; the others
//! lie inside. Blocks of organs, and of tubes along several internodes, have few vertices and are made as they are.

use super::Mesh;
use super::blocks::span;
use super::chunk::Vertex;
use super::scene::Scene;
use super::stem::Drawn;
use super::tube::Frustum;
use bytemuck::Zeroable;
use glam::Vec3;
use phytomer_sim::plant::NodeId;
use std::convert::Infallible;

/// Rounding of a vertex, as a share of its distance from the origin in any axis: far more than single precision makes.
const ROUNDING: f32 = 1e-6;

/// A box of nothing.
const NOTHING: [Vec3; 2] = [Vec3::INFINITY, Vec3::NEG_INFINITY];

/// Working memory for the box of a block.
#[derive(Debug, Default)]
pub struct Boxing {
    mesh: Mesh,
    vertices: Vec<Vertex>,
    /// The tubes of single internodes, with a box that holds each.
    tubes: Vec<(NodeId, [Vec3; 2])>,
}

impl Scene<'_> {
    /// The box around the vertices of a block ([`Scene::block`]), to the bit; its lower corner is above its upper
    /// corner where the block is empty.
    pub fn block_box(&self, block: usize, working: &mut Boxing) -> [Vec3; 2] {
        let Some(stems) = self.stem_block(block) else {
            self.block(block, &mut working.mesh);
            return around(NOTHING, &working.mesh.vertices);
        };
        let Boxing { vertices, tubes, .. } = working;
        tubes.clear();
        let mut own = NOTHING;
        let Ok::<(), Infallible>(()) = self.each_stem(span(stems, self.stem_places()), |node| {
            match self.stems().form(node) {
                Drawn::Tube(tube, _) => tubes.push((node, holding(&self.stems().frustum(node), tube.reach()))),
                _ => own = self.with_stem(own, node, vertices),
            }
            Ok(())
        });
        for side in 0..6 {
            let farthest = tubes.iter().max_by(|(_, a), (_, b)| reach(a, side).total_cmp(&reach(b, side)));
            if let Some((node, _)) = farthest {
                own = self.with_stem(own, *node, vertices);
            }
        }
        for (node, holding) in &*tubes {
            if (0..6).any(|side| reach(holding, side) > reach(&own, side)) {
                own = self.with_stem(own, *node, vertices);
            }
        }
        own
    }

    /// A box with the vertices of an internode.
    fn with_stem(&self, own: [Vec3; 2], node: NodeId, vertices: &mut Vec<Vertex>) -> [Vec3; 2] {
        let stem = self.stems().form(node);
        vertices.resize(stem.vertices(), Vertex::zeroed());
        self.stems().write(stem, node, vertices);
        around(own, vertices)
    }
}

/// A box with some vertices.
fn around(own: [Vec3; 2], vertices: &[Vertex]) -> [Vec3; 2] {
    let points = vertices.iter().map(|vertex| Vec3::from_array(vertex.position()));
    points.fold(own, |[low, high], point| [low.min(point), high.max(point)])
}

/// A box that holds a tube whose corners are so many radii from its axis.
fn holding(frustum: &Frustum, reach: f32) -> [Vec3; 2] {
    let base = Vec3::from_array(frustum.base);
    let tip = base + frustum.length * Vec3::from_array(frustum.heading);
    let [low, high] = [base, tip].map(Vec3::abs);
    let radius = frustum.radii[0].max(frustum.radii[1]) * reach;
    let radius = radius + ROUNDING * (low.max(high).max_element() + radius);
    [base.min(tip) - radius, base.max(tip) + radius]
}

/// How far a box reaches to one of six sides.
#[inline]
fn reach([low, high]: &[Vec3; 2], side: usize) -> f32 {
    if side < 3 { high[side] } else { -low[side - 3] }
}
