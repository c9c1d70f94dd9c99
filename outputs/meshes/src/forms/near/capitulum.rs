//! The head of a sunflower: a receptacle with bracts, rays around it, and disc florets in the spirals of Vogel 1979.
//!
//! A floret is a bud, an open tube with a yellow rim, or withered over its seed; a ripe head shows the seeds. Each
//! stage has the same corners, so that a head can go from one to the next. The colours of the parts are their own; rays
//! are yellow. Absent: where a floret stands and how far it has opened (`phytomer_looks`).

use super::super::{Depth, FormMesh};
use super::build::{Build, Vector, sum};
use super::flower::{around, petal_at};
use super::sheet::{self, Place};
use phytomer_looks::{Apex, Base, Blade, Capitulum};
use phytomer_sim::math::sincosf;

/// The colours of parts, each over the whole of the head's own.
const GREEN: [u8; 4] = [104, 138, 64, 255];
const RAY: [u8; 4] = [246, 194, 30, 255];
const BUD: [f32; 3] = [118.0, 122.0, 52.0];
const OPEN: [f32; 3] = [214.0, 150.0, 34.0];
const WITHERED: [f32; 3] = [92.0, 56.0, 26.0];
const SEED: [f32; 3] = [62.0, 56.0, 52.0];

/// How far along the head its disc begins.
const RIM: f32 = 0.5;

/// A head of a width over its length.
pub fn capitulum(head: &Capitulum, aspect: f32, detail: u8) -> FormMesh {
    let mut build = Build::default();
    let radius = 0.5 * aspect;
    let disc = radius * head.disc;
    receptacle(&mut build, disc, detail);
    build.tint = GREEN;
    let sepal = Blade {
        widest_at: 0.3,
        base: Base::Truncate,
        apex: Apex::Acuminate,
        veins: 0,
        stalk: 0.0,
        fold_deg: 0.0,
        ..Blade::default()
    };
    leaves(
        &mut build,
        &sepal,
        (head.bracts, 0.7 * (radius - disc).max(0.5 * disc), 0.4),
        (RIM - 0.14, 0.8 * disc, 84.0),
        1,
    );
    build.tint = RAY;
    let ray = Blade {
        widest_at: 0.5,
        base: Base::Cuneate,
        apex: Apex::Convex,
        fold_deg: 6.0,
        cup: -0.12,
        arch_deg: 22.0,
        veins: 2,
        stalk: 0.0,
        ..Blade::default()
    };
    // Rays of a young head stand up around the disc, and spread as they unfold.
    let spread = 12.0 + 70.0 * head.unfolded;
    let fine = if head.rays > 50 { 1 } else { detail.saturating_sub(1).max(1) };
    leaves(
        &mut build,
        &ray,
        (head.rays, 1.06 * (radius - disc).max(0.0), 0.3),
        (RIM + 0.02, 0.97 * disc, spread),
        fine,
    );
    florets(&mut build, head, disc, detail);
    build.tint = super::build::PLAIN;
    build.into_form(aspect, Depth::Width, false)
}

/// The green back of the head, from the neck to the rim, and the floor under the florets.
fn receptacle(build: &mut Build, disc: f32, detail: u8) {
    let line = [(0.0, 0.1), (0.1, 0.3), (0.28, 0.72), (0.42, 0.98), (RIM, 1.0), (RIM + 0.04, 0.9)];
    let line: Vec<(Vector, f32)> = line.iter().map(|(along, out)| ([*along, 0.0, 0.0], out * disc)).collect();
    build.tint = GREEN;
    sheet::tube(build, &line, [0.0, 0.0, 1.0], 8 * (u16::from(detail) + 1));
}

/// Blades around the rim, in two rings that alternate: their number, length and width over it; the place of the ring,
/// and their angle to the axis.
fn leaves(
    build: &mut Build,
    blade: &Blade,
    (count, length, width): (u8, f32, f32),
    (along, ring, degrees): (f32, f32, f32),
    detail: u8,
) {
    for number in 0..count {
        let inner = f32::from(number % 2);
        let (sin, cos) = sincosf((degrees - 7.0 * inner).to_radians());
        let out = around(f32::from(number) / f32::from(count));
        // No two rays of a head are of one length.
        let own = length * (0.92 + 0.08 * sincosf(2.4 * f32::from(number)).0);
        let place = petal_at([along + 0.01 * inner, ring], out, [sin, cos], own, width);
        sheet::blade(build, blade, &Place { phase: 0.3 * f32::from(number), ..place }, detail);
    }
}

/// The florets, each a small column with a tip.
fn florets(build: &mut Build, head: &Capitulum, disc: f32, detail: u8) {
    let sides: u16 = match head.florets {
        _ if detail < 2 => 3,
        0..=900 => 5,
        901..=1200 => 4,
        _ => 3,
    };
    let opened = head.opened.unwrap_or(0.5);
    let wide = 0.46 * disc * (std::f32::consts::PI / f32::from(head.florets.max(1))).sqrt();
    for floret in 0..head.florets {
        let [out, turn] = head.place(floret);
        let (sin, cos) = sincosf(turn);
        let far: Vector = [0.0, cos, sin];
        // The disc is vaulted: highest in its middle, and florets lean outwards.
        let base =
            sum(&[(0.96 * out * disc, far), (RIM + 0.03 + 2.0 * head.vault * (1.0 - out * out), [1.0, 0.0, 0.0])]);
        let lean = 4.0 * head.vault * out / disc.max(0.05);
        let ahead = super::build::unit(sum(&[(1.0, [1.0, 0.0, 0.0]), (lean.min(1.0) * 0.5, far)]));
        let open = head.opening(floret, opened);
        column(build, head, (base, ahead, far), (wide, open, sides));
    }
}

/// One floret: how wide, how far open, and of how many sides.
fn column(
    build: &mut Build,
    head: &Capitulum,
    (base, ahead, far): (Vector, Vector, Vector),
    (wide, open, sides): (f32, f32, u16),
) {
    let aside = super::build::cross(ahead, far);
    // Open florets stand above buds and above those that have withered.
    let stands = 4.0 * open * (1.0 - open);
    let (height, rim) = if head.seeds { (1.1, 0.85) } else { (1.3 + 1.5 * stands, 0.55 + 0.35 * stands) };
    let colour = match head.seeds {
        true => SEED,
        false if open < 0.5 => mixed(BUD, OPEN, 2.0 * open),
        false => mixed(OPEN, WITHERED, 2.0 * open - 1.0),
    };
    let [red, green, blue] = colour.map(|x| x as u8);
    build.tint = [red, green, blue, 255];
    let ring = |build: &mut Build, up: f32, by: f32| -> Vec<u32> {
        (0..sides)
            .map(|side| {
                let (sin, cos) = sincosf(std::f32::consts::TAU * f32::from(side) / f32::from(sides));
                let at = sum(&[(1.0, base), (up * wide, ahead), (by * wide * cos, far), (by * wide * sin, aside)]);
                build.corner(at, [0.0; 3], [f32::from(side) / f32::from(sides), up])
            })
            .collect()
    };
    let (low, high) = (ring(build, 0.0, 0.95), ring(build, height, rim));
    let tip = if head.seeds { height + 0.5 } else { height + 0.6 - 0.9 * stands };
    let tip = build.corner(sum(&[(1.0, base), (tip * wide, ahead)]), [0.0; 3], [0.5, 1.0]);
    for side in 0..usize::from(sides) {
        let next = (side + 1) % usize::from(sides);
        build.quad([low[side], low[next], high[next], high[side]]);
        build.face([high[side], high[next], tip]);
    }
}

fn mixed(from: [f32; 3], to: [f32; 3], share: f32) -> [f32; 3] {
    [0, 1, 2].map(|k| from[k] + (to[k] - from[k]) * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// The places of the tips of the florets across the axis, in their order.
    fn tips(head: &Capitulum) -> Vec<[f32; 2]> {
        let form = capitulum(head, 4.0, 3);
        let leafy = |tint: [u8; 4]| tint == GREEN || tint == RAY;
        let tips = form.points.iter().filter(|point| point.texture == [0.5, 1.0] && !leafy(point.tint));
        tips.map(|point| [point.at[1], point.at[2]]).collect()
    }

    /// The differences of number between florets of a ring and the nearest that they touch, by how often they occur.
    fn steps(tips: &[[f32; 2]], ring: std::ops::Range<usize>) -> Vec<usize> {
        let far = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for floret in ring {
            let mut others: Vec<usize> = (0..tips.len()).filter(|other| *other != floret).collect();
            others.sort_by(|a, b| far(tips[*a], tips[floret]).total_cmp(&far(tips[*b], tips[floret])));
            others[..4].iter().for_each(|other| *counts.entry(other.abs_diff(floret)).or_insert(0) += 1);
        }
        let mut steps: Vec<(usize, usize)> = counts.into_iter().map(|(step, count)| (count, step)).collect();
        steps.sort_by(|a, b| b.cmp(a));
        steps.into_iter().map(|(_, step)| step).collect()
    }

    /// How many spirals of a step reach the rim: those of their florets that have none outside of them.
    fn spirals(florets: usize, step: usize) -> usize {
        (0..florets).filter(|floret| floret + step >= florets).count()
    }

    #[test]
    fn contact_parastichies_are_neighbouring_fibonacci_numbers() {
        const FIBONACCI: [usize; 10] = [2, 3, 5, 8, 13, 21, 34, 55, 89, 144];
        for florets in [200, 800, 1500] {
            let tips = tips(&Capitulum { florets, ..Capitulum::default() });
            assert_eq!(tips.len(), usize::from(florets));
            let steps = steps(&tips, tips.len() * 7 / 10..tips.len() * 8 / 10);
            let mut pair = [steps[0], steps[1]];
            pair.sort_unstable();
            let place = FIBONACCI.iter().position(|number| *number == pair[0]).expect("a Fibonacci number");
            assert_eq!(pair[1], FIBONACCI[place + 1], "{florets}: {steps:?}");
            // A step m goes out by c m / 2√i and around by 2π c √i / √5 m: both are equal where m² = 4π i / √5.
            let equal = 4.0 * std::f64::consts::PI * 0.75 * f64::from(florets) / 5.0_f64.sqrt();
            let found = (pair[0] * pair[1]) as f64 / equal;
            assert!((0.5..2.0).contains(&found), "{florets}: {pair:?}");
            assert_eq!(pair.map(|step| spirals(tips.len(), step)), pair);
        }
    }

    #[test]
    fn florets_open_from_the_rim_inwards_and_stages_have_the_same_corners() {
        let head = Capitulum::default();
        let opening = |opened: f32| (0..head.florets).map(move |floret| head.opening(floret, opened));
        for opened in [0.1, 0.3, 0.6, 0.9] {
            assert!(opening(opened).collect::<Vec<_>>().is_sorted(), "{opened}");
        }
        assert!(opening(0.0).all(|open| open == 0.0) && opening(1.0).skip(40).all(|open| open > 0.9));
        let corners = |opened: f32| capitulum(&Capitulum { opened: Some(opened), ..head }, 4.0, 3).faces.len();
        assert_eq!(corners(0.0), corners(1.0));
        assert!(capitulum(&head, 4.0, 3).points.len() < 20_000);
    }
}
