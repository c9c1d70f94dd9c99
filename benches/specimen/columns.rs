//! The columns of a plant, written again into memory that is already allocated: the cost of growth and pose if nothing
//! had to be computed.
//!
//! Each copy names every column, so that a new column cannot be forgotten. Absent: the living buds and the tips of
//! axes, which are few, and the log of events, which a run may leave out.

use phytomer::sim::plant::{Axes, Nodes, Organs, Plant};
use phytomer::sim::pose::Frames;

/// Clears columns and writes those of another into their memory.
macro_rules! rewrite {
    ($kind:ident, $from:expr, $into:expr; $($column:ident),+) => {{
        let $kind { $($column),+ } = $from;
        $($into.$column.clone_from($column);)+
    }};
}

/// Writes the topology, rest geometry and fates of a plant: the columns that growth writes.
pub fn write_growth(from: &Plant, into: &mut Plant) {
    write_axes(&from.axes, &mut into.axes);
    write_nodes(&from.nodes, &mut into.nodes);
    write_organs(&from.organs, &mut into.organs);
}

fn write_axes(from: &Axes, into: &mut Axes) {
    rewrite!(Axes, from, into; bearer, component, key, order, origin, position, follows, state, appearance, birth,
        azimuth, insertion, shed_after, last_node, apex_end, apex_fate, spent, death, shed);
}

fn write_nodes(from: &Nodes, into: &mut Nodes) {
    rewrite!(Nodes, from, into; parent, axis, component, birth, rank, unit_rank, formation, trend, length,
        primary_diameter, diameter, diameter_tip, azimuth, growth_unit, cycle, axillary_buds, runs);
}

fn write_organs(from: &Organs, into: &mut Organs) {
    rewrite!(Organs, from, into; node, component, kind, position, birth, death, cause, form, length, width, area,
        azimuth, insertion);
}

/// Writes the pose of every internode.
pub fn write_frames(from: &Frames, into: &mut Frames) {
    into.base.clone_from(&from.base);
    into.heading.clone_from(&from.heading);
    into.up.clone_from(&from.up);
}
