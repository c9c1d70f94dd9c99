//! The laws of a node: the geometry of its internode, what it bears and how much of it.
//!
//! Every random quantity of a node has its slot in the node's record of words. Absent: the growing of a node
//! (`buds::node`), and what happens at a clock step (`step`).

use super::compiler::Compiler;
use super::geometry::DEGREE;
use super::relay::Branching;
use super::words::{Chance, Layout, Measure, Number};
use crate::buds::law::{Count, CountTable, VariateTable};
use crate::buds::params::{End, Order, Pattern};
use phytomer_sim::plant::Form;

/// Metres in a centimetre and in a millimetre.
const CM: f32 = 0.01;
const MM: f32 = 0.001;

/// The most organs of one kind on a node.
const MOST_ORGANS: u32 = 64;
/// The most buds of one kind on a node: dormant buds are kept as bits.
pub const MOST_BUDS: u32 = 32;
/// The longest delay or life length, in ticks.
pub const LONGEST: u32 = 65_535;

/// The laws of one node of an order.
#[derive(Debug, Clone)]
pub struct NodeLaws {
    /// The words of a node's record.
    pub width: usize,
    /// Whether no node bears anything: neither leaf nor flower nor bud.
    pub is_bare: bool,
    pub long_length: Measure,
    pub short_length: Measure,
    pub diameter: Measure,
    pub divergence: Measure,
    pub leaves: Number,
    /// The life length of a leaf; `None`: as long as its branch.
    pub leaf_life: Option<Number>,
    pub leaf: OrganLaws,
    pub axillary: Branching,
    zones: Option<Vec<ZoneLaw>>,
    pub reiteration: Branching,
    pub reiteration_order: u8,
    pub flowers: Number,
    pub flower_opens: Chance,
    pub flower_delay: Number,
    pub flower_life: Number,
    pub fruit_set: Chance,
    pub fruit_life: Number,
    pub flower: OrganLaws,
    pub fruit: OrganLaws,
}

/// The size and the stand of an organ.
#[derive(Debug, Clone)]
pub struct OrganLaws {
    pub length: Measure,
    pub width: Measure,
    pub insertion: Measure,
    /// Area of one side as a share of length × width; 0 where area means nothing.
    pub area_share: f32,
    pub form: Form,
}

#[derive(Debug, Clone)]
struct ZoneLaw {
    from: End,
    first: u32,
    last: u32,
    chance: Option<Chance>,
}

impl NodeLaws {
    /// Compiles the laws of a node.
    pub fn compile(order: &Order, divergence: VariateTable, compiler: &mut Compiler) -> Self {
        let mut layout = Layout::default();
        let words = &mut layout;
        let short = order.growth_unit.short.as_ref().map(|short| &short.length_cm);
        let long_length = compiler.measure(&order.internode.length_cm, "internode.length_cm");
        let short_length = match short {
            Some(length) => compiler.measure(length, "growth_unit.short.length_cm"),
            None => VariateTable::always(0.0),
        };
        let diameter = compiler.measure(&order.internode.diameter_mm, "internode.diameter_mm");
        let leaves = compiler.count(&order.leaf.per_node, "leaf.per_node", MOST_ORGANS);
        let most_leaves = leaves.max();
        let flowers = lateral_flowers(order, compiler);
        let most_flowers = flowers.max().max(1);
        let opens = compiler.probability(&order.flower.lateral, "flower.lateral");
        let sets = compiler.probability(&order.flower.fruit_set, "flower.fruit_set");
        let mut flower_count = |count: &Count, keys: &str| compiler.count(count, keys, LONGEST);
        let is_bare = [&leaves, &flowers].iter().all(|count| count.max() == 0);
        let flower_delay = flower_count(&order.flower.delay, "flower.delay");
        let flower_life = flower_count(&order.flower.life, "flower.life");
        let fruit_life = flower_count(&order.fruit.life, "fruit.life");
        let axillary = axillary(order, compiler, words);
        let reiteration = reiteration(order, compiler, words);
        let budless = axillary.count.table.max() == 0 && reiteration.count.table.max() == 0;
        Self {
            is_bare: is_bare && budless,
            long_length: words.measure(long_length, CM, 1),
            short_length: words.measure(short_length, CM, 1),
            diameter: words.measure(diameter, MM, 1),
            divergence: words.measure(divergence, DEGREE, 1),
            leaves: words.number(leaves, 1),
            leaf_life: leaf_life(order, compiler, words, most_leaves),
            leaf: leaf(order, compiler, words, most_leaves),
            axillary,
            zones: zones(order, compiler, words),
            reiteration,
            reiteration_order: order.reiteration.order,
            flowers: words.number(flowers, 1),
            flower_opens: words.chance(opens, most_flowers),
            flower_delay: words.number(flower_delay, most_flowers),
            flower_life: words.number(flower_life, most_flowers),
            fruit_set: words.chance(sets, most_flowers),
            fruit_life: words.number(fruit_life, most_flowers),
            flower: flower(order, compiler, words, most_flowers),
            fruit: fruit(order, compiler, words, most_flowers),
            width: layout.width(),
        }
    }

    /// The law of ramification of the node at `rank` of a growth unit of `nodes`; `None` where it does not ramify.
    #[inline]
    pub fn ramification(&self, rank: u32, nodes: u32) -> Option<&Chance> {
        let Some(zones) = &self.zones else {
            return Some(&self.axillary.chance);
        };
        let zone = zones.iter().find(|zone| {
            let rank = if zone.from == End::Base { rank } else { nodes + 1 - rank };
            (zone.first..=zone.last).contains(&rank)
        });
        zone.map(|zone| zone.chance.as_ref().unwrap_or(&self.axillary.chance))
    }

    /// The laws of ramification of the zones that have one of their own.
    pub fn zone_chances(&self) -> impl Iterator<Item = &Chance> {
        self.zones.iter().flatten().filter_map(|zone| zone.chance.as_ref())
    }
}

/// The lateral flowers of a node; none where none can open, so that they take no words.
fn lateral_flowers(order: &Order, compiler: &mut Compiler) -> CountTable {
    let flowers = compiler.count(&order.flower.per_node, "flower.per_node", MOST_ORGANS);
    match compiler.probability(&order.flower.lateral, "flower.lateral").is_never() {
        true => CountTable::always(0),
        false => flowers,
    }
}

fn leaf_life(order: &Order, compiler: &mut Compiler, words: &mut Layout, leaves: u32) -> Option<Number> {
    let life = order.leaf.life.as_ref()?;
    Some(words.number(compiler.count(life, "leaf.life", LONGEST), leaves))
}

fn leaf(order: &Order, compiler: &mut Compiler, words: &mut Layout, leaves: u32) -> OrganLaws {
    let leaf = &order.leaf;
    if !(0.0..=1.0).contains(&leaf.area_share) {
        compiler.fault("leaf.area_share", format!("the share is {}", leaf.area_share), "a share in [0, 1]");
    }
    let angle = compiler.angle(&leaf.insertion_deg, "leaf.insertion_deg");
    OrganLaws {
        length: words.measure(compiler.measure(&leaf.length_cm, "leaf.length_cm"), CM, leaves),
        width: words.measure(compiler.measure(&leaf.width_cm, "leaf.width_cm"), CM, leaves),
        insertion: words.measure(angle, DEGREE, leaves),
        area_share: leaf.area_share as f32,
        form: leaf.form.into(),
    }
}

fn flower(order: &Order, compiler: &mut Compiler, words: &mut Layout, flowers: u32) -> OrganLaws {
    let flower = &order.flower;
    let angle = compiler.angle(&flower.insertion_deg, "flower.insertion_deg");
    OrganLaws {
        length: words.measure(compiler.measure(&flower.length_cm, "flower.length_cm"), CM, flowers),
        width: words.measure(compiler.measure(&flower.width_cm, "flower.width_cm"), CM, flowers),
        insertion: words.measure(angle, DEGREE, flowers),
        area_share: 0.0,
        form: flower.form.into(),
    }
}

fn fruit(order: &Order, compiler: &mut Compiler, words: &mut Layout, flowers: u32) -> OrganLaws {
    let angle = compiler.angle(&order.flower.insertion_deg, "flower.insertion_deg");
    OrganLaws {
        length: words.measure(compiler.measure(&order.fruit.length_cm, "fruit.length_cm"), CM, flowers),
        width: words.measure(compiler.measure(&order.fruit.width_cm, "fruit.width_cm"), CM, flowers),
        insertion: words.measure(angle, DEGREE, flowers),
        area_share: 0.0,
        form: order.fruit.form.into(),
    }
}

fn axillary(order: &Order, compiler: &mut Compiler, words: &mut Layout) -> Branching {
    let axillary = &order.axillary;
    let count = compiler.count(&axillary.buds, "axillary.buds", MOST_BUDS);
    let chance = compiler.probability(&axillary.ramification, "axillary.ramification");
    let delay = compiler.count(&axillary.delay, "axillary.delay", LONGEST);
    let state = axillary.state.as_ref().map(|state| compiler.state(state, "axillary.state"));
    let insertion = compiler.insertion_of_next_order();
    Branching::new(words, count, chance, delay, insertion, state)
}

fn reiteration(order: &Order, compiler: &mut Compiler, words: &mut Layout) -> Branching {
    let reiteration = &order.reiteration;
    if !(1..=compiler.orders()).contains(&usize::from(reiteration.order)) {
        let found = format!("the order is {}", reiteration.order);
        let expected = format!("an order of the species, from 1 to {}", compiler.orders());
        compiler.fault("reiteration.order", found, &expected);
    }
    let count = compiler.count(&reiteration.buds, "reiteration.buds", MOST_BUDS);
    let chance = compiler.probability(&reiteration.probability, "reiteration.probability");
    let delay = compiler.count(&reiteration.delay, "reiteration.delay", LONGEST);
    let angle = compiler.angle(&reiteration.insertion_deg, "reiteration.insertion_deg");
    let state = reiteration.state.as_ref().map_or(0, |state| compiler.state(state, "reiteration.state"));
    Branching::new(words, count, chance, delay, angle, Some(state))
}

fn zones(order: &Order, compiler: &mut Compiler, words: &mut Layout) -> Option<Vec<ZoneLaw>> {
    let Pattern::Rhythmic(rhythmic) = &order.axillary.pattern else {
        return None;
    };
    let most_buds = compiler.count(&order.axillary.buds, "axillary.buds", MOST_BUDS).max();
    let mut compiled = Vec::new();
    for (index, zone) in rhythmic.zones.iter().take(64).enumerate() {
        let keys = format!("axillary.pattern.zones.{index}");
        let last = zone.last.unwrap_or(u32::MAX);
        if zone.first == 0 || last < zone.first {
            let found = format!("the zone goes from rank {} to rank {last}", zone.first);
            compiler.fault(&keys, found, "a first rank from 1 and a last rank not before it");
        }
        let chance = zone.ramification.as_ref().map(|law| {
            let table = compiler.probability(law, &format!("{keys}.ramification"));
            words.chance(table, most_buds)
        });
        compiled.push(ZoneLaw { from: zone.from, first: zone.first, last, chance });
    }
    Some(compiled)
}
