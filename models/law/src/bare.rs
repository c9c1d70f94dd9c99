//! "A bare number, or a table": the reading shared by laws, counts and variates.
//!
//! Written by hand rather than as an untagged enum, so that a fault inside the table is told as such and not as "no
//! variant matched".

use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Unexpected, Visitor};

/// A number that can stand in place of a table.
pub(super) trait Bare: Sized {
    /// What may stand here, for messages.
    const EXPECTED: &'static str;
    fn whole(number: i64) -> Option<Self>;
    fn real(number: f64) -> Option<Self>;
}

impl Bare for f64 {
    const EXPECTED: &'static str = "a number, or a table with one kind";

    fn whole(number: i64) -> Option<Self> {
        Some(number as f64)
    }

    fn real(number: f64) -> Option<Self> {
        Some(number)
    }
}

impl Bare for u32 {
    const EXPECTED: &'static str = "a whole number from 0, or a table with one distribution";

    fn whole(number: i64) -> Option<Self> {
        u32::try_from(number).ok()
    }

    fn real(_: f64) -> Option<Self> {
        None
    }
}

/// A value as it was read: a bare number, or a table.
pub(super) enum BareOr<N, T> {
    Bare(N),
    Table(T),
}

struct Reader<N, T>(PhantomData<(N, T)>);

impl<'de, N: Bare, T: Deserialize<'de>> Visitor<'de> for Reader<N, T> {
    type Value = BareOr<N, T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(N::EXPECTED)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Self::Value, E> {
        N::whole(number).map(BareOr::Bare).ok_or_else(|| E::invalid_value(Unexpected::Signed(number), &self))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Self::Value, E> {
        let whole = i64::try_from(number).ok().and_then(N::whole);
        whole.map(BareOr::Bare).ok_or_else(|| E::invalid_value(Unexpected::Unsigned(number), &self))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Self::Value, E> {
        N::real(number).map(BareOr::Bare).ok_or_else(|| E::invalid_type(Unexpected::Float(number), &self))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(BareOr::Table)
    }
}

/// Reads a bare number or a table.
pub(super) fn read<'de, N, T, D>(deserializer: D) -> Result<BareOr<N, T>, D::Error>
where
    N: Bare,
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    deserializer.deserialize_any(Reader(PhantomData))
}
