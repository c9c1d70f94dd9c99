//! The wood of a species, compiled: tables of stiffness and density by the age of the internode, SI units.
//!
//! A law of stiffness or density is asked at the last age that the run reaches with the internode's own age as dimension
//! and cycle: wood knows how old it is, not how old its plant is. Absent: the equations (`phytomer_sim::mechanics`).

use crate::buds::law::{At, Domain, Law, ValueRange};
use crate::buds::params::{Buds, CountedLeaves, OrderWood, ThickeningRule, UprightingLaw, Wood as WoodParams};
use crate::fault::{Fault, Path};
use phytomer_sim::math::{cos, sin};
use phytomer_sim::mechanics::{Drag, OrganMass, Thickening, Tissue, Uprighting, Wood};

/// Young's modulus, GPa: rubber to steel and beyond.
const MODULUS: ValueRange = ValueRange { min: 1e-4, max: 1000.0, what: "a modulus in GPa" };
/// Green density, kg/m³.
const DENSITY: ValueRange = ValueRange { min: 0.0, max: 5000.0, what: "a density in kg/m³" };

const SQUARE_MILLIMETRE: f64 = 1e-6;

/// The wood of a species; `None` where it states none.
pub fn compile(buds: &Buds, until: u32, path: &Path, faults: &mut Vec<Fault>) -> Option<Wood> {
    let wood = buds.wood.as_ref()?;
    let tissues = buds.order.iter().enumerate().map(|(index, order)| {
        let place =
            Place { buds, until, index, species: path.key("wood"), order: path.key("order").index(index).key("wood") };
        place.tissue(wood, &order.wood, faults)
    });
    Some(Wood {
        tissues: tissues.collect(),
        thickening: wood.thickening.as_ref().map_or(Thickening::Law, thickening),
        bends: wood.bends,
        organs: OrganMass {
            leaf: wood.leaf_kg_m2 as f32,
            flower: wood.flower_kg_m3 as f32,
            fruit: wood.fruit_kg_m3 as f32,
        },
        drag: wood
            .drag
            .as_ref()
            .map_or_else(Drag::default, |drag| Drag { coefficient: drag.c as f32, exponent: drag.n as f32 }),
    })
}

/// Where the wood of one order is stated.
struct Place<'a> {
    buds: &'a Buds,
    until: u32,
    index: usize,
    species: Path,
    order: Path,
}

impl Place<'_> {
    fn tissue(&self, wood: &WoodParams, own: &OrderWood, faults: &mut Vec<Fault>) -> Tissue {
        let mut table = |key: &str, own: &Option<Law>, shared: &Option<Law>, range, scale: f64| {
            let (law, path) = match (own, shared) {
                (Some(law), _) => (law, self.order.key(key)),
                (None, Some(law)) => (law, self.species.key(key)),
                (None, None) if wood.bends => {
                    let expected = format!("`{key}`, or `like` with a wood of the shipped table, or `bends = false`");
                    faults.push(Fault::new(&self.species, format!("the wood bends and has no `{key}`"), expected));
                    return Vec::new();
                }
                (None, None) => return Vec::new(),
            };
            self.by_age(law, &path, range, scale).unwrap_or_else(|mut found| {
                faults.append(&mut found);
                Vec::new()
            })
        };
        Tissue {
            modulus: table("modulus_gpa", &own.modulus_gpa, &wood.modulus_gpa, MODULUS, 1e9),
            density: table("density_kg_m3", &own.density_kg_m3, &wood.density_kg_m3, DENSITY, 1.0),
            uprighting: own.uprighting.as_ref().map_or_else(Uprighting::default, uprighting),
        }
    }

    fn by_age(&self, law: &Law, path: &Path, range: ValueRange, scale: f64) -> Result<Vec<f32>, Vec<Fault>> {
        let domain = Domain {
            order: u8::try_from(self.index + 1).unwrap_or(u8::MAX),
            until: self.until,
            max_cycle: self.until,
            max_rank: 0,
            states: self.buds.states.clone(),
        };
        let compiled = law.compile_value(&domain, path, range)?;
        let at = |own| At { age: self.until, dimension: own, cycle: own, rank: 0, state: 0 };
        let mut table: Vec<f32> =
            (0..=self.until).map(|own| (f64::from(compiled.value(at(own))) * scale) as f32).collect();
        // Ages past a table's last are as its last.
        while table.len() > 1 && table[table.len() - 1] == table[table.len() - 2] {
            table.pop();
        }
        Ok(table)
    }
}

fn thickening(rule: &ThickeningRule) -> Thickening {
    match *rule {
        ThickeningRule::Pipe { mm2_per_leaf, leaves, .. } => {
            Thickening::Pipe { per_leaf: mm2_per_leaf * SQUARE_MILLIMETRE, living: leaves == CountedLeaves::Living }
        }
        ThickeningRule::Vinci { exponent, .. } => Thickening::DaVinci { exponent },
        ThickeningRule::Rings { width_mm, mm2_per_leaf_m2, .. } => {
            Thickening::Rings { width: width_mm * 0.001, per_foliage: mm2_per_leaf_m2 * SQUARE_MILLIMETRE }
        }
    }
}

fn uprighting(law: &UprightingLaw) -> Uprighting {
    let inclination = law.inclination_deg.to_radians();
    Uprighting {
        cos_inclination: cos(inclination) as f32,
        sin_inclination: sin(inclination) as f32,
        strain: law.strain as f32,
        rate: law.rate_deg_per_m.to_radians() as f32,
        young: law.young,
    }
}
