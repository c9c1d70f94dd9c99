//! `cargo +nightly fuzz run run_folder`: libFuzzer over `phytomer_fuzz::run_folder`.
//!
//! The target itself, and what must come of an input, are in the library; libFuzzer begins with no seeds.
//! libFuzzer ends at any panic, so also at those of the crate arrow-ipc that `outputs` makes an error of.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| phytomer_fuzz::run_folder(data));
