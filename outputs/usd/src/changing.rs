//! A mesh that changes: its topology span by span, its points state by state, and its primvars.
//!
//! Primvars name the component of each vertex, its birth and its death as whole numbers, so that readers which know no
//! more than the mesh can show an age or join a table: `birth_age <= a and a < death_age` holds of what stands at a,
//! since what lives has the largest number of 32 bits for its death.

use super::course::{Course, State};
use super::layer::{Attribute, Data, Layer, Value, Values};
use super::paint::{self, Palette};
use std::io;

/// The age of death of what lives.
pub const LIVES: i32 = i32::MAX;

/// The vertices of a topology, by what they belong to.
#[derive(Debug, Default)]
pub struct Tags {
    /// Component numbers.
    pub components: Vec<i32>,
    /// Ages of birth.
    pub births: Vec<i32>,
    /// Ages of death.
    pub deaths: Vec<i32>,
}

/// The faces of a topology.
#[derive(Debug, Default)]
pub struct Faces {
    /// The number of corners of each.
    pub counts: Vec<i32>,
    /// The corners, by their vertices.
    pub corners: Vec<i32>,
}

impl Faces {
    /// Adds a face.
    pub fn add<const N: usize>(&mut self, corners: [usize; N]) {
        self.add_all(corners.into_iter());
    }

    /// Adds a face of any number of corners.
    pub fn add_all(&mut self, corners: impl ExactSizeIterator<Item = usize>) {
        self.counts.push(corners.len() as i32);
        self.corners.extend(corners.map(|corner| corner as i32));
    }
}

impl Tags {
    /// Adds vertices of a component.
    pub fn add(&mut self, vertices: usize, component: u32, birth: f32, death: f32) {
        let end = |list: &mut Vec<i32>, value: i32| list.resize(list.len() + vertices, value);
        end(&mut self.components, component as i32);
        end(&mut self.births, birth as i32);
        end(&mut self.deaths, if death.is_finite() { death.ceil() as i32 } else { LIVES });
    }
}

/// A mesh that changes along a course.
pub trait Changing {
    /// The faces of a span.
    fn faces(&self, span: usize, faces: &mut Faces);
    /// What the vertices of a span belong to.
    fn tags(&self, span: usize, tags: &mut Tags);
    /// The points of a state.
    fn points(&self, state: State, points: &mut Vec<[f32; 3]>);
    /// The colours of the vertices of a state.
    fn colours(&self, state: State, paint: &mut dyn FnMut(usize, [u8; 3]));
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
    values: &mut Values,
) -> io::Result<()> {
    match times {
        Some(times) => layer.attribute(attribute, Value::Timed(times, values)),
        None => values(0, &mut |data| layer.attribute(attribute, Value::Always(data))),
    }
}

fn write_faces(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    let times = course.of_spans().map(Vec::as_slice);
    let faces = |span: usize| {
        let mut faces = Faces::default();
        mesh.faces(span, &mut faces);
        if i32::try_from(faces.corners.len()).is_err() {
            return Err(io::Error::other("more than 2147483647 corners of faces: choose a larger tolerance"));
        }
        Ok(faces)
    };
    let counts = Attribute::new("faceVertexCounts", "int[]");
    put(layer, counts, times, &mut |span, take| take(Data::Ints(&faces(span)?.counts)))?;
    let corners = Attribute::new("faceVertexIndices", "int[]");
    put(layer, corners, times, &mut |span, take| take(Data::Ints(&faces(span)?.corners)))
}

fn write_points(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    let times = course.of_states().map(Vec::as_slice);
    let (mut points, mut extents) = (Vec::new(), vec![[[0.0; 3]; 2]; course.states.len()]);
    put(layer, Attribute::new("points", "point3f[]"), times, &mut |state, take| {
        points.clear();
        mesh.points(course.states[state], &mut points);
        extents[state] = extent(points.iter().copied());
        take(Data::Triples(&points))
    })?;
    put(layer, Attribute::new("extent", "float3[]"), times, &mut |state, take| take(Data::Triples(&extents[state])))
}

/// The least and the largest coordinates of some points.
pub fn extent(points: impl Iterator<Item = [f32; 3]>) -> [[f32; 3]; 2] {
    let nothing = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    let [low, high] = points.fold(nothing, |[low, high], point| {
        [std::array::from_fn(|k| point[k].min(low[k])), std::array::from_fn(|k| point[k].max(high[k]))]
    });
    if low[0] > high[0] { [[0.0; 3]; 2] } else { [low, high] }
}

fn write_tags(layer: &mut dyn Layer, mesh: &dyn Changing, course: &Course) -> io::Result<()> {
    let times = course.of_spans().map(Vec::as_slice);
    for (place, name) in ["primvars:component_id", "primvars:birth_age", "primvars:death_age"].into_iter().enumerate() {
        put(layer, Attribute::over(name, "int[]", "vertex"), times, &mut |span, take| {
            let mut tags = Tags::default();
            mesh.tags(span, &mut tags);
            take(Data::Ints([&tags.components, &tags.births, &tags.deaths][place]))
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
    let mut places = Vec::new();
    put(layer, Attribute::new("primvars:displayColor:indices", "int[]"), times, &mut |state, take| {
        places.clear();
        mesh.colours(course.states[state], &mut |vertices, colour| {
            places.resize(places.len() + vertices, palette.place(colour));
        });
        take(Data::Ints(&places))
    })
}
