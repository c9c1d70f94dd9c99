//! Forms and kinds as a species file states them (de Reffye 1988 §6): what components are, and the form they are drawn
//! with.
//!
//! Absent: the forms themselves, which `phytomer_outputs::meshes` draws, the reading of a user's mesh, and colours.

use crate::fault::Path;
use phytomer_sim::plant::{Form, Kind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A form: one of the library by its name, or a mesh of the user's.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum FormChoice {
    /// One of the library (`phytomer list forms`).
    Named(FormName),
    /// A mesh of the user's.
    Own(OwnForm),
}

/// A mesh of the user's: it is moved and scaled into the unit box of forms, x from the base (0) to the tip (1), y
/// across.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnForm {
    /// The file of the mesh, PLY, OBJ or GLB, as seen from this file.
    #[schemars(length(min = 1))]
    pub mesh: String,
}

impl From<FormName> for FormChoice {
    fn from(name: FormName) -> Self {
        Self::Named(name)
    }
}

/// A form of the library by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FormName {
    /// A broad blade, widest in its middle.
    Elliptic,
    /// A narrow blade, widest below its middle.
    Lanceolate,
    /// A blade as broad as long, heart-shaped or triangular, as a poplar's.
    Deltoid,
    /// A needle.
    Needle,
    /// A pinnate palm leaf.
    Palm,
    /// An open flower of five petals.
    Corolla,
    /// A round fruit.
    Berry,
    /// A cone, standing or hanging.
    Cone,
    /// A blade widest above its middle, as an oak's or a frangipani's.
    Obovate,
    /// A heart-shaped blade on a long stalk, as a lime's.
    Cordate,
    /// A blade of three pointed lobes on a long stalk, as a maple's, a cotton's or a fig's.
    Palmate,
    /// A long narrow blade of even width, as a bamboo's.
    Linear,
    /// A long narrow blade that arches over, as a grass's.
    Arching,
    /// A great oblong blade that arches over, as a banana's.
    Paddle,
    /// A pleated fan on a long stalk, as a fan palm's or a ginkgo's.
    Fan,
    /// A leaf of nine leaflets, as an ash's or a walnut's.
    Pinnate,
    /// A leaflet of a palm: a narrow blade folded along its middle, on no stalk.
    Leaflet,
    /// A pair of needles, as a Scots pine's.
    Fascicle,
    /// A small pointed scale, hollow towards its stem.
    Scale,
    /// A petal: narrow below, broad and hollow above.
    Petal,
    /// A sepal: broad below, pointed above, hollow.
    Sepal,
    /// A filament with its anther.
    Stamen,
    /// A style with its stigma.
    Pistil,
    /// An open flower of five broad petals around its stamens, as a cherry's.
    Rosette,
    /// A catkin or a spike: a spindle of scales.
    Catkin,
    /// A spikelet of a grass.
    Spikelet,
    /// A round fruit on a long stalk.
    Cherry,
    /// A round fruit, hollow at both ends, on a short stalk.
    Apple,
    /// An egg-shaped capsule, as a cotton's boll.
    Capsule,
    /// A nut in its cup, as an acorn.
    Nut,
    /// A fruit longer than broad, as a date or a mango.
    Drupe,
    /// A curved fruit of five sides, as a banana.
    Finger,
    /// A flat pod.
    Pod,
    /// A rosette of needles on a short shoot, as a cedar's or a larch's.
    Tuft,
    /// A piece of shoot with a row of needles on either side, as a fir's or a yew's.
    Spray,
    /// A pyramid of small flowers on side branches, as a mango's.
    Panicle,
    /// Some five-petalled flowers on a dome of stalks, as a frangipani's.
    Cyme,
}

impl From<FormName> for Form {
    fn from(name: FormName) -> Self {
        Self::LIBRARY[name as usize]
    }
}

/// A kind by its tag (`phytomer list kinds`); each key allows those that can stand in its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum KindName {
    /// An internode of a long growth unit.
    Internode,
    /// A leaf.
    Leaf,
    /// A flower or an inflorescence.
    Flower,
    /// A fruit.
    Fruit,
    /// Of a shoot that creeps below ground.
    RhizomeInternode,
    /// Of the jointed stem of a grass or a bamboo.
    CulmInternode,
    /// Of a shoot of a grass that rises from the axil of a leaf at the ground.
    TillerInternode,
    /// Of the rachis of a palm or of another leaf that is drawn as an axis with its leaflets.
    PalmInternode,
    /// Of a leaflet that is drawn as an axis.
    LeafletInternode,
    /// Of the axis or a branch of an inflorescence or a bunch of fruits.
    InflorescenceInternode,
    /// Of the stalk of one flower.
    PedicelInternode,
    /// Of the end of the stalk that bears the parts of a flower.
    ReceptacleInternode,
    /// Of a sepal that is drawn as a growth unit.
    SepalInternode,
    /// Of a petal that is drawn as a growth unit.
    PetalInternode,
    /// Of a stamen that is drawn as a growth unit.
    StamenInternode,
    /// Of a style with its stigma that is drawn as a growth unit.
    StigmaInternode,
    /// A leaflet of a leaf that is drawn as an axis.
    Leaflet,
    /// A leaf that bears a flower or an inflorescence in its axil.
    Bract,
    /// A reduced leaf: of a rhizome, of a bud, the sheath of a young culm.
    ScaleLeaf,
    /// A leaf or a leaflet that is a spine.
    Spine,
    /// A sepal drawn whole.
    Sepal,
    /// A petal drawn whole.
    Petal,
    /// A petal or sepal of a flower that does not tell them apart.
    Tepal,
    /// A stamen drawn whole.
    Stamen,
    /// A style with its stigma drawn whole.
    Stigma,
    /// An inflorescence drawn as one: a catkin, a spike, a glomerule.
    Inflorescence,
    /// A spikelet of a grass.
    Spikelet,
    /// A bunch of fruits drawn as one.
    Infructescence,
    /// A cone of a conifer.
    Strobilus,
}

impl From<KindName> for Kind {
    fn from(name: KindName) -> Self {
        match name {
            KindName::Internode => Self::Internode,
            KindName::Leaf => Self::Leaf,
            KindName::Flower => Self::Flower,
            KindName::Fruit => Self::Fruit,
            KindName::RhizomeInternode => Self::RhizomeInternode,
            KindName::CulmInternode => Self::CulmInternode,
            KindName::TillerInternode => Self::TillerInternode,
            KindName::PalmInternode => Self::PalmInternode,
            KindName::LeafletInternode => Self::LeafletInternode,
            KindName::InflorescenceInternode => Self::InflorescenceInternode,
            KindName::PedicelInternode => Self::PedicelInternode,
            KindName::ReceptacleInternode => Self::ReceptacleInternode,
            KindName::SepalInternode => Self::SepalInternode,
            KindName::PetalInternode => Self::PetalInternode,
            KindName::StamenInternode => Self::StamenInternode,
            KindName::StigmaInternode => Self::StigmaInternode,
            KindName::Leaflet => Self::Leaflet,
            KindName::Bract => Self::Bract,
            KindName::ScaleLeaf => Self::ScaleLeaf,
            KindName::Spine => Self::Spine,
            KindName::Sepal => Self::Sepal,
            KindName::Petal => Self::Petal,
            KindName::Tepal => Self::Tepal,
            KindName::Stamen => Self::Stamen,
            KindName::Stigma => Self::Stigma,
            KindName::Inflorescence => Self::Inflorescence,
            KindName::Spikelet => Self::Spikelet,
            KindName::Infructescence => Self::Infructescence,
            KindName::Strobilus => Self::Strobilus,
        }
    }
}

impl KindName {
    pub(super) fn is_leaf(&self) -> bool {
        *self == Self::Leaf
    }

    pub(super) fn is_flower(&self) -> bool {
        *self == Self::Flower
    }

    pub(super) fn is_fruit(&self) -> bool {
        *self == Self::Fruit
    }
}

/// One thing for all axes of an order, or one for each state in which they can start.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ByState<T> {
    /// The same for all.
    All(T),
    /// One for each state of the species, every state named once.
    Each(EachState<T>),
}

/// One thing for each state of the species.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EachState<T> {
    /// By the name of the state.
    pub by_state: BTreeMap<String, T>,
}

impl<T> ByState<T> {
    /// All that is stated, each with its place.
    pub(in crate::buds) fn places(&self, path: &Path) -> Vec<(Path, &T)> {
        let below = path.key("by_state");
        match self {
            Self::All(one) => vec![(path.clone(), one)],
            Self::Each(each) => each.by_state.iter().map(|(state, one)| (below.key(state), one)).collect(),
        }
    }
}

impl ByState<KindName> {
    pub(super) fn is_plain_kind(&self) -> bool {
        *self == Self::All(KindName::Internode)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, StrDeserializer};

    fn read<T: for<'a> Deserialize<'a>>(word: &str) -> T {
        let deserializer: StrDeserializer<'_, Error> = word.into_deserializer();
        T::deserialize(deserializer).unwrap_or_else(|error| panic!("{word}: {error}"))
    }

    #[test]
    fn the_names_of_files_are_those_of_the_plant() {
        for form in Form::LIBRARY {
            assert_eq!(Form::from(read::<FormName>(form.name().expect("a name"))), form);
        }
        for kind in Kind::ALL.into_iter().filter(|kind| !matches!(kind, Kind::ShortInternode | Kind::ApicalBud)) {
            assert_eq!(Kind::from(read::<KindName>(kind.tag())), kind);
        }
    }
}
