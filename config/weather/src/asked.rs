//! What a scenario says of its weather and its degree-days: the keys, as serde and the JSON Schema know them.
//!
//! Only what is stated changes a file: without `gaps` nothing is filled, without `beyond` the weather ends with its
//! file. The method of degree-days has no default, since methods differ by a fifth. Absent: finding the file, and the
//! place of a key in its scenario; a fault names the key by its path.

use crate::weather::Station;
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::site::degree_days;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The weather of a site: `[weather]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WeatherFile {
    /// The file, as seen from this one: DSSAT `.WTH`, AgMIP `.AgMIP`, APSIM `.met`, or `.csv` with ICASA codes.
    #[schemars(length(min = 1))]
    pub file: String,
    /// How the file is written. By its ending if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<Format>,
    /// What is done about days without a temperature. They are faults if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gaps: Option<Gaps>,
    /// What the weather is beyond the days of the file. `"refuse"` if not given.
    #[serde(default)]
    pub beyond: Beyond,
    /// The years in which the replicates of an experiment grow: `"replicates"`, the first in that of `planting_date`
    /// and each other one a year later, or a list of years, one for each replicate. All in the same year if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub years: Option<Years>,
    /// The latitude of the site in degrees, north positive. That of the file if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -90, max = 90))]
    pub latitude_deg: Option<f64>,
    /// The longitude of the site in degrees, east positive. That of the file if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -180, max = 180))]
    pub longitude_deg: Option<f64>,
    /// The height of the site above the sea, metres. That of the file if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -500, max = 9000))]
    pub elevation_m: Option<f64>,
}

/// How a weather file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Format {
    /// DSSAT's `.WTH`.
    Dssat,
    /// AgMIP's `.AgMIP`, with the wind in m/s.
    Agmip,
    /// APSIM's `.met`.
    Apsim,
    /// A table with a separator, its columns by ICASA codes.
    Csv,
}

/// What is done about days without a temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gaps {
    /// So many days in a row are filled at most, on the straight line between the days around them.
    #[schemars(range(min = 1, max = 31))]
    pub interpolate_days: u32,
}

/// What the weather is beyond the days of its file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Beyond {
    /// There is none: a run that asks for it is at fault.
    #[default]
    Refuse,
    /// That of the same day of an earlier or a later year of the file, which must hold a whole year.
    Repeat,
}

/// The years in which the replicates of an experiment grow.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Years {
    /// Each replicate a year after the one before, by the word `replicates`.
    Word(YearsWord),
    /// The year of planting of each replicate.
    List(#[schemars(length(min = 1), inner(range(min = 1700, max = 2200)))] Vec<i32>),
}

/// The word for years.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum YearsWord {
    /// Each replicate a year after the one before.
    Replicates,
}

/// Degree-days: `degree_days = { method = "sine", base_celsius = 10 }`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DegreeDays {
    /// How a day's extremes are taken together.
    pub method: Method,
    /// The temperature below which nothing develops, °C.
    #[schemars(range(min = -50, max = 60))]
    pub base_celsius: f64,
    /// The temperature above which nothing more is gained, °C. None if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -50, max = 60))]
    pub upper_limit_celsius: Option<f64>,
}

/// How a day's extremes are taken together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The mean less the base (McMaster & Wilhelm 1997, method 1).
    Average,
    /// Each extreme at least the base, then their mean less the base (their method 2).
    Thresholded,
    /// The area between a sine wave and the base (Baskerville & Emin 1969).
    Sine,
}

/// What a reader must know beside the text.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Asked {
    /// How the file is written; by its ending if `None`.
    pub format: Option<Format>,
    /// The most days in a row that are filled.
    pub interpolate_days: u32,
    /// What the weather is beyond the file.
    pub beyond: Beyond,
}

impl WeatherFile {
    /// What the reader of the file must know.
    pub fn asked(&self) -> Asked {
        let interpolate_days = self.gaps.map_or(0, |gaps| gaps.interpolate_days);
        Asked { format: self.format, interpolate_days, beyond: self.beyond }
    }

    /// The station with what is stated of its place; the rest is as its file has it.
    pub fn placed(&self, station: Station) -> Station {
        Station {
            latitude: self.latitude_deg.map(f64::to_radians).or(station.latitude),
            longitude: self.longitude_deg.map(f64::to_radians).or(station.longitude),
            elevation_m: self.elevation_m.or(station.elevation_m),
            ..station
        }
    }
}

impl Format {
    /// The format of a file by the ending of its name.
    pub fn of_name(name: &str) -> Option<Self> {
        let ending = name.rsplit_once('.')?.1.to_ascii_lowercase();
        match ending.as_str() {
            "wth" => Some(Self::Dssat),
            "agmip" => Some(Self::Agmip),
            "met" => Some(Self::Apsim),
            "csv" | "tsv" => Some(Self::Csv),
            _ => None,
        }
    }
}

impl DegreeDays {
    /// What no schema can say: a limit that leaves no room above the base.
    pub fn faults(&self, path: &Path) -> Vec<Fault> {
        let base = self.base_celsius;
        let limit = self.upper_limit_celsius.filter(|limit| *limit <= base);
        let told = limit.map(|limit| {
            let problem = format!("the limit of {limit} °C is not above the base of {base} °C");
            Fault::new(&path.key("upper_limit_celsius"), problem, format!("a temperature above {base} °C"))
        });
        Vec::from_iter(told)
    }

    /// The sum as the site makes it.
    pub fn felt(&self) -> degree_days::DegreeDays {
        let method = match self.method {
            Method::Average => degree_days::Method::Average,
            Method::Thresholded => degree_days::Method::Thresholded,
            Method::Sine => degree_days::Method::Sine,
        };
        degree_days::DegreeDays { method, base: self.base_celsius, upper: self.upper_limit_celsius }
    }
}
