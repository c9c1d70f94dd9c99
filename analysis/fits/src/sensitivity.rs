//! Which of a model's numbers matter: the screening of Morris (1991) and the indices of Sobol' (1993).
//!
//! A model is a function from numbers in [0, 1), one a factor, and the seed of a repetition to a result. Morris: mean
//! size and spread of elementary effects along random ways. Sobol': first-order indices by the estimator of Saltelli et
//! al. (2010, Table 2 b), total ones by that of Jansen (1999), on Owen-scrambled Sobol' points (Burley 2020); intervals
//! by a bootstrap over the points. All evaluations of a point use one seed (common random numbers), and the share of
//! the seed's noise is the variance between two seeds at equal points. Absent: the model, and files.

use crate::draws::Draws;
use crate::problem::Problem;
use sobol_burley::sample;

/// A model: shares of the ranges of its factors, and a seed.
pub type Model<'a> = &'a (dyn Fn(&[f64], u64) -> f64 + Sync);

/// The most factors of one analysis; the points have two dimensions a factor.
pub const MOST_FACTORS: usize = 100;

/// The most base points: the sequence has no more.
pub const MOST_POINTS: u32 = 1 << 16;

/// The effect of a factor along random ways.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effect {
    /// The mean size of the elementary effects (Campolongo et al. 2007).
    pub size: f64,
    /// Their standard deviation: above 0 where the effect is not linear, or depends on other factors.
    pub spread: f64,
}

/// The indices of a factor, with 95 % intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indices {
    /// The share of the variance that is the factor's alone.
    pub first: f64,
    /// Its interval.
    pub first_within: [f64; 2],
    /// The share in which the factor has any part.
    pub total: f64,
    /// Its interval.
    pub total_within: [f64; 2],
}

/// The indices of all factors, and the share of the variance between seeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Sobol {
    /// A factor each.
    pub indices: Vec<Indices>,
    /// The variance between two seeds at one point, as a share of the variance of all.
    pub noise: f64,
}

fn checked(factors: usize, points: usize) -> Result<(), Problem> {
    if factors == 0 || factors > MOST_FACTORS {
        let (what, found) = ("the number of factors".to_owned(), factors as f64);
        return Err(Problem::Impossible { what, found, expected: "1 to 100" });
    }
    if points < 4 {
        return Err(Problem::TooFew { what: "points", found: points, needed: 4, purpose: "a sensitivity" });
    }
    Ok(())
}

/// Elementary effects over so many ways, on a grid of four levels with steps of 2/3.
///
/// # Errors
/// No factors or too many, fewer than four ways.
pub fn morris(model: Model<'_>, factors: usize, ways: usize, seed: u64) -> Result<Vec<Effect>, Problem> {
    checked(factors, ways)?;
    const STEP: f64 = 2.0 / 3.0;
    let mut effects = vec![Vec::with_capacity(ways); factors];
    for way in 0..ways as u64 {
        let mut draws = Draws::new(seed, way);
        // Levels 0 and 1/3 go up, 2/3 and 1 go down.
        let mut point: Vec<f64> = (0..factors).map(|_| draws.below(4) as f64 / 3.0).collect();
        let mut order: Vec<usize> = (0..factors).collect();
        (1..factors).rev().for_each(|k| order.swap(k, draws.below(k + 1)));
        let mut last = model(&point, way);
        for factor in order {
            let step = if point[factor] < 0.5 { STEP } else { -STEP };
            point[factor] += step;
            let here = model(&point, way);
            effects[factor].push((here - last) / step);
            last = here;
        }
    }
    let n = ways as f64;
    let of = |effects: Vec<f64>| {
        let mean = effects.iter().sum::<f64>() / n;
        let square = effects.iter().map(|effect| (effect - mean) * (effect - mean)).sum::<f64>();
        Effect { size: effects.iter().map(|effect| effect.abs()).sum::<f64>() / n, spread: (square / (n - 1.0)).sqrt() }
    };
    Ok(effects.into_iter().map(of).collect())
}

/// The values of the model at the points of one base sample.
struct Values {
    a: Vec<f64>,
    b: Vec<f64>,
    /// A with the column of a factor from B.
    mixed: Vec<Vec<f64>>,
    /// A with other seeds.
    again: Vec<f64>,
}

/// First-order and total indices from so many base points; the model is called factors + 3 times for each.
///
/// # Errors
/// No factors or too many, fewer than four points, a result that never differs.
pub fn sobol(model: Model<'_>, factors: usize, points: u32, seed: u32) -> Result<Sobol, Problem> {
    checked(factors, points as usize)?;
    if points > MOST_POINTS {
        let (what, found) = ("the number of points".to_owned(), f64::from(points));
        return Err(Problem::Impossible { what, found, expected: "at most 65536" });
    }
    let at = |point: u32, dimension: usize| f64::from(sample(point, dimension as u32, seed));
    let mut values = Values { a: Vec::new(), b: Vec::new(), mixed: vec![Vec::new(); factors], again: Vec::new() };
    for point in 0..points {
        let [a, b] = [0, factors].map(|from| (0..factors).map(|k| at(point, from + k)).collect::<Vec<f64>>());
        let own = u64::from(point);
        values.a.push(model(&a, own));
        values.b.push(model(&b, own));
        values.again.push(model(&a, own + (1 << 40)));
        for (factor, mixed) in values.mixed.iter_mut().enumerate() {
            let mut point = a.clone();
            point[factor] = b[factor];
            mixed.push(model(&point, own));
        }
    }
    let all: Vec<usize> = (0..points as usize).collect();
    let variance = variance(&values, &all);
    if !(variance > 0.0 && variance.is_finite()) {
        let consequence = "no factor has a share of it; widen the ranges, or look at another result";
        return Err(Problem::Degenerate { what: "the result is the same at all points".to_owned(), consequence });
    }
    let mut draws = Draws::new(seed.into(), 1);
    let drawn: Vec<Vec<usize>> = (0..200).map(|_| (0..all.len()).map(|_| draws.below(all.len())).collect()).collect();
    let within = |of: &dyn Fn(&[usize]) -> f64| {
        let mut told: Vec<f64> = drawn.iter().map(|chosen| of(chosen)).collect();
        told.sort_by(f64::total_cmp);
        [told[4], told[194]]
    };
    let indices = (0..factors).map(|factor| Indices {
        first: first(&values, factor, &all),
        first_within: within(&|chosen| first(&values, factor, chosen)),
        total: total(&values, factor, &all),
        total_within: within(&|chosen| total(&values, factor, chosen)),
    });
    let squares = values.a.iter().zip(&values.again).map(|(a, again)| (a - again) * (a - again));
    let noise = squares.sum::<f64>() / (2.0 * f64::from(points)) / variance;
    Ok(Sobol { indices: indices.collect(), noise })
}

/// Of the values at both base samples.
fn variance(values: &Values, chosen: &[usize]) -> f64 {
    let all = || chosen.iter().flat_map(|&k| [values.a[k], values.b[k]]);
    let n = 2.0 * chosen.len() as f64;
    let mean = all().sum::<f64>() / n;
    all().map(|value| (value - mean) * (value - mean)).sum::<f64>() / n
}

/// Saltelli et al. (2010): mean of f(B) (f(A with B's column) − f(A)), by the variance. A constant is taken from all
/// values first, which changes nothing but rounding.
fn first(values: &Values, factor: usize, chosen: &[usize]) -> f64 {
    let n = chosen.len() as f64;
    let mean = chosen.iter().map(|&k| values.b[k]).sum::<f64>() / n;
    let term = |&k: &usize| (values.b[k] - mean) * (values.mixed[factor][k] - values.a[k]);
    chosen.iter().map(term).sum::<f64>() / n / variance(values, chosen)
}

/// Jansen (1999): half the mean square of f(A) − f(A with B's column), by the variance.
fn total(values: &Values, factor: usize, chosen: &[usize]) -> f64 {
    let term = |&k: &usize| (values.a[k] - values.mixed[factor][k]) * (values.a[k] - values.mixed[factor][k]);
    chosen.iter().map(term).sum::<f64>() / (2.0 * chosen.len() as f64) / variance(values, chosen)
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_sim::math;
    use std::f64::consts::PI;

    /// Ishigami & Homma (1990), a = 7, b = .1.
    fn ishigami(shares: &[f64], _: u64) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|k| PI * (2.0 * shares[k] - 1.0));
        let sin = math::sin(y);
        math::sin(x) + 7.0 * sin * sin + 0.1 * z * z * z * z * math::sin(x)
    }

    #[test]
    fn the_indices_of_ishigami() {
        let told = sobol(&ishigami, 3, 16_384, 1).unwrap();
        for (found, (first, total)) in told.indices.iter().zip([(0.3139, 0.5576), (0.4424, 0.4424), (0.0, 0.2437)]) {
            println!("{found:?}");
            assert!((found.first - first).abs() < 0.01 && (found.total - total).abs() < 0.01, "{found:?}");
            assert!(found.first_within[0] <= first + 0.01 && first - 0.01 <= found.first_within[1], "{found:?}");
        }
        assert_eq!(told.noise, 0.0);
    }

    /// 2 x + a number of the seed of variance 1/12: x has 4/5 of the variance, and the seed one fifth.
    #[test]
    fn the_share_of_the_seed() {
        let model = |shares: &[f64], seed: u64| 2.0 * shares[0] + Draws::new(7, seed).share();
        let told = sobol(&model, 1, 8192, 3).unwrap();
        assert!((told.noise - 0.2).abs() < 0.02, "{}", told.noise);
        let effects = morris(&|shares: &[f64], _| 3.0 * shares[0] - shares[1] * shares[1], 3, 40, 5).unwrap();
        assert!((effects[0].size - 3.0).abs() < 1e-12 && effects[0].spread < 1e-12 && effects[2].size == 0.0);
        assert!(effects[1].spread > 0.1, "{effects:?}");
    }

    #[test]
    fn what_has_no_indices_is_told() {
        assert!(sobol(&|_, _| 1.0, 2, 64, 1).unwrap_err().to_string().contains("the same at all points"));
        assert!(sobol(&|_, _| 1.0, 0, 64, 1).is_err() && morris(&|_, _| 1.0, 2, 1, 1).is_err());
    }
}
