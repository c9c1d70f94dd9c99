//! Colours for amounts and for classes.
//!
//! Amounts run through a ramp that is perceptually even: lightness, chroma and hue in Oklab (Ottosson 2020, "A
//! perceptual color space for image processing"), from dark violet over blue and green to yellow, so that it also reads
//! in grey. Classes have the eight colours of Okabe & Ito 2008 ("Color Universal Design"), which people of every colour
//! vision can tell apart. Both are cited from memory.

use glam::Vec3;
use phytomer_sim::math::sincosf;
use std::f32::consts::PI;
use std::sync::LazyLock;

use super::tone;

/// The colour of a component without a value.
pub const NOTHING: [u8; 3] = [188, 184, 178];

/// Lightness, chroma and hue in degrees, evenly along the ramp.
const RAMP: [[f32; 3]; 6] = [
    [0.31, 0.135, 305.0],
    [0.43, 0.125, 275.0],
    [0.55, 0.095, 228.0],
    [0.67, 0.115, 172.0],
    [0.79, 0.155, 138.0],
    [0.92, 0.165, 105.0],
];

const CLASSES: [[u8; 3]; 8] = [
    [0, 114, 178],
    [230, 159, 0],
    [0, 158, 115],
    [213, 94, 0],
    [86, 180, 233],
    [204, 121, 167],
    [240, 228, 66],
    [96, 96, 96],
];

static STEPS: LazyLock<[[u8; 3]; 256]> = LazyLock::new(|| std::array::from_fn(|step| ramp(step as f32 / 255.0)));

/// The colour of an amount, by its share of the way from the smallest to the largest amount.
pub fn of_share(share: f64) -> [u8; 3] {
    STEPS[(share.clamp(0.0, 1.0) * 255.0 + 0.5) as usize]
}

/// The colour of a class; from the ninth class on the colours repeat.
pub fn of_class(class: usize) -> [u8; 3] {
    CLASSES[class % CLASSES.len()]
}

fn ramp(share: f32) -> [u8; 3] {
    let place = share * (RAMP.len() - 1) as f32;
    let first = (place as usize).min(RAMP.len() - 2);
    let part = place - first as f32;
    let [l, chroma, hue] = [0, 1, 2].map(|k| RAMP[first][k] + part * (RAMP[first + 1][k] - RAMP[first][k]));
    let (sin, cos) = sincosf(hue * PI / 180.0);
    tone::colour(from_oklab(l, chroma * cos, chroma * sin).max(Vec3::ZERO).map(f32::sqrt))
}

/// The linear light of a colour in Oklab (Ottosson 2020).
fn from_oklab(l: f32, a: f32, b: f32) -> Vec3 {
    let cubed = |x: f32| x * x * x;
    let long = cubed(l + 0.396_337_78 * a + 0.215_803_76 * b);
    let middle = cubed(l - 0.105_561_346 * a - 0.063_854_17 * b);
    let short = cubed(l - 0.089_484_18 * a - 1.291_485_5 * b);
    Vec3::new(
        4.076_741_7 * long - 3.307_711_6 * middle + 0.230_969_94 * short,
        -1.268_438 * long + 2.609_757_4 * middle - 0.341_319_4 * short,
        -0.004_196_086_3 * long - 0.703_418_6 * middle + 1.707_614_7 * short,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_grey_are_where_oklab_has_them() {
        for (l, light) in [(1.0, 1.0), (0.5, 0.125), (0.0, 0.0)] {
            assert!((from_oklab(l, 0.0, 0.0) - Vec3::splat(light)).abs().max_element() < 1e-5);
        }
    }

    #[test]
    fn the_ramp_climbs_in_lightness() {
        let luminance = |step: usize| tone::light(of_share(step as f64 / 255.0)).dot(Vec3::new(0.2126, 0.7152, 0.0722));
        assert!((0..255).all(|step| luminance(step) <= luminance(step + 1) + 2e-3));
        assert!(luminance(255) > 10.0 * luminance(0));
    }
}
