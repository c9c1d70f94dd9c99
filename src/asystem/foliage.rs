//! The leaves of the trees of a stage, and the names of their forms.

use phytomer_asystem::Colour;
use phytomer_looks::FormName;
use phytomer_models::buds::params::{ColourText, LeafChoice};
use phytomer_models::geometric::TreeLeaf;
use phytomer_models::law::{Constant, Quantity};

/// The leaves of a tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaves {
    /// Their form.
    pub form: FormName,
    /// The growth level from which branches bear them.
    pub level: u32,
    /// Their colour.
    pub colour: Colour,
    /// Length and width, metres.
    pub size: [f64; 2],
}

impl Leaves {
    /// The leaves as a tree states them, so many times as large.
    pub fn stated(self, zoom: f64) -> TreeLeaf {
        let [length, width] = self.size.map(|metres| Constant::Number(100.0 * metres * zoom));
        let [r, g, b] = self.colour;
        TreeLeaf {
            form: self.form,
            length_cm: length,
            width_cm: width,
            from_level: Some(Quantity::from(self.level)),
            colour: Some(LeafChoice::One(ColourText(format!("#{r:02x}{g:02x}{b:02x}")))),
            ..TreeLeaf::default()
        }
    }
}

/// The form of this name.
pub fn form_of(word: &str) -> Option<FormName> {
    FormName::ALL.into_iter().find(|form| form.word() == word)
}
