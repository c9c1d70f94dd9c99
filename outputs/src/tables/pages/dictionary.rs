//! Values as places in a list of those that have appeared: of numbers, and of the words of a column.
//!
//! The list is in the order in which values first appear. Absent: when a list becomes too large (`chunk`).

use super::numbers::Number;

/// The numbers that have appeared.
pub struct Seen<T> {
    /// In the order in which they appeared.
    pub list: Vec<T>,
    /// Places in the list, plus 1, by the hash of a number's bits; 0 where there is none. Its length is a power of two.
    table: Vec<u32>,
    last: Option<(u64, u32)>,
}

/// Fibonacci hashing: 2⁶⁴ over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl<T: Number> Seen<T> {
    /// No numbers.
    pub fn none() -> Self {
        Self { list: Vec::new(), table: vec![0; 1024], last: None }
    }

    /// The place of a number in the list, to which a new one is added. Numbers are the same if their bits are.
    #[inline]
    pub fn place(&mut self, value: T) -> u32 {
        let bits = value.bits();
        match self.last {
            Some((last, place)) if last == bits => place,
            _ => {
                let place = self.find(value, bits);
                self.last = Some((bits, place));
                place
            }
        }
    }

    fn find(&mut self, value: T, bits: u64) -> u32 {
        if 2 * self.list.len() >= self.table.len() {
            self.grow();
        }
        let mut slot = self.slot(bits);
        while self.table[slot] != 0 {
            let place = self.table[slot] - 1;
            if self.list[place as usize].bits() == bits {
                return place;
            }
            slot = (slot + 1) % self.table.len();
        }
        self.list.push(value);
        self.table[slot] = self.list.len() as u32;
        self.table[slot] - 1
    }

    fn slot(&self, bits: u64) -> usize {
        (bits.wrapping_mul(GOLDEN) >> (u64::BITS - self.table.len().trailing_zeros())) as usize
    }

    fn grow(&mut self) {
        self.table = vec![0; 4 * self.table.len()];
        for place in 0..self.list.len() {
            let mut slot = self.slot(self.list[place].bits());
            while self.table[slot] != 0 {
                slot = (slot + 1) % self.table.len();
            }
            self.table[slot] = place as u32 + 1;
        }
    }
}

/// The words of a column that have appeared.
pub struct SeenWords<'a> {
    /// In the order in which they appeared.
    pub list: Vec<&'a str>,
    /// For each word of the column its place in the list, or [`UNSEEN`].
    places: Vec<u32>,
    /// For each word of the column the first one that is the same.
    same: &'a [u32],
}

const UNSEEN: u32 = u32::MAX;

impl<'a> SeenWords<'a> {
    /// No words of a column whose words are the same as these of it.
    pub fn none(same: &'a [u32]) -> Self {
        Self { list: Vec::new(), places: vec![UNSEEN; same.len()], same }
    }

    /// The place of a word in the list, to which a new one is added.
    #[inline]
    pub fn place(&mut self, word: usize, words: &'a [String]) -> u32 {
        let first = self.same[word] as usize;
        if self.places[first] == UNSEEN {
            self.places[first] = self.list.len() as u32;
            self.list.push(&words[first]);
        }
        self.places[first]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_listed_as_they_appear() {
        let mut seen = Seen::none();
        let values: Vec<i64> = (0..5_000).map(|k| (k * k) % 2_003 - 7).collect();
        let places: Vec<u32> = values.iter().map(|value| seen.place(*value)).collect();
        let mut list = Vec::new();
        for (value, place) in values.iter().zip(places) {
            let known = list.iter().position(|known| known == value).unwrap_or_else(|| {
                list.push(*value);
                list.len() - 1
            });
            assert_eq!(place as usize, known);
        }
        assert_eq!(seen.list, list);
        let mut zeros = Seen::none();
        assert_eq!([0.0_f32, -0.0, f32::NAN, f32::NAN].map(|value| zeros.place(value)), [0, 1, 2, 2]);
    }

    #[test]
    fn equal_words_are_one() {
        let words = ["a", "b", "a"].map(str::to_owned);
        let mut seen = SeenWords::none(&[0, 1, 0]);
        assert_eq!([2, 1, 0, 2].map(|word| seen.place(word, &words)), [0, 1, 0, 0]);
        assert_eq!(seen.list, ["a", "b"]);
    }
}
