//! A flower of petals around the mouth of a tube, or around a receptacle on a stalk, with its stamens.
//!
//! Petals are blades. Each is turned a little about its own axis, so that one edge lies over the next petal and the
//! other below the one before (contorted, as in a phlox). Where petals that touch narrow to the mouth, a funnel closes
//! it. Absent: heads of many florets (`capitulum`).

use super::super::{Depth, FormMesh};
use super::build::{Build, Vector, sum};
use super::sheet::{self, Place};
use phytomer_looks::{Apex, Base, Blade, Flower};
use phytomer_sim::math::sincosf;
use std::f32::consts::TAU;

/// The colour of anthers, and how far it covers that of the flower.
const ANTHER: [u8; 4] = [226, 178, 60, 255];

/// The colour of sepals, and its share of 255.
const SEPAL: [u8; 4] = [122, 150, 82, 255];

/// How far a petal is turned about its own axis, radians.
const CONTORTED: f32 = 0.09;

/// A flower of a width over its length.
pub fn flower(flower: &Flower, aspect: f32, detail: u8) -> FormMesh {
    let mut build = Build::default();
    let mouth = 0.5 * flower.tube_width * aspect;
    tube(&mut build, flower, mouth, detail);
    let (sin, cos) = sincosf(flower.spread_deg.to_radians());
    let length = (0.5 * aspect - mouth) / sin.max(0.1);
    throat(&mut build, flower, (mouth, length), ([sin, cos], detail));
    sepals(&mut build, flower, (mouth, length), detail);
    for petal in 0..flower.petals {
        let out = around(f32::from(petal) / f32::from(flower.petals));
        let place = petal_at([flower.tube, mouth], out, [sin, cos], length, flower.petal_width);
        sheet::blade(&mut build, &flower.petal, &Place { phase: 0.31 * f32::from(petal), ..place }, detail);
    }
    stamens(&mut build, flower, aspect, detail);
    build.fit(0.5 * aspect);
    build.into_form(aspect, Depth::Width, false)
}

/// The direction out of the axis at a share of a turn.
pub fn around(share: f32) -> Vector {
    let (sin, cos) = sincosf(TAU * share);
    [0.0, cos, sin]
}

/// A petal that stands on a ring around the axis, at an angle with this sine and cosine to it; its upper side faces
/// the axis.
pub fn petal_at([along, ring]: [f32; 2], out: Vector, [sin, cos]: [f32; 2], length: f32, width: f32) -> Place {
    let ahead = sum(&[(cos, [1.0, 0.0, 0.0]), (sin, out)]);
    let up = sum(&[(sin, [1.0, 0.0, 0.0]), (-cos, out)]);
    let left = super::build::cross(up, ahead);
    let (turn_sin, turn_cos) = sincosf(CONTORTED);
    Place {
        base: sum(&[(1.0, [along, 0.0, 0.0]), (ring, out)]),
        along: ahead,
        left: sum(&[(turn_cos, left), (turn_sin, up)]),
        up: sum(&[(turn_cos, up), (-turn_sin, left)]),
        length,
        width: width * length,
        phase: 0.0,
    }
}

/// The funnel from the mouth to where the edges of neighbouring petals meet: below that they are one.
fn throat(build: &mut Build, flower: &Flower, (mouth, length): (f32, f32), ([sin, cos], detail): ([f32; 2], u8)) {
    let half_turn = std::f32::consts::PI / f32::from(flower.petals);
    let (turn_sin, turn_cos) = sincosf(half_turn);
    let meets = |u: &f32| {
        let out = mouth + u * length * sin;
        flower.petal.rim(*u).aside * flower.petal_width * length * turn_cos >= out * turn_sin
    };
    let Some(meet) = (1..=20).map(|k| 0.02 * k as f32).find(meets) else { return };
    let sides = u16::from(flower.petals) * [1, 2, 3, 5][usize::from(detail.min(3))];
    let mut before: Vec<u32> = Vec::new();
    for share in [0.0, 0.5, 1.0, 1.5] {
        // A little below the petals, which lie on it.
        let along = flower.tube + share * meet * length * cos - 0.012 * share;
        let out = mouth * 0.98 + share * meet * length * sin;
        let ring: Vec<u32> = (0..=sides)
            .map(|side| {
                let turn = f32::from(side % sides) / f32::from(sides);
                let across = sum(&[(out, around(turn))]);
                build.corner([along, across[1], across[2]], across, [0.5, share * meet])
            })
            .collect();
        for (from, to) in before.windows(2).zip(ring.windows(2)) {
            build.quad([from[0], to[0], to[1], from[1]]);
        }
        before = ring;
    }
}

/// The sepals, between the petals and below them.
fn sepals(build: &mut Build, flower: &Flower, (mouth, length): (f32, f32), detail: u8) {
    let sepal = Blade {
        stalk: 0.0,
        widest_at: 0.3,
        base: Base::Truncate,
        apex: Apex::Acute,
        fold_deg: 0.0,
        cup: 0.2,
        veins: 0,
        arch_deg: 0.0,
        ..Blade::default()
    };
    let (sin, cos) = sincosf(flower.sepal_deg.to_radians());
    build.tint = SEPAL;
    for number in 0..flower.sepals {
        let out = around((f32::from(number) + 0.5) / f32::from(flower.sepals));
        let place = petal_at([flower.tube - 0.02, mouth], out, [sin, cos], flower.sepal * length, 0.45);
        sheet::blade(build, &sepal, &place, detail.saturating_sub(1).max(1));
    }
    build.tint = super::build::PLAIN;
}

/// The tube, as wide at its mouth as the ring of petals.
fn tube(build: &mut Build, flower: &Flower, mouth: f32, detail: u8) {
    let sides = [5, 6, 10, 16][usize::from(detail.min(3))];
    let places = [(0.0, 0.7), (0.08, 0.75), (0.6, 0.7), (0.9, 0.85), (1.0, 1.0)];
    let line: Vec<(Vector, f32)> =
        places.iter().map(|(share, wide)| ([share * flower.tube, 0.0, 0.0], wide * mouth)).collect();
    build.stalk = true;
    sheet::tube(build, &line, [0.0, 0.0, 1.0], sides);
    build.stalk = false;
}

/// Filaments that lean out of the mouth, each with its anther.
fn stamens(build: &mut Build, flower: &Flower, aspect: f32, detail: u8) {
    if detail < 2 {
        return;
    }
    let length = 0.5 * aspect * flower.stamen;
    for stamen in 0..flower.stamens {
        // Rings of five, each leaning less than the one outside of it.
        let lean = 0.9 - 0.6 * f32::from(stamen) / f32::from(flower.stamens.max(1));
        let (sin, cos) = sincosf(lean * 0.8);
        let out = around(f32::from(stamen) * 0.381_966);
        let ahead = sum(&[(cos, [1.0, 0.0, 0.0]), (sin, out)]);
        let base = [flower.tube, 0.0, 0.0];
        let at = |share: f32| sum(&[(1.0, base), (length * share, ahead)]);
        let thin = 0.018 * length;
        build.tint = [250, 246, 225, 200];
        sheet::tube(build, &[(at(0.0), thin), (at(0.88), 0.7 * thin)], out, 3);
        build.tint = ANTHER;
        let wide = [(0.84, 0.3), (0.88, 1.0), (0.96, 1.0), (1.0, 0.3)];
        let line: Vec<(Vector, f32)> = wide.iter().map(|(share, wide)| (at(*share), 0.055 * length * wide)).collect();
        sheet::tube(build, &line, out, 3 + u16::from(detail));
    }
    build.tint = super::build::PLAIN;
}
