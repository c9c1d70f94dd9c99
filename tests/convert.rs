//! Trees of other programs, from their files to plants: what is written is a species that grows, and what cannot be
//! converted leaves no file.
//!
//! The files are those of the tests of `config/peers`. Absent: what each key becomes, which is tested there.

mod program;

use program::{Said, run};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::tempdir;

/// A file of the tests of `config/peers`.
fn data(name: &str) -> String {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("config/peers/tests/data").join(name).display().to_string()
}

fn convert(folder: &Path, words: &[&str]) -> Said {
    run(folder, &[&["convert"], words].concat())
}

#[test]
fn a_file_of_each_program_becomes_a_species_that_grows() {
    let folder = tempdir().unwrap();
    let files = [
        ("hill_larch.xml", None),
        ("pond_alder.py", None),
        ("field_maple.py", None),
        ("orchard.xml", Some("Quince")),
        ("orchard.xml", Some("Medlar")),
        ("thorn.json", None),
    ];
    for (number, (name, tree)) in files.into_iter().enumerate() {
        let (input, out) = (data(name), format!("tree_{number}.toml"));
        let chosen: Vec<&str> = tree.iter().flat_map(|tree| ["--tree", *tree]).collect();
        let told = convert(folder.path(), &[&[input.as_str(), &out], &chosen[..]].concat()).ending(0).stdout;
        assert!(told.lines().any(|line| line.contains(": taken: ") || line.contains(": mapped: ")), "{told}");
        assert!(told.lines().all(|line| line.starts_with(&input) || line.starts_with(&out)), "{told}");
        run(folder.path(), &["validate", &out]).ending(0);
        let mesh = format!("tree_{number}.ply");
        run(folder.path(), &["mesh", &out, "--age", "1", "--tolerance", "1cm", "--out", &mesh]).ending(0);
        let header = fs::read(folder.path().join(&mesh)).unwrap();
        let header = String::from_utf8_lossy(&header[..2000.min(header.len())]).into_owned();
        let vertices = header.lines().find_map(|line| line.strip_prefix("element vertex ")).expect("vertices");
        assert!(vertices.parse::<u64>().unwrap() > 1000, "{name}: {vertices} vertices");
    }
}

#[test]
fn the_list_is_json_too_and_a_pipe_has_the_species_alone() {
    let folder = tempdir().unwrap();
    let input = data("pond_alder.py");
    let json = convert(folder.path(), &[&input, "alder.toml", "--json"]).ending(0).json();
    assert_eq!((json["from"].as_str(), json["status"].as_str()), (Some("tree-gen"), Some("done")));
    let shape = &json["keys"][0];
    assert_eq!((shape["key"].as_str(), shape["line"].as_u64()), (Some("shape"), Some(5)));
    assert_eq!((shape["fate"].as_str(), shape["written"].as_str()), (Some("mapped"), Some("Shape = 4")));
    let piped = convert(folder.path(), &[&input, "-"]).ending(0);
    assert_eq!(piped.stdout, fs::read_to_string(folder.path().join("alder.toml")).unwrap());
    assert!(piped.stderr.contains("pond_alder.py:5:5: shape: mapped: Shape = 4"), "{}", piped.stderr);
}

#[test]
fn what_cannot_be_converted_leaves_no_file() {
    let folder = tempdir().unwrap();
    let write = |name: &str, text: &[u8]| fs::write(folder.path().join(name), text).unwrap();
    write("cut.py", b"{'baseSize': 0.4,\n 'scale': ");
    write("wide.py", &[b"{'baseSize': [".to_vec(), b"0,".repeat(2_000_000)].concat());
    write("bomb.xml", b"<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY b 'b'>]>\n<arbaro>&b;</arbaro>");
    write("number.json", b"{\"Shape\": 7, \"Scale\": 5, \"Levels\": 1,\n \"Ratio\": 0.02, \"0CurveRes\": 0}");
    write(
        "base.json",
        b"{\"Shape\": 7, \"Scale\": 5, \"Levels\": 1,\n \"Ratio\": 0.02, \"0CurveRes\": 3, \"Flare\": -3}",
    );
    write("plain.txt", b"{'baseSize': 0.4}");
    let refused = [
        ("cut.py", 3, "cut.py:2:11: the file ends in the middle of a value"),
        ("wide.py", 3, "wide.py:1:1048577: the file goes on beyond 1048576 bytes"),
        ("bomb.xml", 3, "bomb.xml:2:1: the file declares a document type"),
        ("number.json", 3, "number.json:2:17: `0CurveRes`"),
        ("base.json", 3, "base.json:2:33: `Flare`"),
        ("plain.txt", 2, "say --from arbaro, tree-gen, sapling, helios or json"),
        ("absent.py", 1, "cannot read absent.py"),
    ];
    for (name, code, told) in refused {
        let said = convert(folder.path(), &[name, "out.toml"]).ending(code);
        assert!(said.stderr.contains(told), "{name}: {}", said.stderr);
        assert!(!folder.path().join("out.toml").exists(), "{name}");
    }
    let said = convert(folder.path(), &[&data("orchard.xml"), "out.toml"]).ending(2);
    assert!(said.stderr.contains("2 trees: Quince, Medlar; choose one by --tree"), "{}", said.stderr);
    assert!(convert(folder.path(), &["cut.py", "out.ply"]).ending(2).stderr.contains("ends in .toml"));
    let json = convert(folder.path(), &["number.json", "out.toml", "--json"]).ending(3).json();
    assert_eq!((json["faults"][0]["line"].as_u64(), json["faults"][0]["path"].as_str()), (Some(2), Some("0CurveRes")));
}
