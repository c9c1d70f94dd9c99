//! One axis under constant death and pause, and the extinction of one type of bud, against their closed forms.
//!
//! Means, variances and probabilities are compared with samples of grown plants. Absent: several orders
//! (`expectation`).

use crate::grown::{PLANTS, Sample, compiled, plant};
use phytomer_models::buds::expectation::{extinct_by, extinction};
use phytomer_models::buds::params::Reiteration;
use phytomer_models::buds::{Buds, Order};
use phytomer_models::law::{Count, Law};
use phytomer_sim::NEVER;

fn one_order(order: Order) -> Buds {
    Buds { order: vec![order], ..Buds::default() }
}

/// Ticks survived E[T] = s(1 − sⁿ)/(1 − s), E[T²] = Σ(2k − 1)sᵏ; nodes: mean g E[T], variance g p E[T] + g² Var T.
#[test]
fn one_axis_survives_and_grows_as_its_closed_form() {
    let (d, p, n) = (0.05, 0.3, 20);
    let (s, g) = (1.0 - d, 1.0 - p);
    let powers: Vec<f64> = (1..=n).scan(1.0, |power, _| Some(*power * s).inspect(|next| *power = *next)).collect();
    let survived: f64 = powers.iter().sum();
    let squared: f64 = powers.iter().zip(1..).map(|(power, k)| f64::from(2 * k - 1) * power).sum();
    let (mean, variance) = (g * survived, g * p * survived + g * g * (squared - survived * survived));
    assert!((survived - s * (1.0 - powers[19]) / (1.0 - s)).abs() < 1e-12);
    assert!((mean - 8.532_137).abs() < 1e-6 && (variance - 29.189_464).abs() < 1e-6, "{mean} {variance}");

    let model = compiled(&one_order(Order { death: Law::from(d), pause: Law::from(p), ..Order::default() }), n);
    let plants: Vec<_> = (0..PLANTS).map(|number| plant(&model, number, n)).collect();
    let nodes = Sample::of(plants.iter().map(|plant| plant.nodes.len() as f64));
    nodes.assert_mean(mean, "nodes");
    nodes.assert_variance(variance, "nodes");
    let ticks = |end| if end == NEVER { f64::from(n) } else { f64::from(end - 1) };
    let survivors = Sample::of(plants.iter().map(|plant| ticks(plant.axes.apex_end[0])));
    survivors.assert_mean(survived, "ticks survived");
    survivors.assert_variance(squared - survived * survived, "ticks survived");
}

/// One type of bud, k = 1: each growth unit bears another such bud with probability a.
#[test]
fn one_type_of_bud_dies_out_with_the_smallest_root() {
    let (d, p, a, until) = (0.1, 0.0, 0.5, 14);
    let reiteration = Reiteration { buds: Count::from(1), probability: Law::from(a), ..Reiteration::default() };
    let order = Order { death: Law::from(d), pause: Law::from(p), reiteration, ..Order::default() };
    let model = compiled(&one_order(order), until);
    let deaths: Vec<_> = (0..PLANTS).map(|number| plant(&model, number, until).death).collect();
    for age in [1, 2, 5, 10, until] {
        let expected = extinct_by(d, p, a, age);
        let dead = Sample::of(deaths.iter().map(|&death| f64::from(u8::from(death <= age))));
        dead.assert_mean(expected, &format!("extinct by age {age}"));
    }
    assert!((extinction(d, p, a) - 2.0 / 9.0).abs() < 1e-15);
    assert!((extinct_by(d, p, a, 200) - 2.0 / 9.0).abs() < 1e-12);
}
