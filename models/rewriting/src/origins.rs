//! Whence modules come: the predecessor and the step of a rewriting, kept once for all modules that it has made.
//!
//! A string keeps the number of an origin with each module. An origin that no module has any more is used again.

use phytomer_sim::key::LineageKey;

/// The origins of the modules of a string.
#[derive(Debug, Clone, Default)]
pub(crate) struct Origins {
    predecessor: Vec<LineageKey>,
    birth: Vec<u32>,
    /// How many modules have each.
    uses: Vec<u32>,
    free: Vec<u32>,
    last: usize,
}

impl Origins {
    /// Forgets all and keeps the memory.
    pub fn clear(&mut self) {
        self.predecessor.clear();
        self.birth.clear();
        self.uses.clear();
        self.free.clear();
        self.last = 0;
    }

    /// The number of an origin, which one more module has.
    #[inline]
    pub fn claim(&mut self, predecessor: LineageKey, birth: u32) -> u32 {
        let last = self.last;
        if self.predecessor.get(last) == Some(&predecessor) && self.birth[last] == birth && self.uses[last] > 0 {
            self.uses[last] += 1;
            return last as u32;
        }
        self.add(predecessor, birth)
    }

    /// The number of an origin, which so many more modules have, at least one.
    #[inline]
    pub fn claim_for(&mut self, predecessor: LineageKey, birth: u32, modules: u32) -> u32 {
        let number = self.claim(predecessor, birth);
        self.uses[number as usize] += modules - 1;
        number
    }

    fn add(&mut self, predecessor: LineageKey, birth: u32) -> u32 {
        let number = match self.free.pop() {
            Some(free) => {
                let number = free as usize;
                (self.predecessor[number], self.birth[number], self.uses[number]) = (predecessor, birth, 1);
                number
            }
            None => {
                self.predecessor.push(predecessor);
                self.birth.push(birth);
                self.uses.push(1);
                self.uses.len() - 1
            }
        };
        self.last = number;
        number as u32
    }

    /// A module less has this origin.
    #[inline]
    pub fn release(&mut self, origin: u32) {
        let uses = &mut self.uses[origin as usize];
        *uses -= 1;
        if *uses == 0 {
            self.free.push(origin);
        }
    }

    /// The key of the predecessor, and the step.
    #[inline]
    pub fn of(&self, origin: u32) -> (LineageKey, u32) {
        (self.predecessor[origin as usize], self.birth[origin as usize])
    }

    /// How many bytes they take.
    pub fn bytes(&self) -> usize {
        (self.uses.len() - self.free.len()) * (size_of::<LineageKey>() + 2 * size_of::<u32>())
    }

    /// How many origins are kept, with those that are free.
    #[cfg(test)]
    pub fn len(&self) -> usize {
        self.uses.len()
    }
}
