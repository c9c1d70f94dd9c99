//! The density of what has grown: a sum of fields about points, and its gradient (the falloff of Wyvill, McPheeters &
//! Wyvill 1986).
//!
//! Points lie in cubes of the reach of a field, so that only those of 27 cubes are asked. Absent: growth.

use phytomer_sim::shape::falloff;
use std::collections::BTreeMap;

/// A field of density.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Density {
    /// The distance at which the field about a point ends, metres.
    reach: f64,
    cubes: BTreeMap<[i32; 3], Vec<[f64; 3]>>,
}

impl Density {
    /// An empty field of points that reach so far.
    pub fn of(reach: f64) -> Self {
        Self { reach, cubes: BTreeMap::new() }
    }

    fn cube(&self, point: [f64; 3]) -> [i32; 3] {
        point.map(|x| (x / self.reach).floor() as i32)
    }

    /// Adds a point.
    pub fn add(&mut self, point: [f64; 3]) {
        self.cubes.entry(self.cube(point)).or_default().push(point);
    }

    /// The density at a point, and its gradient, 1/m; `None` where the density is above `most`, which is known as soon
    /// as so many points have been asked as add up to it.
    pub fn at(&self, point: [f64; 3], most: f64) -> Option<(f64, [f64; 3])> {
        let cube = self.cube(point);
        let square = self.reach * self.reach;
        let (mut density, mut gradient) = (0.0, [0.0; 3]);
        for k in 0..27 {
            let near = [k % 3, k / 3 % 3, k / 9];
            let near = [0, 1, 2].map(|axis| cube[axis].saturating_add(near[axis] - 1));
            for other in self.cubes.get(&near).into_iter().flatten() {
                let away = [0, 1, 2].map(|axis| point[axis] - other[axis]);
                let q = away.iter().map(|x| x * x).sum::<f64>() / square;
                if q < 1.0 {
                    density += falloff(q);
                    // The derivative of the falloff by q.
                    let slope = -22.0 / 9.0 + q * (34.0 / 9.0 - q * (12.0 / 9.0));
                    (0..3).for_each(|axis| gradient[axis] += 2.0 * slope * away[axis] / square);
                    if density > most {
                        return None;
                    }
                }
            }
        }
        Some((density, gradient))
    }

    /// The density at the end of a straight row of points, `step` apart, that ends there.
    pub fn of_row(&self, step: f64) -> f64 {
        let q = |k: u32| (f64::from(k) * step / self.reach) * (f64::from(k) * step / self.reach);
        (0..).map(q).take_while(|q| *q < 1.0).map(falloff).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_density_is_the_sum_over_all_points_and_the_gradient_its_slope() {
        let point = |k: u32| [0, 1, 2].map(|axis| (f64::from(k * 37 % 101 + axis * 13 * k % 29)) / 40.0 - 1.0);
        let points: Vec<[f64; 3]> = (0..200).map(point).collect();
        let mut field = Density::of(0.7);
        points.iter().for_each(|at| field.add(*at));
        let all = |at: [f64; 3]| {
            let q = |other: &[f64; 3]| (0..3).map(|k| (at[k] - other[k]) * (at[k] - other[k])).sum::<f64>() / 0.49;
            points.iter().map(|other| falloff(q(other))).sum::<f64>()
        };
        let mut largest = 0.0_f64;
        for k in 0..100 {
            let at = point(k).map(|x| 0.9 * x + 0.01);
            let (density, gradient) = field.at(at, f64::INFINITY).expect("not too dense");
            assert_eq!(field.at(at, density), Some((density, gradient)));
            assert_eq!(field.at(at, 0.9 * density).is_some(), density == 0.0);
            assert!((density - all(at)).abs() < 1e-9, "{at:?}");
            for (axis, told) in gradient.into_iter().enumerate() {
                let beside = |by: f64| [0, 1, 2].map(|k| at[k] + if k == axis { by } else { 0.0 });
                let slope = (all(beside(1e-5)) - all(beside(-1e-5))) / 2e-5;
                assert!((slope - told).abs() < 1e-4, "{at:?}: {slope}, not {told}");
            }
            largest = largest.max(density);
        }
        assert!(largest > 1.0, "{largest}");
        assert!((field.of_row(0.35) - 1.5).abs() < 1e-12, "at its end, and ½ from half of the reach");
    }
}
