//! The materials of a species: their pictures are checked with their place in the file, and hashed among the inputs of
//! a run, which is drawn with the same ones or not at all.
//!
//! Absent: what a picture may hold, byte by byte (`phytomer_meshes`), and files with textures (`textures`).

mod painted;
mod program;

use painted::{painted, picture};
use program::{run, write};
use serde_json::Value;
use std::fs;

/// The pictures are among the inputs of a run, and a run is not drawn with others.
#[test]
fn a_run_knows_its_pictures_again() {
    let folder = painted("");
    let here = |words: &[&str]| run(folder.path(), words);
    here(&["grow", "scenario.toml", "--name", "painted", "--quiet"]).ending(0);
    let report: Value =
        serde_json::from_slice(&fs::read(folder.path().join("runs/painted/run.json")).expect("a run")).expect("JSON");
    let inputs = report["inputs"].as_array().expect("inputs");
    for name in ["pictures/bark.png", "pictures/relief.png", "pictures/leaf.png"] {
        let of =
            inputs.iter().filter(|input| input["path"] == name && input["sha256"].as_str().map(str::len) == Some(64));
        assert_eq!(of.count(), 1, "{name}");
    }
    here(&["mesh", "runs/painted", "--tolerance", "1mm", "--out", "run.glb"]).ending(0);
    here(&["mesh", "scenario.toml", "--tolerance", "1mm", "--out", "own.glb"]).ending(0);
    assert!(
        fs::read(folder.path().join("run.glb")).expect("a file")
            == fs::read(folder.path().join("own.glb")).expect("a file")
    );
    fs::write(folder.path().join("pictures/leaf.png"), picture([8, 8], png::ColorType::Rgb)).expect("a picture");
    let told = here(&["mesh", "runs/painted", "--out", "changed.glb"]).ending(1).stderr;
    assert!(told.contains("the picture pictures/leaf.png is not the one with which the run was made"), "{told}");
}

#[test]
fn bad_materials_are_told_with_their_place() {
    let folder = painted("");
    let check = |text: &str, said: &[&str]| {
        write(folder.path(), "bad.toml", &format!("name = \"bad\"\ninherits = \"coffee\"\n{text}"));
        let told = run(folder.path(), &["validate", "bad.toml"]).ending(3).stderr;
        assert!(said.iter().all(|said| told.contains(said)), "{text}: {told}");
        let told = run(folder.path(), &["mesh", "bad.toml", "--out", "bad.glb"]).code;
        assert_ne!(told, Some(0), "{text}");
        assert!(!folder.path().join("bad.glb").exists());
    };
    let leaf = |name: &str| format!("[[material]]\nof = \"leaf\"\ntexture = \"{name}\"\n");
    write(folder.path(), "pictures/text.png", "no picture");
    let whole = picture([64, 64], png::ColorType::Rgb);
    fs::write(folder.path().join("pictures/cut.png"), &whole[..whole.len() / 2]).expect("a file");
    fs::write(folder.path().join("pictures/wide.png"), picture([8193, 1], png::ColorType::Grayscale)).expect("a file");
    let long = fs::File::create(folder.path().join("pictures/long.png")).expect("a file");
    long.set_len((32 << 20) + 1).expect("room on the disk");
    let outside = tempfile::tempdir().expect("a temporary folder");
    fs::write(outside.path().join("out.png"), &whole).expect("a file");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(outside.path().join("out.png"), folder.path().join("pictures/link.png"))
            .expect("a link");
        check(&leaf("pictures/link.png"), &["bad.toml:5:11", "is a link out of the folder"]);
    }
    let absolute = outside.path().join("out.png").display().to_string().replace('\\', "/");
    for (text, said) in [
        (leaf("pictures/text.png"), ["bad.toml:5:11", "no picture of a known format"]),
        (leaf("pictures/cut.png"), ["bad.toml:5:11", "in the picture `pictures/cut.png`, its bytes"]),
        (leaf("pictures/wide.png"), ["bad.toml:5:11", "its size: 8193 by 1 pixels"]),
        (leaf("pictures/long.png"), ["bad.toml:5:11", "it is longer than 32 MiB"]),
        (leaf("pictures/none.png"), ["bad.toml:5:11", "there is no picture `pictures/none.png`"]),
        (leaf("../out.png"), ["bad.toml:5:11", "the picture `../out.png` would be outside the folder"]),
        (leaf(&absolute), ["bad.toml:5:11", "would be outside the folder"]),
        (leaf(""), ["bad.toml:5:11", "texture"]),
        (
            format!("{}width_m = 0.1\n", leaf("pictures/leaf.png")),
            ["bad.toml:6:11", "no width: the whole picture covers"],
        ),
        (
            leaf("pictures/leaf.png").replace("leaf\"\n", "bark\"\n"),
            ["bad.toml", "bark without a width of its picture"],
        ),
        (leaf("pictures/leaf.png").replace("\"leaf\"", "\"root\""), ["bad.toml:4:6", "root"]),
        (format!("{}order = 0\n", leaf("pictures/leaf.png")), ["bad.toml:6:9", "order"]),
        (format!("{}colour = 0\n", leaf("pictures/leaf.png")), ["bad.toml:6:1", "colour"]),
        (format!("{0}{0}", leaf("pictures/leaf.png")), ["bad.toml", "a second material of the same part and order"]),
        ("flare = { width = 0 }\n".to_owned(), ["bad.toml:3:19", "0.01"]),
        ("flare = { width = 0.5, lobes = 17 }\n".to_owned(), ["bad.toml:3:32", "16"]),
    ] {
        check(&text, &said);
    }
    // A species that ships has no folder of its own.
    write(
        folder.path(),
        "good.toml",
        &format!("name = \"good\"\ninherits = \"coffee\"\n{}", leaf("pictures/leaf.png")),
    );
    run(folder.path(), &["validate", "good.toml"]).ending(0);
}
