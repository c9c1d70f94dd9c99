//! `cargo +nightly fuzz run asystem`: libFuzzer over `phytomer_fuzz::asystem`.
//!
//! The target itself, and what must come of an input, are in the library; libFuzzer begins with no seeds.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| phytomer_fuzz::asystem(data));
