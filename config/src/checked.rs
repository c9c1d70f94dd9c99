//! What must hold between a scenario and its compiled species: events that the plants can answer, and numbers of
//! components within the limits.
//!
//! Absent: reading, and the checks of a scenario or a species by itself (`validate`, `treatments`).

use std::collections::BTreeSet;
use std::sync::Arc;

use phytomer_law::fault;
use phytomer_sim::model::GrowthModel;

use crate::dates::Dated;
use crate::document::Node;
use crate::explosion;
use crate::load::{Loader, path_of};
use crate::report::Fault;
use crate::scenario::Scenario;
use crate::species::Species;
use crate::treatments::{self, Read};
use crate::trial::{Treatment, Trial};

/// A species with the tree that it was read from.
pub(crate) struct Stated {
    pub species: Species,
    pub tree: Node,
}

/// A species that was checked, with its model and the tree that it was read from.
pub(crate) struct Compiled {
    pub species: Species,
    pub model: Arc<dyn GrowthModel>,
    pub tree: Node,
}

/// A checked scenario, its treatments with the calendars of each, and the species of all of them.
pub(crate) struct Checked {
    pub scenario: Scenario,
    pub treatments: Vec<Treatment>,
    pub species: Vec<Stated>,
    pub trial: Trial,
    /// The model of each cohort of the trial.
    pub models: Vec<Arc<dyn GrowthModel>>,
    pub calendars: Vec<Option<Dated>>,
}

impl Checked {
    /// The models, each with its place and its species.
    fn models(&self) -> impl Iterator<Item = (usize, &Species, &dyn GrowthModel)> {
        let of_cohorts = self.trial.cohorts().iter().zip(&self.models).enumerate();
        of_cohorts.map(|(place, (cohort, model))| (place, &self.species[cohort.species].species, model.as_ref()))
    }
}

/// Events change plants that keep their past alone.
pub(crate) fn check_cuttable(loader: &mut Loader, node: &Node, checked: &Checked) {
    let managed = checked.treatments.iter().filter(|treatment| !treatment.scenario.event.is_empty());
    let places: BTreeSet<usize> = managed.flat_map(|treatment| treatment.species.iter().copied()).collect();
    let is_managed = |place: usize| places.contains(&checked.trial.cohorts()[place].species);
    let managed = checked.models().filter(|(place, ..)| is_managed(*place));
    let remade = managed.filter(|(_, _, model)| !model.growth().keeps_its_past());
    let faults = remade.map(|(_, species, _)| Scenario::fault_of_uncuttable(&species.about.name)).collect();
    loader.tell(node, faults);
}

/// Constants are those of species that read them: without such a species they have no effect.
pub(crate) fn check_constants(loader: &mut Loader, read: &[Read], checked: &Checked) {
    let reads = |place: &usize| checked.species.get(*place).is_some_and(|of| of.species.reads().surroundings);
    treatments::tell_each(loader, read, |place, scenario| {
        let species = checked.treatments.get(place).map(|treatment| treatment.species.as_slice()).unwrap_or_default();
        let unread = scenario.define.keys().next().filter(|_| !species.iter().any(reads));
        let problem = |_: &String| "no species of this run is an L-system of a file, which alone has constants";
        let fault = unread.map(problem).map(|problem| {
            fault::Fault::new(&path_of(&["define"]), problem, "a species with `model = \"lsystem\"` and `file`")
        });
        fault.into_iter().collect()
    });
}

/// Plants of a plot that claim cells of space from one another have cells of one size.
pub(crate) fn check_cells(loader: &mut Loader, node: &Node, checked: &Checked) {
    let different = (0..checked.treatments.len()).find_map(|treatment| {
        let rows = checked.trial.rows_of_cohorts(treatment);
        rows.iter().find_map(|row| {
            let edges =
                row.iter().enumerate().filter_map(|(member, of)| Some((member, checked.models.get(*of)?.cell_m()?)));
            let edges: Vec<(usize, f64)> = edges.collect();
            let first = edges.first()?.1;
            edges.iter().find(|(_, edge)| *edge != first).map(|(member, edge)| (*member, first, *edge))
        })
    });
    let Some((member, first, edge)) = different else { return };
    let path = path_of(&["member"]).index(member).key("species");
    let problem =
        format!("the plants of a plot share voxels, and those of this member are {edge} m, those of another {first} m");
    let expected = "species with the same `voxel_m` in a plot";
    loader.faults.push(Fault::new(node.locate(&path), &path, problem, expected));
}

/// A successor of a species whose laws depend on the date would need a model for each tick at which it may be planted.
pub(crate) fn check_successors(loader: &mut Loader, node: &Node, checked: &Checked) {
    if checked.calendars.iter().all(Option::is_none) {
        return;
    }
    let known = checked.species.iter().enumerate().filter(|(_, of)| of.species.may_know_the_date());
    for (place, of) in known {
        let Some(successor) = checked.trial.successor_of(place) else { continue };
        let path = path_of(&["member"]).index(successor).key("replaces");
        let problem = format!(
            "`{}` has laws of the date, and when a successor is planted is not known before the run",
            of.species.about.name
        );
        let expected = "a successor of a species without laws of the date";
        loader.faults.push(Fault::new(node.locate(&path), &path, problem, expected));
    }
}

/// A species that explodes in one cohort is told once.
pub(crate) fn check_explosions(loader: &mut Loader, node: &Node, checked: &Checked) {
    let mut told = BTreeSet::new();
    for (place, species, model) in checked.models() {
        let of_species = checked.trial.cohorts()[place].species;
        if told.contains(&of_species) {
            continue;
        }
        let Some(until) = explosion::foreseen_until(&checked.trial, place) else { continue };
        if let Some(fault) = explosion::fault_of(node, &checked.scenario, (species, model), until) {
            loader.faults.push(fault);
            told.insert(of_species);
        }
    }
}
