//! The colours of components whose species states none: by kind, and by form where a kind has several forms.
//!
//! They are sRGB, chosen by eye after fresh plants in daylight, and are not data. Absent: the change of colours with
//! age and season (`colour`).

use phytomer_looks::FormName as Name;
use phytomer_sim::plant::{Class, Form, Kind};

/// Red, green and blue, 0 to 255.
pub type Rgb = [f32; 3];

/// The colours of an organ through its life.
#[derive(Debug, Clone, Copy)]
pub struct Tints {
    /// The colour at birth.
    pub young: Rgb,
    /// The colour in the middle of its life, for organs that turn twice.
    pub turning: Option<Rgb>,
    /// The colour at the end of its life.
    pub old: Rgb,
    /// The colour of a leaf before it falls with the season.
    pub autumn: Rgb,
    /// The colour of its stalk.
    pub stalk: Rgb,
}

const STALK: Rgb = [112.0, 132.0, 66.0];
const PETAL: Rgb = [250.0, 244.0, 236.0];
const GOLD: Rgb = [216.0, 164.0, 56.0];
const SEPAL: Rgb = [118.0, 152.0, 76.0];
const POLLEN: Rgb = [226.0, 190.0, 84.0];

/// The colours of an internode: shoot, young bark, old bark.
pub fn wood(kind: Kind) -> [Rgb; 3] {
    match kind {
        Kind::RhizomeInternode => [[216.0, 198.0, 160.0], [184.0, 158.0, 116.0], [140.0, 112.0, 82.0]],
        Kind::CulmInternode => [[122.0, 162.0, 74.0], [142.0, 166.0, 78.0], [182.0, 168.0, 98.0]],
        Kind::TillerInternode => [[132.0, 166.0, 82.0], [140.0, 160.0, 86.0], [172.0, 160.0, 104.0]],
        Kind::PalmInternode => [[128.0, 154.0, 78.0], [124.0, 144.0, 76.0], [148.0, 132.0, 88.0]],
        Kind::InflorescenceInternode | Kind::PedicelInternode | Kind::ReceptacleInternode => {
            [[138.0, 160.0, 88.0], [142.0, 152.0, 90.0], [142.0, 124.0, 84.0]]
        }
        Kind::LeafletInternode => [[104.0, 150.0, 62.0]; 3],
        Kind::SepalInternode => [SEPAL; 3],
        Kind::PetalInternode => [PETAL; 3],
        Kind::StamenInternode => [POLLEN; 3],
        Kind::StigmaInternode => [[186.0, 196.0, 110.0]; 3],
        _ => [[122.0, 134.0, 70.0], [128.0, 98.0, 68.0], [82.0, 66.0, 54.0]],
    }
}

/// The colours of an organ. An organ drawn with a mesh file has the colours of a form without colours of its own.
pub fn organ(kind: Kind, form: Form) -> Tints {
    let form = Name::of(form);
    match kind.class() {
        Class::Leaf => leaf(kind, form),
        Class::Fruit => fruit(kind, form),
        Class::Flower | Class::Internode | Class::Bud => flower(kind, form),
    }
}

fn even(young: Rgb, old: Rgb) -> Tints {
    Tints { young, turning: None, old, autumn: GOLD, stalk: STALK }
}

fn leaf(kind: Kind, form: Option<Name>) -> Tints {
    match kind {
        Kind::Bract => even([134.0, 160.0, 84.0], [150.0, 140.0, 84.0]),
        Kind::ScaleLeaf => even([196.0, 180.0, 132.0], [150.0, 122.0, 84.0]),
        Kind::Spine => even([150.0, 156.0, 84.0], [166.0, 146.0, 96.0]),
        Kind::Sepal => even(SEPAL, SEPAL),
        Kind::Petal | Kind::Tepal => even(PETAL, PETAL),
        Kind::Stamen => Tints { stalk: [236.0, 230.0, 204.0], ..even(POLLEN, [190.0, 150.0, 66.0]) },
        Kind::Stigma => even([196.0, 204.0, 116.0], [160.0, 150.0, 90.0]),
        _ => blade(form),
    }
}

fn blade(form: Option<Name>) -> Tints {
    match form {
        Some(Name::Needle | Name::Scale | Name::Spray | Name::Tuft) => {
            Tints { autumn: [206.0, 170.0, 78.0], ..even([74.0, 112.0, 66.0], [44.0, 78.0, 52.0]) }
        }
        Some(Name::Fascicle) => Tints { autumn: [206.0, 170.0, 78.0], ..even([96.0, 128.0, 82.0], [62.0, 94.0, 68.0]) },
        Some(Name::Palm | Name::Leaflet) => even([104.0, 144.0, 62.0], [86.0, 116.0, 54.0]),
        Some(Name::Deltoid) => even([122.0, 164.0, 66.0], [84.0, 130.0, 50.0]),
        Some(Name::Arching | Name::Linear) => even([126.0, 170.0, 74.0], [92.0, 136.0, 58.0]),
        Some(Name::Paddle) => even([136.0, 182.0, 72.0], [86.0, 138.0, 54.0]),
        Some(Name::Palmate) => Tints { autumn: [206.0, 92.0, 44.0], ..even([108.0, 160.0, 62.0], [62.0, 112.0, 46.0]) },
        _ => even([92.0, 148.0, 56.0], [46.0, 98.0, 42.0]),
    }
}

fn flower(kind: Kind, form: Option<Name>) -> Tints {
    match (kind, form) {
        (_, Some(Name::Cone)) => even([104.0, 118.0, 62.0], [104.0, 118.0, 62.0]),
        (_, Some(Name::Panicle)) => {
            Tints { stalk: [170.0, 140.0, 92.0], ..even([222.0, 206.0, 150.0], [196.0, 150.0, 104.0]) }
        }
        (_, Some(Name::Catkin)) => even([190.0, 188.0, 96.0], [176.0, 150.0, 88.0]),
        (Kind::Spikelet, _) | (_, Some(Name::Spikelet)) => even([154.0, 172.0, 104.0], [198.0, 180.0, 124.0]),
        (_, Some(Name::Rosette)) => Tints { stalk: [176.0, 178.0, 84.0], ..even(PETAL, PETAL) },
        (_, Some(Name::Stamen | Name::Pistil)) => even(POLLEN, POLLEN),
        _ => even(PETAL, PETAL),
    }
}

fn fruit(kind: Kind, form: Option<Name>) -> Tints {
    let three = |young, turning, old| Tints { turning: Some(turning), ..even(young, old) };
    match form {
        _ if kind == Kind::Strobilus || form == Some(Name::Cone) => even([104.0, 118.0, 62.0], [122.0, 84.0, 50.0]),
        Some(Name::Cherry) => three([128.0, 162.0, 66.0], [228.0, 150.0, 76.0], [150.0, 18.0, 34.0]),
        Some(Name::Apple) => three([128.0, 164.0, 70.0], [188.0, 176.0, 72.0], [194.0, 48.0, 42.0]),
        Some(Name::Capsule) => three([104.0, 142.0, 70.0], [130.0, 136.0, 78.0], [138.0, 106.0, 70.0]),
        Some(Name::Nut) => three([124.0, 150.0, 72.0], [152.0, 132.0, 70.0], [142.0, 96.0, 54.0]),
        Some(Name::Drupe) => three([132.0, 154.0, 62.0], [210.0, 160.0, 60.0], [142.0, 78.0, 40.0]),
        Some(Name::Finger) => three([98.0, 146.0, 58.0], [132.0, 164.0, 60.0], [230.0, 198.0, 60.0]),
        Some(Name::Pod) => three([112.0, 152.0, 70.0], [152.0, 150.0, 80.0], [122.0, 94.0, 60.0]),
        _ => three([116.0, 150.0, 58.0], [214.0, 158.0, 52.0], [186.0, 34.0, 38.0]),
    }
}
