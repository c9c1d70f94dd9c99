//! Wavefront OBJ with its materials (`.obj`, `.mtl`), written alone: for PlantGL, GroIMP, and programs of design.
//!
//! Each component is a group, each kind of component a material; of several plants each is an object. Metres, z up;
//! faces are triangles, counterclockwise from outside. The format has meshes alone. Absent: reading, since a mesh does
//! not tell what its plant is.

use super::contract::{Format, Incoming, Outgoing};
use super::decimals::push;
use super::description::{Description, Form, Material, Mesh, Role, Standing};
use super::drawn::Drawn;
use super::losses::Losses;
use super::report::Report;
use super::vectors::{cross, unit};
use phytomer_sim::math::sincos;
use std::fmt::Write as _;
use std::io::{self, Write};

/// So many bytes are gathered before they are written.
const GATHERED: usize = 1 << 16;
/// Places behind the point of a place, metres, and of a normal.
const PLACES: usize = 7;

/// The format.
pub struct Obj;

impl Format for Obj {
    fn word(&self) -> &'static str {
        "obj"
    }

    fn title(&self) -> &'static str {
        "Wavefront OBJ with materials, for PlantGL, GroIMP and programs of design"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["obj"]
    }

    fn reads(&self) -> bool {
        false
    }

    fn read(&self, _: &Incoming<'_>, report: &mut Report) -> Description {
        report.fault(
            (0, 0),
            "OBJ files are written, not read",
            "a file of another format, since a mesh tells no plant",
        );
        Description::default()
    }

    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
        let drawn = Drawn::of(description);
        let library = format!("{}.mtl", out.stem());
        let mut materials = Materials::default();
        out.file(None, &mut |file| {
            Writer {
                description,
                drawn: &drawn,
                materials: &mut materials,
                lists: Lists::of(description, &drawn),
                text: String::new(),
                first: 1,
                file,
            }
            .all(&library, losses)
        })?;
        out.file(Some(&library), &mut |file| file.write_all(materials.text(&drawn).as_bytes()))
    }
}

/// The materials of a file: a name for each kind of component and each material of its shapes.
#[derive(Default)]
struct Materials {
    named: Vec<(Role, Option<u32>, String)>,
}

impl Materials {
    fn name(&mut self, role: Role, material: Option<u32>) -> &str {
        let known = self.named.iter().position(|(kind, own, _)| (*kind, *own) == (role, material));
        let place = known.unwrap_or_else(|| {
            let alike = self.named.iter().filter(|(kind, ..)| *kind == role).count();
            let name = if alike == 0 { role.word().to_owned() } else { format!("{}_{}", role.word(), alike + 1) };
            self.named.push((role, material, name));
            self.named.len() - 1
        });
        &self.named[place].2
    }

    fn text(&self, drawn: &Drawn) -> String {
        let mut out = String::new();
        let grey = Material { diffuse: [0.5, 0.5, 0.5, 1.0], ambient: [0.5, 0.5, 0.5, 1.0], ..Material::default() };
        for (_, material, name) in &self.named {
            let material = material.and_then(|place| drawn.materials.get(place as usize)).unwrap_or(&grey);
            let _ = writeln!(out, "newmtl {name}");
            let colours = [
                ("Ka", material.ambient),
                ("Kd", material.diffuse),
                ("Ks", material.specular),
                ("Ke", material.emission),
            ];
            for (key, [red, green, blue, _]) in colours {
                line(&mut out, key, &[red, green, blue], 6);
            }
            line(&mut out, "Ns", &[material.shininess], 6);
            line(&mut out, "d", &[material.diffuse[3]], 6);
            out.push_str("illum 2\n");
        }
        out
    }
}

/// Which lists a file has beside that of places. Some readers want them as long as that: texture coordinates are
/// written for all vertices where some mesh has them, normals where every mesh has them.
struct Lists {
    has_texture: bool,
    has_normals: bool,
}

impl Lists {
    fn of(description: &Description, drawn: &Drawn) -> Self {
        let (mut has_texture, mut has_normals) = (false, true);
        for entity in description.individuals.iter().flat_map(|plant| &plant.entities) {
            if let Some(shape) = drawn.shape(description.role_of(entity), entity) {
                let mesh = &drawn.meshes[drawn.shapes[shape as usize].mesh as usize];
                has_texture |= !mesh.texture.is_empty();
                has_normals &= mesh.normals.len() == mesh.points.len();
            }
        }
        Self { has_texture, has_normals }
    }
}

struct Writer<'a> {
    description: &'a Description,
    drawn: &'a Drawn,
    materials: &'a mut Materials,
    text: String,
    lists: Lists,
    /// The number of the next vertex.
    first: u64,
    file: &'a mut dyn Write,
}

impl Writer<'_> {
    fn all(mut self, library: &str, losses: &mut Losses) -> io::Result<()> {
        let _ = writeln!(self.text, "# metres, z up\nmtllib {library}");
        let mut undrawn = 0;
        for (number, plant) in self.description.individuals.iter().enumerate() {
            if self.description.individuals.len() > 1 {
                let _ = writeln!(self.text, "o plant_{}", number + 1);
            }
            for (place, entity) in plant.entities.iter().enumerate() {
                let class = self.description.class_of(entity);
                let Some(form) = self.drawn.form(class.role, entity) else {
                    undrawn +=
                        u64::from(!matches!(class.role, Role::Plant | Role::Axis | Role::GrowthUnit | Role::Scene));
                    continue;
                };
                let shape = &self.drawn.shapes[form.shape as usize];
                let _ = writeln!(self.text, "g {}_{}", word_of(&class.symbol), place + 1);
                let material = self.materials.name(class.role, shape.material);
                let _ = writeln!(self.text, "usemtl {material}");
                self.mesh(&self.drawn.meshes[shape.mesh as usize], &form, plant.standing.as_ref());
                self.flush(GATHERED)?;
            }
        }
        losses.add("components without a place or a size", undrawn, "they are not drawn");
        losses.add(
            "links, ages and features of entities",
            self.description.entities() as u64,
            "the format has meshes alone",
        );
        self.flush(0)
    }

    /// The mesh of a component.
    fn mesh(&mut self, mesh: &Mesh, form: &Form, standing: Option<&Standing>) {
        let (least, span) = extent(mesh);
        let widths = form.taper.unwrap_or([1.0; 2]);
        let width = |x: f64| {
            let along = if span > 0.0 { (x - least) / span } else { 0.0 };
            widths[0] + (widths[1] - widths[0]) * along
        };
        for point in &mesh.points {
            let [x, y, z] = *point;
            let wide = width(x);
            let at = [0, 1, 2].map(|k| {
                let row = form.matrix[k];
                row[0] * x + row[1] * y * wide + row[2] * z * wide + row[3]
            });
            line(&mut self.text, "v", &stood(at, standing, true), PLACES);
        }
        if self.lists.has_texture {
            for place in 0..mesh.points.len() {
                line(&mut self.text, "vt", &mesh.texture.get(place).copied().unwrap_or_default(), PLACES);
            }
        }
        if self.lists.has_normals {
            for (normal, point) in mesh.normals.iter().zip(&mesh.points) {
                let normal = turned(form, *normal, width(point[0]));
                line(&mut self.text, "vn", &stood(normal, standing, false), PLACES);
            }
        }
        self.faces(mesh);
        self.first += mesh.points.len() as u64;
    }

    fn faces(&mut self, mesh: &Mesh) {
        for triangle in &mesh.triangles {
            self.text.push('f');
            for corner in triangle.map(|corner| self.first + u64::from(corner)) {
                let _ = match (self.lists.has_texture, self.lists.has_normals) {
                    (true, true) => write!(self.text, " {corner}/{corner}/{corner}"),
                    (false, true) => write!(self.text, " {corner}//{corner}"),
                    (true, false) => write!(self.text, " {corner}/{corner}"),
                    (false, false) => write!(self.text, " {corner}"),
                };
            }
            self.text.push('\n');
        }
    }

    fn flush(&mut self, most: usize) -> io::Result<()> {
        if self.text.len() > most {
            self.file.write_all(self.text.as_bytes())?;
            self.text.clear();
        }
        Ok(())
    }
}

/// A line of a word and numbers.
fn line(out: &mut String, word: &str, numbers: &[f64], places: usize) {
    out.push_str(word);
    for number in numbers {
        out.push(' ');
        push(out, *number, places);
    }
    out.push('\n');
}

/// The least x of a mesh and its length along x.
fn extent(mesh: &Mesh) -> (f64, f64) {
    let along = || mesh.points.iter().map(|point| point[0]);
    let least = along().fold(f64::INFINITY, f64::min);
    (least, along().fold(f64::NEG_INFINITY, f64::max) - least)
}

/// A normal of a mesh in the plant: by the cofactors of the matrix with the widths there.
fn turned(form: &Form, [x, y, z]: [f64; 3], wide: f64) -> [f64; 3] {
    let column = |k: usize, by: f64| [0, 1, 2].map(|row| form.matrix[row][k] * by);
    let (along, left, up) = (column(0, 1.0), column(1, wide), column(2, wide));
    let (a, b, c) = (cross(left, up), cross(up, along), cross(along, left));
    let sum = [0, 1, 2].map(|k| x * a[k] + y * b[k] + z * c[k]);
    unit(sum).unwrap_or([0.0, 0.0, 1.0])
}

/// A place of a plant, or a direction, in its plot.
fn stood(of: [f64; 3], standing: Option<&Standing>, is_place: bool) -> [f64; 3] {
    let Some(standing) = standing else { return of };
    let (sin, cos) = sincos(standing.twist);
    let of = [cos * of[0] - sin * of[1], sin * of[0] + cos * of[1], of[2]];
    // The tilt goes about the horizontal axis to the left of the azimuth (Rodrigues).
    let (sin, cos) = sincos(standing.azimuth);
    let axis = [-sin, cos, 0.0];
    let (sin, cos) = sincos(standing.inclination);
    let (across, along) = (cross(axis, of), axis[0] * of[0] + axis[1] * of[1]);
    let tilted = [0, 1, 2].map(|k| of[k] * cos + across[k] * sin + axis[k] * along * (1.0 - cos));
    if is_place { [0, 1, 2].map(|k| tilted[k] * standing.scale + standing.place[k]) } else { tilted }
}

/// A word of letters, digits and underscores.
fn word_of(symbol: &str) -> String {
    symbol.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
}
