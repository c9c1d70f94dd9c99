//! The destinations of `--out` of `mesh` and `picture`: files, links, pipes, devices, folders and stdout; names of
//! other formats; and the values of `--seed` and `--plants` of `grow`.
//!
//! The writing itself is tested in `phytomer_outputs::destination`.

mod program;

use program::{data, hashes, program as phytomer, run, said};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// A mesh and a picture, without the name of their file, with the first bytes of their formats and their extensions.
fn drawn() -> [(Vec<String>, &'static [u8], &'static str); 2] {
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
    [
        (words(&["mesh", "example1", "--age", "3"]), b"ply\nformat binary_little_endian", "ply"),
        (words(&["picture", "example1", "--age", "3", "--size", "32x32"]), b"\x89PNG\r\n\x1a\n", "png"),
    ]
}

fn written(folder: &Path, words: &[String], out: &str) -> program::Said {
    let words: Vec<&str> = words.iter().map(String::as_str).chain(["--out", out]).collect();
    run(folder, &words)
}

fn count_of(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

#[test]
fn a_name_of_another_format_is_refused() {
    let folder = tempdir().unwrap();
    for (words, head, extension) in drawn() {
        for out in ["x.fbx", "x.gltf", "x.jpg", "x.svg", "x.parquet", "a folder/"] {
            let told = written(folder.path(), &words, out).ending(2);
            let meant = if out.ends_with('/') { "this is a folder" } else { &format!("(.{extension})") };
            assert!(told.stderr.contains(meant) && told.stdout.is_empty(), "{out}: {}", told.stderr);
        }
        assert_eq!(count_of(folder.path()), 0);
        let upper = format!("x.{}", extension.to_uppercase());
        for out in [upper.as_str(), "plain"] {
            let told = written(folder.path(), &words, out).ending(0);
            assert!(told.stdout.starts_with(out), "{}", told.stdout);
            assert!(fs::read(folder.path().join(out)).unwrap().starts_with(head), "{out}");
            fs::remove_file(folder.path().join(out)).unwrap();
        }
    }
    fs::create_dir(folder.path().join("x.ply")).unwrap();
    let told = written(folder.path(), &drawn()[0].0, "x.ply").ending(2);
    assert!(told.stderr.contains("this is a folder"), "{}", told.stderr);
}

#[test]
fn stdout_carries_the_file_alone() {
    let folder = tempdir().unwrap();
    for (words, head, _) in drawn() {
        let words: Vec<&str> = words.iter().map(String::as_str).chain(["--out", "-"]).collect();
        let done = phytomer(folder.path(), &words).output().unwrap();
        assert!(done.status.success() && done.stdout.starts_with(head));
        let told = String::from_utf8(done.stderr).unwrap();
        assert!(told.starts_with("stdout: plant 0 at age 3"), "{told}");
        written(folder.path(), &words[..words.len() - 2].iter().map(|w| (*w).to_owned()).collect::<Vec<_>>(), "file");
        assert_eq!(done.stdout, fs::read(folder.path().join("file")).unwrap());
    }
    assert_eq!(count_of(folder.path()), 1);
}

#[cfg(unix)]
#[test]
fn links_pipes_and_devices_stay_what_they_are() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    symlink("absent", at("dangling")).unwrap();
    fs::write(at("there"), "old").unwrap();
    symlink("there", at("link")).unwrap();
    assert!(std::process::Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
    for (words, head, _) in drawn() {
        for (link, target) in [("dangling", "absent"), ("link", "there")] {
            written(folder.path(), &words, link).ending(0);
            assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink(), "{link}");
            assert!(fs::read(at(target)).unwrap().starts_with(head), "{target}");
        }
        let pipe = at("pipe");
        let reader = std::thread::spawn(move || fs::read(pipe).unwrap());
        written(folder.path(), &words, "pipe").ending(0);
        assert_eq!(reader.join().unwrap(), fs::read(at("there")).unwrap());
        written(folder.path(), &words, "/dev/null").ending(0);
        let through: Vec<&str> = words.iter().map(String::as_str).chain(["--out", "/dev/stdout"]).collect();
        let done = phytomer(folder.path(), &through).output().unwrap();
        assert!(done.status.success() && done.stdout == fs::read(at("there")).unwrap());
    }
    assert!(fs::symlink_metadata(at("pipe")).unwrap().file_type().is_fifo());
    assert_eq!(count_of(folder.path()), 5, "nothing is left beside them");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_ends_in_an_error() {
    use std::os::unix::fs::FileTypeExt;
    let folder = tempdir().unwrap();
    for (words, ..) in drawn() {
        let told = written(folder.path(), &words, "/dev/full").ending(1);
        assert!(told.stderr.contains("cannot write /dev/full: No space left on device"), "{}", told.stderr);
    }
    assert!(fs::metadata("/dev/full").unwrap().file_type().is_char_device());
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let folder = tempdir().unwrap();
    let words = ["mesh", "coffee", "--age", "60", "--out", "-"];
    let mut child = phytomer(folder.path(), &words)
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    said(child.wait_with_output().unwrap()).ending(0);
}

/// Every seed that the command line accepts can be stated by a scenario, and is recorded unchanged.
#[test]
fn seeds_have_one_range() {
    let folder = tempdir().unwrap();
    let most = i64::MAX.to_string();
    let words = ["grow", "example1", "--quiet", "--plants", "1", "--seed", &most, "--out", "run"];
    run(folder.path(), &words).ending(0);
    let recorded = fs::read_to_string(folder.path().join("run/run.json")).unwrap();
    assert!(recorded.contains(&format!("\"seed\": {most}")), "{recorded}");
    let told = run(folder.path(), &["describe", "run", "--json"]).ending(0);
    assert_eq!(told.json()["seed"], i64::MAX);
    written(folder.path(), &["mesh", "run"].map(str::to_owned), "mesh.ply").ending(0);
    let mesh = fs::read(folder.path().join("mesh.ply")).unwrap();
    assert!(String::from_utf8_lossy(&mesh[..400]).contains(&format!("seed {most}")));
    let scenario = |seed: &str| {
        let text = format!("name = \"s\"\nspecies = \"example1\"\nplants = 1\nseed = {seed}\nages = {{ until = 3 }}\n");
        fs::write(folder.path().join("s.toml"), text).unwrap();
        run(folder.path(), &["grow", "s.toml", "--quiet", "--overwrite"])
    };
    scenario(&most).ending(0);
    for seed in ["9223372036854775808", "18446744073709551615", "-1"] {
        scenario(seed).ending(3);
        let told = run(folder.path(), &["grow", "example1", "--seed", seed, "--out", "other"]).ending(2);
        assert!(told.stderr.contains("a whole number from 0 to 9223372036854775807"), "{seed}: {}", told.stderr);
    }
    assert!(!folder.path().join("other").exists());
}

/// With fewer plants each plant is that of the full run: with its mesh, if the scenario draws it, and with its bytes.
#[test]
fn fewer_plants_leave_out_their_meshes() {
    let folder = tempdir().unwrap();
    let meshes = |name: &str, words: &[&str]| {
        let told = run(folder.path(), &[&["grow"], words, &["--out", name]].concat()).ending(0);
        let meshes = hashes(&folder.path().join(name)).into_iter().filter(|(path, _)| path.ends_with(".ply"));
        (meshes.collect::<Vec<_>>(), told.stderr)
    };
    let (three, told) = meshes("three", &["example2", "--plants", "3"]);
    let left_out = "the meshes of 9 plants that the scenario asks for are left out: with --plants 3";
    assert!(three.len() == 3 && told.contains(left_out), "{told}");
    let (one, _) = meshes("one", &["example2", "--plants", "1", "--quiet"]);
    assert_eq!(one, three[..1]);
    let (twenty, told) = meshes("twenty", &["example2", "--plants", "20"]);
    assert!(twenty.len() == 12 && twenty[..3] == three && !told.contains("left out"), "{told}");
    let listed = |plants: &str| {
        let text = format!(
            "name = \"s\"\nspecies = \"example1\"\nplants = 4\nages = {{ until = 3 }}\nmeshes = {{ plants = {plants} }}\n"
        );
        fs::write(folder.path().join("s.toml"), text).unwrap();
        "s.toml"
    };
    assert_eq!(meshes("listed", &[listed("[0, 3]"), "--plants", "2"]).0.len(), 1);
    assert_eq!(meshes("none", &[listed("[2, 3]"), "--plants", "2"]).0.len(), 0);
    run(folder.path(), &["grow", listed("[0, 4]"), "--out", "beyond"]).ending(3);
    run(folder.path(), &["grow", "coffee", "--plants", "1", "--dry-run"]).ending(0);
}

/// The places of a plantation, and with them every mesh, are the same however many plants grow.
#[test]
fn plants_keep_their_places_and_bytes_however_many_grow() {
    let folder = tempdir().unwrap();
    let meshes = |plants: &str| {
        let words = ["grow", &data("small.toml"), "--plants", plants, "--quiet", "--out", plants];
        run(folder.path(), &words).ending(0);
        let all = hashes(&folder.path().join(plants)).into_iter();
        all.filter(|(path, _)| path.contains("meshes/")).collect::<Vec<_>>()
    };
    let (some, all) = (meshes("8"), meshes("12"));
    assert_eq!(some.len(), 4);
    for mesh in &some {
        assert!(all.contains(mesh), "{mesh:?}");
    }
}
