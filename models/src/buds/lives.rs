//! The ends of leaves, and flowers with the fruits that they set: the formulas of one organ.
//!
//! Nodes that are made one by one (`organ`) and nodes that are made at once (`columns`) share them.

use super::compile::{NodeLaws, Number, OrganLaws};
use crate::law::At;
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{Cause, NewOrgan, NodeId};

/// The position of a terminal flower, which is no lateral's.
pub(super) const TERMINAL: u16 = u16::MAX;

/// Where a flower opens, and when.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowerSite {
    pub node: NodeId,
    /// Its place among the flowers in its node's record, from 0.
    pub nth: u32,
    pub birth: Tick,
    pub azimuth: f32,
    pub position: u16,
}

/// A flower, and the fruit that it sets.
pub(super) struct Bloom {
    pub flower: NewOrgan,
    pub fruit: Option<NewOrgan>,
}

/// What a flower or a fruit draws: its life, its length and its width.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawn {
    pub life: u32,
    pub length: f32,
    pub width: f32,
}

/// The tick at which a flower falls if nothing eats it.
#[inline]
pub(super) fn flower_fall(laws: &NodeLaws, words: &[u32], site: FlowerSite, at: At) -> Tick {
    after(site.birth, laws.flower_life.draw(words, site.nth, at))
}

/// The end of a life, which lasts a tick at least.
#[inline]
fn after(birth: Tick, life: u32) -> Tick {
    birth.saturating_add(life.max(1))
}

impl Bloom {
    /// A flower and its fruit, with the ticks at which pests eat them. A terminal flower stands in the direction of its
    /// axis, and its laws are evaluated at the rank of the node that bears it.
    #[inline]
    pub fn of(laws: &NodeLaws, words: &[u32], site: FlowerSite, eaten: [Tick; 2], at: At) -> Self {
        let nth = site.nth;
        let sets = laws.fruit_set.happens(words, nth, at);
        let insertion = if site.position == TERMINAL { 0.0 } else { laws.flower.insertion.draw(words, nth, at) };
        let draw = |organ: &OrganLaws, life: &Number| Drawn {
            life: life.draw(words, nth, at),
            length: organ.length.draw(words, nth, at),
            width: organ.width.draw(words, nth, at),
        };
        let fruit = || draw(&laws.fruit, &laws.fruit_life);
        Self::drawn(laws, (site, insertion), (draw(&laws.flower, &laws.flower_life), sets), fruit, eaten)
    }

    /// A flower that was drawn, with the fruit that it `sets`, of the insertion angle of its flower. A flower that is
    /// eaten sets no fruit.
    #[inline(always)]
    pub fn drawn(
        laws: &NodeLaws,
        (site, insertion): (FlowerSite, f32),
        (flower, sets): (Drawn, bool),
        fruit: impl FnOnce() -> Drawn,
        eaten: [Tick; 2],
    ) -> Self {
        let FlowerSite { node, birth, azimuth, position, .. } = site;
        let organ = |of: &OrganLaws, birth, (death, cause), Drawn { length, width, .. }| NewOrgan {
            node,
            kind: of.kind,
            position,
            birth,
            death,
            cause,
            form: of.form,
            length,
            width,
            area: 0.0,
            azimuth,
            insertion,
        };
        let fall = after(birth, flower.life);
        let own = if sets { Cause::FruitSet } else { Cause::LifeLength };
        let end = first_end((fall, own), eaten[0]);
        let fruit = (end.1 == Cause::FruitSet).then(|| {
            let drawn = fruit();
            let ripe = (after(fall, drawn.life), Cause::LifeLength);
            organ(&laws.fruit, fall, first_end(ripe, eaten[1]), drawn)
        });
        Self { flower: organ(&laws.flower, birth, end, flower), fruit }
    }

    /// Those of its organs that appear by the last age of the run. An organ that would appear later is left out: it
    /// takes neither memory nor room under the plant's limit.
    #[inline]
    pub fn by(&self, last: Tick) -> impl Iterator<Item = NewOrgan> {
        [Some(self.flower), self.fruit].into_iter().flatten().filter(move |organ| organ.birth <= last)
    }

    /// The tick at which the last of its organs falls.
    pub fn end(&self) -> Tick {
        self.fruit.map_or(self.flower.death, |fruit| fruit.death)
    }
}

/// The tick at which a leaf of a birth falls by the date.
#[inline]
pub(super) fn fall_when(falls: &[Tick], birth: Tick) -> Tick {
    falls.get(birth as usize).copied().unwrap_or(NEVER)
}

/// The first tick after a birth that is the tick `fall` of a year of `year` ticks.
#[inline]
pub(super) fn fall_of_year(year: u32, fall: u32, birth: Tick) -> Tick {
    let (year, fall) = (u64::from(year), u64::from(fall));
    let wait = (fall + year - u64::from(birth) % year) % year;
    let wait = if wait == 0 { year } else { wait };
    u32::try_from(u64::from(birth) + wait).unwrap_or(NEVER)
}

/// The tick at which a leaf falls and why, by its life length or by the season, which makes it fall at `seasonal`.
#[inline]
pub(super) fn leaf_fall(seasonal: Tick, birth: Tick, life: Option<u32>) -> (Tick, Cause) {
    let aged = life.map_or(NEVER, |life| birth.saturating_add(life.max(1)));
    match (aged.min(seasonal), aged <= seasonal) {
        (NEVER, _) => (NEVER, Cause::None),
        (tick, true) => (tick, Cause::LifeLength),
        (tick, false) => (tick, Cause::Season),
    }
}

/// The end of an organ, whichever comes first: its own, or that by a pest.
#[inline]
pub(super) fn first_end(own: (Tick, Cause), eaten: Tick) -> (Tick, Cause) {
    if eaten < own.0 { (eaten, Cause::Attacked) } else { own }
}
