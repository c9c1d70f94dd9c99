//! Typed handles: the places of axes, nodes and organs in the columns of their plant.
//!
//! A handle names a component of one plant at one state of its columns. Absent: component numbers, which never change.

/// The place of an axis in its plant's columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AxisId(pub u32);

impl AxisId {
    /// The axis that grew out of the seed.
    pub const TRUNK: Self = Self(0);

    /// The axis that left the columns as the `nth`, from 0, of a plant whose model rewrites; events name it so.
    #[inline]
    pub const fn gone(nth: usize) -> Self {
        Self(u32::MAX - nth as u32)
    }

    /// As an index into the columns.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// The place of a node in its plant's columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

impl NodeId {
    /// No node: the bearer of the first axis.
    pub const NONE: Self = Self(u32::MAX);

    /// As an index into the columns.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The node, where there is one.
    pub fn some(self) -> Option<Self> {
        (self != Self::NONE).then_some(self)
    }
}

/// The place of an organ in its plant's columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct OrganId(pub u32);

impl OrganId {
    /// As an index into the columns.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}
