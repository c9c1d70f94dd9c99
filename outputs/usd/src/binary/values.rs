//! Values of a binary layer: their types, their representations, and how they lie in the file.

use super::ints;
use bytemuck::{NoUninit, cast_slice};
use phytomer_meshes::Patched;
use std::io;

/// The types of values that we write, by their numbers (crateDataTypes.h).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
    Bool = 1,
    Int = 3,
    Int64 = 5,
    Float = 8,
    Double = 9,
    String = 10,
    Token = 11,
    AssetPath = 12,
    Quath = 18,
    Vec2f = 20,
    Vec3f = 24,
    Vec4f = 28,
    TokenListOp = 32,
    StringListOp = 33,
    PathListOp = 34,
    TokenVector = 41,
    Specifier = 42,
    Variability = 44,
    VariantSelectionMap = 45,
    TimeSamples = 46,
    DoubleVector = 48,
}

const ARRAY: u64 = 1 << 63;
const INLINED: u64 = 1 << 62;
const COMPRESSED: u64 = 1 << 61;

/// Lists with fewer whole numbers are not compressed.
const FEWEST_COMPRESSED: usize = 16;

/// Whether a list of whole numbers is compressed.
pub fn is_packed<T>(list: &[T]) -> bool {
    list.len() >= FEWEST_COMPRESSED
}

/// How lists of edits begin: which lists follow.
const EXPLICIT: u8 = 1 | 2;
const PREPENDED: u8 = 32;

/// The representation of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rep(pub u64);

impl Rep {
    /// A value that is its own representation.
    pub fn inlined(of: Type, value: u32) -> Self {
        Self(INLINED | (of as u64) << 48 | u64::from(value))
    }

    fn at(of: Type, place: u64, flags: u64) -> Self {
        Self(flags | (of as u64) << 48 | place)
    }
}

/// The values of a layer, one after another.
pub struct Values<'o> {
    out: &'o mut dyn Patched,
    place: u64,
}

impl<'o> Values<'o> {
    /// Nothing yet.
    pub fn of(out: &'o mut dyn Patched) -> Self {
        Self { out, place: 0 }
    }

    /// The place in the file of what comes next.
    pub fn place(&self) -> u64 {
        self.place
    }

    /// Writes bytes.
    ///
    /// # Errors
    /// Those of the file, as of all that follows.
    pub fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.place += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    /// Writes a whole number of 64 bits.
    ///
    /// # Errors
    /// Those of the file.
    pub fn put_long(&mut self, number: u64) -> io::Result<()> {
        self.put(&number.to_le_bytes())
    }

    /// Writes over bytes at a place.
    ///
    /// # Errors
    /// Those of the file.
    pub fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        self.out.flush()?;
        self.out.patch(at, bytes)
    }

    /// Goes on to a place that is divided by eight, so that readers need not copy.
    fn align(&mut self) -> io::Result<u64> {
        let rest = (self.place.next_multiple_of(8) - self.place) as usize;
        self.put(&[0; 8][..rest])?;
        Ok(self.place)
    }

    /// Writes a value of one piece.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write(&mut self, of: Type, bytes: &[u8]) -> io::Result<Rep> {
        let place = self.align()?;
        self.put(bytes)?;
        Ok(Rep::at(of, place, 0))
    }

    /// Writes a double, which is its own representation where single precision holds it.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_double(&mut self, number: f64) -> io::Result<Rep> {
        let short = number as f32;
        if f64::from(short) == number {
            return Ok(Rep::inlined(Type::Double, short.to_bits()));
        }
        self.write(Type::Double, &number.to_le_bytes())
    }

    /// Writes a list.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_list<T: NoUninit>(&mut self, of: Type, list: &[T]) -> io::Result<Rep> {
        if list.is_empty() {
            return Ok(Rep::at(of, 0, ARRAY));
        }
        let place = self.align()?;
        self.put_long(list.len() as u64)?;
        self.put(cast_slice(list))?;
        Ok(Rep::at(of, place, ARRAY))
    }

    /// Writes a list of whole numbers.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_ints(&mut self, list: &[i32]) -> io::Result<Rep> {
        if !is_packed(list) {
            return self.write_list(Type::Int, list);
        }
        let packed = ints::pack(list);
        self.write_packed(Type::Int, list.len(), &packed)
    }

    /// Writes a list of whole numbers of 64 bits.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_longs(&mut self, list: &[i64]) -> io::Result<Rep> {
        if !is_packed(list) {
            return self.write_list(Type::Int64, list);
        }
        let packed = ints::pack_longs(list);
        self.write_packed(Type::Int64, list.len(), &packed)
    }

    /// Writes so many whole numbers that are packed.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_packed(&mut self, of: Type, count: usize, packed: &[u8]) -> io::Result<Rep> {
        let place = self.align()?;
        self.put_long(count as u64)?;
        self.put_long(packed.len() as u64)?;
        self.put(packed)?;
        Ok(Rep::at(of, place, ARRAY | COMPRESSED))
    }

    /// Writes a list of numbers of words.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_words(&mut self, of: Type, words: &[u32]) -> io::Result<Rep> {
        let place = self.align()?;
        self.put_long(words.len() as u64)?;
        self.put(cast_slice(words))?;
        Ok(Rep::at(of, place, 0))
    }

    /// Writes which variant of a set is chosen, by the numbers of two strings.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_choice(&mut self, set: u32, variant: u32) -> io::Result<Rep> {
        let place = self.align()?;
        self.put_long(1)?;
        self.put(cast_slice(&[set, variant]))?;
        Ok(Rep::at(Type::VariantSelectionMap, place, 0))
    }

    /// Writes a list that stands for itself.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_explicit(&mut self, of: Type, items: &[u32]) -> io::Result<Rep> {
        self.write_edits(of, EXPLICIT, items)
    }

    /// Writes a list that goes before what weaker layers have.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_prepended(&mut self, of: Type, items: &[u32]) -> io::Result<Rep> {
        self.write_edits(of, PREPENDED, items)
    }

    fn write_edits(&mut self, of: Type, header: u8, items: &[u32]) -> io::Result<Rep> {
        let place = self.align()?;
        self.put(&[header])?;
        self.put_long(items.len() as u64)?;
        self.put(cast_slice(items))?;
        Ok(Rep::at(of, place, 0))
    }

    /// Writes the times of samples and the representations of their values.
    ///
    /// # Errors
    /// Those of the file.
    pub fn write_samples(&mut self, samples: &[(f64, Rep)]) -> io::Result<Rep> {
        let times = self.align()?;
        self.put_long(samples.len() as u64)?;
        samples.iter().try_for_each(|(time, _)| self.put(&time.to_le_bytes()))?;
        let place = self.align()?;
        // Where the representation of the times is, from here; and then where the values are.
        self.put_long(8)?;
        self.put_long(Rep::at(Type::DoubleVector, times, 0).0)?;
        self.put_long(8)?;
        self.put_long(samples.len() as u64)?;
        samples.iter().try_for_each(|(_, rep)| self.put_long(rep.0))?;
        Ok(Rep::at(Type::TimeSamples, place, 0))
    }
}
