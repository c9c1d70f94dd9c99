//! A plot: the plants that share a site; the unit of parallel work, of resuming and of distribution.
//!
//! A plot has a tick of its own, and each member an age: the ticks since it was sown. So later sowing, gaps and
//! replanting are data, not special cases: a successor is a member from the start, which is sown when its place is
//! free. Where nothing is shared a plot is one plant. Growth and standing of all members stand in `sim::grow`.

use crate::clock::{NEVER, Tick};
use crate::management::Management;
use crate::mechanics::Wood;
use crate::model::{GrowthModel, Life};
use crate::plant::{Plant, Seed};
use crate::site::Site;

/// What one member of a plot is sown from.
#[derive(Debug, Clone)]
pub struct Sowing {
    /// The species, as a place in the plot's list of species.
    pub species: usize,
    /// The plant's number, its draws and its limit.
    pub seed: Seed,
    /// Where the seed lies, metres.
    pub place: [f64; 3],
    /// The tick of the plot at which it is sown: the plant has age 0 then, and its first clock signal one tick later.
    /// [`NEVER`] for a seed that does not germinate.
    pub sown: Tick,
}

/// The plants of one site. Columns: one entry a member in `plants`, `lives` and `members`.
#[derive(Clone)]
pub struct Plot<'m> {
    /// The plot's number in the run, from 0.
    pub id: u32,
    /// The treatment that it is given, as a place in the run's list of treatments.
    pub treatment: u32,
    /// The replicate of its treatment, from 0; 0 where a run compares no treatments.
    pub replicate: u32,
    /// The block of the field that it stands in; `None` where the field has no blocks.
    pub block: Option<u32>,
    /// Its number within its treatment and replicate, from 0, by which its own draws are keyed.
    pub number: u32,
    /// Its species.
    pub species: Vec<&'m dyn GrowthModel>,
    /// Its plants, in the order of their sowings in the list.
    pub plants: Vec<Plant>,
    /// What the model of each plant remembers of it.
    pub lives: Vec<Life>,
    /// What each plant is in this plot.
    pub members: Vec<Member>,
    /// What they stand on.
    pub site: Site,
    /// What people do to them; stated by [`Plot::manage`].
    pub management: Management,
}

/// What a plant is in its plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Member {
    /// Its species, as a place in the plot's list.
    pub species: usize,
    /// The tick of the plot at which it was sown.
    pub sown: Tick,
}

impl Member {
    /// The plant's age at a tick of the plot; `None` before it is sown.
    pub fn age_at(&self, tick: Tick) -> Option<Tick> {
        tick.checked_sub(self.sown)
    }
}

impl<'m> Plot<'m> {
    /// A plot on open ground, of the first treatment and its first replicate.
    ///
    /// # Panics
    /// Where a sowing names a species that is not in the list.
    pub fn new(id: u32, species: Vec<&'m dyn GrowthModel>, sowings: &[Sowing]) -> Self {
        let (plants, lives) = sowings.iter().map(|sowing| sown(species[sowing.species], sowing)).unzip();
        let members = sowings.iter().map(|sowing| Member { species: sowing.species, sown: sowing.sown }).collect();
        Self {
            id,
            treatment: 0,
            replicate: 0,
            block: None,
            number: id,
            species,
            plants,
            lives,
            members,
            site: Site::default(),
            management: Management::default(),
        }
    }

    /// States what people do to the plants, before their first tick.
    pub fn manage(&mut self, management: Management) {
        self.plants.iter_mut().for_each(|plant| plant.dormant.keep(management.cuts()));
        self.management = management;
    }

    /// A plot of one plant at the origin, sown at tick 0 by `model`.
    pub fn of_one(model: &'m dyn GrowthModel, seed: &Seed) -> Self {
        Self::new(seed.plant, vec![model], &[Sowing { species: 0, seed: seed.clone(), place: [0.0; 3], sown: 0 }])
    }

    /// Sows a plot of one plant anew from another seed, keeping the memory of its columns.
    pub fn resow(&mut self, seed: &Seed) {
        self.id = seed.plant;
        self.plants.iter_mut().for_each(|plant| plant.resow(seed));
        self.sow();
    }

    /// Sows the plot anew as another one whose members are of the same species, keeping the memory of its columns: a
    /// sowing for each member, in their order.
    pub fn sow_again(&mut self, id: u32, sowings: &[Sowing]) {
        self.id = id;
        for ((plant, member), sowing) in self.plants.iter_mut().zip(&mut self.members).zip(sowings) {
            plant.resow(&sowing.seed);
            plant.place = sowing.place;
            member.sown = sowing.sown;
        }
        self.sow();
    }

    /// Takes every plant back to its seed.
    pub fn restart(&mut self) {
        self.plants.iter_mut().for_each(Plant::clear);
        self.sow();
    }

    fn sow(&mut self) {
        let Self { species, plants, lives, members, site, management, .. } = self;
        site.restart();
        management.restart();
        for successor in &**management.successors() {
            if let Some(member) = members.get_mut(successor.member) {
                member.sown = NEVER;
            }
        }
        for ((plant, life), member) in plants.iter_mut().zip(lives).zip(members) {
            species[member.species].sow_again(plant, life);
        }
    }

    /// Whether the shape of its plants at an age depends on those at the ages before, so that each must be gone
    /// through.
    pub fn remembers(&self) -> bool {
        self.plants.iter().any(|plant| plant.habit.wood.as_ref().is_some_and(Wood::remembers))
    }
}

fn sown(model: &dyn GrowthModel, sowing: &Sowing) -> (Plant, Life) {
    let mut plant = Plant::new(&sowing.seed, model.habit());
    plant.place = sowing.place;
    let life = model.sow(&mut plant);
    (plant, life)
}
