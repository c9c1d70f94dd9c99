//! The places of a scene alone, component by component, for outlines, which need neither normals nor colours.
//!
//! A box that holds a component is told first, so that the places of what lies behind others need not be made. Tubes
//! are told as two rings of corners, between which the wood is their convex hull but for a small twist; all else as
//! triangles. Absent: what is done with the places (`phytomer_pictures`).

use super::blocks::span;
use super::chunk::Vertex;
use super::forms::Placement;
use super::organ_base::organ_base;
use super::outline::{OrganForm, Shown};
use super::reduced::{Reduced, ring::Place};
use super::scene::Scene;
use super::stem::Drawn;
use bytemuck::Zeroable;
use glam::Vec3;
use phytomer_sim::plant::{NodeId, OrganId};
use phytomer_sim::pose::Frame;
use std::convert::Infallible;
use std::ops::Range;

/// What takes the places of components.
pub trait TakePlaces {
    /// Whether the places of a component within a box are asked for.
    fn wants(&mut self, held: &Held) -> bool;
    /// The part of a tube between two rings, whose corners are told in their order around.
    fn tube(&mut self, rings: [&[Vec3]; 2]);
    /// Triangles, by their corners.
    fn faces(&mut self, places: &[Vec3], faces: &[[u32; 3]]);
}

/// A box that holds a component: its middle and half of its sides, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    /// The middle.
    pub middle: Vec3,
    /// Half of each of three sides.
    pub half: [Vec3; 3],
}

/// A box that holds an organ in its own form and in its coarser ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrganBox {
    base: Frame,
    held: Held,
}

impl OrganBox {
    /// The box where the organ is so many times as long and as wide.
    #[inline]
    pub fn times(&self, factor: f32) -> Held {
        let (Held { middle, half }, base) = (self.held, Vec3::from_array(self.base.base));
        Held { middle: base + factor * (middle - base), half: half.map(|half| factor * half) }
    }
}

/// Working memory.
#[derive(Debug, Default)]
pub struct Room {
    vertices: Vec<Vertex>,
    places: Vec<Vec3>,
    faces: Vec<[u32; 3]>,
    rings: [Vec<Vec3>; 2],
    course: Vec<Place>,
}

impl Room {
    /// Vertices to be written, of which the places are then told.
    fn write(&mut self, vertices: usize, write: impl FnOnce(&mut [Vertex])) -> &[Vec3] {
        self.vertices.clear();
        self.vertices.resize(vertices, Vertex::zeroed());
        write(&mut self.vertices);
        self.places.clear();
        self.places.extend(self.vertices.iter().map(|vertex| Vec3::from_array(vertex.position())));
        &self.places
    }
}

impl Scene<'_> {
    /// Tells the places of a block, one of [`Scene::blocks`].
    pub fn places(&self, block: usize, room: &mut Room, take: &mut dyn TakePlaces) {
        let of_stems = self.stem_places().div_ceil(super::blocks::BLOCK);
        let Some(block) = block.checked_sub(self.wood.blocks()) else {
            return self.places_of_wood(block, room, take);
        };
        if block < of_stems {
            let Ok::<(), Infallible>(()) = self.each_stem(span(block, self.stem_places()), |node| {
                self.places_of_stem(node, room, take);
                Ok(())
            });
        } else {
            let organs = span(block - of_stems, self.plant().organs.len());
            self.organs_of(organs).for_each(|organ| self.places_of_organ(organ, None, room, take));
        }
    }

    fn places_of_wood(&self, block: usize, room: &mut Room, take: &mut dyn TakePlaces) {
        let tubes = self.wood.tubes().and_then(|reduced| Some((reduced, reduced.blocks().get(block)?)));
        if let Some((reduced, tubes)) = tubes {
            self.places_of_tubes(reduced, tubes.clone(), room, take);
        } else if let Some(welded) = self.wood.welded() {
            room.faces.clear();
            room.faces.extend(welded.faces.iter().map(|face| face.indices()));
            room.write(welded.vertices.len(), |out| out.copy_from_slice(&welded.vertices));
            take.faces(&room.places, &room.faces);
        }
    }

    fn places_of_tubes(&self, reduced: &Reduced, tubes: Range<usize>, room: &mut Room, take: &mut dyn TakePlaces) {
        let Room { course, rings, .. } = room;
        for tube in tubes {
            reduced.each_piece(self.stems(), tube, (course, rings), &mut |rings| take.tube(rings));
        }
    }

    fn places_of_stem(&self, node: NodeId, room: &mut Room, take: &mut dyn TakePlaces) {
        let form = self.stems().form(node);
        if let Drawn::Tube(tube, _) = form {
            let frustum = self.stems().frustum(node);
            let [base, heading, up] = [frustum.base, frustum.heading, frustum.up].map(Vec3::from_array);
            let (along, thick) =
                (0.5 * frustum.length * heading, tube.reach() * frustum.radii[0].max(frustum.radii[1]));
            if take.wants(&Held { middle: base + along, half: [along, thick * up, thick * heading.cross(up)] }) {
                tube.rings(&frustum, &mut room.rings);
                take.tube([&room.rings[0], &room.rings[1]]);
            }
        } else {
            let places = room.write(form.vertices(), |out| self.stems().write(form, node, out));
            take.faces(places, form.faces());
        }
    }

    /// A box that holds an organ of which nothing is left out, in its own form and in its coarser ones; `None` for a
    /// form that the organ states itself.
    pub fn box_of(&self, organ: OrganId) -> Option<OrganBox> {
        let Shown::Whole(OrganForm::Shape(shape)) = self.form(organ) else { return None };
        let place = self.placement(organ, shape);
        let [mut low, mut high] = shape.bounds(&place);
        for coarse in shape.coarser_meshes() {
            let fullness = self.fullness(organ, coarse);
            let [least, most] = coarse.bounds(&Placement { fullness, ..place });
            (low, high) = (low.min(least), high.max(most));
        }
        let base = Frame { base: place.base, heading: place.heading, up: place.up };
        Some(OrganBox { base, held: held(&place, [low, high]) })
    }

    /// Tells the places of an organ, whose box is known or not.
    pub fn places_of_organ(
        &self,
        organ: OrganId,
        known: Option<&OrganBox>,
        room: &mut Room,
        take: &mut dyn TakePlaces,
    ) {
        let form = self.form(organ);
        if let Shown::Whole(OrganForm::Shape(shape)) = form {
            let base = known.map_or_else(|| organ_base(self.plant(), organ, self.age()), |known| known.base);
            let place = self.placement_at(base, organ, shape);
            if take.wants(&held(&place, shape.bounds(&place))) {
                shape.places(&place, &mut room.places);
                take.faces(&room.places, &shape.faces);
            }
        } else {
            let places = room.write(form.vertices(), |out| self.write_organ(form, organ, out));
            take.faces(places, form.faces());
        }
    }
}

/// The box of an organ, by the least and the most along its axes.
#[inline]
fn held(place: &Placement, [low, high]: [Vec3; 2]) -> Held {
    let [base, heading, up] = [place.base, place.heading, place.up].map(Vec3::from_array);
    let axes = [heading, up.cross(heading), up];
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let middle = base + middle.x * axes[0] + middle.y * axes[1] + middle.z * axes[2];
    Held { middle, half: [half.x * axes[0], half.y * axes[1], half.z * axes[2]] }
}
