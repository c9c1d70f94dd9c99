//! Organs from near: each leaf of each shipped species has the area of the tables at each detail, and what cannot be
//! drawn is refused.
//!
//! Areas are summed from the triangles of single organs, closed parts by half of their surface, as in the tables
//! (Chen & Black 1992). Absent: the forms by themselves, whose tests stand beside them.

mod program;
#[path = "program/side_by_side.rs"]
mod side_by_side;

use phytomer::outputs::meshes::{Joints, Mesh, MeshOptions, Scene, mesh_plant};
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::plant::{Class, Kind as Kinds, OrganId, Plant};
use phytomer_config::{Kind, presets, validate_species};
use phytomer_triangles::{self as triangles, Triangle};
use program::{program as phytomer_program, run, said};
use side_by_side::each;
use std::collections::BTreeSet;
use std::fs;
use tempfile::tempdir;

/// The most leaves of a species that are measured at the details 2 and 3, evenly over all of them.
const MEASURED: usize = 120;

/// The triangles of a mesh.
fn triangles_of(mesh: &Mesh) -> Vec<Triangle> {
    let at = |corner: u32| mesh.vertices[corner as usize].position().map(f64::from);
    mesh.faces.iter().map(|face| face.indices().map(at)).collect()
}

/// The largest share by which a leaf is off its area, and how many were measured.
fn off(plant: &Plant, age: u32, detail: u8, most: usize) -> (f64, usize) {
    let scene = Scene::new(plant, age, &MeshOptions { detail, ..MeshOptions::default() });
    let is_leaf = |organ: &OrganId| plant.organs.kind[organ.index()].class() == Class::Leaf;
    let leaves: Vec<OrganId> =
        scene.organs().filter(is_leaf).filter(|o| plant.organ_area::<f64>(*o, age) > 0.0).collect();
    let step = leaves.len().div_ceil(most).max(1);
    let offs = leaves.iter().step_by(step).map(|organ| {
        let stated: f64 = plant.organ_area(*organ, age);
        (triangles::one_side(&triangles_of(&scene.mesh_of(*organ))) / stated - 1.0).abs()
    });
    let offs: Vec<f64> = offs.collect();
    (offs.iter().copied().fold(0.0, f64::max), offs.len())
}

#[test]
fn leaves_of_every_shipped_species_have_their_areas_at_every_detail() {
    let of_species = each(presets(Kind::Species).to_vec(), |(name, _)| {
        let (mut wrong, mut measured) = (Vec::new(), 0);
        let species = validate_species(name, 1).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let age = species.shown_at().min(40);
        let species = validate_species(name, age).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let shown = Regrowth::of(&species.alone(name)).show(0, &[age], &mut |age, plant| {
            for detail in 0..=3 {
                let (off, count) = off(plant, age, detail, if detail < 2 { 2000 } else { MEASURED });
                measured += count;
                if off > 0.01 {
                    wrong.push(format!("{name} at detail {detail}: {off:.4}"));
                }
            }
            Ok(())
        });
        shown.unwrap_or_else(|error| panic!("{name}: {error}"));
        (wrong, measured)
    });
    let measured: usize = of_species.iter().map(|(_, measured)| measured).sum();
    let wrong: Vec<String> = of_species.into_iter().flat_map(|(wrong, _)| wrong).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(measured > 5000, "{measured} leaves");
}

fn picture(folder: &std::path::Path, words: &[&str]) -> Vec<u8> {
    run(folder, &[&["picture"], words, &["--size", "160x120", "--out", "p.png"]].concat()).ending(0);
    fs::read(folder.join("p.png")).expect("a picture")
}

#[test]
fn detail_0_is_the_default_and_a_focus_is_another_picture() {
    let folder = tempdir().expect("a temporary folder");
    let folder = folder.path();
    let plain = picture(folder, &["monocarp", "--age", "30"]);
    assert_eq!(plain, picture(folder, &["monocarp", "--age", "30", "--detail", "0"]));
    let near: Vec<Vec<u8>> = ["0", "1", "3"]
        .map(|detail| picture(folder, &["monocarp", "--age", "30", "--focus", "leaf", "--detail", detail]))
        .into();
    assert!(near[0] != plain && near[0] != near[1] && near[1] != near[2]);
    let draw = |threads: &str| {
        let words = ["picture", "monocarp", "--age", "31", "--focus", "flower", "--detail", "3", "--size", "200x150"];
        let words = [&words[..], &["--out", "t.png"]].concat();
        said(phytomer_program(folder, &words).env("RAYON_NUM_THREADS", threads).output().unwrap()).ending(0);
        fs::read(folder.join("t.png")).unwrap()
    };
    assert!(draw("1") == draw("5"), "threads");
}

/// A flower that is made of internodes fills a picture as an organ does.
#[test]
fn a_flower_of_internodes_is_found() {
    let folder = tempdir().expect("a temporary folder");
    let bytes = picture(folder.path(), &["dog_rose", "--age", "6", "--focus", "flower", "--detail", "1"]);
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("a picture");
    let step = info.color_type.samples();
    let pink = |pixel: &&[u8]| pixel[0] > 150 && pixel[0] > pixel[1] + 12 && pixel[2] > pixel[1];
    let pink = pixels.chunks_exact(step).filter(pink).count();
    assert!(10 * pink > 2 * 160 * 120, "{pink} of {} pixels are petals", 160 * 120);
    let none = run(folder.path(), &["picture", "dog_rose", "--age", "6", "--focus", "fruit", "--out", "no.png"]);
    assert_ne!(none.code, Some(0), "it has no fruit");
}

#[test]
fn a_mesh_from_near_has_more_triangles_and_the_same_components() {
    let folder = tempdir().expect("a temporary folder");
    let mesh = |detail: &str| {
        run(folder.path(), &["mesh", "monocarp", "--age", "30", "--detail", detail, "--out", "m.ply"]).ending(0);
        fs::read(folder.path().join("m.ply")).expect("a mesh").len()
    };
    let plain = mesh("0");
    run(folder.path(), &["mesh", "monocarp", "--age", "30", "--out", "n.ply"]).ending(0);
    assert_eq!(fs::read(folder.path().join("n.ply")).unwrap(), {
        mesh("0");
        fs::read(folder.path().join("m.ply")).unwrap()
    });
    assert!(mesh("1") > plain && mesh("3") > 4 * mesh("1"));
}

/// The bytes of a file that `mesh` makes of a plant.
fn meshed(folder: &std::path::Path, words: &[&str], out: &str) -> usize {
    run(folder, &[&["mesh"], words, &["--out", out]].concat()).ending(0);
    fs::metadata(folder.join(out)).expect("a mesh").len() as usize
}

/// Instances of one age, and a life, have one model for each form at its detail: what a file has more than at detail 0
/// does not grow with the number of leaves, as it does where they are merged.
#[test]
fn instances_from_near_cost_their_models_alone() {
    let folder = tempdir().expect("a temporary folder");
    for (out, more) in [("s.usdc", &[][..]), ("s.glb", &["--leaves", "instances"])] {
        let at = |age: &str, detail: &str| {
            meshed(folder.path(), &[&["coffee", "--age", age, "--detail", detail], more].concat(), out)
        };
        let added = at("24", "2") - at("24", "0");
        let merged = |detail: &str| {
            meshed(folder.path(), &["coffee", "--age", "24", "--leaves", "merged", "--detail", detail], out)
        };
        let all = merged("2") - merged("0");
        assert!(added > 1000 && 2 * added < all, "{out}: {added} of {all}");
    }
    let life = |detail: &str, out: &str| {
        meshed(folder.path(), &["coffee", "--ages", "4..16/4", "--detail", detail, "--tolerance", "2mm"], out)
    };
    let lives = ["0", "2"].map(|detail| life(detail, "l.usdc"));
    assert!(lives[1] > lives[0] && lives[1] < lives[0] + 200_000, "{lives:?}");
    assert!(life("1", "l.glb") > life("0", "l.glb"));
}

#[test]
fn a_page_from_near_has_the_forms_of_its_detail() {
    let folder = tempdir().expect("a temporary folder");
    let page = |detail: &str, threads: &str| {
        let words = ["view", "monocarp", "--ages", "10..34/8", "--detail", detail, "--out", "p.html"];
        let done = phytomer_program(folder.path(), &words).env("RAYON_NUM_THREADS", threads).output().unwrap();
        let told = said(done).ending(0).stdout;
        assert_eq!(told.contains(&format!(", detail {detail}, ")), detail != "0", "{told}");
        fs::read(folder.path().join("p.html")).expect("a page")
    };
    let pages = ["0", "1", "3"].map(|detail| page(detail, "2"));
    assert!(pages[0].len() < pages[1].len() && pages[1].len() < pages[2].len());
    assert!(pages[2].len() < pages[0].len() + 1_000_000, "{} {}", pages[0].len(), pages[2].len());
    assert!(page("3", "1") == pages[2], "threads");
}

#[test]
fn what_cannot_be_shown_from_near_is_refused() {
    let folder = tempdir().expect("a temporary folder");
    for (words, meant) in [
        (vec!["picture", "coffee", "--age", "24", "--detail", "9"], "9 is not in 0..=3"),
        (vec!["picture", "coffee", "--age", "24", "--focus", "root"], "`leaf`, `flower`, `fruit` or the number"),
        (vec!["picture", "monocarp", "--age", "10", "--focus", "fruit"], "has no fruit at age 10"),
        (vec!["picture", "coffee", "--age", "4", "--focus", "99999999"], "has no component 99999999 at age 4"),
        (vec!["picture", "coffee", "--ages", "4,8", "--focus", "leaf"], "this is for one plant at one age"),
        (vec!["mesh", "coffee", "--age", "4", "--detail", "9", "--out", "x.ply"], "9 is not in 0..=3"),
        (vec!["mesh", "coffee", "--age", "4", "--detail=-1", "--out", "x.ply"], "-1 is not in 0..=3"),
        (vec!["view", "coffee", "--detail", "9", "--out", "x.html"], "9 is not in 0..=3"),
        (vec!["animate", "coffee", "--detail", "9", "--out", "x.webp"], "9 is not in 0..=3"),
    ] {
        let out = if words.contains(&"--out") { &[][..] } else { &["--out", "x.png"] };
        let told = run(folder.path(), &[&words[..], out].concat()).ending(2);
        assert!(told.stderr.contains(meant), "{words:?}: {}", told.stderr);
    }
}

#[test]
fn settings_that_are_not_sound_are_faults() {
    let folder = tempdir().expect("a temporary folder");
    let leaf = |near: &str| {
        format!(
            "name = \"a\"\nmodel = \"buds\"\ntick = \"one year\"\n[[order]]\ninternode = {{ length_cm = 10 }}\n[order.leaf]\nnear = {near}\n"
        )
    };
    for (near, meant) in [
        ("{ blade = { stalk = 2 } }", "from 0 to 0.9"),
        ("{ blade = { fold_deg = 85, arch_deg = -300 } }", "the blade crosses itself"),
        ("{ blade = { margin = \"wavy\" } }", "toothed"),
        ("{ capitulum = { florets = 5000 } }", "from 20 to 1600"),
        ("{ flower = { petals = 1 } }", "from 2 to 40"),
        ("{ flower = { petal = { fold_deg = 85, arch_deg = -300 } } }", "the blade crosses itself"),
        ("{ blade = { margin = \"palmate\", divisions = 9, spread_deg = 10 } }", "from 30 to 350"),
        ("{ blade = { tears = -0.5 } }", "from 0 to 1"),
        ("{ blade = { stalks = 1 } }", "stalk"),
        ("{ brush = { needles = 1 } }", "from 2 to 300"),
        ("{ cluster = { count = 1 } }", "from 2 to 240"),
        ("{ cluster = { middle = 0.9 } }", "from 0 to 0.8"),
        ("{ cluster = { flower = { petal = { claw = 2 } } } }", "from 0 to 0.9"),
    ] {
        fs::write(folder.path().join("a.toml"), leaf(near)).unwrap();
        let told = run(folder.path(), &["validate", "a.toml"]).ending(3);
        assert!(told.stderr.contains(meant), "{near}: {}", told.stderr);
    }
    let stem = |near: &str| {
        format!(
            "name = \"a\"\nmodel = \"buds\"\ntick = \"one year\"\n[[order]]\ninternode = {{ length_cm = 10, near = {near} }}\n"
        )
    };
    for (near, meant) in [
        ("{ profile = [[0, 1], [0.5, 1]] }", "ascend from 0 to 1"),
        ("{ profile = [[0, 1], [1, 9]] }", "from 0.02 to 4"),
        ("{ leaf_bases = { width = 3 } }", "from 0.02 to 1.5"),
        ("{ head = 9 }", "from 1 to 3"),
        ("{ ranks = [3, 2] }", "a first rank from 1"),
        ("{ lobed_sides = [3] }", "0, 1 or 2"),
    ] {
        fs::write(folder.path().join("a.toml"), stem(near)).unwrap();
        let told = run(folder.path(), &["validate", "a.toml"]).ending(3);
        assert!(told.stderr.contains(meant) && told.stderr.contains("a.toml:5:"), "{near}: {}", told.stderr);
    }
    for sound in [
        leaf("{ blade = { margin = \"toothed\", divisions = 20 } }"),
        stem("{ profile = [[0, 1], [1, 1.2]], head = 1.3 }"),
    ] {
        fs::write(folder.path().join("a.toml"), sound).unwrap();
        run(folder.path(), &["validate", "a.toml"]).ending(0);
    }
}

/// The wood of a plant at a detail.
fn wood(plant: &Plant, age: u32, detail: u8, joints: Joints) -> Mesh {
    let kinds = Kinds::ALL.map(|kind| kind.class() == Class::Internode);
    mesh_plant(plant, age, &MeshOptions { detail, kinds, joints, ..MeshOptions::default() })
}

/// Swollen nodes and the rings of scars hardly change the volume of the wood, and leaf bases stand beside it: a stem of
/// each number is there at every detail. Welded wood keeps its frusta.
#[test]
fn wood_from_near_has_the_same_internodes_and_nearly_the_same_volume() {
    let volume = |mesh: &Mesh| triangles::volume(&triangles_of(mesh));
    let numbers =
        |mesh: &Mesh| -> BTreeSet<i32> { mesh.vertices.iter().map(|vertex| vertex.tag().component).collect() };
    for (name, age, within) in [("bamboo", 24, 0.04), ("coconut", 100, 0.04), ("oil_palm", 120, 0.4)] {
        let species = validate_species(name, age).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let shown = Regrowth::of(&species.alone(name)).show(0, &[age], &mut |age, plant| {
            let far = wood(plant, age, 0, Joints::Open);
            for detail in 1..=3 {
                let near = wood(plant, age, detail, Joints::Open);
                assert!(near.faces.len() > 2 * far.faces.len(), "{name} {detail}");
                assert_eq!(numbers(&near), numbers(&far), "{name} {detail}");
                let ratio = volume(&near) / volume(&far);
                assert!((ratio - 1.0).abs() < within, "{name} {detail}: {ratio}");
            }
            let [far, near] = [0, 3].map(|detail| wood(plant, age, detail, Joints::Welded));
            assert!(far.faces.len() == near.faces.len() && volume(&far) == volume(&near), "{name}");
            Ok(())
        });
        shown.unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
