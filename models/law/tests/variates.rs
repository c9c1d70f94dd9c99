//! Every distribution that a file may state, compared with the same distribution of `rand_distr`: an independent
//! implementation of each name, parametrisation and table.
//!
//! This crate draws by inverse transform from the words of a plant's stream, `rand_distr` by its own methods from a
//! generator of its own; the seeds are fixed. Counts are compared by Pearson's χ² test of homogeneity, real numbers by
//! the two-sample test of Kolmogorov and Smirnov and, for spread and tails, by χ² over cells that are cut at ranks of
//! both samples together. A test fails where its statistic lies in the upper tail that a normal variable has beyond 4
//! standard errors. Absent: closed forms of moments, which the unit tests of `law` have.

use std::fmt::Debug;

use phytomer_law::{At, Count, Domain, Speeds, ValueRange, Variate};
use phytomer_sim::math;
use phytomer_sim::plant::key::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng as _;
use rand_distr::weighted::WeightedIndex;
use rand_distr::{Binomial, Distribution, Gamma, Geometric, LogNormal, Normal, Poisson, Uniform};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

#[allow(dead_code, reason = "the measured counts of `tests/fitted` ask for more")]
#[path = "../../../tests/fitted/chi2.rs"]
mod chi2;

/// Draws in each of the two samples.
const DRAWS: usize = 1 << 18;
/// The probability that a normal variable exceeds its mean by more than 4 standard errors (Abramowitz & Stegun 1964,
/// table 26.1).
const LEVEL: f64 = 3.167_124e-5;
/// Tails of both samples together are cut at shares of 2⁻² to 2⁻¹³, where 32 draws of each sample are expected.
const CUTS: std::ops::RangeInclusive<u32> = 2..=13;

/// The point at which laws are evaluated.
const HERE: At = At {
    age: 7,
    dimension: 5,
    cycle: 4,
    rank: 3,
    bud_birth: 6,
    bud_dimension: 4,
    unit: 4,
    height: 0,
    contact: 0,
    shade: 0,
    state: 0,
};
const ANY: ValueRange = ValueRange { min: f64::NEG_INFINITY, max: f64::INFINITY, what: "a number" };

/// A distribution of `rand_distr`, as a function of its generator.
type Drawn<T> = Box<dyn Fn(&mut ChaCha8Rng) -> T>;

fn domain() -> Domain {
    Domain { order: 1, until: 40, max_cycle: 40, max_unit: 40, max_rank: 9, ..Domain::default() }
}

fn read<T: DeserializeOwned>(given: &Value) -> T {
    serde_json::from_value(given.clone()).unwrap_or_else(|error| panic!("{given}: {error}"))
}

fn compiled<T>(given: &Value, table: Result<T, impl Debug>) -> T {
    table.unwrap_or_else(|faults| panic!("{given}: {faults:?}"))
}

/// A seed for each distribution, from its text in a file (FNV-1a), so that no two tests draw the same words.
fn seed(given: &Value) -> u64 {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    given.to_string().bytes().fold(0xcbf2_9ce4_8422_2325, step)
}

/// A stream of words as a plant has it.
fn words(given: &Value) -> Stream {
    PlantRandom::new(seed(given), 7).stream(LineageKey(3), Purpose::Node)
}

/// The same number of draws of `rand_distr`.
fn sample<T>(given: &Value, draw: impl Fn(&mut ChaCha8Rng) -> T) -> Vec<T> {
    let mut random = ChaCha8Rng::seed_from_u64(!seed(given));
    (0..DRAWS).map(|_| draw(&mut random)).collect()
}

fn our_counts(given: &Value) -> Vec<u32> {
    let table = compiled(given, read::<Count>(given).compile(&domain(), &Default::default()));
    let mut words = words(given);
    (0..DRAWS).map(|_| table.sample(words.word(), HERE)).collect()
}

fn our_numbers(given: &Value) -> Vec<f64> {
    let table = compiled(given, read::<Variate>(given).compile(&domain(), &Default::default(), ANY));
    let mut words = words(given);
    (0..DRAWS).map(|_| table.draw_f64(words.word(), HERE)).collect()
}

/// How often each count from 0 occurs.
fn frequencies(counts: &[u32]) -> Vec<f64> {
    let mut frequencies = vec![0.0; counts.iter().max().map_or(0, |most| *most as usize + 1)];
    counts.iter().for_each(|count| frequencies[*count as usize] += 1.0);
    frequencies
}

/// The probability of a χ² at least so large by chance; 1 where both samples hold a single number, which leaves no
/// degree of freedom.
fn chance_of_counts(ours: &[u32], theirs: &[u32]) -> f64 {
    match ours.iter().chain(theirs).all(|count| *count == ours[0]) {
        true => 1.0,
        false => chi2::homogeneity(&frequencies(ours), &frequencies(theirs), 0).p,
    }
}

/// The probability of a greatest distance between two empirical distribution functions so large by chance: Q(λ) = 2 Σ
/// (−1)ᵏ⁻¹ exp(−2 k² λ²), λ = D √(n m / (n + m)), k from 1 (Smirnov 1948, *Annals of Mathematical Statistics* 19).
/// Where values are equal the distance is taken after the last of them, which makes the test milder and never stricter.
fn chance_of_distance(ours: &[f64], theirs: &[f64]) -> f64 {
    let (mut i, mut j, mut distance) = (0, 0, 0.0_f64);
    while i < ours.len() && j < theirs.len() {
        let value = ours[i].min(theirs[j]);
        i += ours[i..].iter().take_while(|other| **other <= value).count();
        j += theirs[j..].iter().take_while(|other| **other <= value).count();
        distance = distance.max((i as f64 / ours.len() as f64 - j as f64 / theirs.len() as f64).abs());
    }
    let (n, m) = (ours.len() as f64, theirs.len() as f64);
    let lambda = distance * (n * m / (n + m)).sqrt();
    if lambda < 0.2 {
        // The series converges slowly there, and its sum is 1 to all digits.
        return 1.0;
    }
    let term = |k: i32| f64::from(1 - 2 * ((k + 1) % 2)) * math::exp(-2.0 * f64::from(k * k) * lambda * lambda);
    2.0 * (1..=100).map(term).sum::<f64>()
}

/// The smaller of two probabilities, of the distance and of χ² over cells. Both samples are sorted.
fn chance_of_numbers(ours: &[f64], theirs: &[f64]) -> f64 {
    let mut all = [ours, theirs].concat();
    all.sort_by(f64::total_cmp);
    let mut edges: Vec<f64> =
        CUTS.flat_map(|k| [all.len() >> k, all.len() - (all.len() >> k)]).map(|i| all[i]).collect();
    edges.push(all[all.len() / 2]);
    edges.sort_by(f64::total_cmp);
    let cell = |value: &f64| edges.partition_point(|edge| edge <= value) as u32;
    let cells = |values: &[f64]| values.iter().map(cell).collect::<Vec<_>>();
    chance_of_distance(ours, theirs).min(chance_of_counts(&cells(ours), &cells(theirs)))
}

fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values
}

fn binomial(n: u64, p: f64) -> Drawn<u32> {
    let binomial = Binomial::new(n, p).expect("parameters");
    Box::new(move |random| binomial.sample(random) as u32)
}

fn poisson(mean: f64) -> Drawn<u32> {
    let poisson = Poisson::new(mean).expect("parameters");
    Box::new(move |random| poisson.sample(random) as u32)
}

/// A Poisson variable whose mean is drawn from a gamma distribution of shape r and scale (1 − p) / p (Greenwood & Yule
/// 1920, *Journal of the Royal Statistical Society* 83): failures before the r-th success of probability p.
fn negative_binomial(r: f64, p: f64) -> Drawn<u32> {
    let gamma = Gamma::new(r, (1.0 - p) / p).expect("parameters");
    Box::new(move |random| {
        let mean: f64 = gamma.sample(random);
        if mean > 0.0 { Poisson::new(mean).expect("a mean").sample(random) as u32 } else { 0 }
    })
}

fn weighted(weights: &[f64]) -> Drawn<u32> {
    let index = WeightedIndex::new(weights).expect("weights");
    Box::new(move |random| index.sample(random) as u32)
}

/// A mixture: draws which of several distributions the count is drawn from.
fn mixture(parts: Vec<(f64, Drawn<u32>)>) -> Drawn<u32> {
    let which = weighted(&parts.iter().map(|part| part.0).collect::<Vec<_>>());
    Box::new(move |random| parts[which(random) as usize].1(random))
}

fn shifted(by: u32, draw: Drawn<u32>) -> Drawn<u32> {
    Box::new(move |random| by + draw(random))
}

fn normal(mean: f64, sd: f64) -> Drawn<f64> {
    let normal = Normal::new(mean, sd).expect("parameters");
    Box::new(move |random| normal.sample(random))
}

fn uniform(min: f64, max: f64) -> Drawn<f64> {
    let uniform = Uniform::new_inclusive(min, max).expect("parameters");
    Box::new(move |random| uniform.sample(random))
}

fn lognormal(mean: f64, sd: f64) -> Drawn<f64> {
    let lognormal = LogNormal::from_mean_cv(mean, sd / mean).expect("parameters");
    Box::new(move |random| lognormal.sample(random))
}

fn one_of(values: &'static [f64]) -> Drawn<f64> {
    let place = Uniform::new(0, values.len()).expect("values");
    Box::new(move |random| values[place.sample(random)])
}

fn clamped(low: f64, high: f64, draw: Drawn<f64>) -> Drawn<f64> {
    Box::new(move |random| draw(random).clamp(low, high))
}

#[track_caller]
fn assert_counts(given: Value, theirs: Drawn<u32>) {
    let chance = chance_of_counts(&our_counts(&given), &sample(&given, theirs));
    println!("{given}: {chance:.3}");
    assert!(chance >= LEVEL, "{given}: such a difference has the probability {chance:e}");
}

#[track_caller]
fn assert_numbers(given: Value, theirs: Drawn<f64>) {
    let chance = chance_of_numbers(&sorted(our_numbers(&given)), &sorted(sample(&given, theirs)));
    println!("{given}: {chance:.3}");
    assert!(chance >= LEVEL, "{given}: such a difference has the probability {chance:e}");
}

#[test]
fn binomial_counts() {
    for (n, p) in [
        (0, 0.3),
        (1, 0.25),
        (7, 0.0),
        (7, 0.63),
        (7, 1.0),
        (12, 0.74),
        (40, 0.999),
        (300, 0.5),
        (65_535, 1e-5),
        (65_535, 0.01),
        (65_535, 0.5),
    ] {
        assert_counts(json!({ "binomial": { "n": n, "p": p } }), binomial(n, p));
    }
    let given = json!({ "binomial": { "n": { "expression": "2 * rank" }, "p": { "expression": "age / 40" } } });
    assert_counts(given, binomial(6, 0.175));
}

#[test]
fn poisson_counts() {
    // The method of rand_distr changes at a mean of 12.
    for mean in [1e-3, 0.2, 2.5, 11.9, 12.1, 150.0, 6000.0, 60_000.0] {
        assert_counts(json!({ "poisson": { "mean": mean } }), poisson(mean));
    }
    assert_counts(
        json!({ "poisson": { "mean": { "expression": "dimension / 2" } }, "shift": 4 }),
        shifted(4, poisson(2.5)),
    );
}

#[test]
fn negative_binomial_counts() {
    for (r, p) in [(0.05, 0.02), (0.3, 0.2), (1.0, 0.5), (8.18, 0.275), (12.0, 0.292), (200.0, 0.9), (3.0, 0.005)] {
        assert_counts(json!({ "negative_binomial": { "r": r, "p": p } }), negative_binomial(r, p));
    }
    for p in [0.002, 0.3, 0.95] {
        let geometric = Geometric::new(p).expect("a probability");
        let theirs: Drawn<u32> = Box::new(move |random| geometric.sample(random) as u32);
        assert_counts(json!({ "negative_binomial": { "r": 1, "p": p } }), theirs);
    }
}

#[test]
fn observed_counts_mixtures_and_speeds() {
    for weights in [vec![1.0], vec![0.0, 0.0, 3.0], vec![1.0, 0.0, 2.0, 1.0], vec![1e-4, 12.0, 0.5], vec![1.0; 50]] {
        assert_counts(json!({ "empirical": weights }), weighted(&weights));
    }
    let given = json!({ "mixture": [
        { "weight": 3, "constant": 2 },
        { "weight": 1, "poisson": { "mean": 4 }, "shift": 1 },
        { "weight": 0.5, "binomial": { "n": 9, "p": 0.8 } },
        { "weight": 0.01, "negative_binomial": { "r": 2, "p": 0.05 } },
        { "weight": 0, "empirical": [1, 1] } ], "shift": 2 });
    let two: Drawn<u32> = Box::new(|_| 2);
    let parts = vec![
        (3.0, two),
        (1.0, shifted(1, poisson(4.0))),
        (0.5, binomial(9, 0.8)),
        (0.01, negative_binomial(2.0, 0.05)),
    ];
    assert_counts(given, shifted(2, mixture(parts)));
    // Of the speeds 1/2, 2/3 and 3, whose weights are 1, 2 and 5 + 0.25, each axis draws one.
    let given = json!({ "empirical": ["1/2", "2/3", 3, "6/2"], "weights": [1, 2, 5, 0.25] });
    let (speeds, place) = compiled(&given, read::<Speeds>(&given).compile(&Default::default())).into_parts();
    assert_eq!(speeds.iter().map(|speed| speed.ratio()).collect::<Vec<_>>(), [0.5, 2.0 / 3.0, 3.0]);
    let mut words = words(&given);
    let ours: Vec<u32> = (0..DRAWS).map(|_| place.sample(words.word(), At::default())).collect();
    let chance = chance_of_counts(&ours, &sample(&given, weighted(&[1.0, 2.0, 5.25])));
    assert!(chance >= LEVEL, "{given}: such a difference has the probability {chance:e}");
}

#[test]
fn normal_numbers() {
    for (mean, sd) in [(0.0, 1.0), (55.0, 5.0), (-3.0, 1e-4), (1e6, 1e-3), (4.0, 0.0), (0.0, 1e30)] {
        assert_numbers(json!({ "normal": { "mean": mean, "sd": sd } }), normal(mean, sd));
    }
    let given = json!({ "normal": { "mean": { "expression": "10 * rank" }, "sd": { "expression": "age" } } });
    assert_numbers(given, normal(30.0, 7.0));
    for (low, high) in [(-0.5, 2.0), (1.0, 1.5), (-9.0, 3.0), (4.0, 9.0)] {
        let given = json!({ "normal": { "mean": 0, "sd": 1 }, "min": low, "max": high });
        assert_numbers(given, clamped(low, high, normal(0.0, 1.0)));
    }
}

#[test]
fn uniform_numbers() {
    for (min, max) in [(0.0, 1.0), (-2.0, 6.0), (3.0, 3.0), (-1e30, 1e30), (100.0, 100.001)] {
        assert_numbers(json!({ "uniform": { "min": min, "max": max } }), uniform(min, max));
    }
    let given = json!({ "uniform": { "min": 0, "max": { "expression": "dimension" } }, "min": 1, "max": 3.5 });
    assert_numbers(given, clamped(1.0, 3.5, uniform(0.0, 5.0)));
}

#[test]
fn lognormal_numbers() {
    for (mean, sd) in [(12.0, 3.0), (1.0, 0.01), (1.0, 10.0), (1e-6, 1e-6), (1e9, 5e9), (2.0, 0.0)] {
        assert_numbers(json!({ "lognormal": { "mean": mean, "sd": sd } }), lognormal(mean, sd));
    }
    let given = json!({ "lognormal": { "mean": 2, "sd": { "expression": "rank - 1" } }, "min": 0.5, "max": 3 });
    assert_numbers(given, clamped(0.5, 3.0, lognormal(2.0, 2.0)));
}

#[test]
fn observed_numbers() {
    const SETS: [&[f64]; 4] = [&[7.5], &[1.0, 2.0, 6.0], &[3.0, -1.0, 8.0, 8.0, 8.0], &[0.1; 3]];
    for values in SETS {
        assert_numbers(json!({ "empirical": values }), one_of(values));
    }
    assert_numbers(json!({ "empirical": SETS[2], "min": 0 }), clamped(0.0, 9.0, one_of(SETS[2])));
}

/// The tests see parameters that are wrong by a few hundredths, and parametrisations that are mistaken for one another.
#[test]
fn parameters_a_little_wrong_are_seen() {
    let counts = [
        (json!({ "binomial": { "n": 7, "p": 0.63 } }), binomial(7, 0.635)),
        (json!({ "binomial": { "n": 65_535, "p": 0.5 } }), binomial(65_535, 0.5001)),
        (json!({ "poisson": { "mean": 2.5 } }), poisson(2.53)),
        (json!({ "poisson": { "mean": 60_000 } }), poisson(60_030.0)),
        // Its mean as its variance: r successes counted instead of failures, or p for 1 − p.
        (json!({ "negative_binomial": { "r": 8.18, "p": 0.275 } }), negative_binomial(8.18, 0.28)),
        (json!({ "negative_binomial": { "r": 1, "p": 0.5 } }), shifted(1, negative_binomial(1.0, 0.5))),
        (json!({ "empirical": [1, 0, 2, 1] }), weighted(&[1.0, 0.0, 2.1, 1.0])),
        (
            json!({ "mixture": [{ "weight": 3, "constant": 2 }, { "weight": 1, "constant": 4 }] }),
            weighted(&[0.0, 0.0, 3.1, 0.0, 1.0]),
        ),
    ];
    for (given, theirs) in counts {
        let chance = chance_of_counts(&our_counts(&given), &sample(&given, theirs));
        assert!(chance < LEVEL, "{given}: not seen, {chance:e}");
    }
    let numbers = [
        (json!({ "normal": { "mean": 55, "sd": 5 } }), normal(55.08, 5.0)),
        (json!({ "normal": { "mean": 55, "sd": 5 } }), normal(55.0, 5.1)),
        (json!({ "uniform": { "min": 0, "max": 1 } }), uniform(0.0, 1.002)),
        (json!({ "lognormal": { "mean": 12, "sd": 3 } }), lognormal(12.0, 3.06)),
        // The parameters of the logarithm.
        (json!({ "lognormal": { "mean": 1, "sd": 1 } }), {
            let log = LogNormal::new(0.0, 1.0).expect("parameters");
            Box::new(move |random: &mut ChaCha8Rng| log.sample(random)) as Drawn<f64>
        }),
        // The logarithm's mean is ln m − σ²/2, not ln m.
        (json!({ "lognormal": { "mean": 1, "sd": 0.2 } }), lognormal(1.01, 0.2)),
        (json!({ "empirical": [1, 2, 6] }), one_of(&[1.0, 2.0, 6.0, 6.0])),
        (json!({ "normal": { "mean": 0, "sd": 1 }, "min": -0.5 }), clamped(-0.49, 9.0, normal(0.0, 1.0))),
    ];
    for (given, theirs) in numbers {
        let chance = chance_of_numbers(&sorted(our_numbers(&given)), &sorted(sample(&given, theirs)));
        assert!(chance < LEVEL, "{given}: not seen, {chance:e}");
    }
}

/// The 4 standard errors, and points of Smirnov's table (1948): 1 − L(0.83) = 0.4962, 1 − L(1.36) = 0.0495 and
/// 1 − L(1.63) = 0.0098.
#[test]
fn probabilities_are_those_of_the_tables() {
    assert!((0.5 * chi2::tail(16.0, 1) / LEVEL - 1.0).abs() < 1e-6, "{}", 0.5 * chi2::tail(16.0, 1));
    // Of two samples of 20,000, λ is a hundred times the distance, and a shift by r ranks is a distance of r / 20,000.
    let ours: Vec<f64> = (0..20_000).map(f64::from).collect();
    for (ranks, chance) in [(166.0, 0.4962), (272.0, 0.0495), (326.0, 0.0098)] {
        let theirs: Vec<f64> = ours.iter().map(|value| value + ranks - 0.5).collect();
        let found = chance_of_distance(&ours, &theirs);
        assert!((found - chance).abs() < 6e-5, "{ranks}: {found}");
    }
}
