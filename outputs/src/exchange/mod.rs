//! Plants in the files of other programs, read and written over one neutral [`Description`].
//!
//! A format is a file of this folder that has the trait [`Format`], and a line in [`FORMATS`]. Reading gives a
//! description and a [`Report`]: what could be read with a warning, and the faults for which nothing is taken over.
//! Writing tells in [`Losses`] what the format cannot hold. `docs/exchange.md` has all of it as a table. Absent: paths,
//! which the caller has, and parametric trees of other programs, which are species and no plants (`config/peers`).

mod contract;
mod cursor;
mod decimals;
mod description;
mod drawn;
pub mod grown;
mod losses;
mod mtg;
mod numbers;
mod obj;
mod opf;
mod ops;
mod qsm;
mod report;
#[cfg(test)]
mod tests;
mod text;
mod vectors;
mod xml;

pub use contract::{Format, InMemory, Incoming, MOST_BYTES, MOST_ENTITIES, Outgoing, Units};
pub use description::{
    Class, Date, Description, Entity, Feature, FeatureType, Form, Individual, Link, Material, Mesh, Observation, Role,
    Shape, Standing, Value,
};
pub use losses::{Loss, Losses};
pub use report::{Fault, MOST_TOLD, Place, Report, Warning};
pub use text::{decoded, place_of, said};

/// Every format. A new one is a line here and a file beside this one.
pub static FORMATS: [&dyn Format; 7] =
    [&mtg::Mtg, &opf::Opf, &ops::Ops, &qsm::TreeQsm, &qsm::TreeQsm15, &qsm::QsmTable, &obj::Obj];

/// The format with a word, such as `mtg`.
pub fn by_word(word: &str) -> Option<&'static dyn Format> {
    FORMATS.into_iter().find(|format| format.word() == word)
}

/// The formats of files with an ending, without the dot and in any case, in the order of [`FORMATS`].
pub fn by_ending(ending: &str) -> Vec<&'static dyn Format> {
    let has = |format: &&dyn Format| format.endings().iter().any(|known| known.eq_ignore_ascii_case(ending));
    FORMATS.into_iter().filter(has).collect()
}
