//! How much of each length, diameter and size is there between two ticks.
//!
//! Of the n nodes by which an axis grows in a tick node k has the share clamp(n f − k + 1, 0, 1) of its length: one
//! after the other elongates, at an even speed of the axis. A model makes one growth unit a tick, or several where the
//! axis is faster than the clock, and these follow one another. In models without growth units what appears has the
//! share f. Diameters of new nodes go from 0, but for nodes that are put between others: these have that of the later
//! tick. An organ on a new node appears with it, another new organ with the share f of its size.
//! The corners of an outline go evenly where there are as many at both ticks, and so do the factors of one curved
//! surface.

use crate::clock::Tick;
use crate::plant::{Lasting, NodeId, OrganId, Plant};

/// The values at both ticks, and which nodes appear between them.
#[derive(Debug, Default)]
pub(super) struct Shares {
    /// The nodes that appear, with their number k among the n of their axis.
    new: Vec<(NodeId, [f32; 2])>,
    lengths: [Vec<f32>; 2],
    /// Diameters at the base and at the tip.
    diameters: [[Vec<f32>; 2]; 2],
    /// Curvature and moment; empty where the plant does not bend.
    pub bending: [[Vec<[f32; 2]>; 2]; 2],
    /// The shares of full size of organs.
    sizes: [Vec<f32>; 2],
    /// The organs that appear, with the place in `new` of their node where it appears as well.
    new_organs: Vec<(OrganId, Option<usize>)>,
    /// Full lengths and widths of organs that differ.
    full: Vec<(OrganId, [[f32; 2]; 2])>,
    /// Corners of outlines that differ, as many at both ticks.
    outlines: Vec<(OrganId, [Vec<[f32; 3]>; 2])>,
    /// Factors of curved surfaces that differ.
    surfaces: Vec<(OrganId, [[f32; 3]; 2])>,
}

fn between(a: f32, b: f32, share: f32) -> f32 {
    a + (b - a) * share
}

impl Shares {
    /// Finds what appears. With `units` the nodes of an axis appear one after the other, else all at once.
    pub fn of(plant: &Plant, lasting: &Lasting, age: Tick, units: bool) -> Self {
        let mut counts = vec![0_u32; plant.axes.len()];
        let mut new = Vec::new();
        let appears = |node: &NodeId| lasting.nodes[node.index()].some().is_none() && plant.stands(*node, age);
        for node in (0..plant.nodes.len() as u32).map(NodeId).filter(appears) {
            let count = &mut counts[plant.nodes.axis[node.index()].index()];
            *count += 1;
            new.push((node, [if units { *count as f32 } else { 1.0 }, 1.0]));
        }
        if units {
            new.iter_mut().for_each(|(node, of)| of[1] = counts[plant.nodes.axis[node.index()].index()] as f32);
        }
        Self { new, ..Self::default() }
    }

    /// Takes the values at both ticks.
    pub fn remember(&mut self, plant: &Plant, lasting: &Lasting, (before, after): (&Plant, &Plant), age: Tick) {
        let inserted = inserted(plant, lasting);
        let both = |was: &dyn Fn(NodeId) -> f32, will: &[f32], new: &dyn Fn(usize) -> f32| -> [Vec<f32>; 2] {
            let places = 0..plant.nodes.len();
            let old = |node: usize| lasting.nodes[node].some().map(was);
            let first = places.clone().map(|node| old(node).unwrap_or_else(|| new(node)));
            let last = places.map(|node| will.get(node).copied().or_else(|| old(node)).unwrap_or(0.0));
            [first.collect(), last.collect()]
        };
        let length = |node: NodeId| before.posed_length(node);
        self.lengths = both(&length, after.posed_lengths(), &|_| 0.0);
        let width = |node: usize, column: &[f32]| if inserted[node] { column[node] } else { 0.0 };
        self.diameters = [
            both(&|node| before.nodes.diameter[node.index()], &after.nodes.diameter, &|node| {
                width(node, &after.nodes.diameter)
            }),
            both(&|node| before.nodes.diameter_tip[node.index()], &after.nodes.diameter_tip, &|node| {
                width(node, &after.nodes.diameter_tip)
            }),
        ];
        if !after.strain.curvature.is_empty() {
            let pair = |column: &dyn Fn(&Plant) -> &[[f32; 2]]| {
                let at = |of: &[[f32; 2]], node: usize| of.get(node).copied().unwrap_or_default();
                let old =
                    |node: usize| lasting.nodes[node].some().map_or([0.0; 2], |old| at(column(before), old.index()));
                let first = (0..plant.nodes.len()).map(old).collect();
                [first, (0..plant.nodes.len()).map(|node| at(column(after), node)).collect()]
            };
            self.bending = [pair(&|plant| &plant.strain.curvature), pair(&|plant| &plant.strain.moment)];
        }
        self.remember_organs(plant, lasting, (before, after), age);
    }

    fn remember_organs(&mut self, plant: &Plant, lasting: &Lasting, (before, after): (&Plant, &Plant), age: Tick) {
        let places = (0..plant.organs.len()).zip(&lasting.organs);
        let of_after = |organ: usize| organ < after.organs.len();
        for (place, old) in places {
            let organ = OrganId(place as u32);
            let was = old.map(|old| before.expanded(old, age - 1));
            let will = if of_after(place) { after.expanded(organ, age) } else { was.unwrap_or(0.0) };
            self.sizes[0].push(was.unwrap_or(0.0));
            self.sizes[1].push(will);
            if let Some(old) = old {
                let full = |plant: &Plant, place: usize| [plant.organs.length[place], plant.organs.width[place]];
                let full = [full(before, old.index()), full(plant, place)];
                if full[0] != full[1] {
                    self.full.push((organ, full));
                }
                self.remember_form([(before, *old), (plant, organ)]);
            } else if plant.organ_stands(organ, age) {
                let node = plant.organs.node[place];
                let found = self.new.binary_search_by_key(&node, |(node, _)| *node).ok();
                self.new_organs.push((organ, found));
            }
        }
    }

    /// Takes the outline or the surface that an organ states at both ticks.
    fn remember_form(&mut self, [(before, old), (plant, organ)]: [(&Plant, OrganId); 2]) {
        let outlines = [before.outline_of(old), plant.outline_of(organ)];
        if outlines[0].len() == outlines[1].len() && outlines[0] != outlines[1] {
            self.outlines.push((organ, outlines.map(<[[f32; 3]]>::to_vec)));
        }
        let surfaces = [before.stated_organs.surface(old), plant.stated_organs.surface(organ)];
        if let [Some((was, from)), Some((will, to))] = surfaces
            && was == will
            && from != to
        {
            self.surfaces.push((organ, [from, to]));
        }
    }

    /// The share of its length that a new node has.
    fn grown(&self, place: usize, share: f32) -> f32 {
        let [k, n] = self.new[place].1;
        (n * share - k + 1.0).clamp(0.0, 1.0)
    }

    /// The share of its full size of each organ.
    pub fn sizes(&self, share: f32) -> Vec<f32> {
        let mut sizes: Vec<f32> =
            self.sizes[0].iter().zip(&self.sizes[1]).map(|(a, b)| between(*a, *b, share)).collect();
        for &(organ, node) in &self.new_organs {
            let grown = node.map_or(share, |place| self.grown(place, share));
            sizes[organ.index()] = grown * self.sizes[1][organ.index()];
        }
        sizes
    }

    /// Writes the lengths into the frames, and the full sizes and own forms of organs where they differ.
    pub fn lengthen(&self, plant: &mut Plant, share: f32) {
        let lengths = &mut plant.frames.lengths;
        lengths.clear();
        lengths.extend(self.lengths[0].iter().zip(&self.lengths[1]).map(|(a, b)| between(*a, *b, share)));
        for (place, (node, _)) in self.new.iter().enumerate() {
            lengths[node.index()] = self.grown(place, share) * self.lengths[1][node.index()];
        }
        for (organ, [was, will]) in &self.full {
            plant.organs.length[organ.index()] = between(was[0], will[0], share);
            plant.organs.width[organ.index()] = between(was[1], will[1], share);
        }
        let place = |was: &[f32; 3], will: &[f32; 3]| [0, 1, 2].map(|k| between(was[k], will[k], share));
        for (organ, [was, will]) in &self.outlines {
            plant.move_outline(*organ, was.iter().zip(will).map(|(was, will)| place(was, will)));
        }
        for (organ, [was, will]) in &self.surfaces {
            plant.scale_surface(*organ, place(was, will));
        }
    }

    /// Writes the diameters.
    pub fn thicken(&self, plant: &mut Plant, share: f32) {
        let write = |column: &mut [f32], [was, will]: &[Vec<f32>; 2]| {
            let values = was.iter().zip(will).map(|(a, b)| between(*a, *b, share));
            column.iter_mut().zip(values).for_each(|(place, value)| *place = value);
        };
        write(&mut plant.nodes.diameter, &self.diameters[0]);
        write(&mut plant.nodes.diameter_tip, &self.diameters[1]);
    }
}

/// Whether each node is put between others: something of its axis stood beyond it before.
fn inserted(plant: &Plant, lasting: &Lasting) -> Vec<bool> {
    let mut beyond = vec![false; plant.axes.len()];
    let mut inserted = vec![false; plant.nodes.len()];
    for node in (0..plant.nodes.len()).rev() {
        let beyond = &mut beyond[plant.nodes.axis[node].index()];
        inserted[node] = *beyond;
        *beyond |= lasting.nodes[node].some().is_some();
    }
    inserted
}
