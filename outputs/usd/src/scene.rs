//! A landscape as text (`.usda`): a point instancer for each species, of which each variant is a file of its own.
//!
//! Lists are written as they come, and the instances are asked for anew for each list, so that memory holds none of
//! them. Absent: where plants stand, which the caller knows, and the files of the variants.

use super::layer::{Attribute, Header, Layer};
use super::text::{Text, Tuple, Turn};
use half::f16;
use phytomer_sim::math;
use std::fmt::Display;
use std::io::{self, Write};

/// The instances of one species.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stand {
    /// The name of its prim, of which what is no name in USD becomes `_`.
    pub name: String,
    /// The file of each variant, seen from that of the scene.
    pub files: Vec<String>,
}

/// An instance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planted {
    /// Its variant.
    pub variant: u32,
    /// Where it stands, metres.
    pub place_m: [f32; 3],
    /// Its turn about the vertical, radians.
    pub turn_rad: f64,
    /// Its size over that of its variant.
    pub scale: f32,
}

/// Takes an instance.
pub type Take<'a> = dyn FnMut(Planted) -> io::Result<()> + 'a;

/// Hands on the instances of a stand, by its place; the same ones each time that it is asked.
pub type Each<'a> = dyn FnMut(usize, &mut Take) -> io::Result<()> + 'a;

const ROOT: &str = "forest";
const VARIANTS: &str = "variants";

/// Writes the scene of some stands; `words` is what it says of itself.
///
/// # Errors
/// Those of `out` and of `each`.
pub fn write_scene(out: impl Write, words: &str, stands: &[Stand], each: &mut Each) -> io::Result<()> {
    let header = Header { root: ROOT.to_owned(), words: words.to_owned(), time: None };
    let mut text = Text::begin(out, &header)?;
    text.begin("Xform", ROOT, &[])?;
    let names = names(stands);
    for (number, (stand, name)) in stands.iter().zip(&names).enumerate() {
        write_stand(&mut text, stand, name, &mut |take| each(number, take))?;
    }
    text.end()?;
    text.finish()
}

/// Hands on all instances of a stand.
type EachOfStand<'a> = dyn FnMut(&mut Take) -> io::Result<()> + 'a;

fn write_stand<W: Write>(text: &mut Text<W>, stand: &Stand, name: &str, each: &mut EachOfStand) -> io::Result<()> {
    text.begin("PointInstancer", name, &[])?;
    list(text, &Attribute::new("protoIndices", "int[]"), each, |planted| planted.variant)?;
    list(text, &Attribute::new("positions", "point3f[]"), each, |planted| Tuple(planted.place_m))?;
    list(text, &Attribute::new("orientations", "quath[]"), each, |planted| turn(planted.turn_rad))?;
    list(text, &Attribute::new("scales", "float3[]"), each, |planted| Tuple([planted.scale; 3]))?;
    let variant = |number: usize| format!("variant_{number}");
    let paths = (0..stand.files.len()).map(|number| format!("/{ROOT}/{name}/{VARIANTS}/{}", variant(number)));
    text.relationship("prototypes", &paths.collect::<Vec<_>>())?;
    text.begin("Scope", VARIANTS, &[])?;
    for (number, file) in stand.files.iter().enumerate() {
        text.refer(&variant(number), file)?;
    }
    text.end()?;
    text.end()
}

fn list<W: Write, T: Display>(
    text: &mut Text<W>,
    attribute: &Attribute,
    each: &mut EachOfStand,
    value: impl Fn(Planted) -> T,
) -> io::Result<()> {
    text.listed(attribute, |put| each(&mut |planted| put(&value(planted))))
}

/// The rotation about the vertical.
fn turn(radians: f64) -> Turn {
    let (sin, cos) = (math::sin(radians / 2.0), math::cos(radians / 2.0));
    let bits = |number: f64| f16::from_f64(number).to_bits();
    Turn([bits(cos), bits(0.0), bits(0.0), bits(sin)])
}

/// A name of a prim for each stand, each of its own.
fn names(stands: &[Stand]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for stand in stands {
        let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let plain: String = stand.name.chars().map(letter).collect();
        let plain = if plain.starts_with(|c: char| c.is_ascii_alphabetic()) { plain } else { format!("plant_{plain}") };
        let other = |number: usize| if number == 0 { plain.clone() } else { format!("{plain}_{number}") };
        let name = (0..).map(other).find(|name| !names.contains(name));
        names.extend(name);
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stand_is_a_point_instancer_of_references() {
        let stands = [
            Stand {
                name: "wp/aspen".to_owned(),
                files: vec!["meshes/a-0.usdc".to_owned(), "meshes/a-1.usdc".to_owned()],
            },
            Stand { name: "wp_aspen".to_owned(), files: vec!["b.usdc".to_owned()] },
            Stand { name: "1".to_owned(), files: vec!["c.usdc".to_owned()] },
        ];
        let quarter = std::f64::consts::FRAC_PI_2;
        let planted = Planted { variant: 1, place_m: [1.5, -2.0, 0.25], turn_rad: quarter, scale: 0.9 };
        let mut out = Vec::new();
        write_scene(&mut out, "a wood", &stands, &mut |stand, take| {
            (0..[2, 1, 0][stand]).try_for_each(|number| take(Planted { variant: number, ..planted }))
        })
        .unwrap();
        let text = String::from_utf8(out).unwrap();
        for line in [
            "    doc = \"a wood\"",
            "    def PointInstancer \"wp_aspen\"",
            "        int[] protoIndices = [0, 1]",
            "        point3f[] positions = [(1.5, -2, 0.25), (1.5, -2, 0.25)]",
            "        quath[] orientations = [(0.70703125, 0, 0, 0.70703125), (0.70703125, 0, 0, 0.70703125)]",
            "        float3[] scales = [(0.9, 0.9, 0.9), (0.9, 0.9, 0.9)]",
            "        rel prototypes = [</forest/wp_aspen/variants/variant_0>, </forest/wp_aspen/variants/variant_1>]",
            "                prepend references = @meshes/a-1.usdc@",
            "    def PointInstancer \"wp_aspen_1\"",
            "    def PointInstancer \"plant_1\"",
            "        int[] protoIndices = []",
        ] {
            assert!(text.lines().any(|found| found == line), "{line}\n{text}");
        }
        assert_eq!(text.matches('{').count(), text.matches('}').count());
    }
}
