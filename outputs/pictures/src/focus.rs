//! One organ that a picture is filled with: its points, and from where it is seen.
//!
//! A leaf is seen from above its upper side and a little from its apex, a flower from before it, a panicle, a catkin
//! and a spikelet from aside, a fruit from outside of the plant, or from near that direction where other parts would
//! hide it (`free`). Of the largest organs of its kind, which have expanded, one is taken that is freely seen. Absent:
//! what else of the plant is seen around it, which stays.

use super::View;
use super::free::{self, Freest};
use super::gaze::Gaze;
use glam::Vec3;
use phytomer_looks::{FormName, Paints};
use phytomer_meshes::{MeshOptions, Scene, Vertex};
use phytomer_sim::Tick;
use phytomer_sim::math::{asinf, atan2f};
use phytomer_sim::plant::{Class, Kind, NodeId, OrganId, Plant};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The least size of an organ that is taken because it is freely seen, as a share of the largest.
const NEARLY: f32 = 0.8;
/// The most organs whose views are looked at.
const MOST_ASKED: usize = 12;

/// What a picture is to show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// The largest organ of a class, a leaf, a flower or a fruit; one that is nearly as large, if it is freely seen.
    Largest(Class),
    /// A component by its number.
    Component(u32),
}

/// An organ that fills a picture, of the first plant of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Focus {
    points: Vec<[f32; 3]>,
    /// The unit direction from which it is seen.
    from: [f32; 3],
    /// The numbers of the components that would hide it, where nothing but a part of it is seen from any side; they are
    /// not drawn.
    left_out: Arc<[u32]>,
}

impl Focus {
    /// The organ of a plant at an age that is wanted, as large as it is drawn; `None` where it does not stand.
    pub fn of(plant: &Plant, age: Tick, options: &MeshOptions, wanted: Wanted) -> Option<Self> {
        let scene = Scene::new(plant, age, options);
        let organs = match wanted {
            Wanted::Largest(class) => largest(plant, age, class),
            Wanted::Component(number) => {
                let organs = (0..plant.organs.len()).map(|organ| OrganId(organ as u32));
                let is_wanted = |organ: &OrganId| plant.organs.component[organ.index()] == number;
                organs.filter(is_wanted).filter(|organ| plant.organ_stands(*organ, age)).take(1).collect()
            }
        };
        let before: Vec<(OrganId, Vec3)> = organs.into_iter().map(|organ| (organ, before(&scene, organ))).collect();
        if let Some(Freest { organ, from, hiding }) = free::freest(&scene, &before) {
            let points = scene.mesh_of(organ).vertices.iter().map(Vertex::position).collect();
            return Some(Self { points, from: from.to_array(), left_out: hiding.into() });
        }
        match wanted {
            Wanted::Largest(Class::Flower) => {
                let flowers = flowers(plant, age);
                // Of equal ones the first.
                let largest = flowers.iter().reduce(|one, other| if other.size() > one.size() { other } else { one });
                largest.map(Flower::focus)
            }
            Wanted::Largest(_) => None,
            Wanted::Component(number) => {
                let nodes = (0..plant.nodes.len()).map(|node| NodeId(node as u32));
                let is_wanted = |node: &NodeId| plant.nodes.component[node.index()] == number;
                let node = nodes.filter(|node| plant.stands(*node, age)).find(is_wanted)?;
                let heading = Vec3::from_array(plant.frames.heading[node.index()]);
                Some(Flower { heading, points: ends(plant, node).to_vec() }.focus())
            }
        }
    }

    /// The length times the width of the largest organ of a class that stands, square metres; where there are no
    /// flowers, those of the largest flower that is made of internodes.
    pub fn size_of_largest(plant: &Plant, age: Tick, class: Class) -> Option<f32> {
        let largest = of_class(plant, age, class).into_iter().map(|(_, size)| size).reduce(f32::max);
        let of_parts = || flowers(plant, age).iter().map(Flower::size).reduce(f32::max);
        if class == Class::Flower { largest.or_else(of_parts) } else { largest }
    }

    /// The gaze towards it, turned to the left by an angle.
    pub(super) fn gaze(&self, turn: f32) -> Gaze {
        let [x, y, z] = self.from;
        Gaze::towards(atan2f(-y, -x) + turn, asinf(z.clamp(-0.999, 0.999)))
    }

    /// A sun over the left shoulder of whoever looks at it, a little higher than it is seen from.
    pub(super) fn sun(&self, turn: f32) -> [f32; 2] {
        let [x, y, _] = self.from;
        [atan2f(y, x) + turn - 0.9, View::Perspective.sun(0.0)[1] + 0.2]
    }

    /// Its points.
    pub(super) fn points(&self) -> impl Iterator<Item = Vec3> {
        self.points.iter().copied().map(Vec3::from_array)
    }

    /// The middle of the box around it.
    pub(super) fn middle(&self) -> Vec3 {
        let around = |[low, high]: [Vec3; 2], point: Vec3| [low.min(point), high.max(point)];
        let [low, high] = self.points().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], around);
        0.5 * (low + high)
    }

    /// The numbers of the components that are not drawn, in their order.
    pub(super) fn left_out(&self) -> Arc<[u32]> {
        Arc::clone(&self.left_out)
    }

    /// The box around it, and around as much of what stands beside it as may be seen; of what stands around an organ
    /// that is freed for the picture little throws a shadow on it.
    pub(super) fn bounds(&self) -> [Vec3; 2] {
        let around = |[low, high]: [Vec3; 2], point: Vec3| [low.min(point), high.max(point)];
        let [low, high] = self.points().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], around);
        let share = if self.left_out.is_empty() { 0.6 } else { 0.1 };
        let beside = Vec3::splat(share * (high - low).length());
        [low - beside, high + beside]
    }
}

/// The unit direction from before an organ.
fn before(scene: &Scene, organ: OrganId) -> Vec3 {
    let drawn = scene.organ(organ);
    let [heading, up] = [drawn.heading, drawn.up].map(Vec3::from_array);
    let from = match scene.plant().organs.kind[organ.index()].class() {
        Class::Leaf => {
            let up = if up.z < 0.0 { -up } else { up };
            0.85 * up + 0.4 * heading + Vec3::Z * 0.15
        }
        Class::Flower if is_long(scene.plant(), organ) => {
            let aside = Vec3::new(heading.x, heading.y, 0.0).normalize_or(Vec3::NEG_Y);
            (aside - aside.dot(heading) * heading).normalize_or(heading.any_orthonormal_vector()) + 0.25 * heading
        }
        Class::Flower => 0.9 * heading + Vec3::Z * 0.35,
        _ => Vec3::new(heading.x, heading.y, 0.0).normalize_or(Vec3::NEG_Y) + Vec3::Z * 0.2,
    };
    from.normalize_or(Vec3::NEG_Y)
}

/// Whether an organ is an inflorescence that is longer than broad, of which its tip shows little. A cluster that a
/// species states for near views spreads, as an oil palm's, and its tip shows most of it.
fn is_long(plant: &Plant, organ: OrganId) -> bool {
    use FormName::{Catkin, Panicle, Spikelet};
    let look = plant.look_of_organ(organ);
    let states_another = look.is_some_and(|look| Paints::of(&plant.habit).organ(look.paint).near.is_some());
    !states_another && [Catkin, Panicle, Spikelet].map(FormName::form).contains(&plant.organs.form[organ.index()])
}

/// A flower that is made of internodes, as a dog rose's, by the places of its petals, sepals, stamens and styles.
struct Flower {
    /// The direction of what bears them.
    heading: Vec3,
    points: Vec<Vec3>,
}

impl Flower {
    /// The product of the two longest sides of the box around it, square metres.
    fn size(&self) -> f32 {
        let around = |[low, high]: [Vec3; 2], point: &Vec3| [low.min(*point), high.max(*point)];
        let [low, high] = self.points.iter().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], around);
        let mut sides = (high - low).max(Vec3::ZERO).to_array();
        sides.sort_by(f32::total_cmp);
        sides[1] * sides[2]
    }

    /// The flower as it fills a picture: seen from before and above, so that its middle and its parts are seen.
    fn focus(&self) -> Focus {
        let from = (0.8 * self.heading + Vec3::new(0.15, -0.55, 0.1)).normalize_or(Vec3::NEG_Y);
        let points = self.points.iter().map(Vec3::to_array).collect();
        Focus { points, from: from.to_array(), left_out: Arc::default() }
    }
}

/// The flowers of a plant that are made of internodes: the parts of a flower that one receptacle bears, or one stem.
fn flowers(plant: &Plant, age: Tick) -> Vec<Flower> {
    use Kind::{PetalInternode, ReceptacleInternode, SepalInternode, StamenInternode, StigmaInternode};
    let is_part = |node: NodeId| {
        matches!(plant.kind_of(node), PetalInternode | SepalInternode | StamenInternode | StigmaInternode)
    };
    // The lowest internode of the flower of each node; a bearer comes before what it bears.
    let mut lowest = vec![NodeId::NONE; plant.nodes.len()];
    let mut flowers: BTreeMap<NodeId, Flower> = BTreeMap::new();
    for node in (0..plant.nodes.len()).map(|node| NodeId(node as u32)) {
        if !(is_part(node) || plant.kind_of(node) == ReceptacleInternode) {
            continue;
        }
        let parent = plant.nodes.parent[node.index()].some();
        lowest[node.index()] = parent.map(|parent| lowest[parent.index()]).and_then(NodeId::some).unwrap_or(node);
        if !is_part(node) || !plant.stands(node, age) {
            continue;
        }
        let bearer = parent.filter(|parent| !is_part(*parent)).unwrap_or(node);
        let heading = Vec3::from_array(plant.frames.heading[bearer.index()]);
        let flower = flowers.entry(lowest[node.index()]);
        flower.or_insert(Flower { heading, points: Vec::new() }).points.extend(ends(plant, node));
    }
    flowers.into_values().collect()
}

/// The corners of an internode as a blade.
fn ends(plant: &Plant, node: NodeId) -> [Vec3; 4] {
    let frame = plant.frames.at(node);
    let [base, heading, up] = [frame.base, frame.heading, frame.up].map(Vec3::from_array);
    let aside = 0.5 * plant.nodes.diameter[node.index()] * heading.cross(up);
    let tip = base + plant.posed_length(node) * heading;
    [base - aside, base + aside, tip - aside, tip + aside]
}

/// The largest organs of a class that stand, and those nearly as large, the largest first; of equal ones the first.
fn largest(plant: &Plant, age: Tick, class: Class) -> Vec<OrganId> {
    let mut organs = of_class(plant, age, class);
    organs.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let least = organs.first().map_or(0.0, |(_, size)| NEARLY * size);
    organs.into_iter().take(MOST_ASKED).take_while(|(_, size)| *size >= least).map(|(organ, _)| organ).collect()
}

/// The organs of a class that stand, with their lengths times their widths, square metres; of leaves those that are no
/// bracts or scales, of a plant that has others.
fn of_class(plant: &Plant, age: Tick, class: Class) -> Vec<(OrganId, f32)> {
    let organs = (0..plant.organs.len()).map(|organ| OrganId(organ as u32));
    let standing =
        organs.filter(|organ| plant.organs.kind[organ.index()].class() == class && plant.organ_stands(*organ, age));
    let size = |organ: OrganId| {
        let share = plant.expanded(organ, age);
        share * share * plant.organs.length[organ.index()] * plant.organs.width[organ.index()]
    };
    let is_foliage = |organ: &OrganId| plant.organs.kind[organ.index()].is_foliage();
    let has_foliage = class == Class::Leaf && plant.organs.kind.iter().any(|kind| kind.is_foliage());
    standing.filter(|organ| !has_foliage || is_foliage(organ)).map(|organ| (organ, size(organ))).collect()
}
