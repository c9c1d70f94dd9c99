//! Vectors of three numbers, in the coordinates of a turtle: products and directions.
//!
//! Double precision, as the turtle has it; the frames of a plant have vectors of their own (`phytomer_sim::vector`).
//! Absent: turns (`turtle`).

/// Three numbers.
pub type Vector = [f64; 3];

/// Below this square of its length a vector has no direction.
pub(super) const NOTHING: f64 = 1e-20;

#[inline]
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction of a vector, if it has one.
pub(super) fn unit(vector: Vector) -> Option<Vector> {
    let square = dot(vector, vector);
    let length = square.sqrt();
    (square > NOTHING && square.is_finite()).then(|| vector.map(|x| x / length))
}
