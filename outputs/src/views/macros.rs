//! The bodies of the macros over tables: what each is good for, the tables that it needs, and its SQL.
//!
//! `{run}` becomes `run, ` where rows of several runs can stand together, `{records}` the view of records with their
//! places in the plot where there is one, `{pressures}` the means of the pressures of pests; any other name in braces
//! is a parameter. A quotient is made of real numbers: one of whole numbers is cut off by DataFusion and is not by
//! DuckDB.

use crate::tables::Table;

/// A macro, or a view over other views.
pub struct Macro {
    pub tables: &'static [Table],
    pub name: &'static str,
    pub parameters: Option<&'static [&'static str]>,
    pub comment: &'static str,
    pub body: &'static str,
}

/// The view of a run with `records` and `plants`: the rows of `records` with the places of components in the plot. The
/// sums are in double precision, as the places of plants are.
pub const WORLD: Macro = Macro {
    tables: &[Table::Records, Table::Plants],
    name: "records_world",
    parameters: None,
    comment: "Records with their places in the plot, `world_x_m`, `world_y_m` and `world_z_m`, beside those from the plant's seed.",
    body: "SELECT r.*, p.x_m + r.x_m AS world_x_m, p.y_m + r.y_m AS world_y_m, p.z_m + r.z_m AS world_z_m FROM records r \
           JOIN (SELECT {run}plot_id, plant_id, x_m, y_m, z_m FROM plants) p USING ({run}plot_id, plant_id)",
};

/// The macros.
pub const MACROS: [Macro; 10] = [
    Macro {
        tables: &[Table::Records],
        name: "at_age",
        parameters: Some(&["a"]),
        comment: "Everything that stands on plants of an age: SELECT kind, count(*) FROM at_age(10) GROUP BY kind;",
        body: "SELECT * FROM {records} WHERE age = {a}",
    },
    Macro {
        tables: &[Table::Records],
        name: "at_tick",
        parameters: Some(&["t"]),
        comment: "Everything that stands at a tick of the plot, which is the age of plants that were sown at tick 0.",
        body: "SELECT * FROM {records} WHERE tick = {t}",
    },
    Macro {
        tables: &[Table::Records],
        name: "orders_at",
        parameters: Some(&["a"]),
        comment: "The internodes of each order at an age, with their length and wood volume, by plant.",
        body: "SELECT {run}plant_id, axis_order, count(*) AS internodes, sum(length_m) AS length_m, sum(pi() / 12 * length_m * \
               (diameter_m * diameter_m + diameter_m * diameter_tip_m + diameter_tip_m * diameter_tip_m)) AS \
               wood_volume_m3 FROM records WHERE age = {a} AND ends_with(kind, 'internode') GROUP BY {run}plant_id, \
               axis_order ORDER BY {run}plant_id, axis_order",
    },
    Macro {
        tables: &[Table::Components],
        name: "alive_at",
        parameters: Some(&["a"]),
        comment: "What was alive at any age of its plant, recorded or not.",
        body: "SELECT * FROM components WHERE birth_age <= {a} AND (death_age IS NULL OR death_age > {a})",
    },
    Macro {
        tables: &[Table::Components],
        name: "axes",
        parameters: Some(&[]),
        comment: "One row an axis, with the axillary buds of its nodes.",
        body: "SELECT {run}plant_id, axis_id, b.bearing_axis_id, b.axis_order, b.origin, b.state_name, b.birth_age, \
               b.death_age, coalesce(i.internodes, 0) AS internodes, i.length_m, i.axillary_buds FROM (SELECT {run}plot_id, \
               plant_id, axis_id, bearing_axis_id, axis_order, origin, state_name, birth_age, death_age FROM components \
               WHERE kind = 'apical_bud') b LEFT JOIN (SELECT {run}plot_id, plant_id, axis_id, count(*) AS internodes, \
               sum(length_m) AS length_m, sum(axillary_buds) AS axillary_buds FROM components WHERE ends_with(kind, \
               'internode') GROUP BY {run}plot_id, plant_id, axis_id) i USING ({run}plot_id, plant_id, axis_id) ORDER BY \
               {run}plant_id, axis_id",
    },
    Macro {
        tables: &[Table::Events],
        name: "fates",
        parameters: Some(&[]),
        comment: "How often each fate befell a bud, by age and order.",
        body: "SELECT {run}age, axis_order, event, count(*) AS buds FROM events GROUP BY {run}age, axis_order, event ORDER BY \
               {run}age, axis_order, event",
    },
    Macro {
        tables: &[Table::Site],
        name: "sites",
        parameters: Some(&[]),
        comment: "What the date brought to each treatment and replicate, tick by tick, its parts together.",
        body: "SELECT {run}treatment, replicate, block, tick, max(date) AS date, max(degree_days) AS degree_days, \
               max(degree_day_sum) AS degree_day_sum, max(day_length_h) AS day_length_h, max(nitrogen_kg_ha) AS \
               nitrogen_kg_ha, sum(plots) AS plots, sum(living_plants) AS living_plants, {pressures} FROM site GROUP BY \
               {run}treatment, replicate, block, tick ORDER BY {run}treatment, replicate, block, tick",
    },
    Macro {
        tables: &[Table::Summary, Table::Plants],
        name: "growth",
        parameters: Some(&[]),
        comment: "Means over the plants of each treatment and species, by age.",
        body: "SELECT {run}s.treatment, p.species, s.age, max(s.age_years) AS age_years, max(s.age_days) AS \
               age_days, count(*) AS plants, count(*) FILTER \
               (WHERE s.alive) AS alive, avg(s.internodes) AS internodes, avg(s.leaves) AS leaves, avg(s.height_m) AS \
               height_m, avg(s.leaf_area_m2) AS leaf_area_m2 FROM summary s JOIN (SELECT {run}plot_id, plant_id, species \
               FROM plants) p USING ({run}plot_id, plant_id) GROUP BY {run}s.treatment, p.species, s.age ORDER BY \
               {run}s.treatment, p.species, s.age",
    },
    Macro {
        tables: &[Table::Summary, Table::Treatments],
        name: "treatments_at",
        parameters: Some(&["a"]),
        comment: "The means of each treatment at an age, with its level of each factor.",
        body: "SELECT t.*, m.plants, m.alive, m.internodes, m.leaves, m.height_m, m.leaf_area_m2 FROM treatments t JOIN \
               (SELECT {run}treatment, count(*) AS plants, count(*) FILTER (WHERE alive) AS alive, avg(internodes) AS \
               internodes, avg(leaves) AS leaves, avg(height_m) AS height_m, avg(leaf_area_m2) AS leaf_area_m2 FROM summary \
               WHERE age = {a} GROUP BY {run}treatment) m USING ({run}treatment) ORDER BY {run}t.treatment_index",
    },
    Macro {
        tables: &[Table::Summary, Table::Plants],
        name: "pairs_at",
        parameters: Some(&["a"]),
        comment: "The plants at an age with what pairs them across treatments: replicate, and number within it. Plants of \
                  the same replicate and number have the same draws.",
        body: "SELECT p.replicate, p.block, p.number, s.* FROM summary s JOIN (SELECT {run}plot_id, plant_id, replicate, \
               block, row_number() OVER (PARTITION BY {run}treatment, replicate ORDER BY plant_id) - 1 AS number FROM \
               plants) p USING ({run}plot_id, plant_id) WHERE s.age = {a} ORDER BY p.replicate, p.number, s.treatment",
    },
];

/// The macro of a run with the columns of mechanics.
pub const MECHANICS: Macro = Macro {
    tables: &[Table::Records],
    name: "mechanics_at",
    parameters: Some(&["a"]),
    comment: "What each plant weighs at an age, in kg, and where it is bent most, in N m and 1/m.",
    body: "SELECT {run}plant_id, sum(wood_volume_m3) AS wood_volume_m3, sum(fresh_mass_kg) AS fresh_mass_kg, \
           max(\"bending_moment_N_m\") AS \"bending_moment_N_m\", max(curvature_per_m) AS curvature_per_m FROM records WHERE \
           age = {a} GROUP BY {run}plant_id ORDER BY {run}plant_id",
};
