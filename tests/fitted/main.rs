//! The laws that were fitted to measured plants reproduce their data: grown plants of the shipped species against the
//! counts, by χ² (`docs/fitted-laws.md` has the table, `--nocapture` prints it).
//!
//! Each file has one data set. Seeds are fixed; a law passes at 1 %, and where a law does not fit, the test asserts
//! that it does not. The measured counts are outside the project (`absent`): without them the tests fail in CI, and are
//! skipped elsewhere.

#[path = "../program/absent.rs"]
mod absent;
mod apple;
mod beech;
mod cherry;
mod chi2;
mod coffee;
mod cotton;
mod measured;
mod oak;
mod pine;
mod poplar;
mod simulated;
mod stated;
mod without_data;
