//! The words of one axis: its streams, opened when they are first read, and the records last read from each.
//!
//! The words of responses and pests come from streams of their own, in records whose places are fixed: a record of the
//! species' own words is the same whether something responds or not. Absent: which slot is for what (`compile::words`).

use super::bud::ApicalBud;
use super::columns::Columns;
use super::compile::{BudModel, NODE_OF_RESPONSES, OrderLaws, Ranks, STEP_OF_RESPONSES, Spare};
use super::plan::Plan;
use super::together::{Ahead, AtHand, NodeWords, OfBud, WORDS_AT_ONCE};
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{LineageKey, Plant};
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use phytomer_sim::site::stems::Line;
use std::cell::Cell;

/// The words of one axis.
#[derive(Debug, Default)]
pub(super) struct Words {
    bud: Option<Stream>,
    node: Option<Stream>,
    step_response: Option<Stream>,
    node_response: Option<Stream>,
    /// The head record of the bud stream; then the records of steps, of a node and of the end.
    pub head: Vec<u32>,
    steps: Steps,
    pub on_node: Vec<u32>,
    pub end: Vec<u32>,
    /// The ranks from which the axis's trends hold, where it draws them, with their places.
    pub trends: Vec<(u32, u8)>,
    /// The ranks of the zones of the growth unit, where it draws them.
    pub zones: Vec<Ranks>,
    /// Whether the bud lacks light.
    pub shaded: bool,
    /// The nodes that axes have decided on and have yet to make.
    pub plan: Plan,
    /// Whether axes use them that begin, one after another.
    pub many_begin: bool,
    /// Whether many axes of one order use them, one after another.
    pub many_alike: bool,
    /// The buds that have grown to their age and live.
    pub living: Vec<ApicalBud>,
    /// The records of the nodes that are planned.
    pub nodes: NodeWords,
    /// The words of buds that grow one after another, and of the one that grows now.
    ahead: Ahead,
    of_bud: OfBud,
    /// Room for making them.
    pub columns: Columns,
    /// Room for the line of a growth unit that is about to grow.
    pub line: Line,
}

thread_local! {
    /// The words of the axes that a thread grows, kept for their memory: a population has many plants, and a plant that
    /// grows by the clock many ticks.
    static WORDS: Cell<Option<Box<Words>>> = const { Cell::new(None) };
}

impl Words {
    /// Lends the words of this thread, with nothing planned; to axes that begin, one after another, where `many_begin`.
    pub fn lend<T>(many_begin: bool, work: impl FnOnce(&mut Self) -> T) -> T {
        let mut words = WORDS.take().unwrap_or_default();
        (words.many_begin, words.many_alike) = (many_begin, false);
        words.plan.clear();
        words.living.clear();
        words.ahead.clear();
        let done = work(&mut words);
        WORDS.set(Some(words));
        done
    }

    /// Makes these the words of an axis of an order; none that were read ahead.
    pub fn of(&mut self, laws: &OrderLaws) {
        (self.bud, self.node, self.step_response, self.node_response) = (None, None, None, None);
        // A quantity without words reads word 0 and ignores it.
        if self.head.len() != laws.head.width.max(1) {
            self.head.resize(laws.head.width.max(1), 0);
        }
        self.steps.of(laws);
        if self.on_node.len() < laws.node.spare.words() {
            self.on_node.resize(laws.node.spare.words(), 0);
        }
        if self.end.len() < laws.end.width.max(1) {
            self.end.resize(laws.end.width.max(1), 0);
        }
        self.trends.clear();
        self.zones.clear();
        self.of_bud.clear();
    }

    /// Makes these the words of another axis of the same order; none that were read ahead.
    #[inline]
    pub fn of_next(&mut self, laws: &OrderLaws) {
        (self.bud, self.node, self.step_response, self.node_response) = (None, None, None, None);
        self.steps.of(laws);
        self.trends.clear();
        self.zones.clear();
        self.of_bud.clear();
    }

    /// Reads the head record from the axis's bud stream.
    pub fn read_head(&mut self, mut stream: Stream) {
        stream.read(&mut self.head);
        self.bud = Some(stream);
    }

    /// The record of the clock step that was read last, and what stands behind it.
    #[inline(always)]
    pub fn step(&self) -> &[u32] {
        let Steps { words, place, are_ahead, .. } = &self.steps;
        let words = if *are_ahead { self.ahead.words() } else { words };
        &words[*place..]
    }

    /// Reads the record of a clock step, from 0, of an axis that may go through `ahead` steps from this one on.
    #[inline]
    pub fn read_step(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, step: u32, ahead: u32) {
        self.go_to_step(laws, step, |words| words.read_steps(laws, random, key, step, ahead));
        if !laws.step.spare.places().is_empty() && self.responds(laws) {
            self.read_step_response(laws, random, key, step);
        }
    }

    /// Goes to the record of a clock step, from 0; `read` reads it where it is not at hand.
    #[inline(always)]
    pub fn go_to_step(&mut self, laws: &OrderLaws, step: u32, read: impl FnOnce(&mut Self)) {
        let width = laws.step.width;
        if width > 0 && !self.steps.go_to(step, width) {
            read(self);
        }
    }

    /// Makes the blocks in which the records of a step and of a node begin, each from 0, side by side.
    #[inline]
    pub fn read_both(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, (step, node): (u32, u32)) {
        let (of_step, of_node) = (laws.step.width, laws.node.width);
        if of_step > 0 && of_node > 0 {
            let bud = self.bud.get_or_insert_with(|| random.stream(key, Purpose::Bud));
            bud.seek(laws.head.width as u64 + start(step, of_step as u32));
            let nodes = self.node.insert(random.stream(key, Purpose::Node));
            nodes.seek(start(node, of_node as u32));
            Stream::reach_both(bud, nodes);
        }
    }

    /// Whether the words of responses are read.
    fn responds(&self, laws: &OrderLaws) -> bool {
        self.shaded || !laws.light_alone
    }

    /// Reads the records of the steps from `step` on: of one where words of responses stand behind it, else of many.
    #[inline(never)]
    pub fn read_steps(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, step: u32, ahead: u32) {
        self.read_more_steps(laws, random, key, (step, ahead), self.steps.number > 0);
    }

    /// As [`Self::read_steps`]; more at once where records of the axis have been read `before`.
    fn read_more_steps(
        &mut self,
        laws: &OrderLaws,
        random: &PlantRandom,
        key: LineageKey,
        (step, ahead): (u32, u32),
        before: bool,
    ) {
        let width = laws.step.width;
        let alone = !laws.step.spare.places().is_empty() && self.responds(laws);
        let most = WORDS_AT_ONCE[usize::from(before)] / width;
        let number = if alone { 1 } else { (ahead as usize).min(most).max(1) };
        let into = self.steps.begin_at(step, number, laws.step.spare.words() + (number - 1) * width);
        let stream = self.bud.get_or_insert_with(|| random.stream(key, Purpose::Bud));
        stream.seek(laws.head.width as u64 + start(step, width as u32));
        stream.read(&mut into[..number * width]);
    }

    #[inline(never)]
    fn read_step_response(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, step: u32) {
        let of = &laws.step;
        let stream = self.step_response.get_or_insert_with(|| random.stream(key, Purpose::StepResponse));
        let words = &mut self.steps.words[self.steps.place + of.width..];
        read_spare(stream, start(step, STEP_OF_RESPONSES), &of.spare, words);
    }

    /// Reads the record of a node, from 0.
    #[inline]
    pub fn read_node(&mut self, laws: &OrderLaws, random: &PlantRandom, key: LineageKey, node: u32) {
        let of = &laws.node;
        if self.of_bud.node == node && !self.of_bud.node_words.is_empty() {
            self.on_node[..of.width].copy_from_slice(self.ahead.at(&self.of_bud.node_words));
        } else if of.width > 0 {
            let stream = self.node.get_or_insert_with(|| random.stream(key, Purpose::Node));
            read(stream, 0, node, of.width, &mut self.on_node);
        }
        if !of.spare.places().is_empty() && (self.shaded || !laws.light_alone) {
            let stream = self.node_response.get_or_insert_with(|| random.stream(key, Purpose::NodeResponse));
            read_spare(stream, start(node, NODE_OF_RESPONSES), &of.spare, &mut self.on_node[of.width..]);
        }
    }

    /// Reads the records of the nodes that are planned.
    pub fn read_nodes(&mut self, laws: &OrderLaws, random: &PlantRandom) {
        self.nodes.read(&self.plan, laws.node.width, random);
    }

    /// Reads words of buds before they grow to `age`, one after another in this order: those of their next steps and,
    /// where they make their nodes `one_by_one`, of their next nodes.
    pub fn read_ahead(&mut self, of: (&BudModel, &Plant), buds: &[ApicalBud], age: Tick, one_by_one: bool) {
        self.ahead.read(of, buds, age, one_by_one);
    }

    /// The number of the bud that grows next among those whose words were read ahead, if any.
    pub fn next_ahead(&self) -> usize {
        self.ahead.next()
    }

    /// Leaves out the words of buds that have grown without [`Self::take_ahead`]: the bud `next` grows next.
    pub fn go_on_ahead_from(&mut self, next: usize) {
        self.ahead.go_on_from(next);
    }

    /// The records of steps at hand, and the plan: those that were read ahead for the bud `ahead`, else those that were
    /// read last.
    #[inline]
    pub fn at_hand(&mut self, ahead: Option<usize>) -> (AtHand<'_>, &mut Plan) {
        let at_hand = match ahead {
            Some(nth) => self.ahead.steps_of(nth),
            None => AtHand { words: &self.steps.words, first: self.steps.first, number: self.steps.number },
        };
        (at_hand, &mut self.plan)
    }

    /// Reads records of steps for [`Self::at_hand`], from `step` on, of an axis that may go through `ahead` from it on;
    /// `begins` where these are the first that are not read ahead.
    #[inline(never)]
    pub fn read_on(
        &mut self,
        laws: &OrderLaws,
        random: &PlantRandom,
        key: LineageKey,
        (step, ahead): (u32, u32),
        begins: bool,
    ) {
        if begins {
            self.bud = None;
        }
        self.read_more_steps(laws, random, key, (step, ahead), !begins || step > 0);
    }

    /// Takes the record of the node at a place of the plan as that of the node which is made next.
    #[inline]
    pub fn take_planned(&mut self, node: usize, width: usize) {
        let record = self.nodes.records[node] as usize;
        self.on_node[..width].copy_from_slice(&self.nodes.words()[record..record + width]);
    }

    /// Lets the bud of an axis that has grown to its age join the living ones.
    #[inline]
    pub fn live_on(&mut self, bud: ApicalBud) {
        let Self { plan, living, .. } = self;
        if let Some(shoot) = plan.shoots.last_mut().filter(|shoot| shoot.bud.axis == bud.axis) {
            shoot.living = Some(living.len());
        }
        living.push(bud);
    }

    /// Makes `living` the buds that have grown to their age and live. Memory is exchanged where that is no waste: it is
    /// lent to other plants.
    pub fn give_living(&mut self, living: &mut Vec<ApicalBud>) {
        living.clear();
        if self.living.capacity() <= 2 * self.living.len() {
            std::mem::swap(living, &mut self.living);
        } else {
            living.append(&mut self.living);
        }
    }

    /// Takes the words that were read ahead for the bud which grows next, if any.
    pub fn take_ahead(&mut self, laws: &OrderLaws) {
        let width = laws.step.width;
        self.ahead.go_on(&mut self.of_bud);
        let has_responses = !laws.step.spare.places().is_empty() && self.responds(laws);
        if self.of_bud.steps > 0 && !has_responses {
            // They are read where they stand.
            let begin = self.of_bud.words.start as usize;
            let (first, number) = (self.of_bud.first, self.of_bud.steps);
            (self.steps.first, self.steps.number, self.steps.are_ahead) = (first, number, true);
            (self.steps.begin, self.steps.place) = (begin, begin);
        } else if self.of_bud.steps > 0 {
            let (first, number) = (self.of_bud.first, self.of_bud.steps as usize);
            let into = self.steps.begin_at(first, number, laws.step.spare.words() + (number - 1) * width);
            into[..number * width].copy_from_slice(self.ahead.of_steps(&self.of_bud));
        }
    }

    /// Whether the words of the next step are at hand.
    #[inline]
    pub fn are_ahead(&self) -> bool {
        self.of_bud.steps > 0
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

/// Records of clock steps that follow one another.
#[derive(Debug, Default)]
struct Steps {
    words: Vec<u32>,
    /// The first step, from 0, and how many they are.
    first: u32,
    number: u32,
    /// The place of the record that is asked for, and of the first.
    place: usize,
    begin: usize,
    /// Whether they stand among the words that were read ahead.
    are_ahead: bool,
}

impl Steps {
    /// Forgets the records of the axis before. A quantity without words reads word 0 and ignores it.
    fn of(&mut self, laws: &OrderLaws) {
        (self.first, self.number, self.place, self.begin, self.are_ahead) = (0, 0, 0, 0, false);
        let least = laws.step.spare.words();
        if self.words.len() < least {
            self.words.resize(least, 0);
        }
    }

    /// Goes to the record of a step. Whether it is here.
    #[inline(always)]
    fn go_to(&mut self, step: u32, width: usize) -> bool {
        let nth = step.wrapping_sub(self.first);
        let is_here = nth < self.number;
        if is_here {
            self.place = self.begin + nth as usize * width;
        }
        is_here
    }

    /// Room for `number` records from the step `first` on, in `words` words.
    fn begin_at(&mut self, first: u32, number: usize, words: usize) -> &mut [u32] {
        (self.first, self.number, self.place, self.begin, self.are_ahead) = (first, number as u32, 0, 0, false);
        if self.words.len() < words {
            self.words.resize(words, 0);
        }
        &mut self.words
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
