//! The colour of each component, by kind, form, order, age and season (de Reffye 1988 §6 gives each form a colour).
//!
//! Wood turns from the green of the shoot to brown and darkens; dead wood turns grey. Leaves darken with age and turn
//! before they fall with the season; fruits ripen through a third colour. A colour that the species states is used as
//! stated; else the palette gives one by kind and form (`palette`). Meshes and pictures take their colours from here.

use super::palette::{self, Rgb};
use phytomer_looks::{Bark, Colour, Paints};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::math::pow;
use phytomer_sim::plant::{Cause, Class, Kind, OrganId, OrganLook, PaintNumber, Plant};

const DEAD_WOOD: Rgb = [150.0, 145.0, 138.0];
/// The share of the grey colour in dead wood.
const GREYED: f32 = 0.7;

/// The ticks after which a shoot has turned halfway to young bark, and young bark halfway to old.
const BARK_FORMS: Tick = 2;
const BARK_DARKENS: Tick = 20;

/// The ticks after which an organ without a stated life length is half old.
const AGES: Tick = 4;

/// The part of full light, in linear light, of a byte of a colour as screens take it (sRGB, IEC 61966-2-1).
pub fn linear(byte: u8) -> f64 {
    let shown = f64::from(byte) / 255.0;
    if shown <= 0.040_45 { shown / 12.92 } else { pow((shown + 0.055) / 1.055, 2.4) }
}

/// The colour of an internode of a kind, `old` ticks after its birth.
#[inline]
pub fn wood(kind: Kind, bark: &Bark, old: Tick, dead: bool) -> [u8; 4] {
    let [shoot, young, grown] = palette::wood(kind);
    let darkens = half_way(old, bark.darkens_in.unwrap_or(BARK_DARKENS));
    let forms = half_way(old, bark.forms_in.unwrap_or(BARK_FORMS));
    let wood =
        mixed(stated(bark.shoot, shoot), mixed(stated(bark.young, young), stated(bark.old, grown), darkens), forms);
    opaque(match (dead, bark.dead) {
        (false, _) => wood,
        (true, Some(dead)) => rgb(dead),
        (true, None) => mixed(wood, DEAD_WOOD, GREYED),
    })
}

/// The colours of an organ and of its stalk, at an age of the plant; between two ticks they go from those at the one to
/// those at the other. What appears in the tick has its first colours, and what falls its last.
#[inline]
pub fn organ(plant: &Plant, paints: &Paints, organ: OrganId, age: Tick) -> [[u8; 4]; 2] {
    let at = |age: Tick| organ_at(plant, paints, organ, (plant.look_of_organ(organ), age));
    let was = || organ_at(plant, paints, organ, (plant.former_look_of_organ(organ), age - 1));
    let (birth, death) = (plant.organs.birth[organ.index()], plant.organs.death[organ.index()]);
    match plant.partway() {
        Some(_) if death <= age => was(),
        Some(share) if birth < age => {
            let (from, to) = (was(), at(age));
            [0, 1].map(|k| between(from[k], to[k], share))
        }
        _ => at(age),
    }
}

/// The colour a share of the way to another.
pub fn between(from: [u8; 4], to: [u8; 4], share: f32) -> [u8; 4] {
    let mid = |k: usize| (f32::from(from[k]) + (f32::from(to[k]) - f32::from(from[k])) * share + 0.5) as u8;
    [0, 1, 2, 3].map(mid)
}

fn organ_at(plant: &Plant, paints: &Paints, organ: OrganId, (look, age): (Option<&OrganLook>, Tick)) -> [[u8; 4]; 2] {
    let organs = &plant.organs;
    let place = organ.index();
    let (kind, form) = (organs.kind[place], organs.form[place]);
    let tints = palette::organ(kind, form);
    let look = paints.organ(look.map_or(PaintNumber::NONE, |look| look.paint));
    let [young, old] = [stated(look.young, tints.young), stated(look.old, tints.old)];
    // Between two stated colours the palette's third colour is not used.
    let turning = look.turning.map(rgb).or(tints.turning.filter(|_| look.young.is_none() || look.old.is_none()));
    let lived = lived(organs.birth[place], organs.death[place], age);
    let mut blade = match turning {
        None => mixed(young, old, lived),
        Some(turning) if lived < 0.5 => mixed(young, turning, 2.0 * lived),
        Some(turning) => mixed(turning, old, 2.0 * lived - 1.0),
    };
    if kind.class() == Class::Leaf && organs.cause[place] == Cause::Season {
        let turned = turned(organs.death[place].saturating_sub(age), look.turns_in);
        blade = mixed(blade, stated(look.autumn, tints.autumn), turned);
    }
    [opaque(blade), opaque(stated(look.stalk, tints.stalk))]
}

/// The share of its life that an organ has lived; without an end of its life, half after [`AGES`] ticks.
fn lived(birth: Tick, death: Tick, age: Tick) -> f32 {
    let old = age.saturating_sub(birth);
    if death == NEVER { half_way(old, AGES) } else { old as f32 / (death.saturating_sub(birth).max(1) as f32) }
}

/// How far a leaf that falls in `left` ticks has turned, from 0 to 1: wholly at its last tick, by one tick's part
/// `turns_in` ticks before it.
fn turned(left: Tick, turns_in: Tick) -> f32 {
    if left == 0 || left > turns_in { 0.0 } else { (turns_in - left + 1) as f32 / turns_in as f32 }
}

/// old / (old + half), which is ½ after `half` ticks.
fn half_way(old: Tick, half: Tick) -> f32 {
    if old == 0 { 0.0 } else { old as f32 / (old as f32 + half as f32) }
}

fn stated(colour: Option<Colour>, tint: Rgb) -> Rgb {
    colour.map_or(tint, rgb)
}

fn rgb(colour: Colour) -> Rgb {
    colour.map(f32::from)
}

fn mixed(a: Rgb, b: Rgb, share: f32) -> Rgb {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * share)
}

fn opaque(colour: Rgb) -> [u8; 4] {
    let [r, g, b] = colour.map(|x| (x + 0.5) as u8);
    [r, g, b, 255]
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_looks::{FormName, OrganPaint, own_form};
    use phytomer_sim::plant::{Habit, Looks, NewAxis, NewNode, NewOrgan, OrganLooks, Seed, Shape, Trend};
    use std::sync::Arc;

    const A: Colour = [200, 100, 0];
    const B: Colour = [100, 200, 50];
    const C: Colour = [0, 0, 250];

    /// The colour at a share of the way from one to another, as the closed form has it.
    fn between(a: Colour, b: Colour, share: f64) -> [u8; 3] {
        [0, 1, 2].map(|k| (f64::from(a[k]) + (f64::from(b[k]) - f64::from(a[k])) * share).round() as u8)
    }

    fn near(found: [u8; 4], expected: [u8; 3]) -> bool {
        found[3] == 255 && (0..3).all(|k| found[k].abs_diff(expected[k]) <= 1)
    }

    #[test]
    fn bark_has_the_stated_colours_at_the_stated_ages() {
        let bark = Bark {
            shoot: Some(A),
            young: Some(B),
            old: Some(B),
            dead: Some(C),
            forms_in: Some(3),
            darkens_in: Some(7),
        };
        let wood = |bark: &Bark, old, dead| wood(Kind::Internode, bark, old, dead);
        for old in [0, 1, 3, 12, 400] {
            let share = f64::from(old) / (f64::from(old) + 3.0);
            assert!(near(wood(&bark, old, false), between(A, B, share)), "{old}");
        }
        assert_eq!(wood(&bark, 5, true), [0, 0, 250, 255]);
        let darkening = Bark { old: Some(C), forms_in: Some(0), ..bark };
        assert!(near(wood(&darkening, 0, false), A) && near(wood(&darkening, 7, false), between(B, C, 0.5)));
    }

    /// A plant of one node with an organ that lives from 10 to `death`.
    fn bearing(kind: Kind, form: FormName, death: Tick, cause: Cause, paint: OrganPaint) -> Plant {
        let mut paints = Paints::default();
        let look = OrganLook { paint: paints.add_organ(paint), ..OrganLook::default() };
        let looks = OrganLooks { leaf: look.clone(), flower: look.clone(), fruit: look };
        let looks = Looks { organs: vec![looks], ..Looks::of_shape(Shape::Cone) };
        let for_drawing = paints.into_habit();
        let habit = Habit { trends: vec![Trend::STRAIGHT], looks, for_drawing, ..Habit::default() };
        let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 9, keep_events: false };
        let mut plant = Plant::new(&seed, Arc::new(habit));
        let axis = plant.add_axis(NewAxis::OF_THE_SEED);
        let node = plant.add_node(NewNode { axis, length: 0.1, diameter: 0.01, ..NewNode::OF_THE_TRUNK });
        plant.add_organ(NewOrgan {
            node,
            kind,
            birth: 10,
            death,
            cause,
            form: form.form(),
            length: 0.1,
            width: 0.1,
            insertion: 1.0,
            ..NewOrgan::LEAF
        });
        plant
    }

    /// The colours of its organ and of the organ's stalk.
    fn coloured(plant: &Plant, age: Tick) -> [[u8; 4]; 2] {
        organ(plant, Paints::of(&plant.habit), OrganId(0), age)
    }

    #[test]
    fn leaves_turn_before_the_season_takes_them() {
        let paint = OrganPaint {
            young: Some(A),
            old: Some(A),
            autumn: Some(B),
            stalk: Some(C),
            turns_in: 4,
            ..OrganPaint::default()
        };
        let plant = bearing(Kind::Leaf, FormName::Elliptic, 20, Cause::Season, paint);
        for (age, share) in [(10, 0.0), (15, 0.0), (16, 0.25), (17, 0.5), (18, 0.75), (19, 1.0)] {
            let [blade, stalk] = coloured(&plant, age);
            assert!(near(blade, between(A, B, share)) && stalk == [0, 0, 250, 255], "{age}");
        }
        let aged = bearing(Kind::Leaf, FormName::Elliptic, 20, Cause::LifeLength, paint);
        assert!(near(coloured(&aged, 19)[0], A), "only the season turns them");
        assert_eq!(turned(1, 0), 0.0);
    }

    #[test]
    fn fruits_ripen_by_way_of_a_third_colour() {
        let paint = OrganPaint { young: Some(A), turning: Some(B), old: Some(C), ..OrganPaint::default() };
        let plant = bearing(Kind::Fruit, FormName::Berry, 30, Cause::LifeLength, paint);
        for (age, expected) in
            [(10, A), (15, between(A, B, 0.5)), (20, B), (25, between(B, C, 0.5)), (29, between(B, C, 0.9))]
        {
            assert!(near(coloured(&plant, age)[0], expected), "{age}");
        }
        let direct = OrganPaint { turning: None, ..paint };
        let plant = bearing(Kind::Fruit, FormName::Berry, 30, Cause::LifeLength, direct);
        assert!(near(coloured(&plant, 20)[0], between(A, C, 0.5)), "no third colour between two that are stated");
        let silent = bearing(Kind::Fruit, FormName::Berry, NEVER, Cause::None, OrganPaint::default());
        assert!(near(coloured(&silent, 14)[0], [214, 158, 52]), "half old after 4 ticks");
    }

    #[test]
    fn every_kind_and_form_has_a_colour() {
        for kind in Kind::ALL {
            assert!(palette::wood(kind).iter().flatten().all(|x| (0.0..=255.0).contains(x)));
            for form in FormName::ALL.map(FormName::form).into_iter().chain([own_form(0)]) {
                let tints = palette::organ(kind, form);
                let all = [tints.young, tints.old, tints.autumn, tints.stalk, tints.turning.unwrap_or(tints.old)];
                assert!(all.iter().flatten().all(|x| (0.0..=255.0).contains(x)), "{kind:?} {form:?}");
            }
        }
    }
}
