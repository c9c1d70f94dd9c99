//! Plants coloured by a column of `records`, and the legend that says what the colours mean.
//!
//! The values are those of the table. All plants of a picture share one scale, from the least to the largest value of
//! what stands on any of them. Words, truths and orders are classes; all else is a quantity.

use super::Subject;
use super::canvas::Canvas;
use super::caption::{Align, write};
use super::error::PictureError;
use super::value_colours::{NOTHING, of_class, of_share};
use crate::tables::columns::RECORDS;
use crate::tables::record_values;
use crate::tables::schema::{Column, Type};

/// How wide a legend is, in letter sizes.
pub const WIDTH: f32 = 9.5;

/// What the colours of a picture mean.
#[derive(Debug, Clone, PartialEq)]
pub struct Legend {
    name: String,
    means: Means,
}

#[derive(Debug, Clone, PartialEq)]
enum Means {
    /// Classes by their names, each with a colour.
    Classes(Vec<(String, [u8; 3])>),
    /// The least and the largest value.
    Range(f64, f64),
}

/// The colours of every component of each plant.
pub type Colours = Vec<Vec<[u8; 3]>>;

/// The names of the columns that plants can be coloured by.
pub fn colour_columns() -> impl Iterator<Item = &'static str> {
    RECORDS.iter().map(|column| column.name)
}

/// The colours of every component of some plants by a column of `records`.
///
/// # Errors
/// [`PictureError::NoSuchColumn`]; [`PictureError::NothingToColour`] where no component has a value; a plant too large for tables.
pub fn colours(column: &str, subjects: &[Subject]) -> Result<(Colours, Legend), PictureError> {
    let known = RECORDS.iter().find(|known| known.name == column);
    let column = known.ok_or_else(|| PictureError::NoSuchColumn { column: column.to_owned() })?;
    let values = subjects.iter().map(|subject| record_values(subject.plant, subject.age, column));
    let values: Vec<Vec<f64>> = values.collect::<Result<_, _>>()?;
    let all = || values.iter().flatten().copied().filter(|value| !value.is_nan());
    let (low, high) =
        all().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return Err(PictureError::NothingToColour { column: column.name, reason: reason(column.name, subjects) });
    }
    let means = means(column, low, high);
    let colour = |value: &f64| match &means {
        _ if value.is_nan() => NOTHING,
        Means::Classes(_) => of_class((*value - least_class(column)) as usize),
        Means::Range(low, high) => of_share(if high > low { (value - low) / (high - low) } else { 0.5 }),
    };
    let colours = values.iter().map(|values| values.iter().map(colour).collect()).collect();
    Ok((colours, Legend { name: column.name.to_owned(), means }))
}

/// Why no component of some plants has a value in a column: what the column's description says of its nulls, held
/// against what stands and against the wood of the species.
fn reason(column: &str, subjects: &[Subject]) -> &'static str {
    let wood = || subjects.iter().filter_map(|subject| subject.plant.habit.wood.as_ref());
    let of_wood = ["fresh_mass_kg", "curvature_per_m", "bending_moment_N_m"].contains(&column);
    let of_bending = of_wood && column != "fresh_mass_kg";
    match column {
        _ if !any_value("component_id", subjects) => "nothing stands at that age",
        _ if of_wood && wood().next().is_none() => "the species states no `[wood]`",
        _ if of_bending && !wood().any(|wood| wood.bends) => {
            "the wood of the species does not bend (`bends = false` in its `[wood]`)"
        }
        "parent_id" => "everything that stands grows on the seed itself",
        "area_m2" if any_value("length_m", subjects) => "nothing that stands has an area, as leaves have",
        "fresh_mass_kg" if any_value("length_m", subjects) => "the `[wood]` of the species states no `density_kg_m3`",
        "length_m" | "diameter_m" | "area_m2" | "fresh_mass_kg" => "nothing but buds stands at that age",
        _ => "no internode stands at that age",
    }
}

/// Whether a component of some plants has a value in a column.
fn any_value(column: &str, subjects: &[Subject]) -> bool {
    let column = RECORDS.iter().find(|known| known.name == column);
    let values = |subject: &Subject| column.and_then(|column| record_values(subject.plant, subject.age, column).ok());
    subjects.iter().filter_map(values).flatten().any(|value| !value.is_nan())
}

/// Orders count from 1, words and truths from 0.
fn least_class(column: &Column) -> f64 {
    if column.name == "order" { 1.0 } else { 0.0 }
}

fn means(column: &Column, low: f64, high: f64) -> Means {
    let classes = |name: &dyn Fn(usize) -> String| {
        let (first, last) = (low as usize, high as usize);
        let class = |value: usize| (name(value), of_class(value - least_class(column) as usize));
        Means::Classes((first..=last).map(class).collect())
    };
    match column.holds {
        Type::Word(words) => classes(&|value| words.get(value).copied().unwrap_or_default().replace('_', " ")),
        Type::Bool => classes(&|value| if value == 0 { "dead".to_owned() } else { "alive".to_owned() }),
        Type::Name(_) => classes(&|_| "control".to_owned()),
        Type::Int if column.name == "order" => classes(&|value| format!("order {value}")),
        _ => Means::Range(low, high),
    }
}

impl Legend {
    /// Draws the legend into a band of [`WIDTH`] letter sizes at the right of a picture.
    pub fn draw(&self, canvas: &mut Canvas, size: f32) {
        let left = canvas.width as f32 - WIDTH * size;
        let top = 2.6 * size;
        write(canvas, &self.name, size, [left, top], Align::Left);
        match &self.means {
            Means::Classes(classes) => draw_classes(canvas, classes, size, [left, top + 1.2 * size]),
            Means::Range(low, high) => draw_range(canvas, [*low, *high], size, [left, top + 1.4 * size]),
        }
    }
}

fn draw_classes(canvas: &mut Canvas, classes: &[(String, [u8; 3])], size: f32, [left, top]: [f32; 2]) {
    for (row, (name, colour)) in classes.iter().enumerate() {
        let line = top + 1.9 * size * (row as f32 + 0.6);
        canvas.rectangle([left, line - size, left + 1.3 * size, line + 0.3 * size], *colour);
        write(canvas, name, 0.85 * size, [left + 2.0 * size, line], Align::Left);
    }
}

fn draw_range(canvas: &mut Canvas, [low, high]: [f64; 2], size: f32, [left, top]: [f32; 2]) {
    let tall = (0.42 * canvas.height as f32).max(6.0 * size);
    let (right, steps) = (left + 1.2 * size, tall.ceil() as u16);
    for step in 0..steps {
        let y = top + f32::from(step);
        let share = 1.0 - (f64::from(step) + 0.5) / f64::from(steps);
        canvas.rectangle([left, y, right, (y + 1.0).min(top + tall)], of_share(share));
    }
    let ticks = ticks(low, high);
    for tick in &ticks {
        let share = if high > low { ((tick - low) / (high - low)) as f32 } else { 0.5 };
        let y = top + tall * (1.0 - share);
        canvas.rectangle([right, y - 0.5, right + 0.4 * size, y + 0.5], super::caption::INK);
        write(canvas, &in_words(*tick, &ticks), 0.85 * size, [right + 0.9 * size, y + 0.43 * size], Align::Left);
    }
}

/// Round values from the least to the largest, four to nine of them: steps of 1, 2 or 5 times a power of ten.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    if high <= low {
        return vec![low];
    }
    let mut step = 1e-9;
    let mut factors = [2.0, 2.5, 2.0].into_iter().cycle();
    while (high - low) / step > 8.0 {
        step *= factors.next().unwrap_or(10.0);
    }
    let first = (low / step).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// A value with as many digits as tell it from its neighbours.
fn in_words(value: f64, ticks: &[f64]) -> String {
    let step = ticks.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let apart = |digits: usize| (0..digits).fold(1.0, |ten, _| ten * 10.0) * step >= 0.999;
    let digits = if step.is_finite() { (0..9).find(|digits| apart(*digits)).unwrap_or(9) } else { 2 };
    format!("{value:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let words = |low: f64, high: f64| {
            let ticks = ticks(low, high);
            ticks.iter().map(|tick| in_words(*tick, &ticks)).collect::<Vec<_>>()
        };
        assert_eq!(words(0.0, 10.0), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(words(0.013, 0.247), ["0.05", "0.10", "0.15", "0.20"]);
        assert_eq!(words(-3.0, 2.0), ["-3", "-2", "-1", "0", "1", "2"]);
        assert_eq!(words(4.0, 4.0), ["4.00"]);
    }
}
