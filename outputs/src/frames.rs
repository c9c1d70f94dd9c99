//! The frames of a film as PNG files in a folder, numbered from 1: `frame-0001.png`.
//!
//! A picture that is held is a file for each frame, so that the numbers are times. Each file is whole or not there. A
//! folder that has such files already is refused: those of a longer film would be left among the new ones.

use crate::{Destination, FileError};
use phytomer_films::{Encoder, Film};
use phytomer_pictures::{Canvas, Compression, write_png};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The beginning and the end of the names of frames.
const NAME: (&str, &str) = ("frame-", ".png");
/// The least digits of a number.
const LEAST_DIGITS: usize = 4;

/// A folder of frames.
#[derive(Debug)]
pub struct Frames {
    folder: PathBuf,
    note: String,
    digits: usize,
    written: u32,
    bytes: u64,
}

impl Frames {
    /// Makes the folder, and those that it lies in.
    ///
    /// # Errors
    /// The system's; a folder that has frames.
    pub fn create(folder: &Path, film: &Film) -> Result<Self, FileError> {
        let refused = |error| FileError::io("write", folder)(error);
        fs::create_dir_all(folder).map_err(refused)?;
        for entry in fs::read_dir(folder).map_err(refused)? {
            let name = entry.map_err(refused)?.file_name();
            let name = name.to_string_lossy();
            if name.starts_with(NAME.0) && name.ends_with(NAME.1) {
                let told =
                    format!("it has frames of another film, such as {name}: remove them or choose another folder");
                return Err(refused(io::Error::new(io::ErrorKind::AlreadyExists, told)));
            }
        }
        let digits = film.frames.to_string().len().max(LEAST_DIGITS);
        Ok(Self { folder: folder.to_owned(), note: film.note.clone(), digits, written: 0, bytes: 0 })
    }

    /// The bytes of all frames that are written.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

impl Encoder for Frames {
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()> {
        let mut png = Vec::new();
        write_png(canvas, &self.note, Compression::Balanced, &mut png)?;
        for _ in 0..frames {
            self.written += 1;
            let name = format!("{}{:0digits$}{}", NAME.0, self.written, NAME.1, digits = self.digits);
            let mut file = Destination::create(&self.folder.join(name)).map_err(io::Error::other)?;
            file.write_all(&png)?;
            self.bytes += file.finish().map_err(io::Error::other)?;
        }
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        Ok(())
    }
}
