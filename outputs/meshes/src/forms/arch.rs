//! Blades that bend along their length: grass and banana leaves, petals and sepals, each of at most four plane
//! polygons.
//!
//! A blade that arches is four stretches of a strip, one after another; its length runs along the bend. A petal is two
//! stretches folded along the middle, hollow above (plane polygons, as in de Reffye 1988 §6). Absent: stalks.

use super::{Depth, FormMesh, along};
use phytomer_sim::math::sincosf;

/// The half widths of a strip at the ends of its four stretches.
type Widths = [f32; 5];

/// A grass leaf: it leaves its stem steeply and bends over through more than a right angle.
pub fn arching() -> FormMesh {
    strip(1.9, [0.36, 0.5, 0.46, 0.3, 0.0])
}

/// A banana leaf: narrow as its stalk at the base, then a broad oblong that hangs at the end.
pub fn paddle() -> FormMesh {
    strip(1.1, [0.07, 0.44, 0.5, 0.42, 0.12])
}

/// A petal: a claw below, broad and hollow above, its rim bent back a little.
pub fn petal() -> FormMesh {
    let spine = [[0.0, 0.0], [0.5, 0.05], [1.0, -0.06]];
    hollow(spine, &[[0.0, 0.09], [0.7, 0.4], [1.0, 0.46]], &[[0.0, 0.46], [0.5, 0.5], [0.85, 0.34], [1.0, 0.1]])
}

/// A sepal: broad below, pointed above.
pub fn sepal() -> FormMesh {
    let spine = [[0.0, 0.0], [0.45, 0.02], [1.0, 0.12]];
    hollow(spine, &[[0.0, 0.34], [0.5, 0.47], [1.0, 0.48]], &[[0.0, 0.48], [0.3, 0.44], [1.0, 0.0]])
}

/// Four stretches along an arc of `bend` radians, which starts along x and turns down.
fn strip(bend: f32, widths: Widths) -> FormMesh {
    let mut shape = FormMesh::new(Depth::Length);
    let spine: Vec<[f32; 2]> = (0..=4_u8)
        .map(|k| {
            let (sin, cos) = sincosf(bend * f32::from(k) / 4.0);
            [sin / bend, (cos - 1.0) / bend]
        })
        .collect();
    for (k, (ends, wide)) in spine.windows(2).zip(widths.windows(2)).enumerate() {
        let [[x, z], [beyond_x, beyond_z]] = [ends[0], ends[1]];
        let mut corners = vec![[x, wide[0], z], [x, -wide[0], z], [beyond_x, -wide[1], beyond_z]];
        if wide[1] > 0.0 {
            corners.push([beyond_x, wide[1], beyond_z]);
        }
        let share = |[x, ..]: [f32; 3]| if x == ends[0][0] { k as f32 / 4.0 } else { (k + 1) as f32 / 4.0 };
        shape.polygon(&corners, |at| [0.5 + at[1], share(at)], false);
    }
    shape
}

/// Two segments along a spine (points along x and z), each of two halves. A half is given by pairs: the share of the
/// segment, and the half width there. The edges rise by half of the half width.
fn hollow(spine: [[f32; 2]; 3], lower: &[[f32; 2]], upper: &[[f32; 2]]) -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    for (ends, outline) in spine.windows(2).zip([lower, upper]) {
        let on_spine = |share: f32| [0, 1].map(|k| ends[0][k] + share * (ends[1][k] - ends[0][k]));
        let edge = |&[share, wide]: &[f32; 2], side: f32| {
            let [x, z] = on_spine(share);
            [x, side * wide, z + 0.5 * wide]
        };
        let middle = [on_spine(0.0), on_spine(1.0)].map(|[x, z]| [x, 0.0, z]);
        let closes = outline.iter().filter(|place| place[1] > 0.0);
        let right: Vec<_> =
            [middle[0]].into_iter().chain(closes.clone().map(|place| edge(place, -1.0))).chain([middle[1]]).collect();
        let left: Vec<_> =
            [middle[1]].into_iter().chain(closes.rev().map(|place| edge(place, 1.0))).chain([middle[0]]).collect();
        shape.polygon(&right, along, false);
        shape.polygon(&left, along, false);
    }
    shape
}
