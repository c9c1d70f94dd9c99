//! Hours of shade on the zones of a plan, and which tree is best planted where (the space planning that Aono & Kunii
//! 1984 name among the uses of their trees).
//!
//! A [`Body`] is what casts a shadow: the triangles of a box, or of a plant by its wood and by what falls with the
//! season. A [`Caster`] is a body in its place. [`Samples`] are points in zones, each with the area that it stands for.
//! [`shade`] follows the sun of a [`Sky`] through the months and tells how long each zone lies in the shade; [`table`]
//! writes it as Parquet and [`drawing`] as SVG. [`arrange`] chooses trees for spots. Absent: plants, files of plans and
//! files at all, which the caller has; slopes, reflections, and leaves that let light through.

pub mod arrange;
mod body;
pub mod drawing;
mod hours;
mod polygon;
mod samples;
mod shadow;
mod sky;
pub mod table;
#[cfg(test)]
mod tests;

pub use body::{Body, Caster, Cause, Triangle};
pub use hours::{MonthOfZone, Shade, Stopped, Watch, shade};
pub use polygon::{Point, Polygon};
pub use samples::{Sample, Samples, TooMany};
pub use sky::{Day, Moment, Sky};
