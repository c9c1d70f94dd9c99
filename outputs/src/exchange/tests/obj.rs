//! OBJ files: what is in them, counted, and areas against closed forms.

use super::{text, trips, written};
use crate::exchange::{Description, Standing};

/// A triangle: its group, its material and its corners.
type Face = (String, String, [usize; 3]);

/// Vertices and triangles of a text, with the group and the material of each triangle.
fn faces(text: &str) -> (Vec<[f64; 3]>, Vec<Face>) {
    let (mut points, mut found) = (Vec::new(), Vec::new());
    let (mut group, mut material) = (String::new(), String::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[0] {
            "v" => points.push([1, 2, 3].map(|k| words[k].parse().unwrap())),
            "g" => words[1].clone_into(&mut group),
            "usemtl" => words[1].clone_into(&mut material),
            "f" => {
                let corner = |k: usize| words[k].split('/').next().unwrap().parse::<usize>().unwrap() - 1;
                found.push((group.clone(), material.clone(), [1, 2, 3].map(corner)));
            }
            _ => {}
        }
    }
    (points, found)
}

fn area(points: &[[f64; 3]], [a, b, c]: [usize; 3]) -> f64 {
    let less = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k] - q[k]);
    let across = crate::exchange::vectors::cross(less(points[b], points[a]), less(points[c], points[a]));
    crate::exchange::vectors::norm(across) / 2.0
}

fn wood(plant: &Description) -> f64 {
    let (points, found) = faces(&text(&written("obj", plant).0));
    found.iter().filter(|face| face.1 == "internode").map(|face| area(&points, face.2)).sum()
}

#[test]
fn a_cylinder_has_the_area_of_its_polygon() {
    let mut plant = trips::stem(&[(2.0, 0.3, 0.3)]);
    // Twelve strips as long as the stem and as wide as a side of a polygon in a circle of its radius.
    let side = 2.0 * 0.15 * phytomer_sim::math::sin(std::f64::consts::PI / 12.0);
    let expected = 12.0 * 2.0 * side;
    assert!((wood(&plant) / expected - 1.0).abs() < 1e-6);
    // Of a stem that ends in a point half of that, but for the slant of the strips.
    plant.individuals[0].entities[2].latest_mut().tip_diameter = Some(0.0);
    let apothem = 0.15 * phytomer_sim::math::cos(std::f64::consts::PI / 12.0);
    let slant = (4.0 + apothem * apothem).sqrt();
    assert!((wood(&plant) / (12.0 * side * slant / 2.0) - 1.0).abs() < 1e-6);
}

#[test]
fn a_plant_that_stands_elsewhere_is_as_large_and_lies_where_it_leans() {
    let mut plant = trips::stem(&[(2.0, 0.3, 0.3)]);
    let upright = wood(&plant);
    // A quarter turn towards north, twice as large.
    let quarter = std::f64::consts::FRAC_PI_2;
    plant.individuals[0].standing =
        Some(Standing { place: [10.0, 0.0, 1.0], scale: 2.0, azimuth: quarter, inclination: quarter, twist: 0.7 });
    assert!((wood(&plant) / (4.0 * upright) - 1.0).abs() < 1e-6);
    let (points, _) = faces(&text(&written("obj", &plant).0));
    let most = |k: usize| points.iter().map(|point| point[k]).fold(f64::NEG_INFINITY, f64::max);
    assert!((most(1) - 4.0).abs() < 1e-6 && (most(2) - 1.3).abs() < 0.02, "{} {}", most(1), most(2));
}

#[test]
fn components_are_groups_and_kinds_are_materials() {
    let plant = trips::plant(3, 40);
    let (out, losses) = written("obj", &plant);
    let (points, found) = faces(&text(&out));
    let mut groups: Vec<&str> = found.iter().map(|face| face.0.as_str()).collect();
    groups.dedup();
    let placed =
        plant.individuals[0].entities.iter().filter(|entity| entity.latest().is_some_and(|seen| seen.place.is_some()));
    assert_eq!(groups.len(), placed.count());
    let library = String::from_utf8(out.beside["plant.mtl"].clone()).unwrap();
    let mut named: Vec<&str> = library.lines().filter_map(|line| line.strip_prefix("newmtl ")).collect();
    named.sort_unstable();
    assert_eq!(named, ["flower", "fruit", "internode", "leaf"]);
    let mut used: Vec<&str> = found.iter().map(|face| face.1.as_str()).collect();
    used.sort_unstable();
    used.dedup();
    assert_eq!(used, named);
    assert!(found.iter().flat_map(|face| face.2).all(|corner| corner < points.len()));
    // Readers want the other lists as long as that of vertices.
    let lines = text(&out);
    let count = |word: &str| lines.lines().filter(|line| line.starts_with(word)).count();
    assert_eq!((count("vt "), count("vn ")), (points.len(), points.len()));
    assert_eq!(
        losses,
        [format!("lost: links, ages and features of entities ({}): the format has meshes alone", plant.entities())]
    );
}
