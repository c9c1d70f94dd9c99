//! How often a law can change along the nodes that one axis makes, so that many draws look up its cell once.

/// How often the parameters of a law can change from node to node of one axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Varies {
    /// Never: they are the same at every point.
    Never,
    /// From growth unit to growth unit.
    ByUnit,
    /// From node to node: the law depends on the rank.
    ByNode,
}
