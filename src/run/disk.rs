//! Whether a run fits on its disk, before its first tick.
//!
//! What is expected is what `--dry-run` tells of the tables; meshes and events are not foreseen, and neither is what
//! the plants shed. So this is an estimate, and a person can set it aside (`ignore_disk`): the run then ends by the
//! watch of the run folder before the disk is full, and can be resumed. Of a run to be resumed only the parts that are
//! not there count, and a run to be replaced gives its room back.

use super::Settings;
use super::forecast::Forecast;
use phytomer_config::Resolved;
use phytomer_outputs::{self as outputs, Bytes, Checking, Depth, Error, Mode, Space};
use std::path::{Path, PathBuf};

/// More is expected of a run than its disk has room for.
#[derive(Debug, Clone, thiserror::Error)]
#[error(
    "up to about {needed} of tables are expected and the disk of {} has {free} free, of which a run leaves {reserve}: record \
     fewer ages or tables, grow fewer plants, choose a folder on another disk by --out, or begin all the same with \
     --ignore-disk; nothing was written",
    folder.display()
)]
pub struct TooSmall {
    /// The run folder.
    pub folder: PathBuf,
    /// What is expected.
    pub needed: Bytes,
    /// What is free, with what a replaced run gives back.
    pub free: Bytes,
    /// What a run leaves free.
    pub reserve: Bytes,
}

/// What an earlier run has in the folder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct There {
    /// Bytes that are free once it is replaced.
    pub bytes: u64,
    /// The share of its parts that need not be grown.
    pub share: f64,
}

/// Looks at what is there that matters in the mode of the run: lengths alone, for an estimate.
///
/// # Errors
/// Where the folder cannot be read.
pub fn there(settings: &Settings) -> Result<There, Error> {
    let found = match outputs::check(&settings.folder, Depth::Lengths, &Checking::default()) {
        // What the folder is, is not asked here; opening it tells.
        Err(Error::NotARun { .. } | Error::OlderFormat { .. }) => None,
        found => Some(found?),
    };
    let share = |sound: usize, shards: u32| sound as f64 / f64::from(shards.max(1));
    Ok(match (settings.mode, found) {
        (Mode::Overwrite, Some(found)) => There { bytes: found.bytes, share: 0.0 },
        (Mode::Resume, Some(found)) => {
            There { bytes: 0, share: share(found.sound.len(), found.shards.unwrap_or_default()).min(1.0) }
        }
        _ => There { bytes: 0, share: 0.0 },
    })
}

/// Refuses what cannot fit.
///
/// # Errors
/// [`TooSmall`].
pub fn check_room(needed: f64, there: There, space: Space, folder: &Path) -> Result<(), TooSmall> {
    let needed = needed * (1.0 - there.share);
    let free = space.free.saturating_add(there.bytes);
    if needed <= free.saturating_sub(space.reserve()) as f64 {
        return Ok(());
    }
    let (needed, free, reserve) = (Bytes(needed as u64), Bytes(free), Bytes(space.reserve()));
    Err(TooSmall { folder: folder.to_path_buf(), needed, free, reserve })
}

/// The same for a scenario and its settings; where there is no forecast, or none but a loose bound, or the system tells
/// no free space, nothing is refused.
///
/// # Errors
/// [`TooSmall`].
pub(super) fn check(resolved: &Resolved, settings: &Settings, there: There) -> Result<(), TooSmall> {
    match (Forecast::of(resolved), room(settings)) {
        (Some(forecast), Some(space)) if !settings.ignore_disk && !forecast.is_loose => {
            let share = settings.share.map_or(1.0, |share| 1.0 / f64::from(share.of()));
            check_room(forecast.table_bytes * share, there, space, &settings.folder)
        }
        _ => Ok(()),
    }
}

/// The room on the disk that the run folder is, or would be, on.
pub fn room(settings: &Settings) -> Option<Space> {
    let absolute = std::path::absolute(&settings.folder).ok()?;
    let stands = absolute.ancestors().find(|folder| folder.is_dir())?;
    settings.space.space(stands)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Space = Space { free: 1_000_000_000, total: 100_000_000_000 };

    fn room_for(needed: f64, there: There) -> Result<(), TooSmall> {
        check_room(needed, there, ROOM, Path::new("runs/a"))
    }

    #[test]
    fn a_run_fits_with_what_a_run_leaves_free() {
        let nothing = There { bytes: 0, share: 0.0 };
        assert!(room_for(9.36e8, nothing).is_ok());
        assert!(room_for(9.37e8, nothing).is_err());
        assert!(room_for(9.37e8, There { bytes: 2_000_000, share: 0.0 }).is_ok(), "a replaced run gives back its room");
        assert!(room_for(1.8e9, There { bytes: 0, share: 0.5 }).is_ok(), "half of the parts are there");
        let told = room_for(4.7e12, nothing).unwrap_err().to_string();
        for word in ["4.7 TB", "1.0 GB", "runs/a", "--ignore-disk", "nothing was written"] {
            assert!(told.contains(word), "`{word}` is missing in {told}");
        }
    }
}
