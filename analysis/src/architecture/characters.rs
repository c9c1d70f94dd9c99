//! The characters by which Hallé, Oldeman & Tomlinson 1978 tell their models apart, measured on one recorded plant:
//! where and when it branches, how its axes end, how they are relayed, how they are inclined, where its flowers stand.
//!
//! Characters are counts and shares over topology, fates and stated trends. Recorded directions are read only for how
//! axes bend under their weight and how the base of a trunk is erected (`lie`), since two models are defined by these.
//! Absent: the models, each a list of required characters (`models`).

use super::axes::{Axis, Role, axes_of, is_plagiotropic};
use super::lie::{Lie, lie_of};
use super::relays::{Relays, relays_of};
use super::share::Share;
use super::tolerance::TIER_SHARE;
use phytomer_outputs::rows::{ComponentRow, PoseRow};
use phytomer_sim::plant::{Cause, Kind, Origin};

/// The characters of one plant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Characters {
    /// The number of axes that made an internode, without reiterates.
    pub axes: u32,
    /// The number of trunks: the axes of order 1, without reiterates.
    pub trunks: u32,
    /// The number of axes of order 1 from the base of another axis of order 1.
    pub basal: u32,
    /// The number of axes from axillary buds.
    pub axillary: u32,
    /// Of the apices that divided: the share that divided into two.
    pub dichotomies: Share,
    /// Whether a bud lives at the last age.
    pub lives: bool,
    /// The number of flowers on the sides of axes.
    pub lateral_flowers: u32,
    /// The number of axes of order 1 that ended in a flower.
    pub flowered_trunks: u32,
    /// The number of axes of higher orders that ended in a flower.
    pub flowered_branches: u32,
    /// Of the trunks that flowered or completed their growth: the share that completed it without a flower.
    pub completed_trunks: Share,
    /// Of the branches that flowered or completed their growth: the share that flowered.
    pub branch_flowers: Share,
    /// Of the axes of order 1 with a trend: the share that is plagiotropic at first.
    pub plagiotropic_trunks: Share,
    /// Of the axes of order 2 with a trend: the share that is plagiotropic at first.
    pub plagiotropic_limbs: Share,
    /// Of the axes of all higher orders with a trend: the share that is plagiotropic at first.
    pub plagiotropic_branches: Share,
    /// Whether the trunk's branches stand in tiers at the tips of growth units; `None` with fewer than three branches.
    pub tiers: Option<bool>,
    /// Of the axes of order 2 on the trunk whose apices have ended: the share that is determinate, having completed all
    /// growth units.
    pub determinate_branches: Share,
    /// Of the determinate axes of order 2: the share that bears no axes.
    pub simple_branches: Share,
    /// The number of determinate branches that were shed whole.
    pub shed_branches: u32,
    /// The relays of axes of order 1.
    pub trunk_relays: Relays,
    /// The relays of axes of higher orders.
    pub branch_relays: Relays,
    /// Inclinations under weight, from recorded directions.
    pub lie: Lie,
    /// What is not told of the plant; nothing of a plant that has grown.
    pub untold: Untold,
}

/// What the file of a measured plant does not tell. A model does not lack what nobody has looked at.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Untold {
    /// Whether axes flower, and where.
    pub flowers: bool,
    /// Which nodes are of one growth unit.
    pub units: bool,
    /// Which apices have ended.
    pub ends: bool,
}

impl Characters {
    /// The characters of one plant from its rows of `components`, and from the recorded poses of its internodes.
    /// Without `poses` the characters in [`Lie`] are empty. Takes O(n log n) for n rows.
    pub fn of(components: &[ComponentRow], poses: &[PoseRow]) -> Self {
        let axes = axes_of(components);
        let lives = components.iter().any(|row| row.kind == Kind::ApicalBud && row.death_age.is_none());
        let mut c = Self { lives, tiers: tiers(&axes), lie: lie_of(&axes, poses), ..Self::default() };
        let counts = |axis: &&Axis| axis.is_judged() && !axis.nodes.is_empty();
        for axis in axes.iter().filter(counts) {
            c.count(axis);
        }
        c.count_forks(&axes);
        c.count_branches(&axes);
        c.trunk_relays = relays_of(&axes, |order| order == 1);
        c.branch_relays = relays_of(&axes, |order| order > 1);
        c
    }

    fn count(&mut self, axis: &Axis) {
        let trunk = axis.order == 1;
        self.axes += 1;
        self.trunks += u32::from(trunk);
        self.basal += u32::from(axis.role == Role::Basal);
        self.axillary += u32::from(axis.origin == Origin::Axillary);
        self.lateral_flowers += axis.lateral_flowers;
        self.flowered_trunks += u32::from(trunk && axis.flowered());
        self.flowered_branches += u32::from(!trunk && axis.flowered());
        if axis.finished() {
            let ends = if trunk { &mut self.completed_trunks } else { &mut self.branch_flowers };
            ends.add(axis.flowered() != trunk);
        }
        if let Some(trend) = axis.first_trend() {
            let trends = if trunk { &mut self.plagiotropic_trunks } else { &mut self.plagiotropic_branches };
            trends.add(is_plagiotropic(trend));
            if axis.order == 2 {
                self.plagiotropic_limbs.add(is_plagiotropic(trend));
            }
        }
    }

    fn count_forks(&mut self, axes: &[Axis]) {
        for bearing in axes {
            let forked = bearing.bears.iter().filter(|&&axis| axes[axis].origin == Origin::Fork).count();
            if forked > 0 {
                self.dichotomies.add(forked == 2);
            }
        }
    }

    fn count_branches(&mut self, axes: &[Axis]) {
        let of_trunk = |axis: &&Axis| axis.order == 2 && axis.role == Role::Own && axis.origin == Origin::Axillary;
        for axis in axes.iter().filter(of_trunk) {
            let Some((_, cause)) = axis.end else { continue };
            let determinate = cause == Cause::Completed;
            self.determinate_branches.add(determinate);
            if determinate {
                self.simple_branches.add(axis.bears.is_empty());
                self.shed_branches += u32::from(axis.shed.is_some());
            }
        }
    }
}

/// Whether the branches of the trunk stand in the outer halves of its growth units. Branches on a growth unit of fewer
/// than four nodes count as outside a tier, since so short a unit has no distinct tip.
fn tiers(axes: &[Axis]) -> Option<bool> {
    const LEAST_NODES: usize = 4;
    const LEAST_BRANCHES: u32 = 3;
    let mut outer = Share::default();
    for trunk in axes.iter().filter(|axis| axis.order == 1 && axis.role == Role::Own) {
        let units = units_of(trunk);
        let borne = trunk.bears.iter().map(|&place| &axes[place]);
        let branches = borne.filter(|axis| axis.origin == Origin::Axillary);
        for branch in branches {
            let rank = branch.bearer_rank as usize;
            let unit = units.iter().find(|(first, last)| (*first..=*last).contains(&rank));
            let in_tier =
                |(first, last): &(usize, usize)| last - first + 1 >= LEAST_NODES && 2 * (rank - first) >= last - first;
            outer.add(unit.is_some_and(in_tier));
        }
    }
    (outer.of >= LEAST_BRANCHES).then(|| outer.is_at_least(TIER_SHARE))
}

/// The first and the last rank of each growth unit of an axis. A new unit begins where the rank in the unit does not
/// rise.
fn units_of(axis: &Axis) -> Vec<(usize, usize)> {
    let mut units: Vec<(usize, usize)> = Vec::new();
    let mut before = u32::MAX;
    for (rank, node) in (1..).zip(&axis.nodes) {
        match units.last_mut() {
            Some(unit) if node.unit_rank > before => unit.1 = rank,
            _ => units.push((rank, rank)),
        }
        before = node.unit_rank;
    }
    units
}
