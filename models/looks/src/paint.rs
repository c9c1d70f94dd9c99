//! Stated colours, and the other parts of a look that growth does not use: by the age of wood, of organs, and of leaves
//! by season.
//!
//! A form and a colour are associated with each tag, and forms may depend on age (de Reffye 1988 §6). Here a colour
//! that is not stated is `None`. Absent: the colours that replace it (`phytomer_meshes::palette`), and how one colour
//! turns into the next (`phytomer_meshes::colour`).

use super::near::{Near, NearStem};
use super::section::Section;
use super::surface::Surface;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{ForDrawing, Form, Habit, PaintNumber};

/// A stated colour: red, green and blue, sRGB.
pub type Colour = [u8; 3];

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

/// How the internodes of a look are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InternodePaint {
    /// The sides of their tubes; `None`: as many as the mesh has by default.
    pub sides: Option<u8>,
    /// The form that is drawn in place of a tube, as long as the internode and as wide as its diameter; `None`: a tube.
    pub form: Option<Form>,
    /// Their stated colours.
    pub bark: Bark,
    /// How they are drawn from near, by its place among those of the paints; `None`: as a tube.
    pub near: Option<u16>,
}

/// The stated colours of the organs of a look.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OrganPaint {
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
    /// How it is drawn from near, by its place among those of the paints; `None`: as its form is.
    pub near: Option<u16>,
}

/// The paints of a species, which its looks name by number.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Paints {
    internodes: Vec<InternodePaint>,
    organs: Vec<OrganPaint>,
    surfaces: Vec<Surface>,
    sections: Vec<Section>,
    nears: Vec<Near>,
    near_stems: Vec<NearStem>,
}

impl Paints {
    /// Adds how the internodes of a look are drawn. Returns the number of the paint, which several looks may name.
    pub fn add_internode(&mut self, paint: InternodePaint) -> PaintNumber {
        self.internodes.push(paint);
        PaintNumber::nth(self.internodes.len())
    }

    /// Adds the colours of the organs of a look. Returns the number of the paint, which several looks may name.
    pub fn add_organ(&mut self, paint: OrganPaint) -> PaintNumber {
        self.organs.push(paint);
        PaintNumber::nth(self.organs.len())
    }

    /// Adds a curved surface. Returns its place, which organs state.
    pub fn add_surface(&mut self, surface: Surface) -> usize {
        self.surfaces.push(surface);
        self.surfaces.len() - 1
    }

    /// The curved surface with a place.
    #[inline]
    pub fn surface(&self, place: usize) -> Option<&Surface> {
        self.surfaces.get(place)
    }

    /// Adds how organs are drawn from near. Returns its place, which the paints of organs name.
    pub fn add_near(&mut self, near: Near) -> Option<u16> {
        self.nears.push(near);
        u16::try_from(self.nears.len() - 1).ok()
    }

    /// How organs are drawn from near, in their places.
    pub fn nears(&self) -> &[Near] {
        &self.nears
    }

    /// Adds how internodes are drawn from near. Returns its place, which the paints of internodes name.
    pub fn add_near_stem(&mut self, near: NearStem) -> Option<u16> {
        self.near_stems.push(near);
        u16::try_from(self.near_stems.len() - 1).ok()
    }

    /// How internodes with this paint are drawn from near.
    pub fn near_stem(&self, paint: &InternodePaint) -> Option<&NearStem> {
        self.near_stems.get(usize::from(paint.near?))
    }

    /// Adds a cross section. Returns its place, which internodes state.
    pub fn add_section(&mut self, section: Section) -> usize {
        self.sections.push(section);
        self.sections.len() - 1
    }

    /// The cross sections in their places.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// How the internodes of a look with this paint number are drawn; for [`PaintNumber::NONE`] nothing is stated.
    #[inline]
    pub fn internode(&self, number: PaintNumber) -> &InternodePaint {
        static SILENT: InternodePaint = InternodePaint {
            sides: None,
            form: None,
            bark: Bark { shoot: None, young: None, old: None, dead: None, forms_in: None, darkens_in: None },
            near: None,
        };
        number.place().and_then(|place| self.internodes.get(place)).unwrap_or(&SILENT)
    }

    /// The colours of the organs of a look with this paint number; for [`PaintNumber::NONE`] nothing is stated.
    #[inline]
    pub fn organ(&self, number: PaintNumber) -> &OrganPaint {
        static SILENT: OrganPaint =
            OrganPaint { young: None, turning: None, old: None, autumn: None, stalk: None, turns_in: 0, near: None };
        number.place().and_then(|place| self.organs.get(place)).unwrap_or(&SILENT)
    }

    /// The paints in the form in which a habit carries them.
    pub fn into_habit(self) -> ForDrawing {
        ForDrawing::new(self)
    }

    /// The paints that a habit carries; an empty set where it carries none.
    pub fn of(habit: &Habit) -> &Self {
        static NONE: Paints = Paints {
            internodes: Vec::new(),
            organs: Vec::new(),
            surfaces: Vec::new(),
            sections: Vec::new(),
            nears: Vec::new(),
            near_stems: Vec::new(),
        };
        habit.for_drawing.get().unwrap_or(&NONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_habit_gives_back_the_paints_that_it_was_given() {
        let mut paints = Paints::default();
        let red = OrganPaint { young: Some([200, 0, 0]), ..OrganPaint::default() };
        let hexagon = InternodePaint { sides: Some(6), ..InternodePaint::default() };
        let (organ, internode) = (paints.add_organ(red), paints.add_internode(hexagon));
        let habit = Habit { for_drawing: paints.into_habit(), ..Habit::default() };
        let of = Paints::of(&habit);
        assert_eq!((of.organ(organ), of.internode(internode)), (&red, &hexagon));
        let silent = (of.organ(PaintNumber::NONE), of.internode(PaintNumber::nth(2)));
        assert_eq!(silent, (&OrganPaint::default(), &InternodePaint::default()));
        assert_eq!(Paints::of(&Habit::default()), &Paints::default());
    }
}
