//! `mesh --lods` on the command line: the files and what they say of their levels, and what is told of what cannot be.
//!
//! Absent: whether outlines hold (`levels`), and whether a GLB file is valid (`glb`).

#[path = "program/absent.rs"]
mod absent;
#[allow(dead_code, reason = "the place is told elsewhere")]
mod ply;
mod program;

use ply::{count, mesh};
use program::run;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;

const PLANT: [&str; 5] = ["mesh", "coffee", "--age", "18", "--lods"];

fn words<'a>(lods: &'a str, more: &[&'a str], out: &'a str) -> Vec<&'a str> {
    [&PLANT[..], &[lods], more, &["--out", out]].concat()
}

/// The JSON of a GLB file.
fn json(path: &Path) -> Value {
    let bytes = fs::read(path).expect("a file");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).expect("JSON")
}

/// The triangles of the mesh of a node.
fn triangles(file: &Value, node: usize) -> u64 {
    let mesh = file["nodes"][node]["mesh"].as_u64().expect("a mesh") as usize;
    let primitives = file["meshes"][mesh]["primitives"].as_array().expect("primitives");
    let of = |primitive: &Value| {
        let indices = primitive["indices"].as_u64().expect("indices") as usize;
        file["accessors"][indices]["count"].as_u64().expect("a count") / 3
    };
    primitives.iter().map(of).sum()
}

#[test]
fn one_glb_has_all_levels_and_other_formats_have_a_file_for_each() {
    let folder = tempdir().expect("a temporary folder");
    let told = run(folder.path(), &words("3", &[], "coffee.glb")).ending(0).stdout;
    assert!(told.contains("3 levels") && told.contains("level 2: "), "{told}");
    let file = json(&folder.path().join("coffee.glb"));
    assert_eq!(file["extensionsUsed"], serde_json::json!(["MSFT_lod"]));
    assert!(file.get("extensionsRequired").is_none(), "the first level is shown without it");
    assert_eq!(file["scenes"][0]["nodes"], serde_json::json!([0]));
    assert_eq!(file["nodes"][0]["extensions"]["MSFT_lod"]["ids"], serde_json::json!([1, 2]));
    let screens = file["nodes"][0]["extras"]["MSFT_screencoverage"].as_array().expect("a number for each level");
    assert_eq!(screens.len(), 3);
    let levels = file["asset"]["extras"]["levels"].as_array().expect("levels");
    let own: Vec<u64> = (0..3).map(|node| triangles(&file, node)).collect();
    let said: Vec<u64> = levels.iter().map(|level| level["triangles"].as_u64().expect("a count")).collect();
    assert_eq!(own, said);
    assert!(own[1] <= own[0] / 4 && own[2] < own[1], "{own:?}");
    for level in levels {
        assert!(level["outline_area_apart"].as_f64().expect("a share") <= 0.03, "{level}");
        assert!((1.0..=2.0).contains(&level["leaf_area_times"].as_f64().expect("a factor")), "{level}");
    }
    let counts = format!("{},{}", own[1], own[2]);
    run(folder.path(), &words(&counts, &[], "coffee.ply")).ending(0);
    run(folder.path(), &["mesh", "coffee", "--age", "18", "--out", "alone.ply"]).ending(0);
    let files = [0, 1, 2].map(|number| mesh(&folder.path().join(format!("coffee_lod{number}.ply"))));
    assert_eq!(files[0], mesh(&folder.path().join("alone.ply")), "the first level is the mesh without levels");
    assert!(!folder.path().join("coffee.ply").exists());
    for ((header, bytes), most) in files.iter().zip(&own) {
        assert!(count(header, "face") as u64 <= *most);
        assert_eq!(bytes.len(), 49 * count(header, "vertex") + 13 * count(header, "face"));
    }
    run(folder.path(), &words("2", &["--tolerance", "1mm"], "coffee.stl")).ending(0);
    assert!(folder.path().join("coffee_lod1.stl").exists());
}

/// The triangles that a file of levels says of them.
fn said(path: &Path) -> Vec<String> {
    let file = json(path);
    let levels = file["asset"]["extras"]["levels"].as_array().expect("levels").clone();
    levels.iter().map(|level| level["triangles"].to_string()).collect()
}

/// A reader in Python of an environment that has a module; what it finds wrong fails. Where it is missing it is
/// skipped, but never in CI.
fn read_by(environment: &str, module: &str, script: &str, arguments: &[String]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python = root.join(environment).join("bin/python");
    let found = Command::new(&python).args(["-c", &format!("import {module}")]).output();
    if !found.is_ok_and(|found| found.status.success()) {
        assert!(!absent::in_ci(), "CI must have {module} in {environment}");
        return absent::skip(&format!("no {module} in {environment}; .ci/run installs it"));
    }
    let done = Command::new(&python).arg(root.join("tests/readers").join(script)).args(arguments).output();
    let done = done.expect("python runs");
    let told = [done.stdout, done.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(done.status.success(), "{arguments:?}:\n{}{}", told[0], told[1]);
}

/// USD has a set of variants, with the triangles of the levels of GLB; GLB and OBJ open in Blender with all of theirs.
#[test]
fn openusd_and_blender_read_the_levels() {
    let folder = tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    for name in ["a.glb", "a.usda", "a.usdc", "a.usdz", "a.obj", "merged.usdc"] {
        let more: &[&str] = if name == "merged.usdc" { &["--leaves", "merged"] } else { &[] };
        run(folder.path(), &words("3", more, name)).ending(0);
    }
    let faces = said(&folder.path().join("a.glb"));
    assert_eq!(faces.len(), 3);
    let dashes = ["--".to_owned()];
    let of_usd = ["a.usda", "a.usdc", "a.usdz"].map(at);
    read_by(".venv", "pxr", "lods_usd.py", &[&faces[..], &dashes, &of_usd].concat());
    read_by(".venv", "pxr", "lods_usd.py", &[&faces[..], &dashes, &[at("merged.usdc")]].concat());
    let of_blender = ["a.glb", "a_lod0.obj", "a_lod1.obj", "a_lod2.obj"].map(at);
    for environment in [".venv-blender-4.2", ".venv-blender"] {
        read_by(environment, "bpy", "lods_blender.py", &[&faces[..], &dashes, &of_blender].concat());
    }
}

/// Two species in a plot, beside a stone.
const PLOT: &str = r#"
name = "plot"
species = "coffee"
plants = 3
spacing_m = 4
seed = 5
ages = { until = 24, record = [24] }
member = [{ at_m = [-1, 0] }, { at_m = [1, 0.5] }, { species = "frangipani", at_m = [0, -1], sown = 4 }]

[[site.obstacle]]
shape = { form = "box", at_m = [0, 1.5, 0], size_m = [0.5, 0.5, 0.4] }
"#;

/// Each plant of a plot has levels; the obstacles stay, and stated numbers are for all plants together.
#[test]
fn plots_have_levels_of_their_plants() {
    let folder = tempdir().expect("a temporary folder");
    fs::write(folder.path().join("plot.toml"), PLOT).expect("a scenario file");
    let plot = ["mesh", "plot.toml", "--plot", "--age", "24"];
    let written = |more: &[&str]| run(folder.path(), &[&plot[..], more].concat()).ending(0).stdout;
    let told = written(&["--lods", "3", "--out", "plot.glb"]);
    assert!(told.contains("level 1: ") && told.contains("outline of each plant within"), "{told}");
    let path = folder.path().join("plot.glb");
    let (file, said) = (json(&path), said(&path));
    let own: Vec<u64> = (0..said.len()).map(|node| triangles(&file, node)).collect();
    assert_eq!(own.iter().map(u64::to_string).collect::<Vec<_>>(), said);
    assert!(own.len() > 1 && own.windows(2).all(|pair| pair[1] < pair[0]), "{own:?}");
    written(&["--out", "alone.ply"]);
    let half = format!("{}k", own[0] / 2000);
    written(&["--lods", &half, "--out", "plot.ply"]);
    let read = |name: &str| mesh(&folder.path().join(name));
    assert_eq!(read("plot_lod0.ply"), read("alone.ply"), "the first level is the mesh without levels");
    let (header, bytes) = read("plot_lod1.ply");
    assert!(count(&header, "face") as u64 <= own[0] / 2, "{header}");
    // Vertices of obstacles have the component number -1, and are the same in each level.
    let of_obstacles = |header: &str, bytes: &[u8]| {
        let vertices = bytes[..49 * count(header, "vertex")].chunks_exact(49);
        vertices.filter(|vertex| vertex[44..48] == [u8::MAX; 4]).count()
    };
    let (first, all) = read("plot_lod0.ply");
    assert!(of_obstacles(&first, &all) > 0);
    assert_eq!(of_obstacles(&header, &bytes), of_obstacles(&first, &all));
    // USD has the same levels as variants, with organs as instances in the first or merged, and with the obstacle.
    let at = |name: &str| folder.path().join(name).to_str().expect("a path in UTF-8").to_owned();
    for name in ["plot.usda", "plot.usdc", "plot.usdz", "merged.usdc"] {
        let more: &[&str] = if name == "merged.usdc" { &["--leaves", "merged"] } else { &[] };
        let told = written(&[&["--lods", "3", "--out", name], more].concat());
        assert!(told.contains(&format!("{} levels", said.len())) && told.contains("outline of each plant"), "{told}");
    }
    let files = ["plot.usda", "plot.usdc", "plot.usdz"].map(at);
    read_by(".venv", "pxr", "lods_usd.py", &[&said[..], &["--".to_owned()], &files].concat());
    read_by(".venv", "pxr", "lods_usd.py", &[&said[..], &["--".to_owned(), at("merged.usdc")]].concat());
    let few = run(folder.path(), &[&plot[..], &["--lods", "90,9", "--out", "no.glb"]].concat()).ending(2).stderr;
    assert!(few.contains("--lods") && few.contains("of plot 0 at tick 24"), "{few}");
}

#[test]
fn what_cannot_be_is_told_and_leaves_nothing() {
    let folder = tempdir().expect("a temporary folder");
    let expected = "a number of levels from 1 to 8 is expected";
    for (lods, more, out, told) in [
        ("0", &[][..], "no.glb", expected),
        ("9", &[], "no.glb", expected),
        ("-1", &[], "no.glb", expected),
        ("many", &[], "no.glb", expected),
        ("5k,0", &[], "no.glb", expected),
        ("5k,6k", &[], "no.glb", "each level has fewer than the one before"),
        ("9,8", &[], "no.ply", "--lods: level 1 of plant 0 at age 18 may have 9 triangles, and has at least "),
        ("2", &["--leaves", "instances"], "no.glb", "--lods: organs that stand for others"),
        ("2", &["--cards"], "no.ply", "--cards: they have textures"),
        ("1", &["--cards"], "no.glb", "--cards: they are the last of at least two levels"),
        ("900,7", &["--cards"], "no.glb", "may have 7 triangles, and has at least 8"),
        ("2", &[], "-", "--lods: each level is a file, and stdout is one"),
    ] {
        let said = run(folder.path(), &words(lods, more, out)).ending(2);
        assert!(said.stderr.contains(told), "{lods} {more:?}: {}", said.stderr);
    }
    for more in [&["--plot", "--cards"][..], &["--rig", "9", "--wind", "5"], &["--range", "9"]] {
        let said = run(folder.path(), &words("2", more, "no.glb")).ending(2);
        assert!(said.stderr.contains("cannot be used with"), "{more:?}: {}", said.stderr);
    }
    let life = run(folder.path(), &["mesh", "coffee", "--ages", "1..9", "--lods", "2", "--out", "no.glb"]).ending(2);
    assert!(life.stderr.contains("cannot be used with"), "{}", life.stderr);
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0, "no file is left");
}

/// An open crown has cards too: what covers too much from one side is found together with all others.
#[test]
fn open_crowns_have_cards() {
    let folder = tempdir().expect("a temporary folder");
    for (name, age) in [("coffee", "36"), ("abop/2.8a", "6")] {
        run(folder.path(), &["mesh", name, "--age", age, "--lods", "2", "--cards", "--out", "open.glb"]).ending(0);
        let file = json(&folder.path().join("open.glb"));
        let last = file["asset"]["extras"]["levels"].as_array().and_then(|levels| levels.last()).expect("levels");
        assert_eq!(last["cards"], 4, "{name}");
        assert!(last["outline_area_apart"].as_f64().expect("a share") <= 0.03, "{name}: {last}");
    }
}

/// Cards are four quads in planes 45 degrees apart, with an atlas in the file whose upper edge is the top of the plant.
#[test]
fn cards_are_the_last_level_with_their_atlas() {
    let folder = tempdir().expect("a temporary folder");
    let told = run(folder.path(), &["mesh", "wp/quaking_aspen", "--lods", "3", "--cards", "--out", "aspen.glb"]);
    let told = told.ending(0).stdout;
    assert!(told.contains("level 2: 8 triangles, cards, outline within "), "{told}");
    let path = folder.path().join("aspen.glb");
    let (file, bytes) = (json(&path), fs::read(&path).expect("a file"));
    let ids = file["nodes"][0]["extensions"]["MSFT_lod"]["ids"].as_array().expect("levels").clone();
    assert_eq!((ids.len(), triangles(&file, 2)), (2, 8));
    let last = file["asset"]["extras"]["levels"].as_array().and_then(|levels| levels.last()).expect("levels");
    assert!(last["outline_area_apart"].as_f64().expect("a share") <= 0.03, "{last}");
    let materials = file["materials"].as_array().expect("materials");
    let material = materials.iter().find(|material| material["name"] == "cards").expect("the material of cards");
    assert_eq!((&material["alphaMode"], &material["doubleSided"]), (&"MASK".into(), &true.into()));
    let body = 28 + u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    let picture = |image: usize| {
        let view = file["images"][image]["bufferView"].as_u64().expect("a view") as usize;
        let [from, length] =
            ["byteOffset", "byteLength"].map(|key| file["bufferViews"][view][key].as_u64().expect("a number") as usize);
        let mut reader =
            png::Decoder::new(std::io::Cursor::new(&bytes[body + from..][..length])).read_info().expect("PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a picture");
        (info.width as usize, info.height as usize, info.color_type, pixels)
    };
    let (width, height, kind, colours) = picture(0);
    assert_eq!(kind, png::ColorType::Rgba);
    assert_eq!(picture(1).2, png::ColorType::Rgb);
    // The trunk is brown or grey below, the crown is green and wider above.
    let shown = |y: usize| (0..width / 2).filter(|x| colours[4 * (y * width + x) + 3] >= 128).count();
    let (above, below): (usize, usize) = ((0..height / 4).map(shown).sum(), (height / 4..height / 2).map(shown).sum());
    assert!(above > 2 * below && below > 0, "{above} {below}");
    // No texel is dark where nothing is shown: colours go on there.
    let dark = colours.chunks_exact(4).filter(|texel| texel[..3].iter().all(|channel| *channel < 20)).count();
    assert!(dark * 100 < width * height, "{dark} of {}", width * height);
}
