//! Files on a disk, below tables and run folder: files that are whole or not there, and the watch over the free space.
//!
//! Absent: what the files hold, and what a run is expected to need.

pub mod durable;
mod error;
pub mod space;

pub use error::FileError;
