//! PNG files: eight bits a channel, with opacity where the picture has any, and the name of the program that made it.
//!
//! Absent: other formats; how the data are compressed (`phytomer-png`).

use super::canvas::Canvas;
use phytomer_png::{Compression, filtered, write_deflated};
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent};
use std::io::{self, Write};

/// Writes a picture; `note` goes into the file as its description.
///
/// # Errors
/// Those of `out`.
pub fn write_png(canvas: &Canvas, note: &str, compression: Compression, out: impl Write) -> io::Result<()> {
    let opaque = canvas.pixels.iter().all(|pixel| pixel[3] == 255);
    let mut quick = Vec::new();
    let mut encoder = filtered(Encoder::new(&mut quick, canvas.width, canvas.height));
    encoder.set_color(if opaque { ColorType::Rgb } else { ColorType::Rgba });
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Software".to_owned(), "phytomer".to_owned())?;
    encoder.add_itxt_chunk("Description".to_owned(), note.to_owned())?;
    let mut writer = encoder.write_header()?;
    if opaque {
        let bytes: Vec<u8> = canvas.pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        writer.write_image_data(&bytes)?;
    } else {
        writer.write_image_data(bytemuck::cast_slice(&canvas.pixels))?;
    }
    writer.finish()?;
    write_deflated(&quick, compression, out)
}
