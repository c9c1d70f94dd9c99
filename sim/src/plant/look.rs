//! How the components of a species look, as far as it says so (de Reffye 1988 §6): kinds, forms and stated colours by
//! order and state, and how organs grow to their size.
//!
//! A form and a colour are associated with each tag, and forms may depend on age. Absent: triangles, and the colours of
//! what states none (`phytomer_outputs::meshes`).

use super::form::Form;
use super::kind::{Class, Kind};
use crate::clock::Tick;

/// A stated colour: red, green and blue, sRGB.
pub type Colour = [u8; 3];

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
    /// Of internodes: by order from 1, and within it by the state in which the axis started.
    pub internodes: Vec<InternodeLook>,
    /// Of organs, by order from 1.
    pub organs: Vec<OrganLooks>,
    /// Looks that single nodes name, whatever their order and state.
    pub apart: Vec<InternodeLook>,
    /// Looks that single organs name.
    pub organs_apart: Vec<OrganLook>,
}

/// What the internodes of an axis are and look like.
#[derive(Debug, Clone, PartialEq)]
pub struct InternodeLook {
    /// Their kind; those of short growth units are [`Kind::ShortInternode`] where this is [`Kind::Internode`].
    pub kind: Kind,
    /// Their shape.
    pub shape: Shape,
    /// The thickness of those that are blades, m.
    pub thickness: f32,
    /// The sides of their tubes; left out: as many as the mesh has.
    pub sides: Option<u8>,
    /// The form that they are drawn with, of their length and their diameter, where they are no tubes.
    pub form: Option<Form>,
    /// Their stated colours.
    pub bark: Bark,
    /// The share of their full length, by their own age in ticks, the last one for ever; empty: full at birth.
    pub expansion: Vec<f32>,
}

/// The stated colours of internodes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bark {
    /// At birth.
    pub shoot: Option<Colour>,
    /// When bark has formed.
    pub young: Option<Colour>,
    /// When it is old.
    pub old: Option<Colour>,
    /// Of dead wood that stands.
    pub dead: Option<Colour>,
    /// The ticks in which a shoot turns halfway to bark.
    pub forms_in: Option<Tick>,
    /// The ticks in which young bark turns halfway to old.
    pub darkens_in: Option<Tick>,
}

/// What the organs of an order look like.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrganLooks {
    /// What stands as a leaf.
    pub leaf: OrganLook,
    /// What stands as a flower.
    pub flower: OrganLook,
    /// What stands as a fruit.
    pub fruit: OrganLook,
}

/// The stated colours of an organ, and how it grows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrganLook {
    /// At its birth.
    pub young: Option<Colour>,
    /// In the middle of its life, where it turns twice.
    pub turning: Option<Colour>,
    /// At its end.
    pub old: Option<Colour>,
    /// Of a leaf at its last tick before a seasonal fall.
    pub autumn: Option<Colour>,
    /// Of its stalk.
    pub stalk: Option<Colour>,
    /// The ticks over which a leaf turns before a seasonal fall; 0: it does not.
    pub turns_in: Tick,
    /// The share of its full length and width, by its own age in ticks, the last one for ever; empty: full at birth.
    pub expansion: Vec<f32>,
}

impl InternodeLook {
    /// The thickness of blades of which none is stated, m; assumed: petals and laminae are of 0.1 to 0.5 mm.
    pub const BLADE_THICKNESS: f32 = 0.0003;

    /// A tube of a shape, and nothing else stated.
    pub const fn of_shape(shape: Shape) -> Self {
        let bark = Bark { shoot: None, young: None, old: None, dead: None, forms_in: None, darkens_in: None };
        Self {
            kind: Kind::Internode,
            shape,
            thickness: Self::BLADE_THICKNESS,
            sides: None,
            form: None,
            bark,
            expansion: Vec::new(),
        }
    }

    /// The share of its full length that one of them has at its own age.
    #[inline]
    pub fn share(&self, own_age: Tick) -> f32 {
        share(&self.expansion, own_age)
    }

    /// The kind of one of them.
    #[inline]
    pub fn kind(&self, short: bool) -> Kind {
        if short && self.kind == Kind::Internode { Kind::ShortInternode } else { self.kind }
    }
}

impl Looks {
    /// Those of a species whose internodes are all of one shape.
    pub fn of_shape(shape: Shape) -> Self {
        Self { states: 1, internodes: vec![InternodeLook::of_shape(shape)], ..Self::default() }
    }

    /// The place in [`Looks::internodes`] of an axis of `order` that started in `state`; orders past the last are as
    /// the last. `None` where there is none.
    #[inline]
    pub fn place(&self, order: u8, state: u8) -> Option<usize> {
        let states = self.states.max(1);
        let last = (self.internodes.len() / states).checked_sub(1)?;
        Some(usize::from(order).saturating_sub(1).min(last) * states + usize::from(state).min(states - 1))
    }

    /// Whether any internodes go on to grow in length after they have appeared.
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
}

/// The entry of a table at an own age: past its end the last one, of an empty table 1.
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
