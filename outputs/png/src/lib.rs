//! PNG files whose bytes are those of the picture alone, whatever other crates a program is built with.
//!
//! The `png` crate writes the file and chooses the filter of each row; its data are deflated by flate2. flate2 takes
//! another compressor where any crate of a build asks for one, as the reader of Parquet of the feature `sql` does, and
//! another compressor writes other bytes. So the data are deflated here, by miniz, which has no such choice. Absent:
//! animations (`phytomer-films` puts pictures of this kind together).

use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::decompress_to_vec_zlib;
use png::{BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter};
use std::io::{self, Write};

/// How much work is done for a short file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compression {
    /// zlib's level 6: most of the gain for a part of the work.
    Balanced,
    /// zlib's level 9, its greatest.
    High,
}

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// A chunk's length, name and checksum, bytes.
const AROUND_DATA: usize = 12;
/// PNG (third edition) 5.3: the length of a chunk is below 2³¹.
const LONGEST: usize = (1 << 31) - 1;

/// A file of eight bits a channel: `size` is width and height, `bytes` are the pixels row by row from the top.
///
/// # Errors
/// Where the bytes are not as many as the size and the colour ask for.
pub fn file([width, height]: [u32; 2], colour: ColorType, bytes: &[u8]) -> Result<Vec<u8>, EncodingError> {
    let mut quick = Vec::new();
    let mut encoder = Encoder::new(&mut quick, width, height);
    encoder.set_color(colour);
    encoder.set_depth(BitDepth::Eight);
    let mut writer = filtered(encoder).write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    let mut out = Vec::with_capacity(quick.len());
    write_deflated(&quick, Compression::Balanced, &mut out)?;
    Ok(out)
}

/// The encoder with the filters that png takes at any level, and with its quickest compressor: [`write_deflated`]
/// deflates the rows again.
#[must_use]
pub fn filtered<W: Write>(mut encoder: Encoder<'_, W>) -> Encoder<'_, W> {
    encoder.set_deflate_compression(DeflateCompression::FdeflateUltraFast);
    encoder.set_filter(Filter::Adaptive);
    encoder
}

/// Writes a PNG file that another encoder has made, with its data deflated by miniz; all other chunks
/// stay. Takes the memory of the picture's pixels twice over.
///
/// # Errors
/// Those of `out`, and [`io::ErrorKind::InvalidData`] where this is no whole PNG file.
pub fn write_deflated(file: &[u8], compression: Compression, mut out: impl Write) -> io::Result<()> {
    let no_png = || io::Error::new(io::ErrorKind::InvalidData, "this is no whole PNG file");
    let mut rest = file.strip_prefix(SIGNATURE).ok_or_else(no_png)?;
    out.write_all(SIGNATURE)?;
    let level = match compression {
        Compression::Balanced => 6,
        Compression::High => 9,
    };
    let mut data = Vec::new();
    while !rest.is_empty() {
        let length = rest.first_chunk().map(|bytes| u32::from_be_bytes(*bytes) as usize).ok_or_else(no_png)?;
        let (chunk, after) = rest.split_at_checked(length.saturating_add(AROUND_DATA)).ok_or_else(no_png)?;
        rest = after;
        let is_data = &chunk[4..8] == b"IDAT";
        if is_data {
            data.extend_from_slice(&chunk[8..8 + length]);
        } else if !data.is_empty() {
            let rows = decompress_to_vec_zlib(&std::mem::take(&mut data)).map_err(|_| no_png())?;
            let deflated = compress_to_vec_zlib(&rows, level);
            deflated.chunks(LONGEST).try_for_each(|part| write_chunk(*b"IDAT", part, &mut out))?;
        }
        if !is_data {
            out.write_all(chunk)?;
        }
    }
    if data.is_empty() { Ok(()) } else { Err(no_png()) }
}

fn write_chunk(name: [u8; 4], data: &[u8], out: &mut impl Write) -> io::Result<()> {
    let mut sum = crc32fast::Hasher::new();
    sum.update(&name);
    sum.update(data);
    out.write_all(&(data.len() as u32).to_be_bytes())?;
    out.write_all(&name)?;
    out.write_all(data)?;
    out.write_all(&sum.finalize().to_be_bytes())
}

#[cfg(test)]
mod tests;
