//! The folder of the parts, beside the run folder, on a disk that all machines see.
//!
//! ```text
//! runs/coffee.parts/
//!   lock                         held by the program that asks for the run
//!   current.json                 the fingerprint of the run, and the number of the asking that holds
//!   0f3a…-00007/                 part 7, whole: a run folder with one part
//!   .0f3a…-00007-…/              part 7 while an executor grows it
//! ```
//!
//! A part is grown in a folder with a name of its own, and renamed when it is whole and on the disk. Two executors may
//! grow the same part: the first to end has grown it, and what the second has grown is removed. So a part is there with
//! all its bytes or not at all. Absent: growing (`worker`), merging (`growing`).

use super::fault::{Fault, Kind};
use super::parts::Grown;
use phytomer::outputs::{Checking, Depth, Share, check};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::time::{SystemTime, UNIX_EPOCH};

/// The file with the asking that holds.
const CURRENT: &str = "current.json";

/// The asking that holds.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Current {
    fingerprint: String,
    submission: String,
}

/// The parts of one run.
#[derive(Debug, Clone)]
pub struct Store {
    folder: PathBuf,
    fingerprint: String,
    shards: u32,
}

impl Store {
    /// The parts of the run with this fingerprint and so many parts.
    pub fn of(folder: &Path, fingerprint: &str, shards: u32) -> Self {
        Self { folder: folder.to_path_buf(), fingerprint: fingerprint.to_owned(), shards }
    }

    /// The folder of parts that belongs to a run folder: `coffee.parts` beside `coffee`.
    pub fn beside(out: &Path) -> PathBuf {
        let name = out.file_name().unwrap_or_default().to_string_lossy();
        out.with_file_name(format!("{name}.parts"))
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The folder of a whole part.
    pub fn part(&self, shard: u32) -> PathBuf {
        self.folder.join(format!("{}-{shard:05}", self.fingerprint))
    }

    /// What a run folder with this part alone has of the run.
    pub fn share(&self, shard: u32) -> Option<Share> {
        Share::new(shard.checked_add(1)?, self.shards)
    }

    /// A new folder for a part that is being grown.
    pub fn attempt(&self, shard: u32) -> PathBuf {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        self.folder.join(format!(".{}-{shard:05}-{}-{}", self.fingerprint, unique(), NEXT.fetch_add(1, Relaxed)))
    }

    /// Gives a part that is whole its name; `false` where another executor was first, and this one is removed.
    ///
    /// # Errors
    /// Where the folder can be neither renamed nor removed.
    pub fn commit(&self, attempt: &Path, shard: u32) -> io::Result<bool> {
        let part = self.part(shard);
        match fs::rename(attempt, &part) {
            Err(_) if part.is_dir() => fs::remove_dir_all(attempt).map(|()| false),
            Err(error) => Err(error),
            // The name survives a crash when its folder is on the disk; systems that cannot sync folders do it alone.
            Ok(()) => File::open(&self.folder).and_then(|folder| folder.sync_all()).or(Ok(())).map(|()| true),
        }
    }

    /// What a part holds that is whole; `None` where it is missing, or a file of it is not as it was written.
    pub fn whole(&self, shard: u32, depth: Depth) -> Option<Grown> {
        let part = self.part(shard);
        let run: Value = serde_json::from_slice(&fs::read(part.join("run.json")).ok()?).ok()?;
        let share = self.share(shard)?.to_string();
        let is_own = run["fingerprint"] == self.fingerprint.as_str() && run["shard"] == share.as_str();
        if !is_own || run["status"] != "complete" || !check(&part, depth, &Checking::default()).ok()?.is_clean() {
            return None;
        }
        let rows = run["rows"].as_object()?.iter().filter_map(|(table, rows)| Some((table.clone(), rows.as_u64()?)));
        Some(Grown { now: false, rows: rows.collect(), bytes: run["bytes"].as_u64()? })
    }

    /// The number of parts that have their name.
    pub fn there(&self) -> u32 {
        (0..self.shards).filter(|shard| self.part(*shard).is_dir()).count() as u32
    }

    /// Whether an asking still holds.
    ///
    /// # Errors
    /// [`Kind::Superseded`] where it does not, [`Kind::NotShared`] where the folder is not seen here.
    pub fn holds(&self, submission: &str) -> Result<(), Fault> {
        let path = self.folder.join(CURRENT);
        let text = fs::read(&path).map_err(|error| {
            let text = format!(
                "{} cannot be read ({error}): every machine must see the folder of the run under the same path",
                path.display()
            );
            Fault::new(Kind::NotShared, text)
        })?;
        let current: Option<Current> = serde_json::from_slice(&text).ok();
        match current {
            Some(current) if current.fingerprint == self.fingerprint && current.submission == submission => Ok(()),
            _ => Err(Fault::new(
                Kind::Superseded,
                "the run was stopped, or was asked for anew, while the part was grown",
            )),
        }
    }
}

/// A number that no other program has: its own, and the time.
fn unique() -> String {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).map(|time| time.as_nanos()).unwrap_or_default();
    format!("{:x}-{now:x}", std::process::id())
}

/// The folder of the parts in the hands of the program that asks for the run: no second one may ask at once.
#[derive(Debug)]
pub struct Held {
    store: Store,
    _lock: File,
}

/// Why the folder of the parts cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// Another program asks for the run.
    #[error("{} is used by another phytomer-cluster: wait for its end or end it", .0.display())]
    InUse(PathBuf),
    /// It holds parts of another run, or of this run where a new one is asked for.
    #[error(
        "{} holds parts of an interrupted run: go on with that run by --resume and the same scenario and program, or begin \
         anew with --overwrite",
        .0.display()
    )]
    Occupied(PathBuf),
    /// The system refused.
    #[error("cannot use {}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
}

impl Held {
    /// Takes the folder. Parts of the same run are kept with `resume`, and all parts are removed with `overwrite`.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn take(store: Store, (resume, overwrite): (bool, bool)) -> Result<Self, StoreError> {
        let folder = store.folder.clone();
        let io = |path: &Path| {
            let path = path.to_path_buf();
            move |source| StoreError::Io { path, source }
        };
        fs::create_dir_all(&folder).map_err(io(&folder))?;
        let path = folder.join("lock");
        let lock = File::create(&path).map_err(io(&path))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(StoreError::InUse(folder)),
            // A file system without locks: as with run folders, two programs would then not be noticed.
            Err(TryLockError::Error(_)) => {}
        }
        let text = fs::read(folder.join(CURRENT)).ok();
        let there: Option<Current> = text.and_then(|text| serde_json::from_slice(&text).ok());
        let same = there.as_ref().is_some_and(|there| there.fingerprint == store.fingerprint);
        if there.is_some() && !overwrite && !(resume && same) {
            return Err(StoreError::Occupied(folder));
        }
        let held = Self { store, _lock: lock };
        if overwrite {
            held.remove_all(|_| true).map_err(io(&folder))?;
        }
        Ok(held)
    }

    /// The parts.
    pub fn store(&self) -> &Store {
        &self.store
    }

    /// Begins a new asking, which ends all earlier ones, and removes what they had begun. Returns its number.
    ///
    /// # Errors
    /// Where the folder cannot be written.
    pub fn begin(&self) -> io::Result<String> {
        let submission = unique();
        self.write(&submission)?;
        self.remove_all(|name| name.starts_with('.'))?;
        Ok(submission)
    }

    /// Ends the asking: executors give up the parts that they grow.
    pub fn stop(&self) {
        // The folder may be gone already, and then nothing is grown.
        let _ = self.write("none");
    }

    fn write(&self, submission: &str) -> io::Result<()> {
        let current = Current { fingerprint: self.store.fingerprint.clone(), submission: submission.to_owned() };
        let beside = self.store.folder.join(format!("{CURRENT}.new"));
        fs::write(&beside, serde_json::to_vec(&current)?)?;
        fs::rename(&beside, self.store.folder.join(CURRENT))
    }

    /// Removes a part, which is then to be grown again.
    ///
    /// # Errors
    /// Where the system refuses.
    pub fn remove(&self, shard: u32) -> io::Result<()> {
        removed(&self.store.part(shard))
    }

    /// Removes the folder with all parts.
    ///
    /// # Errors
    /// Where the system refuses.
    pub fn remove_folder(self) -> io::Result<()> {
        self.stop();
        removed(&self.store.folder)
    }

    fn remove_all(&self, chosen: impl Fn(&str) -> bool) -> io::Result<()> {
        for entry in fs::read_dir(&self.store.folder)? {
            let entry = entry?;
            if entry.path().is_dir() && chosen(&entry.file_name().to_string_lossy()) {
                removed(&entry.path())?;
            }
        }
        Ok(())
    }
}

/// Removes a folder that an executor may be filling or removing at the same time.
fn removed(folder: &Path) -> io::Result<()> {
    let mut tries = 0;
    loop {
        match fs::remove_dir_all(folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(_) if tries < 20 => tries += 1,
            done => return done,
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn held(folder: &Path, fingerprint: &str, mode: (bool, bool)) -> Result<Held, StoreError> {
        Held::take(Store::of(folder, fingerprint, 3), mode)
    }

    #[test]
    fn one_program_at_a_time_and_one_run_at_a_time() {
        let home = tempfile::tempdir().unwrap();
        let folder = Store::beside(&home.path().join("coffee"));
        assert!(folder.ends_with("coffee.parts"));
        let first = held(&folder, "aa", (false, false)).unwrap();
        assert!(matches!(held(&folder, "aa", (true, false)), Err(StoreError::InUse(_))));
        let submission = first.begin().unwrap();
        assert!(first.store().holds(&submission).is_ok());
        drop(first);
        assert!(matches!(held(&folder, "aa", (false, false)), Err(StoreError::Occupied(_))));
        assert!(matches!(held(&folder, "bb", (true, false)), Err(StoreError::Occupied(_))));
        let second = held(&folder, "aa", (true, false)).unwrap();
        second.begin().unwrap();
        assert_eq!(second.store().holds(&submission).unwrap_err().kind, Kind::Superseded);
        drop(second);
        let third = held(&folder, "bb", (false, true)).unwrap();
        third.begin().unwrap();
        third.remove_folder().unwrap();
        assert!(!folder.exists());
        assert_eq!(Store::of(&folder, "aa", 3).holds("x").unwrap_err().kind, Kind::NotShared);
    }

    /// The second of two executors with the same part removes its own, and the first stays as it is.
    #[test]
    fn a_part_gets_its_name_once() {
        let home = tempfile::tempdir().unwrap();
        let store = Store::of(home.path(), "aa", 3);
        let [first, second] = ["first", "second"].map(|text| {
            let folder = store.attempt(1);
            fs::create_dir(&folder).unwrap();
            fs::write(folder.join("text"), text).unwrap();
            folder
        });
        assert_ne!(first, second);
        assert!(store.commit(&first, 1).unwrap());
        assert!(!store.commit(&second, 1).unwrap());
        assert_eq!(fs::read_to_string(store.part(1).join("text")).unwrap(), "first");
        assert_eq!((store.there(), second.exists()), (1, false));
    }
}
