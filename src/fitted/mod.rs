//! Geometric trees that were fitted: measured branches out of runs, the species file of a fit, and a picture of the
//! fitted tree beside the data.
//!
//! The estimates are `phytomer_fits::gmt` and `phytomer_fits::proportions`. Absent: the command line.

mod branches;
mod picture;
mod species;

pub use branches::of_run;
pub use picture::{Pictured, picture};
pub use species::{Source, of_branches, of_proportions};
