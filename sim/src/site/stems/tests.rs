//! What is beside a bud: found through the trees as by asking each stem, and a cone that meets a stem, by hand.

use super::beside::Near;
use super::*;
use crate::site::solids::Cone;

/// A plant of upright stems, each an axis of its own.
fn of_plant(number: u32, place: Point, stems: &[([f32; 3], [f32; 3], f32)]) -> OfPlant {
    let mut of = OfPlant::empty(number, place);
    let stem = |(axis, &(start, end, radius)): (usize, &([f32; 3], [f32; 3], f32))| Stem {
        start,
        end,
        radii: [radius, 0.5 * radius],
        axis: axis as u32,
    };
    let all: Vec<Stem> = stems.iter().enumerate().map(stem).collect();
    all.chunks(3).for_each(|piece| of.add(piece.iter().copied()));
    of
}

fn stems(plants: Vec<OfPlant>, whose: Whose) -> Stems {
    let tree = Tree::of(&plants.iter().map(OfPlant::bounds).collect::<Vec<_>>());
    Stems { whose, plants, tree }
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
        (0..9).map(|k| of_plant(k, [f64::from(k % 3), f64::from(k / 3), 0.0], &some(k as usize))).collect();
    let mut found = 0;
    for whose in [Whose::Neighbours, Whose::All] {
        let all = stems(plants.clone(), whose);
        for asked in 0..300_u32 {
            let [x, y, z] = [7, 11, 13].map(|prime| f64::from(asked * prime % 97) / 97.0);
            let (point, reach) = ([3.2 * x, 3.2 * y, z], 0.02 + 0.2 * z);
            let spared = Spared { plant: asked % 9, axis: asked % 240 };
            let mut near = Vec::new();
            all.each_near(point, reach, spared, &mut |plant, stem| near.push((plant.number, stem.axis)));
            near.sort_unstable();
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
    assert!(found > 2000, "{found}");
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
