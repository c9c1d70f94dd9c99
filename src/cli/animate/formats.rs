//! The formats of films by the endings of their names, and the file, the folder or the pipe that takes one.
//!
//! What a format cannot hold is refused before anything grows. Absent: how each is written (`phytomer_outputs::films`).

use super::super::Misuse;
use anyhow::{Context, Result, bail};
use phytomer_outputs::destination::{is_folder, is_stdout};
use phytomer_outputs::films::ffmpeg::{self, Container, Ffmpeg};
use phytomer_outputs::films::{Apng, Encoder, Film, Gif, MOST_FPS_OF_GIF, MOST_SIDE_OF_WEBP, Palette, WebP, Y4m};
use phytomer_outputs::pictures::Canvas;
use phytomer_outputs::{Destination, Frames};
use std::io;
use std::path::Path;

/// A format of films.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    WebP,
    Gif,
    Apng,
    Y4m,
    Ffmpeg(Container),
    Folder,
}

/// The endings of their names.
const ENDINGS: [(&str, Format); 6] = [
    ("webp", Format::WebP),
    ("gif", Format::Gif),
    ("apng", Format::Apng),
    ("y4m", Format::Y4m),
    ("mp4", Format::Ffmpeg(Container::Mp4)),
    ("webm", Format::Ffmpeg(Container::WebM)),
];

impl Format {
    /// The format that a name asks for.
    ///
    /// # Errors
    /// No ending, or one of no film, with those that there are.
    pub fn of(path: &Path) -> Result<Self, Misuse> {
        if is_stdout(path) {
            return Ok(Self::Y4m);
        }
        if is_folder(path) {
            return Ok(Self::Folder);
        }
        let ending = path.extension();
        let known = ENDINGS.iter().find(|(name, _)| ending.is_some_and(|ending| ending.eq_ignore_ascii_case(name)));
        known.map(|(_, format)| *format).ok_or_else(|| {
            let lacks = ending.map_or("the name has no ending".to_owned(), |ending| {
                format!("`animate` cannot write `.{}`", ending.display())
            });
            let endings = ENDINGS.map(|(name, _)| format!(".{name}")).join(", ");
            Misuse(format!(
                "--out {}: {lacks}; the endings that it has: {endings}; a slash at the end makes a folder of PNGs",
                path.display()
            ))
        })
    }

    /// Refuses what the format cannot hold.
    ///
    /// # Errors
    /// By the option that asks for it; an ffmpeg that is not there.
    pub fn check(self, [width, height]: [u32; 2], fps: u32) -> Result<()> {
        let misuse = |told: String| Err(Misuse(told).into());
        match self {
            Self::Gif if fps > MOST_FPS_OF_GIF => {
                misuse(format!("--fps {fps}: a GIF plays at most {MOST_FPS_OF_GIF} frames a second"))
            }
            Self::WebP if width.max(height) > MOST_SIDE_OF_WEBP => {
                misuse(format!("--size {width}x{height}: WebP has at most {MOST_SIDE_OF_WEBP} pixels along a side"))
            }
            Self::Ffmpeg(_) if width % 2 + height % 2 > 0 => {
                misuse(format!("--size {width}x{height}: MP4 and WebM need even sides"))
            }
            Self::Ffmpeg(_) if !ffmpeg::is_there() => bail!(
                "MP4 and WebM are written by ffmpeg, and there is none on the path: install it, or write .webp, .gif, .apng, \
                 .y4m or a folder of PNGs"
            ),
            _ => Ok(()),
        }
    }
}

/// Where a film goes to.
pub struct Output {
    format: Format,
    named: std::path::PathBuf,
    to: To,
}

enum To {
    File(Destination),
    Folder(Frames),
}

impl Output {
    /// Makes the file or the folder.
    ///
    /// # Errors
    /// The system's; a pipe or a device for a format that goes back to its beginning.
    pub fn create(path: &Path, format: Format, film: &Film) -> Result<Self> {
        let to = match format {
            Format::Folder => To::Folder(Frames::create(path, film)?),
            _ => To::File(Destination::create(path)?),
        };
        if let (Format::WebP | Format::Ffmpeg(_), To::File(file)) = (format, &to)
            && file.staged().is_none()
        {
            let shown = path.display();
            return Err(Misuse(format!(
                "--out {shown}: this format goes back to its beginning, which a pipe or a device cannot: write .y4m there"
            ))
            .into());
        }
        Ok(Self { format, named: path.to_owned(), to })
    }

    /// Whether its format learns colours before the first picture.
    pub fn learns(&self) -> bool {
        self.format == Format::Gif
    }

    /// What writes the film.
    ///
    /// # Errors
    /// The system's.
    pub fn encoder<'a>(&'a mut self, film: &Film, quality: u8, samples: &[Canvas]) -> Result<Box<dyn Encoder + 'a>> {
        let doing = || format!("cannot write {}", self.named.display());
        let file = match &mut self.to {
            To::Folder(frames) => return Ok(Box::new(frames)),
            To::File(file) => file,
        };
        let begun: io::Result<Box<dyn Encoder + 'a>> = match (self.format, file.staged().map(Path::to_owned)) {
            (Format::WebP, _) => WebP::new(film, quality, file).map(|film| Box::new(film) as _),
            (Format::Gif, _) => Gif::new(film, Palette::of(samples), file).map(|film| Box::new(film) as _),
            (Format::Apng, _) => Ok(Box::new(Apng::new(film, file))),
            (Format::Ffmpeg(container), Some(path)) => {
                Ffmpeg::start(film, container, &path).map(|film| Box::new(film) as _)
            }
            _ => Y4m::new(film, file).map(|film| Box::new(film) as _),
        };
        begun.with_context(doing)
    }

    /// Gives the file its name, and returns its bytes where they can be counted.
    ///
    /// # Errors
    /// The system's.
    pub fn finish(self) -> Result<Option<u64>> {
        Ok(match (self.to, self.format) {
            (To::Folder(frames), _) => Some(frames.bytes()),
            (To::File(file), Format::Ffmpeg(_)) => {
                file.finish()?;
                std::fs::metadata(&self.named).ok().map(|file| file.len())
            }
            (To::File(file), _) => Some(file.finish()?),
        })
    }
}
