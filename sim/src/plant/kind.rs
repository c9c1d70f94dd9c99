//! What a component is (the tag of de Reffye's record, 1988 §6), which form it is drawn with, and why it ended.
//!
//! The numbers of these lists are part of the tables and of the meshes: they may grow at their ends, never change.
//! Absent: how a form looks.

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
}

impl Kind {
    /// Every kind, in the order of their numbers.
    pub const ALL: [Self; 6] =
        [Self::Internode, Self::ShortInternode, Self::Leaf, Self::Flower, Self::Fruit, Self::ApicalBud];

    /// The tag as it stands in tables.
    pub const fn tag(self) -> &'static str {
        match self {
            Self::Internode => "internode",
            Self::ShortInternode => "short_internode",
            Self::Leaf => "leaf",
            Self::Flower => "flower",
            Self::Fruit => "fruit",
            Self::ApicalBud => "apical_bud",
        }
    }
}

/// The form in which an organ is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Form {
    /// A broad blade, widest in its middle.
    Elliptic = 0,
    /// A narrow blade, widest below its middle.
    Lanceolate = 1,
    /// A blade as broad as long, heart-shaped or triangular, as a poplar's.
    Deltoid = 2,
    /// A needle.
    Needle = 3,
    /// A pinnate palm leaf.
    Palm = 4,
    /// An open flower of five petals.
    Corolla = 5,
    /// A round fruit.
    Berry = 6,
    /// A cone, standing or hanging.
    Cone = 7,
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
