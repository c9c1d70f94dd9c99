//! Internodes from near: their radius goes smoothly through the places of a profile, and the base of a fallen leaf, or
//! the head of a cut stem, may stand on them.
//!
//! Between its places a profile is a cubic without overshoot (Fritsch & Butland 1984), so that a swollen node is one
//! smooth ring. The base of a leaf is a closed, flattened wedge with a cut end, on the side of the stem on which the
//! leaf stood. Absent: which internodes are drawn so (`stem`), and frusta, which tables and detail 0 have (`tube`).

use super::chunk::{Tag, Vertex};
use super::tube::{Frustum, Tube, cross, lean};
use phytomer_looks::{LeafBases, NearStem};
use phytomer_sim::clock::Tick;
use phytomer_sim::math::sincosf;

/// The colour of a dry leaf base, and its share of 255.
const DRY: [u8; 4] = [112, 90, 62, 210];
/// The same of its cut end.
const CUT: [u8; 4] = [158, 132, 94, 230];

/// Rings of a leaf base: the share of its length, and its width and thickness there over those at its foot.
const WEDGE: [[f32; 3]; 4] = [[0.0, 1.0, 1.0], [0.35, 0.82, 0.8], [0.8, 0.6, 0.62], [1.0, 0.56, 0.56]];
/// The thickness of a leaf base at its foot over its width.
const THICK: f32 = 0.42;

/// How high the head of a cut stem is over its breadth, and how far its knuckles stand out, as a share of its radius.
const FLAT: f32 = 0.8;
const KNUCKLES: f32 = 0.09;

/// Which internodes of a look are drawn how.
#[derive(Debug, Clone, Copy)]
pub struct Choice {
    ranks: Option<[u32; 2]>,
    /// The bases of leaves that stay.
    pub bases: Option<LeafBases>,
    /// Whether it must be known where a stem was cut.
    pub headed: bool,
    profiled: bool,
}

/// How an internode is drawn from near.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// As afar: of another rank, or without a profile.
    Plain,
    /// By its profile.
    Turned,
    /// By its profile, with the base of its leaf.
    Based,
    /// By its profile, with the head of a cut stem.
    Headed,
}

/// A tube whose radius follows a profile.
#[derive(Debug)]
pub struct Turned {
    /// For each ring the share of the length and the factor of the radius.
    rings: Vec<[f32; 2]>,
    /// The corners of a ring: cosine, sine, share of the way around; the first is repeated at the end.
    corners: Vec<[f32; 3]>,
    /// The distance of a corner from the axis line, in radii.
    reach: f32,
    base: Option<LeafBases>,
    /// The breadth of a head over that of the stem, and its rings.
    head: Option<(f32, u16)>,
    /// The corners of a ring of a leaf base.
    around: Vec<[f32; 3]>,
    faces: Vec<[u32; 3]>,
}

impl Choice {
    /// The choice of a setting.
    pub fn of(near: &NearStem) -> Self {
        Self {
            ranks: near.ranks,
            bases: near.leaf_bases,
            headed: near.head.is_some(),
            profiled: !near.profile.is_empty(),
        }
    }

    /// How an internode of a rank and an age is drawn, whose leaf may have fallen, and which may end a stem that was
    /// cut.
    pub fn variant(&self, (rank, age): (u32, Tick), fallen: bool, cut: bool) -> Variant {
        let stays = |bases: LeafBases| bases.falls_after.is_none_or(|falls| age < falls);
        if self.ranks.is_some_and(|[first, last]| !(first..=last).contains(&rank)) {
            Variant::Plain
        } else if cut && self.headed {
            Variant::Headed
        } else if fallen && self.bases.is_some_and(stays) {
            Variant::Based
        } else if self.profiled {
            Variant::Turned
        } else {
            Variant::Plain
        }
    }
}

impl Turned {
    /// The forms of a setting at a detail from 1, in the order of [`Variant`] without the first; `sides` are those of
    /// the plain form.
    pub fn each(near: &NearStem, sides: u8, detail: u8) -> [Self; 3] {
        let parts = [(None, None), (near.leaf_bases, None), (None, near.head)];
        parts.map(|parts| Self::new(near, parts, sides, detail))
    }

    fn new(near: &NearStem, (base, head): (Option<LeafBases>, Option<f32>), sides: u8, detail: u8) -> Self {
        let sides = usize::from(sides.max([3, 8, 14, 24][usize::from(detail.min(3))]));
        let places: &[[f32; 2]] = if near.profile.is_empty() { &[[0.0, 1.0], [1.0, 1.0]] } else { &near.profile };
        let rings = smooth(places, [1, 1, 3, 5][usize::from(detail.min(3))]);
        let tube = Tube::new(sides.min(64) as u8);
        let corners = tube.corners().to_vec();
        let around = Tube::new([3, 5, 7, 10][usize::from(detail.min(3))]).corners().to_vec();
        let head = head.map(|head| (head, [4, 6, 10, 16][usize::from(detail.min(3))]));
        let mut turned = Self { rings, corners, reach: tube.reach(), base, head, around, faces: Vec::new() };
        turned.faces = turned.all_faces();
        turned
    }

    /// The number of its vertices.
    pub fn vertices(&self) -> usize {
        self.around() + 2 * (self.corners.len() - 1) + self.of_base() + self.of_head()
    }

    /// How many of them, the first, stand around the stem.
    pub fn around(&self) -> usize {
        self.rings.len() * self.corners.len()
    }

    fn of_base(&self) -> usize {
        if self.base.is_some() { WEDGE.len() * self.around.len() + self.around.len() - 1 } else { 0 }
    }

    fn of_head(&self) -> usize {
        self.head.map_or(0, |(_, rings)| usize::from(rings + 1) * self.corners.len())
    }

    /// Its triangles.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    fn all_faces(&self) -> Vec<[u32; 3]> {
        let mut faces = skin(0, self.rings.len() as u32, self.corners.len() as u32);
        let sides = self.corners.len() as u32 - 1;
        let bottom = self.around() as u32;
        let top = bottom + sides;
        faces.extend((1..sides - 1).flat_map(|k| [[bottom, bottom + k + 1, bottom + k], [top, top + k, top + k + 1]]));
        if self.base.is_some() {
            let (first, ring) = (top + sides, self.around.len() as u32);
            faces.extend(skin(first, WEDGE.len() as u32, ring));
            let end = first + WEDGE.len() as u32 * ring;
            faces.extend((1..ring - 2).map(|k| [end, end + k, end + k + 1]));
        }
        if let Some((_, rings)) = self.head {
            // Rings at both ends are points: their triangles are fans.
            let (first, ring) = ((self.vertices() - self.of_head()) as u32, sides + 1);
            let ends = [first, first + u32::from(rings) * ring];
            let is_point = |[a, b, c]: &[u32; 3]| {
                let at_end = |corner: &u32, end: u32| (end..end + ring).contains(corner);
                ends.iter().any(|end| [[a, b], [b, c], [c, a]].iter().any(|pair| pair.iter().all(|k| at_end(k, *end))))
            };
            faces.extend(skin(first, u32::from(rings) + 1, ring).into_iter().filter(|face| !is_point(face)));
        }
        faces
    }

    /// Writes its vertices; `leaf` is the direction in which the fallen leaf stood.
    pub fn write(&self, frustum: &Frustum, leaf: [f32; 3], tag: &Tag, out: &mut [Vertex]) {
        let Frustum { base, heading, up, length, .. } = *frustum;
        let side = cross(heading, up);
        let ring = self.corners.len();
        let (stem, parts) = out.split_at_mut(self.around() + 2 * (ring - 1));
        let (wedge, head) = parts.split_at_mut(self.of_base());
        let (skin, caps) = stem.split_at_mut(self.around());
        let (bottom, top) = caps.split_at_mut(ring - 1);
        let last = self.rings.len() - 1;
        for (number, out) in skin.chunks_exact_mut(ring).enumerate() {
            let [share, _] = self.rings[number];
            let (radius, lean) = (self.reach * self.radius(frustum, number), self.lean(frustum, number));
            let middle = [0, 1, 2].map(|i| base[i] + share * length * heading[i]);
            for (k, &[cos, sin, turn]) in self.corners.iter().enumerate() {
                let radial = [0, 1, 2].map(|i| cos * up[i] + sin * side[i]);
                let at = [0, 1, 2].map(|i| middle[i] + radius * radial[i]);
                let normal = [0, 1, 2].map(|i| lean[0] * radial[i] + lean[1] * heading[i]);
                out[k] = Vertex::new(at, normal, [turn, share], tag);
                let round = [0.5 + 0.5 * cos, 0.5 + 0.5 * sin];
                if k + 1 < ring && number == 0 {
                    bottom[k] = Vertex::new(at, heading.map(|x| -x), round, tag);
                } else if k + 1 < ring && number == last {
                    top[k] = Vertex::new(at, heading, round, tag);
                }
            }
        }
        if let Some(bases) = &self.base {
            self.write_base(bases, frustum, leaf, tag, wedge);
        }
        if let Some((broad, rings)) = self.head {
            self.write_head((broad, rings), frustum, tag, head);
        }
    }

    /// The radius at a ring.
    fn radius(&self, frustum: &Frustum, number: usize) -> f32 {
        let [share, factor] = self.rings[number];
        factor * (frustum.radii[0] + share * (frustum.radii[1] - frustum.radii[0]))
    }

    /// The normal at a ring as its parts along the radius and along the axis.
    fn lean(&self, frustum: &Frustum, number: usize) -> [f32; 2] {
        let (before, after) = (number.saturating_sub(1), (number + 1).min(self.rings.len() - 1));
        let along = frustum.length * (self.rings[after][0] - self.rings[before][0]);
        lean(along, self.radius(frustum, before) - self.radius(frustum, after))
    }

    /// Writes the head of a cut stem: a flattened ball around its end, with knuckles where shoots were cut again and
    /// again.
    fn write_head(&self, (broad, rings): (f32, u16), frustum: &Frustum, tag: &Tag, out: &mut [Vertex]) {
        let Frustum { base, heading, up, length, radii } = *frustum;
        let side = cross(heading, up);
        let middle = [0, 1, 2].map(|i| base[i] + length * heading[i]);
        for (number, out) in out.chunks_exact_mut(self.corners.len()).enumerate() {
            let share = number as f32 / f32::from(rings);
            let (out_of, along) = sincosf(std::f32::consts::PI * share);
            for (&[cos, sin, turn], out) in self.corners.iter().zip(out) {
                let (knuckles, _) = sincosf(std::f32::consts::TAU * 5.0 * turn + 9.0 * share);
                let (rows, _) = sincosf(std::f32::consts::PI * 4.0 * share);
                let radius = broad * radii[1] * (1.0 + KNUCKLES * knuckles * rows);
                let parts =
                    |flat: f32| [0, 1, 2].map(|i| out_of * (cos * up[i] + sin * side[i]) - flat * along * heading[i]);
                let at = parts(FLAT).map(|x| radius * x);
                *out = Vertex::new([0, 1, 2].map(|i| middle[i] + at[i]), unit(parts(1.0 / FLAT)), [turn, share], tag);
            }
        }
    }

    /// Writes the base of a leaf, which begins within the stem.
    fn write_base(&self, bases: &LeafBases, frustum: &Frustum, leaf: [f32; 3], tag: &Tag, out: &mut [Vertex]) {
        let Frustum { base, heading, length, radii, .. } = *frustum;
        let wide = 2.0 * radii[1];
        let (sin, cos) = sincosf(bases.angle_deg.to_radians());
        let ahead = [0, 1, 2].map(|i| cos * heading[i] + sin * leaf[i]);
        let above = [0, 1, 2].map(|i| sin * heading[i] - cos * leaf[i]);
        let left = cross(above, ahead);
        let half = [0.5 * bases.width * wide, 0.5 * THICK * bases.width * wide];
        let inside = self.radius(frustum, self.rings.len() - 1) - half[1];
        let foot = [0, 1, 2].map(|i| base[i] + length * heading[i] + inside * leaf[i]);
        let ring = self.around.len();
        let (skin, end) = out.split_at_mut(WEDGE.len() * ring);
        for (&[share, across, thick], out) in WEDGE.iter().zip(skin.chunks_exact_mut(ring)) {
            let middle = [0, 1, 2].map(|i| foot[i] + share * bases.length * wide * ahead[i]);
            for (&[cos, sin, turn], out) in self.around.iter().zip(out) {
                let at = |y: f32, z: f32| [0, 1, 2].map(|i| y * left[i] + z * above[i]);
                let place = at(across * half[0] * cos, thick * half[1] * sin);
                let normal = unit(at(thick * half[1] * cos, across * half[0] * sin));
                *out = Vertex::new([0, 1, 2].map(|i| middle[i] + place[i]), normal, [turn, share], tag);
                out.lay_over(DRY);
            }
        }
        for (vertex, out) in skin[(WEDGE.len() - 1) * ring..].iter().zip(end) {
            *out = Vertex::new(vertex.position(), ahead, [0.5, 0.5], tag);
            out.lay_over(CUT);
        }
    }
}

/// The triangles between rings of so many corners, the first repeated at the end.
fn skin(first: u32, rings: u32, ring: u32) -> Vec<[u32; 3]> {
    let quads = (0..rings - 1).flat_map(|row| (0..ring - 1).map(move |k| first + row * ring + k));
    quads.flat_map(|k| [[k, k + 1, ring + k + 1], [k, ring + k + 1, ring + k]]).collect()
}

/// A curve through places, with so many steps between two of them, that never overshoots them.
fn smooth(places: &[[f32; 2]], steps: u16) -> Vec<[f32; 2]> {
    let slope = |k: usize| (places[k + 1][1] - places[k][1]) / (places[k + 1][0] - places[k][0]);
    let tangent = |k: usize| {
        if k == 0 || k + 1 == places.len() {
            return if places.len() < 3 { slope(0) } else { 0.0 };
        }
        let (before, after) = (slope(k - 1), slope(k));
        if before * after > 0.0 { 2.0 * before * after / (before + after) } else { 0.0 }
    };
    let mut curve = Vec::new();
    for k in 0..places.len() - 1 {
        let ([from, low], [to, high]) = (places[k], places[k + 1]);
        let steps = if low == high { 1 } else { steps };
        let wide = to - from;
        curve.extend((0..steps).map(|step| {
            let u = f32::from(step) / f32::from(steps);
            let [a, b] = [u * u * (3.0 - 2.0 * u), u * (1.0 - u)];
            let bend = b * (1.0 - u) * tangent(k) - b * u * tangent(k + 1);
            [from + u * wide, low + a * (high - low) + wide * bend]
        }));
    }
    curve.push(places[places.len() - 1]);
    curve
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length > 1e-20 { v.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::super::chunk::Face;
    use super::super::measure::{assert_closed, assert_unit_normals, outward_share, volume};
    use super::*;
    use bytemuck::Zeroable;

    const TAG: Tag = Tag { colour: [9, 9, 9, 255], birth: 1.0, death: f32::INFINITY, component: 0, kind: 0 };

    fn written(turned: &Turned, radii: [f32; 2]) -> (Vec<Vertex>, Vec<Face>) {
        let frustum =
            Frustum { base: [0.1, 0.2, 0.3], heading: [0.0, 0.6, 0.8], up: [1.0, 0.0, 0.0], length: 1.5, radii };
        let mut vertices = vec![Vertex::zeroed(); turned.vertices()];
        turned.write(&frustum, [1.0, 0.0, 0.0], &TAG, &mut vertices);
        (vertices, turned.faces().iter().map(|face| Face::new(*face)).collect())
    }

    fn stem(profile: Vec<[f32; 2]>, detail: u8) -> Turned {
        Turned::new(&NearStem { profile, ..NearStem::default() }, (None, None), 8, detail)
    }

    /// Without a profile it is the tube of the internode: V = π h/3 · (r₁² + r₂² + r₁r₂).
    #[test]
    fn without_a_profile_it_is_the_frustum() {
        for detail in 1..=3 {
            let (vertices, faces) = written(&stem(Vec::new(), detail), [0.3, 0.2]);
            assert_closed(&vertices, &faces);
            assert_unit_normals(&vertices);
            assert_eq!(outward_share(&vertices, &faces), 1.0);
            let expected = std::f64::consts::PI * 0.5 * (0.09 + 0.04 + 0.06);
            assert!((volume(&vertices, &faces) / expected - 1.0).abs() < 1e-5, "{detail}");
        }
    }

    #[test]
    fn a_profile_is_met_in_its_places_and_never_overshot() {
        let places = vec![[0.0, 1.2], [0.1, 1.0], [0.6, 1.0], [0.9, 1.4], [1.0, 0.7]];
        for detail in 1..=3 {
            let turned = stem(places.clone(), detail);
            let (vertices, faces) = written(&turned, [0.1, 0.1]);
            assert_closed(&vertices, &faces);
            assert_unit_normals(&vertices);
            assert!(outward_share(&vertices, &faces) > 0.99);
            for place in &places {
                assert!(turned.rings.iter().any(|ring| ring == place), "{detail}: {place:?}");
            }
            assert!(turned.rings.iter().all(|[_, factor]| (0.7..=1.4).contains(factor)));
            assert!(turned.rings.is_sorted_by(|a, b| a[0] < b[0]));
        }
    }

    /// The stem and the base of its leaf are closed by themselves but for the foot of the base, which is in the stem.
    #[test]
    fn the_base_of_a_leaf_stands_out_where_the_leaf_was() {
        let bases = LeafBases { length: 0.5, width: 0.4, ..LeafBases::default() };
        for detail in 1..=3 {
            let turned = Turned::new(&NearStem::default(), (Some(bases), None), 8, detail);
            let (vertices, faces) = written(&turned, [0.2, 0.2]);
            assert_unit_normals(&vertices);
            assert!(outward_share(&vertices, &faces) > 0.95, "{detail}");
            let out = |vertex: &Vertex| vertex.position()[0] - 0.1;
            let far = vertices.iter().map(out).fold(0.0, f32::max);
            assert!((0.25..0.5).contains(&far), "{far}");
            let foot = &vertices[turned.around() + 2 * (turned.corners.len() - 1)..][..turned.around.len()];
            assert!(foot.iter().all(|vertex| out(vertex) < 0.2 * turned.reach));
        }
    }

    /// A head goes around the cut end, on all sides of it, and is closed.
    #[test]
    fn the_head_of_a_cut_stem_covers_its_end() {
        for detail in 1..=3 {
            let turned = Turned::new(&NearStem::default(), (None, Some(1.4)), 8, detail);
            let (vertices, faces) = written(&turned, [0.2, 0.2]);
            assert_unit_normals(&vertices);
            assert!(outward_share(&vertices, &faces) > 0.93, "{detail}");
            let tip = [0.1, 1.1, 1.5];
            let head = &vertices[turned.vertices() - turned.of_head()..];
            let far = head.iter().map(|vertex| {
                let at = vertex.position();
                (0..3).map(|k| (at[k] - tip[k]) * (at[k] - tip[k])).sum::<f32>().sqrt()
            });
            assert!(far.clone().all(|far| (0.2..0.32).contains(&far)), "{detail}");
        }
    }
}
