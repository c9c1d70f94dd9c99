//! Why a run could not begin, or ended before its time.
//!
//! What tables, meshes and the run folder refuse is told in their own words. A message does not repeat its cause, which
//! `source` has. Absent: what is wrong with the text of a scenario, of which `config` makes a report.

use super::disk::TooSmall;
use phytomer_models::fault::Fault;
use phytomer_outputs::tables::TableError;
use phytomer_sim::model::Overgrown;
use phytomer_sim::{RecordError, Tick};
use std::io;

/// A failure of a run, or of a plant that is grown again.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A table or the run folder refused.
    #[error(transparent)]
    Outputs(#[from] phytomer_outputs::Error),
    /// More is expected than the disk has room for.
    #[error(transparent)]
    TooSmall(#[from] TooSmall),
    /// The species is wrong: its laws, or a mesh that it names. The first of its faults.
    #[error(transparent)]
    Species(Fault),
    /// The meshes that the species names do not hold together, for no reason that a fault tells.
    #[error("the meshes of the species cannot be read")]
    Forms,
    /// A mesh or a picture that the species names cannot be read.
    #[error("cannot read the {what} {name}")]
    Form {
        /// What the file should be.
        what: &'static str,
        /// The file, as the species names it.
        name: String,
        /// The system's answer.
        source: io::Error,
    },
    /// A mesh or a picture that the species names has changed since the run.
    #[error("the {what} {name} is not the one with which the run was made")]
    FormChanged {
        /// What the file is.
        what: &'static str,
        /// The file, as the species names it.
        name: String,
    },
    /// A mesh of the run could not be written.
    #[error("cannot write the mesh {path}")]
    Mesh {
        /// The file.
        path: String,
        /// Why.
        source: io::Error,
    },
    /// The scenario cannot be told in `run.json`.
    #[error("cannot write the scenario as JSON")]
    Scenario(#[source] serde_json::Error),
    /// The system gives no threads.
    #[error("cannot start the threads")]
    Threads(#[source] rayon::ThreadPoolBuildError),
    /// A plant comes to its limit of components before the last age that it is asked for.
    #[error("{limit}, on the way to the age {age}; the last age that is asked for is {last}")]
    Overgrown {
        /// The plant and the limit.
        limit: Overgrown,
        /// The age that it could not finish.
        age: Tick,
        /// The last age that is asked for.
        last: Tick,
    },
    /// A plant comes to its limit of components at its first age, so nothing of it can be shown.
    #[error("{limit} at age {age}")]
    OvergrownAtOnce {
        /// The plant and the limit.
        limit: Overgrown,
        /// The first age.
        age: Tick,
    },
    /// A plant of which nothing can be shown.
    #[error("the seed of plant {plant} did not germinate")]
    NotGerminated {
        /// The plant's number.
        plant: u32,
    },
    /// A plant that an event plants at a tick that is known when its plot has grown.
    #[error("plant {plant} is a successor that an event plants: its plot shows it, with --plot {plot}")]
    Successor {
        /// The plant's number.
        plant: u32,
        /// The number of its plot.
        plot: u32,
    },
    /// The run was told to stop.
    #[error("the run was told to stop")]
    Stopped,
    /// What looks at the plants while they grow has failed.
    #[error(transparent)]
    Recorder(RecordError),
}

impl RunError {
    /// The failure of a recorder, as what it was before it went through the loop of growth.
    pub(super) fn of_recorder(error: RecordError) -> Self {
        let error = match error.downcast::<Self>() {
            Ok(own) => return *own,
            Err(error) => error,
        };
        let error = match error.downcast::<TableError>() {
            Ok(table) => return Self::Outputs((*table).into()),
            Err(error) => error,
        };
        match error.downcast::<phytomer_outputs::Error>() {
            Ok(outputs) => Self::Outputs(*outputs),
            Err(error) => Self::Recorder(error),
        }
    }

    /// The first of the faults of a species, of which a caller that has checked it expects none.
    pub(super) fn of_species(faults: Vec<Fault>) -> Self {
        faults.into_iter().next().map_or(Self::Forms, Self::Species)
    }
}
