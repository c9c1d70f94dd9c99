//! Material slots and a species' own textures, from its file to the readers of GLB, USD and OBJ: pictures are found
//! beside the species and stand in the node trees and materials of programs that know nothing of phytomer.
//!
//! The readers are those of `tests/glb.rs`, `tests/usd.rs` and `tests/external_readers.rs`; where they are missing the
//! tests skip and say so, but never in CI. Absent: bad pictures, and the pictures of a run (`materials`).

mod painted;
mod program;
#[path = "program/reading.rs"]
#[allow(dead_code, reason = "what scripts say is read here")]
mod reading;

use painted::{BY_ORDER, painted};
use program::run;
use reading::absent;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The JSON of a GLB file.
fn glb(path: &Path) -> Value {
    let bytes = fs::read(path).expect("a file");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).expect("JSON")
}

/// The names of a list of a GLB file.
fn names(file: &Value, list: &str) -> Vec<String> {
    let entries = file[list].as_array().map(Vec::as_slice).unwrap_or_default();
    entries.iter().map(|entry| entry["name"].as_str().unwrap_or_default().to_owned()).collect()
}

/// The modules of node; `None`, with the reason printed, where they are missing.
fn modules() -> Option<PathBuf> {
    let modules = Path::new(ROOT).join(".venv/node/node_modules");
    let node = Command::new("node").arg("--version").output().is_ok();
    if node && modules.join("three").is_dir() && modules.join("gltf-validator").is_dir() {
        return Some(modules);
    }
    assert!(!absent::in_ci(), "CI must have node with three and gltf-validator");
    absent::skip("no node with three and gltf-validator; .ci/run installs them");
    None
}

/// What a program says as JSON on its last line.
fn told(command: &mut Command) -> Value {
    let done = command.output().expect("the reader starts");
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(done.status.success(), "{command:?}: {text}{}", String::from_utf8_lossy(&done.stderr));
    let last = text.lines().rev().find(|line| line.starts_with('{')).unwrap_or_default();
    serde_json::from_str(last).unwrap_or_else(|error| panic!("{command:?}: {error}: {text}"))
}

/// A material for each kind, or for each kind and order; all triangles are in one of them.
#[test]
fn materials_are_by_kind_or_by_order() {
    let folder = painted("");
    let out = |by: &str| format!("{by}.glb");
    for by in ["kind", "order"] {
        let words = ["mesh", "coffee", "--age", "24", "--tolerance", "1mm", "--materials", by, "--out", &out(by)];
        run(folder.path(), &words).ending(0);
    }
    let plain = ["mesh", "coffee", "--age", "24", "--tolerance", "1mm", "--out", "plain.glb"];
    run(folder.path(), &plain).ending(0);
    let bytes = |name: &str| fs::read(folder.path().join(name)).expect("a file");
    assert!(bytes("kind.glb") == bytes("plain.glb"));
    let [kind, order] = ["kind", "order"].map(|by| glb(&folder.path().join(out(by))));
    assert_eq!(names(&kind, "materials")[..2], ["wood", "leaves"]);
    let by_order = names(&order, "materials");
    assert!(by_order.starts_with(&["wood_1".to_owned(), "wood_2".to_owned()]), "{by_order:?}");
    assert!(by_order.contains(&"leaves_1".to_owned()) && by_order.contains(&"leaves_2".to_owned()), "{by_order:?}");
    let triangles = |file: &Value| -> u64 {
        let primitives = file["meshes"][0]["primitives"].as_array().expect("primitives");
        let count = |primitive: &Value| {
            file["accessors"][primitive["indices"].as_u64().expect("a place") as usize]["count"].as_u64()
        };
        primitives.iter().filter_map(count).sum()
    };
    assert_eq!(triangles(&kind), triangles(&order));
    for (words, said) in [
        (["--materials", "order", "--out", "a.ply"], "--materials order: PLY and STL hold no materials"),
        (["--materials", "order", "--out", "a.stl"], "--materials order: PLY and STL hold no materials"),
        (["--materials", "age", "--out", "a.glb"], "possible values: kind, order"),
    ] {
        let found = run(folder.path(), &[&["mesh", "coffee", "--age", "3"][..], &words].concat()).ending(2);
        assert!(found.stderr.contains(said), "{}", found.stderr);
    }
    let life = ["mesh", "coffee", "--ages", "1..9", "--materials", "order", "--out", "life.glb"];
    assert!(run(folder.path(), &life).ending(2).stderr.contains("leave out --ages"));
}

/// The pictures are in a GLB file once each, with their bytes; what they cover is white, repeats or is cut out.
#[test]
fn a_glb_file_has_the_pictures() {
    let folder = painted(BY_ORDER);
    let words = ["mesh", "scenario.toml", "--tolerance", "1mm", "--out"];
    let life: &[&str] = &["--ages", "4..16", "--keys", "4"];
    let ways: [(&str, &[&str]); 5] = [
        ("still", &[]),
        ("life", life),
        ("instances", &["--leaves", "instances"]),
        ("order", &["--materials", "order"]),
        ("plot", &["--plot"]),
    ];
    for (name, more) in ways {
        let file = format!("{name}.glb");
        run(folder.path(), &[&words[..], &[&file], more].concat()).ending(0);
        let json = glb(&folder.path().join(&file));
        assert_eq!(names(&json, "images").len(), 5, "{name}");
        let whole = fs::read(folder.path().join(&file)).expect("a file");
        for picture in ["bark", "relief", "leaf", "trunk", "twig_leaf"] {
            let bytes = fs::read(folder.path().join(format!("pictures/{picture}.png"))).expect("a picture");
            assert_eq!(whole.windows(bytes.len()).filter(|part| *part == bytes).count(), 1, "{picture} in {name}");
        }
    }
    let file = |name: &str| folder.path().join(name);
    let Some(modules) = modules() else { return };
    for name in ["still", "life", "instances", "order", "plot"] {
        let script = Path::new(ROOT).join("tests/readers/textures.mjs");
        let read = told(Command::new("node").arg(script).arg(&modules).arg(file(&format!("{name}.glb"))));
        let of = |material: &str| &read["materials"][material];
        assert_eq!(read["images"], 5, "{name}: {read}");
        assert_eq!(of("wood_1")["picture"], serde_json::json!([64, 64]), "{name}: {read}");
        assert_eq!(of("leaves_2")["picture"], serde_json::json!([12, 10]), "{name}: {read}");
        let wood = of(if name == "order" { "wood_2" } else { "wood" });
        assert_eq!((&wood["picture"], &wood["relief"]), (&serde_json::json!([32, 16]), &serde_json::json!([16, 8])));
        assert!(wood["repeats"] == true && wood["white"] == true && wood["cut"] == 0.0, "{name}: {read}");
        let leaves = of(if name == "order" { "leaves_1" } else { "leaves" });
        assert_eq!((&leaves["picture"], &leaves["cut"]), (&serde_json::json!([20, 24]), &serde_json::json!(0.5)));
        assert!(leaves["repeats"] == false && leaves["white"] == true, "{name}: {read}");
        // The whole picture is on a blade, with the midrib in its middle.
        let ends = |end: &str| [0, 1].map(|k| leaves[end][k].as_f64().expect("a number"));
        let ([left, bottom], [right, top]) = (ends("low"), ends("high"));
        assert!(left >= 0.0 && right <= 1.0 && bottom >= 0.0 && top <= 1.0 && top - bottom > 0.99, "{name}: {read}");
        assert!((left + right - 1.0).abs() < 1e-6 && right - left > 0.9, "{name}: {read}");
    }
}

/// The trunk and its twigs have whole repeats around; the picture is 5 cm wide and half as high on bark of order 2.
#[test]
fn bark_has_its_stated_width() {
    let folder = painted("");
    run(folder.path(), &["mesh", "scenario.toml", "--out", "bark.obj"]).ending(0);
    let text = fs::read_to_string(folder.path().join("bark.obj")).expect("a text");
    let numbers = |word: &str| -> Vec<Vec<f64>> {
        let of = |line: &str| line.split(' ').skip(1).map(|number| number.parse().expect("a number")).collect();
        text.lines().filter(|line| line.split(' ').next() == Some(word)).map(of).collect()
    };
    let (places, texture) = (numbers("v"), numbers("vt"));
    // The first tube: the sides of 9 + 9 vertices around the first internode of the trunk.
    let along = |k: usize| places[k][2];
    let (times, length) = (texture[8][0], along(9) - along(0));
    let apart = |k: usize| (0..3).map(|c| places[k + 1][c] - places[k][c]).map(|x| x * x).sum::<f64>().sqrt();
    let around = (0..8).map(apart).sum::<f64>();
    let covered = length / (texture[9][1] - texture[0][1]);
    assert!(times >= 1.0 && times.fract() == 0.0, "{times}");
    let (wide, high) = (around / times, covered);
    assert!((0.5..=2.0).contains(&(wide / high / 2.0)), "a picture twice as wide as high: {wide} {high}");
    assert!(wide <= 0.08 && high <= 0.0251, "{wide} {high}");
}

#[test]
fn usd_and_obj_are_read_with_their_pictures() {
    let folder = painted(BY_ORDER);
    let at = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    let kind = painted("");
    let files: [(&str, &Path, &[&str]); 11] = [
        ("still.usda", folder.path(), &[]),
        ("still.usdc", folder.path(), &[]),
        ("still.usdz", folder.path(), &[]),
        ("plot.usdc", folder.path(), &["--plot"]),
        ("still.obj", folder.path(), &[]),
        ("plot.obj", folder.path(), &["--plot"]),
        ("kind.usdc", kind.path(), &[]),
        ("merged.usda", kind.path(), &["--leaves", "merged"]),
        ("kind.obj", kind.path(), &[]),
        ("life.usdc", folder.path(), &["--ages", "12..16"]),
        ("lives.usda", kind.path(), &["--plot", "--ages", "12..16"]),
    ];
    for (name, from, more) in files {
        let scenario = from.join("scenario.toml").to_str().expect("a path").to_owned();
        run(folder.path(), &[&["mesh", &scenario, "--tolerance", "1mm", "--out", name], more].concat()).ending(0);
    }
    let pictures = |stem: &str| {
        let found = fs::read_dir(folder.path()).expect("a folder").flatten().map(|entry| entry.file_name());
        found.filter(|name| name.to_string_lossy().starts_with(&format!("{stem}_"))).count()
    };
    assert_eq!(["still", "plot", "kind", "merged", "life", "lives"].map(pictures), [5, 5, 3, 3, 5, 3]);
    let beside = fs::read(folder.path().join("still_bark.png")).expect("a picture");
    assert!(beside == fs::read(folder.path().join("pictures/bark.png")).expect("a picture"));
    let paths: Vec<String> = files.iter().map(|(name, ..)| at(name)).collect();
    if let Some(python) = reading::python() {
        let script = Path::new(ROOT).join("tests/readers/textures.py");
        let read = told(Command::new(&python).arg(script).args(&paths));
        for (name, ..) in files {
            let by_order = !["kind", "merged", "lives"].iter().any(|stem| name.starts_with(stem));
            let of = |material: &str, key: &str| read[name][material][key].clone();
            let is_instanced = ["kind.usdc", "lives.usda"].contains(&name);
            let leaf = if is_instanced { "leaf" } else { "leaves" };
            assert_eq!(of("wood", "texture"), serde_json::json!([32, 16]), "{name}: {read}");
            assert_eq!(of(leaf, "texture"), serde_json::json!([20, 24]), "{name}: {read}");
            if by_order {
                assert_eq!(of("wood_1", "texture"), serde_json::json!([64, 64]), "{name}: {read}");
                assert_eq!(of("leaves_2", "texture"), serde_json::json!([12, 10]), "{name}: {read}");
            }
            assert!(of("wood", "faces").as_u64() > Some(100) && of(leaf, "faces").as_u64() > Some(1), "{name}: {read}");
            if name.ends_with(".obj") {
                assert_eq!(of("wood", "faces"), of("wood", "open3d"), "{name}: {read}");
                assert_eq!(of("leaves", "faces"), of("leaves", "open3d"), "{name}: {read}");
            } else {
                assert_eq!(of("wood", "relief"), serde_json::json!([16, 8]), "{name}: {read}");
                // Pictures of bark go around a stem a whole number of times.
                let around = of("wood", "around").as_f64();
                let is_life = name.starts_with("li");
                assert!(around.map_or(!is_life, |around| around >= 1.0 && around.fract() == 0.0), "{name}: {read}");
                assert_eq!((of("wood", "repeats"), of(leaf, "repeats")), (true.into(), false.into()), "{name}: {read}");
                assert_eq!((of("wood", "cut"), of(leaf, "cut")), (Value::Null, 0.5.into()), "{name}: {read}");
            }
        }
    }
    let blender = Path::new(ROOT).join(".venv-blender/bin/python");
    let found = Command::new(&blender).args(["-c", "import bpy"]).output();
    if !found.is_ok_and(|found| found.status.success()) {
        assert!(!absent::in_ci(), "CI must have bpy in .venv-blender");
        return absent::skip("no bpy in .venv-blender; .ci/run installs it");
    }
    run(folder.path(), &["mesh", "scenario.toml", "--tolerance", "1mm", "--out", "still.glb"]).ending(0);
    let paths = ["still.glb", "still.usda", "still.usdz", "still.obj", "kind.usdc"].map(at);
    let read = told(Command::new(&blender).arg(Path::new(ROOT).join("tests/readers/textures_blender.py")).args(&paths));
    for name in ["still.glb", "still.usda", "still.usdz", "still.obj", "kind.usdc"] {
        let sizes = |material: &str| read[name][material].clone();
        assert_eq!(sizes("wood"), serde_json::json!([[16, 8], [32, 16]]), "{name}: {read}");
        if name != "kind.usdc" {
            assert_eq!(sizes("wood_1"), serde_json::json!([[64, 64]]), "{name}: {read}");
            // A picture that is cut out may be there twice: for its colours, and for what is clear.
            let leaves = sizes("leaves");
            assert!(
                leaves.as_array().is_some_and(|sizes| sizes.iter().all(|size| *size == serde_json::json!([20, 24])))
            );
        }
    }
}

/// A plot keeps the pictures to the species that states them; a material of another species is apart.
#[test]
fn each_species_of_a_plot_has_its_own() {
    let folder = painted("");
    run(folder.path(), &["mesh", "plot.toml", "--plot", "--tolerance", "1mm", "--out", "plot.glb"]).ending(0);
    let json = glb(&folder.path().join("plot.glb"));
    let materials = json["materials"].as_array().expect("materials");
    let textured = |name: &str| {
        let of = materials.iter().find(|material| material["name"] == name);
        of.map(|of| of["pbrMetallicRoughness"]["baseColorTexture"].is_object())
    };
    assert_eq!([textured("painted_wood"), textured("painted_leaves")], [Some(true); 2], "{materials:?}");
    assert_eq!([textured("wood"), textured("leaves"), textured("obstacles")], [Some(false); 3], "{materials:?}");
}
