//! The order in which the modules of a string stand, as links: for each slot the slot behind it, and, where it is asked
//! for, the slot before it.
//!
//! The slots before are kept where a production looks to the left, and from the first module on that is taken out. In
//! other strings nothing asks for them, and each rewriting would note its last module at the module behind it, which is
//! mostly old and lies far from all else that is written. Absent: what stands in the slots (`string`).

/// No slot: before the first module and after the last.
pub(crate) const NONE: u32 = u32::MAX;

/// The order of modules.
#[derive(Debug, Clone)]
pub(crate) struct Links {
    next: Vec<u32>,
    /// `None` where it is not kept.
    previous: Option<Vec<u32>>,
    head: u32,
    tail: u32,
}

impl Links {
    /// Those of no module. Where they are not kept `both_ways`, [`Links::before`] tells nothing.
    pub fn new(both_ways: bool) -> Self {
        Self { next: Vec::new(), previous: both_ways.then(Vec::new), head: NONE, tail: NONE }
    }

    /// Forgets all modules and keeps the memory.
    pub fn clear(&mut self, both_ways: bool) {
        self.next.clear();
        let mut previous = self.previous.take().unwrap_or_default();
        previous.clear();
        self.previous = both_ways.then_some(previous);
        (self.head, self.tail) = (NONE, NONE);
    }

    /// How many bytes the links of one module take.
    pub fn bytes_each(&self) -> usize {
        size_of::<u32>() * (1 + usize::from(self.previous.is_some()))
    }

    /// The first and the last module.
    #[inline]
    pub fn ends(&self) -> [u32; 2] {
        [self.head, self.tail]
    }

    /// The slot behind a module.
    #[inline]
    pub fn behind(&self, slot: u32) -> u32 {
        self.next[slot as usize]
    }

    /// The slot before a module.
    #[inline]
    pub fn before(&self, slot: u32) -> u32 {
        debug_assert!(self.previous.is_some(), "a string whose productions do not look to the left");
        self.previous.as_ref().map_or(NONE, |previous| previous[slot as usize])
    }

    /// Makes room for so many slots more.
    pub fn reserve(&mut self, more: usize) {
        self.next.reserve_exact(more);
        self.previous.iter_mut().for_each(|previous| previous.reserve_exact(more));
    }

    /// Adds a slot that is not linked yet.
    pub fn add(&mut self) {
        self.next.push(NONE);
        self.previous.iter_mut().for_each(|previous| previous.push(NONE));
    }

    /// Puts a slot behind another, or before all others.
    #[inline]
    pub fn insert(&mut self, after: u32, slot: u32) {
        let next = if after == NONE { self.head } else { self.next[after as usize] };
        self.next[slot as usize] = next;
        self.put_behind(after, slot);
        if let Some(previous) = &mut self.previous {
            previous[slot as usize] = after;
        }
        self.put_before(next, slot);
    }

    /// Adds so many slots, at least one, in a row behind another; returns the first.
    #[inline]
    pub fn insert_row(&mut self, after: u32, count: u32) -> u32 {
        let (start, next) = (self.next.len() as u32, self.next[after as usize]);
        let last = start + count - 1;
        self.next.extend(start + 1..=last);
        self.next.push(next);
        if let Some(previous) = &mut self.previous {
            previous.push(after);
            previous.extend(start..last);
        }
        self.put_behind(after, start);
        self.put_before(next, last);
        start
    }

    /// Takes a slot out; returns the slot before it.
    pub fn remove(&mut self, slot: u32) -> u32 {
        if self.previous.is_none() {
            self.link_back();
        }
        let (before, behind) = (self.before(slot), self.behind(slot));
        self.put_behind(before, behind);
        self.put_before(behind, before);
        before
    }

    #[inline]
    fn put_behind(&mut self, before: u32, slot: u32) {
        match before {
            NONE => self.head = slot,
            before => self.next[before as usize] = slot,
        }
    }

    #[inline]
    fn put_before(&mut self, behind: u32, slot: u32) {
        if behind == NONE {
            self.tail = slot;
        } else if let Some(previous) = &mut self.previous {
            previous[behind as usize] = slot;
        }
    }

    /// Finds the slots before all modules, which are kept from then on.
    #[cold]
    fn link_back(&mut self) {
        let mut previous = vec![NONE; self.next.len()];
        let (mut before, mut at) = (NONE, self.head);
        while at != NONE {
            previous[at as usize] = before;
            (before, at) = (at, self.next[at as usize]);
        }
        self.previous = Some(previous);
    }
}
