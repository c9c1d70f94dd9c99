//! What the parameters of the models of cellular branching have in common: ranges, and what holds where nothing is
//! stated.
//!
//! Absent: the parameters themselves.

use crate::law::{Constant, ConstantForm, ValueRange};

pub(super) const SIZE: ValueRange = ValueRange { min: 1e-4, max: 1000.0, what: "a length in m" };
pub(super) const DIAMETER: ValueRange = ValueRange { min: 0.0, max: 1e6, what: "a diameter in mm" };
pub(super) const ANGLE: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };
pub(super) const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a probability" };
pub(super) const WEIGHT: ValueRange = ValueRange { min: 0.0, max: 1000.0, what: "a weight" };

/// The diameter of an internode, millimetres, of a species that states none.
pub(super) fn assumed_diameter() -> Constant {
    Constant::from(ConstantForm { value: 10.0, assumed: true, ..ConstantForm::default() })
}
