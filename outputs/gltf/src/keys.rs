//! A plant at the key ages of a life: what its morph targets are made of.
//!
//! The plant is shown once for each key, in the order of age. Its wood is the lines of a [`Life`]; what is drawn by
//! itself, organs and internodes that are no plain tubes, is kept with its corners at each key at which it stands. What
//! does not stand at a key is a point there: the tip of the internode that bears it, or of the nearest one below it
//! that stands. So a part grows out of its bearer, and goes into it again. Memory grows with the number of keys, not
//! with the number of ages that lie between them. Absent: tubes (`wood`), and the file (`growth`).

use super::paint::class_of;
use phytomer_life::{Life, Maker, Nearness};
use phytomer_meshes::{Mesh, MeshOptions, OwnForms, Scene, Slots, Tag, Tolerance, Vertex};
use phytomer_sim::Tick;
use phytomer_sim::plant::{NodeId, OrganId, Plant};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

const NONE: u32 = u32::MAX;
/// The number under which the flare of a trunk is kept.
const FLARE: usize = 0;
/// The place of what does not stand.
const NOWHERE: [f32; 3] = [f32::NAN; 3];
/// The most bearers that are passed on the way to one that stands.
const MOST_BEARERS: usize = 64;

/// Something that is drawn by itself.
#[derive(Debug, Clone)]
pub struct Alone {
    /// What its vertices share at the last key at which it stands.
    pub tag: Tag,
    /// The first key at which it stands.
    pub first: usize,
    /// The first of its corners at each key at which it stands.
    corners: Vec<u32>,
    /// Its triangles, and its colours, a corner.
    pub faces: Range<usize>,
    pub colours: Range<usize>,
}

impl Alone {
    /// The keys at which it stands.
    pub fn keys(&self) -> Range<usize> {
        self.first..self.first + self.corners.len()
    }

    /// The number of its vertices.
    pub fn vertices(&self) -> usize {
        self.colours.len()
    }
}

/// A plant at one of the keys.
#[derive(Debug, Clone)]
struct Shown {
    age: f32,
    /// The tip of each internode by its number; what does not stand has the place where it would grow from.
    tips: Vec<[f32; 3]>,
}

/// A plant that is shown key by key.
pub struct KeyMaker {
    maker: Maker,
    options: MeshOptions,
    keyed: Keyed,
    /// What is drawn by itself: the flare of the trunk, and from 1 on what has the component number that is 1 less.
    known: Vec<u32>,
    /// The triangles that are kept, since most organs share them.
    shared: BTreeMap<Vec<[u32; 3]>, Range<usize>>,
}

/// A plant at all keys.
#[derive(Debug, Clone, Default)]
pub struct Keyed {
    /// The lines of its wood.
    pub(crate) life: Life,
    /// What is drawn by itself.
    pub(crate) alone: Vec<Alone>,
    shown: Vec<Option<Shown>>,
    /// What bears each component, by its number.
    bearer: Vec<u32>,
    corners: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    pub(crate) colours: Vec<[u8; 4]>,
    /// Texture coordinates in the places of the colours, those of the last key; none where no picture covers anything.
    pub(crate) textures: Vec<[f32; 2]>,
    pub(crate) faces: Vec<[u32; 3]>,
    /// The materials, and what covers the parts of the species.
    pub(crate) slots: Slots,
    own: Arc<OwnForms>,
}

impl KeyMaker {
    /// A plant whose wood is drawn within a tolerance, and its forms by these options, at so many keys.
    pub fn new(tolerance: Tolerance, options: &MeshOptions, keys: usize) -> Self {
        let options = MeshOptions { tolerance: Some(tolerance), ..options.clone() };
        let maker = Maker::new(Nearness::of(tolerance.distance), &options);
        let keyed = Keyed { shown: vec![None; keys], own: Arc::clone(&options.own), ..Keyed::default() };
        Self { maker, options, keyed, known: Vec::new(), shared: BTreeMap::new() }
    }

    /// Shows the plant at a later key than before.
    pub fn show(&mut self, key: usize, plant: &Plant, age: Tick) {
        self.maker.show(plant, age);
        let shown = self.keyed.stand(plant, age);
        if let Some(place) = self.keyed.shown.get_mut(key) {
            *place = Some(shown);
        }
        let options = self.options.clone();
        if self.keyed.has_textures() {
            // A plant keeps the numbers of what has fallen, so that the last one that is shown has all.
            self.keyed.slots = Slots::of([(plant, &options, 0)]);
        }
        let scene = Scene::new(plant, age, &options);
        if let Some(foot) = scene.stems().foot() {
            let flare = scene.stems().flare_mesh(&foot);
            let faces: Vec<[u32; 3]> = flare.faces.iter().map(phytomer_meshes::Face::indices).collect();
            self.keep(FLARE, key, &flare.vertices, &faces);
        }
        scene.each_alone(&mut |vertices, faces| {
            let number = vertices.first().and_then(|vertex| usize::try_from(vertex.tag().component).ok());
            self.keep(number.map_or(FLARE, |number| number + 1), key, vertices, faces);
        });
    }

    /// Keeps what is drawn by itself under a number, by which it is known again.
    fn keep(&mut self, number: usize, key: usize, vertices: &[Vertex], faces: &[[u32; 3]]) {
        let Some(tag) = vertices.first().map(Vertex::tag).filter(|_| !faces.is_empty()) else { return };
        if self.known.len() <= number {
            self.known.resize(number + 1, NONE);
        }
        let last = self.keyed.alone.get(self.known[number] as usize);
        // A form from near that changes with age may have as many corners and other triangles.
        let goes_on = last.is_some_and(|last| {
            let same = last.vertices() == vertices.len() && self.keyed.faces[last.faces.clone()] == *faces;
            last.keys().end == key && same
        });
        if !goes_on {
            let faces = self.share(faces);
            self.known[number] = self.keyed.alone.len() as u32;
            self.keyed.begin(key, tag, vertices, faces);
        }
        let keyed = &mut self.keyed;
        let corner = keyed.corners.len() as u32;
        if let Some(alone) = keyed.alone.get_mut(self.known[number] as usize) {
            alone.corners.push(corner);
            alone.tag = tag;
            if goes_on && keyed.own.has_textures() {
                let coordinates = keyed.textures[alone.colours.clone()].iter_mut();
                coordinates.zip(vertices).for_each(|(old, vertex)| *old = vertex.texture());
            }
            // Leaves keep the green of their first key, wood and fruits take the colour of their last.
            if goes_on && class_of(&tag) != 1 {
                let colours = vertices.iter().map(|vertex| vertex.tag().colour);
                keyed.colours[alone.colours.clone()].iter_mut().zip(colours).for_each(|(old, new)| *old = new);
            }
        }
        keyed.corners.extend(vertices.iter().map(Vertex::position));
        keyed.normals.extend(vertices.iter().map(Vertex::normal));
    }

    fn share(&mut self, faces: &[[u32; 3]]) -> Range<usize> {
        if let Some(known) = self.shared.get(faces) {
            return known.clone();
        }
        let start = self.keyed.faces.len();
        self.keyed.faces.extend_from_slice(faces);
        let range = start..self.keyed.faces.len();
        self.shared.insert(faces.to_vec(), range.clone());
        range
    }

    /// The plant at all keys.
    pub fn finish(self) -> Keyed {
        let mut keyed = self.keyed;
        keyed.life = self.maker.finish();
        for shown in keyed.shown.iter_mut().flatten() {
            shown.tips.resize(keyed.bearer.len(), NOWHERE);
            // Most bearers have smaller numbers, so that one scan finds them.
            for component in 0..shown.tips.len() {
                let bearer = keyed.bearer[component] as usize;
                if shown.tips[component][0].is_nan() && bearer < component {
                    shown.tips[component] = shown.tips[bearer];
                }
            }
        }
        keyed
    }
}

impl Keyed {
    /// Closed meshes that stand still at all keys.
    pub fn still(meshes: &[Arc<Mesh>], keys: usize) -> Self {
        let mut keyed = Self { shown: vec![None; keys], ..Self::default() };
        for mesh in meshes {
            let Some(tag) = mesh.vertices.first().map(Vertex::tag) else { continue };
            let start = keyed.faces.len();
            keyed.faces.extend(mesh.faces.iter().map(phytomer_meshes::Face::indices));
            keyed.begin(0, tag, &mesh.vertices, start..keyed.faces.len());
            let corner = keyed.corners.len() as u32;
            keyed.corners.extend(mesh.vertices.iter().map(Vertex::position));
            keyed.normals.extend(mesh.vertices.iter().map(Vertex::normal));
            keyed.alone.iter_mut().last().into_iter().for_each(|alone| alone.corners = vec![corner; keys]);
        }
        keyed
    }

    /// Whether pictures cover parts of the plant.
    pub fn has_textures(&self) -> bool {
        self.own.has_textures()
    }

    /// How many metres of bark the picture of an order is wide and long.
    pub fn bark(&self, order: u8) -> Option<[f32; 2]> {
        self.own.textures().bark(order)
    }

    /// The number of keys.
    pub fn keys(&self) -> usize {
        self.shown.len()
    }

    /// The age of the plant at a key; `None` before it is sown.
    pub fn age(&self, key: usize) -> Option<f32> {
        self.shown.get(key)?.as_ref().map(|shown| shown.age)
    }

    /// The first of the keys at which something that stood at `last` stands no more, by the age of the plant; the
    /// largest number where there is none.
    pub fn death(&self, last: usize) -> f32 {
        (last + 1..self.keys()).find_map(|key| self.age(key)).unwrap_or(f32::MAX)
    }

    /// Where a component that does not stand at a key would grow from.
    pub fn origin(&self, component: u32, key: usize) -> [f32; 3] {
        let Some(Some(shown)) = self.shown.get(key) else { return [0.0; 3] };
        let mut at = component;
        for _ in 0..MOST_BEARERS {
            let Some(tip) = shown.tips.get(at as usize) else { break };
            if !tip[0].is_nan() {
                return *tip;
            }
            at = self.bearer[at as usize];
        }
        [0.0; 3]
    }

    /// Where an internode begins at a key, if the internode below it stands.
    pub fn base(&self, component: u32, key: usize) -> [f32; 3] {
        self.origin(self.bearer.get(component as usize).copied().unwrap_or(NONE), key)
    }

    /// The corners of something that is drawn by itself: as it stands at a key, or the point that it is there.
    pub fn corners(&self, alone: &Alone, key: usize, out: &mut Vec<[f32; 3]>) {
        out.clear();
        let keys = alone.keys();
        if let Some(first) = key.checked_sub(keys.start).and_then(|nth| alone.corners.get(nth)) {
            out.extend_from_slice(&self.corners[*first as usize..*first as usize + alone.vertices()]);
            return;
        }
        let near = key.clamp(keys.start.saturating_sub(1), keys.end.min(self.keys() - 1));
        let component = u32::try_from(alone.tag.component).unwrap_or(NONE);
        out.resize(alone.vertices(), self.origin(component, near));
    }

    /// The normals of the same at the last key at which it stands.
    pub fn normals(&self, alone: &Alone) -> &[[f32; 3]] {
        let first = alone.corners.last().map_or(0, |first| *first as usize);
        &self.normals[first..first + alone.vertices()]
    }

    fn begin(&mut self, key: usize, tag: Tag, vertices: &[Vertex], faces: Range<usize>) {
        let start = self.colours.len();
        self.colours.extend(vertices.iter().map(|vertex| vertex.tag().colour));
        if self.has_textures() {
            self.textures.extend(vertices.iter().map(Vertex::texture));
        }
        let colours = start..self.colours.len();
        self.alone.push(Alone { tag, first: key, corners: Vec::new(), faces, colours });
    }

    /// Takes the tips of all internodes that stand, and what bears whom.
    fn stand(&mut self, plant: &Plant, age: Tick) -> Shown {
        let (nodes, organs) = (&plant.nodes, &plant.organs);
        let mut tips = vec![NOWHERE; self.bearer.len()];
        for node in (0..nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, age)) {
            let component = nodes.component[node.index()];
            let parent = nodes.parent[node.index()].some().map(|parent| nodes.component[parent.index()]);
            let at_birth = plant.bearer_at_birth(component).flatten();
            self.bear(component, at_birth.or(parent));
            let place = component as usize;
            if tips.len() <= place {
                tips.resize(place + 1, NOWHERE);
            }
            tips[place] = plant.frames.at(node).advanced(plant.posed_length(node)).base;
        }
        for organ in (0..organs.len() as u32).map(OrganId).filter(|organ| plant.organ_stands(*organ, age)) {
            let bearer = nodes.component[organs.node[organ.index()].index()];
            self.bear(organs.component[organ.index()], Some(bearer));
        }
        Shown { age: plant.shown_age(age) as f32, tips }
    }

    fn bear(&mut self, component: u32, bearer: Option<u32>) {
        let place = component as usize;
        if self.bearer.len() <= place {
            self.bearer.resize(place + 1, NONE);
        }
        self.bearer[place] = bearer.unwrap_or(NONE);
    }
}
