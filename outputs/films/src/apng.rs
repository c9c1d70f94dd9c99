//! Animated PNG: no pixel is lost, and what knows plain PNG shows the first picture.
//!
//! Pictures are compressed as PNG files are; their data go on into chunks of the animation (PNG third edition, W3C
//! 2025 §4.9 and §11.3.3). Of a picture after the first the rectangle that differs is stored, over what stands. The
//! number of pictures stands near the beginning and is put right where a film ends early.

use crate::changed::Area;
use crate::{Encoder, Film, Patched};
use phytomer_pictures::{Canvas, Compression, write_png};
use std::io;

/// The bytes of a file before its first chunk, and those of the first chunk (IHDR), behind which stands that of the
/// animation.
const SIGNATURE: usize = 8;
const BEFORE: usize = SIGNATURE + 25;
/// The most that 16 bits hold, in which times are told.
const MOST_TIME: u32 = u16::MAX as u32;

/// An animated PNG that is being written.
pub struct Apng<S> {
    out: S,
    film: Film,
    before: Option<Canvas>,
    written: u32,
    /// The number of the next chunk of the animation.
    number: u32,
}

impl<S: Patched> Apng<S> {
    /// Begins a film.
    pub fn new(film: &Film, out: S) -> Self {
        Self { out, film: film.clone(), before: None, written: 0, number: 0 }
    }

    fn chunk(&mut self, kind: &[u8; 4], parts: &[&[u8]]) -> io::Result<()> {
        let length: usize = parts.iter().map(|part| part.len()).sum();
        let length = u32::try_from(length).ok().filter(|length| *length <= i32::MAX as u32);
        let length = length.ok_or_else(|| io::Error::other("a picture is too large for a chunk of PNG"))?;
        let mut sum = crc32fast::Hasher::new();
        sum.update(kind);
        self.out.write_all(&length.to_be_bytes())?;
        self.out.write_all(kind)?;
        for part in parts {
            sum.update(part);
            self.out.write_all(part)?;
        }
        self.out.write_all(&sum.finalize().to_be_bytes())
    }

    /// What the animation says of itself: the number of its pictures, and that it repeats for ever.
    fn about(pictures: u32) -> [u8; 8] {
        let mut about = [0; 8];
        about[..4].copy_from_slice(&pictures.to_be_bytes());
        about
    }

    /// Place and time of the next picture; its own pixels replace what stands.
    fn control(&mut self, area: Area, frames: u32) -> io::Result<()> {
        let (frames, a_second) = match (frames, self.film.fps) {
            (frames, fps) if frames.max(fps) <= MOST_TIME => (frames, fps),
            (frames, fps) => ((frames / fps.max(1)).min(MOST_TIME), 1),
        };
        let mut control = Vec::with_capacity(26);
        for number in [self.number, area.width, area.height, area.left, area.top] {
            control.extend(number.to_be_bytes());
        }
        control.extend((frames as u16).to_be_bytes());
        control.extend((a_second as u16).to_be_bytes());
        control.extend([0, 0]);
        self.number += 1;
        self.chunk(b"fcTL", &[&control])
    }

    /// The first picture is the file that a plain PNG of it would be, with the chunks of the animation.
    fn first(&mut self, file: &[u8], area: Area, frames: u32) -> io::Result<()> {
        self.out.write_all(&file[..BEFORE])?;
        self.chunk(b"acTL", &[&Self::about(self.film.pictures)])?;
        let mut begun = false;
        for (kind, data) in chunks(file).skip(1).filter(|(kind, _)| kind != b"IEND") {
            if &kind == b"IDAT" && !begun {
                begun = true;
                self.control(area, frames)?;
            }
            self.chunk(&kind, &[data])?;
        }
        Ok(())
    }

    fn next(&mut self, file: &[u8], area: Area, frames: u32) -> io::Result<()> {
        self.control(area, frames)?;
        for (_, data) in chunks(file).filter(|(kind, _)| kind == b"IDAT") {
            let number = self.number.to_be_bytes();
            self.number += 1;
            self.chunk(b"fdAT", &[&number, data])?;
        }
        Ok(())
    }
}

impl<S: Patched> Encoder for Apng<S> {
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()> {
        let area = match &self.before {
            None => Area::whole(self.film.size),
            Some(before) => Area::between(&before.pixels, &canvas.pixels, canvas.width),
        };
        let pixels = area.rows(&canvas.pixels, canvas.width).flatten().copied().collect();
        let changed = Canvas { width: area.width, height: area.height, pixels };
        let mut file = Vec::new();
        write_png(&changed, &self.film.note, Compression::Balanced, &mut file)?;
        match self.before {
            None => self.first(&file, area, frames)?,
            Some(_) => self.next(&file, area, frames)?,
        }
        self.before = Some(canvas.clone());
        self.written += 1;
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        self.chunk(b"IEND", &[])?;
        if self.written != self.film.pictures {
            let about = Self::about(self.written);
            let mut sum = crc32fast::Hasher::new();
            sum.update(b"acTL");
            sum.update(&about);
            self.out.patch(BEFORE as u64 + 8, &[&about[..], &sum.finalize().to_be_bytes()].concat())?;
        }
        self.out.flush()
    }
}

/// The chunks of a PNG file: their kinds and their data.
fn chunks(file: &[u8]) -> impl Iterator<Item = ([u8; 4], &[u8])> {
    let mut rest = file.get(SIGNATURE..).unwrap_or_default();
    std::iter::from_fn(move || {
        let (length, after) = rest.split_first_chunk::<4>()?;
        let (kind, after) = after.split_first_chunk::<4>()?;
        let (data, after) = after.split_at_checked(u32::from_be_bytes(*length) as usize)?;
        rest = after.get(4..)?;
        Some((*kind, data))
    })
}
