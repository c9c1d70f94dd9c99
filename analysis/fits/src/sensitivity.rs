//! Which of a model's numbers matter: the screening of Morris (1991) and the indices of Sobol' (1993).
//!
//! A model is a function from numbers in [0, 1], one a factor, and the seed of a repetition to a result. A design says
//! where it is to be evaluated, in any order and on any threads, and what the results tell. Morris: mean size and
//! spread of elementary effects along random ways. Sobol': first-order indices by the estimator of Saltelli et al.
//! (2010, Table 2 b), total ones by that of Jansen (1999), on Owen-scrambled Sobol' points (Burley 2020). Intervals are
//! those of a bootstrap over ways or points. All evaluations of a way or a point use one seed (common random numbers),
//! and the share of the seed's noise is the variance between two seeds at equal points. Absent: the model, and files.

use crate::draws::Draws;
use crate::problem::Problem;
use sobol_burley::sample;

/// A model: shares of the ranges of its factors, and a seed.
pub type Model<'a> = &'a (dyn Fn(&[f64], u64) -> f64 + Sync);

/// The most factors of the indices; the points have two dimensions a factor.
pub const MOST_FACTORS: usize = 100;

/// The most factors of a screening.
pub const MOST_SCREENED: usize = 2000;

/// The most base points: the sequence has no more.
pub const MOST_POINTS: u32 = 1 << 16;

/// Samples of a bootstrap.
const SAMPLES: usize = 200;

/// Where a model is to be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// The share of the range of each factor.
    pub at: Vec<f64>,
    /// The seed.
    pub seed: u64,
}

/// The effect of a factor along random ways.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effect {
    /// The mean size of the elementary effects (Campolongo et al. 2007).
    pub size: f64,
    /// Its interval of 95 %.
    pub size_within: [f64; 2],
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
    /// Its interval.
    pub noise_within: [f64; 2],
}

fn checked(factors: usize, most: usize, points: usize) -> Result<(), Problem> {
    if factors == 0 || factors > most {
        let (what, found) = ("the number of factors".to_owned(), factors as f64);
        let expected = if most == MOST_FACTORS { "1 to 100" } else { "1 to 2000" };
        return Err(Problem::Impossible { what, found, expected });
    }
    if points < 4 {
        return Err(Problem::TooFew { what: "points", found: points, needed: 4, purpose: "a sensitivity" });
    }
    Ok(())
}

/// The evaluations of so many ways on a grid of four levels, with steps of 2/3: factors + 1 of each way in turn.
///
/// # Errors
/// No factors or too many, fewer than four ways.
pub fn morris_design(factors: usize, ways: usize, seed: u64) -> Result<Vec<Evaluation>, Problem> {
    checked(factors, MOST_SCREENED, ways)?;
    const STEP: f64 = 2.0 / 3.0;
    let mut design = Vec::with_capacity(ways * (factors + 1));
    for way in 0..ways as u64 {
        let mut draws = Draws::new(seed, way);
        // Levels 0 and 1/3 go up, 2/3 and 1 go down.
        let mut at: Vec<f64> = (0..factors).map(|_| draws.below(4) as f64 / 3.0).collect();
        let mut order: Vec<usize> = (0..factors).collect();
        (1..factors).rev().for_each(|k| order.swap(k, draws.below(k + 1)));
        design.push(Evaluation { at: at.clone(), seed: way });
        for factor in order {
            at[factor] = (at[factor] + if at[factor] < 0.5 { STEP } else { -STEP }).clamp(0.0, 1.0);
            design.push(Evaluation { at: at.clone(), seed: way });
        }
    }
    Ok(design)
}

/// Elementary effects from the results of a design, in its order; a result that is not finite makes the effects on both
/// sides of it unknown, and they are left out. `seed` is that of the bootstrap.
pub fn morris_effects(design: &[Evaluation], results: &[f64], seed: u64) -> Vec<Effect> {
    let factors = design.first().map_or(0, |first| first.at.len());
    let mut effects = vec![Vec::new(); factors];
    for (points, values) in design.chunks(factors + 1).zip(results.chunks(factors + 1)) {
        for (pair, values) in points.windows(2).zip(values.windows(2)) {
            let moved = (0..factors).find(|k| pair[0].at[*k] != pair[1].at[*k]);
            let Some(factor) = moved else { continue };
            let effect = (values[1] - values[0]) / (pair[1].at[factor] - pair[0].at[factor]);
            effects[factor].extend(effect.is_finite().then_some(effect));
        }
    }
    let mut draws = Draws::new(seed, u64::MAX);
    effects.iter().map(|effects| effect(effects, &mut draws)).collect()
}

fn effect(effects: &[f64], draws: &mut Draws) -> Effect {
    let n = effects.len() as f64;
    let mean = effects.iter().sum::<f64>() / n;
    let square = effects.iter().map(|effect| (effect - mean) * (effect - mean)).sum::<f64>();
    let size = |chosen: &[f64]| chosen.iter().map(|effect| effect.abs()).sum::<f64>() / chosen.len() as f64;
    let mut sizes: Vec<f64> = (0..if effects.is_empty() { 0 } else { SAMPLES })
        .map(|_| size(&(0..effects.len()).map(|_| effects[draws.below(effects.len())]).collect::<Vec<f64>>()))
        .collect();
    Effect { size: size(effects), size_within: middle(&mut sizes), spread: (square / (n - 1.0)).sqrt() }
}

/// The limits between which 95 % of samples lie.
fn middle(values: &mut [f64]) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => [f64::NAN; 2],
        n => [values[n / 40], values[n - 1 - n / 40]],
    }
}

/// Elementary effects over so many ways.
///
/// # Errors
/// No factors or too many, fewer than four ways.
pub fn morris(model: Model<'_>, factors: usize, ways: usize, seed: u64) -> Result<Vec<Effect>, Problem> {
    let design = morris_design(factors, ways, seed)?;
    let results: Vec<f64> = design.iter().map(|own| model(&own.at, own.seed)).collect();
    Ok(morris_effects(&design, &results, seed))
}

/// The evaluations of so many base points: for each in turn A, B, A with another seed, and A with the column of each
/// factor from B.
///
/// # Errors
/// No factors or too many, fewer than four points or too many.
pub fn sobol_design(factors: usize, points: u32, seed: u32) -> Result<Vec<Evaluation>, Problem> {
    checked(factors, MOST_FACTORS, points as usize)?;
    if points > MOST_POINTS {
        let (what, found) = ("the number of points".to_owned(), f64::from(points));
        return Err(Problem::Impossible { what, found, expected: "at most 65536" });
    }
    let share = |point: u32, dimension: usize| f64::from(sample(point, dimension as u32, seed));
    let mut design = Vec::with_capacity(points as usize * (factors + 3));
    for point in 0..points {
        let [a, b] = [0, factors].map(|from| (0..factors).map(|k| share(point, from + k)).collect::<Vec<f64>>());
        let own = u64::from(point);
        design.push(Evaluation { at: a.clone(), seed: own });
        design.push(Evaluation { at: b.clone(), seed: own });
        design.push(Evaluation { at: a.clone(), seed: own + (1 << 40) });
        for factor in 0..factors {
            let mut at = a.clone();
            at[factor] = b[factor];
            design.push(Evaluation { at, seed: own });
        }
    }
    Ok(design)
}

/// The results of the model at the points of one base sample.
struct Values {
    a: Vec<f64>,
    b: Vec<f64>,
    /// A with the column of a factor from B.
    mixed: Vec<Vec<f64>>,
    /// A with other seeds.
    again: Vec<f64>,
}

/// First-order and total indices from the results of a design, in its order. A point with a result that is not finite
/// is left out with all its evaluations. `seed` is that of the bootstrap.
///
/// # Errors
/// Fewer than four points, a result that never differs.
pub fn sobol_indices(factors: usize, results: &[f64], seed: u32) -> Result<Sobol, Problem> {
    let mut values = Values { a: Vec::new(), b: Vec::new(), mixed: vec![Vec::new(); factors], again: Vec::new() };
    for own in results.chunks_exact(factors + 3).filter(|own| own.iter().all(|value| value.is_finite())) {
        values.a.push(own[0]);
        values.b.push(own[1]);
        values.again.push(own[2]);
        values.mixed.iter_mut().zip(&own[3..]).for_each(|(mixed, value)| mixed.push(*value));
    }
    let all: Vec<usize> = (0..values.a.len()).collect();
    checked(factors, MOST_FACTORS, all.len())?;
    let variance = variance(&values, &all);
    if !(variance > 0.0 && variance.is_finite()) {
        let consequence = "no factor has a share of it; widen the ranges, or look at another result";
        return Err(Problem::Degenerate { what: "the result is the same at all points".to_owned(), consequence });
    }
    let mut draws = Draws::new(seed.into(), 1);
    let drawn: Vec<Vec<usize>> =
        (0..SAMPLES).map(|_| (0..all.len()).map(|_| draws.below(all.len())).collect()).collect();
    let within = |of: &dyn Fn(&[usize]) -> f64| {
        let mut told: Vec<f64> = drawn.iter().map(|chosen| of(chosen)).collect();
        middle(&mut told)
    };
    let indices = (0..factors).map(|factor| Indices {
        first: first(&values, factor, &all),
        first_within: within(&|chosen| first(&values, factor, chosen)),
        total: total(&values, factor, &all),
        total_within: within(&|chosen| total(&values, factor, chosen)),
    });
    let (noise, noise_within) = (noise(&values, &all), within(&|chosen| noise(&values, chosen)));
    Ok(Sobol { indices: indices.collect(), noise, noise_within })
}

/// First-order and total indices from so many base points; the model is called factors + 3 times for each.
///
/// # Errors
/// No factors or too many, fewer than four points, a result that never differs.
pub fn sobol(model: Model<'_>, factors: usize, points: u32, seed: u32) -> Result<Sobol, Problem> {
    let design = sobol_design(factors, points, seed)?;
    let results: Vec<f64> = design.iter().map(|own| model(&own.at, own.seed)).collect();
    sobol_indices(factors, &results, seed)
}

/// Of the values at both base samples.
fn variance(values: &Values, chosen: &[usize]) -> f64 {
    let all = || chosen.iter().flat_map(|&k| [values.a[k], values.b[k]]);
    let n = 2.0 * chosen.len() as f64;
    let mean = all().sum::<f64>() / n;
    all().map(|value| (value - mean) * (value - mean)).sum::<f64>() / n
}

/// Half the mean square between two seeds, by the variance.
fn noise(values: &Values, chosen: &[usize]) -> f64 {
    let square = |&k: &usize| (values.a[k] - values.again[k]) * (values.a[k] - values.again[k]);
    chosen.iter().map(square).sum::<f64>() / (2.0 * chosen.len() as f64) / variance(values, chosen)
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
