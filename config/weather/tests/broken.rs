//! Twenty thousand broken weather files: each is weather that holds together, or is told; none panics or hangs.
//!
//! The short form of the fuzz target `weather` (`fuzz/`), over the files of `data`, with draws that are always the
//! same. Absent: coverage, which libFuzzer has.

mod answered;

mod draw;

use answered::{answer, choice};
use draw::Draw;
use phytomer_weather::Format;
use std::time::{Duration, Instant};

const FILES: [(Format, &[u8]); 5] = [
    (Format::Dssat, include_bytes!("data/station.WTH")),
    (Format::Dssat, include_bytes!("data/sections.WTH")),
    (Format::Agmip, include_bytes!("data/station.AgMIP")),
    (Format::Apsim, include_bytes!("data/station.met")),
    (Format::Csv, include_bytes!("data/station.csv")),
];

const PIECES: [&str; 24] = [
    "-99",
    "*****",
    "99999999999999999999",
    "1e999",
    "nan",
    "@DATE",
    "@",
    "*",
    "$",
    "!",
    "\x1a",
    "\t",
    "\r",
    "\n",
    "\0",
    "=",
    "(",
    "\"",
    ";",
    "95366",
    "9999365",
    "-",
    "é",
    "@DATE  TMAX  TMIN\n",
];

fn broken(file: &[u8], draw: &mut Draw) -> Vec<u8> {
    let mut file = file.to_vec();
    for _ in 0..=draw.below(3) {
        let at = draw.below(file.len());
        let end = (at + 1 + draw.below(40)).min(file.len());
        let piece = PIECES[draw.below(PIECES.len())].as_bytes();
        match draw.below(6) {
            0 => _ = file.drain(at..end),
            1 => _ = file.splice(at..end, piece.iter().copied()),
            2 => _ = file.splice(at..at, piece.iter().copied()),
            3 => file.truncate(at),
            4 => {
                let copy = file[at..end].to_vec();
                let to = draw.below(file.len());
                file.splice(to..to, copy);
            }
            _ => {
                if let Some(byte) = file.get_mut(at) {
                    *byte = draw.below(256) as u8;
                }
            }
        }
    }
    file
}

#[test]
fn whole_files_are_read() {
    for (format, file) in FILES {
        assert!(answer(&[&[choice(format)], file].concat()), "{format:?}");
    }
}

#[test]
fn a_broken_file_is_read_or_told() {
    let (mut draw, mut read, began) = (Draw(1995), 0, Instant::now());
    for _ in 0..20_000 {
        let (format, file) = FILES[draw.below(FILES.len())];
        // Most are read as what they are, some as another format, with gaps filled or not, repeated or not.
        let choice =
            if draw.below(8) == 0 { draw.below(256) as u8 } else { choice(format) | (draw.below(16) << 4) as u8 };
        let mut input = vec![choice];
        input.extend(broken(file, &mut draw));
        let one = Instant::now();
        read += u32::from(answer(&input));
        assert!(one.elapsed() < Duration::from_secs(20), "{:?}", String::from_utf8_lossy(&input));
    }
    println!("{read} of 20,000 were read, in {:?}", began.elapsed());
    assert!((2_000..18_000).contains(&read), "{read}: if nearly all were read, or none, this would test little");
}

#[test]
fn files_that_are_all_of_one_thing_are_told() {
    let rows = "@DATE  TMAX  TMIN\n95001 1 ";
    for piece in PIECES.iter().copied().chain(["@DATE TMAX TMIN ", "95001 1 1\n", "a=1\n", "x,", rows, "1 "]) {
        let text = piece.repeat(30_000);
        let began = Instant::now();
        for choice in 0..4 {
            answer(&[&[choice], text.as_bytes()].concat());
            answer(&[&[choice], b"@DATE  TMAX  TMIN  RHUM\n95001 ".as_slice(), text.as_bytes()].concat());
        }
        assert!(began.elapsed() < Duration::from_secs(20), "{piece:?} takes {:?}", began.elapsed());
    }
}
