//! The sky as parts that send parallel light: rings of equal elevation, each cut into azimuths.
//!
//! The sines of the elevations of the rings are the nodes of Gauss and Legendre's quadrature over (0, 1), so that an
//! integral over the sky is exact for polynomials of the sine up to the degree 2 n − 1 (Abramowitz & Stegun 1964,
//! eq. 25.4.30). A uniform sky sends as much from every part; the standard overcast sky (1 + 2 sin β) / 3 of the zenith
//! (Moon & Spencer 1942). Absent: the sun, clouds at a place, the ring around the sun.

use super::Source;
use crate::math::{cos, sincos};
use std::f64::consts::{PI, TAU};

/// The most rings of a sky.
pub const MOST_RINGS: u32 = 64;
/// The most azimuths of a ring.
pub const MOST_AZIMUTHS: u32 = 512;

/// How bright the parts of a sky are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SkyKind {
    /// All alike.
    #[default]
    Uniform,
    /// As under standard overcast: the zenith three times as bright as the horizon.
    Overcast,
}

/// A sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sky {
    /// How bright its parts are.
    pub kind: SkyKind,
    /// Its rings, from 1 to [`MOST_RINGS`].
    pub rings: u32,
    /// The azimuths of each ring, from 1 to [`MOST_AZIMUTHS`].
    pub azimuths: u32,
}

impl Default for Sky {
    fn default() -> Self {
        Self { kind: SkyKind::Uniform, rings: 5, azimuths: 8 }
    }
}

impl Sky {
    /// Its parts; the shares of light on level ground sum to 1.
    pub fn sources(&self) -> Vec<Source> {
        let azimuths = self.azimuths.clamp(1, MOST_AZIMUTHS);
        let rings = gauss_legendre(self.rings.clamp(1, MOST_RINGS));
        let light = |(sine, weight): &(f64, f64)| weight * sine * self.brightness(*sine);
        let all: f64 = rings.iter().map(light).sum();
        let mut sources = Vec::with_capacity(rings.len() * azimuths as usize);
        for (number, ring) in rings.iter().enumerate() {
            let level = (1.0 - ring.0 * ring.0).max(0.0).sqrt();
            for part in 0..azimuths {
                // Rings are turned against one another, so that no two parts stand above one another.
                let turned = f64::from(part) + 0.5 + 0.5 * (number % 2) as f64;
                let (sin, cos) = sincos(TAU * turned / f64::from(azimuths));
                let weight = light(ring) / all / f64::from(azimuths);
                sources.push(Source { towards: [level * cos, level * sin, ring.0], weight });
            }
        }
        sources
    }

    fn brightness(&self, sine: f64) -> f64 {
        match self.kind {
            SkyKind::Uniform => 1.0,
            SkyKind::Overcast => (1.0 + 2.0 * sine) / 3.0,
        }
    }
}

/// The nodes of Gauss and Legendre's quadrature over (0, 1) with their weights, rising.
pub fn gauss_legendre(count: u32) -> Vec<(f64, f64)> {
    let n = f64::from(count);
    let node = |place: u32| {
        let mut x = cos(PI * (f64::from(place) + 0.75) / (n + 0.5));
        let mut slope = 1.0;
        // Newton's steps from that place double the digits: five are more than enough.
        for _ in 0..8 {
            let (value, of) = legendre(count, x);
            slope = of;
            x -= value / slope;
        }
        ((1.0 - x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

/// Legendre's polynomial of this degree at a place, with its slope.
fn legendre(degree: u32, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=degree {
        let k = f64::from(k);
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, f64::from(degree) * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quadrature_is_exact_up_to_its_degree() {
        for count in [1_u32, 2, 5, 9, 32] {
            let nodes = gauss_legendre(count);
            assert!(nodes.windows(2).all(|two| two[0].0 < two[1].0));
            for degree in 0..2 * count as i32 {
                let sum: f64 = nodes.iter().map(|(x, weight)| weight * crate::math::pow(*x, f64::from(degree))).sum();
                assert!((sum * f64::from(degree + 1) - 1.0).abs() < 1e-12, "{count} nodes, degree {degree}: {sum}");
            }
        }
        // Abramowitz & Stegun 1964, table 25.4: x = .906179845938664 and w = .236926885056189 on (−1, 1).
        let last = gauss_legendre(5)[4];
        assert!((2.0 * last.0 - 1.0 - 0.906_179_845_938_664).abs() < 1e-14, "{last:?}");
        assert!((2.0 * last.1 - 0.236_926_885_056_189).abs() < 1e-14, "{last:?}");
    }

    /// The mean sine of elevation, weighted by the light on level ground: ⅔ of a uniform sky, and 5/7 of an overcast
    /// one: ∫ x² (1 + 2x) / ∫ x (1 + 2x).
    #[test]
    fn skies_are_as_bright_as_they_are_said_to_be() {
        for (kind, mean) in [(SkyKind::Uniform, 2.0 / 3.0), (SkyKind::Overcast, 5.0 / 7.0)] {
            let sources = Sky { kind, rings: 3, azimuths: 7 }.sources();
            assert_eq!(sources.len(), 21);
            let sum: f64 = sources.iter().map(|source| source.weight).sum();
            let sine: f64 = sources.iter().map(|source| source.weight * source.towards[2]).sum();
            assert!((sum - 1.0).abs() < 1e-14 && (sine - mean).abs() < 1e-14, "{kind:?}: {sum} {sine}");
            let east: f64 = sources.iter().map(|source| source.weight * source.towards[0]).sum();
            assert!(east.abs() < 1e-14, "no side is preferred: {east}");
            for Source { towards: [x, y, z], .. } in sources {
                assert!((x * x + y * y + z * z - 1.0).abs() < 1e-14);
            }
        }
    }
}
