//! Lists of what a life in the making remembers: of all that has ever been, and of what stands.
//!
//! A list that grows by moving what it has to a larger place is there twice while it moves, and has room to spare
//! afterwards; these are not.

use std::ops::{Index, IndexMut};

/// The entries of a block.
const BLOCK: usize = 1024;

/// Entries one after another, which are never moved.
#[derive(Debug, Clone)]
pub struct Blocks<T>(Vec<Vec<T>>);

impl<T> Default for Blocks<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Blocks<T> {
    /// The number of entries.
    pub fn len(&self) -> usize {
        self.0.last().map_or(0, |last| (self.0.len() - 1) * BLOCK + last.len())
    }

    /// Adds an entry; its place.
    pub fn push(&mut self, entry: T) -> u32 {
        let place = self.len();
        if place.is_multiple_of(BLOCK) {
            // The first block grows as a small plant needs it.
            self.0.push(Vec::with_capacity(if place == 0 { 0 } else { BLOCK }));
        }
        if let Some(block) = self.0.last_mut() {
            block.push(entry);
        }
        place as u32
    }

    /// The entry at a place, where there is one.
    #[inline]
    pub fn get(&self, place: u32) -> Option<&T> {
        self.0.get(place as usize / BLOCK)?.get(place as usize % BLOCK)
    }

    /// The entry at a place, where there is one, to be changed.
    #[inline]
    pub fn get_mut(&mut self, place: u32) -> Option<&mut T> {
        self.0.get_mut(place as usize / BLOCK)?.get_mut(place as usize % BLOCK)
    }

    /// All entries in their order, to be changed.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.0.iter_mut().flatten()
    }

    /// All entries in one list; each block goes when its entries have moved.
    pub fn into_list(self) -> Vec<T> {
        let mut list = Vec::with_capacity(self.len());
        self.0.into_iter().for_each(|block| list.extend(block));
        list
    }
}

impl<T> Index<u32> for Blocks<T> {
    type Output = T;

    #[inline]
    fn index(&self, place: u32) -> &T {
        &self.0[place as usize / BLOCK][place as usize % BLOCK]
    }
}

impl<T> IndexMut<u32> for Blocks<T> {
    #[inline]
    fn index_mut(&mut self, place: u32) -> &mut T {
        &mut self.0[place as usize / BLOCK][place as usize % BLOCK]
    }
}

/// Entries at places that are taken anew when what was there has gone.
#[derive(Debug, Clone)]
pub struct Places<T> {
    entries: Blocks<Option<T>>,
    free: Vec<u32>,
}

impl<T> Default for Places<T> {
    fn default() -> Self {
        Self { entries: Blocks::default(), free: Vec::new() }
    }
}

impl<T> Places<T> {
    /// Adds an entry; its place.
    pub fn add(&mut self, entry: T) -> u32 {
        if let Some(place) = self.free.pop()
            && let Some(free) = self.entries.get_mut(place)
        {
            *free = Some(entry);
            return place;
        }
        self.entries.push(Some(entry))
    }

    /// The entry at a place.
    #[inline]
    pub fn get(&self, place: u32) -> Option<&T> {
        self.entries.get(place)?.as_ref()
    }

    /// The entry at a place, to be changed.
    #[inline]
    pub fn get_mut(&mut self, place: u32) -> Option<&mut T> {
        self.entries.get_mut(place)?.as_mut()
    }

    /// Takes the entry from a place, which is free from then on.
    pub fn take(&mut self, place: u32) -> Option<T> {
        let entry = self.entries.get_mut(place)?.take()?;
        self.free.push(place);
        Some(entry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_keep_their_places_and_their_order() {
        let mut blocks = Blocks::default();
        let places: Vec<u32> = (0..3 * BLOCK as u32 + 7).map(|k| blocks.push(k)).collect();
        assert!((0..).zip(&places).all(|(k, place)| k == *place && blocks[k] == k && blocks.get(k) == Some(&k)));
        assert_eq!((blocks.len(), blocks.get(places.len() as u32)), (places.len(), None));
        blocks[BLOCK as u32] = 5;
        let list = blocks.into_list();
        assert_eq!((list.len(), list.capacity(), list[BLOCK]), (places.len(), places.len(), 5));
    }

    #[test]
    fn a_place_is_taken_anew_when_its_entry_has_gone() {
        let mut places = Places::default();
        assert_eq!(["a", "b", "c"].map(|word| places.add(word)), [0, 1, 2]);
        assert_eq!((places.take(1), places.take(1), places.get(1)), (Some("b"), None, None));
        assert_eq!((places.add("d"), places.add("e")), (1, 3));
        *places.get_mut(3).expect("an entry") = "f";
        assert_eq!((places.get(1).copied(), places.get(3).copied(), places.take(9)), (Some("d"), Some("f"), None));
    }
}
