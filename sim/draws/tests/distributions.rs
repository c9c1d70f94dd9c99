//! Draws of a site compared with the closed forms of their distributions, and with samplers written out here.
//!
//! Bounds are at least four standard errors: of a mean and a variance by their formulas, of a χ² with k classes by its
//! variance 2 k, of Kolmogorov's distance by P(√n D > 2.3) < 6·10⁻⁵. Seeds are fixed.

use phytomer_draws::{Aggregation, Clusters, DrawError, Draws, Event, Key};
use phytomer_sim::math::{asin, erf, exp, expm1, lgamma, log, pow};
use rand::Rng;
use std::f64::consts::PI;

const DRAWS: usize = 40_000;

fn key(name: &str) -> Key {
    Key::of_field(1988, 0, Event::named("test", name))
}

fn sample(name: &str, mut draw: impl FnMut(&mut Draws) -> f64) -> Vec<f64> {
    let mut draws = Draws::of(&key(name));
    (0..DRAWS).map(|_| draw(&mut draws)).collect()
}

/// Kolmogorov's distance of a sample from a distribution function is within its bound.
fn follows(name: &str, draw: impl FnMut(&mut Draws) -> f64, function: impl Fn(f64) -> f64) {
    let mut sample = sample(name, draw);
    sample.sort_by(f64::total_cmp);
    let n = DRAWS as f64;
    let distance = sample.iter().enumerate().fold(0.0_f64, |most, (place, &x)| {
        let expected = function(x);
        most.max((expected - place as f64 / n).abs()).max((expected - (place + 1) as f64 / n).abs())
    });
    assert!(distance * n.sqrt() < 2.3, "{name}: {}", distance * n.sqrt());
}

/// The counts of 0, 1, 2 … agree with their probabilities; classes of fewer than 20 are put together.
fn counts_follow(name: &str, counts: &[f64], probability: impl Fn(u32) -> f64) {
    let n = counts.len() as f64;
    let most = counts.iter().fold(0.0_f64, |most, &x| most.max(x)) as u32 + 1;
    let (mut chi2, mut classes, mut seen, mut expected, mut left) = (0.0, 0.0, 0.0, 0.0, n);
    for count in 0..=most {
        seen += counts.iter().filter(|&&x| x == f64::from(count)).count() as f64;
        expected += n * probability(count);
        if expected >= 20.0 && left - expected >= 20.0 {
            chi2 += (seen - expected) * (seen - expected) / expected;
            (classes, left) = (classes + 1.0, left - expected);
            (seen, expected) = (0.0, 0.0);
        }
    }
    chi2 += (seen - left) * (seen - left) / left;
    let bound = classes + 4.0 * f64::sqrt(2.0 * classes) + 4.0;
    assert!(classes >= 1.0 && chi2 < bound, "{name}: χ² {chi2} for {classes} classes");
}

#[test]
fn real_numbers_follow_their_distribution_functions() {
    follows("uniform", |draws| draws.uniform(), |x| x);
    follows("normal", |draws| draws.normal(3.0, 0.5).unwrap(), |x| 0.5 + 0.5 * erf((x - 3.0) / 0.5 / f64::sqrt(2.0)));
    // Beta: the arc sine law and others of shapes up to 1, then of larger shapes in either order.
    follows("arc sine", |draws| draws.beta(0.5, 0.5).unwrap(), |x| 2.0 / PI * asin(x.sqrt()));
    follows("beta 1 3", |draws| draws.beta(1.0, 3.0).unwrap(), |x| 1.0 - pow(1.0 - x, 3.0));
    follows("beta 3 1", |draws| draws.beta(3.0, 1.0).unwrap(), |x| x * x * x);
    follows("beta 2 3", |draws| draws.beta(2.0, 3.0).unwrap(), |x| x * x * (6.0 - 8.0 * x + 3.0 * x * x));
    follows("beta 3 2", |draws| draws.beta(3.0, 2.0).unwrap(), |x| x * x * x * (4.0 - 3.0 * x));
    follows("gamma .5", |draws| draws.gamma(0.5, 2.0).unwrap(), |x| erf((x / 2.0).sqrt()));
    follows("gamma 1", |draws| draws.gamma(1.0, 2.0).unwrap(), |x| -expm1(-x / 2.0));
    follows("gamma 2", |draws| draws.gamma(2.0, 0.5).unwrap(), |x| 1.0 - exp(-2.0 * x) * (1.0 + 2.0 * x));
}

#[test]
fn numbers_of_events_follow_poisson() {
    // The sampler changes its method at a mean of 12.
    for mean in [0.3, 4.0, 11.9, 12.1, 50.0] {
        let counts = sample(&format!("poisson {mean}"), |draws| draws.poisson(mean).unwrap() as f64);
        let probability = |k: u32| exp(f64::from(k) * log(mean) - mean - lgamma(f64::from(k) + 1.0));
        counts_follow(&format!("poisson {mean}"), &counts, probability);
    }
    assert_eq!(Draws::of(&key("none")).poisson(0.0), Ok(0));
}

/// Twenty organs, p = .2, ρ = .1: a = 1.8, b = 7.2, variance 9.28, and .097872 of the plants escape.
#[test]
fn attacks_are_aggregated_among_plants() {
    let aggregation = Aggregation::new(0.2, 0.1).unwrap();
    assert!((aggregation.variance(20) - 9.28).abs() < 1e-12);
    assert!((aggregation.probability(20, 0) - 0.097_872).abs() < 5e-7, "{}", aggregation.probability(20, 0));
    let sum: f64 = (0..=20).map(|k| aggregation.probability(20, k)).sum();
    assert!((sum - 1.0).abs() < 1e-12);
    let plants = 40_000;
    let of_plant = |plant| Draws::of(&Key { plant, season: 3, ..key("borer") });
    let counts: Vec<f64> =
        (0..plants).map(|plant| f64::from(aggregation.attacked(20, &mut of_plant(plant)).unwrap())).collect();
    counts_follow("beta-binomial", &counts, |k| aggregation.probability(20, k));
    let n = f64::from(plants);
    let mean = counts.iter().sum::<f64>() / n;
    let central = |power: i32| counts.iter().map(|k| (0..power).map(|_| k - mean).product::<f64>()).sum::<f64>() / n;
    assert!((mean - 4.0).abs() < 4.0 * f64::sqrt(9.28 / n), "{mean}");
    let error = ((central(4) - central(2) * central(2)) / n).sqrt();
    assert!((central(2) - 9.28).abs() < 4.0 * error, "{} ± {error}", central(2));
}

#[test]
fn the_ends_of_aggregation() {
    let of = |p, rho| Aggregation::new(p, rho).unwrap();
    let mut draws = Draws::of(&key("ends"));
    let mut all = |of: Aggregation| (0..2000).map(|_| of.susceptibility(&mut draws).unwrap()).collect::<Vec<_>>();
    assert!(all(of(0.3, 0.0)).iter().all(|&own| own == 0.3));
    assert!(all(of(0.0, 0.5)).iter().all(|&own| own == 0.0) && all(of(1.0, 0.5)).iter().all(|&own| own == 1.0));
    let whole = all(of(0.3, 1.0));
    assert!(whole.iter().all(|&own| own == 0.0 || own == 1.0));
    let share = whole.iter().sum::<f64>() / 2000.0;
    assert!((share - 0.3).abs() < 4.0 * f64::sqrt(0.21 / 2000.0), "{share}");
    assert!(Aggregation::new(1.2, 0.1).is_err() && Aggregation::new(0.2, f64::NAN).is_err());
}

/// Ripley's K of 400 fields of clusters has the closed form, and is far from that of points at random.
#[test]
fn points_of_clusters_have_the_k_of_a_thomas_process() {
    const FIELDS: u32 = 400;
    let (parents, spread, offspring, side) = (0.05, 1.0, 5.0, 40.0);
    let clusters = Clusters::new(parents, spread).unwrap();
    let radii = [0.5, 1.0, 2.0, 3.0, 4.0];
    let mut of_fields = radii.map(|_| Vec::new());
    let mut number = 0.0;
    for replicate in 0..FIELDS {
        let points = clusters.points(&Key { replicate, ..key("k") }, [[0.0; 2], [side; 2]], offspring).unwrap();
        number += points.len() as f64;
        for (place, &radius) in radii.iter().enumerate() {
            of_fields[place].push(ripley(&points, radius, side, parents * offspring));
        }
    }
    // Var N = λ A (1 + offspring) at most, for a field with all of each cluster.
    let expected = f64::from(FIELDS) * parents * offspring * side * side;
    assert!((number - expected).abs() < 4.0 * (expected * (1.0 + offspring)).sqrt(), "{number} of {expected}");
    for (&radius, found) in radii.iter().zip(&of_fields) {
        let n = f64::from(FIELDS);
        let mean = found.iter().sum::<f64>() / n;
        let error = (found.iter().map(|k| (k - mean) * (k - mean)).sum::<f64>() / (n - 1.0) / n).sqrt();
        let random = PI * radius * radius;
        let closed = random - expm1(-radius * radius / (4.0 * spread * spread)) / parents;
        assert!((mean - closed).abs() < 4.0 * error, "K({radius}) = {mean} ± {error}, expected {closed}");
        assert!((mean - random).abs() > 8.0 * error, "K({radius}) = {mean} ± {error} tells no cluster");
    }
}

/// K by the points that are no nearer to the edge than the radius, with the known intensity: without bias.
fn ripley(points: &[[f64; 2]], radius: f64, side: f64, intensity: f64) -> f64 {
    let inner = |point: &&[f64; 2]| point.iter().all(|x| (radius..side - radius).contains(x));
    let near =
        |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) <= radius * radius;
    let pairs: usize =
        points.iter().filter(inner).map(|a| points.iter().filter(|b| near(a, b)).count().saturating_sub(1)).sum();
    pairs as f64 / (intensity * intensity * (side - 2.0 * radius) * (side - 2.0 * radius))
}

/// The pressure has mean 1 over fields, its variance is that of a shot noise, 1 / (4 π σ² κ), and neighbours share it.
#[test]
fn pressure_is_that_of_the_clusters_around() {
    let (parents, spread) = (0.02, 2.0);
    let clusters = Clusters::new(parents, spread).unwrap();
    let at = |replicate, place| clusters.pressure(&Key { replicate, ..key("pressure") }, place).unwrap();
    let found: Vec<f64> = (0..10_000).map(|replicate| at(replicate, [-3.0, 17.0])).collect();
    let n = found.len() as f64;
    let mean = found.iter().sum::<f64>() / n;
    let central = |power: i32| found.iter().map(|k| (0..power).map(|_| k - mean).product::<f64>()).sum::<f64>() / n;
    let variance = 1.0 / (4.0 * PI * spread * spread * parents);
    assert!((mean - 1.0).abs() < 4.0 * (variance / n).sqrt(), "{mean}");
    let error = ((central(4) - central(2) * central(2)) / n).sqrt();
    assert!((central(2) - variance).abs() < 4.0 * error, "{} ± {error}, expected {variance}", central(2));
    // Continuous across the borders of cells, and 1 where there are no places.
    for replicate in 0..50 {
        let (before, after) = (at(replicate, [10.0 - 1e-9, 20.0 - 1e-9]), at(replicate, [10.0, 20.0]));
        assert!((before - after).abs() < 1e-5, "{before} {after}");
    }
    assert_eq!(clusters.pressure(&key("far"), [f64::NAN, 0.0]), Ok(1.0));
    assert!(matches!(Clusters::new(1e3, 10.0), Err(DrawError::Crowded { .. })));
    assert!(Clusters::new(0.0, 1.0).is_err() && Clusters::new(1.0, f64::INFINITY).is_err());
}

/// Two hundred blocks differ by their standard deviation; a value is kept within its range.
#[test]
fn blocks_shift_what_the_site_gives() {
    let shift = |plot, sd, range| {
        let key = Key { plot, ..key("nitrogen") };
        Draws::of(&key).shifted(60.0, sd, range).unwrap()
    };
    let blocks: Vec<f64> = (0..2000).map(|plot| shift(plot, 10.0, [0.0, f64::MAX])).collect();
    let mean = blocks.iter().sum::<f64>() / 2000.0;
    let variance = blocks.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 1999.0;
    assert!((mean - 60.0).abs() < 4.0 * 10.0 / f64::sqrt(2000.0), "{mean}");
    assert!((variance - 100.0).abs() < 4.0 * 100.0 * f64::sqrt(2.0 / 1999.0), "{variance}");
    assert!((0..50).all(|plot| shift(plot, 0.0, [0.0, 100.0]) == 60.0));
    assert!((0..2000).map(|plot| shift(plot, 100.0, [0.0, 100.0])).all(|x| (0.0..=100.0).contains(&x)));
}

/// The sampler of Beta for shapes above 1 (R. C. H. Cheng 1978, *Communications of the ACM* 21: 317–322, algorithm BB)
/// and of a small Poisson mean (Knuth), written out with the functions of `sim::math`: the same bits from the same
/// words. With the system's functions `rand_distr` would draw other bits wherever they differ in their last.
#[test]
fn draws_are_those_of_samplers_over_math() {
    let mut words = key("by hand").generator();
    let mut open = || ((words.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64;
    let (a, b) = (1.8, 7.2);
    let sum: f64 = a + b;
    let beta = ((sum - 2.0) / (2.0 * a * b - sum)).sqrt();
    let gamma = a + 1.0 / beta;
    let mut by_hand = || loop {
        let (u1, u2): (f64, f64) = (open(), open());
        let v = beta * log(u1 / (1.0 - u1));
        let w = a * exp(v);
        let (z, r) = (u1 * u1 * u2, gamma * v - log(4.0));
        let s = a + r - w;
        let t = log(z);
        if s + 1.0 + log(5.0) >= 5.0 * z || s >= t || r + sum * log(sum / (b + w)) >= t {
            return w / (b + w);
        }
    };
    let mut draws = Draws::of(&key("by hand"));
    assert!((0..20_000).all(|_| draws.beta(a, b).unwrap().to_bits() == by_hand().to_bits()));

    let mut words = key("knuth").generator();
    let mut uniform = || (words.next_u64() >> 11) as f64 * (0.5 / (1_u64 << 52) as f64);
    let mut draws = Draws::of(&key("knuth"));
    let (mean, bound) = (7.5, exp(-7.5));
    for _ in 0..20_000 {
        let (mut events, mut product) = (0, uniform());
        while product > bound {
            (events, product) = (events + 1, product * uniform());
        }
        assert_eq!(draws.poisson(mean), Ok(events));
    }
}

/// At the ends of the ranges of parameters draws end and are numbers; beyond them they are refused.
#[test]
fn every_parameter_within_its_range_can_be_drawn() {
    let mut draws = Draws::of(&key("range"));
    for a in [1e-3, 0.9, 1.0, 1.1, 1e9] {
        for b in [1e-3, 0.9, 1.0, 1.1, 1e9] {
            assert!((0..200).all(|_| (0.0..=1.0).contains(&draws.beta(a, b).unwrap())), "{a} {b}");
        }
        for scale in [1e-12, 1.0, 1e12] {
            assert!((0..200).all(|_| draws.gamma(a, scale).unwrap() >= 0.0), "{a} {scale}");
        }
    }
    for mean in [1e-300, 1e-9, 12.0, 1e6, 1e9] {
        let most = mean + 10.0 * f64::sqrt(mean) + 10.0;
        assert!((0..200).all(|_| (draws.poisson(mean).unwrap() as f64) < most), "{mean}");
    }
    let refused = [0.0, -1.0, 1e-4, 1e10, f64::NAN, f64::INFINITY];
    assert!(refused.iter().all(|&shape| draws.beta(shape, 1.0).is_err() && draws.gamma(shape, 1.0).is_err()));
    assert!([-1.0, 1e10, f64::NAN].iter().all(|&mean| draws.poisson(mean).is_err()));
    assert!(draws.normal(0.0, -1.0).is_err() && draws.normal(f64::NAN, 1.0).is_err());
    let told = draws.beta(0.0, 1.0).unwrap_err().to_string();
    assert_eq!(told, "the first shape is 0, and must be from 0.001 to 1000000000");
}
