//! The sun along its path, beside the light of the sky.
//!
//! The path of a tick is that of the day in its middle: the sun stands at the nodes of a quadrature between sunrise
//! and sunset, and lights level ground by the sine of its elevation. The share of the sky in the light of a day
//! follows from the share of the radiation above the atmosphere that reaches the ground (Spitters, Toussaint &
//! Goudriaan 1986, *Agricultural and Forest Meteorology* 38: 217–229, the relation of de Jong 1980 for days), or is
//! stated. Absent: clouds that come and go within a day.

use super::Source;
use super::sky::{Sky, gauss_legendre};
use crate::clock::Tick;
use crate::site::date::Date;
use crate::site::sun::{Sun, declination, extraterrestrial_mj_m2, sunset_hour_angle};
use std::f64::consts::PI;

/// The least sine of the elevation at which the sun counts: half a degree, about its own radius.
const LOWEST: f64 = 0.01;

/// The sun of the ticks of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct SunPath {
    /// The latitude, radians, north positive.
    pub latitude: f64,
    /// Of each tick, from 0, the day in its middle and the share of the sky in its light; later ticks have the last.
    pub days: Vec<(Date, f64)>,
    /// The places of the sun on a day.
    pub instants: u32,
}

impl SunPath {
    /// The sources of a tick: those of the sky by its share, and the sun.
    pub fn with_sky(&self, sky: &Sky, tick: Tick) -> Vec<Source> {
        let mut sources = sky.sources();
        let Some(&(date, of_sky)) = self.days.get(tick as usize).or(self.days.last()) else { return sources };
        let sun = places(self.latitude, date, self.instants);
        let of_sky = if sun.is_empty() { 1.0 } else { of_sky.clamp(0.0, 1.0) };
        sources.iter_mut().for_each(|source| source.weight *= of_sky);
        sources.extend(sun.into_iter().map(|source| Source { weight: source.weight * (1.0 - of_sky), ..source }));
        sources.retain(|source| source.weight > 0.0);
        sources
    }
}

/// The places of the sun on a day, with shares of its light on level ground that sum to 1; none where it does not rise.
pub fn places(latitude: f64, date: Date, count: u32) -> Vec<Source> {
    let half_day = sunset_hour_angle(latitude, declination(date.day_of_year())) * 12.0 / PI;
    let nodes = gauss_legendre(count.clamp(1, 64));
    let at = |(share, weight): (f64, f64)| {
        let hours = 12.0 + half_day * (2.0 * share - 1.0);
        let towards = Sun::at_solar_time(date, hours, 0.0).seen_from(latitude, 0.0).towards();
        (towards[2] > LOWEST).then_some(Source { towards, weight: weight * towards[2] })
    };
    let mut places: Vec<Source> = nodes.into_iter().filter_map(at).collect();
    let all: f64 = places.iter().map(|place| place.weight).sum();
    places.iter_mut().for_each(|place| place.weight /= all);
    places
}

/// The share of the sky in the radiation of a day, by the share of the radiation above the atmosphere that reaches the
/// ground (Spitters et al. 1986).
pub fn share_of_sky(transmission: f64) -> f64 {
    match transmission {
        t if t < 0.07 => 1.0,
        t if t < 0.35 => 1.0 - 2.3 * (t - 0.07) * (t - 0.07),
        t if t < 0.75 => 1.33 - 1.46 * t,
        t if t >= 0.75 => 0.23,
        // No number.
        _ => 1.0,
    }
}

/// The share of the sky in the radiation of some days, each with its radiation, MJ/m²: the radiation of the sky of all
/// days over all radiation, with that above the atmosphere by FAO-56. 1 where there is no radiation.
///
/// Days are taken one by one and not by their mean: a clear day and a dark one have less light of the sky than two
/// days between them.
pub fn share_of_days(latitude: f64, days: impl IntoIterator<Item = (Date, f64)>) -> f64 {
    let (mut of_sky, mut all) = (0.0, 0.0);
    for (date, radiation) in days {
        let above = extraterrestrial_mj_m2(latitude, date.day_of_year());
        let share = if above > 0.0 { share_of_sky(radiation / above) } else { 1.0 };
        of_sky += radiation * share;
        all += radiation;
    }
    if all > 0.0 { of_sky / all } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::site::light::SkyKind;

    fn day(month: u32, day: u32) -> Date {
        Date::new(2001, month, day).expect("a day")
    }

    #[test]
    fn the_share_of_the_sky_falls_as_days_are_clear() {
        let shares = [0.0, 0.05, 0.2, 0.5, 0.8, f64::NAN].map(share_of_sky);
        let expected = [1.0, 1.0, 1.0 - 2.3 * 0.13 * 0.13, 0.6, 0.23, 1.0];
        assert!(shares.iter().zip(expected).all(|(share, known)| (share - known).abs() < 1e-12), "{shares:?}");
        // The pieces join to a hundredth, as in the paper.
        for edge in [0.07, 0.35, 0.75] {
            assert!((share_of_sky(edge - 1e-9) - share_of_sky(edge + 1e-9)).abs() < 0.02, "{edge}");
        }
    }

    /// By hand: FAO-56, example 8, has 32.2 MJ/m² above the atmosphere on 3 September at 20° S. Of 20 MJ/m² a share of
    /// .6211 passes, so 1.33 − 1.46 · .6211 = .4232 is of the sky; 8 MJ/m² are .2484, and 1 − 2.3 · .1784² = .9268.
    #[test]
    fn days_share_their_light_as_worked_by_hand() {
        let (latitude, date) = (-20.0_f64.to_radians(), day(9, 3));
        let of = |days: &[f64]| share_of_days(latitude, days.iter().map(|radiation| (date, *radiation)));
        assert!((extraterrestrial_mj_m2(latitude, date.day_of_year()) - 32.2).abs() < 0.05);
        // 32.2 is rounded: .05 of it moves the shares by .0015 and .0002.
        assert!((of(&[20.0]) - 0.4232).abs() < 0.002 && (of(&[8.0]) - 0.9268).abs() < 0.001, "{}", of(&[20.0]));
        // Both days: (20 · .4232 + 8 · .9268) / 28 = .5671; two days of 14 MJ/m² would have .6952.
        assert!((of(&[20.0, 8.0]) - 0.5671).abs() < 0.002, "{}", of(&[20.0, 8.0]));
        assert!((of(&[14.0, 14.0]) - 0.6952).abs() < 0.002, "{}", of(&[14.0]));
        assert_eq!((of(&[]), of(&[0.0])), (1.0, 1.0));
        assert_eq!(share_of_days(1.4, [(day(12, 21), 0.3)]), 1.0, "in the polar night all light is of the sky");
    }

    #[test]
    fn the_sun_goes_from_east_to_west_over_the_south() {
        let places = places(50.0_f64.to_radians(), day(6, 21), 9);
        assert_eq!(places.len(), 9);
        let sum: f64 = places.iter().map(|place| place.weight).sum();
        assert!((sum - 1.0).abs() < 1e-14);
        let (first, noon, last) = (&places[0], &places[4], &places[8]);
        assert!(first.towards[0] > 0.7 && last.towards[0] < -0.7, "{places:?}");
        assert!(noon.towards[0].abs() < 0.01 && noon.towards[1] < 0.0);
        let height = crate::math::asin(noon.towards[2]).to_degrees();
        assert!((height - 63.43).abs() < 0.1, "90° − 50° + 23.43°: {height}");
        assert!(super::places(80.0_f64.to_radians(), day(12, 21), 9).is_empty());
    }

    #[test]
    fn sky_and_sun_share_the_light() {
        let sun = SunPath { latitude: 0.3, days: vec![(day(3, 1), 0.4), (day(9, 1), 1.0)], instants: 5 };
        let sky = Sky { kind: SkyKind::Overcast, rings: 2, azimuths: 4 };
        let both = sun.with_sky(&sky, 0);
        assert_eq!(both.len(), 8 + 5);
        let of_sky: f64 = both[..8].iter().map(|source| source.weight).sum();
        let all: f64 = both.iter().map(|source| source.weight).sum();
        assert!((of_sky - 0.4).abs() < 1e-14 && (all - 1.0).abs() < 1e-14);
        assert_eq!(sun.with_sky(&sky, 7), sky.sources(), "later ticks have the last");
    }
}
