//! Which samples of a chain are kept, so that the tube along them is as near as its tolerance says.
//!
//! Of the samples between two that are kept, with the tolerance e: the distance of each to the line, and of its radius
//! to the radius there, is at most e (or a share of the radius, where that is asked for), and their sum with the radius
//! that is lost where the internode leans against the line, r (1 − cos θ), at most 4e/3. The polygon around takes at
//! most 2e/3 more (`ring`), so that no corner of a round tube of the full mesh is farther than 2e from the reduced one.
//! From each kept sample the farthest next one is sought by doubling steps and then by halving them: O(n log n) for n
//! samples. (Imai & Iri 1988 find the least number of samples; going as far as possible comes close to it.)

use super::super::Tolerance;
use super::chain::Sample;
use glam::Vec3;

/// The share of the tolerance that line, radius and lean may take together.
const TOGETHER: f32 = 4.0 / 3.0;

/// Replaces `kept` by the places of the samples that are kept: the first, the last, and what is needed between them.
pub fn simplify(samples: &[Sample], tolerance: &Tolerance, kept: &mut Vec<u32>) {
    kept.clear();
    let Some(last) = samples.len().checked_sub(1) else { return };
    let mut at = 0;
    kept.push(0);
    while at < last {
        at = farthest(samples, at, last, tolerance);
        kept.push(at as u32);
    }
}

/// The farthest sample, as far as the search sees, that a straight piece of tube can reach from a sample.
fn farthest(samples: &[Sample], from: usize, last: usize, tolerance: &Tolerance) -> usize {
    let fits = |to: usize| fits(&samples[from..=to], tolerance);
    let mut good = from + 1;
    let mut step = 2;
    let mut bad = loop {
        let to = (from + step).min(last);
        if good == last {
            return last;
        }
        if !fits(to) {
            break to;
        }
        good = to;
        step *= 2;
    };
    while bad - good > 1 {
        let to = good.midpoint(bad);
        if fits(to) { good = to } else { bad = to }
    }
    good
}

/// Whether a straight piece of tube from the first sample to the last is near enough to all of them.
pub fn fits(samples: &[Sample], tolerance: &Tolerance) -> bool {
    let [from, between @ .., to] = samples else { return true };
    let along = to.at - from.at;
    let square = along.length_squared();
    let over = if square > 0.0 { 1.0 / square } else { 0.0 };
    let line = Line { from: from.at, along, over, direction: along * over.sqrt() };
    let limit = tolerance.distance * TOGETHER;
    let mut lean = line.lean(from, between.first().unwrap_or(to));
    if lean > limit {
        return false;
    }
    for (place, sample) in between.iter().enumerate() {
        let next = line.lean(sample, between.get(place + 1).unwrap_or(to));
        let (share, aside) = line.beside(sample.at);
        let thinner = (sample.radius - (from.radius + share * (to.radius - from.radius))).abs();
        let near = aside <= tolerance.distance && thinner <= tolerance.of_radius(sample.radius);
        if !near || aside + thinner + lean.max(next) > limit || differ(sample, from) > tolerance.colour {
            return false;
        }
        lean = next;
    }
    lean <= limit
}

/// The line of a piece of tube.
struct Line {
    from: Vec3,
    along: Vec3,
    /// One over its squared length; 0 where it has no length.
    over: f32,
    direction: Vec3,
}

impl Line {
    /// The share of the line at which it is nearest to a point, and the distance there.
    #[inline]
    fn beside(&self, point: Vec3) -> (f32, f32) {
        let seen = point - self.from;
        let share = (seen.dot(self.along) * self.over).clamp(0.0, 1.0);
        (share, (seen - share * self.along).length())
    }

    /// What an internode from a sample to the next loses of its radius where it leans against the line.
    #[inline]
    fn lean(&self, sample: &Sample, next: &Sample) -> f32 {
        let turned = if sample.heading == Vec3::ZERO { 1.0 } else { sample.heading.dot(self.direction) };
        sample.radius.max(next.radius) * (1.0 - turned).max(0.0)
    }
}

fn differ(one: &Sample, other: &Sample) -> u8 {
    (0..3).map(|k| one.colour[k].abs_diff(other.colour[k])).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::super::super::Keeping;
    use super::*;
    use phytomer_sim::math::sincosf;
    use phytomer_sim::plant::NodeId;

    const FINE: Tolerance =
        Tolerance { distance: 0.001, share: f32::INFINITY, colour: u8::MAX, keeps: Keeping::Section, organs: false };

    fn chain(count: usize, at: impl Fn(f32) -> (Vec3, f32)) -> Vec<Sample> {
        let place = |k: usize| at(k as f32 / count as f32);
        let sample = |k: usize| {
            let (at, radius) = place(k);
            let heading = if k < count { (place(k + 1).0 - at).normalize() } else { Vec3::ZERO };
            Sample { at, radius, heading, node: NodeId(k as u32), end: k == count, colour: [0; 3] }
        };
        (0..=count).map(sample).collect()
    }

    fn kept(samples: &[Sample], tolerance: &Tolerance) -> Vec<u32> {
        let mut kept = Vec::new();
        simplify(samples, tolerance, &mut kept);
        kept
    }

    #[test]
    fn a_straight_cone_is_one_piece() {
        for count in [1, 2, 3, 100, 1000] {
            let cone = chain(count, |t| (Vec3::new(t, 2.0 * t, 0.5), 0.02 - 0.01 * t));
            assert_eq!(kept(&cone, &FINE), [0, count as u32]);
        }
        assert_eq!(kept(&[], &FINE), [0_u32; 0]);
    }

    /// An arc of radius R within e has pieces of the angle 2 arccos(1 − e/R), or as many samples fewer as fit.
    #[test]
    fn an_arc_has_as_many_pieces_as_its_sagitta_asks() {
        let count = 1000;
        let quarter = std::f32::consts::FRAC_PI_2;
        let arc = chain(count, |t| {
            let (sin, cos) = sincosf(t * quarter);
            (Vec3::new(cos, sin, 0.0), 1e-4)
        });
        for tolerance in [1e-2, 1e-3, 1e-4] {
            let within = Tolerance::of(tolerance);
            let pieces = kept(&arc, &within).len() - 1;
            let angle = 2.0 * f64::acos_of(1.0 - f64::from(tolerance));
            let steps = (angle / f64::from(quarter) * count as f64).floor();
            assert_eq!(pieces, (count as f64 / steps).ceil() as usize, "within {tolerance}");
        }
    }

    trait Acos {
        fn acos_of(of: f64) -> f64;
    }
    impl Acos for f64 {
        fn acos_of(of: f64) -> f64 {
            phytomer_sim::math::acos(of)
        }
    }

    #[test]
    fn radius_colour_and_lean_end_a_piece() {
        let stepped = chain(10, |t| (Vec3::Z * t, if t < 0.45 { 0.02 } else { 0.01 }));
        assert_eq!(kept(&stepped, &FINE), [0, 4, 5, 10]);
        let mut coloured = chain(10, |t| (Vec3::Z * t, 0.01));
        coloured.iter_mut().enumerate().for_each(|(k, sample)| sample.colour = [0, 10 * k as u8, 0]);
        assert_eq!(kept(&coloured, &Tolerance { colour: 20, ..FINE }), [0, 3, 6, 9, 10]);
        // A thick zigzag within the tolerance of its line still loses of its radius.
        let zigzag = |radius: f32| {
            chain(10, move |t| (Vec3::new(4e-4 * ((10.0 * t + 0.5) as i32 % 2) as f32, 0.0, 1e-3 * t), radius))
        };
        assert_eq!(kept(&zigzag(1e-4), &FINE), [0, 10]);
        assert!(kept(&zigzag(0.1), &FINE).len() > 5);
    }
}
