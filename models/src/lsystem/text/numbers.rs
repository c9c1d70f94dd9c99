//! The numbers and the births of components, by the keys of their modules, from one age to the next.
//!
//! A component is numbered when it appears, in the order of the string; the internode that bears what stands at the
//! base is numbered before that. A component that has gone loses its key: what comes back is new. So every number is
//! alive for one unbroken span of ages. Absent: the columns.

use super::draft::{BASE, Draft, Item};
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
    /// The key of its last apex; `None` where it never had one.
    pub apex: Option<LineageKey>,
    /// When and how the last apex ended.
    pub end: (Tick, ApexFate),
}

/// The numbers of the components that stand, and the keys of all that ever stood.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Numbers {
    /// Looked up alone, never gone through.
    by_key: HashMap<u64, Born, BuildHasherDefault<OwnHash>>,
    /// The bud of each axis, by the number of the bud; in the order of the numbers.
    buds: Vec<(u32, Bud)>,
    /// By their numbers.
    keys: Vec<LineageKey>,
}

/// The numbers of the components of a draft, in its order.
#[derive(Debug, Clone, Default)]
pub(super) struct Numbered {
    pub axes: Vec<Born>,
    pub nodes: Vec<Born>,
    pub organs: Vec<Born>,
    /// By numbers, whether the component stands.
    pub stands: Vec<bool>,
}

impl Numbers {
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
        if self.keys.is_empty() {
            plant.next_number_on(None);
            self.keys.push(LineageKey::SEED);
            self.buds.push((0, Bud { apex: None, end: (NEVER, ApexFate::Alive) }));
        }
        numbered.axes[0] = Born::TRUNK;
        if let Some(first) = draft.first.filter(|_| draft.has_base) {
            self.number_item(Item::Node(first), draft, age, plant, numbered);
        }
        for &item in &draft.order {
            self.number_item(item, draft, age, plant, numbered);
        }
        numbered.stands.clear();
        numbered.stands.resize(self.keys.len(), false);
        for born in numbered.axes.iter().chain(&numbered.nodes).chain(&numbered.organs) {
            numbered.stands[born.number as usize] = true;
        }
    }

    fn number_item(&mut self, item: Item, draft: &Draft, age: Tick, plant: &mut Plant, numbered: &mut Numbered) {
        let (key, on) = match item {
            Item::Axis(place) => (draft.axes[place].key, draft.axes[place].on),
            Item::Node(place) => (draft.nodes[place].key, draft.nodes[place].below),
            Item::Organ(place) => (draft.organs[place].key, draft.organs[place].on),
        };
        let born = match self.by_key.get(&key.0) {
            Some(born) => *born,
            None => {
                let first = draft.first.filter(|first| item != Item::Node(*first));
                let on = if on == BASE { first } else { Some(on as usize) };
                let number = plant.next_number_on(on.map(|node| numbered.nodes[node].number));
                let born = Born { number, at: age };
                self.by_key.insert(key.0, born);
                self.keys.push(key);
                if let Item::Axis(_) = item {
                    self.buds.push((number, Bud { apex: None, end: (NEVER, ApexFate::Alive) }));
                }
                born
            }
        };
        match item {
            Item::Axis(place) => numbered.axes[place] = born,
            Item::Node(place) => numbered.nodes[place] = born,
            Item::Organ(place) => numbered.organs[place] = born,
        }
    }

    /// Forgets a component that has gone, so that what comes back is new; its key.
    pub fn forget(&mut self, number: u32) -> LineageKey {
        let key = self.key(number);
        self.by_key.remove(&key.0);
        key
    }

    /// The key of the module that a component is, standing or gone.
    pub fn key(&self, number: u32) -> LineageKey {
        self.keys[number as usize]
    }

    /// The bud of an axis by its number.
    pub fn bud(&mut self, number: u32) -> &mut Bud {
        let place = self.buds.partition_point(|(known, _)| *known < number);
        &mut self.buds[place].1
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
