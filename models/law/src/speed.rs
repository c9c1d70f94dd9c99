//! The growth speed of an order as it is written, and compiled: an exact ratio, or several ratios of which each axis
//! draws one (de Reffye et al. 1988 §3, Fig. 14).
//!
//! A drawn speed is one of the ratios that are listed, so that the clock of each axis stays exactly rational. Absent on
//! purpose: continuous distributions of speeds, whose draws would be no ratios; and the clock itself (`sim::clock`).

use std::collections::BTreeMap;

use phytomer_sim::clock::Speed;
use phytomer_sim::site::calendar::{Dates, TickLength};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::count_table::CountTable;
use super::form::{check_intervals, one_kind};
use crate::fault::{Fault, Path};

/// The most clock steps that an axis may make a tick.
const FASTEST: f64 = 64.0;
/// The most ratios that may be listed.
const MOST_RATIOS: usize = 64;

/// A growth speed, clock steps per tick. Written bare as a whole number, a decimal number or a ratio in quotes such
/// as "2/3", or as a table with its source, with `value`, with `empirical`: `{ empirical = ["1/2", "2/3"], weights =
/// [1, 2] }`, or with `phyllochron_degree_days`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Speeds {
    /// The same speed for every axis.
    Text(SpeedText),
    /// A table with `value`, `empirical` or `phyllochron_degree_days`.
    Form(Box<SpeedForm>),
}

/// One speed, or several of which each axis draws one at its birth, and where they come from.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(inline, extend("minProperties" = 1))]
pub struct SpeedForm {
    /// The same speed for every axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "SpeedText")]
    pub value: Option<SpeedText>,
    /// The speeds of which each axis draws one; equally often, where no weights are given. A speed in between is none
    /// of them: the clock of an axis stays exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<SpeedText>")]
    pub empirical: Option<Vec<SpeedText>>,
    /// The degree-days from one clock step to the next, °C d, for ticks that are sums of degree-days: the speed is
    /// the sum of a tick by this number.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub phyllochron_degree_days: Option<f64>,
    /// The weight of each of these speeds, as observed; they need not sum to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<f64>")]
    pub weights: Option<Vec<f64>>,
    /// Where the numbers come from: a reference, a data set, an observation.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub source: Option<String>,
    /// The interval of 95 % of each number that was estimated, by the number's name: `interval = { value = [0.5, 0.6]
    /// }`. It documents the speed; growth does not read it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub interval: BTreeMap<String, [f64; 2]>,
    /// How many observations the numbers were estimated from. It documents the speed; growth does not read it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32")]
    pub n: Option<u32>,
    /// True where the numbers are a guess and not a measure.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub assumed: bool,
}

/// A growth speed: a whole number, a decimal number, or a ratio in quotes such as "2/3".
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum SpeedText {
    /// Steps per tick.
    Whole(u32),
    /// Steps per tick, as a decimal number of at most six digits.
    Decimal(f64),
    /// "steps/ticks".
    Ratio(String),
}

impl Default for Speeds {
    fn default() -> Self {
        Self::Text(SpeedText::Whole(1))
    }
}

impl From<SpeedText> for Speeds {
    fn from(text: SpeedText) -> Self {
        Self::Text(text)
    }
}

impl From<SpeedForm> for Speeds {
    fn from(form: SpeedForm) -> Self {
        Self::Form(Box::new(form))
    }
}

/// The speeds of an order, compiled: distinct ratios, and which of them an axis draws.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedTable {
    speeds: Vec<Speed>,
    /// The place in `speeds` that an axis draws.
    pick: CountTable,
}

impl Speeds {
    /// Reads every ratio exactly and compiles the draw, or fails with every fault found.
    pub fn compile(&self, path: &Path) -> Result<SpeedTable, Vec<Fault>> {
        self.compile_dated(path, None)
    }

    /// As [`Speeds::compile`], for a plant whose ages have these dates: where a tick is a sum of degree-days the
    /// speed may be stated as a phyllochron.
    pub fn compile_dated(&self, path: &Path, dates: Option<&Dates>) -> Result<SpeedTable, Vec<Fault>> {
        let form = match self {
            Self::Text(text) => return Ok(SpeedTable::always(exact(text, path).map_err(|fault| vec![fault])?)),
            Self::Form(form) => form,
        };
        let kinds = [
            ("value", form.value.is_some()),
            ("empirical", form.empirical.is_some()),
            ("phyllochron_degree_days", form.phyllochron_degree_days.is_some()),
        ];
        one_kind(&kinds, path).and_then(|()| check_intervals(&form.interval, path)).map_err(|fault| vec![fault])?;
        form.check_weights(path)?;
        if let Some(phyllochron) = form.phyllochron_degree_days {
            let speed = of_phyllochron(phyllochron, dates, &path.key("phyllochron_degree_days"));
            return Ok(SpeedTable::always(speed.map_err(|fault| vec![fault])?));
        }
        match (&form.value, &form.empirical) {
            (Some(text), _) => Ok(SpeedTable::always(exact(text, &path.key("value")).map_err(|fault| vec![fault])?)),
            (None, texts) => form.table(texts.as_deref().unwrap_or_default(), path),
        }
    }
}

impl SpeedForm {
    /// A fault unless the number of weights is the number of ratios.
    fn check_weights(&self, path: &Path) -> Result<(), Vec<Fault>> {
        let ratios = self.empirical.as_ref().map_or(0, Vec::len);
        let fault = |key, problem: String, expected: String| Err(vec![Fault::new(&path.key(key), problem, expected)]);
        match &self.weights {
            _ if self.empirical.is_some() && !(1..=MOST_RATIOS).contains(&ratios) => {
                fault("empirical", format!("there are {ratios} speeds"), format!("from 1 to {MOST_RATIOS} speeds"))
            }
            Some(_) if self.empirical.is_none() => fault(
                "weights",
                "weights are given, but no speeds to draw from".to_owned(),
                "`empirical` beside them".to_owned(),
            ),
            Some(weights) if weights.len() != ratios => {
                let problem = format!("{} weights for {ratios} speeds", weights.len());
                fault("weights", problem, "one weight for each speed".to_owned())
            }
            _ => Ok(()),
        }
    }

    /// The table of the ratios in `texts`. Equal ratios are merged and their weights added; a ratio of weight 0 is left
    /// out.
    fn table(&self, texts: &[SpeedText], path: &Path) -> Result<SpeedTable, Vec<Fault>> {
        let mut faults = Vec::new();
        let equal = vec![1.0; texts.len()];
        let stated = self.weights.as_deref().unwrap_or(&equal);
        faults.extend(CountTable::of_weights(stated, &path.key("weights")).err().into_iter().flatten());
        let (mut speeds, mut weights): (Vec<Speed>, Vec<f64>) = (Vec::new(), Vec::new());
        for (place, (text, &weight)) in texts.iter().zip(stated).enumerate() {
            match exact(text, &path.key("empirical").index(place)) {
                Err(fault) => faults.push(fault),
                Ok(_) if weight == 0.0 => {}
                Ok(speed) => match speeds.iter().position(|known| *known == speed) {
                    Some(known) => weights[known] += weight,
                    None => {
                        speeds.push(speed);
                        weights.push(weight);
                    }
                },
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        Ok(SpeedTable { speeds, pick: CountTable::of_weights(&weights, &path.key("weights"))? })
    }
}

impl SpeedTable {
    /// One speed for every axis.
    pub fn always(speed: Speed) -> Self {
        Self { speeds: vec![speed], pick: CountTable::always(0) }
    }

    /// The speeds, and the count that draws a place among them for an axis.
    pub fn into_parts(self) -> (Vec<Speed>, CountTable) {
        (self.speeds, self.pick)
    }

    /// The most clock steps that an axis can make in `ticks`.
    pub fn most_steps_by(&self, ticks: u32) -> u32 {
        self.speeds.iter().map(|speed| speed.steps_by(ticks)).max().unwrap_or(0)
    }
}

/// The exact ratio of a speed, at most 64.
fn exact(text: &SpeedText, path: &Path) -> Result<Speed, Fault> {
    parse(text).filter(|speed| speed.ratio() <= FASTEST).ok_or_else(|| {
        let expected = "a positive number or ratio of clock steps per tick such as 1, 0.5 or \"2/3\", at most 64";
        Fault::new(path, format!("the speed is {}", in_words(text)), expected)
    })
}

/// The clock steps a tick of an axis that makes a step each `phyllochron` °C d.
fn of_phyllochron(phyllochron: f64, dates: Option<&Dates>, path: &Path) -> Result<Speed, Fault> {
    let Some(TickLength::DegreeDays(tick)) = dates.map(|dates| dates.calendar.tick_length()) else {
        let problem = "the speed is a phyllochron, and a tick is no sum of degree-days";
        let expected = "a scenario whose `calendar.tick` is `{ degree_days = … }`, or a speed in clock steps per tick";
        return Err(Fault::new(path, problem, expected));
    };
    let speed = match (decimal_parts(tick), decimal_parts(phyllochron)) {
        (Some((tick, of_tick)), Some((step, of_step))) => ratio(tick * of_step, step * of_tick),
        _ => None,
    };
    speed.filter(|speed| speed.ratio() <= FASTEST).ok_or_else(|| {
        let problem = format!("a phyllochron of {phyllochron} °C d in ticks of {tick} °C d is no speed");
        Fault::new(path, problem, "a positive number with few digits, at least a 64th of a tick")
    })
}

/// The ratio of two whole numbers, in lowest terms; `None` where it does not fit.
fn ratio(steps: u64, ticks: u64) -> Option<Speed> {
    let (mut a, mut b) = (steps, ticks);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    Speed::new(u32::try_from(steps / a.max(1)).ok()?, u32::try_from(ticks / a.max(1)).ok()?)
}

fn in_words(text: &SpeedText) -> String {
    match text {
        SpeedText::Whole(steps) => steps.to_string(),
        SpeedText::Decimal(steps) => steps.to_string(),
        SpeedText::Ratio(ratio) => format!("\"{ratio}\""),
    }
}

/// The speed as an exact ratio; a decimal number is read as the decimal fraction that was typed.
fn parse(text: &SpeedText) -> Option<Speed> {
    match text {
        SpeedText::Whole(steps) => Speed::new(*steps, 1),
        SpeedText::Decimal(steps) => decimal(*steps),
        SpeedText::Ratio(ratio) => {
            let (steps, ticks) = ratio.split_once('/').unwrap_or((ratio, "1"));
            Speed::new(steps.trim().parse().ok()?, ticks.trim().parse().ok()?)
        }
    }
}

fn decimal(steps: f64) -> Option<Speed> {
    let (whole, scale) = decimal_parts(steps)?;
    Speed::new(u32::try_from(whole).ok()?, u32::try_from(scale).ok()?)
}

/// A decimal number of at most six digits after the point as a whole number and a power of ten.
fn decimal_parts(number: f64) -> Option<(u64, u64)> {
    let digits = (0..=6).find_map(|digits| {
        let scale = f64::from(10_u32.pow(digits));
        let scaled = number * scale;
        let whole = scaled.round();
        ((scaled - whole).abs() < 1e-9 * scale).then_some((whole, 10_u64.pow(digits)))
    });
    let (whole, scale) = digits?;
    let fits = (1.0..=1e12).contains(&whole);
    if fits { Some((whole as u64, scale)) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(text: &str) -> SpeedText {
        SpeedText::Ratio(text.to_owned())
    }

    #[test]
    fn a_speed_is_exact_however_it_is_typed() {
        let two_thirds = Speed::new(2, 3);
        assert_eq!(parse(&ratio("2/3")), two_thirds);
        assert_eq!(parse(&ratio(" 4 / 6 ")), two_thirds);
        assert_eq!(parse(&SpeedText::Decimal(0.3)), Speed::new(3, 10));
        assert_eq!(parse(&SpeedText::Decimal(1.5)), Speed::new(3, 2));
        assert_eq!(parse(&SpeedText::Whole(2)), Speed::new(2, 1));
        for wrong in ["0", "1/0", "-1", "a/b", "", "1/2/3"] {
            assert_eq!(parse(&ratio(wrong)), None, "{wrong}");
        }
        assert_eq!(parse(&SpeedText::Decimal(f64::NAN)), None);
        assert_eq!(parse(&SpeedText::Decimal(1e300)), None);
        assert_eq!(parse(&SpeedText::Decimal(1.0 / 3.0)), None);
    }

    #[test]
    fn equal_speeds_are_one_and_unweighted_ones_equally_likely() {
        let compiled = |texts: &[&str], weights: Option<Vec<f64>>| {
            let empirical = Some(texts.iter().map(|text| ratio(text)).collect());
            let form = SpeedForm { empirical, weights, ..SpeedForm::default() };
            Speeds::from(form).compile(&Path::root()).map(SpeedTable::into_parts)
        };
        let (speeds, pick) = compiled(&["1/2", "2/4", "3"], None).unwrap();
        assert_eq!(speeds, [Speed::new(1, 2).unwrap(), Speed::new(3, 1).unwrap()]);
        assert!((pick.mean(Default::default()) - 1.0 / 3.0).abs() < 1e-9);
        let (one, pick) = compiled(&["1/2", "1", "2/4"], Some(vec![1.0, 0.0, 2.0])).unwrap();
        assert_eq!((one.len(), pick.constant()), (1, Some(0)));
    }
}
