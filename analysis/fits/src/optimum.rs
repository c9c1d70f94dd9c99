//! The largest value of a function of a few variables: the simplex of Nelder & Mead (1965), started again until it
//! stays, then Newton's steps with numerical derivatives.
//!
//! Values that are not finite count as minus infinity, so that a likelihood may refuse a point. Absent: constraints;
//! whoever asks states bounded parameters on a scale without bounds.

use crate::matrix::{Matrix, inverse};

/// A place and the value there.
#[derive(Debug, Clone)]
pub struct Optimum {
    pub at: Vec<f64>,
    pub value: f64,
}

fn judged(f: &dyn Fn(&[f64]) -> f64, at: &[f64]) -> f64 {
    let value = f(at);
    if value.is_finite() { value } else { f64::NEG_INFINITY }
}

/// The largest value near `start`, of which `step` is the first distance in each variable.
pub fn largest(f: &dyn Fn(&[f64]) -> f64, start: &[f64], step: f64) -> Optimum {
    let mut best = Optimum { at: start.to_vec(), value: judged(f, start) };
    if start.is_empty() {
        return best;
    }
    let mut step = step;
    for _ in 0..12 {
        let found = simplex(f, &best.at, step, 1e-9);
        let gain = found.value - best.value;
        if found.value >= best.value {
            best = found;
        }
        if gain < 1e-7 {
            break;
        }
        step *= 0.5;
    }
    newton(f, best)
}

/// The largest value within 10⁻⁶, from a start that is near it.
pub fn near(f: &dyn Fn(&[f64]) -> f64, start: &[f64], step: f64) -> Optimum {
    if start.is_empty() {
        return Optimum { at: Vec::new(), value: judged(f, start) };
    }
    simplex(f, start, step, 1e-7)
}

/// One run of the simplex, until the values of its corners differ by less than `within`.
fn simplex(f: &dyn Fn(&[f64]) -> f64, start: &[f64], step: f64, within: f64) -> Optimum {
    let n = start.len();
    let mut corners: Vec<Optimum> = vec![Optimum { at: start.to_vec(), value: judged(f, start) }];
    for place in 0..n {
        let mut at = start.to_vec();
        at[place] += step;
        corners.push(Optimum { value: judged(f, &at), at });
    }
    for _ in 0..400 * n {
        corners.sort_by(|a, b| b.value.total_cmp(&a.value));
        if corners[0].value - corners[n].value < within && spread(&corners) < 1e-3 {
            break;
        }
        turn(f, &mut corners);
    }
    corners.sort_by(|a, b| b.value.total_cmp(&a.value));
    corners.swap_remove(0)
}

fn spread(corners: &[Optimum]) -> f64 {
    let off = |corner: &Optimum| corner.at.iter().zip(&corners[0].at).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    corners.iter().map(off).fold(0.0, f64::max)
}

/// Replaces the worst corner, or draws all towards the best. The corners are sorted, the best first.
fn turn(f: &dyn Fn(&[f64]) -> f64, corners: &mut [Optimum]) {
    let n = corners.len() - 1;
    let centre: Vec<f64> =
        (0..n).map(|k| corners[..n].iter().map(|corner| corner.at[k]).sum::<f64>() / n as f64).collect();
    let along = |by: f64| {
        let at: Vec<f64> = centre.iter().zip(&corners[n].at).map(|(c, worst)| c + by * (c - worst)).collect();
        Optimum { value: judged(f, &at), at }
    };
    let reflected = along(1.0);
    let next = if reflected.value > corners[0].value {
        let far = along(2.0);
        if far.value > reflected.value { far } else { reflected }
    } else if reflected.value > corners[n - 1].value {
        reflected
    } else {
        let inside = if reflected.value > corners[n].value { along(0.5) } else { along(-0.5) };
        if inside.value > corners[n].value.max(reflected.value) { inside } else { return shrink(f, corners) }
    };
    corners[n] = next;
}

fn shrink(f: &dyn Fn(&[f64]) -> f64, corners: &mut [Optimum]) {
    let best = corners[0].at.clone();
    for corner in &mut corners[1..] {
        corner.at.iter_mut().zip(&best).for_each(|(x, b)| *x = b + 0.5 * (*x - b));
        corner.value = judged(f, &corner.at);
    }
}

/// Newton's steps, as long as they gain something.
fn newton(f: &dyn Fn(&[f64]) -> f64, mut best: Optimum) -> Optimum {
    for _ in 0..8 {
        let Some(inverted) = inverse(&hessian(f, &best.at)) else { break };
        let slope = gradient(f, &best.at);
        let at: Vec<f64> = (0..best.at.len())
            .map(|row| best.at[row] - inverted[row].iter().zip(&slope).map(|(h, g)| h * g).sum::<f64>())
            .collect();
        let value = judged(f, &at);
        if value <= best.value {
            break;
        }
        best = Optimum { at, value };
    }
    best
}

fn gradient(f: &dyn Fn(&[f64]) -> f64, at: &[f64]) -> Vec<f64> {
    let slope = |place: usize| {
        let h = 1e-5 * (1.0 + at[place].abs());
        let moved = |by: f64| {
            let mut point = at.to_vec();
            point[place] += by;
            judged(f, &point)
        };
        (moved(h) - moved(-h)) / (2.0 * h)
    };
    (0..at.len()).map(slope).collect()
}

/// The second derivatives by central differences.
pub fn hessian(f: &dyn Fn(&[f64]) -> f64, at: &[f64]) -> Matrix {
    let n = at.len();
    let h: Vec<f64> = at.iter().map(|x| 3e-4 * (1.0 + x.abs())).collect();
    let moved = |by: &[(usize, f64)]| {
        let mut point = at.to_vec();
        by.iter().for_each(|&(place, sign)| point[place] += sign * h[place]);
        judged(f, &point)
    };
    let centre = judged(f, at);
    let entry = |i: usize, j: usize| {
        if i == j {
            (moved(&[(i, 1.0)]) - 2.0 * centre + moved(&[(i, -1.0)])) / (h[i] * h[i])
        } else {
            let corner = |a: f64, b: f64| moved(&[(i, a), (j, b)]);
            (corner(1.0, 1.0) - corner(1.0, -1.0) - corner(-1.0, 1.0) + corner(-1.0, -1.0)) / (4.0 * h[i] * h[j])
        }
    };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley (1960) has its lowest point at (1, 1).
    #[test]
    fn the_valley_of_rosenbrock() {
        let f = |x: &[f64]| -(100.0 * (x[1] - x[0] * x[0]) * (x[1] - x[0] * x[0]) + (1.0 - x[0]) * (1.0 - x[0]));
        let found = largest(&f, &[-1.2, 1.0], 0.5);
        assert!((found.at[0] - 1.0).abs() < 1e-6 && (found.at[1] - 1.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn a_point_that_is_refused_is_left() {
        let f = |x: &[f64]| if x[0] < 0.5 { f64::NAN } else { -(x[0] - 0.6) * (x[0] - 0.6) };
        assert!((largest(&f, &[2.0], 1.0).at[0] - 0.6).abs() < 1e-6);
        assert!(largest(&|_| f64::NAN, &[2.0], 1.0).value == f64::NEG_INFINITY);
    }

    #[test]
    fn second_derivatives_of_a_quadratic_form() {
        let f = |x: &[f64]| 3.0 * x[0] * x[0] - 2.0 * x[0] * x[1] + 5.0 * x[1] * x[1];
        let found = hessian(&f, &[1.0, 2.0]);
        for (row, expected) in found.iter().zip([[6.0, -2.0], [-2.0, 10.0]]) {
            row.iter().zip(expected).for_each(|(a, b)| assert!((a - b).abs() < 1e-5, "{a} {b}"));
        }
    }
}
