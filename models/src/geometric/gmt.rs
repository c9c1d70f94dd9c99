//! The four models as the registry knows them: GMT1 to GMT4 of Aono & Kunii 1984, each a tree of its type.
//!
//! GMT1 is two children at constant angles; GMT2 lets their tips deviate; GMT3 has a centre child; the angles of GMT4
//! change with the growth level. Age 1 shows the first branch, and age a the growth level a − 1, where a growth level
//! grows in one tick. Absent: the keys (`descriptor`, `parts`), and everything that follows from them.

use super::descriptor::{GeometricTree, TreeType};
use super::model::GeometricModel;
use crate::fault::{Fault, Path};
use crate::parameters::{Card, Keys, Parameters};
use phytomer_sim::clock::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::sync::Arc;

/// Makes the type of parameters of each model: a tree in a box, so that the parameters of other models, which share an
/// enum with these, do not take its room.
macro_rules! models {
    ($($(#[doc = $prose:tt])+ $name:ident, $about:literal;)+) => {$(
        $(#[doc = $prose])+
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub Box<GeometricTree>);

        impl $name {
            /// The type of its trees.
            pub const TYPE: TreeType = TreeType::$name;

            /// The card of this model.
            pub const CARD: Card = Card { word: Self::TYPE.word(), about: $about, keys: Keys::PLAIN };

            /// Every fault of meaning in the parameters, which stand at `path` in their file.
            pub fn check(&self, path: &Path) -> Vec<Fault> {
                self.0.check(Self::TYPE, path)
            }

            /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
            ///
            /// # Errors
            /// Every fault that `check` finds, and an age past the last tick.
            pub fn compile(&self, until: Tick, path: &Path) -> Result<GeometricModel, Vec<Fault>> {
                self.0.compile(Self::TYPE, until, path)
            }
        }

        impl From<GeometricTree> for $name {
            fn from(tree: GeometricTree) -> Self {
                Self(Box::new(tree))
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                let mut schema = GeometricTree::json_schema(generator).to_value();
                Self::TYPE.narrow(&mut schema);
                Schema::try_from(schema).unwrap_or_default()
            }
        }

        impl Parameters for $name {
            fn card(&self) -> &'static Card {
                &Self::CARD
            }

            fn model(&self, until: Tick, _: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
                Ok(Arc::new(self.compile(until, top)?))
            }

            fn full_grown_at(&self) -> Option<Tick> {
                Some(self.0.full_grown_at())
            }
        }
    )+};
}

models! {
    /// The bifurcating tree GMT1: at each growth level every branch that has none bears two children at its tip, at
    /// constant angles and ratios.
    Gmt1, "two branches at every tip, by ratios and angles (Aono & Kunii 1984)";
    /// GMT2: as GMT1, but tips are moved by wind, light and gravity, and by attractors and inhibitors.
    Gmt2, "two branches at every tip, moved by wind, light and points that pull (Aono & Kunii 1984)";
    /// GMT3: three children at every tip, of which the centre one keeps the direction of its mother.
    Gmt3, "three branches at every tip, the centre one straight on (Aono & Kunii 1984)";
    /// GMT4: two children at every tip, whose angles change from the ground to the top and scatter.
    Gmt4, "two branches at every tip, by angles that change with the growth level (Aono & Kunii 1984)";
}
