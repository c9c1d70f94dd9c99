//! How the leaves and the bark of a parametric tree look: the paper's leaf shapes by their numbers (§4.5), and every
//! form of the library.
//!
//! The paper names its shapes and prints none but the oval of Figure 1. Absent: their triangles (`phytomer_meshes`).

use crate::law::Quantity;
use phytomer_looks::FormName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The paper's shapes of leaves in the order in which §4.5 lists them, which is that of their numbers here.
pub(super) const SHAPES: [FormName; 6] = [
    FormName::Oval,
    FormName::Triangle,
    FormName::ThreeLobeOak,
    FormName::ThreeLobeMaple,
    FormName::FiveLobeMaple,
    FormName::ThreeLeaflets,
];

/// The shape of leaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum LeafShape {
    /// A shape of the paper by its number.
    Number(#[schemars(extend("maximum" = 5))] Quantity),
    /// A form of the library by its name.
    Form(FormName),
}

impl LeafShape {
    /// The form; `None` for a number past the last.
    pub fn form(&self) -> Option<FormName> {
        match self {
            Self::Number(number) => SHAPES.get(number.value() as usize).copied(),
            Self::Form(form) => Some(*form),
        }
    }
}

impl Default for LeafShape {
    fn default() -> Self {
        Self::Number(Quantity::Number(0))
    }
}
