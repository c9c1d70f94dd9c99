//! The rows of `plants`: what is known of a plant at its sowing, its place above all.
//!
//! A place is told here once, in double precision, and nowhere else in a table: a float has 8 mm of precision 100 km
//! away, and a plant told from its own seed keeps that of its size. Absent: what becomes of the plant, which `summary`
//! has.

use super::buffers::columns;
use phytomer_sim::Plot;
use phytomer_sim::plant::Plant;

columns! {
    /// The buffers of `plants`.
    PlantColumns of plant: Plant, plot: &Plot {
        treatment: Word(i8) = 0,
        plot: Int(i32) = plot.id as i32,
        plant: Int(i32) = plant.id as i32,
        species: Word(i8) = 0,
        x: Double(f64) = plant.place[0],
        y: Double(f64) = plant.place[1],
        z: Double(f64) = plant.place[2],
    }
}

impl PlantColumns {
    /// Adds the row of one plant.
    pub fn add(&mut self, plot: &Plot, plant: &Plant) {
        self.extend(std::slice::from_ref(plant), plot);
    }
}
