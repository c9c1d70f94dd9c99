//! Levels of detail: each has at most the triangles that it may have, keeps the outline of the first from eight sides
//! within 3 %, and the area of the leaves, and its organs are some of those of the level before.
//!
//! Outlines are drawn anew here, finer than the search draws them, by `silhouette`, which counts samples on a lattice
//! of its own. Absent: files, which `lods` reads.

use phytomer::config::validate;
use phytomer::outputs::meshes::{MOST_LARGER, Mesh, MeshOptions, Scene, Thinned, mesh_plant};
use phytomer::outputs::pictures::levels::{Level, levels};
use phytomer::outputs::pictures::silhouette::silhouette;
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer::sim::math::sincos;
use phytomer::sim::plant::{Class, OrganId, Plant};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_4;

/// The bound of the outline, as a share.
const BOUND: f64 = 0.03;
/// The samples along the height of a plant.
const SAMPLES: f32 = 700.0;

/// The plants that are looked at, each with its age.
const PLANTS: [(&str, Tick); 7] = [
    ("coffee", 36),
    ("willow", 60),
    ("fir", 12),
    ("wild_cherry", 20),
    ("banana", 100),
    ("wp/quaking_aspen", 30),
    ("abop/2.8a", 6),
];

/// The first plant of a shipped scenario at an age.
fn plant((name, age): (&str, Tick)) -> (Plant, Tick) {
    let resolved = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let mut found = None;
    let shown = Regrowth::of(&resolved).show(0, &[age], &mut |age, plant| {
        found = Some((plant.clone(), age));
        Ok(())
    });
    shown.unwrap_or_else(|error| panic!("{name}: {error}"));
    found.unwrap_or_else(|| panic!("{name}: no plant"))
}

/// The areas of the outline from the eight sides, m².
fn outlines(mesh: &Mesh, apart: f32) -> [f64; 8] {
    std::array::from_fn(|side| {
        let (sin, cos) = sincos(side as f64 * FRAC_PI_4);
        f64::from(silhouette(mesh, [cos, sin, 0.0], apart).expect("an outline").area_m2)
    })
}

/// The distance of samples, metres.
fn apart(mesh: &Mesh) -> f32 {
    let heights = mesh.vertices.iter().map(|vertex| vertex.position()[2]);
    let (low, high) = heights.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
    (high - low) / SAMPLES
}

/// The area of the triangles of each organ of a class, by its number in the columns of the plant.
fn areas(scene: &Scene, class: Class) -> BTreeMap<OrganId, f64> {
    let of = |organ: &OrganId| scene.plant().organs.kind[organ.index()].class() == class;
    scene.organs().filter(of).map(|organ| (organ, area(&scene.mesh_of(organ)))).collect()
}

fn area(mesh: &Mesh) -> f64 {
    let of_face = |corners: [u32; 3]| {
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize].position().map(f64::from));
        let [u, v] = [b, c].map(|to| [0, 1, 2].map(|k| to[k] - a[k]));
        let cross = [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
        0.5 * cross.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    mesh.faces.iter().map(|face| of_face(face.indices())).sum()
}

fn found(name: &str, plant: &Plant, age: Tick, options: &MeshOptions, most: &[Option<u64>]) -> Vec<Level> {
    levels(plant, age, options, most).unwrap_or_else(|fault| panic!("{name}: {fault}"))
}

/// Prints what the levels of each plant have; the largest differences of area stay within the bound.
#[test]
fn outlines_hold_from_eight_sides() {
    for (name, age) in PLANTS {
        let (plant, age) = plant((name, age));
        let levels = found(name, &plant, age, &MeshOptions::default(), &[None; 3]);
        let first = mesh_plant(&plant, age, &MeshOptions::default());
        let lattice = apart(&first);
        let of_first = outlines(&first, lattice);
        for (number, level) in levels.iter().enumerate() {
            let mesh = mesh_plant(&plant, age, &level.options);
            assert_eq!(mesh.faces.len() as u64, level.faces, "{name} level {number}");
            let of_level = outlines(&mesh, lattice);
            let worst = of_level.iter().zip(&of_first).map(|(own, first)| (own - first) / first);
            let worst = worst.max_by(|a, b| a.abs().total_cmp(&b.abs())).expect("eight sides");
            println!(
                "{name} level {number}: {} faces, within {:?}, {:?}, area {:+.2} % ({:.2} %), either {:.2} %",
                level.faces,
                level.options.tolerance.map(|tolerance| tolerance.distance),
                level.options.thinned,
                100.0 * worst,
                100.0 * level.apart.area,
                100.0 * level.apart.either,
            );
            assert!(worst.abs() <= BOUND, "{name} level {number}: {worst}");
            if let Some(before) = number.checked_sub(1) {
                assert!(level.faces < levels[before].faces, "{name} level {number}");
            }
        }
        assert!(levels.len() > 1, "{name} has levels");
    }
}

/// Each leaf has k times its recorded area, all leaves together the recorded sum until k is two, and fewer organs are
/// some of more.
#[test]
fn fewer_leaves_keep_the_area() {
    for (name, age) in [("coffee", 36), ("fir", 8), ("wp/quaking_aspen", 30)] {
        let (plant, age) = plant((name, age));
        let organ_area = |organ: &OrganId| -> f64 { plant.organ_area(*organ, age) };
        let all = areas(&Scene::new(&plant, age, &MeshOptions::default()), Class::Leaf);
        let recorded: f64 = all.keys().map(organ_area).sum();
        let mut before: Vec<OrganId> = all.keys().copied().collect();
        for share in [0.9, 0.75, 0.6, 0.3] {
            let thinned = Thinned::of(&plant, age, share).expect("fewer organs");
            let k = thinned.larger[0];
            let options = MeshOptions { thinned: Some(thinned), ..MeshOptions::default() };
            let kept = areas(&Scene::new(&plant, age, &options), Class::Leaf);
            for (organ, area) in &kept {
                let own = k * organ_area(organ);
                assert!((area / own - 1.0).abs() < 0.01, "{name} {share}: {organ:?} {area} {own}");
            }
            let sum: f64 = kept.values().sum();
            if k < MOST_LARGER {
                assert!((sum / recorded - 1.0).abs() < 0.01, "{name} {share}: {sum} {recorded}");
            } else {
                assert!(share < 0.6 && sum < recorded, "{name} {share}: {k}");
            }
            assert!((kept.len() as f64 / all.len() as f64 - share).abs() < 0.1, "{name} {share}: {}", kept.len());
            assert!(kept.len() < before.len() && kept.keys().all(|organ| before.contains(organ)), "{name} {share}");
            before = kept.into_keys().collect();
        }
    }
}

/// Levels have at most what they may have and nearly all of it; what they have at least can be had.
#[test]
fn levels_have_at_most_the_triangles_that_they_may_have() {
    let (plant, age) = plant(("coffee", 36));
    let options = MeshOptions::default();
    let full = Scene::new(&plant, age, &options).counts().faces;
    let most = [full / 3, full / 7].map(Some);
    let levels = found("coffee", &plant, age, &options, &most);
    for (level, most) in levels[1..].iter().zip(most) {
        let most = most.expect("a count");
        assert!(level.faces <= most && level.faces > most / 2, "{} of {most}", level.faces);
    }
    let screens: Vec<f64> = levels.iter().map(|level| level.screen).collect();
    assert!(screens[0] > screens[1] && screens[1] > screens[2] && screens[2] == 0.0, "{screens:?}");
    let few = phytomer::outputs::pictures::levels::levels(&plant, age, &options, &[Some(9)]).expect_err("too few");
    assert_eq!((few.level, few.most), (1, 9));
    let least = found("coffee", &plant, age, &options, &[Some(few.least)]);
    assert!(least[1].faces <= few.least);
}
