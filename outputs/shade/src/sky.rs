//! The moments of a month at which the sun is asked for.
//!
//! A month is told by some of its days, each in the middle of an equal part of the month. A day is the time for which
//! the sun stands higher than the lowest altitude that counts, in an odd number of equal steps, each told by its
//! middle: mornings mirror afternoons. The declination is that of the day's noon by the *Astronomical Almanac*
//! (`sim/site/sun`); within the day it moves by less than .1° from it. Hours are those of the sun: 12 is when it stands
//! in the meridian. The ends of the day are where a sphere has them: no air bends the light.

use phytomer_sim::math::{acos, sin, sincos};
use phytomer_sim::site::date::Date;
use phytomer_sim::site::sun::{Direction, Sun};
use std::f64::consts::PI;

/// The fewest moments of a day.
const FEWEST_MOMENTS: usize = 3;
/// The lowest sun whose shadow is followed, as the sine of its altitude.
const LOWEST: f64 = 1e-9;

/// Where on the earth, and how finely the year is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sky {
    /// Radians, north positive.
    pub latitude: f64,
    /// Radians, east positive; it shifts noon within the day of universal time, and with it the declination a little.
    pub longitude: f64,
    /// The year.
    pub year: i32,
    /// How many days of each month are followed.
    pub days_a_month: u32,
    /// The longest step from moment to moment, hours.
    pub step_h: f64,
    /// The lowest altitude of the sun that counts, radians.
    pub lowest: f64,
}

/// The sun at a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Where it stands.
    pub sun: Direction,
    /// By how much the shadow of a point lies east and north of it for each metre of its height.
    pub shift: [f64; 2],
}

/// The moments of a day.
#[derive(Debug, Clone, PartialEq)]
pub struct Day {
    /// The day.
    pub date: Date,
    /// How many days of the month it stands for.
    pub days: f64,
    /// How long the sun is high enough, hours.
    pub sun_h: f64,
    /// From sunrise to sunset; none where it does not rise.
    pub moments: Vec<Moment>,
}

impl Sky {
    /// The days of a month (1 to 12) that stand for it; none of a month that the calendar does not have.
    pub fn days(&self, month: u32) -> Vec<Day> {
        let Some(first) = Date::new(self.year, month, 1) else { return Vec::new() };
        let length = (28..=31).rev().find(|day| Date::new(self.year, month, *day).is_some()).unwrap_or(28);
        let count = self.days_a_month.clamp(1, length);
        let middle = |part: u32| ((2 * part + 1) * length / (2 * count)) as i32;
        (0..count).map(|part| self.day(first.plus(middle(part)), f64::from(length) / f64::from(count))).collect()
    }

    /// A day that stands for so many.
    pub fn day(&self, date: Date, days: f64) -> Day {
        let noon = Sun::at_solar_time(date, 12.0, self.longitude);
        let half = self.half_day(noon.declination);
        let sun_h = half * 24.0 / PI;
        let steps = (sun_h / self.step_h).ceil().max(FEWEST_MOMENTS as f64) as usize;
        let steps = if sun_h > 0.0 { steps | 1 } else { 0 };
        let hour_angle = |step: usize| half * (2.0 * step as f64 + 1.0 - steps as f64) / steps as f64;
        let moments = (0..steps).filter_map(|step| self.moment(noon.declination, hour_angle(step))).collect();
        Day { date, days, sun_h, moments }
    }

    /// The hour angle at which the sun comes down to the lowest altitude: 0 where it is never above it, π where always.
    fn half_day(&self, declination: f64) -> f64 {
        let ((sin_phi, cos_phi), (sin_delta, cos_delta)) = (sincos(self.latitude), sincos(declination));
        let over = sin(self.lowest) - sin_phi * sin_delta;
        let cosine = over / (cos_phi * cos_delta);
        if cosine.is_nan() { if over < 0.0 { PI } else { 0.0 } } else { acos(cosine.clamp(-1.0, 1.0)) }
    }

    /// The sun of a declination at an hour angle; `None` where it stands in the horizon.
    fn moment(&self, declination: f64, hour_angle: f64) -> Option<Moment> {
        let sun = Sun { declination, right_ascension: 0.0, sidereal_time: hour_angle }.seen_from(self.latitude, 0.0);
        let [east, north, up] = sun.towards();
        (up > LOWEST).then(|| Moment { sun, shift: [-east / up, -north / up] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_sim::math::tan;
    use std::f64::consts::FRAC_PI_2;

    fn sky(latitude_deg: f64) -> Sky {
        Sky {
            latitude: latitude_deg.to_radians(),
            longitude: 0.0,
            year: 2024,
            days_a_month: 31,
            step_h: 0.25,
            lowest: 0.0,
        }
    }

    /// Noon is the moment in the middle: the number of steps is odd.
    fn noon(day: &Day) -> Moment {
        day.moments[day.moments.len() / 2]
    }

    #[test]
    fn at_an_equinox_noon_stands_at_90_degrees_less_the_latitude() {
        // 20 March 2021, 9:37 UT; 22 September 2024, 12:44; and 20 March 2024, 3:06, which is noon at 133° east.
        for (year, month, day, longitude) in [(2021, 3, 20, 0.0), (2024, 9, 22, 0.0), (2024, 3, 20, 133.0_f64)] {
            let date = Date::new(year, month, day).expect("a day");
            for latitude in [-89.0, -60.0, -23.4, -1.0, 0.0, 12.0, 45.0, 48.2, 66.0, 89.0_f64] {
                let sky = Sky { longitude: longitude.to_radians(), ..sky(latitude) };
                let stands = noon(&sky.day(date, 1.0)).sun.altitude.to_degrees();
                assert!((stands - (90.0 - latitude.abs())).abs() < 0.1, "{year}-{month}, {latitude}: {stands}");
            }
        }
    }

    #[test]
    fn the_shadow_of_a_pole_is_its_height_over_the_tangent() {
        for latitude in [-50.0, 10.0, 64.0] {
            for day in sky(latitude).days(5) {
                for moment in &day.moments {
                    let [east, north] = moment.shift;
                    let length = (east * east + north * north).sqrt();
                    let known = 1.0 / tan(moment.sun.altitude);
                    assert!((length - known).abs() < 1e-9 * known, "{length} {known}");
                    // The shadow lies opposite to the sun.
                    let (sin_azimuth, cos_azimuth) = sincos(moment.sun.azimuth);
                    assert!((east + length * sin_azimuth).abs() < 1e-9 * known.max(1.0));
                    assert!((north + length * cos_azimuth).abs() < 1e-9 * known.max(1.0));
                }
            }
        }
    }

    #[test]
    fn mornings_mirror_afternoons_and_the_hemispheres_each_other() {
        for latitude in [0.0, 35.0, 60.0] {
            let (north, south) = (sky(latitude), sky(-latitude));
            let date = Date::new(2024, 5, 3).expect("a day");
            let day = north.day(date, 1.0);
            assert!(day.moments.len() % 2 == 1 && day.sun_h / day.moments.len() as f64 <= 0.25);
            for (morning, evening) in day.moments.iter().zip(day.moments.iter().rev()) {
                assert!((morning.shift[0] + evening.shift[0]).abs() < 1e-9 * morning.shift[0].abs().max(1.0));
                assert!((morning.shift[1] - evening.shift[1]).abs() < 1e-9 * morning.shift[1].abs().max(1.0));
            }
            // The sun of the other hemisphere has the other declination.
            let declination = Sun::at_solar_time(date, 12.0, 0.0).declination;
            assert!((north.half_day(declination) - south.half_day(-declination)).abs() < 1e-12);
            for hour_angle in [-1.2, 0.0, 0.7] {
                let (Some(here), Some(there)) =
                    (north.moment(declination, hour_angle), south.moment(-declination, hour_angle))
                else {
                    panic!("the sun is up")
                };
                assert!((here.shift[0] - there.shift[0]).abs() < 1e-9);
                assert!((here.shift[1] + there.shift[1]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn days_stand_for_their_month() {
        let few = Sky { days_a_month: 4, ..sky(50.0) };
        for month in 1..=12 {
            let days = few.days(month);
            let length = few.days(month).iter().map(|day| day.days).sum::<f64>();
            assert!((28.0..=31.0).contains(&length) && days.len() == 4);
            let dates: Vec<u32> = days.iter().map(|day| day.date.month_and_day().1).collect();
            assert!(dates[0] >= 4 && f64::from(dates[3]) <= length - 2.0 && days[0].date.month_and_day().0 == month);
            assert_eq!(sky(50.0).days(month).len() as f64, length, "every day of it");
        }
        assert!(few.days(0).is_empty() && few.days(13).is_empty());
        let year: f64 = (1..=12).flat_map(|month| sky(50.0).days(month)).map(|day| day.sun_h * day.days).sum();
        assert!((year / 366.0 - 12.0).abs() < 0.1, "{year}: the sun is up for half of a year");
    }

    #[test]
    fn at_the_poles_nothing_is_undefined() {
        for latitude in [90.0, -90.0, 89.999_999, 70.0] {
            let sky = sky(latitude);
            for month in 1..=12 {
                for day in sky.days(month) {
                    assert!((0.0..=24.0).contains(&day.sun_h));
                    assert!(day.moments.iter().all(|moment| moment.shift.iter().all(|x| x.is_finite())));
                    assert!(day.sun_h > 0.0 || day.moments.is_empty());
                }
            }
            let dark = if latitude > 0.0 { 12 } else { 6 };
            assert!(sky.days(dark).iter().any(|day| day.sun_h == 0.0), "a polar night");
            assert!(sky.days(18 - dark).iter().any(|day| day.sun_h == 24.0), "a polar day");
        }
        assert!((sky(0.0).half_day(0.3) - FRAC_PI_2).abs() < 1e-12);
    }

    #[test]
    fn a_low_sun_may_be_left_out() {
        let date = Date::new(2024, 3, 20).expect("a day");
        let day = Sky { lowest: 10_f64.to_radians(), ..sky(0.0) }.day(date, 1.0);
        // At the equator at an equinox the sun climbs 15° an hour.
        assert!((day.sun_h - (12.0 - 20.0 / 15.0)).abs() < 1e-3, "{}", day.sun_h);
        assert!(day.moments.iter().all(|moment| moment.sun.altitude > 10_f64.to_radians()));
    }
}
