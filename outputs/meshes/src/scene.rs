//! The standing part of a plant at an age, as vertices and triangles in chunks.
//!
//! An internode stands from its birth until its branch falls, an organ from its birth until its death. A living
//! component has the death age +∞, so that `birth_age <= a and a < death_age` holds without a special case and no later
//! fate is shown; an internode that stands dead has the age of its death. Between two ticks all that stands at either
//! is there, and what is yet to appear by the later one has the birth age of that. The base of an organ is moved from
//! the axis line to the surface of the stem, by half the tip's diameter towards the organ.

use super::chunk::{Chunk, Counts, Face, Sink, Tag, Vertex};
use super::columns::Columns;
use super::detail::{Detail, Primitive};
use super::drawn_organ::DrawnOrgan;
use super::dress::{Crown, is_leaf};
use super::forms::{FormMesh, Placement};
use super::near::{self, NearForm, Nears};
use super::organ_base::organ_base;
use super::outline::{self, OrganForm, Outlines, OwnForm, Shown};
use super::stem::Stems;
use super::wood::Wood;
use super::{About, Joints, MeshOptions, Thinned, Tolerance, colour};
use phytomer_looks::Paints;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{NodeId, OrganId, Plant};
use phytomer_sim::pose::Frame;
use std::convert::Infallible;
use std::io;
use std::ops::Range;
use std::sync::Arc;

/// A plant at an age, ready to be drawn.
#[derive(Debug)]
pub struct Scene<'a> {
    plant: &'a Plant,
    age: Tick,
    options: MeshOptions,
    paints: &'a Paints,
    stems: Stems<'a>,
    /// The wood that is not drawn internode by internode.
    pub(super) wood: Wood,
    /// The triangles of organs that state an outline.
    outlines: Outlines,
    /// The crown out of which leaf normals point, where that is asked for.
    crown: Option<Crown>,
    /// What vertices tell beside the properties of every mesh.
    columns: Option<Columns<'a>>,
    /// The forms of organs seen from near; none at detail 0.
    nears: Option<Arc<Nears>>,
}

impl<'a> Scene<'a> {
    /// The scene of `plant` at `age`; its frames and diameters must be those of that age. Of a plant that is shown
    /// between two ticks `age` is the later one.
    pub fn new(plant: &'a Plant, age: Tick, options: &MeshOptions) -> Self {
        let stems = Stems::of(plant, age, options);
        let wood = Wood::of(&stems, options);
        let paints = Paints::of(&plant.habit);
        let columns = Columns::of(plant, stems.detail.as_ref(), options.swings.as_ref(), options.attributes);
        let (nears, options) = ((options.detail > 0).then(|| options.nears.of(paints)), options.clone());
        let outlines = Outlines::of(plant);
        let mut scene = Self { plant, age, options, paints, stems, wood, outlines, crown: None, columns, nears };
        scene.crown = scene.options.crown_normals.then(|| scene.crown()).flatten();
        scene
    }

    /// The crown of the leaves that are drawn.
    fn crown(&self) -> Option<Crown> {
        Crown::around(self.organs().filter(|organ| is_leaf(self.plant, *organ)).map(|organ| self.organ(organ).base))
    }

    /// The ranges at which something ends to be drawn, metres, in their order; none where no range is asked for.
    pub fn ends(&self) -> Vec<f32> {
        self.stems.detail.as_ref().map(Detail::ends).unwrap_or_default()
    }

    /// What vertices tell beside the properties of every mesh.
    pub fn columns(&self) -> Option<&Columns<'a>> {
        self.columns.as_ref()
    }

    /// The same scene with its wood drawn within a tolerance.
    pub fn within(&self, tolerance: Tolerance) -> Self {
        Self::new(self.plant, self.age, &MeshOptions { tolerance: Some(tolerance), ..self.options.clone() })
    }

    /// Draws fewer or more of its organs.
    pub fn thin(&mut self, thinned: Option<Thinned>) {
        self.options.thinned = thinned;
    }

    /// How it is drawn.
    pub fn options(&self) -> &MeshOptions {
        &self.options
    }

    /// The age of the plant; between two ticks that at the later one.
    pub fn age(&self) -> Tick {
        self.age
    }

    /// The age that the plant shows, ticks.
    pub fn shown_age(&self) -> f64 {
        self.plant.shown_age(self.age)
    }

    /// How near the wood is drawn; `None`: each internode by itself.
    pub fn tolerance(&self) -> Option<Tolerance> {
        self.options.tolerance
    }

    /// The identity of the mesh, for its file.
    pub fn about(&self, run_seed: u64) -> About {
        About { plant: self.plant.id, age: self.shown_age(), run_seed, place: self.plant.place }
    }

    /// The size of the mesh, by one scan of births and deaths.
    pub fn counts(&self) -> Counts {
        let mut counts = self.wood.counts();
        let mut count = |vertices: usize, faces: usize| {
            counts.components += 1;
            counts.vertices += vertices as u64;
            counts.faces += faces as u64;
        };
        let Ok::<(), Infallible>(()) = self.each_stem(0..self.stem_places(), |node| {
            let stem = self.stems.form(node);
            count(stem.vertices(), stem.faces().len());
            Ok(())
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
        self.wood.vertices(&self.stems, chunk, sink)?;
        self.each_stem(0..self.stem_places(), |node| {
            let stem = self.stems.form(node);
            self.stems.write(stem, node, chunk.room(stem.vertices(), sink)?);
            io::Result::Ok(())
        })?;
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
        let mut first = self.wood.faces(chunk, sink)?;
        self.each_stem(0..self.stem_places(), |node| {
            let stem = self.stems.form(node);
            put_faces(first, stem.faces(), chunk, sink)?;
            first += stem.vertices() as u32;
            io::Result::Ok(())
        })?;
        for organ in self.organs() {
            let form = self.form(organ);
            put_faces(first, form.faces(), chunk, sink)?;
            first += form.vertices() as u32;
        }
        sink(chunk)
    }

    /// The number of places of [`Scene::each_stem`].
    pub(super) fn stem_places(&self) -> usize {
        self.wood.apart().map_or(self.plant.nodes.len(), <[NodeId]>::len)
    }

    /// Calls `draw` with the internodes of some places that are drawn by themselves.
    #[inline]
    pub(super) fn each_stem<E>(
        &self,
        places: Range<usize>,
        draw: impl FnMut(NodeId) -> Result<(), E>,
    ) -> Result<(), E> {
        match self.wood.apart() {
            Some(apart) => apart[places].iter().copied().try_for_each(draw),
            None => self.stems.drawn_of(places).try_for_each(draw),
        }
    }

    /// Whether its wood should be one welded surface, and none of it is.
    pub fn welds_nothing(&self) -> bool {
        self.options.joints == Joints::Welded && self.wood.counts().components == 0
    }

    /// The plant.
    pub fn plant(&self) -> &'a Plant {
        self.plant
    }

    /// Its internodes.
    pub fn stems(&self) -> &Stems<'a> {
        &self.stems
    }

    /// An organ as it is drawn.
    pub fn organ(&self, organ: OrganId) -> DrawnOrgan {
        let colours = self.organ_colours(organ);
        match self.own_form(organ) {
            OrganForm::Shape(shape) => {
                let Placement { base, heading, up, size, fullness } = self.placement(organ, shape);
                let size = [size[0], size[1], 0.0];
                let own = self.near(organ).map_or(OwnForm::None, |(form, _)| OwnForm::Near(form));
                DrawnOrgan { base, heading, up, size, fullness, colours, own }
            }
            OrganForm::Outline(..) => {
                let Frame { base, heading, up } = organ_base(self.plant, organ, self.age);
                let share = self.share(organ);
                let size = [share, share, 0.0];
                DrawnOrgan { base, heading, up, size, fullness: 1.0, colours, own: OwnForm::Outline }
            }
            OrganForm::Surface(_, scale) => {
                let Frame { base, heading, up } = organ_base(self.plant, organ, self.age);
                let size = scale.map(|x| x * self.share(organ));
                let place = self.plant.stated_organs.surface(organ).map_or(0, |(place, _)| place);
                DrawnOrgan { base, heading, up, size, fullness: 1.0, colours, own: OwnForm::Surface(place) }
            }
        }
    }

    /// The forms of organs seen from near; none at detail 0.
    pub fn nears(&self) -> Option<&Arc<Nears>> {
        self.nears.as_ref()
    }

    /// The form from near of an organ, and which it is; `None` where it has that of detail 0 or a mesh of the user's.
    #[inline]
    pub fn near(&self, organ: OrganId) -> Option<(NearForm, &FormMesh)> {
        self.nears.as_ref()?.form((self.plant, self.age), organ, &self.options)
    }

    /// The finest detail that any of its organs has.
    pub fn finest(&self) -> u8 {
        let details = self.organs().map(|organ| near::detail_of(self.plant, organ, &self.options));
        if self.options.detail == 0 { 0 } else { details.max().unwrap_or_default() }
    }

    /// The colours of an organ and of its stalk.
    pub fn organ_colours(&self, organ: OrganId) -> [[u8; 4]; 2] {
        match self.options.colour_of(self.plant.organs.component[organ.index()]) {
            Some(stated) => [stated; 2],
            None => colour::organ(self.plant, self.paints, organ, self.age),
        }
    }

    /// The organs that are drawn.
    pub fn organs(&self) -> impl Iterator<Item = OrganId> {
        self.organs_of(0..self.plant.organs.len())
    }

    /// Of a range of organs those that are drawn.
    pub fn organs_of(&self, range: Range<usize>) -> impl Iterator<Item = OrganId> {
        let (plant, age, kinds, detail) = (self.plant, self.age, self.options.kinds, self.stems.detail.as_ref());
        let thinned = self.options.thinned;
        let drawn = move |&organ: &OrganId| {
            plant.organ_stands(organ, age)
                && kinds[plant.organs.kind[organ.index()] as usize]
                && thinned.is_none_or(|thinned| thinned.keeps(plant, organ))
                && detail.is_none_or(|detail| detail.leaf(plant, organ).is_some())
        };
        range.map(|organ| OrganId(organ as u32)).filter(drawn)
    }

    /// The form of an organ as it is drawn.
    #[inline]
    pub(super) fn form(&self, organ: OrganId) -> Shown<'_> {
        let is_point = |detail: &Detail| detail.leaf(self.plant, organ) == Some(Primitive::Simple);
        if self.stems.detail.as_ref().is_some_and(is_point) { Shown::Point } else { Shown::Whole(self.own_form(organ)) }
    }

    /// The form of an organ, whatever its range.
    #[inline]
    fn own_form(&self, organ: OrganId) -> OrganForm<'_> {
        if let Some((place, scale)) = self.plant.stated_organs.surface(organ)
            && let Some(surface) = self.paints.surface(place)
        {
            return OrganForm::Surface(surface, scale);
        }
        match self.outlines.faces(organ) {
            Some(faces) => OrganForm::Outline(self.plant.outline_of(organ), faces),
            None => OrganForm::Shape(self.shape_of(organ)),
        }
    }

    /// The shape of the form of an organ: a coarser one where the tolerance allows it. It is that of its full size, so
    /// that it stays the same while the organ grows.
    #[inline]
    fn shape_of(&self, organ: OrganId) -> &FormMesh {
        let (organs, place) = (&self.plant.organs, organ.index());
        let shape = self.near(organ).map_or_else(|| self.options.shape(organs.form[place]), |(_, near)| near);
        match self.options.tolerance.filter(|tolerance| tolerance.organs) {
            Some(tolerance) => shape.within(tolerance.distance, [organs.length[place], organs.width[place]]),
            None => shape,
        }
    }

    #[inline]
    pub(super) fn write_organ(&self, form: Shown<'_>, organ: OrganId, out: &mut [Vertex]) {
        let tags = self.organ_tags(organ);
        match form {
            Shown::Whole(OrganForm::Shape(shape)) => {
                self.options.write(shape, &self.placement(organ, shape), &tags, out)
            }
            Shown::Whole(OrganForm::Outline(corners, faces)) => {
                let (frame, share) = (organ_base(self.plant, organ, self.age), self.share(organ));
                outline::write((corners, faces), &frame, share, &tags[0], out);
            }
            Shown::Whole(OrganForm::Surface(surface, scale)) => {
                let (frame, share) = (organ_base(self.plant, organ, self.age), self.share(organ));
                outline::write_surface(surface, scale.map(|x| share * x), &frame, &tags[0], out);
            }
            Shown::Point => {
                outline::write_point(self.size_of_point(organ), &organ_base(self.plant, organ, self.age), &tags[0], out)
            }
        }
        if let Some(crown) = self.crown.as_ref().filter(|_| is_leaf(self.plant, organ)) {
            crown.dress(out);
        }
    }

    /// The share of its full size that an organ has at its age; more, where it stands for others too.
    #[inline]
    fn share(&self, organ: OrganId) -> f32 {
        let share = self.plant.expanded(organ, self.age);
        self.options.thinned.map_or(share, |thinned| share * thinned.factor(self.plant, organ))
    }

    /// The placement of an organ, with its size at its age, and with the fullness that gives it the area in the tables.
    pub(super) fn placement(&self, organ: OrganId, shape: &FormMesh) -> Placement {
        self.placement_at(organ_base(self.plant, organ, self.age), organ, shape)
    }

    /// The same of an organ whose base is known.
    pub(super) fn placement_at(&self, frame: Frame, organ: OrganId, shape: &FormMesh) -> Placement {
        let organs = &self.plant.organs;
        let share = self.share(organ);
        let full = [organs.length[organ.index()], organs.width[organ.index()]];
        let fullness = self.fullness(organ, shape);
        let size = full.map(|size| size * share);
        Placement { base: frame.base, heading: frame.heading, up: frame.up, size, fullness }
    }

    /// The fullness of an organ in a form. An organ expands in proportion, so its fullness is that of its full size.
    #[inline]
    pub(super) fn fullness(&self, organ: OrganId, shape: &FormMesh) -> f32 {
        let (organs, place) = (&self.plant.organs, organ.index());
        shape.fullness([organs.length[place], organs.width[place]], organs.area[place])
    }

    /// The length and the area of the triangle that stands for an organ; one without an area fills half of its box.
    fn size_of_point(&self, organ: OrganId) -> [f32; 2] {
        let (organs, place) = (&self.plant.organs, organ.index());
        let share = self.share(organ);
        let [length, width] = [organs.length[place], organs.width[place]].map(|size| size * share);
        let area = organs.area[place] * share * share;
        [length, if area > 0.0 { area } else { 0.5 * length * width }]
    }

    /// The tags of an organ and of its stalk.
    fn organ_tags(&self, organ: OrganId) -> [Tag; 2] {
        let organs = &self.plant.organs;
        let place = organ.index();
        self.organ_colours(organ).map(|colour| Tag {
            colour,
            birth: organs.birth[place] as f32,
            death: f32::INFINITY,
            component: organs.component[place] as i32,
            kind: organs.kind[place] as u8,
        })
    }
}

#[inline]
fn put_faces(first: u32, faces: &[[u32; 3]], chunk: &mut Chunk, sink: &mut Sink) -> io::Result<()> {
    let out = chunk.room(faces.len(), sink)?;
    for (face, out) in faces.iter().zip(out) {
        *out = Face::new(face.map(|corner| first + corner));
    }
    Ok(())
}
