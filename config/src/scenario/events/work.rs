//! The operations of events: their words in files, what they choose among, and the keys that belong to each.
//!
//! Absent: the keys themselves, which are those of an event, and what an operation does.

use phytomer_sim::management::Thing;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is done to plants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Work {
    /// Axes are shortened.
    Heading,
    /// Branches are taken off where they arise.
    Thinning,
    /// Everything above a height is taken.
    Topping,
    /// Everything beyond planes, outside a box, or outside a shape, is taken.
    Hedging,
    /// The trunk, and every other axis of its order, is cut above a height or above a node.
    Stumping,
    /// Whole plants are taken.
    Removal,
    /// Fruits are picked so that the others have more.
    FruitThinning,
    /// Ripe fruits are picked, or everything above a height is taken.
    Harvest,
    /// Branches are bent to an angle or in a direction, by spreaders, ties or weights.
    Bending,
    /// The trunk is tied to a stake: straight and upright up to a height.
    Staking,
    /// Branches are tied along horizontal wires.
    Tying,
    /// Successors are planted where plants are dead, were taken or did not germinate.
    Replanting,
}

/// The keys of an operation beside those of its times and its plants.
pub(super) struct Keys {
    /// Of these it asks for exactly one; for none where the list is empty.
    pub one: &'static [&'static str],
    /// Of these it asks for at least one.
    pub some: &'static [&'static str],
    /// These are allowed.
    pub also: &'static [&'static str],
}

impl Keys {
    /// Every key that has an effect.
    pub fn all(&self) -> impl Iterator<Item = &'static str> {
        [self.one, self.some, self.also].into_iter().flatten().copied()
    }
}

impl Work {
    /// The word in files.
    pub(super) const fn word(self) -> &'static str {
        match self {
            Self::Heading => "heading",
            Self::Thinning => "thinning",
            Self::Topping => "topping",
            Self::Hedging => "hedging",
            Self::Stumping => "stumping",
            Self::Removal => "removal",
            Self::FruitThinning => "fruit_thinning",
            Self::Harvest => "harvest",
            Self::Bending => "bending",
            Self::Staking => "staking",
            Self::Tying => "tying",
            Self::Replanting => "replanting",
        }
    }

    /// What its conditions choose among.
    pub(super) const fn thing(self) -> Thing {
        match self {
            Self::FruitThinning | Self::Harvest => Thing::Fruit,
            Self::Removal | Self::Replanting => Thing::Plant,
            _ => Thing::Wood,
        }
    }

    /// Whether it trains wood.
    pub(super) const fn trains(self) -> bool {
        matches!(self, Self::Bending | Self::Staking | Self::Tying)
    }

    /// Whether it takes wood, so that plants grow otherwise than by their laws alone.
    pub(super) const fn cuts(self) -> bool {
        !matches!(self, Self::FruitThinning | Self::Harvest | Self::Replanting) && !self.trains()
    }

    /// Its keys.
    pub(super) const fn keys(self) -> Keys {
        const CHOICE: &[&str] = &["only", "protect", "first", "share", "at_most"];
        const TRAINED: &[&str] = &["only", "protect", "first", "share", "at_most", "stays"];
        const TIED: &[&str] = &["only", "protect", "first", "share", "at_most", "azimuth_deg", "stays"];
        const PICKED: &[&str] = &[
            "only",
            "protect",
            "first",
            "share",
            "at_most",
            "ripe_share",
            "harvest_cut_height",
            "harvest_operations_date",
        ];
        let (one, some, also): (&[&str], &[&str], &[&str]) = match self {
            Self::Heading => (&["keep_nodes", "keep_share", "keep_length_m"], &[], CHOICE),
            Self::Thinning | Self::FruitThinning => (&[], &[], CHOICE),
            Self::Topping => (&["height_m"], &[], CHOICE),
            Self::Hedging => (&["planes", "box_m", "shape"], &[], CHOICE),
            Self::Stumping => (&["height_m", "keep_nodes"], &[], &["protect"]),
            Self::Removal => (&[], &[], &["protect", "first", "share", "at_most"]),
            Self::Harvest => (&[], &[], PICKED),
            Self::Bending => (&[], &["angle_deg", "azimuth_deg"], TRAINED),
            Self::Staking => (&["height_m"], &[], &["stays"]),
            Self::Tying => (&["wires_m"], &[], TIED),
            Self::Replanting => (&[], &[], &[]),
        };
        Keys { one, some, also }
    }
}
