//! The plants of a plot on their way from one tick to the next, for a recorder that looks at moments between them.
//!
//! At a tick before such a moment a recorder keeps the plants, and at the next it is shown all moments in between: it
//! must want both. A plant that is sown at the later tick is not there before. Memory holds the plants once more for
//! each of the two.

use super::{Between, Moment};
use crate::clock::Tick;
use crate::plant::Plant;
use crate::plot::Plot;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelIterator};

/// The plants of a plot on their way.
#[derive(Debug, Default)]
pub struct Passage {
    kept: Option<(Tick, Vec<Plant>)>,
    ways: Vec<Option<Between>>,
    falls: bool,
}

impl Passage {
    /// With `falls`, leaves, petals and fruits drop to the ground in the tick in which they fall.
    pub fn new(falls: bool) -> Self {
        Self { falls, ..Self::default() }
    }

    /// Whether a recorder that looks at these moments, in their order, needs a tick.
    pub fn needs(moments: &[Moment], tick: Tick) -> bool {
        let from = moments.partition_point(|moment| moment.tick() < tick);
        let next = moments[from..].iter().find(|moment| moment.tick() > tick);
        moments.get(from).is_some_and(|moment| moment.tick() == tick) || Self::is_left(next, tick)
    }

    /// Whether moments between a tick and the next one are among these, which are in their order.
    pub fn begins(moments: &[Moment], tick: Tick) -> bool {
        Self::is_left(moments.iter().find(|moment| moment.tick() > tick), tick)
    }

    fn is_left(next: Option<&Moment>, tick: Tick) -> bool {
        next.is_some_and(|next| next.tick() - 1 == tick && next.share().is_some())
    }

    /// Keeps the plants as they stand at a tick.
    pub fn keep(&mut self, tick: Tick, plot: &Plot) {
        self.kept = Some((tick, plot.plants.clone()));
    }

    /// Makes the ways from the plants that were kept to those that stand at the tick after; none where that is not so.
    pub fn arrive(&mut self, tick: Tick, plot: &Plot) {
        self.ways.clear();
        let Some((before, plants)) = self.kept.take().filter(|(before, _)| *before + 1 == tick) else { return };
        let falls = self.falls;
        let members = plants.par_iter().zip(&plot.plants).zip(&plot.members);
        let ways = members.map(|((was, will), member)| {
            let age = member.age_at(tick).filter(|_| member.age_at(before).is_some())?;
            Some(Between::new(was, will, age, plot.species[member.species].growth(), falls))
        });
        self.ways = ways.collect();
    }

    /// The plants at a share of the tick, in the order of the plot, each with its age at the later tick; `None` for
    /// what is not sown.
    pub fn at(&mut self, share: f32) -> Vec<Option<(&Plant, Tick)>> {
        self.ways
            .par_iter_mut()
            .map(|way| {
                way.as_mut().map(|way| {
                    let age = way.age;
                    (way.at(share), age)
                })
            })
            .collect()
    }
}
