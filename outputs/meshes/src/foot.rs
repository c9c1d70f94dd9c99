//! The flare at the foot of a trunk as a form of its own, for lives and for pages, which have no welded wood.
//!
//! It is a closed body with the same rings at every age, in a box of its own: x from 0 at the ground to 1 where the
//! flare ends, and radii in the diameters of the trunk. It is placed along the straight way from the base of the trunk
//! to where the flare ends, and narrows as the trunk does between these two ([`super::model::Model::at`]). Absent: the
//! flare of a mesh of one age (`welded::flare`), which follows the wood ring by ring, and the profile
//! (`phytomer_looks::Flare`).

use super::Mesh;
use super::chunk::{Face, Tag, Vertex};
use super::model::Model;
use super::stem::{Drawn, Stems};
use super::tube::Frustum;
use super::welded::{corners_of, most_of_trunk, shares};
use glam::{DVec3, Vec3};
use phytomer_looks::Flare;
use phytomer_sim::math::sincos;
use phytomer_sim::plant::NodeId;
use std::f64::consts::TAU;

/// The share of the radius of the wood at which the body ends, so that the edge of its end is within the trunk.
const END: f64 = 0.9;

/// The foot of a trunk.
#[derive(Debug, Clone, Copy)]
pub struct Foot {
    /// The lowest internode of the trunk.
    pub node: NodeId,
    /// Where the flare stands: from the ground to where it ends, with the radii of the trunk there.
    pub frustum: Frustum,
}

impl Stems<'_> {
    /// The foot of the trunk, where the species states a flare and the trunk is drawn.
    pub fn foot(&self) -> Option<Foot> {
        let flare = self.flare.as_ref()?;
        let first = self.drawn_of(0..self.plant.nodes.len()).next()?;
        let is_round = matches!(self.form(first), Drawn::Tube(..) | Drawn::Prism(_) | Drawn::Turned(_));
        is_round.then_some(())?;
        let axis = self.plant.nodes.axis[first.index()];
        let of_trunk = |node: &NodeId| self.plant.nodes.axis[node.index()] == axis;
        let trunk = self.drawn_of(first.index()..self.plant.nodes.len()).filter(of_trunk);
        let trunk: Vec<Frustum> = trunk.map(|node| self.frustum(node)).collect();
        let lowest = trunk.first()?;
        let all: f32 = trunk.iter().map(|frustum| frustum.length).sum();
        let long = (2.0 * flare.height() as f32 * lowest.radii[0]).min(most_of_trunk() as f32 * all);
        if !(long.is_finite() && long > 0.0 && lowest.radii[0] > 0.0) {
            return None;
        }
        let (mut left, mut end) = (long, None);
        for frustum in &trunk {
            let share = if frustum.length > 0.0 { (left / frustum.length).clamp(0.0, 1.0) } else { 1.0 };
            let at = Vec3::from_array(frustum.base) + share * frustum.length * Vec3::from_array(frustum.heading);
            end = Some((at, frustum.radii[0] + share * (frustum.radii[1] - frustum.radii[0])));
            left -= frustum.length;
            if left <= 0.0 {
                break;
            }
        }
        let (at, radius) = end?;
        let base = Vec3::from_array(lowest.base);
        let heading = (at - base).try_normalize()?;
        let up = Vec3::from_array(lowest.up);
        let up = (up - up.dot(heading) * heading).try_normalize().unwrap_or_else(|| heading.any_orthonormal_vector());
        let frustum = Frustum {
            base: lowest.base,
            heading: heading.to_array(),
            up: up.to_array(),
            length: (at - base).length(),
            radii: [lowest.radii[0], radius],
        };
        Some(Foot { node: first, frustum })
    }

    /// The form of the flare, in the colour of an internode of the trunk; empty where the species states none.
    pub fn flare_model(&self, node: NodeId) -> Model {
        let mesh = self.flare.as_ref().map(|flare| body(flare, self.colour(node))).unwrap_or_default();
        Model::narrowing(mesh)
    }

    /// The flare as it stands, with what its vertices tell of the lowest internode.
    pub fn flare_mesh(&self, foot: &Foot) -> Mesh {
        let mut mesh = self.flare_model(foot.node).mesh;
        let Frustum { base, heading, up, length, radii } = foot.frustum;
        let [base, heading, up] = [base, heading, up].map(Vec3::from_array);
        let (left, tag) = (up.cross(heading), self.tag(foot.node));
        for vertex in &mut mesh.vertices {
            let [x, y, z] = vertex.position();
            let wide = 2.0 * (radii[0] + x * (radii[1] - radii[0]));
            let at = base + x * length * heading + wide * (y * left + z * up);
            let [a, b, c] = vertex.normal();
            // Across the surface: shares of the box by what they are long and wide.
            let normal = a / length.max(f32::MIN_POSITIVE) * heading + (b * left + c * up) / (2.0 * radii[0]);
            *vertex = Vertex::new(at.to_array(), normal.normalize_or(heading).to_array(), vertex.texture(), &tag);
        }
        mesh
    }
}

/// The body of a flare in its box: rings from the ground up, each closed by its first corner, and both ends.
fn body(flare: &Flare, [red, green, blue]: [u8; 3]) -> Mesh {
    let tag = Tag { colour: [red, green, blue, 255], birth: 0.0, death: f32::INFINITY, component: 0, kind: 0 };
    let corners = corners_of(flare, 1);
    let radius = |x: f64, angle: f64| 0.5 * (1.0 + flare.wider(x, angle));
    let at = |x: f64, radius: f64, angle: f64| {
        let (sin, cos) = sincos(angle);
        DVec3::new(x, -radius * sin, radius * cos)
    };
    let (mut mesh, step) = (Mesh::default(), 1e-4);
    let mut ring = |x: f64, share: f64, normal: Option<DVec3>| {
        for k in 0..=corners {
            let around = f64::from(k % corners) / f64::from(corners) * TAU;
            let on = |x: f64, angle: f64| at(x, radius(x, angle), angle);
            let along = on(x + step, around) - on(x - step, around);
            let across = on(x, around + step) - on(x, around - step);
            let normal = normal.unwrap_or_else(|| across.cross(along).normalize_or(DVec3::X));
            let place = at(x, share * radius(x, around), around);
            let texture = [k as f32 / corners as f32, x as f32];
            mesh.vertices.push(Vertex::new(place.as_vec3().to_array(), normal.as_vec3().to_array(), texture, &tag));
        }
    };
    ring(0.0, 1.0, Some(DVec3::NEG_X));
    let rings: Vec<f64> = shares().collect();
    rings.iter().for_each(|x| ring(*x, 1.0, None));
    ring(1.0, END, Some(DVec3::X));
    let (columns, rings) = (corners + 1, rings.len() as u32);
    for low in (1..=rings).map(|ring| ring * columns) {
        for k in 0..corners {
            let [a, b] = [low + k, low + k + 1];
            mesh.faces.extend([[a, b, a + columns], [b, b + columns, a + columns]].map(Face::new));
        }
    }
    let end = (rings + 1) * columns;
    mesh.faces.extend((2..corners).map(|k| Face::new([0, k, k - 1])));
    mesh.faces.extend((2..corners).map(|k| Face::new([end, end + k - 1, end + k])));
    mesh
}

#[cfg(test)]
mod tests {
    use super::super::measure::volume;
    use super::*;

    /// Turned outwards, a round body holds the integral of its rings, and a ring at the ground is as wide as stated.
    #[test]
    fn the_body_has_the_volume_of_its_profile() {
        let flare = Flare { width: 0.4, height: Some(1.2), lobes: 0, depth: 0.0 };
        let mesh = body(&flare, [9; 3]);
        let steps = 20_000;
        let slices = (0..steps).map(|k| {
            let radius = 0.5 * (1.0 + flare.wider((f64::from(k) + 0.5) / f64::from(steps), 0.0));
            std::f64::consts::PI * radius * radius / f64::from(steps)
        });
        let (expected, found) = (slices.sum::<f64>(), volume(&mesh.vertices, &mesh.faces));
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
        let widest = mesh.vertices.iter().map(|vertex| vertex.position()[2]).fold(0.0, f32::max);
        assert!((widest - 0.9).abs() < 1e-6, "{widest}");
        for vertex in &mesh.vertices[25..mesh.vertices.len() - 25] {
            let ([_, y, z], [_, b, c]) = (vertex.position(), vertex.normal());
            assert!(y * b + z * c > 0.0, "a normal that points into the body");
        }
    }
}
