//! Blades against closed forms: cantilevers of b t³/12 out of their plane and t b³/12 in it, flat, on edge and between.
//!
//! The first frequency of a blade is compared as well. Absent: round stems (`small`, `elastica`).

use super::*;
use crate::math::{cos, sin};
use std::f64::consts::FRAC_PI_2;

/// A blade of length 1 m that lies level along X, with its upper side turned by `roll` from the vertical.
struct Blade {
    width: f64,
    thickness: f64,
    roll: f64,
    /// E, Pa, and ρ, kg/m³.
    modulus: f64,
    density: f64,
}

const INTERNODES: u32 = 200;

impl Blade {
    fn flat(modulus: f64, density: f64) -> Self {
        Self { width: 0.05, thickness: 0.002, roll: 0.0, modulus, density }
    }

    /// On a stub without length, whose heading is the upper side of the blade.
    fn plant(&self) -> Plant {
        let rod = Rod { insertion: self.roll, diameter: self.width, internodes: 0, ..Rod::level(0) };
        let mut plant = rod.plant();
        let mut look = InternodeLook::of_shape(Shape::Blade);
        look.thickness = self.thickness as f32;
        let wood = Wood {
            tissues: vec![Tissue {
                modulus: vec![self.modulus as f32],
                density: vec![self.density as f32],
                uprighting: Uprighting::default(),
            }],
            ..rod.wood()
        };
        let looks = Looks { internodes: vec![look], ..plant.habit.looks.clone() };
        plant.habit = Arc::new(Habit { looks, wood: Some(wood), ..(*plant.habit).clone() });
        plant.axes.azimuth[0] = FRAC_PI_2 as f32;
        let stub = add_node(&mut plant, AxisId::TRUNK, 0.0, self.width as f32);
        let axis = add_axis(&mut plant, Some(stub), FRAC_PI_2);
        plant.axes.azimuth[axis.index()] = FRAC_PI_2 as f32;
        for _ in 0..INTERNODES {
            let node = add_node(&mut plant, axis, 1.0 / INTERNODES as f32, self.width as f32);
            plant.nodes.diameter_tip[node.index()] = self.width as f32;
        }
        plant
    }

    fn bent(&self) -> (Plant, [f64; 3]) {
        let mut plant = self.plant();
        let outcome = bend(&mut plant, 1, &unit_gravity(), &mut Scratch::default());
        assert!(outcome.settled && outcome.yields.is_none(), "{outcome:?}");
        let tip = crate::pose::bud_frame(&plant, AxisId(1)).base.map(f64::from);
        (plant, tip)
    }

    /// Weight of a metre, N/m, and flexural stiffness out of its plane and in it, N·m².
    fn beam(&self) -> (f64, [f64; 2]) {
        let (b, t) = (self.width, self.thickness);
        (self.density * b * t, [b * t * t * t, t * b * b * b].map(|twelfths| self.modulus * twelfths / 12.0))
    }
}

fn near(found: f64, expected: f64, tolerance: f64) -> bool {
    (found - expected).abs() < tolerance * expected.abs()
}

/// w L⁴ / 8 E I about each axis, by the share of the weight that acts along it.
#[test]
fn a_blade_bends_out_of_its_plane_and_in_it_under_its_own_weight() {
    for roll in [0.0, 0.5, 1.2, FRAC_PI_2] {
        let blade = Blade { roll, ..Blade::flat(3e6, 0.1) };
        let (weight, [flat, edge]) = blade.beam();
        let (_, [_, y, z]) = blade.bent();
        // Along its upper side (0, sin, cos) and along its width (0, cos, −sin).
        let (normal, across) = (weight * cos(roll) / (8.0 * flat), weight * sin(roll) / (8.0 * edge));
        let expected = [-normal * sin(roll) + across * cos(roll), -normal * cos(roll) - across * sin(roll)];
        assert!((y - expected[0]).abs() < 1e-3 * normal.max(across) + 1e-7, "roll {roll}: {y}, not {}", expected[0]);
        assert!((z - expected[1]).abs() < 1e-3 * normal.max(across) + 1e-7, "roll {roll}: {z}, not {}", expected[1]);
    }
}

#[test]
fn far_bent_it_is_the_rod_of_the_same_stiffness_and_weight() {
    let blade = Blade::flat(3e6, 5.0);
    let (weight, [flexural, _]) = blade.beam();
    assert!((0.9..20.0).contains(&(weight / flexural)), "{weight} on {flexural}");
    let (_, [x, _, z]) = blade.bent();
    let (rod, _) = Rod { weight, flexural, ..Rod::level(INTERNODES) }.bent();
    let (rod_x, rod_z) = tip(&rod);
    assert!((x - rod_x).abs() < 1e-5 && (z - rod_z).abs() < 1e-5, "{x} {z}, not {rod_x} {rod_z}");
}

/// On edge and heavy enough to hang down if it bent as it does out of its plane.
#[test]
fn on_edge_it_stands_a_load_under_which_it_hangs_when_flat() {
    let flat = Blade::flat(3e6, 5.0);
    let (weight, [_, edge]) = flat.beam();
    assert!(flat.bent().1[2] < -0.3, "flat");
    let drop = -Blade { roll: FRAC_PI_2, ..flat }.bent().1[2];
    assert!(near(drop, weight / (8.0 * edge), 1e-2), "{drop}, not {}", weight / (8.0 * edge));
}

#[test]
fn it_has_volume_mass_and_a_frequency() {
    let blade = Blade::flat(3e9, 800.0);
    let (weight, [flexural, _]) = blade.beam();
    let plant = blade.plant();
    let volume: f64 = (0..plant.nodes.len()).map(|node| wood_volume(&plant, NodeId(node as u32))).sum();
    assert!(near(volume, 0.05 * 0.002, 1e-5), "{volume}");
    let wood = plant.habit.wood.as_ref().expect("it has wood");
    let frequency = sway::frequencies(&plant, wood, 1)[1];
    // β₁² / 2π √(E I / μ) of a clamped beam.
    let expected = pow(1.875_104_068_7, 2.0) / (2.0 * std::f64::consts::PI) * (flexural / weight).sqrt();
    assert!(near(frequency, expected, 1e-4), "{frequency} Hz, not {expected}");
}
