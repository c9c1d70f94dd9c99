//! The library of forms: unit boxes, normals, planes, closed solids and areas.
//!
//! Every form is drawn at several sizes and measured. Absent: forms from mesh files (`own/tests`).

use super::super::chunk::Face;
use super::super::measure::{assert_closed, assert_unit_normals, outward_share, surface, volume};
use super::*;
use bytemuck::Zeroable;
use phytomer_looks::FormName;
use std::collections::BTreeSet;

const FORMS: [FormName; FormName::ALL.len()] = FormName::ALL;

/// The construction of a form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Build {
    /// A blade in one piece: a leaf, petal or sepal that is not compound.
    Blade,
    /// One or several closed surfaces.
    Solid,
    /// Several blades, with or without the axis that bears them.
    Compound,
}

/// A new form must be entered here, or the match does not compile.
fn build(form: FormName) -> Build {
    use FormName::*;
    match form {
        Elliptic | Lanceolate | Deltoid | Needle | Obovate | Cordate | Palmate | Linear => Build::Blade,
        Arching | Paddle | Fan | Leaflet | Fascicle | Scale | Petal | Sepal => Build::Blade,
        Oval | Triangle | ThreeLobeOak | ThreeLobeMaple | FiveLobeMaple | ThreeLeaflets => Build::Blade,
        Berry | Cone | Catkin | Spikelet | Cherry | Apple | Capsule | Nut => Build::Solid,
        Drupe | Finger | Pod | Stamen | Pistil => Build::Solid,
        Palm | Corolla | Pinnate | Rosette | Tuft | Spray | Panicle | Cyme => Build::Compound,
    }
}

fn built(as_a: Build) -> impl Iterator<Item = FormName> {
    FORMS.into_iter().filter(move |form| build(*form) == as_a)
}

fn shape(form: FormName) -> &'static FormMesh {
    super::shape(form.form())
}

fn placed(form: FormName, size: [f32; 2]) -> (Vec<Vertex>, Vec<Face>) {
    fuller(form, size, 1.0)
}

fn fuller(form: FormName, size: [f32; 2], fullness: f32) -> (Vec<Vertex>, Vec<Face>) {
    let tag = Tag { colour: [0; 4], birth: 0.0, death: 1.0, component: 3, kind: 2 };
    let place = Placement { base: [1.0, 2.0, 3.0], heading: [0.0, 0.6, 0.8], up: [0.0, -0.8, 0.6], size, fullness };
    let shape = shape(form);
    let mut vertices = vec![Vertex::zeroed(); shape.points.len()];
    shape.write(&place, &[tag, tag], &mut vertices);
    (vertices, shape.faces.iter().map(|&face| Face::new(face)).collect())
}

#[test]
fn every_form_fits_its_box_and_its_normals_agree_with_its_triangles() {
    for form in FORMS {
        let inside = |p: &Point| p.at[0] >= -0.01 && p.at[0] <= 1.01 && p.at[1].abs() <= 0.51;
        assert!(shape(form).points.iter().all(inside), "{form:?}");
        let corners: BTreeSet<u32> = shape(form).faces.iter().flatten().copied().collect();
        assert!(corners.into_iter().eq(0..shape(form).points.len() as u32), "{form:?}: readers drop idle vertices");
        for size in [[0.2, 0.08], [0.1, 0.12], [1.0, 1.0]] {
            let (vertices, faces) = placed(form, size);
            assert_unit_normals(&vertices);
            assert_eq!(outward_share(&vertices, &faces), 1.0, "{form:?} {size:?}");
        }
    }
}

/// The area of one side: of plane polygons their area, of closed surfaces half of it. The rachis of a palm and the tube
/// of a corolla are open at their ends.
fn area(form: FormName, size: [f32; 2], fullness: f32) -> f64 {
    let (vertices, faces) = fuller(form, size, fullness);
    let is_plane = |face: &Face| {
        let corner = face.indices()[0];
        shape(form).polygons.iter().any(|&[first, count]| (first..first + count).contains(&corner))
    };
    let (plane, round): (Vec<Face>, Vec<Face>) = faces.into_iter().partition(is_plane);
    let sides = if matches!(form, FormName::Palm | FormName::Corolla) { 1.0 } else { 2.0 };
    surface(&vertices, &plane) + surface(&vertices, &round) / sides
}

#[test]
fn forms_have_the_share_of_area_that_species_are_told() {
    let shares = FORMS.map(|form| area(form, [1.0, 0.5], 1.0) / 0.5);
    let told = FORMS.map(|form| f64::from(form.area_share()));
    let near = |(share, told): (&f64, &f64)| (share / told - 1.0).abs() < 1e-3;
    assert!(shares.iter().zip(&told).all(near), "{shares:.4?}, not {told:?}");
}

#[test]
fn an_organ_has_the_area_that_is_stated_whatever_its_form_and_proportions() {
    for form in FORMS {
        for size in [[0.2, 0.08], [0.1, 0.12], [1.0, 1.0], [3.0, 0.4]] {
            for share in [0.05, 0.3, 0.7, 1.0, 2.5] {
                let stated = share * size[0] * size[1];
                let fullness = shape(form).fullness(size, stated);
                let found = area(form, size, fullness) / f64::from(stated);
                assert!((found - 1.0).abs() < 2e-3, "{form:?} {size:?} {share}: {found}");
                let (vertices, faces) = fuller(form, size, fullness);
                assert_unit_normals(&vertices);
                // Solids that are far wider than long keep the normals of their own proportions, which lean too far.
                let outward = build(form) == Build::Solid || outward_share(&vertices, &faces) == 1.0;
                assert!(outward, "{form:?} {size:?} {share}");
            }
        }
        assert_eq!(shape(form).fullness([0.1, 0.05], 0.0), 1.0, "no area is stated");
        assert_eq!(shape(form).fullness([0.0, 0.05], 0.1), 1.0, "an organ without length");
    }
}

#[test]
fn normals_are_unit_at_any_size() {
    for (form, size) in FORMS.iter().flat_map(|&form| [(form, [0.0, 0.0]), (form, [1e-6, 1e-6]), (form, [3.0, 0.0])]) {
        assert_unit_normals(&placed(form, size).0);
    }
}

#[test]
fn blades_are_assemblies_of_at_most_four_plane_convex_polygons() {
    for form in built(Build::Blade) {
        let shape = shape(form);
        assert!((1..=4).contains(&shape.polygons.len()), "{form:?}");
        let corners: u32 = shape.polygons.iter().map(|polygon| polygon[1]).sum();
        assert_eq!(corners as usize, shape.points.len(), "{form:?} has nothing else");
    }
}

/// Every polygon of every form lies in a plane and turns one way.
#[test]
fn polygons_are_plane_and_convex() {
    for (form, &[first, count]) in FORMS.iter().flat_map(|form| shape(*form).polygons.iter().map(move |p| (form, p))) {
        let corners = &shape(*form).points[first as usize..(first + count) as usize];
        let normal = corners[0].normal;
        let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let minus = |a: [f32; 3], b: [f32; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
        for (k, corner) in corners.iter().enumerate() {
            assert!(dot(minus(corner.at, corners[0].at), normal).abs() < 1e-5, "{form:?}: corner {k} is out of plane");
            let [next, after] = [1, 2].map(|n| corners[(k + n) % corners.len()].at);
            let turn = crate::tube::cross(minus(next, corner.at), minus(after, next));
            assert!(dot(turn, normal) > -1e-6, "{form:?}: the polygon of corner {k} is hollow");
        }
    }
}

#[test]
fn solids_are_closed_and_face_outward() {
    for form in built(Build::Solid) {
        let (vertices, faces) = placed(form, [0.05, 0.02]);
        assert_closed(&vertices, &faces);
        assert!(volume(&vertices, &faces) > 0.0, "{form:?}");
    }
}

#[test]
fn a_berry_is_closed_and_nearly_a_sphere() {
    let (vertices, faces) = placed(FormName::Berry, [0.02, 0.02]);
    assert_closed(&vertices, &faces);
    let ball = std::f64::consts::PI / 6.0 * 8e-6;
    assert!((0.6..1.0).contains(&(volume(&vertices, &faces) / ball)));
}
