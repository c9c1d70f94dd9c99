//! What of a tree of stems is drawn: some of its levels alone, and what Weber & Penn 1995 §5 leaves of it at a range.
//!
//! A segment is an internode, a leaf any organ; the trunk and its clones are level 0, and what a stem bears has the
//! level after it, its leaves too. The elements of a list stand in the order of the plant's columns, which is that of
//! their creation, as §5 asks. A segment is drawn as a polygon where that is in its range, else as a line where that
//! is: the paper's lines lie inside of its polygons and are not seen there. Leaves likewise, as polygons or as points.
//! Absent: the curves (`range`), and the forms of lines and points, which are the scene's.

use super::MeshOptions;
use super::range::{Elements, Scales, Span, Zoom};
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{NodeId, OrganId, Plant};

/// A tree of stems as it is seen from afar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Afar {
    /// Its quality and its season.
    pub scales: Scales,
    /// The picture in which it is seen.
    pub zoom: Zoom,
    /// How far away it is, metres; `None` where all of it is drawn, with the ranges of its elements.
    pub metres: Option<f64>,
}

/// What of a tree of stems is drawn; by default all of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Seen {
    /// The first and the last of the levels that are drawn, 0 for the trunk; leaves have the level after that of their
    /// stem. `None`: all.
    pub levels: Option<[u8; 2]>,
    /// The tree as it is seen from afar; `None`: whatever its range.
    pub afar: Option<Afar>,
}

/// How an element is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Primitive {
    /// With all its triangles.
    Polygon,
    /// A segment as a line, a leaf as a point.
    Simple,
}

/// The elements of a plant at an age.
#[derive(Debug, Clone)]
pub struct Detail {
    levels: Option<[u8; 2]>,
    afar: Option<Spans>,
}

/// The ends of the ranges of all elements: of their polygons and of their lines or points, in the formulas' metres.
#[derive(Debug, Clone)]
struct Spans {
    afar: Afar,
    stems: Vec<[f32; 2]>,
    leaves: Vec<[f32; 2]>,
}

/// The number of lists of stems: levels 0, 1, and 2 with all beyond.
const LISTS: usize = 3;

/// The elements of each list of stems, and of the leaves: polygons, and lines or points.
const STEMS: [[Elements; 2]; LISTS] = [
    [Elements::TrunkPolygons, Elements::TrunkLines],
    [Elements::BranchPolygons, Elements::BranchLines],
    [Elements::TwigPolygons, Elements::TwigLines],
];
const LEAVES: [Elements; 2] = [Elements::LeafPolygons, Elements::LeafPoints];

/// The level of an internode.
pub fn level(plant: &Plant, node: NodeId) -> u8 {
    plant.axes.order[plant.nodes.axis[node.index()].index()].saturating_sub(1)
}

impl Detail {
    /// What of `plant` at `age` these options draw; `None` where they draw all of it.
    pub fn of(plant: &Plant, age: Tick, options: &MeshOptions) -> Option<Self> {
        let Seen { levels, afar } = options.seen;
        let afar = afar.map(|afar| Spans::of(plant, age, afar));
        (afar.is_some() || levels.is_some()).then_some(Self { levels, afar })
    }

    /// How an internode is drawn; `None` where it is not.
    pub fn stem(&self, plant: &Plant, node: NodeId) -> Option<Primitive> {
        let level = level(plant, node);
        self.has(level).then(|| self.afar.as_ref().map_or(Some(Primitive::Polygon), |afar| afar.stem(level, node)))?
    }

    /// How an organ is drawn; `None` where it is not.
    pub fn leaf(&self, plant: &Plant, organ: OrganId) -> Option<Primitive> {
        let level = level(plant, plant.organs.node[organ.index()]).saturating_add(1);
        self.has(level).then(|| self.afar.as_ref().map_or(Some(Primitive::Polygon), |afar| afar.leaf(organ)))?
    }

    /// Whether elements have ranges.
    pub fn has_ranges(&self) -> bool {
        self.afar.is_some()
    }

    fn has(&self, level: u8) -> bool {
        self.levels.is_none_or(|[first, last]| (first..=last).contains(&level))
    }

    /// The ranges at which something ends to be drawn, metres, each once, in their order.
    pub fn ends(&self) -> Vec<f32> {
        let Some(afar) = &self.afar else { return Vec::new() };
        let all = afar.stems.iter().chain(&afar.leaves).flatten().copied();
        let mut ends: Vec<f32> = all.filter(|until| until.is_finite()).collect();
        ends.sort_unstable_by(f32::total_cmp);
        ends.dedup();
        ends.iter_mut().for_each(|r| *r = afar.afar.zoom.metres(f64::from(*r)) as f32);
        ends
    }

    /// The range until which an internode is drawn in some way, metres; +∞ where no range is asked for.
    pub fn until_of_stem(&self, node: NodeId) -> f32 {
        self.afar.as_ref().map_or(f32::INFINITY, |afar| afar.until(afar.stems[node.index()]))
    }

    /// The range until which an organ is drawn in some way, metres; +∞ where no range is asked for.
    pub fn until_of_leaf(&self, organ: OrganId) -> f32 {
        self.afar.as_ref().map_or(f32::INFINITY, |afar| afar.until(afar.leaves[organ.index()]))
    }
}

impl Spans {
    fn of(plant: &Plant, age: Tick, afar: Afar) -> Self {
        let list = |node: NodeId| {
            let list = usize::from(level(plant, node)).min(LISTS - 1);
            plant.stands(node, age).then_some((list, STEMS[list]))
        };
        let stems = spans((0..plant.nodes.len()).map(|node| list(NodeId(node as u32))), &afar.scales);
        let leaf = |organ: usize| plant.organ_stands(OrganId(organ as u32), age).then_some((0, LEAVES));
        let leaves = spans((0..plant.organs.len()).map(leaf), &afar.scales);
        Self { afar, stems, leaves }
    }

    fn stem(&self, level: u8, node: NodeId) -> Option<Primitive> {
        let Some(r) = self.calibrated() else { return Some(Primitive::Polygon) };
        let [polygon, line] = self.stems[node.index()].map(f64::from);
        let lines_from = if level == 0 { super::range::TRUNK_LINES_FROM } else { 0.0 };
        primitive(r, Span { from: 0.0, until: polygon }, Span { from: lines_from, until: line })
    }

    fn leaf(&self, organ: OrganId) -> Option<Primitive> {
        let Some(r) = self.calibrated() else { return Some(Primitive::Polygon) };
        let [polygon, point] = self.leaves[organ.index()].map(|until| Span { from: 0.0, until: f64::from(until) });
        primitive(r, polygon, point)
    }

    fn calibrated(&self) -> Option<f64> {
        self.afar.metres.map(|metres| self.afar.zoom.calibrated(metres))
    }

    fn until(&self, [polygon, simple]: [f32; 2]) -> f32 {
        self.afar.zoom.metres(f64::from(polygon.max(simple))) as f32
    }
}

fn primitive(r: f64, polygon: Span, simple: Span) -> Option<Primitive> {
    match (polygon.holds(r), simple.holds(r)) {
        (true, _) => Some(Primitive::Polygon),
        (false, true) => Some(Primitive::Simple),
        (false, false) => None,
    }
}

/// The ends of the ranges of what stands, each in its list; 0 for what does not stand.
fn spans(elements: impl Iterator<Item = Option<(usize, [Elements; 2])>> + Clone, scales: &Scales) -> Vec<[f32; 2]> {
    let mut totals = [0; LISTS];
    elements.clone().flatten().for_each(|(list, _)| totals[list] += 1);
    let mut places = [0; LISTS];
    let until = |element: Option<(usize, [Elements; 2])>| {
        let Some((list, kinds)) = element else { return [0.0; 2] };
        let place = places[list];
        places[list] += 1;
        kinds.map(|kind| Span::of(scales, kind, place, totals[list]).until as f32)
    };
    elements.map(until).collect()
}
