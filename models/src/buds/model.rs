//! The bud model as a [`GrowthModel`]: sowing, growing axis by axis to an age, and the diameters at an age.
//!
//! A plant grown ahead takes its axes one after another through all their ticks; a plant grown by the clock takes each
//! living bud through one tick. Both call the same step. Absent: the step (`grow`) and the node (`node`).

use super::birth::{add_axis, first_bud};
use super::bud::{ApicalBud, LivingBuds};
use super::compile::{BudModel, OrderLaws};
use super::grow::{Axis, Full};
use super::planned::make_last;
use super::record::Words;
use crate::law::At;
use phytomer_sim::Tick;
use phytomer_sim::expectation::Expectation;
use phytomer_sim::mechanics::taper;
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{ApexFate, AxisId, Habit, LineageKey, NewAxis, Plant, ThreadBudget};
use phytomer_sim::pose::bud_frame;
use phytomer_sim::site::{Site, View};
use std::ops::Range;
use std::sync::Arc;

/// The ticks of growth that cost as much as the start of an axis, as measured. The number only serves to divide work
/// equally.
const BEGINNING: u64 = 12;

/// The buds whose next words are made together.
const READ_TOGETHER: usize = 48;

impl BudModel {
    /// The last age for which the model's laws are compiled.
    pub fn until(&self) -> Tick {
        self.until
    }

    /// How many orders the species has.
    pub fn orders(&self) -> usize {
        self.orders.len()
    }

    /// Whether some law depends on `bud_birth`, `bud_dimension` or `unit`, which move with growth units alone. Sums
    /// over the ages and the cycles of axes cannot have such laws.
    pub fn asks_the_bud(&self) -> bool {
        self.orders.iter().any(|laws| laws.asks_the_bud)
    }

    /// Whether some law depends on the height of the plant.
    fn asks_height(&self) -> bool {
        self.orders.iter().any(|laws| laws.asks_height)
    }

    /// Whether some law or response depends on the light of the bud.
    fn asks_light(&self) -> bool {
        self.orders.iter().any(|laws| laws.asks_light)
    }

    pub(super) fn has_order(&self, order: u8) -> bool {
        (1..=self.orders.len()).contains(&usize::from(order))
    }

    #[inline]
    pub(super) fn laws(&self, order: u8) -> &OrderLaws {
        &self.orders[usize::from(order) - 1]
    }

    /// Grows one axis of `plant` from `bud` to `age`, without the axes that it bears. Returns its bud at that age, or
    /// `None` where the apex has come to its end.
    ///
    /// Growth ahead and growth by the clock are both made of this step; a prefix traversal in the manner of de Reffye
    /// 1988 §4 calls it recursively.
    ///
    /// # Errors
    /// [`Overgrown`] where the plant comes to its limit.
    pub fn grow_axis(&self, plant: &mut Plant, bud: ApicalBud, age: Tick) -> Result<Option<ApicalBud>, Overgrown> {
        Words::lend(false, |words| {
            self.grow_alike((plant, None), &[bud], age, words)?;
            self.make_last(plant, words)?;
            Ok(words.living.pop())
        })
    }

    /// The bud from which axis `axis` of `plant` starts.
    pub fn first_bud(&self, plant: &Plant, axis: AxisId) -> ApicalBud {
        first_bud(self, plant, axis)
    }

    /// Metres that internodes have added to their diameters when the plant is `age` ticks old: a list for each order
    /// and state, whose entry i is for internodes of age i.
    fn thickening_at(&self, age: Tick) -> Vec<Vec<f32>> {
        let classes = self.orders.iter().flat_map(|laws| (0..self.states).map(move |state| (laws, state as u8)));
        let by_own_age = |(laws, state): (&OrderLaws, u8)| {
            let at = |own| At { age, dimension: own, cycle: own, state, ..At::default() };
            (0..=age).map(|own| laws.thickening.value(at(own)) * 0.001).collect()
        };
        classes.map(by_own_age).collect()
    }

    /// Makes the nodes that axes have left to be made.
    fn make_last(&self, plant: &mut Plant, words: &mut Words) -> Result<(), Overgrown> {
        make_last(self, plant, words).map_err(|Full| Overgrown::of(plant))
    }

    /// Grows every living bud first, then the axes that arise meanwhile, each through all its ticks: parents come
    /// before their children, and nodes of an axis that are grown at once are neighbours in the columns. Living buds
    /// meet the solids and the stems of `site`; axes that arise meanwhile make nothing at the tick of their birth.
    fn grow_plant(
        &self,
        (plant, site): (&mut Plant, Option<&Site>),
        living: &mut Vec<ApicalBud>,
        age: Tick,
    ) -> Result<(), Overgrown> {
        let first_new = plant.axes.len();
        if !plant.cuts.all().is_empty() {
            // Leaves out the buds of axes that were cut off since the last tick.
            living.retain(|bud| plant.axes.apex_fate[bud.axis.index()] == ApexFate::Alive);
        }
        Words::lend(false, |words| {
            for buds in living.chunks(READ_TOGETHER) {
                let one_by_one = buds.first().is_some_and(|bud| age.saturating_sub(bud.age) == 1);
                words.read_ahead((self, plant), buds, age, one_by_one);
                self.grow_all((plant, site), buds, age, words)?;
            }
            self.make_last(plant, words)?;
            words.give_living(living);
            Ok(())
        })?;
        let mut next = first_new;
        while next < plant.axes.len() {
            let waiting = next..plant.axes.len();
            next = waiting.end;
            living.append(&mut self.grow_waiting(plant, waiting, age, plant.budget)?);
        }
        plant.age = age;
        Ok(())
    }

    /// Kills each bud that by the end of the last tick has reached a plane of the site that kills; the death is at the
    /// tick `age`, before the bud's step. The axes that follow its death start as living buds of that tick.
    fn kill_reaching(
        &self,
        plant: &mut Plant,
        living: &mut Vec<ApicalBud>,
        age: Tick,
        site: &Site,
    ) -> Result<(), Overgrown> {
        let mut words = Words::default();
        let limit = Overgrown::of(plant);
        let first_new = plant.axes.len();
        keep(living, |bud| {
            let at = bud_frame(plant, bud.axis).base;
            let at = [0, 1, 2].map(|k| plant.place[k] + f64::from(at[k]));
            if !site.kills_at(at) {
                return Ok(Some(bud));
            }
            Axis::new(self, plant, &mut words, bud).kill(age).map_err(|Full| limit.clone())?;
            Ok(None)
        })?;
        let new = first_new..plant.axes.len();
        living.extend(new.map(|axis| first_bud(self, plant, AxisId(axis as u32))));
        Ok(())
    }

    /// Grows the axes `waiting` through all their ticks and returns their living buds. Many axes are shared out to
    /// several threads, with the same result: the second half grows in a fragment of its own.
    fn grow_waiting(
        &self,
        plant: &mut Plant,
        waiting: Range<usize>,
        age: Tick,
        budget: ThreadBudget,
    ) -> Result<Vec<ApicalBud>, Overgrown> {
        if !budget.share(waiting.len()) {
            return self.grow_in_turn(plant, waiting, age);
        }
        let (first, second) = budget.parted();
        let limit = Overgrown::of(plant);
        let middle = middle_of(&plant.axes.birth, waiting.clone(), age);
        let mut fragment = plant.fragment(middle..waiting.end);
        let rest = fragment.waiting();
        let (mine, theirs) = rayon::join(
            || self.grow_waiting(plant, waiting.start..middle, age, first),
            || self.grow_waiting(&mut fragment.plant, rest, age, second),
        );
        // The limit of a fragment is the room that the whole plant has left.
        let (mut living, others) = mine.and_then(|mine| Ok((mine, theirs?))).map_err(|_| limit.clone())?;
        let joint = plant.join(fragment);
        living.extend(others.into_iter().map(|bud| bud.joined(&joint)));
        if plant.is_overgrown() { Err(limit) } else { Ok(living) }
    }

    fn grow_in_turn(&self, plant: &mut Plant, waiting: Range<usize>, age: Tick) -> Result<Vec<ApicalBud>, Overgrown> {
        Words::lend(true, |words| {
            for begin in waiting.clone().step_by(READ_TOGETHER) {
                let axes = begin..waiting.end.min(begin + READ_TOGETHER);
                let buds: Vec<_> = axes.map(|axis| first_bud(self, plant, AxisId(axis as u32))).collect();
                words.read_ahead((self, plant), &buds, age, false);
                self.grow_all((plant, None), &buds, age, words)?;
            }
            self.make_last(plant, words)?;
            Ok(words.living.drain(..).collect())
        })
    }
}

/// Takes each living bud through `step`, and keeps the buds that are still alive.
fn keep(
    living: &mut Vec<ApicalBud>,
    mut step: impl FnMut(ApicalBud) -> Result<Option<ApicalBud>, Overgrown>,
) -> Result<(), Overgrown> {
    let mut kept = 0;
    for place in 0..living.len() {
        if let Some(bud) = step(living[place])? {
            living[kept] = bud;
            kept += 1;
        }
    }
    living.truncate(kept);
    Ok(())
}

/// The place in `waiting` that divides the work into halves, measured by the ticks to come; neither half is empty.
fn middle_of(births: &[Tick], waiting: Range<usize>, age: Tick) -> usize {
    let ticks = |axis: usize| BEGINNING + u64::from(age.saturating_sub(births[axis]));
    let half = waiting.clone().map(ticks).sum::<u64>() / 2;
    let mut before = 0;
    let middle = waiting.clone().find(|&axis| {
        before += ticks(axis);
        before > half
    });
    middle.unwrap_or(waiting.end).clamp(waiting.start + 1, waiting.end - 1)
}

impl Grow for BudModel {
    type Life = LivingBuds;

    fn growth(&self) -> Growth {
        Growth::Extends
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) -> LivingBuds {
        let laws = &self.laws(1).head;
        let words = laws.words(&plant.random, LineageKey::SEED);
        let new = NewAxis { insertion: laws.insertion.draw(&words, 0, At::default()), ..NewAxis::OF_THE_SEED };
        let axis = add_axis(self, plant, new);
        LivingBuds(vec![first_bud(self, plant, axis)])
    }

    fn grow_to(
        &self,
        age: Tick,
        plant: &mut Plant,
        LivingBuds(living): &mut LivingBuds,
        view: &View<'_>,
    ) -> Result<(), Overgrown> {
        if view.site.kills() {
            self.kill_reaching(plant, living, age, view.site)?;
        }
        let met = Some(view.site).filter(|site| site.blocks());
        self.grow_plant((plant, met), living, age)
    }

    fn answer_cuts(&self, age: Tick, plant: &mut Plant, LivingBuds(living): &mut LivingBuds) -> Result<(), Overgrown> {
        self.release_below_cuts(age, plant, living)
    }

    fn expectation(&self, until: Tick) -> Option<Expectation> {
        if self.asks_the_bud() || self.asks_height() || self.orders.iter().any(|laws| laws.laws_ask_light) {
            return None;
        }
        match until.min(self.until) {
            last if last == self.until => self.expected.get_or_init(|| self.expectation_from(1, last)).clone(),
            age => self.expectation_from(1, age),
        }
    }

    /// Diameter at birth plus the thickening of the internode's order at the plant's age and its own.
    fn sees_height(&self) -> bool {
        self.asks_height()
    }

    fn sees_light(&self) -> bool {
        self.asks_light()
    }

    fn thicken(&self, age: Tick, plant: &mut Plant) {
        let added = self.thickening_at(age);
        let Plant { axes, nodes, appeared, .. } = plant;
        for stretch in appeared.by(age, nodes) {
            let axis = stretch.axis.index();
            let added = &added[(usize::from(axes.order[axis]) - 1) * self.states + usize::from(axes.state[axis])];
            for node in stretch.nodes() {
                nodes.diameter[node] = nodes.primary_diameter[node] + added[(age - nodes.birth[node]) as usize];
            }
        }
        taper(plant, age);
    }
}
