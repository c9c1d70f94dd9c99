//! The columns of the table `site`: what the date and pests bring to the plots of a treatment and replicate.
//!
//! Columns that other tables have too are declared beside them (`columns`). Absent: how the values are counted
//! (`tables::site`).

use super::super::schema::{Column, Encoding, Type};
use super::{BLOCK, TICK, TREATMENT};

/// A row per treatment, replicate and recorded tick, in each part that has plots of them.
pub static SITE: [Column; 17] = [
    TREATMENT,
    Column::id("plot_id", "The first of the plots in this part: those of one treatment and replicate."),
    Column::small(
        "replicate",
        "The replicate of the treatment of the plots, from 0; 0 where a run compares no treatments.",
    ),
    BLOCK,
    TICK,
    Column::new(
        "date",
        Type::Date,
        Encoding::Dictionary,
        "The day that begins when the tick ends. Null where the scenario has no calendar, as are the next four columns.",
    )
    .or_null(),
    Column::double(
        "degree_days",
        "°C d",
        "The degree-days of the days of the tick. Null where the scenario does not state how they are taken.",
    )
    .or_null(),
    Column::double("degree_day_sum", "°C d", "The degree-days since planting. Null as `degree_days`.").or_null(),
    Column::double(
        "day_length_h",
        "h",
        "The hours from sunrise to sunset on the date. Null where the latitude is not known.",
    )
    .or_null(),
    Column::double(
        "nitrogen_kg_ha",
        "kg/ha",
        "The nitrogen of the season: the soil's own supply and what was applied since the season began. Null where the \
         scenario states no soil.",
    )
    .or_null(),
    Column::small("plots", "The number of plots of the treatment and replicate in this part."),
    Column::small("living_plants", "The plants of these plots that live at the tick."),
    pressure(
        "pest_pressure_apex",
        "The probability that a pest kills an apical bud at the tick, if it makes a clock step: the mean over the living \
         plants. Null where no pest attacks buds or no plant lives.",
    ),
    pressure(
        "pest_pressure_leaf",
        "The same for a leaf, which is eaten: the share of the leaf area that goes at the tick. Null where no pest attacks \
         leaves or no plant lives.",
    ),
    pressure("pest_pressure_flower", "The same for a flower. Null where no pest attacks flowers or no plant lives."),
    pressure("pest_pressure_fruit", "The same for a fruit. Null where no pest attacks fruits or no plant lives."),
    pressure(
        "pest_pressure_plant",
        "The probability that a pest kills all buds of a plant at the tick. Null where no pest attacks whole plants or no \
         plant lives.",
    ),
];

/// The pressure of pests on something.
const fn pressure(name: &'static str, description: &'static str) -> Column {
    Column::double(name, "", description).or_null()
}
