//! Tests of laws: each kind against its closed form, the checks, the expressions, the shape on file.
//!
//! Files are stood in for by JSON values, which go through the same `Deserialize`.

use phytomer_sim::math;
use schemars::json_schema;
use serde::Deserialize;

#[path = "../../../tests/program/absent.rs"]
mod absent;

use super::*;
use crate::fault::{Fault, Path};

/// A value of a parameter type, as it would be read from a file.
macro_rules! read {
    ($type:ty, $($json:tt)+) => {
        json_schema!({ "it": $($json)+ }).get("it").map(|json| <$type>::deserialize(json.clone())).expect("has `it`")
    };
}
pub(super) use read;

pub(super) fn domain() -> Domain {
    let states = vec!["juvenile".to_owned(), "adult".to_owned()];
    Domain { order: 2, until: 50, max_cycle: 60, max_unit: 60, max_rank: 12, states, ..Domain::default() }
}

pub(super) fn root() -> Path {
    Path::root().key("law")
}

fn law(law: Result<Law, impl std::fmt::Debug>) -> Law {
    law.expect("reads")
}

fn probability(given: Law) -> ProbabilityTable {
    given.compile_probability(&domain(), &root()).expect("compiles")
}

fn faults(given: Law) -> Vec<String> {
    given.compile_probability(&domain(), &root()).expect_err("has faults").iter().map(Fault::to_string).collect()
}

fn expression(text: &str) -> Law {
    LawForm { expression: Some(text.to_owned()), ..LawForm::default() }.into()
}

fn value(text: &str, at: At) -> f64 {
    let range = ValueRange { min: f64::NEG_INFINITY, max: f64::INFINITY, what: "a number" };
    let table = expression(text).compile_value(&domain(), &root(), range).unwrap_or_else(|f| panic!("{text}: {f:?}"));
    f64::from(table.value(at))
}

#[test]
fn constants_are_one_cell() {
    let never = probability(0.0.into());
    let certain = probability(law(read!(Law, { "value": 1, "source": "de Reffye 1988", "assumed": true })));
    let some = probability(law(read!(Law, { "table": { "over": "age", "values": [0.1], "beyond": "last" } })));
    assert!(never.is_never() && certain.is_certain() && !some.is_never() && !some.is_certain());
    assert_eq!(some.constant(), Some(0.1));
    for word in [0, 1, u32::MAX / 2, u32::MAX] {
        assert!(!never.happens(word, At::default()) && certain.happens(word, At::default()));
    }
    assert!(some.happens(429_496_729, At::default()) && !some.happens(429_496_730, At::default()));
    assert_eq!(ProbabilityTable::certain_or_never(true), probability(1.0.into()));
}

#[test]
fn curves_follow_their_formulas() {
    let at = |x| At { age: 50, dimension: x, cycle: x, rank: x, ..At::default() };
    let step = probability(law(read!(Law, { "step": { "over": "rank", "at": 5, "before": 0.25, "after": 1 } })));
    assert_eq!((step.probability(at(4)), step.probability(at(5))), (0.25, 1.0));
    assert!(step.happens(u32::MAX, at(5)));
    let linear = read!(Law, { "linear": { "over": "dimension", "start": -0.1, "slope": 0.125, "min": 0, "max": 0.5 } });
    let linear = probability(law(linear));
    assert_eq!((linear.probability(at(0)), linear.probability(at(49))), (0.0, 0.5));
    assert!((linear.probability(at(2)) - 0.15).abs() < 1e-9);
    let rise = read!(Law, { "exponential": { "over": "cycle", "start": 0.1, "end": 0.9, "rate": 0.05 } });
    let rise = probability(law(rise));
    assert!((rise.probability(at(7)) - (0.9 - 0.8 * math::exp(-0.35))).abs() < 1e-9);
    let logistic =
        read!(Law, { "logistic": { "over": "cycle", "low": 0.2, "high": 0.8, "midpoint": 10, "steepness": 0.3 } });
    let logistic = probability(law(logistic));
    assert!((logistic.probability(at(10)) - 0.5).abs() < 1e-9);
    let table = read!(Law, { "table": { "over": "cycle", "from": 3, "values": [0.5, 0.25], "beyond": "zero" } });
    let table = probability(law(table));
    assert_eq!([0, 3, 4, 5, 60].map(|x| table.probability(at(x))), [0.5, 0.5, 0.25, 0.0, 0.0]);
}

#[test]
fn hazards_multiply_to_their_cumulative_fractions() {
    let weibull = probability(law(read!(Law, { "weibull": { "over": "dimension", "scale": 20, "shape": 2.5 } })));
    let robusta = probability(law(read!(Law, { "robusta": { "over": "cycle", "alpha": 8.89e-8, "beta": 4.418 } })));
    let (mut outlived, mut alive) = (1.0, 1.0);
    for x in 0..=50 {
        let at = At { age: 50, dimension: x, cycle: x, ..At::default() };
        outlived *= 1.0 - weibull.probability(at);
        alive *= 1.0 - robusta.probability(at);
        let x = f64::from(x);
        assert!((outlived - math::exp(-math::pow(x / 20.0, 2.5))).abs() < 1e-8, "{x}");
        assert!((alive - math::exp(-8.89e-8 * math::pow(x, 4.418))).abs() < 1e-8, "{x}");
    }
}

/// The law that was fitted to the branches of robusta, and its rival: S(x) is the product of those of the causes.
#[test]
fn several_causes_multiply_what_outlives_each() {
    let both = probability(law(read!(Law, { "hazards": [
        { "weibull": { "over": "dimension", "scale": 40, "shape": 4.9 } }, { "value": 0.002 }] })));
    let gompertz = probability(law(read!(Law, { "gompertz": { "over": "dimension", "c": 0.00744, "g": 0.1216 } })));
    let (mut outlived, mut alive) = (1.0, 1.0);
    for x in 1..=50 {
        let at = At { age: 50, dimension: x, cycle: x, ..At::default() };
        outlived *= 1.0 - both.probability(at);
        alive *= 1.0 - gompertz.probability(at);
        let x = f64::from(x);
        let causes = math::exp(-math::pow(x / 40.0, 4.9)) * math::pow(0.998, x);
        assert!((outlived - causes).abs() < 1e-7, "{x}: {outlived} {causes}");
        assert!((alive - math::exp(-0.00744 * math::expm1(0.1216 * x))).abs() < 1e-7, "{x}");
    }
}

#[test]
fn robusta_fits_the_measured_dead_fractions() {
    let Some(text) = absent::measured("greenlab_published_tables.csv") else { return };
    let robusta = probability(law(read!(Law, { "robusta": { "over": "cycle", "alpha": 8.89e-8, "beta": 4.418 } })));
    let dead_by = |cycle| {
        let alive: f64 = (0..=cycle).map(|cycle| 1.0 - robusta.probability(At { cycle, ..At::default() })).product();
        1.0 - alive
    };
    let mut points = 0;
    for line in text.lines().filter(|line| line.starts_with("coffee_branch_mortality")) {
        let cells: Vec<&str> = line.split(',').collect();
        let (cycles, dead): (u32, f64) = (cells[3].parse().expect("cycles"), cells[5].parse().expect("fraction"));
        assert!((dead_by(cycles) - dead).abs() < 0.025, "{cycles} cycles: {} for {dead}", dead_by(cycles));
        points += 1;
    }
    assert_eq!(points, 5);
}

#[test]
fn values_outside_are_told_with_their_point() {
    let slope = law(read!(Law, { "linear": { "over": "dimension", "start": 0, "slope": 0.03 } }));
    assert_eq!(faults(slope), ["law: the law is 1.02 at dimension 34; expected a probability in [0, 1]"]);
    assert_eq!(faults(1.5.into()), ["law: the value is 1.5; expected a probability in [0, 1]"]);
    assert_eq!(faults(f64::NAN.into()), ["law: the value is NaN; expected a probability in [0, 1]"]);
    assert_eq!(
        faults(1.000_000_000_001.into())[0],
        "law: the value is 1.000000000001; expected a probability in [0, 1]"
    );
    let both = faults(expression("if(dimension > age, 7, if(age == 3 and rank == 2, 2, 0))"));
    assert_eq!(both, ["law: the law is 2 at age 3, dimension 0, rank 2; expected a probability in [0, 1]"]);
    let by_state = read!(Law, { "by_state": { "adult": { "expression": "cycle / 50" }, "juvenile": -1 } });
    assert_eq!(
        faults(law(by_state)),
        [
            "law.by_state.juvenile: the law is -1 at cycle 0, state juvenile; expected a probability in [0, 1]",
            "law.by_state.adult: the law is 1.02 at cycle 51, state adult; expected a probability in [0, 1]",
        ]
    );
}

#[test]
fn faults_of_form_are_told() {
    let short = law(read!(Law, { "table": { "over": "dimension", "values": [0.1, 0.2] } }));
    assert_eq!(
        faults(short),
        [
            "law.table.values: table too short: has 2 values, needs 50; expected 50 values, or beyond = \"last\" or \"zero\""
        ]
    );
    let two = law(read!(Law, { "value": 1, "expression": "1" }));
    assert!(faults(two)[0].starts_with("law: 2 kinds are given: value, expression; expected exactly one of value,"));
    assert!(faults(LawForm::default().into())[0].starts_with("law: no kind is given"));
    let states = faults(law(read!(Law, { "by_state": { "adlut": 0, "juvenile": { "by_state": {} } } })));
    assert_eq!(
        states,
        [
            "law.by_state.adlut: unknown state `adlut`; expected a state of this species; the nearest is `adult`",
            "law.by_state.juvenile.by_state: by_state inside by_state; expected a law of the state",
            "law.by_state: no law for state `adult`; expected a law for each state",
        ]
    );
    let bad = law(read!(Law, { "weibull": { "over": "age", "scale": 0, "shape": -1 } }));
    assert_eq!(faults(bad).len(), 2);
    let unranked = Domain { max_rank: 0, ..domain() };
    assert!(expression("rank").compile_probability(&unranked, &root()).is_err());
    let huge = Domain { until: u32::MAX, max_cycle: u32::MAX, ..domain() };
    let over = expression("0 * age * cycle * dimension").compile_probability(&huge, &root());
    assert!(over.expect_err("too large")[0].problem.starts_with("the law takes 18446744073709551615 points"));
    assert!(expression("0 * age").compile_probability(&huge, &root()).is_err());
}

#[test]
fn states_and_points_beyond_are_clamped() {
    let table = probability(law(read!(Law, { "by_state": { "juvenile": 0, "adult": { "expression": "age / 100" } } })));
    let at = |age, state| At { age, state, ..At::default() };
    assert_eq!(table.probability(at(50, 0)), 0.0);
    assert_eq!([50, 51, u32::MAX].map(|age| table.probability(at(age, 1))), [0.5; 3]);
    assert_eq!(table.probability(at(50, 255)), 0.5);
    let four = expression("(age + dimension + cycle + rank) / 1000");
    let table = four.compile_probability(&domain(), &root()).expect("compiles");
    let all = At { age: 20, dimension: 7, cycle: 9, rank: 3, ..At::default() };
    assert!((table.probability(all) - 0.039).abs() < 1e-9);
    assert!((table.probability(At { rank: 0, ..all }) - 0.037).abs() < 1e-9);
}

#[test]
fn expressions_bind_as_on_paper() {
    let at = At { age: 7, dimension: 3, cycle: 2, rank: 5, ..At::default() };
    let cases = [
        ("1 + 2 * 3 ^ 2", 19.0),
        ("-2 ^ 2", -4.0),
        ("2 ^ -1", 0.5),
        ("2 ^ 3 ^ 2", 512.0),
        ("8 - 3 - 2", 3.0),
        ("8 / 4 / 2", 1.0),
        ("(1 + 2) * -3", -9.0),
        ("not 1 < 2", 0.0),
        ("1 or 0 and 0", 1.0),
        ("age == 7 and dimension <= 3 and rank != 4", 1.0),
        ("order + cycle", 4.0),
        ("min(4, 2, 3) + max(1, .5e1)", 7.0),
        ("if(age > 0, floor(2.7), log(-1))", 2.0),
        ("pow(2, 10) + sqrt(16) + abs(-1) + exp(0) + log(1)", 1030.0),
        ("1e3 + 1E-3 * 0", 1000.0),
        ("1 - -1 + +1", 3.0),
    ];
    for (text, expected) in cases {
        assert_eq!(value(text, at), expected, "{text}");
    }
}

#[test]
fn errors_in_expressions_carry_the_column() {
    let cases = [
        ("1 + dimention", "column 5 of the expression: unknown name `dimention`", "; the nearest is `dimension`"),
        ("mix(1, 2)", "column 1 of the expression: unknown function `mix`", "; the nearest is `min`"),
        ("1 + ", "column 5 of the expression: the expression ends too early", "a number"),
        ("", "column 1 of the expression: the expression ends too early", "a number"),
        ("(1 + 2", "column 7 of the expression: the expression ends too early", "`)`"),
        ("1 2", "column 3 of the expression: unexpected number 2", "an operator"),
        ("1 $ 2", "column 3 of the expression: unexpected character `$`", "a number"),
        ("0 < age < 3", "column 9 of the expression: comparisons do not chain", "`and`"),
        ("exp(1, 2)", "column 1 of the expression: `exp` is given 2 arguments", "1 argument"),
        ("max(1)", "column 1 of the expression: `max` is given 1 arguments", "2 arguments or more"),
        ("1e999", "column 1 of the expression: `1e999` is not a number", "a number"),
    ];
    for (text, problem, expected) in cases {
        let found = expression(text).compile_probability(&domain(), &root()).expect_err(text);
        assert_eq!((found.len(), found[0].problem.as_str()), (1, problem));
        assert!(found[0].expected.contains(expected), "{text}: {}", found[0].expected);
        assert_eq!(found[0].path.to_string(), "law.expression");
    }
    for deep in ["(".repeat(1999), "-".repeat(1999), "not ".repeat(400), "2^".repeat(900), "exp(".repeat(400)] {
        assert!(faults(expression(&deep))[0].contains("nested too deeply"), "{}", &deep[..8]);
    }
    assert!(faults(expression(&"1+".repeat(1_000_000)))[0].contains("too long"));
    assert_eq!(value(&format!("1{}", "+1".repeat(900)), At::default()), 901.0);
}

/// A small generator: the sequence need only be long and the same on every run.
pub(super) fn random(seed: &mut u64) -> u32 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) as u32
}

#[test]
fn random_expressions_never_panic() {
    const WORDS: [&str; 36] = [
        "1",
        "0.5",
        "2e3",
        ".",
        "1e",
        "age",
        "dimension",
        "cycle",
        "rank",
        "order",
        "+",
        "-",
        "*",
        "/",
        "^",
        "<",
        "<=",
        ">",
        ">=",
        "==",
        "!=",
        "(",
        "(",
        ")",
        ")",
        ",",
        "min",
        "max",
        "exp(",
        "log(",
        "if(",
        "not",
        "and",
        "or",
        "π",
        "\u{0}",
    ];
    let small = Domain { until: 3, max_cycle: 2, max_rank: 2, ..domain() };
    let (mut seed, mut parsed) = (1, 0);
    for _ in 0..10_000 {
        let words = (0..random(&mut seed) % 12).map(|_| WORDS[random(&mut seed) as usize % WORDS.len()]);
        let text = words.collect::<Vec<_>>().join(if random(&mut seed).is_multiple_of(2) { " " } else { "" });
        parsed += usize::from(parser::parse(&text, &expression::OfLaws).is_ok());
        let table = expression(&text).compile_probability(&small, &root());
        if let Ok(table) = table {
            table.happens(random(&mut seed), At { age: random(&mut seed), ..At::default() });
        }
    }
    assert!(parsed > 100, "{parsed} parsed");
}

#[test]
fn the_shape_on_file_is_exact() {
    for bad in [read!(Law, "0.1"), read!(Law, true), read!(Law, [1]), read!(Law, { "valeu": 1 })] {
        assert!(bad.is_err());
    }
    let unknown = read!(Law, { "table": { "over": "dimesion", "values": [1] } }).expect_err("unknown variable");
    assert!(unknown.to_string().contains("unknown variant `dimesion`"), "{unknown}");
    let given = json_schema!({ "it": { "by_state": {
        "a": { "table": { "over": "age", "from": 2, "values": [0.5], "beyond": "last" }, "source": "x" },
        "b": { "expression": "age", "assumed": true }, "c": 0.25 } } });
    let given = given.get("it").expect("has `it`");
    let read = Law::deserialize(given.clone()).expect("reads");
    assert_eq!(json_schema!({ "it": read }).get("it"), Some(given));
}
