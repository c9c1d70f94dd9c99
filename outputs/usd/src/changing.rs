//! A mesh that changes: its topology span by span, its points state by state, and its primvars.
//!
//! Primvars name the component of each vertex, its birth and its death as whole numbers, so that readers which know no
//! more than the mesh can show an age or join a table: `birth_age <= a and a < death_age` holds of what stands at a,
//! since what lives has the largest number of 32 bits for its death.

use super::course::{Course, State};
use super::layer::{Attribute, Data, Layer, List, Value, Values};
use super::paint::{self, Palette};
use std::io;
use std::sync::{Mutex, PoisonError};

/// The age of death of what lives.
pub const LIVES: i32 = i32::MAX;

/// What is told of vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tag {
    /// Component numbers.
    Component,
    /// Ages of birth.
    Birth,
    /// Ages of death.
    Death,
}

/// What is told of the vertices of a topology, vertex by vertex.
#[derive(Debug)]
pub struct Tags(Tag, Vec<i32>);

/// What is told of faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Told {
    /// The number of corners of each.
    Counts,
    /// The corners, by their vertices.
    Corners,
}

/// What is told of the faces of a topology.
#[derive(Debug)]
pub struct Faces {
    told: Told,
    list: Vec<i32>,
    corners: usize,
}

impl Faces {
    /// Adds a face.
    #[inline]
    pub fn add<const N: usize>(&mut self, corners: [usize; N]) {
        self.add_all(corners.into_iter());
    }

    /// Adds a face of any number of corners.
    #[inline]
    pub fn add_all(&mut self, corners: impl ExactSizeIterator<Item = usize>) {
        self.corners += corners.len();
        match self.told {
            Told::Counts => self.list.push(corners.len() as i32),
            Told::Corners => self.list.extend(corners.map(|corner| corner as i32)),
        }
    }
}

impl Tags {
    /// Adds vertices of a component.
    pub fn add(&mut self, vertices: usize, component: u32, birth: f32, death: f32) {
        let Self(tag, list) = self;
        let value = match tag {
            Tag::Component => component as i32,
            Tag::Birth => birth as i32,
            Tag::Death if death.is_finite() => death.ceil() as i32,
            Tag::Death => LIVES,
        };
        list.resize(list.len() + vertices, value);
    }
}

/// A mesh that changes along a course.
pub trait Changing: Sync {
    /// The faces of a span.
    fn faces(&self, span: usize, faces: &mut Faces);
    /// What the vertices of a span belong to.
    fn tags(&self, span: usize, tags: &mut Tags);
    /// The points of a state.
    fn points(&self, state: State, points: &mut Vec<[f32; 3]>);
    /// The colours of the vertices of a state.
    fn colours(&self, state: State, paint: &mut dyn FnMut(usize, [u8; 3]));
    /// The texture coordinates of the corners of the faces of a span, in their order; `None` where none are written.
    fn textures(&self, span: usize) -> Option<Vec<[f32; 2]>>;
}

/// Writes a mesh that changes, with a material.
///
/// # Errors
/// Those of the file.
pub fn write(
    layer: &mut dyn Layer,
    (root, name, material): (&str, &str, &str),
    mesh: &dyn Changing,
    course: &Course,
) -> io::Result<()> {
    begin_mesh(layer, name)?;
    write_faces(layer, mesh, course)?;
    write_points(layer, mesh, course)?;
    write_textures(layer, mesh, course)?;
    write_tags(layer, mesh, course)?;
    write_colours(layer, mesh, course)?;
    layer.relationship("material:binding", &[paint::path_of(root, material)])?;
    layer.end()
}

/// Begins a mesh that is drawn as it is, from both sides.
///
/// # Errors
/// Those of the file.
pub fn begin_mesh(layer: &mut dyn Layer, name: &str) -> io::Result<()> {
    layer.begin("Mesh", name, &["MaterialBindingAPI"])?;
    layer.attribute(Attribute::uniform("subdivisionScheme", "token"), Value::Always(Data::Token("none")))?;
    layer.attribute(Attribute::uniform("doubleSided", "bool"), Value::Always(Data::Flag(true)))
}

/// Writes the value of an attribute at its times, or the one of a still.
///
/// # Errors
/// Those of the file.
pub fn put(
    layer: &mut dyn Layer,
    attribute: Attribute,
    times: Option<&[(f64, usize)]>,
    values: &Values,
) -> io::Result<()> {
    match times {
        Some(times) => layer.attribute(attribute, Value::Timed(times, values)),
        None => layer.attribute(attribute, Value::Always(values(0)?.data())),
    }
}

fn write_faces(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    let times = course.of_spans().map(Vec::as_slice);
    let faces = |span: usize, told: Told| {
        let mut faces = Faces { told, list: Vec::new(), corners: 0 };
        mesh.faces(span, &mut faces);
        if i32::try_from(faces.corners).is_err() {
            return Err(io::Error::other("more than 2147483647 corners of faces: choose a larger tolerance"));
        }
        Ok(List::Ints(faces.list))
    };
    let counts = Attribute::new("faceVertexCounts", "int[]");
    put(layer, counts, times, &|span| faces(span, Told::Counts))?;
    let corners = Attribute::new("faceVertexIndices", "int[]");
    put(layer, corners, times, &|span| faces(span, Told::Corners))
}

fn write_points(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    let times = course.of_states().map(Vec::as_slice);
    let extents = Mutex::new(vec![[[0.0; 3]; 2]; course.states.len()]);
    put(layer, Attribute::new("points", "point3f[]"), times, &|state| {
        let mut points = Vec::new();
        mesh.points(course.states[state], &mut points);
        let found = extent(points.iter().copied());
        extents.lock().unwrap_or_else(PoisonError::into_inner)[state] = found;
        Ok(List::Triples(points))
    })?;
    let extents = extents.into_inner().unwrap_or_else(PoisonError::into_inner);
    put(layer, Attribute::new("extent", "float3[]"), times, &|state| Ok(List::Triples(extents[state].to_vec())))
}

/// The least and the largest coordinates of some points.
pub fn extent(points: impl Iterator<Item = [f32; 3]>) -> [[f32; 3]; 2] {
    let nothing = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    let [low, high] = points.fold(nothing, |[low, high], point| {
        [std::array::from_fn(|k| point[k].min(low[k])), std::array::from_fn(|k| point[k].max(high[k]))]
    });
    if low[0] > high[0] { [[0.0; 3]; 2] } else { [low, high] }
}

fn write_textures(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    if mesh.textures(0).is_none() {
        return Ok(());
    }
    let times = course.of_spans().map(Vec::as_slice);
    put(layer, Attribute::over("primvars:st", "texCoord2f[]", "faceVarying"), times, &|span| {
        Ok(List::Pairs(mesh.textures(span).unwrap_or_default()))
    })
}

fn write_tags(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    let times = course.of_spans().map(Vec::as_slice);
    for (tag, name) in [
        (Tag::Component, "primvars:component_id"),
        (Tag::Birth, "primvars:birth_age"),
        (Tag::Death, "primvars:death_age"),
    ] {
        put(layer, Attribute::over(name, "int[]", "vertex"), times, &|span| {
            let mut tags = Tags(tag, Vec::new());
            mesh.tags(span, &mut tags);
            Ok(List::Ints(tags.1))
        })?;
    }
    Ok(())
}

fn write_colours(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    let mut palette = Palette::default();
    for state in &course.states {
        mesh.colours(*state, &mut |_, colour| _ = palette.place(colour));
    }
    let colours = Attribute::over("primvars:displayColor", "color3f[]", "vertex");
    layer.attribute(colours, Value::Always(Data::Triples(palette.colours())))?;
    let times = course.of_held().map(Vec::as_slice);
    put(layer, Attribute::new("primvars:displayColor:indices", "int[]"), times, &|state| {
        let (mut places, mut palette) = (Vec::new(), palette.clone());
        mesh.colours(course.states[state], &mut |vertices, colour| {
            places.resize(places.len() + vertices, palette.place(colour));
        });
        Ok(List::Ints(places))
    })
}
