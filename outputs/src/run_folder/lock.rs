//! The lock of a run folder: of two processes that would fill it, the second is refused.
//!
//! `run.lock` is locked by the system for as long as a process fills the folder, and freed by it when that process
//! ends, however it ends. Its content names the process, for people; an empty one says that nobody is there. The file
//! is never removed: a second process could then lock a new file of that name beside the first one. Some network file
//! systems know no locks; a run in one of them says so ([`Lock::unlockable`]) and goes on.

use crate::Error;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::fs::{File, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// The name of the file.
pub const LOCK: &str = "run.lock";

/// A reader holds the lock for a moment while it looks, and the holder writes its name after it has the lock: so a
/// refusal waits a little.
const TRIES: u32 = 20;
const PAUSE: Duration = Duration::from_millis(10);

/// The longest name that is read.
const MOST_BYTES: u64 = 4096;

/// A process that fills a run folder; what of it is not known is `None`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Holder {
    /// Its number.
    pub process: Option<u32>,
    /// The machine that it runs on.
    pub host: Option<String>,
    /// When it began, in UTC.
    pub started: Option<String>,
}

impl Holder {
    fn this_process() -> Self {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Self { process: Some(std::process::id()), host: host(), started: Some(in_utc(now.as_secs())) }
    }

    /// The name in a lock file; on Windows nobody but the holder can read it.
    fn named_in(file: &File) -> Self {
        let mut text = Vec::new();
        let read = file.take(MOST_BYTES).read_to_end(&mut text);
        read.ok().and_then(|_| serde_json::from_slice(&text).ok()).unwrap_or_default()
    }
}

impl fmt::Display for Holder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.process {
            Some(process) => write!(f, "process {process}")?,
            None => write!(f, "another process")?,
        }
        self.host.iter().try_for_each(|host| write!(f, " on {host}"))?;
        self.started.iter().try_for_each(|started| write!(f, ", started {started}"))
    }
}

/// The lock, held until this is dropped.
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

    /// Why the file system could not lock the file, where it could not.
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
        // A name that stays does no harm: only the lock says whether somebody is there.
        let _ = self.file.set_len(0);
        // Closing would do, but a child process that is just being started holds copies of all open files for a moment.
        let _ = self.file.unlock();
    }
}

/// Tries again for a while where another has the lock.
fn patiently(mut lock: impl FnMut() -> Result<(), TryLockError>) -> Result<(), TryLockError> {
    for _ in 1..TRIES {
        match lock() {
            Err(TryLockError::WouldBlock) => sleep(PAUSE),
            done => return done,
        }
    }
    lock()
}

/// Who fills a run folder now; `None` where nobody does, or where the file system does not tell.
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

#[cfg(unix)]
fn host() -> Option<String> {
    Some(rustix::system::uname().nodename().to_string_lossy().into_owned())
}

#[cfg(not(unix))]
fn host() -> Option<String> {
    std::env::var("COMPUTERNAME").ok()
}

/// Seconds since 1970 as a date and a time; the date by Hinnant's `civil_from_days`.
fn in_utc(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    let since_march = days + 719_468;
    let (era, day_of_era) = (since_march / 146_097, since_march % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_of_the_calendar() {
        assert_eq!(in_utc(0), "1970-01-01 00:00:00 UTC");
        assert_eq!(in_utc(951_782_399), "2000-02-28 23:59:59 UTC");
        assert_eq!(in_utc(951_868_800), "2000-03-01 00:00:00 UTC");
        assert_eq!(in_utc(4_107_542_400), "2100-03-01 00:00:00 UTC");
    }

    #[test]
    fn the_second_is_refused_by_the_name_of_the_first() {
        let home = tempfile::tempdir().unwrap();
        assert_eq!(holder_of(home.path()), None);
        let lock = Lock::take(home.path()).unwrap();
        assert_eq!(lock.unlockable(), None);
        let Err(Error::InProgress { holder, .. }) = Lock::take(home.path()) else { panic!("two have the lock") };
        if cfg!(unix) {
            assert_eq!((holder.process, holder.host.clone()), (Some(std::process::id()), host()));
            assert!(holder.started.is_some());
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
