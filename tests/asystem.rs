//! `phytomer asystem`: scripts that ship, what is refused, what is typed, and the tables of a run.
//!
//! Absent: the language (its crate), and stages (`src/asystem/tests`).

mod program;

use phytomer::asystem::checked;
use phytomer::outputs::Table;
use phytomer::outputs::read::Run;
use program::{program as phytomer, run};
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use tempfile::tempdir;

fn scripts() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/asystem");
    let entries = fs::read_dir(folder).expect("the scripts that ship");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "asys"));
    paths.sort();
    paths
}

#[test]
fn every_script_that_ships_can_run_and_has_its_picture() {
    let all = scripts();
    assert!(all.len() >= 45, "{} scripts", all.len());
    for path in &all {
        let text = fs::read_to_string(path).expect("a script");
        let refused = checked(&text).map_or_else(|refused| refused.to_string(), |_| String::new());
        assert_eq!(refused, "", "{}", path.display());
        assert!(text.contains(&format!("open {} display;", path.file_stem().unwrap().to_string_lossy())));
        assert!(path.with_extension("png").is_file(), "no picture of {}", path.display());
    }
}

#[test]
fn a_script_that_ships_draws_its_picture_to_the_byte() {
    let folder = tempdir().unwrap();
    for path in scripts().iter().filter(|path| path.ends_with("fig6a.asys") || path.ends_with("fig12c.asys")) {
        run(folder.path(), &["asystem", &path.to_string_lossy(), "--out", "drawn"]).ending(0);
        let picture = path.with_extension("png");
        let drawn = folder.path().join("drawn").join(picture.file_name().unwrap());
        assert!(fs::read(&drawn).unwrap() == fs::read(&picture).unwrap(), "{} is another picture", picture.display());
    }
}

#[test]
fn what_is_wrong_is_told_with_file_line_and_column_and_nothing_is_drawn() {
    let folder = tempdir().unwrap();
    fs::write(
        folder.path().join("s.asys"),
        "open a plotter;\ncreate gmt1 oak 3 .9 .7 20 -40;\nmove oak 1;\nappear aok on;",
    )
    .unwrap();
    let told = run(folder.path(), &["asystem", "s.asys", "--out", "drawn"]).ending(3).stderr;
    assert!(told.contains("s.asys:3:1: `move` is no command") && told.contains("s.asys:4:8: no tree is named `aok`"));
    assert!(told.contains("the nearest is `oak`") && !folder.path().join("drawn").exists());
    fs::write(folder.path().join("large.asys"), "\n  create gmt3 a 15 .9 .8 .8 20 -40;").unwrap();
    let told = run(folder.path(), &["asystem", "large.asys", "--out", "drawn"]).ending(3).stderr;
    assert!(told.contains("large.asys:2:3: the tree `a` of growth level 15 would have"), "{told}");
    fs::write(folder.path().join("bytes.asys"), [0xff, 0xfe, 0x00]).unwrap();
    assert!(
        run(folder.path(), &["asystem", "bytes.asys", "--out", "drawn"]).ending(2).stderr.contains("no text in UTF-8")
    );
    run(folder.path(), &["asystem", "none.asys", "--out", "drawn"]).ending(1);
}

#[test]
fn with_local_a_script_reads_on_from_stdin() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("s.asys"), "open a plotter; create gmt1 oak 3 .9 .7 20 -40; local;").unwrap();
    let mut child = phytomer(folder.path(), &["asystem", "s.asys", "--out", "drawn"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let typed = b"copy oka b;\ncopy oak\n ash;\ninform ash;\nexit;\ndelete ash;\n";
    child.stdin.take().unwrap().write_all(typed).unwrap();
    let output = child.wait_with_output().unwrap();
    let (told, wrong) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && wrong.contains("stdin:1:6: no tree is named `oka`"), "{wrong}");
    assert!(told.contains("name = \"ash\"") && told.contains("a.svg"), "{told}");
    assert!(folder.path().join("drawn/a.svg").is_file());
}

#[test]
fn the_trees_of_a_script_are_one_plot_in_tables() {
    let folder = tempdir().unwrap();
    let script =
        "create gmt1 oak 3 .9 .7 20 -40; create gmt3 ash 2 .8 .7 .7 30 -30; abs_translate ash 5 -2 1; abs_zoom oak 2;";
    fs::write(folder.path().join("s.asys"), script).unwrap();
    run(folder.path(), &["asystem", "s.asys", "--out", "drawn", "--run", "runs/trees"]).ending(0);
    let run = Run::open(&folder.path().join("runs/trees")).unwrap();
    assert_eq!(run.rows().unwrap().get(&Table::Plants), Some(&2));
}
