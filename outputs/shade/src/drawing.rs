//! A plan as SVG: zones coloured by their hours of shade, buildings, crowns from above, spots, north and a scale.
//!
//! North is up. The hours of a zone are a small picture of one pixel a cell within the outline of the zone, so that a
//! plan stays small however fine its grid is. What grows may hide what lies below it, so crowns are half transparent.
//! Absent: which month is drawn, and the names, which the caller has.

use crate::polygon::{Point, bounds};
use crate::samples::{Grid, Samples};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use phytomer_sim::math::{log10, pow};
use std::fmt::Write;

/// The width and the height that the plan fills at most, pixels.
const FILLS: [f64; 2] = [860.0, 640.0];
/// The margins at the left, the top, the right and the bottom.
const MARGINS: [f64; 4] = [30.0, 56.0, 180.0, 56.0];
/// Colours from no shade to shade all day.
const COLOURS: [[f64; 3]; 5] =
    [[255.0, 243.0, 176.0], [247.0, 205.0, 120.0], [190.0, 160.0, 150.0], [108.0, 122.0, 168.0], [44.0, 62.0, 122.0]];

/// A thing with an outline and a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Outlined {
    /// What is written beside it; nothing where it is empty.
    pub name: String,
    /// Its corners, metres.
    pub corners: Vec<Point>,
    /// Where its name stands.
    pub at: Point,
}

/// What a plan shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing<'a> {
    /// The title.
    pub title: String,
    /// What is told below it.
    pub subtitle: String,
    /// The zones, with what is written in them.
    pub zones: Vec<Outlined>,
    /// The points of the zones.
    pub samples: &'a Samples,
    /// Hours of shade a day of each point.
    pub hours: Vec<f32>,
    /// The hours of the darkest colour.
    pub most_h: f64,
    /// The ground plans of buildings.
    pub buildings: Vec<Outlined>,
    /// The crowns of plants.
    pub crowns: Vec<Outlined>,
    /// Spots that are not planted.
    pub spots: Vec<Outlined>,
}

/// From metres to pixels.
struct Sheet {
    low: Point,
    high: Point,
    scale: f64,
}

impl Sheet {
    fn of(drawing: &Drawing<'_>) -> Self {
        let all = [&drawing.zones, &drawing.buildings, &drawing.crowns, &drawing.spots].into_iter().flatten();
        let corners: Vec<Point> = all.flat_map(|thing| thing.corners.iter().chain([&thing.at]).copied()).collect();
        let [low, high] = bounds(&corners);
        let [low, high] = if low[0] <= high[0] { [low, high] } else { [[0.0; 2], [1.0; 2]] };
        let size = [0, 1].map(|k| (high[k] - low[k]).max(1e-3));
        let scale = (FILLS[0] / size[0]).min(FILLS[1] / size[1]);
        Self { low, high, scale }
    }

    fn at(&self, place: Point) -> Point {
        [MARGINS[0] + (place[0] - self.low[0]) * self.scale, MARGINS[1] + (self.high[1] - place[1]) * self.scale]
    }

    /// Width and height of the whole sheet, pixels.
    fn size(&self) -> [f64; 2] {
        let [right, bottom] = self.at([self.high[0], self.low[1]]);
        [(right + MARGINS[2]).max(520.0).ceil(), (bottom + MARGINS[3]).max(360.0).ceil()]
    }
}

/// The text of a plan.
///
/// # Errors
/// Where a picture within it cannot be made.
pub fn plan(drawing: &Drawing<'_>) -> Result<String, png::EncodingError> {
    let sheet = Sheet::of(drawing);
    let [width, height] = sheet.size();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#f6f4ee\"/>\n"
    );
    // A text takes everything.
    let _ = writeln!(text, "<text x=\"{}\" y=\"24\" font-size=\"17\">{}</text>", MARGINS[0], escaped(&drawing.title));
    let _ = writeln!(text, "<text x=\"{}\" y=\"41\" fill=\"#555\">{}</text>", MARGINS[0], escaped(&drawing.subtitle));
    for (number, (zone, grid)) in drawing.zones.iter().zip(&drawing.samples.grids).enumerate() {
        hours(&mut text, &sheet, drawing, (number, zone, grid))?;
    }
    for building in &drawing.buildings {
        shape(&mut text, &sheet, building, "fill=\"#8d8a85\" stroke=\"#4b4945\" stroke-width=\"1\"");
    }
    for crown in &drawing.crowns {
        let look =
            "fill=\"#4f8a4a\" fill-opacity=\".45\" stroke=\"#2c5a2a\" stroke-width=\".8\" stroke-linejoin=\"round\"";
        shape(&mut text, &sheet, crown, look);
        let [x, y] = sheet.at(crown.at);
        let _ = writeln!(text, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"2\" fill=\"#4a3420\"/>");
    }
    for spot in &drawing.spots {
        let [x, y] = sheet.at(spot.at);
        let cross = format!("M{:.2} {y:.2}h8M{x:.2} {:.2}v8", x - 4.0, y - 4.0);
        let _ = writeln!(text, "<path d=\"{cross}\" stroke=\"#a02c2c\" stroke-width=\"1.4\" fill=\"none\"/>");
    }
    let (zones, things) = (drawing.zones.iter(), [&drawing.buildings, &drawing.crowns, &drawing.spots]);
    zones.for_each(|zone| label(&mut text, &sheet, zone, "middle", [0.0, 4.0]));
    things.into_iter().flatten().for_each(|thing| label(&mut text, &sheet, thing, "start", [5.0, -5.0]));
    legend(&mut text, drawing.most_h, width);
    north(&mut text, width);
    scale_bar(&mut text, &sheet, height);
    text.push_str("</svg>\n");
    Ok(text)
}

/// The hours of a zone, within its outline.
fn hours(
    text: &mut String,
    sheet: &Sheet,
    drawing: &Drawing<'_>,
    (number, zone, grid): (usize, &Outlined, &Grid),
) -> Result<(), png::EncodingError> {
    let [x, y] = sheet.at([grid.corner[0], grid.corner[1] + grid.side[1] * grid.size[1] as f64]);
    let [width, height] = [0, 1].map(|k| grid.side[k] * grid.size[k] as f64 * sheet.scale);
    let picture = STANDARD.encode(picture(drawing, grid)?);
    let path = outline(sheet, &zone.corners);
    let _ = writeln!(text, "<clipPath id=\"zone{number}\"><path d=\"{path}\"/></clipPath>");
    let _ = writeln!(
        text,
        "<image clip-path=\"url(#zone{number})\" x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
         preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{picture}\"/>"
    );
    let _ = writeln!(text, "<path d=\"{path}\" fill=\"none\" stroke=\"#6b5f3a\" stroke-width=\"1\"/>");
    Ok(())
}

/// A PNG of one pixel a cell, the northernmost row first.
fn picture(drawing: &Drawing<'_>, grid: &Grid) -> Result<Vec<u8>, png::EncodingError> {
    let [columns, rows] = grid.size;
    let mut pixels = Vec::with_capacity(columns * rows * 4);
    for row in (0..rows).rev() {
        for column in 0..columns {
            let sample = (grid.samples[row * columns + column] as usize).checked_sub(1);
            let of = |sample: usize| colour(f64::from(drawing.hours[sample]) / drawing.most_h.max(1e-9));
            pixels.extend(sample.map_or([0; 4], |sample| {
                let [r, g, b] = of(sample);
                [r, g, b, 255]
            }));
        }
    }
    phytomer_png::file([columns as u32, rows as u32], png::ColorType::Rgba, &pixels)
}

/// The colour of a share of the most hours.
fn colour(share: f64) -> [u8; 3] {
    let place = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let first = (place as usize).min(COLOURS.len() - 2);
    let along = place - first as f64;
    [0, 1, 2].map(|k| (COLOURS[first][k] * (1.0 - along) + COLOURS[first + 1][k] * along).round() as u8)
}

fn outline(sheet: &Sheet, corners: &[Point]) -> String {
    let mut path = String::new();
    for (k, corner) in corners.iter().enumerate() {
        let [x, y] = sheet.at(*corner);
        let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
    }
    path + "Z"
}

fn shape(text: &mut String, sheet: &Sheet, thing: &Outlined, look: &str) {
    let _ = writeln!(text, "<path d=\"{}\" {look}/>", outline(sheet, &thing.corners));
}

/// A name with a pale edge, so that it is read on any ground.
fn label(text: &mut String, sheet: &Sheet, thing: &Outlined, anchor: &str, by: [f64; 2]) {
    let [x, y] = sheet.at(thing.at);
    for (line, words) in thing.name.lines().enumerate() {
        let (x, y) = (x + by[0], y + by[1] + 13.0 * line as f64);
        let _ = writeln!(
            text,
            "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" stroke=\"#fff\" stroke-width=\"2.5\" \
             stroke-opacity=\".8\" paint-order=\"stroke\">{}</text>",
            escaped(words)
        );
    }
}

/// The colours with their hours.
fn legend(text: &mut String, most_h: f64, width: f64) {
    let (x, top, height) = (width - MARGINS[2] + 40.0, 170.0, 140.0);
    let _ = writeln!(text, "<text x=\"{x:.0}\" y=\"{:.0}\">hours of shade a day</text>", top - 12.0);
    let steps = 28;
    for step in 0..steps {
        let [r, g, b] = colour((f64::from(steps - step) - 0.5) / f64::from(steps));
        let (y, each) = (top + height * f64::from(step) / f64::from(steps), height / f64::from(steps));
        let _ = writeln!(
            text,
            "<rect x=\"{x:.0}\" y=\"{y:.2}\" width=\"16\" height=\"{:.2}\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>",
            each + 0.3
        );
    }
    for share in [0.0, 0.5, 1.0] {
        let y = top + height * (1.0 - share) + 4.0;
        let _ = writeln!(text, "<text x=\"{:.0}\" y=\"{y:.0}\">{:.1}</text>", x + 22.0, most_h * share);
    }
}

fn north(text: &mut String, width: f64) {
    let (x, y) = (width - MARGINS[2] + 48.0, 60.0);
    let _ = writeln!(
        text,
        "<path d=\"M{x} {y}l9 34l-9 -8l-9 8Z\" fill=\"#333\"/>\n\
         <text x=\"{x}\" y=\"{:.0}\" text-anchor=\"middle\" font-size=\"13\">N</text>",
        y + 52.0
    );
}

/// A bar of 1, 2 or 5 times a power of ten metres, about a fifth of the plan.
fn scale_bar(text: &mut String, sheet: &Sheet, height: f64) {
    let fifth = 160.0 / sheet.scale;
    let power = pow(10.0, log10(fifth).floor());
    let length = [5.0, 2.0, 1.0].map(|step| step * power).into_iter().find(|length| *length <= fifth).unwrap_or(power);
    let (x, y, long) = (MARGINS[0], height - 22.0, length * sheet.scale);
    let _ = writeln!(
        text,
        "<path d=\"M{x} {:.0}v6h{long:.2}v-6\" fill=\"none\" stroke=\"#333\" stroke-width=\"1.5\"/>\n\
         <text x=\"{:.2}\" y=\"{:.0}\">{length} m</text>",
        y - 6.0,
        x + long + 6.0,
        y + 2.0
    );
}

/// A text without what XML reads as its own; characters that XML does not know are left out.
fn escaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for letter in text.chars().filter(|letter| !letter.is_control() && !matches!(letter, '\u{fffe}' | '\u{ffff}')) {
        match letter {
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '&' => plain.push_str("&amp;"),
            '"' => plain.push_str("&quot;"),
            letter => plain.push(letter),
        }
    }
    plain
}
