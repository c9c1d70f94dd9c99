//! Wood, weight and wind: how internodes thicken, and how axes bend under what they bear (de Reffye 1988 §5, by the
//! theory of the strength of materials, with Young's modulus).
//!
//! Each tick internodes gain diameter (`secondary`), then loads and shape are brought to equilibrium (`bend`: moments
//! in one reverse scan in `loads`, curvatures and pose in one forward scan in `turn`). The curvature is frozen in the
//! wood ([`crate::plant::Strain`]). Axes right themselves by reaction wood and as young shoots (`uprighting`); `sway`
//! moves a plant of one age in the wind. Absent: twisting, creep and breaking.

mod bend;
mod loads;
mod scratch;
mod secondary;
mod section;
pub mod sway;
mod turn;
mod uprighting;
mod wood;

pub use crate::plant::{Drag, OrganMass, Strain, Thickening, Tissue, Uprighting, Wood};
pub(crate) use bend::pose_bent;
pub use bend::{MOST_STEPS, Outcome, SETTLED, bend};
pub use scratch::Scratch;
pub use secondary::{taper, thicken};
pub use wood::wood_volume;

#[cfg(test)]
mod tests;
