//! Animated WebP, lossy: the smallest of the files, for pages.
//!
//! libwebp encodes each picture by itself; the file around them (RIFF, ANIM and ANMF, *WebP Container Specification*)
//! is written here, so that it grows on the disk and not in memory. Of a picture after the first the blocks in which a
//! pixel has changed are shown and the others are left clear, so that what does not move does not flicker either. A
//! block beside one that is shown is encoded too, unseen: blocks are smoothed across their edges. The length of the
//! file stands at its beginning and is put right at the end.

use crate::changed::Area;
use crate::time::Units;
use crate::{Encoder, Film, Patched};
use phytomer_pictures::Canvas;
use std::io;
use webp::{PixelLayout, WebPConfig};

/// The most pixels along a side.
pub const MOST_SIDE: u32 = 16_383;
/// The side of a block of the format, pixels.
const BLOCK: u32 = 16;
/// The flags of the file: animation and opacity.
const FLAGS: u8 = 0x02 | 0x10;
/// The flag of a picture that replaces what stands, clear or not.
const REPLACES: u8 = 0x02;
/// The most units of time of a picture, milliseconds: 24 bits.
const MOST_TIME: u32 = (1 << 24) - 1;

/// An animated WebP that is being written.
pub struct WebP<S> {
    out: S,
    size: [u32; 2],
    config: WebPConfig,
    time: Units,
    before: Option<Canvas>,
    bytes: u64,
}

impl<S: Patched> WebP<S> {
    /// Begins a film of a quality, from 1 to 100.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(film: &Film, quality: u8, out: S) -> io::Result<Self> {
        let mut config = WebPConfig::new().map_err(|()| io::Error::other("libwebp is of another version"))?;
        config.quality = f32::from(quality);
        config.method = 4;
        config.thread_level = 0;
        // What is clear keeps its colours where they are given.
        config.exact = 1;
        config.alpha_compression = 1;
        let (size, time) = (film.size, Units::new(1000, film.fps));
        let mut begun = Self { out, size, config, time, before: None, bytes: 0 };
        begun.write(b"RIFF\0\0\0\0WEBP")?;
        let [width, height] = size.map(|side| side.saturating_sub(1).to_le_bytes());
        begun.chunk(b"VP8X", &[&[FLAGS, 0, 0, 0], &width[..3], &height[..3]])?;
        // A white background, and no end to the repetitions.
        begun.chunk(b"ANIM", &[&[255; 4], &[0; 2]])?;
        Ok(begun)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.bytes += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    fn chunk(&mut self, kind: &[u8; 4], parts: &[&[u8]]) -> io::Result<()> {
        let length: usize = parts.iter().map(|part| part.len()).sum();
        let length = u32::try_from(length).map_err(|_| too_large())?;
        self.write(kind)?;
        self.write(&length.to_le_bytes())?;
        parts.iter().try_for_each(|part| self.write(part))?;
        if length % 2 == 1 { self.write(&[0]) } else { Ok(()) }
    }
}

impl<S: Patched> Encoder for WebP<S> {
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()> {
        let first = self.before.is_none();
        let (area, pixels) = match &self.before {
            None => (Area::whole(self.size), canvas.pixels.clone()),
            Some(before) => changed_blocks(before, canvas),
        };
        let bytes = bytemuck::cast_slice(&pixels);
        let encoder = webp::Encoder::new(bytes, PixelLayout::Rgba, area.width, area.height);
        let encoded = encoder.encode_advanced(&self.config);
        let encoded =
            encoded.map_err(|error| io::Error::other(format!("libwebp cannot encode a picture: {error:?}")))?;
        let data = picture_chunks(&encoded).ok_or_else(|| io::Error::other("libwebp wrote no picture"))?;
        let places =
            [area.left / 2, area.top / 2, area.width - 1, area.height - 1, self.time.next(frames).min(MOST_TIME)];
        let places: Vec<u8> = places.iter().flat_map(|place| place.to_le_bytes().into_iter().take(3)).collect();
        self.chunk(b"ANMF", &[&places, &[if first { REPLACES } else { 0 }], &data])?;
        self.before = Some(canvas.clone());
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        let length = u32::try_from(self.bytes - 8).map_err(|_| too_large())?;
        self.out.patch(4, &length.to_le_bytes())?;
        self.out.flush()
    }
}

fn too_large() -> io::Error {
    io::Error::other("a film in WebP has at most 4 GiB: choose a smaller size, fewer frames or a lower quality")
}

/// The chunks of a file that hold its picture and its opacity, with their heads.
fn picture_chunks(file: &[u8]) -> Option<Vec<u8>> {
    let mut rest = file.get(12..)?;
    let mut picture = Vec::new();
    while rest.len() >= 8 {
        let (head, after) = rest.split_at(8);
        let length = u32::from_le_bytes(head[4..].try_into().ok()?) as usize;
        let padded = (length + length % 2).min(after.len());
        if [b"ALPH", b"VP8 ", b"VP8L"].iter().any(|kind| head.starts_with(*kind)) {
            picture.extend(head);
            picture.extend(&after[..padded]);
        }
        rest = &after[padded..];
    }
    (!picture.is_empty()).then_some(picture)
}

/// The blocks of a picture in which something has changed: the rectangle around them, and its pixels, of which those
/// of other blocks are clear.
fn changed_blocks(before: &Canvas, after: &Canvas) -> (Area, Vec<[u8; 4]>) {
    let [wide, high] = [after.width, after.height].map(|side| side.div_ceil(BLOCK) as usize);
    let mut changed = vec![false; wide * high];
    for (index, (a, b)) in before.pixels.iter().zip(&after.pixels).enumerate().filter(|(_, (a, b))| a != b) {
        debug_assert_ne!(a, b);
        let [x, y] = [index as u32 % after.width, index as u32 / after.width];
        changed[(y / BLOCK) as usize * wide + (x / BLOCK) as usize] = true;
    }
    let area = blocks_around(&changed, wide, [after.width, after.height]);
    let is_changed = |x: i64, y: i64| {
        let inside = x >= 0 && y >= 0 && x < wide as i64 && y < high as i64;
        inside && changed[y as usize * wide + x as usize]
    };
    let is_near = |x: i64, y: i64| (-1..=1).any(|dy| (-1..=1).any(|dx| is_changed(x + dx, y + dy)));
    let mut pixels: Vec<[u8; 4]> = area.rows(&after.pixels, after.width).flatten().copied().collect();
    for (row, pixels) in pixels.chunks_mut(area.width as usize).enumerate() {
        let y = i64::from((area.top + row as u32) / BLOCK);
        for (block, pixels) in pixels.chunks_mut(BLOCK as usize).enumerate() {
            let x = i64::from(area.left / BLOCK) + block as i64;
            if is_changed(x, y) {
                continue;
            }
            let near = is_near(x, y);
            pixels.iter_mut().for_each(|[r, g, b, a]| {
                *a = 0;
                if !near {
                    (*r, *g, *b) = (128, 128, 128);
                }
            });
        }
    }
    (area, pixels)
}

/// The rectangle around changed blocks; the first block where none has changed.
fn blocks_around(changed: &[bool], wide: usize, [width, height]: [u32; 2]) -> Area {
    let mut bounds: Option<[u32; 4]> = None;
    for block in (0..changed.len()).filter(|block| changed[*block]) {
        let (x, y) = ((block % wide) as u32, (block / wide) as u32);
        let [left, top, right, bottom] = bounds.unwrap_or([x, y, x, y]);
        bounds = Some([left.min(x), top.min(y), right.max(x), bottom.max(y)]);
    }
    let [left, top, right, bottom] = bounds.unwrap_or_default();
    let [left, top, right, bottom] = [left, top, right + 1, bottom + 1].map(|side| side * BLOCK);
    Area { left, top, width: right.min(width) - left, height: bottom.min(height) - top }
}
