//! Curved surfaces as forms of organs: points, normals and triangles in the frame of the organ, x along it, y to its
//! left, z to its upper side, scaled along each axis by what the organ states.
//!
//! A surface is thin: it has two sides and no volume. Normals are those of the surface that the triangles stand for,
//! not of the triangles, so that patches that join smoothly are shaded smoothly. Areas are those of the triangles.
//! Absent: where surfaces come from (`phytomer_models`), and vertices of meshes (`phytomer_meshes`).

/// Three coordinates.
type Vector = [f64; 3];

/// A curved surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Surface {
    points: Vec<SurfacePoint>,
    faces: Vec<[u32; 3]>,
    /// For each triangle the vector across it, twice as long as its area.
    across: Vec<Vector>,
}

/// A point of a curved surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Where it is.
    pub at: [f32; 3],
    /// The normal on the side from which triangles run counterclockwise, a unit vector.
    pub normal: [f32; 3],
    /// Where it is in a picture that is laid over the surface.
    pub texture: [f32; 2],
}

impl Surface {
    /// The surface of points with their normals and places in a texture, and of triangles that name them. A normal of
    /// length 0, as that of a point where a patch is drawn together, is the mean of the triangles about the point.
    /// Triangles that name no point are left out.
    pub fn of(points: &[(Vector, Vector, [f64; 2])], faces: &[[u32; 3]]) -> Self {
        let named = |face: &&[u32; 3]| face.iter().all(|corner| (*corner as usize) < points.len());
        let faces: Vec<[u32; 3]> = faces.iter().filter(named).copied().collect();
        let at = |corner: u32| points[corner as usize].0;
        let across: Vec<Vector> = faces.iter().map(|face| across(face.map(at))).collect();
        let mut sums = vec![[0.0; 3]; points.len()];
        for (face, across) in faces.iter().zip(&across) {
            face.iter().for_each(|corner| (0..3).for_each(|k| sums[*corner as usize][k] += across[k]));
        }
        let point = |((at, normal, texture), sum): (&(Vector, Vector, [f64; 2]), &Vector)| {
            let normal = unit(*normal).or_else(|| unit(*sum)).unwrap_or([0.0, 0.0, 1.0]);
            SurfacePoint { at: at.map(single), normal: normal.map(single), texture: texture.map(single) }
        };
        Self { points: points.iter().zip(&sums).map(point).collect(), faces, across }
    }

    /// Its points.
    pub fn points(&self) -> &[SurfacePoint] {
        &self.points
    }

    /// Its triangles by the places of their corners among the points.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The area of one side when the surface is scaled along each axis: that of its triangles.
    pub fn area(&self, scale: Vector) -> f64 {
        self.across.iter().map(|across| 0.5 * length(turned(*across, scale))).sum()
    }

    /// How far it reaches along an axis from the origin to both sides together, when it is scaled by 1.
    pub fn extent(&self, axis: usize) -> f32 {
        let along = self.points.iter().map(|point| point.at[axis]);
        let (least, most) = along.fold((0.0_f32, 0.0_f32), |(least, most), x| (least.min(x), most.max(x)));
        most - least
    }
}

impl SurfacePoint {
    /// The normal where the surface is scaled along each axis, a unit vector.
    #[inline]
    pub fn normal_scaled(&self, scale: [f32; 3]) -> [f32; 3] {
        let normal = turned(self.normal.map(f64::from), scale.map(f64::from));
        unit(normal).map_or(self.normal, |normal| normal.map(single))
    }
}

/// What becomes of a vector across a face when the face is scaled along each axis: it stays across, and its length
/// grows as the area does.
fn turned(across: Vector, [x, y, z]: Vector) -> Vector {
    [across[0] * y * z, across[1] * x * z, across[2] * x * y]
}

fn across([a, b, c]: [Vector; 3]) -> Vector {
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn length(of: Vector) -> f64 {
    (of[0] * of[0] + of[1] * of[1] + of[2] * of[2]).sqrt()
}

/// The direction of a vector, if it has one.
fn unit(of: Vector) -> Option<Vector> {
    let largest = of.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let scaled = of.map(|x| x / largest);
    let size = length(scaled);
    Some(scaled.map(|x| x / size))
}

#[inline]
fn single(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 2 × 1 in a plane that leans by 45° about y: scaled by s along x and t along z its area is √(s² + t²)
    /// √2.
    #[test]
    fn a_scaled_plane_has_its_area_and_its_normal() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]];
        let points = corners.map(|[x, y]| ([x, y, x], [0.0; 3], [x, 0.5 * y]));
        let surface = Surface::of(&points, &[[0, 1, 2], [0, 2, 3], [0, 1, 9]]);
        assert_eq!((surface.points().len(), surface.faces().len()), (4, 2));
        for [x, y, z] in [[1.0, 1.0, 1.0], [3.0, 1.0, 0.5], [0.25, 4.0, -2.0], [1.0, 1.0, 0.0]] {
            let expected = 2.0 * y * f64::sqrt(x * x + z * z);
            assert!((surface.area([x, y, z]) - expected).abs() < 1e-12 * expected, "{x} {y} {z}");
            let normal = surface.points()[0].normal_scaled([x, y, z].map(single)).map(f64::from);
            let along = [x, 0.0, z];
            assert!((0..3).map(|k| normal[k] * along[k]).sum::<f64>().abs() < 1e-6, "{normal:?}");
            assert!((length(normal) - 1.0).abs() < 1e-6);
        }
        assert_eq!(surface.area([0.0; 3]), 0.0);
        assert_eq!([0, 1, 2].map(|axis| surface.extent(axis)), [1.0, 2.0, 1.0]);
    }
}
