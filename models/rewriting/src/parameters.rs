//! The parameters of all modules of a string, in one flat column.
//!
//! What a module leaves is used again by another with as many parameters. Absent: which module begins where (`string`).

use crate::symbol::Symbol;

/// The parameters of no module that a column may keep beside as many as its modules have.
const MOST_FREE: usize = 4096;

/// A column of parameters.
#[derive(Debug, Clone)]
pub(crate) struct Parameters {
    pub values: Vec<f64>,
    /// Where parameters may begin that belong to no module, by their number.
    free: Vec<Vec<u32>>,
    /// How many parameters belong to no module.
    free_count: usize,
}

impl Parameters {
    /// An empty column for modules of at most so many parameters.
    pub fn new(most: usize) -> Self {
        Self { values: Vec::new(), free: vec![Vec::new(); most + 1], free_count: 0 }
    }

    /// Forgets all and keeps the memory, for modules of at most so many parameters.
    pub fn clear(&mut self, most: usize) {
        self.values.clear();
        self.free.iter_mut().for_each(Vec::clear);
        self.free.resize(most + 1, Vec::new());
        self.free_count = 0;
    }

    /// An empty column for the same modules, with room for what this one holds.
    pub fn anew(&self) -> Self {
        Self { values: Vec::with_capacity(self.count()), ..Self::new(self.free.len().saturating_sub(1)) }
    }

    /// How many parameters all modules have.
    pub fn count(&self) -> usize {
        self.values.len().saturating_sub(self.free_count)
    }

    /// Whether every parameter belongs to a module.
    #[inline]
    pub fn is_dense(&self) -> bool {
        self.free_count == 0
    }

    /// Whether most parameters belong to no module.
    pub fn is_loose(&self) -> bool {
        self.free_count > MOST_FREE + self.count()
    }

    /// A place for the parameters of a module: where they begin.
    pub fn claim(&mut self, values: &[f64]) -> u32 {
        if values.is_empty() {
            return 0;
        }
        if let Some(first) = self.free.get_mut(values.len()).and_then(Vec::pop) {
            self.free_count -= values.len();
            self.values[first as usize..first as usize + values.len()].copy_from_slice(values);
            return first;
        }
        self.values.extend_from_slice(values);
        (self.values.len() - values.len()) as u32
    }

    /// Parameters that began at `first` belong to no module any more.
    pub fn release(&mut self, first: u32, arity: usize) {
        if arity > 0
            && let Some(free) = self.free.get_mut(arity)
        {
            free.push(first);
            self.free_count += arity;
        }
    }
}

/// The most parameters of a kind.
pub(crate) fn most_of(kinds: &[(Symbol, u16)]) -> usize {
    kinds.iter().map(|&(_, arity)| usize::from(arity)).max().unwrap_or(0)
}
