//! Forms with fewer triangles, for organs of which little is seen: plane polygons lose corners, and stalks go.
//!
//! A corner is left out where what remains of its polygon lies near it. Each coarser form knows how far it lies from
//! the full one along each side of the box, so that an organ of any size can ask for the coarsest that serves it; it
//! has its own area, by which organs keep theirs ([`FormMesh::fullness`]). Absent: forms with triangles outside of
//! plane polygons, such as fruits, which stay as they are.

use super::{FormMesh, Point};

/// A coarser form.
#[derive(Debug, Clone, PartialEq)]
pub struct Coarse {
    /// Its mesh.
    pub mesh: FormMesh,
    /// The farthest that a corner of the full form lies from it, along each side of the box.
    pub off: [f32; 3],
}

impl Coarse {
    /// The farthest that a corner of an organ of this length and width lies from the full form, metres, where the
    /// organ has the width that its form states; the fullness by its area moves corners a little more or less.
    #[inline]
    pub fn distance(&self, [length, width]: [f32; 2]) -> f32 {
        let depth = if self.mesh.depth == super::Depth::Width { width } else { length };
        let off = [self.off[0] * length, self.off[1] * width, self.off[2] * depth];
        (off[0] * off[0] + off[1] * off[1] + off[2] * off[2]).sqrt()
    }
}

/// The coarser forms of a form, the finest first: polygons of at most four corners, of three, and of three without
/// stalks.
pub fn coarser(full: &FormMesh) -> Vec<Coarse> {
    let in_polygons: u32 = full.polygons.iter().map(|[_, corners]| corners - 2).sum();
    if in_polygons as usize != full.faces.len() || full.polygons.iter().any(|[_, corners]| *corners > MOST_CORNERS) {
        return Vec::new();
    }
    let mut all: Vec<Coarse> = Vec::new();
    for (corners, stalks) in [(4, true), (3, true), (3, false)] {
        let made = coarse(full, corners, stalks);
        let before = all.last().map_or(full.faces.len(), |coarse| coarse.mesh.faces.len());
        if !made.mesh.faces.is_empty() && made.mesh.faces.len() < before {
            all.push(made);
        }
    }
    all
}

/// The most corners of a polygon whose choices are tried one by one.
const MOST_CORNERS: u32 = 12;

fn coarse(full: &FormMesh, corners: u32, stalks: bool) -> Coarse {
    let mut mesh = FormMesh { in_parts: full.in_parts, ..FormMesh::new(full.depth) };
    for [first, count] in &full.polygons {
        let points = &full.points[*first as usize..][..*count as usize];
        if stalks || !points.iter().all(|point| point.stalk) {
            let kept = kept(points, corners);
            let start = mesh.points.len() as u32;
            mesh.polygons.push([start, kept.len() as u32]);
            mesh.faces.extend((1..kept.len() as u32 - 1).map(|k| [start, start + k, start + k + 1]));
            mesh.points.extend(kept);
        }
    }
    let mesh = mesh.measured();
    let off = off(full, &mesh);
    Coarse { mesh, off }
}

/// At most so many corners of a polygon, in their order, chosen so that the corners left out lie as near as can be.
fn kept(points: &[Point], corners: u32) -> Vec<Point> {
    if points.len() <= corners as usize {
        return points.to_vec();
    }
    let chosen = |choice: u32| points.iter().enumerate().filter(move |(k, _)| choice >> k & 1 == 1).map(|(_, p)| *p);
    let far = |choice: u32| {
        let rest: Vec<Point> = chosen(choice).collect();
        points.iter().map(|point| length(way_to(point.at, &rest))).fold(0.0, f32::max)
    };
    let choices = (0..1_u32 << points.len()).filter(|choice| choice.count_ones() == corners);
    let best = choices.map(|choice| (choice, far(choice))).min_by(|(_, a), (_, b)| a.total_cmp(b));
    best.map_or_else(|| points.to_vec(), |(choice, _)| chosen(choice).collect())
}

/// The farthest that the corners of a full form lie from a coarser one, along each side of the box, with what the
/// coarser one is wider for the area of the full one.
fn off(full: &FormMesh, coarse: &FormMesh) -> [f32; 3] {
    let mut off = [0.0_f32; 3];
    let polygons = || coarse.polygons.iter().map(|[first, count]| &coarse.points[*first as usize..][..*count as usize]);
    for point in &full.points {
        let ways = polygons().map(|polygon| way_to(point.at, polygon));
        let way = ways.min_by(|a, b| length(*a).total_cmp(&length(*b))).unwrap_or(point.at);
        (0..3).for_each(|k| off[k] = off[k].max(way[k].abs()));
    }
    // The shares hardly depend on the aspect; a blade of one to two stands for all.
    let wider = (full.area_share(0.5) / coarse.area_share(0.5).max(f64::MIN_POSITIVE)) as f32 - 1.0;
    for point in &coarse.points {
        let moved = if coarse.in_parts { point.across } else { [0.0, point.at[1], point.at[2]] };
        (0..3).for_each(|k| off[k] = off[k].max((wider * moved[k]).abs()));
    }
    off
}

/// The way from a place to the nearest place on the sides of a polygon.
fn way_to(place: [f32; 3], polygon: &[Point]) -> [f32; 3] {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let ways = sides.map(|(a, b)| {
        let (along, from) = ([0, 1, 2].map(|k| b.at[k] - a.at[k]), [0, 1, 2].map(|k| place[k] - a.at[k]));
        let dot = |u: [f32; 3], v: [f32; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let share = (dot(along, from) / dot(along, along).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        [0, 1, 2].map(|k| share * along[k] - from[k])
    });
    ways.min_by(|a, b| length(*a).total_cmp(&length(*b))).unwrap_or([f32::INFINITY; 3])
}

fn length(way: [f32; 3]) -> f32 {
    (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::shape;
    use super::*;
    use phytomer_looks::FormName;

    #[test]
    fn a_leaf_of_a_willow_is_two_triangles_from_afar() {
        let full = shape(FormName::Lanceolate.form());
        let faces: Vec<usize> = full.coarser().iter().map(|coarse| coarse.mesh.faces.len()).collect();
        assert_eq!((full.faces.len(), faces), (8, vec![6, 3, 2]));
        // Base, widest place and tip of each half; the stalk, 0.05 of the length and a little aside, lies farthest.
        let least = &full.coarser()[2];
        assert!((least.off[0] - 0.05).abs() < 0.002, "{:?}", least.off);
        assert!(least.distance([0.08, 0.012]) < 0.005 && least.distance([0.8, 0.12]) > 0.04);
    }

    #[test]
    fn coarser_forms_have_corners_of_the_full_one_and_no_corner_lies_farther_than_they_say() {
        for form in FormName::ALL {
            let full = shape(form.form());
            for coarse in full.coarser() {
                assert!(coarse.mesh.points.iter().all(|point| full.points.contains(point)), "{form:?}");
                assert!(coarse.mesh.faces.len() < full.faces.len(), "{form:?}");
                let size = [2.0, 0.7];
                let placed = |at: [f32; 3]| {
                    let depth = if full.depth == super::super::Depth::Width { size[1] } else { size[0] };
                    [at[0] * size[0], at[1] * size[1], at[2] * depth]
                };
                let placed = |point: &Point| Point { at: placed(point.at), ..*point };
                for point in &full.points {
                    let nearest = coarse.mesh.polygons.iter().map(|[first, count]| {
                        let polygon = &coarse.mesh.points[*first as usize..][..*count as usize];
                        let polygon: Vec<Point> = polygon.iter().map(placed).collect();
                        length(way_to(placed(point).at, &polygon))
                    });
                    assert!(nearest.fold(f32::INFINITY, f32::min) <= coarse.distance(size) + 1e-6, "{form:?}");
                }
            }
        }
    }
}
