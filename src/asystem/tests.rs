//! Stages held against the equations: places of tips under a segment's transforms, trees that are joined, frames, and
//! what the models refuse.

use super::stage::Stage;
use super::*;
use phytomer_asystem::Step;
use std::fs;
use std::path::Path;

fn steps(script: &str) -> Vec<Step> {
    checked(script).unwrap_or_else(|refused| panic!("{refused}")).steps
}

/// Runs a script, and what it wrote and told.
fn run(script: &str, folder: &Path) -> Written {
    let mut stage = Stage::new(folder);
    let mut all = Written::default();
    for step in steps(script) {
        let written = stage.take(&step).unwrap();
        all.files.extend(written.files);
        all.told += &written.told;
    }
    stage.end(&mut all).unwrap();
    all
}

fn told(script: &str) -> String {
    checked(script).map_or_else(|refused| refused.to_string(), |_| String::new())
}

/// The ends of all branches of a tree after a script.
fn tips(script: &str, name: &str) -> Vec<[f64; 3]> {
    let mut stage = Stage::new(Path::new("nowhere"));
    steps(script).iter().for_each(|step| drop(stage.take(step).unwrap()));
    let tree = stage.cast.trees[name].clone();
    let (plant, age) = grown::plant_of(&tree, 1, u32::MAX).unwrap();
    let grown = files::Grown { name, tree: &tree, plant: &plant, age };
    files::drawing_of(&[grown]).branches.iter().map(|branch| branch.ends[1]).collect()
}

fn near(a: [f64; 3], b: [f64; 3], within: f64) -> bool {
    (0..3).all(|k| (a[k] - b[k]).abs() <= within)
}

/// Aono & Kunii 1984, Table 4, row 11a: the first children of a first branch of 10 under (0.3, 0.3, -0.3).
#[test]
fn a_tree_that_deviates_has_the_first_children_of_the_equations() {
    let script = "divergence 140; create gmt1 a 1 .9 .8 0 -45; deform a on off off .3 .3 -.3;";
    let tips = tips(script, "a");
    assert_eq!(tips.len(), 3);
    assert!(near(tips[1], [0.3, 0.3, 18.7], 1e-5), "{tips:?}");
    assert!(near(tips[2], [5.956854, 0.3, 15.356854], 1e-5), "{tips:?}");
}

#[test]
fn a_segment_moves_zooms_and_turns_a_tree() {
    let tree = "create gmt1 a 3 .9 .8 20 -40 1 2 0 1 2 10;";
    let (plain, zoomed) =
        (tips(tree, "a"), tips(&format!("{tree} abs_zoom a 2; rel_zoom a 1.5; abs_translate a 5 0 1;"), "a"));
    for (a, b) in plain.iter().zip(&zoomed) {
        let expected = [1.0 + 5.0 + 3.0 * (a[0] - 1.0), 2.0 + 3.0 * (a[1] - 2.0), 1.0 + 3.0 * a[2]];
        assert!(near(*b, expected, 1e-4), "{b:?} {expected:?}");
    }
    // A quarter turn takes x to y, and z stays.
    let turned = tips(&format!("{tree} abs_rotate a 60; rel_rotate a 30;"), "a");
    for (a, b) in plain.iter().zip(&turned) {
        assert!(near(*b, [1.0 - (a[1] - 2.0), 2.0 + (a[0] - 1.0), a[2]], 1e-4), "{b:?}");
    }
    assert_eq!(tips(&format!("{tree} rel_zoom a 3; rel_rotate a 9; rel_translate a 1 1 1; release a;"), "a"), plain);
}

#[test]
fn trees_are_combined_glued_and_cut() {
    let of = |script: &str| tips(script, "a").len();
    assert_eq!(of("create gmt3 a 3 .8 .7 .7 30 -30;"), 40, "(3^4 - 1) / 2");
    // Two levels of two children, then one of three: 1 + 2 + 4 + 12.
    assert_eq!(of("combine a 3 gmt1 1 2 .9 .8 20 -40 gmt3 3 3 .8 .7 .7 30 -30;"), 19);
    let two = "create gmt1 b 2 .9 .8 20 -40; create gmt3 c 1 .8 .7 .7 30 -30;";
    assert_eq!(of(&format!("{two} glue b c a;")), 7 + 4);
    // The main axis of a monopodial tree is cut from level 2 on: what stands on its second branch and beyond is gone.
    assert_eq!(of("create gmt1 a 3 .9 .8 0 -40;"), 15);
    assert!(of("cut_axis on 2; create gmt1 a 3 .9 .8 0 -40;") < 15);
    assert_eq!(of("cut_lateral on 1; create gmt1 a 3 .9 .8 0 -40;"), 4, "the main axis alone");
    assert!((5..15).contains(&of("cut_lateral on 1 {{1} {3}}; create gmt1 a 3 .9 .8 0 -40;")));
    assert_eq!(of("cut_axis on 2; cut_axis off; create gmt1 a 3 .9 .8 0 -40;"), 15);
}

#[test]
fn workstations_write_their_files_into_one_folder() {
    let folder = tempfile::tempdir().unwrap();
    let script = "open d display; open p plotter; open m model; create gmt1 a 4 .9 .8 20 -40; girth a on;\n\
        leaf a gmt1 elliptic 4 0 128 0; shadow a gmt1 20 -20 60 90 90 90; port d top 0 .5 1 .5; port d front 0 1 .5 0;\n\
        window p -20 20 40 -2; cont on 2; create gmt1 b 2 .9 .8 20 -40; cluster c a b; animate gmt1 b 2; flush c 1;\n\
        defer .5; animate gmt1 a 1; exit;";
    let written = run(script, folder.path());
    let names: Vec<String> =
        written.files.iter().map(|path| path.file_name().unwrap().to_string_lossy().into_owned()).collect();
    // Of b three levels of two steps, of c two trees, of a two levels.
    let frames = |name: &str| names.iter().filter(|file| file.starts_with(&format!("{name}-0"))).count();
    assert_eq!((frames("d"), frames("p"), frames("m")), (6 + 2 + 2, 6 + 2 + 2, 0), "{names:?}");
    for name in ["d.png", "p.svg", "m.ply", "d-frames.txt", "p-frames.txt"] {
        assert!(names.iter().any(|file| file == name), "{name} in {names:?}");
    }
    let times = fs::read_to_string(folder.path().join("d-frames.txt")).unwrap();
    assert!(
        times.starts_with("ffconcat version 1.0\nfile 'd-0000.png'\nduration 0.2\n") && times.contains("duration 1\n")
    );
    assert!(times.ends_with("duration 0.5\n"));
    assert!(written.files.iter().all(|path| path.parent() == Some(folder.path()) && path.is_file()));
}

#[test]
fn what_is_informed_is_a_species_that_grows_the_same_tree() {
    let folder = tempfile::tempdir().unwrap();
    let script = "divergence 2/5; create gmt3 a 4 .8 .7 .7 30 -30; deform a on on off 0 0 -.2 {1 3 1.5 30 0 30};\n\
        leaf a gmt3 elliptic 3 0 128 0; abs_zoom a .5; inform a; inquire c; help glue; help;";
    let told = run(&format!("create gmt1 z 1 .9 .8 20 -40; cluster c z; {script}"), folder.path()).told;
    let (species, rest) = told.split_at(told.find("z: gmt1, growth level 1, at 0 0 0").unwrap());
    assert!(rest.contains("glue tree1 tree2 tree3") && rest.matches("create type tree level").count() == 1);
    let path = folder.path().join("a.toml");
    fs::write(&path, species).unwrap();
    let found = phytomer_config::validate(path.to_str().unwrap());
    assert!(found.is_ok(), "{}\n{species}", found.err().map(|report| report.render(false)).unwrap_or_default());
}

#[test]
fn what_the_models_refuse_is_told_before_anything_is_drawn() {
    let explodes = told("exit; ").is_empty() && told("create gmt1 a 25 .9 .8 20 -40;").contains("would have");
    assert!(explodes, "{}", told("create gmt1 a 25 .9 .8 20 -40;"));
    assert!(
        told("create gmt1 a 3 .9 .8 0 0;").starts_with("1:1: the tree `a`, h2_deg"),
        "{}",
        told("create gmt1 a 3 .9 .8 0 0;")
    );
    let crossed = told("\n  create gmt4 a 3 .9 .8 1 20 60 -20 -60;");
    assert!(crossed.starts_with("2:3: the tree `a`"), "{crossed}");
    for shorter in [10, 25] {
        let gone = told(&format!("create gmt1 a 3 .9 .8 20 -40; deform a off off on 0 0 0 -{shorter};"));
        assert!(gone.contains("1:31: the tree `a`, first_length_m"), "{shorter}: {gone}");
    }
    let leaf = told("create gmt1 a 3 .9 .8 20 -40; leaf a gmt1 eliptic 3 0 99 0;");
    assert!(leaf.contains("the nearest is `elliptic`"), "{leaf}");
}

/// The star of Fig. 23: in every kind of workstation, at the place of the controller as the tree stands.
#[test]
fn controllers_are_stars_while_the_valuator_is_active() {
    let folder = tempfile::tempdir().unwrap();
    let tree = "create gmt1 a 3 .9 .8 20 -40 1 2 0 1 2 10; deform a off on off {1 3 .5 31 2 0 1 3 -.5 1 12 5};";
    let script = format!("{tree} abs_zoom a 2; abs_translate a 1 1 1; abs_rotate a 90;");
    let mut stage = Stage::new(folder.path());
    steps(&script).iter().for_each(|step| drop(stage.take(step).unwrap()));
    let stars = stage.cast.trees["a"].controllers();
    // From the root (1, 2, 0): (30, 0, 0) and (0, 10, 5), twice as large, a quarter turn on.
    for ((place, pulls), expected) in stars.iter().zip([([2.0, 63.0, 1.0], true), ([-18.0, 3.0, 11.0], false)]) {
        assert!(near(*place, expected.0, 1e-9) && *pulls == expected.1, "{stars:?}");
    }
    assert_eq!(stars.len(), 2);
    let open = "open d display; open p plotter; open m model;";
    run(&format!("{open} {tree} exit;"), folder.path());
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    let without = ["d.png", "p.svg", "m.ply"].map(read);
    let active = "activate d valuator; activate p valuator; activate m valuator;";
    run(&format!("{open} {active} {tree} exit;"), folder.path());
    let with = ["d.png", "p.svg", "m.ply"].map(read);
    assert!(without.iter().zip(&with).all(|(a, b)| a != b));
    let paths = |svg: &[u8]| String::from_utf8_lossy(svg).matches("<path d").count();
    // A filled star, an outline and what it encloses.
    assert_eq!(paths(&with[1]), paths(&without[1]) + 3);
    let vertices = |ply: &[u8]| {
        let text = String::from_utf8_lossy(ply).into_owned();
        let line = text.lines().find_map(|line| line.strip_prefix("element vertex ").map(str::to_owned));
        line.and_then(|count| count.parse::<usize>().ok()).unwrap()
    };
    assert!(vertices(&with[2]) > vertices(&without[2]));
    let closed = "deactivate d valuator; deactivate p valuator; deactivate m valuator;";
    run(&format!("{open} {active} {tree} {closed} exit;"), folder.path());
    assert_eq!(["d.png", "p.svg", "m.ply"].map(read), without);
}

/// The wood of a model has the colour of the tree; without one it is bark.
#[test]
fn the_wood_of_a_model_has_the_colour_of_its_tree() {
    let folder = tempfile::tempdir().unwrap();
    let drawn = |colour: &str| {
        let script =
            format!("open m model; create gmt1 a 2 .9 .8 20 -40; leaf a gmt1 elliptic 2 0 128 0; {colour} exit;");
        run(&script, folder.path());
        let mut stage = Stage::new(folder.path());
        steps(&script).iter().for_each(|step| drop(stage.take(step).unwrap()));
        let tree = stage.cast.trees.get("a").cloned().unwrap();
        let (plant, age) = grown::plant_of(&tree, 1, u32::MAX).unwrap();
        let mesh = phytomer_outputs::meshes::mesh_plant(&plant, age, &phytomer_outputs::meshes::MeshOptions::default());
        let colours: std::collections::BTreeSet<[u8; 4]> =
            mesh.vertices.iter().map(|vertex| vertex.tag().colour).collect();
        (colours, fs::read(folder.path().join("m.ply")).unwrap())
    };
    let (bark, plain) = drawn("");
    let (red, painted) = drawn("color a 200 30 20;");
    let wood = |colour: &[u8; 4]| colour[..3] == [200, 30, 20];
    assert!(red.iter().any(wood) && !bark.iter().any(wood), "{red:?} {bark:?}");
    // Leaves and their stalks stay as they are.
    assert!(red.len() == 3 && red.iter().all(|own| wood(own) || bark.contains(own)), "{red:?} {bark:?}");
    assert_eq!((plain.len(), plain == painted), (painted.len(), false));
}

#[test]
fn workstations_that_differ_in_capitals_alone_are_refused() {
    for script in ["open a display; open A plotter;", "open oak display; close oak; open OAK display;"] {
        assert!(told(script).contains("differ in capitals alone"), "{script}: {}", told(script));
    }
    assert_eq!(told("open a display; close a; open a plotter; open b display;"), "");
}
