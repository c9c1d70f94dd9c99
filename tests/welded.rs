//! `mesh --joints welded` read by trimesh: every specimen's wood is one closed surface, and has the volume of its
//! frusta.
//!
//! The specimens are coffee, willow, cherry, pollard, the 23 architectural models, a parametric aspen and an L-system
//! tree. Readers are those of `tests/external_readers.rs`; the surface itself is proved in `phytomer_meshes`. Absent:
//! pictures of it.

mod program;
#[path = "program/reading.rs"]
mod reading;

use phytomer::sim::plant::{Class, Kind};
use program::run;
use std::fs;
use std::path::Path;

/// The specimens with their ages; of what has no age the one at which its species is shown. The pollard stands before
/// its second cutting, and after its third, where thick shoots leave a knuckle side by side.
const SPECIMENS: [(&str, Option<&str>); 7] = [
    ("coffee", Some("36")),
    ("willow", Some("60")),
    ("wild_cherry", Some("40")),
    ("pollard", Some("20")),
    ("pollard", Some("40")),
    ("wp/quaking_aspen", None),
    ("abop/2.7a", None),
];

/// Writes a specimen with its joints.
fn write(folder: &Path, name: &str, age: Option<&str>, joints: &str) -> String {
    let out = format!("{}-{}-{joints}.ply", name.replace('/', "-"), age.unwrap_or("shown"));
    let mut words = vec!["mesh", name, "--joints", joints, "--out", &out];
    words.extend(age.iter().flat_map(|age| ["--age", age]));
    let told = run(folder, &words).ending(0).stdout;
    assert_eq!(told.contains(", wood welded"), joints == "welded", "{told}");
    folder.join(out).to_str().expect("a path in UTF-8").to_owned()
}

/// Lets trimesh read all specimens.
fn hold(specimens: &[(&str, Option<&str>)]) {
    let Some(python) = reading::python() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let kinds = Kind::ALL.into_iter().filter(|kind| kind.class() == Class::Internode);
    let kinds: Vec<String> = kinds.map(|kind| (kind as u8).to_string()).collect();
    let pair = |(name, age): &(&str, Option<&str>)| ["welded", "open"].map(|how| write(folder.path(), name, *age, how));
    let words: Vec<String> = [kinds.join(",")].into_iter().chain(specimens.iter().flat_map(pair)).collect();
    reading::read(&python, "welded.py", &words.iter().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn wood_of_specimens_is_one_closed_surface() {
    hold(&SPECIMENS);
}

#[test]
fn wood_of_the_architectural_models_is_one_closed_surface() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("config/presets/halle");
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("the presets")
        .map(|file| format!("halle/{}", file.expect("a file").path().file_stem().expect("a name").to_string_lossy()))
        .collect();
    names.sort();
    assert_eq!(names.len(), 23);
    hold(&names.iter().map(|name| (name.as_str(), None)).collect::<Vec<_>>());
}

/// Open joints are what is written where none are asked for, byte for byte.
#[test]
fn open_joints_are_as_ever() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let plain = ["mesh", "coffee", "--age", "24", "--out", "plain.ply"];
    run(folder.path(), &plain).ending(0);
    let open = write(folder.path(), "coffee", Some("24"), "open");
    assert_eq!(fs::read(folder.path().join("plain.ply")).expect("a file"), fs::read(open).expect("a file"));
}

#[test]
fn what_cannot_be_welded_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (words, told) in [
        (
            &["--age", "0", "--joints", "welded"][..],
            "--joints welded: plant 0 at age 0 has no wood that could be welded",
        ),
        (
            &["--ages", "1..12", "--joints", "welded"],
            "--joints welded: this is for a plant that stands still at one age",
        ),
        (&["--age", "12", "--joints", "glued"], "[possible values: open, collar, welded]"),
    ] {
        let words = [&["mesh", "coffee", "--out", "none.glb"], words].concat();
        let said = run(folder.path(), &words).ending(2);
        assert!(said.stderr.contains(told), "{words:?}: {}", said.stderr);
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0, "no file is left");
}

/// Collars are added to the open mesh, whose vertices and triangles stay.
#[test]
fn collars_are_skirts_beside_the_open_mesh() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let sizes = ["open", "collar"].map(|joints| {
        let path = write(folder.path(), "coffee", Some("36"), joints);
        let bytes = fs::read(path).expect("a file");
        let end = bytes.windows(11).position(|part| part == b"end_header\n").expect("a header");
        let header = String::from_utf8_lossy(&bytes[..end]).into_owned();
        let count = |what: &str| -> u64 {
            let line = header.lines().find_map(|line| line.strip_prefix(&format!("element {what} "))).expect("a count");
            line.parse().expect("a number")
        };
        [count("vertex"), count("face")]
    });
    assert!((0..2).all(|k| sizes[1][k] > sizes[0][k] && sizes[1][k] < 2 * sizes[0][k]), "{sizes:?}");
    // Eight sides: five rings of eight vertices and four strips of sixteen triangles each.
    assert_eq!([(sizes[1][0] - sizes[0][0]) % 40, (sizes[1][1] - sizes[0][1]) % 64], [0, 0]);
}
