//! `cargo +nightly fuzz run run_folder`: libFuzzer over `phytomer_fuzz::run_folder`.
//!
//! The target itself, and what must come of an input, are in the library; the seeds of the bin `minute` are not used.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| phytomer_fuzz::run_folder(data));
