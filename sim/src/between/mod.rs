//! A plant between two ticks: what stood at either, on its way from the one to the other.
//!
//! An age has a fraction f. In a plant that a model extends, node k of the n nodes by which an axis grows in a tick has
//! the share clamp(n f − k + 1, 0, 1) of its length (`shares`); curvature goes linearly from tick to tick, and the
//! plant is posed with it (`bending`). In a plant that is made anew or rewritten each component goes from its place on
//! its bearer at the one tick to that at the other, by slerp, and carries along what it bears (`carried`); what appears
//! grows from its base. In either, lengths of what stands at both ticks, diameters and sizes of organs go linearly, and
//! what falls in a tick goes at its end. At f = 0 and f = 1 a plant is the plant of the tick itself, which no pose
//! between can replace: [`Passage`] shows it. Absent: colours, which are those of drawing, and tables, which have whole
//! ticks.

mod bending;
mod carried;
mod moment;
mod passage;
mod shares;

pub use moment::Moment;
pub use passage::Passage;

use crate::clock::Tick;
use crate::mechanics::Scratch;
use crate::model::Growth;
use crate::plant::{Cause, Former, OrganId, Partway, Plant};
use carried::Carried;
use shares::Shares;
use std::sync::Arc;

/// The part of a tick by the end of which the last organ comes loose, where organs drop; the rest is its way down.
const LOOSE: f32 = 0.5;

/// The way of a plant from one tick to the next.
#[derive(Debug)]
pub struct Between {
    /// The plant as it is shown.
    plant: Plant,
    age: Tick,
    shares: Shares,
    /// The places on bearers, where the plant is not posed by its model's rules.
    carried: Option<Carried>,
    former: Arc<Former>,
    falls: bool,
    scratch: Scratch,
}

impl Between {
    /// The way of a plant from `before` to `after`, both posed, of which the later has the age `age`, at least 1. With
    /// `falls`, leaves, petals and fruits that fall within the tick drop to the ground first.
    pub fn new(before: &Plant, after: &Plant, age: Tick, growth: Growth, falls: bool) -> Self {
        let mut plant = after.clone();
        let extended = growth == Growth::Extends;
        let rules = extended && !after.stated.differ(age - 1, age);
        let lasting = plant.put_back(before, age);
        plant.partway = Some(Box::default());
        let mut shares = Shares::of(&plant, &lasting, age, extended);
        shares.remember(&plant, &lasting, (before, after), age);
        let former = Arc::new(lasting.former_looks(&plant, before));
        let carried = (!rules).then(|| Carried::of(&plant, &lasting, (before, after), age));
        Self { plant, age, shares, carried, former, falls, scratch: Scratch::default() }
    }

    /// The plant when the share `share` of the tick has passed, between 0 and 1. Passes that ask for an age are to be
    /// given that of the later tick. Linear in the components.
    pub fn at(&mut self, share: f32) -> &Plant {
        let Self { plant, age, shares, carried, former, falls, scratch } = self;
        let sizes = shares.sizes(share);
        let drops = if *falls { drops(plant, *age, share) } else { Vec::new() };
        let organs = carried.as_ref().map(|carried| carried.organs(share)).unwrap_or_default();
        plant.partway = Some(Box::new(Partway { share, sizes, drops, organs, former: Arc::clone(former) }));
        shares.lengthen(plant, share);
        shares.thicken(plant, share);
        match carried {
            Some(carried) => carried.pose(plant, share),
            None => bending::pose(plant, *age, shares, share, scratch),
        }
        plant
    }
}

/// How far each organ has dropped: it comes loose at a moment of its own and falls freely, with the square of the time.
fn drops(plant: &Plant, age: Tick, share: f32) -> Vec<f32> {
    let drop = |organ: u32| {
        let (organs, place) = (&plant.organs, organ as usize);
        let natural =
            matches!(organs.cause[place], Cause::LifeLength | Cause::Season | Cause::Branch | Cause::FruitSet);
        if organs.death[place] != age || !natural || !plant.organ_stands(OrganId(organ), age) {
            return 0.0;
        }
        // Two bytes of a multiplicative hash (Knuth), of another factor than the one that scatters organs (`pose`).
        let hash = (organs.component[place].wrapping_mul(2_246_822_519) >> 16) as f32 / 65_536.0;
        let time = ((share - LOOSE * hash) / (1.0 - LOOSE)).clamp(0.0, 1.0);
        time * time
    };
    (0..plant.organs.len() as u32).map(drop).collect()
}

#[cfg(test)]
mod tests;
