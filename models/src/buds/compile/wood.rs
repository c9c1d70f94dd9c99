//! The wood of a species, compiled: tables of stiffness and density by the age of the internode, SI units.
//!
//! A law of stiffness or density depends on the internode's own age, not on the plant's. Absent: the equations
//! (`phytomer_sim::mechanics`).

use super::order_of;
use crate::buds::params::{Buds, CountedLeaves, DragLaw, OrderWood, ThickeningRule, UprightingLaw, Wood as WoodParams};
use crate::fault::{self, Fault, Path};
use crate::law::{Constant, Law, ValueRange};
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::math::{cos, sin};
use phytomer_sim::mechanics::{Drag, OrganMass, Thickening, Tissue, Uprighting, Wood};

/// Young's modulus, GPa: rubber to steel and beyond.
const MODULUS: ValueRange = ValueRange { min: 1e-4, max: 1000.0, what: "a modulus in GPa" };
/// Green density, kg/m³.
const DENSITY: ValueRange = ValueRange { min: 0.0, max: 5000.0, what: "a density in kg/m³" };

const LEAF: ValueRange = ValueRange { min: 0.0, max: 100.0, what: "a mass of leaf in kg/m²" };
/// c of the drag law.
const DRAG: ValueRange = ValueRange { min: 0.0, max: 100.0, what: "a coefficient of drag" };
/// n of the drag law: past 2 a stronger wind would push less.
const STREAMLINING: ValueRange = ValueRange { min: 0.0, max: 2.0, what: "an exponent of drag" };
const SECTION: ValueRange = ValueRange { min: 0.0, max: 1e6, what: "a section in mm²" };
/// Δ of da Vinci's rule.
const FORK: ValueRange = ValueRange { min: 1.0, max: 5.0, what: "an exponent of forks" };
const RING: ValueRange = ValueRange { min: 0.0, max: 1000.0, what: "the width of a ring in mm" };
const FOLIAGE: ValueRange = ValueRange { min: 0.0, max: 1e6, what: "a section in mm² for a square metre of leaves" };
const INCLINATION: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle to the vertical in degrees" };
/// Δε.
const STRAIN: ValueRange = ValueRange { min: -0.1, max: 0.1, what: "a difference of maturation strains" };
const RATE: ValueRange = ValueRange { min: 0.0, max: 36_000.0, what: "a curvature in degrees a metre" };

const SQUARE_MILLIMETRE: f64 = 1e-6;

/// The wood of a species; `None` where it states none.
pub fn compile(buds: &Buds, until: u32, path: &Path, faults: &mut Vec<Fault>) -> Option<Wood> {
    let Some(wood) = buds.wood.as_ref() else {
        ownerless(buds, path, faults);
        return None;
    };
    let species = path.key("wood");
    let tissues = buds.order.iter().enumerate().map(|(index, order)| {
        let order_path = path.key("order").index(index).key("wood");
        let place = Place { until, index, species: species.clone(), order: order_path };
        let mut found = Vec::new();
        let tissue = place.tissue(wood, &order.wood, &mut found);
        // Laws of the species are asked in each order.
        fault::tell_once(faults, found);
        tissue
    });
    let tissues = tissues.collect();
    let mut numbers = Numbers { path: species, faults };
    Some(Wood {
        tissues,
        thickening: wood
            .thickening
            .as_ref()
            .map_or(Thickening::Law, |rule| numbers.below("thickening").thickening(rule)),
        bends: wood.bends,
        organs: OrganMass {
            leaf: numbers.read("leaf_kg_m2", &wood.leaf_kg_m2, LEAF) as f32,
            flower: numbers.read("flower_kg_m3", &wood.flower_kg_m3, DENSITY) as f32,
            fruit: numbers.read("fruit_kg_m3", &wood.fruit_kg_m3, DENSITY) as f32,
        },
        drag: wood.drag.as_ref().map_or_else(Drag::default, |drag| numbers.below("drag").drag(drag)),
    })
}

/// Adds a fault for each order that states a wood where the species has none: such a wood would have no effect.
fn ownerless(buds: &Buds, path: &Path, faults: &mut Vec<Fault>) {
    for (index, _) in buds.order.iter().enumerate().filter(|(_, order)| !order.wood.is_as_the_species()) {
        let path = path.key("order").index(index).key("wood");
        let problem = "the order has wood of its own, and the species has none";
        faults.push(Fault::new(&path, problem, "a `[wood]` table of the species beside it"));
    }
}

/// Where the wood of one order is stated.
struct Place {
    until: u32,
    index: usize,
    species: Path,
    order: Path,
}

impl Place {
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
        let modulus = table("modulus_gpa", &own.modulus_gpa, &wood.modulus_gpa, MODULUS, 1e9);
        let density = table("density_kg_m3", &own.density_kg_m3, &wood.density_kg_m3, DENSITY, 1.0);
        let mut numbers = Numbers { path: self.order.key("uprighting"), faults };
        let uprighting = own.uprighting.as_ref().map_or_else(Uprighting::default, |law| numbers.uprighting(law));
        Tissue { modulus, density, uprighting }
    }

    fn by_age(&self, law: &Law, path: &Path, range: ValueRange, scale: f64) -> Result<Vec<f32>, Vec<Fault>> {
        let table = law.by_own_age(order_of(self.index), self.until, path, range)?;
        Ok(table.into_iter().map(|value| (f64::from(value) * scale) as f32).collect())
    }
}

/// Reads the numbers of one table and adds a fault for each number outside its range.
struct Numbers<'a> {
    path: Path,
    faults: &'a mut Vec<Fault>,
}

impl Numbers<'_> {
    fn below(&mut self, key: &str) -> Numbers<'_> {
        Numbers { path: self.path.key(key), faults: self.faults }
    }

    fn read(&mut self, key: &str, number: &Constant, range: ValueRange) -> f64 {
        number.within(&self.path.key(key), range).unwrap_or_else(|fault| {
            self.faults.push(fault);
            range.max
        })
    }

    fn drag(&mut self, law: &DragLaw) -> Drag {
        Drag { coefficient: self.read("c", &law.c, DRAG) as f32, exponent: self.read("n", &law.n, STREAMLINING) as f32 }
    }

    fn thickening(&mut self, rule: &ThickeningRule) -> Thickening {
        match rule {
            ThickeningRule::Pipe { mm2_per_leaf, leaves, .. } => Thickening::Pipe {
                per_leaf: self.read("mm2_per_leaf", mm2_per_leaf, SECTION) * SQUARE_MILLIMETRE,
                living: *leaves == CountedLeaves::Living,
            },
            ThickeningRule::Vinci { exponent, .. } => {
                Thickening::DaVinci { exponent: self.read("exponent", exponent, FORK) }
            }
            ThickeningRule::Rings { width_mm, mm2_per_leaf_m2, .. } => Thickening::Rings {
                width: self.read("width_mm", width_mm, RING) * 0.001,
                per_foliage: self.read("mm2_per_leaf_m2", mm2_per_leaf_m2, FOLIAGE) * SQUARE_MILLIMETRE,
            },
        }
    }

    fn uprighting(&mut self, law: &UprightingLaw) -> Uprighting {
        let inclination = self.read("inclination_deg", &law.inclination_deg, INCLINATION).to_radians();
        let young = law.young.value();
        if young > LAST_TICK {
            let path = self.path.key("young");
            self.faults.push(Fault::new(&path, format!("the value is {young}"), format!("at most {LAST_TICK} ticks")));
        }
        Uprighting {
            cos_inclination: cos(inclination) as f32,
            sin_inclination: sin(inclination) as f32,
            strain: self.read("strain", &law.strain, STRAIN) as f32,
            rate: self.read("rate_deg_per_m", &law.rate_deg_per_m, RATE).to_radians() as f32,
            young,
        }
    }
}
