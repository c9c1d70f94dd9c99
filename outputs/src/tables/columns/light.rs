//! The columns of light, which follow the others of `records`, `summary` and `site` in runs that ask for them.
//!
//! Absent: how the values are found (`phytomer_sim::site::light`).

use super::super::schema::Column;
use super::{RECORDS, SITE, SUMMARY};

/// The columns of `records` in a run with those of light.
pub static RECORDS_IN_LIGHT: [Column; 31] = joined(
    &RECORDS,
    [Column::float(
        "light",
        "",
        "The share of the light of open ground that reaches the middle of a leaf, or an apical bud. Null for the others, and \
         where the scenario has no light.",
    )
    .or_null()],
);

/// The columns of `summary` in a run with those of light.
pub static SUMMARY_IN_LIGHT: [Column; 26] = joined(
    &SUMMARY,
    [
        Column::double(
            "intercepted_light_m2",
            "m2",
            "The light that the plant keeps, as the area of open, level ground that receives as much. Null where the \
             scenario has no light.",
        )
        .or_null(),
        Column::double(
            "light_competition",
            "",
            "The light that the plant keeps over that which it would keep without its neighbours: 1 where they take none \
             from it. Null where it keeps none, and where the scenario has no light.",
        )
        .or_null(),
    ],
);

/// The columns of `site` in a run with those of light.
pub static SITE_IN_LIGHT: [Column; 19] = joined(
    &SITE,
    [
        Column::double(
            "leaf_area_index",
            "",
            "The area of one side of all leaves over the ground of the plots, those that repeat by their width. Null where \
             the ground of plants is not known.",
        )
        .or_null(),
        Column::double(
            "ground_light",
            "",
            "The share of the light of open ground on the ground of the plots, by rays from 16 × 16 places: of a plot that \
             repeats on its whole ground, else on the rectangle below its crowns. The mean over the plots. Null where the \
             scenario has no light.",
        )
        .or_null(),
    ],
);

const fn joined<const A: usize, const B: usize, const N: usize>(first: &[Column; A], then: [Column; B]) -> [Column; N] {
    let mut all = [first[0]; N];
    let mut place = 0;
    while place < N {
        all[place] = if place < A { first[place] } else { then[place - A] };
        place += 1;
    }
    all
}
