//! Thirty-odd tables that are wrong, or tell too little: each is refused with file and line, or the result says what
//! could not be estimated. No number of what is stated is ever NaN.
//!
//! Absent: species that do not take a law, which the program's own tests have.

use phytomer_fits::data::columns::LAWS;
use phytomer_fits::data::{Law, Table, read};
use phytomer_fits::outcome::fit;
use phytomer_fits::wanted::Wanted;

/// What is told of a table: its faults, or the problem, or the law that is taken with what is stated.
fn told(law: Law, bytes: &[u8]) -> String {
    let table = match Table::from_csv("t.csv", bytes) {
        Ok(table) => table,
        Err(faults) => return faults.iter().map(|fault| format!("{fault}\n")).collect(),
    };
    let data = match read(law, &table) {
        Ok(data) => data,
        Err(faults) => return faults.iter().map(|fault| format!("{fault}\n")).collect(),
    };
    match fit(law, &data, &Wanted::default()) {
        Err(problem) => problem.to_string(),
        Ok(outcome) => {
            let stated: String = outcome.stated.iter().map(|key| format!("{} = {}\n", key.key, key.value)).collect();
            assert!(!stated.contains("NaN") && !stated.contains("inf,"), "{stated}");
            format!("{}\n{stated}{}", outcome.taken().law, outcome.taken().notes.join("\n"))
        }
    }
}

const FIXTURES: [(&str, Law, &str, &str); 36] = [
    ("no bytes", Law::Nodes, "", "t.csv:1: there is no header"),
    ("a header alone", Law::Nodes, "nodes,count\n", "t.csv: there are no rows below the header"),
    (
        "a missing column",
        Law::Nodes,
        "length\n3\n",
        "t.csv: there is no column `nodes`; expected it among the columns length",
    ),
    ("a misspelt column", Law::Nodes, "nods\n3\n", "the nearest is `nods`"),
    ("two columns of a name", Law::Nodes, "nodes,nodes\n3,4\n", "t.csv:1: two columns are named `nodes`"),
    ("a ragged line", Law::Nodes, "nodes,count\n3,4\n5\n", "t.csv:3:1: 1 cells under 2 names"),
    ("a long line", Law::Nodes, "nodes,count\n3,4,5\n", "t.csv:2:5: 3 cells under 2 names"),
    ("a negative count", Law::Nodes, "nodes\n3\n-1\n", "t.csv:3: `nodes` is -1, which is below 0"),
    ("a fractional count", Law::Nodes, "nodes\n3\n4.5\n", "t.csv:3: `nodes` is 4.5, which is not whole"),
    ("NaN", Law::Nodes, "nodes\n3\nNaN\n", "t.csv:3: `nodes` is not a number (NaN)"),
    ("infinity", Law::Nodes, "nodes\n3\ninf\n", "t.csv:3: `nodes` is inf, which is above 1000000"),
    ("a word for a count", Law::Nodes, "nodes\nmany\n", "t.csv:2: `nodes` is `many`, which is no number"),
    ("an empty cell", Law::Nodes, "nodes,count\n3,\n", "t.csv:2: `count` is empty"),
    ("too many nodes", Law::Nodes, "nodes\n70000\n3\n", "t.csv:2: a growth unit has 70000 nodes"),
    ("one growth unit", Law::Nodes, "nodes\n7\n", "1 growth units, and at least 2 are needed"),
    ("equal numbers of nodes", Law::Nodes, "nodes\n7\n7\n7\n", "every growth unit has 7 nodes (V = 0)"),
    ("counts of 0 alone", Law::Nodes, "nodes,count\n7,0\n", "0 growth units"),
    ("one axis", Law::Activity, "nodes\n5\n", "1 axes, and at least 3 are needed"),
    ("V = 0", Law::Activity, "nodes\n5\n5\n5\n5\n", "every axis made 5 nodes (V = 0)"),
    ("V > X", Law::Activity, "nodes\n0\n9\n0\n9\n", "is above their mean"),
    ("no nodes", Law::Activity, "nodes\n0\n0\n0\n", "no axis made a node"),
    ("two windows", Law::Activity, "nodes,days\n5,30\n6,31\n5,30\n", "t.csv:3: the window has 31 days"),
    ("a window of no days", Law::Activity, "nodes,days\n5,0\n", "t.csv:2: `days` is `0`"),
    ("falling numbers", Law::Activity, "axis,day,nodes\na,0,3\na,5,2\n", "t.csv:3: axis `a` has fewer nodes"),
    ("a day twice", Law::Activity, "axis,day,nodes\na,0,3\na,0,3\n", "t.csv:3: axis `a` has day 0 twice"),
    ("few waits", Law::Activity, "axis,day,nodes\na,0,1\na,9,2\na,19,3\n", "waits that ended, and at least 10"),
    ("all censored", Law::Mortality, "age,died\n9,0\n12,0\n", "none of 2 axes died (all are censored)"),
    ("a death that is 2", Law::Mortality, "age,died\n9,2\n", "t.csv:2: `died` is 2 at age 9"),
    ("more dead than axes", Law::Mortality, "age,axes,dead\n9,10,11\n", "t.csv:2: 11 of 10 axes are dead at age 9"),
    ("no axes of an age", Law::Mortality, "age,axes,dead\n9,0,0\n", "t.csv:2: 0 of 0 axes"),
    ("all dead", Law::Mortality, "age,axes,dead\n9,10,10\n12,5,5\n", "all 15 axes were dead"),
    ("rank 0", Law::Branching, "axis,rank,fate\na,0,long\n", "t.csv:2: rank 0 of axis `a` follows rank 0"),
    (
        "a rank left out",
        Law::Branching,
        "axis,rank,fate\na,1,long\na,3,long\n",
        "t.csv:3: rank 3 of axis `a` follows rank 1",
    ),
    ("an empty fate", Law::Branching, "axis,rank,fate\na,1,\n", "t.csv:2: `fate` is empty"),
    ("branches without nodes", Law::Crown, "above,first,second\n5,0,0\n", "1 pairs, and at least 10"),
    ("pairs below no node", Law::Crown, "above,first\n5,0\n", "there is no column `second`"),
];

#[test]
fn each_is_refused_in_words() {
    for (name, law, text, expected) in FIXTURES {
        let told = told(law, text.as_bytes());
        assert!(told.contains(expected), "{name}: expected {expected}\ntold {told}");
    }
    let told = told(Law::Nodes, b"nodes\n\xff\xfe\n");
    assert!(told.contains("the bytes are no text in UTF-8"), "{told}");
}

#[test]
fn an_empty_group_is_told() {
    let table = Table::from_csv("t.csv", b"dataset,nodes\na,3\n").unwrap();
    let fault = table.clone().only("dataset", "b").unwrap_err().to_string();
    assert!(fault.contains("no row has `b` in the column `dataset`: the group is empty"), "{fault}");
    assert!(table.only("datset", "a").unwrap_err().to_string().contains("the nearest is `dataset`"));
}

/// Every sample file is read, fitted and stated.
#[test]
fn every_sample_file_becomes_keys_of_a_species() {
    for (law, name, _, sample) in LAWS {
        let told = told(law, sample.as_bytes());
        assert!(told.contains(" = {") && told.contains("source = "), "{name}: {told}");
        println!("{name}\n{told}\n");
    }
}

/// Any bytes at all: no panic, and always words.
#[test]
fn mutilated_samples_do_not_panic() {
    let mut draws = phytomer_fits::draws::Draws::new(1988, 0);
    for (law, _, _, sample) in LAWS.iter().filter(|law| law.0 == Law::Nodes || law.0 == Law::Mortality) {
        for _ in 0..40 {
            let mut bytes = sample.as_bytes().to_vec();
            bytes.truncate(1 + draws.below(bytes.len()));
            for _ in 0..3 {
                let place = draws.below(bytes.len());
                bytes[place] = b"0,\n-.9#\"e"[draws.below(9)];
            }
            assert!(!told(*law, &bytes).is_empty());
        }
    }
}
