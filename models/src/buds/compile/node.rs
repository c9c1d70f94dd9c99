//! The laws of a node: the geometry of its internode, its organs and buds, and their numbers and sizes.
//!
//! Every random quantity of a node has its slot in the node's record of words. Absent: the growing of a node
//! (`buds::node`), and the laws of a clock step (`step`).

use super::branching::{Branching, MOST_BUDS};
use super::change::{ByAge, Change};
use super::compiler::{Compiler, LONGEST};
use super::geometry::{DEGREE, divergence};
use super::step::StepLaws;
use super::words::{Chance, Layout, Measure, Number, Spare};
use super::zone::{Ramification, Ranks, Zones};
use crate::buds::params::{Order, Season};
use crate::law::{Count, CountTable, ProbabilityTable, ValueRange, VariateTable};
use phytomer_sim::Tick;
use phytomer_sim::plant::{Form, Kind};

/// Metres in a centimetre and in a millimetre.
const CM: f32 = 0.01;
const MM: f32 = 0.001;

/// The area of one side of a leaf as a share of length × width; the area of a tuft of needles is several times that of
/// its outline.
const AREA_SHARE: ValueRange = ValueRange { min: 0.0, max: 20.0, what: "a share of length × width" };

/// The most organs of one kind on a node.
const MOST_ORGANS: u32 = 64;

/// The places of the words of a node in its record in the stream of responses, and the width of that record.
const PLACE_OF_BUDS: u32 = 0;
const PLACE_OF_FLOWERS: u32 = PLACE_OF_BUDS + MOST_BUDS;
const PLACE_OF_FRUITS: u32 = PLACE_OF_FLOWERS + MOST_ORGANS;
pub const PLACE_OF_EATEN_LEAVES: u32 = PLACE_OF_FRUITS + MOST_ORGANS;
pub const PLACE_OF_EATEN_FLOWERS: u32 = PLACE_OF_EATEN_LEAVES + MOST_ORGANS;
pub const PLACE_OF_EATEN_FRUITS: u32 = PLACE_OF_EATEN_FLOWERS + MOST_ORGANS;
pub const NODE_OF_RESPONSES: u32 = PLACE_OF_EATEN_FRUITS + MOST_ORGANS;

/// The words of the nodes that are made at once, where that is between 16 and 256 nodes: they stay in the caches that
/// are nearest, and an axis that outgrows its plant's limit has no more in hand.
const WORDS_OF_BLOCK: usize = 4096;

/// The laws of one node of an order.
#[derive(Debug, Clone)]
pub struct NodeLaws {
    /// The words of a node's record.
    pub width: usize,
    /// The words of responses behind it.
    pub spare: Spare,
    /// Whether no node bears anything: neither leaf nor flower nor bud.
    pub is_bare: bool,
    /// The most nodes that an axis makes at a step of its clock.
    pub most_nodes: u32,
    /// The most nodes that are made at once; 0 where nodes are made one by one.
    pub block: u32,
    pub long_length: Measure,
    pub short_length: Measure,
    pub diameter: Measure,
    pub divergence: Measure,
    pub leaves: Number,
    /// The life length of a leaf; `None`: as long as its branch.
    pub leaf_life: Option<Number>,
    /// When leaves fall together; `None` where they do not.
    pub leaf_fall: Option<LeafFall>,
    pub leaf: OrganLaws,
    pub axillary: Branching,
    pub zones: Option<Zones>,
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

/// When the leaves of a plant fall together.
#[derive(Debug, Clone)]
pub enum LeafFall {
    /// At a tick of the year, which each leaf draws: the ticks of a year, and the tick of the year.
    OfYear(u32, Box<Number>),
    /// By the date: the tick at which a leaf falls, by that of its birth; `NEVER` where none of the run makes it fall.
    When(Vec<Tick>),
}

/// The size and the direction of an organ.
#[derive(Debug, Clone)]
pub struct OrganLaws {
    pub length: Measure,
    pub width: Measure,
    pub insertion: Measure,
    /// Area of one side as a share of length × width; 0 for organs that have no area.
    pub area_share: Measure,
    pub form: Form,
    pub kind: Kind,
}

impl NodeLaws {
    /// Compiles the laws of a node.
    pub fn compile(order: &Order, season: Option<&Season>, step: &StepLaws, compiler: &mut Compiler) -> Self {
        let buds = compiler.places(&order.axillary.buds, "axillary.buds", MOST_BUDS);
        let most_buds = buds.max_in_any_run();
        let leaves = compiler.places(&order.leaf.per_node, "leaf.per_node", MOST_ORGANS);
        let most_leaves = leaves.max_in_any_run();
        let divergence = divergence(order, most_leaves.max(most_buds), compiler);
        let mut layout = Layout::default();
        let words = &mut layout;
        let short = order.growth_unit.short.as_ref().map(|short| &short.length_cm);
        let long_length = compiler.measure(&order.internode.length_cm, "internode.length_cm");
        let short_length = match short {
            Some(length) => compiler.measure(length, "growth_unit.short.length_cm"),
            None => VariateTable::always(0.0),
        };
        let diameter = compiler.measure(&order.internode.diameter_mm, "internode.diameter_mm");
        let (flowers, opens) = lateral_flowers(order, compiler);
        let most_flowers = flowers.max_in_any_run().max(1);
        let sets = compiler.probability(&order.flower.fruit_set, "flower.fruit_set");
        let mut flower_count = |count: &Count, keys: &str| compiler.count(count, keys, LONGEST);
        let is_bare = [&leaves, &flowers].iter().all(|count| count.max() == 0);
        let flower_delay = flower_count(&order.flower.delay, "flower.delay");
        let flower_life = flower_count(&order.flower.life, "flower.life");
        let fruit_life = flower_count(&order.fruit.life, "fruit.life");
        let flower_angle = compiler.angle(&order.flower.insertion_deg, "flower.insertion_deg");
        let axillary = axillary(order, buds, compiler, words);
        let reiteration = reiteration(order, compiler, words);
        let budless = axillary.count.table.max() == 0 && reiteration.count.table.max() == 0;
        Self {
            is_bare: is_bare && budless,
            most_nodes: step.most_nodes().now.saturating_mul(step.per_step.table.max()),
            long_length: words.measure(long_length, CM, 1),
            short_length: words.measure(short_length, CM, 1),
            diameter: words.measure(diameter, MM, 1),
            divergence: words.measure(divergence, DEGREE, 1),
            leaves: words.number(leaves, 1),
            leaf_life: leaf_life(order, compiler, words, most_leaves),
            leaf: leaf(order, compiler, words, most_leaves),
            axillary,
            zones: Zones::compile(order, &step.zone_ranks, most_buds, compiler, words),
            reiteration,
            reiteration_order: reiteration_order(order, compiler),
            flowers: words.number(flowers, 1),
            flower_opens: words.chance(opens, most_flowers),
            flower_delay: words.number(flower_delay, most_flowers),
            flower_life: words.number(flower_life, most_flowers),
            fruit_set: words.chance(sets, most_flowers),
            fruit_life: words.number(fruit_life, most_flowers),
            flower: flower(order, flower_angle.clone(), compiler, words, most_flowers),
            fruit: fruit(order, flower_angle, compiler, words, most_flowers),
            leaf_fall: season.and_then(|season| LeafFall::compile(season, compiler, words, most_leaves)),
            width: layout.width(),
            block: (WORDS_OF_BLOCK / layout.width().max(1)).clamp(16, 256) as u32,
            spare: Spare::after(layout.width()),
        }
    }

    /// Multiplies the probability that an axillary bud ramifies, in every zone.
    pub fn ramification_times(&mut self, factor: &ByAge) {
        let buds = self.axillary.count.table.max_in_any_run();
        let of_zones = self.zones.iter_mut().flat_map(|zones| zones.own_chances());
        for chance in of_zones.chain([&mut self.axillary.chance]) {
            chance.respond(Change::Times(factor.clone()), (PLACE_OF_BUDS, buds), &mut self.spare);
        }
    }

    /// Multiplies the probability that a lateral flower opens.
    pub fn flowers_times(&mut self, factor: ByAge) {
        let words = (PLACE_OF_FLOWERS, self.most_flowers());
        self.flower_opens.respond(Change::Times(factor), words, &mut self.spare);
    }

    /// Multiplies the probability that a flower sets fruit.
    pub fn fruits_times(&mut self, factor: ByAge) {
        let words = (PLACE_OF_FRUITS, self.most_flowers());
        self.fruit_set.respond(Change::Times(factor), words, &mut self.spare);
    }

    /// Multiplies the lengths of internodes.
    pub fn lengths_times(&mut self, factor: &ByAge) {
        for length in [&mut self.long_length, &mut self.short_length] {
            length.respond(factor.clone());
        }
    }

    /// Multiplies the areas of leaves, and so their lengths and widths by the square root.
    pub fn leaf_areas_times(&mut self, factor: &ByAge) {
        let root = factor.roots();
        for side in [&mut self.leaf.length, &mut self.leaf.width] {
            side.respond(root.clone());
        }
    }

    fn most_flowers(&self) -> u32 {
        self.flowers.table.max_in_any_run().clamp(1, MOST_ORGANS)
    }

    /// How the node at `rank` of a growth unit of `nodes` ramifies; `None` where it does not. `drawn` are the ranks of
    /// zones that the unit has drawn, if any.
    #[inline]
    pub fn ramification(&self, rank: u32, nodes: u32, drawn: &[Ranks]) -> Option<Ramification<'_>> {
        match &self.zones {
            None => Some(Ramification::of_order(&self.axillary.chance)),
            Some(zones) => zones.ramification(rank, nodes, drawn, &self.axillary.chance),
        }
    }
}

/// The number of lateral flowers of a node, and the probability that each opens. The number is 0 where no flower can
/// open, so that flowers take no words.
fn lateral_flowers(order: &Order, compiler: &mut Compiler) -> (CountTable, ProbabilityTable) {
    let flowers = compiler.places(&order.flower.per_node, "flower.per_node", MOST_ORGANS);
    let opens = compiler.probability(&order.flower.lateral, "flower.lateral");
    (if opens.is_never() { CountTable::always(0) } else { flowers }, opens)
}

fn leaf_life(order: &Order, compiler: &mut Compiler, words: &mut Layout, leaves: u32) -> Option<Number> {
    let life = order.leaf.life.as_ref()?;
    Some(words.number(compiler.count(life, "leaf.life", LONGEST), leaves))
}

fn leaf(order: &Order, compiler: &mut Compiler, words: &mut Layout, leaves: u32) -> OrganLaws {
    let leaf = &order.leaf;
    let angle = compiler.angle(&leaf.insertion_deg, "leaf.insertion_deg");
    let form = compiler.form(&leaf.form);
    let area_share = match &leaf.area_share {
        Some(stated) => compiler.variate(stated, "leaf.area_share", AREA_SHARE),
        None => VariateTable::always(f64::from(leaf.form.area_share())),
    };
    OrganLaws {
        length: words.measure(compiler.measure(&leaf.length_cm, "leaf.length_cm"), CM, leaves),
        width: words.measure(compiler.measure(&leaf.width_cm, "leaf.width_cm"), CM, leaves),
        insertion: words.measure(angle, DEGREE, leaves),
        area_share: words.measure(area_share, 1.0, leaves),
        form,
        kind: leaf.kind.into(),
    }
}

impl LeafFall {
    fn compile(season: &Season, compiler: &mut Compiler, words: &mut Layout, leaves: u32) -> Option<Self> {
        compiler.check_season(season);
        let year = season.ticks_per_year.value();
        if let Some(fall) = &season.leaf_fall {
            let fall = compiler.fall_within(fall, year);
            return Some(Self::OfYear(year, Box::new(words.number(fall, leaves))));
        }
        season.leaf_fall_when.as_ref().map(|when| Self::When(compiler.falls_after(when)))
    }
}

fn flower(order: &Order, angle: VariateTable, compiler: &mut Compiler, words: &mut Layout, flowers: u32) -> OrganLaws {
    let flower = &order.flower;
    OrganLaws {
        length: words.measure(compiler.measure(&flower.length_cm, "flower.length_cm"), CM, flowers),
        width: words.measure(compiler.measure(&flower.width_cm, "flower.width_cm"), CM, flowers),
        insertion: words.measure(angle, DEGREE, flowers),
        area_share: words.measure(VariateTable::always(0.0), 1.0, flowers),
        form: compiler.form(&flower.form),
        kind: flower.kind.into(),
    }
}

/// The laws of a fruit, which hangs where its flower stood.
fn fruit(order: &Order, angle: VariateTable, compiler: &mut Compiler, words: &mut Layout, flowers: u32) -> OrganLaws {
    OrganLaws {
        length: words.measure(compiler.measure(&order.fruit.length_cm, "fruit.length_cm"), CM, flowers),
        width: words.measure(compiler.measure(&order.fruit.width_cm, "fruit.width_cm"), CM, flowers),
        insertion: words.measure(angle, DEGREE, flowers),
        area_share: words.measure(VariateTable::always(0.0), 1.0, flowers),
        form: compiler.form(&order.fruit.form),
        kind: order.fruit.kind.into(),
    }
}

fn axillary(order: &Order, buds: CountTable, compiler: &mut Compiler, words: &mut Layout) -> Branching {
    let axillary = &order.axillary;
    let chance = compiler.probability(&axillary.ramification, "axillary.ramification");
    let delay = compiler.count(&axillary.delay, "axillary.delay", LONGEST);
    let state = axillary.state.as_ref().map(|state| compiler.state(state, "axillary.state"));
    let insertion = compiler.insertion_of_next_order();
    Branching::new(words, buds, chance, delay, insertion, state)
}

fn reiteration_order(order: &Order, compiler: &mut Compiler) -> u8 {
    let orders = u32::try_from(compiler.orders()).unwrap_or(u32::MAX);
    let stated = &order.reiteration.order;
    let order = compiler.quantity(stated, "reiteration.order", orders, ("the order", "an order of the species"));
    u8::try_from(order).unwrap_or(1)
}

fn reiteration(order: &Order, compiler: &mut Compiler, words: &mut Layout) -> Branching {
    let reiteration = &order.reiteration;
    let count = compiler.places(&reiteration.buds, "reiteration.buds", MOST_BUDS);
    let chance = compiler.probability(&reiteration.probability, "reiteration.probability");
    let delay = compiler.count(&reiteration.delay, "reiteration.delay", LONGEST);
    let angle = compiler.angle(&reiteration.insertion_deg, "reiteration.insertion_deg");
    let state = reiteration.state.as_ref().map_or(0, |state| compiler.state(state, "reiteration.state"));
    Branching::new(words, count, chance, delay, angle, Some(state))
}
