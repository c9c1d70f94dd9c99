//! Files that are either whole or absent: written beside their final name, synced, then renamed.
//!
//! A crash at any moment leaves the old file, the new file, or a file beside its name, which a resumed run removes.

use super::error::FileError;
use super::space::{WaitFor, Watch};
use sha2::{Digest, Sha256};
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::{self, JoinHandle};

/// The number of bytes that are synced at a time, while the next bytes are made. So little is left to sync at the end
/// of a large file.
const SENT_AT_ONCE: u64 = 32 << 20;

/// A new file that is hashed as it is written.
#[derive(Debug)]
pub struct HashingFile {
    file: File,
    path: PathBuf,
    hash: Sha256,
    bytes: u64,
    sent: u64,
    sending: Option<JoinHandle<io::Result<()>>>,
    watch: Arc<Watch>,
}

impl HashingFile {
    /// Creates the file, replacing an existing file; `watch` checks the free space of the disk as the file grows.
    pub fn create(path: &Path, watch: &Arc<Watch>) -> Result<Self, FileError> {
        let file = File::create(path).map_err(FileError::io("create", path))?;
        let (path, watch) = (path.to_path_buf(), Arc::clone(watch));
        Ok(Self { file, path, hash: Sha256::new(), bytes: 0, sent: 0, sending: None, watch })
    }

    /// Syncs the file; returns its size in bytes and its SHA-256 in hexadecimal.
    pub fn finish(mut self) -> Result<(u64, String), FileError> {
        // The system reports a lost block once, to the first call that asks, so the background syncs are checked first.
        let watch = Arc::clone(&self.watch);
        watch
            .wait(WaitFor::Disk, || self.sent().and_then(|()| self.file.sync_all()))
            .map_err(FileError::io("write to disk", &self.path))?;
        Ok((self.bytes, hexadecimal(&self.hash.finalize())))
    }

    /// Starts to sync the written bytes on a thread of its own; while an earlier sync runs, the next call starts it.
    fn send(&mut self) -> io::Result<()> {
        if self.sending.as_ref().is_some_and(|sending| !sending.is_finished()) {
            return Ok(());
        }
        self.sent()?;
        let file = self.file.try_clone()?;
        // Where no thread can start, the bytes are synced with the next piece, or at the end of the file.
        self.sending = thread::Builder::new().name("sync".to_owned()).spawn(move || file.sync_data()).ok();
        self.sent = self.bytes;
        Ok(())
    }

    /// Waits for the sync under way and returns its result.
    fn sent(&mut self) -> io::Result<()> {
        let Some(sending) = self.sending.take() else { return Ok(()) };
        sending.join().unwrap_or_else(|_| Err(io::Error::other("the thread that syncs the file has ended")))
    }
}

impl Write for HashingFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        self.watch.wrote(written as u64)?;
        if self.bytes - self.sent >= SENT_AT_ONCE {
            self.send()?;
        }
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The name beside `path` under which the file is written before it is renamed.
pub fn beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.tmp"))
}

/// Whether a file has a name that [`beside`] makes.
pub fn is_beside(path: &Path) -> bool {
    path.file_name().is_some_and(|name| {
        let name = name.to_string_lossy();
        name.starts_with('.') && name.ends_with(".tmp")
    })
}

/// Writes a small file as a whole.
pub fn write(path: &Path, content: &[u8]) -> Result<(), FileError> {
    let staged = beside(path);
    let mut file = File::create(&staged).map_err(FileError::io("create", &staged))?;
    file.write_all(content).map_err(FileError::io("write", &staged))?;
    file.sync_all().map_err(FileError::io("write to disk", &staged))?;
    rename(&staged, path)
}

/// Gives a synced file its final name, and syncs the folder.
pub fn rename(from: &Path, to: &Path) -> Result<(), FileError> {
    fs::rename(from, to).map_err(FileError::io("rename", from))?;
    sync_folder_of(to)
}

/// Syncs the folder of `path`, so that the names in it survive a crash; does nothing where a system cannot.
pub fn sync_folder_of(path: &Path) -> Result<(), FileError> {
    let Some(folder) = path.parent().filter(|folder| cfg!(unix) && !folder.as_os_str().is_empty()) else {
        return Ok(());
    };
    File::open(folder).and_then(|folder| folder.sync_all()).map_err(FileError::io("write to disk", folder))
}

/// Syncs a file that other code has written; returns its size in bytes and its SHA-256 in hexadecimal.
pub fn sync_and_hash(path: &Path) -> Result<(u64, String), FileError> {
    let mut file = File::open(path).map_err(FileError::io("open", path))?;
    file.sync_all().map_err(FileError::io("write to disk", path))?;
    hash(&mut file, |_| Ok(())).map_err(FileError::io("read", path))
}

/// The size in bytes and the SHA-256 of a file. `progress` is called with the size of each block, and can end the
/// reading by an error.
pub fn hash(file: &mut File, mut progress: impl FnMut(u64) -> io::Result<()>) -> io::Result<(u64, String)> {
    let mut hash = Sha256::new();
    let mut block = vec![0; 1 << 20];
    let mut bytes = 0;
    loop {
        let read = file.read(&mut block)?;
        if read == 0 {
            return Ok((bytes, hexadecimal(&hash.finalize())));
        }
        hash.update(&block[..read]);
        bytes += read as u64;
        progress(read as u64)?;
    }
}

/// Removes a file; does nothing where there is no such file.
pub fn remove(path: &Path) -> Result<(), FileError> {
    match fs::remove_file(path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => Err(FileError::io("remove", path)(source)),
        _ => Ok(()),
    }
}

/// The files directly in a folder, sorted by name; empty where there is no folder.
pub fn files_in(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let entries = match fs::read_dir(folder) {
        Err(source) if source.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(FileError::io("read", folder))?,
    };
    let mut files = Vec::new();
    for entry in entries {
        files.push(entry.map_err(FileError::io("read", folder))?.path());
    }
    files.sort();
    Ok(files)
}

/// The SHA-256 of some bytes, in hexadecimal.
pub fn sha256_of(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
