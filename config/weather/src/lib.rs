//! Weather files as people have them, read as they are: DSSAT `.WTH`, AgMIP `.AgMIP`, APSIM `.met`, and CSV with the
//! codes of the ICASA dictionary.
//!
//! [`read`] takes the bytes of a file and gives its days as [`Weather`], or every [`Fault`] with its line and column. A
//! value is read right or told: where it cannot be known which column a number stands in, the row is a fault and no
//! guess. Gaps are filled on request alone, and what was filled is noted. Days follow one another without a gap in what
//! is given back, in °C, mm, MJ/m², m/s and Pa, angles in radians. `docs/weather.md` tells of the formats. Absent:
//! paths and files, which the caller has; hours; what plants make of the weather.
//!
//! ```
//! use phytomer_weather::{Asked, read};
//!
//! let text = b"@DATE  SRAD  TMAX  TMIN  RAIN\n01001  12.0  25.0   5.0   0.0\n01002  13.0  24.0   6.0   1.5\n";
//! let weather = read("station.WTH", text, &Asked::default()).unwrap();
//! assert_eq!((weather.days().len(), weather.first().to_string()), (2, "2001-01-01".to_owned()));
//! ```

mod asked;
mod csv;
mod dates;
mod dssat;
mod fault;
mod met;
mod named;
mod names;
mod number;
mod quantity;
mod reading;
mod rows;
mod series;
mod station;
mod text;
mod weather;

pub use asked::{Asked, Beyond, DegreeDays, Format, Gaps, Method, WeatherFile, Years, YearsWord};
pub use fault::{Fault, Kind, MOST_FAULTS, Refused};
pub use quantity::Quantity;
pub use reading::{read, read_text};
pub use text::decode;
pub use weather::{Absent, Day, Filled, LeftOut, Notes, Station, Weather};
