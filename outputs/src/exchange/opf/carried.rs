//! What an entity of an OPF file carries: attributes, and the place, the form and the sizes that its geometry states.
//!
//! A matrix takes the reference mesh, in centimetres, to the plant. `dDwn` and `dUp` are the widths at base and tip, by
//! which a mesh of unit width is tapered. Lengths in attributes are in the unit of their class; of a class without unit
//! they are in centimetres, as the geometry is, where the caller states no other unit. Absent: how entities stand to
//! one another (`topology`).

use super::super::contract::Units;
use super::super::description::{Feature, FeatureType, Form, Individual, Role, Shape, Value};
use super::super::numbers::{is_lacking, number};
use super::super::report::Report;
use super::super::text::said;
use super::super::vectors::{norm, unit};
use super::super::xml::{Element, Piece, Xml};
use super::parts::{CM, Declared, Parts, numbers, whole};
use super::passed::left_out;
use super::words::{Known, known};
use std::collections::BTreeMap;

/// The most features that a file may have.
const MOST_FEATURES: usize = 10_000;

/// Reads what entities carry, by the attributes that the file declares.
pub(super) struct Carried<'a> {
    parts: &'a Parts,
    units: Option<Units>,
    feature_of: BTreeMap<String, u32>,
    found: Found,
}

/// What was found beside the entities themselves.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// Features of the file.
    pub features: Vec<Feature>,
    /// Ticks of a year.
    pub ticks_per_year: Option<f64>,
    /// Entities whose shapes are to be looked up: plant, entity, `Id` of the shape and where it stands.
    shaped: Vec<(u32, u32, i64, (usize, usize))>,
}

/// What a geometry states.
#[derive(Default)]
struct Geometry {
    shape: Option<i64>,
    matrix: Option<[[f64; 4]; 3]>,
    down: Option<f64>,
    up: Option<f64>,
}

impl<'a> Carried<'a> {
    /// With the attributes of a file.
    pub fn of(parts: &'a Parts, units: Option<Units>) -> Self {
        let mut carried = Self { parts, units, feature_of: BTreeMap::new(), found: Found::default() };
        for (name, declared) in &parts.attributes {
            if known(name).is_none() {
                carried.feature(name, declared.kind());
            }
        }
        carried
    }

    /// What was found.
    pub fn found(self) -> Found {
        self.found
    }

    /// Reads the element that was opened last into the entity of a plant.
    pub fn take(
        &mut self,
        element: &Element<'_>,
        plants: &mut [Individual],
        entity: u32,
        xml: &mut Xml<'_>,
        report: &mut Report,
    ) {
        let number = plants.len() as u32 - 1;
        let Some(plant) = plants.last_mut() else { return };
        if element.name == "geometry" {
            return self.geometry(element, (number, plant), entity, xml, report);
        }
        let (text, at) = xml.text(report);
        let word = text.trim();
        if is_lacking(word) {
            return;
        }
        let wrong = match known(&element.name) {
            Some(field) => self.field(field, &element.name, word, plant, entity),
            None => self.value(element, word, plant, entity, xml, report),
        };
        if let Err(expected) = wrong {
            let place = xml.place(at);
            report.fault(place, format!("`<{}>` is `{}`", said(&element.name), said(word)), expected);
        }
    }

    /// A value that the description has a field for.
    fn field(
        &mut self,
        field: Known,
        name: &str,
        word: &str,
        plant: &mut Individual,
        entity: u32,
    ) -> Result<(), &'static str> {
        let real = || number(word).ok_or("a number, or `NA` where it is not known");
        let size =
            || real().and_then(|found| if found < 0.0 { Err("a number that is not below 0") } else { Ok(found) });
        let ticks = || word.parse().map(Some).map_err(|_| "a whole number of ticks from 0");
        let units = self.units;
        let stated = match self.parts.declared(name) {
            Some(Declared::Real(per_metre)) => per_metre,
            _ => None,
        };
        let in_m = |found: f64, of: fn(&Units) -> f64| match (stated, &units) {
            (Some(per_metre), _) => found / per_metre,
            (None, Some(units)) => found * of(units),
            (None, None) => found / CM,
        };
        let own = &mut plant.entities[entity as usize];
        match field {
            Known::Length => own.latest_mut().length = Some(in_m(size()?, |units| units.length_m)),
            Known::Width => own.latest_mut().base_diameter = Some(in_m(size()?, |units| units.diameter_m)),
            Known::TipWidth => own.latest_mut().tip_diameter = Some(in_m(size()?, |units| units.diameter_m)),
            Known::Area => {
                own.latest_mut().area = Some(in_m(in_m(size()?, |units| units.length_m), |units| units.length_m))
            }
            Known::Index => own.index = Some(real()?),
            Known::BirthAge => own.birth = ticks()?,
            Known::DeathAge => own.death = ticks()?,
            Known::Dead => own.dead = Some(truth(word)?),
            Known::PlantName => plant.name = Some(word.to_owned()),
            Known::Species => plant.species = Some(word.to_owned()),
            Known::PlantAge => plant.age = ticks()?,
            Known::TicksPerYear => self.found.ticks_per_year = Some(real()?),
        }
        Ok(())
    }

    /// A value of a feature of the file.
    fn value(
        &mut self,
        element: &Element<'_>,
        word: &str,
        plant: &mut Individual,
        entity: u32,
        xml: &mut Xml<'_>,
        report: &mut Report,
    ) -> Result<(), &'static str> {
        let declared = self.parts.declared(&element.name);
        if declared.is_none() {
            let place = xml.place(element.at);
            report.warn(place, "", format!("the attribute `{}` is not declared: read as text", said(&element.name)));
        }
        let declared = declared.unwrap_or(Declared::Text);
        let value = match declared {
            Declared::Text => Value::Text(word.into()),
            Declared::Int => Value::Int(integer(word).ok_or("a whole number, as its class says")?),
            Declared::Real(_) => Value::Real(number(word).ok_or("a number, as its class says")?),
            Declared::Truth => Value::Truth(truth(word)?),
        };
        let kind = declared.kind();
        let Some(feature) = self.feature(&element.name, kind) else {
            return Err("no attribute beyond the first 10000");
        };
        let values = &mut plant.entities[entity as usize].latest_mut().values;
        match values.binary_search_by_key(&feature, |(feature, _)| *feature) {
            Ok(known) => values[known].1 = value,
            Err(place) => values.insert(place, (feature, value)),
        }
        Ok(())
    }

    fn feature(&mut self, name: &str, kind: FeatureType) -> Option<u32> {
        if let Some(feature) = self.feature_of.get(name) {
            return Some(*feature);
        }
        let feature = self.found.features.len();
        if feature == MOST_FEATURES {
            return None;
        }
        self.found.features.push(Feature { name: name.to_owned(), kind });
        self.feature_of.insert(name.to_owned(), feature as u32);
        Some(feature as u32)
    }

    fn geometry(
        &mut self,
        element: &Element<'_>,
        (number, plant): (u32, &mut Individual),
        entity: u32,
        xml: &mut Xml<'_>,
        report: &mut Report,
    ) {
        let place = xml.place(element.at);
        let stated = Geometry::read(xml, report);
        let Some(matrix) = stated.matrix else {
            if stated.shape.is_some() {
                report.fault(
                    place,
                    "a `<geometry>` with a shape has no `<mat>`",
                    "a matrix of three rows and four columns",
                );
            }
            return;
        };
        let own = &mut plant.entities[entity as usize];
        let seen = own.latest_mut();
        let column = |k: usize| [matrix[0][k], matrix[1][k], matrix[2][k]];
        seen.place = Some(column(3));
        seen.direction = unit(column(0));
        seen.up = unit(column(2));
        if let Some(shape) = stated.shape {
            let widths = match (stated.down, stated.up) {
                (Some(down), Some(up)) => Some([down, up]),
                (Some(one), None) | (None, Some(one)) => Some([one; 2]),
                (None, None) => None,
            };
            // The shape is looked up when all of them are known.
            own.form = Some(Box::new(Form { shape: 0, matrix, taper: widths }));
            self.found.shaped.push((number, entity, shape, place));
        }
    }
}

impl Found {
    /// Looks up the shapes of the entities of all plants, and takes from them the sizes that no attribute tells.
    pub fn settle(
        &self,
        plants: &mut [Individual],
        parts: &Parts,
        shapes: &[Shape],
        role_of: impl Fn(u32) -> Role,
        report: &mut Report,
    ) {
        let spans: Vec<f64> = parts.meshes.iter().map(|mesh| span(&mesh.points)).collect();
        for (plant, entity, id, place) in &self.shaped {
            let own = &mut plants[*plant as usize].entities[*entity as usize];
            let Some(shape) = parts.shape_with(*id) else {
                report.fault(
                    *place,
                    format!("`<shapeIndex>` is {id}, which no shape has as its `Id`"),
                    "the `Id` of a `<shape>`",
                );
                continue;
            };
            let mesh = shapes[shape as usize].mesh as usize;
            let role = role_of(own.class);
            let Some(mut form) = own.form.take() else { continue };
            form.shape = shape;
            if !parts.tapered.get(mesh).copied().unwrap_or(true) {
                form.taper = None;
            }
            let seen = own.latest_mut();
            let along = [0, 1, 2].map(|k| form.matrix[k][0]);
            seen.length =
                seen.length.or_else(|| spans.get(mesh).map(|span| span * norm(along)).filter(|x| x.is_finite()));
            if let Some([down, up]) = form.taper {
                seen.base_diameter = seen.base_diameter.or(Some(down / CM));
                if matches!(role, Role::Internode | Role::GrowthUnit | Role::Axis | Role::Other) {
                    seen.tip_diameter = seen.tip_diameter.or(Some(up / CM));
                }
            }
            own.form = Some(form);
        }
    }
}

impl Geometry {
    /// The geometry that was opened last.
    fn read(xml: &mut Xml<'_>, report: &mut Report) -> Self {
        let mut found = Self::default();
        loop {
            match xml.next(report) {
                Piece::Open(element) => match element.name.as_ref() {
                    "shapeIndex" => found.shape = whole(xml, report, "shapeIndex"),
                    "mat" => found.matrix = matrix(xml, report),
                    "dUp" => found.up = width(xml, report),
                    "dDwn" => found.down = width(xml, report),
                    _ => left_out(&element, xml, report),
                },
                Piece::Text(..) => {}
                Piece::Close | Piece::End => return found,
            }
        }
    }
}

/// Three rows of four numbers, with or without the fourth row; the last column from centimetres to metres.
fn matrix(xml: &mut Xml<'_>, report: &mut Report) -> Option<[[f64; 4]; 3]> {
    let found = numbers(xml, report);
    if !matches!(found.len(), 12 | 16) {
        let place = xml.here();
        report.fault(place, format!("a matrix has {} numbers", found.len()), "three rows of four");
        return None;
    }
    Some([0, 1, 2].map(|row| [found[4 * row], found[4 * row + 1], found[4 * row + 2], found[4 * row + 3] / CM]))
}

/// A width; `None` where the element is empty or `NA`.
fn width(xml: &mut Xml<'_>, report: &mut Report) -> Option<f64> {
    let (text, at) = xml.text(report);
    let word = text.trim();
    if is_lacking(word) {
        return None;
    }
    let found = number(word).filter(|width| *width >= 0.0);
    if found.is_none() {
        let place = xml.place(at);
        report.fault(place, format!("a width is `{}`", said(word)), "a number that is not below 0");
    }
    found
}

/// A whole number, also one that is written with a point.
fn integer(word: &str) -> Option<i64> {
    let whole = |found: &f64| found.fract() == 0.0 && found.abs() < 9e15;
    word.parse().ok().or_else(|| number(word).filter(whole).map(|found| found as i64))
}

fn truth(word: &str) -> Result<bool, &'static str> {
    match word.to_ascii_lowercase().as_str() {
        "true" | "1" => Ok(true),
        "false" | "0" => Ok(false),
        _ => Err("`true` or `false`"),
    }
}

/// The length of a mesh along x, m.
fn span(points: &[[f64; 3]]) -> f64 {
    let least = points.iter().map(|point| point[0]).fold(f64::INFINITY, f64::min);
    let most = points.iter().map(|point| point[0]).fold(f64::NEG_INFINITY, f64::max);
    if points.is_empty() { 0.0 } else { most - least }
}
