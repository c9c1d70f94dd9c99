//! Tables of branches: what is read, and every fault of a bad one with line and column.
//!
//! Absent: the fit (`gmt`).

use phytomer_fits::data::Table;
use phytomer_fits::gmt::skeleton::{MOST_BRANCHES, SAMPLE, read};
use phytomer_fits::gmt::{Piece, Skeleton, TreeModel, Wish, fit};

fn pieces(text: &str) -> Result<Vec<Piece>, Vec<String>> {
    let told = |faults: Vec<phytomer_fits::data::Fault>| faults.iter().map(ToString::to_string).collect::<Vec<_>>();
    let table = Table::from_csv("b.csv", text.as_bytes()).map_err(told)?;
    read(&table, Some(text.as_bytes()), [0.0; 3]).map_err(told)
}

/// The faults of rows below the header.
fn faults(rows: &str) -> Vec<String> {
    pieces(&format!("id,parent,x,y,z,diameter\n{rows}")).expect_err("a fault")
}

fn assert_told(rows: &str, expected: &[&str]) {
    let found = faults(rows);
    assert_eq!(found.len(), expected.len(), "{rows}: {found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.starts_with(expected), "{rows}: {found} does not begin with {expected}");
        assert!(found.contains("; expected "), "{found}");
    }
}

#[test]
fn every_fault_has_its_line_and_column() {
    let cases: [(&str, &[&str]); 14] = [
        ("1,,0,0,1,.1\n2,3,0,0,2,.1", &["b.csv:3:3: no branch has the id `3`"]),
        ("1,,0,0,1,.1\n2,,0,0,2,.1", &["b.csv:3:3: a second branch has no parent; the first is on line 2"]),
        ("1,,0,0,1,.1\n1,1,0,0,2,.1", &["b.csv:3:1: the id `1` stands twice, first on line 2"]),
        (",,0,0,1,.1", &["b.csv:2:1: a branch has no id"]),
        ("1,2,0,0,1,.1\n2,1,0,0,2,.1", &["b.csv:2:3: the parents of the branch `1` lead back to it"]),
        ("1,,0,0,1,.1\n2,2,0,0,2,.1", &["b.csv:3:3: the parents of the branch `2` lead back to it"]),
        ("1,,0,NaN,1,.1", &["b.csv:2:6: the y of a tip is `NaN`"]),
        ("1,,0,0,inf,.1", &["b.csv:2:8: the z of a tip is `inf`"]),
        ("1, ,0,0, tall ,.1", &["b.csv:2:10: the z of a tip is `tall`"]),
        ("1,,0,0,1,-2", &["b.csv:2:10: the diameter is `-2`"]),
        ("1,,0,0,0,.1", &["b.csv:2:4: the branch ends where it begins"]),
        ("1,,0,0,1,.1\n2,1,0,0,1,.1", &["b.csv:3:5: the branch ends where it begins"]),
        ("1,,0,0,1\n2,1,0,0,2,.1,9", &["b.csv:2:8: 5 cells under 6 names", "b.csv:3:14: 7 cells under 6 names"]),
        ("1,,0,0,1,.1\n2,9,x,0,2,.1", &["b.csv:3:3: no branch has the id `9`", "b.csv:3:5: the x of a tip is `x`"]),
    ];
    for (rows, expected) in cases {
        assert_told(rows, expected);
    }
    let missing = pieces("id,parent,x,y,zz,diameter\n1,,0,0,1,.1").expect_err("a fault");
    assert!(missing[0].starts_with("b.csv: there is no column `z`"), "{missing:?}");
    assert!(pieces("").is_err() && pieces("id,parent,x,y,z,diameter\n").is_err());
    let long: String = (0..=MOST_BRANCHES).map(|k| format!("{k},,0,0,1,\n")).collect();
    let told = faults(&long);
    assert!(told.len() == 1 && told[0].contains("expected at most 200000"), "{told:?}");
}

#[test]
fn plants_are_told_apart_and_pieces_are_joined() {
    let text = "plant,id,parent,x,y,z,diameter\n\
        a,1,,0,0,1,.2\na,2,1,0,0,2,.2\na,3,2,1,0,3,\na,4,2,-1,0,3,.1\nb,1,,0,0,2,.3\nb,2,1,1,0,3,.2\nb,3,1,-1,0,3,.2";
    let skeleton = Skeleton::of(&pieces(text).expect("branches"));
    // Of the plant a the first two pieces are one branch.
    let levels: Vec<u32> = skeleton.branches.iter().map(|branch| branch.level).collect();
    assert_eq!(levels, [0, 0, 1, 1, 1, 1]);
    assert!(skeleton.branches[..2].iter().all(|branch| branch.vector == [0.0, 0.0, 2.0] && branch.children.len() == 2));
    assert_eq!(skeleton.branches[2].diameter, None);
    let found = fit(&skeleton, &Wish::default()).expect("a fit");
    for (name, expected) in [("h1_deg", 45.0), ("h2_deg", -45.0), ("r1", 0.5_f64.sqrt())] {
        let value = found.value(name).expect("a value");
        assert!((value - expected).abs() < 1e-12, "{name}: {value}");
    }
    // Ratios of .1 to .2, and of .2 to .3 twice; one is not measured.
    let ratio = found.value("diameter_ratio").expect("a ratio");
    assert!((ratio - (0.5 + 2.0 * 2.0 / 3.0) / 3.0).abs() < 1e-12);
}

#[test]
fn one_branch_is_no_tree() {
    let alone = Skeleton::of(&pieces("id,parent,x,y,z,diameter\n1,,0,0,1,.1\n2,1,0,0,2,.1").expect("branches"));
    let told = fit(&alone, &Wish::default()).expect_err("no branching").to_string();
    assert!(told.starts_with("0 branchings, and at least 1 are needed"), "{told}");
    let binary = Skeleton::of(&pieces(SAMPLE).expect("the sample"));
    let told = fit(&binary, &Wish { model: Some(TreeModel::Gmt3), ..Wish::default() }).expect_err("no ternary tree");
    assert!(told.to_string().starts_with("0 branchings"), "{told}");
}

/// A trunk that bears a branch at each of thirty nodes has more growth levels than a geometric tree.
#[test]
fn more_levels_than_a_tree_has_are_refused() {
    let mut rows = "id,parent,x,y,z,diameter\n0,,0,0,1,\n".to_owned();
    for k in 1..=30 {
        rows += &format!("{k},{},0,0,{},\nb{k},{},1,0,{},\n", k - 1, k + 1, k - 1, k + 1);
    }
    let told = fit(&Skeleton::of(&pieces(&rows).expect("branches")), &Wish::default()).expect_err("too many levels");
    assert!(told.to_string().starts_with("the last growth level is 30, and 28 or less"), "{told}");
    // A branch that comes back to where it began has no direction; its branching is left out.
    let back = "id,parent,x,y,z,diameter\n1,,0,0,1,\n2,1,0,0,2,\n3,1,1,0,2,\n4,2,0,0,1,\n5,4,1,0,3,\n6,4,-1,0,3,";
    let told = fit(&Skeleton::of(&pieces(back).expect("branches")), &Wish::default()).expect_err("no direction");
    assert!(told.to_string().starts_with("2 branchings of 2 growth levels: no such tree can be told"), "{told}");
}

/// The sample is of known numbers: the intervals of 99.99 % hold them.
#[test]
fn the_sample_has_the_numbers_that_it_was_drawn_with() {
    let skeleton = Skeleton::of(&pieces(SAMPLE).expect("the sample"));
    let found =
        fit(&skeleton, &Wish { confidence: 0.9999, model: Some(TreeModel::Gmt1), course: None }).expect("a fit");
    for (name, truth) in [("h1_deg", 27.0), ("h2_deg", -37.0), ("r1", 0.786), ("r2", 0.786), ("diameter_ratio", 0.7)] {
        let own = found.taken().estimate(name).unwrap_or_else(|| panic!("no {name}"));
        let [low, high] = [own.low, own.high].map(|limit| limit.expect("a limit"));
        assert!(low < truth && truth < high, "{name}: {low} to {high}");
    }
    assert_eq!((found.levels, found.by_level.len(), found.first[0].map(|mean| mean.n)), (3, 4, Some(2)));
}
