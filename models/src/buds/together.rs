//! Words of many streams, made together: those of the nodes of a block, and the next ones of buds that grow one after
//! another.
//!
//! A block of words is made faster beside others than alone, and those of different streams of a plant as fast as those
//! of one. The words stay where they are made: each record is known by its place. Absent: what the words decide.

use super::bud::ApicalBud;
use super::compile::{BudModel, OrderLaws};
use super::plan::Plan;
use phytomer_sim::clock::{Speed, Tick};
use phytomer_sim::plant::Plant;
use phytomer_sim::random::{PlantRandom, Purpose, Sought, WORDS_OF_BLOCK, WordBlock};
use std::ops::Range;

/// Room for the words of more things of one kind than a node has, in blocks.
const MOST_ON_NODE: usize = 64 / WORDS_OF_BLOCK;

/// The fewest buds of one order, one after another, that make their nodes together, as measured: blocks of fewer take
/// fewer instructions, but more time.
pub(super) const MANY_ALIKE: usize = 24;

/// The words that an axis which goes through many steps reads at once, the first time and later: blocks of a stream are
/// made faster many at once, but an axis may die soon.
pub(super) const WORDS_AT_ONCE: [usize; 2] = [32, 96];

/// The records of the nodes of a block.
#[derive(Debug, Default)]
pub(super) struct NodeWords {
    sought: Vec<Sought>,
    blocks: Vec<WordBlock>,
    /// The place of the record of each node among the words.
    pub records: Vec<u32>,
}

impl NodeWords {
    /// Reads the records, of `width` words each, of the nodes that are planned.
    pub fn read(&mut self, plan: &Plan, width: usize, random: &PlantRandom) {
        let Self { sought, blocks, records } = self;
        sought.clear();
        records.clear();
        if width == 0 {
            records.resize(plan.nodes as usize, 0);
        } else {
            for shoot in &plan.shoots {
                let nodes = (shoot.nodes.1 - shoot.nodes.0) as usize;
                let start = u64::from(shoot.bud.rank) * width as u64;
                let place = sought.len() * WORDS_OF_BLOCK + start as usize % WORDS_OF_BLOCK;
                records.extend((0..nodes).map(|node| (place + node * width) as u32));
                seek(sought, Sought::stream_of(shoot.key, Purpose::Node), start..start + (nodes * width) as u64);
            }
        }
        make(sought, blocks, MOST_ON_NODE, random);
    }

    /// All words. Behind the records stand as many more as there can be things of one kind on a node.
    pub fn words(&self) -> &[u32] {
        self.blocks.as_flattened()
    }
}

/// Seeks the blocks of a stream in which some of its words stand.
#[inline]
fn seek(sought: &mut Vec<Sought>, stream: u64, words: Range<u64>) {
    // Most often the count is one.
    let (mut block, end) = (words.start / WORDS_OF_BLOCK as u64, words.end.div_ceil(WORDS_OF_BLOCK as u64));
    while block < end {
        sought.push(Sought { stream, block });
        block += 1;
    }
}

/// Makes the blocks that are sought, with room for `more` behind them.
fn make(sought: &[Sought], blocks: &mut Vec<WordBlock>, more: usize, random: &PlantRandom) {
    let number = sought.len();
    if blocks.len() < number + more {
        blocks.resize(number + more, [0; WORDS_OF_BLOCK]);
    }
    random.make_blocks(sought, &mut blocks[..number]);
}

/// The words that buds read next, which grow one after another: the records of their next steps, and of their next node
/// where they make nodes one by one.
#[derive(Debug, Default)]
pub(super) struct Ahead {
    sought: Vec<Sought>,
    blocks: Vec<WordBlock>,
    buds: Vec<OfBud>,
    /// The bud that grows next.
    next: usize,
}

/// Records of steps of a bud that follow one another.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AtHand<'a> {
    /// Their words, one record after another, and more behind them than one record has with its responses.
    pub words: &'a [u32],
    /// The number of the first, from 0, and how many they are.
    pub first: u32,
    pub number: u32,
}

/// The words of one bud.
#[derive(Debug, Clone, Default)]
pub(super) struct OfBud {
    /// The number of its next step, from 0, and how many steps have their words here.
    pub first: u32,
    pub steps: u32,
    /// Where the words of the steps stand.
    pub words: Range<u32>,
    /// The number of its next node, from 0.
    pub node: u32,
    /// Where the words of the node stand; none where it needs none.
    pub node_words: Range<u32>,
}

impl OfBud {
    /// Forgets the words.
    #[inline]
    pub fn clear(&mut self) {
        self.steps = 0;
        self.node_words = 0..0;
    }
}

impl Ahead {
    /// Forgets all buds.
    pub fn clear(&mut self) {
        self.buds.clear();
        self.next = 0;
    }

    /// Reads words of buds which are about to grow to `age`, in this order. A bud that makes its nodes `one_by_one`,
    /// and one at each step unless it dies, reads those of its next node too.
    pub fn read(&mut self, (model, plant): (&BudModel, &Plant), buds: &[ApicalBud], age: Tick, one_by_one: bool) {
        self.clear();
        self.sought.clear();
        let order = |bud: &ApicalBud| plant.axes.order[bud.axis.index()];
        let mut behind = 0;
        for alike in buds.chunk_by(|one, next| order(one) == order(next)) {
            let laws = model.laws(order(&alike[0]));
            let one_by_one = one_by_one && alike.len() < MANY_ALIKE && !model.grow_plainly(plant, alike);
            self.read_alike(&Records::of(laws, one_by_one), plant, alike, age);
            behind = behind.max(laws.step.spare.words());
        }
        make(&self.sought, &mut self.blocks, behind.div_ceil(WORDS_OF_BLOCK), &plant.random);
    }

    /// Seeks the words of buds of one order.
    fn read_alike(&mut self, of_order: &Records<'_>, plant: &Plant, buds: &[ApicalBud], age: Tick) {
        for bud in buds {
            let key = plant.axes.key[bud.axis.index()];
            let mut of = OfBud { first: bud.cycle, node: bud.rank, ..OfBud::default() };
            of.steps = of_order.steps_at_once(plant, bud, age);
            if of.steps > 0 {
                let start = of_order.head + u64::from(of.first) * of_order.width;
                let words = start..start + u64::from(of.steps) * of_order.width;
                of.words = self.seek(Sought::stream_of(key, Purpose::Bud), words);
                let width = of_order.node;
                if width > 0 {
                    let start = u64::from(of.node) * width;
                    of.node_words = self.seek(Sought::stream_of(key, Purpose::Node), start..start + width);
                }
            }
            self.buds.push(of);
        }
    }

    /// Seeks some words of a stream; where they will stand.
    #[inline]
    fn seek(&mut self, stream: u64, words: Range<u64>) -> Range<u32> {
        let start = (self.sought.len() * WORDS_OF_BLOCK) as u32 + words.start as u32 % WORDS_OF_BLOCK as u32;
        let length = (words.end - words.start) as u32;
        seek(&mut self.sought, stream, words);
        start..start + length
    }

    /// Goes on to the bud that grows next, which becomes `of`.
    #[inline]
    pub fn go_on(&mut self, of: &mut OfBud) {
        match self.buds.get(self.next) {
            Some(next) => of.clone_from(next),
            None => *of = OfBud::default(),
        }
        self.next += 1;
    }

    /// The number of the bud that grows next.
    pub fn next(&self) -> usize {
        self.next
    }

    /// Lets the bud `next` be the one that grows next.
    pub fn go_on_from(&mut self, next: usize) {
        self.next = next;
    }

    /// The records of the next steps of a bud.
    #[inline]
    pub fn steps_of(&self, nth: usize) -> AtHand<'_> {
        match self.buds.get(nth) {
            Some(of) if of.steps > 0 => {
                let words = &self.blocks.as_flattened()[of.words.start as usize..];
                AtHand { words, first: of.first, number: of.steps }
            }
            _ => AtHand::default(),
        }
    }

    /// All words. Behind the records stand as many more as one record of a step has with its responses.
    #[inline]
    pub fn words(&self) -> &[u32] {
        self.blocks.as_flattened()
    }

    /// The words of the steps of a bud.
    #[inline]
    pub fn of_steps(&self, of: &OfBud) -> &[u32] {
        self.at(&of.words)
    }

    /// The words at a place.
    #[inline]
    pub fn at(&self, words: &Range<u32>) -> &[u32] {
        &self.blocks.as_flattened()[words.start as usize..words.end as usize]
    }
}

/// The records that buds of an order read.
#[derive(Clone, Copy)]
struct Records<'a> {
    laws: &'a OrderLaws,
    /// The words of the record of an axis, and of that of a step.
    head: u64,
    width: u64,
    /// The words of the record of the next node, where it is read too; else 0.
    node: u64,
    /// The speed of every axis; `None` where axes draw it, or steps have no words.
    speed: Option<Speed>,
    /// Whether words of responses can follow those of a step.
    responds: bool,
}

impl<'a> Records<'a> {
    fn of(laws: &'a OrderLaws, one_by_one: bool) -> Self {
        let (head, width) = (laws.head.width as u64, laws.step.width as u64);
        let makes_one = laws.node.most_nodes == 1 && laws.step.pause.is_never();
        let node = if one_by_one && makes_one { laws.node.width as u64 } else { 0 };
        let speed = laws.head.speed.only().filter(|_| width > 0);
        Self { laws, head, width, node, speed, responds: !laws.step.spare.places().is_empty() }
    }

    /// The number of steps that a bud reads at once when it begins to grow to `age`; 0 where that is not known before.
    /// Steps whose words are followed by words of responses are read one at a time.
    #[inline]
    fn steps_at_once(&self, plant: &Plant, bud: &ApicalBud, age: Tick) -> u32 {
        let Some(speed) = self.speed else { return 0 };
        let due = speed.steps_by(age.saturating_sub(plant.axes.birth[bud.axis.index()])).saturating_sub(bud.cycle);
        if due <= 1 {
            return due;
        }
        let alone = self.responds && !(self.laws.light_alone && plant.shade.of(bud.axis) == 0);
        due.min(if alone { 1 } else { (WORDS_AT_ONCE[0] as u32 / self.width as u32).max(1) })
    }
}
