//! The rows of `plants`: what is known of a plant when it is sown, as species, tick, replicate, block and place.
//!
//! The place of a plant is stated here alone, in double precision: a 32-bit float has a precision of 8 mm at 100 km,
//! while components relative to the plant's seed keep a precision that fits the plant's size. Absent: the growth and
//! fate of the plant (`summary`).

use super::buffers::{NULL, columns};
use super::membership::Membership;
use super::plan::OfMember;
use phytomer_sim::plant::Plant;

columns! {
    /// The buffers of `plants`.
    PlantColumns of plant: Plant, of: (Membership, Standing) {
        treatment: Name(i32) = of.0.treatment as i32,
        plot: Int(i32) = of.0.plot as i32,
        plant: Int(i32) = plant.id as i32,
        replicate: Int(i32) = of.0.replicate as i32,
        block: Int(i32) = of.0.block.map_or(NULL, |block| block as i32),
        species: Name(i32) = of.0.species as i32,
        ticks_per_year: Double(f64) = of.1.ticks_per_year.unwrap_or(f64::NAN),
        sown: Int(i32) = of.0.sown as i32,
        x: Double(f64) = plant.place[0],
        y: Double(f64) = plant.place[1],
        z: Double(f64) = plant.place[2],
        ground_area: Double(f64) = of.1.member.ground_area_m2.unwrap_or(f64::NAN),
        sampled: Bool(i8) = i8::from(of.0.sampled),
        guard: Bool(i8) = i8::from(of.1.member.guard),
    }
}

/// What species and scenario state for a plant.
#[derive(Debug, Clone, Copy)]
pub struct Standing {
    /// The ticks of a year of its species.
    pub ticks_per_year: Option<f64>,
    /// What is stated of it as a member of its plot.
    pub member: OfMember,
}

impl PlantColumns {
    /// Adds the row of one plant.
    pub fn add(&mut self, of: Membership, standing: Standing, plant: &Plant) {
        self.extend(std::slice::from_ref(plant), (of, standing));
    }
}
