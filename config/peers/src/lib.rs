//! Trees of other programs, read as data and written as species of the parametric model.
//!
//! [`convert`] takes the bytes of a file and gives the text of a species with the names of Weber & Penn 1995, with what
//! became of each key, or the fault with its line and column. Read are Arbaro's XML, the Python dictionaries of
//! tree-gen and Sapling, Helios' library and JSON. Nothing of a file is run, and size, depth and number of values are
//! bounded.
//! `docs/convert.md` tells how keys are mapped. Absent: paths and files, which the caller has; the model.
//!
//! ```
//! use phytomer_peers::{Asked, Format, convert};
//!
//! let text = b"{'shape': '7', 'scale': 13.0, 'baseSize': 0.4, 'levels': 2, 'branches': (0, 50, 30, 10)}";
//! let converted = convert("aspen.py", text, Asked::default()).unwrap();
//! assert_eq!(converted.format, Format::Sapling);
//! assert!(converted.species.contains("1Branches = 50\n"));
//! ```

mod arbaro;
mod fault;
mod format;
mod helios;
mod leaf;
mod literal;
mod mapping;
mod names;
mod paper;
mod reading;
mod sapling;
mod tree_gen;
mod value;
mod writing;
mod xml;

pub use fault::{Fault, Refused};
pub use format::Format;
pub use mapping::{Fate, Told};
pub use reading::{Asked, Converted, Failed, MOST_BYTES, convert};
