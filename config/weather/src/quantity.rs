//! What a weather file measures: the quantities that are kept, in which unit, and what a station can have measured.
//!
//! The bounds are records of the World Meteorological Organization, rounded outwards: −89.2 and 56.7 °C, 1,825 mm of
//! rain in a day, a gust of 113 m/s; the radiation is that above the atmosphere at most (48 MJ/m² at the south pole). A
//! value beyond them is a slip (99.9 °C). Absent: whether a value fits its station and season.

/// What is measured a day.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The highest temperature of the air, °C.
    Maximum,
    /// The lowest temperature of the air, °C.
    Minimum,
    /// Rain, mm.
    Rain,
    /// Solar radiation on level ground, MJ/m².
    Radiation,
    /// The mean speed of the wind, m/s.
    Wind,
    /// The temperature at which the air's vapour condenses, °C.
    DewPoint,
    /// The pressure of water vapour, Pa.
    VapourPressure,
    /// The relative humidity, from 0 to 1.
    Humidity,
}

/// The number of quantities.
pub(crate) const QUANTITIES: usize = 8;

/// A value of each quantity, where it was measured: in memory that is not a number where it was not, and nothing but
/// these functions sees that.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Values([f64; QUANTITIES]);

impl Default for Values {
    fn default() -> Self {
        Self([f64::NAN; QUANTITIES])
    }
}

impl Values {
    /// The value of a quantity.
    #[inline]
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        Some(self.0[quantity as usize]).filter(|value| !value.is_nan())
    }

    /// Sets the value of a quantity.
    #[inline]
    pub fn set(&mut self, quantity: Quantity, value: Option<f64>) {
        self.0[quantity as usize] = value.unwrap_or(f64::NAN);
    }

    /// Whether both temperatures were measured.
    #[inline]
    pub fn are_whole(&self) -> bool {
        self.get(Quantity::Maximum).is_some() && self.get(Quantity::Minimum).is_some()
    }
}

impl Quantity {
    /// All of them, in the order in which they are kept.
    pub const ALL: [Self; QUANTITIES] = [
        Self::Maximum,
        Self::Minimum,
        Self::Rain,
        Self::Radiation,
        Self::Wind,
        Self::DewPoint,
        Self::VapourPressure,
        Self::Humidity,
    ];

    /// What messages and notes call it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Maximum => "maximum temperature",
            Self::Minimum => "minimum temperature",
            Self::Rain => "rain",
            Self::Radiation => "solar radiation",
            Self::Wind => "wind",
            Self::DewPoint => "dew point",
            Self::VapourPressure => "vapour pressure",
            Self::Humidity => "relative humidity",
        }
    }

    /// Whether a plant's development and the light and water that it has can be told without it.
    pub(crate) fn is_minor(self) -> bool {
        matches!(self, Self::Wind | Self::DewPoint | Self::VapourPressure | Self::Humidity)
    }

    /// The least and the most that can be, in the unit that is kept.
    fn bounds(self) -> (f64, f64) {
        match self {
            Self::Maximum | Self::Minimum => (-90.0, 60.0),
            Self::Rain => (0.0, 2000.0),
            Self::Radiation => (0.0, 50.0),
            Self::Wind => (0.0, 115.0),
            Self::DewPoint => (-100.0, 40.0),
            Self::VapourPressure => (0.0, 10_000.0),
            // A wet sensor says a little more than all.
            Self::Humidity => (0.0, 1.05),
        }
    }
}

/// A quantity in the unit of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Measure {
    /// What is measured.
    pub quantity: Quantity,
    /// What a value of the file is multiplied by, to be in the unit that is kept.
    pub factor: f64,
    /// The unit of the file.
    pub unit: &'static str,
}

impl Measure {
    /// The value in the unit that is kept; `None` where no station can have measured it.
    #[inline]
    pub fn kept(&self, value: f64) -> Option<f64> {
        let (least, most) = self.quantity.bounds();
        let kept = if self.factor == 1.0 { value } else { value * self.factor };
        (kept >= least && kept <= most).then_some(kept)
    }

    /// What can be measured, in the unit of the file.
    pub fn range(&self) -> String {
        let (least, most) = self.quantity.bounds();
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        format!("[{}, {}]{unit}", rounded(least / self.factor), rounded(most / self.factor))
    }
}

fn rounded(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}
