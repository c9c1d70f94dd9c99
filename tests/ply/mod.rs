//! PLY files as tests read them, without the program's own readers: the header as text, and the bytes behind it.
//!
//! Nothing here knows how a mesh is made. Absent: elements and properties, of which each test reads what it asks.

use std::fs;
use std::path::Path;

/// The header of a PLY file, and what follows it.
pub fn mesh(path: &Path) -> (String, Vec<u8>) {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let end = b"end_header\n";
    let at = bytes.windows(end.len()).position(|window| window == end).expect("a header") + end.len();
    (String::from_utf8_lossy(&bytes[..at]).into_owned(), bytes[at..].to_vec())
}

/// The place that a header tells, metres.
pub fn place_in(header: &str) -> [f64; 3] {
    let line = header.lines().find_map(|line| line.strip_prefix("comment place_m ")).expect("a place");
    let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().expect("a number")).collect();
    numbers.try_into().expect("three numbers")
}

/// The number of an element that a header tells.
pub fn count(header: &str, element: &str) -> usize {
    let line = header.lines().find_map(|line| line.strip_prefix(&format!("element {element} "))).expect("an element");
    line.parse().expect("a count")
}
