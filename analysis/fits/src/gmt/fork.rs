//! One branching as it stands: angles, ratios, and the turn of its plane, by the equations of GMT1 read backwards (Aono
//! & Kunii 1984, "3-D geometric model GMT1", Figs. 3, 4 and 10).
//!
//! The children of a mother leave her in a plane; its own is the one through the difference of their directions, so
//! that an angle does not depend on how regular divergences are. The turn of that plane is counted from the maximal
//! gradient plane, which holds the mother and the horizontal across her. Absent: which child is the left one
//! (`labels`).

use phytomer_sim::math;

/// A branch that leans by less than this counts as vertical, radians: a hundredth of a millimetre in ten metres. Below
/// it the direction of the lean is that of the errors.
const VERTICAL: f64 = 1e-6;

/// A vector.
pub type Vector = [f64; 3];

/// The children of a branching: left, right, and the centre one of three.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Children<T> {
    /// The left child, h1 and R1.
    pub left: T,
    /// The right child, h2 and R2.
    pub right: T,
    /// The centre child, R0.
    pub centre: Option<T>,
}

impl<T> Children<T> {
    /// Each child as something else.
    pub fn map<U>(self, mut of: impl FnMut(T) -> U) -> Children<U> {
        Children { left: of(self.left), right: of(self.right), centre: self.centre.map(of) }
    }
}

/// What is measured of a branching, in radians and shares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// h1 and h2: in the plane of the branching, above 0 to the left.
    pub angles: [f64; 2],
    /// R1 and R2.
    pub ratios: [f64; 2],
    /// R0.
    pub centre: Option<f64>,
    /// The turn of the plane, in (−π, π].
    pub turn: f64,
    /// The parts of unit vectors that the model has none of: of both lateral children out of the plane; of the centre
    /// child across the mother, in the plane and out of it.
    pub astray: [f64; 3],
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The horizontal unit vector on the left of a unit vector: −x where that is vertical, as in the models.
fn left_of([u, v, _]: Vector) -> Vector {
    let horizontal = (u * u + v * v).sqrt();
    if horizontal <= VERTICAL { [-1.0, 0.0, 0.0] } else { [-v / horizontal, u / horizontal, 0.0] }
}

/// The shape of a branching; `None` where a branch has no length, or the plane no direction.
pub fn shape(mother: Vector, children: Children<Vector>) -> Option<Shape> {
    let long = length(mother);
    if long.is_nan() || long <= 0.0 {
        return None;
    }
    let along = mother.map(|x| x / long);
    let left = left_of(along);
    let beyond = [
        along[1] * left[2] - along[2] * left[1],
        along[2] * left[0] - along[0] * left[2],
        along[0] * left[1] - along[1] * left[0],
    ];
    // Along the mother, to her left, and beyond.
    let seen = |child: Vector| {
        let size = length(child);
        let at = [along, left, beyond].map(|way| dot(child, way) / size);
        (size > 0.0 && size.is_finite()).then_some((at, size / long))
    };
    let (a, ratio_a) = seen(children.left)?;
    let (b, ratio_b) = seen(children.right)?;
    let apart = [a[1] - b[1], a[2] - b[2]];
    let wide = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
    if wide.is_nan() || wide <= 1e-12 {
        return None;
    }
    let across = apart.map(|x| x / wide);
    let in_plane = |at: [f64; 3]| at[1] * across[0] + at[2] * across[1];
    let out = |at: [f64; 3]| at[2] * across[0] - at[1] * across[1];
    let centre = match children.centre {
        Some(child) => Some(seen(child)?),
        None => None,
    };
    let [in_centre, out_centre] = centre.map_or([0.0; 2], |(at, _)| [in_plane(at), out(at)]);
    Some(Shape {
        angles: [a, b].map(|at| math::atan2(in_plane(at), at[0])),
        ratios: [ratio_a, ratio_b],
        centre: centre.map(|(_, ratio)| ratio),
        turn: math::atan2(across[1], across[0]),
        astray: [out(a), in_centre, out_centre],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The printed equations: x = R (u cos h − S T v sin h), y = R (v cos h + S T u sin h), z = R w cos h.
    fn printed([u, v, w]: Vector, ratio: f64, angle: f64) -> Vector {
        let (s, t) = (1.0 / (u * u + v * v).sqrt(), (u * u + v * v + w * w).sqrt());
        let (sin, cos) = math::sincos(angle);
        [ratio * (u * cos - s * t * v * sin), ratio * (v * cos + s * t * u * sin), ratio * w * cos]
    }

    #[test]
    fn the_printed_equations_are_read_backwards() {
        for mother in [[0.31, -0.22, 0.9], [-2.0, 0.1, 0.0], [0.4, 0.4, -0.7]] {
            for [h1, h2] in [[0.0, -0.8], [0.3, -0.7], [0.6, -0.6], [0.9, 0.2]] {
                let children =
                    Children { left: printed(mother, 0.9, h1), right: printed(mother, 0.7, h2), centre: None };
                let found = shape(mother, children).expect("a shape");
                let off = [found.angles[0] - h1, found.angles[1] - h2, found.ratios[0] - 0.9, found.ratios[1] - 0.7];
                assert!(off.iter().all(|off| off.abs() < 1e-12), "{found:?}");
                assert!(found.turn.abs() < 1e-12 && found.astray[0].abs() < 1e-12, "{found:?}");
            }
        }
    }

    #[test]
    fn children_of_one_direction_have_no_plane() {
        let [child, mother] = [[0.0, 0.1, 1.0], [0.0, 0.0, 1.0]];
        assert_eq!(shape(mother, Children { left: child, right: child, centre: None }), None);
        assert_eq!(shape(mother, Children { left: child, right: [0.0; 3], centre: None }), None);
    }
}
