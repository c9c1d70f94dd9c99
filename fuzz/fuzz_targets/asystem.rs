//! `cargo +nightly fuzz run asystem`: libFuzzer over `phytomer_fuzz::asystem`.
//!
//! The target itself, and what must come of an input, are in the library; the seeds of the bin `minute` are not used.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| phytomer_fuzz::asystem(data));
