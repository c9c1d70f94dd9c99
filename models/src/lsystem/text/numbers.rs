//! The numbers and the births of components, by the keys of their modules, from one age to the next.
//!
//! A component is numbered when it appears, in the order of the string; the internode that bears what stands at the
//! base is numbered before that. A component that has gone loses its key: what comes back is new. So every number is
//! alive for one unbroken span of ages. Modules mostly keep their order from step to step, so what stood before is
//! found beside what was found last. Absent: the columns.

use super::draft::{BASE, Draft, Item, Placed};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::key::LineageKey;
use phytomer_sim::plant::{ApexFate, Plant};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// The number and the birth of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Born {
    pub number: u32,
    pub at: Tick,
}

impl Born {
    /// The trunk, by its bud.
    pub const TRUNK: Self = Self { number: 0, at: 0 };
}

/// What is known of the bud of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bud {
    /// The key of the module of its last apex; `None` where it never had one.
    pub apex: Option<LineageKey>,
    /// When and how the last apex ended.
    pub end: (Tick, ApexFate),
}

impl Bud {
    /// A bud that lives.
    pub const ALIVE: Self = Self { apex: None, end: (NEVER, ApexFate::Alive) };
}

/// The numbers of the components that stand, and the modules of all that ever stood.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Numbers {
    /// What stands but the trunk, with its keys, in the order in which it was looked at.
    standing: Vec<(LineageKey, Born)>,
    /// The bud of each axis, in the order of the numbers.
    buds: Vec<Bud>,
    /// By their numbers: the keys of the modules of the string that they are or that are drawn as them.
    modules: Vec<LineageKey>,
    /// By the numbers of buds: their places among the buds. Of no meaning for other components.
    places: Vec<u32>,
}

/// The numbers of the components of a draft, in its order.
#[derive(Debug, Clone, Default)]
pub(super) struct Numbered {
    pub axes: Vec<Born>,
    pub nodes: Vec<Born>,
    pub organs: Vec<Born>,
    /// By numbers, whether the component stands.
    pub stands: Vec<bool>,
    before: Before,
}

/// What stood at the age before.
#[derive(Debug, Clone, Default)]
struct Before {
    standing: Vec<(LineageKey, Born)>,
    /// Behind what was found last.
    next: usize,
    /// The places of all by their keys, once the order has told nothing of a key. Looked up alone, never gone through.
    places: HashMap<u64, u32, BuildHasherDefault<OwnHash>>,
}

/// Among how many that come next in the order a component is sought before it is sought among all.
const AHEAD: usize = 8;

impl Before {
    /// Takes over what stood, and leaves an empty list.
    fn begin(&mut self, standing: &mut Vec<(LineageKey, Born)>) {
        std::mem::swap(&mut self.standing, standing);
        standing.clear();
        self.next = 0;
        self.places.clear();
    }

    /// The number and the birth of the component with a key, if it stood.
    #[inline]
    fn find(&mut self, key: LineageKey) -> Option<Born> {
        let ahead = self.standing.get(self.next..).unwrap_or_default();
        let place = match ahead.iter().take(AHEAD).position(|(known, _)| *known == key) {
            Some(nth) => self.next + nth,
            None => self.find_among_all(key)?,
        };
        self.next = place + 1;
        Some(self.standing[place].1)
    }

    #[cold]
    fn find_among_all(&mut self, key: LineageKey) -> Option<usize> {
        if self.places.is_empty() {
            self.places.extend((0_u32..).zip(&self.standing).map(|(place, (key, _))| (key.0, place)));
        }
        self.places.get(&key.0).map(|place| *place as usize)
    }
}

impl Numbers {
    /// Forgets all and keeps the memory.
    pub fn clear(&mut self) {
        self.standing.clear();
        self.buds.clear();
        self.modules.clear();
        self.places.clear();
    }

    /// Gives each component of a draft its number; those that are new appear at `age` in `plant`.
    pub fn number(&mut self, draft: &Draft, age: Tick, plant: &mut Plant, numbered: &mut Numbered) {
        let none = Born { number: u32::MAX, at: age };
        for (list, len) in [
            (&mut numbered.axes, draft.axes.len()),
            (&mut numbered.nodes, draft.nodes.len()),
            (&mut numbered.organs, draft.organs.len()),
        ] {
            list.clear();
            list.resize(len, none);
        }
        if self.modules.is_empty() {
            plant.next_number_on(None);
            self.modules.push(LineageKey::SEED);
            self.places.push(0);
            self.buds.push(Bud::ALIVE);
        }
        numbered.axes[0] = Born::TRUNK;
        numbered.before.begin(&mut self.standing);
        self.standing.reserve(draft.order.len() + 1);
        let base = draft.first.filter(|_| draft.has_base).map(Item::Node);
        if let Some(item) = base {
            let placed = draft.order.iter().find(|placed| placed.item == item).copied();
            let foot = Placed { item, is_new: false };
            self.number_item(placed.unwrap_or(foot), draft, age, plant, numbered);
        }
        for &placed in draft.order.iter().filter(|placed| Some(placed.item) != base) {
            self.number_item(placed, draft, age, plant, numbered);
        }
        numbered.stands.clear();
        numbered.stands.resize(self.modules.len(), false);
        for born in numbered.axes.iter().chain(&numbered.nodes).chain(&numbered.organs) {
            numbered.stands[born.number as usize] = true;
        }
    }

    #[inline]
    fn number_item(&mut self, placed: Placed, draft: &Draft, age: Tick, plant: &mut Plant, numbered: &mut Numbered) {
        let Placed { item, is_new } = placed;
        let (key, module, on) = match item {
            Item::Axis(place) => (draft.axes[place].key, draft.axes[place].module, draft.axes[place].on),
            Item::Node(place) => (draft.nodes[place].key, draft.nodes[place].module, draft.nodes[place].below),
            Item::Organ(place) => (draft.organs[place].key, draft.organs[place].module, draft.organs[place].on),
        };
        let stood = if is_new { None } else { numbered.before.find(key) };
        let born = match stood {
            Some(born) => born,
            None => {
                let first = draft.first.filter(|first| item != Item::Node(*first));
                let on = if on == BASE { first } else { Some(on as usize) };
                let number = plant.next_number_on(on.map(|node| numbered.nodes[node].number));
                self.modules.push(module);
                self.places.push(self.buds.len() as u32);
                if let Item::Axis(_) = item {
                    self.buds.push(Bud::ALIVE);
                }
                Born { number, at: age }
            }
        };
        self.standing.push((key, born));
        match item {
            Item::Axis(place) => numbered.axes[place] = born,
            Item::Node(place) => numbered.nodes[place] = born,
            Item::Organ(place) => numbered.organs[place] = born,
        }
    }

    /// The key of the module of a component, by its number.
    pub fn module(&self, number: u32) -> LineageKey {
        self.modules[number as usize]
    }

    /// The bud of an axis by its number.
    pub fn bud(&mut self, number: u32) -> &mut Bud {
        &mut self.buds[self.places[number as usize] as usize]
    }
}

/// The hash of a key is the key: it is a hash already.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct OwnHash(u64);

impl Hasher for OwnHash {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = self.0.rotate_left(8) ^ u64::from(byte);
        }
    }

    fn write_u64(&mut self, key: u64) {
        self.0 = key;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In the order in which it stood, with few and with many gone between, backwards, and never what did not stand.
    #[test]
    fn what_stood_is_found_in_any_order() {
        let key = |place: u32| LineageKey::SEED.child(u64::from(place));
        let stood = |place: u32| (key(place), Born { number: 3 * place, at: place });
        let mut before = Before::default();
        let mut places = |asked: &[u32]| {
            let mut standing: Vec<_> = (0..100).map(stood).collect();
            before.begin(&mut standing);
            assert_eq!(standing, []);
            asked.iter().map(|place| before.find(key(*place))).collect::<Vec<_>>()
        };
        let in_order: Vec<u32> = (0..100).collect();
        let backwards: Vec<u32> = (0..100).rev().collect();
        for asked in [in_order, backwards, vec![5, 6, 40, 41, 2, 99, 0, 98]] {
            assert_eq!(places(&asked), asked.iter().map(|place| Some(stood(*place).1)).collect::<Vec<_>>());
        }
        let [gone, last] = [100, 99].map(|place| (place < 100).then(|| stood(place).1));
        assert_eq!(places(&[100, 99, 100]), [gone, last, gone]);
    }
}
