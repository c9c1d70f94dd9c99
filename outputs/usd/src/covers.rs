//! What covers the parts of lives: the slots of their materials, and which lines and organs have which.
//!
//! A part has the order of the axis that it stands on, which its life tells. Absent: the pictures (`paint`), and the
//! coordinates on them.

use super::Plants;
use phytomer_life::{Life, Line, Part};
use phytomer_meshes::{MeshOptions, Slot, Slots, class_of_kind};
use std::collections::BTreeMap;

/// The slots of the materials of lives; plain where none states a texture.
pub fn slots_of(plants: &Plants) -> Slots {
    Slots::of_orders(plants.lives.iter().map(orders_of).zip(plants.options))
}

/// The order of each component of a life.
fn orders_of(life: &Life) -> Vec<u8> {
    let of_axis: BTreeMap<u32, u8> = life.lines.iter().map(|line| (line.axis, line.order)).collect();
    let of_points =
        life.lines.iter().flat_map(|line| life.points[line.points.clone()].iter().map(move |at| (at, line)));
    let known: Vec<(u32, u8)> = (of_points.map(|(point, line)| (point.component, line.order)))
        .chain(life.parts.iter().map(|part| (part.component, of_axis.get(&part.axis).copied().unwrap_or(1))))
        .collect();
    let count = known.iter().map(|(component, _)| *component as usize + 1).max().unwrap_or(0);
    let mut orders = vec![1; count];
    known.into_iter().for_each(|(component, order)| orders[component as usize] = order);
    orders
}

/// One of the slots of lives, and what is in it.
#[derive(Clone, Copy)]
pub struct Slotted<'a> {
    slots: &'a Slots,
    place: usize,
    options: &'a [MeshOptions],
}

impl<'a> Slotted<'a> {
    /// The slots of some lives, one by one, with what is in each.
    pub fn each(slots: &'a Slots, options: &'a [MeshOptions]) -> impl Iterator<Item = (&'a Slot, Self)> {
        slots.list().iter().enumerate().map(move |(place, slot)| (slot, Self { slots, place, options }))
    }

    /// Whether it has a picture.
    pub fn has_texture(&self) -> bool {
        self.slots.list()[self.place].texture.is_some()
    }

    /// Whether it has a line of a life.
    pub fn has_line(&self, number: usize, line: &Line, life: &Life) -> bool {
        let first = life.points[line.points.clone()].first();
        first.is_some_and(|point| self.slots.of_component(number, point.component, 0) == self.place)
    }

    /// Whether it has an organ of a life.
    pub fn has_part(&self, life: usize, part: &Part) -> bool {
        self.slots.of_component(life, part.component, class_of_kind(part.kind)) == self.place
    }

    /// How many metres of the bark of a line of a life its picture is wide and high.
    pub fn bark(&self, life: usize, line: &Line) -> Option<[f32; 2]> {
        self.options.get(life)?.own.textures().bark(line.order)
    }
}
