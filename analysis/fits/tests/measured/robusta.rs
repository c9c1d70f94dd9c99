//! Mortality of the branches of robusta coffee: 600 axes at each of four ages (GreenLab course, CIRAD).

use crate::table::{Table, is};
use phytomer_fits::mortality::{Hazard, Observed, SeenOnce, fit, fit_all, least_squares};

/// The published fractions, or the whole numbers of dead axes that they stand for.
fn seen(whole: bool) -> Option<Vec<SeenOnce>> {
    let table = Table::read("greenlab_published_tables.csv")?;
    let rows = table.of(("table", "coffee_branch_mortality"), ["x", "y"]);
    let numbers = rows.iter().map(|row| row.map(|text| text.parse::<f64>().unwrap()));
    let dead = |fraction: f64| if whole { (600.0 * fraction).round() } else { 600.0 * fraction };
    Some(numbers.map(|[age, fraction]| SeenOnce { age, axes: 600.0, dead: dead(fraction) }).collect())
}

#[test]
fn least_squares_and_likelihood_of_the_power_law() {
    let (Some(fractions), Some(seen)) = (seen(false), seen(true)) else { return };
    let (alpha, beta) = least_squares(&fractions);
    is("α / 10⁻⁸ by least squares", alpha * 1e8, 8.888, 3);
    is("β by least squares", beta, 4.418, 3);
    let power = fit(&Observed::SeenOnce(seen), Hazard::Power).unwrap();
    is("α / 10⁻⁷", power.value("alpha") * 1e7, 2.946, 3);
    is("β", power.value("shape"), 4.099, 3);
    is("χ²", power.tests[0].statistic, 16.0, 1);
    assert!(power.tests[0].df == 2.0 && power.tests[0].p < 0.01);
    // Scale and shape are all but independent; ln α and β are not.
    let (scale, shape) = (power.value("scale"), power.value("shape"));
    let [[ss, sb], [_, bb]] = [0, 1].map(|row| [power.covariance[row][0], power.covariance[row][1]]);
    let ln = phytomer_sim::math::log(scale);
    let (aa, ab) = (
        ln * ln * bb + 2.0 * ln * shape / scale * sb + shape * shape / scale / scale * ss,
        -ln * bb - shape / scale * sb,
    );
    is("correlation of ln α and β", ab / (aa * bb).sqrt(), -0.997, 3);
    assert!(power.correlated().is_empty(), "{:?}", power.correlated());
}

#[test]
fn a_constant_hazard_or_gompertz_holds() {
    let Some(seen) = seen(true) else { return };
    let seen = Observed::SeenOnce(seen);
    let both = fit(&seen, Hazard::PowerAndConstant).unwrap();
    is("constant", both.value("constant"), 0.00176, 5);
    is("α / 10⁻⁸", both.value("alpha") * 1e8, 1.391, 3);
    is("β", both.value("shape"), 4.895, 3);
    is("χ²", both.tests[0].statistic, 0.32, 2);
    assert_eq!(both.tests[0].df, 1.0);
    let gompertz = fit(&seen, Hazard::Gompertz).unwrap();
    is("c", gompertz.value("c"), 0.00744, 5);
    is("g", gompertz.value("g"), 0.1216, 4);
    is("χ²", gompertz.tests[0].statistic, 2.84, 2);
    assert_eq!(gompertz.tests[0].df, 2.0);
    let choice = fit_all(&seen).unwrap();
    let rivals: Vec<&str> = choice.fits[..choice.rivals].iter().map(|fit| fit.law.as_str()).collect();
    assert!(rivals.contains(&"Gompertz") && rivals.contains(&"power and constant hazard"), "{rivals:?}");
    assert_eq!(choice.taken().law, "Gompertz");
}
