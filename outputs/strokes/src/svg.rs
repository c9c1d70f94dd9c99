//! A sheet as SVG 1.1: one path for each shape, clipped to its port. Numbers have two decimals of a pixel.

use super::flat::Flat;
use super::{Colour, Port, Sheet};
use std::fmt::Write;

/// The text of a sheet.
pub fn written(sheet: &Sheet, ports: &[(Port, Vec<Flat>)]) -> String {
    let [width, height] = sheet.size;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
        hex(sheet.background)
    );
    for (number, (port, shapes)) in ports.iter().enumerate() {
        let [left, top, right, bottom] = port.pixels(sheet.size);
        // A text takes everything.
        let _ = writeln!(
            text,
            "<clipPath id=\"port{number}\"><rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{:.2}\" height=\"{:.2}\"/>\
             </clipPath>\n<g clip-path=\"url(#port{number})\">",
            right - left,
            bottom - top
        );
        shapes.iter().for_each(|shape| path(&mut text, shape));
        text.push_str("</g>\n");
    }
    text.push_str("</svg>\n");
    text
}

fn path(text: &mut String, shape: &Flat) {
    text.push_str("<path d=\"");
    for (k, [x, y]) in shape.corners.iter().enumerate() {
        let _ = write!(text, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
    }
    let _ = write!(text, "Z\" fill=\"{}\"", hex(shape.colour));
    if shape.opacity < 1.0 {
        let _ = write!(text, " fill-opacity=\"{}\"", shape.opacity);
    }
    text.push_str("/>\n");
}

fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
