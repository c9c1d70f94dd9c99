//! Where the sun stands and how much of it reaches the top of the atmosphere, for all who ask.
//!
//! Two formulas, each for what it is used for. **Days** ([`declination`], [`day_length_h`], [`extraterrestrial_mj_m2`])
//! follow FAO-56 (Allen et al. 1998, *Crop evapotranspiration*, eqs 21–25 and 34), whose numbers agronomists compare
//! with theirs; its declination is off by up to 1.5°. **Instants** ([`Sun`]), for shadows, follow the low-precision
//! formula of the *Astronomical Almanac* (section C, "Low precision formulas for the Sun"; also Michalsky 1988, *Solar
//! Energy* 40: 227–235): stated to .01° for 1950–2050, and within .017° of VSOP87 from 1900 to 2100. Sidereal time is
//! that of the IAU of 1982 (Meeus 1998, *Astronomical Algorithms*, eq. 12.4). Places are those of the centre of the sun
//! without an atmosphere. Absent: refraction (half a degree at the horizon), the sun's parallax (.0024°), the
//! difference of terrestrial and universal time (.0008°).

use super::date::Date;
use crate::math::{acos, asin, atan2, cos, fmod, sin, sincos, tan};
use std::f64::consts::{PI, TAU};

/// The solar constant of FAO-56, MJ/m² a minute.
pub const SOLAR_CONSTANT: f64 = 0.0820;

/// The square of the mean distance to the sun over that of the day: FAO-56, eq. 23.
pub fn inverse_distance(day_of_year: u32) -> f64 {
    1.0 + 0.033 * cos(TAU / 365.0 * f64::from(day_of_year))
}

/// The declination of the sun on a day, radians: FAO-56, eq. 24.
pub fn declination(day_of_year: u32) -> f64 {
    0.409 * sin(TAU / 365.0 * f64::from(day_of_year) - 1.39)
}

/// The hour angle of sunset, radians: FAO-56, eq. 25. 0 where the sun does not rise, π where it does not set.
pub fn sunset_hour_angle(latitude: f64, declination: f64) -> f64 {
    acos((-tan(latitude) * tan(declination)).clamp(-1.0, 1.0))
}

/// Hours from sunrise to sunset at a latitude (radians, north positive): FAO-56, eq. 34.
pub fn day_length_h(latitude: f64, day_of_year: u32) -> f64 {
    24.0 / PI * sunset_hour_angle(latitude, declination(day_of_year))
}

/// The radiation of a day on level ground without an atmosphere, MJ/m²: FAO-56, eq. 21.
pub fn extraterrestrial_mj_m2(latitude: f64, day_of_year: u32) -> f64 {
    let declination = declination(day_of_year);
    let sunset = sunset_hour_angle(latitude, declination);
    let ((sin_phi, cos_phi), (sin_delta, cos_delta)) = (sincos(latitude), sincos(declination));
    let height = sunset * sin_phi * sin_delta + cos_phi * cos_delta * sin(sunset);
    24.0 * 60.0 / PI * SOLAR_CONSTANT * inverse_distance(day_of_year) * height
}

/// The sun at an instant, as seen from the centre of the earth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sun {
    /// How far north of the celestial equator, radians.
    pub declination: f64,
    /// How far east of the vernal equinox along the celestial equator, radians.
    pub right_ascension: f64,
    /// The hour angle of the vernal equinox at Greenwich (mean sidereal time), radians in [0, 2π).
    pub sidereal_time: f64,
}

/// Where the centre of the sun stands in the sky of a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// From north through east, radians in [0, 2π).
    pub azimuth: f64,
    /// Above the horizon, radians; negative at night.
    pub altitude: f64,
}

impl Sun {
    /// The sun so many hours of universal time after the midnight with which a day begins.
    pub fn at(date: Date, ut_hours: f64) -> Self {
        let days = date.since_j2000() + ut_hours / 24.0;
        let longitude = ecliptic_longitude(days);
        let obliquity = (23.439 - 0.000_000_4 * days).to_radians();
        let (sin_lambda, cos_lambda) = sincos(longitude);
        let (sin_epsilon, cos_epsilon) = sincos(obliquity);
        Self {
            declination: asin(sin_epsilon * sin_lambda),
            right_ascension: atan2(cos_epsilon * sin_lambda, cos_lambda),
            sidereal_time: turn(280.460_618_37 + 360.985_647_366_29 * days),
        }
    }

    /// The sun at true solar time: so many hours after the true midnight of a place (longitude in radians, east
    /// positive), so that it stands in the meridian at 12.
    pub fn at_solar_time(date: Date, solar_hours: f64, longitude: f64) -> Self {
        let mut hours = solar_hours - longitude * 12.0 / PI;
        // The equation of time, at most 17 minutes, changes by 30 seconds a day: the second step ends it.
        for _ in 0..2 {
            let ahead = Self::at(date, hours).hour_angle(longitude) - (solar_hours - 12.0) * PI / 12.0;
            hours -= half_turns(ahead) * 12.0 / PI;
        }
        Self::at(date, hours)
    }

    /// How far the sun has moved west of the meridian of a longitude (radians, east positive), radians.
    pub fn hour_angle(&self, longitude: f64) -> f64 {
        half_turns(self.sidereal_time + longitude - self.right_ascension)
    }

    /// Where the sun stands for a place (latitude and longitude in radians, north and east positive).
    pub fn seen_from(&self, latitude: f64, longitude: f64) -> Direction {
        let (sin_hour, cos_hour) = sincos(self.hour_angle(longitude));
        let ((sin_phi, cos_phi), (sin_delta, cos_delta)) = (sincos(latitude), sincos(self.declination));
        let up = sin_phi * sin_delta + cos_phi * cos_delta * cos_hour;
        let north = cos_phi * sin_delta - sin_phi * cos_delta * cos_hour;
        let east = -cos_delta * sin_hour;
        let azimuth = atan2(east, north);
        Direction { azimuth: if azimuth < 0.0 { azimuth + TAU } else { azimuth }, altitude: asin(up.clamp(-1.0, 1.0)) }
    }
}

impl Direction {
    /// The unit vector that points to the sun: x to the east, y to the north, z up.
    pub fn towards(&self) -> [f64; 3] {
        let ((sin_azimuth, cos_azimuth), (sin_altitude, cos_altitude)) = (sincos(self.azimuth), sincos(self.altitude));
        [cos_altitude * sin_azimuth, cos_altitude * cos_azimuth, sin_altitude]
    }
}

/// The apparent longitude of the sun along the ecliptic, radians: mean longitude and equation of the centre.
fn ecliptic_longitude(days: f64) -> f64 {
    let anomaly = turn(357.528 + 0.985_600_3 * days);
    let centre = 1.915 * sin(anomaly) + 0.020 * sin(2.0 * anomaly);
    turn(280.460 + 0.985_647_4 * days + centre)
}

/// Degrees as radians in [0, 2π).
fn turn(degrees: f64) -> f64 {
    let rest = fmod(degrees, 360.0);
    (if rest < 0.0 { rest + 360.0 } else { rest }).to_radians()
}

/// The same angle in [−π, π].
fn half_turns(angle: f64) -> f64 {
    let rest = fmod(angle, TAU);
    if rest > PI {
        rest - TAU
    } else if rest < -PI {
        rest + TAU
    } else {
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// What shadows may be off by, radians: .02°.
    const NEAR: f64 = 0.02 * PI / 180.0;

    fn date(year: i32, month: u32, day: u32) -> Date {
        Date::new(year, month, day).expect("a day of the calendar")
    }

    fn apart(a: &Direction, b: &Direction) -> f64 {
        let (a, b) = (a.towards(), b.towards());
        (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
    }

    #[test]
    fn the_worked_examples_of_fao_56() {
        // Examples 8 and 9: 20° S on 3 September.
        let day = date(1999, 9, 3).day_of_year();
        let south = -20_f64.to_radians();
        assert_eq!(day, 246);
        assert!((declination(day) - 0.120).abs() < 5e-4, "{}", declination(day));
        assert!((inverse_distance(day) - 0.985).abs() < 5e-4, "{}", inverse_distance(day));
        assert!((sunset_hour_angle(south, declination(day)) - 1.527).abs() < 5e-4);
        assert!((extraterrestrial_mj_m2(south, day) - 32.2).abs() < 0.05, "{}", extraterrestrial_mj_m2(south, day));
        assert!((day_length_h(south, day) - 11.7).abs() < 0.05, "{}", day_length_h(south, day));
    }

    #[test]
    fn beyond_the_polar_circle_the_sun_neither_sets_nor_rises() {
        let north = 70_f64.to_radians();
        assert_eq!((day_length_h(north, 172), day_length_h(-north, 172)), (24.0, 0.0));
        assert_eq!((day_length_h(north, 355), day_length_h(-north, 355)), (0.0, 24.0));
        assert_eq!((extraterrestrial_mj_m2(north, 355), extraterrestrial_mj_m2(-north, 172)), (0.0, 0.0));
        for day in 1..=366 {
            assert!((day_length_h(0.0, day) - 12.0).abs() < 1e-9);
            for latitude in [-FRAC_PI_2, -1.0, 0.3, FRAC_PI_2] {
                let both = day_length_h(latitude, day) + day_length_h(-latitude, day);
                assert!((both - 24.0).abs() < 1e-9, "what is day here is night on the other side: {both}");
                assert!(extraterrestrial_mj_m2(latitude, day) >= 0.0);
            }
        }
    }

    /// The radiation of a day is the solar constant times the sine of the sun's altitude, summed over the day.
    #[test]
    fn a_day_of_radiation_is_the_sum_of_its_moments() {
        for (latitude, day) in [(-0.35, 246), (0.8, 15), (1.2, 172), (1.3, 60)] {
            let delta = declination(day);
            let steps = 200_000;
            let moment = |i: i32| {
                let hour = (f64::from(i) + 0.5) * TAU / f64::from(steps) - PI;
                (sin(latitude) * sin(delta) + cos(latitude) * cos(delta) * cos(hour)).max(0.0)
            };
            let sum = (0..steps).map(moment).sum::<f64>() * 24.0 * 60.0 / f64::from(steps);
            let (sum, closed) = (sum * SOLAR_CONSTANT * inverse_distance(day), extraterrestrial_mj_m2(latitude, day));
            assert!((sum - closed).abs() < 1e-7 * closed, "{latitude} {day}: {sum} {closed}");
        }
    }

    /// Meeus 1998, table 27.E: equinoxes and solstices (dynamical time; a minute more or less is .0007°).
    #[test]
    fn the_seasons_begin_when_tables_say() {
        let tables = [
            (1996, [(20, 8, 4), (21, 2, 25), (22, 18, 1), (21, 14, 7)]),
            (1999, [(21, 1, 47), (21, 19, 50), (23, 11, 33), (22, 7, 45)]),
            (2000, [(20, 7, 36), (21, 1, 49), (22, 17, 29), (21, 13, 39)]),
            (2005, [(20, 12, 34), (21, 6, 47), (22, 22, 24), (21, 18, 36)]),
        ];
        for (year, seasons) in tables {
            for (quarter, (day, hour, minute)) in (0..4_u32).zip(seasons) {
                let hours = f64::from(hour) + f64::from(minute) / 60.0;
                let at = date(year, 3 * quarter + 3, day).since_j2000() + hours / 24.0;
                let off = half_turns(ecliptic_longitude(at) - f64::from(quarter) * FRAC_PI_2);
                assert!(off.abs() < NEAR, "{year}, {quarter}: {off}");
            }
        }
    }

    /// Reda & Andreas 2008 (NREL/TP-560-34302), table A5.1: Golden, Colorado, 17 October 2003, 12:30:30 at UT − 7 h;
    /// the altitude is that before refraction. And Meeus 1998, example 25.b: 13 October 1992, 0 h.
    #[test]
    fn the_sun_stands_where_published_examples_have_it() {
        let golden = Sun::at(date(2003, 10, 17), 19.0 + 30.5 / 60.0);
        let seen = golden.seen_from(39.742_476_f64.to_radians(), -105.178_6_f64.to_radians());
        let published = Direction { azimuth: 194.340_24_f64.to_radians(), altitude: 39.872_046_f64.to_radians() };
        assert!(apart(&seen, &published) < NEAR, "{seen:?}");
        let meeus = Sun::at(date(1992, 10, 13), 0.0);
        let ascension = (13.0 + 13.0 / 60.0 + 30.749 / 3600.0) * 15.0_f64;
        assert!((meeus.declination - -(7.0 + 47.0 / 60.0 + 1.74 / 3600.0_f64).to_radians()).abs() < NEAR);
        assert!(half_turns(meeus.right_ascension - ascension.to_radians()).abs() < NEAR);
    }

    /// Two dozen instants of 1900 to 2100 drawn at random over the earth: year, day of the year, hours UT, latitude,
    /// longitude, azimuth and altitude, degrees, by VSOP87 (PyEphem 4.2.1, without refraction).
    const BY_VSOP87: [(i32, u32, f64, f64, f64, f64, f64); 24] = [
        (1914, 47, 2.04, 59.7, 84.9, 115.1589, -0.3194),
        (2071, 158, 6.04, -51.2, -167.1, 274.5657, -26.0339),
        (2074, 82, 23.99, 24.6, 109.3, 96.1270, 16.5789),
        (2030, 191, 13.06, -9.8, -83.4, 63.5958, 15.3537),
        (1909, 15, 8.74, 76.9, 146.8, 270.3544, -21.8952),
        (2008, 270, 3.95, -57.4, -97.0, 219.8034, -24.7116),
        (1945, 167, 4.17, 1.8, -50.5, 24.1481, -62.3010),
        (2031, 346, 13.44, 88.1, -19.6, 183.5509, -21.1854),
        (2006, 269, 21.76, 46.8, 104.3, 78.3519, -12.7010),
        (1990, 186, 23.54, 82.2, -122.0, 232.8199, 27.6117),
        (2093, 205, 17.16, -6.9, 10.9, 289.8294, 0.8465),
        (2025, 143, 22.20, 0.1, 119.3, 69.2163, 2.9321),
        (1990, 339, 21.19, 71.1, -14.0, 297.7558, -32.5203),
        (2045, 286, 17.37, -2.4, -100.1, 110.2620, 73.0143),
        (1983, 359, 20.04, 67.1, 41.9, 337.0422, -44.9430),
        (2097, 246, 7.43, 81.4, 74.2, 186.0176, 15.7507),
        (2029, 288, 12.43, 27.0, 31.7, 234.4446, 36.0407),
        (1979, 107, 11.73, -23.7, 66.3, 291.7886, 20.2427),
        (1919, 175, 17.42, 72.6, -111.1, 143.9871, 38.0473),
        (2090, 55, 1.41, 27.2, -81.7, 273.5391, -27.4822),
        (1958, 350, 21.01, -70.1, 8.1, 212.6369, 6.7962),
        (1968, 126, 19.79, 79.0, -158.3, 136.6321, 24.6330),
        (2083, 17, 1.50, -24.9, -90.2, 242.6687, -7.9829),
        (1906, 43, 2.77, -77.0, -165.3, 303.9428, 21.6205),
    ];

    #[test]
    fn the_sun_stands_where_vsop87_has_it() {
        for (year, day, hours, latitude, longitude, azimuth, altitude) in BY_VSOP87 {
            let sun = Sun::at(Date::of_year(year, day).expect("a day"), hours);
            let seen = sun.seen_from(latitude.to_radians(), longitude.to_radians());
            let known = Direction { azimuth: azimuth.to_radians(), altitude: altitude.to_radians() };
            assert!(apart(&seen, &known) < NEAR, "{year}, {day}, {hours} h: {seen:?}, not {known:?}");
        }
    }

    #[test]
    fn solar_noon_is_in_the_meridian_and_the_vector_points_there() {
        for month in 1..=12 {
            for longitude in [-PI, -1.5, 0.0, 0.1, 3.0] {
                let noon = Sun::at_solar_time(date(2024, month, 11), 12.0, longitude);
                assert!(noon.hour_angle(longitude).abs() < 1e-6);
                let (high, low) = (noon.seen_from(0.9, longitude), noon.seen_from(-0.9, longitude));
                assert!((high.azimuth - PI).abs() < 1e-5, "north of the tropics the sun is in the south: {high:?}");
                assert!(low.azimuth.min(TAU - low.azimuth) < 1e-5, "and south of them in the north: {low:?}");
                assert!((high.altitude - (FRAC_PI_2 - 0.9 + noon.declination)).abs() < 1e-6);
                let morning = Sun::at_solar_time(date(2024, month, 11), 7.0, longitude);
                assert!((morning.hour_angle(longitude) + 5.0 * PI / 12.0).abs() < 1e-6);
                let [east, _, up] = morning.seen_from(0.2, longitude).towards();
                assert!(east > 0.85 && up > 0.1, "an hour after sunrise");
            }
        }
    }
}
