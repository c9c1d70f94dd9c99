//! The places of children along a stem, and which of its clones bears each (Weber & Penn 1995 §4.2, §4.3).
//!
//! A stem bears its n children at k/(n + 1) of its length, k = 1 … n, without jitter, or all of them at its end where
//! they stand in a fan. The paper has a cloned stem "reduce its propensity to form clones by half", which contradicts
//! its own counts of clones; it is read of children here: above a split the children that are planned are dealt in turn
//! to the stems that go on, so that a split changes no number of children. Absent: numbers of children (`equations`).

use super::generation::Stem;

/// The child of a stem with its clones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Its number among all children of the family, from 0; those that the bare part of the trunk lacks are counted.
    pub number: u32,
    /// offset_child over length_parent.
    pub share: f64,
    /// The segment on which it stands, from 0 at the base of the first stem, and where on it, from 0 to 1.
    pub segment: u32,
    pub within: f64,
}

/// How children are planned.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    pub number: u32,
    /// In a fan at the end of the stem.
    pub fan: bool,
    /// The share of the stem that is bare, and whether all children stand above it.
    pub bare: f64,
    pub above: bool,
    pub curve_res: u32,
}

/// The children of each stem of a family; made anew for each family in the same memory.
#[derive(Debug, Default)]
pub(super) struct Dealt {
    lists: Vec<Vec<Place>>,
}

/// A share may fall short of the bare part by this.
const ROUNDING: f64 = 1e-9;

impl Plan {
    /// The place of child `number`; `None` in the bare part.
    pub fn place(&self, number: u32) -> Option<Place> {
        let even = f64::from(number + 1) / (f64::from(self.number) + 1.0);
        let share = match (self.fan, self.above) {
            (true, _) => 1.0,
            (_, true) => self.bare + even * (1.0 - self.bare),
            _ => even,
        };
        let along = share * f64::from(self.curve_res);
        let segment = (along as u32).min(self.curve_res - 1);
        let place = Place { number, share, segment, within: along - f64::from(segment) };
        (self.bare == 0.0 || share > self.bare + ROUNDING).then_some(place)
    }
}

impl Dealt {
    /// Deals the planned children to the stems of a family.
    pub fn deal(&mut self, plan: &Plan, stems: &[Stem]) {
        self.lists.iter_mut().for_each(Vec::clear);
        self.lists.resize_with(self.lists.len().max(stems.len()), Vec::new);
        self.lists[0].extend((0..plan.number).filter_map(|number| plan.place(number)));
        let mut first = 1;
        while first < stems.len() {
            let Stem { twin, before, .. } = stems[first];
            let alike = |stem: &&Stem| (stem.twin, stem.before) == (twin, before);
            let clones = stems[first..].iter().take_while(alike).count();
            let at = self.lists[twin as usize].partition_point(|place| place.segment < before);
            let above = self.lists[twin as usize].split_off(at);
            for (turn, place) in above.into_iter().enumerate() {
                let stem = match turn % (clones + 1) {
                    0 => twin as usize,
                    clone => first + clone - 1,
                };
                self.lists[stem].push(place);
            }
            first += clones;
        }
    }

    /// The children of a stem of the family, from its base to its tip.
    pub fn on(&self, stem: usize) -> &[Place] {
        &self.lists[stem]
    }
}
