//! What keeps light in a plot: the leaves of its plants, their wood on request, piece by piece.
//!
//! A blade is cut along its length and across into pieces no longer than asked, with the outline of an ellipse; the
//! pieces of a leaf together have its area. Wood counts as leaves of half its surface: a beam of any direction then
//! meets it as often as it meets the cylinder, on average over its directions. Absent: voxels, light, the curves of
//! blades, flowers and fruits.

use crate::clock::Tick;
use crate::plant::{AxisId, Frame, NodeId, OrganId, Plant};
use crate::pose::{bud_base, organ_frame};
use crate::shape::Point;
use std::f64::consts::FRAC_PI_2;

/// The most pieces of a blade along its length, and across.
const MOST_PIECES: f64 = 64.0;

/// A piece of leaf, so small that its middle tells where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Its middle, metres.
    pub place: Point,
    /// The direction across it, a unit vector; its sign does not matter.
    pub normal: Point,
    /// Its area by one side, m².
    pub area: f64,
}

/// What keeps light in a plot, plant by plant.
pub trait Canopy: Sync {
    /// The number of plants.
    fn plants(&self) -> usize;
    /// Shows the pieces of a plant, each of at most `longest` metres, in a fixed order.
    fn pieces(&self, plant: usize, longest: f64, show: &mut dyn FnMut(Piece));
    /// A place that goes with the plants, metres: beams of a plot that repeats are laid about its voxel.
    fn anchor(&self) -> Point {
        [0.0; 3]
    }
    /// Shows the buds of a plant whose light is wanted: each with the number of its axis and its place, metres.
    fn buds(&self, plant: usize, show: &mut dyn FnMut(usize, Point));
}

/// The plants of a plot as they stand.
pub struct Standing<'a> {
    /// The plants, posed.
    pub plants: &'a [Plant],
    /// The age of each; `None` of one that is not sown yet.
    pub ages: &'a [Option<Tick>],
    /// Whether wood keeps light.
    pub wood: bool,
    /// Of each plant whether the light of its buds is wanted.
    pub feel: &'a [bool],
}

impl Standing<'_> {
    pub(super) fn age_of(&self, plant: usize) -> Option<Tick> {
        self.ages.get(plant).copied().flatten()
    }
}

impl Canopy for Standing<'_> {
    fn plants(&self) -> usize {
        self.plants.len()
    }

    /// The place of the first plant.
    fn anchor(&self) -> Point {
        self.plants.first().map_or([0.0; 3], |plant| plant.place)
    }

    fn pieces(&self, number: usize, longest: f64, show: &mut dyn FnMut(Piece)) {
        let (plant, Some(age)) = (&self.plants[number], self.age_of(number)) else { return };
        for organ in 0..plant.organs.len() {
            leaf_pieces(plant, OrganId(organ as u32), age, longest, show);
        }
        if self.wood {
            wood_pieces(plant, age, longest, show);
        }
    }

    fn buds(&self, number: usize, show: &mut dyn FnMut(usize, Point)) {
        let (plant, Some(age)) = (&self.plants[number], self.age_of(number)) else { return };
        if !self.feel.get(number).copied().unwrap_or(false) {
            return;
        }
        for axis in 0..plant.axes.len() {
            let id = AxisId(axis as u32);
            if plant.bud_lives(id, age) {
                show(axis, in_plot(plant, bud_base(plant, id)));
            }
        }
    }
}

/// A place of a plant in its plot.
fn in_plot(plant: &Plant, at: [f32; 3]) -> Point {
    [0, 1, 2].map(|k| plant.place[k] + f64::from(at[k]))
}

/// Shows the pieces of an organ, if it is a leaf that stands.
pub fn leaf_pieces(plant: &Plant, organ: OrganId, age: Tick, longest: f64, show: &mut dyn FnMut(Piece)) {
    if plant.organs.kind[organ.index()].is_foliage() && plant.organ_stands(organ, age) {
        pieces_of_leaf(plant, organ, age, longest, show);
    }
}

/// Shows the pieces of a leaf as it is at an age, whether it stands or not.
pub(super) fn pieces_of_leaf(plant: &Plant, organ: OrganId, age: Tick, longest: f64, show: &mut dyn FnMut(Piece)) {
    let place = organ.index();
    let area: f64 = plant.organ_area(organ, age);
    if area > 0.0 {
        let share = f64::from(plant.expanded(organ, age));
        let sides = [plant.organs.length[place], plant.organs.width[place]].map(|side| f64::from(side) * share);
        blade_pieces(&Blade { plant, frame: organ_frame(plant, organ, age), sides, area }, longest, show);
    }
}

/// A blade where it stands.
struct Blade<'a> {
    plant: &'a Plant,
    frame: Frame,
    /// Its length and its width, metres.
    sides: [f64; 2],
    area: f64,
}

fn blade_pieces(blade: &Blade, longest: f64, show: &mut dyn FnMut(Piece)) {
    let Blade { plant, frame, sides: [length, width], area } = *blade;
    let [heading, normal] = [frame.heading, frame.up].map(|of| of.map(f64::from));
    let base = in_plot(plant, frame.base);
    if length <= longest && width <= longest {
        // In one piece, with its middle on the midrib.
        show(Piece { place: [0, 1, 2].map(|k| base[k] + heading[k] * (0.5 * length)), normal, area });
        return;
    }
    let across = cross(heading, normal);
    let [rows, columns] = [length, width].map(|side| (side / longest).ceil().clamp(1.0, MOST_PIECES));
    // The width of the ellipse in the middle of each row.
    let wide = |row: f64| {
        let along = (row + 0.5) / rows;
        2.0 * (along * (1.0 - along)).sqrt()
    };
    let all: f64 = (0..rows as u32).map(|row| wide(f64::from(row))).sum();
    for row in (0..rows as u32).map(f64::from) {
        let (along, area) = ((row + 0.5) / rows * length, area * wide(row) / all / columns);
        for column in (0..columns as u32).map(f64::from) {
            let aside = ((column + 0.5) / columns - 0.5) * width * wide(row);
            let place = [0, 1, 2].map(|k| base[k] + heading[k] * along + across[k] * aside);
            show(Piece { place, normal, area });
        }
    }
}

/// Shows the pieces of the wood that stands.
fn wood_pieces(plant: &Plant, age: Tick, longest: f64, show: &mut dyn FnMut(Piece)) {
    plant.each_standing(age, |stretch| {
        for node in stretch.nodes() {
            let frame = plant.frames.at(NodeId(node as u32));
            let length = f64::from(plant.posed_length(NodeId(node as u32)));
            let area = FRAC_PI_2 * f64::from(plant.nodes.diameter[node]) * length;
            let rows = (length / longest).ceil().clamp(1.0, MOST_PIECES);
            let (base, heading) = (in_plot(plant, frame.base), frame.heading.map(f64::from));
            let up = frame.up.map(f64::from);
            let normals = [up, cross(heading, up)];
            for row in (0..rows as u32).map(f64::from) {
                let place = [0, 1, 2].map(|k| base[k] + heading[k] * (row + 0.5) / rows * length);
                normals.into_iter().for_each(|normal| show(Piece { place, normal, area: area / rows / 2.0 }));
            }
        }
    });
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
