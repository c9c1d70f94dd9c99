//! The looks of the components of a species, as far as growth, pose and mechanics use them (de Reffye 1988 §6): kinds
//! and shapes by order and state, and how internodes and organs expand to their size.
//!
//! A look names how it is drawn by a number, the place among the data for drawing in the habit. Absent: colours, forms
//! and triangles (`phytomer_looks`, `phytomer_meshes`).

use super::kind::{Class, Kind};
use crate::clock::Tick;

/// The number by which a look names how it is drawn; growth does not use it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PaintNumber(u32);

impl PaintNumber {
    /// The number of a look of which nothing is stated for drawing.
    pub const NONE: Self = Self(0);

    /// The number of the nth entry of its list, counted from 1; [`PaintNumber::NONE`] for 0.
    pub fn nth(nth: usize) -> Self {
        Self(u32::try_from(nth).unwrap_or(0))
    }

    /// The place in the list, from 0; `None` for [`PaintNumber::NONE`].
    #[inline]
    pub fn place(self) -> Option<usize> {
        (self.0 as usize).checked_sub(1)
    }
}

/// The shape of an internode at rest (de Reffye 1988 §4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// One diameter along the whole internode.
    Cylinder,
    /// The tip has the diameter of the base of the internode that follows it on its axis.
    Cone,
    /// A plane blade as wide as the diameter, its tip as wide as the internode that follows, of the thickness of its
    /// look.
    Blade,
}

/// The looks of a species.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Looks {
    /// How many states axes can be in; 0 counts as 1.
    pub states: usize,
    /// The looks of internodes: by order from 1, and within it by the state in which the axis started.
    pub internodes: Vec<InternodeLook>,
    /// The looks of organs, by order from 1.
    pub organs: Vec<OrganLooks>,
    /// Looks that single nodes name, whatever their order and state.
    pub apart: Vec<InternodeLook>,
    /// Looks that single organs name.
    pub organs_apart: Vec<OrganLook>,
}

/// The look of the internodes of an axis: what they are and how they are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct InternodeLook {
    /// Their kind; those of short growth units are [`Kind::ShortInternode`] where this is [`Kind::Internode`].
    pub kind: Kind,
    /// Their shape.
    pub shape: Shape,
    /// The thickness of internodes that are blades, m.
    pub thickness: f32,
    /// How they are drawn.
    pub paint: PaintNumber,
    /// The share of their full length by their own age in ticks; later ages have the last share. Empty: full length at
    /// birth.
    pub expansion: Vec<f32>,
}

/// What the organs of an order look like.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrganLooks {
    /// The look of organs that stand as leaves.
    pub leaf: OrganLook,
    /// The look of organs that stand as flowers.
    pub flower: OrganLook,
    /// The look of organs that stand as fruits.
    pub fruit: OrganLook,
}

/// How an organ grows and is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrganLook {
    /// How it is drawn.
    pub paint: PaintNumber,
    /// The share of its full length and width by its own age in ticks; later ages have the last share. Empty: full size
    /// at birth.
    pub expansion: Vec<f32>,
}

impl InternodeLook {
    /// The thickness of blades for which none is stated, m. Assumed: petals and laminae have 0.1 to 0.5 mm.
    pub const BLADE_THICKNESS: f32 = 0.0003;

    /// A tube of a shape, and nothing else stated.
    pub const fn of_shape(shape: Shape) -> Self {
        Self {
            kind: Kind::Internode,
            shape,
            thickness: Self::BLADE_THICKNESS,
            paint: PaintNumber::NONE,
            expansion: Vec::new(),
        }
    }

    /// The share of its full length that an internode has at its own age.
    #[inline]
    pub fn share(&self, own_age: Tick) -> f32 {
        share(&self.expansion, own_age)
    }

    /// The kind of an internode of a long or a short growth unit.
    #[inline]
    pub fn kind(&self, short: bool) -> Kind {
        if short && self.kind == Kind::Internode { Kind::ShortInternode } else { self.kind }
    }
}

impl Looks {
    /// The looks of a species whose internodes are all of one shape.
    pub fn of_shape(shape: Shape) -> Self {
        Self { states: 1, internodes: vec![InternodeLook::of_shape(shape)], ..Self::default() }
    }

    /// The place in [`Looks::internodes`] of an axis of `order` that started in `state`; orders past the last have the
    /// place of the last. `None` where no looks are stated.
    #[inline]
    pub fn place(&self, order: u8, state: u8) -> Option<usize> {
        let states = self.states.max(1);
        let last = (self.internodes.len() / states).checked_sub(1)?;
        Some(usize::from(order).saturating_sub(1).min(last) * states + usize::from(state).min(states - 1))
    }

    /// Whether any internodes still grow in length after they have appeared.
    pub fn lengthen(&self) -> bool {
        self.internodes.iter().chain(&self.apart).any(|look| !look.expansion.is_empty())
    }

    /// The look of the internodes of an axis of `order` that started in `state`.
    #[inline]
    pub fn internode(&self, order: u8, state: u8) -> &InternodeLook {
        static PLAIN: InternodeLook = InternodeLook::of_shape(Shape::Cylinder);
        self.place(order, state).map_or(&PLAIN, |place| &self.internodes[place])
    }

    /// The look of the organs of a class on an axis of `order`; `None` where nothing is stated.
    #[inline]
    pub fn organ(&self, order: u8, class: Class) -> Option<&OrganLook> {
        let last = self.organs.len().checked_sub(1)?;
        let looks = &self.organs[usize::from(order).saturating_sub(1).min(last)];
        match class {
            Class::Leaf => Some(&looks.leaf),
            Class::Flower => Some(&looks.flower),
            Class::Fruit => Some(&looks.fruit),
            Class::Internode | Class::Bud => None,
        }
    }
}

impl OrganLook {
    /// The share of its full length and width at its own age.
    #[inline]
    pub fn share(&self, own_age: Tick) -> f32 {
        share(&self.expansion, own_age)
    }

    /// Whether this share does not change any more from an own age on.
    pub fn is_grown(&self, own_age: Tick) -> bool {
        own_age as usize + 1 >= self.expansion.len()
    }
}

/// The entry of a table at an own age: past the end the last entry, and 1 for an empty table.
#[inline]
fn share(table: &[f32], own_age: Tick) -> f32 {
    match table.len() {
        0 => 1.0,
        ages => table[(own_age as usize).min(ages - 1)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_are_found_by_order_and_state() {
        let look = |kind| InternodeLook { kind, ..InternodeLook::of_shape(Shape::Blade) };
        let kinds = [Kind::Internode, Kind::CulmInternode, Kind::SepalInternode, Kind::PetalInternode];
        let looks = Looks { states: 2, internodes: kinds.map(look).to_vec(), ..Looks::default() };
        let found = [(1, 0), (1, 1), (2, 0), (2, 1), (7, 1), (0, 0), (2, 9)].map(|(o, s)| looks.internode(o, s).kind);
        assert_eq!(found[..4], kinds);
        assert_eq!(found[4..], [Kind::PetalInternode, Kind::Internode, Kind::PetalInternode]);
        assert_eq!(Looks::default().internode(3, 1).shape, Shape::Cylinder);
        assert_eq!(
            (looks.internode(1, 0).kind(true), looks.internode(1, 1).kind(true)),
            (Kind::ShortInternode, Kind::CulmInternode)
        );
    }

    #[test]
    fn an_organ_keeps_its_last_share() {
        let look = OrganLook { expansion: vec![0.2, 0.6, 1.0], ..OrganLook::default() };
        assert_eq!([0, 1, 2, 3, 900].map(|age| look.share(age)), [0.2, 0.6, 1.0, 1.0, 1.0]);
        assert_eq!(OrganLook::default().share(0), 1.0);
    }
}
