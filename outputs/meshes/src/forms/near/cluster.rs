//! Flowers or fruits that stand together at a node, each on its stalk or none.
//!
//! They stand golden angles apart around the axis, evenly over the cap of a sphere, and reach the side of the box;
//! those of a bunch stand around its middle and fill an ellipsoid.
//! Where an area is stated each is larger or smaller about the end of its own stalk. Absent: their number and their
//! kind (`phytomer_looks::Cluster`).

use super::super::{Depth, FormMesh, Point, scaled_normal};
use super::build::{Build, Vector, cross, sum, unit};
use super::{flower, made, rounder, sheet};
use phytomer_looks::{Cluster, GOLDEN_DEG};
use phytomer_sim::math::sincosf;

/// A cluster of a width over its length.
pub fn cluster(cluster: &Cluster, aspect: f32, detail: u8) -> FormMesh {
    let mut build = Build::default();
    let part = part_of(cluster, detail);
    let (widest, least) = sincosf(cluster.spread_deg.to_radians());
    // At a node all are of one length, with which the outermost reach the side of the box.
    let equal = (0.5 * aspect / if least < 0.0 { 1.0 } else { widest.max(0.3) }).min(1.0);
    let middle = [cluster.middle, 0.0, 0.0];
    for number in 0..cluster.count {
        // Even over the cap of a sphere.
        let share = (f32::from(number) + 0.5) / f32::from(cluster.count);
        let cos = 1.0 - share * (1.0 - least);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let out = flower::around((f32::from(number) * GOLDEN_DEG % 360.0) / 360.0);
        let ahead = sum(&[(cos, [1.0, 0.0, 0.0]), (sin, out)]);
        let reach = if cluster.middle > 0.0 {
            // An ellipsoid from the base of the box to its end.
            let half = if cos < 0.0 { cluster.middle } else { 1.0 - cluster.middle };
            let [along, aside] = [cos / half, sin / (0.5 * aspect).max(1e-3)];
            1.0 / (along * along + aside * aside).sqrt().max(1e-3)
        } else {
            equal
        };
        stand(&mut build, &part, (middle, ahead, reach), cluster);
    }
    if cluster.middle > 0.0 {
        // What bears them, which is seen between them.
        let wide = 0.5 * aspect * (0.4 + 0.6 * cluster.stalk);
        let line = [(0.0, 0.25), (0.12, 0.5), (0.3, 0.85), (0.5, 1.0), (0.7, 0.85), (0.88, 0.5), (0.97, 0.1)];
        let line = line.map(|(along, out)| ([along, 0.0, 0.0], out * wide));
        build.stalk = true;
        sheet::tube(&mut build, &line, [0.0, 0.0, 1.0], 6 + 2 * u16::from(detail));
        build.stalk = false;
    }
    build.into_form(aspect, Depth::Width, true)
}

/// One of them in its unit box.
fn part_of(cluster: &Cluster, detail: u8) -> FormMesh {
    // Each is small: the grid of one by itself at the next lower detail.
    let grid = detail.saturating_sub(1).max(1);
    match (&cluster.flower, cluster.form.near()) {
        (Some(flower), _) => flower::flower(flower, cluster.width, grid),
        (None, Some(near)) => made(&near, cluster.width, grid),
        (None, None) => {
            let shape = super::super::shape(cluster.form.form());
            // At detail 1 they share the corners of their triangles, so that many of them fit into a form.
            if detail < 2 { shape.clone() } else { rounder::rounder(shape, u32::from(detail)) }
        }
    }
}

/// Adds one of them on its stalk.
fn stand(build: &mut Build, part: &FormMesh, (middle, ahead, reach): (Vector, Vector, f32), cluster: &Cluster) {
    let foot = cluster.stalk * reach;
    let base = sum(&[(1.0, middle), (foot, ahead)]);
    let length = reach - foot;
    if cluster.stalk > 0.02 && cluster.middle <= 0.0 {
        let thin = 0.03 * length * cluster.width.min(1.0);
        build.stalk = true;
        sheet::tube(build, &[([0.0; 3], thin), (sum(&[(1.02, base)]), thin)], [0.0, 0.0, 1.0], 4);
        build.stalk = false;
    }
    let up = unit(sum(&[(1.0, [1.0, 0.0, 0.0]), (-ahead[0], ahead)]));
    let left = cross(up, ahead);
    let wide = length * cluster.width;
    let deep = if part.depth() == Depth::Width { wide } else { length };
    let first: Vec<u32> = (part.points.iter())
        .map(|&Point { at: [x, y, z], normal, texture, stalk, tint, .. }| {
            let across = sum(&[(x * length, ahead), (y * wide, left), (z * deep, up)]);
            let [a, b, c] = scaled_normal(normal, [wide * deep, length * deep, length * wide]);
            let normal = sum(&[(a, ahead), (b, left), (c, up)]);
            build.shaped(Point { at: sum(&[(1.0, base), (1.0, across)]), across, normal, texture, stalk, tint })
        })
        .collect();
    part.faces.iter().for_each(|face| build.face(face.map(|corner| first[corner as usize])));
}
