//! What a scenario states for the models of its species: constants of their L-systems, as `[define]`, and the shapes of
//! its site, which such files may call.
//!
//! A level of a factor sets a constant as it sets any key: `define = { a = 2 }`. Absent: what the constants mean to a
//! species (`phytomer_models::lsystem`), and the plants that have them in common (`cohorts`).

use super::Scenario;
use phytomer_law::fault::{Fault, Path};
use phytomer_law::{Domain, Variate};
use phytomer_models::lsystem::CONSTANT;
use phytomer_models::parameters::Surroundings;
use phytomer_models::shapes::StatedShape;

impl Scenario {
    /// What the models of species may read; `None` where nothing is stated. In the place of what has faults, which
    /// [`Scenario::faults`] has, stands something sound, so that no species has faults for that reason.
    pub(crate) fn surroundings(&self) -> Option<Surroundings> {
        if self.site.shape.is_empty() && self.define.is_empty() {
            return None;
        }
        let sound = self.site.shapes(&mut Vec::new());
        let instead = StatedShape::Sphere { at_m: [0.0; 3], radius_m: 1.0 };
        let shapes = self.site.shape.iter().map(|(name, shape)| {
            let shape = if sound.get(name).is_some() { shape.clone() } else { instead.clone() };
            (name.clone(), shape)
        });
        let constants = self.define.iter().map(|(name, law)| {
            let is_sound = law.compile(&Domain::ONCE, &Path::root(), CONSTANT).is_ok();
            (name.clone(), if is_sound { law.clone() } else { Variate::from(1.0) })
        });
        Some(Surroundings { shapes: shapes.collect(), constants: constants.collect() })
    }

    /// Adds the faults of constants.
    pub(super) fn check_constants(&self, faults: &mut Vec<Fault>) {
        for (name, law) in &self.define {
            let path = Path::root().key("define").key(name);
            faults.extend(law.compile(&Domain::ONCE, &path, CONSTANT).err().into_iter().flatten());
        }
    }
}
