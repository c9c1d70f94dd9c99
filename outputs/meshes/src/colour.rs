//! The colour of each component: by kind, by form, by order, by age and by season (de Reffye 1988 §6: one to a form).
//!
//! Wood goes from the green of the shoot to brown and darkens; dead wood turns grey. Leaves darken as they grow old and
//! turn before they fall with the season, fruits ripen by way of a third colour. What a species states holds; the rest
//! is a palette by kind and form, by eye: nothing is measured from it. Every picture takes its colours from here.

use super::palette::{self, Rgb};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{Cause, Class, Colour, InternodeLook, OrganId, OrganLook, Plant};

const DEAD_WOOD: Rgb = [150.0, 145.0, 138.0];
/// The share of that colour in dead wood.
const GREYED: f32 = 0.7;

/// The ticks in which a shoot turns halfway to young bark, and young bark halfway to old.
const BARK_FORMS: Tick = 2;
const BARK_DARKENS: Tick = 20;

/// The ticks in which an organ without a life length is half old.
const AGES: Tick = 4;

/// The colour of an internode that is `old` ticks old.
#[inline]
pub fn wood(look: &InternodeLook, old: Tick, dead: bool) -> [u8; 4] {
    let [shoot, young, grown] = palette::wood(look.kind);
    let bark = &look.bark;
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

/// The colours of an organ and of its stalk, `age` ticks after the seed.
#[inline]
pub fn organ(plant: &Plant, organ: OrganId, age: Tick) -> [[u8; 4]; 2] {
    let organs = &plant.organs;
    let place = organ.index();
    let (kind, form) = (organs.kind[place], organs.form[place]);
    let tints = palette::organ(kind, form);
    let silent = OrganLook::default();
    let look = plant.look_of_organ(organ).unwrap_or(&silent);
    let [young, old] = [stated(look.young, tints.young), stated(look.old, tints.old)];
    // Between two stated colours there is no third of the palette's.
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

/// The share of its life that an organ has lived; without an end to it, half after [`AGES`] ticks.
fn lived(birth: Tick, death: Tick, age: Tick) -> f32 {
    let old = age.saturating_sub(birth);
    if death == NEVER { half_way(old, AGES) } else { old as f32 / (death.saturating_sub(birth).max(1) as f32) }
}

/// How far a leaf has turned that falls in `left` ticks: wholly at its last, one tick's part `turns_in` ticks before.
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
    use phytomer_sim::plant::{
        Bark, Form, Habit, InternodeLook, Kind, Looks, NewAxis, NewNode, NewOrgan, NodeId, OrganLooks, Seed, Shape,
        Trend,
    };
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
        let look = InternodeLook { bark, ..InternodeLook::of_shape(Shape::Cone) };
        for old in [0, 1, 3, 12, 400] {
            let share = f64::from(old) / (f64::from(old) + 3.0);
            assert!(near(wood(&look, old, false), between(A, B, share)), "{old}");
        }
        assert_eq!(wood(&look, 5, true), [0, 0, 250, 255]);
        let darkening = InternodeLook { bark: Bark { old: Some(C), forms_in: Some(0), ..bark }, ..look };
        assert!(near(wood(&darkening, 0, false), A) && near(wood(&darkening, 7, false), between(B, C, 0.5)));
    }

    /// A plant of one node with an organ that lives from 10 to `death`.
    fn bearing(kind: Kind, form: Form, death: Tick, cause: Cause, looks: OrganLooks) -> Plant {
        let looks = Looks { organs: vec![looks], ..Looks::of_shape(Shape::Cone) };
        let habit = Habit { trends: vec![Trend::STRAIGHT], looks, organ_trends: vec![], wood: None };
        let seed = Seed { plant: 0, run_seed: 1, component_limit: 9, keep_events: false };
        let mut plant = Plant::new(&seed, Arc::new(habit));
        let axis = plant.add_axis(NewAxis::OF_THE_SEED);
        let node = plant.add_node(NewNode {
            parent: NodeId::NONE,
            axis,
            birth: 1,
            rank: 1,
            unit_rank: 1,
            short: false,
            neoformed: false,
            trend: 0,
            length: 0.1,
            diameter: 0.01,
            azimuth: 0.0,
        });
        plant.add_organ(NewOrgan {
            node,
            kind,
            position: 0,
            birth: 10,
            death,
            cause,
            form,
            length: 0.1,
            width: 0.1,
            area: 0.0,
            azimuth: 0.0,
            insertion: 1.0,
        });
        plant
    }

    #[test]
    fn leaves_turn_before_the_season_takes_them() {
        let look = OrganLook {
            young: Some(A),
            old: Some(A),
            autumn: Some(B),
            stalk: Some(C),
            turns_in: 4,
            ..OrganLook::default()
        };
        let looks = OrganLooks { leaf: look, ..OrganLooks::default() };
        let plant = bearing(Kind::Leaf, Form::Elliptic, 20, Cause::Season, looks.clone());
        for (age, share) in [(10, 0.0), (15, 0.0), (16, 0.25), (17, 0.5), (18, 0.75), (19, 1.0)] {
            let [blade, stalk] = organ(&plant, OrganId(0), age);
            assert!(near(blade, between(A, B, share)) && stalk == [0, 0, 250, 255], "{age}");
        }
        let aged = bearing(Kind::Leaf, Form::Elliptic, 20, Cause::LifeLength, looks);
        assert!(near(organ(&aged, OrganId(0), 19)[0], A), "only the season turns them");
        assert_eq!(turned(1, 0), 0.0);
    }

    #[test]
    fn fruits_ripen_by_way_of_a_third_colour() {
        let look = OrganLook { young: Some(A), turning: Some(B), old: Some(C), ..OrganLook::default() };
        let looks = |look: &OrganLook| OrganLooks { fruit: look.clone(), ..OrganLooks::default() };
        let plant = bearing(Kind::Fruit, Form::Berry, 30, Cause::LifeLength, looks(&look));
        for (age, expected) in
            [(10, A), (15, between(A, B, 0.5)), (20, B), (25, between(B, C, 0.5)), (29, between(B, C, 0.9))]
        {
            assert!(near(organ(&plant, OrganId(0), age)[0], expected), "{age}");
        }
        let direct = OrganLook { turning: None, ..look };
        let plant = bearing(Kind::Fruit, Form::Berry, 30, Cause::LifeLength, looks(&direct));
        assert!(
            near(organ(&plant, OrganId(0), 20)[0], between(A, C, 0.5)),
            "no third colour between two that are stated"
        );
        let silent = bearing(Kind::Fruit, Form::Berry, NEVER, Cause::None, OrganLooks::default());
        assert!(near(organ(&silent, OrganId(0), 14)[0], [214, 158, 52]), "half old after 4 ticks");
    }

    #[test]
    fn every_kind_and_form_has_a_colour() {
        for kind in Kind::ALL {
            assert!(palette::wood(kind).iter().flatten().all(|x| (0.0..=255.0).contains(x)));
            for form in Form::LIBRARY {
                let tints = palette::organ(kind, form);
                let all = [tints.young, tints.old, tints.autumn, tints.stalk, tints.turning.unwrap_or(tints.old)];
                assert!(all.iter().flatten().all(|x| (0.0..=255.0).contains(x)), "{kind:?} {form:?}");
            }
        }
    }
}
