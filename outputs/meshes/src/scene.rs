//! The standing part of a plant at an age, as vertices and triangles in chunks.
//!
//! An internode stands from its birth until its branch falls, an organ from its birth until its death. A living
//! component has the death age +∞, so that `birth_age <= a and a < death_age` holds without a special case and no later
//! fate is shown; an internode that stands dead has the age of its death. The base of an organ is moved from the axis
//! line to the surface of the stem, by half the tip's diameter towards the organ.

use super::MeshOptions;
use super::chunk::{Chunk, Face, Sink, Tag, Vertex};
use super::forms::{FormMesh, Placement};
use super::outline::{self, OrganForm, Outlines};
use super::section::{Prism, Ring};
use super::tube::{Frustum, Strip, Tube};
use super::{About, Mesh, colour};
use bytemuck::Zeroable;
use phytomer_looks::Paints;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{AxisId, InternodeLook, NodeId, OrganId, Plant, Shape as Stem};
use phytomer_sim::pose::{Frame, organ_frame, stated_organ_frame};
use std::io;
use std::ops::Range;

/// The number of entries of a column in one block of a scene.
const BLOCK: usize = 256;

/// An organ whose insertion angle has a smaller sine stands on the tip of the stem, not on its side.
const TERMINAL: f32 = 1e-3;

/// The size of a mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// The number of its components.
    pub components: u64,
    /// The number of its vertices.
    pub vertices: u64,
    /// The number of its triangles.
    pub faces: u64,
}

/// A plant at an age, ready to be drawn.
#[derive(Debug)]
pub struct Scene<'a> {
    plant: &'a Plant,
    age: Tick,
    options: MeshOptions,
    paints: &'a Paints,
    /// The form of internodes by the index of their look in the habit; the last entry is for internodes without a look.
    stems: Vec<Drawn>,
    /// The forms of internodes with a cross section of their own, in the places of the sections.
    sections: Vec<Drawn>,
    /// The triangles of organs that state an outline.
    outlines: Outlines,
}

/// The form of an internode.
#[derive(Debug)]
enum Drawn {
    Tube(Tube),
    Strip,
    Prism(Prism),
    /// A form of an organ, with the internode's length and diameter.
    Form(FormMesh),
}

impl Drawn {
    fn of(look: &InternodeLook, paints: &Paints, options: &MeshOptions) -> Self {
        let paint = paints.internode(look.paint);
        match (paint.form, look.shape) {
            (Some(form), _) => Self::Form(options.shape(form).clone()),
            (None, Stem::Blade) => Self::Strip,
            (None, Stem::Cylinder | Stem::Cone) => Self::Tube(Tube::new(paint.sides.unwrap_or(options.sides))),
        }
    }

    fn vertices(&self) -> usize {
        match self {
            Self::Tube(tube) => tube.vertices(),
            Self::Strip => Strip::VERTICES,
            Self::Prism(prism) => prism.vertices(),
            Self::Form(shape) => shape.points.len(),
        }
    }

    fn faces(&self) -> &[[u32; 3]] {
        match self {
            Self::Tube(tube) => tube.faces(),
            Self::Strip => &Strip::FACES,
            Self::Prism(prism) => prism.faces(),
            Self::Form(shape) => &shape.faces,
        }
    }
}

impl<'a> Scene<'a> {
    /// The scene of `plant` at `age`; its frames and diameters must be those of that age.
    pub fn new(plant: &'a Plant, age: Tick, options: &MeshOptions) -> Self {
        let looks = plant.habit.looks.internodes.iter().chain(&plant.habit.looks.apart);
        let paints = Paints::of(&plant.habit);
        let mut stems: Vec<Drawn> = looks.map(|look| Drawn::of(look, paints, options)).collect();
        stems.push(Drawn::Tube(Tube::new(options.sides)));
        let sections = paints.sections().iter().map(|section| Drawn::Prism(Prism::new(section))).collect();
        Self { plant, age, options: options.clone(), paints, stems, sections, outlines: Outlines::of(plant) }
    }

    /// The age of the plant.
    pub fn age(&self) -> Tick {
        self.age
    }

    /// The identity of the mesh, for its file.
    pub fn about(&self, run_seed: u64) -> About {
        About { plant: self.plant.id, age: self.age, run_seed, place: self.plant.place }
    }

    /// The size of the mesh, by one scan of births and deaths.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        let mut count = |vertices: usize, faces: usize| {
            counts.components += 1;
            counts.vertices += vertices as u64;
            counts.faces += faces as u64;
        };
        self.nodes().for_each(|node| {
            let stem = self.stem(node);
            count(stem.vertices(), stem.faces().len());
        });
        self.organs().for_each(|organ| {
            let form = self.form(organ);
            count(form.vertices(), form.faces().len());
        });
        counts
    }

    /// Writes the vertices into `chunk`, and calls `sink` with each full chunk and with the last one.
    ///
    /// # Errors
    /// The errors of `sink`.
    pub fn vertices(&self, chunk: &mut Chunk, sink: &mut Sink) -> io::Result<()> {
        for node in self.nodes() {
            let stem = self.stem(node);
            self.write_stem(stem, node, chunk.room(stem.vertices(), sink)?);
        }
        for organ in self.organs() {
            let form = self.form(organ);
            self.write_organ(form, organ, chunk.room::<Vertex>(form.vertices(), sink)?);
        }
        sink(chunk)
    }

    /// Writes the triangles into `chunk`, in the order of the vertices, and calls `sink` with each full chunk and with
    /// the last one.
    ///
    /// # Errors
    /// The errors of `sink`.
    pub fn faces(&self, chunk: &mut Chunk, sink: &mut Sink) -> io::Result<()> {
        let mut first = 0;
        for node in self.nodes() {
            let stem = self.stem(node);
            put_faces(first, stem.faces(), chunk, sink)?;
            first += stem.vertices() as u32;
        }
        for organ in self.organs() {
            let form = self.form(organ);
            put_faces(first, form.faces(), chunk, sink)?;
            first += form.vertices() as u32;
        }
        sink(chunk)
    }

    /// The number of blocks of the scene, for [`Scene::block`].
    pub fn blocks(&self) -> usize {
        self.plant.nodes.len().div_ceil(BLOCK) + self.plant.organs.len().div_ceil(BLOCK)
    }

    /// Replaces `mesh` by one block of neighbouring components; triangles refer to the block's own vertices. All blocks
    /// in their order are the mesh of the scene, and each can be made alone, on any thread. A block may be empty. Takes
    /// O(1) per component of the block.
    pub fn block(&self, block: usize, mesh: &mut Mesh) {
        mesh.vertices.clear();
        mesh.faces.clear();
        let of_nodes = self.plant.nodes.len().div_ceil(BLOCK);
        if block < of_nodes {
            self.nodes_of(span(block, self.plant.nodes.len())).for_each(|node| {
                let stem = self.stem(node);
                self.write_stem(stem, node, appended(mesh, stem.vertices(), stem.faces()));
            });
        } else {
            self.organs_of(span(block - of_nodes, self.plant.organs.len())).for_each(|organ| {
                let form = self.form(organ);
                self.write_organ(form, organ, appended(mesh, form.vertices(), form.faces()));
            });
        }
    }

    /// The internodes that are drawn.
    fn nodes(&self) -> impl Iterator<Item = NodeId> {
        self.nodes_of(0..self.plant.nodes.len())
    }

    fn nodes_of(&self, range: Range<usize>) -> impl Iterator<Item = NodeId> {
        let (plant, age, kinds) = (self.plant, self.age, self.options.kinds);
        let drawn = move |&node: &NodeId| plant.stands(node, age) && kinds[plant.kind_of(node) as usize];
        range.map(|node| NodeId(node as u32)).filter(drawn)
    }

    /// The organs that are drawn.
    fn organs(&self) -> impl Iterator<Item = OrganId> {
        self.organs_of(0..self.plant.organs.len())
    }

    fn organs_of(&self, range: Range<usize>) -> impl Iterator<Item = OrganId> {
        let (plant, age, kinds) = (self.plant, self.age, self.options.kinds);
        let drawn = move |&organ: &usize| {
            plant.organ_stands(OrganId(organ as u32), age) && kinds[plant.organs.kind[organ] as usize]
        };
        range.filter(drawn).map(|organ| OrganId(organ as u32))
    }

    #[inline]
    fn form(&self, organ: OrganId) -> OrganForm<'_> {
        if let Some((place, scale)) = self.plant.stated_organs.surface(organ)
            && let Some(surface) = self.paints.surface(place)
        {
            return OrganForm::Surface(surface, scale);
        }
        match self.outlines.faces(organ) {
            Some(faces) => OrganForm::Outline(self.plant.outline_of(organ), faces),
            None => OrganForm::Shape(self.options.shape(self.plant.organs.form[organ.index()])),
        }
    }

    #[inline]
    fn write_organ(&self, form: OrganForm<'_>, organ: OrganId, out: &mut [Vertex]) {
        let tags = self.organ_tags(organ);
        match form {
            OrganForm::Shape(shape) => shape.write(&self.placement(organ, shape), &tags, out),
            OrganForm::Outline(corners, faces) => {
                let (frame, share) = (self.organ_base(organ), self.plant.expanded(organ, self.age));
                outline::write((corners, faces), &frame, share, &tags[0], out);
            }
            OrganForm::Surface(surface, scale) => {
                let (frame, share) = (self.organ_base(organ), self.plant.expanded(organ, self.age));
                outline::write_surface(surface, scale.map(|x| share * x), &frame, &tags[0], out);
            }
        }
    }

    /// The form of an internode.
    #[inline]
    fn stem(&self, node: NodeId) -> &Drawn {
        let Plant { axes, nodes, habit, own_looks, .. } = self.plant;
        if let Some(section) = own_looks.section_of(node).and_then(|place| self.sections.get(place)) {
            return section;
        }
        if let Some(apart) = own_looks.of_node(node).filter(|&place| place < habit.looks.apart.len()) {
            return &self.stems[habit.looks.internodes.len() + apart];
        }
        let axis: AxisId = nodes.axis[node.index()];
        let place = habit.looks.place(axes.order[axis.index()], axes.state[axis.index()]);
        &self.stems[place.unwrap_or(self.stems.len() - 1)]
    }

    #[inline]
    fn write_stem(&self, stem: &Drawn, node: NodeId, out: &mut [Vertex]) {
        match stem {
            Drawn::Tube(tube) => tube.write(&self.frustum(node), &self.wood_tag(node), out),
            Drawn::Strip => Strip::write(&self.frustum(node), &self.wood_tag(node), out),
            Drawn::Prism(prism) => prism.write(self.rings(node), &self.wood_tag(node), out),
            Drawn::Form(shape) => shape.write(&self.stands(node), &[self.wood_tag(node); 2], out),
        }
    }

    /// The placement of an internode that has the form of an organ.
    fn stands(&self, node: NodeId) -> Placement {
        let frame = self.plant.frames.at(node);
        let nodes = &self.plant.nodes;
        let size = [self.plant.posed_length(node), nodes.diameter[node.index()]];
        Placement { base: frame.base, heading: frame.heading, up: frame.up, size, fullness: 1.0 }
    }

    /// The rings of an internode with a section: it begins with that at the tip of the internode with a section that it
    /// continues, if there is one.
    fn rings(&self, node: NodeId) -> [Ring; 2] {
        let own = self.frustum(node);
        let [base, tip] = [Ring::base(&own), Ring::tip(&own)];
        let before = self.plant.nodes.parent[node.index()].some();
        let before = before.filter(|parent| self.plant.own_looks.section_of(*parent).is_some());
        let joint = before.map(|parent| Ring::tip(&self.frustum(parent))).filter(|end| end.meets(&base));
        [joint.map_or(base, |end| Ring { middle: base.middle, radius: base.radius, ..end }), tip]
    }

    #[inline]
    fn frustum(&self, node: NodeId) -> Frustum {
        let frame = self.plant.frames.at(node);
        let (nodes, length) = (&self.plant.nodes, self.plant.posed_length(node));
        let node = node.index();
        let radii = [nodes.diameter[node] * 0.5, nodes.diameter_tip[node] * 0.5];
        Frustum { base: frame.base, heading: frame.heading, up: frame.up, length, radii }
    }

    /// The placement of an organ, with its size at its age, and with the fullness that gives it the area in the tables.
    fn placement(&self, organ: OrganId, shape: &FormMesh) -> Placement {
        let frame = self.organ_base(organ);
        let organs = &self.plant.organs;
        let share = self.plant.expanded(organ, self.age);
        let full = [organs.length[organ.index()], organs.width[organ.index()]];
        // An organ expands in proportion, so its fullness is that of its full size.
        let fullness = shape.fullness(full, organs.area[organ.index()]);
        let size = full.map(|size| size * share);
        Placement { base: frame.base, heading: frame.heading, up: frame.up, size, fullness }
    }

    /// The frame of an organ at its drawn base: where the organ states it, else on the surface of its stem.
    #[inline]
    fn organ_base(&self, organ: OrganId) -> Frame {
        if let Some(stated) = stated_organ_frame(self.plant, organ) {
            return stated;
        }
        let frame = organ_frame(self.plant, organ, self.age);
        let node = self.plant.organs.node[organ.index()];
        let out = outward(self.plant.frames.heading[node.index()], frame.heading);
        let radius = 0.5 * self.plant.nodes.diameter_tip[node.index()];
        Frame { base: [0, 1, 2].map(|k| frame.base[k] + radius * out[k]), ..frame }
    }

    #[inline]
    fn wood_tag(&self, node: NodeId) -> Tag {
        let look = self.plant.look_of_node(node);
        let nodes = &self.plant.nodes;
        let death = self.plant.death_of(node);
        let node = node.index();
        let dead = death <= self.age;
        Tag {
            colour: colour::wood(
                look.kind,
                &self.paints.internode(look.paint).bark,
                self.age - nodes.birth[node],
                dead,
            ),
            birth: nodes.birth[node] as f32,
            death: if dead { death as f32 } else { f32::INFINITY },
            component: nodes.component[node] as i32,
            kind: look.kind(nodes.formation[node].is_short()) as u8,
        }
    }

    /// The tags of an organ and of its stalk.
    fn organ_tags(&self, organ: OrganId) -> [Tag; 2] {
        let organs = &self.plant.organs;
        let place = organ.index();
        colour::organ(self.plant, self.paints, organ, self.age).map(|colour| Tag {
            colour,
            birth: organs.birth[place] as f32,
            death: f32::INFINITY,
            component: organs.component[place] as i32,
            kind: organs.kind[place] as u8,
        })
    }
}

/// The entries of a column of `length` entries in a block.
fn span(block: usize, length: usize) -> Range<usize> {
    block * BLOCK..((block + 1) * BLOCK).min(length)
}

/// Adds room for `vertices` vertices at the end of `mesh`, and adds their triangles.
#[inline]
fn appended<'m>(mesh: &'m mut Mesh, vertices: usize, faces: &[[u32; 3]]) -> &'m mut [Vertex] {
    let first = mesh.vertices.len();
    mesh.faces.extend(faces.iter().map(|face| Face::new(face.map(|corner| first as u32 + corner))));
    mesh.vertices.resize(first + vertices, Vertex::zeroed());
    &mut mesh.vertices[first..]
}

/// The part of an organ's heading across its stem, as a unit vector; zero for an organ on the tip.
fn outward(stem: [f32; 3], organ: [f32; 3]) -> [f32; 3] {
    let along = stem[0] * organ[0] + stem[1] * organ[1] + stem[2] * organ[2];
    let across = [0, 1, 2].map(|k| organ[k] - along * stem[k]);
    let length = (across[0] * across[0] + across[1] * across[1] + across[2] * across[2]).sqrt();
    if length > TERMINAL { across.map(|x| x / length) } else { [0.0; 3] }
}

#[inline]
fn put_faces(first: u32, faces: &[[u32; 3]], chunk: &mut Chunk, sink: &mut Sink) -> io::Result<()> {
    let out = chunk.room(faces.len(), sink)?;
    for (face, out) in faces.iter().zip(out) {
        *out = Face::new(face.map(|corner| first + corner));
    }
    Ok(())
}
