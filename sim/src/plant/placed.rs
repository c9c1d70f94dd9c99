//! How a model that rewrites fills the columns: with components whose numbers were given before, in whatever order.
//!
//! Such a model may also put something between a component and what bears it. So a plant may keep the bearer that each
//! component had at its birth, which is always of a smaller number. Absent: what has left the columns (`ledger`).

use super::{AxisId, NewAxis, NewNode, NewOrgan, NodeId, OrganId, Plant, numbered};

/// No component: what the first of a plant stands on.
const NOTHING: u32 = u32::MAX;

impl Plant {
    /// Names the components of this plant by their numbers from now on: a node that a model inserts in mid-axis changes
    /// the ranks of others, but not their numbers.
    pub fn name_by_number(&mut self) {
        self.named_by_number = true;
    }

    /// A new component number.
    pub fn next_number(&mut self) -> u32 {
        self.number()
    }

    /// Adds an axis with a component number that was given before; its key follows from the number.
    #[inline]
    pub fn place_axis(&mut self, axis: NewAxis, component: u32) -> AxisId {
        self.axes.push(NewAxis { key: numbered(component), ..axis }, component)
    }

    /// Adds an internode with its node at the tip of its axis, with a component number that was given before.
    #[inline]
    pub fn place_node(&mut self, node: NewNode, component: u32) -> NodeId {
        let id = self.nodes.push(node, component);
        self.axes.grown(node.axis, id);
        id
    }

    /// Adds an organ to a node, with a component number that was given before.
    #[inline]
    pub fn place_organ(&mut self, organ: NewOrgan, component: u32) -> OrganId {
        self.organs.push(organ, component)
    }

    /// A new component number, of a component that the component `bearer` bears at its birth.
    #[inline]
    pub fn next_number_on(&mut self, bearer: Option<u32>) -> u32 {
        let number = self.next_number();
        if self.bearers.len() != number as usize {
            self.bearers.resize(number as usize, NOTHING);
        }
        self.bearers.push(bearer.unwrap_or(NOTHING));
        number
    }

    /// The component that bore a component at its birth, where the plant keeps it: a model that rewrites in mid-axis
    /// may put something between the two later. `None` where the plant does not keep it, since nothing changes.
    #[inline]
    pub fn bearer_at_birth(&self, component: u32) -> Option<Option<u32>> {
        let bearer = self.bearers.get(component as usize)?;
        Some((*bearer != NOTHING).then_some(*bearer))
    }

    /// The apical buds of axes that have left the columns, by their numbers, in the order of departure.
    pub fn gone_buds(&self) -> &[u32] {
        &self.gone_buds
    }

    /// The component number of the apical bud of an axis, also of one that is gone ([`AxisId::gone`]).
    #[inline]
    pub fn bud_number(&self, axis: AxisId) -> u32 {
        match self.axes.component.get(axis.index()) {
            Some(number) => *number,
            None => self.gone_buds.get((u32::MAX - axis.0) as usize).copied().unwrap_or_default(),
        }
    }

    /// The order of an axis, also of one that is gone ([`AxisId::gone`]).
    #[inline]
    pub fn order_of(&self, axis: AxisId) -> u8 {
        match self.axes.order.get(axis.index()) {
            Some(order) => *order,
            None => self.gone_orders.get((u32::MAX - axis.0) as usize).copied().unwrap_or_default(),
        }
    }
}
