//! The text on a picture: its scale, the ages of its plants, and the meaning of its colours.
//!
//! The scale bar is the longest of 1, 2 or 5 times a power of ten metres that fits. In perspective it holds at the foot
//! of the plants, which are all at the same distance from the eye.

use super::canvas::Canvas;
use super::letters::{width, written};

/// The colour of text, and on dark ground.
pub const INK: [u8; 3] = [70, 66, 60];
const LIGHT: [u8; 3] = [242, 240, 234];

/// The luminance, as a share of white's, below which ground is dark: there dark text has a contrast of less than 2.4,
/// and light text one of more than 3.6 (WCAG 2, relative luminance).
const DARK: f64 = 0.2;

/// The colour of text in a box, from its left and upper corner to the other.
fn ink(canvas: &Canvas, [left, top, right, bottom]: [f32; 4]) -> [u8; 3] {
    let pixels = |from: f32, to: f32, all: u32| (from.max(0.0) as u32).min(all)..(to.max(0.0).ceil() as u32).min(all);
    let columns = pixels(left, right, canvas.width);
    let (mut sum, mut count) = (0.0, 0_u32);
    for row in pixels(top, bottom, canvas.height) {
        for column in columns.clone() {
            let [red, green, blue, alpha] = canvas.at(column, row);
            let [red, green, blue] = [red, green, blue].map(phytomer_meshes::linear);
            // What is clear is seen on light paper.
            let clear = 1.0 - f64::from(alpha) / 255.0;
            sum += clear + (1.0 - clear) * (0.2126 * red + 0.7152 * green + 0.0722 * blue);
            count += 1;
        }
    }
    if count > 0 && sum < DARK * f64::from(count) { LIGHT } else { INK }
}

/// The height of a capital, pixels, for a picture of this height.
pub fn letter_size(height: u32) -> f32 {
    (height as f32 / 62.0).clamp(7.0, 34.0)
}

/// The alignment of a line of text to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// The text begins at the point.
    Left,
    /// The middle of the text is at the point.
    Middle,
    /// The text ends at the point.
    Right,
}

/// Writes a line of text.
pub fn write(canvas: &mut Canvas, text: &str, size: f32, [x, line]: [f32; 2], align: Align) {
    let wide = width(text, size);
    let left = match align {
        Align::Left => x,
        Align::Middle => x - 0.5 * wide,
        Align::Right => x - wide,
    };
    let (strokes, _) = written(text, size, [left, line]);
    let ink = ink(canvas, [left, line - size, left + wide, line]);
    canvas.strokes(&strokes, (0.062 * size).max(0.55), ink);
}

/// The length of a scale bar, metres, for a scale in pixels per metre: the longest that fits into `room` pixels.
pub fn bar_length(scale: f32, room: f32) -> Option<f32> {
    let most = f64::from(room) / f64::from(scale);
    let fits = |length: &f64| *length <= most;
    let lengths = (-4..=4).flat_map(|power: i32| {
        let ten = if power < 0 { 1.0 / 10_f64.pow_whole(-power) } else { 10_f64.pow_whole(power) };
        [ten, 2.0 * ten, 5.0 * ten]
    });
    lengths.rev().find(fits).map(|length| length as f32)
}

/// An integer power by multiplication, which gives the same bits on every platform.
trait PowWhole {
    fn pow_whole(self, power: i32) -> Self;
}

impl PowWhole for f64 {
    fn pow_whole(self, power: i32) -> Self {
        (0..power).fold(1.0, |product, _| product * self)
    }
}

/// A length as people write it: `5 m`, `20 cm`, `2 mm`.
pub fn length_in_words(metres: f32) -> String {
    match metres {
        m if m >= 0.995 => format!("{m:.0} m"),
        m if m >= 0.0095 => format!("{:.0} cm", m * 100.0),
        m if m >= 0.00095 => format!("{:.0} mm", m * 1000.0),
        m => format!("{:.1} mm", m * 1000.0),
    }
}

/// Draws a scale bar that begins at a point, and its length in words above it.
pub fn scale_bar(canvas: &mut Canvas, scale: f32, room: f32, size: f32, [left, line]: [f32; 2]) {
    let Some(length) = bar_length(scale, room) else { return };
    let thick = (0.16 * size).max(1.0);
    let right = left + length * scale;
    let tick = 0.45 * size;
    let ink = ink(canvas, [left, line - tick, right, line]);
    canvas.rectangle([left, line - thick, right, line], ink);
    canvas.rectangle([left, line - tick, left + thick, line], ink);
    canvas.rectangle([right - thick, line - tick, right, line], ink);
    write(canvas, &length_in_words(length), size, [0.5 * (left + right), line - 0.75 * size], Align::Middle);
}

/// The beginning of a line of text that fits into `room` pixels.
pub fn fitting(text: &str, size: f32, room: f32) -> String {
    let mut fitting = text.to_owned();
    while width(&fitting, size) > room && fitting.chars().count() > 2 {
        fitting = fitting.trim_end_matches('…').to_owned();
        fitting.pop();
        fitting = format!("{}…", fitting.trim_end());
    }
    fitting
}

/// Where the middle of the label of a single plant is written, whose foot is at `x`: on the line where there is room
/// between the scale bar and the title, which leave the part from `free[0]` to `free[1]`. A label that would meet the
/// title is written above the line. One that would meet the scale bar is moved into the free part or, where it is too
/// long, is written above the length of the bar.
pub fn lone_label(x: f32, half: f32, free: [f32; 2], (line, size): (f32, f32)) -> [f32; 2] {
    if x - half >= free[0] {
        return [x, if x + half > free[1] { line - 1.9 * size } else { line }];
    }
    if free[1] - free[0] >= 2.0 * half { [free[0] + half, line] } else { [x, line - 2.4 * size] }
}

/// Writes labels around their places on a line. A label that does not fit there is written on a second line above, or
/// left out where that is taken too.
pub fn write_row(canvas: &mut Canvas, labels: &[(f32, &str)], size: f32, line: f32) {
    let mut ends = [f32::NEG_INFINITY; 2];
    for (x, label) in labels {
        let half = 0.5 * width(label, size);
        let x = x.max(half + size).min(canvas.width as f32 - half - size);
        let Some(row) = (0..2).find(|row| ends[*row] + size <= x - half) else { continue };
        ends[row] = x + half;
        write(canvas, label, size, [x, line - 1.7 * size * row as f32], Align::Middle);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line on ground of a grey: the darkest and the lightest of its pixels.
    fn greys(ground: u8) -> [u8; 2] {
        let mut canvas = Canvas::new(120, 30);
        canvas.pixels.fill([ground, ground, ground, 255]);
        write(&mut canvas, "Rosa canina L.", 14.0, [60.0, 22.0], Align::Middle);
        let greens = canvas.pixels.iter().map(|pixel| pixel[1]);
        greens.fold([255, 0], |[low, high], green| [low.min(green), high.max(green)])
    }

    #[test]
    fn words_are_light_on_dark_ground_and_dark_on_light_ground() {
        assert_eq!(greys(230), [INK[1], 230]);
        assert_eq!(greys(140), [INK[1], 140]);
        assert_eq!(greys(50), [50, LIGHT[1]]);
        // Clear ground is taken for light paper.
        let mut canvas = Canvas::new(120, 30);
        write(&mut canvas, "Rosa", 14.0, [60.0, 22.0], Align::Middle);
        assert!(canvas.pixels.iter().any(|pixel| pixel[..3] == INK && pixel[3] == 255));
    }
}
