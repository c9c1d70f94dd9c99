//! A column that most plants leave empty: values of some nodes, axes or organs, beside the columns in which each has an
//! entry.
//!
//! The column is as long as the last stated entry; entries between and past its end have the default. A plant that
//! states nothing has an empty column, and reading it costs one comparison with its length.

/// A column of values of which most are the default.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Rare<T> {
    values: Vec<T>,
}

impl<T: Copy + Default> Rare<T> {
    /// Whether no entry was ever stated.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The value at a place; the default where none is stated.
    #[inline]
    pub fn at(&self, place: usize) -> T {
        self.values.get(place).copied().unwrap_or_default()
    }

    /// States the value at a place.
    #[inline]
    pub fn set(&mut self, place: usize, value: T) {
        if self.values.len() == place {
            self.values.push(value);
            return;
        }
        if self.values.len() < place {
            self.values.resize(place + 1, T::default());
        }
        self.values[place] = value;
    }

    /// Adds the entries of another column, each at the place that `place` returns for it.
    pub fn join(&mut self, more: &Self, place: impl Fn(usize) -> usize) {
        for (at, &value) in more.values.iter().enumerate() {
            self.set(place(at), value);
        }
    }

    /// Changes every entry from a place on.
    pub fn change_from(&mut self, place: usize, change: impl Fn(T) -> T) {
        let values = self.values.get_mut(place..).unwrap_or_default();
        values.iter_mut().for_each(|value| *value = change(*value));
    }

    /// Forgets every entry and keeps the memory.
    pub fn clear(&mut self) {
        self.values.clear();
    }
}
