//! Trees of stems on the command line: by levels, at ranges, within a number of triangles, in the wind; what their
//! vertices tell; and what is told of plants without levels.
//!
//! The tree is the quaking aspen of Weber & Penn 1995. Absent: the curves and the elements of a tree, and the law of
//! sway, which are tested beside them.

#[allow(dead_code, reason = "the place is told elsewhere")]
mod ply;
mod program;

use ply::{count, mesh, place_in};
use program::{Said, run};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

const ASPEN: &str = "wp/quaking_aspen";
/// A vertex with the properties of every mesh, and the place of its component number in it.
const VERTEX: usize = 49;
const COMPONENT: usize = 44;

fn drawn(folder: &Path, more: &[&str], out: &str) -> Said {
    run(folder, &[&["mesh", ASPEN], more, &["--out", out]].concat()).ending(0)
}

/// The vertices of a PLY file: component number and `until_m`.
fn vertices(path: &Path) -> Vec<(i32, f32)> {
    let (header, bytes) = mesh(path);
    assert!(header.contains("property float until_m\n"), "{header}");
    assert_eq!(place_in(&header), [0.0; 3], "a plant alone stands at the origin");
    let number = |at: usize, bytes: &[u8]| [0, 1, 2, 3].map(|k| bytes[at + k]);
    let all = bytes.chunks_exact(VERTEX + 4).take(count(&header, "vertex"));
    all.map(|vertex| (i32::from_le_bytes(number(COMPONENT, vertex)), f32::from_le_bytes(number(VERTEX, vertex))))
        .collect()
}

/// The aspen of Table 2 has lines of 30 branches and 739 twigs; the whole mesh, clipped at a range, is the mesh of that
/// range, component by component.
#[test]
fn the_whole_mesh_clipped_at_a_range_is_the_mesh_of_the_range() {
    let folder = tempdir().expect("a temporary folder");
    drawn(folder.path(), &[], "whole.ply");
    let whole = vertices(&folder.path().join("whole.ply"));
    let mut last = usize::MAX;
    for metres in ["0", "55.5", "130", "333", "1200", "20000"] {
        let told = drawn(folder.path(), &["--range", metres], "far.ply").stdout;
        assert_eq!(told.contains("as seen from"), metres != "0", "{told}");
        let far: BTreeSet<i32> = vertices(&folder.path().join("far.ply")).iter().map(|vertex| vertex.0).collect();
        let range: f32 = metres.parse().expect("a number");
        let clipped = whole.iter().filter(|(_, until)| *until >= range).map(|(component, _)| *component);
        assert_eq!(clipped.collect::<BTreeSet<i32>>(), far, "at {metres} m");
        assert!(far.len() <= last);
        last = far.len();
    }
    // The trunk of three segments, and one leaf in eight.
    assert_eq!(last, 3 + 13_498_usize.div_ceil(8));
}

/// A lens of 6 degrees brings a tree ten times nearer, and half the pixels take it twice as far.
#[test]
fn a_picture_of_other_measures_is_another_range() {
    let folder = tempdir().expect("a temporary folder");
    let bytes = |more: &[&str]| {
        drawn(folder.path(), more, "a.ply");
        mesh(&folder.path().join("a.ply")).1.len()
    };
    let there = bytes(&["--range", "120"]);
    assert_eq!(there, bytes(&["--range", "1200", "--fov", "6"]));
    assert_eq!(there, bytes(&["--range", "60", "--image-height", "500"]));
    assert!(there < bytes(&["--range", "60"]));
}

#[test]
fn a_tree_has_at_most_the_triangles_that_are_asked_for_at_the_nearest_range() {
    let folder = tempdir().expect("a temporary folder");
    let told = drawn(folder.path(), &["--triangles", "20k"], "fits.ply").stdout;
    assert!(told.contains("as seen from") && !told.contains("within"), "{told}");
    let (header, _) = mesh(&folder.path().join("fits.ply"));
    let faces = count(&header, "face");
    assert!((19_000..=20_000).contains(&faces), "{faces}");
    let few = run(folder.path(), &["mesh", ASPEN, "--triangles", "100", "--out", "few.ply"]).ending(2).stderr;
    assert!(few.contains("--triangles 100: plant 0 at age 30 has at least"), "{few}");
}

/// Half the quality: half the leaves, √2 times as long. Levels: the trunk with its branches.
#[test]
fn quality_and_levels_change_the_tree() {
    let folder = tempdir().expect("a temporary folder");
    let components = |more: &[&str]| {
        drawn(folder.path(), more, "a.ply");
        vertices(&folder.path().join("a.ply")).iter().map(|vertex| vertex.0).collect::<BTreeSet<i32>>().len()
    };
    let (leaves, fewer) = (components(&["--levels", "3"]), components(&["--levels", "3", "--quality", "0.5"]));
    assert!(leaves == 13_498 && (6000..6750).contains(&fewer), "{leaves} {fewer}");
    assert_eq!(components(&["--levels", "0"]), 3);
    assert_eq!(components(&["--levels", "0-1"]), 3 + 30 * 5);
}

/// A calm is the tree at rest to the bit; a wind moves it, another moment moves it elsewhere, and a film closes.
#[test]
fn a_tree_sways() {
    let folder = tempdir().expect("a temporary folder");
    let bytes = |more: &[&str]| {
        drawn(folder.path(), &[&["--levels", "0-2"], more].concat(), "a.ply");
        fs::read(folder.path().join("a.ply")).expect("a file")
    };
    let rest = bytes(&[]);
    assert!(rest == bytes(&["--wind", "0", "--time", "3"]));
    let wind = bytes(&["--wind", "4", "--gust", "2", "--time", "0.5"]);
    assert!(wind != rest && wind != bytes(&["--wind", "4", "--gust", "2", "--time", "0.75"]));
    let closing = |time| bytes(&["--wind", "4", "--gust", "2", "--loop", "6", "--time", time]);
    assert!(closing("0.5") == closing("6.5") && closing("0.5") != closing("3.5"));
    let told = drawn(folder.path(), &["--wind", "4", "--gust", "2", "--time", "0.5"], "a.ply").stdout;
    assert!(told.contains(" in a wind of 4 m/s with gusts of 2 m/s more at 0.5 s"), "{told}");
}

/// Vertices tell how they sway: the properties follow those of every mesh, in each format that has any.
#[test]
fn vertices_tell_how_they_sway() {
    let folder = tempdir().expect("a temporary folder");
    let more = ["--levels", "0-1", "--wind-data", "--bark", "0.5"];
    drawn(folder.path(), &more, "wind.ply");
    let (header, bytes) = mesh(&folder.path().join("wind.ply"));
    let names = ["until_m", "level", "stem_place", "sway_rate", "sway_phase_x", "sway_phase_y"];
    assert!(names.iter().all(|name| header.contains(&format!("property float {name}\n"))), "{header}");
    assert_eq!(bytes.len(), (VERTEX + 4 * names.len()) * count(&header, "vertex") + 13 * count(&header, "face"));
    for (file, wanted) in [("wind.glb", "_SWAY_PHASE_Y"), ("wind.usda", "float[] primvars:sway_phase_y = [")] {
        drawn(folder.path(), &more, file);
        let file = fs::read(folder.path().join(file)).expect("a file");
        assert!(String::from_utf8_lossy(&file).contains(wanted), "{wanted}");
    }
    drawn(folder.path(), &["--leaf-normals", "crown", "--levels", "3"], "crown.ply");
    drawn(folder.path(), &["--levels", "3"], "leaves.ply");
    assert!(mesh(&folder.path().join("crown.ply")).1 != mesh(&folder.path().join("leaves.ply")).1);
}

/// What is asked of plants that cannot have it is refused with words, and nothing is written.
#[test]
fn what_is_for_trees_of_stems_is_refused_for_others() {
    let folder = tempdir().expect("a temporary folder");
    for (words, told) in [
        (
            &["mesh", "coffee", "--range", "100", "--out", "a.ply"][..],
            "--range: the species `coffee` is of the model `buds`",
        ),
        (&["mesh", "coffee", "--levels", "0-1", "--out", "a.ply"], "--levels: the species `coffee`"),
        (&["mesh", "coffee", "--quality", "0.5", "--out", "a.ply"], "--quality: the species `coffee`"),
        (&["picture", "willow", "--range", "100", "--out", "a.png"], "--range: the species"),
        (&["picture", ASPEN, "--fov", "30", "--out", "a.png"], "--fov: it belongs to --range"),
        (&["mesh", "coffee", "--wind-data", "--out", "a.ply"], "--wind-data: the species `coffee`"),
        (&["mesh", "willow", "--wind", "5", "--gust", "2", "--out", "a.ply"], "sways by its wood"),
        (&["mesh", "willow", "--wind", "5", "--loop", "6", "--out", "a.ply"], "sways by its wood"),
        (&["mesh", ASPEN, "--wind", "5", "--wind-towards", "90", "--out", "a.ply"], "knows no direction"),
        (&["mesh", ASPEN, "--gust", "5", "--out", "a.ply"], "--wind"),
        (&["mesh", ASPEN, "--range", "-1", "--out", "a.ply"], "a range from 0 to 1,000,000 m is expected"),
        (&["mesh", ASPEN, "--range", "5", "--triangles", "9k", "--out", "a.ply"], "cannot be used with"),
        (&["mesh", ASPEN, "--levels", "2-1", "--out", "a.ply"], "such as 2 or 0-1"),
        (&["mesh", ASPEN, "--quality", "0", "--out", "a.ply"], "a quality above 0"),
        (&["mesh", ASPEN, "--quality", "NaN", "--out", "a.ply"], "a quality above 0"),
        (&["mesh", ASPEN, "--fov", "0", "--out", "a.ply"], "an angle from 0.001"),
        (&["mesh", ASPEN, "--image-height", "inf", "--out", "a.ply"], "a height from 1"),
        (&["mesh", ASPEN, "--bark", "0", "--out", "a.ply"], "a length from 0.001"),
        (&["mesh", ASPEN, "--bark", "1", "--out", "a.stl"], "--bark: STL holds triangles alone"),
        (&["mesh", ASPEN, "--wind-data", "--plot", "--out", "a.ply"], "--wind-data: this is for a single plant"),
        (&["mesh", ASPEN, "--wind", "5", "--loop", "0", "--out", "a.ply"], "a length from 0.001 to 3600 seconds"),
        (
            &["mesh", ASPEN, "--ages", "1..2", "--levels", "0", "--out", "a.glb"],
            "--levels: this is for a plant at one age",
        ),
    ] {
        let said = run(folder.path(), words);
        assert!(said.code == Some(2) && said.stderr.contains(told), "{words:?}: {}", said.stderr);
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0, "{words:?}");
    }
}
