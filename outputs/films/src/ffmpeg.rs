//! MP4 and WebM: frames go through a pipe to an ffmpeg that is installed, which encodes and writes the file.
//!
//! MP4 has H.264 (libx264), WebM has VP9 (libvpx-vp9); both in BT.709 with a chroma for four pixels, which every player
//! takes, so both sides are even. Which bytes come out is ffmpeg's matter. Absent: any other format that ffmpeg has:
//! `.y4m` goes to every encoder.

use crate::{Encoder, Film};
use phytomer_pictures::Canvas;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;

/// The name of the program, sought on the path.
const PROGRAM: &str = "ffmpeg";

/// Whether it is there.
pub fn is_there() -> bool {
    let mut version = Command::new(PROGRAM);
    version.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    version.status().is_ok_and(|status| status.success())
}

/// A format that ffmpeg writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Container {
    /// H.264 in MP4.
    Mp4,
    /// VP9 in WebM.
    WebM,
}

impl Container {
    /// What ffmpeg is told of the encoding.
    fn words(self) -> &'static [&'static str] {
        match self {
            Self::Mp4 => {
                &["-c:v", "libx264", "-crf", "18", "-preset", "medium", "-movflags", "+faststart", "-f", "mp4"]
            }
            Self::WebM => &["-c:v", "libvpx-vp9", "-crf", "30", "-b:v", "0", "-row-mt", "1", "-f", "webm"],
        }
    }
}

/// An ffmpeg that takes frames.
pub struct Ffmpeg {
    child: Child,
    /// `None` once it has all frames.
    frames: Option<ChildStdin>,
    /// What it says.
    said: Option<JoinHandle<String>>,
    frame: Vec<u8>,
}

impl Ffmpeg {
    /// Starts it; it replaces the file at `path`.
    ///
    /// # Errors
    /// Where it is not there; sides that are odd.
    pub fn start(film: &Film, container: Container, path: &Path) -> io::Result<Self> {
        let [width, height] = film.size;
        if width % 2 + height % 2 > 0 {
            let problem = format!("MP4 and WebM need even sides, and {width}x{height} has an odd one");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        }
        let mut command = Command::new(PROGRAM);
        command.args(["-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]);
        command.args(["-s", &format!("{width}x{height}"), "-framerate", &film.fps.to_string(), "-i", "pipe:0"]);
        command.args(["-vf", "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-colorspace", "bt709"]);
        command.args(["-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv"]);
        command.args(["-metadata", &format!("comment={}", film.note)]).args(container.words()).arg(path);
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        // Ctrl-C in a terminal goes to every process of a group; ffmpeg is to end when its frames do.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn().map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => io::Error::new(error.kind(), "there is no ffmpeg on the path, which writes it"),
            _ => error,
        })?;
        let said = child.stderr.take().map(|mut stderr| {
            std::thread::spawn(move || {
                let mut said = Vec::new();
                let _ = stderr.read_to_end(&mut said);
                String::from_utf8_lossy(&said).trim().to_owned()
            })
        });
        let frames = child.stdin.take();
        Ok(Self { child, frames, said, frame: Vec::new() })
    }

    /// Waits for its end; what it says where it failed.
    fn end(&mut self) -> io::Result<()> {
        drop(self.frames.take());
        let status = self.child.wait()?;
        let said = self.said.take().and_then(|said| said.join().ok()).unwrap_or_default();
        if status.success() {
            return Ok(());
        }
        let said = if said.is_empty() { status.to_string() } else { said };
        Err(io::Error::other(format!("ffmpeg failed: {said}")))
    }
}

impl Encoder for Ffmpeg {
    fn picture(&mut self, canvas: &Canvas, frames: u32) -> io::Result<()> {
        self.frame.clear();
        self.frame.extend(canvas.pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]));
        let frame = &self.frame;
        let sent = self.frames.as_mut().map_or(Ok(()), |out| (0..frames).try_for_each(|_| out.write_all(frame)));
        // Where it takes no more it has ended, and says why.
        sent.or_else(|error| self.end().and(Err(error)))
    }

    fn finish(&mut self) -> io::Result<()> {
        self.end()
    }
}

/// An ffmpeg that is not told to end has no use for its file.
impl Drop for Ffmpeg {
    fn drop(&mut self) {
        if self.frames.take().is_some() {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}
