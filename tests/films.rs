//! `animate` as people use it: every ending, frames that are the pictures of their ages, ground that stands still, the
//! same bytes on any number of threads, films that Ctrl-C ends, and what is refused.
//!
//! Formats are tested pixel by pixel beside their encoders. Here an animated PNG tells the frames, as png reads it.

mod program;

use program::{Said, data, program as phytomer, run, said};
use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::process::Stdio;
use tempfile::tempdir;

const SIZE: &str = "160x120";
type Pixels = Vec<[u8; 3]>;

/// Makes a film of the bush of the tests, of the size of the tests unless the words state another.
fn animate(folder: &Path, words: &[&str]) -> Said {
    let small: &[&str] = if words.contains(&"--size") { &[] } else { &["--size", SIZE] };
    run(folder, &[&["animate", &data("small.toml")][..], small, words].concat())
}

/// The pictures of an animated PNG, or the one of a plain one, laid over one another, with the seconds that each lasts.
fn read_png(file: &[u8]) -> Vec<(Pixels, f64)> {
    let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let count = reader.info().animation_control.map_or(1, |control| control.num_frames);
    let mut stands = vec![[0; 3]; width * height];
    let mut read = Vec::new();
    for _ in 0..count {
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut bytes).unwrap();
        let control = reader.info().frame_control().copied().unwrap_or_default();
        for (row, line) in bytes[..frame.buffer_size()].chunks(frame.line_size).enumerate() {
            for (column, pixel) in line.chunks(3).enumerate() {
                let at = (control.y_offset as usize + row) * width + control.x_offset as usize + column;
                stands[at] = [pixel[0], pixel[1], pixel[2]];
            }
        }
        let time = f64::from(control.delay_num) / f64::from(control.delay_den.max(1));
        read.push((stands.clone(), time));
    }
    read
}

fn read(path: &Path) -> Vec<(Pixels, f64)> {
    read_png(&fs::read(path).unwrap())
}

#[test]
fn every_frame_is_the_picture_of_its_age() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    animate(folder.path(), &["--plant", "3", "--ages", "2..12/5", "--seconds", "1", "--out", "a.apng"]).ending(0);
    animate(folder.path(), &["--plant", "3", "--ages", "2..12/5", "--seconds", "1", "--out", "frames/"]).ending(0);
    let (film, files) = (read(&at("a.apng")), fs::read_dir(at("frames")).unwrap().count());
    assert_eq!((film.len(), files), (3, 24), "pictures are held, and a frame is a file");
    assert!((film.iter().map(|(_, time)| time).sum::<f64>() - 1.0).abs() < 1e-9);
    // 23 steps over two: the first and the last are held for half as long as the middle.
    for (((seen, time), age), (held, frame)) in film.iter().zip(["2", "7", "12"]).zip([(6, 1), (12, 7), (6, 24)]) {
        let words = ["picture", &data("small.toml"), "--plant", "3", "--age", age, "--size", SIZE];
        run(folder.path(), &[&words[..], &["--framed-for", "2..12/5", "--out", "p.png"]].concat()).ending(0);
        assert!(read(&at("p.png"))[0].0 == *seen, "age {age}");
        assert!(read(&at(&format!("frames/frame-{frame:04}.png")))[0].0 == *seen, "frame {frame}");
        assert!((time * 24.0 - f64::from(held)).abs() < 1e-9, "age {age} is held for {time} s");
    }
    // Of one age the camera of the film is that of the picture.
    animate(folder.path(), &["--ages", "12", "--out", "one.apng"]).ending(0);
    run(folder.path(), &["picture", &data("small.toml"), "--age", "12", "--size", SIZE, "--out", "p.png"]).ending(0);
    assert!(read(&at("one.apng"))[0].0 == read(&at("p.png"))[0].0);
}

/// Between ticks too, by one camera; and at the ticks a film is what it is without a picture between them.
#[test]
fn frames_between_ticks_are_the_pictures_of_their_ages() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let film = |ages: &str, frames: &str| {
        let words = ["--ages", ages, "--fps", frames, "--seconds", "1", "--out", "a.apng"];
        animate(folder.path(), &words).ending(0);
        read(&at("a.apng"))
    };
    let (smooth, whole) = (film("8..10", "5"), film("8..10/1", "3"));
    assert_eq!((smooth.len(), whole.len()), (5, 3));
    for (frame, age) in ["8", "8.5", "9", "9.5", "10"].into_iter().enumerate() {
        let words = ["picture", &data("small.toml"), "--age", age, "--size", SIZE, "--framed-for", "8..10"];
        run(folder.path(), &[&words[..], &["--out", "p.png"]].concat()).ending(0);
        assert!(read(&at("p.png"))[0].0 == smooth[frame].0, "age {age}");
    }
    assert!((0..3).all(|k| smooth[2 * k].0 == whole[k].0));
    assert!(smooth[1].0 != smooth[0].0 && smooth[1].0 != smooth[2].0);
}

#[test]
fn bare_ground_stands_still_while_the_plant_grows() {
    let folder = tempdir().unwrap();
    let words =
        ["animate", &data("small.toml"), "--size", "480x120", "--no-caption", "--seconds", "1", "--ages", "1..12"];
    run(folder.path(), &[&words[..], &["--out", "a.apng"]].concat()).ending(0);
    let film = read(&folder.path().join("a.apng"));
    assert_eq!(film.len(), 24, "between ticks each frame is its own");
    let (first, last) = (&film[0].0, &film[23].0);
    assert!(first != last);
    // The bush stands in the middle, 180 pixels wide at last. Its shade falls to the right, and it takes light of the
    // sky up to 0.42 of its size away. Beyond that, and in the sky above it, no pixel changes by a single level.
    let same = |at: usize| film.iter().all(|(seen, _)| seen[at] == first[at]);
    assert!((0..4 * 480).all(same), "the sky has changed");
    assert!((0..480 * 120).filter(|at| at % 480 < 30).all(same), "ground far from the plant has changed");
    let still = (0..480 * 120).filter(|at| same(*at)).count();
    assert!(still > 480 * 120 / 2, "{still} pixels never change");
}

#[test]
fn the_bytes_do_not_depend_on_threads() {
    let folder = tempdir().unwrap();
    for ending in ["webp", "gif", "apng", "y4m"] {
        let film = |threads: &str| {
            let out = format!("t.{ending}");
            let words = ["animate", &data("small.toml"), "--size", SIZE, "--ages", "4..12/2", "--seconds", "0.5"];
            let words = [&words[..], &["--orbit", "40", "--out", &out]].concat();
            said(phytomer(folder.path(), &words).env("RAYON_NUM_THREADS", threads).output().unwrap()).ending(0);
            fs::read(folder.path().join(out)).unwrap()
        };
        let first = film("1");
        for threads in ["2", "8"] {
            assert!(film(threads) == first, "{ending} on {threads} threads");
        }
    }
}

#[test]
fn a_stream_goes_into_a_pipe_and_its_words_to_stderr() {
    let folder = tempdir().unwrap();
    let words = [
        "animate",
        &data("small.toml"),
        "--size",
        "32x16",
        "--ages",
        "1..3",
        "--fps",
        "2",
        "--seconds",
        "2",
        "--out",
        "-",
    ];
    let out = phytomer(folder.path(), &words).output().unwrap();
    assert!(out.status.success());
    let head = b"YUV4MPEG2 W32 H16 F2:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
    assert!(out.stdout.starts_with(head));
    assert_eq!(out.stdout.len(), head.len() + 4 * (6 + 3 * 32 * 16));
    assert!(String::from_utf8_lossy(&out.stderr).contains("stdout: plant 0 from age 1 to 3, 4 frames in 2.0 s"));
}

#[test]
fn plots_films_of_wind_and_walks_are_drawn() {
    let folder = tempdir().unwrap();
    let film = |words: &[&str]| {
        let size = ["--size", "96x64", "--out", "a.apng"];
        run(folder.path(), &[&["animate"], words, &size].concat()).ending(0);
        read(&folder.path().join("a.apng"))
    };
    let plot = film(&["under_a_roof", "--plot", "--ages", "2..6/2", "--seconds", "0.5"]);
    assert_eq!(plot.len(), 3);
    let bending = data("bending.toml");
    let wind = film(&[&bending, "--ages", "6", "--wind", "12", "--fps", "1"]);
    assert_eq!(wind.len(), 8, "a film of wind lasts one gust");
    assert!(wind[1..].iter().all(|(seen, _)| *seen != wind[0].0));
    // It loops: what would follow its last frame is its first.
    let later = film(&[&bending, "--ages", "6", "--wind", "12", "--fps", "1", "--time", "8"]);
    let furthest = |a: &Pixels, b: &Pixels| {
        a.as_flattened().iter().zip(b.as_flattened()).filter(|(a, b)| a.abs_diff(**b) > 8).count()
    };
    assert!(furthest(&wind[0].0, &later[0].0) * 20 < furthest(&wind[0].0, &wind[1].0).max(20));
    let walk = film(&[&bending, "--ages", "6", "--orbit", "360", "--fps", "4", "--seconds", "1"]);
    assert_eq!(walk.len(), 4);
    assert!(walk[0].0 != walk[1].0);
    let follows = film(&[&bending, "--ages", "1..6/5", "--follow", "--fps", "2", "--seconds", "1"]);
    let holds = film(&[&bending, "--ages", "1..6/5", "--fps", "2", "--seconds", "1"]);
    assert!(follows[0].0 != holds[0].0 && follows[1].0 == holds[1].0, "at the end both hold all");
}

#[test]
fn what_cannot_be_filmed_is_refused_with_words() {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("taken")).unwrap();
    fs::write(folder.path().join("taken/frame-0001.png"), "x").unwrap();
    for (words, code, meant) in [
        (vec!["--ages", "1..25", "--out", "a.gif"], 2, "--ages 25: the run has the ages 0 to 24"),
        (vec!["--ages", "9..2", "--out", "a.gif"], 2, "the first age, 9, is after the last, 2"),
        (vec!["--ages", "1..12/0", "--out", "a.gif"], 2, "a step of at least 0.001"),
        (vec!["--ages", "1.5.1..3", "--out", "a.gif"], 2, "ages in ticks are expected"),
        (vec!["--ages", "1..24.5", "--out", "a.gif"], 2, "--ages 24.5: the run has the ages 0 to 24"),
        (vec!["--ages", "nan..3", "--out", "a.gif"], 2, "ages in ticks are expected"),
        (vec!["--ages", "1..3/-1", "--out", "a.gif"], 2, "a step of at least 0.001 is expected"),
        (vec!["--plant", "12", "--out", "a.gif"], 2, "--plant 12: the run has the plants 0 to 11"),
        (vec!["--plot", "12", "--out", "a.gif"], 2, "--plot 12: the run has the plots 0 to 11"),
        (vec!["--out", "a.avi"], 2, "`animate` cannot write `.avi`; the endings that it has: .webp, .gif"),
        (vec!["--out", "film"], 2, "the name has no ending"),
        (vec!["--fps", "0", "--out", "a.gif"], 2, "1..=120"),
        (vec!["--fps", "60", "--out", "a.gif"], 2, "a GIF plays at most 50 frames a second"),
        (vec!["--seconds", "NaN", "--out", "a.gif"], 2, "a length above 0 and up to 600 seconds"),
        (vec!["--seconds", "0", "--out", "a.gif"], 2, "a length above 0"),
        (vec!["--seconds", "-3", "--out", "a.gif"], 2, "a length above 0"),
        (vec!["--seconds", "inf", "--out", "a.gif"], 2, "a length above 0"),
        (vec!["--size", "0x0", "--out", "a.gif"], 2, "two sides of 16 to"),
        (vec!["--size", "16384x16", "--out", "a.webp"], 2, "WebP has at most 16383 pixels"),
        (vec!["--size", "33x16", "--out", "a.mp4"], 2, "MP4 and WebM need even sides"),
        (vec!["--orbit", "NaN", "--out", "a.gif"], 2, "a number is expected"),
        (vec!["--quality", "0", "--out", "a.webp"], 2, "1..=100"),
        (vec!["--wind", "8", "--out", "a.gif"], 2, "no wood that bends"),
        (vec!["--out", "no/folder.gif"], 1, "cannot write no/folder.gif"),
        (vec!["--out", "taken/"], 1, "it has frames of another film, such as frame-0001.png"),
        (vec!["--ages", "1..2", "--out", "taken/frame-0001.png/"], 1, "cannot write taken/frame-0001.png"),
    ] {
        let told = animate(folder.path(), &words).ending(code);
        assert!(told.stdout.is_empty() && told.stderr.contains(meant), "{words:?}: {}", told.stderr);
    }
    run(folder.path(), &["animate", "coffeee", "--out", "a.gif"]).ending(3);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing was written");
    for (words, meant) in [
        (["--age", "3", "--framed-for", "2..12/5"], "it is none of the ages of --framed-for"),
        (["--view", "sheet", "--framed-for", "2..12"], "a sheet has four cameras"),
    ] {
        let told =
            run(folder.path(), &[&["picture", &data("small.toml"), "--out", "a.png"][..], &words].concat()).ending(2);
        assert!(told.stderr.contains(meant), "{}", told.stderr);
    }
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::time::Duration;

    /// Words for a film that no machine draws in a second.
    const LONG: [&str; 6] = ["--ages", "12", "--orbit", "360", "--seconds", "600"];

    #[test]
    fn without_ffmpeg_mp4_and_webm_are_refused_and_the_others_named() {
        let folder = tempdir().unwrap();
        for out in ["a.mp4", "a.webm"] {
            let words = ["animate", &data("small.toml"), "--out", out];
            let told = said(phytomer(folder.path(), &words).env("PATH", folder.path()).output().unwrap()).ending(1);
            assert!(
                told.stderr.contains("there is none on the path") && told.stderr.contains(".webp"),
                "{}",
                told.stderr
            );
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    /// An ffmpeg of the tests' own that counts the bytes that come, or fails.
    fn ffmpeg(folder: &Path, script: &str) {
        let path = folder.join("ffmpeg");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    #[test]
    fn an_ffmpeg_gets_every_frame_and_its_words_are_told() {
        let folder = tempdir().unwrap();
        let bin = tempdir().unwrap();
        let path = format!("{}:{}", bin.path().display(), std::env::var("PATH").unwrap());
        let film = |script: &str| {
            ffmpeg(bin.path(), script);
            let words =
                ["animate", &data("small.toml"), "--size", "32x16", "--ages", "1..3", "--fps", "2", "--seconds", "2"];
            let words = [&words[..], &["--out", "a.mp4"]].concat();
            said(phytomer(folder.path(), &words).env("PATH", &path).output().unwrap())
        };
        let last = "for last; do :; done";
        film(&format!("[ \"$1\" = -version ] && exit 0; {last}; wc -c > \"$last\"")).ending(0);
        let counted = fs::read_to_string(folder.path().join("a.mp4")).unwrap();
        assert_eq!(counted.trim(), (4 * 3 * 32 * 16).to_string());
        let told = film("[ \"$1\" = -version ] && exit 0; echo 'Unknown encoder libx264' >&2; exit 1").ending(1);
        assert!(told.stderr.contains("ffmpeg failed: Unknown encoder libx264"), "{}", told.stderr);
        assert_eq!(fs::read_to_string(folder.path().join("a.mp4")).unwrap(), counted, "the film before is kept");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_disk_that_is_full_in_mid_film_is_told() {
        let folder = tempdir().unwrap();
        for name in ["full.y4m", "full.gif", "full.apng"] {
            symlink("/dev/full", folder.path().join(name)).unwrap();
            let told = animate(folder.path(), &["--ages", "1..12", "--seconds", "1", "--out", name]).ending(1);
            assert!(told.stderr.contains("No space left on device") && told.stderr.contains(name), "{}", told.stderr);
        }
        symlink("/dev/full", folder.path().join("full.webp")).unwrap();
        let told = animate(folder.path(), &["--out", "full.webp"]).ending(2);
        assert!(told.stderr.contains("which a pipe or a device cannot"), "{}", told.stderr);
    }

    #[test]
    fn a_folder_that_cannot_be_written_is_told() {
        let folder = tempdir().unwrap();
        let sealed = folder.path().join("sealed");
        fs::create_dir(&sealed).unwrap();
        fs::set_permissions(&sealed, fs::Permissions::from_mode(0o555)).unwrap();
        // Root may write everywhere.
        if fs::write(sealed.join("try"), "x").is_ok() {
            return;
        }
        for out in ["sealed/a.webp", "sealed/frames/"] {
            let told = animate(folder.path(), &["--out", out]).ending(1);
            assert!(told.stderr.contains("Permission denied"), "{}", told.stderr);
        }
    }

    /// Whether the file beside the final one has bytes before two minutes have gone.
    fn grows(folder: &Path) -> bool {
        let begun = |entry: std::io::Result<fs::DirEntry>| {
            let entry = entry.unwrap();
            entry.file_name().to_string_lossy().ends_with(".tmp") && entry.metadata().is_ok_and(|file| file.len() > 0)
        };
        (0..2400).any(|_| {
            std::thread::sleep(Duration::from_millis(50));
            fs::read_dir(folder).unwrap().any(begun)
        })
    }

    #[test]
    fn ctrl_c_leaves_a_film_of_what_is_drawn() {
        let folder = tempdir().unwrap();
        for ending in ["apng", "gif", "webp", "y4m"] {
            let name = format!("a.{ending}");
            let out = folder.path().join(&name);
            let scenario = data("small.toml");
            let words = [&["animate", &scenario, "--size", SIZE][..], &LONG, &["--out", &name]].concat();
            let child = phytomer(folder.path(), &words).stderr(Stdio::piped()).spawn().unwrap();
            assert!(grows(folder.path()), "nothing is drawn");
            assert!(!out.exists(), "the name stands for a whole film");
            let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
            assert!(kill.success());
            let told = said(child.wait_with_output().unwrap()).ending(130);
            assert!(told.stderr.contains(&format!("stopped; {name} has the first ")), "{}", told.stderr);
            let words: Vec<&str> = told.stderr.split_whitespace().collect();
            let frames =
                words.iter().position(|word| *word == "first").map(|at| words[at + 1].parse::<usize>().unwrap());
            let (frames, file) = (frames.unwrap(), fs::read(&out).unwrap());
            assert!((1..14_400).contains(&frames), "{frames}");
            match ending {
                "apng" => assert_eq!(read_png(&file).len(), frames),
                "gif" => assert_eq!(file.last(), Some(&b';'), "the end of a GIF"),
                "webp" => assert_eq!(u32::from_le_bytes(file[4..8].try_into().unwrap()) as usize, file.len() - 8),
                _ => assert_eq!(file.windows(6).filter(|word| word == b"FRAME\n").count(), frames),
            }
        }
    }
}
