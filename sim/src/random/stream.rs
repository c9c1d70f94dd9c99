//! The words of one axis for one purpose: sought by position, read one by one or many at once.
//!
//! The block of the next word is kept, so that reading on costs nothing until the block ends. A long read makes its
//! blocks where its words shall stand. Absent: how a block is made (`kernel`).

use super::block::{Block, Name, WORDS};
use super::kernel::Kernel;
use super::share;

/// Stands for no block: no stream is that long.
const NO_BLOCK: u64 = u64::MAX;

/// The blocks that are made at once, at most.
const MANY: usize = 12;

/// The 32-bit words of one axis for one purpose; sought by position, cheap to read forward.
#[derive(Debug, Clone)]
pub struct Stream {
    name: Name,
    position: u64,
    block: u64,
    words: Block,
}

impl Stream {
    pub(super) fn new(name: Name) -> Self {
        Self { name, position: 0, block: NO_BLOCK, words: [0; WORDS] }
    }

    /// Goes to word `position`.
    #[inline]
    pub fn seek(&mut self, position: u64) {
        self.position = position;
    }

    /// The next word, uniform over all 2³² values.
    #[inline]
    pub fn word(&mut self) -> u32 {
        self.reach();
        let word = self.words[self.offset()];
        self.position += 1;
        word
    }

    /// Makes the blocks in which the next words of two streams of one plant stand. Most machines make both in the time
    /// of one: whoever needs words of both reads them afterwards.
    #[inline]
    pub fn reach_both(one: &mut Self, other: &mut Self) {
        Self::reach_both_by(Kernel::fastest(), one, other);
    }

    /// As [`Stream::reach_both`], with the blocks that this kernel makes.
    pub(super) fn reach_both_by(kernel: Kernel, one: &mut Self, other: &mut Self) {
        let blocks = [&*one, &*other].map(|stream| stream.position / WORDS as u64);
        if blocks[0] != one.block && blocks[1] != other.block {
            let of = [(&one.name, blocks[0]), (&other.name, blocks[1])];
            kernel.fill_two(of, [&mut one.words, &mut other.words]);
            (one.block, other.block) = (blocks[0], blocks[1]);
        }
    }

    /// The next word as a number in (0, 1).
    #[inline]
    pub fn share(&mut self) -> f64 {
        share(self.word())
    }

    /// The next words, as many as `into` holds.
    ///
    /// Words are made in blocks of 16. A short read makes the blocks that it touches. A long one makes eight or twelve
    /// at once where the processor can, straight into `into`, in a third to a fifth of the time a block: whoever needs
    /// many words of one stream reads them together.
    #[inline]
    pub fn read(&mut self, into: &mut [u32]) {
        self.read_by(Kernel::fastest(), into);
    }

    /// As [`Stream::read`], with the blocks that this kernel makes.
    #[inline]
    pub(super) fn read_by(&mut self, kernel: Kernel, into: &mut [u32]) {
        let at_hand = if self.position / WORDS as u64 == self.block { WORDS - self.offset() } else { 0 };
        let (ready, later) = into.split_at_mut(at_hand.min(into.len()));
        if !ready.is_empty() {
            let from = self.offset();
            ready.copy_from_slice(&self.words[from..from + ready.len()]);
            self.position += ready.len() as u64;
        }
        if !later.is_empty() {
            self.make(kernel, later);
        }
    }

    /// The next words, none of which stands in the block at hand.
    fn make(&mut self, kernel: Kernel, into: &mut [u32]) {
        let mut left = into;
        while !left.is_empty() {
            if self.offset() == 0 && left.len() >= MANY * WORDS {
                left = self.make_straight(kernel, left);
            } else {
                left = self.make_aside(kernel, left);
            }
        }
    }

    /// Makes whole groups of blocks where their words shall stand; gives back what is left.
    fn make_straight<'a>(&mut self, kernel: Kernel, into: &'a mut [u32]) -> &'a mut [u32] {
        let (now, later) = into.split_at_mut(into.len() / (MANY * WORDS) * (MANY * WORDS));
        let (blocks, _) = now.as_chunks_mut();
        kernel.fill(&self.name, self.position / WORDS as u64, blocks);
        self.position += now.len() as u64;
        later
    }

    /// Makes one group of blocks and copies the words that are asked for; the last block stays at hand.
    fn make_aside<'a>(&mut self, kernel: Kernel, into: &'a mut [u32]) -> &'a mut [u32] {
        let (first, offset) = (self.position / WORDS as u64, self.offset());
        let number = (offset + into.len()).div_ceil(WORDS).min(MANY);
        let (now, later) = into.split_at_mut(into.len().min(number * WORDS - offset));
        if number == 1 {
            kernel.fill(&self.name, first, std::slice::from_mut(&mut self.words));
            now.copy_from_slice(&self.words[offset..offset + now.len()]);
        } else {
            let mut blocks = [[0; WORDS]; MANY];
            kernel.fill(&self.name, first, &mut blocks[..number]);
            now.copy_from_slice(&blocks.as_flattened()[offset..offset + now.len()]);
            self.words = blocks[number - 1];
        }
        self.block = first + number as u64 - 1;
        self.position += now.len() as u64;
        later
    }

    /// The place of the next word in its block.
    #[inline]
    fn offset(&self) -> usize {
        (self.position % WORDS as u64) as usize
    }

    /// Makes the block in which the next word stands.
    #[inline]
    fn reach(&mut self) {
        let block = self.position / WORDS as u64;
        if block != self.block {
            Kernel::fastest().fill(&self.name, block, std::slice::from_mut(&mut self.words));
            self.block = block;
        }
    }
}
