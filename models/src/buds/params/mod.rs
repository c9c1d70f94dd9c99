//! The parameters of the bud model as a species file states them (de Reffye 1988 §4, the list of parameters).
//!
//! There is one [`Order`] for each order of axes, the trunk first; every probability is a [`Law`] of state and the
//! variables of [`crate::law`], every number of things a [`Count`], every measure a [`Variate`], every speed one of
//! [`Speeds`], and a number for a whole species a [`Quantity`] or a [`Constant`]; so each may be bare or state its
//! source. A species without states, reiteration and relays reads as in 1988. Axes of an order past the last are never
//! made.
//!
//! Absent on purpose: the effects of the parameters, which are in `compile` and `grow`.

pub(crate) mod colour;
mod contact;
mod geometry;
mod looks;
mod near;
mod organs;
mod response;
mod sympodial;
mod wood;

pub use colour::{
    BarkChoice, BarkColours, ColourText, FlowerChoice, FlowerColours, FruitChoice, FruitColours, LeafChoice,
    LeafColours,
};
pub use contact::{Answer, Contact};
pub use geometry::{
    Divergence, Internode, NamedPhyllotaxis, Orientation, Phase, Phyllotaxis, ShapeName, StateTrends, Tended, Trend,
};
pub use looks::{ByState, EachState, FormChoice, KindName, OwnForm};
pub use organs::{Facing, Flower, Fruit, Leaf, OrganTrend, Season};
pub use response::{Response, Target};
pub use sympodial::{Apex, ApexEnd, Fork, Reiteration, Relay, Sibling, Transition, Traumatic};
pub use wood::{CountedLeaves, DragLaw, OrderWood, ThickeningRule, UprightingLaw, Wood};

pub use phytomer_looks::FormName;

pub use crate::law::{Constant, Quantity, SpeedForm, SpeedText, Speeds};

use crate::law::{Count, Law, Variate};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A species of the bud model.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Buds {
    /// The physiological states that an axis can be in (juvenile, adult; long shoot, short shoot), the first one that
    /// of the seed's axis. Left out: one state, as in 1988.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub states: Vec<String>,
    /// When leaves fall together, whatever their age.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub season: Option<Season>,
    /// The wood: secondary growth, weight and bending; left out: laws of age, and the pose at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wood: Option<Wood>,
    /// What buds do where they meet an obstacle that blocks, or the ground; left out: they turn along it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<Contact>,
    /// How the buds respond to what the site and its seasons bring, such as nitrogen; in the order in which they act.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub response: Vec<Response>,
    /// The axes of each order: the first entry is the trunk. Axes of an order past the last are never made.
    #[schemars(length(min = 1, max = 16))]
    pub order: Vec<Order>,
}

/// The axes of one order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Order {
    /// Clock steps per tick, as an exact ratio: 1, 0.5, "2/3"; or several, of which each axis draws one at its birth.
    /// In de Reffye's Fig. 14 the growth ratio r of order 1 over order 2 is 1/speed of order 2.
    pub speed: Speeds,
    /// The probability that a living apical bud dies at a clock step. Tested first.
    pub death: Law,
    /// The probability that a living apical bud makes a pause (a break) at a clock step. Tested second.
    pub pause: Law,
    /// What a bud makes at a step at which it neither dies nor pauses.
    pub growth_unit: GrowthUnit,
    /// Standard axillary buds: axes of the next order.
    pub axillary: Axillary,
    /// Adaptive reiteration: buds that make a young tree on the old one.
    pub reiteration: Reiteration,
    /// Traumatic reiteration: what the loss of an apex releases.
    pub traumatic: Traumatic,
    /// How an apex comes to its end other than by death.
    pub apex: Apex,
    /// Sympodial growth: axes of the same order that take the place of an ended apex.
    pub relay: Relay,
    /// Passages between the states, tested after each step at which the bud grew; at most one a step.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub transition: Vec<Transition>,
    /// Length and diameter of internodes.
    pub internode: Internode,
    /// The insertion angle with the bearing axis, degrees; for order 1 with the vertical. Its laws are evaluated at the
    /// bearing node: age, dimension, cycle, rank and state are those of the bearing axis there.
    pub insertion_deg: Variate,
    /// How leaves and axillary buds turn around the axis from node to node.
    pub phyllotaxis: Phyllotaxis,
    /// The direction that the axis tends to.
    pub trend: Trend,
    /// Leaves.
    pub leaf: Leaf,
    /// Flowers, terminal or lateral.
    pub flower: Flower,
    /// Fruits, from flowers that set.
    pub fruit: Fruit,
    /// The wood of this order, where it differs from that of the species, and how its axes right themselves.
    #[serde(skip_serializing_if = "OrderWood::is_as_the_species")]
    pub wood: OrderWood,
    /// The ticks from the death of all buds of a branch to its fall; drawn once an axis, at its birth, by laws that may
    /// depend on the `age` of the plant. Left out: dead wood stays.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shed_after: Option<Count>,
}

impl Default for Order {
    fn default() -> Self {
        Self {
            speed: Speeds::default(),
            death: Law::default(),
            pause: Law::default(),
            growth_unit: GrowthUnit::default(),
            axillary: Axillary::default(),
            reiteration: Reiteration::default(),
            traumatic: Traumatic::default(),
            apex: Apex::default(),
            relay: Relay::default(),
            transition: Vec::new(),
            internode: Internode::default(),
            insertion_deg: Variate::from(0.0),
            phyllotaxis: Phyllotaxis::default(),
            trend: Trend::default(),
            leaf: Leaf::default(),
            flower: Flower::default(),
            fruit: Fruit::default(),
            wood: OrderWood::default(),
            shed_after: None,
        }
    }
}

/// A growth unit: the internodes and nodes that a bud makes at one step, usually within a short time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GrowthUnit {
    /// The nodes of a long growth unit, or of its preformed part.
    pub nodes: Count,
    /// The nodes added after bud break: the neoformed part of a long growth unit, beyond the preformed nodes.
    pub neoformed: Count,
    /// The growth units of one step: more than 1 is polycyclism.
    pub per_step: Count,
    /// Growth units of the short type; left out: all are long.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub short: Option<ShortUnit>,
}

impl Default for GrowthUnit {
    fn default() -> Self {
        Self { nodes: Count::from(1), neoformed: Count::from(0), per_step: Count::from(1), short: None }
    }
}

/// Growth units of the short type: few internodes, often one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShortUnit {
    /// The probability that a growth unit is of the short type.
    pub probability: Law,
    /// Its nodes.
    #[serde(default = "one")]
    pub nodes: Count,
    /// The length of its internodes, cm.
    pub length_cm: Variate,
}

fn one() -> Count {
    Count::from(1)
}

/// The standard axillary buds of a node.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Axillary {
    /// The axillary buds of a node; at most 32.
    pub buds: Count,
    /// The probability that an axillary bud becomes an axis; one that does not lies dormant.
    pub ramification: Law,
    /// Which nodes of a growth unit ramify.
    pub pattern: Pattern,
    /// The ticks that a bud waits before its axis begins: 0 sylleptic, more proleptic.
    pub delay: Count,
    /// The state in which the new axes start; left out: that of the bearing axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

impl Default for Axillary {
    fn default() -> Self {
        Self {
            buds: Count::from(0),
            ramification: Law::default(),
            pattern: Pattern::default(),
            delay: Count::from(0),
            state: None,
        }
    }
}

/// Which nodes of a growth unit ramify (de Reffye 1988 §2, Fig. 4).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Pattern {
    /// `"continuous"`: every node; `"diffuse"`: nodes at random. Either way the law of ramification decides.
    Named(PatternName),
    /// Rhythmic: the nodes of the named zones of the growth unit, and no others.
    Rhythmic(Rhythmic),
    /// Rhythmic, by zones one after the other whose lengths are drawn.
    Chain(Chain),
}

impl Default for Pattern {
    fn default() -> Self {
        Self::Named(PatternName::Continuous)
    }
}

/// A pattern of ramification without zones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum PatternName {
    /// Every node ramifies, as far as the law of ramification lets it.
    Continuous,
    /// Nodes ramify at random, by the law of ramification.
    Diffuse,
}

/// Rhythmic ramification: by zones of the growth unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rhythmic {
    /// The zones that ramify; a node in several belongs to the first.
    #[schemars(length(min = 1, max = 64))]
    pub zones: Vec<Zone>,
}

/// A run of nodes of a growth unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Zone {
    /// The botanists' name of the zone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// From which end of the growth unit ranks are counted.
    pub from: End,
    /// The first rank of the zone, from 1 at that end; drawn once a growth unit.
    pub first: Count,
    /// The last rank of the zone, drawn once a growth unit; one before the first makes a unit without the zone. Left
    /// out: the other end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub last: Option<Count>,
    /// The law of ramification of this zone; left out: that of the order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ramification: Option<Law>,
    /// The state in which the axes of this zone start, as long shoots at the tip and short ones below: one, or a share
    /// for each; left out: that of the order's axillary buds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<ZoneState>,
}

/// Zones one after the other along a growth unit, each of a random length: a left-to-right semi-Markov chain, as it is
/// fitted to fates of axillary buds (Guédon et al. 2001). Zones may be skipped; the last goes on to the end of the
/// unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    /// From which end of the growth unit the zones follow one another.
    pub from: End,
    /// The weights of the first zone, the second … as the one in which a unit begins. Left out: the first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub begins: Vec<f64>,
    /// The zones in their order.
    #[schemars(length(min = 1, max = 64))]
    pub chain: Vec<Link>,
}

/// A zone of a chain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Link {
    /// The botanists' name of the zone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its number of nodes, at least 1, drawn once a growth unit. Left out: to the end of the unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<Count>,
    /// The weights of the next zone, the one after it … as the one that follows. Left out: the next.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub next: Vec<f64>,
    /// The law of ramification of this zone; left out: that of the order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ramification: Option<Law>,
    /// The state in which the axes of this zone start; left out: that of the order's axillary buds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<ZoneState>,
}

/// The state in which the axes of a zone start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ZoneState {
    /// The same for all.
    Named(String),
    /// The share of each state, drawn once an axis: `{ long = 0.3, short = 0.7 }`; shares need not sum to 1.
    Shares(BTreeMap<String, f64>),
}

/// An end of a growth unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum End {
    /// The oldest node.
    Base,
    /// The youngest node.
    Tip,
}
