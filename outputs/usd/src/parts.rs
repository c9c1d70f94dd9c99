//! Organs, and internodes that are drawn by themselves: as instances of their models, or merged into one mesh.
//!
//! Instances have a place, a rotation in half precision, three factors of size, a model, and their component number as
//! their id. What is to come has no size yet. Internodes narrow from base to tip, which no instance does, so they are
//! always merged.

use super::changing::{Changing, Faces, Tags, extent, put};
use super::course::{Course, State};
use super::layer::{Attribute, Data, Layer};
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
}

/// A part at a state.
struct Standing<'a> {
    life: usize,
    part: &'a Part,
    pose: Pose,
    tint: [f32; 3],
    /// What is to come has no size.
    is_there: bool,
}

impl<'a> Parts<'a> {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        !self.skeletons.iter().any(|skeleton| skeleton.life.parts.iter().any(|part| self.has(part)))
    }

    fn has(&self, part: &Part) -> bool {
        matches!(part.what, What::Internode) == self.internodes
    }

    /// The parts of a span, plant by plant, each with its place in the life.
    fn of_span(&self, span: usize) -> impl Iterator<Item = (&'a Member, usize, &'a Part)> {
        let members = self.members.iter().filter_map(|member| Some((member, self.skeletons.get(member.life)?)));
        members.flat_map(move |(member, skeleton)| {
            let parts = skeleton.parts_of(span).filter(move |(_, part)| self.has(part));
            parts.map(move |(place, part)| (member, place, part))
        })
    }

    fn at_state(&self, state: State) -> impl Iterator<Item = Standing<'a>> {
        self.of_span(state.span).map(move |(member, place, part)| {
            let skeleton = &self.skeletons[member.life];
            let age = skeleton.life.ages[state.age];
            let is_there = part.from <= age;
            let mut pose = skeleton.life.pose_at(part, age);
            if !is_there {
                pose.base = skeleton.waits(place);
            }
            pose.base = std::array::from_fn(|k| pose.base[k] + member.offset[k]);
            let tint = between(skeleton.life.tints_of_part(part), age);
            Standing { life: member.life, part, pose, tint, is_there }
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
        put(layer, Attribute::new("protoIndices", "int[]"), held, &mut |state, take| {
            let of = |part: Standing| self.models.place(part.life, part.part, part.tint) as i32;
            take(Data::Ints(&self.at_state(course.states[state]).map(of).collect::<Vec<_>>()))
        })?;
        let spans = course.of_spans().map(Vec::as_slice);
        put(layer, Attribute::new("ids", "int64[]"), spans, &mut |span, take| {
            let ids = self.of_span(span).map(|(member, _, part)| member.id_of(part.component));
            take(Data::Longs(&ids.collect::<Vec<_>>()))
        })?;
        if let Some(columns) = self.columns.filter(|columns| columns.names().contains(&UNTIL)) {
            put(
                layer,
                Attribute::over(&format!("primvars:{UNTIL}"), "float[]", "vertex"),
                spans,
                &mut |span, take| {
                    let until = self.of_span(span).map(|(_, _, part)| columns.until_of(part.component));
                    take(Data::Floats(&until.collect::<Vec<_>>()))
                },
            )?;
        }
        layer.begin("Scope", "models", &[])?;
        models::write(self.models, layer, root)?;
        layer.end()?;
        layer.end()
    }

    fn write_places(&self, layer: &mut dyn Layer, course: &Course) -> io::Result<()> {
        let times = course.of_states().map(Vec::as_slice);
        let of = |state: usize| self.at_state(course.states[state]);
        put(layer, Attribute::new("positions", "point3f[]"), times, &mut |state, take| {
            take(Data::Triples(&of(state).map(|part| part.pose.base).collect::<Vec<_>>()))
        })?;
        put(layer, Attribute::new("orientations", "quath[]"), times, &mut |state, take| {
            let turn = |part: Standing| {
                Quat::from_mat3(&part.pose.turn()).normalize().to_array().map(|part| f16::from_f32(part).to_bits())
            };
            take(Data::Turns(&of(state).map(turn).collect::<Vec<_>>()))
        })?;
        put(layer, Attribute::new("scales", "float3[]"), times, &mut |state, take| {
            take(Data::Triples(&of(state).map(|part| self.scale(&part)).collect::<Vec<_>>()))
        })?;
        put(layer, Attribute::new("extent", "float3[]"), times, &mut |state, take| {
            take(Data::Triples(&self.extent_of(of(state))))
        })
    }

    fn scale(&self, part: &Standing) -> [f32; 3] {
        let model = self.models.form(part.life, part.part).filter(|_| part.is_there);
        model.map_or([0.0; 3], |model| model.scale(part.pose.size, part.part.fullness))
    }

    /// The least and the largest coordinates of some parts. The vertices of a part are made only where the ball that
    /// holds it reaches beyond what was found.
    fn extent_of(&self, parts: impl Iterator<Item = Standing<'a>>) -> [[f32; 3]; 2] {
        let [mut low, mut high] = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        for part in parts {
            let base = Vec3::from_array(part.pose.base);
            let reach = self.models.reach(part.life, part.part) * Vec3::from_array(part.pose.size).abs().max_element();
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
        let Some(model) = self.models.form(part.life, part.part) else { return };
        let (turn, base) = (part.pose.turn(), Vec3::from_array(part.pose.base));
        for vertex in &model.mesh.vertices {
            let at = model.at(vertex.position(), part.pose.size, part.part.fullness);
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
            let place = self.models.place(part.life, part.part, part.tint);
            let model = self.models.made().get(place).map_or(&[][..], |(_, model)| &model.mesh.vertices);
            for vertex in model {
                paint(1, rgb(vertex));
            }
        }
    }
}
