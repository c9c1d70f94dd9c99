//! What is beside a bud: found through the trees as by asking each stem, and a cone that meets a stem, by hand.

use super::stem::Near;
use super::*;
use crate::site::solids::Cone;
use crate::vector::Vector;

/// A plant of stems, each an axis of its own.
pub(super) fn of_plant(number: u32, place: Point, stems: &[([f32; 3], [f32; 3], f32)]) -> OfPlant {
    let stem = |(axis, &(start, end, radius)): (usize, &([f32; 3], [f32; 3], f32))| Stem {
        start,
        end,
        radii: [radius, 0.5 * radius],
        axis: axis as u32,
        entered: radius,
        turn: false,
    };
    let stems: Vec<Stem> = stems.iter().enumerate().map(stem).collect();
    let (standing, length) = (stems.len(), stems.iter().map(Stem::extent).sum());
    let pieces = (0..standing as u32).step_by(3).map(|start| (start, (start + 3).min(standing as u32))).collect();
    OfPlant { number, place, about: about(&stems, place), stems, standing, length, pieces, ..OfPlant::default() }
}

pub(super) fn stems(plants: Vec<OfPlant>, whose: Whose) -> Stems {
    let mut stems = Stems { whose, plants, ..Stems::default() };
    stems.number();
    stems
}

/// A box about stems, as they are entered.
fn about(stems: &[Stem], place: Point) -> Bounds {
    stems.iter().fold(Bounds::NOTHING, |all, stem| all.with(&stem.entered_bounds(place)))
}

/// Numbers in [0, 1) without an order.
pub(super) fn fractions(mut state: u64) -> impl FnMut() -> f32 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1 << 24) as f32
    }
}

/// Stems that come, move, grow thicker and fall, among them some that pass through very many cells, are found where
/// they are as those that are entered at once.
#[test]
fn stems_that_change_are_found_where_they_are() {
    let mut fraction = fractions(11);
    let mut stem = |axis: u32, along: f32, radius: f32| {
        let start = [0, 1, 2].map(|_| 2.0 * fraction());
        let end = start.map(|x| x + along * (fraction() - 0.5));
        let radii = [radius * fraction(), radius * fraction()];
        Stem { start, end, radii, axis, entered: radii[0].max(radii[1]), turn: false }
    };
    let place = [3.0, -7.0, 0.5];
    let first: Vec<Stem> = (0..200).map(|axis| stem(axis, if axis % 50 == 0 { 300.0 } else { 0.2 }, 0.02)).collect();
    let of = |stems: &[Stem]| {
        let stands: Vec<Stem> = stems.iter().copied().filter(|stem| stem.entered >= 0.0).collect();
        let (standing, length) = (stands.len(), stands.iter().map(Stem::extent).sum());
        let about = about(&stands, place);
        OfPlant { number: 5, place, about, standing, length, stems: stems.to_vec(), ..OfPlant::default() }
    };
    let mut kept = stems(vec![of(&first)], Whose::Neighbours);
    let (mut found, mut made_anew) = (0, 0);
    for round in 0..40 {
        // At the end stems become ever longer, so that other cells suit them.
        let longer = if round < 30 { 0.2 } else { 0.6 };
        let mut now = kept.plants[0].stems.clone();
        let changed: Vec<(u32, Stem)> = (0..200_u32)
            .filter(|node| (node * 7 + round) % 5 == 0)
            .map(|node| {
                let was = std::mem::replace(&mut now[node as usize], stem(node, longer, 0.05));
                if (node + round) % 3 == 0 {
                    now[node as usize] = Stem::NONE;
                }
                (node, was)
            })
            .collect();
        let suited = kept.plants[0].cells().suit(of(&now).mean_length());
        made_anew += usize::from(!suited);
        let cells = std::mem::take(&mut kept.plants[0].cells);
        kept.plants[0] = OfPlant { changed, cells, ..of(&now) };
        kept.plants[0].enter();
        kept.boxes = OnceLock::new();
        let fresh = stems(vec![of(&now)], Whose::Neighbours);
        assert!(kept == fresh);
        for _ in 0..150 {
            let point = place.map(|at| at + f64::from(stem(0, 0.0, 0.0).start[0]));
            let reach = f64::from(stem(0, 0.0, 0.0).start[1]) * 0.1;
            let near = |stems: &Stems| {
                let mut near = Vec::new();
                stems.gather(point, reach, Spared::default(), &mut near);
                near.iter().map(|which| stems.get(*which).1.axis).collect::<Vec<_>>()
            };
            let at = [0, 1, 2].map(|k| point[k] - place[k]);
            let standing = now.iter().filter(|stem| stem.entered >= 0.0);
            let expected: Vec<u32> = standing.filter(|stem| stem.distance(at) < reach).map(|stem| stem.axis).collect();
            assert_eq!(near(&kept), expected, "round {round}");
            assert_eq!(near(&fresh), expected, "round {round}");
            found += expected.len();
        }
    }
    assert!(found > 1_000 && made_anew > 0, "{found} {made_anew}");
}

#[test]
fn what_is_near_is_what_asking_each_stem_finds() {
    let some = |seed: usize| -> Vec<([f32; 3], [f32; 3], f32)> {
        let at = |k: usize, prime: usize| ((k * prime + seed) % 251) as f32 / 251.0;
        let stem = |k: usize| {
            let start = [at(k, 7), at(k, 11), at(k, 13)];
            let along = [at(k, 17) - 0.5, at(k, 19) - 0.5, at(k, 23)].map(|x| 0.2 * x);
            (start, [0, 1, 2].map(|axis| start[axis] + along[axis]), 0.01 + 0.02 * at(k, 29))
        };
        (0..240).map(stem).collect()
    };
    let plants: Vec<OfPlant> =
        (0..16).map(|k| of_plant(k, [f64::from(k % 4), f64::from(k / 4), 0.0], &some(k as usize))).collect();
    let (mut found, mut by_list, mut by_tree) = (0, 0, 0);
    for whose in [Whose::Neighbours, Whose::All] {
        let all = stems(plants.clone(), whose);
        for asked in 0..300_u32 {
            let [x, y, z] = [7, 11, 13].map(|prime| f64::from(asked * prime % 97) / 97.0);
            let spared = Spared { plant: asked % 16, axis: asked % 240 };
            // Every other one asks about its own plant, the others anywhere; one of them about a place far beyond all.
            let own = plants[spared.plant as usize].place;
            let about_own = [own[0] + 1.4 * x - 0.2, own[1] + 1.4 * y - 0.2, z];
            let point = if asked % 2 == 0 { about_own } else { [4.2 * x, 4.2 * y, if asked == 7 { 9.0 } else { z }] };
            let reach = 0.02 + if asked % 5 == 0 { 0.8 } else { 0.2 } * z;
            let box_of_own = all.plants[spared.plant as usize].about.with_margin(ASIDE - reach - ROUNDING);
            if box_of_own.holds(point) {
                by_list += 1
            } else {
                by_tree += 1
            }
            let mut near = Vec::new();
            all.gather(point, reach, spared, &mut near);
            let known = |(plant, stem): (&OfPlant, &Stem)| (plant.number, stem.axis);
            let mut near: Vec<(u32, u32)> = near.iter().map(|which| known(all.get(*which))).collect();
            near.sort_unstable();
            let mut around = Vec::new();
            all.each_around(point, reach, spared, &mut |plant, stem| around.push((plant.number, stem.axis)));
            around.sort_unstable();
            assert_eq!(near, around);
            let mut expected = Vec::new();
            for plant in &plants {
                for stem in &plant.stems {
                    let known = Near::of(stem, plant.place, plant.number);
                    let own = plant.number == spared.plant;
                    let counts = if whose == Whose::All { !own || stem.axis != spared.axis } else { !own };
                    if counts && known.distance(Vector::of(point)) < reach {
                        expected.push((plant.number, stem.axis));
                    }
                }
            }
            assert_eq!(near, expected);
            found += near.len();
        }
    }
    assert!(found > 2000 && by_list > 150 && by_tree > 150, "{found} {by_list} {by_tree}");
}

/// A cone of 10 cm and 30° before an upright stem of 1 cm radius, whose bark is to be felt where the middle of a ball
/// is nearer to it than the radius of the ball: straight ahead at the end of the cone, and aside where the ball of the
/// same height has grown so far.
#[test]
fn a_cone_meets_the_stem_ahead_and_not_the_one_that_it_leaves() {
    let cone = Cone { length: 0.1, sine: 0.5 };
    let met = |x: f64, y: f64, heading: Point| {
        let post = of_plant(1, [x, y, 0.0], &[([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 0.01)]);
        let mut beside = Beside::default();
        beside.look(&stems(vec![post], Whose::Neighbours), [0.0; 3], 0.2, Spared::default());
        beside.met([0.0; 3], heading, cone)
    };
    // The radius at the middle of the stem is 7.5 mm. Of it the nearest point of the cone is its end at 10 cm.
    let ahead = [1.0, 0.0, 0.0];
    assert!(met(0.1074, 0.0, ahead).is_some() && met(0.1076, 0.0, ahead).is_none());
    // Across from the ball at s, whose radius is s / 2: the side of the cone lies at y cos 30° − x sin 30°.
    let side = |x: f64| (0.0075 + x * 0.5) / 0.75_f64.sqrt();
    assert!(met(0.04, side(0.04) - 1e-4, ahead).is_some() && met(0.04, side(0.04) + 1e-4, ahead).is_none());
    let out = met(0.05, 0.02, ahead).expect("it is met");
    assert!(out[1] < -0.9, "out of the stem, which is to the left: {out:?}");
    // One that stands around the bud, or that it leaves behind, is not ahead.
    assert!(met(0.0, 0.0, ahead).is_none() && met(-0.02, 0.0, ahead).is_none());
}
