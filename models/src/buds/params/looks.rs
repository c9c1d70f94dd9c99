//! Forms and kinds as a species file states them (de Reffye 1988 §6): what components are, and the form they are drawn
//! with.
//!
//! Absent: the forms themselves, which `phytomer_looks` lists and `phytomer_meshes` draws, the reading of a user's
//! mesh, and colours.

use crate::fault::Path;
use phytomer_looks::FormName;
use phytomer_sim::plant::Kind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A form: one of the library by its name, or a mesh of the user's.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum FormChoice {
    /// One of the library (`phytomer list forms`).
    Named(FormName),
    /// A mesh of the user's.
    Own(OwnForm),
}

/// A mesh of the user's: it is moved and scaled into the unit box of forms, x from the base (0) to the tip (1), y
/// across.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnForm {
    /// The file of the mesh, PLY, OBJ or GLB, as seen from this file.
    #[schemars(length(min = 1))]
    pub mesh: String,
}

impl FormChoice {
    /// The area of one side as a share of length × width. A user's mesh has here the share of a broad blade; its own
    /// share is computed where the mesh is read.
    pub(in crate::buds) const fn area_share(&self) -> f32 {
        match self {
            Self::Named(name) => name.area_share(),
            Self::Own(_) => FormName::Elliptic.area_share(),
        }
    }
}

impl From<FormName> for FormChoice {
    fn from(name: FormName) -> Self {
        Self::Named(name)
    }
}

/// Makes [`KindName`] of the table of kinds.
macro_rules! kind_name {
    (stated { $(#[doc = $prose:tt] $name:ident = $n:tt, $tag:tt, $c:ident, $p:ident, $t:tt;)* } grown $grown:tt) => {
        /// A kind by its tag (`phytomer list kinds`); each key allows those that can stand in its place.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
        pub enum KindName {
            $(#[doc = $prose] #[serde(rename = $tag)] $name,)*
        }

        impl From<KindName> for Kind {
            fn from(name: KindName) -> Self {
                match name {
                    $(KindName::$name => Self::$name,)*
                }
            }
        }

        impl KindName {
            /// Every kind that a species file can state.
            pub(in crate::buds) const ALL: &[Self] = &[$(Self::$name),*];
        }
    };
}

phytomer_sim::kinds!(kind_name);

impl KindName {
    pub(super) fn is_leaf(&self) -> bool {
        *self == Self::Leaf
    }

    pub(super) fn is_flower(&self) -> bool {
        *self == Self::Flower
    }

    pub(super) fn is_fruit(&self) -> bool {
        *self == Self::Fruit
    }
}

/// One thing for all axes of an order, or one for each state in which they can start.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ByState<T> {
    /// The same for all.
    All(T),
    /// One for each state of the species, every state named once.
    Each(EachState<T>),
}

/// One thing for each state of the species.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EachState<T> {
    /// By the name of the state.
    pub by_state: BTreeMap<String, T>,
}

impl<T> ByState<T> {
    /// Every value that is stated, with its path.
    pub(in crate::buds) fn places(&self, path: &Path) -> Vec<(Path, &T)> {
        let below = path.key("by_state");
        match self {
            Self::All(one) => vec![(path.clone(), one)],
            Self::Each(each) => each.by_state.iter().map(|(state, one)| (below.key(state), one)).collect(),
        }
    }
}

impl ByState<KindName> {
    pub(super) fn is_plain_kind(&self) -> bool {
        *self == Self::All(KindName::Internode)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, StrDeserializer};

    fn read<T: for<'a> Deserialize<'a>>(word: &str) -> T {
        let deserializer: StrDeserializer<'_, Error> = word.into_deserializer();
        T::deserialize(deserializer).unwrap_or_else(|error| panic!("{word}: {error}"))
    }

    #[test]
    fn the_names_of_files_are_those_of_the_plant() {
        for form in FormName::ALL {
            assert_eq!(read::<FormName>(form.word()), form);
        }
        for kind in KindName::ALL.iter().map(|name| Kind::from(*name)) {
            assert_eq!(Kind::from(read::<KindName>(kind.tag())), kind);
        }
        let unstated =
            Kind::ALL.into_iter().filter(|kind| !KindName::ALL.iter().any(|name| Kind::from(*name) == *kind));
        assert!(unstated.eq([Kind::ShortInternode, Kind::ApicalBud, Kind::AxillaryBud]));
    }
}
