//! What the components of a species look like (de Reffye 1988 §6), where models state it and meshes draw it: the table
//! of forms, colours, and the curved surfaces and cross sections that a species
//! brings along.
//!
//! The plant itself carries numbers alone: the number of a form ([`phytomer_sim::plant::Form`]) and of a paint among
//! the [`Paints`] of its species. A model that states colours puts the paints into the habit, and a mesh reads them
//! there. Absent: triangles and the colours of components without a stated colour (`phytomer_meshes`), and how a file
//! states forms and colours (`phytomer_models`).

mod flare;
mod form;
mod near;
mod paint;
pub mod polygon;
mod section;
mod surface;

pub use flare::Flare;
pub use form::{FormName, own_form, place_of_own};
pub use near::{
    Apex, Base, Blade, Brush, Capitulum, Cluster, Flower, GOLDEN_DEG, LeafBases, MOST_DETAIL, Margin, Near, NearStem,
    Rim, Unsound,
};
pub use paint::{Bark, Colour, InternodePaint, OrganPaint, Paints};
pub use section::Section;
pub use surface::{Surface, SurfacePoint};
