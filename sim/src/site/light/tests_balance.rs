//! No light is lost, and nothing but the canopy shows in it.

use super::canopy::{Canopy, Piece};
use super::{Borders, Field, Lighting, Lit, Projection, Sky};
use crate::shape::{Point, Shape, Sphere};
use std::sync::Arc;

/// Plants that are heaps of leaves, in this order, with a bud above each.
struct Heaps(Vec<u32>);

impl Canopy for Heaps {
    fn plants(&self) -> usize {
        self.0.len()
    }

    fn pieces(&self, plant: usize, _: f64, show: &mut dyn FnMut(Piece)) {
        let number = self.0[plant];
        for leaf in 0..400_u32 {
            let part = |prime: u32| f64::from((leaf * prime + number * 31) % 97) / 97.0;
            let place = [part(7) + f64::from(number % 3), part(11) + f64::from(number / 3), 2.0 * part(13)];
            let turned = [part(17) - 0.5, part(19) - 0.5, 0.6];
            let length = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
            show(Piece { place, normal: turned.map(|x| x / length), area: 0.004 + 0.001 * part(23) });
        }
    }

    fn buds(&self, plant: usize, show: &mut dyn FnMut(usize, Point)) {
        let number = f64::from(self.0[plant]);
        show(0, [number % 3.0 + 0.5, number / 3.0, 2.9]);
    }
}

fn lightings() -> Vec<Lighting> {
    let ball = Arc::new(Shape::Sphere(Sphere { centre: [1.0, 1.0, 2.5], radius: 0.4 }));
    let periodic = Borders::Periodic([3.1, 3.3]);
    let projections = [Projection::Even(0.5), Projection::OfLeaves];
    let mut all = Vec::new();
    for projection in projections {
        for borders in [Borders::Open, periodic] {
            all.push(Lighting { projection, borders, opaque: vec![Arc::clone(&ball)], ..Lighting::default() });
        }
    }
    all
}

#[test]
fn all_light_is_kept_stopped_or_passed() {
    for lighting in lightings() {
        let field = Field::of(&lighting, &Heaps((0..9).collect()), &Sky::default().sources());
        let balance = field.balance();
        let off = balance.sent - balance.kept - balance.stopped - balance.passed;
        assert!(off.abs() < 1e-9 * balance.sent, "{balance:?}");
        assert!(balance.kept > 1.0 && balance.stopped > 0.1 && balance.passed > 1.0, "{balance:?}");
        let of_voxels: f64 = field.kept.iter().sum();
        assert!((of_voxels - balance.kept).abs() < 1e-9 * balance.sent, "{of_voxels} {balance:?}");
        assert!(field.light.iter().all(|share| (0.0..=1.0).contains(share)));
        if lighting.borders == Borders::Open {
            continue;
        }
        assert!((balance.sent - 3.1 * 3.3).abs() < 1e-9, "{balance:?}");
    }
}

#[test]
fn neither_threads_nor_the_order_of_plants_show() {
    let sources = Sky { rings: 3, azimuths: 7, ..Sky::default() }.sources();
    for lighting in lightings() {
        let order: Vec<u32> = (0..9).collect();
        let known = Field::of(&lighting, &Heaps(order.clone()), &sources);
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let mut order = order.clone();
            order.rotate_left(threads);
            order.reverse();
            let field = pool.install(|| Field::of(&lighting, &Heaps(order), &sources));
            assert!(field == known, "{threads} threads");
        }
    }
}

/// Light in open ground is whole: nothing stands between the sky and the lone bud of a plant without leaves.
#[test]
fn without_leaves_there_is_no_shade() {
    struct Bare;
    impl Canopy for Bare {
        fn plants(&self) -> usize {
            1
        }
        fn pieces(&self, _: usize, _: f64, _: &mut dyn FnMut(Piece)) {}
        fn buds(&self, _: usize, show: &mut dyn FnMut(usize, Point)) {
            show(0, [0.33, 0.11, 0.0]);
        }
    }
    let field = Field::of(&Lighting::default(), &Bare, &Sky::default().sources());
    assert!((field.share_at([0.33, 0.11, 0.0]) - 1.0).abs() < 1e-12);
    assert!((field.share_at([90.0, -40.0, 7.0]) - 1.0).abs() < 1e-12);
    assert_eq!(field.balance().kept, 0.0);
}
