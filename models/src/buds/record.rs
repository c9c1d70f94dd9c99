//! The words of one axis: its streams, opened when they are first read, and the record last read from each.
//!
//! The words of responses and pests come from streams of their own, in records whose places are fixed: a record of the
//! species' own words is the same whether something responds or not. Absent: which slot is for what (`compile::words`).

use super::columns::Columns;
use super::compile::{NODE_OF_RESPONSES, OrderLaws, Ranks, STEP_OF_RESPONSES, Spare};
use super::plan::Plan;
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};

/// No node has as many things of one kind.
const MOST_ON_NODE: usize = 64;

/// The words of one axis.
#[derive(Debug, Default)]
pub(super) struct Words {
    bud: Option<Stream>,
    node: Option<Stream>,
    step_response: Option<Stream>,
    node_response: Option<Stream>,
    /// The head record of the bud stream; then the records of a step, of a node and of the end.
    pub head: Vec<u32>,
    pub step: Vec<u32>,
    pub on_node: Vec<u32>,
    pub end: Vec<u32>,
    /// The ranks from which the axis's trends hold, where it draws them, with their places.
    pub trends: Vec<(u32, u8)>,
    /// The ranks of the zones of the growth unit, where it draws them.
    pub zones: Vec<Ranks>,
    /// Whether the bud lacks light.
    pub shaded: bool,
    /// The nodes that the axis has decided on and has yet to make.
    pub plan: Plan,
    /// Their records.
    pub nodes: Vec<u32>,
    /// Room for making them.
    pub columns: Columns,
}

impl Words {
    /// Makes these the words of an axis of an order.
    pub fn of(&mut self, laws: &OrderLaws) {
        (self.bud, self.node, self.step_response, self.node_response) = (None, None, None, None);
        // A quantity without words reads word 0 and ignores it.
        self.head.resize(laws.head.width.max(1), 0);
        self.step.resize(laws.step.spare.words(), 0);
        self.on_node.resize(laws.node.spare.words(), 0);
        self.end.resize(laws.end.width.max(1), 0);
        self.trends.clear();
        self.zones.clear();
    }

    /// Reads the head record from the axis's bud stream.
    pub fn read_head(&mut self, mut stream: Stream) {
        stream.read(&mut self.head);
        self.bud = Some(stream);
    }

    /// Reads the record of a clock step, from 0.
    pub fn read_step(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, step: u32) {
        let of = &laws.step;
        if of.width > 0 {
            let stream = self.bud.get_or_insert_with(|| random.stream(key, Purpose::Bud));
            read(stream, laws.head.width, step, of.width, &mut self.step);
        }
        if !of.spare.places().is_empty() && (self.shaded || !laws.light_alone) {
            let stream = self.step_response.get_or_insert_with(|| random.stream(key, Purpose::StepResponse));
            read_spare(stream, start(step, STEP_OF_RESPONSES), &of.spare, &mut self.step[of.width..]);
        }
    }

    /// Reads the record of a node, from 0.
    #[inline]
    pub fn read_node(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, node: u32) {
        let of = &laws.node;
        if of.width > 0 {
            let stream = self.node.get_or_insert_with(|| random.stream(key, Purpose::Node));
            read(stream, 0, node, of.width, &mut self.on_node);
        }
        if !of.spare.places().is_empty() && (self.shaded || !laws.light_alone) {
            let stream = self.node_response.get_or_insert_with(|| random.stream(key, Purpose::NodeResponse));
            read_spare(stream, start(node, NODE_OF_RESPONSES), &of.spare, &mut self.on_node[of.width..]);
        }
    }

    /// Reads the records of the nodes that are planned, with as many words behind them as there can be things of one
    /// kind on a node; `made` nodes of the axis are made.
    pub fn read_nodes(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, made: u32) {
        let into = &mut self.nodes;
        let (width, nodes) = (laws.node.width, self.plan.nodes() as usize);
        let words = nodes * width;
        into.resize(into.len().max(words + MOST_ON_NODE), 0);
        if width > 0 {
            let stream = self.node.get_or_insert_with(|| random.stream(key, Purpose::Node));
            stream.seek(start(made, width as u32));
            stream.read(&mut into[..words]);
        }
    }

    /// One word of the responses of a clock step.
    pub fn of_step(&mut self, random: &PlantRandom, key: LineageKey, step: u32, place: u32) -> u32 {
        let stream = self.step_response.get_or_insert_with(|| random.stream(key, Purpose::StepResponse));
        stream.seek(start(step, STEP_OF_RESPONSES) + u64::from(place));
        stream.word()
    }

    /// One word of the responses of a node.
    pub fn of_node(&mut self, random: &PlantRandom, key: LineageKey, node: u32, place: u32) -> u32 {
        let stream = self.node_response.get_or_insert_with(|| random.stream(key, Purpose::NodeResponse));
        stream.seek(start(node, NODE_OF_RESPONSES) + u64::from(place));
        stream.word()
    }
}

fn start(record: u32, width: u32) -> u64 {
    u64::from(record) * u64::from(width)
}

/// Reads record `number` of `width` words, after a head of `head` words.
pub(super) fn read(stream: &mut Stream, head: usize, number: u32, width: usize, words: &mut [u32]) {
    stream.seek(head as u64 + u64::from(number) * width as u64);
    stream.read(&mut words[..width]);
}

/// Reads the words of responses of the record that starts at `start`.
fn read_spare(stream: &mut Stream, start: u64, spare: &Spare, words: &mut [u32]) {
    for (word, &place) in words.iter_mut().zip(spare.places()) {
        stream.seek(start + u64::from(place));
        *word = stream.word();
    }
}
