//! The flare at the foot of a trunk: rings near the ground that are wider than the wood, with a lobe for each root.
//!
//! Where the wood is one surface these are rings of the trunk. Else they are a closed body of their own around the foot
//! of the trunk, whose rings are never within the polygons of the tubes. A trunk that is shorter than twice its flare
//! has one of half its length. Absent: the profile (`phytomer_looks::Flare`).

use super::course::{Course, Station};
use super::limbs::Outlines;
use super::outline::Outline;
use phytomer_looks::Flare;

/// The stretches between rings.
const STRETCHES: u32 = 10;
/// The corners of a ring for each lobe, and the least of a ring.
const OF_A_LOBE: u32 = 10;
const LEAST: u32 = 24;
/// How far a body around a trunk goes into it, in radii.
const INTO: f64 = 0.1;
/// The most of the length of a trunk that its flare takes.
const MOST: f64 = 0.5;

/// The shares of its height at which a flare has rings.
pub fn shares() -> impl Iterator<Item = f64> {
    (0..=STRETCHES).map(|k| {
        let part = f64::from(k) / f64::from(STRETCHES);
        // Closer to one another near the ground, where the profile bends.
        part * part.sqrt()
    })
}

/// The corners of a ring of a flare, a multiple of those of the wood.
pub fn corners_of(flare: &Flare, sides: u32) -> u32 {
    LEAST.max(OF_A_LOBE * flare.lobes).div_ceil(sides) * sides
}

/// The most of the length of a trunk that its flare takes.
pub fn most_of_trunk() -> f64 {
    MOST
}

/// The stations of a trunk with those of its flare, and the length along it at which the flare ends.
pub fn flared(flare: &Flare, stations: Vec<Station>, outlines: &mut Outlines) -> (Vec<Station>, f64) {
    let (Some(first), Some(last)) = (stations.first().copied(), stations.last()) else { return (stations, 0.0) };
    let long = (flare.height() * 2.0 * first.radius).min(MOST * (last.z - first.z));
    let end = first.z + long;
    if !(long.is_finite() && long > 0.0 && first.radius > 0.0) {
        return (stations, first.z);
    }
    let own = stations.iter().map(|station| station.z).filter(|z| *z < end);
    let mut lengths: Vec<f64> = shares().map(|share| first.z + share * long).chain(own).collect();
    lengths.sort_by(f64::total_cmp);
    // Rings that are nearer than this to the one below are left out, but for steps of the wood at one length.
    let apart = 1e-3 * long;
    let mut kept: Vec<f64> = Vec::new();
    for z in lengths {
        if kept.last().is_none_or(|below| z - below > apart) {
            kept.push(z);
        }
    }
    let course = Course::through(stations, false);
    let mut found: Vec<Station> = Vec::new();
    for z in kept {
        let below = *course.below(z);
        let share = ((z - first.z) / long).min(1.0);
        let (outline, mean) = outline(flare, share, &outlines.list[below.outline as usize]);
        let (radius, place) = (course.radius(z) * mean, outlines.add(outline));
        found.push(Station { z, at: course.line(z), radius, outline: place, ..below });
    }
    found.extend(course.stations().iter().filter(|station| station.z > end + apart));
    (found, end)
}

/// The ring with which a body around a trunk ends: within the trunk, so that the edge of its end is not seen.
pub fn within(last: &Station, course: &Course) -> Station {
    let z = (last.z + INTO * last.radius).min(course.ends()[1]);
    Station { z, at: course.line(z), radius: (1.0 - INTO) * last.radius, ..*last }
}

/// The outline of a ring at a share of the height of a flare around a polygon, and its mean reach, in radii of the
/// wood.
fn outline(flare: &Flare, share: f64, wood: &Outline) -> (Outline, f64) {
    let sides = wood.corners().len().max(3) as u32;
    let corners = corners_of(flare, sides);
    let mean = 1.0 + flare.wider(share, 0.0) * (1.0 - 0.5 * flare.depth * f64::from(u8::from(flare.lobes > 0)));
    let reach = |angle: f64| wood.reach(angle) * (1.0 + flare.wider(share, angle)) / mean;
    (Outline::lobed(corners, reach), mean)
}
