//! Secondary growth: how internodes gain diameter, in one reverse scan.
//!
//! The law of age is the model's own (de Reffye 1988 §4). In the pipe model (Shinozaki et al. 1964) each leaf above
//! adds a pipe of one section; pipes stay in the wood when their leaves fall. By da Vinci's rule (Prusinkiewicz &
//! Lindenmayer 1990 §2, "da Vinci's postulate") at a fork d^Δ is the sum of d^Δ above. Rings: each tick adds a ring of
//! one width, or a section in proportion to the foliage above (Pressler's law), as far as its leaves have expanded.
//! Fallen branches still count in the wood below them: wood does not vanish. Absent: heartwood, and growth that differs
//! around the stem.

use super::scratch::{Above, Scratch};
use crate::clock::Tick;
use crate::math::pow;
use crate::plant::{NodeId, OrganId, Plant, Shape, Thickening};
use std::f64::consts::PI;

/// Gives each internode of `plant` its diameters at `age` by a rule other than the model's law. To be called at each
/// tick, in order: rings are added to the diameters of the last tick. Linear in internodes and leaves.
pub fn thicken(plant: &mut Plant, age: Tick, rule: Thickening, scratch: &mut Scratch) {
    let above = &mut scratch.above;
    above.clear();
    above.resize(plant.nodes.len(), Above::default());
    match rule {
        Thickening::Law => return,
        Thickening::Pipe { per_leaf, living } => {
            count_leaves(plant, age, above, |_, lives| if living && !lives { 0.0 } else { per_leaf });
            downwards(plant, age, above, |plant, node, above| {
                let section = PI / 4.0 * square(plant.nodes.primary_diameter[node]) + above.sum;
                (section * 4.0 / PI).sqrt().max(f64::from(plant.nodes.diameter[node]))
            });
        }
        Thickening::DaVinci { exponent } => join_forks(plant, age, above, exponent),
        Thickening::Rings { width, per_foliage } => {
            let area = |leaf| plant.organ_area::<f64>(leaf, age);
            count_leaves(plant, age, above, |leaf, lives| if lives { per_foliage * area(leaf) } else { 0.0 });
            downwards(plant, age, above, |plant, node, above| {
                let diameter = plant.nodes.diameter[node];
                let grows = plant.nodes.birth[node] < age && age < plant.death_of(NodeId(node as u32));
                if grows { (square(diameter) + above.sum * 4.0 / PI).sqrt() + 2.0 * width } else { f64::from(diameter) }
            });
        }
    }
    taper(plant, age);
}

/// Adds to each node the leaves that have appeared there by `age`: `worth` is the value of a leaf by its handle and
/// whether it lives.
fn count_leaves(plant: &Plant, age: Tick, above: &mut [Above], worth: impl Fn(OrganId, bool) -> f64) {
    let organs = &plant.organs;
    for organ in (0..organs.len()).filter(|&organ| organs.kind[organ].is_foliage() && organs.birth[organ] <= age) {
        above[organs.node[organ].index()].sum += worth(OrganId(organ as u32), organs.death[organ] > age);
    }
}

/// From the tips down: computes the diameter of each internode from the sums above it, and adds the internode to the
/// sums below.
fn downwards(plant: &mut Plant, age: Tick, above: &mut [Above], diameter: impl Fn(&Plant, usize, &Above) -> f64) {
    for node in (0..plant.nodes.len()).rev().filter(|&node| plant.nodes.birth[node] <= age) {
        plant.nodes.diameter[node] = diameter(plant, node, &above[node]) as f32;
        hand_down(plant, node, above, above[node].sum);
    }
}

fn join_forks(plant: &mut Plant, age: Tick, above: &mut [Above], exponent: f64) {
    for node in (0..plant.nodes.len()).rev().filter(|&node| plant.nodes.birth[node] <= age) {
        let born = f64::from(plant.nodes.primary_diameter[node]);
        let powered = match above[node].branches {
            0 => pow(born, exponent),
            1 => above[node].sum.max(pow(born, exponent)),
            _ => above[node].sum,
        };
        plant.nodes.diameter[node] = pow(powered, 1.0 / exponent) as f32;
        hand_down(plant, node, above, powered);
    }
}

#[inline]
fn hand_down(plant: &Plant, node: usize, above: &mut [Above], worth: f64) {
    if let Some(parent) = plant.nodes.parent[node].some() {
        above[parent.index()].sum += worth;
        above[parent.index()].branches += 1;
    }
}

/// Sets the diameters of tips. The tip of a cone has the diameter of the next internode of its axis where that is
/// thinner, the tip of a blade always; every other tip has the diameter of its base. Internodes that have not appeared
/// by `age` keep their values.
pub fn taper(plant: &mut Plant, age: Tick) {
    let Plant { axes, nodes, appeared, habit, .. } = plant;
    for stretch in appeared.by(age, nodes) {
        let (axis, born) = (stretch.axis, stretch.nodes());
        let (diameter, tip) = (&nodes.diameter[born.clone()], &mut nodes.diameter_tip[born.clone()]);
        tip.copy_from_slice(diameter);
        let shape = habit.shape(axes.order[axis.index()], axes.state[axis.index()]);
        if shape != Shape::Cylinder {
            let joined = |base: f32, next: f32| if shape == Shape::Cone { base.min(next) } else { next };
            tip.iter_mut().zip(diameter.windows(2)).for_each(|(tip, pair)| *tip = joined(pair[0], pair[1]));
            if let Some(parent) = nodes.parent[born.start].some().filter(|parent| nodes.axis[parent.index()] == axis) {
                nodes.diameter_tip[parent.index()] = joined(nodes.diameter[parent.index()], nodes.diameter[born.start]);
            }
        }
    }
}

fn square(diameter: f32) -> f64 {
    f64::from(diameter) * f64::from(diameter)
}
