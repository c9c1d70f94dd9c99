//! Six thousand broken files of other programs: each is converted, or told with its place; none panics or hangs.
//!
//! The draws are always the same. Absent: whether the model takes what is written.

mod draw;

use draw::Draw;
use phytomer_peers::{Asked, Failed, convert};

const FILES: [(&str, &[u8]); 5] = [
    ("a.xml", include_bytes!("data/hill_larch.xml")),
    ("a.py", include_bytes!("data/pond_alder.py")),
    ("b.py", include_bytes!("data/field_maple.py")),
    ("b.xml", include_bytes!("data/orchard.xml")),
    ("a.json", include_bytes!("data/thorn.json")),
];

const PIECES: [&str; 28] = [
    "-0",
    "1e999",
    "99999999999999999999",
    "nan",
    "0x",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "'",
    "\"",
    "\"\"\"",
    "#",
    "\\",
    "\\u12",
    "\0",
    "é",
    "\n",
    "<",
    ">",
    "&b;",
    "<!DOCTYPE a [<!ENTITY b \"c\">]>",
    "<!--",
    "None",
];

fn broken(file: &[u8], draw: &mut Draw) -> Vec<u8> {
    let mut file = file.to_vec();
    for _ in 0..=draw.below(2) {
        let at = draw.below(file.len());
        let end = (at + 1 + draw.below(40)).min(file.len());
        let piece = PIECES[draw.below(PIECES.len())].as_bytes();
        match draw.below(9) {
            0 => _ = file.drain(at..end),
            1 => _ = file.splice(at..end, piece.iter().copied()),
            2 => _ = file.splice(at..at, piece.iter().copied()),
            3 => file.truncate(at),
            4 => _ = file.splice(at..at, file[at..end].to_vec()),
            5 => _ = file.get_mut(at).map(|byte| *byte = draw.below(256) as u8),
            // Another digit, so that the file stays sound and its number does not.
            _ => {
                let digit = (at..file.len()).find(|place| file[*place].is_ascii_digit());
                _ = digit.map(|place| file[place] = b'0' + draw.below(10) as u8);
            }
        }
    }
    file
}

#[test]
fn a_broken_file_is_converted_or_told() {
    let (mut whole, mut told) = (0, 0);
    for number in 0..6000 {
        let mut draw = Draw(number);
        let (name, file) = FILES[draw.below(FILES.len())];
        let file = broken(file, &mut draw);
        let asked = Asked { from: None, tree: (name == "b.xml").then_some("Quince") };
        match convert(name, &file, asked) {
            Ok(converted) => {
                assert!(converted.told.iter().all(|told| told.line >= 1 && told.column >= 1));
                whole += 1;
            }
            Err(Failed::Refused(refused)) => {
                let lines = file.iter().filter(|byte| **byte == b'\n').count() + 1;
                assert!(refused.faults.iter().all(|fault| fault.line <= lines), "{refused}");
                told += 1;
            }
            Err(Failed::Choice { .. }) => told += 1,
            Err(failed @ Failed::Ending(_)) => panic!("{failed}"),
        }
    }
    println!("{whole} converted, {told} told");
    assert!(whole > 1000 && told > 1000, "{whole} converted, {told} told");
}
