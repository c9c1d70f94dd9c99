//! Vectors of three numbers.

/// The length of a vector.
pub fn norm(of: [f64; 3]) -> f64 {
    (of[0] * of[0] + of[1] * of[1] + of[2] * of[2]).sqrt()
}

/// A vector of length 1, as it is where it has that length but for rounding, so that what is written stays as it was
/// read; `None` for one of no length.
pub fn unit(of: [f64; 3]) -> Option<[f64; 3]> {
    let length = norm(of);
    if (length - 1.0).abs() < 1e-6 {
        return Some(of);
    }
    (length.is_finite() && length > 0.0).then(|| of.map(|x| x / length))
}

/// The cross product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction across another that points up the most; that of y where the other is upright.
pub fn upward([x, y, z]: [f64; 3]) -> [f64; 3] {
    let across = [-z * x, -z * y, x * x + y * y];
    if norm(across) < 1e-9 { [0.0, 1.0, 0.0] } else { across.map(|of| of / norm(across)) }
}

/// The columns of a matrix with these directions of x and z, y across them to the left, and a place.
pub fn frame(along: [f64; 3], up: [f64; 3], place: [f64; 3]) -> [[f64; 4]; 3] {
    let length = norm(along);
    let left = if length > 0.0 { cross(up, along).map(|of| of / length) } else { [0.0; 3] };
    [0, 1, 2].map(|k| [along[k], left[k], up[k], place[k]])
}
