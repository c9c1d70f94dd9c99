//! One organ that a picture is filled with: its points, and from where it is seen.
//!
//! A leaf is seen from above its upper side and a little from its apex, a flower from before it, a fruit from outside
//! of the plant, or from near that direction where other parts would hide it (`free`). Of the largest organs of its
//! kind, which have expanded, one is taken that is freely seen. Absent: what else of the plant is seen around it, which
//! stays.

use super::gaze::Gaze;
use super::{View, free};
use glam::Vec3;
use phytomer_meshes::{MeshOptions, Scene, Vertex};
use phytomer_sim::Tick;
use phytomer_sim::math::{asinf, atan2f};
use phytomer_sim::plant::{Class, Kind, NodeId, OrganId, Plant};

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
        if let Some((organ, from)) = free::freest(&scene, &before) {
            let points = scene.mesh_of(organ).vertices.iter().map(Vertex::position).collect();
            return Some(Self { points, from: from.to_array() });
        }
        let nodes = (0..plant.nodes.len()).map(|node| NodeId(node as u32)).filter(|node| plant.stands(*node, age));
        let parts: Vec<NodeId> = nodes.filter(|node| is_of(plant, *node, wanted)).collect();
        (!parts.is_empty()).then(|| Self::internodes(plant, &parts))
    }

    /// The length times the width of the largest organ of a class that stands, square metres.
    pub fn size_of_largest(plant: &Plant, age: Tick, class: Class) -> Option<f32> {
        of_class(plant, age, class).into_iter().map(|(_, size)| size).reduce(f32::max)
    }

    /// Internodes that make up a flower, as a dog rose's, seen from before and above it.
    fn internodes(plant: &Plant, parts: &[NodeId]) -> Self {
        let end = |node: NodeId| {
            let at = |of: [f32; 3]| Vec3::from_array(of);
            let (base, heading) = (at(plant.frames.base[node.index()]), at(plant.frames.heading[node.index()]));
            let length = plant.nodes.length[node.index()];
            let wide = 0.5 * plant.nodes.diameter[node.index()];
            [base - Vec3::splat(wide), base + heading * length + Vec3::splat(wide)].map(|place| place.to_array())
        };
        let first = Vec3::from_array(plant.frames.heading[parts[0].index()]);
        let from = (first * 0.4 + Vec3::new(0.15, -0.5, 0.75)).normalize_or(Vec3::NEG_Y);
        Self { points: parts.iter().flat_map(|node| end(*node)).collect(), from: from.to_array() }
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

    /// The box around it, and around as much of what stands beside it as may be seen.
    pub(super) fn bounds(&self) -> [Vec3; 2] {
        let around = |[low, high]: [Vec3; 2], point: Vec3| [low.min(point), high.max(point)];
        let [low, high] = self.points().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], around);
        let beside = Vec3::splat(0.6 * (high - low).length());
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
        Class::Flower => 0.9 * heading + Vec3::Z * 0.35,
        _ => Vec3::new(heading.x, heading.y, 0.0).normalize_or(Vec3::NEG_Y) + Vec3::Z * 0.2,
    };
    from.normalize_or(Vec3::NEG_Y)
}

/// Whether an internode is what is wanted, or a part of it.
fn is_of(plant: &Plant, node: NodeId, wanted: Wanted) -> bool {
    use Kind::{PetalInternode, SepalInternode, StamenInternode, StigmaInternode};
    match wanted {
        Wanted::Component(number) => plant.nodes.component[node.index()] == number,
        Wanted::Largest(Class::Flower) => {
            matches!(plant.kind_of(node), PetalInternode | SepalInternode | StamenInternode | StigmaInternode)
        }
        Wanted::Largest(_) => false,
    }
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
