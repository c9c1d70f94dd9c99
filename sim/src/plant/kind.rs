//! What a component is (the tag of de Reffye's record, 1988 §6), and why it ended.
//!
//! The paper's tags are internodes, leaves, flowers and fruits, and, where the simulation is enlarged (§5), rhizome,
//! palm, petal and sepal internodes. The numbers of these lists are part of the tables and of the meshes: they may grow
//! at their ends, never change. Absent: forms (`form`), and how a kind looks.

/// The tag of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Kind {
    /// An internode of a long growth unit.
    Internode = 0,
    /// An internode of a short growth unit.
    ShortInternode = 1,
    /// A leaf.
    Leaf = 2,
    /// A flower or an inflorescence.
    Flower = 3,
    /// A fruit.
    Fruit = 4,
    /// The bud at the tip of an axis, growing or waiting.
    ApicalBud = 5,
    /// Of a shoot that creeps below ground.
    RhizomeInternode = 6,
    /// Of the jointed stem of a grass or a bamboo.
    CulmInternode = 7,
    /// Of a shoot of a grass that rises from the axil of a leaf at the ground.
    TillerInternode = 8,
    /// Of the rachis of a palm or of another leaf that is drawn as an axis with its leaflets.
    PalmInternode = 9,
    /// Of a leaflet that is drawn as an axis.
    LeafletInternode = 10,
    /// Of the axis or a branch of an inflorescence or a bunch of fruits.
    InflorescenceInternode = 11,
    /// Of the stalk of one flower.
    PedicelInternode = 12,
    /// Of the end of the stalk that bears the parts of a flower.
    ReceptacleInternode = 13,
    /// Of a sepal that is drawn as a growth unit.
    SepalInternode = 14,
    /// Of a petal that is drawn as a growth unit.
    PetalInternode = 15,
    /// Of a stamen that is drawn as a growth unit.
    StamenInternode = 16,
    /// Of a style with its stigma that is drawn as a growth unit.
    StigmaInternode = 17,
    /// A leaflet of a leaf that is drawn as an axis.
    Leaflet = 18,
    /// A leaf that bears a flower or an inflorescence in its axil.
    Bract = 19,
    /// A reduced leaf: of a rhizome, of a bud, the sheath of a young culm.
    ScaleLeaf = 20,
    /// A leaf or a leaflet that is a spine.
    Spine = 21,
    /// A sepal drawn whole.
    Sepal = 22,
    /// A petal drawn whole.
    Petal = 23,
    /// A petal or sepal of a flower that does not tell them apart.
    Tepal = 24,
    /// A stamen drawn whole.
    Stamen = 25,
    /// A style with its stigma drawn whole.
    Stigma = 26,
    /// An inflorescence drawn as one: a catkin, a spike, a glomerule.
    Inflorescence = 27,
    /// A spikelet of a grass.
    Spikelet = 28,
    /// A bunch of fruits drawn as one.
    Infructescence = 29,
    /// A cone of a conifer.
    Strobilus = 30,
}

/// What a kind stands among: where a component of it may stand, and with which it is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Internodes, whatever they are a part of; their tags end in `internode`.
    Internode,
    /// What a node bears as a leaf: leaves and leaflets, bracts and scales, the parts of a flower.
    Leaf,
    /// What opens as a flower: flowers and inflorescences drawn as one.
    Flower,
    /// What ripens from it.
    Fruit,
    /// Buds.
    Bud,
}

impl Kind {
    /// Every kind, in the order of their numbers.
    pub const ALL: [Self; 31] = [
        Self::Internode,
        Self::ShortInternode,
        Self::Leaf,
        Self::Flower,
        Self::Fruit,
        Self::ApicalBud,
        Self::RhizomeInternode,
        Self::CulmInternode,
        Self::TillerInternode,
        Self::PalmInternode,
        Self::LeafletInternode,
        Self::InflorescenceInternode,
        Self::PedicelInternode,
        Self::ReceptacleInternode,
        Self::SepalInternode,
        Self::PetalInternode,
        Self::StamenInternode,
        Self::StigmaInternode,
        Self::Leaflet,
        Self::Bract,
        Self::ScaleLeaf,
        Self::Spine,
        Self::Sepal,
        Self::Petal,
        Self::Tepal,
        Self::Stamen,
        Self::Stigma,
        Self::Inflorescence,
        Self::Spikelet,
        Self::Infructescence,
        Self::Strobilus,
    ];

    /// The tag as it stands in tables.
    pub const fn tag(self) -> &'static str {
        match self {
            Self::Internode => "internode",
            Self::ShortInternode => "short_internode",
            Self::Leaf => "leaf",
            Self::Flower => "flower",
            Self::Fruit => "fruit",
            Self::ApicalBud => "apical_bud",
            Self::RhizomeInternode => "rhizome_internode",
            Self::CulmInternode => "culm_internode",
            Self::TillerInternode => "tiller_internode",
            Self::PalmInternode => "palm_internode",
            Self::LeafletInternode => "leaflet_internode",
            Self::InflorescenceInternode => "inflorescence_internode",
            Self::PedicelInternode => "pedicel_internode",
            Self::ReceptacleInternode => "receptacle_internode",
            Self::SepalInternode => "sepal_internode",
            Self::PetalInternode => "petal_internode",
            Self::StamenInternode => "stamen_internode",
            Self::StigmaInternode => "stigma_internode",
            Self::Leaflet => "leaflet",
            Self::Bract => "bract",
            Self::ScaleLeaf => "scale_leaf",
            Self::Spine => "spine",
            Self::Sepal => "sepal",
            Self::Petal => "petal",
            Self::Tepal => "tepal",
            Self::Stamen => "stamen",
            Self::Stigma => "stigma",
            Self::Inflorescence => "inflorescence",
            Self::Spikelet => "spikelet",
            Self::Infructescence => "infructescence",
            Self::Strobilus => "strobilus",
        }
    }

    /// The kind of a tag.
    pub fn of_tag(tag: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.tag() == tag)
    }

    /// What it stands among.
    pub const fn class(self) -> Class {
        match self {
            Self::Internode
            | Self::ShortInternode
            | Self::RhizomeInternode
            | Self::CulmInternode
            | Self::TillerInternode
            | Self::PalmInternode
            | Self::LeafletInternode
            | Self::InflorescenceInternode
            | Self::PedicelInternode
            | Self::ReceptacleInternode
            | Self::SepalInternode
            | Self::PetalInternode
            | Self::StamenInternode
            | Self::StigmaInternode => Class::Internode,
            Self::Leaf
            | Self::Leaflet
            | Self::Bract
            | Self::ScaleLeaf
            | Self::Spine
            | Self::Sepal
            | Self::Petal
            | Self::Tepal
            | Self::Stamen
            | Self::Stigma => Class::Leaf,
            Self::Flower | Self::Inflorescence | Self::Spikelet => Class::Flower,
            Self::Fruit | Self::Infructescence | Self::Strobilus => Class::Fruit,
            Self::ApicalBud => Class::Bud,
        }
    }

    /// Whether it is a green blade: its area is leaf area, and a pipe of wood leads to it.
    pub const fn is_foliage(self) -> bool {
        matches!(self, Self::Leaf | Self::Leaflet)
    }
}

/// Why a component ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Cause {
    /// It lives.
    None = 0,
    /// The mortality test of its bud.
    Mortality = 1,
    /// The bud became a flower.
    Flowered = 2,
    /// The axis made all the growth units that it makes.
    Completed = 3,
    /// Its life length was over.
    LifeLength = 4,
    /// The season of its fall came.
    Season = 5,
    /// Every bud of its branch was dead.
    Branch = 6,
    /// The flower set fruit.
    FruitSet = 7,
    /// Something from outside killed it.
    Killed = 8,
    /// It was cut off.
    Pruned = 9,
}

impl Cause {
    /// Every cause of an end, in the order of their numbers.
    pub const ALL: [Self; 9] = [
        Self::Mortality,
        Self::Flowered,
        Self::Completed,
        Self::LifeLength,
        Self::Season,
        Self::Branch,
        Self::FruitSet,
        Self::Killed,
        Self::Pruned,
    ];

    /// The cause as it stands in tables; `None` for a living component.
    pub const fn tag(self) -> Option<&'static str> {
        Some(match self {
            Self::None => return None,
            Self::Mortality => "mortality",
            Self::Flowered => "flowered",
            Self::Completed => "completed",
            Self::LifeLength => "life_length",
            Self::Season => "season",
            Self::Branch => "branch",
            Self::FruitSet => "fruit_set",
            Self::Killed => "killed",
            Self::Pruned => "pruned",
        })
    }
}
