//! The steps in which laws know what is measured of a plant and its buds: a table has a cell for each step.
//!
//! Absent: variables that are counted, which are whole numbers themselves.

/// The steps in which laws know the height of a plant, metres: a table has a cell for each.
pub const HEIGHT_STEP: f64 = 0.05;
/// The greatest height that laws know, metres; the tallest tree known, the coast redwood Hyperion, has 116 m.
pub(super) const MOST_HEIGHT: u32 = 125;

/// The last step that a height has reached, but for rounding.
pub fn height_in_steps(metres: f64) -> u32 {
    // The cast saturates, and takes 0 where there is no number.
    (metres / HEIGHT_STEP + 1e-3).floor() as u32
}

/// The steps in which laws know the share of light that a bud has.
pub const LIGHT_STEP: f64 = 0.01;
/// The steps from full light to none.
pub const SHADE_STEPS: u32 = 100;

/// What a share of light lacks of full light, in steps, to the nearest.
pub fn shade_in_steps(light: f64) -> u32 {
    // The cast saturates, and takes full light where there is no number.
    (((1.0 - light) / LIGHT_STEP).round() as u32).min(SHADE_STEPS)
}
