//! Internodes that are blades, drawn as pieces of one smooth blade, where detail is asked for: petals and sepals made
//! of a chain of internodes (de Reffye 1988 §5).
//!
//! A piece goes from the base of its internode to its tip along a cubic curve, with the mean directions of neighbours
//! at both ends, and its width follows a curve without overshoot (Fritsch & Butland 1984); so pieces meet without an
//! edge. It is hollow on its upper side. A chain that ends broad is rounded there and a little notched. A piece may
//! have a narrow lobe on either side, as the outer sepals of a rose have. Absent: strips of detail 0 (`tube`).

use super::chunk::{Tag, Vertex};
use super::tube::{Frustum, cross};

/// How high the edges of a blade stand, as a share of half its width.
const HOLLOW: f32 = 0.24;
/// How far the rim at a broad end stands beyond the middle, as a share of half the width.
const NOTCH: f32 = 0.2;
/// How far a lobe stands out, in halves of the width.
const LOBE: f32 = 2.2;
/// Half the length of a lobe's foot, as a share of its internode.
const FOOT: f32 = 0.24;
/// The step of the differences by which normals are found.
const STEP: f32 = 0.02;

/// The grid of a piece.
#[derive(Debug)]
pub struct Lamina {
    rows: u16,
    columns: u16,
    faces: Vec<[u32; 3]>,
}

/// An internode with those before and after it on its axis, where they stand.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    /// The internode.
    pub own: Frustum,
    /// The one before it.
    pub before: Option<Frustum>,
    /// The one after it.
    pub after: Option<Frustum>,
    /// Whether it has a lobe on its right and on its left.
    pub lobed: [bool; 2],
}

impl Lamina {
    /// The grid at a detail from 1.
    pub fn new(detail: u8) -> Self {
        let (rows, columns) = [(1, 2), (3, 4), (5, 6), (10, 12)][usize::from(detail.min(3))];
        let at = |row: u16, column: u16| u32::from(row * (columns + 1) + column);
        let quads = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let faces = quads.flat_map(|(row, column)| {
            let [a, b, c, d] = [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
            [[a, b, c], [a, c, d]]
        });
        Self { rows, columns, faces: faces.collect() }
    }

    /// The number of its vertices.
    pub fn vertices(&self) -> usize {
        usize::from(self.rows + 1) * usize::from(self.columns + 1)
    }

    /// Its triangles.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Writes its vertices; `out` must have a place for each.
    pub fn write(&self, piece: &Piece, tag: &Tag, out: &mut [Vertex]) {
        let places = (0..=self.rows).flat_map(|row| (0..=self.columns).map(move |column| (row, column)));
        for ((row, column), vertex) in places.zip(out) {
            let u = f32::from(row) / f32::from(self.rows);
            // From its right to its left.
            let v = 2.0 * f32::from(column) / f32::from(self.columns) - 1.0;
            *vertex = Vertex::new(piece.at(u, v), piece.normal(u, v), [0.5 + 0.5 * v, u], tag);
        }
    }
}

impl Piece {
    /// The place at a share of its length, and of half its width to its left.
    fn at(&self, u: f32, v: f32) -> [f32; 3] {
        let own = &self.own;
        let [start, end] = self.ends(|frustum| frustum.heading).map(unit);
        let tip = [0, 1, 2].map(|k| own.base[k] + own.length * own.heading[k]);
        let [a, b] = [u * u * (3.0 - 2.0 * u), u * (1.0 - u)];
        let (away, arriving) = (b * (1.0 - u) * own.length, -b * u * own.length);
        let middle = [0, 1, 2].map(|k| own.base[k] + a * (tip[k] - own.base[k]) + away * start[k] + arriving * end[k]);
        let along = unit([0, 1, 2].map(|k| start[k] + u * (end[k] - start[k])));
        let [low, high] = self.ends(|frustum| frustum.up);
        let up = [0, 1, 2].map(|k| low[k] + u * (high[k] - low[k]));
        let left = unit(cross(up, along));
        let up = cross(along, left);
        let (half, beyond) = self.half(u);
        let lobe = if self.lobed[usize::from(v > 0.0)] { lobe(u) * v * v } else { 0.0 };
        let (aside, lift) = (half * v * (1.0 + LOBE * lobe), HOLLOW * half * v * v);
        let ahead = beyond * v * v + 0.8 * LOBE * half * lobe;
        [0, 1, 2].map(|k| middle[k] + aside * left[k] + lift * up[k] + ahead * along[k])
    }

    /// The mean of its own direction and that of its neighbour, at its base and at its tip.
    fn ends(&self, of: impl Fn(&Frustum) -> [f32; 3]) -> [[f32; 3]; 2] {
        let own = of(&self.own);
        [self.before, self.after].map(|other| {
            other.as_ref().map_or(own, |other| {
                let other = of(other);
                [0, 1, 2].map(|k| 0.5 * (own[k] + other[k]))
            })
        })
    }

    /// Half its width at a share of its length, and how far its rim stands ahead of its middle.
    fn half(&self, u: f32) -> (f32, f32) {
        let [base, tip] = self.own.radii;
        let rise = tip - base;
        let slope = |other: f32| if other * rise > 0.0 { 2.0 * other * rise / (other + rise) } else { 0.0 };
        let share = |other: &Frustum| self.own.length / other.length.max(1e-9);
        let first = self.before.map_or(rise, |before| slope((before.radii[1] - before.radii[0]) * share(&before)));
        let last = self.after.map_or(rise, |after| slope((after.radii[1] - after.radii[0]) * share(&after)));
        let [a, b] = [u * u * (3.0 - 2.0 * u), u * (1.0 - u)];
        let smooth = base + a * rise + b * (1.0 - u) * first - b * u * last;
        if self.after.is_some() {
            return (smooth, 0.0);
        }
        let broad = 2.0 * tip > self.own.length;
        if broad {
            // A round end: a quarter of a superellipse over the last internode.
            ((base + 0.4 * rise * u) * (1.0 - u * u * u).max(0.0).sqrt(), NOTCH * base * u * u)
        } else {
            (base * (1.0 - u * u).max(0.0).sqrt().min(1.0 - 0.6 * u), 0.0)
        }
    }

    /// The unit normal on its upper side, by differences.
    fn normal(&self, u: f32, v: f32) -> [f32; 3] {
        let inner = (u.clamp(STEP, 1.0 - 2.0 * STEP), v.clamp(STEP - 1.0, 1.0 - STEP));
        let minus = |a: [f32; 3], b: [f32; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
        let along = minus(self.at(inner.0 + STEP, inner.1), self.at(inner.0 - STEP, inner.1));
        let aside = minus(self.at(inner.0, inner.1 + STEP), self.at(inner.0, inner.1 - STEP));
        let normal = cross(along, aside);
        let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
        if length > 1e-20 { normal.map(|x| x / length) } else { unit(self.own.up) }
    }
}

/// How far a lobe stands out at a share of its internode, in [0, 1].
fn lobe(u: f32) -> f32 {
    let beside = ((u - 0.4) / FOOT).abs().min(1.0);
    (1.0 - beside) * (1.0 - beside) * (1.0 + 2.0 * beside)
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length > 1e-20 { v.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::super::measure::assert_unit_normals;
    use super::*;
    use bytemuck::Zeroable;

    fn chain(radii: [f32; 2], base: f32) -> Frustum {
        Frustum { base: [base, 0.0, 0.0], heading: [1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0], length: 0.01, radii }
    }

    fn drawn(piece: &Piece, detail: u8) -> Vec<Vertex> {
        let lamina = Lamina::new(detail);
        let tag = Tag { colour: [0; 4], birth: 0.0, death: 1.0, component: 0, kind: 0 };
        let mut out = vec![Vertex::zeroed(); lamina.vertices()];
        lamina.write(piece, &tag, &mut out);
        out
    }

    /// Pieces meet in the same points with nearly the same normals, and widths never overshoot those of both ends.
    #[test]
    fn pieces_of_a_chain_meet_without_an_edge() {
        let [a, b, c] = [chain([0.003, 0.008], 0.0), chain([0.008, 0.01], 0.01), chain([0.01, 0.009], 0.02)];
        let first = Piece { own: a, before: None, after: Some(b), lobed: [false; 2] };
        let second = Piece { own: b, before: Some(a), after: Some(c), lobed: [false; 2] };
        for detail in 1..=3 {
            let columns = usize::from(Lamina::new(detail).columns) + 1;
            let (low, high) = (drawn(&first, detail), drawn(&second, detail));
            assert_unit_normals(&low);
            for (end, start) in low[low.len() - columns..].iter().zip(&high) {
                let off = |a: [f32; 3], b: [f32; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max);
                assert!(off(end.position(), start.position()) < 1e-7);
                assert!(off(end.normal(), start.normal()) < 0.08, "{detail}");
            }
            assert!(high.iter().all(|vertex| vertex.position()[1].abs() <= 0.010_01));
        }
    }

    #[test]
    fn a_broad_end_is_round_and_notched_and_a_narrow_one_pointed() {
        let before = Some(chain([0.01, 0.012], -0.01));
        let broad = Piece { own: chain([0.012, 0.01], 0.0), before, after: None, lobed: [false; 2] };
        let far = |piece: &Piece| drawn(piece, 3).iter().map(|v| v.position()[0]).fold(0.0, f32::max);
        assert!(far(&broad) > 0.0101, "the rim stands beyond the middle");
        let narrow = Piece { own: chain([0.002, 0.001], 0.0), ..broad };
        assert!((far(&narrow) - 0.01).abs() < 1e-6);
    }

    /// A lobe stands out on the side that has one, and pieces still meet.
    #[test]
    fn lobes_stand_out_between_the_ends_of_a_piece() {
        let own = chain([0.002, 0.002], 0.0);
        let neighbours = [chain([0.002, 0.002], -0.01), chain([0.002, 0.002], 0.01)].map(Some);
        let piece = |lobed| Piece { own, before: neighbours[0], after: neighbours[1], lobed };
        let sides = |lobed| {
            let drawn = drawn(&piece(lobed), 3);
            let left = drawn.iter().map(|vertex| vertex.position()[1]);
            (left.clone().fold(0.0, f32::min), left.fold(0.0, f32::max))
        };
        let ((right, left), plain) = (sides([false, true]), 0.002);
        assert!((right + plain).abs() < 1e-6 && left > 2.5 * plain, "{right} {left}");
        let both = sides([true, true]);
        assert!(both.0 < -2.5 * plain && (both.0 + both.1).abs() < 1e-5);
        let columns = usize::from(Lamina::new(3).columns) + 1;
        let (low, plain) = (drawn(&piece([true; 2]), 3), drawn(&piece([false; 2]), 3));
        let ends = |of: &[Vertex]| -> Vec<[f32; 3]> {
            of[..columns].iter().chain(&of[of.len() - columns..]).map(Vertex::position).collect()
        };
        assert_eq!(ends(&low), ends(&plain));
    }
}
