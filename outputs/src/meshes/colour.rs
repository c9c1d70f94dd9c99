//! The colour of each component: one to a form, as in de Reffye 1988 §6, shifted by age.
//!
//! Wood goes from the green of the shoot to brown and darkens; dead wood turns grey. Leaves darken as they grow old,
//! fruits ripen from green by yellow to red over their life. The tints are by eye; nothing is measured from them.

use phytomer_sim::clock::NEVER;
use phytomer_sim::plant::{Form, Kind};

type Rgb = [f32; 3];

const SHOOT: Rgb = [122.0, 134.0, 70.0];
const YOUNG_BARK: Rgb = [128.0, 98.0, 68.0];
const OLD_BARK: Rgb = [82.0, 66.0, 54.0];
const DEAD_WOOD: Rgb = [150.0, 145.0, 138.0];
const PETAL: Rgb = [250.0, 244.0, 236.0];
const GREEN_FRUIT: Rgb = [116.0, 150.0, 58.0];
const TURNING_FRUIT: Rgb = [214.0, 158.0, 52.0];
const RIPE_FRUIT: Rgb = [186.0, 34.0, 38.0];
const GREEN_CONE: Rgb = [104.0, 118.0, 62.0];
const RIPE_CONE: Rgb = [122.0, 84.0, 50.0];
const STALK: Rgb = [112.0, 132.0, 66.0];

/// The ticks in which a shoot turns halfway to young bark, and young bark halfway to old.
const BARK_FORMS: f32 = 2.0;
const BARK_DARKENS: f32 = 20.0;

/// The colour of an internode that is `old` ticks old.
#[inline]
pub fn wood(old: f32, dead: bool) -> [u8; 4] {
    let bark = mixed(YOUNG_BARK, OLD_BARK, old / (old + BARK_DARKENS));
    let wood = mixed(SHOOT, bark, old / (old + BARK_FORMS));
    opaque(if dead { mixed(wood, DEAD_WOOD, 0.7) } else { wood })
}

/// The colours of an organ and of its stalk, `age` ticks after the seed.
#[inline]
pub fn organ(kind: Kind, form: Form, birth: u32, death: u32, age: u32) -> [[u8; 4]; 2] {
    let old = age.saturating_sub(birth) as f32;
    let lived = if death == NEVER { old / (old + 4.0) } else { old / (death.saturating_sub(birth).max(1) as f32) };
    let blade = match kind {
        Kind::Leaf => leaf(form, lived),
        Kind::Fruit if form == Form::Cone => mixed(GREEN_CONE, RIPE_CONE, lived),
        Kind::Fruit if lived < 0.5 => mixed(GREEN_FRUIT, TURNING_FRUIT, 2.0 * lived),
        Kind::Fruit => mixed(TURNING_FRUIT, RIPE_FRUIT, 2.0 * lived - 1.0),
        _ if form == Form::Cone => GREEN_CONE,
        _ => PETAL,
    };
    [opaque(blade), opaque(STALK)]
}

fn leaf(form: Form, lived: f32) -> Rgb {
    let (fresh, old) = match form {
        Form::Needle => ([74.0, 112.0, 66.0], [44.0, 78.0, 52.0]),
        Form::Palm => ([104.0, 144.0, 62.0], [86.0, 116.0, 54.0]),
        Form::Deltoid => ([122.0, 164.0, 66.0], [84.0, 130.0, 50.0]),
        _ => ([92.0, 148.0, 56.0], [46.0, 98.0, 42.0]),
    };
    mixed(fresh, old, lived)
}

fn mixed(a: Rgb, b: Rgb, share: f32) -> Rgb {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * share)
}

fn opaque(colour: Rgb) -> [u8; 4] {
    let [r, g, b] = colour.map(|x| (x + 0.5) as u8);
    [r, g, b, 255]
}
