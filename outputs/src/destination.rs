//! A single output file whose path the user has named, outside a run folder.
//!
//! A new file, or one that replaces a regular file, is written beside its final name and renamed, so that the name
//! always stands for a whole file. A symbolic link stays, and its target is replaced in the same way. A pipe or a
//! device is written directly, and so are the streams of the process below `/dev` and `/proc`. A folder is refused.
//! Absent: the files of a run folder (`run_folder`), and file formats.

use crate::FileError;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The name that stands for stdout.
pub const STDOUT: &str = "-";
/// The paths of stdout on different systems.
const STDOUT_OF_SYSTEMS: [&str; 3] = ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
/// The folders with names of open streams: a link in them is a stream, not a file to be replaced.
const STREAMS: [&str; 2] = ["/dev/fd", "/proc"];
/// The longest chain of links that is followed, as on Linux.
const MOST_LINKS: usize = 40;
/// The most files beside the final file that are skipped; earlier processes with this process number may have left
/// them.
const MOST_BESIDE: u32 = 100;

/// A file that is being written.
#[derive(Debug)]
pub struct Destination {
    named: PathBuf,
    out: BufWriter<Sink>,
    bytes: u64,
    /// The file beside the final file, and the final file; `None` where the bytes are written directly.
    beside: Option<(PathBuf, PathBuf)>,
}

#[derive(Debug)]
enum Sink {
    File(File),
    Stdout(io::Stdout),
}

impl Destination {
    /// Begins to write the file at `path`.
    ///
    /// # Errors
    /// [`FileError::IsFolder`], or the system's error.
    pub fn create(path: &Path) -> Result<Self, FileError> {
        let refused = FileError::io("write", path);
        let begun = |sink, beside| Self { named: path.to_owned(), out: BufWriter::new(sink), bytes: 0, beside };
        if is_stdout(path) {
            return Ok(begun(Sink::Stdout(io::stdout()), None));
        }
        if is_folder(path) {
            return Err(FileError::IsFolder { path: path.to_owned() });
        }
        if is_written_through(path) {
            let file = OpenOptions::new().write(true).open(path).map_err(refused)?;
            return Ok(begun(Sink::File(file), None));
        }
        let (file, beside) = staged(path).map_err(refused)?;
        Ok(begun(Sink::File(file), Some(beside)))
    }

    /// The file beside the final one, for a program that writes it in our place; `None` where the bytes are written
    /// directly, so that they are gone for good.
    pub fn staged(&self) -> Option<&Path> {
        self.beside.as_ref().map(|(beside, _)| beside.as_path())
    }

    /// Writes over bytes that were written before.
    ///
    /// # Errors
    /// The system's; where there is no going back, as in a pipe.
    pub fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        self.out.flush()?;
        let Sink::File(file) = self.out.get_mut() else { return Err(io::ErrorKind::NotSeekable.into()) };
        file.seek(SeekFrom::Start(at))?;
        file.write_all(bytes)?;
        file.seek(SeekFrom::End(0)).map(drop)
    }

    /// Syncs the file and gives it its name; returns its size in bytes.
    ///
    /// # Errors
    /// The system's error. A file that was there before is then unchanged.
    pub fn finish(mut self) -> Result<u64, FileError> {
        self.complete().map_err(FileError::io("write", &self.named))?;
        Ok(self.bytes)
    }

    /// Waits until the bytes so far are on the disk, so that [`Destination::finish`] has little to wait for. The file
    /// has not its name yet.
    ///
    /// # Errors
    /// The system's error.
    pub fn sync(&mut self) -> Result<(), FileError> {
        let synced = self.out.flush().and_then(|()| match (self.out.get_ref(), &self.beside) {
            (Sink::File(file), Some(_)) => file.sync_all(),
            _ => Ok(()),
        });
        synced.map_err(FileError::io("write", &self.named))
    }

    fn complete(&mut self) -> io::Result<()> {
        self.out.flush()?;
        let (Sink::File(file), Some((beside, last))) = (self.out.get_ref(), &self.beside) else { return Ok(()) };
        file.sync_all()?;
        fs::rename(beside, last)?;
        self.beside = None;
        Ok(())
    }
}

/// Whether a path stands for stdout; the program then writes nothing else to stdout.
pub fn is_stdout(path: &Path) -> bool {
    path == Path::new(STDOUT) || STDOUT_OF_SYSTEMS.iter().any(|name| path == Path::new(name))
}

/// Whether a path is that of a folder: of an existing folder, or by the slash at its end.
pub fn is_folder(path: &Path) -> bool {
    let ends_in_slash =
        path.as_os_str().as_encoded_bytes().last().is_some_and(|&byte| std::path::is_separator(byte.into()));
    path.is_dir() || ends_in_slash || path.file_name().is_none()
}

/// Whether a path stands for something other than a regular file: a pipe, a device, a stream of a process.
fn is_written_through(path: &Path) -> bool {
    let is_stream = STREAMS.iter().any(|streams| path.starts_with(streams));
    fs::metadata(path).is_ok_and(|found| is_stream || !found.is_file())
}

/// The path at the end of a chain of symbolic links; the file need not exist.
fn target(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match fs::symlink_metadata(&path) {
            Ok(found) if found.is_symlink() => {
                let next = fs::read_link(&path)?;
                path = path.parent().unwrap_or(Path::new("")).join(next);
            }
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => return Ok(path),
        }
    }
    // For a link to itself the system's own error is returned.
    fs::metadata(&path).and(Err(io::Error::other("too many symbolic links")))
}

/// Creates a file beside the file at `path`, with the permissions of an existing file; returns it with both paths.
fn staged(path: &Path) -> io::Result<(File, (PathBuf, PathBuf))> {
    let last = target(path)?;
    // A file without write permission is not replaced.
    let there = match OpenOptions::new().write(true).open(&last) {
        Ok(file) => Some(file.metadata()?.permissions()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    let (file, beside) = new_beside(&last)?;
    if let Some(permissions) = there {
        file.set_permissions(permissions).inspect_err(|_| _ = fs::remove_file(&beside))?;
    }
    Ok((file, (beside, last)))
}

/// Creates a file in the folder of `last`. Its name is short, so that the name of `last` may be as long as the system
/// allows.
fn new_beside(last: &Path) -> io::Result<(File, PathBuf)> {
    let process = std::process::id();
    let mut number = 0;
    loop {
        let beside = last.with_file_name(format!(".phytomer-{process}-{number}.tmp"));
        match File::create_new(&beside) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && number < MOST_BESIDE => number += 1,
            created => return Ok((created?, beside)),
        }
    }
}

impl Write for Destination {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

impl phytomer_meshes::Patched for Destination {
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        Self::patch(self, at, bytes)
    }
}

/// A file that is not finished is removed.
impl Drop for Destination {
    fn drop(&mut self) {
        if let Some((beside, _)) = &self.beside {
            _ = fs::remove_file(beside);
        }
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.write(bytes),
            Self::Stdout(stdout) => stdout.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(file) => file.flush(),
            Self::Stdout(stdout) => stdout.flush(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::tempdir;

    fn written(path: &Path, text: &str) -> Result<u64, FileError> {
        let mut destination = Destination::create(path)?;
        destination.write_all(text.as_bytes()).map_err(FileError::io("write", path))?;
        destination.finish()
    }

    fn names_in(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_as_a_whole() {
        let folder = tempdir().unwrap();
        let path = folder.path().join("a.ply");
        assert_eq!(written(&path, "first").unwrap(), 5);
        let mut second = Destination::create(&path).unwrap();
        second.write_all(b"second and longer").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"first", "until all is written");
        drop(second);
        assert_eq!((fs::read(&path).unwrap(), names_in(folder.path())), (b"first".to_vec(), vec!["a.ply".to_owned()]));
        written(&path, "2nd").unwrap();
        assert_eq!((fs::read(&path).unwrap(), names_in(folder.path())), (b"2nd".to_vec(), vec!["a.ply".to_owned()]));
    }

    #[test]
    fn a_folder_is_refused() {
        let folder = tempdir().unwrap();
        let new = folder.path().join("new/");
        for path in [folder.path(), &new, Path::new("."), Path::new("..")] {
            assert!(matches!(Destination::create(path), Err(FileError::IsFolder { .. })), "{}", path.display());
        }
        assert!(names_in(folder.path()).is_empty());
    }

    #[test]
    fn a_name_as_long_as_the_system_takes_is_written() {
        let folder = tempdir().unwrap();
        let path = folder.path().join("n".repeat(255));
        written(&path, "x").unwrap();
        assert_eq!(fs::read(path).unwrap(), b"x");
    }

    #[cfg(unix)]
    mod unix {
        use super::*;
        use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

        #[test]
        fn a_link_stays_and_its_target_is_replaced() {
            let folder = tempdir().unwrap();
            let at = |name: &str| folder.path().join(name);
            fs::create_dir(at("deep")).unwrap();
            fs::write(at("deep/target"), "old").unwrap();
            fs::set_permissions(at("deep/target"), fs::Permissions::from_mode(0o640)).unwrap();
            symlink("deep/second", at("first")).unwrap();
            symlink("target", at("deep/second")).unwrap();
            written(&at("first"), "new").unwrap();
            assert_eq!(fs::read(at("deep/target")).unwrap(), b"new");
            assert_eq!(fs::metadata(at("deep/target")).unwrap().permissions().mode() & 0o777, 0o640);
            for link in ["first", "deep/second"] {
                assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink(), "{link}");
            }
            assert_eq!(names_in(&at("deep")), ["second", "target"]);
        }

        #[test]
        fn a_link_to_nothing_makes_its_target_and_a_circle_is_refused() {
            let folder = tempdir().unwrap();
            let at = |name: &str| folder.path().join(name);
            symlink(at("absent"), at("dangling")).unwrap();
            written(&at("dangling"), "new").unwrap();
            assert_eq!(fs::read(at("absent")).unwrap(), b"new");
            symlink("no/folder", at("astray")).unwrap();
            assert!(matches!(written(&at("astray"), "x"), Err(FileError::Io { doing: "write", .. })));
            symlink("circle", at("circle")).unwrap();
            assert!(matches!(written(&at("circle"), "x"), Err(FileError::Io { doing: "write", .. })));
            symlink(".", at("here")).unwrap();
            assert!(matches!(written(&at("here"), "x"), Err(FileError::IsFolder { .. })));
            assert_eq!(names_in(folder.path()), ["absent", "astray", "circle", "dangling", "here"]);
        }

        #[test]
        fn devices_and_pipes_are_written_through() {
            let folder = tempdir().unwrap();
            let path = folder.path().join("pipe");
            assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
            let reader = std::thread::spawn({
                let path = path.clone();
                move || fs::read(path).unwrap()
            });
            assert_eq!(written(&path, "through").unwrap(), 7);
            assert_eq!(reader.join().unwrap(), b"through");
            assert!(fs::symlink_metadata(&path).unwrap().file_type().is_fifo(), "the pipe stays");
            assert_eq!(written(Path::new("/dev/null"), "nothing").unwrap(), 7);
            symlink("/dev/null", folder.path().join("null")).unwrap();
            written(&folder.path().join("null"), "nothing").unwrap();
            assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
        }

        #[cfg(target_os = "linux")]
        #[test]
        fn a_full_device_is_an_error() {
            let told = written(Path::new("/dev/full"), "no room").expect_err("no room");
            assert_eq!(told.to_string(), "cannot write /dev/full");
            let cause = std::error::Error::source(&told).expect("a cause").to_string();
            assert!(cause.starts_with("No space left on device"), "{cause}");
            assert!(fs::metadata("/dev/full").unwrap().file_type().is_char_device());
        }
    }
}
