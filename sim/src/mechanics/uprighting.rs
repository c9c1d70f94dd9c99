//! How axes right themselves: reaction wood in internodes that thicken, and the turning of young internodes.
//!
//! An axis keeps to a direction t at a stated angle to the vertical, in the vertical plane of its heading h. Reaction
//! wood shrinks more on one side as it matures, so a ring that adds dR to the radius adds the curvature
//! dκ = 2 Δε dR / R² (Fournier, Bailleres & Chanson 1994; Alméras & Fournier 2009), here weighted by sin γ, the sine of
//! the angle between h and t: the response of shoots to their inclination. A young internode adds its rate times
//! sin γ each tick. Both change the curvature that the internode has without load, and are frozen in like growth.

use crate::clock::Tick;
use crate::plant::standing::Standing;
use crate::plant::{Plant, Shape, Uprighting, Wood};
use crate::vector::Vector;

/// Adds the curvature of this tick's righting to the curvatures without load. `before` holds the diameters of the last
/// tick, where reaction wood is made.
pub(super) fn straighten(
    plant: &Plant,
    wood: &Wood,
    age: Tick,
    standing: &Standing,
    before: &[f32],
    natural: &mut [[f32; 2]],
) {
    for run in &standing.runs {
        let axis = run.axis.index();
        let uprighting = &wood.tissue(plant.axes.order[axis]).uprighting;
        if !uprighting.acts() || plant.axes.death[axis] <= age {
            continue;
        }
        // A blade has no rings.
        let before = if plant.look_of(run.axis).shape == Shape::Blade { &[] } else { before };
        for node in run.nodes() {
            let gain = gained(plant, uprighting, age, before, node);
            if gain != 0.0 {
                let [about_up, about_side] = towards(plant, uprighting, node);
                natural[node][0] += (gain * about_up) as f32;
                natural[node][1] += (gain * about_side) as f32;
            }
        }
    }
}

/// The curvature that an internode square to its direction gains in this tick, rad/m.
fn gained(plant: &Plant, uprighting: &Uprighting, age: Tick, before: &[f32], node: usize) -> f64 {
    let own_age = age - plant.nodes.birth[node];
    let primary = if own_age < uprighting.young { f64::from(uprighting.rate) } else { 0.0 };
    let radius = f64::from(plant.nodes.diameter[node]) * 0.5;
    let last = before.get(node).map_or(radius, |&diameter| f64::from(diameter) * 0.5);
    // A ring from R₀ to R adds the integral of 2 Δε dR / R².
    let rings = if own_age > 0 && 0.0 < last && last < radius { 1.0 / last - 1.0 / radius } else { 0.0 };
    primary + 2.0 * f64::from(uprighting.strain) * rings
}

/// h × t in the axes of the material: the sine of γ about the axis that turns the heading towards its direction t.
fn towards(plant: &Plant, uprighting: &Uprighting, node: usize) -> [f64; 2] {
    let (heading, up) = (Vector::from(plant.frames.heading[node]), Vector::from(plant.frames.up[node]));
    let side = heading.cross(up);
    let level = (heading.x * heading.x + heading.y * heading.y).sqrt();
    let (cos, sin) = (f64::from(uprighting.cos_inclination), f64::from(uprighting.sin_inclination));
    let out = if level > 1e-6 { sin / level } else { 0.0 };
    let kept = Vector::new(heading.x * out, heading.y * out, cos);
    let axis = heading.cross(kept);
    [axis.dot(up), axis.dot(side)]
}
