//! What stands before the plant in an OPF file: reference meshes, materials, shapes, and the classes of attributes.
//!
//! A shape names its mesh and its material by their `Id`, in whatever order they stand. Points are centimetres. Faces
//! stand in elements of their own, with three corners or more, or all together in threes. Absent: the plant.

use super::super::description::{FeatureType, Material, Mesh, Shape};
use super::super::numbers::{is_lacking, number, words};
use super::super::report::Report;
use super::super::text::said;
use super::super::xml::{Element, Piece, Xml};
use super::faces::Faces;
use super::passed::left_out;
use std::collections::BTreeMap;

/// Centimetres in a metre.
pub(super) const CM: f64 = 100.0;

/// What a value of an attribute is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Declared {
    /// Characters.
    Text,
    /// A whole number.
    Int,
    /// A number, and how many of its unit are a metre where the class says that.
    Real(Option<f64>),
    /// True or false.
    Truth,
}

impl Declared {
    /// The type of the feature.
    pub fn kind(self) -> FeatureType {
        match self {
            Self::Text => FeatureType::Text,
            Self::Int => FeatureType::Int,
            Self::Real(_) => FeatureType::Real,
            Self::Truth => FeatureType::Truth,
        }
    }
}

/// All of it.
#[derive(Debug, Default)]
pub(super) struct Parts {
    /// The reference meshes.
    pub meshes: Vec<Mesh>,
    /// Of each mesh whether it is tapered.
    pub tapered: Vec<bool>,
    /// The materials.
    pub materials: Vec<Material>,
    /// The attributes, in the order of the file.
    pub attributes: Vec<(String, Declared)>,
    attribute_of: BTreeMap<String, usize>,
    shapes: Vec<Named>,
    mesh_of: BTreeMap<i64, u32>,
    material_of: BTreeMap<i64, u32>,
    shape_of: BTreeMap<i64, u32>,
}

/// A shape before its mesh is looked up.
#[derive(Debug)]
struct Named {
    name: String,
    mesh: Option<i64>,
    material: Option<i64>,
    place: (usize, usize),
}

impl Parts {
    /// Reads one of the four parts, by the element that was opened last; false where it is none of them.
    pub fn take(&mut self, name: &str, xml: &mut Xml<'_>, report: &mut Report) -> bool {
        match name {
            "meshBDD" => self.each(xml, report, "mesh", Self::mesh),
            "materialBDD" => self.each(xml, report, "material", Self::material),
            "shapeBDD" => self.each(xml, report, "shape", Self::shape),
            "attributeBDD" => self.each(xml, report, "attribute", Self::attribute),
            _ => return false,
        }
        true
    }

    /// What an attribute is declared as.
    pub fn declared(&self, name: &str) -> Option<Declared> {
        self.attribute_of.get(name).map(|place| self.attributes[*place].1)
    }

    /// The place of the shape with an `Id`.
    pub fn shape_with(&self, id: i64) -> Option<u32> {
        self.shape_of.get(&id).copied()
    }

    /// The shapes with their meshes and materials; what a shape names must be there.
    pub fn shapes(&self, report: &mut Report) -> Vec<Shape> {
        let made = self.shapes.iter().map(|shape| {
            let mesh = shape.mesh.and_then(|id| self.mesh_of.get(&id));
            if mesh.is_none() {
                let id = shape.mesh.map_or("none".to_owned(), |id| id.to_string());
                let problem = format!("the mesh of a shape has the `meshIndex` {id}, which no mesh has as its `Id`");
                report.fault(shape.place, problem, "the `Id` of a `<mesh>`");
            }
            let material = shape.material.and_then(|id| self.material_of.get(&id)).copied();
            if let (Some(id), None) = (shape.material, material) {
                report.warn(shape.place, "no material", format!("no material has the `Id` {id}: the shape has none"));
            }
            Shape { name: shape.name.clone(), mesh: mesh.copied().unwrap_or_default(), material }
        });
        made.collect()
    }

    fn each(
        &mut self,
        xml: &mut Xml<'_>,
        report: &mut Report,
        name: &'static str,
        read: fn(&mut Self, &Element<'_>, &mut Xml<'_>, &mut Report),
    ) {
        loop {
            match xml.next(report) {
                Piece::Open(element) if element.name == name => read(self, &element, xml, report),
                Piece::Open(element) => left_out(&element, xml, report),
                Piece::Text(..) => {}
                Piece::Close | Piece::End => return,
            }
        }
    }

    fn mesh(&mut self, element: &Element<'_>, xml: &mut Xml<'_>, report: &mut Report) {
        let place = xml.place(element.at);
        identify(&mut self.mesh_of, element, place, self.meshes.len(), report);
        let mut mesh = Mesh { name: element.attribute("name").unwrap_or("").to_owned(), ..Mesh::default() };
        let mut faces = Faces::default();
        loop {
            match xml.next(report) {
                Piece::Open(inner) => match inner.name.as_ref() {
                    "points" => mesh.points = in_threes(xml, report, CM),
                    "normals" => mesh.normals = in_threes(xml, report, 1.0),
                    "textureCoords" => mesh.texture = in_twos(&numbers(xml, report)),
                    "faces" => faces.read(xml, report),
                    _ => left_out(&inner, xml, report),
                },
                Piece::Text(..) => {}
                Piece::Close | Piece::End => break,
            }
        }
        let points = mesh.points.len();
        mesh.triangles = faces.triangles(points, report);
        if !mesh.normals.is_empty() && mesh.normals.len() != points {
            report.warn(place, "normals", format!("{} normals for {points} points are left out", mesh.normals.len()));
            mesh.normals.clear();
        }
        if !mesh.texture.is_empty() && mesh.texture.len() != points {
            let text = format!("{} texture coordinates for {points} points are left out", mesh.texture.len());
            report.warn(place, "texture", text);
            mesh.texture.clear();
        }
        self.tapered.push(element.attribute("enableScale").is_none_or(|word| word.trim() != "false"));
        self.meshes.push(mesh);
    }

    fn material(&mut self, element: &Element<'_>, xml: &mut Xml<'_>, report: &mut Report) {
        let place = xml.place(element.at);
        identify(&mut self.material_of, element, place, self.materials.len(), report);
        let mut material = Material { name: element.attribute("name").unwrap_or("").to_owned(), ..Material::default() };
        loop {
            match xml.next(report) {
                Piece::Open(inner) => match inner.name.as_ref() {
                    "emission" => material.emission = colour(xml, report),
                    // Some programs write the French word.
                    "ambient" | "ambiant" => material.ambient = colour(xml, report),
                    "diffuse" => material.diffuse = colour(xml, report),
                    "specular" => material.specular = colour(xml, report),
                    "shininess" => material.shininess = numbers(xml, report).first().copied().unwrap_or_default(),
                    _ => left_out(&inner, xml, report),
                },
                Piece::Text(..) => {}
                Piece::Close | Piece::End => break,
            }
        }
        self.materials.push(material);
    }

    fn shape(&mut self, element: &Element<'_>, xml: &mut Xml<'_>, report: &mut Report) {
        let place = xml.place(element.at);
        identify(&mut self.shape_of, element, place, self.shapes.len(), report);
        let mut shape = Named { name: String::new(), mesh: None, material: None, place };
        loop {
            match xml.next(report) {
                Piece::Open(inner) => match inner.name.as_ref() {
                    "name" => shape.name = xml.text(report).0.trim().to_owned(),
                    "meshIndex" => shape.mesh = whole(xml, report, "meshIndex"),
                    "materialIndex" => shape.material = whole(xml, report, "materialIndex"),
                    _ => left_out(&inner, xml, report),
                },
                Piece::Text(..) => {}
                Piece::Close | Piece::End => break,
            }
        }
        self.shapes.push(shape);
    }

    fn attribute(&mut self, element: &Element<'_>, xml: &mut Xml<'_>, report: &mut Report) {
        let place = xml.place(element.at);
        xml.skip(report);
        let Some(name) = element.attribute("name") else {
            report.fault(place, "an attribute has no `name`", "`<attribute name=\"…\" class=\"…\"/>`");
            return;
        };
        let class = element.attribute("class").unwrap_or("String").trim();
        let declared = match class {
            "Integer" => Declared::Int,
            "Boolean" => Declared::Truth,
            "Double" | "Float" | "Real" => Declared::Real(None),
            "Metre" | "Metre_100" => Declared::Real(Some(1.0)),
            "Centimetre" => Declared::Real(Some(100.0)),
            "Millimetre" => Declared::Real(Some(1000.0)),
            "10E-5 Metre" => Declared::Real(Some(10_000.0)),
            "String" | "Object" | "Color" | "Image" => Declared::Text,
            other => {
                let text =
                    format!("the class `{}` of the attribute `{}` is not known: read as text", said(other), said(name));
                report.warn(place, "", text);
                Declared::Text
            }
        };
        let next = self.attributes.len();
        let place = *self.attribute_of.entry(name.to_owned()).or_insert(next);
        if place == next {
            self.attributes.push((name.to_owned(), declared));
        }
    }
}

/// Notes under which `Id` a thing stands; its place where it has none.
fn identify(
    known: &mut BTreeMap<i64, u32>,
    element: &Element<'_>,
    place: (usize, usize),
    number: usize,
    report: &mut Report,
) {
    let id = match element.attribute("Id").map(|word| (word, word.trim().parse::<i64>())) {
        None => number as i64,
        Some((_, Ok(id))) => id,
        Some((word, Err(_))) => {
            report.fault(place, format!("`Id` is `{}`", said(word)), "a whole number");
            return;
        }
    };
    if known.insert(id, number as u32).is_some() {
        report.fault(place, format!("a second `<{}>` has the `Id` {id}", element.name), "an `Id` of its own");
    }
}

/// The numbers of the element that was opened last.
pub(super) fn numbers(xml: &mut Xml<'_>, report: &mut Report) -> Vec<f64> {
    let (text, at) = xml.text(report);
    let mut found = Vec::new();
    for (word, at) in words(&text, at) {
        match number(word) {
            Some(number) => found.push(number),
            None => {
                let place = xml.place(at);
                report.fault(place, format!("`{}` is no number", said(word)), "numbers with blanks between them");
            }
        }
    }
    found
}

/// The whole number of the element that was opened last; `None` where it is empty or `NA`.
pub(super) fn whole(xml: &mut Xml<'_>, report: &mut Report, name: &str) -> Option<i64> {
    let (text, at) = xml.text(report);
    let word = text.trim();
    if is_lacking(word) {
        return None;
    }
    let found = word.parse().ok();
    if found.is_none() {
        let place = xml.place(at);
        report.fault(place, format!("`<{name}>` is `{}`", said(word)), "a whole number");
    }
    found
}

fn in_threes(xml: &mut Xml<'_>, report: &mut Report, unit: f64) -> Vec<[f64; 3]> {
    let found = numbers(xml, report);
    if !found.len().is_multiple_of(3) {
        let place = xml.here();
        report.fault(place, format!("{} numbers are no points", found.len()), "three numbers a point");
    }
    found.chunks_exact(3).map(|point| [point[0] / unit, point[1] / unit, point[2] / unit]).collect()
}

fn in_twos(found: &[f64]) -> Vec<[f64; 2]> {
    found.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// Red, green, blue and opacity; opaque where there is no fourth number.
fn colour(xml: &mut Xml<'_>, report: &mut Report) -> [f64; 4] {
    let found = numbers(xml, report);
    if !matches!(found.len(), 3 | 4) {
        let place = xml.here();
        report.fault(place, format!("a colour has {} numbers", found.len()), "red, green, blue and opacity, 0 to 1");
    }
    let part = |k: usize| found.get(k).copied();
    [part(0).unwrap_or(0.0), part(1).unwrap_or(0.0), part(2).unwrap_or(0.0), part(3).unwrap_or(1.0)]
}
