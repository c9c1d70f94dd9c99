//! The pose of a plant between two ticks by the rules of its growth: curvature and moment go linearly from tick to
//! tick, and the axes are followed with the lengths of the moment.

use super::shares::Shares;
use crate::clock::Tick;
use crate::mechanics::{Scratch, pose_bent};
use crate::plant::Plant;
use crate::pose::pose_anew;

/// Poses a plant that has its lengths.
pub(super) fn pose(plant: &mut Plant, age: Tick, shares: &Shares, share: f32, scratch: &mut Scratch) {
    let [curvature, moment] = &shares.bending;
    if curvature[1].is_empty() {
        return pose_anew(plant, age);
    }
    let write = |column: &mut Vec<[f32; 2]>, [was, will]: &[Vec<[f32; 2]>; 2]| {
        column.clear();
        column.extend(was.iter().zip(will).map(|(a, b)| [0, 1].map(|k| a[k] + (b[k] - a[k]) * share)));
    };
    write(&mut plant.strain.curvature, curvature);
    write(&mut plant.strain.moment, moment);
    pose_bent(plant, age, scratch);
}
