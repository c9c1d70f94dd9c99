//! `picture` as people use it: shipped names, files, runs and species; the same bytes on any number of threads; the
//! inputs that are refused, and the messages.
//!
//! The content of pictures is tested beside the drawing, in closed forms; their format in `external_readers`.

mod program;

use program::{data, program as phytomer, run, said};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

fn picture(folder: &Path, out: &str, words: &[&str]) -> Vec<u8> {
    let all = [&["picture"][..], words, &["--size", "160x120", "--out", out]].concat();
    run(folder, &all).ending(0);
    fs::read(folder.join(out)).unwrap()
}

#[test]
fn a_run_a_scenario_and_a_species_are_drawn() {
    let folder = tempdir().unwrap();
    run(folder.path(), &["grow", &data("small.toml"), "--quiet"]).ending(0);
    let of_scenario = picture(folder.path(), "a.png", &[&data("small.toml"), "--age", "12", "--plant", "3"]);
    let of_run = picture(folder.path(), "b.png", &["runs/small", "--age", "12", "--plant", "3"]);
    assert_eq!(of_scenario, of_run, "a run keeps what its plants need to be grown again");
    assert!(of_run.starts_with(b"\x89PNG\r\n\x1a\n"));
    for name in ["gmt1/5a", "example1", &data("bush.toml")] {
        picture(folder.path(), "c.png", &[name]);
    }
    assert!(!folder.path().join("c.png.tmp").exists());
}

#[test]
fn the_bytes_do_not_depend_on_threads() {
    let folder = tempdir().unwrap();
    let draw = |threads: &str| {
        let words = ["picture", &data("small.toml"), "--ages", "6,12", "--plants", "0,3", "--size", "320x200"];
        let words = [&words[..], &["--out", "t.png"]].concat();
        said(phytomer(folder.path(), &words).env("RAYON_NUM_THREADS", threads).output().unwrap()).ending(0);
        fs::read(folder.path().join("t.png")).unwrap()
    };
    let first = draw("1");
    for threads in ["1", "2", "7"] {
        assert!(draw(threads) == first, "{threads} threads");
    }
}

#[test]
fn every_view_is_another_picture() {
    let folder = tempdir().unwrap();
    let views = ["perspective", "top", "front", "side", "oblique", "sheet"];
    let drawn = views.map(|view| picture(folder.path(), "v.png", &["coffee", "--age", "24", "--view", view]));
    for (k, one) in drawn.iter().enumerate() {
        assert!(drawn[..k].iter().all(|other| other != one), "{}", views[k]);
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_with_words() {
    let folder = tempdir().unwrap();
    for (words, code, meant) in [
        (vec!["coffee", "--age", "145"], 2, "--age 145: the run has the ages 0 to 144"),
        (vec!["coffee", "--age", "144.25"], 2, "--age 144.25: the run has the ages 0 to 144"),
        (vec!["coffee", "--age", "3,5"], 2, "an age in ticks is expected, such as 48, or 3.5"),
        (vec!["coffee", "--age", "nan"], 2, "an age in ticks is expected"),
        (vec!["coffee", "--age", "1e10"], 2, "an age in ticks is expected"),
        (vec!["coffee", "--age", "3.5", "--colour-by", "order"], 2, "--colour-by order needs an age such as 3 or 4"),
        (vec!["coffee", "--ages", "12,145"], 2, "--ages 145: the run has the ages 0 to 144"),
        (vec!["coffee", "--plants", "0,2000"], 2, "--plants 2000: the run has the plants 0 to 1999"),
        (vec!["coffee", "--size", "9x9"], 2, "1920x1080"),
        (vec!["coffee", "--sun", "10,95"], 2, "3 to 90 degrees"),
        (vec!["coffee", "--view", "below"], 2, "perspective"),
        (vec!["coffee", "--wind", "8"], 2, "no wood that bends"),
        (vec!["example1", "--colour-by", "area_m2"], 1, "nothing that stands has an area, as leaves have"),
        (vec!["example1", "--colour-by", "bending_moment_N_m"], 1, "the species states no `[wood]`"),
        (vec!["coffeee"], 3, "did you mean `coffee`?"),
        (vec!["coffee", "--age", "2", "--out", "no/folder.png"], 1, "cannot write"),
    ] {
        let out = if words.contains(&"--out") { &[][..] } else { &["--out", "x.png"] };
        let told = run(folder.path(), &[&["picture"][..], &words, out].concat()).ending(code);
        assert!(told.stdout.is_empty() && told.stderr.contains(meant), "{words:?}: {}", told.stderr);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
