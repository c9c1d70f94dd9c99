//! Plants coloured by a value of each component, and the legend that states the meaning of the colours.
//!
//! All plants of a picture share one scale, from the smallest to the largest value of the standing components of all
//! plants. Absent: the origin of the values; `phytomer_outputs::colouring` makes them from a column of `records`.

use super::canvas::Canvas;
use super::caption::{Align, write};
use super::value_colours::{NOTHING, of_class, of_share};

/// The width of a legend, in letter sizes.
pub const WIDTH: f32 = 9.5;

/// Values that colour the components of a picture's plants.
#[derive(Debug, Clone, PartialEq)]
pub struct Colouring {
    /// The name of the values, which heads the legend.
    pub name: String,
    /// For each plant the value of each component, by component number; NaN for no value.
    pub values: Vec<Vec<f64>>,
    /// The scale of the values: amounts or classes.
    pub scale: Scale,
}

/// The scale of the values of a colouring.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Scale {
    /// Amounts, which run through a ramp of colours.
    Amounts,
    /// Whole numbers that stand for classes, each with a colour of its own.
    Classes {
        /// The number of the first class.
        first: usize,
        /// The names of the classes, from the first on.
        names: Vec<String>,
    },
}

/// The meaning of the colours of a picture.
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

/// The colours of every component, for each plant.
pub type Colours = Vec<Vec<[u8; 3]>>;

/// The colours of every component, for each plant, and their legend; no legend where no component has a value.
pub fn colours(colouring: &Colouring) -> (Colours, Option<Legend>) {
    let all = colouring.values.iter().flatten().copied().filter(|value| !value.is_nan());
    let (low, high) =
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let colour = |value: &f64| match &colouring.scale {
        _ if value.is_nan() => NOTHING,
        Scale::Classes { first, .. } => of_class((*value as usize).saturating_sub(*first)),
        Scale::Amounts => of_share(if high > low { (value - low) / (high - low) } else { 0.5 }),
    };
    let colours = colouring.values.iter().map(|values| values.iter().map(colour).collect()).collect();
    let legend = || Legend { name: colouring.name.clone(), means: means(&colouring.scale, low, high) };
    (colours, (low <= high).then(legend))
}

fn means(scale: &Scale, low: f64, high: f64) -> Means {
    let Scale::Classes { first, names } = scale else { return Means::Range(low, high) };
    let class = |value: usize| {
        let place = value.saturating_sub(*first);
        (names.get(place).cloned().unwrap_or_default(), of_class(place))
    };
    Means::Classes((low as usize..=high as usize).map(class).collect())
}

impl Legend {
    /// Draws the legend into a band at the right of a picture, [`WIDTH`] letter sizes wide.
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
