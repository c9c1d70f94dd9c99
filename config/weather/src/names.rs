//! What a column of a weather file is called in each format, and in which unit it then is.
//!
//! DSSAT's codes are those of its `WEATHER.CDE`; `.AgMIP` files have the same codes with the wind in m/s and the
//! pressure of vapour in hPa (agmip translators, which multiply by 86.4 and divide by 10 on the way to the database).
//! CSV files have the codes of the ICASA dictionary (`W_DATE`, `TDEW`, `VPRSD` in kPa, `RHAVD`, wind in km/d; White et
//! al. 2013, *Computers and Electronics in Agriculture* 96: 1–12) or words. APSIM's are those of its weather component.
//! Case, hyphens and blanks make no difference. Absent: columns that nobody asks for, which are passed over and noted.

use crate::asked::Format;
use crate::quantity::{Measure, Quantity};
use phytomer_law::spelling::nearest;

/// More columns than this no table of weather has.
pub(crate) const MOST_COLUMNS: usize = 200;

/// What a column is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Column {
    /// The whole date.
    Date,
    /// The year.
    Year,
    /// The month, 1 to 12.
    Month,
    /// The day of the month.
    DayOfMonth,
    /// The day of the year.
    DayOfYear,
    /// A quantity.
    Of(Measure),
    /// Degrees north.
    Latitude,
    /// Degrees east.
    Longitude,
    /// Metres above the sea.
    Elevation,
    /// The station, by a name or a code.
    Station,
    /// Anything else.
    Unused,
}

/// Seconds of a day over metres of a kilometre: km/d are so many m/s.
const KM_A_DAY: f64 = 1000.0 / 86_400.0;

/// What the column of a name is. A name that says nothing is [`Column::Unused`].
pub(crate) fn column(format: Format, name: &str) -> Column {
    let name = folded(name);
    let of = |quantity, factor, unit| Column::Of(Measure { quantity, factor, unit });
    let (wind, vapour) = match format {
        Format::Dssat | Format::Csv => ((KM_A_DAY, "km/d"), (1000.0, "kPa")),
        Format::Agmip | Format::Apsim => ((1.0, "m/s"), (100.0, "hPa")),
    };
    match name.as_str() {
        "date" | "w_date" | "weather_date" => Column::Date,
        "year" | "yyyy" => Column::Year,
        "month" | "mm" => Column::Month,
        "day" if format == Format::Apsim => Column::DayOfYear,
        "day" | "dd" | "day_of_month" => Column::DayOfMonth,
        "doy" | "day_of_year" => Column::DayOfYear,
        "tmax" | "maxt" | "maximum_temperature" | "temperature_maximum" => of(Quantity::Maximum, 1.0, "°C"),
        "tmin" | "mint" | "minimum_temperature" | "temperature_minimum" => of(Quantity::Minimum, 1.0, "°C"),
        "rain" | "rainfall" | "precipitation" => of(Quantity::Rain, 1.0, "mm"),
        "srad" | "radn" | "solar_radiation" => of(Quantity::Radiation, 1.0, "MJ/m²"),
        "wind" | "wind_speed" => of(Quantity::Wind, wind.0, wind.1),
        "dewp" | "tdew" | "dewpoint_temperature" | "temperature_dewpoint" => of(Quantity::DewPoint, 1.0, "°C"),
        "vprs" | "vapr" | "vprsd" | "vp" | "vapor_pressure" => of(Quantity::VapourPressure, vapour.0, vapour.1),
        "rhum" | "rhumd" | "rhavd" | "rh" | "relative_humidity" => of(Quantity::Humidity, 0.01, "%"),
        "lat" | "latitude" | "wst_lat" => Column::Latitude,
        "long" | "longitud" | "longitude" | "wst_long" => Column::Longitude,
        "elev" | "elevation" | "wst_elev" => Column::Elevation,
        "insi" | "site" | "wst_id" | "station" | "weather_station_id" => Column::Station,
        _ => Column::Unused,
    }
}

fn folded(name: &str) -> String {
    name.trim().trim_end_matches('.').to_lowercase().replace(['-', ' '], "_")
}

/// The unit of APSIM's files as they may write it, folded; none where any is taken.
pub(crate) fn unit_is_known(column: Column, unit: &str) -> bool {
    let unit: String = unit.chars().filter(|c| !c.is_whitespace() && *c != '^').collect::<String>().to_lowercase();
    let Column::Of(Measure { quantity, .. }) = column else { return true };
    let known: &[&str] = match quantity {
        Quantity::Maximum | Quantity::Minimum | Quantity::DewPoint => &["oc", "°c", "c", "degc", "deg_c", "celsius"],
        Quantity::Rain => &["mm", "mm/d", "mm/day"],
        Quantity::Radiation => &["mj/m2", "mj/m²", "mj/m2/d", "mj/m2/day", "mj/m²/d", "mj"],
        Quantity::Wind => &["m/s", "ms-1"],
        Quantity::VapourPressure => &["hpa", "mb", "mbar"],
        Quantity::Humidity => &["%"],
    };
    unit.is_empty() || known.contains(&unit.as_str())
}

/// What is told where a table has no column for a temperature: the problem, and what was expected, with the name that
/// was most likely meant. `has` tells which there are, `unused` are the names that say nothing.
pub(crate) fn lacking<'n>(
    format: Format,
    has: impl Fn(Quantity) -> bool,
    unused: impl Iterator<Item = &'n str> + Clone,
) -> Vec<(String, String)> {
    let codes = match format {
        Format::Apsim => [("maxt", Quantity::Maximum), ("mint", Quantity::Minimum)],
        _ => [("TMAX", Quantity::Maximum), ("TMIN", Quantity::Minimum)],
    };
    let told = |(code, quantity): (&str, Quantity)| {
        let meant = unused.clone().find(|name| nearest(code, [name.to_lowercase().as_str()]).is_some());
        let expected = meant.map_or_else(|| format!("a column `{code}`"), |near| format!("`{code}` for `{near}`"));
        (format!("there is no column for the {}", quantity.words()), expected)
    };
    codes.into_iter().filter(|(_, quantity)| !has(*quantity)).map(told).collect()
}
