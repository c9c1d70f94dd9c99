//! Files of each program: what is written of them, and what is told of each key.
//!
//! The files of `data` were written for these tests. Absent: whether the parametric model takes what is written
//! (`tests/convert.rs` of the program).

use phytomer_peers::{Asked, Converted, Failed, Fate, Format, Told, convert};

const ARBARO: &[u8] = include_bytes!("data/hill_larch.xml");
const TREE_GEN: &[u8] = include_bytes!("data/pond_alder.py");
const SAPLING: &[u8] = include_bytes!("data/field_maple.py");
const HELIOS: &[u8] = include_bytes!("data/orchard.xml");
const JSON: &[u8] = include_bytes!("data/thorn.json");

fn converted(name: &str, bytes: &[u8]) -> Converted {
    convert(name, bytes, Asked::default()).unwrap_or_else(|failed| panic!("{failed}"))
}

/// Each line of the species, but for comments.
fn states(converted: &Converted, lines: &[&str]) {
    let written: Vec<&str> = converted.species.lines().map(|line| line.split("  # ").next().unwrap_or(line)).collect();
    for line in lines {
        assert!(written.contains(line), "`{line}` is not in\n{}", converted.species);
    }
}

fn told<'a>(converted: &'a Converted, key: &str) -> &'a Told {
    converted.told.iter().find(|told| told.key == key).unwrap_or_else(|| panic!("{key}"))
}

fn note<'a>(converted: &'a Converted, key: &str) -> &'a str {
    told(converted, key).note.as_deref().unwrap_or("")
}

#[test]
fn arbaro_has_the_papers_names() {
    let larch = converted("trees/hill_larch.xml", ARBARO);
    assert_eq!((larch.format, larch.label.as_deref()), (Format::Arbaro, Some("hill larch")));
    states(
        &larch,
        &["name = \"hill larch\"", "Scale = 9.5", "1DownAngleV = -40", "children = \"above_base\"", "3DownAngle = 45"],
    );
    // What Arbaro would take where the file says nothing.
    states(&larch, &["2Taper = 1", "2Rotate = 120", "0SegSplits = 0"]);
    assert!(!larch.species.contains("3Length") && !larch.species.contains("PruneWidthPeak"));
    let scale = told(&larch, "Scale");
    assert_eq!((scale.fate, scale.line, scale.column, scale.written.as_str()), (Fate::Taken, 8, 18, "Scale = 9.5"));
    assert_eq!(told(&larch, "Shape").fate, Fate::Mapped);
    assert!(note(&larch, "LeafDistrib").contains("no effect") && !note(&larch, "1BranchDist").contains("no effect"));
    assert_eq!(note(&larch, "Colour"), "this program has no such key");
    assert_eq!(larch.told.len(), 48, "every key of the file");
}

#[test]
fn tree_gen_has_names_of_its_own() {
    let alder = converted("pond_alder.py", TREE_GEN);
    assert_eq!((alder.format, alder.label.as_deref()), (Format::TreeGen, None));
    states(
        &alder,
        &["name = \"pond_alder\"", "Scale = 7", "BaseSize = 0.2", "Flare = 0.4", "Leaves = 12", "LeafShape = 0"],
    );
    states(&alder, &["1SplitAngle = 12", "0BaseSplits = 2", "0Scale = 1.1", "AttractionUp = 0.6", "3Rotate = 137"]);
    assert!(!alder.species.contains("0DownAngle") && !alder.species.contains("3Branches"), "{}", alder.species);
    assert_eq!(told(&alder, "down_angle").written, "1DownAngle = 55, 2DownAngle = 45, 3DownAngle = 40");
    assert!(note(&alder, "split_angle").contains("one plane") && note(&alder, "tropism").contains("upward part"));
    assert_eq!(told(&alder, "bend_v").fate, Fate::Without);
    assert_eq!((told(&alder, "shape").line, told(&alder, "shape").column), (5, 5));
}

#[test]
fn sapling_of_the_third_generation_adds_its_back_curve() {
    let maple = converted("field_maple.py", SAPLING);
    assert_eq!(maple.format, Format::Sapling);
    // Half of −30 over the first half; half of −30 and 40 over the second. Single precision leaves no trace.
    states(
        &maple,
        &["1Curve = -15", "1CurveBack = 25", "2Curve = -20", "2CurveBack = 0", "2Length = 0.4", "ScaleV = 0.8"],
    );
    states(&maple, &["PruneRatio = 0.75", "Flare = 0.25", "AttractionUp = 0.5", "3DownAngle = 65", "3RotateV = 3"]);
    assert!(note(&maple, "leafDist").contains("shape 4") && note(&maple, "closeTip").contains("no effect"));
    let first = String::from_utf8_lossy(SAPLING).replace("'splitHeight'", "'bevelRes'");
    let first = first.replace("'useOldDownAngle': False, ", "").replace("'attractOut'", "'resU'");
    let first = first.replace("'leafDownAngle': 65.0,", "").replace("'prune': True", "'prune': False");
    states(
        &converted("maple.py", first.as_bytes()),
        &["1Curve = -30", "1CurveBack = 40", "PruneRatio = 0", "3DownAngle = 30"],
    );
}

#[test]
fn a_tree_of_the_library_of_helios_is_chosen_by_its_label() {
    let asked = |tree| convert("orchard.xml", HELIOS, Asked { from: None, tree });
    let Err(Failed::Choice { labels, .. }) = asked(None) else { panic!("two trees") };
    assert_eq!(labels, ["Quince", "Medlar"]);
    assert!(matches!(asked(Some("Pear")), Err(Failed::Choice { .. })));
    let quince = asked(Some("quince")).unwrap();
    states(
        &quince,
        &["0Scale = 1.2", "1SplitAngle = 10", "1CurveV = 10", "1DownAngleV = 10", "2Rotate = 220", "3DownAngle = 135"],
    );
    assert!(!quince.species.contains("ZScale"));
    assert!(note(&quince, "nSplitAngle").contains("next level") && note(&quince, "nRotate").contains("other way"));
    let medlar = asked(Some("Medlar")).unwrap();
    states(&medlar, &["0BaseSplits = 2", "0SplitAngle = 40", "0Scale = 1", "2DownAngle = 45"]);
}

#[test]
fn json_has_the_papers_names_or_those_of_a_program() {
    let thorn = converted("thorn.json", JSON);
    assert_eq!((thorn.format, thorn.label.as_deref()), (Format::Json, Some("thorn")));
    states(&thorn, &["Shape = 2", "children = \"above_base\"", "1Length = 0.5", "1CurveV = 80", "LeafShape = 1"]);
    let alder = br#"{"shape": 4, "g_scale": 7, "levels": 2, "branches": [0, 22, 9, 0]}"#;
    assert_eq!(converted("alder.json", alder).format, Format::TreeGen);
    let said = convert("alder.txt", alder, Asked { from: Some(Format::Json), tree: None }).unwrap();
    assert_eq!(said.species.lines().nth(4), converted("alder.json", alder).species.lines().nth(4));
}

#[test]
fn what_does_not_tell_is_asked_for() {
    assert!(matches!(convert("a.txt", SAPLING, Asked::default()), Err(Failed::Ending(_))));
    let from = |from| convert("a.txt", SAPLING, Asked { from: Some(from), tree: None });
    assert_eq!(from(Format::Sapling).unwrap().format, Format::Sapling);
    let told = from(Format::TreeGen).unwrap_err().to_string();
    assert!(told.contains("this is a file of Sapling and not of tree-gen"), "{told}");
    let told = convert("a.py", b"{'a': 1}", Asked::default()).unwrap_err().to_string();
    assert!(told.starts_with("a.py:1:2: the keys are neither"), "{told}");
}

/// Each fault with its line and column.
#[test]
fn bad_files_are_told_with_their_place() {
    let cut = |bytes: &[u8], end: usize| bytes[..end].to_vec();
    let endless = [b"{'a': [".to_vec(), b"1,".repeat(50_000_000)].concat();
    let bomb =
        b"<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ENTITY a \"aa\"><!ENTITY b \"&a;&a;\">]>\n<arbaro>&b;</arbaro>";
    let bad = [
        ("a.py", cut(TREE_GEN, 300), ":14:5: ", "this text has no end"),
        ("a.py", cut(SAPLING, 88), ":1:89: ", "the file ends"),
        ("a.py", endless, ":1:1048577: ", "the file goes on beyond 1048576 bytes"),
        ("a.xml", cut(ARBARO, 400), ":12:31: ", "this is no XML"),
        ("a.xml", bomb.to_vec(), ":2:1: ", "the file declares a document type"),
        ("a.json", cut(JSON, 60), ":5:", "this is no JSON"),
        ("a.py", b"{'scaleV': 'tall', 'baseSize': 0.2}".to_vec(), ":1:12: ", "`'tall'` is no number"),
        ("a.py", b"{'baseSize': [0.2], 'levels': None}".to_vec(), ":1:31: ", "nothing stands here"),
        ("a.py", b"{'baseSize': {}, 'levels': 2}".to_vec(), ":1:14: ", "a dictionary stands here"),
        ("a.py", b"{'baseSize': 1, 'levels': 9}".to_vec(), ":1:27: ", "`levels` is 9"),
        ("a.py", b"{'baseSize': \xff}".to_vec(), ":1:14: ", "this byte belongs to no character"),
        ("a.xml", b"<arbaro></arbaro>".to_vec(), ":1:18: ", "the file has no tree"),
    ];
    let tell = |(name, bytes, place, problem): (&str, Vec<u8>, &str, &str)| {
        let told = convert(name, &bytes, Asked::default()).expect_err(problem).to_string();
        (!told.starts_with(&format!("{name}{place}")) || !told.contains(problem)).then(|| format!("{place}: {told}"))
    };
    let other: Vec<String> = bad.into_iter().filter_map(tell).collect();
    assert!(other.is_empty(), "{other:#?}");
}
