//! What a species states for drawing alone, carried by its habit unread.
//!
//! A model puts it in and a mesh takes it out. Growth, pose and mechanics do not use it, and this crate does not know
//! its type. Absent: what it is (`phytomer_looks::Paints`).

use std::any::Any;
use std::fmt::Debug;
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::Arc;

/// What can be carried for drawing: any data that can be shared between threads, shown and compared.
pub trait Carried: Any + Debug + Send + Sync + UnwindSafe + RefUnwindSafe {
    /// Whether `other` is of the same type and equal.
    fn equals(&self, other: &dyn Any) -> bool;
}

impl<T: Any + Debug + PartialEq + Send + Sync + UnwindSafe + RefUnwindSafe> Carried for T {
    fn equals(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<T>() == Some(self)
    }
}

/// What a species states for drawing; nothing by default. A clone shares it.
#[derive(Debug, Clone, Default)]
pub struct ForDrawing(Option<Arc<dyn Carried>>);

impl ForDrawing {
    /// Carries `stated`.
    pub fn new(stated: impl Carried) -> Self {
        Self(Some(Arc::new(stated)))
    }

    /// What is carried, if it is of this type.
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
