//! How organs and internodes are drawn from near, where a mesh or a picture asks for detail: the forms of the library
//! as settings of one blade, of flowers, of heads and of needles, and those that a species states.
//!
//! The form of an organ stays what it is at detail 0; these settings hold from detail 1 on. Absent: triangles
//! (`phytomer_meshes`).

mod blade;
mod cluster;
mod head;
mod library;
mod sound;
mod stem;

pub use blade::{Apex, Base, Blade, Margin, Rim};
pub use cluster::{Brush, Cluster};
pub use head::{Capitulum, Flower, GOLDEN_DEG};
pub use sound::Unsound;
pub use stem::{LeafBases, NearStem};

/// The most detail that there is.
pub const MOST_DETAIL: u8 = 3;

/// How an organ is drawn from near.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Near {
    /// A blade, simple or compound.
    Blade(Blade),
    /// A flower of petals.
    Flower(Flower),
    /// A head of florets.
    Capitulum(Capitulum),
    /// The needles of a piece of shoot.
    Brush(Brush),
    /// Flowers or fruits that stand together.
    Cluster(Cluster),
}
