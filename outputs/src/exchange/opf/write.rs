//! OPF files, written: what a description holds, in centimetres.
//!
//! Numbers are rounded to so many places that a file which is read and written again has the same bytes. `Length`,
//! `Width` and `Area` are attributes beside the geometry, since most readers ask for them there. PlantGeom.jl takes
//! an end whose width is exactly 1 for an entity that is not tapered, so such a width is written a little larger.
//! Absent: the order of elements (`order`), and the forms of entities without one (`drawn`).

use super::super::decimals::{push, push_real, push_whole};
use super::super::description::{Class, Description, Entity, FeatureType, Form, Individual, Mesh, Observation, Value};
use super::super::drawn::Drawn;
use super::super::losses::Losses;
use super::super::numbers::is_lacking;
use super::super::vectors::{cross, unit};
use super::super::xml::escaped;
use super::fields::{PLACES, SIZES, fields, names};
use super::order::{Order, Step, Way};
use super::parts::CM;
use super::used::Used;
use super::words::{KNOWN, class, role};
use std::fmt::Write as _;
use std::io::{self, Write};

/// So many bytes are gathered before they are written.
const GATHERED: usize = 1 << 16;
/// The deepest indentation.
const DEEPEST: usize = 12;

/// What all files of a description are written from.
pub(in super::super) struct Writing<'a> {
    described: &'a Description,
    drawn: Drawn,
    /// The attribute of each feature.
    names: Vec<String>,
    /// The place of each feature among all, by the names of their attributes.
    places: Vec<u32>,
    /// What the element of an entity of each class begins with, behind its word.
    classes: Vec<String>,
}

impl<'a> Writing<'a> {
    /// Of a description.
    pub fn of(described: &'a Description, losses: &mut Losses) -> Self {
        let names = names(described, losses);
        let mut by_name: Vec<usize> = (0..names.len()).collect();
        by_name.sort_unstable_by_key(|feature| &names[*feature]);
        let mut places = vec![0; names.len()];
        by_name.into_iter().zip(0..).for_each(|(feature, place)| places[feature] = place);
        let classes = described.classes.iter().map(beginning).collect();
        Self { described, drawn: Drawn::of(described), names, places, classes }
    }

    /// Writes some plants as one file.
    ///
    /// # Errors
    /// Those of the file.
    pub fn file(&self, plants: &[usize], file: &mut dyn Write, losses: &mut Losses) -> io::Result<()> {
        let order = |plant: &usize| (*plant, Order::of(&self.described.individuals[*plant], &self.described.classes));
        let orders: Vec<(usize, Order)> = plants.iter().map(order).collect();
        let used = Used::of(self.described, &self.drawn, &orders);
        Writer { of: self, used, file, losses, text: String::new(), id: 1 }.all(&orders)
    }
}

/// A file that is being written.
struct Writer<'a> {
    of: &'a Writing<'a>,
    used: Used,
    file: &'a mut dyn Write,
    losses: &'a mut Losses,
    text: String,
    /// The number of the next element.
    id: i64,
}

impl Writer<'_> {
    /// Writes these plants.
    fn all(mut self, plants: &[(usize, Order)]) -> io::Result<()> {
        self.text.push_str("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<opf version=\"2.0\" editable=\"true\">\n");
        self.meshes()?;
        self.materials();
        self.shapes();
        self.attributes();
        match plants {
            [(one, order)] => self.plant(*one, order, true, 1)?,
            many => {
                let _ = writeln!(self.text, "\t<topology class=\"Scene\" scale=\"0\" id=\"{}\">", self.id);
                self.id += 1;
                for (plant, order) in many {
                    self.plant(*plant, order, false, 2)?;
                }
                self.text.push_str("\t</topology>\n");
            }
        }
        self.text.push_str("</opf>\n");
        self.file.write_all(self.text.as_bytes())
    }

    /// Hands on what was gathered.
    fn flush(&mut self) -> io::Result<()> {
        if self.text.len() >= GATHERED {
            self.file.write_all(self.text.as_bytes())?;
            self.text.clear();
        }
        Ok(())
    }

    fn meshes(&mut self) -> io::Result<()> {
        self.text.push_str("\t<meshBDD>\n");
        let of = self.of;
        for (id, number) in self.used.meshes.all.clone().into_iter().enumerate() {
            let mesh = &of.drawn.meshes[number as usize];
            let is_tapered = of.drawn.tapered[number as usize];
            let name = escaped(&mesh.name).into_owned();
            let _ =
                writeln!(self.text, "\t\t<mesh name=\"{name}\" shape=\"\" Id=\"{id}\" enableScale=\"{is_tapered}\">");
            self.mesh(mesh);
            self.text.push_str("\t\t</mesh>\n");
            self.flush()?;
        }
        self.text.push_str("\t</meshBDD>\n");
        Ok(())
    }

    fn mesh(&mut self, mesh: &Mesh) {
        self.rows("points", mesh.points.iter().map(|point| point.map(|x| x * CM)));
        if !mesh.normals.is_empty() {
            self.rows("normals", mesh.normals.iter().copied());
        }
        if !mesh.texture.is_empty() {
            self.rows("textureCoords", mesh.texture.iter().copied());
        }
        self.text.push_str("\t\t\t<faces>\n");
        for (id, [a, b, c]) in mesh.triangles.iter().enumerate() {
            self.text.push_str("\t\t\t\t<face Id=\"");
            for (number, end) in [(id as u32, "\">"), (*a, " "), (*b, " "), (*c, "</face>\n")] {
                push_whole(&mut self.text, number);
                self.text.push_str(end);
            }
        }
        self.text.push_str("\t\t\t</faces>\n");
    }

    fn rows<const N: usize>(&mut self, name: &str, rows: impl Iterator<Item = [f64; N]>) {
        let _ = writeln!(self.text, "\t\t\t<{name}>");
        for row in rows {
            self.row(&row);
        }
        let _ = writeln!(self.text, "\t\t\t</{name}>");
    }

    fn row(&mut self, row: &[f64]) {
        for (place, number) in row.iter().enumerate() {
            if place > 0 {
                self.text.push(' ');
            }
            push(&mut self.text, *number, PLACES);
        }
        self.text.push('\n');
    }

    fn materials(&mut self) {
        self.text.push_str("\t<materialBDD>\n");
        let of = self.of;
        for (id, number) in self.used.materials.all.clone().into_iter().enumerate() {
            let material = &of.drawn.materials[number as usize];
            let _ = write!(self.text, "\t\t<material");
            if !material.name.is_empty() {
                let _ = write!(self.text, " name=\"{}\"", escaped(&material.name));
            }
            let _ = writeln!(self.text, " Id=\"{id}\">");
            let colours = [
                ("emission", material.emission),
                ("ambient", material.ambient),
                ("diffuse", material.diffuse),
                ("specular", material.specular),
            ];
            for (name, colour) in colours {
                let _ = write!(self.text, "\t\t\t<{name}>");
                self.row(&colour);
                self.text.pop();
                let _ = writeln!(self.text, "</{name}>");
            }
            self.text.push_str("\t\t\t<shininess>");
            push(&mut self.text, material.shininess, PLACES);
            self.text.push_str("</shininess>\n\t\t</material>\n");
        }
        self.text.push_str("\t</materialBDD>\n");
    }

    fn shapes(&mut self) {
        self.text.push_str("\t<shapeBDD>\n");
        let of = self.of;
        for (id, number) in self.used.shapes.all.clone().into_iter().enumerate() {
            let shape = &of.drawn.shapes[number as usize];
            let _ = writeln!(self.text, "\t\t<shape Id=\"{id}\">\n\t\t\t<name>{}</name>", escaped(&shape.name));
            let _ = writeln!(self.text, "\t\t\t<meshIndex>{}</meshIndex>", self.used.meshes.place(shape.mesh));
            if let Some(material) = shape.material.map(|material| self.used.materials.place(material)) {
                let _ = writeln!(self.text, "\t\t\t<materialIndex>{material}</materialIndex>");
            }
            self.text.push_str("\t\t</shape>\n");
        }
        self.text.push_str("\t</shapeBDD>\n");
    }

    /// Declares the attributes that some entity has.
    fn attributes(&mut self) {
        self.text.push_str("\t<attributeBDD>\n");
        for (_, name, class) in KNOWN.into_iter().filter(|(field, ..)| self.used.fields.contains(field)) {
            let _ = writeln!(self.text, "\t\t<attribute name=\"{name}\" class=\"{class}\"/>");
        }
        let named = |feature: &u32| {
            let name = self.of.names.get(*feature as usize)?;
            Some((name.as_str(), self.of.described.features.get(*feature as usize)?))
        };
        // By name, for their numbers tell what was read first.
        let mut features: Vec<_> = self.used.features.iter().filter_map(named).collect();
        features.sort_unstable_by_key(|(name, _)| *name);
        for (name, feature) in features {
            let class = match feature.kind {
                FeatureType::Int => "Integer",
                FeatureType::Real => "Double",
                FeatureType::Truth => "Boolean",
                FeatureType::Text | FeatureType::Date => "String",
            };
            let _ = writeln!(self.text, "\t\t<attribute name=\"{name}\" class=\"{class}\"/>");
        }
        self.text.push_str("\t</attributeBDD>\n");
    }

    /// Writes a plant; as the topology itself, or as a part of a scene.
    fn plant(&mut self, plant: usize, order: &Order, is_topology: bool, depth: usize) -> io::Result<()> {
        let plant = &self.of.described.individuals[plant];
        self.losses.add("links between entities", order.misplaced, "they stand in their wholes, or as branches");
        let mut depth = depth;
        order.each(|step| match step {
            Step::Begin(number) => {
                let word = match order.ways[number as usize] {
                    _ if number == 0 && is_topology => "topology",
                    Way::Decomp => "decomp",
                    Way::Follow => "follow",
                    Way::Branch => "branch",
                };
                self.entity(plant, number, word, depth);
                depth += 1;
                self.flush()
            }
            Step::End(number) => {
                depth -= 1;
                self.indent(depth);
                self.text.push_str(match order.ways[number as usize] {
                    _ if number == 0 && is_topology => "</topology>\n",
                    Way::Decomp => "</decomp>\n",
                    Way::Follow => "</follow>\n",
                    Way::Branch => "</branch>\n",
                });
                Ok(())
            }
        })
    }

    fn indent(&mut self, depth: usize) {
        self.text.extend(std::iter::repeat_n('\t', depth.min(DEEPEST)));
    }

    /// The beginning of an entity with what it carries.
    fn entity(&mut self, plant: &Individual, number: u32, word: &str, depth: usize) {
        let entity = &plant.entities[number as usize];
        self.indent(depth);
        push_all(&mut self.text, ["<", word, &self.of.classes[entity.class as usize]]);
        push_whole(&mut self.text, self.id);
        self.text.push_str("\">\n");
        self.id += 1;
        let start = self.text.len();
        let text = &mut self.text;
        fields(self.of.described, plant, number as usize, entity, |field, value| {
            let name = KNOWN[field as usize].1;
            push_all(text, ["<", name, ">"]);
            value.push(text);
            push_all(text, ["</", name, ">"]);
        });
        let seen = entity.latest();
        let mut values: Vec<_> = seen.map_or(&[][..], |seen| &seen.values).iter().collect();
        values.sort_unstable_by_key(|(feature, _)| self.of.places.get(*feature as usize));
        for (feature, value) in values {
            self.value(*feature, value);
        }
        let kind = self.of.described.class_of(entity);
        if self.text.len() > start {
            self.text.push('\n');
        }
        match self.of.drawn.form(kind.role, entity) {
            Some(form) => self.form(&form),
            None => self.placed(seen),
        }
        self.told(entity);
    }

    /// A value of a feature; nothing where it would be read as a lack.
    fn value(&mut self, feature: u32, value: &Value) {
        let Some(name) = self.of.names.get(feature as usize) else { return };
        match value {
            Value::Real(number) if !number.is_finite() => return,
            Value::Text(text) if is_lacking(text.trim()) => return,
            _ => push_all(&mut self.text, ["<", name, ">"]),
        }
        let text = &mut self.text;
        match value {
            Value::Int(number) => push_whole(text, *number),
            Value::Real(number) => push_real(text, *number),
            Value::Text(word) => text.push_str(&escaped(word.trim())),
            Value::Truth(truth) => text.push_str(if *truth { "true" } else { "false" }),
            Value::Date(date) => _ = write!(text, "{date}"),
        }
        push_all(text, ["</", name, ">"]);
    }

    /// The geometry of an entity that is drawn.
    fn form(&mut self, form: &Form) {
        let shape = self.used.shapes.place(form.shape);
        self.text.push_str("<geometry class=\"Mesh\"><shapeIndex>");
        push_whole(&mut self.text, shape);
        self.text.push_str("</shapeIndex><mat>\n");
        for [x, y, z, place] in form.matrix {
            self.row(&[x, y, z, place * CM]);
        }
        self.text.push_str("</mat>");
        // Readers ask for widths of what is not tapered too.
        let [mut down, mut up] = form.taper.unwrap_or([1.0; 2]).map(width);
        if (down == "1") != (up == "1") {
            let one = if down == "1" { &mut down } else { &mut up };
            *one = "1.0000000001".to_owned();
        }
        push_all(&mut self.text, ["<dUp>", &up, "</dUp><dDwn>", &down, "</dDwn></geometry>\n"]);
    }

    /// Place and directions of an entity that is not drawn: columns of zeros where they are not known.
    fn placed(&mut self, seen: Option<&Observation>) {
        let Some(seen) = seen else { return };
        let Some(place) = seen.place else {
            let lost = u64::from(seen.direction.is_some());
            return self.losses.add("directions of entities without a place", lost, "");
        };
        let rounded = |of: Option<[f64; 3]>| of.and_then(unit).map(|of| of.map(|x| (x * 1e9).round() / 1e9));
        let (along, up) = (rounded(seen.direction), rounded(seen.up));
        let left = along.zip(up).and_then(|(along, up)| unit(cross(up, along)));
        let column = |of: Option<[f64; 3]>| of.unwrap_or_default();
        let (along, left, up) = (column(along), column(left), column(up));
        self.text.push_str("<geometry class=\"Mesh\"><mat>\n");
        for k in 0..3 {
            self.row(&[along[k], left[k], up[k], place[k] * CM]);
        }
        self.text.push_str("</mat></geometry>\n");
    }

    /// Tells what the file does not have of an entity.
    fn told(&mut self, entity: &Entity) {
        let dated = entity.observations.iter().filter(|seen| seen.date.is_some()).count() as u64;
        let earlier = entity.observations.len().saturating_sub(1) as u64;
        self.losses.add("observations before the last", earlier, "the format has one state of a plant");
        self.losses.add("dates of observations", dated, "the format has none");
    }
}

/// What the element of an entity of a class begins with, behind its word and up to its number.
fn beginning(of: &Class) -> String {
    let symbol = class(&of.symbol, of.role);
    let role = if role(symbol) == of.role { String::new() } else { format!(" role=\"{}\"", of.role.word()) };
    format!(" class=\"{}\"{role} scale=\"{}\" id=\"", escaped(symbol), of.scale)
}

fn push_all<const N: usize>(text: &mut String, words: [&str; N]) {
    words.into_iter().for_each(|word| text.push_str(word));
}

fn width(of: f64) -> String {
    let mut text = String::new();
    push(&mut text, of, SIZES);
    text
}
