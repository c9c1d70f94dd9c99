//! Degree-days: what a day's temperatures add to the development of a plant, by the three methods that are in use.
//!
//! `Average` and `Thresholded` are methods 1 and 2 of McMaster & Wilhelm 1997 (*Agricultural and Forest Meteorology*
//! 87: 291–300), which differ by up to a fifth on one station: a scenario must say which it means. `Sine` is
//! Baskerville & Emin 1969 (*Ecology* 50: 514–517), the area between a sine wave through both extremes and the base.
//! An upper limit cuts horizontally: heat beyond it adds nothing and takes nothing away. For `Sine` that is the
//! degree-days above the base less those above the limit; for `Average` the mean, for `Thresholded` each extreme is at
//! most the limit, as both are at least the base. Absent: slower development above an optimum.

use crate::math::{asin, cos};
use std::f64::consts::{FRAC_PI_2, PI};

/// How a day's extremes become degree-days.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// The mean of the extremes, less the base: McMaster & Wilhelm's method 1.
    Average,
    /// The mean of the extremes, each at least the base, less the base: their method 2.
    Thresholded,
    /// The mean over the day of a sine wave through the extremes, of what is above the base.
    Sine,
}

/// Degree-days above a base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DegreeDays {
    /// How extremes are taken together.
    pub method: Method,
    /// The temperature below which nothing develops, °C.
    pub base: f64,
    /// The temperature above which nothing more is gained, °C.
    pub upper: Option<f64>,
}

impl DegreeDays {
    /// The degree-days of a day with these extremes, °C d; never negative.
    pub fn of_day(&self, maximum: f64, minimum: f64) -> f64 {
        let upper = self.upper.unwrap_or(f64::INFINITY);
        let limited = |temperature: f64| temperature.min(upper).max(self.base);
        match self.method {
            Method::Average => limited((maximum + minimum) / 2.0) - self.base,
            Method::Thresholded => (limited(maximum) + limited(minimum)) / 2.0 - self.base,
            Method::Sine => {
                let beyond = self.upper.map_or(0.0, |upper| above(maximum, minimum, upper));
                (above(maximum, minimum, self.base) - beyond).max(0.0)
            }
        }
    }
}

/// The mean over a day of how far a sine wave between the extremes is above a threshold; where it is below, nothing.
fn above(maximum: f64, minimum: f64, threshold: f64) -> f64 {
    let (mean, half) = ((maximum + minimum) / 2.0, (maximum - minimum) / 2.0);
    if minimum >= threshold {
        return mean - threshold;
    }
    if maximum <= threshold {
        return 0.0;
    }
    let crossing = asin(((threshold - mean) / half).clamp(-1.0, 1.0));
    ((mean - threshold) * (FRAC_PI_2 - crossing) + half * cos(crossing)) / PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sin;

    const METHODS: [Method; 3] = [Method::Average, Method::Thresholded, Method::Sine];

    fn of(method: Method, base: f64, upper: Option<f64>, maximum: f64, minimum: f64) -> f64 {
        DegreeDays { method, base, upper }.of_day(maximum, minimum)
    }

    #[test]
    fn a_day_that_crosses_the_base_differs_by_method() {
        let [average, thresholded, sine] = METHODS.map(|method| of(method, 10.0, None, 25.0, 5.0));
        assert_eq!((average, thresholded), (5.0, 7.5));
        // (5 · 2π/3 + 10 · √3/2) / π
        let closed = (10.0 * PI / 3.0 + 75.0_f64.sqrt()) / PI;
        assert!((sine - closed).abs() < 1e-12 && (sine - 6.0900).abs() < 5e-5, "{sine}");
    }

    #[test]
    fn within_the_limits_all_methods_agree_and_beyond_them_nothing_is_gained() {
        for method in METHODS {
            for (maximum, minimum) in [(25.0, 15.0), (20.0, 20.0)] {
                let gained = of(method, 10.0, Some(30.0), maximum, minimum);
                assert!((gained - ((maximum + minimum) / 2.0 - 10.0)).abs() < 1e-12, "{method:?}: {gained}");
            }
            assert_eq!(of(method, 10.0, None, 9.0, -30.0), 0.0, "{method:?}: a day below the base");
            assert_eq!(of(method, 10.0, Some(30.0), 45.0, 30.0), 20.0, "{method:?}: a day above the limit");
            assert_eq!(of(method, 10.0, Some(10.0), 45.0, -30.0), 0.0, "{method:?}: no room between base and limit");
            assert_eq!(of(method, 10.0, Some(5.0), 45.0, -30.0), 0.0, "{method:?}: a limit below the base");
        }
        assert_eq!(of(Method::Average, 10.0, Some(30.0), 45.0, 25.0), 20.0);
        assert_eq!(of(Method::Thresholded, 10.0, Some(30.0), 45.0, 25.0), 17.5);
    }

    /// The mean of the sine wave held between base and limit, by the midpoint rule between the kinks.
    fn integrated(base: f64, upper: f64, maximum: f64, minimum: f64) -> f64 {
        let (mean, half) = ((maximum + minimum) / 2.0, (maximum - minimum) / 2.0);
        let kink = |threshold: f64| asin(((threshold - mean) / half).clamp(-1.0, 1.0));
        let bounds = [-FRAC_PI_2, kink(base), kink(upper), FRAC_PI_2];
        let steps = 50_000;
        let piece = |from: f64, to: f64| {
            let step = (to - from) / f64::from(steps);
            let value = |i: i32| (mean + half * sin(from + (f64::from(i) + 0.5) * step)).clamp(base, upper) - base;
            (0..steps).map(value).sum::<f64>() * step
        };
        bounds.windows(2).map(|ends| piece(ends[0], ends[1])).sum::<f64>() / PI
    }

    #[test]
    fn the_sine_is_its_integral() {
        for (base, upper) in [(10.0, 30.0), (0.0, 12.0), (-5.0, 60.0)] {
            for (maximum, minimum) in [(25.0, 5.0), (35.0, 5.0), (35.0, 12.0), (11.0, -20.0), (30.0, 10.0)] {
                let closed = of(Method::Sine, base, Some(upper), maximum, minimum);
                let numeric = integrated(base, upper, maximum, minimum);
                let bound = 1e-9 * numeric.max(1.0);
                assert!(
                    (closed - numeric).abs() <= bound,
                    "{base} to {upper}, {maximum}/{minimum}: {closed} {numeric}"
                );
            }
        }
    }

    #[test]
    fn extremes_that_are_none_do_no_harm() {
        for method in METHODS {
            for (maximum, minimum) in [(5.0, 25.0), (f64::NAN, 1.0), (f64::INFINITY, 1.0), (1e308, -1e308)] {
                let _ = of(method, 10.0, Some(30.0), maximum, minimum);
            }
        }
    }
}
