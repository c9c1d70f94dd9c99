//! Special functions against scipy 1.17 (`stats.chi2.sf`, `norm.cdf`, `norm.ppf`, `special.betainc`, `2 * t.sf`,
//! `binomtest(...).proportion_ci(method="exact")`), within 10⁻¹⁰ of the value.
//!
//! Absent: estimators.

use phytomer_fits::special::{
    beta_below, chi2_tail, normal_below, normal_quantile, proportion_interval, student_both_tails,
};

#[track_caller]
fn is(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-10 * expected.abs().max(1e-300), "{found:e} {expected:e}");
}

#[test]
fn tails_of_chi2() {
    for (x, df, expected) in [
        (0.5, 1.0, 0.47950012218695337),
        (3.84, 1.0, 0.05004352124870519),
        (16.0, 2.0, 0.0003354626279025119),
        (342.6, 12.0, 5.102093064017153e-66),
        (60.0, 30.0, 0.0009206823961486636),
        (0.001, 5.0, 0.9999999983185123),
    ] {
        is(chi2_tail(x, df), expected);
    }
}

#[test]
fn the_normal_distribution() {
    for (x, expected) in [
        (-8.0, 6.22096057427174e-16),
        (-3.1, 0.0009676032132183563),
        (-1.96, 0.024997895148220435),
        (-0.01, 0.4960106436853684),
        (0.0, 0.5),
        (0.7, 0.758036347776927),
        (2.5, 0.9937903346742238),
        (6.0, 0.9999999990134123),
    ] {
        is(normal_below(x), expected);
    }
    for (p, expected) in [
        (1e-6, -4.753424308822899),
        (0.025, -1.9599639845400545),
        (0.3, -0.5244005127080409),
        (0.975, 1.959963984540054),
        (0.9999, 3.719016485455709),
    ] {
        is(normal_quantile(p), expected);
    }
}

#[test]
fn beta_and_student() {
    for (a, b, x, expected) in [
        (2.0, 3.0, 0.4, 0.5247999999999999),
        (0.5, 0.5, 0.1, 0.20483276469913345),
        (553.0, 49.0, 0.9, 0.0539624877603837),
        (20.0, 1.0, 0.97, 0.543794342926747),
        (1.0, 20.0, 0.01, 0.18209306240276915),
    ] {
        is(beta_below(a, b, x), expected);
    }
    for (t, df, expected) in [
        (2.0, 5.0, 0.10193947882985835),
        (0.3, 40.0, 0.7657307167710191),
        (12.7, 1.0, 0.050024327689344165),
        (4.0, 100.0, 0.00012152364430076177),
    ] {
        is(student_both_tails(t, df), expected);
    }
}

#[test]
fn the_exact_interval_of_a_proportion() {
    let [low, high] = proportion_interval(3.0, 20.0, 0.05);
    is(low, 0.03207093718554477);
    is(high, 0.37892682654529564);
    let [low, high] = proportion_interval(0.0, 20.0, 0.05);
    assert_eq!(low, 0.0);
    is(high, 0.16843347098308548);
}
