//! The branches of a plant, measured where conditions ask, and the cuts that an operation makes in them.
//!
//! A branch is an axis with all that it bears; it counts while an internode of its axis stands. Cuts are made at nodes.
//! What is protected is not cut, and nothing is cut that bears it. Sources of the terms: heading shortens an axis,
//! thinning takes a branch off where it arises (Forshey, Elfving & Stebbins 1992, *Training and Pruning Apple and Pear
//! Trees*). Absent: what the plant makes of a cut, and how branches are trained (`training`).

use super::choice::Choice;
use super::column::Column;
use super::region::Region;
use crate::clock::Tick;
use crate::plant::{AxisId, Cut, NodeId, Plant, Taking};
use crate::pose::node_frame;

/// What a heading cut leaves of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kept {
    /// Its first nodes.
    Nodes(u32),
    /// The internodes whose tips lie within this share of its length; 1 leaves them all and takes the bud at the tip.
    Share(f64),
    /// The internodes whose tips lie within this length, metres.
    Length(f64),
}

/// The standing part of one axis.
#[derive(Debug, Clone, Copy)]
struct Branch {
    axis: AxisId,
    first: NodeId,
    last: NodeId,
    nodes: u32,
    length: f64,
}

/// The branches of a plant at the tick of an operation: what stood at the end of the tick before and was not taken
/// since.
pub struct Branches<'a> {
    plant: &'a Plant,
    tick: Tick,
    branches: Vec<Branch>,
    /// For each axis the branches that it bears itself.
    borne: Vec<u32>,
    /// For each axis the highest rank at which it bears something protected, and whether it is protected itself.
    held: Vec<(u32, bool)>,
    height: f64,
}

impl<'a> Branches<'a> {
    /// Finds the branches of `plant` in the order of their axes. Linear in its internodes.
    pub fn find(plant: &'a Plant, tick: Tick) -> Self {
        let mut of_axis: Vec<Option<Branch>> = vec![None; plant.axes.len()];
        plant.each_standing(tick, |stretch| {
            let axis = stretch.axis;
            let (first, last) = (stretch.nodes().start, stretch.nodes().end - 1);
            let of = of_axis[axis.index()].get_or_insert(Branch {
                axis,
                first: NodeId(first as u32),
                last: NodeId(last as u32),
                nodes: 0,
                length: 0.0,
            });
            of.last = NodeId(last as u32);
            of.nodes += stretch.nodes().len() as u32;
            of.length = stretch.nodes().fold(of.length, |sum, node| sum + f64::from(plant.nodes.length[node]));
        });
        let branches: Vec<Branch> = of_axis.into_iter().flatten().collect();
        let mut borne = vec![0; plant.axes.len()];
        for branch in &branches {
            if let Some(bearer) = plant.axes.bearer[branch.axis.index()].some() {
                borne[plant.nodes.axis[bearer.index()].index()] += 1;
            }
        }
        Self { plant, tick, branches, borne, held: vec![(0, false); plant.axes.len()], height: f64::NAN }
    }

    /// Tells the height of the plant, for columns that ask it.
    pub fn of_height(self, height: f64) -> Self {
        Self { height, ..self }
    }

    /// The value of a column of a branch; NaN for columns that branches do not have.
    fn value(&self, branch: &Branch, column: Column) -> f64 {
        let plant = self.plant;
        let (axis, axes) = (branch.axis.index(), &plant.axes);
        let bearer = axes.bearer[axis].some().map(NodeId::index);
        match column {
            Column::Age => f64::from(self.tick.saturating_sub(axes.appearance[axis])),
            Column::Order => f64::from(axes.order[axis]),
            Column::Origin => f64::from(axes.origin[axis] as u8),
            Column::Kind => f64::from(plant.kind_of(branch.first) as u8),
            Column::State => f64::from(axes.state[axis]),
            Column::Rank => bearer.map_or(0.0, |node| f64::from(plant.nodes.rank[node])),
            Column::Position => f64::from(axes.position[axis]),
            Column::Nodes => f64::from(branch.nodes),
            Column::Branches => f64::from(self.borne[axis]),
            Column::Dead => f64::from(u8::from(axes.death[axis] < self.tick)),
            Column::Length => branch.length,
            Column::Insertion => f64::from(axes.insertion[axis]).to_degrees(),
            Column::PlantAge => f64::from(self.tick),
            Column::PlantHeight => self.height,
            _ => self.posed(branch, column),
        }
    }

    fn posed(&self, branch: &Branch, column: Column) -> f64 {
        let plant = self.plant;
        let (base, tip) = (plant.frames.at(branch.first), node_frame(plant, branch.last).base.map(f64::from));
        match column {
            Column::Diameter => f64::from(plant.nodes.diameter[branch.first.index()]),
            Column::Height => f64::from(base.base[2]),
            Column::TipHeight => tip[2],
            Column::Reach => (tip[0] * tip[0] + tip[1] * tip[1]).sqrt(),
            Column::Inclination => crate::math::acos(f64::from(base.heading[2]).clamp(-1.0, 1.0)).to_degrees(),
            Column::Azimuth => {
                let [east, north, _] = base.heading.map(f64::from);
                let turned = crate::math::atan2(east, north).to_degrees();
                if turned < 0.0 { turned + 360.0 } else { turned }
            }
            _ => f64::NAN,
        }
    }

    /// Marks what a choice protects, and what bears it.
    fn protect(&mut self, choice: &Choice) {
        if choice.protect.is_none() {
            return;
        }
        let mut held = std::mem::take(&mut self.held);
        for branch in &self.branches {
            held[branch.axis.index()].1 = choice.protects(&mut |column| self.value(branch, column));
        }
        for branch in self.branches.iter().rev() {
            let axis = branch.axis.index();
            let Some(bearer) = self.plant.axes.bearer[axis].some().map(NodeId::index) else { continue };
            if held[axis].1 || held[axis].0 > 0 {
                let rank = &mut held[self.plant.nodes.axis[bearer].index()].0;
                *rank = (*rank).max(self.plant.nodes.rank[bearer]);
            }
        }
        self.held = held;
    }

    /// Whether nothing protected is above the node of `rank`.
    fn may_cut(&self, axis: AxisId, rank: u32) -> bool {
        let (highest, itself) = self.held[axis.index()];
        !itself && highest <= rank
    }

    /// The cuts at ranks that `rank_of` tells, of the axes that `choice` takes; `None` where there is nothing to cut.
    fn cuts(mut self, choice: &Choice, by: Taking, rank_of: impl Fn(&Self, &Branch) -> Option<u32>) -> Vec<Cut> {
        self.protect(choice);
        let ranks: Vec<Option<u32>> = self.branches.iter().map(|branch| rank_of(&self, branch)).collect();
        let allowed = |place: usize| ranks[place].is_some_and(|rank| self.may_cut(self.branches[place].axis, rank));
        let chosen = choice.of(self.branches.len(), allowed, |place, column| self.value(&self.branches[place], column));
        let cut = |place: usize| Cut {
            axis: self.branches[place].axis,
            rank: ranks[place].unwrap_or(u32::MAX),
            tick: self.tick,
            by,
        };
        self.without_what_goes_along(chosen.into_iter().map(cut).collect())
    }

    /// Leaves out the cuts of axes that go with a bearer that is cut below them. Bearers come first.
    fn without_what_goes_along(&self, cuts: Vec<Cut>) -> Vec<Cut> {
        let plant = self.plant;
        let mut left = vec![u32::MAX; plant.axes.len()];
        for cut in &cuts {
            left[cut.axis.index()] = cut.rank;
        }
        for axis in 0..plant.axes.len() {
            let Some(bearer) = plant.axes.bearer[axis].some().map(NodeId::index) else { continue };
            if plant.nodes.rank[bearer] > left[plant.nodes.axis[bearer].index()] {
                // Nothing of it is left, so that what it bears goes along too; its own cut is not needed.
                left[axis] = 0;
            }
        }
        let goes_along = |cut: &Cut| {
            let bearer = plant.axes.bearer[cut.axis.index()].some().map(NodeId::index);
            bearer.is_some_and(|bearer| plant.nodes.rank[bearer] > left[plant.nodes.axis[bearer].index()])
        };
        cuts.into_iter().filter(|cut| !goes_along(cut)).collect()
    }

    /// The branches that a choice trains, in the order of their axes. The trunk is no branch; what is protected is not
    /// trained itself, but goes along with its bearer.
    pub fn trained(&self, choice: &Choice) -> Vec<AxisId> {
        let known = |place: usize, column| self.value(&self.branches[place], column);
        let free = |place: usize| {
            let branch = &self.branches[place];
            let is_branch = self.plant.axes.bearer[branch.axis.index()].some().is_some();
            is_branch && !choice.protects(&mut |column| self.value(branch, column))
        };
        let chosen = choice.of(self.branches.len(), free, known);
        chosen.into_iter().map(|place| self.branches[place].axis).collect()
    }

    /// Heading: each chosen axis keeps a part. An axis that is no longer than that is left as it is.
    pub fn head(self, choice: &Choice, kept: Kept, by: Taking) -> Vec<Cut> {
        self.cuts(choice, by, |all, branch| {
            let last = all.plant.nodes.rank[branch.last.index()];
            let first = all.plant.nodes.rank[branch.first.index()];
            let rank = match kept {
                Kept::Nodes(nodes) => nodes,
                Kept::Share(share) if share >= 1.0 => {
                    let lives = all.plant.axes.apex_end[branch.axis.index()] >= all.tick;
                    return lives.then_some(last);
                }
                Kept::Share(share) => all.within(branch, first, share * branch.length),
                Kept::Length(length) => all.within(branch, first, length),
            };
            (rank < last).then_some(rank)
        })
    }

    /// The rank of the last node of which the tip lies within a length from the base of the axis.
    fn within(&self, branch: &Branch, first: u32, length: f64) -> u32 {
        let mut lengths = vec![0.0; branch.nodes as usize];
        let mut node = branch.last;
        for place in lengths.iter_mut().rev() {
            *place = f64::from(self.plant.nodes.length[node.index()]);
            node = self.plant.nodes.parent[node.index()];
        }
        let mut along = 0.0;
        // A tip that lies at the length but for rounding is within it.
        let within = lengths.iter().take_while(|internode| {
            along += **internode;
            along <= length * (1.0 + 1e-6)
        });
        (first - 1).saturating_add(within.count() as u32)
    }

    /// Thinning: each chosen branch is taken off where it arises. The trunk is no branch.
    pub fn thin(self, choice: &Choice, by: Taking) -> Vec<Cut> {
        self.cuts(choice, by, |all, branch| all.plant.axes.bearer[branch.axis.index()].some().map(|_| 0))
    }

    /// Stumping: the trunk keeps its first nodes, and no other axis of the order of the trunk that stands on them.
    pub fn stump(self, choice: &Choice, kept: u32, by: Taking) -> Vec<Cut> {
        let plant = self.plant;
        self.cuts(choice, by, |_, branch| match plant.axes.bearer[branch.axis.index()].some().map(NodeId::index) {
            None => (kept < plant.nodes.rank[branch.last.index()]).then_some(kept),
            Some(bearer) => {
                let young_trunk =
                    plant.axes.order[branch.axis.index()] == 1 && plant.nodes.axis[bearer] == AxisId::TRUNK;
                young_trunk.then_some(0)
            }
        })
    }

    /// Topping and hedging: each chosen axis loses what stands in a region from where it enters it. Of axes of an order
    /// above `highest_order` nothing is cut.
    pub fn clear(self, choice: &Choice, region: &Region, highest_order: u8, by: Taking) -> Vec<Cut> {
        let plant = self.plant;
        let mut enters = vec![u32::MAX; plant.axes.len()];
        plant.each_standing(self.tick, |stretch| {
            let rank = &mut enters[stretch.axis.index()];
            let mut reached = stretch.nodes().map(|node| NodeId(node as u32));
            if plant.axes.order[stretch.axis.index()] <= highest_order
                && *rank == u32::MAX
                && let Some(node) = reached.find(|node| region.holds(node_frame(plant, *node).base))
            {
                *rank = plant.nodes.rank[node.index()];
            }
        });
        self.cuts(choice, by, |_, branch| {
            let rank = enters[branch.axis.index()];
            (rank < u32::MAX).then(|| rank.saturating_sub(1))
        })
    }
}
