//! Tangents of vertices on which a picture of relief lies (glTF 2.0 §3.7.2.1): the direction in which the picture goes
//! to its right, and on which side of it and the normal its upper edge is.
//!
//! A vertex has the sum of those of its triangles, each by its area, across the normal. They are kept for one material
//! at a time, 56 bytes a vertex. Absent: vertices without such a picture.

use glam::Vec3;
use phytomer_meshes::Vertex;

/// The vertices of a material.
#[derive(Default)]
pub struct Tangents {
    corners: Vec<Corner>,
}

struct Corner {
    at: Vec3,
    normal: Vec3,
    texture: [f32; 2],
    /// The sums of the directions in which the picture goes right and up.
    right: Vec3,
    up: Vec3,
}

impl Tangents {
    /// Adds a vertex.
    pub fn add(&mut self, vertex: &Vertex) {
        let [at, normal] = [vertex.position(), vertex.normal()].map(Vec3::from_array);
        let normal = normal.try_normalize().unwrap_or(Vec3::Z);
        self.corners.push(Corner { at, normal, texture: vertex.texture(), right: Vec3::ZERO, up: Vec3::ZERO });
    }

    /// Adds a triangle of vertices that were added before.
    pub fn join(&mut self, face: [u32; 3]) {
        let of = |corner: u32| self.corners.get(corner as usize).map(|corner| (corner.at, corner.texture));
        let [Some((a, s)), Some((b, t)), Some((c, u))] = face.map(of) else { return };
        let [one, other] = [b - a, c - a];
        let [[du, dv], [eu, ev]] = [[t[0] - s[0], t[1] - s[1]], [u[0] - s[0], u[1] - s[1]]];
        // One that turns the picture over has both directions the other way.
        let side = if du * ev - eu * dv < 0.0 { -1.0 } else { 1.0 };
        let (right, up) = ((one * ev - other * dv) * side, (other * du - one * eu) * side);
        for corner in face {
            if let Some(corner) = self.corners.get_mut(corner as usize) {
                corner.right += right;
                corner.up += up;
            }
        }
    }

    /// The tangents as a file has them.
    pub fn bytes(&self) -> Vec<u8> {
        let each = |Corner { normal, right, up, .. }: &Corner| {
            let across = (right - normal * right.dot(*normal)).try_normalize();
            let across = across.unwrap_or_else(|| normal.any_orthonormal_vector());
            let side = if normal.cross(across).dot(*up) < 0.0 { -1.0_f32 } else { 1.0 };
            // Y is up in the file.
            [across.x, across.z, -across.y, side]
        };
        self.corners.iter().flat_map(each).flat_map(f32::to_le_bytes).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_meshes::Tag;

    /// A square in the plane of the ground, its picture as it lies and mirrored; Y is up in the file.
    #[test]
    fn a_square_has_its_own_sides() {
        let tag = Tag { colour: [9; 4], birth: 1.0, death: f32::INFINITY, component: 0, kind: 0 };
        for (mirrored, side) in [(false, 1.0), (true, -1.0)] {
            let mut tangents = Tangents::default();
            for [x, y] in [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]] {
                let s = if mirrored { -x } else { x };
                tangents.add(&Vertex::new([x, y, 0.0], [0.0, 0.0, 1.0], [s, y], &tag));
            }
            tangents.join([0, 1, 2]);
            tangents.join([0, 2, 3]);
            tangents.join([0, 9, 3]);
            let bytes = tangents.bytes();
            let numbers: Vec<f32> =
                bytes.chunks_exact(4).map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]])).collect();
            assert!(numbers.chunks_exact(4).all(|four| four == [side, 0.0, 0.0, side]), "{numbers:?}");
        }
    }
}
