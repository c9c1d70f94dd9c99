//! The lock of a run folder: a second process that would fill the folder is refused.
//!
//! The system locks `run.lock` as long as a process fills the folder, and frees it when the process ends in any way.
//! The content names the process for people; an empty file means no process. The file is never removed: else a second
//! process could lock a new file of the same name beside the first. Some network file systems have no locks; a run on
//! them reports this ([`Lock::unlockable`]) and goes on.

use super::error::Error;
use super::holder::Holder;
use std::fs::{File, TryLockError};
use std::io::{self, Seek, Write};
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

/// The name of the lock file.
pub const LOCK: &str = "run.lock";

/// The number of attempts before a refusal. A reader holds the lock for a moment while it looks, and a process writes
/// its name only after it has the lock.
const TRIES: u32 = 20;
const PAUSE: Duration = Duration::from_millis(10);

/// The lock of a run folder, held until the value is dropped.
#[derive(Debug)]
pub struct Lock {
    file: File,
    unlockable: Option<String>,
}

impl Lock {
    /// Takes the lock of a folder.
    ///
    /// # Errors
    /// [`Error::InProgress`] where another process has it, or where the file cannot be written.
    pub fn take(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(LOCK);
        let options = File::options().read(true).write(true).create(true).truncate(false).clone();
        let file = options.open(&path).map_err(Error::io("open", &path))?;
        let unlockable = match patiently(|| file.try_lock()) {
            Ok(()) => None,
            Err(TryLockError::Error(error)) => Some(error.to_string()),
            Err(TryLockError::WouldBlock) => {
                return Err(Error::InProgress { path: folder.to_path_buf(), holder: Holder::named_in(&file) });
            }
        };
        let mut lock = Self { file, unlockable };
        lock.name().map_err(Error::io("write", &path))?;
        Ok(lock)
    }

    /// The reason why the file system could not lock the file; `None` where it could.
    pub fn unlockable(&self) -> Option<&str> {
        self.unlockable.as_deref()
    }

    fn name(&mut self) -> io::Result<()> {
        let mut text = serde_json::to_vec(&Holder::this_process())?;
        text.push(b'\n');
        self.file.set_len(0)?;
        self.file.rewind()?;
        self.file.write_all(&text)
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // A name that stays is harmless, since the lock alone decides whether a process fills the folder.
        let _ = self.file.set_len(0);
        // Closing is not enough: a child process that is just starting holds copies of all open files for a moment.
        let _ = self.file.unlock();
    }
}

/// Tries again for a while where another process has the lock.
fn patiently(mut lock: impl FnMut() -> Result<(), TryLockError>) -> Result<(), TryLockError> {
    for _ in 1..TRIES {
        match lock() {
            Err(TryLockError::WouldBlock) => sleep(PAUSE),
            done => return done,
        }
    }
    lock()
}

/// The process that fills a run folder now; `None` without such a process, or where the file system has no locks.
pub fn holder_of(folder: &Path) -> Option<Holder> {
    let file = File::open(folder.join(LOCK)).ok()?;
    match file.try_lock_shared() {
        Err(TryLockError::WouldBlock) => Some(Holder::named_in(&file)),
        _ => {
            let _ = file.unlock();
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_is_refused_by_the_name_of_the_first() {
        let home = tempfile::tempdir().unwrap();
        assert_eq!(holder_of(home.path()), None);
        let lock = Lock::take(home.path()).unwrap();
        assert_eq!(lock.unlockable(), None);
        let Err(Error::InProgress { holder, .. }) = Lock::take(home.path()) else { panic!("two have the lock") };
        if cfg!(unix) {
            assert_eq!(holder.process, Some(std::process::id()));
            assert!(holder.host.is_some() && holder.started.is_some());
        }
        assert!(holder_of(home.path()).is_some());
        drop(lock);
        assert_eq!(holder_of(home.path()), None);
        assert_eq!(std::fs::metadata(home.path().join(LOCK)).unwrap().len(), 0);
        Lock::take(home.path()).unwrap();
    }

    #[test]
    fn a_reader_that_looks_for_a_moment_does_not_refuse_a_run() {
        let home = tempfile::tempdir().unwrap();
        drop(Lock::take(home.path()).unwrap());
        let reader = File::open(home.path().join(LOCK)).unwrap();
        reader.lock_shared().unwrap();
        let releasing = std::thread::spawn(move || {
            sleep(3 * PAUSE);
            drop(reader);
        });
        Lock::take(home.path()).unwrap();
        releasing.join().unwrap();
    }

    #[test]
    fn a_file_system_without_locks_is_not_the_same_as_a_lock_that_is_taken() {
        let mut asked = 0;
        let unsupported = patiently(|| {
            asked += 1;
            Err(TryLockError::Error(io::Error::from(io::ErrorKind::Unsupported)))
        });
        assert!(matches!(unsupported, Err(TryLockError::Error(_))));
        assert_eq!(asked, 1);
    }
}
