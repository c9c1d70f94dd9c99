//! From measured branches to a geometric tree: angles, ratios, the ratio of diameters, divergence, a uniform deviation
//! and the category of the angles (Aono & Kunii 1984, "Parameter fitting", Figs. 14 and 16, Table 3).
//!
//! `skeleton` reads branches, `fork` measures a branching by the equations of GMT1 read backwards, `labels` tells
//! which child is which, `search` finds the rule that leaves the least, `estimate` states it with t intervals of any
//! level. The model that is taken is the one of the least BIC (`choice`). Absent: controllers, which a single point
//! pulls all tips by and which the branches of one tree do not tell from other things that bend; trees that are
//! combined or glued.

pub mod estimate;
pub mod fork;
mod labels;
pub mod levels;
mod regress;
mod rule;
mod search;
pub mod skeleton;

pub use estimate::{Fitted, TreeModel, Wish, fit};
pub use levels::{LevelMeans, Mean};
pub use rule::Course;
pub use skeleton::{Branch, Piece, Skeleton};
