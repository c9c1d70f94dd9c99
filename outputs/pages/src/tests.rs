//! A page of a small plant that is written by hand, read back: what its table says at each age, and where its leaf is.
//!
//! Whole species are held against `records` by an independent reader (`tests/readers/pages.py`), and seen by a browser
//! (`tests/readers/view.mjs`).

#[path = "../../life/src/specimen.rs"]
mod specimen;

use super::*;
use miniz_oxide::inflate::decompress_to_vec;
use phytomer_life::{Maker, Nearness};
use specimen::{TALL, plant};
use std::collections::BTreeMap;

fn columns() -> Vec<Column> {
    let column = |name, holds, kept| Column { name, unit: "", description: "", holds, kept };
    let words = ["bud", "stem", "leaf"].map(str::to_owned).to_vec();
    vec![
        column("plant_id", Holds::Whole, false),
        column("kind", Holds::Words(words), true),
        column("diameter_m", Holds::Real, true),
    ]
}

/// The diameter of a component at an age: none of the bud, nothing of a leaf, and a stem thickens.
fn diameter(kind: usize, component: u32, age: u32) -> f64 {
    match kind {
        0 => f64::NAN,
        1 => 0.002 * f64::from(age - component + 1) + 0.0001,
        _ => 0.0,
    }
}

/// The kinds of the components, and the ages at which they have rows.
const ROWS: [(usize, u32, u32); 4] = [(0, 0, 9), (1, 1, 9), (1, 2, 9), (2, 2, 5)];

fn table() -> Table {
    let mut table = Table::new(&columns());
    for age in 0..=TALL {
        table.begin(age as f32);
        for (component, (kind, from, until)) in (0..).zip(ROWS) {
            if (from..until).contains(&age) {
                table.row(component, [kind as f64, diameter(kind, component, age)]);
            }
        }
    }
    table
}

fn page() -> Page {
    let plant = plant();
    let mut maker = Maker::new(Nearness::of(1e-3), &MeshOptions::default());
    (0..=TALL).for_each(|age| maker.show(&plant, age));
    let subject = Subject {
        number: 3,
        species: 0,
        name: "plant 3".to_owned(),
        place: [1.0, 2.0, 0.0],
        sown: 0.0,
        constants: vec![("plant_id", json!(3))],
        reach: 0.6,
        life: maker.finish(),
        table: table(),
        options: MeshOptions::default(),
    };
    Page {
        title: "A <trunk> & its leaf".to_owned(),
        note: String::new(),
        run: "small".to_owned(),
        seed: u64::MAX,
        tolerance: 1e-3,
        detail: 0,
        of_plot: false,
        ages: (0..=TALL).map(|age| (age as f32, format!("age {age}"))).collect(),
        events: vec![(2.0, "grew", 1)],
        columns: columns(),
        subjects: vec![subject],
        obstacles: Vec::new(),
    }
}

fn written() -> Vec<u8> {
    let mut file = Vec::new();
    page().write(&mut file).expect("memory does not fail");
    file
}

/// The header and the streams of a page.
fn read(file: &[u8]) -> (Value, BTreeMap<String, Vec<i64>>) {
    let text = std::str::from_utf8(file).expect("UTF-8");
    let (_, data) = text.split_once("id=\"data\">").expect("data");
    let (data, _) = data.split_once("</script>").expect("an end");
    let letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let codes: Vec<u32> = data.chars().filter_map(|letter| letters.find(letter)).map(|code| code as u32).collect();
    let bytes: Vec<u8> = codes
        .chunks(4)
        .flat_map(|four| {
            let word = four.iter().fold(0, |word, code| word << 6 | code) << (6 * (4 - four.len()));
            word.to_be_bytes()[1..four.len()].to_vec()
        })
        .collect();
    let plain = decompress_to_vec(&bytes[10..bytes.len() - 8]).expect("deflate");
    let sum = u32::from_le_bytes(bytes[bytes.len() - 8..bytes.len() - 4].try_into().expect("four bytes"));
    assert_eq!(sum, crc32fast::hash(&plain));
    let length = u32::from_le_bytes(plain[..4].try_into().expect("four bytes")) as usize;
    let header: Value = serde_json::from_slice(&plain[4..4 + length]).expect("JSON");
    let (mut streams, mut at) = (BTreeMap::new(), 4 + length);
    for entry in header["streams"].as_array().expect("a list") {
        let (name, size) = (entry[0].as_str().expect("a name"), entry[1].as_u64().expect("a length") as usize);
        streams.insert(name.to_owned(), numbers(&plain[at..at + size]));
        at += size;
    }
    assert_eq!(at, plain.len());
    (header, streams)
}

fn numbers(bytes: &[u8]) -> Vec<i64> {
    let (mut found, mut value, mut shift) = (Vec::new(), 0_u64, 0);
    for byte in bytes {
        value |= u64::from(byte & 127) << shift;
        shift += 7;
        if *byte < 128 {
            found.push((value >> 1) as i64 ^ -((value & 1) as i64));
            (value, shift) = (0, 0);
        }
    }
    found
}

#[test]
fn the_same_page_has_the_same_bytes() {
    assert!(written() == written());
}

#[test]
fn a_page_says_what_it_holds() {
    let (header, streams) = read(&written());
    assert_eq!(header["title"], "A <trunk> & its leaf");
    assert_eq!(header["seed"], u64::MAX.to_string());
    assert_eq!(header["ages"].as_array().map(Vec::len), Some(7));
    let plant = &header["plants"][0];
    assert_eq!((&plant["lines"], &plant["points"], &plant["parts"]), (&json!(1), &json!(2), &json!(1)));
    assert_eq!(plant["components"], 4);
    assert_eq!(header["forms"].as_array().map(Vec::len), Some(1));
    assert_eq!(streams["0.part.from"], [2], "the leaf appears at the third age");
    assert_eq!(streams["0.part.lasts"], [3]);
    assert_eq!(streams["0.part.host"], [1], "it is borne by the first point of the trunk");
}

/// Rows begin and end where the table says, words are exact, and what is between two keys is near on the scale.
#[test]
fn rows_come_back_at_each_age() {
    let (header, streams) = read(&written());
    let mut from = streams["0.row.from"].clone();
    (1..from.len()).for_each(|i| from[i] += from[i - 1]);
    assert_eq!(from, ROWS.map(|(_, from, _)| i64::from(from)));
    assert_eq!(streams["0.row.lasts"], [0, 0, 0, 3]);
    let mut kinds = streams["0.row.0.values"].clone();
    (1..kinds.len()).for_each(|i| kinds[i] += kinds[i - 1]);
    assert_eq!(kinds, ROWS.map(|(kind, ..)| kind as i64));
    let [octave, least] = ["octave", "least"].map(|name| header[name].as_f64().expect("a number"));
    let (mut ages, mut values) = (streams["0.row.1.ages"].iter(), streams["0.row.1.values"].iter());
    let mut firsts = BTreeMap::new();
    for (component, (kind, from, until)) in (0..).zip(ROWS) {
        let (mut keys, mut age) = (Vec::new(), i64::from(from));
        let mut value = firsts.get(&kind).copied().unwrap_or(0);
        for key in 0..streams["0.row.1.counts"][component as usize] {
            age += if key > 0 { *ages.next().expect("an age") } else { 0 };
            value += values.next().expect("a value");
            keys.push((age as f64, value as f64));
            firsts.entry(kind).and_modify(|first| *first = if key == 0 { value } else { *first }).or_insert(value);
        }
        for now in from..until.min(TALL + 1) {
            let meant = diameter(kind, component, now);
            let after = keys.iter().position(|(age, _)| *age > f64::from(now)).unwrap_or(keys.len());
            let (at, mut place) = keys[after - 1];
            if let Some((to, next)) = keys.get(after).filter(|(_, next)| place > 0.0 && *next > 0.0) {
                place += (f64::from(now) - at) / (to - at) * (next - place);
            }
            match meant {
                meant if meant.is_nan() => assert_eq!(place, -1.0),
                0.0 => assert_eq!(place, 0.0),
                meant => {
                    let found = least * phytomer_sim::math::exp2((place - 1.0) / octave);
                    assert!((found / meant - 1.0).abs() < 0.03, "{component} at {now}: {found} {meant}");
                }
            }
        }
    }
    assert!(ages.next().is_none() && values.next().is_none());
}
