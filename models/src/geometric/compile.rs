//! From the parameters of GMT1 to the model: every law compiled and every fault of meaning found before the first tick.
//!
//! Checked are angles that cannot both be 0, branches that are not too small, and levels for which a plant has room.
//! Absent on purpose: the parameters (`gmt1`) and the draws (`laws`).

use super::gmt1::{Gmt1, MOST_LEVELS};
use super::laws::Laws;
use super::model::Gmt1Model;
use crate::fault::{Fault, Path};
use crate::law::Quantity;
use phytomer_sim::clock::{LAST_TICK, Tick};

impl Gmt1 {
    /// Every fault of meaning in the parameters, which stand at `path` in their file.
    pub fn check(&self, path: &Path) -> Vec<Fault> {
        let mut faults = Vec::new();
        self.laws(path, &mut faults);
        faults
    }

    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault that [`Gmt1::check`] finds, and an age past the last tick.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<Gmt1Model, Vec<Fault>> {
        let mut faults = Vec::new();
        let laws = self.laws(path, &mut faults);
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        if faults.is_empty() { Ok(Gmt1Model::new(self, laws)) } else { Err(faults) }
    }

    /// The laws of the parameters; adds every fault in the values that can be drawn.
    fn laws(&self, path: &Path, faults: &mut Vec<Fault>) -> Laws {
        let laws = Laws::compile(self, path, faults);
        laws.check_angles(path, faults);
        self.check_levels(path, faults);
        if faults.is_empty() {
            laws.check_smallest(self.levels.value(), path, faults);
        }
        laws
    }

    fn check_levels(&self, path: &Path, faults: &mut Vec<Fault>) {
        let levels = self.levels.value();
        if levels > MOST_LEVELS {
            let path = match self.levels {
                Quantity::Number(_) => path.key("levels"),
                Quantity::Form(_) => path.key("levels").key("value"),
            };
            let problem = format!("levels is {levels}: a tree of 2^{} branches", u64::from(levels) + 1);
            faults.push(Fault::new(&path, problem, format!("at most {MOST_LEVELS} growth levels")));
        }
    }
}
