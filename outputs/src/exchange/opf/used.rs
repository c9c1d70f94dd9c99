//! What the plants of a written OPF file need of all that a description has: shapes with their meshes and materials,
//! and attributes, in an order that the plants alone tell.
//!
//! So a plant has the same file whatever stands beside it in a scene, and a file that is read is written as it was.

use super::super::description::Description;
use super::super::drawn::Drawn;
use super::fields::fields;
use super::order::{Order, Step};
use super::words::Known;
use std::collections::{BTreeMap, BTreeSet};
use std::convert::Infallible;

/// Numbers of a list, in the order in which they are met.
#[derive(Debug, Default)]
pub(super) struct Met {
    /// The numbers.
    pub all: Vec<u32>,
    place_of: BTreeMap<u32, u32>,
}

impl Met {
    fn meet(&mut self, number: u32) {
        let next = self.all.len() as u32;
        if *self.place_of.entry(number).or_insert(next) == next {
            self.all.push(number);
        }
    }

    /// The place of a number that was met.
    pub fn place(&self, number: u32) -> u32 {
        self.place_of.get(&number).copied().unwrap_or_default()
    }
}

/// What is needed.
#[derive(Debug, Default)]
pub(super) struct Used {
    /// Shapes, in the order of the entities that they draw.
    pub shapes: Met,
    /// Meshes, in the order of the shapes.
    pub meshes: Met,
    /// Materials, likewise.
    pub materials: Met,
    /// Features.
    pub features: BTreeSet<u32>,
    /// Fields.
    pub fields: BTreeSet<Known>,
}

impl Used {
    /// What these plants need, each with the order of its entities.
    pub fn of(described: &Description, drawn: &Drawn, plants: &[(usize, Order)]) -> Self {
        let mut used = Self::default();
        for (plant, order) in plants {
            let plant = &described.individuals[*plant];
            let _: Result<(), Infallible> = order.each(|step| {
                let Step::Begin(number) = step else { return Ok(()) };
                let entity = &plant.entities[number as usize];
                if let Some(shape) = drawn.shape(described.role_of(entity), entity) {
                    used.shapes.meet(shape);
                }
                let values = entity.latest().map_or(&[][..], |seen| &seen.values);
                used.features.extend(values.iter().map(|(feature, _)| *feature));
                fields(described, plant, number as usize, entity, |field, _| _ = used.fields.insert(field));
                Ok(())
            });
        }
        for shape in used.shapes.all.iter().filter_map(|shape| drawn.shapes.get(*shape as usize)) {
            used.meshes.meet(shape.mesh);
            if let Some(material) = shape.material {
                used.materials.meet(material);
            }
        }
        used
    }
}
