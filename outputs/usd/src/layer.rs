//! What a USD layer is made of: prims in a tree, with attributes, relationships, connections and variants.
//!
//! A [`Layer`] is written from its first prim to its last, and each attribute as a whole, so that memory holds one
//! value at a time, or two. A value that changes is asked for by its number, once for each different value in a binary
//! file, where two are made at a time, and once for each time in a text. Absent: what the prims mean, which is the
//! schemas' of USD and of the writers above.

use std::io;

/// What a layer says of itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// The name of its one prim at the root.
    pub root: String,
    /// What it is, in words.
    pub words: String,
    /// The first and the last time code, and the time codes of a second; `None` for a still.
    pub time: Option<[f64; 3]>,
}

/// A value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Data<'a> {
    /// A word of a schema.
    Token(&'a str),
    /// A text.
    Text(&'a str),
    /// Yes or no.
    Flag(bool),
    /// One number.
    Float(f32),
    /// Three numbers.
    Triple([f32; 3]),
    /// Four numbers.
    Quad([f32; 4]),
    /// Another file, by its path.
    File(&'a str),
    /// Whole numbers.
    Ints(&'a [i32]),
    /// Whole numbers of 64 bits.
    Longs(&'a [i64]),
    /// Numbers.
    Floats(&'a [f32]),
    /// Pairs of numbers, as texture coordinates are.
    Pairs(&'a [[f32; 2]]),
    /// Triples.
    Triples(&'a [[f32; 3]]),
    /// Rotations as the bits of half precision: x, y, z and the real part.
    Turns(&'a [[u16; 4]]),
}

/// An attribute without its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attribute<'a> {
    /// Its name, with its namespaces.
    pub name: &'a str,
    /// The name of its type, such as `point3f[]`.
    pub of: &'static str,
    /// Whether it never changes.
    pub uniform: bool,
    /// How a primvar goes over its surface.
    pub interpolation: Option<&'static str>,
}

impl<'a> Attribute<'a> {
    /// An attribute that may change.
    pub fn new(name: &'a str, of: &'static str) -> Self {
        Self { name, of, uniform: false, interpolation: None }
    }

    /// An attribute that never changes.
    pub fn uniform(name: &'a str, of: &'static str) -> Self {
        Self { uniform: true, ..Self::new(name, of) }
    }

    /// A primvar, or normals.
    pub fn over(name: &'a str, of: &'static str, interpolation: &'static str) -> Self {
        Self { interpolation: Some(interpolation), ..Self::new(name, of) }
    }
}

/// The value of an attribute.
pub enum Value<'v, 'd> {
    /// It has none of its own.
    None,
    /// The same at all times.
    Always(Data<'d>),
    /// At each of some times the value of a number, and a function that makes the value of each number.
    Timed(&'v [(f64, usize)], &'v Values<'v>),
    /// That of another attribute, by its path.
    Of(&'v str),
}

/// Makes the value of a number; two threads may ask at once.
pub type Values<'v> = dyn Fn(usize) -> io::Result<List> + Sync + 'v;

/// A value that is a list, and belongs to who has it.
#[derive(Debug, Clone, PartialEq)]
pub enum List {
    /// Whole numbers.
    Ints(Vec<i32>),
    /// Whole numbers of 64 bits.
    Longs(Vec<i64>),
    /// Numbers.
    Floats(Vec<f32>),
    /// Pairs of numbers, as texture coordinates are.
    Pairs(Vec<[f32; 2]>),
    /// Triples.
    Triples(Vec<[f32; 3]>),
    /// Rotations as the bits of half precision: x, y, z and the real part.
    Turns(Vec<[u16; 4]>),
}

impl List {
    /// The value.
    pub fn data(&self) -> Data<'_> {
        match self {
            Self::Ints(list) => Data::Ints(list),
            Self::Longs(list) => Data::Longs(list),
            Self::Floats(list) => Data::Floats(list),
            Self::Pairs(list) => Data::Pairs(list),
            Self::Triples(list) => Data::Triples(list),
            Self::Turns(list) => Data::Turns(list),
        }
    }
}

/// A set of variants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variants<'a> {
    /// The name of the set.
    pub set: &'a str,
    /// The names of the variants.
    pub names: &'a [String],
}

/// A layer that is being written.
pub trait Layer {
    /// Begins a prim of a type within the one that is open, with API schemas.
    ///
    /// # Errors
    /// Those of the file, as of all that follows.
    fn begin(&mut self, of: &'static str, name: &str, schemas: &[&str]) -> io::Result<()>;

    /// Begins a prim of a type within the one that is open, which has a set of variants, of which the first is chosen;
    /// nothing else follows in it but these variants, and then the end of the set and of the prim.
    ///
    /// # Errors
    /// Those of the file.
    fn begin_varied(&mut self, of: &'static str, name: &str, variants: &Variants) -> io::Result<()>;

    /// Begins a variant of the set that is open.
    ///
    /// # Errors
    /// Those of the file.
    fn begin_variant(&mut self, name: &str) -> io::Result<()>;

    /// Writes an attribute of the open prim.
    ///
    /// # Errors
    /// Those of the file, and of the function that makes values.
    fn attribute(&mut self, attribute: Attribute, value: Value) -> io::Result<()>;

    /// Writes a relationship of the open prim to prims, by their paths.
    ///
    /// # Errors
    /// Those of the file.
    fn relationship(&mut self, name: &str, targets: &[String]) -> io::Result<()>;

    /// Ends the open prim, variant or set of variants.
    ///
    /// # Errors
    /// Those of the file.
    fn end(&mut self) -> io::Result<()>;

    /// Ends the layer.
    ///
    /// # Errors
    /// Those of the file.
    fn finish(&mut self) -> io::Result<()>;
}
