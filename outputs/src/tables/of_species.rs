//! What rows have of the species of their plant: its number in the run, the names of its states, the ticks of its year.
//!
//! A plant knows its model, and a run may have several models of one species. Absent: the parameters of the species,
//! which `run.json` has.

use super::{Membership, RunPlan};

/// What the rows of plants have of their species, by the models of a run.
#[derive(Debug, Clone, Default)]
pub struct OfSpecies {
    species_of_models: Vec<usize>,
    states: Vec<Vec<i32>>,
    ticks_per_year: Vec<Option<f64>>,
}

impl OfSpecies {
    /// That of the species of a plan.
    pub fn of(plan: &RunPlan) -> Self {
        Self {
            species_of_models: plan.species_of_models.clone(),
            states: plan.provenance.places_of_states(),
            ticks_per_year: plan.provenance.ticks_per_year.clone(),
        }
    }

    /// The species of a plant, as an index into the run's list of species; a species is its own model beyond the list.
    pub fn number(&self, of: Membership) -> usize {
        self.species_of_models.get(of.species).copied().unwrap_or(of.species)
    }

    /// The names of the states of a plant's species, by their numbers, as indices into the run's list of names.
    pub fn states(&self, of: Membership) -> &[i32] {
        self.states.get(self.number(of)).map_or(&[], Vec::as_slice)
    }

    /// The ticks of a year of a plant's species, where it states them.
    pub fn ticks_per_year(&self, of: Membership) -> Option<f64> {
        self.ticks_per_year.get(self.number(of)).copied().flatten()
    }
}
