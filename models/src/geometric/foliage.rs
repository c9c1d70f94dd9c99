//! The leaves of a tree from their keys, and how they look (Aono & Kunii 1984, Fig. 20 and `leaf` of the appendix).
//!
//! The leaves of the tree itself have the look of the species' leaves; those of trees on its root have looks of their
//! own. Absent: where a leaf stands (`tree`).

use super::parts::TreeLeaf;
use super::plan::Leaves;
use crate::buds::params::LeafChoice;
use crate::fault::{Fault, Path};
use crate::law::{Constant, Quantity, ValueRange};
use phytomer_looks::Paints;
use phytomer_sim::plant::{Habit, Looks, OrganLook, OrganLooks, Shape, Trend};

const CENTIMETRES: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 10_000.0, what: "centimetres" };
const INSERTION: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };
/// The most leaves at a tip.
const MOST_LEAVES: u32 = 100;

/// The looks of a species in the making.
pub(super) struct Wardrobe {
    looks: Looks,
    paints: Paints,
    is_leafy: bool,
}

impl Wardrobe {
    pub fn new() -> Self {
        Self { looks: Looks::of_shape(Shape::Cylinder), paints: Paints::default(), is_leafy: false }
    }

    /// What the plants of the species carry.
    pub fn habit(self) -> Habit {
        let for_drawing = if self.is_leafy { self.paints.into_habit() } else { Habit::default().for_drawing };
        Habit { trends: vec![Trend::STRAIGHT], looks: self.looks, for_drawing, ..Habit::default() }
    }

    /// The leaves that stand at `path`, of a tree of `levels` growth levels at `place` on its root.
    pub fn leaves(
        &mut self,
        stated: &TreeLeaf,
        (levels, place): (u32, usize),
        path: &Path,
        faults: &mut Vec<Fault>,
    ) -> Option<Leaves> {
        let mut read = |number: &Constant, key: &str, range: ValueRange| {
            number.within(&path.key(key), range).map_err(|fault| faults.push(fault)).ok()
        };
        let long = read(&stated.length_cm, "length_cm", CENTIMETRES);
        let wide = read(&stated.width_cm, "width_cm", CENTIMETRES);
        let insertion = read(&stated.insertion_deg, "insertion_deg", INSERTION);
        let number = stated.number.value();
        if !(1..=MOST_LEAVES).contains(&number) {
            let expected = format!("a whole number in [1, {MOST_LEAVES}]");
            faults.push(Fault::new(&path.key("number"), format!("the number is {number}"), expected));
        }
        let level = |stated: &Option<Quantity>| stated.as_ref().map_or(levels, Quantity::value);
        let (from, to) = (level(&stated.from_level), level(&stated.to_level));
        if from > to || to > levels {
            let problem = format!("the branches of the growth levels {from} to {to} bear leaves");
            let expected = format!("from_level ≤ to_level ≤ {levels}, the last growth level");
            let key = if stated.to_level.is_some() { "to_level" } else { "from_level" };
            faults.push(Fault::new(&path.key(key), problem, expected));
        }
        if stated.life.as_ref().map(Quantity::value) == Some(0) {
            faults.push(Fault::new(&path.key("life"), "the life of a leaf is 0 ticks", "at least 1"));
        }
        let paint = LeafChoice::paint(stated.colour.as_ref(), 0, &path.key("colour"), faults);
        let size_m = [long? / 100.0, wide? / 100.0];
        let look = OrganLook { paint: self.paints.add_organ(paint), ..OrganLook::default() };
        self.is_leafy = true;
        let own = (place > 0).then_some(self.looks.organs_apart.len() as u16);
        match own {
            Some(_) => self.looks.organs_apart.push(look),
            None => self.looks.organs = vec![OrganLooks { leaf: look, ..OrganLooks::default() }],
        }
        Some(Leaves {
            levels: from..=to,
            number,
            form: stated.form.form(),
            size_m,
            area_m2: size_m[0] * size_m[1] * f64::from(stated.form.area_share()),
            insertion: insertion?.to_radians(),
            life: stated.life.as_ref().map(Quantity::value),
            look: own,
        })
    }
}
