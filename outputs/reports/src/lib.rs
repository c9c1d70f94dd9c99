//! A report as one HTML file without any script: text, charts, pictures and tables.
//!
//! A [`Chart`] is data with units. It is drawn as SVG and PNG by the crate kuva, and told as CSV and as a specification
//! of Vega-Lite, so that a figure, its table and its specification never differ. A [`Report`] is written as a page that
//! asks for nothing beyond itself. Absent: what a report of a run says, which the program decides, and statistics.

mod chart;
mod drawn;
mod escape;
mod page;
mod table;
mod vega;

#[cfg(test)]
mod tests;

pub use chart::{Axis, Chart, Contrast, Contrasts, Mark, Plotted, Point, Series};
pub use drawn::{png, svg};
pub use page::{Figure, Part, Picture, Report, Section, page};
pub use table::{Cell, Table};
pub use vega::vega_lite;
