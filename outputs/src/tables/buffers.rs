//! Column buffers: filled row by row, lent to Arrow without a copy, and emptied for reuse.
//!
//! While a buffer is filled, a negative integer, a NaN or [`NO_DATE`] stands for null; they become nulls when the
//! buffer is lent and never reach a file. [`columns!`] makes a struct of buffers from a table's columns and the
//! expressions of their values in a row.

use super::schema::{Column, Rounding};
use arrow_array::types::{ArrowPrimitiveType, Date32Type, Float32Type, Float64Type, Int8Type, Int32Type, Int64Type};
use arrow_array::{ArrayRef, BooleanArray, DictionaryArray, PrimitiveArray, StringArray};
use arrow_buffer::{ArrowNativeType, BooleanBuffer, Buffer, NullBuffer, ScalarBuffer};
use arrow_schema::ArrowError;
use phytomer_sim::{NEVER, Tick};
use std::sync::Arc;

/// The integer that stands for null in a buffer.
pub const NULL: i32 = -1;

/// The day that stands for null in a buffer.
pub const NO_DATE: i32 = i32::MIN;

/// The values of one column.
#[derive(Debug)]
pub enum Values {
    /// Days since 1970-01-01; [`NO_DATE`] for null.
    Date(Vec<i32>),
    /// 0, 1, or −1 for null.
    Bool(Vec<i8>),
    /// 32-bit integers; negative for null.
    Int(Vec<i32>),
    /// 64-bit integers, never null.
    Key(Vec<i64>),
    /// 32-bit real numbers; NaN for null.
    Float(Vec<f32>),
    /// 64-bit real numbers; NaN for null.
    Double(Vec<f64>),
    /// Indices into the column's list of words; negative for null.
    Word(Vec<i8>),
    /// Indices into the run's list of names; negative for null.
    Name(Vec<i32>),
}

impl Values {
    /// Empties the buffer and keeps its memory.
    pub fn clear(&mut self) {
        match self {
            Self::Bool(values) | Self::Word(values) => values.clear(),
            Self::Int(values) | Self::Name(values) | Self::Date(values) => values.clear(),
            Self::Key(values) => values.clear(),
            Self::Float(values) => values.clear(),
            Self::Double(values) => values.clear(),
        }
    }
}

/// The memory of a lent buffer, which can be taken back after the array is dropped.
#[derive(Debug)]
pub enum Lent {
    /// Arrow got a copy: this is the buffer itself.
    Kept(Values),
    /// 32-bit numbers.
    Int(Buffer),
    /// 64-bit numbers.
    Key(Buffer),
    /// Real numbers.
    Float(Buffer),
    /// Real numbers, 64 bits wide.
    Double(Buffer),
    /// Places in a list of words.
    Word(Buffer),
    /// Places in a list of names.
    Name(Buffer),
    /// Days.
    Date(Buffer),
}

impl Lent {
    /// The buffer, emptied, with its memory.
    pub fn take_back(self) -> Values {
        match self {
            Self::Kept(Values::Bool(mut values)) => {
                values.clear();
                Values::Bool(values)
            }
            Self::Kept(values) => values,
            Self::Int(buffer) => Values::Int(emptied(buffer)),
            Self::Key(buffer) => Values::Key(emptied(buffer)),
            Self::Float(buffer) => Values::Float(emptied(buffer)),
            Self::Double(buffer) => Values::Double(emptied(buffer)),
            Self::Word(buffer) => Values::Word(emptied(buffer)),
            Self::Name(buffer) => Values::Name(emptied(buffer)),
            Self::Date(buffer) => Values::Date(emptied(buffer)),
        }
    }
}

fn emptied<N: ArrowNativeType>(buffer: Buffer) -> Vec<N> {
    let mut values = buffer.into_vec().unwrap_or_default();
    values.clear();
    values
}

/// The Arrow array of `values`, and the lent buffer. `words` are the words or names of the column. Takes O(n) for n
/// values, and copies only booleans.
///
/// # Errors
/// Where the index of a word is not in the list.
pub fn lend(values: Values, column: &Column, words: &Arc<StringArray>) -> Result<(ArrayRef, Lent), ArrowError> {
    let nullable = column.nullable;
    Ok(match values {
        Values::Bool(values) => (truths(&values, nullable), Lent::Kept(Values::Bool(values))),
        Values::Int(values) => {
            let (array, buffer) = numbers::<Int32Type>(values, nullable, |value| value >= 0);
            (Arc::new(array), Lent::Int(buffer))
        }
        Values::Key(values) => {
            let (array, buffer) = numbers::<Int64Type>(values, false, |_| true);
            (Arc::new(array), Lent::Key(buffer))
        }
        Values::Date(values) => {
            let (array, buffer) = numbers::<Date32Type>(values, nullable, |value| value != NO_DATE);
            (Arc::new(array), Lent::Date(buffer))
        }
        Values::Float(values) => {
            let (array, buffer) = numbers::<Float32Type>(values, nullable, |value| !value.is_nan());
            (Arc::new(array), Lent::Float(buffer))
        }
        Values::Double(values) => {
            let (array, buffer) = numbers::<Float64Type>(values, nullable, |value| !value.is_nan());
            (Arc::new(array), Lent::Double(buffer))
        }
        Values::Word(values) => {
            let (keys, buffer) = numbers::<Int8Type>(values, nullable, |value| value >= 0);
            (Arc::new(DictionaryArray::try_new(keys, words.clone())?), Lent::Word(buffer))
        }
        Values::Name(values) => {
            let (keys, buffer) = numbers::<Int32Type>(values, nullable, |value| value >= 0);
            (Arc::new(DictionaryArray::try_new(keys, words.clone())?), Lent::Name(buffer))
        }
    })
}

fn numbers<T: ArrowPrimitiveType>(
    values: Vec<T::Native>,
    nullable: bool,
    applies: impl Fn(T::Native) -> bool,
) -> (PrimitiveArray<T>, Buffer) {
    let nulls = nullable.then(|| applying(values.len(), |row| applies(values[row]))).flatten();
    let length = values.len();
    let buffer = Buffer::from_vec(values);
    (PrimitiveArray::new(ScalarBuffer::new(buffer.clone(), 0, length), nulls), buffer)
}

fn truths(values: &[i8], nullable: bool) -> ArrayRef {
    let nulls = nullable.then(|| applying(values.len(), |row| values[row] >= 0)).flatten();
    Arc::new(BooleanArray::new(BooleanBuffer::collect_bool(values.len(), |row| values[row] > 0), nulls))
}

fn applying(rows: usize, applies: impl FnMut(usize) -> bool) -> Option<NullBuffer> {
    let valid = NullBuffer::new(BooleanBuffer::collect_bool(rows, applies));
    (valid.null_count() > 0).then_some(valid)
}

/// Rounds positions and directions to multiples of a power of two, so that the low bits are zero and compress well. The
/// step of a position is the greatest power of two up to `precision_m`, so no value moves by more than half of it.
pub fn round(values: &mut Values, rounding: Rounding, precision_m: f32) {
    let step = match rounding {
        Rounding::Exact => return,
        Rounding::Position => power_of_two_below(precision_m),
        Rounding::Direction => 1.0 / 4096.0,
    };
    if let Values::Float(values) = values {
        let steps = 1.0 / step;
        for value in values {
            // The sum with zero turns −0 into 0.
            *value = (*value * steps).round_ties_even() * step + 0.0;
        }
    }
}

/// The greatest power of two up to a positive normal number: its exponent without its fraction.
fn power_of_two_below(value: f32) -> f32 {
    f32::from_bits(value.to_bits() & 0x7f80_0000)
}

/// The buffers of a table, in the order of its columns; buffers of columns that a run does not have stay empty.
pub trait Columns: Default {
    /// The number of rows in the buffers.
    fn rows(&self) -> usize;

    /// Takes the buffers and leaves empty ones.
    fn take(&mut self) -> Vec<Values>;

    /// Puts emptied buffers back, so that their memory is used again.
    fn give_back(&mut self, values: Vec<Values>);
}

/// Makes a struct of column buffers and the function that adds rows. Each column is written once, in the order of the
/// table's list of columns: its buffer, and the expression of its value in a row, from an item and from values that all
/// items share. A column without an expression is filled by the table's own code.
macro_rules! columns {
    ($(#[$meta:meta])* $name:ident of $item:ident: $item_type:ty, $shared:ident: $shared_type:ty {
        $first:ident: $first_values:ident($first_type:ty) = $first_value:expr,
        $($field:ident: $values:ident($type:ty) $(= $value:expr)?,)*
    }) => {
        $(#[$meta])*
        #[derive(Debug, Default)]
        pub struct $name {
            pub $first: Vec<$first_type>,
            $(pub $field: Vec<$type>,)*
        }

        impl $name {
            /// Adds a row for each item, column by column.
            #[allow(unused_variables, reason = "some values are those of all items")]
            fn extend(&mut self, items: &[$item_type], $shared: $shared_type) {
                self.$first.extend(items.iter().map(|_| $first_value));
                $($(self.$field.extend(items.iter().map(|$item| $value));)?)*
            }
        }

        impl $crate::tables::buffers::Columns for $name {
            fn rows(&self) -> usize {
                self.$first.len()
            }

            fn take(&mut self) -> Vec<$crate::tables::buffers::Values> {
                use $crate::tables::buffers::Values;
                vec![
                    Values::$first_values(std::mem::take(&mut self.$first)),
                    $(Values::$values(std::mem::take(&mut self.$field)),)*
                ]
            }

            fn give_back(&mut self, values: Vec<$crate::tables::buffers::Values>) {
                use $crate::tables::buffers::Values;
                let mut values = values.into_iter();
                if let Some(Values::$first_values(buffer)) = values.next() {
                    self.$first = buffer;
                }
                $(if let Some(Values::$values(buffer)) = values.next() {
                    self.$field = buffer;
                })*
            }
        }
    };
}
pub(crate) use columns;

/// A tick as a number, or null where it is later than `last`, the last tick of which anything is known.
#[inline]
pub fn known(tick: Tick, last: Tick) -> i32 {
    if tick <= last && tick != NEVER { tick as i32 } else { NULL }
}
