//! `cargo +nightly fuzz run exchange`: libFuzzer over `phytomer_fuzz::exchange`.
//!
//! The target itself, and what must come of an input, are in the library; libFuzzer begins with no seeds.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| phytomer_fuzz::exchange(data));
