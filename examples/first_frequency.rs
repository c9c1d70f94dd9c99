//! The first frequency of simulated poplars beside that of real broadleaves, 0.148 + 0.453 DBH / H² Hz (DBH in cm, H in
//! m). The comparison shows the order of magnitude; it is printed and not asserted.
//!
//! cargo run --release --example first_frequency
//!
//! The poplar is the shipped `poplar` with green cottonwood (7.0 GPa, *Wood Handbook*; 850 kg/m³ assumed) and no change
//! of its diameters; the frequency is that of its trunk as a clamped cylinder that carries the whole crown.

use phytomer_config::{Model, validate_species};
use phytomer_models::buds::params::Wood;
use phytomer_models::fault::Path;
use phytomer_sim::mechanics::sway::frequencies;
use phytomer_sim::plant::{Plant, Seed};
use phytomer_sim::{Plot, RecordError, Recorder, Tick, grow};

const UNTIL: Tick = 30;

/// Prints a row for each requested age.
struct Rows;

impl Recorder for Rows {
    fn wants(&self, age: Tick) -> bool {
        age.is_multiple_of(5)
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        let plant = &plot.plants[0];
        let wood = plant.habit.wood.as_ref().ok_or("the poplar has wood")?;
        let (height, breast) = (height(plant, age), breast_height_diameter(plant, age));
        let published = 0.148 + 0.453 * breast * 100.0 / (height * height);
        println!(
            "| {age} | {height:.1} | {:.0} | {:.2} | {published:.2} |",
            breast * 100.0,
            frequencies(plant, wood, age)[0]
        );
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let species = validate_species("poplar", UNTIL).map_err(|report| report.summary())?.species;
    let Model::Buds(mut poplar) = species.model else { return Err("the poplar grows from buds".into()) };
    let wood = Wood { modulus_gpa: Some(7.0.into()), density_kg_m3: Some(850.0.into()), ..Wood::default() };
    poplar.wood = Some(wood);
    let model = poplar.compile(UNTIL, &Path::root()).map_err(|faults| format!("{faults:?}"))?;
    let seed = Seed { plant: 0, draws: 0, run_seed: 1988, component_limit: u32::MAX, keep_events: false };
    println!("| age, years | height, m | DBH, cm | f₁ simulated, Hz | f₁ of broadleaves, Hz |\n|---|---|---|---|---|");
    grow(&mut Plot::of_one(&model, &seed), UNTIL, &mut Rows)?;
    Ok(())
}

fn height(plant: &Plant, age: Tick) -> f64 {
    let tops = (0..plant.nodes.len()).filter(|&node| plant.nodes.birth[node] <= age);
    tops.map(|node| f64::from(plant.frames.base[node][2])).fold(0.0, f64::max)
}

/// The diameter of the trunk at 1.3 m, m.
fn breast_height_diameter(plant: &Plant, age: Tick) -> f64 {
    let mut trunk =
        (0..plant.nodes.len()).filter(|&node| plant.nodes.axis[node].index() == 0 && plant.nodes.birth[node] <= age);
    let below = trunk.rfind(|&node| plant.frames.base[node][2] <= 1.3);
    below.map_or(0.0, |node| f64::from(plant.nodes.diameter[node]))
}
