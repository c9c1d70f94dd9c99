//! Scripts that are read and scripts that are refused: of every production of the appendix one of each.

use super::*;

/// What a script needs before the statement of a case: trees, clusters and a workstation.
const BEFORE: &str = "create gmt1 oak 5 .9 .7 20 -40; create gmt3 ash 4 .8 .7 .7 30 -30; create gmt4 elm 6 .9 .8 1 60 20 -60 -20;\n\
    create gmt1 fir 3 .9 .7 20 -40; cluster wood ash; cluster park elm; open w display; activate w pick;\n";

/// A command, operands that are read, and operands that are refused, with what their messages hold.
type Case = (&'static str, &'static [&'static str], &'static [(&'static str, &'static str)]);

const CASES: &[Case] = &[
    (
        "create",
        &[
            "gmt2 a 3 .9 .8 0 -45",
            "gmt3 a 3 .8 .7 .7 30 -30 {0 0 0 0 0 12}",
            "gmt4 a 9 .9 .8 5 60 20 -60 -20 0 0 0 0 0 1",
        ],
        &[
            ("gmt5 a 3 .9 .8 0 -45", "`gmt5` is none of gmt1, gmt2, gmt3, gmt4"),
            ("gmt1 a 40 .9 .8 0 -45", "`40` is no whole number in bounds"),
            ("gmt1 a 3 0 .8 0 -45", "0 is out of bounds; expected the contraction ratio R1"),
            ("gmt3 a 3 0 .9 .8 0 -45", "expected the contraction ratio R0"),
            ("gmt1 oak 3 .9 .8 0 -45", "the tree `oak` exists"),
            ("gmt1 a 3 .9 .8 0 -45 1 1 1 1 1 1", "the first branch has no length"),
            ("gmt1 a 3 .9 .8 0", "the statement ends here; expected the angle h2"),
            ("gmt1 a 3 .9 .8 0 -45 {0 0 0 0 0 12 9}", "the braces hold more"),
        ],
    ),
    (
        "combine",
        &[
            "a 5 {{gmt1 1 3 .9 .7 20 -40} {gmt3 4 5 .8 .7 .7 30 -30}}",
            "a 2 gmt1 1 1 .9 .7 20 -40 0 0 0 0 0 9 gmt1 2 2 .9 .7 1 -4",
        ],
        &[
            ("a 5 gmt1 1 3 .9 .7 20 -40", "lead to growth level 3, and the tree to 5"),
            ("a 5 gmt1 2 5 .9 .7 20 -40", "the range begins with growth level 2; expected growth level 1"),
            ("a 5 gmt1 3 1 .9 .7 20 -40", "the first growth level, 3, is above the last, 1"),
            ("oak 1 gmt1 1 1 .9 .7 20 -40", "the tree `oak` exists"),
        ],
    ),
    (
        "delete",
        &["oak"],
        &[("oka", "no tree is named `oka` here; expected a tree that `create` has made; the nearest is `oak`")],
    ),
    ("copy", &["oak a"], &[("oak ash", "the tree `ash` exists"), ("oak 7", "`7` is no name")]),
    ("abs_translate", &["oak 1 2 -3"], &[("oak 1 2", "its z"), ("oak 1 2 nan", "`nan` is no number")]),
    ("rel_translate", &["oak 1 2 -3"], &[("oak 1 2 3 4", "`4` is more than the statement takes")]),
    ("abs_zoom", &["oak 2"], &[("oak 0", "0 is out of bounds")]),
    ("rel_zoom", &["oak .5"], &[("oak x", "`x` is no number")]),
    ("abs_rotate", &["oak 90"], &[("oak", "the angle about the main axis")]),
    ("rel_rotate", &["oak -90"], &[("okk -90", "the nearest is `oak`")]),
    ("release", &["oak"], &[("", "the statement ends here")]),
    (
        "animate",
        &["gmt1 oak 5", "gmt1 oak 5 {.2}"],
        &[("gmt2 oak 5", "of another type; expected the type gmt1"), ("gmt1 oak 5 -1", "-1 is out of bounds")],
    ),
    ("inform", &["oak"], &[("oak ash", "`ash` is more than the statement takes")]),
    (
        "glue",
        &["oak fir both"],
        &[("oak oak both", "cannot be glued to itself"), ("oak fir ash", "the tree `ash` exists")],
    ),
    (
        "cluster",
        &["c oak", "c oak fir", "c oak {fir}"],
        &[
            ("wood oak", "the cluster `wood` exists"),
            ("c ash", "in the cluster `wood`"),
            ("c", "the statement ends here"),
        ],
    ),
    (
        "remove",
        &["wood"],
        &[("wod", "no cluster is named `wod` here; expected a cluster that `cluster` has made; the nearest is `wood`")],
    ),
    (
        "append",
        &["wood oak"],
        &[("wood ash", "`expel wood ash;` before"), ("trees oak", "no cluster is named `trees`")],
    ),
    ("expel", &["wood ash"], &[("wood oak", "`oak` is not in the cluster `wood`")]),
    ("flush", &["wood", "wood 1.5"], &[("wood 1 2", "`2` is more"), ("trees", "no cluster is named `trees`")]),
    (
        "merge",
        &["wood park all"],
        &[("wood wood all", "cannot be merged with itself"), ("wood park", "the statement ends here")],
    ),
    ("inquire", &["wood"], &[("woods", "the nearest is `wood`")]),
    (
        "compose",
        &["oak", "oak top", "oak {front} {0 -50 3}", "oak 0 -50 3"],
        &[("oak tip", "the nearest is `top`"), ("oak 0 1", "its z")],
    ),
    (
        "view",
        &["wood", "wood perspective 0 -50 3"],
        &[("oak", "no cluster is named `oak`"), ("wood top 1 2 3 4", "`4` is more")],
    ),
    (
        "color",
        &["10 20 30", "oak #00ff7f", "{oak} 1 2 3"],
        &[
            ("oak 1 2 300", "`300` is no whole number in bounds"),
            ("#12345", "`#12345` is no colour"),
            ("oak", "expected a colour"),
        ],
    ),
    ("appear", &["oak off", "oak 1"], &[("oak of", "the nearest is `off`")]),
    ("visible", &["wood on"], &[("wood", "on or off")]),
    (
        "girth",
        &["on", "oak on {.5 .7 1 on off 8}", "off"],
        &[("oak on .5 .7 1 on off 2", "`2` is no whole number in bounds"), ("on .5 2", "2 is out of bounds")],
    ),
    ("cont", &["on 8", "off", "on"], &[("on 0", "`0` is no whole number in bounds"), ("8", "`8` is none of on, off")]),
    ("cut_axis", &["on 4", "off"], &[("on 99", "`99` is no whole number in bounds")]),
    (
        "cut_lateral",
        &["on 2", "on {2 {{3} {4}}}", "on 2 3 4", "off"],
        &[("on 2 x", "`x` is no whole number"), ("yes", "none of on, off")],
    ),
    (
        "divergence",
        &["140", "2/5", "0"],
        &[("7/5", "no part of a turn"), ("1/0", "no part of a turn"), ("999", "999 is out of bounds")],
    ),
    (
        "deform",
        &[
            "oak on off off .3 .3 -.3",
            "oak 0 1 0 {1 5 2 30 0 30} {2 2 -1 0 0 9}",
            "oak 1 1 1 0 0 1 1 5 2 30 0 30 {5 5 0 2}",
            "oak 0 0 0",
        ],
        &[
            ("oak on off off .3 .3", "here are 2 numbers; expected dx, dy and dz of the deviator"),
            ("oak off on off 1 5 2 30 0", "lower and upper level, factor"),
            ("oak off off off 1", "none: all masks are off"),
            ("oak off on off 1 9 2 30 0 30", "up to growth level 9; expected at most 5"),
            ("oak off on off 5 1 2 30 0 30", "is above the last"),
        ],
    ),
    (
        "leaf",
        &["oak gmt1 elliptic 5 0 160 0", "oak gmt1 elliptic 5 #00a000 .3 .2"],
        &[
            ("oak gmt1 elliptic 6 0 160 0", "at most 5"),
            ("oak gmt3 elliptic 5 0 160 0", "the type gmt1"),
            ("oak gmt1 elliptic 5 0 160 0 .3", "the width of a leaf"),
        ],
    ),
    (
        "shadow",
        &["oak gmt1 10 -10 50 90 90 90", "oak gmt1 10 -10 50 #5a5a5a off"],
        &[("oak gmt1 10 -10 0 90 90 90", "on or below the ground"), ("oak gmt4 10 -10 9 90 90 90", "the type gmt1")],
    ),
    (
        "open",
        &["v plotter", "w2 model"],
        &[("w display", "the workstation `w` is open"), ("v screen", "none of display, plotter, model")],
    ),
    ("close", &["w"], &[("v", "no workstation is named `v`")]),
    (
        "port",
        &["w top 0 .5 1 .5"],
        &[
            ("w top .5 0 1 .5", "is inside out"),
            ("w top 0 .5 .5 1", "is inside out"),
            ("w top 0 2 1 0", "2 is out of bounds"),
        ],
    ),
    ("window", &["w -20 20 30 -1"], &[("w 20 -20 30 -1", "is inside out"), ("w 1 2", "the top of the window")]),
    ("activate", &["w locator"], &[("w pick", "is active"), ("w mouse", "none of pick")]),
    ("deactivate", &["w pick"], &[("w valuator", "is not active")]),
    ("clear", &["w"], &[("wood", "no workstation is named `wood`")]),
    ("back_color", &["0 0 0"], &[("0 0", "the statement ends here"), ("black", "`black` is no whole number")]),
    ("exit", &[""], &[("now", "`now` is more than the statement takes")]),
    ("local", &[""], &[("1", "`1` is more")]),
    ("defer", &[".25"], &[("-1", "-1 is out of bounds"), ("soon", "`soon` is no number")]),
    ("help", &["", "deform"], &[("from", "`from` is no command"), ("deform now", "`now` is more")]),
];

fn told(script: &str) -> String {
    read(script).map_or_else(|refused| refused.to_string(), |_| String::new())
}

#[test]
fn every_command_has_scripts_that_are_read_and_scripts_that_are_refused() {
    assert_eq!(told(BEFORE), "");
    let commands: Vec<&str> = COMMANDS.iter().map(|command| command.word).collect();
    for (command, accepted, refused) in CASES {
        assert!(commands.contains(command) && !accepted.is_empty() && !refused.is_empty(), "{command}");
        for operands in *accepted {
            assert_eq!(told(&format!("{BEFORE}{command} {operands};")), "", "{command} {operands}");
        }
        for (operands, expected) in *refused {
            let told = told(&format!("{BEFORE}{command} {operands};"));
            assert!(told.contains(expected) && told.starts_with("3:"), "{command} {operands}: {told}");
            assert_eq!(told.lines().count(), 1, "{command} {operands}: {told}");
        }
    }
    assert!(commands.iter().all(|command| CASES.iter().any(|(case, ..)| case == command)), "a command without a case");
}

#[test]
fn all_that_is_wrong_is_told_at_once_with_places() {
    let told = told("creat gmt1 a 3 .9 .8 0 -45;\nexit; defer 1;\n  color oak 1 2 3");
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines.len(), 3, "{told}");
    assert!(lines[0].starts_with("1:1: `creat` is no command") && lines[0].ends_with("the nearest is `create`"));
    assert!(lines[1].starts_with("2:7: this stands after `exit`"));
    assert!(lines[2].starts_with("3:3: the statement `color` does not end"));
    let many = "x;".repeat(5000);
    let refused = read(&many).unwrap_err();
    assert_eq!((refused.faults.len(), refused.more), (MOST_FAULTS, 5000 - MOST_FAULTS));
}

#[test]
fn operands_are_what_was_written() {
    let script =
        "create gmt4 a 7 .9 .8 2 60 20 -50 -10 {1 2 3 1 2 13}; deform a 1 1 1 .1 .2 .3 {2 4 -1.5 7 8 9} {0 0 1 .5};";
    let steps = read(script).unwrap().steps;
    let Statement::Create { level, descriptor, .. } = &steps[0].statement else { panic!("{steps:?}") };
    assert_eq!((*level, descriptor.init), (7, Some([[1.0, 2.0, 3.0], [1.0, 2.0, 13.0]])));
    assert_eq!(descriptor.angles, Angles::Changing { category: 2, left: [60.0, 20.0], right: [-50.0, -10.0] });
    let Statement::Deform { deformation, .. } = &steps[1].statement else { panic!("{steps:?}") };
    assert_eq!((deformation.deviator, deformation.start), (Some([0.1, 0.2, 0.3]), Some(([0.0, 0.0, 1.0], 0.5))));
    let controller = Controller { levels: [2, 4], factor: -1.5, at: [7.0, 8.0, 9.0] };
    assert_eq!(deformation.controllers, Some(vec![controller]));
    let steps = read("divergence 2/5; divergence 140;").unwrap().steps;
    assert_eq!(steps[0].statement, Statement::Divergence { degrees: 144.0 });
}

#[test]
fn what_is_joined_gives_its_names_free() {
    let trees = "create gmt1 a 3 .9 .8 20 -40; create gmt1 b 4 .9 .8 20 -40;";
    assert_eq!(
        told(&format!("{trees} cluster c a; glue a b d; create gmt1 a 3 .9 .8 20 -40; append c a; append c d;")),
        ""
    );
    assert!(told(&format!("{trees} glue a b c; copy b d;")).contains("no tree is named `b`"));
    assert!(told(&format!("{trees} cluster c a; delete a; expel c a;")).contains("no tree is named `a`"));
}

#[test]
fn what_is_typed_goes_on_with_the_names_of_the_script() {
    let mut typing = read("create gmt1 a 3 .9 .8 20 -40; local;").unwrap().typing;
    assert!(typing.has_ended());
    assert!(typing.take("delete b;").is_err());
    assert_eq!(typing.take("copy a b; delete a;").unwrap().len(), 2);
    assert!(typing.take("copy a c;").is_err() && typing.take("copy b c; exit;").is_ok() && typing.has_ended());
}
