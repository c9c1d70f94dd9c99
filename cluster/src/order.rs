//! What executors are asked for: a scenario, with the numbers that replace its own, and the folder of its parts.
//!
//! Each executor reads and checks the scenario itself, and compares what it found with the fingerprint of the run, so
//! that no machine grows another scenario. Absent: which part, which the rows say (`parts`).

use phytomer::config::{Report, Resolved, validate};
use phytomer::run::forms;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A scenario as a command line states it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stated {
    /// A shipped scenario or species by its name, or a file by its path, which leads to it on every machine.
    pub scenario: String,
    /// The seed of every draw in the place of the scenario's.
    pub seed: Option<u64>,
    /// The number of plants in the place of the scenario's.
    pub plants: Option<u32>,
}

impl Stated {
    /// The same with the path of a file from the root on, so that it does not depend on where a program was started.
    #[must_use]
    pub fn from_the_root(mut self) -> Self {
        if Path::new(&self.scenario).is_file()
            && let Ok(path) = std::path::absolute(&self.scenario)
            && let Some(path) = path.to_str()
        {
            path.clone_into(&mut self.scenario);
        }
        self
    }

    /// Reads and checks it.
    ///
    /// # Errors
    /// Every fault of the scenario, of its species, and of the numbers that replace its own.
    pub fn resolved(&self) -> Result<Resolved, Report> {
        let mut resolved = validate(&self.scenario)?;
        forms::settle(&mut resolved)?;
        if let Some(seed) = self.seed {
            resolved.reseed(seed)?;
        }
        if let Some(plants) = self.plants {
            resolved.grow_only(plants);
            let faults: Vec<_> = resolved.faults().into_iter().map(|(_, fault)| fault).collect();
            if !faults.is_empty() {
                return Err(resolved.report(faults));
            }
        }
        Ok(resolved)
    }
}

/// What every executor is told of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Order {
    /// The version of the program that asks.
    pub version: String,
    /// The commit that it was built from.
    pub git_hash: String,
    /// The scenario.
    pub stated: Stated,
    /// The fingerprint of the run: a short hash of everything that its bytes depend on.
    pub fingerprint: String,
    /// The number of its parts.
    pub shards: u32,
    /// The folder of the parts, which every machine sees under this path.
    pub folder: PathBuf,
    /// The number of this asking; parts of an earlier one are not gone on with.
    pub submission: String,
    /// Whether parts begin that the disk seems too small for.
    pub ignore_disk: bool,
}
