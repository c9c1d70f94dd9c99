//! A species with pictures of its own, its scenarios, and the pictures, made anew for each test.

#![allow(dead_code, reason = "each test program uses a part of it")]

use super::program::write;
use std::fs;

pub const SPECIES: &str = r#"name = "painted"
inherits = "coffee"

[[material]]
of = "bark"
texture = "pictures/bark.png"
normal = "pictures/relief.png"
width_m = 0.05

[[material]]
of = "leaf"
texture = "pictures/leaf.png"
"#;

/// Bark of its own on the trunk, and leaves of their own on branches.
pub const BY_ORDER: &str = r#"
[[material]]
of = "bark"
order = 1
texture = "pictures/trunk.png"
width_m = 0.1

[[material]]
of = "leaf"
order = 2
texture = "pictures/twig_leaf.png"
normal = "pictures/relief.png"
"#;

pub const SCENARIO: &str = r#"name = "painted"
species = "painted.toml"
plants = 2
spacing_m = 2
seed = 5
ages = { until = 16 }
"#;

/// A plot of two species, of which one is painted.
pub const PLOT: &str = r#"name = "plot"
species = "painted.toml"
plants = 3
seed = 5
ages = { until = 12 }
member = [{ at_m = [-1, 0] }, { at_m = [1, 0.5] }, { species = "other.toml", at_m = [0, -1] }]

[[site.obstacle]]
shape = { form = "box", at_m = [0, 1.5, 0], size_m = [0.5, 0.5, 0.4] }
"#;

/// A picture of squares, of so many pixels; with a fourth colour it is clear at its corners.
pub fn picture([wide, high]: [u32; 2], colour: png::ColorType) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, wide, high);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    let pixel = |k: u32| {
        let (x, y) = (k % wide, k / wide);
        let light = if (x / 4 + y / 4).is_multiple_of(2) { 200 } else { 120 };
        let clear = [x, y] == [0, 0] || [x, y] == [wide - 1, high - 1];
        [light, light - 40, 60, if clear { 0 } else { 255 }]
    };
    let data: Vec<u8> = (0..wide * high).flat_map(|k| pixel(k).into_iter().take(colour.samples())).collect();
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&data).expect("its data");
    writer.finish().expect("its end");
    bytes
}

/// A folder with the species, its pictures and its scenarios.
pub fn painted(more: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::create_dir(folder.path().join("pictures")).expect("a folder");
    for (name, size, colour) in [
        ("bark", [32, 16], png::ColorType::Rgb),
        ("relief", [16, 8], png::ColorType::Rgb),
        ("leaf", [20, 24], png::ColorType::Rgba),
        ("trunk", [64, 64], png::ColorType::Rgb),
        ("twig_leaf", [12, 10], png::ColorType::Rgb),
    ] {
        fs::write(folder.path().join(format!("pictures/{name}.png")), picture(size, colour)).expect("a picture");
    }
    write(folder.path(), "painted.toml", &format!("{SPECIES}{more}"));
    write(folder.path(), "other.toml", "name = \"other\"\ninherits = \"painted.toml\"\nmaterial = []\n");
    write(folder.path(), "scenario.toml", SCENARIO);
    write(folder.path(), "plot.toml", PLOT);
    folder
}
