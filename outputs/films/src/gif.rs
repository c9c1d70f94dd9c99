//! GIF: plays everywhere, in 255 colours, which are the same from the first picture to the last.
//!
//! Between the colours of the palette pixels are mixed by an ordered pattern (Bayer 1973) that stands still on the
//! picture, so that what does not move has the same pixels in every picture. Of a picture after the first the rectangle
//! that differs is stored, and in it the pixels that do. Time is in hundredths of a second.

use crate::changed::Area;
use crate::palette::{MOST, Palette};
use crate::time::Units;
use crate::{Encoder, Film, Patched};
use gif::{DisposalMethod, Frame, Repeat};
use phytomer_pictures::Canvas;
use rayon::prelude::*;
use std::borrow::Cow;
use std::io;

/// The most frames a second: players slow down what is shorter than two hundredths.
pub const MOST_FPS: u32 = 50;
/// The place in the palette of pixels that do not change.
const STAYS: u8 = MOST as u8;
/// How far apart the pattern moves the values of a channel, of 255.
const MIXED: i32 = 10;
/// The rows of a picture that a thread handles at once.
const ROWS: usize = 16;

/// The order in which a square of 8 by 8 pixels fills up.
#[rustfmt::skip]
const BAYER: [[i32; 8]; 8] = [
    [ 0, 32,  8, 40,  2, 34, 10, 42], [48, 16, 56, 24, 50, 18, 58, 26],
    [12, 44,  4, 36, 14, 46,  6, 38], [60, 28, 52, 20, 62, 30, 54, 22],
    [ 3, 35, 11, 43,  1, 33,  9, 41], [51, 19, 59, 27, 49, 17, 57, 25],
    [15, 47,  7, 39, 13, 45,  5, 37], [63, 31, 55, 23, 61, 29, 53, 21],
];

/// A GIF that is being written.
pub struct Gif<S: Patched> {
    /// `None` once it is complete.
    out: Option<gif::Encoder<S>>,
    palette: Palette,
    time: Units,
    width: usize,
    before: Option<Vec<u8>>,
}

impl<S: Patched> Gif<S> {
    /// Begins a film in the colours of a palette.
    ///
    /// # Errors
    /// Those of `out`; sides of more than 65,535 pixels.
    pub fn new(film: &Film, palette: Palette, out: S) -> io::Result<Self> {
        let [width, height] = film.size.map(u16::try_from);
        let (Ok(wide), Ok(high)) = (width, height) else {
            return Err(io::Error::other("a picture of a GIF has at most 65535 pixels along a side"));
        };
        let mut colours = palette.colours.as_flattened().to_vec();
        colours.resize(3 * (MOST + 1), 0);
        let mut out = gif::Encoder::new(out, wide, high, &colours).map_err(told)?;
        out.set_repeat(Repeat::Infinite).map_err(told)?;
        let (time, width) = (Units::new(100, film.fps), film.size[0].max(1) as usize);
        Ok(Self { out: Some(out), palette, time, width, before: None })
    }

    /// The places in the palette of the pixels of a picture.
    fn indexed(&self, canvas: &Canvas) -> Vec<u8> {
        let mut places = vec![0; canvas.pixels.len()];
        let (palette, width) = (&self.palette, self.width);
        let some = ROWS * width;
        let (rows, from) = (places.par_chunks_mut(some), canvas.pixels.par_chunks(some));
        rows.zip(from).for_each(|(places, pixels)| {
            // Every chunk begins with a row whose number is a multiple of eight.
            for (index, (place, [r, g, b, _])) in places.iter_mut().zip(pixels).enumerate() {
                let (x, y) = (index % width, index / width);
                // Evenly spread around 0.
                let more = MIXED * (2 * BAYER[y % 8][x % 8] - 63) / 128;
                let mixed = [*r, *g, *b].map(|value| (i32::from(value) + more).clamp(0, 255) as u8);
                *place = palette.nearest(mixed);
            }
        });
        places
    }
}

impl<S: Patched> Encoder for Gif<S> {
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()> {
        let places = self.indexed(canvas);
        let (area, pixels) = match &self.before {
            None => (Area::whole([canvas.width, canvas.height]), places.clone()),
            Some(before) => {
                let area = Area::between(before, &places, canvas.width);
                let rows = area.rows(before, canvas.width).zip(area.rows(&places, canvas.width));
                let each = rows.flat_map(|(before, after)| before.iter().zip(after));
                (area, each.map(|(before, after)| if before == after { STAYS } else { *after }).collect())
            }
        };
        let frame = Frame {
            delay: self.time.next(frames).min(u16::MAX.into()) as u16,
            dispose: DisposalMethod::Keep,
            transparent: self.before.is_some().then_some(STAYS),
            left: area.left as u16,
            top: area.top as u16,
            width: area.width as u16,
            height: area.height as u16,
            buffer: Cow::Owned(pixels),
            ..Frame::default()
        };
        self.before = Some(places);
        self.out.as_mut().map_or(Ok(()), |out| out.write_frame(&frame)).map_err(told)
    }

    fn finish(&mut self) -> io::Result<()> {
        let Some(out) = self.out.take() else { return Ok(()) };
        out.into_inner().map_err(told)?.flush()
    }
}

/// The system's error below one of the encoder.
fn told(error: gif::EncodingError) -> io::Error {
    match error {
        gif::EncodingError::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}
