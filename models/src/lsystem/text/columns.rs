//! The columns of a plant, written from a draft: the turtle's (x, y, z), y up, are the plant's (x, −z, y).
//!
//! The internode that bears what stands at the base comes first, the others in the order of the string; so do axes, so
//! that a bearer comes before what it bears at each age. Every part states how it is turned in the frame of its bearer,
//! and where it begins. Absent: what departs (`model`).

use super::draft::{BASE, Draft, Internode};
use super::form::{Stated, metres};
use super::numbers::{Born, Bud, Numbered};
use crate::lsystem::turtle::{Frame, Vector};
use phytomer_looks::FormName;
use phytomer_sim::clock::NEVER;
use phytomer_sim::plant::{
    ApexFate, AxisId, Cause, Class, Kind, LineageKey, NewAxis, NewNode, NewOrgan, NodeId, Origin, Part, Plant,
};
use phytomer_sim::rotation::Rotation;

/// How units of the turtle become metres, and colours looks.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measures {
    /// The length of a step of 1, metres.
    pub step: f64,
    /// The diameter of a line of width 1, metres.
    pub width: f64,
    /// The kinds of internodes that lines are, with the place of the first look of each; a look for each colour.
    pub looks: Vec<(Kind, u16)>,
    /// Whether looks depend on colours.
    pub coloured: bool,
    /// The volume within each contour over that of a cylinder as wide.
    pub bulks: Vec<f32>,
}

/// The frame of the ground in the coordinates of the turtle: upright, its upper side along x.
const GROUND: Frame =
    Frame { position: [0.0; 3], heading: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0], up: [1.0, 0.0, 0.0] };

/// Writes the columns of `plant`, which are empty, at `age`; `bud` tells of the bud of an axis by its number.
pub(super) fn write(
    draft: &Draft,
    numbered: &Numbered,
    measures: &Measures,
    plant: &mut Plant,
    mut bud: impl FnMut(u32) -> Bud,
) {
    let to = Places { first: draft.first.filter(|_| draft.has_base) };
    let mut borne = vec![0_u16; draft.nodes.len()];
    for (axis, born) in draft.axes.iter().zip(&numbered.axes) {
        let bearer = (born.number > 0).then(|| to.place(axis.on));
        let new = NewAxis {
            bearer: bearer.map(|place| NodeId(place as u32)),
            key: LineageKey::SEED,
            order: axis.order,
            origin: if bearer.is_some() { Origin::Axillary } else { Origin::Seed },
            position: bearer.map_or(0, |place| next(&mut borne[place])),
            appearance: born.at,
            birth: born.at,
            insertion: 0.0,
            ..NewAxis::OF_THE_SEED
        };
        let id = plant.place_axis(new, born.number);
        let (tick, fate) = bud(born.number).end;
        if fate != ApexFate::Alive {
            plant.axes.end_apex(id, tick.max(born.at).max(1), fate);
            // Wood lives as long as the string has it, whatever became of the apex.
            plant.axes.spent[id.index()] = NEVER;
        }
    }
    let mut ranks = vec![0_u32; draft.axes.len()];
    for place in to.order(draft.nodes.len()) {
        write_node(draft, place, numbered.nodes[place], &to, &mut ranks, measures, plant);
    }
    for (place, axis) in draft.axes.iter().enumerate().filter(|(place, _)| ranks[*place] == 0) {
        if let Some((_, frame)) = &axis.apex {
            let part = Part::Axis(AxisId(place as u32));
            state(plant, part, &bearing(draft, axis.on, &to), frame, measures.step);
        }
    }
    let mut borne = vec![0_u16; draft.nodes.len()];
    for place in 0..draft.organs.len() {
        write_organ(draft, place, numbered.organs[place], &to, &mut borne, measures, plant);
    }
}

/// Where the internodes of a draft stand in the columns: the one that bears the base comes first.
struct Places {
    first: Option<usize>,
}

impl Places {
    /// The place of an internode in the columns.
    fn place(&self, node: u32) -> usize {
        match self.first {
            _ if node == BASE => 0,
            Some(first) if node as usize == first => 0,
            Some(first) if (node as usize) < first => node as usize + 1,
            _ => node as usize,
        }
    }

    /// The internodes of a draft in the order of the columns.
    fn order(&self, nodes: usize) -> impl Iterator<Item = usize> + use<> {
        let first = self.first;
        first.into_iter().chain((0..nodes).filter(move |node| Some(*node) != first))
    }
}

fn next(count: &mut u16) -> u16 {
    let position = *count;
    *count = count.saturating_add(1).min(u16::MAX - 1);
    position
}

fn write_node(
    draft: &Draft,
    place: usize,
    born: Born,
    to: &Places,
    ranks: &mut [u32],
    measures: &Measures,
    plant: &mut Plant,
) {
    let node = &draft.nodes[place];
    let rank = &mut ranks[node.axis as usize];
    *rank += 1;
    let is_first = node.axis == 0 && *rank == 1;
    let new = NewNode {
        parent: if is_first { NodeId::NONE } else { NodeId(to.place(node.below) as u32) },
        axis: AxisId(node.axis),
        birth: born.at,
        rank: *rank,
        unit_rank: 1,
        short: false,
        neoformed: false,
        trend: 0,
        length: metres(node.length * measures.step),
        diameter: metres(node.width * measures.width),
        azimuth: 0.0,
    };
    let id = plant.place_node(new, born.number);
    let bearer = if is_first { Bearer::GROUND } else { bearing(draft, node.below, to) };
    state(plant, Part::Node(id), &bearer, &node.frame, measures.step);
    if let Some(look) = measures.look(node) {
        plant.give_look(id, look);
    }
    if let Some(section) = node.section {
        plant.give_section(id, section);
        plant.state_bulk(id, measures.bulks.get(usize::from(section)).copied().unwrap_or(1.0));
    }
}

impl Measures {
    /// The look of an internode that is not the habit's.
    fn look(&self, node: &Internode) -> Option<u16> {
        if !self.coloured && node.kind == Kind::Internode {
            return None;
        }
        let (_, first) = self.looks.iter().find(|(kind, _)| *kind == node.kind)?;
        Some(if self.coloured { first + node.colour.rem_euclid(256) as u16 } else { *first })
    }
}

/// The frame of a bearer, and its tip.
struct Bearer<'d> {
    frame: &'d Frame,
    tip: Vector,
}

impl Bearer<'_> {
    const GROUND: Self = Self { frame: &GROUND, tip: [0.0; 3] };
}

#[inline]
fn bearing<'d>(draft: &'d Draft, node: u32, to: &Places) -> Bearer<'d> {
    let place = if node == BASE { to.first } else { Some(node as usize) };
    let Some(node) = place.map(|place| &draft.nodes[place]) else { return Bearer::GROUND };
    Bearer { frame: &node.frame, tip: node.tip() }
}

/// How a frame is turned in that of its bearer, and where it begins from the tip of that, metres.
#[inline]
fn relative(bearer: &Bearer<'_>, frame: &Frame, step: f64) -> (Rotation, [f32; 3]) {
    let turned = Rotation::to(bearer.frame.coordinates(frame.heading), bearer.frame.coordinates(frame.up));
    let ([x, y, z], tip) = (frame.position, bearer.tip);
    let [along, left, up] = bearer.frame.coordinates([x - tip[0], y - tip[1], z - tip[2]]);
    (turned, [metres(along * step), metres(left * step), metres(up * step)])
}

#[inline]
fn state(plant: &mut Plant, part: Part, bearer: &Bearer<'_>, frame: &Frame, step: f64) {
    let (turned, start) = relative(bearer, frame, step);
    plant.state_frame(part, turned, start);
}

fn write_organ(
    draft: &Draft,
    place: usize,
    born: Born,
    to: &Places,
    borne: &mut [u16],
    measures: &Measures,
    plant: &mut Plant,
) {
    let organ = &draft.organs[place];
    let node = to.place(organ.on);
    let size = metres(organ.size * measures.width);
    let form = Stated::of(&organ.form, &organ.frame, &draft.corners, measures.step, plant);
    let [length, width] = form.extents().unwrap_or([size; 2]);
    let new = NewOrgan {
        node: NodeId(node as u32),
        kind: organ.kind,
        position: next(&mut borne[node]),
        birth: born.at,
        death: NEVER,
        cause: Cause::None,
        form: form_of(organ.kind).form(),
        length,
        width,
        area: 0.0,
        azimuth: 0.0,
        insertion: 0.0,
    };
    let id = plant.place_organ(new, born.number);
    let (turned, start) = relative(&bearing(draft, organ.on, to), &organ.frame, measures.step);
    plant.state_organ(id, turned, start);
    if !form.state(plant, id) && organ.kind.class() == Class::Leaf {
        plant.organs.area[id.index()] = length * width * form_of(organ.kind).area_share();
    }
    if measures.coloured {
        plant.give_organ_look(id, organ.colour.rem_euclid(256) as u16);
    }
}

/// What an organ without an outline is drawn as.
fn form_of(kind: Kind) -> FormName {
    match kind.class() {
        Class::Leaf => FormName::Elliptic,
        Class::Flower => FormName::Corolla,
        Class::Fruit | Class::Bud | Class::Internode => FormName::Berry,
    }
}
