//! The tropisms and torques of cpfg that view files number, and what modules change of their strengths.
//!
//! Its manual tells of tropisms; torques follow its source (`movements.c`), in which both are numbered together in the
//! order of their lines. Absent: the one tropism of the book, which bends after each step (`Frame::bend`).

use super::frame::Frame;
use super::settings::bounded;
use super::{Axis, Change, Turtle, Vector, first};
use crate::lsystem::vector::{cross, dot, unit};
use phytomer_sim::math::sincos;

impl Turtle {
    pub(super) fn elasticity_of(&mut self, change: Change, parameters: &[f64]) {
        let place = first(parameters).unwrap_or(1.0) - 1.0;
        let number = (place >= 0.0 && place < self.elasticities.len() as f64).then_some(place as usize);
        let Some(number) = number else { return };
        let by = parameters.get(1).copied().map(bounded);
        let increment = self.settings.tropisms[number].elasticity_increment;
        let elasticity = &mut self.elasticities[number];
        if !self.stack.is_empty() {
            self.changed.push((number, *elasticity));
        }
        match change {
            Change::Up => *elasticity += by.unwrap_or(increment),
            Change::Down => *elasticity -= by.unwrap_or(increment),
            Change::Set => *elasticity = by.unwrap_or(0.0),
        }
    }

    /// The numbered tropisms turn H by |H × D|, at most 1 rad, towards D = Σ e (cos γ T + sin γ T × (H × T) / |H × T|),
    /// of the angle γ to T (cpfg).
    pub(super) fn bend_by_numbers(&mut self) {
        if self.elasticities.iter().all(|elasticity| *elasticity == 0.0) {
            return;
        }
        let frame = &mut self.state.frame;
        let (mut towards, mut rolls) = ([0.0; 3], [0.0; 3]);
        let felt = self.settings.tropisms.iter().zip(&self.elasticities).filter(|(_, elasticity)| **elasticity != 0.0);
        for (tropism, elasticity) in felt {
            if tropism.rolls {
                (0..3).for_each(|i| rolls[i] += elasticity * tropism.direction[i]);
                continue;
            }
            let (sin, cos) = sincos(tropism.angle_deg.to_radians());
            let torque = unit(cross(frame.heading, tropism.direction)).unwrap_or(frame.left);
            let across = cross(tropism.direction, torque);
            (0..3).for_each(|i| towards[i] += elasticity * (cos * tropism.direction[i] + sin * across[i]));
        }
        let torque = cross(frame.heading, towards);
        let size = dot(torque, torque).sqrt();
        frame.bend(towards, if size > 1.0 { 1.0 / size } else { 1.0 });
        roll(frame, rolls);
    }
}

/// The torques of cpfg: with R = Σ e T, of the length r, and P the part of R / r across H, the upper side of cpfg, −U,
/// turns about H towards P by r |P × U|, at most 1 rad. Where R lies along H nothing turns.
fn roll(frame: &mut Frame, towards: Vector) {
    let length = dot(towards, towards).sqrt();
    let Some(direction) = unit(towards) else { return };
    let along = dot(frame.heading, direction);
    if 1.0 - along * along <= 1e-8 {
        return;
    }
    let across = [0, 1, 2].map(|i| direction[i] - along * frame.heading[i]);
    let angle = -length * dot(cross(frame.up, across), frame.heading);
    let (sin, cos) = sincos(angle.clamp(-1.0, 1.0));
    frame.turn(Axis::Heading, sin, cos);
}
