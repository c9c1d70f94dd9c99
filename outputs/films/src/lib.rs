//! Films: pictures of one size, one after another, into files that play.
//!
//! Each format is a file with an [`Encoder`]: it takes a picture, and for how many frames it is held, and writes it at
//! once, so that memory does not grow with the length of a film. A film that ends early is a whole film of what was
//! drawn until then: what a format says of the whole at its beginning is put right at the end ([`Patched::patch`]). The
//! same pictures give the same bytes. Absent: drawing, which is `phytomer_pictures`'; formats that are written by a
//! program of their own but for the way to it (`ffmpeg`); sound.

mod apng;
mod changed;
pub mod ffmpeg;
mod gif;
mod palette;
#[cfg(test)]
mod tests;
mod time;
mod webp;
mod y4m;

pub use apng::Apng;
pub use gif::{Gif, MOST_FPS as MOST_FPS_OF_GIF};
pub use palette::Palette;
pub use phytomer_meshes::Patched;
pub use time::Timeline;
pub use webp::{MOST_SIDE as MOST_SIDE_OF_WEBP, WebP};
pub use y4m::Y4m;

use phytomer_pictures::Canvas;
use std::io;

/// What is known of a film before its first frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Frames a second, at least 1.
    pub fps: u32,
    /// How many frames it is going to have.
    pub frames: u32,
    /// How many pictures it is going to have; a picture that is held counts once.
    pub pictures: u32,
    /// What the file says of itself, where its format can.
    pub note: String,
}

/// A format of films that is being written.
pub trait Encoder: Send {
    /// Adds an opaque picture of the film's size, shown for so many frames, at least one.
    ///
    /// # Errors
    /// Those of the file; what the format cannot hold.
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()>;

    /// Ends the film after its last picture, of which there has been at least one.
    ///
    /// # Errors
    /// Those of the file.
    fn finish(&mut self) -> io::Result<()>;
}

impl<E: Encoder + ?Sized> Encoder for &mut E {
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()> {
        (**self).picture(canvas, frames)
    }

    fn finish(&mut self) -> io::Result<()> {
        (**self).finish()
    }
}
