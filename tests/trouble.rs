//! The messages of the program where a run folder is damaged or the system refuses: each file, each cause, once.
//!
//! Absent: how damage is found and mended (`damage`).

mod program;

use program::{data, grown, run, write};
use std::fs;

#[test]
fn verify_tells_of_each_file_and_resume_mends() {
    let folder = grown();
    let whole = run(folder.path(), &["verify", "small"]).ending(0).stdout;
    assert!(whole.contains("a complete run; 26 files") && whole.contains("all as they were written"), "{whole}");
    assert_eq!(run(folder.path(), &["verify", "runs/small", "--quiet"]).ending(0).stdout, "");
    let missing = "runs/small/records/part-00001.parquet";
    fs::remove_file(folder.path().join(missing)).unwrap();
    write(folder.path(), "runs/small/notes.txt", "mine");
    let told = run(folder.path(), &["verify", "runs/small"]).ending(1).stdout;
    for word in ["a damaged run", "records/part-00001.parquet: missing", "notes.txt: foreign", "--resume", "1 part"] {
        assert!(told.contains(word), "`{word}` is missing in {told}");
    }
    for quick in [&["describe", "runs/small"][..], &["describe", "runs/small", "--quick"]] {
        let told = run(folder.path(), quick).ending(1).stdout;
        assert!(told.contains("a damaged run") && told.contains("part-00001.parquet: missing"), "{told}");
    }
    let mended = run(folder.path(), &["grow", &data("small.toml"), "--resume"]).ending(0);
    for word in ["records/part-00001.parquet: missing", "parts to grow: 1", "left alone", "notes.txt"] {
        assert!(mended.stderr.contains(word), "`{word}` is missing in {}", mended.stderr);
    }
    let told = run(folder.path(), &["describe", "small"]).ending(0).stdout;
    assert!(told.contains("a complete run") && told.contains("notes.txt: foreign"), "{told}");
    run(folder.path(), &["verify", "small"]).ending(1);
    let none = run(folder.path(), &["verify", "smal"]).ending(2).stderr;
    assert!(none.contains("there is no run `smal`"), "{none}");
}

/// The system's error text stands once in a message, however many layers have passed it on.
#[test]
fn each_cause_is_told_once() {
    let folder = grown();
    write(folder.path(), "file", "no folder");
    let answer = |error: std::io::Error| error.to_string();
    let no_folder = answer(fs::read_dir(folder.path().join("file")).unwrap_err());
    let nothing = answer(fs::read(folder.path().join("nothing")).unwrap_err());
    for (words, cause) in [
        (vec!["grow", "coffee", "--plants", "4", "--out", "file/run"], &no_folder),
        (vec!["mesh", "runs/small", "--out", "no/such/folder.ply"], &nothing),
        (vec!["picture", "runs/small", "--out", "no/such/folder.png"], &nothing),
    ] {
        let told = run(folder.path(), &words).ending(1).stderr;
        assert_eq!(told.matches(cause.as_str()).count(), 1, "{told}");
    }
    fs::remove_dir_all(folder.path().join("runs/small/records")).unwrap();
    write(folder.path(), "runs/small/records", "no folder");
    let told = run(folder.path(), &["grow", &data("small.toml"), "--resume"]).ending(1).stderr;
    assert_eq!(told.lines().filter(|line| line.starts_with("error: ")).count(), 1, "{told}");
}
