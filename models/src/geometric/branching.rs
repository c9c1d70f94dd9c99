//! The equations of GMT1 as printed (Aono & Kunii 1984, "3-D geometric model GMT1", Fig. 3), with the deviation δ of
//! their Fig. 10.
//!
//! A branch is the vector (u, v, w) from its root P_A to its tip P_B, so that P_i = P_B + the vector of child i;
//! vectors are carried instead of points because a difference of points loses the digits of a short, far branch. Z is
//! up. Absent on purpose: levels, axes and everything that a plant is.

use phytomer_sim::math;
use std::f64::consts::PI;

/// A branch whose horizontal part is smaller than this share of its length counts as vertical. The headings of a
/// vertical axis are off by some 1e-16, and no branch that is meant to lean leans by 1e-12 (a sixth of a micron a
/// hundred kilometres up).
const VERTICAL: f64 = 1e-12;

/// The vector of a child branch, P_i − P_B, from its mother's P_B − P_A.
///
/// x_i − x_B = R_i (u cos h_i − S T v sin h_i), y_i − y_B = R_i (v cos h_i + S T u sin h_i) and
/// z_i − z_B = R_i w cos h_i where the `deviation` is 0: the child lies in the maximal gradient plane, which holds the
/// mother and the horizontal across her. A deviation of δ turns that plane by δ about the mother, counter-clockwise
/// seen from her tip backwards. `angle` is h_i and, as the deviation, in radians; `ratio` is R_i.
pub fn child(mother: [f64; 3], ratio: f64, angle: f64, deviation: f64) -> [f64; 3] {
    Spread::of(mother, math::sincos(deviation)).child(ratio, math::sincos(angle))
}

/// The plane in which a mother bears her children.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spread {
    mother: [f64; 3],
    /// T of the paper.
    length: f64,
    /// The unit vector across the mother on her left.
    across: [f64; 3],
}

impl Spread {
    /// The maximal gradient plane, turned about the mother by an angle with this sine and cosine.
    #[inline]
    pub fn of(mother: [f64; 3], turn: (f64, f64)) -> Self {
        let length = length(mother);
        Self { mother, length, across: turned(left_of(mother), mother.map(|x| x / length), turn) }
    }

    /// The vector of a child at an angle with this sine and cosine.
    #[inline]
    pub fn child(&self, ratio: f64, (sin, cos): (f64, f64)) -> [f64; 3] {
        [0, 1, 2].map(|i| ratio * (self.mother[i] * cos + self.length * self.across[i] * sin))
    }

    /// The angle between the mother and a vector, and the azimuth of the vector about her from her right,
    /// counter-clockwise seen from her tip backwards, in [0, 2π), radians; 0 where there is none.
    pub fn angles(&self, vector: [f64; 3]) -> (f64, f64) {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let [x, y, z] = self.mother.map(|x| x / self.length);
        let [a, b, c] = self.across;
        let beyond = [y * c - z * b, z * a - x * c, x * b - y * a];
        let (left, far) = (dot(vector, self.across), dot(vector, beyond));
        let azimuth = math::atan2(0.0 - far, 0.0 - left);
        let angle = math::atan2((left * left + far * far).sqrt(), dot(vector, [x, y, z]));
        (angle, if azimuth < 0.0 { (azimuth + 2.0 * PI).min(2.0 * PI - 1e-9) } else { azimuth })
    }
}

/// The horizontal unit vector on the left of a branch, (−S v, S u, 0).
///
/// S is infinite on a vertical branch. There the rule for the first two children holds: "on the plane parallel to the
/// direction of gravity". Of all such planes this takes x–z, the plane of the paper's front views, seen from −y with x
/// to the right: the left is −x.
pub fn left_of(branch: [f64; 3]) -> [f64; 3] {
    let [u, v, _] = branch;
    let horizontal = (u * u + v * v).sqrt();
    if horizontal <= VERTICAL * length(branch) {
        return [-1.0, 0.0, 0.0];
    }
    let s = 1.0 / horizontal;
    [-s * v, s * u, 0.0]
}

/// The horizontal unit vector `left` turned about the unit vector `about`, at right angles to it, by an angle with this
/// sine and cosine.
fn turned(left: [f64; 3], about: [f64; 3], (sin, cos): (f64, f64)) -> [f64; 3] {
    let [a, b, _] = left;
    let [x, y, z] = about;
    let beyond = [-z * b, z * a, x * b - y * a];
    [0, 1, 2].map(|i| cos * left[i] + sin * beyond[i])
}

/// The length of a branch: T of the paper.
pub(super) fn length([u, v, w]: [f64; 3]) -> f64 {
    (u * u + v * v + w * w).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    fn angle_between(a: [f64; 3], b: [f64; 3]) -> f64 {
        math::acos((dot(a, b) / (length(a) * length(b))).clamp(-1.0, 1.0))
    }

    const MOTHERS: [[f64; 3]; 6] =
        [[0.0, 0.0, 1.0], [0.3, -0.2, 0.9], [-2.0, 0.1, 0.0], [1e-3, 2e-3, 5.0], [0.4, 0.4, -0.7], [0.0, 0.0, -3.0]];

    #[test]
    fn a_child_makes_its_angle_with_its_mother_and_has_its_share_of_her_length() {
        for mother in MOTHERS {
            for (angle, deviation) in [(0.3, 0.0), (-1.2, 0.0), (0.6, 2.4), (-0.7, 5.0), (1.5, 1.0)] {
                let child = child(mother, 0.7, angle, deviation);
                assert!(
                    (angle_between(mother, child) - f64::abs(angle)).abs() < 1e-9,
                    "{mother:?} {angle} {deviation}"
                );
                assert!((length(child) - 0.7 * length(mother)).abs() < 1e-12);
            }
        }
    }

    /// The plane of the mother and of the horizontal across her; its normal is what the mother climbs along.
    #[test]
    fn without_deviation_the_children_lie_in_the_maximal_gradient_plane() {
        for mother @ [u, v, w] in MOTHERS {
            let horizontal = (u * u + v * v).sqrt();
            if horizontal == 0.0 {
                continue;
            }
            let normal = [-u * w / horizontal, -v * w / horizontal, horizontal];
            assert!(dot(normal, mother).abs() < 1e-12, "the normal of the plane is wrong");
            for angle in [0.4, -1.1] {
                assert!(dot(normal, child(mother, 0.9, angle, 0.0)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_equations_stand_as_printed() {
        let (u, v, w): (f64, f64, f64) = (0.31, -0.22, 0.9);
        let (s, t) = (1.0 / (u * u + v * v).sqrt(), (u * u + v * v + w * w).sqrt());
        let (r, h) = (0.8, -0.65);
        let (sin, cos) = math::sincos(h);
        let printed = [r * (u * cos - s * t * v * sin), r * (v * cos + s * t * u * sin), r * w * cos];
        let found = child([u, v, w], r, h, 0.0);
        assert!((0..3).all(|i| (found[i] - printed[i]).abs() < 1e-15), "{found:?} is not {printed:?}");
    }

    #[test]
    fn the_children_of_a_vertical_branch_lie_in_the_front_plane_left_and_right() {
        let up = [0.0, 0.0, 2.0];
        let left = child(up, 0.5, FRAC_PI_2 / 2.0, 0.0);
        let right = child(up, 0.5, -FRAC_PI_2 / 2.0, 0.0);
        assert!(left[0] < 0.0 && right[0] > 0.0 && left[1] == 0.0 && right[1] == 0.0);
        let back = child(up, 0.5, -FRAC_PI_2 / 2.0, FRAC_PI_2);
        assert!(back[1] > 0.7 && back[0].abs() < 1e-15, "a quarter turn leads from +x to +y");
    }

    #[test]
    fn a_deviation_turns_both_children_about_their_mother() {
        for mother in MOTHERS {
            let plain = child(mother, 1.0, 0.9, 0.0);
            let half = child(mother, 1.0, 0.9, PI);
            let other = child(mother, 1.0, -0.9, 0.0);
            assert!((0..3).all(|i| (half[i] - other[i]).abs() < 1e-12), "half a turn swaps left and right");
            let quarter = child(mother, 1.0, 0.9, FRAC_PI_2);
            let along = dot(mother, plain) / dot(mother, mother);
            let across = |c: [f64; 3]| [0, 1, 2].map(|i| c[i] - along * mother[i]);
            assert!(dot(across(plain), across(quarter)).abs() < 1e-12);
        }
    }
}
