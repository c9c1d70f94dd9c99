//! Which axes stand as they stood at the age before, so that their lines need not be looked at again.
//!
//! Of each internode place, direction, length and diameters are remembered, and of each axis which internodes it had
//! and which lines it makes. An axis is known where all of these are the same to the bit. Colours are not among them:
//! bark changes while wood stands still. Where single internodes have looks of their own nothing is known.

use phytomer_sim::plant::{AxisId, NodeId, Plant, Stretch};

/// What was seen of a plant at the last age.
#[derive(Debug, Clone, Default)]
pub struct Still {
    nodes: Vec<([f32; 9], u32)>,
    axes: Vec<Axis>,
    /// This age and the last one.
    ages: [f32; 2],
}

#[derive(Debug, Clone)]
struct Axis {
    bud: u32,
    /// The first internode and the number of them.
    of: [usize; 2],
    seen: f32,
    lines: Vec<u32>,
    apart: bool,
}

impl Default for Axis {
    fn default() -> Self {
        Self { bud: u32::MAX, of: [0; 2], seen: f32::NAN, lines: Vec::new(), apart: false }
    }
}

impl Still {
    /// Looks at an axis by its stretches; its lines where it stands as it stood at the age before. Else what it has is
    /// to be told ([`Still::has_line`], [`Still::is_apart`]).
    pub fn look(&mut self, plant: &Plant, stretches: &[Stretch], age: f32) -> Option<Vec<u32>> {
        if self.ages[0] != age {
            self.ages = [age, self.ages[0]];
        }
        let first = stretches.first()?;
        let place = first.axis.index();
        self.axes.resize(self.axes.len().max(plant.axes.len()), Axis::default());
        self.nodes.resize(self.nodes.len().max(plant.nodes.len()), ([f32::NAN; 9], u32::MAX));
        let mut same = plant.own_looks.is_empty();
        for node in stretches.iter().flat_map(Stretch::nodes) {
            let now = values(plant, node);
            same &= self.nodes[node] == now;
            self.nodes[node] = now;
        }
        let count = stretches.iter().map(|stretch| stretch.nodes().len()).sum();
        let (bud, of) = (plant.axes.component[place], [first.nodes().start, count]);
        let axis = &mut self.axes[place];
        let known = same && axis.seen == self.ages[1] && !axis.apart && (axis.bud, axis.of) == (bud, of);
        axis.seen = age;
        if known {
            return Some(axis.lines.clone());
        }
        *axis = Axis { bud, of, seen: age, ..Axis::default() };
        None
    }

    /// An axis makes a line.
    pub fn has_line(&mut self, axis: AxisId, line: u32) {
        self.axes[axis.index()].lines.push(line);
    }

    /// An axis has an internode that is in no line.
    pub fn is_apart(&mut self, axis: AxisId) {
        self.axes[axis.index()].apart = true;
    }
}

fn values(plant: &Plant, node: usize) -> ([f32; 9], u32) {
    let (frames, nodes) = (&plant.frames, &plant.nodes);
    let [x, y, z] = frames.base[node];
    let [u, v, w] = frames.heading[node];
    let length = plant.posed_length(NodeId(node as u32));
    ([x, y, z, u, v, w, length, nodes.diameter[node], nodes.diameter_tip[node]], nodes.component[node])
}
