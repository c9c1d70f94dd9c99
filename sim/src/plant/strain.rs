//! The curvature and the bending moment of each internode: the columns that mechanics alone writes.
//!
//! Both are vectors in the axes of the material, along `up` and along `heading × up` of the internode, so that they
//! keep their meaning while the branch turns. There is no component along the heading: internodes bend and do not
//! twist.

use super::AxisId;

/// The state of bending, one entry an internode; empty until a plant bends.
#[derive(Debug, Clone, Default)]
pub struct Strain {
    /// The curvature that bending has added to the pose at rest, rad/m, about the two axes.
    pub curvature: Vec<[f32; 2]>,
    /// The bending moment at the middle of the internode, N·m, about the two axes.
    pub moment: Vec<[f32; 2]>,
    /// The axis nearest to the seed that did not hold its load, at the last tick.
    pub yields: Option<AxisId>,
}

impl Strain {
    /// Forgets every internode.
    pub fn clear(&mut self) {
        self.curvature.clear();
        self.moment.clear();
        self.yields = None;
    }

    /// Makes room for `nodes` internodes; new ones are straight and free of load.
    pub(crate) fn resize(&mut self, nodes: usize) {
        self.curvature.resize(nodes, [0.0; 2]);
        self.moment.resize(nodes, [0.0; 2]);
    }

    /// The magnitude of the curvature of internode `node`, rad/m; 0 where the plant does not bend.
    pub fn curvature_of(&self, node: usize) -> f32 {
        size(self.curvature.get(node))
    }

    /// The magnitude of the bending moment in internode `node`, N·m; 0 where the plant does not bend.
    pub fn moment_of(&self, node: usize) -> f32 {
        size(self.moment.get(node))
    }
}

fn size(pair: Option<&[f32; 2]>) -> f32 {
    pair.map_or(0.0, |[a, b]| (a * a + b * b).sqrt())
}
