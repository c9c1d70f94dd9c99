//! Forms from near: they fit their boxes, have the areas that are stated, and are finer at each detail.

use super::super::super::chunk::{Face, Tag, Vertex};
use super::super::super::measure::{assert_unit_normals, outward_share, surface};
use super::super::{Placement, Point};
use super::*;
use bytemuck::Zeroable;
use phytomer_looks::{Blade, Margin};

/// The lengths and widths of organs, metres.
const SIZES: [[f32; 2]; 6] = [[0.2, 0.08], [0.1, 0.12], [1.0, 1.0], [3.0, 0.4], [0.06, 0.0012], [0.05, 0.05]];

fn placed(form: &FormMesh, size: [f32; 2], fullness: f32) -> (Vec<Vertex>, Vec<Face>) {
    let tag = Tag { colour: [0; 4], birth: 0.0, death: 1.0, component: 3, kind: 2 };
    let place = Placement { base: [1.0, 2.0, 3.0], heading: [0.0, 0.6, 0.8], up: [0.0, -0.8, 0.6], size, fullness };
    let mut vertices = vec![Vertex::zeroed(); form.points.len()];
    form.write(&place, &[tag, tag], &mut vertices);
    (vertices, form.faces.iter().map(|&face| Face::new(face)).collect())
}

/// The area of one side: of sheets that of their triangles, of stalks and other closed parts half of their surface.
fn area(form: &FormMesh, size: [f32; 2], fullness: f32) -> f64 {
    let (vertices, faces) = placed(form, size, fullness);
    let closed = super::super::side::closed_parts(form);
    let part = |wanted: bool| -> Vec<Face> {
        faces.iter().zip(&closed).filter(|(_, closed)| **closed == wanted).map(|(face, _)| *face).collect()
    };
    surface(&vertices, &part(false)) + 0.5 * surface(&vertices, &part(true))
}

fn each(mut then: impl FnMut(FormName, u8, [f32; 2], &FormMesh)) {
    for form in FormName::ALL {
        for detail in 1..=MOST_DETAIL {
            for size in SIZES {
                then(form, detail, size, of_library(form.form(), detail, size, 0.0).0);
            }
        }
    }
}

#[test]
fn a_form_fits_its_box_and_its_normals_agree_with_its_triangles() {
    each(|form, detail, size, shape| {
        let inside = |p: &Point| p.at[0] >= -0.05 && p.at[0] <= 1.08 && p.at[1].abs() <= 0.56;
        assert!(shape.points.iter().all(inside), "{form:?} {detail} {size:?}");
        // A fan or a berry fifty times as long as wide is a needle: its rays and rings are slivers.
        let slim = size[1] < 0.2 * size[0];
        let (vertices, faces) = placed(shape, size, 1.0);
        assert_unit_normals(&vertices);
        let outward = outward_share(&vertices, &faces);
        let least = [0.0, 0.9, 0.95, 0.97][usize::from(detail)];
        assert!(slim || outward > least, "{form:?} {detail} {size:?}: {outward}");
    });
}

#[test]
fn an_organ_has_the_area_that_is_stated_at_every_detail() {
    each(|form, detail, size, _| {
        // Lobes around the end of a stalk reach as far aside as ahead: slimmer, their pleats alone are more area.
        let is_palmate = matches!(form.near(), Some(Near::Blade(blade)) if blade.margin == Margin::Palmate);
        if is_palmate && size[1] < 0.4 * size[0] {
            return;
        }
        for share in [0.3, 0.5, 0.7, 1.0] {
            let stated = share * size[0] * size[1];
            let shape = of_library(form.form(), detail, size, stated).0;
            let found = area(shape, size, shape.fullness(size, stated)) / f64::from(stated);
            assert!((found - 1.0).abs() < 8e-3, "{form:?} {detail} {size:?} {share}: {found}");
        }
    });
}

#[test]
fn the_grid_follows_the_detail_and_the_midrib_is_in_the_middle_of_the_texture() {
    for form in FormName::ALL.into_iter().filter(|form| form.near().is_some()) {
        let faces: Vec<usize> = (1..=3).map(|d| of_library(form.form(), d, [0.1, 0.05], 0.0).0.faces.len()).collect();
        assert!(faces[0] < faces[1] && faces[1] < faces[2] && faces[2] < 21_000, "{form:?}: {faces:?}");
    }
    let blade = leaf::leaf(&Blade { margin: Margin::Toothed, arch_deg: 80.0, ..Blade::default() }, 0.5, 3);
    let on_midrib = blade.points.iter().filter(|point| !point.stalk && point.at[1].abs() < 1e-7);
    assert!(on_midrib.clone().count() > 20 && on_midrib.clone().all(|point| point.texture[0] == 0.5));
}

/// The area between an ellipse's axes is π / 4 of the box: a flat entire blade of a rounded base and apex.
#[test]
fn a_flat_round_blade_is_an_ellipse() {
    use phytomer_looks::{Apex, Base};
    let round = Blade {
        stalk: 0.0,
        base: Base::Rounded,
        apex: Apex::Rounded,
        widest_at: 0.5,
        fold_deg: 0.0,
        arch_deg: 0.0,
        veins: 0,
        ..Blade::default()
    };
    for (detail, within) in [(1, 0.06), (2, 0.015), (3, 0.004)] {
        let share = leaf::leaf(&round, 0.5, detail).area_share(0.5);
        assert!((share / std::f64::consts::FRAC_PI_4 - 1.0).abs() < within, "{detail}: {share}");
    }
}

#[test]
fn a_rounder_berry_stays_closed_and_nears_the_sphere_of_its_corners() {
    use super::super::super::measure::{assert_closed, volume};
    let berry = FormName::Berry.form();
    let mut before = 0.0;
    for detail in 1..=3 {
        let (vertices, faces) = placed(of_library(berry, detail, [0.02, 0.02], 0.0).0, [0.02, 0.02], 1.0);
        assert_closed(&vertices, &faces);
        let share = volume(&vertices, &faces) / (std::f64::consts::PI / 6.0 * 8e-6);
        assert!(share > before && share < 1.03, "{detail}: {share}");
        before = share;
    }
    assert!(before > 0.92, "{before}");
}

#[test]
fn classes_of_proportions_are_steps_of_the_root_of_two() {
    assert_eq!([-12, -1, 0, 3].map(power_of_root_two), [1.0 / 64.0, 0.707_106_77, 1.0, 2.0 * std::f32::consts::SQRT_2]);
    let near = |aspect: f32| aspect_of(class([1.0, aspect])) / aspect;
    assert!((1..2000).map(|k| near(0.02 + 0.002 * k as f32)).all(|off| (0.84..1.19).contains(&off)));
    let unseen = [class([1.0, f32::NAN]), class([0.0, 0.0]), class([1.0, 0.0])];
    assert_eq!((unseen, class([0.0, 1.0])), ([0; 3], CLASSES - 1));
}

/// However many corners its parts have, the form of a bunch is as high and as deep as it is wide. Some are tried,
/// and that of the fruits of an oil palm.
#[test]
fn a_cluster_of_many_stays_a_cluster() {
    for form in FormName::ALL.into_iter().step_by(6).chain([FormName::Drupe]) {
        let (flower, middle) = (None, 0.5);
        let bunch = Cluster { count: 240, form, flower, stalk: 0.66, width: 0.8, spread_deg: 165.0, middle };
        // Where it has too many corners it has the grid of a lower detail, or fewer parts.
        let made = made(&Near::Cluster(bunch), 0.7, 3);
        assert!(made.points.len() <= MOST_CORNERS && made.faces.len() > 240, "{form:?}");
        let extent = |k: usize| {
            let far = made.points.iter().map(|point| point.at[k]);
            far.clone().fold(0.0, f32::max) - far.fold(0.0, f32::min)
        };
        assert!(extent(1) > 0.6 && extent(2) > 0.8 * extent(1), "{form:?}: {} {}", extent(1), extent(2));
    }
    // None of sixty grains is missing.
    let parts = Cluster {
        count: 60,
        form: FormName::Berry,
        flower: None,
        stalk: 0.3,
        width: 0.9,
        spread_deg: 100.0,
        middle: 0.0,
    };
    assert!(made(&Near::Cluster(parts), 0.7, 2).faces.len() > 60 * 100);
}
