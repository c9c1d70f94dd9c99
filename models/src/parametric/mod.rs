//! Parametric trees: stems and leaves described by few numbers, level by level (Weber & Penn, *Creation and Rendering
//! of Realistic Trees*, 1995).
//!
//! [`Tree`] has the parameters by the paper's names (`params`, in one table by `keys`), `checks` makes them plain
//! [`numbers`]. `equations`, `radius` and `envelope` have the formulas of §4; `path` follows a stem with its clones,
//! `dealt` gives their children places, `prune` shortens them, `grow` goes from level to level, `leaves` adds leaves,
//! and `write` fills the columns of the plant, which `model` rebuilds at any age. `sections` has the lobes and the
//! flare of the trunk. `expectation` has the numbers of stems and leaves in closed form; `sway` moves a tree in the
//! wind (§4.7). The paper's trees have no age; the laws `growth` and `season` are of this program. Decisions where the
//! paper is silent or contradicts itself stand at the formulas, and together in `docs/parametric.md`. Absent:
//! degradation at range (§5), which meshes do; `seen` tells them what it depends on.

mod card;
mod checks;
mod compile;
mod dealt;
mod drawn;
mod draws;
mod envelope;
mod equations;
mod expectation;
mod generation;
mod grow;
mod keys;
mod leaves;
mod looks;
mod model;
pub mod numbers;
pub mod params;
mod path;
mod prune;
mod radius;
mod sections;
mod seen;
#[cfg(test)]
mod specimens;
mod sway;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_contract;
#[cfg(test)]
mod tests_equations;
#[cfg(test)]
mod tests_faults;
#[cfg(test)]
mod tests_leaves;
#[cfg(test)]
mod tests_plant;
#[cfg(test)]
mod tests_prune;
#[cfg(test)]
mod tests_sections;
#[cfg(test)]
mod tests_sway;
mod write;

pub use looks::LeafShape;
pub use model::TreeModel;
pub use params::Tree;
