//! The models that parts of lives are instances of: one for each kind, form and step of colour.
//!
//! Readers keep little of an instance but its place and its model, so the colour goes by the model, in steps of 12 of
//! 255 in each of three bytes. A form that becomes fuller in its parts has a model for each step of a sixty-fourth.
//! Lives that are drawn with the same forms share models. Absent: instances and files, which are the writers'.

use super::{Life, Model, Part, What};
use phytomer_meshes::{MeshOptions, Vertex};
use phytomer_sim::plant::Kind;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The step of a colour, in each of three bytes.
const STEP: f32 = 12.0;
/// The steps of fullness from 0 to 1.
const FULLNESS: f32 = 64.0;

/// What tells one model from another: the life, the kind, the form, its place, its fullness, and two colours.
type Key = (usize, u8, [u32; 3], [[u8; 3]; 2]);

/// All models of some lives.
pub struct Models<'a> {
    lives: &'a [Life],
    options: &'a [MeshOptions],
    /// Of each life the first that is drawn with the same forms.
    alike: Vec<usize>,
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
        let same = |a: usize, b: usize| {
            let nears = [a, b].map(|life| lives.get(life).and_then(|life| life.nears.as_ref()).map(Arc::as_ptr));
            Arc::ptr_eq(&options[a].own, &options[b].own) && nears[0] == nears[1]
        };
        let alike = |own: usize| (0..own).find(|other| same(own, *other)).unwrap_or(own);
        let alike = (0..options.len()).map(alike).collect();
        let (places, plain, reaches) = Default::default();
        Self { lives, options, alike, places, made: Vec::new(), plain, reaches }
    }

    /// Makes the model of a part in a colour, where there is none yet; its place.
    pub fn meet(&mut self, life: usize, part: &Part, tint: [f32; 3]) -> usize {
        let key = self.key(life, part, tint);
        if let Some(known) = self.places.get(&key) {
            return *known;
        }
        let model = self.make(life, part, key.3);
        let farthest = |vertex: &Vertex| vertex.position().map(|x| x * x).iter().sum::<f32>().sqrt();
        let reach = model.mesh.vertices.iter().map(farthest).fold(0.0, f32::max);
        self.reaches.insert((key.0, key.2), reach);
        self.plain.entry((key.0, key.2)).or_insert_with(|| model.clone());
        self.places.insert(key, self.made.len());
        self.made.push((part.kind, model));
        self.made.len() - 1
    }

    /// The place of the model of a part that was met.
    pub fn place(&self, life: usize, part: &Part, tint: [f32; 3]) -> usize {
        self.places.get(&self.key(life, part, tint)).copied().unwrap_or_default()
    }

    /// The form of a part that was met, in any colour.
    pub fn form(&self, life: usize, part: &Part) -> Option<&Model> {
        self.plain.get(&(self.whose(life, part), self.form_of(life, part)))
    }

    /// How far a part that was met reaches from its base, in the largest of its sizes.
    pub fn reach(&self, life: usize, part: &Part) -> f32 {
        self.reaches.get(&(self.whose(life, part), self.form_of(life, part))).copied().unwrap_or(f32::INFINITY)
    }

    /// The life whose forms a part has: what is a polygon, a surface or an internode has its own life's.
    fn whose(&self, life: usize, part: &Part) -> usize {
        if matches!(part.what, What::Organ(_) | What::Near(_)) { self.alike[life] } else { life }
    }

    fn key(&self, life: usize, part: &Part, tint: [f32; 3]) -> Key {
        (self.whose(life, part), part.kind as u8, self.form_of(life, part), [stepped(tint), part.stalk])
    }

    /// The form of a part; from near it is one whatever its fullness, unless that is in its mesh.
    fn form_of(&self, life: usize, part: &Part) -> [u32; 3] {
        let of = form_of(part);
        let mesh = |form| self.lives[life].nears.as_ref()?.mesh(form);
        match part.what {
            What::Near(form) if mesh(form).is_some_and(|mesh| !mesh.is_in_parts()) => [of[0], of[1], 0],
            _ => of,
        }
    }

    fn make(&self, life: usize, part: &Part, colours: [[u8; 3]; 2]) -> Model {
        let of = &self.lives[life];
        let found = match part.what {
            What::Organ(form) => {
                let fullness = (part.fullness * FULLNESS).round() / FULLNESS;
                Some(Model::of_form(&self.options[life], form, fullness, colours))
            }
            What::Near(form) => {
                let fullness = (part.fullness * FULLNESS).round() / FULLNESS;
                of.nears.as_ref().and_then(|nears| Some(Model::of_near(nears.mesh(form)?, fullness, colours)))
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

    /// The models in their order, each with the kind of its parts.
    pub fn made(&self) -> &[(Kind, Model)] {
        &self.made
    }

    /// The names of the models, in their order: the kind and a number.
    pub fn names(&self) -> Vec<String> {
        let mut counts = [0; Kind::ALL.len()];
        let name = |(kind, _): &(Kind, Model)| {
            let count = &mut counts[*kind as usize];
            *count += 1;
            format!("{}_{}", kind.tag(), *count - 1)
        };
        self.made.iter().map(name).collect()
    }
}

/// A colour in the steps that models have.
pub fn stepped(tint: [f32; 3]) -> [u8; 3] {
    tint.map(|part| ((part / STEP).round() * STEP).clamp(0.0, 255.0) as u8)
}

/// The form of a part, its place among its like, and the step of its fullness where the form is full in its parts.
fn form_of(part: &Part) -> [u32; 3] {
    match part.what {
        What::Organ(form) => [0, u32::from(form.0), (part.fullness * FULLNESS).round().max(0.0) as u32],
        What::Near(form) => [4, form.number(), (part.fullness * FULLNESS).round().max(0.0) as u32],
        What::Outlined(place) => [1, place, 0],
        What::Surface(place) => [2, place, 0],
        What::Internode => [3, part.stem, 0],
    }
}
