//! Growth between the operations of people: ahead to the tick before each, then the operation, then on.
//!
//! So a plot with few operations grows axis by axis for nearly all of its ticks. The plants stand at the end of the
//! tick before an operation that looks at where their wood is. Then the cuts are made, the models answer them, and what
//! is dead is shed. Absent: what an operation does ([`crate::management`]), and the loop.

use crate::clock::Tick;
use crate::management::Worked;
use crate::model::Overgrown;
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
        let members = self.worked();
        let mut now = self.site.tick;
        while let Some(tick) = self.management.next(now, &members).filter(|tick| *tick <= until) {
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
        // Where plants stand at each tick anyway, they have stood at the last.
        if self.management.looks_at(tick, &members) && !self.is_looked_at() {
            self.stand(tick - 1);
        }
        let Self { species, plants, lives, members: all, management, .. } = self;
        management.work(tick, &members, plants);
        for ((plant, life), (member, worked)) in plants.iter_mut().zip(lives).zip(all.iter().zip(&members)) {
            if let Some(age) = member.age_at(tick).filter(|age| *age > 0 && worked.can_be_cut) {
                species[member.species].answer_cuts(age, plant, life)?;
                shed(plant);
            }
        }
        Ok(())
    }

    fn worked(&self) -> Vec<Worked> {
        let worked = |member: &Member| Worked {
            sown: member.sown,
            can_be_cut: self.species[member.species].growth().keeps_its_past(),
        };
        self.members.iter().map(worked).collect()
    }
}
