//! A plant as a list of components with their lineage keys, so that two plants can be compared.
//!
//! Numbers are kept as bits and compared bit for bit. Absent on purpose: component numbers and places in columns, which
//! differ between growth ahead and growth by the clock.

use std::collections::BTreeSet;
use std::fmt::Debug;

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{AxisId, Class, Departed, Kind, LineageKey, NodeId, OrganId, Plant, Rest};

/// One component of a plant.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Component {
    /// Its lineage key.
    pub key: LineageKey,
    /// `axis` (with its apical bud), `node` (with its internode) or `organ`.
    pub what: &'static str,
    /// The tick of appearance.
    pub birth: Tick,
    /// The tick of death.
    pub death: Tick,
    /// The tick of its fall; for an organ its death.
    pub shed: Tick,
    /// The key of the bearing component: for an axis its bearing node, for a node the node below, for an organ its
    /// node.
    pub parent: Option<LineageKey>,
    /// Ranks, kinds, fates and causes: every whole number of the component, in the order of the columns.
    pub state: Vec<u32>,
    /// Lengths, areas and angles, as bits, in the order of the columns.
    pub measures: Vec<u32>,
}

/// The components of `plant`, also those of its ledger, sorted by lineage key. Takes time n log n for n components.
pub fn components(plant: &Plant) -> Vec<Component> {
    let axes = (0..plant.axes.len()).map(|i| axis(plant, i));
    let nodes = (0..plant.nodes.len()).map(|i| node(plant, i));
    let organs = (0..plant.organs.len()).map(|i| organ(plant, i));
    let gone = plant.ledger.iter().map(departed);
    let mut components: Vec<Component> = axes.chain(nodes).chain(organs).chain(gone).collect();
    components.sort_unstable();
    components
}

/// As [`components`], for a plant at the age `age`: without organs that appear later, and, for axes that are born
/// later, without their draws at birth: the time to their fall and trends of their own.
pub(super) fn born_by(plant: &Plant, age: Tick) -> Vec<Component> {
    let unborn = |i: &usize| plant.axes.birth[*i] > age;
    let waiting: BTreeSet<LineageKey> = (0..plant.axes.len()).filter(unborn).map(|i| plant.axes.key[i]).collect();
    let mut components = components(plant);
    components.retain(|component| component.what != "organ" || component.birth <= age);
    for axis in components.iter_mut().filter(|component| waiting.contains(&component.key)) {
        axis.measures.truncate(ANGLES);
    }
    components
}

/// The number of angles that an axis has from its bud; the draws at its birth follow them in `measures`.
const ANGLES: usize = 2;

/// As [`components`], in the order of component numbers, each component with its number.
pub(super) fn numbered(plant: &Plant) -> Vec<(u32, Component)> {
    let axes = (0..plant.axes.len()).map(|i| (plant.axes.component[i], axis(plant, i)));
    let nodes = (0..plant.nodes.len()).map(|i| (plant.nodes.component[i], node(plant, i)));
    let organs = (0..plant.organs.len()).map(|i| (plant.organs.component[i], organ(plant, i)));
    let gone = plant.ledger.iter().map(|gone| (gone.component, departed(gone)));
    let mut components: Vec<(u32, Component)> = axes.chain(nodes).chain(organs).chain(gone).collect();
    components.sort_unstable();
    components
}

fn axis(plant: &Plant, i: usize) -> Component {
    let axes = &plant.axes;
    let own_trends = plant.own_trends.of(AxisId(i as u32)).unwrap_or_default();
    let trends = own_trends.iter().flat_map(|trend| [trend.inclination as f32, trend.share as f32]);
    let angles: Vec<f32> = [axes.azimuth[i], axes.insertion[i]].into_iter().chain(trends).collect();
    Component {
        key: axes.key[i],
        what: "axis",
        birth: axes.appearance[i],
        death: axes.death[i],
        shed: axes.shed[i],
        parent: axes.bearer[i].some().map(|bearer| plant.node_key(bearer)),
        state: vec![
            axes.order[i].into(),
            axes.origin[i] as u32,
            axes.position[i].into(),
            axes.follows[i].into(),
            axes.state[i].into(),
            axes.birth[i],
            axes.apex_end[i],
            axes.apex_fate[i] as u32,
            axes.spent[i],
        ],
        measures: bits(&angles).into_iter().chain([axes.shed_after[i]]).collect(),
    }
}

fn node(plant: &Plant, i: usize) -> Component {
    let nodes = &plant.nodes;
    let rest = match plant.rest_of(NodeId(i as u32), plant.age) {
        Rest::Follows => [0.0; 3],
        Rest::Heading(heading) => heading.map(f64::from),
        Rest::Turned(rotation) => rotation.turned([1.0, 2.0, 3.0]),
    };
    let start = plant.start_of(NodeId(i as u32));
    Component {
        key: plant.node_key(NodeId(i as u32)),
        what: "node",
        birth: nodes.birth[i],
        death: plant.death_of(NodeId(i as u32)),
        shed: plant.shed_of(NodeId(i as u32)),
        parent: nodes.parent[i].some().map(|parent| plant.node_key(parent)),
        state: vec![
            nodes.rank[i],
            nodes.unit_rank[i].into(),
            nodes.formation[i].is_short().into(),
            nodes.formation[i].is_neoformed().into(),
            nodes.trend[i].into(),
        ],
        measures: [bits(&[nodes.length[i], nodes.primary_diameter[i], nodes.azimuth[i]]), bits(&start)]
            .concat()
            .into_iter()
            .chain(rest.into_iter().flat_map(|x| [x.to_bits() as u32, (x.to_bits() >> 32) as u32]))
            .collect(),
    }
}

/// A component of the ledger. Its parent is known by its number alone.
fn departed(gone: &Departed) -> Component {
    Component {
        key: gone.key,
        what: match gone.kind {
            Kind::ApicalBud => "axis",
            kind if kind.class() == Class::Internode => "node",
            _ => "organ",
        },
        birth: gone.birth,
        death: gone.left,
        shed: gone.left,
        parent: None,
        state: vec![
            gone.rank.unwrap_or_default(),
            gone.unit_rank.unwrap_or_default().into(),
            gone.parent.map_or(0, |parent| parent + 1),
            gone.axis,
            gone.order.into(),
            gone.cause as u32,
        ],
        measures: bits(&[gone.length, gone.birth_diameter]),
    }
}

fn organ(plant: &Plant, i: usize) -> Component {
    let organs = &plant.organs;
    Component {
        key: plant.organ_key(OrganId(i as u32)),
        what: "organ",
        birth: organs.birth[i],
        death: organs.death[i],
        shed: organs.death[i],
        parent: Some(plant.node_key(organs.node[i])),
        state: vec![
            organs.kind[i] as u32,
            organs.position[i].into(),
            organs.cause[i] as u32,
            u32::from(organs.form[i].0),
        ],
        measures: bits(&[organs.length[i], organs.width[i], organs.area[i], organs.azimuth[i], organs.insertion[i]]),
    }
}

fn bits(measures: &[f32]) -> Vec<u32> {
    measures.iter().map(|x| x.to_bits()).collect()
}

/// An event with the key of its axis: tick, axis, kind, count.
pub(super) type KeyedEvent = (Tick, LineageKey, &'static str, u32);

/// The events of a plant, sorted; empty where the plant keeps no events.
pub(super) fn events(plant: &Plant) -> Vec<KeyedEvent> {
    // An axis that is gone has its number alone.
    let gone = |axis: AxisId| LineageKey(plant.bud_number(axis).into());
    let key = |axis: AxisId| plant.axes.key.get(axis.index()).copied().unwrap_or_else(|| gone(axis));
    let mut events: Vec<_> =
        plant.events.iter().flatten().map(|e| (e.tick, key(e.axis), e.kind.tag(), e.count)).collect();
    events.sort_unstable();
    events
}

/// Panics at the first component, or event, in which two plants differ.
pub(super) fn assert_same<T: PartialEq + Debug>(rule: &str, one: &[T], other: &[T]) {
    for (a, b) in one.iter().zip(other) {
        assert!(a == b, "{rule}, but one plant has\n  {a:?}\nand the other\n  {b:?}");
    }
    let (more, fewer) = if one.len() > other.len() { (one, other) } else { (other, one) };
    if let Some(single) = more.get(fewer.len()) {
        panic!("{rule}, but they have {} and {}; one alone has\n  {single:?}", one.len(), other.len());
    }
}
