//! A plant of one age in a gusty wind: a frame at a time, for animation.
//!
//! Each axis is an oscillator about the shape that the steady wind gives it, with the first frequency of a clamped
//! cylinder, f₁ = (β₁² / 8π) d √(E/ρ) / L² = 0.139897 d √(E/ρ) / L² (Euler–Bernoulli, β₁ = 1.8751); ρ is the mass of
//! its wood and its load over the volume of its wood. A gust every [`GUSTS_S`] seconds knocks each axis, which then
//! swings freely, e^(−ζωτ) cos(ω√(1−ζ²) τ + φ), with a phase φ from its lineage key; the swings after all earlier gusts
//! are a geometric series. So the motion repeats with the gusts, and an animation of that length loops. Absent: leaves
//! that flutter, vortices, and any effect on the growth of the plant.

use super::scratch::Scratch;
use super::section::Section;
use super::wood::wood_volume;
use crate::clock::Tick;
use crate::math::{exp, sincos};
use crate::plant::{Habit, LineageKey, NodeId, OrganId, Plant, Wood};
use crate::site::{Site, Wind};
use std::f64::consts::TAU;

/// The time between two gusts, s.
pub const GUSTS_S: f64 = 8.0;

/// The damping ratio ζ, of the order measured on trees in leaf (de Langre 2008, *Effects of wind on plants*: 0.05 to
/// 0.15).
pub const DAMPING: f64 = 0.1;

/// The share of the steady deflection by which a gust knocks an axis: the turbulence intensity of wind near the ground.
pub const GUSTINESS: f64 = 0.3;

/// β₁² / 8π of a clamped cylinder, with β₁ the first root of cos β cosh β = −1.
pub const CLAMPED_CYLINDER: f64 = 0.139_897;

/// Why a plant does not sway.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unmoved {
    /// Its species has no wood that bends.
    #[error("the species has no wood that bends: its file needs a `[wood]` table")]
    Stiff,
    /// Its wood has no drag.
    #[error("the wood of the species has no drag: its `[wood]` needs `drag`, or `like` with a wood that has one")]
    NoDrag,
}

/// Moves a plant that stands bent and posed at `age` to its pose in `wind` after `time` seconds. A calm moves nothing.
/// Cost: one bending and one pose.
///
/// # Errors
/// [`Unmoved`] where the species has no wood that bends, or none with drag.
pub fn sway(
    plant: &mut Plant,
    age: Tick,
    site: &Site,
    wind: Wind,
    time: f64,
    scratch: &mut Scratch,
) -> Result<(), Unmoved> {
    let habit = std::sync::Arc::clone(&plant.habit);
    let wood = yielding(&habit)?;
    if wind.speed <= 0.0 {
        return Ok(());
    }
    let calm = scratch.lean(plant, wood, age, &Site { wind, ..site.clone() });
    let swings: Vec<f64> = frequencies(plant, wood, age)
        .into_iter()
        .zip(&plant.axes.key)
        .map(|(frequency, key)| 1.0 + GUSTINESS * swing(frequency, phase(*key), time))
        .collect();
    for (node, calm) in calm.iter().enumerate() {
        let swing = swings[plant.nodes.axis[node].index()];
        let curvature = &mut plant.strain.curvature[node];
        *curvature = [0, 1].map(|k| {
            let (still, steady) = (f64::from(calm[k]), f64::from(curvature[k]));
            (still + (steady - still) * swing) as f32
        });
    }
    scratch.pose(plant, age);
    Ok(())
}

/// The wood of plants of this habit, where wind can move it.
///
/// # Errors
/// [`Unmoved`] where the species has no wood that bends, or none with drag.
pub fn yielding(habit: &Habit) -> Result<&Wood, Unmoved> {
    let wood = habit.wood.as_ref().filter(|wood| wood.bends).ok_or(Unmoved::Stiff)?;
    if wood.drag.coefficient > 0.0 { Ok(wood) } else { Err(Unmoved::NoDrag) }
}

/// The first frequency of each axis at `age`, Hz, one entry an axis; 0 where an axis does not stand, has no length, or
/// has no stiffness or mass.
pub fn frequencies(plant: &Plant, wood: &Wood, age: Tick) -> Vec<f64> {
    let mut axes = vec![Beam::default(); plant.axes.len()];
    let stands = |node: usize| plant.stands(NodeId(node as u32), age);
    for organ in 0..plant.organs.len() {
        let node = plant.organs.node[organ].index();
        if plant.organ_stands(OrganId(organ as u32), age) && stands(node) {
            axes[plant.nodes.axis[node].index()].mass += wood.organs.of(plant, organ, age);
        }
    }
    for node in (0..plant.nodes.len()).filter(|&node| stands(node)) {
        axes[plant.nodes.axis[node].index()].extend(plant, wood, age, node);
    }
    // An axis comes after its bearing axis, so its load is complete when it is added to that of the bearing axis.
    for axis in (0..axes.len()).rev() {
        if let Some(bearer) = plant.axes.bearer[axis].some() {
            let carried = axes[axis].mass;
            axes[plant.nodes.axis[bearer.index()].index()].mass += carried;
        }
    }
    axes.iter().map(Beam::frequency).collect()
}

/// An axis as a clamped cylinder; a blade as the cylinder that bends alike out of the blade's plane.
#[derive(Debug, Clone, Copy, Default)]
struct Beam {
    length: f64,
    volume: f64,
    /// The mass of its wood and of everything that it carries, kg.
    mass: f64,
    /// The diameter at its base, m; of a blade that of a round stem with the same radius of gyration.
    diameter: f64,
    modulus: f64,
}

impl Beam {
    fn extend(&mut self, plant: &Plant, wood: &Wood, age: Tick, node: usize) {
        let own_age = age - plant.nodes.birth[node];
        let tissue = wood.tissue(plant.axes.order[plant.nodes.axis[node].index()]);
        if self.length == 0.0 {
            let section = Section::of(plant.look_of_node(NodeId(node as u32)));
            self.diameter = section.gyration(f64::from(plant.nodes.diameter[node]));
            self.modulus = tissue.modulus(own_age);
        }
        let volume = wood_volume(plant, NodeId(node as u32));
        self.length += f64::from(plant.posed_length(NodeId(node as u32)));
        self.volume += volume;
        self.mass += volume * tissue.density(own_age);
    }

    fn frequency(&self) -> f64 {
        if self.length > 0.0 && self.mass > 0.0 {
            let speed = (self.modulus * self.volume / self.mass).sqrt();
            CLAMPED_CYLINDER * self.diameter * speed / (self.length * self.length)
        } else {
            0.0
        }
    }
}

/// Σ e^(−ζω(τ + kT)) cos(ω_d (τ + kT) + φ) over all gusts k ≥ 0, with τ the time since the last gust.
fn swing(frequency: f64, phase: f64, time: f64) -> f64 {
    if frequency <= 0.0 {
        return 0.0;
    }
    let omega = TAU * frequency;
    let (decay, turn) = (DAMPING * omega, omega * (1.0 - DAMPING * DAMPING).sqrt());
    let since = crate::math::fmod(time, GUSTS_S);
    let since = if since < 0.0 { since + GUSTS_S } else { since };
    // 1 / (1 − z) with z = e^((−ζω + i ω_d) T).
    let (sin, cosine) = sincos(turn * GUSTS_S);
    let size = exp(-decay * GUSTS_S);
    let (real, imaginary) = (1.0 - size * cosine, -size * sin);
    let norm = real * real + imaginary * imaginary;
    let (s, c) = sincos(turn * since + phase);
    exp(-decay * since) * (c * real + s * imaginary) / norm
}

/// The phase of an axis from its lineage key, radians.
fn phase(key: LineageKey) -> f64 {
    TAU * (key.0 >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::cos;
    use std::f64::consts::PI;

    #[test]
    fn the_swings_after_all_gusts_add_up() {
        for (frequency, phase, time) in [(0.2, 0.3, 1.7), (1.5, 2.0, 0.0), (0.05, 5.0, 7.9), (12.0, 1.0, 0.01)] {
            let omega = TAU * frequency;
            let turn = omega * (1.0 - DAMPING * DAMPING).sqrt();
            let after = |gust: i32| {
                let since = time + f64::from(gust) * GUSTS_S;
                exp(-DAMPING * omega * since) * cos(turn * since + phase)
            };
            let direct: f64 = (0..400).map(after).sum();
            assert!((swing(frequency, phase, time) - direct).abs() < 1e-9, "{frequency}: {direct}");
        }
    }

    #[test]
    fn the_motion_repeats_with_the_gusts() {
        for time in [0.0, 0.4, 5.0] {
            assert!((swing(0.7, 1.0, time) - swing(0.7, 1.0, time + 3.0 * GUSTS_S)).abs() < 1e-9);
        }
    }

    #[test]
    fn the_factor_is_that_of_the_first_root() {
        let root = 1.875_104_068_7_f64;
        assert!((root * root / (8.0 * PI) - CLAMPED_CYLINDER).abs() < 1e-6);
    }
}
