//! What the loop tells of a plot at each age, and to whom.
//!
//! A recorder is asked once an age whether it wants it, and shown the plot once; and once before, where growth runs
//! ahead. Absent: formats and files.

use crate::clock::Tick;
use crate::plot::Plot;

/// A recorder's failure: it ends the run.
pub type RecordError = Box<dyn std::error::Error + Send + Sync>;

/// Something that keeps what the loop shows it: tables, meshes, measures in a test.
pub trait Recorder {
    /// Whether this age is to be recorded.
    fn wants(&self, age: Tick) -> bool;

    /// Growth has run ahead: the lives of all components are known to the age `until`, before the first age is
    /// recorded. Work that needs no more than that can begin here, while the ages are made ready.
    ///
    /// # Errors
    /// Whatever keeps it from recording; the run then ends.
    fn grown(&mut self, _until: Tick, _plot: &Plot) -> Result<(), RecordError> {
        Ok(())
    }

    /// The plot as it stands at `age`, shed, thickened and posed.
    ///
    /// # Errors
    /// Whatever keeps it from recording; the run then ends.
    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError>;
}

/// Records nothing: for a caller that reads the plants after their growth.
impl Recorder for () {
    fn wants(&self, _: Tick) -> bool {
        false
    }

    fn record(&mut self, _: Tick, _: &Plot) -> Result<(), RecordError> {
        Ok(())
    }
}
