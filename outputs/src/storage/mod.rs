//! Files on a disk, as tables and run folder need them: files that are either whole or absent, and the watch over free
//! space.
//!
//! Absent: the content of files, and the size that a run is expected to need.

pub mod durable;
mod error;
pub mod space;

pub use error::FileError;
