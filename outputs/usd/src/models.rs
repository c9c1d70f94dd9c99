//! The models that parts are instances of: one for each kind, form and step of colour.
//!
//! Readers keep little of an instance but its place and its model, so the colour goes by the model, in steps of 12 of
//! 255 in each of three bytes. A form that becomes fuller in its parts has a model for each step of a sixty-fourth.

use super::changing::begin_mesh;
use super::layer::{Attribute, Data, Layer, Value};
use super::paint::{self, Palette};
use super::stepped;
use phytomer_life::{Life, Model, Part, What};
use phytomer_meshes::{MeshOptions, Vertex};
use phytomer_sim::plant::Kind;
use std::collections::BTreeMap;
use std::io;

/// The steps of fullness from 0 to 1.
const FULLNESS: f32 = 64.0;

/// What tells one model from another: the life, the kind, the form, its place, its fullness, and two colours.
type Key = (usize, u8, [u32; 3], [[u8; 3]; 2]);

/// All models of some lives.
pub struct Models<'a> {
    lives: &'a [Life],
    options: &'a [MeshOptions],
    places: BTreeMap<Key, usize>,
    made: Vec<(Kind, Model)>,
    /// Models for the scale of a part alone, whatever its colour.
    plain: BTreeMap<(usize, [u32; 3]), Model>,
    /// How far each of these reaches from its base, in the largest of the sizes of a part.
    reaches: BTreeMap<(usize, [u32; 3]), f32>,
}

impl<'a> Models<'a> {
    /// No model yet, of lives that are drawn with these options.
    pub fn of(lives: &'a [Life], options: &'a [MeshOptions]) -> Self {
        Self {
            lives,
            options,
            places: BTreeMap::new(),
            made: Vec::new(),
            plain: BTreeMap::new(),
            reaches: BTreeMap::new(),
        }
    }

    /// Makes the model of a part in a colour, where there is none yet.
    pub fn meet(&mut self, life: usize, part: &Part, tint: [f32; 3]) {
        let key = self.key(life, part, tint);
        if self.places.contains_key(&key) {
            return;
        }
        let [blade, stalk] = key.3;
        let model = self.make(life, part, [blade, stalk]);
        let farthest = |vertex: &Vertex| vertex.position().map(|x| x * x).iter().sum::<f32>().sqrt();
        let reach = model.mesh.vertices.iter().map(farthest).fold(0.0, f32::max);
        self.reaches.insert((life, key.2), reach);
        self.plain.entry((life, key.2)).or_insert_with(|| model.clone());
        self.places.insert(key, self.made.len());
        self.made.push((part.kind, model));
    }

    /// The place of the model of a part that was met.
    pub fn place(&self, life: usize, part: &Part, tint: [f32; 3]) -> i32 {
        self.places.get(&self.key(life, part, tint)).map_or(0, |place| *place as i32)
    }

    /// The form of a part that was met, in any colour.
    pub fn form(&self, life: usize, part: &Part) -> Option<&Model> {
        self.plain.get(&(life, form_of(part)))
    }

    /// How far a part that was met reaches from its base, in the largest of its sizes.
    pub fn reach(&self, life: usize, part: &Part) -> f32 {
        self.reaches.get(&(life, form_of(part))).copied().unwrap_or(f32::INFINITY)
    }

    fn key(&self, life: usize, part: &Part, tint: [f32; 3]) -> Key {
        (life, part.kind as u8, form_of(part), [stepped(tint), part.stalk])
    }

    fn make(&self, life: usize, part: &Part, colours: [[u8; 3]; 2]) -> Model {
        let of = &self.lives[life];
        let found = match part.what {
            What::Organ(form) => {
                let fullness = (part.fullness * FULLNESS).round() / FULLNESS;
                Some(Model::of_form(&self.options[life], form, fullness, colours))
            }
            What::Outlined(place) => {
                of.outlines.get(place as usize).map(|corners| Model::of_outline(corners, colours[0]))
            }
            What::Surface(place) => {
                of.surfaces.get(place as usize).map(|surface| Model::of_surface(surface, colours[0]))
            }
            What::Internode => of.stems.get(part.stem as usize).cloned(),
        };
        found.unwrap_or_default()
    }

    /// The kinds of all models, each once.
    pub fn kinds(&self) -> Vec<Kind> {
        let all = Kind::ALL.into_iter();
        all.filter(|kind| self.made.iter().any(|(of, _)| of == kind)).collect()
    }

    /// The names of the models, in their order.
    pub fn names(&self) -> Vec<String> {
        let mut counts = [0; Kind::ALL.len()];
        let name = |(kind, _): &(Kind, Model)| {
            let count = &mut counts[*kind as usize];
            *count += 1;
            format!("{}_{}", kind.tag(), *count - 1)
        };
        self.made.iter().map(name).collect()
    }

    /// The vertices of a model.
    pub fn vertices(&self, place: usize) -> &[Vertex] {
        self.made.get(place).map_or(&[], |(_, model)| &model.mesh.vertices)
    }

    /// Writes the models as meshes.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write(&self, layer: &mut dyn Layer, root: &str) -> io::Result<()> {
        for (name, (kind, model)) in self.names().iter().zip(&self.made) {
            begin_mesh(layer, name)?;
            write_model(layer, model)?;
            layer.relationship("material:binding", &[paint::path_of(root, kind.tag())])?;
            layer.end()?;
        }
        Ok(())
    }
}

/// The form of a part, its place among its like, and the step of its fullness where the form is full in its parts.
fn form_of(part: &Part) -> [u32; 3] {
    match part.what {
        What::Organ(form) => [0, u32::from(form.0), (part.fullness * FULLNESS).round().max(0.0) as u32],
        What::Outlined(place) => [1, place, 0],
        What::Surface(place) => [2, place, 0],
        What::Internode => [3, part.stem, 0],
    }
}

fn write_model(layer: &mut dyn Layer, model: &Model) -> io::Result<()> {
    let (vertices, faces) = (&model.mesh.vertices, &model.mesh.faces);
    let mut always = |attribute, data: Data| layer.attribute(attribute, Value::Always(data));
    let corners: Vec<i32> = faces.iter().flat_map(|face| face.indices().map(|corner| corner as i32)).collect();
    always(Attribute::new("faceVertexCounts", "int[]"), Data::Ints(&vec![3; faces.len()]))?;
    always(Attribute::new("faceVertexIndices", "int[]"), Data::Ints(&corners))?;
    let of = |read: fn(&Vertex) -> [f32; 3]| vertices.iter().map(read).collect::<Vec<_>>();
    let points = of(Vertex::position);
    always(Attribute::new("points", "point3f[]"), Data::Triples(&points))?;
    let extent = super::changing::extent(points.iter().copied());
    always(Attribute::new("extent", "float3[]"), Data::Triples(&extent))?;
    always(Attribute::over("normals", "normal3f[]", "vertex"), Data::Triples(&of(Vertex::normal)))?;
    let texture: Vec<[f32; 2]> = vertices.iter().map(Vertex::texture).collect();
    always(Attribute::over("primvars:st", "texCoord2f[]", "vertex"), Data::Pairs(&texture))?;
    let mut palette = Palette::default();
    let places: Vec<i32> = vertices.iter().map(|vertex| palette.place(rgb(vertex))).collect();
    let colours = Attribute::over("primvars:displayColor", "color3f[]", "vertex");
    always(colours, Data::Triples(palette.colours()))?;
    always(Attribute::new("primvars:displayColor:indices", "int[]"), Data::Ints(&places))
}

/// The colour of a vertex.
pub fn rgb(vertex: &Vertex) -> [u8; 3] {
    let [red, green, blue, _] = vertex.tag().colour;
    [red, green, blue]
}
