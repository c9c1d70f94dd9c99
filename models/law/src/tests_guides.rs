//! Tests of the guides of counts: the guided search of each word beside the plain search among all thresholds.
//!
//! The thresholds are read back from the probabilities of a table, which are whole multiples of 2⁻³² and sum without
//! rounding. Words are those around each threshold, around each bound of the guide, and a fixed sequence over the whole
//! range.

use super::tests::{domain, root};
use super::*;

/// The bounds of the guides: the words that begin with the same six bits.
const GROUP: u32 = 1 << 26;

fn table(given: &str) -> CountTable {
    let given: Count = serde_json::from_str(given).expect("reads");
    given.compile(&domain(), &root()).expect("compiles")
}

/// The thresholds at a point, with the smallest count, from the probabilities of 0, 1, 2 ….
fn thresholds(table: &CountTable, at: At) -> (u32, Vec<u64>) {
    let pmf = table.pmf(at);
    let first = pmf.iter().take_while(|p| **p == 0.0).count();
    let sum = |sum: &mut f64, p: &f64| {
        *sum += p;
        Some((*sum * 4_294_967_296.0) as u64)
    };
    let mut found: Vec<u64> = pmf[first..].iter().scan(0.0, sum).collect();
    assert_eq!(found.pop(), Some(1 << 32), "the probabilities sum to 1");
    (first as u32, found)
}

/// Words around each threshold and each bound of the guide, and many others.
fn words(thresholds: &[u64]) -> impl Iterator<Item = u32> {
    let bounds = (0..=64_u64).map(|group| group * u64::from(GROUP));
    let around: Vec<u32> = thresholds
        .iter()
        .copied()
        .chain(bounds)
        .flat_map(|word| [word.wrapping_sub(1), word, word + 1].map(|word| word.min(u64::from(u32::MAX)) as u32))
        .collect();
    around.into_iter().chain((0..20_000_u32).map(|nth| nth.wrapping_mul(2_654_435_769)))
}

/// Compares every way to draw a count with the plain search, at one point. Returns the number of thresholds.
fn compare(table: &CountTable, at: At, what: &str) -> usize {
    let (first, thresholds) = thresholds(table, at);
    let words: Vec<u32> = words(&thresholds).collect();
    let mut many = vec![u32::MAX; words.len()];
    table.sample_many(table.distribution(&at), words.iter().copied().zip(&mut many));
    for (&word, together) in words.iter().zip(many) {
        let expected = first + thresholds.iter().filter(|threshold| **threshold <= u64::from(word)).count() as u32;
        let drawn = [table.sample(word, at), table.sample_at(word, &at), table.at_point(&at).draw(word), together];
        assert_eq!(drawn, [expected; 4], "{what}: the word {word} at {at:?}");
    }
    thresholds.len()
}

#[test]
fn a_guided_count_is_that_of_the_plain_search() {
    let shapes = [
        ("7", 0),
        (r#"{ "binomial": { "n": 1, "p": 0.5 } }"#, 1),
        (r#"{ "binomial": { "n": 12, "p": 0.5 }, "shift": 4 }"#, 12),
        (r#"{ "binomial": { "n": 40, "p": 0.999 } }"#, 5),
        (r#"{ "poisson": { "mean": 0.001 } }"#, 2),
        (r#"{ "poisson": { "mean": 90 } }"#, 80),
        (r#"{ "negative_binomial": { "r": 0.4, "p": 0.01 }, "shift": 3 }"#, 500),
        (r#"{ "empirical": [0, 0, 1, 0, 0, 1, 0, 1e-12, 1] }"#, 3),
        (r#"{ "empirical": [1, 1e-9, 1e-9, 1] }"#, 3),
        (
            r#"{ "mixture": [
                { "weight": 0.046, "poisson": { "mean": 8.5 } },
                { "weight": 1, "negative_binomial": { "r": 21, "p": 0.4 } }
            ] }"#,
            40,
        ),
    ];
    for (given, least) in shapes {
        let found = compare(&table(given), At::default(), given);
        assert!(found >= least, "{given} has {found} thresholds");
    }
}

/// As many distributions as are guided, one more, and the largest count that a table holds.
#[test]
fn tables_with_and_without_guides_draw_alike() {
    for ages in [63, 64, 65, 66, 120] {
        let law = format!(r#"{{ "binomial": {{ "n": {{ "expression": "min(age, {ages})" }}, "p": 0.37 }} }}"#);
        let given: Count = serde_json::from_str(&law).expect("reads");
        let domain = Domain { until: 130, ..domain() };
        let table = given.compile(&domain, &root()).expect("compiles");
        for age in [1, 2, 31, ages - 1, ages, ages + 1, 130, 999] {
            compare(&table, At { age, ..At::default() }, &law);
        }
    }
    let most = format!(r#"{{ "empirical": [{}1] }}"#, "1,".repeat(65_535));
    let table = table(&most);
    let (first, thresholds) = thresholds(&table, At::default());
    assert_eq!((table.max(), first, thresholds.len()), (65_535, 0, 65_535));
    for word in (0..=64_u32).flat_map(|group| {
        let bound = (u64::from(group) * u64::from(GROUP)).min(u64::from(u32::MAX)) as u32;
        [bound.saturating_sub(1), bound, bound.saturating_add(1)]
    }) {
        let expected = thresholds.partition_point(|threshold| *threshold <= u64::from(word)) as u32;
        assert_eq!(table.sample(word, At::default()), expected, "the word {word}");
    }
}
