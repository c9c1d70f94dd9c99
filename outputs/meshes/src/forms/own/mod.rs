//! Mesh files as forms of organs: read from PLY, OBJ or GLB, checked, moved and scaled into the unit box of the
//! library.
//!
//! In the file x runs along the organ from its base to its tip, y across it and z to its upper side, in any unit; the x
//! axis is the organ's own line. A GLB, whose y is up, is turned first. The smallest x becomes 0 and the largest 1, the
//! largest distance from the line ½, and z is scaled as y is. A vertex that triangles share has the mean of their
//! normals, weighted by area. Absent: materials, textures and the file's own normals; a species states colours.

mod glb;
mod obj;
mod ply;
#[cfg(test)]
mod tests;

use super::{Depth, FormMesh, Point};
use crate::texture::Textures;
use phytomer_looks::{Flare, polygon};

/// The most triangles of a mesh file, since an organ is drawn thousands of times.
pub const MOST_TRIANGLES: usize = 10_000;

/// What a species states for meshes by itself: the mesh files that it names as forms, in the order of their numbers,
/// its textures, and the flare of its trunk.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OwnForms {
    forms: Vec<OwnForm>,
    textures: Textures,
    flare: Option<Flare>,
}

/// A mesh file as a form.
#[derive(Debug, Clone, PartialEq)]
struct OwnForm {
    shape: FormMesh,
    /// Its width divided by its length, in the file.
    aspect: f64,
}

/// A fault of a mesh file: the place, the problem, and what was expected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}; expected {expected}")]
pub struct MeshFault {
    /// The line, byte or part of the file, in words.
    pub place: String,
    /// What was found there, in words.
    pub problem: String,
    /// What was expected, in words.
    pub expected: String,
}

impl MeshFault {
    fn new(place: impl Into<String>, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { place: place.into(), problem: problem.into(), expected: expected.into() }
    }
}

type Read<T> = Result<T, MeshFault>;

/// The triangles of a file, as they stand there.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Soup {
    points: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// Adds a polygon as triangles; `corners` are indices of points that were added before.
    fn polygon(&mut self, corners: &[u32], place: impl Fn() -> String) -> Read<()> {
        if corners.len() < 3 {
            let problem = format!("a face of {} corners", corners.len());
            return Err(MeshFault::new(place(), problem, "at least 3"));
        }
        if let Some(outside) = corners.iter().find(|corner| **corner as usize >= self.points.len()) {
            let problem = format!("a face of the vertex {outside}, counted from 0");
            return Err(MeshFault::new(place(), problem, format!("one of the {} vertices", self.points.len())));
        }
        if self.triangles.len() + corners.len() - 2 > MOST_TRIANGLES {
            let problem = format!("more than {MOST_TRIANGLES} triangles");
            return Err(MeshFault::new(place(), problem, "a mesh of fewer: an organ is drawn thousands of times"));
        }
        let points: Vec<[f32; 3]> = corners.iter().map(|corner| self.points[*corner as usize]).collect();
        let triangles = polygon::triangles(&points);
        self.triangles.extend(triangles.into_iter().map(|triangle| triangle.map(|place| corners[place])));
        Ok(())
    }
}

impl OwnForms {
    /// Reads the forms from pairs of a file's name and its bytes, in their order.
    ///
    /// # Errors
    /// The fault of the first file that is not such a mesh.
    pub fn read<'a>(files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> Result<Self, MeshFault> {
        let forms: Result<_, MeshFault> = files.into_iter().map(|(name, bytes)| shape_of(name, bytes)).collect();
        Ok(Self { forms: forms?, ..Self::default() })
    }

    /// The same with textures and a flare.
    pub fn with(self, textures: Textures, flare: Option<Flare>) -> Self {
        Self { textures, flare, ..self }
    }

    /// The textures.
    pub fn textures(&self) -> &Textures {
        &self.textures
    }

    /// Whether a picture covers any part.
    pub fn has_textures(&self) -> bool {
        !self.textures.list.is_empty()
    }

    /// How the foot of the trunk widens.
    pub fn flare(&self) -> Option<&Flare> {
        self.flare.as_ref()
    }

    /// The number of forms.
    pub fn len(&self) -> usize {
        self.forms.len()
    }

    /// Whether there are no forms.
    pub fn is_empty(&self) -> bool {
        self.forms.is_empty()
    }

    /// The shape of the form with the index `place`.
    pub(crate) fn shape(&self, place: u8) -> Option<&FormMesh> {
        self.forms.get(usize::from(place)).map(|form| &form.shape)
    }

    /// The area of one side of the form with the index `place`, in the proportions of its file, as a share of length ×
    /// width; `None` where there is no such form.
    pub fn area_share(&self, place: usize) -> Option<f64> {
        self.forms.get(place).map(|form| form.shape.area_share(form.aspect))
    }
}

/// Checks that a file holds a mesh that can be used as a form.
///
/// # Errors
/// The first fault of the file.
pub fn check(name: &str, bytes: &[u8]) -> Result<(), MeshFault> {
    shape_of(name, bytes).map(drop)
}

fn shape_of(name: &str, bytes: &[u8]) -> Read<OwnForm> {
    shape(&soup(name, bytes)?)
}

/// The triangles of a file; its format follows from the ending of its name.
fn soup(name: &str, bytes: &[u8]) -> Read<Soup> {
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
    match ending.as_deref() {
        Some("ply") => ply::read(bytes),
        Some("obj") => obj::read(bytes),
        Some("glb") => glb::read(bytes),
        _ => Err(MeshFault::new("its name", "a mesh of no known format", "a file that ends in .ply, .obj or .glb")),
    }
}

/// Moves and scales triangles into the unit box.
fn shape(soup: &Soup) -> Read<OwnForm> {
    let used = soup.triangles.iter().flatten().map(|corner| soup.points[*corner as usize]);
    let (mut low, mut high, mut half) = (f32::INFINITY, f32::NEG_INFINITY, 0_f32);
    for [x, y, z] in used {
        if !(x.is_finite() && y.is_finite() && z.is_finite()) {
            return Err(MeshFault::new("a vertex", "a coordinate that is no finite number", "finite numbers"));
        }
        (low, high, half) = (low.min(x), high.max(x), half.max(y.abs()));
    }
    if soup.triangles.is_empty() {
        return Err(MeshFault::new("the whole", "a mesh without triangles", "at least one"));
    }
    let long = high - low;
    if !(long.is_finite() && long >= f32::MIN_POSITIVE && half >= f32::MIN_POSITIVE && (1.0 / half).is_finite()) {
        let problem = format!("a mesh {long} long (x) and {half} to each side (y)");
        return Err(MeshFault::new("the whole", problem, "some length along x and some width along y"));
    }
    let scaled = |[x, y, z]: [f32; 3]| [(x - low) / long, y / (2.0 * half), z / (2.0 * half)];
    let points: Vec<[f32; 3]> = soup.points.iter().map(|&point| scaled(point)).collect();
    Ok(OwnForm { shape: in_box(&points, &soup.triangles)?.measured(), aspect: 2.0 * f64::from(half) / f64::from(long) })
}

/// A shape of the used vertices, without triangles of area 0.
fn in_box(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Read<FormMesh> {
    let mut normals = vec![[0.0_f32; 3]; points.len()];
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| points[corner as usize]);
        let edge = |to: [f32; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
        let across = crate::tube::cross(edge(b), edge(c));
        if !across.iter().all(|x| x.is_finite()) || across.iter().all(|&x| x == 0.0) {
            continue;
        }
        faces.push(*triangle);
        for corner in triangle {
            (0..3).for_each(|k| normals[*corner as usize][k] += across[k]);
        }
    }
    if faces.is_empty() {
        return Err(MeshFault::new("the whole", "no triangle has an area", "at least one that has"));
    }
    let mut shape = FormMesh::new(Depth::Width);
    let mut numbers = vec![u32::MAX; points.len()];
    for face in faces {
        let face = face.map(|corner| {
            let place = corner as usize;
            if numbers[place] == u32::MAX {
                numbers[place] = shape.points.len() as u32;
                shape.points.push(point(points[place], normals[place]));
            }
            numbers[place]
        });
        shape.faces.push(face);
    }
    Ok(shape)
}

fn point(at: [f32; 3], normal: [f32; 3]) -> Point {
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    // Of triangles that face each other nothing is left: such a vertex looks up.
    let normal =
        if length > f32::MIN_POSITIVE && length.is_finite() { normal.map(|x| x / length) } else { [0.0, 0.0, 1.0] };
    Point { at, across: [0.0; 3], normal, texture: super::along(at), stalk: false, tint: [0; 4] }
}
