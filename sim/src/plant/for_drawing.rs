//! The data that a species states for drawing alone, carried by its habit.
//!
//! A model stores them and a mesh reads them. Growth, pose and mechanics do not use them, and this crate does not
//! contain their type. Absent: the data themselves (`phytomer_looks::Paints`).

use std::any::Any;
use std::fmt::Debug;
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::Arc;

/// Data that a habit can carry for drawing: any type that can be shared between threads, printed and compared.
pub trait Carried: Any + Debug + Send + Sync + UnwindSafe + RefUnwindSafe {
    /// Whether `other` is of the same type and equal.
    fn equals(&self, other: &dyn Any) -> bool;
}

impl<T: Any + Debug + PartialEq + Send + Sync + UnwindSafe + RefUnwindSafe> Carried for T {
    fn equals(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<T>() == Some(self)
    }
}

/// The data of a species for drawing; empty by default. Clones share them.
#[derive(Debug, Clone, Default)]
pub struct ForDrawing(Option<Arc<dyn Carried>>);

impl ForDrawing {
    /// Data that a habit carries.
    pub fn new(stated: impl Carried) -> Self {
        Self(Some(Arc::new(stated)))
    }

    /// The data, if they are of this type.
    pub fn get<T: Any>(&self) -> Option<&T> {
        let carried: &dyn Any = self.0.as_deref()?;
        carried.downcast_ref()
    }
}

impl PartialEq for ForDrawing {
    fn eq(&self, other: &Self) -> bool {
        match (self.0.as_deref(), other.0.as_deref()) {
            (None, None) => true,
            (Some(a), Some(b)) => a.equals(b),
            _ => false,
        }
    }
}
