//! The check of each treatment as a whole scenario, and the species that it names.
//!
//! A fault that several treatments have is told once. One that not every treatment has is in a level, and is told with
//! the names of its treatments. Absent: expansion, and the check of species.

use std::collections::{BTreeMap, BTreeSet};

use phytomer_law::fault::{self, Segment};
use phytomer_models::parameters::Keys;
use serde_json::Value as Json;

use crate::document::Node;
use crate::expansion::Expanded;
use crate::load::{Loader, Mention, path_of};
use crate::meaning;
use crate::report::Fault;
use crate::scenario::{Scenario, icasa};
use crate::schema;
use crate::source::Span;
use crate::trial::check_size;

/// The most treatments that a fault names.
const NAMED: usize = 3;

/// A treatment as far as it could be read.
pub(crate) struct Read {
    pub expanded: Expanded,
    pub scenario: Option<Scenario>,
    /// The species that it names, in the order of [`Scenario::species_names`].
    pub species: Vec<Mention>,
}

/// Reads and checks all treatments of a scenario. The faults of the scenario itself are told already.
pub(crate) fn check(
    loader: &mut Loader,
    schema: &Json,
    (node, run): (&Node, Option<&Scenario>),
    all: Vec<Expanded>,
) -> Vec<Read> {
    let told: BTreeSet<_> = loader.faults.iter().map(|fault| (fault.span, fault.problem.clone())).collect();
    let mut findings = Findings::default();
    let mut read = Vec::with_capacity(all.len());
    for expanded in all {
        let mut refused = Vec::new();
        schema::check(schema, &expanded.node, &mut refused);
        icasa::name_keys(&mut refused);
        let scenario = loader.read(&expanded.node, &Keys::PLAIN, &refused, serde_path_to_error::deserialize);
        findings.add(&expanded, refused);
        read.push(Read { species: mentions(&expanded.node), scenario, expanded });
    }
    let plants = plants_of(loader, (node, run), &read);
    let experiment = run.map(|run| &run.experiment).filter(|_| !loader.faults.iter().any(is_of_experiment));
    for Read { expanded, scenario, .. } in &read {
        let faults = scenario.as_ref().map(|scenario| scenario.faults_in_run_of(plants, experiment));
        let faults = faults.unwrap_or_default();
        let placed = faults.into_iter().map(|fault| meaning::place(&loader.sources, &expanded.node, fault)).collect();
        findings.add(expanded, placed);
    }
    loader.faults.extend(findings.told(read.len(), &told));
    read
}

/// Whether a fault is one of the experiment itself, so that its design and its replicates are not known.
fn is_of_experiment(fault: &Fault) -> bool {
    matches!(fault.path.0.as_slice(), [Segment::Key(table), Segment::Key(_)] if table == "experiment")
}

/// Tells what is wrong with the treatments beyond what their scenarios tell by themselves; `faults_of` gets the place
/// of a treatment with its scenario.
pub(crate) fn tell_each(loader: &mut Loader, read: &[Read], faults_of: impl Fn(usize, &Scenario) -> Vec<fault::Fault>) {
    let mut findings = Findings::default();
    for (place, Read { scenario, expanded, .. }) in read.iter().enumerate() {
        let faults = scenario.as_ref().map(|scenario| faults_of(place, scenario)).unwrap_or_default();
        let placed = faults.into_iter().map(|fault| meaning::place(&loader.sources, &expanded.node, fault)).collect();
        findings.add(expanded, placed);
    }
    loader.faults.extend(findings.told(read.len(), &BTreeSet::new()));
}

/// The plants of the whole run; of a run that could not be read, as many as there can be.
fn plants_of(loader: &mut Loader, (node, run): (&Node, Option<&Scenario>), read: &[Read]) -> u32 {
    let scenarios: Option<Vec<&Scenario>> = read.iter().map(|read| read.scenario.as_ref()).collect();
    let (Some(run), Some(scenarios)) = (run, scenarios) else { return u32::MAX };
    check_size(run, scenarios.into_iter()).unwrap_or_else(|fault| {
        loader.faults.push(meaning::place(&loader.sources, node, fault));
        u32::MAX
    })
}

/// What a fault is told by: its place and its problem.
type Key = (Option<Span>, String);

/// The faults of all treatments, each once, with the treatments that have it.
#[derive(Default)]
struct Findings {
    faults: BTreeMap<Key, (Fault, Vec<String>)>,
}

impl Findings {
    fn add(&mut self, of: &Expanded, faults: Vec<Fault>) {
        for fault in faults {
            let key = (fault.span, fault.problem.clone());
            let (_, names) = self.faults.entry(key).or_insert_with(|| (fault, Vec::new()));
            if names.last() != Some(&of.chosen.name) {
                names.push(of.chosen.name.clone());
            }
        }
    }

    /// The faults that are not `told` yet, of so many treatments.
    fn told(self, treatments: usize, told: &BTreeSet<Key>) -> Vec<Fault> {
        let new = self.faults.into_iter().filter(|(key, _)| !told.contains(key));
        let in_words = |(_, (mut fault, names)): (Key, (Fault, Vec<String>))| {
            if names.len() < treatments {
                fault.problem += &in_treatments(&names);
            }
            fault
        };
        new.map(in_words).collect()
    }
}

/// The treatments that have a fault, as the end of a sentence.
fn in_treatments(names: &[String]) -> String {
    let shown: Vec<String> = names.iter().take(NAMED).map(|name| format!("`{name}`")).collect();
    let noun = if names.len() == 1 { "treatment" } else { "treatments" };
    let more = names.len().saturating_sub(NAMED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!(" (in the {noun} {}{more})", shown.join(", "))
}

/// The species that a scenario names, each at the first place where it is named: the scenario's own first, in the order
/// of [`Scenario::species_names`].
fn mentions(scenario: &Node) -> Vec<Mention> {
    let own = (scenario.get("species"), path_of(&["species"]));
    let members = scenario.get("member").map(Node::items).unwrap_or_default().iter().enumerate();
    let members = members.map(|(k, member)| (member.get("species"), path_of(&["member"]).index(k).key("species")));
    let stand = |keys: &[&str]| {
        let items = keys.iter().try_fold(scenario, |node, key| node.get(key)).map(Node::items).unwrap_or_default();
        let path = path_of(keys);
        let named = items.iter().enumerate();
        named.map(|(k, item)| (item.get("species"), path.index(k).key("species"))).collect::<Vec<_>>()
    };
    let of_stand = stand(&["stand", "plant"]).into_iter().chain(stand(&["stand", "layout", "at"]));
    let mut mentions: Vec<Mention> = Vec::new();
    for (value, path) in [own].into_iter().chain(members).chain(of_stand) {
        let Some(value) = value else { continue };
        let Some(name) = value.text().filter(|name| !name.is_empty()) else { continue };
        if mentions.iter().all(|known| known.name != name) {
            mentions.push(Mention { name: name.to_owned(), place: Some((value.span, path)) });
        }
    }
    mentions
}
