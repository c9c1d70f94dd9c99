//! `mesh --tolerance` and `--triangles` on the command line: what is written, and what is told of what cannot be.
//!
//! The plant is one of the small run of the tests. Absent: how near the mesh is to the plant (`budget`).

#[allow(dead_code, reason = "the place is told elsewhere")]
mod ply;
mod program;

use ply::{count, mesh};
use program::{grown, run};
use std::fs;

const PLANT: [&str; 6] = ["mesh", "runs/small", "--plant", "7", "--age", "12"];

fn words<'a>(more: &[&'a str], out: &'a str) -> Vec<&'a str> {
    [&PLANT[..], more, &["--out", out]].concat()
}

#[test]
fn a_mesh_has_the_tolerance_or_at_most_the_triangles_that_are_asked_for() {
    let folder = grown();
    let write = |more: &[&str], out: &str| {
        let told = run(folder.path(), &words(more, out)).ending(0).stdout;
        (mesh(&folder.path().join(out)), told)
    };
    let ((full, _), told) = write(&[], "full.ply");
    assert!(!told.contains("within") && full.contains("comment tubes keep the section"), "{told}");
    let ((near, bytes), told) = write(&["--tolerance", "1mm"], "near.ply");
    assert!(told.contains(", wood within 1 mm, "), "{told}");
    assert!(near.contains("comment tolerance_m 0.001: "), "{near}");
    assert!(count(&near, "face") < count(&full, "face"));
    assert_eq!(bytes.len(), 49 * count(&near, "vertex") + 13 * count(&near, "face"));
    let same = write(&["--tolerance", "0.1 cm"], "same.ply");
    assert_eq!((&near, &bytes), (&same.0.0, &same.0.1), "one length in two units");
    let most = count(&near, "face") + 20;
    let ((fits, _), told) = write(&["--triangles", &most.to_string()], "fits.ply");
    assert!((count(&near, "face")..=most).contains(&count(&fits, "face")), "{told}");
    assert!(told.contains(", wood within "), "{told}");
    let told = run(folder.path(), &["mesh", "runs/small", "--plot", "1", "--tolerance", "2mm", "--out", "plot.ply"]);
    assert!(told.ending(0).stdout.contains(", wood within 2 mm, "));
    let (plot, bytes) = mesh(&folder.path().join("plot.ply"));
    assert!(plot.contains("comment tolerance_m 0.002: "));
    assert_eq!(bytes.len(), 49 * count(&plot, "vertex") + 13 * count(&plot, "face"));
}

#[test]
fn what_cannot_be_written_is_told_and_leaves_nothing() {
    let folder = grown();
    let before = fs::read_dir(folder.path()).expect("a folder").count();
    for (more, told) in [
        (["--tolerance", "0mm"], "a length from 10 µm to 100 m is expected"),
        (["--tolerance", "-1mm"], "a length from 10 µm to 100 m is expected"),
        (["--tolerance", "NaN"], "a number with its unit is expected"),
        (["--tolerance", "1"], "its unit is missing"),
        (["--tolerance", "1 furlong"], "`furlong` is no unit of length"),
        (["--tolerance", "1um"], "a length from 10 µm to 100 m is expected"),
        (["--triangles", "0"], "a count from 1 on is expected"),
        (["--triangles", "NaN"], "a count from 1 on is expected"),
        (["--triangles", "2.5"], "a count from 1 on is expected"),
        (["--triangles", "3"], "--triangles 3: plant 7 at age 12 has at least "),
    ] {
        let said = run(folder.path(), &words(&more, "no.ply")).ending(2);
        assert!(said.stderr.contains(told), "{more:?}: {}", said.stderr);
    }
    for more in [
        ["--tolerance", "1mm", "--sides", "8"],
        ["--tolerance", "1mm", "--triangles", "8"],
        ["--triangles", "8", "--sides", "5"],
    ] {
        let said = run(folder.path(), &words(&more, "no.ply")).ending(2);
        assert!(said.stderr.contains("cannot be used with"), "{more:?}: {}", said.stderr);
    }
    let plot = ["mesh", "runs/small", "--plot", "0", "--triangles", "3", "--out", "no.ply"];
    assert!(run(folder.path(), &plot).ending(2).stderr.contains("has at least "));
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), before, "no file is left");
}

/// The least that is told is what can be had, and one fewer cannot.
#[test]
fn the_least_number_of_triangles_is_told() {
    let folder = grown();
    let told = run(folder.path(), &words(&["--triangles", "1"], "no.ply")).ending(2).stderr;
    let least = told.split("at least ").nth(1).and_then(|rest| rest.split(" triangles").next()).expect("a count");
    let least: usize = least.replace(' ', "").parse().expect("a number");
    run(folder.path(), &words(&["--triangles", &(least - 1).to_string()], "no.ply")).ending(2);
    run(folder.path(), &words(&["--triangles", &least.to_string()], "least.ply")).ending(0);
    assert_eq!(count(&mesh(&folder.path().join("least.ply")).0, "face"), least);
}
