//! The radii of stems (Weber & Penn 1995 §4.4): that of a branch by its parent's, tapers from 0 to 3, and the flare and
//! the lobes of the trunk.
//!
//! Absent: which rings of a stem are drawn (`rings`).

use phytomer_sim::math;

/// The radius at the base of a branch, at most `there`, the radius of the parent where the branch leaves it.
/// `length_ratio` is the length of the branch over that of its parent.
pub(super) fn branch_radius(parent_radius: f64, length_ratio: f64, ratio_power: f64, there: f64) -> f64 {
    (parent_radius * math::pow(length_ratio, ratio_power)).min(there)
}

/// unit_taper: by how much a stem narrows as a cone, of its radius over its whole length.
fn unit_taper(taper: f64) -> f64 {
    match taper {
        t if t < 1.0 => t,
        t if t < 2.0 => 2.0 - t,
        _ => 0.0,
    }
}

/// radius_Z: the radius of a stem at the share `z` of its length.
///
/// The paper's chart goes to nTaper 3, its cases to below 3; at 3 the case from 2 on continues.
pub(super) fn radius_at(z: f64, taper: f64, radius: f64, length: f64) -> f64 {
    let cone = radius * (1.0 - unit_taper(taper) * z);
    if taper < 1.0 {
        return cone.max(0.0);
    }
    let from_end = (1.0 - z) * length;
    let depth = if taper < 2.0 || from_end < cone { 1.0 } else { taper - 2.0 };
    let within = match taper < 2.0 {
        true => from_end,
        false => (from_end - 2.0 * cone * (from_end / (2.0 * cone) + 0.5).floor()).abs(),
    };
    if taper < 2.0 && within >= cone {
        return cone;
    }
    let inside = (cone * cone - (within - cone) * (within - cone)).max(0.0);
    // Where the stem has no width, there is no sphere either.
    if cone > 0.0 { (1.0 - depth) * cone + depth * inside.sqrt() } else { 0.0 }
}

/// flare_Z: the factor by which the trunk is wider at the share `z` of its length.
pub(super) fn flare(flare: f64, z: f64) -> f64 {
    let y = (1.0 - 8.0 * z).max(0.0);
    flare * (math::pow(100.0, y) - 1.0) / 100.0 + 1.0
}

/// lobe_Z: the factor of the radius at an angle from the x-axis about the z-axis, radians.
pub(super) fn lobe(lobes: u32, depth: f64, angle: f64) -> f64 {
    1.0 + depth * math::sin(f64::from(lobes) * angle)
}
