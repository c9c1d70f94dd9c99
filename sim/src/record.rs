//! What the loop tells of a plot at each tick, and to whom.
//!
//! A recorder is asked once a tick whether it wants it, and shown the plot once; and once before, where growth runs
//! ahead. The ticks are those of the plot; the age of a member is `Member::age_at` the tick. Absent: formats and files.

use crate::clock::Tick;
use crate::plot::Plot;

/// A recorder's failure: it ends the run.
pub type RecordError = Box<dyn std::error::Error + Send + Sync>;

/// Something that keeps what the loop shows it: tables, meshes, measures in a test.
pub trait Recorder {
    /// Whether this tick of the plot is to be recorded.
    fn wants(&self, tick: Tick) -> bool;

    /// Growth has run ahead: the lives of all components are known to the tick `until`, before the first tick is
    /// recorded. Work that needs no more than that can begin now, while the plants are made ready.
    ///
    /// # Errors
    /// Whatever keeps it from recording; the run then ends.
    fn grown(&mut self, _until: Tick, _plot: &Plot) -> Result<(), RecordError> {
        Ok(())
    }

    /// The plot as it stands at `tick`: the members that are sown by then are shed, thickened and posed.
    ///
    /// # Errors
    /// Whatever keeps it from recording; the run then ends.
    fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), RecordError>;
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
