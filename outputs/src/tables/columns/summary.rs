//! The columns of the table `summary`: a plant at an age in a few numbers.
//!
//! Columns that other tables have too are declared beside them (`columns`). Absent: how the values are counted
//! (`tables::summary`).

use super::super::schema::Column;
use super::{AGE, PLANT, PLOT, TICK, TREATMENT};

/// A row per plant and recorded tick; none before the plant is sown.
pub static SUMMARY: [Column; 24] = [
    TREATMENT,
    PLOT,
    PLANT,
    TICK,
    AGE,
    Column::id("internodes", "Living internodes of every kind: those whose kind ends in `internode`."),
    Column::id("leaves", "Leaves on the plant, of kind `leaf`; leaflets, bracts and the parts of flowers are none."),
    Column::id("flowers", "Flowers on the plant, and inflorescences and spikelets that are drawn as one."),
    Column::id("fruits", "Fruits on the plant, and infructescences and strobili."),
    Column::id("buds", "Living apical buds. An apex that has become a flower is none."),
    Column::id("dead_internodes", "Dead internodes that still stand."),
    Column::id("axes", "Axes with an internode that stands, living or dead, or a living bud."),
    Column::small("max_order", "The highest order among them; 0 where none is left."),
    Column::double("height_m", "m", "The highest tip of a living internode above the seed. Null where none lives.")
        .or_null(),
    Column::double(
        "crown_width_m",
        "m",
        "The mean of the extents along x and y of the tips of living internodes. Null where none lives.",
    )
    .or_null(),
    Column::double("leaf_area_m2", "m2", "One side of every leaf and leaflet on the plant."),
    Column::double(
        "wood_volume_m3",
        "m3",
        "The volume of the internodes that stand, living and dead: frusta, and of blades their area by their thickness.",
    ),
    Column::truth(
        "alive",
        "Whether the plant lives, which is when any of its components at this age does, as `records` and `components` tell. \
         It may live without a bud: on the flower or fruit that an apex has become, or on a branch that has completed its \
         growth and persists.",
    ),
    Column::tick("death_age", "The age at which the last of its components died. Null while the plant lives.")
        .or_null(),
    Column::id("harvested_fruits", "Fruits of the plant that were harvested by this age: the yield."),
    Column::double(
        "harvested_fresh_mass_kg",
        "kg",
        "The fresh mass of these fruits when they were harvested. Null where the species states no mass of fruits.",
    )
    .or_null(),
    Column::double(
        "basal_diameter_m",
        "m",
        "The diameter at the base of the first internode of the axis of the seed. Null where it does not live.",
    )
    .or_null(),
    Column::double(
        "diameter_at_1_3_m",
        "m",
        "The diameter 1.3 m above the seed, of the thickest living internode of order 1 that rises through that height. Null \
         where none does.",
    )
    .or_null(),
    Column::double(
        "lowest_leaf_m",
        "m",
        "The height of the base of the lowest leaf or leaflet above the seed. Null where the plant has none.",
    )
    .or_null(),
];
