//! Light and screen colours: the sRGB curve (IEC 61966-2-1), a curve for bright light, and the scale in which samples
//! are averaged.
//!
//! Samples of a pixel are averaged as the square roots of their light, which is nearly the scale of human vision: a
//! dark twig that covers half a pixel before a bright sky then looks half as dark, not a fifth.

use glam::Vec3;
use phytomer_sim::math::powf;
use std::sync::LazyLock;

const STEPS: usize = 4096;

static LIGHT: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|byte| decoded(byte as f32 / 255.0)));

static BYTES: LazyLock<[u8; STEPS]> = LazyLock::new(|| {
    std::array::from_fn(|step| {
        let root = step as f32 / (STEPS - 1) as f32;
        (encoded(root * root) * 255.0 + 0.5) as u8
    })
});

fn decoded(screen: f32) -> f32 {
    if screen <= 0.040_45 { screen / 12.92 } else { powf((screen + 0.055) / 1.055, 2.4) }
}

fn encoded(light: f32) -> f32 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * powf(light, 1.0 / 2.4) - 0.055 }
}

/// The light of a screen colour (sRGB).
#[inline]
pub fn light(colour: [u8; 3]) -> Vec3 {
    Vec3::from_array(colour.map(|byte| LIGHT[usize::from(byte)]))
}

/// The square roots of the light of a screen colour.
pub fn roots(colour: [u8; 3]) -> Vec3 {
    light(colour).map(f32::sqrt)
}

/// The screen colour of some light, from its square roots.
#[inline]
pub fn colour(roots: Vec3) -> [u8; 3] {
    roots.to_array().map(|root| BYTES[(root.clamp(0.0, 1.0) * (STEPS - 1) as f32 + 0.5) as usize])
}

/// The light of a scene as a screen shows it: nearly unchanged below the middle, never above 1 (the curve of Reinhard
/// et al. 2002 with a white at 2.4).
#[inline]
pub fn shown(light: Vec3) -> Vec3 {
    const WHITE: f32 = 2.4;
    let light = light.max(Vec3::ZERO) * 1.18;
    (light * (Vec3::ONE + light / (WHITE * WHITE)) / (Vec3::ONE + light)).min(Vec3::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_comes_back() {
        for byte in 0..=255 {
            assert_eq!(colour(roots([byte, 255 - byte, 7])), [byte, 255 - byte, 7]);
        }
    }

    #[test]
    fn light_is_shown_in_its_order() {
        let shown: Vec<f32> = (0..100).map(|k| shown(Vec3::splat(k as f32 * 0.03)).x).collect();
        assert!(shown.windows(2).all(|pair| pair[0] < pair[1] || pair[1] == 1.0));
        assert_eq!((shown[0], shown[99]), (0.0, 1.0));
    }
}
