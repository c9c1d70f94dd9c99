//! The columns of the seven tables, each declared once; `treatments` has a further column for each factor of the run.
//!
//! The Arrow schema, the Parquet metadata, `datapackage.json` and the documentation are made from these lists. Ids and
//! ticks are signed, because many readers have no unsigned numbers. Null means "does not apply" or "not by the end of
//! the run"; no number stands for it. A `tick` is the plot's, an `age` (or `…_age`) the plant's. A component's place is
//! relative to the seed of its plant, in single precision; that of the seed is in `plants`, in double precision.

mod light;
mod site;
mod summary;

pub use light::{RECORDS_IN_LIGHT, SITE_IN_LIGHT, SUMMARY_IN_LIGHT};
pub use site::SITE;
pub use summary::SUMMARY;

use super::schema::{Column, Encoding, Named, Rounding, Type};
use phytomer_sim::plant::{Cause, EventKind, Kind, Origin};

/// The version of these lists: it changes with a column's name, type or meaning.
pub const SCHEMA_VERSION: &str = "5";

/// The tags of [`Kind`], in the order of their numbers.
pub static KINDS: [&str; Kind::ALL.len()] = {
    let mut tags = [""; Kind::ALL.len()];
    let mut i = 0;
    while i < tags.len() {
        tags[i] = Kind::ALL[i].tag();
        i += 1;
    }
    tags
};

/// The tags of [`EventKind`], in the order of their numbers.
pub static EVENT_TAGS: [&str; EventKind::ALL.len()] = {
    let mut tags = [""; EventKind::ALL.len()];
    let mut i = 0;
    while i < tags.len() {
        tags[i] = EventKind::ALL[i].tag();
        i += 1;
    }
    tags
};

/// The tags of [`Origin`], in the order of their numbers.
pub static ORIGINS: [&str; Origin::ALL.len()] = {
    let mut tags = [""; Origin::ALL.len()];
    let mut i = 0;
    while i < tags.len() {
        tags[i] = Origin::ALL[i].tag();
        i += 1;
    }
    tags
};

/// The causes of death, in the order of their numbers less one.
pub static CAUSES: [&str; Cause::ALL.len()] = {
    let mut tags = [""; Cause::ALL.len()];
    let mut i = 0;
    while i < tags.len() {
        tags[i] = match Cause::ALL[i].tag() {
            Some(tag) => tag,
            None => "",
        };
        i += 1;
    }
    tags
};

const TREATMENT: Column = Column::new(
    "treatment",
    Type::Name(Named::Treatment),
    Encoding::Dictionary,
    "The treatment of the plot; `control` where a run has one.",
);
const PLOT: Column = Column::id("plot_id", "The plot: the plants that share a site.");
const PLANT: Column = Column::id("plant_id", "The plant's number in the run, from 0.");
const BLOCK: Column =
    Column::small("block", "The block of the field, from 0. Null where the experiment has no blocks.").or_null();
/// Constant over long runs of rows; DELTA_BINARY_PACKED stores such a run in no bits per row.
const TICK: Column = Column::id("tick", "The tick of the plot, from 0.").unit("tick");
const AGE: Column = Column::id(
    "age",
    "The age of the plant: ticks since it was sown, which is `tick` less its `sown_tick` in `plants`.",
)
.unit("tick");
const COMPONENT: Column = Column::id(
    "component_id",
    "The component's number in its plant: dense from 0, a parent's before its children's, the same at every age.",
);
const PARENT: Column = Column::id(
    "parent_id",
    "The component_id of the internode whose node bears this one; for an apical bud, of the internode that bears its \
     axis. Null for what stands on the seed.",
)
.or_null();
const AXIS: Column = Column::id("axis_id", "The axis, as the component_id of its apical bud.");
const ORDER: Column = Column::small("order", "The order of the axis; the trunk is 1.");
const STATE_NAME: Column = Column::new(
    "state_name",
    Type::Name(Named::State),
    Encoding::Dictionary,
    "The name of that state in the species. Null where the species names no states, or `state` is null.",
)
.or_null();
const KIND: Column = Column::word("kind", &KINDS, "What the component is.");

/// The number of columns of [`RECORDS`] that every run has; the columns of mechanics follow, for runs that state them.
pub const RECORDS_OF_POSE: usize = 26;

/// A row per component that stands at a recorded tick, living or dead.
pub static RECORDS: [Column; RECORDS_OF_POSE + 4] = [
    TREATMENT,
    PLOT,
    PLANT,
    TICK,
    AGE,
    COMPONENT,
    PARENT,
    AXIS,
    ORDER,
    KIND,
    Column::id(
        "rank",
        "The rank along the axis, from 1, of the internode or of the internode that bears the organ; for an apical bud, \
         the internodes that it has made so far.",
    ),
    Column::tick("birth_age", "The age of the plant at which the component appeared."),
    Column::float(
        "x_m",
        "m",
        "The base of the component, eastward of the seed of its plant; for an apical bud, its place. `plants` has the \
         place of the seed: added up in double precision they are the place in the plot.",
    )
    .rounded(Rounding::Position),
    Column::float(
        "y_m",
        "m",
        "The base of the component, northward of the seed of its plant; for an apical bud, its place.",
    )
    .rounded(Rounding::Position),
    Column::float(
        "z_m",
        "m",
        "The base of the component, above the seed of its plant; for an apical bud, its place.",
    )
    .rounded(Rounding::Position),
    Column::float(
        "dir_x",
        "",
        "The direction in which the component points, eastward: a unit vector with the next two.",
    )
    .rounded(Rounding::Direction),
    Column::float("dir_y", "", "The direction in which the component points, northward.").rounded(Rounding::Direction),
    Column::float("dir_z", "", "The direction in which the component points, upward.").rounded(Rounding::Direction),
    Column::float(
        "up_x",
        "",
        "The direction of its upper side, eastward: a unit vector with the next two, across the first.",
    )
    .rounded(Rounding::Direction),
    Column::float("up_y", "", "The direction of its upper side, northward.").rounded(Rounding::Direction),
    Column::float("up_z", "", "The direction of its upper side, upward.").rounded(Rounding::Direction),
    Column::float("length_m", "m", "Length along its direction at this age. Null for buds.").repeated().or_null(),
    Column::float("diameter_m", "m", "Diameter at the base at this age; width of an organ. Null for buds.").or_null(),
    Column::float("diameter_tip_m", "m", "Diameter at the tip at this age. Null for organs and buds.").or_null(),
    Column::float("area_m2", "m2", "Area of one side. Null where a component has none.").repeated().or_null(),
    Column::truth(
        "alive",
        "Whether the component lives. False for dead wood that still stands alone: between its branch's death and its fall.",
    ),
    Column::float(
        "wood_volume_m3",
        "m3",
        "The frustum of an internode at this age, of a blade its area by its thickness. Null for organs and buds.",
    )
    .or_null(),
    Column::float(
        "fresh_mass_kg",
        "kg",
        "Fresh mass at this age: of an internode its volume times the green density of its wood, of an organ by the \
         species' mass of leaves, flowers and fruits. Null for buds, and where the species states no wood or no density.",
    )
    .or_null(),
    Column::float(
        "curvature_per_m",
        "1/m",
        "The size of the curvature that bending has given an internode beyond its pose at rest. Null for organs, buds and \
         species whose wood does not bend.",
    )
    .or_null(),
    Column::float(
        "bending_moment_N_m",
        "N m",
        "The size of the bending moment in the middle of an internode. Null for organs, buds and species whose wood does \
         not bend.",
    )
    .or_null(),
];

/// A row per component that ever lived, by the last tick of the run.
pub static COMPONENTS: [Column; 30] = [
    TREATMENT,
    PLOT,
    PLANT,
    COMPONENT,
    Column::new(
        "lineage_key",
        Type::Key,
        Encoding::Plain,
        "A hash of the path of ranks from the seed: the same in every run and every order of growth.",
    ),
    PARENT,
    AXIS,
    Column::id("bearing_axis_id", "The axis that bears this axis, as an axis_id. Null on the axis of the seed.")
        .or_null(),
    ORDER,
    KIND,
    Column::word("origin", &ORIGINS, "How the axis came to be."),
    Column::small("state", "The state in which the axis started, as the model numbers them."),
    STATE_NAME,
    Column::small(
        "position",
        "The position among its like on the node, from 0: of a lateral organ, or of the bud that an axis came from. Null \
         for internodes, and for the flower and the fruit at the end of an axis.",
    )
    .or_null(),
    Column::id(
        "rank",
        "The rank along the axis, from 1, of the internode, or of the one that bears the organ or the bud (for a bud, \
         along the bearing axis). Null for the bud of the seed.",
    )
    .or_null(),
    Column::small(
        "unit_rank",
        "The rank of the same internode in its growth unit, from 1. Null for the bud of the seed.",
    )
    .or_null(),
    Column::small(
        "growth_unit",
        "The number of the growth unit of the internode on its axis, from 1; units without nodes count. Null for organs and \
         buds, for models without growth units, and above 65,534.",
    )
    .or_null(),
    Column::small(
        "cycle",
        "The clock step of its axis at which the internode was made, from 1; steps at which the bud paused count. Null as \
         `growth_unit`.",
    )
    .or_null(),
    Column::truth("neoformed", "Whether the internode was made after bud break. Null for organs and buds.").or_null(),
    Column::small(
        "axillary_buds",
        "The axillary buds of the node at the tip of the internode, whether they became axes or lie dormant. Null as \
         `growth_unit`.",
    )
    .or_null(),
    Column::tick("birth_age", "The age of the plant at which the component appeared."),
    Column::tick("birth_dimension", "The ticks since the birth of the axis, at the component's. Null for buds.")
        .or_null(),
    Column::tick(
        "delay",
        "The ticks between the appearance of a bud and the birth of its axis: 0 sylleptic, more proleptic. Null for \
         internodes and organs.",
    )
    .or_null(),
    Column::float("length_m", "m", "Length along its direction. Null for buds.").repeated().or_null(),
    Column::float("birth_diameter_m", "m", "Diameter at birth; the width of an organ. Null for buds.")
        .repeated()
        .or_null(),
    Column::float("area_m2", "m2", "Area of one side. Null where a component has none.").repeated().or_null(),
    Column::tick(
        "death_age",
        "The age at which it died, from which on it lives no more: an organ fell, an apex ended, every apex of an \
         internode's branch had ended and was spent, which an apex that became a flower is when its flower and fruit have \
         fallen, and one that completed its growth when it has persisted as long as its species says. Null for what was alive at \
         the end.",
    )
    .or_null(),
    Column::tick(
        "shed_age",
        "The age at which it left the plant, from which on it has no row in `records`: the fall of an internode's branch; \
         the death of organs and buds, of which nothing stands dead. Null for what stood at the end.",
    )
    .or_null(),
    Column::word("cause_of_death", &CAUSES, "Why it died. Null for what was alive at the end.").or_null(),
    Column::float(
        "trend_deg",
        "deg",
        "The angle to the upward vertical that the axis tends to at this internode: 0 orthotropic, 90 plagiotropic. Null \
         for organs and buds, and where the axis keeps its direction.",
    )
    .repeated()
    .or_null(),
];

/// A row per fate of a bud or a branch, up to the last tick of the run.
pub static EVENTS: [Column; 12] = [
    TREATMENT,
    PLOT,
    PLANT,
    TICK,
    AGE,
    Column::id("component_id", "The apical bud: of the new axis where one began, of the branch that fell for `shed`."),
    Column::id("axis_id", "The axis of that bud: the same number, so that events join by axis too."),
    ORDER,
    Column::small(
        "state",
        "The state of the bud when it happened, as the model numbers them; of a new axis the state in which it starts. Null \
         for models without states, and for what befalls a branch whole: cuts, harvests, falls and buckling.",
    )
    .or_null(),
    STATE_NAME,
    Column::word("event", &EVENT_TAGS, "What happened; the falls of organs are in components."),
    Column::small(
        "count",
        "Of how many: the nodes of `grew`, the growth units of `completed`, the fruits of `thinned` and of a harvest of \
         fruits; else 1.",
    ),
];

/// A row per plant.
pub static PLANTS: [Column; 14] = [
    TREATMENT,
    PLOT,
    PLANT,
    Column::small(
        "replicate",
        "The replicate of the treatment of the plot, from 0; 0 where a run compares no treatments.",
    ),
    BLOCK,
    Column::new("species", Type::Name(Named::Species), Encoding::Dictionary, "The species of the plant."),
    Column::double("ticks_per_year", "tick", "The ticks of a year of the species. Null where it states none.").or_null(),
    Column::tick(
        "sown_tick",
        "The tick of the plot at which the plant was sown: its age 0. Null for a seed that did not germinate.",
    )
    .or_null(),
    Column::double(
        "x_m",
        "m",
        "The place of the seed in the plot, eastward, to which the places in `records` and in meshes are to be added; never \
         rounded.",
    ),
    Column::double("y_m", "m", "The place of the seed in the plot, northward; never rounded."),
    Column::double("z_m", "m", "The place of the seed in the plot, upward; never rounded."),
    Column::double(
        "ground_area_m2",
        "m2",
        "The ground of the plant: that of a place of the grid of its treatment, shared by the members of a plot. Null where \
         the scenario states no distances.",
    )
    .or_null(),
    Column::truth(
        "sampled",
        "Whether `components`, `records` and `events` have rows of the plant: true unless the run has a sample that it is \
         not in.",
    ),
    Column::truth("guard", "Whether the plant is a guard of its stand, which `summary` leaves out."),
];

/// The columns of [`PLANTS`] in a run without guards: all but the last.
pub const PLANTS_WITHOUT_GUARDS: usize = PLANTS.len() - 1;

/// A row per treatment. A column for each factor follows, with the name of the level.
pub static TREATMENTS: [Column; 2] =
    [Column::id("treatment_index", "The number of the treatment, from 0, in the order of its plots."), TREATMENT];
