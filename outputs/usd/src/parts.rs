//! Organs, and internodes that are drawn by themselves: as instances of their models, or merged into one mesh.
//!
//! Instances have a place, a rotation in half precision, three factors of size, a model, and their component number as
//! their id. What is to come has no size yet. Internodes narrow from base to tip, which no instance does, so they are
//! always merged.

use super::changing::{Changing, Faces, Tags, extent, put};
use super::course::{Course, State};
use super::covers::Slotted;
use super::layer::{Attribute, Layer, List};
use super::models::{self, rgb};
use super::skeleton::Skeleton;
use glam::{Quat, Vec3};
use half::f16;
use phytomer_life::{Member, Models, Part, Pose, What, between};
use phytomer_meshes::{Columns, UNTIL};
use std::io;

/// Rounding of places, as a share of their distance from the origin: far more than single precision makes.
const ROUNDING: f32 = 1e-5;

/// The parts of some lives.
pub struct Parts<'a> {
    /// The lives along their course.
    pub skeletons: &'a [Skeleton<'a>],
    /// What stands where.
    pub members: &'a [Member],
    /// The models that were met.
    pub models: &'a Models<'a>,
    /// Whether these are internodes; else organs.
    pub internodes: bool,
    /// What is told of each component of a single plant beside the properties of every file.
    pub columns: Option<&'a Columns<'a>>,
    /// The slot of materials whose organs or internodes these are; `None`: those of all slots.
    pub slot: Option<Slotted<'a>>,
}

/// A part at a state.
struct Standing<'a> {
    skeleton: &'a Skeleton<'a>,
    member: &'a Member,
    /// Its place in the life.
    place: usize,
    part: &'a Part,
    age: f32,
    /// What is to come has no size.
    is_there: bool,
}

impl Standing<'_> {
    /// Where its base is.
    fn base(&self) -> [f32; 3] {
        self.placed(self.skeleton.life.base_at(self.part, self.age))
    }

    /// Its pose.
    fn pose(&self) -> Pose {
        let pose = self.skeleton.life.pose_at(self.part, self.age);
        Pose { base: self.placed(pose.base), ..pose }
    }

    /// A base where the plant stands, or where what is to come waits.
    fn placed(&self, base: [f32; 3]) -> [f32; 3] {
        let base = if self.is_there { base } else { self.skeleton.waits(self.place) };
        std::array::from_fn(|k| base[k] + self.member.offset[k])
    }

    fn tint(&self) -> [f32; 3] {
        between(self.skeleton.life.tints_of_part(self.part), self.age)
    }
}

impl<'a> Parts<'a> {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        let lives = self.skeletons.iter().enumerate();
        !lives
            .map(|(life, skeleton)| (life, &skeleton.life.parts))
            .any(|(life, parts)| parts.iter().any(|part| self.has(life, part)))
    }

    fn has(&self, life: usize, part: &Part) -> bool {
        matches!(part.what, What::Internode) == self.internodes
            && self.slot.as_ref().is_none_or(|slot| slot.has_part(life, part))
    }

    /// The parts of a span, plant by plant, each with its place in the life.
    fn of_span(&self, span: usize) -> impl Iterator<Item = (&'a Member, usize, &'a Part)> {
        let members = self.members.iter().filter_map(|member| Some((member, self.skeletons.get(member.life)?)));
        members.flat_map(move |(member, skeleton)| {
            let parts = skeleton.parts_of(span).filter(move |(_, part)| self.has(member.life, part));
            parts.map(move |(place, part)| (member, place, part))
        })
    }

    fn at_state(&self, state: State) -> impl Iterator<Item = Standing<'a>> {
        self.of_span(state.span).map(move |(member, place, part)| {
            let skeleton = &self.skeletons[member.life];
            let age = skeleton.life.ages[state.age];
            Standing { skeleton, member, place, part, age, is_there: part.from <= age }
        })
    }

    /// Writes the parts as instances.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_instances(&self, layer: &mut dyn Layer, root: &str, course: &Course) -> io::Result<()> {
        layer.begin("PointInstancer", "organs", &[])?;
        let names = self.models.names();
        let models = names.iter().map(|name| format!("/{root}/organs/models/{name}"));
        layer.relationship("prototypes", &models.collect::<Vec<_>>())?;
        self.write_places(layer, course)?;
        let held = course.of_held().map(Vec::as_slice);
        put(layer, Attribute::new("protoIndices", "int[]"), held, &|state| {
            let of = |part: Standing| self.models.place(part.member.life, part.part, part.tint()) as i32;
            Ok(List::Ints(self.at_state(course.states[state]).map(of).collect()))
        })?;
        let spans = course.of_spans().map(Vec::as_slice);
        put(layer, Attribute::new("ids", "int64[]"), spans, &|span| {
            let ids = self.of_span(span).map(|(member, _, part)| member.id_of(part.component));
            Ok(List::Longs(ids.collect()))
        })?;
        if let Some(columns) = self.columns.filter(|columns| columns.names().contains(&UNTIL)) {
            put(layer, Attribute::over(&format!("primvars:{UNTIL}"), "float[]", "vertex"), spans, &|span| {
                let until = self.of_span(span).map(|(_, _, part)| columns.until_of(part.component));
                Ok(List::Floats(until.collect()))
            })?;
        }
        layer.begin("Scope", "models", &[])?;
        models::write(self.models, layer, root)?;
        layer.end()?;
        layer.end()
    }

    fn write_places(&self, layer: &mut dyn Layer, course: &Course) -> io::Result<()> {
        let times = course.of_states().map(Vec::as_slice);
        let of = |state: usize| self.at_state(course.states[state]);
        put(layer, Attribute::new("positions", "point3f[]"), times, &|state| {
            Ok(List::Triples(of(state).map(|part| part.base()).collect()))
        })?;
        put(layer, Attribute::new("orientations", "quath[]"), times, &|state| {
            let turn = |part: Standing| {
                let pose = part.skeleton.life.pose_at(part.part, part.age);
                Quat::from_mat3(&pose.turn()).normalize().to_array().map(|part| f16::from_f32(part).to_bits())
            };
            Ok(List::Turns(of(state).map(turn).collect()))
        })?;
        put(layer, Attribute::new("scales", "float3[]"), times, &|state| {
            Ok(List::Triples(of(state).map(|part| self.scale(&part)).collect()))
        })?;
        put(layer, Attribute::new("extent", "float3[]"), times, &|state| {
            Ok(List::Triples(self.extent_of(of(state)).to_vec()))
        })
    }

    fn scale(&self, part: &Standing) -> [f32; 3] {
        let model = self.models.form(part.member.life, part.part).filter(|_| part.is_there);
        model.map_or([0.0; 3], |model| model.scale(part.skeleton.life.size_at(part.part, part.age), part.part.fullness))
    }

    /// The least and the largest coordinates of some parts. The vertices of a part are made only where the ball that
    /// holds it reaches beyond what was found.
    fn extent_of(&self, parts: impl Iterator<Item = Standing<'a>>) -> [[f32; 3]; 2] {
        let [mut low, mut high] = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        for part in parts {
            let base = Vec3::from_array(part.base());
            let size = Vec3::from_array(part.skeleton.life.size_at(part.part, part.age));
            let reach = self.models.reach(part.member.life, part.part) * size.abs().max_element();
            let reach = reach * part.part.fullness.max(1.0) + ROUNDING * (base.abs().max_element() + reach);
            if (base - reach).cmplt(low).any() || (base + reach).cmpgt(high).any() {
                self.each_point(&part, &mut |point| {
                    let point = Vec3::from_array(point);
                    (low, high) = (low.min(point), high.max(point));
                });
            }
        }
        extent([low, high].map(|corner| corner.to_array()).into_iter().filter(|_| low.x <= high.x))
    }

    /// The vertices of a part where they stand.
    fn each_point(&self, part: &Standing, see: &mut dyn FnMut([f32; 3])) {
        let Some(model) = self.models.form(part.member.life, part.part) else { return };
        let pose = part.pose();
        let (turn, base) = (pose.turn(), Vec3::from_array(pose.base));
        for vertex in &model.mesh.vertices {
            let at = model.at(vertex.position(), pose.size, part.part.fullness);
            let at = if part.is_there { base + turn * Vec3::from_array(at) } else { base };
            see(at.to_array());
        }
    }
}

impl Changing for Parts<'_> {
    fn faces(&self, span: usize, faces: &mut Faces) {
        let mut first = 0;
        for (member, _, part) in self.of_span(span) {
            let Some(model) = self.models.form(member.life, part) else { continue };
            for face in &model.mesh.faces {
                faces.add(face.indices().map(|corner| first + corner as usize));
            }
            first += model.mesh.vertices.len();
        }
    }

    fn textures(&self, span: usize) -> Option<Vec<[f32; 2]>> {
        self.slot.as_ref().filter(|slot| slot.has_texture())?;
        let mut all = Vec::new();
        for (member, _, part) in self.of_span(span) {
            let Some(model) = self.models.form(member.life, part) else { continue };
            let corners = model.mesh.faces.iter().flat_map(|face| face.indices());
            all.extend(corners.map(|corner| model.mesh.vertices[corner as usize].texture()));
        }
        Some(all)
    }

    fn tags(&self, span: usize, tags: &mut Tags) {
        for (member, _, part) in self.of_span(span) {
            let vertices = self.models.form(member.life, part).map_or(0, |model| model.mesh.vertices.len());
            let death = part.death - self.skeletons[member.life].life.sown;
            tags.add(vertices, part.component, part.birth, death);
        }
    }

    fn points(&self, state: State, points: &mut Vec<[f32; 3]>) {
        self.at_state(state).for_each(|part| self.each_point(&part, &mut |point| points.push(point)));
    }

    fn colours(&self, state: State, paint: &mut dyn FnMut(usize, [u8; 3])) {
        for part in self.at_state(state) {
            let place = self.models.place(part.member.life, part.part, part.tint());
            let model = self.models.made().get(place).map_or(&[][..], |(_, model)| &model.mesh.vertices);
            for vertex in model {
                paint(1, rgb(vertex));
            }
        }
    }
}
