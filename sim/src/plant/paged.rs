//! A column of which few nodes have an entry, in pages: those alone are kept in which something is stated.
//!
//! A plant of a hundred thousand nodes of which one in a thousand states something keeps little, and need not move it
//! as it grows. Reading costs one look at the place of the page more than a plain column.

/// The entries of a page.
const PAGE: usize = 32;

/// A column of values of which most are the default.
#[derive(Debug, Clone, Default)]
pub(crate) struct Paged<T> {
    /// One more than the place of the last entry that was stated.
    length: usize,
    /// The number of each page among those that are kept, from 1; 0 where it is not.
    pages: Vec<u32>,
    kept: Vec<[T; PAGE]>,
}

impl<T: Copy + Default + PartialEq> Paged<T> {
    /// Whether no entry was ever stated.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// The value at a place; the default where none is stated.
    #[inline]
    pub fn at(&self, place: usize) -> T {
        match self.pages.get(place / PAGE) {
            None | Some(0) => T::default(),
            Some(page) => self.kept[*page as usize - 1][place % PAGE],
        }
    }

    /// States the value at a place.
    #[inline]
    pub fn set(&mut self, place: usize, value: T) {
        self.length = self.length.max(place + 1);
        let page = place / PAGE;
        if self.pages.len() <= page {
            self.pages.resize(page + 1, 0);
        }
        if self.pages[page] == 0 {
            if value == T::default() {
                return;
            }
            self.kept.push([T::default(); PAGE]);
            self.pages[page] = self.kept.len() as u32;
        }
        self.kept[self.pages[page] as usize - 1][place % PAGE] = value;
    }

    /// Adds the entries of another column, each at the place that `place` returns for it.
    pub fn join(&mut self, more: &Self, place: impl Fn(usize) -> usize) {
        (0..more.length).for_each(|at| self.set(place(at), more.at(at)));
    }

    /// Forgets every entry and keeps the memory.
    pub fn clear(&mut self) {
        self.length = 0;
        self.pages.clear();
        self.kept.clear();
    }
}

impl<T: Copy + Default + PartialEq> PartialEq for Paged<T> {
    fn eq(&self, other: &Self) -> bool {
        self.length == other.length && (0..self.length).all(|place| self.at(place) == other.at(place))
    }
}

#[cfg(test)]
mod tests {
    use super::Paged;

    /// Beside a plain column in which what is between the entries has the default.
    #[test]
    fn entries_are_where_they_were_stated_and_all_others_have_the_default() {
        let (mut paged, mut plain) = (Paged::default(), vec![0_u32; 0]);
        let mut state = 5_u64;
        for round in 1..400 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (place, value) = ((state >> 40) as usize % (8 * round), (state >> 33) as u32 % 3);
            plain.resize(plain.len().max(place + 1), 0);
            plain[place] = value;
            paged.set(place, value);
            assert!((0..plain.len() + 70).all(|at| paged.at(at) == plain.get(at).copied().unwrap_or(0)));
        }
        let mut moved = Paged::default();
        moved.join(&paged, |at| 2 * at + 1);
        assert!((0..plain.len()).all(|at| moved.at(2 * at + 1) == plain[at] && moved.at(2 * at) == 0));
        assert!(moved != paged && paged.clone() == paged);
        paged.clear();
        assert!(paged.is_empty() && paged.at(0) == 0 && paged == Paged::default());
    }
}
