//! The weather files that ship: mean years of two regions of mango orchards, made of monthly normals.
//!
//! `cargo run --example weather_of_normals [FOLDER]` writes them into a folder, `config/presets/weather` if none is
//! given; `tests/trials` holds the files there to what this makes. Days lie on the smooth curve whose monthly means are
//! the normals, by the algorithm of Rymes & Myers 2001 (*Solar Energy* 71: 225–231): every day begins with the normal
//! of its month; then 365 times each day becomes the mean of itself and its two neighbours, around the turn of the
//! year too, and each month is shifted by what its mean has lost. Additions and divisions alone make the same bytes
//! everywhere. Absent: days of rain, wind and radiation, and the spells that make one year unlike another.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

/// The days of the months of a common year.
pub const MONTHS: [usize; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// The days of a common year.
const DAYS: usize = 365;

/// A station with its monthly normals.
pub struct Station {
    /// The name of its file.
    pub file: &'static str,
    /// The lines that tell what it is and where its normals were found.
    about: &'static [&'static str],
    /// Latitude and longitude, degrees.
    place: [f64; 2],
    /// Mean daily maximum of each month, °C.
    pub highs: [f64; 12],
    /// Mean daily minimum of each month, °C.
    pub lows: [f64; 12],
    /// Mean rain of each month, mm, which the header tells and no day has.
    rain: [f64; 12],
}

/// The stations.
pub const STATIONS: [Station; 2] = [
    Station {
        file: "humpty_doo.csv",
        about: &[
            "Humpty Doo, Northern Territory, Australia: wet and dry tropics, one of the mango districts around Darwin.",
            "Normals of the Bureau of Meteorology, station Middle Point, all years,",
            "as read at https://liquisearch.com/humpty_doo/climate. The place is that of the town, to .1 degrees.",
        ],
        place: [-12.6, 131.1],
        highs: [32.6, 32.0, 32.4, 33.1, 32.5, 31.3, 31.3, 32.9, 34.7, 35.6, 35.1, 33.8],
        lows: [23.8, 23.9, 23.6, 22.1, 19.4, 16.1, 14.9, 16.8, 20.1, 22.7, 23.7, 23.9],
        rain: [332.6, 284.0, 254.7, 88.4, 22.0, 1.6, 0.8, 2.4, 12.9, 57.4, 125.8, 228.6],
    },
    Station {
        file: "rockhampton.csv",
        about: &[
            "Rockhampton, Queensland, Australia: subtropics with a cool, dry winter, mango orchards along the coast.",
            "Normals of the Bureau of Meteorology, station Rockhampton Airport, all years: temperatures as read at",
            "https://www.liquisearch.com/rockhampton/climate, rain as read at",
            "https://www.liverockhampton.com.au/regional-weather/statistics/. The place is that of the town, to .1",
            "degrees.",
        ],
        place: [-23.4, 150.5],
        highs: [31.9, 31.2, 30.5, 28.8, 26.0, 23.5, 23.1, 24.8, 27.3, 29.6, 31.2, 32.1],
        lows: [22.1, 22.1, 20.8, 17.9, 14.2, 10.9, 9.5, 10.7, 13.6, 17.0, 19.5, 21.2],
        rain: [127.0, 143.0, 95.0, 44.0, 48.0, 39.0, 29.0, 27.0, 23.0, 50.0, 69.0, 101.0],
    },
];

/// What all files say of themselves.
const METHOD: [&str; 3] = [
    "Days lie on the smooth curve whose monthly means are the normals (Rymes & Myers 2001, Solar Energy 71: 225-231);",
    "the year of the dates has no meaning. `cargo run --example weather_of_normals` makes this file again.",
    "The normals, degrees Celsius and mm, from January to December:",
];

fn main() -> io::Result<()> {
    let folder = env::args().nth(1).unwrap_or_else(|| "config/presets/weather".to_owned());
    for station in &STATIONS {
        fs::write(PathBuf::from(&folder).join(station.file), station.csv())?;
    }
    Ok(())
}

impl Station {
    /// The weather file: a header of comments, the names of the columns, and the days of a common year.
    pub fn csv(&self) -> String {
        let mut text = String::new();
        let mut tell = |line: &str| {
            let _ = writeln!(text, "# {line}");
        };
        tell("A mean year, made of monthly normals and not measured.");
        self.about.iter().chain(&METHOD).for_each(|line| tell(line));
        for (what, normals) in [("maximum", &self.highs), ("minimum", &self.lows), ("rain", &self.rain)] {
            let row = normals.iter().fold(format!("{what:<8}"), |row, normal| format!("{row} {normal:5.1}"));
            tell(&row);
        }
        text += "WST_LAT,WST_LONG,W_DATE,TMAX,TMIN\n";
        let [latitude, longitude] = self.place;
        let (highs, lows) = (days_of(&self.highs), days_of(&self.lows));
        for (day, (high, low)) in highs.iter().zip(&lows).enumerate() {
            let (month, of_month) = date(day);
            let at = format!("{latitude:.1},{longitude:.1},2001-{month:02}-{of_month:02}");
            let _ = writeln!(text, "{at},{high:.1},{low:.1}");
        }
        text
    }
}

/// The days of a common year on the smooth curve whose monthly means are these.
pub fn days_of(normals: &[f64; 12]) -> Vec<f64> {
    let mut days: Vec<f64> = (0..DAYS).map(|day| normals[date(day).0 - 1]).collect();
    for _ in 0..DAYS {
        let before = days.clone();
        for day in 0..DAYS {
            days[day] = (before[(day + DAYS - 1) % DAYS] + before[day] + before[(day + 1) % DAYS]) / 3.0;
        }
        let mut first = 0;
        for (normal, length) in normals.iter().zip(MONTHS) {
            let month = &mut days[first..first + length];
            let lost = normal - month.iter().sum::<f64>() / length as f64;
            month.iter_mut().for_each(|day| *day += lost);
            first += length;
        }
    }
    days
}

/// The month and the day of the month, both from 1, of a day of a common year, from 0.
fn date(day: usize) -> (usize, usize) {
    let mut of_month = day;
    for (month, length) in (1..).zip(MONTHS) {
        if of_month < length {
            return (month, of_month + 1);
        }
        of_month -= length;
    }
    (12, 31)
}
