//! Grow any plant from seed to death, a million at a time, and query the result like a database.
//!
//! This is the facade: the crates of the house under short names, and [`run`], which makes a run folder out of a
//! scenario; [`fitted`] has species of measured branches; [`forest`] plants a landscape from a raster; [`report`]
//! tells of runs in a page; [`sample`] grows a few plants of a species to hold them against what was published;
//! [`simulate`] tells what plants of other numbers are like; [`cli`] is the whole command line as one function, for the
//! binary and for whoever brings the program along.
//!
//! ```no_run
//! use phytomer::run::{self, Progress, Settings};
//!
//! let resolved = phytomer::config::validate("coffee").map_err(|report| report.render(false)).unwrap();
//! let outcome = run::run(&resolved, &Settings::in_folder("runs/coffee"), &Progress::default()).unwrap();
//! println!("{} components", outcome.report.components);
//! ```

pub use phytomer_analysis as analysis;
pub use phytomer_config as config;
pub use phytomer_fits as fits;
pub use phytomer_models as models;
pub use phytomer_outputs as outputs;
pub use phytomer_sim as sim;
pub use phytomer_weather as weather;

// The verbs speak of this crate by its name.
extern crate self as phytomer;

pub mod architecture;
pub mod asystem;
#[doc(hidden)]
pub mod cli;
pub mod counted;
pub mod fitted;
pub mod forest;
pub mod report;
pub mod run;
pub mod sample;
pub mod shade;
pub mod simulate;
