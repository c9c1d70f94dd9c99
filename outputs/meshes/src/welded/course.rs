//! The course of a limb: its stations from base to tip, and the skin between them.
//!
//! A station has a place on the axis line, a radius and an outline. Where the line bends, its ring lies in the plane
//! that halves the angle and is wider there (a mitre), so that bends take no volume. Between two stations the skin is
//! the ruled surface of their rings; a point of it has an angle and a length along the limb. Absent: limbs (`limbs`),
//! holes (`bands`).

use super::outline::Outline;
use glam::DVec3;
use phytomer_sim::math::atan2;
use phytomer_sim::plant::NodeId;

/// The cosine of the sharpest bend that is mitred, 120 degrees: there a ring is twice as wide.
const SHARPEST: f64 = -0.5;

/// The least width of a ring on the outer side of a bend, in radii.
const LEAST_OUTER: f64 = 0.9;

/// A place along a limb.
#[derive(Debug, Clone, Copy)]
pub struct Station {
    /// The length along the limb, metres.
    pub z: f64,
    /// The place, metres.
    pub at: DVec3,
    /// The radius, metres.
    pub radius: f64,
    /// The place of its outline among all.
    pub outline: u32,
    /// The internode that begins here, or that ends here at the tip.
    pub node: NodeId,
    /// Unit vectors along the limb, and towards the angles 0 and π/2.
    pub along: DVec3,
    pub(super) up: DVec3,
    pub(super) side: DVec3,
    /// The unit vector towards the inner side of a bend, and by how much the ring is wider on the outer and the inner.
    pub(super) bend: DVec3,
    pub(super) wider: [f64; 2],
}

/// Where a point is beside a limb.
#[derive(Debug, Clone, Copy)]
pub struct Beside {
    /// The length along the limb of the nearest point of the axis line, metres.
    pub z: f64,
    /// The distance from it, metres.
    pub distance: f64,
    /// The radius there, metres.
    pub radius: f64,
}

/// A limb as it is drawn.
#[derive(Debug, Default)]
pub struct Course {
    stations: Vec<Station>,
    /// Whether its angle 0 is that of its first internode, whose outline is no regular one.
    is_turned: bool,
}

impl Station {
    /// A station whose frame is not yet known.
    pub fn new(z: f64, at: DVec3, radius: f64, outline: u32, node: NodeId) -> Self {
        let none = DVec3::ZERO;
        Self { z, at, radius, outline, node, along: DVec3::Z, up: none, side: none, bend: none, wider: [0.0; 2] }
    }

    /// The station with at least a radius.
    pub fn at_least(&self, radius: f64) -> Self {
        Self { radius: self.radius.max(radius), ..*self }
    }

    /// The point of its ring in a direction, `reach` radii from the axis line.
    #[inline]
    pub fn corner(&self, [cos, sin]: [f64; 2], reach: f64) -> DVec3 {
        let out = self.up * cos + self.side * sin;
        let inwards: f64 = out.dot(self.bend);
        let wider = self.wider[usize::from(inwards > 0.0)];
        self.at + (out + self.bend * (wider * inwards)) * (self.radius * reach)
    }
}

impl Course {
    /// The course through these stations, of which there must be at least two.
    pub fn through(stations: Vec<Station>, is_turned: bool) -> Self {
        Self { stations, is_turned }
    }

    /// Whether its angle 0 must be that of its first internode.
    pub fn is_turned(&self) -> bool {
        self.is_turned
    }

    /// Its stations.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// The lengths along the limb of its first and its last station.
    pub fn ends(&self) -> [f64; 2] {
        [self.stations.first(), self.stations.last()].map(|station| station.map_or(0.0, |station| station.z))
    }

    /// The mean of its circumference, each part by its surface, metres.
    pub fn circumference(&self) -> f64 {
        let part = |pair: &[Station]| {
            let [length, mean] = [pair[1].z - pair[0].z, 0.5 * (pair[0].radius + pair[1].radius)];
            [length * mean, length * mean * mean]
        };
        let [surface, squares] = self
            .stations
            .windows(2)
            .map(part)
            .fold([0.0; 2], |sum: [f64; 2], more| [sum[0] + more[0], sum[1] + more[1]]);
        if surface > 0.0 { std::f64::consts::TAU * squares / surface } else { 0.0 }
    }

    /// The place of the stretch between two stations that has a length, and the share of it that is below.
    #[inline]
    fn stretch(&self, z: f64) -> (usize, f64) {
        let after = self.stations.partition_point(|station| station.z <= z);
        let below = after.clamp(1, self.stations.len() - 1) - 1;
        let [from, to] = [self.stations[below].z, self.stations[below + 1].z];
        (below, if to > from { ((z - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 })
    }

    /// The axis line at a length.
    pub fn line(&self, z: f64) -> DVec3 {
        let (k, share) = self.stretch(z);
        self.stations[k].at.lerp(self.stations[k + 1].at, share)
    }

    /// The radius at a length.
    pub fn radius(&self, z: f64) -> f64 {
        let (k, share) = self.stretch(z);
        self.stations[k].radius + share * (self.stations[k + 1].radius - self.stations[k].radius)
    }

    /// The unit vector along the stretch at a length; the nearest that has one where the stretch has no length.
    pub fn direction(&self, z: f64) -> DVec3 {
        let (k, _) = self.stretch(z);
        let of = |k: usize| (self.stations[k + 1].at - self.stations[k].at).try_normalize();
        let below = (0..=k).rev().take(4).find_map(of);
        below.or_else(|| (k + 1..self.stations.len() - 1).take(4).find_map(of)).unwrap_or(self.stations[k].along)
    }

    /// The station that a ring at a length has its outline and its internode from.
    pub fn below(&self, z: f64) -> &Station {
        &self.stations[self.stretch(z).0]
    }

    /// The point of the skin at an angle and a length.
    pub fn point(&self, outlines: &[Outline], [angle, z]: [f64; 2], turned: [f64; 2]) -> DVec3 {
        let (k, share) = self.stretch(z);
        let corner = |station: &Station| station.corner(turned, outlines[station.outline as usize].reach(angle));
        corner(&self.stations[k]).lerp(corner(&self.stations[k + 1]), share)
    }

    /// The angle at which a direction leaves the axis line at a length; `None` where it runs along the line.
    pub fn angle(&self, z: f64, towards: DVec3) -> Option<f64> {
        let (k, share) = self.stretch(z);
        let nearer = &self.stations[k + usize::from(share > 0.5)];
        let (cos, sin) = (towards.dot(nearer.up), towards.dot(nearer.side));
        (cos * cos + sin * sin > 1e-6 * towards.length_squared()).then(|| atan2(sin, cos))
    }

    /// Where a point is beside the axis line, sought from a length on, by the nearest stretch downhill.
    pub fn beside(&self, point: DVec3, from: f64) -> Beside {
        let (mut k, _) = self.stretch(from);
        let last = self.stations.len() - 2;
        let (mut way, mut share) = (0_i32, 0.0);
        for _ in 0..=last {
            let [a, b] = [self.stations[k].at, self.stations[k + 1].at];
            let (along, length) = (b - a, (b - a).length_squared());
            share = if length > 0.0 { (point - a).dot(along) / length } else { f64::from(way.max(0)) };
            if (share > 1.0 || length == 0.0 && way > 0) && k < last && way >= 0 {
                (k, way) = (k + 1, 1);
            } else if (share < 0.0 || length == 0.0) && k > 0 && way <= 0 {
                (k, way) = (k - 1, -1);
            } else {
                break;
            }
        }
        let share = share.clamp(0.0, 1.0);
        let [low, high] = [&self.stations[k], &self.stations[k + 1]];
        Beside {
            z: low.z + share * (high.z - low.z),
            distance: (point - low.at.lerp(high.at, share)).length(),
            radius: low.radius + share * (high.radius - low.radius),
        }
    }

    /// Cuts off what is below a length, which must be above the first station and below the last.
    pub fn begin(&mut self, z: f64) {
        let (k, share) = self.stretch(z);
        let [low, high] = [self.stations[k], self.stations[k + 1]];
        let radius = low.radius + share * (high.radius - low.radius);
        let first = Station { z, at: low.at.lerp(high.at, share), radius, ..low };
        self.stations.drain(..k);
        self.stations[0] = first;
    }

    /// Turns the rings from the first on without a twist; `up` is about where its angle 0 is.
    pub fn turn(&mut self, up: DVec3) {
        let count = self.stations.len();
        let ways: Vec<Option<DVec3>> =
            self.stations.windows(2).map(|pair| (pair[1].at - pair[0].at).try_normalize()).collect();
        let lengths: Vec<f64> = self.stations.windows(2).map(|pair| (pair[1].at - pair[0].at).length()).collect();
        let mut next = vec![None; count];
        for k in (0..count).rev() {
            next[k] = ways.get(k).copied().flatten().or_else(|| next.get(k + 1).copied().flatten());
        }
        let (mut before, mut last) = (None, None);
        for (k, above) in next.into_iter().enumerate() {
            before = k.checked_sub(1).and_then(|k| ways[k]).or(before);
            let [low, high] = [before.or(above), above.or(before)].map(|way| way.unwrap_or(DVec3::Z));
            let bends: f64 = low.dot(high);
            let station = &mut self.stations[k];
            if bends >= SHARPEST {
                station.along = (low + high).try_normalize().unwrap_or(low);
                station.bend = (high - low).try_normalize().unwrap_or(DVec3::ZERO);
                let mitre = (2.0 / (1.0 + bends)).sqrt();
                let beside = [k.wrapping_sub(1), k].map(|k| ways.get(k).and(lengths.get(k)).copied().unwrap_or(0.0));
                let spare = spare(mitre, station.radius, beside[0] + beside[1]);
                station.wider = [(mitre - spare).max(LEAST_OUTER) - 1.0, mitre - 1.0];
            } else {
                station.along = low;
            }
            station.up = match last {
                None => across(up, station.along),
                Some((along, up)) => across(carried(up, along, station.along), station.along),
            };
            station.side = station.along.cross(station.up);
            last = Some((station.along, station.up));
        }
    }
}

/// By how much less than its mitre a ring is wide on the outer side of a bend, so that the skin has the volume that
/// two round tubes with flat ends have together. With half the angle α, the radius r and the lengths of both, they
/// share 4/3 r³ tan α; a ring that is narrower by s on that side takes half of s π r² cos α / 2 times their lengths.
fn spare(mitre: f64, r: f64, lengths: f64) -> f64 {
    let cos = 1.0 / mitre;
    let tan = (mitre * mitre - 1.0).max(0.0).sqrt();
    if lengths > 0.0 { 16.0 / 3.0 * r * tan / (std::f64::consts::PI * lengths * cos) } else { 0.0 }
}

/// A vector across the unit vector `from` as the least turn of it to the unit vector `to` carries it along.
fn carried(vector: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let both = 1.0 + from.dot(to);
    if both > 1e-6 { vector - (from + to) * (vector.dot(to) / both) } else { vector }
}

/// The unit vector across another that is nearest to a vector.
fn across(vector: DVec3, along: DVec3) -> DVec3 {
    let flat = vector - along * vector.dot(along);
    if flat.length_squared() > 1e-12 { flat.normalize() } else { along.any_orthonormal_vector() }
}
