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
    PlantColumns {
        treatment: Word(i8), plot: Int(i32), plant: Int(i32), species: Word(i8),
        x: Double(f64), y: Double(f64), z: Double(f64),
    }
}

impl PlantColumns {
    /// Adds the row of one plant.
    pub fn add(&mut self, plot: &Plot, plant: &Plant) {
        let [x, y, z] = plant.place;
        self.treatment.push(0);
        self.plot.push(plot.id as i32);
        self.plant.push(plant.id as i32);
        self.species.push(0);
        self.x.push(x);
        self.y.push(y);
        self.z.push(z);
    }
}
