//! The conditions of a closed form: laws that depend only on what is known of a cohort, and the axes whose end matters
//! to organs that have not appeared yet.
//!
//! Absent: the sums (`cohort`, `lost`).

use super::cohort::Births;
use super::frame;
use super::unit::longest_wait;
use crate::buds::compile::{Branching, BudModel, Chance, NodeLaws, OrderLaws};
use crate::law::{CountTable, Variable};
use phytomer_sim::expectation::Certainty;

/// The variables that are known for the axes of a cohort; their states are followed beside these.
const KNOWN: &[Variable] = &[Variable::Age, Variable::Dimension, Variable::Cycle, Variable::Rank];

/// The variables of [`KNOWN`] without the rank: the laws of a terminal flower are evaluated at the rank of its bearing
/// node, by which the axes of a cohort are not counted apart.
const KNOWN_OF_APICES: &[Variable] = &[Variable::Age, Variable::Dimension, Variable::Cycle];

/// The certainty of the means of axes, growth units and nodes.
pub fn of_axes(model: &BudModel) -> Certainty {
    if !model.orders.iter().all(axes_are_of_cohorts) {
        return Certainty::About;
    }
    match model.orders.iter().all(frame::tells_short_axes) {
        true => Certainty::Exact,
        false => Certainty::AtMost,
    }
}

/// The certainty of the means of organs, where no organ is lost with its branch before it appears.
pub fn of_organs(model: &BudModel) -> Certainty {
    if model.orders.iter().all(organs_are_of_cohorts) { of_axes(model) } else { Certainty::About }
}

fn axes_are_of_cohorts(laws: &OrderLaws) -> bool {
    let (step, node, end) = (&laws.step, &laws.node, &laws.end);
    let chances = [&step.death, &step.pause, &step.flower, &step.short];
    let chances = chances.into_iter().chain(step.transitions.iter().map(|passage| &passage.chance));
    let counts = [&step.per_step, &step.long_nodes, &step.short_nodes, &step.neoformed, &end.below];
    let counts = counts.into_iter().chain(&laws.head.units).chain(&end.persists);
    let branchings = [&node.axillary, &node.reiteration, &end.relay, &end.traumatic];
    let mut branchings = branchings.into_iter().chain(&end.fork);
    let of_branching = |of: &Branching| {
        let counts: [&CountTable; 2] = [&of.count.table, &of.delay.table];
        of.chance.asks_only(KNOWN) && counts.iter().all(|table| table.asks_only(KNOWN))
    };
    chances.into_iter().all(|of| of.asks_only(KNOWN))
        && counts.map(|of| &of.table).all(|table| table.asks_only(KNOWN))
        && branchings.all(of_branching)
        && step.zone_ranks.ask_only(KNOWN)
        && node.zones.as_ref().is_none_or(|zones| zones.ask_only(KNOWN))
}

fn organs_are_of_cohorts(laws: &OrderLaws) -> bool {
    let node = &laws.node;
    let counts = [&node.leaves, &node.flowers, &node.flower_delay, &node.flower_life, &node.fruit_life];
    counts.iter().all(|count| count.table.asks_only(KNOWN))
        && node.flower_opens.asks_only(KNOWN)
        && node.fruit_set.asks_only(KNOWN)
        && (laws.step.flower.is_never() || terminal_flowers_are_of_cohorts(node))
}

fn terminal_flowers_are_of_cohorts(node: &NodeLaws) -> bool {
    let lives = [&node.flower_life, &node.fruit_life];
    node.fruit_set.asks_only(KNOWN_OF_APICES) && lives.iter().all(|life| life.table.asks_only(KNOWN_OF_APICES))
}

/// Axes that start in one state, by place of their order and the state.
type Start = (usize, u8);

/// The axes on which organs may be lost, and all axes that these may bear.
#[derive(Debug, Default)]
pub struct Needs {
    /// The places of orders and the states in which such axes start, in ascending order.
    pub starts: Vec<Start>,
}

impl Needs {
    /// The axes among `born` on which organs may be lost, and all that these may bear. `None` where the death of such
    /// branches has no closed form here: where dormant buds are released, or growth units draw the ranks of their
    /// zones.
    pub fn of(model: &BudModel, born: &Births) -> Option<Self> {
        let states = 0..model.states as u8;
        let all = (0..model.orders.len()).flat_map(|order| states.clone().map(move |state| (order, state)));
        let is_born = |&(order, state): &Start| {
            let classes = &born[order][2 * usize::from(state)..][..2];
            classes.iter().flatten().any(|born| *born > 0.0)
        };
        let mut starts: Vec<Start> = all.filter(is_born).filter(|start| loses(model, *start)).collect();
        let mut next = 0;
        while let Some(&(order, state)) = starts.get(next) {
            let laws = &model.orders[order];
            let bears = laws.node.axillary.count.table.max() > 0 && model.has_order(laws.number + 1);
            if !laws.end.traumatic.chance.is_never() || bears && laws.step.zone_ranks.are_drawn() {
                return None;
            }
            let borne = reached(laws, state).into_iter().flat_map(|state| borne_in(model, order, state));
            let new: Vec<Start> = borne.filter(|start| !starts.contains(start)).collect();
            new.into_iter().for_each(|start| {
                if !starts.contains(&start) {
                    starts.push(start)
                }
            });
            next += 1;
        }
        starts.sort_unstable();
        Some(Self { starts })
    }
}

/// Whether axes can end while organs of theirs have not appeared yet, or at the tick at which one appears.
fn loses(model: &BudModel, (order, state): Start) -> bool {
    let laws = &model.orders[order];
    let (step, node) = (&laws.step, &laws.node);
    let states = reached(laws, state);
    let happens = |chance: &Chance| states.iter().any(|state| !chance.is_never_in(*state));
    let ends = happens(&step.death) || happens(&step.flower) || laws.head.units.is_some();
    let flowers = node.flowers.table.max() > 0 && happens(&node.flower_opens);
    let leaves = node.leaves.table.max() > 0;
    ends && (flowers && longest_wait(node) > 0 || ends_at_birth(laws) && (flowers || leaves))
}

/// Whether an axis can be dead at the tick at which it made a node.
fn ends_at_birth(laws: &OrderLaws) -> bool {
    let persists = laws.end.persists.as_ref().map_or(0, |ticks| ticks.table.min());
    let several = laws.head.speed.shares().any(|(speed, _)| speed.ratio() > 1.0);
    several || laws.head.units.is_some() && persists == 0
}

/// The states that an axis can come to.
fn reached(laws: &OrderLaws, state: u8) -> Vec<u8> {
    let mut states = vec![state];
    let mut next = 0;
    while let Some(&from) = states.get(next) {
        for passage in laws.step.transitions.iter().filter(|passage| passage.from == from) {
            if !states.contains(&passage.to) {
                states.push(passage.to);
            }
        }
        next += 1;
    }
    states
}

/// The starts of the axes that an axis in a state may bear.
fn borne_in(model: &BudModel, order: usize, state: u8) -> Vec<Start> {
    let laws = &model.orders[order];
    let (node, end) = (&laws.node, &laws.end);
    let mut borne = Vec::new();
    if node.axillary.count.table.max() > 0 && model.has_order(laws.number + 1) {
        let states = match &node.zones {
            Some(zones) => zones.states_of(state, &node.axillary.chance),
            None if node.axillary.chance.is_never_in(state) => Vec::new(),
            None => vec![None],
        };
        let of_zone = |of: Option<u8>| (order + 1, of.or(node.axillary.state).unwrap_or(state));
        borne.extend(states.into_iter().map(of_zone));
    }
    if node.reiteration.count.table.max() > 0 && !node.reiteration.chance.is_never_in(state) {
        borne.push((usize::from(node.reiteration_order) - 1, node.reiteration.state.unwrap_or(state)));
    }
    let relays = Some(&end.relay).filter(|_| frame::is_relayed(laws));
    let sets = relays.into_iter().chain(&end.fork);
    borne.extend(sets.map(|set| (order, set.state.unwrap_or(state))));
    borne
}
