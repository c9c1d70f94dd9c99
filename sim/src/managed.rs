//! Growth between the operations of people: ahead to the tick before each, then the operation, then on.
//!
//! So a plot with few operations grows axis by axis for nearly all of its ticks. The plants stand at the end of the
//! tick before an operation that looks at where their wood is. Then the cuts are made, the models answer them, and what
//! is dead is shed. Absent: what an operation does ([`crate::management`]), and the loop.

use crate::clock::{NEVER, Tick};
use crate::management::{Successor, Worked};
use crate::model::Overgrown;
use crate::plant::{AxisId, Plant};
use crate::plot::{Member, Plot};
use crate::shed::shed;

impl Plot<'_> {
    /// Whether operations keep growth from running ahead: they depend on wood that remembers its shape, which must have
    /// stood at each tick before.
    pub(crate) fn is_watched(&self) -> bool {
        self.management.looks() && self.remembers()
    }

    /// Grows all members to the tick `until`, from operation to operation.
    ///
    /// # Errors
    /// [`Overgrown`], as [`Plot::grow_to`].
    pub(crate) fn grow_managed(&mut self, until: Tick) -> Result<(), Overgrown> {
        let mut now = self.site.tick;
        while let Some(tick) = self.management.next(now, &self.worked()).filter(|tick| *tick <= until) {
            self.grow_to(tick - 1)?;
            self.operate(tick)?;
            now = tick;
        }
        self.grow_to(until)
    }

    /// Does what people do between the tick before `tick` and this one, and lets the plants answer.
    ///
    /// # Errors
    /// [`Overgrown`], of the first plant in the order of the plot of which the answer passed its limit.
    pub fn operate(&mut self, tick: Tick) -> Result<(), Overgrown> {
        let members = self.worked();
        if self.management.is_empty() || self.management.next(tick - 1, &members) != Some(tick) {
            return Ok(());
        }
        // Where plants stand at each tick anyway, they have stood at the last, though perhaps without their diameters.
        if self.management.looks_at(tick, &members) {
            if !self.is_looked_at() {
                self.stand(tick - 1);
            } else if !self.needs_diameters() {
                self.stand_in_known_light(tick - 1);
            }
        }
        let replants = self.management.replants(tick, &members);
        let Self { species, plants, lives, members: all, management, .. } = self;
        management.work(tick, &members, plants);
        for ((plant, life), (member, worked)) in plants.iter_mut().zip(lives).zip(all.iter().zip(&members)) {
            if let Some(age) = member.age_at(tick).filter(|age| *age > 0 && worked.can_be_cut) {
                species[member.species].answer_cuts(age, plant, life)?;
                shed(plant);
            }
        }
        if replants {
            self.replant(tick);
        }
        Ok(())
    }

    /// Plants each successor whose place is free at `tick`: it has the age 0 then. What still stands of the plant that
    /// it follows is taken. A seed that did not germinate has left its place free.
    fn replant(&mut self, tick: Tick) {
        let Self { plants, members, management, .. } = self;
        let free = |plants: &[Plant], members: &[Member], place: usize, is_successor: bool| match members[place].sown {
            NEVER => !is_successor,
            sown => sown < tick && plants[place].death <= tick - sown,
        };
        let successors = management.successors();
        let mut are_successors = vec![false; members.len()];
        for successor in successors.iter() {
            if let Some(is) = are_successors.get_mut(successor.member) {
                *is = true;
            }
        }
        for Successor { member, follows } in successors.iter().copied() {
            let there = member < members.len() && follows < members.len();
            if !there || members[member].sown != NEVER || !free(plants, members, follows, are_successors[follows]) {
                continue;
            }
            if let Some(age) = members[follows].age_at(tick).filter(|age| plants[follows].axes.shed[0] > *age) {
                plants[follows].cut(AxisId::TRUNK, 0, age);
                shed(&mut plants[follows]);
            }
            members[member].sown = tick;
        }
    }

    fn worked(&self) -> Vec<Worked> {
        let worked = |member: &Member| Worked {
            sown: member.sown,
            can_be_cut: self.species[member.species].growth().keeps_its_past(),
        };
        self.members.iter().map(worked).collect()
    }
}
