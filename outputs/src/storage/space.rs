//! The free space of a disk, and the watch that ends a run before the disk is full.
//!
//! A full disk harms every program on the machine, and a run that first learns of it from a failed write may have
//! damaged a file of another program. So free space is checked while tables are written, and before each mesh. Where a
//! system does not report its free space, a run goes on without this check. Absent: the size that a run is expected to
//! need. The watch also counts what was written, and how long threads have waited until it was.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// The most bytes that a run leaves free: for writes under way on other threads, for the journal and for other
/// programs.
const RESERVE: u64 = 64_000_000;
/// On a small disk, its total space divided by this number is left free.
const RESERVED_PART: u64 = 20;

/// The number of bytes written between two checks.
const STEP: u64 = 1 << 20;

/// The free and the total space of a disk, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Space {
    /// The bytes that this user may still write.
    pub free: u64,
    /// The size of the disk.
    pub total: u64,
}

impl Space {
    /// The bytes that a run leaves free on this disk.
    pub fn reserve(self) -> u64 {
        RESERVE.min(self.total / RESERVED_PART)
    }
}

/// A source of the free space of a disk: the system, or a test.
pub trait FreeSpace: fmt::Debug + Send + Sync {
    /// The space on the disk of an existing folder; `None` where it is unknown.
    fn space(&self, folder: &Path) -> Option<Space>;
}

/// The free space that the operating system reports.
#[derive(Debug, Clone, Copy)]
pub struct SystemSpace;

impl FreeSpace for SystemSpace {
    fn space(&self, folder: &Path) -> Option<Space> {
        let stats = fs4::statvfs(folder).ok()?;
        Some(Space { free: stats.available_space(), total: stats.total_space() })
    }
}

/// The error of a disk that has less free space than a run leaves.
#[derive(Debug, thiserror::Error)]
#[error("the disk of {} has {free} left, and a run leaves {reserve} free", path.display())]
pub struct AlmostFull {
    /// The folder.
    pub path: PathBuf,
    /// The free bytes.
    pub free: Bytes,
    /// The bytes that a run leaves free.
    pub reserve: Bytes,
}

/// What a thread may wait for that would grow plants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WaitFor {
    /// Columns of a row group that other threads encode.
    Columns = 0,
    /// The disk, which syncs and renames a file.
    Disk = 1,
}

/// Checks the free space of a disk while a run folder is filled.
#[derive(Debug)]
pub struct Watch {
    folder: PathBuf,
    space: Arc<dyn FreeSpace>,
    written: AtomicU64,
    waited_ns: [AtomicU64; 2],
}

impl Watch {
    /// Watches the disk of a folder.
    pub fn over(folder: &Path, space: &Arc<dyn FreeSpace>) -> Arc<Self> {
        Arc::new(Self {
            folder: folder.to_path_buf(),
            space: Arc::clone(space),
            written: AtomicU64::new(0),
            waited_ns: Default::default(),
        })
    }

    /// The number of bytes that were counted so far.
    pub fn written(&self) -> u64 {
        self.written.load(Relaxed)
    }

    /// The time that threads have waited for something of the writer, all together.
    pub fn waited(&self, what: WaitFor) -> Duration {
        Duration::from_nanos(self.waited_ns[what as usize].load(Relaxed))
    }

    /// Does what a thread must wait for, and counts the time.
    pub fn wait<T>(&self, what: WaitFor, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        let waited = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.waited_ns[what as usize].fetch_add(waited, Relaxed);
        result
    }

    /// Counts written bytes without a look at the disk.
    pub fn count(&self, bytes: u64) {
        self.written.fetch_add(bytes, Relaxed);
    }

    /// Counts written bytes, and checks the disk once per megabyte.
    ///
    /// # Errors
    /// As [`Watch::check`].
    pub fn wrote(&self, bytes: u64) -> io::Result<()> {
        let before = self.written.fetch_add(bytes, Relaxed);
        if before / STEP == before.saturating_add(bytes) / STEP { Ok(()) } else { self.check() }
    }

    /// Checks the disk.
    ///
    /// # Errors
    /// `StorageFull` with an [`AlmostFull`] where less is free than a run leaves.
    pub fn check(&self) -> io::Result<()> {
        match self.space.space(&self.folder) {
            Some(space) if space.free < space.reserve() => {
                let (path, free, reserve) = (self.folder.clone(), Bytes(space.free), Bytes(space.reserve()));
                Err(io::Error::new(io::ErrorKind::StorageFull, AlmostFull { path, free, reserve }))
            }
            _ => Ok(()),
        }
    }
}

/// A number of bytes, shown in powers of a thousand: `31.5 MB`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Bytes(pub u64);

impl fmt::Display for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const UNITS: [&str; 7] = ["B", "kB", "MB", "GB", "TB", "PB", "EB"];
        let mut scaled = self.0 as f64;
        let mut unit = 0;
        while scaled >= 999.5 && unit + 1 < UNITS.len() {
            scaled /= 1000.0;
            unit += 1;
        }
        let digits = usize::from(unit > 0 && scaled < 100.0);
        write!(f, "{scaled:.digits$} {}", UNITS[unit])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug)]
    struct Shrinking(AtomicU64);

    impl FreeSpace for Shrinking {
        fn space(&self, _: &Path) -> Option<Space> {
            let free = self.0.fetch_sub(STEP, Relaxed);
            Some(Space { free, total: 1000 * STEP })
        }
    }

    #[test]
    fn the_watch_looks_once_a_step_and_ends_before_the_disk_is_full() {
        let space: Arc<dyn FreeSpace> = Arc::new(Shrinking(AtomicU64::new(54 * STEP)));
        let watch = Watch::over(Path::new("runs/a"), &space);
        let written = (0..).take_while(|_| watch.wrote(STEP / 4).is_ok()).count() as u64;
        // A twentieth of the disk is 50 steps: 54, 53, 52, 51 and 50 are seen, 49 is too little.
        assert_eq!(written / 4, 5);
        let error = watch.check().unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        let told = error.to_string();
        assert!(told.contains("runs/a") && told.contains("52.4 MB"), "{told}");
    }

    #[test]
    fn the_system_tells_its_space() {
        let home = tempfile::tempdir().unwrap();
        let space = SystemSpace.space(home.path()).unwrap();
        assert!(space.free <= space.total && space.reserve() <= RESERVE);
        assert_eq!(SystemSpace.space(&home.path().join("nothing")), None);
    }

    #[test]
    fn bytes_as_people_read_them() {
        let told = [12, 31_460_000, 999_999, 4_700_000_000_000].map(|bytes| Bytes(bytes).to_string());
        assert_eq!(told, ["12 B", "31.5 MB", "1.0 MB", "4.7 TB"]);
    }
}
