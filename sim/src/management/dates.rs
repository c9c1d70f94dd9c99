//! What conditions on plants ask of the calendar of the plot.
//!
//! An operation of tick t is done at the midnight with which the tick before has ended: the day is the one that then
//! begins, and degree-days are those up to then, from the sowing of the plant as in laws of the date. Absent: dates at
//! which operations are done, which are ticks before they come to this crate.

use super::column::Column;
use crate::clock::Tick;
use crate::site::calendar::Calendar;

/// The value of a column of the date, for a plant that was sown at `sown`; NaN where the calendar does not tell it.
pub fn value(calendar: Option<&Calendar>, column: Column, tick: Tick, sown: Tick) -> f64 {
    let Some(calendar) = calendar else { return f64::NAN };
    let at = calendar.at(tick.saturating_sub(1));
    let value = match column {
        Column::Date => Some(f64::from(at.date.day_of_year())),
        Column::DegreeDays => at.degree_day_sum.zip(calendar.at(sown).degree_day_sum).map(|(by, before)| by - before),
        Column::DayLength => at.day_length_h,
        _ => None,
    };
    value.unwrap_or(f64::NAN)
}
