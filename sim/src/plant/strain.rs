//! The curvature and the bending moment of each internode: the columns that mechanics alone writes.
//!
//! Both are vectors in the axes of the material, along `up` and along `heading × up` of the internode, so that they
//! keep their meaning while the branch turns. There is no component along the heading: internodes bend and do not
//! twist. What a support holds is stated here too: it does not bend.

use super::AxisId;
use super::rare::Rare;
use crate::clock::Tick;

/// How a support holds an internode.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Hold {
    /// The age of the plant from which on the support holds it no more; 0 where none ever held it.
    pub until: Tick,
    /// Whether the support stands on the ground and bears the weight of the internode and of all that is beyond it.
    pub bears: bool,
}

/// The state of bending, one entry an internode; empty until a plant bends.
#[derive(Debug, Clone, Default)]
pub struct Strain {
    /// The curvature that bending has added to the pose at rest, rad/m, about the two axes.
    pub curvature: Vec<[f32; 2]>,
    /// The bending moment at the middle of the internode, N·m, about the two axes.
    pub moment: Vec<[f32; 2]>,
    /// The axis nearest to the seed that did not hold its load, at the last tick.
    pub yields: Option<AxisId>,
    /// What supports hold; empty where there is none.
    held: Rare<Hold>,
}

impl Strain {
    /// Forgets every internode.
    pub fn clear(&mut self) {
        self.curvature.clear();
        self.moment.clear();
        self.yields = None;
        self.held.clear();
    }

    /// Holds internode `node`: it keeps its curvature and turns with its base alone.
    pub(crate) fn hold(&mut self, node: usize, hold: Hold) {
        self.held.set(node, hold);
    }

    /// Straightens internode `node`, free of stress.
    pub(crate) fn straighten(&mut self, node: usize) {
        for column in [&mut self.curvature, &mut self.moment] {
            if let Some(value) = column.get_mut(node) {
                *value = [0.0; 2];
            }
        }
    }

    /// Whether any internode was ever held.
    #[inline]
    pub(crate) fn has_holds(&self) -> bool {
        !self.held.is_empty()
    }

    /// How internode `node` is held at `age`; `None` where it is free.
    #[inline]
    pub(crate) fn hold_of(&self, node: usize, age: Tick) -> Option<Hold> {
        Some(self.held.at(node)).filter(|hold| age < hold.until)
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
