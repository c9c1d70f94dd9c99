//! The declaration of a column of a table: name, type, unit, encoding and meaning.
//!
//! The lists of columns are in [`super::columns`]. Absent: Arrow and Parquet schemas, which [`super::arrow`] makes.

/// The type of a column's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
    /// True or false.
    Bool,
    /// A 32-bit signed integer.
    Int,
    /// A 64-bit signed integer.
    Key,
    /// A day of the calendar.
    Date,
    /// A 32-bit real number.
    Float,
    /// A 64-bit real number.
    Double,
    /// One word of a closed list, as a dictionary string.
    Word(&'static [&'static str]),
    /// A name that the run states, as a dictionary string; the list of names has any length.
    Name(Named),
}

/// The kinds of names that a run states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Named {
    /// The treatment of a plot.
    Treatment,
    /// The species of a plant.
    Species,
    /// A state of an apical bud, as a species names it.
    State,
}

/// How a column is encoded in Parquet, before compression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// PLAIN: hashes and truth values, in which no order can be found.
    Plain,
    /// DELTA_BINARY_PACKED: numbers that climb or stay.
    Delta,
    /// A dictionary: few values, often repeated.
    Dictionary,
    /// BYTE_STREAM_SPLIT, never a dictionary: measured real numbers.
    Split,
    /// A small dictionary that gives way to BYTE_STREAM_SPLIT: real numbers that laws repeat.
    Repeated,
}

/// The effect of the optional rounding on a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// No rounding.
    Exact,
    /// A position: rounded to the stated precision.
    Position,
    /// A component of a unit vector: rounded to 2⁻¹².
    Direction,
}

/// One column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Its name, with the unit in it.
    pub name: &'static str,
    /// The type of its values.
    pub holds: Type,
    /// Its encoding in Parquet.
    pub encoding: Encoding,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// Whether it may be null.
    pub nullable: bool,
    /// The effect of the optional rounding.
    pub rounding: Rounding,
    /// Its meaning, in a sentence for the reader of the table.
    pub description: &'static str,
}

impl Column {
    pub(super) const fn new(name: &'static str, holds: Type, encoding: Encoding, description: &'static str) -> Self {
        Self { name, holds, encoding, unit: "", nullable: false, rounding: Rounding::Exact, description }
    }

    pub(super) const fn id(name: &'static str, description: &'static str) -> Self {
        Self::new(name, Type::Int, Encoding::Delta, description)
    }

    pub(super) const fn small(name: &'static str, description: &'static str) -> Self {
        Self::new(name, Type::Int, Encoding::Dictionary, description)
    }

    pub(super) const fn tick(name: &'static str, description: &'static str) -> Self {
        Self::new(name, Type::Int, Encoding::Dictionary, description).unit("tick")
    }

    pub(super) const fn word(name: &'static str, words: &'static [&'static str], description: &'static str) -> Self {
        Self::new(name, Type::Word(words), Encoding::Dictionary, description)
    }

    pub(super) const fn truth(name: &'static str, description: &'static str) -> Self {
        Self::new(name, Type::Bool, Encoding::Plain, description)
    }

    pub(super) const fn float(name: &'static str, unit: &'static str, description: &'static str) -> Self {
        Self::new(name, Type::Float, Encoding::Split, description).unit(unit)
    }

    pub(super) const fn double(name: &'static str, unit: &'static str, description: &'static str) -> Self {
        Self::new(name, Type::Double, Encoding::Split, description).unit(unit)
    }

    pub(super) const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    pub(super) const fn repeated(self) -> Self {
        Self { encoding: Encoding::Repeated, ..self }
    }

    pub(super) const fn rounded(self, rounding: Rounding) -> Self {
        Self { rounding, ..self }
    }

    pub(super) const fn or_null(self) -> Self {
        Self { nullable: true, ..self }
    }
}
