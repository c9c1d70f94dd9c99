//! The outline of a plant from eight sides, of the compass, as the rasteriser of pictures draws it.
//!
//! The projection is parallel and level, as from far away; so the outline from a side is that from the opposite one,
//! mirrored, and four are drawn for the eight. A sample is covered or not, whatever covers it. Samples stand on a
//! lattice of the plant that is compared with, and all that is compared is drawn on the same lattice, so that the error
//! of counting samples, a thousandth or so (`silhouette`), mostly cancels. Absent: what has which outline.

use super::gaze::Gaze;
use super::raster::{UPRIGHT, Window, cover};
use glam::Vec3;
use phytomer_meshes::{Mesh, Scene};
use phytomer_sim::plant::NodeId;
use rayon::prelude::*;
use std::f32::consts::FRAC_PI_4;

/// The directions that are drawn: each is that of two of the eight sides.
pub const DRAWN: usize = 4;

/// The room around the plant, as a share of its extent: organs that stand for others are larger.
const ROOM: f32 = 0.1;

/// The lattices of four directions.
#[derive(Debug, Clone)]
pub struct Sides {
    gazes: [Gaze; DRAWN],
    windows: [Window; DRAWN],
    /// The place of the first sample of each direction, to the right and up, metres.
    corners: [[f32; 2]; DRAWN],
    /// Samples a metre.
    scale: f32,
}

/// The samples that something covers from each direction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outline {
    rows: [Vec<u64>; DRAWN],
}

/// How far an outline is from another, as shares of the covered area of the other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Apart {
    /// The largest difference of the covered areas over the eight sides.
    pub area: f64,
    /// The largest area that one covers and the other does not.
    pub either: f64,
}

impl Sides {
    /// The lattices around a plant, with so many samples along the longest side; `None` where nothing of it has an
    /// extent.
    pub fn around(scene: &Scene, samples: u32) -> Option<Self> {
        let gazes: [Gaze; DRAWN] = std::array::from_fn(|side| Gaze::towards(side as f32 * FRAC_PI_4, 0.0));
        let mut boxes = [[f32::INFINITY, f32::NEG_INFINITY, f32::INFINITY, f32::NEG_INFINITY]; DRAWN];
        each_ball(scene, &mut |at, radius| {
            for (bounds, gaze) in boxes.iter_mut().zip(&gazes) {
                let [x, y] = [at.dot(gaze.right), at.dot(gaze.up)];
                let [left, right, low, high] = *bounds;
                *bounds = [left.min(x - radius), right.max(x + radius), low.min(y - radius), high.max(y + radius)];
            }
        });
        let extents = boxes.map(|[left, right, low, high]| [right - left, high - low]);
        let longest = extents.iter().flatten().fold(0.0_f32, |most, extent| most.max(*extent));
        if !(longest > 0.0 && longest.is_finite()) {
            return None;
        }
        let scale = samples as f32 / (longest * (1.0 + 2.0 * ROOM));
        let room = ROOM * longest;
        let window = |[wide, high]: [f32; 2]| {
            let [columns, rows] = [wide, high].map(|extent| ((extent + 2.0 * room) * scale).ceil().max(1.0) as u32);
            Window { columns: 0..columns, rows: 0..rows, shifts: UPRIGHT }
        };
        let corners = boxes.map(|[left, _, _, high]| [left - room, high + room]);
        Some(Self { gazes, windows: extents.map(window), corners, scale })
    }

    /// The outline of a plant.
    pub fn of(&self, scene: &Scene) -> Outline {
        let none = || self.nothing();
        let draw = |(mut mesh, mut outline): (Mesh, Outline), block: usize| {
            scene.block(block, &mut mesh);
            self.draw(&mesh, &mut outline);
            (mesh, outline)
        };
        let drawn = (0..scene.blocks()).into_par_iter().fold(|| (Mesh::default(), none()), draw);
        drawn.map(|(_, outline)| outline).reduce(none, Outline::with)
    }

    /// The outline of a mesh.
    pub fn of_mesh(&self, mesh: &Mesh) -> Outline {
        let mut outline = self.nothing();
        self.draw(mesh, &mut outline);
        outline
    }

    fn nothing(&self) -> Outline {
        Outline { rows: self.windows.each_ref().map(|window| vec![0; window.len().div_ceil(64)]) }
    }

    fn draw(&self, mesh: &Mesh, outline: &mut Outline) {
        let mut seen = Vec::with_capacity(mesh.vertices.len());
        for side in 0..DRAWN {
            let (gaze, window, [left, top]) = (&self.gazes[side], &self.windows[side], self.corners[side]);
            seen.clear();
            seen.extend(mesh.vertices.iter().map(|vertex| {
                let at = Vec3::from_array(vertex.position());
                let [x, y] = [at.dot(gaze.right) - left, top - at.dot(gaze.up)];
                Vec3::new(x * self.scale, y * self.scale, 0.5)
            }));
            let rows = &mut outline.rows[side];
            for face in &mesh.faces {
                let corners = face.indices().map(|corner| seen[corner as usize]);
                cover(&corners, window, |sample| rows[sample.index / 64] |= 1 << (sample.index % 64));
            }
        }
    }
}

impl Outline {
    /// The samples that either covers.
    fn with(mut self, other: Self) -> Self {
        for (rows, others) in self.rows.iter_mut().zip(other.rows) {
            rows.iter_mut().zip(others).for_each(|(row, other)| *row |= other);
        }
        self
    }

    /// The number of samples that are covered from each direction.
    pub fn covered(&self) -> [u64; DRAWN] {
        self.rows.each_ref().map(|rows| rows.iter().map(|row| u64::from(row.count_ones())).sum())
    }

    /// How far it is from the outline of what it stands for, on the same lattices.
    pub fn apart(&self, from: &Self) -> Apart {
        let (own, of) = (self.covered(), from.covered());
        let mut apart = Apart::default();
        for side in 0..DRAWN {
            let either: u32 =
                self.rows[side].iter().zip(&from.rows[side]).map(|(one, other)| (one ^ other).count_ones()).sum();
            let over = 1.0 / (of[side].max(1) as f64);
            apart.area = apart.area.max(own[side].abs_diff(of[side]) as f64 * over);
            apart.either = apart.either.max(f64::from(either) * over);
        }
        apart
    }
}

/// Calls `take` with balls that hold all that is drawn, but for what leans far out of its own length.
pub fn each_ball(scene: &Scene, take: &mut dyn FnMut(Vec3, f32)) {
    let (plant, age) = (scene.plant(), scene.age());
    for node in (0..plant.nodes.len()).map(|node| NodeId(node as u32)).filter(|node| plant.stands(*node, age)) {
        let (frame, radius) = (plant.frames.at(node), 0.5 * plant.nodes.diameter[node.index()]);
        let (base, length) = (Vec3::from_array(frame.base), plant.posed_length(node));
        take(base, radius);
        take(base + length * Vec3::from_array(frame.heading), radius);
    }
    for organ in scene.organs() {
        let drawn = scene.organ(organ);
        let length = plant.organs.length[organ.index()].max(drawn.size[0]).max(0.0);
        take(Vec3::from_array(drawn.base) + 0.5 * length * Vec3::from_array(drawn.heading), 0.5 * length);
    }
}
