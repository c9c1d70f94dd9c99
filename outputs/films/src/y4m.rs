//! YUV4MPEG2 (`.y4m`): frames as they are, for other programs; a pipe takes it as it comes.
//!
//! Luma and chroma are those of ITU-R BT.601 in the range of video (16 to 235, 16 to 240), one of each a pixel (C444),
//! each rounded once: Y = 16 + 65.481 R + 128.553 G + 24.966 B for R, G, B in [0, 1], and so on (BT.601-7 §3).
//! A picture that is held is written as often as it is shown.

use crate::{Encoder, Film, Patched};
use phytomer_pictures::Canvas;
use std::io;

/// The parts of red, green and blue in Y, Cb and Cr, over 2¹⁶ × 255: 219 times the shares of light 0.299, 0.587 and
/// 0.114, and 224 times those of the differences of colour.
const PARTS: [[i32; 3]; 3] = [[16829, 33039, 6416], [-9714, -19071, 28785], [28785, -24104, -4681]];
/// The values of black.
const BLACK: [i32; 3] = [16, 128, 128];

/// A film of bare frames.
pub struct Y4m<S> {
    out: S,
    frame: Vec<u8>,
}

impl<S: Patched> Y4m<S> {
    /// Begins a film.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(film: &Film, mut out: S) -> io::Result<Self> {
        let [width, height] = film.size;
        writeln!(out, "YUV4MPEG2 W{width} H{height} F{}:1 Ip A1:1 C444 XCOLORRANGE=LIMITED", film.fps)?;
        Ok(Self { out, frame: Vec::new() })
    }
}

impl<S: Patched> Encoder for Y4m<S> {
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()> {
        self.frame.clear();
        self.frame.extend(b"FRAME\n");
        for (parts, black) in PARTS.iter().zip(BLACK) {
            let of = |[r, g, b, _]: &[u8; 4]| {
                let sum = i32::from(*r) * parts[0] + i32::from(*g) * parts[1] + i32::from(*b) * parts[2];
                (black + ((sum + (1 << 15)) >> 16)) as u8
            };
            self.frame.extend(canvas.pixels.iter().map(of));
        }
        (0..frames).try_for_each(|_| self.out.write_all(&self.frame))
    }

    fn finish(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
