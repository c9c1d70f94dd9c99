//! Tests of counts and variates: probabilities, means and variances against closed forms; draws; faults; schemas.
//!
//! Draws are counted over a fixed sequence of words. Absent: other implementations of the distributions
//! (`tests/variates.rs`).

use phytomer_sim::math;
use schemars::{json_schema, schema_for};
use serde::Deserialize;

use super::tests::{domain, random, read, root};
use super::*;
use crate::fault::Fault;

const ANY: ValueRange = ValueRange { min: f64::NEG_INFINITY, max: f64::INFINITY, what: "a number" };
const HERE: At = At {
    age: 10,
    dimension: 5,
    cycle: 4,
    rank: 3,
    bud_birth: 9,
    bud_dimension: 4,
    unit: 4,
    height: 0,
    contact: 0,
    shade: 0,
    state: 1,
};

fn count(given: Result<Count, impl std::fmt::Debug>) -> CountTable {
    given.expect("reads").compile(&domain(), &root()).expect("compiles")
}

fn count_faults(given: Result<Count, impl std::fmt::Debug>) -> Vec<String> {
    given.expect("reads").compile(&domain(), &root()).expect_err("has faults").iter().map(Fault::to_string).collect()
}

fn variate(given: Result<Variate, impl std::fmt::Debug>) -> VariateTable {
    given.expect("reads").compile(&domain(), &root(), ANY).expect("compiles")
}

fn variate_faults(given: Result<Variate, impl std::fmt::Debug>) -> Vec<String> {
    let table = given.expect("reads").compile(&domain(), &root(), ANY);
    table.expect_err("has faults").iter().map(Fault::to_string).collect()
}

fn close(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within * expected.abs().max(1.0), "{found} for {expected}");
}

/// Mean and variance as stated and as drawn, against the formula; the thresholds' sum and order.
fn check(table: &CountTable, mean: f64, variance: f64) {
    close(table.mean(HERE), mean, 1e-6);
    close(table.variance(HERE), variance, 1e-6);
    let pmf = table.pmf(HERE);
    close(pmf.iter().sum(), 1.0, 1e-12);
    assert!(pmf.iter().all(|p| *p >= 0.0));
    assert_eq!(pmf.len() as u32, table.max() + 1);
    let drawn: f64 = pmf.iter().zip(0..).map(|(p, k)| p * f64::from(k)).sum();
    close(drawn, mean, 1e-6);
    let words = (0..1000_u32).map(|i| i * 4_294_967).chain([u32::MAX]);
    let counts: Vec<u32> = words.map(|word| table.sample(word, HERE)).collect();
    assert!(counts.is_sorted() && counts[1000] == table.max());
}

#[test]
fn counts_have_their_closed_forms() {
    check(&count(read!(Count, { "binomial": { "n": 7, "p": 0.63 } })), 4.41, 1.6317);
    check(&count(read!(Count, { "binomial": { "n": 65535, "p": 0.5 } })), 32767.5, 16383.75);
    check(&count(read!(Count, { "binomial": { "n": 12, "p": 0.74 }, "shift": 3 })), 11.88, 2.3088);
    check(&count(read!(Count, { "binomial": { "n": 5, "p": 1 } })), 5.0, 0.0);
    check(&count(read!(Count, { "poisson": { "mean": 2.5 } })), 2.5, 2.5);
    check(&count(read!(Count, { "poisson": { "mean": 1000 } })), 1000.0, 1000.0);
    check(&count(read!(Count, { "poisson": { "mean": 0 } })), 0.0, 0.0);
    check(&count(read!(Count, { "negative_binomial": { "r": 0.3, "p": 0.2 } })), 1.2, 6.0);
    check(&count(read!(Count, { "empirical": [1, 0, 2, 1] })), 1.75, 1.1875);
    let mixed =
        read!(Count, { "mixture": [{ "weight": 3, "constant": 2 }, { "weight": 1, "poisson": { "mean": 4 } }] });
    check(&count(mixed), 2.5, 1.75);
}

#[test]
fn the_negative_binomial_is_that_of_stat_tool() {
    // Poplar, nodes per growth unit of orders 2 to 4: observed means 29.13, 21.56, 13.81 (Caraglio & Rey).
    for (r, p, mean) in [(12.0, 0.292, 29.13), (8.18, 0.275, 21.56), (8.04, 0.368, 13.81)] {
        let table = count(read!(Count, { "negative_binomial": { "r": r, "p": p } }));
        check(&table, r * (1.0 - p) / p, r * (1.0 - p) / (p * p));
        close(table.mean(HERE), mean, 0.002);
        close(table.pmf(HERE)[0], math::pow(p, r), 1e-9);
    }
}

#[test]
fn a_word_draws_by_inverse_transform() {
    let table = count(read!(Count, { "binomial": { "n": 1, "p": 0.25 } }));
    let at_edge = [0, 3_221_225_471, 3_221_225_472, u32::MAX].map(|word| table.sample(word, HERE));
    assert_eq!(at_edge, [0, 0, 1, 1]);
    assert_eq!(count(read!(Count, 3)).constant(), Some(3));
    assert_eq!(count(read!(Count, { "empirical": [0, 0, 1, 0] })).constant(), Some(2));
    let by_rank = count(read!(Count, { "constant": { "step": { "over": "rank", "at": 4, "before": 1, "after": 2 } } }));
    assert_eq!((by_rank.sample(7, HERE), by_rank.sample(7, At { rank: 9, ..HERE }), by_rank.constant()), (1, 2, None));
    assert_eq!((by_rank.min(), by_rank.max()), (1, 2));
    let changing = count(read!(Count, { "poisson": { "mean": { "expression": "dimension / 2" } }, "shift": 1 }));
    close(changing.mean(HERE), 3.5, 1e-9);
    close(changing.mean(At { dimension: 20, ..HERE }), 11.0, 1e-9);
}

#[test]
fn faults_of_counts_are_told() {
    assert_eq!(
        count_faults(read!(Count, { "constant": 2.5 }))[0],
        "law.constant: the value is 2.5; expected a whole number in [0, 65535]"
    );
    let p = count_faults(read!(Count, { "binomial": { "n": 3, "p": { "expression": "age / 40" } } }));
    assert_eq!(p, ["law.binomial.p: the law is 1.025 at age 41; expected a probability in [0, 1]"]);
    let rare = count_faults(read!(Count, { "negative_binomial": { "r": 1, "p": 1e-4 } }));
    assert_eq!(rare, ["law.negative_binomial: the counts are too large; expected counts of at most 65535"]);
    let none = count_faults(read!(Count, { "negative_binomial": { "r": 0, "p": 0 } }));
    assert_eq!(
        none,
        [
            "law.negative_binomial.r: the value is 0; expected a number of successes above 0",
            "law.negative_binomial.p: the value is 0; expected a probability above 0 and at most 1",
        ]
    );
    for bad in [
        read!(Count, 70000),
        read!(Count, {}),
        read!(Count, { "constant": 1, "empirical": [1] }),
        read!(Count, { "empirical": [] }),
        read!(Count, { "empirical": [1, -1] }),
        read!(Count, { "mixture": [] }),
        read!(Count, { "mixture": [{ "weight": 1 }] }),
        read!(Count, { "poisson": { "mean": 1e300 } }),
        read!(Count, { "poisson": { "mean": 60000 }, "shift": 60000 }),
        read!(Count, { "negative_binomial": { "r": 1e300, "p": 1e-300 } }),
        read!(Count, { "binomial": { "n": { "expression": "rank / 2" }, "p": 0.5 } }),
        read!(Count, { "poisson": { "mean": { "expression": "1000 + age + 51 * dimension + 2600 * rank" } } }),
    ] {
        assert!(!count_faults(bad).is_empty());
    }
    for bad in
        [read!(Count, -1), read!(Count, 1.0), read!(Count, "3"), read!(Count, { "mixture": [{ "constant": 1 }] })]
    {
        assert!(bad.is_err());
    }
}

#[test]
fn variates_have_their_closed_forms() {
    let mean_of = |table: &VariateTable| {
        let n = 1 << 16;
        (0..n).map(|i| f64::from(table.draw((i << 16) + (1 << 15), HERE))).sum::<f64>() / f64::from(n)
    };
    let cases = [
        (read!(Variate, { "normal": { "mean": 55, "sd": 5 } }), 55.0),
        (read!(Variate, { "uniform": { "min": -2, "max": 6 } }), 2.0),
        (read!(Variate, { "lognormal": { "mean": 12, "sd": 3 } }), 12.0),
        (read!(Variate, { "empirical": [1, 2, 6] }), 3.0),
        (read!(Variate, { "value": { "expression": "age / 4" } }), 2.5),
        (read!(Variate, { "uniform": { "min": 0, "max": 4 }, "min": 1, "max": 3.5 }), 2.09375),
    ];
    for (given, mean) in cases {
        let table = variate(given);
        close(table.mean(HERE), mean, 1e-6);
        close(mean_of(&table), mean, 1e-4);
    }
    let clamped = [
        read!(Variate, { "normal": { "mean": 0, "sd": 1 }, "min": -0.5, "max": 2 }),
        read!(Variate, { "lognormal": { "mean": 2, "sd": 2 }, "min": 0.5, "max": 3 }),
        read!(Variate, { "normal": { "mean": 0, "sd": 1 }, "min": 1 }),
        read!(Variate, { "uniform": { "min": 0, "max": 1 }, "min": 2 }),
    ];
    for table in clamped.map(variate) {
        close(mean_of(&table), table.mean(HERE), 1e-4);
    }
}

#[test]
fn the_lognormal_has_the_spread_of_the_variable_itself() {
    let table = variate(read!(Variate, { "lognormal": { "mean": 12, "sd": 3 } }));
    let n = 1_u32 << 20;
    let deviations = (0..n).map(|i| f64::from(table.draw((i << 12) + (1 << 11), HERE)) - 12.0);
    close((deviations.map(|d| d * d).sum::<f64>() / f64::from(n)).sqrt(), 3.0, 1e-3);
}

#[test]
fn variates_draw_in_order_and_know_their_constants() {
    let table = variate(read!(Variate, { "normal": { "mean": { "expression": "rank" }, "sd": 1 } }));
    let draws: Vec<f32> = (0..4096).map(|i| table.draw(i << 20, HERE)).collect();
    assert!(draws.is_sorted() && table.draw(u32::MAX, HERE).is_finite());
    assert_eq!((variate(read!(Variate, 137.5)).constant(), table.constant()), (Some(137.5), None));
    assert_eq!(variate(read!(Variate, { "normal": { "mean": 4, "sd": 0 } })).constant(), Some(4.0));
    assert_eq!(variate(read!(Variate, { "uniform": { "min": 3, "max": 3 } })).constant(), Some(3.0));
}

#[test]
fn faults_of_variates_are_told() {
    let sd = variate_faults(
        read!(Variate, { "normal": { "mean": 1, "sd": { "expression": "2 - rank" } }, "min": 2, "max": 1 }),
    );
    assert_eq!(
        sd,
        [
            "law.min: min 2 is above max 1; expected min ≤ max",
            "law.normal.sd: the law is -1 at rank 3; expected a standard deviation of at least 0",
        ]
    );
    for bad in [
        read!(Variate, {}),
        read!(Variate, 1e300),
        read!(Variate, { "empirical": [] }),
        read!(Variate, { "uniform": { "min": 1, "max": 0 } }),
        read!(Variate, { "lognormal": { "mean": 0, "sd": 1 } }),
        read!(Variate, { "lognormal": { "mean": 1e-300, "sd": 1e30 } }),
        read!(Variate, { "value": 1, "normal": { "mean": 1, "sd": 1 } }),
    ] {
        assert!(!variate_faults(bad).is_empty());
    }
    let range = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };
    let angle = Variate::from(200.0).compile(&domain(), &root(), range).expect_err("out of range");
    assert_eq!(angle[0].to_string(), "law: the value is 200; expected an angle in degrees in [0, 180]");
}

#[test]
fn random_parameters_never_panic() {
    const EXTREMES: [f64; 12] =
        [0.0, 1.0, -1.0, 0.5, 1e-320, 1e-16, 0.999_999_999_999_999_9, 65_535.0, 1e20, 1e300, 3.0, 40.0];
    let mut seed = 7;
    let mut pick = || EXTREMES[random(&mut seed) as usize % EXTREMES.len()];
    for _ in 0..2000 {
        let (a, b, w) = (pick(), pick(), pick());
        let part = read!(CountComponent, { "weight": w, "poisson": { "mean": b } }).expect("reads");
        for given in [
            read!(Count, { "binomial": { "n": a, "p": b } }),
            read!(Count, { "negative_binomial": { "r": a, "p": b } }),
            read!(Count, { "mixture": [{ "weight": a, "constant": 3 }, part] }),
            read!(Count, { "empirical": [a, b] }),
        ] {
            if let Ok(table) = given.expect("reads").compile(&domain(), &root()) {
                assert!(table.sample(u32::MAX, HERE) == table.max() && table.mean(HERE).is_finite());
            }
        }
        for given in [
            read!(Variate, { "normal": { "mean": a, "sd": b }, "min": w }),
            read!(Variate, { "lognormal": { "mean": a, "sd": b } }),
            read!(Variate, { "uniform": { "min": a, "max": b }, "max": w }),
        ] {
            if let Ok(table) = given.expect("reads").compile(&domain(), &root(), ANY) {
                assert!(table.draw(u32::MAX, HERE).is_finite() && !table.mean(HERE).is_nan(), "{a} {b} {w}");
            }
        }
    }
}

#[test]
fn shapes_go_round() {
    let counts = json_schema!({ "it": [3, { "mixture": [
        { "weight": 0.3, "binomial": { "n": 7, "p": 0.63 }, "shift": 2, "source": "x" },
        { "weight": 0.7, "empirical": [1.0, 2.0] }], "shift": 1, "assumed": true }] });
    let read: Vec<Count> = Deserialize::deserialize(counts.get("it").expect("has `it`").clone()).expect("reads");
    let back = json_schema!({ "it": read });
    assert_eq!(Vec::<Count>::deserialize(back.get("it").expect("has `it`").clone()).expect("reads again"), read);
    let variates = json_schema!({ "it": [1.5, { "normal": { "mean": 1.0, "sd": { "value": 2.0 } }, "min": 0.5 }] });
    let given = variates.get("it").expect("has `it`");
    let read = Vec::<Variate>::deserialize(given.clone()).expect("reads");
    assert_eq!(json_schema!({ "it": read }).get("it"), Some(given));
}

#[test]
fn schemas_are_a_number_or_one_closed_object() {
    for (schema, kinds) in [(schema_for!(Law), 10), (schema_for!(Count), 6), (schema_for!(Variate), 5)] {
        let branches = schema.get("anyOf").and_then(|it| it.as_array()).expect("has branches");
        assert_eq!(branches.len(), 2);
        let object = &branches[1];
        assert_eq!(
            (object["additionalProperties"].as_bool(), object["minProperties"].as_u64()),
            (Some(false), Some(1))
        );
        let properties = object["properties"].as_object().expect("has properties");
        assert!(properties.len() >= kinds + 2);
        assert!(properties.values().all(|property| property.get("description").is_some()), "{properties:?}");
        let text = format!("{schema:?}");
        assert_eq!(kinds == 6, branches[0].get("maximum").and_then(|it| it.as_u64()) == Some(65_535));
        assert!(!text.contains("\"null\"") && !text.contains("Null"), "{text}");
    }
}

#[test]
fn the_extent_is_that_of_the_draws_and_what_can_be_drawn_is_known() {
    let table = variate(read!(Variate, { "normal": { "mean": 5, "sd": 1 }, "min": 4 }));
    let [least, most] = table.extent();
    assert_eq!(least, 4.0);
    assert_eq!(most, table.draw_f64(u32::MAX, HERE));
    assert!((11.33..11.34).contains(&most), "z of 1 − 2⁻³³ is 6.338: {most}");
    assert!(table.can_be(4.0) && table.can_be(table.draw_f64(123_456_789, HERE)));
    assert!(!table.can_be(3.9) && !table.can_be(12.0), "beyond the draws");
    let table = variate(read!(Variate, { "empirical": [3, -1, 8] }));
    assert_eq!(table.extent(), [-1.0, 8.0]);
    assert!(table.can_be(3.0) && !table.can_be(0.0));
    let table = variate(read!(Variate, { "uniform": { "min": -1, "max": { "expression": "if(age > 20, 9, 1)" } } }));
    assert!((table.extent()[1] - 9.0).abs() < 1e-8, "the largest at any age: {:?}", table.extent());
    assert!(!table.can_be(0.0), "0 lies between two words");
    assert_eq!(variate(read!(Variate, 2.5)).extent(), [2.5, 2.5]);
}

#[test]
fn what_is_drawn_once_a_plant_depends_on_no_variable() {
    let once = |given: Result<Variate, _>| -> Result<VariateTable, Vec<Fault>> {
        let given: Result<Variate, serde::de::value::Error> = given;
        given.expect("reads").compile(&Domain::ONCE, &root(), ANY)
    };
    let of = |text: &str| {
        let law = Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() });
        once(Ok(Variate::from(VariateForm { value: Some(law), ..VariateForm::default() })))
    };
    assert_eq!(of("2 * 3").map(|table| table.exact()), Ok(Some(6.0)));
    for (text, name) in [("age", "age"), ("1 + rank", "rank"), ("order", "order"), ("cycle - dimension", "dimension")] {
        let faults = of(text).expect_err("a variable");
        assert_eq!(faults.len(), 1, "{faults:?}");
        assert_eq!(faults[0].problem, format!("the law depends on {name}, which does not apply here"));
    }
}

#[test]
fn a_variate_looked_up_at_a_point_draws_what_its_table_draws() {
    let kinds = [
        r#"{"value": {"linear": {"over": "age", "start": 1.0, "slope": 0.25}}}"#,
        r#"{"normal": {"mean": {"linear": {"over": "age", "start": 1.0, "slope": 0.25}}, "sd": 2.0}, "min": 0.5}"#,
        r#"{"normal": {"mean": 5.2, "sd": 0.9}, "min": 2.5, "max": 6.0}"#,
        r#"{"uniform": {"min": -1.0, "max": 3.0}}"#,
        r#"{"lognormal": {"mean": 3.0, "sd": 0.4}, "max": 4.0}"#,
        r#"{"empirical": [1.0, 2.0, 7.5]}"#,
    ];
    for kind in kinds {
        let table = variate(serde_json::from_str(kind));
        for at in (1..=12).map(|age| At { age, ..HERE }) {
            let here = table.at_point(&at);
            for word in (0..2000_u32).map(|nth| nth.wrapping_mul(2_147_401)).chain([u32::MAX]) {
                let (found, expected) = (here.draw(word), table.draw(word, at));
                assert_eq!(found.to_bits(), expected.to_bits(), "{kind}: the word {word} at {at:?}");
            }
        }
    }
}

#[test]
fn thresholds_along_the_one_variable_are_those_of_the_table() {
    let laws = [
        ("0.3", None),
        (r#"{"gompertz": {"over": "cycle", "c": 0.01, "g": 0.2}}"#, Some(Variable::Cycle)),
        (r#"{"step": {"over": "age", "at": 6, "before": 0.0, "after": 0.98}}"#, Some(Variable::Age)),
        (r#"{"linear": {"over": "dimension", "start": 0.1, "slope": 0.01}}"#, Some(Variable::Dimension)),
    ];
    for (given, variable) in laws {
        let law: Law = serde_json::from_str(given).expect("reads");
        let table = law.compile_probability(&domain(), &root()).expect("compiles");
        let along = table.along().expect("at most one variable");
        assert_eq!(along.variable, variable, "{given}");
        for value in 0..200 {
            let at = At { age: value, dimension: value, cycle: value, ..HERE };
            assert_eq!(along.threshold(value), table.threshold(at), "{given} at {value}");
        }
    }
    let both: Law = serde_json::from_str(r#"{"expression": "0.001 * age + 0.001 * cycle"}"#).expect("reads");
    assert!(both.compile_probability(&domain(), &root()).expect("compiles").along().is_none());
}
