//! What must hold between a scenario and its compiled species: sowings that the laws of the date allow, events that the
//! plants can answer, and numbers of components within the limits.
//!
//! Absent: reading, and the checks of a scenario or a species by itself (`validate`, `treatments`).

use std::collections::BTreeSet;
use std::sync::Arc;

use phytomer_sim::model::GrowthModel;

use crate::dates::Dated;
use crate::document::Node;
use crate::explosion;
use crate::load::{Loader, path_of};
use crate::report::Fault;
use crate::scenario::Scenario;
use crate::species::Species;
use crate::trial::{Treatment, Trial};

/// A species that was checked, with the tree that it was read from.
pub(crate) struct Compiled {
    pub species: Species,
    pub model: Arc<dyn GrowthModel>,
    pub tree: Node,
}

/// A checked scenario, its treatments with the calendar of each, and the species of all of them.
pub(crate) struct Checked {
    pub scenario: Scenario,
    pub treatments: Vec<Treatment>,
    pub first: Compiled,
    pub others: Vec<Compiled>,
    pub calendars: Vec<Option<Dated>>,
}

impl Checked {
    /// The species with their indices.
    pub fn species(&self) -> impl Iterator<Item = (usize, &Compiled)> {
        [&self.first].into_iter().chain(&self.others).enumerate()
    }
}

/// Events change plants that keep their past alone.
pub(crate) fn check_cuttable(loader: &mut Loader, node: &Node, checked: &Checked) {
    let managed = checked.treatments.iter().filter(|treatment| !treatment.scenario.event.is_empty());
    let places: BTreeSet<usize> = managed.flat_map(|treatment| treatment.species.iter().copied()).collect();
    let managed = checked.species().filter(|(place, _)| places.contains(place));
    let remade = managed.filter(|(_, of)| !of.model.growth().keeps_its_past());
    let faults = remade.map(|(_, of)| Scenario::fault_of_uncuttable(&of.species.about.name)).collect();
    loader.tell(node, faults);
}

/// A species whose laws depend on the date has one model in each calendar, and so one tick of sowing.
pub(crate) fn check_sowings(loader: &mut Loader, node: &Node, checked: &Checked) {
    if checked.calendars.iter().all(Option::is_none) {
        return;
    }
    let trial = Trial::of(&checked.scenario, &checked.treatments);
    for (place, of) in checked.species().filter(|(_, of)| of.species.may_know_the_date()) {
        if let Some(successor) = trial.successor_of(place) {
            let path = path_of(&["member"]).index(successor).key("replaces");
            let problem = format!(
                "`{}` has laws of the date, and when a successor is planted is not known before the run",
                of.species.about.name
            );
            let expected = "a successor of a species without laws of the date";
            loader.faults.push(Fault::new(node.locate(&path), &path, problem, expected));
        }
        let Some(member) = trial.sown_apart(place) else { continue };
        let path = path_of(&["member"]).index(member).key("sown");
        let problem =
            format!("`{}` has laws of the date, and its members are sown at different ticks", of.species.about.name);
        let expected =
            "one tick of sowing for all members of the species, or a species of their own for the later ones";
        loader.faults.push(Fault::new(node.locate(&path), &path, problem, expected));
    }
}

pub(crate) fn check_explosions(loader: &mut Loader, node: &Node, checked: &Checked) {
    let scenario = &checked.scenario;
    let trial = Trial::of(scenario, &checked.treatments);
    for (place, of) in checked.species() {
        let Some(until) = explosion::foreseen_until(&trial, place) else { continue };
        loader.faults.extend(explosion::fault_of(node, scenario, (&of.species, of.model.as_ref()), until));
    }
}
