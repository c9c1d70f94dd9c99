//! The silhouette of a mesh along a direction, as the rasteriser of pictures draws it: its area and the length of its
//! outline, both by counting samples.
//!
//! The area of a shape by a lattice of points of the mesh a has the standard error √(.0724 B a³), where B is the
//! length of its outline (Gundersen & Jensen 1987, *Journal of Microscopy* 147: 229–263, point counting: a coefficient
//! of error of √(.0724 B / √A) n^(−3/4) with n points in the area A). Absent: colours, and what is behind.

use super::film::Film;
use super::raster::{UPRIGHT, Window};
use super::{camera::Camera, extent::Extent, gaze::Gaze};
use glam::Vec3;
use phytomer_meshes::Mesh;
use phytomer_sim::site::light::lattice::across;
use std::f32::consts::FRAC_PI_4;

/// What the outline of a shape has in the error of its area.
const OF_OUTLINE: f32 = 0.0724;

/// A silhouette.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Silhouette {
    /// Its area, m².
    pub area_m2: f32,
    /// The length of its outline, metres: by the theorem of Crofton, from the changes between neighbouring samples.
    pub outline_m: f32,
    /// The standard error of its area, m².
    pub error_m2: f32,
}

/// The silhouette of a mesh from where the unit vector `towards` points, with samples `apart` metres from one another.
/// Costs a byte or so for each mm² where samples are a millimetre apart; `None` where there would be more than 2²⁸.
pub fn silhouette(mesh: &Mesh, towards: [f64; 3], apart: f32) -> Option<Silhouette> {
    let [right, up] = across(towards).map(|axis| Vec3::from_array(axis.map(|x| x as f32)));
    let gaze = Gaze { right, up, forward: -Vec3::from_array(towards.map(|x| x as f32)) };
    let mut extent = Extent::new(gaze, [0.0; 4]);
    mesh.vertices.iter().for_each(|vertex| extent.add(Vec3::from_array(vertex.position())));
    let [west, east, south, north] = [extent.most[0], extent.most[1], extent.most[3], extent.most[2]];
    // A free sample on each side.
    let size = [west + east, north + south].map(|side| (side / apart).ceil() + 2.0);
    if !size.iter().all(|side| (0.0..1e6).contains(side)) || size[0] * size[1] > 268_435_456.0 {
        return None;
    }
    let middle = [0.5 * (east - west), 0.5 * (north - south)];
    let camera = Camera::parallel(gaze, middle, extent.depths, 1.0 / apart, size.map(|side| 0.5 * side));
    let [width, height] = size.map(|side| side as u32);
    let window = Window { columns: 0..width, rows: 0..height, shifts: UPRIGHT };
    let mut film = Film::default();
    film.clear(&window);
    for face in &mesh.faces {
        let corner = |corner: u32| camera.project(Vec3::from_array(mesh.vertices[corner as usize].position()));
        if let [Some(a), Some(b), Some(c)] = face.indices().map(corner) {
            film.deepen(&[a, b, c], &window);
        }
    }
    let covers = |column: u32, row: u32| film.covers(window.index(column, row));
    let (mut covered, mut changes) = (0_u64, 0_u64);
    for row in 1..height {
        for column in 1..width {
            let here = covers(column, row);
            covered += u64::from(here);
            changes += u64::from(here != covers(column - 1, row)) + u64::from(here != covers(column, row - 1));
        }
    }
    let (area_m2, outline_m) = (covered as f32 * apart * apart, FRAC_PI_4 * changes as f32 * apart);
    Some(Silhouette { area_m2, outline_m, error_m2: (OF_OUTLINE * outline_m * apart * apart * apart).sqrt() })
}
