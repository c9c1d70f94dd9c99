//! Tables of measured plants: tidy rows with named columns, read into what the estimators take.
//!
//! `table` reads comma-separated values and knows the line of each row; `columns` has the columns of each law and makes
//! its rows, or tells every fault with file and line. Absent: opening files, and Parquet, which the program reads.

pub mod columns;
pub mod observed;
pub mod table;

pub use columns::{Data, Law, read};
pub use table::{Fault, Table};
