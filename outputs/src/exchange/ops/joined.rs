//! Descriptions that are joined to one: classes, features, meshes, materials and shapes that are equal stand in it
//! once.

use super::super::description::{Class, Description, Feature, FeatureType, Individual};
use std::collections::BTreeMap;

/// A description that others are joined to.
#[derive(Debug, Default)]
pub(super) struct Joined {
    /// All of it.
    pub all: Description,
    /// How many entities its plants have.
    pub entities: usize,
    classes: BTreeMap<(String, u32), u32>,
    features: BTreeMap<(String, u8), u32>,
}

impl Joined {
    /// Takes over all that the plants of a description refer to, and gives them back as plants of this one.
    pub fn take(&mut self, other: Description) -> Vec<Individual> {
        let classes: Vec<u32> = other.classes.into_iter().map(|class| self.class(class)).collect();
        let features: Vec<u32> = other.features.into_iter().map(|feature| self.feature(feature)).collect();
        let meshes: Vec<u32> = other.meshes.into_iter().map(|mesh| place(&mut self.all.meshes, mesh)).collect();
        let materials: Vec<u32> =
            other.materials.into_iter().map(|material| place(&mut self.all.materials, material)).collect();
        let shape = |mut shape: super::super::description::Shape| {
            shape.mesh = meshes[shape.mesh as usize];
            shape.material = shape.material.map(|material| materials[material as usize]);
            place(&mut self.all.shapes, shape)
        };
        let shapes: Vec<u32> = other.shapes.into_iter().map(shape).collect();
        self.all.ticks_per_year = self.all.ticks_per_year.or(other.ticks_per_year);
        let mut plants = other.individuals;
        for entity in plants.iter_mut().flat_map(|plant| &mut plant.entities) {
            entity.class = classes[entity.class as usize];
            if let Some(form) = &mut entity.form {
                form.shape = shapes[form.shape as usize];
            }
            for seen in &mut entity.observations {
                seen.values.iter_mut().for_each(|(feature, _)| *feature = features[*feature as usize]);
                seen.values.sort_by_key(|(feature, _)| *feature);
            }
        }
        plants
    }

    fn class(&mut self, class: Class) -> u32 {
        let next = self.all.classes.len() as u32;
        let place = *self.classes.entry((class.symbol.clone(), class.scale)).or_insert(next);
        if place == next {
            self.all.classes.push(class);
        }
        place
    }

    fn feature(&mut self, feature: Feature) -> u32 {
        let next = self.all.features.len() as u32;
        let kind = match feature.kind {
            FeatureType::Int => 0,
            FeatureType::Real => 1,
            FeatureType::Text => 2,
            FeatureType::Truth => 3,
            FeatureType::Date => 4,
        };
        let place = *self.features.entry((feature.name.clone(), kind)).or_insert(next);
        if place == next {
            self.all.features.push(feature);
        }
        place
    }
}

/// The place of something in a list, which it is added to where it is new. In time of the list, which is short.
fn place<T: PartialEq>(list: &mut Vec<T>, of: T) -> u32 {
    match list.iter().position(|known| *known == of) {
        Some(place) => place as u32,
        None => {
            list.push(of);
            list.len() as u32 - 1
        }
    }
}
