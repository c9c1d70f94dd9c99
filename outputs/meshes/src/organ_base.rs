//! Where an organ is drawn: where it states it, else on the surface of the stem that bears it.
//!
//! Absent: its form and its size, which are the scene's.

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{OrganId, Plant};
use phytomer_sim::pose::{Frame, organ_frame, stated_organ_frame};

/// An organ whose insertion angle has a smaller sine stands on the tip of the stem, not on its side.
const TERMINAL: f32 = 1e-3;

/// The frame of an organ at its drawn base.
#[inline]
pub fn organ_base(plant: &Plant, organ: OrganId, age: Tick) -> Frame {
    if let Some(stated) = stated_organ_frame(plant, organ) {
        return stated;
    }
    let frame = organ_frame(plant, organ, age);
    let node = plant.organs.node[organ.index()];
    let out = outward(plant.frames.heading[node.index()], frame.heading);
    let radius = 0.5 * plant.nodes.diameter_tip[node.index()];
    Frame { base: [0, 1, 2].map(|k| frame.base[k] + radius * out[k]), ..frame }
}

/// The part of an organ's heading across its stem, as a unit vector; zero for an organ on the tip.
fn outward(stem: [f32; 3], organ: [f32; 3]) -> [f32; 3] {
    let along = stem[0] * organ[0] + stem[1] * organ[1] + stem[2] * organ[2];
    let across = [0, 1, 2].map(|k| organ[k] - along * stem[k]);
    let length = (across[0] * across[0] + across[1] * across[1] + across[2] * across[2]).sqrt();
    if length > TERMINAL { across.map(|x| x / length) } else { [0.0; 3] }
}
