//! Bad files with what is said of each, and files broken at random: no panic, no hang, no memory without bound.

use super::Mtg;
use super::tests::{measured, read, read_bytes, small};
use crate::exchange::contract::{Format, InMemory};
use crate::exchange::losses::Losses;
use crate::exchange::report::MOST_TOLD;

/// Rows after a sound head, and the faults that are told, with their places. The head has 22 lines.
const BAD: [(&str, &[&str]); 15] = [
    ("/P1\n^/Q7\n", &["24:3: no class `Q` is declared; expected one of the classes P, A, I"]),
    ("P1\n", &["23:1: `P1` is no code of an entity; expected a sign before each label"]),
    ("/P1/+A1\n", &["23:4: `/+A1` is no code of an entity; expected a label after the sign"]),
    (
        "^/P1\n",
        &["23:1: `^` goes on from an entity, and none stands above in this column; expected an entity above it"],
    ),
    ("\t/P1\n", &["23:2: no entity stands in a column on the left; expected codes of plants in the first column"]),
    ("+P1\n", &["23:2: `P1` begins a plant; expected `/` before what begins a plant, such as `/P1`"]),
    ("/P1/A1\n(nobody)+A2\n", &["24:1: no entity has this alias; expected an alias that an entity above has"]),
    ("/P1/A1\n(nobody+A2\n", &["24:1: an alias is not closed; expected a closing parenthesis after the alias"]),
    ("/P1/A1x2\n", &["23:5: the label `A1x2` has no number as its index; expected a symbol and an index"]),
    ("/P1/A1<<I3\n", &["23:9: the range to `I3` has no beginning of the same class with an index"]),
    ("/P1/A3<<A1\n", &["23:9: the range to `A1` goes down from 3; expected a range that rises"]),
    (
        "/P1/A1<<A999999999\n",
        &["23:9: with the range to `A999999999` the ranges of the file stand for 999999998 entities"],
    ),
    ("/P1/A1\t+A2\n", &["23:8: a second code, `+A2`, stands in the line; expected one code a line"]),
    ("*\t\t\t\t1\n", &["23:1: `*` observes an entity again, and none stands above it in its column"]),
    (
        "/P1/Q1\n\t+A1\n/P2/A\u{7f}1\n^/\n",
        &["23:5: no class `Q`", "25:5: no class `A\u{7f}`", "26:2: `/` is no code of an entity"],
    ),
];

#[test]
fn bad_rows_are_told_with_their_places_all_at_once() {
    for (rows, expected) in BAD {
        let (_, report) = small(rows);
        let told: Vec<String> = report.faults().iter().map(ToString::to_string).collect();
        assert_eq!(told.len(), expected.len(), "{rows:?}: {told:?}");
        for (told, expected) in told.iter().zip(expected) {
            let expected = format!("plant.mtg:{expected}").replace('\u{7f}', "");
            assert!(told.starts_with(&expected), "{rows:?}: {told}\n{expected}");
        }
    }
}

#[test]
fn bad_heads_are_told_with_their_places() {
    let classes = "CLASSES:\nP\t1\n";
    let rows = "MTG:\nENTITY-CODE\n/P1\n";
    let bad = [
        (String::new(), "plant.mtg: there is no section `CLASSES:`"),
        (classes.to_owned(), "plant.mtg: there is no section `MTG:`"),
        (format!("{classes}MTG:\n\n"), "plant.mtg: nothing stands after `MTG:`"),
        (format!("{classes}MTG:\nENTITY-CODE\n"), "plant.mtg: the file has no entity"),
        (format!("{classes}MTG:\nENTITIES\n/P1\n"), "plant.mtg:4:1: the entities begin with `ENTITIES`"),
        (format!("CODE:\tFORM-B\n{classes}{rows}"), "plant.mtg:1:7: the code is of the form `FORM-B`; expected FORM-A"),
        (format!("CLASSES:\nP\tone\n{rows}"), "plant.mtg:2:3: the class `P` has the scale `one`"),
        (format!("CLASSES:\nP\t1\nP\t2\n{rows}"), "plant.mtg:3:1: the class `P` has the scale 2, and 1 before"),
        (
            format!("CLASSES:\nP\t1\nA2\t2\n{rows}"),
            "plant.mtg:3:1: a class is called `A2`; expected a symbol of letters",
        ),
    ];
    for (text, expected) in bad {
        let (_, report) = read(&text);
        let told: Vec<String> = report.faults().iter().map(ToString::to_string).collect();
        assert!(told.iter().any(|told| told.starts_with(expected)), "{text:?}: {told:?}");
    }
}

#[test]
fn unusual_files_are_read_with_a_warning_each() {
    let rows = "/P1/A1\t\t\ta\ttall\t31/02/2003\tx\tbeyond\n\t\t\t\t1\n";
    let (plant, report) = small(rows);
    assert!(report.faults().is_empty());
    let told: Vec<String> = report.warnings().iter().map(ToString::to_string).collect();
    for words in [
        "`tall` is not of the type of the feature `Length`",
        "`31/02/2003` is not",
        "values beyond",
        "values without an entity",
    ] {
        assert!(told.iter().any(|told| told.contains(words)), "{words}: {told:?}");
    }
    let seen = plant.individuals[0].entities[1].latest().unwrap();
    assert_eq!((seen.length, seen.date), (None, None), "what cannot be a length is none");
}

#[test]
fn many_faults_are_counted() {
    let (_, report) = small(&"/Q1\n".repeat(MOST_TOLD + 500));
    assert_eq!((report.faults().len(), report.more_faults()), (MOST_TOLD, 499));
}

/// A small generator (Marsaglia's xorshift): the same files in each run.
struct Words(u64);

impl Words {
    fn next(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below.max(1) as u64) as usize
    }
}

/// A sound file with pieces cut, doubled and overwritten by what means something in the format.
fn broken(sound: &[u8], words: &mut Words) -> Vec<u8> {
    const PIECES: [&[u8]; 16] = [
        b"<<",
        b"++",
        b"<.<",
        b"+.+",
        b"^",
        b"/P1",
        b"A999999",
        b"\t",
        b"\n",
        b"(a)",
        b"*",
        b"#",
        b"MTG:",
        b"1e309",
        b"\xff\xfe",
        b"CLASSES:",
    ];
    let mut bytes = sound.to_vec();
    for _ in 0..=words.next(6) {
        let at = words.next(bytes.len() + 1).min(bytes.len());
        match words.next(4) {
            0 => bytes.truncate(bytes.len() - words.next(bytes.len() / 4 + 1)),
            1 => _ = bytes.splice(at..at, PIECES[words.next(PIECES.len())].iter().copied()),
            2 => {
                let end = (at + words.next(40)).min(bytes.len());
                bytes.drain(at..end);
            }
            _ => {
                let end = (at + words.next(200)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                let to = words.next(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
        }
    }
    bytes
}

/// A range in a few letters stands for branches that bear one another, and each would have a column in every line.
#[test]
fn a_chain_of_branches_as_deep_as_it_is_long_is_not_written() {
    for (code, is_written) in [("/P1/A1++A3000", true), ("/P1/A1++A99000", false)] {
        let (plants, report) = small(&format!("{code}\n"));
        assert!(report.faults().is_empty(), "{code}: {:?}", report.faults());
        let written = Mtg.write(&plants, &mut InMemory::default(), &mut Losses::default());
        assert_eq!(written.is_ok(), is_written, "{code}");
        if let Err(error) = written {
            assert!(error.to_string().contains("deep in one another") && error.to_string().contains("OPF"), "{error}");
        }
    }
}

/// Reads broken files and writes again what could be read. `PHYTOMER_MUTATIONS` asks for more of them.
#[test]
fn broken_files_are_refused_or_read_and_written() {
    let count = std::env::var("PHYTOMER_MUTATIONS").ok().and_then(|count| count.parse().ok()).unwrap_or(3000);
    let mut words = Words(0x9e37_79b9_7f4a_7c15);
    let head = super::tests::HEAD;
    let small = format!("{head}/P1\n^/A1/I1<<I9\t\t\ta\t2.5\t01/02/03\tx\n\t+A2/I1<I2\n*\t\t\t\t3\n(a)+A3++A5\n");
    let mut sound = vec![small.into_bytes()];
    if let Some(folder) = measured() {
        let text = std::fs::read(folder.join("agraf.mtg")).unwrap();
        sound.push(text[..8000].to_vec());
    }
    let mut taken = 0;
    for number in 0..count {
        let bytes = broken(&sound[number % sound.len()], &mut words);
        let (plants, report) = read_bytes(&bytes, None);
        if report.is_refused() {
            continue;
        }
        taken += 1;
        let (mut out, mut losses) = (InMemory::default(), Losses::default());
        if let Err(error) = Mtg.write(&plants, &mut out, &mut losses) {
            assert!(error.to_string().contains("deep in one another"), "{number}: {error}");
            continue;
        }
        let (again, report) = read_bytes(&out.main, None);
        assert!(report.faults().is_empty(), "{number}: {:?}", report.faults());
        assert_eq!(again.entities(), plants.entities(), "{number}");
    }
    assert!(taken > count / 20, "{taken} of {count} could still be read");
}

#[test]
fn deep_branching_takes_no_stack() {
    let mut rows = String::from("/P1/A1");
    (2..20_000).for_each(|number| rows += &format!("+A{number}"));
    let (plant, report) = small(&(rows + "\n"));
    assert!(report.faults().is_empty());
    assert_eq!(plant.entities(), 20_000);
    assert!(plant.individuals[0].bearer_of(19_999).is_some());
}
