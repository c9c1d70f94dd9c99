//! Forks: where an axis ends and its branches go on from its tip, each thinner than it, as Leonardo's rule has it.
//!
//! One of the branches continues the limb. Its radius goes evenly from that of its bearer to its own, half below the
//! fork and half above it, so that the skin has no step and the wood keeps its volume; the feet of the other branches
//! stand on that skin. Where tubes are drawn by themselves a skirt goes from the end of the bearer to the branch.
//! Absent: steps within an axis, which are the species' own.

use super::course::{Course, Station};
use super::outline::Outline;
use super::skin::{Line, Skin};
use phytomer_sim::plant::NodeId;

/// How far below and above a fork its radius changes, in radii of the thicker side.
const REACH: f64 = 0.75;
/// The most of the way to the next station that it takes.
const MOST: f64 = 0.45;
/// Radii that differ by less than this share are the same.
const ALIKE: f64 = 1e-3;
/// The stretches of a skirt.
const STRETCHES: u32 = 4;

/// A fork along a limb.
#[derive(Debug, Clone, Copy)]
pub struct Fork {
    /// The length along the limb, metres.
    pub z: f64,
    /// How far from it the radius changes, metres.
    pub reach: f64,
    /// The radii below and above.
    pub radii: [f64; 2],
}

/// The stations of a limb without steps at its forks, and its forks; `forks` tells whether a station ends an axis and
/// the next begins another.
pub fn evened(stations: Vec<Station>, forks: impl Fn(&Station, &Station) -> bool) -> (Vec<Station>, Vec<Fork>) {
    let (mut even, mut found): (Vec<Station>, Vec<Fork>) = (Vec::with_capacity(stations.len()), Vec::new());
    let mut k = 0;
    while k < stations.len() {
        let [below, above] = [Some(&stations[k]), stations.get(k + 1)];
        let step = below.zip(above).filter(|(below, above)| {
            let apart = (below.radius - above.radius).abs() > ALIKE * below.radius.max(above.radius);
            below.z == above.z && apart && forks(below, above)
        });
        let neighbours = step.and_then(|(below, above)| {
            let before = even.last().copied().filter(|before| before.z < below.z)?;
            let after = stations.get(k + 2).copied().filter(|after| after.z > above.z)?;
            Some(([before, *below], [*above, after]))
        });
        let Some((low, high)) = neighbours else {
            even.push(stations[k]);
            k += 1;
            continue;
        };
        let ([before, below], [above, after]) = (low, high);
        let reach = REACH * below.radius.max(above.radius);
        let reach = reach.min(MOST * (below.z - before.z)).min(MOST * (after.z - above.z));
        even.push(between(&before, &below, below.z - reach, below.node));
        even.push(Station { radius: below.radius.midpoint(above.radius), ..above });
        even.push(between(&above, &after, above.z + reach, above.node));
        found.push(Fork { z: below.z, reach, radii: [below.radius, above.radius] });
        k += 2;
    }
    (even, found)
}

/// The station at a length between two others.
fn between(low: &Station, high: &Station, z: f64, node: NodeId) -> Station {
    let share = (z - low.z) / (high.z - low.z);
    let radius = low.radius + share * (high.radius - low.radius);
    Station { z, at: low.at.lerp(high.at, share), radius, node, ..*high }
}

/// Adds the skirt of a fork: from the end of the thicker side to the thinner, whose skin it touches.
pub fn skirt(skin: &mut Skin, fork: &Fork, course: &Course, outlines: &[Outline]) {
    let [below, above] = fork.radii;
    let (way, thick, thin) = if below > above { (1.0, below, above) } else { (-1.0, above, below) };
    let mut last: Option<Line> = None;
    for step in 0..=STRETCHES {
        let left = 1.0 - f64::from(step) / f64::from(STRETCHES);
        let z = fork.z + way * 2.0 * fork.reach * (1.0 - left);
        let of = course.below(z);
        let station = Station { z, at: course.line(z), radius: thin + (thick - thin) * left * left, ..*of };
        let mut line = Line::default();
        skin.ring(&station, &outlines[of.outline as usize], &mut line);
        if let Some(last) = &last {
            if way > 0.0 { skin.join(last, &line) } else { skin.join(&line, last) }
        }
        last = Some(line);
    }
}
