//! The rows of `plants`: what is known of a plant at its sowing: species, tick, replicate and place.
//!
//! A place is told here once, in double precision, and nowhere else in a table: a float has 8 mm of precision 100 km
//! away, and a plant told from its own seed keeps that of its size. Absent: what becomes of the plant, which `summary`
//! has.

use super::buffers::columns;
use super::membership::Membership;
use phytomer_sim::plant::Plant;

columns! {
    /// The buffers of `plants`.
    PlantColumns of plant: Plant, of: Membership {
        treatment: Name(i32) = of.treatment as i32,
        plot: Int(i32) = of.plot as i32,
        plant: Int(i32) = plant.id as i32,
        replicate: Int(i32) = of.replicate as i32,
        species: Name(i32) = of.species as i32,
        sown: Int(i32) = of.sown as i32,
        x: Double(f64) = plant.place[0],
        y: Double(f64) = plant.place[1],
        z: Double(f64) = plant.place[2],
    }
}

impl PlantColumns {
    /// Adds the row of one plant.
    pub fn add(&mut self, of: Membership, plant: &Plant) {
        self.extend(std::slice::from_ref(plant), of);
    }
}
