//! Fewer organs that stand for all: a share of them, chosen by their lineage keys, each so much larger that their area
//! is kept.
//!
//! An organ is kept where the number of its lineage key is below the share, so that a smaller share keeps some of those
//! that a larger one keeps, at every age. With the area A of all organs of a class and the area K of those that are
//! kept, each of these is drawn with k = A / K times its own area, in length, width and depth √k times its size: the
//! sum of the areas stays A. k is at most [`MOST_LARGER`], beyond which leaves look like balloons; then area is lost.
//! Organs without an area count alike. Absent: which share a level of detail has (`phytomer_pictures::levels`).

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{Class, OrganId, Plant};

/// The most times its own area that an organ is drawn with: √2 times its length.
pub const MOST_LARGER: f64 = 2.0;

/// The classes of organs, each of which keeps its area.
pub const CLASSES: [Class; 3] = [Class::Leaf, Class::Flower, Class::Fruit];

/// A share of the organs of a plant, and how much larger they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thinned {
    /// The share of the organs that is kept, about: an organ is kept where the number of its key is below it.
    pub share: f64,
    /// How many times its own area an organ has, for leaves, flowers and fruits.
    pub larger: [f64; CLASSES.len()],
}

impl Thinned {
    /// The organs of `plant` at `age` of which about `share` are kept; `None` where all are.
    pub fn of(plant: &Plant, age: Tick, share: f64) -> Option<Self> {
        if share >= 1.0 {
            return None;
        }
        let mut sums = ClassSums::default();
        for organ in (0..plant.organs.len()).map(|organ| OrganId(organ as u32)) {
            if plant.organ_stands(organ, age) {
                let Some(class) = organ_class(plant, organ) else { continue };
                sums.add(class, plant.organ_area(organ, age), organ_number(plant, organ) < share);
            }
        }
        sums.thinned(share)
    }

    /// What a file says of them.
    pub fn in_words(&self) -> String {
        let [leaves, flowers, fruits] = self.larger;
        format!(
            "thinned {:.4}: of the organs that share stands for all, leaves with {leaves:.4} times their area_m2, flowers \
             {flowers:.4}, fruits {fruits:.4}",
            self.share
        )
    }

    /// Whether an organ is one of those that become fewer.
    #[inline]
    pub fn concerns(plant: &Plant, organ: OrganId) -> bool {
        organ_class(plant, organ).is_some()
    }

    /// Whether an organ is kept.
    #[inline]
    pub fn keeps(&self, plant: &Plant, organ: OrganId) -> bool {
        !Self::concerns(plant, organ) || organ_number(plant, organ) < self.share
    }

    /// The factor of its sizes.
    #[inline]
    pub fn factor(&self, plant: &Plant, organ: OrganId) -> f32 {
        organ_class(plant, organ).map_or(1.0, |class| self.larger[class].sqrt() as f32)
    }
}

/// The areas and the numbers of the organs of each class: of all, and of those that are kept.
#[derive(Debug, Clone, Copy, Default)]
pub struct ClassSums {
    areas: [[f64; 2]; CLASSES.len()],
    counts: [[u64; 2]; CLASSES.len()],
}

impl ClassSums {
    /// Adds an organ of a class (of leaves, flowers and fruits, from 0) and of an area, m², which is kept or not.
    #[inline]
    pub fn add(&mut self, class: usize, area: f64, kept: bool) {
        // The sum of those that are kept is a part of the sum of all.
        for k in 0..=usize::from(kept) {
            self.areas[class][k] += area;
            self.counts[class][k] += 1;
        }
    }

    /// The organs of which about `share` are kept; `None` where all are.
    pub fn thinned(&self, share: f64) -> Option<Thinned> {
        let larger = std::array::from_fn(|class| match (self.areas[class], self.counts[class]) {
            ([all, kept], _) if kept > 0.0 => all / kept,
            (_, [all, kept]) if kept > 0 => all as f64 / kept as f64,
            _ => 1.0,
        });
        (share < 1.0).then(|| Thinned { share, larger: larger.map(|k: f64| k.clamp(1.0, MOST_LARGER)) })
    }
}

/// The class of an organ (of leaves, flowers and fruits, from 0); `None` for an organ of a kind that never becomes
/// fewer.
#[inline]
pub fn organ_class(plant: &Plant, organ: OrganId) -> Option<usize> {
    let class = plant.organs.kind[organ.index()].class();
    CLASSES.iter().position(|of| *of == class)
}

/// The number of an organ, from 0 to 1, by which it is kept or not: of the lower bits of its lineage key, since the
/// upper ones are the phase that shaders read, and the organs that are kept should sway in all phases.
#[inline]
pub fn organ_number(plant: &Plant, organ: OrganId) -> f64 {
    f64::from(plant.organ_key(organ).0 as u32) / 4_294_967_296.0
}
