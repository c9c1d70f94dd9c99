//! Axes of one order that grow one after another: what is the same for all of them is looked up once.
//!
//! Absent: the growth of one axis (`grow`), and the words that are read for many (`together`).

use super::bud::ApicalBud;
use super::compile::BudModel;
use super::grow::{Axis, Full};
use super::record::Words;
use super::together::MANY_ALIKE;
use phytomer_sim::Tick;
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::Plant;
use phytomer_sim::site::Site;

impl BudModel {
    /// Grows axes of one order from their buds to `age`, one after another. The buds join the living ones among
    /// `words`, whose last nodes may be left to be made by [`Self::make_last`].
    pub(super) fn grow_alike(
        &self,
        (plant, site): (&mut Plant, Option<&Site>),
        buds: &[ApicalBud],
        age: Tick,
        words: &mut Words,
    ) -> Result<(), Overgrown> {
        let Some(first) = buds.first() else { return Ok(()) };
        let grown = {
            let mut axis = Axis::new(self, plant, words, *first);
            buds.iter().enumerate().try_for_each(|(nth, bud)| {
                if nth > 0 {
                    axis.go_on_to(*bud);
                }
                if site.is_some() {
                    axis.look_around(site);
                }
                axis.grow(age)
            })
        };
        grown.map_err(|Full| Overgrown::of(plant))
    }

    /// As [`Self::grow_alike`], for axes of any orders.
    pub(super) fn grow_all(
        &self,
        (plant, site): (&mut Plant, Option<&Site>),
        mut buds: &[ApicalBud],
        age: Tick,
        words: &mut Words,
    ) -> Result<(), Overgrown> {
        while let Some(first) = buds.first() {
            let order = |bud: &ApicalBud| plant.axes.order[bud.axis.index()];
            let alike = buds.iter().take_while(|bud| order(bud) == order(first)).count();
            let (now, later) = buds.split_at(alike);
            words.many_alike = alike >= MANY_ALIKE;
            if site.is_none() && self.grow_plainly(plant, now) {
                self.grow_plain(plant, now, age, words).map_err(|Full| Overgrown::of(plant))?;
            } else {
                self.grow_alike((plant, site), now, age, words)?;
            }
            buds = later;
        }
        Ok(())
    }
}

impl<'a> Axis<'a> {
    /// An axis that grows from its bud, with the words that were read ahead for the bud which grows next.
    #[inline(always)]
    pub(super) fn new(model: &'a BudModel, plant: &'a mut Plant, words: &'a mut Words, bud: ApicalBud) -> Self {
        let axis = Self::of(model, plant, words, bud);
        axis.words.take_ahead(axis.laws);
        axis
    }

    /// Goes on to another axis of the same order, with the words that were read ahead for it.
    #[inline]
    fn go_on_to(&mut self, bud: ApicalBud) {
        self.stand_on(bud);
        self.words.take_ahead(self.laws);
    }

    /// Goes on to another axis of the same order.
    #[inline]
    pub(super) fn stand_on(&mut self, bud: ApicalBud) {
        let place = bud.axis.index();
        self.words.of_next(self.laws);
        self.bud = bud;
        (self.start, self.around, self.contact, self.plans) = (None, None, 0, false);
        (self.leads, self.birth) = (!self.plant.axes.follows[place], self.plant.axes.birth[place]);
        self.set_tick(bud.age);
        if self.laws.asks_light {
            self.shade = self.plant.shade.of(bud.axis);
            if self.words.shaded != (self.shade > 0) {
                (self.words.shaded, self.tests) = (self.shade > 0, None);
            }
        }
        if self.laws.head.guides_growth {
            self.read_head();
        }
    }
}
