//! Files that are refused, each with the message that tells why.

use super::{read, read_with};
use std::collections::BTreeMap;

/// An OPF file with something in it and a plant.
fn opf(inside: &str) -> String {
    format!("<opf version=\"2.0\">\n{inside}\n<topology class=\"Plant\" scale=\"1\"/>\n</opf>")
}

/// An OPF file with a plant that has something in it.
fn plant(inside: &str) -> String {
    format!(
        "<opf>\n<attributeBDD><attribute name=\"Count\" class=\"Integer\"/></attributeBDD>\n\
         <topology class=\"Plant\" scale=\"1\">\n{inside}\n</topology></opf>"
    )
}

fn mesh(inside: &str) -> String {
    opf(&format!("<meshBDD><mesh Id=\"0\"><points>0 0 0 1 0 0 1 1 0</points>\n{inside}</mesh></meshBDD>"))
}

#[test]
fn opf_files() {
    let bad: [(String, &str); 27] = [
        (
            "<opf>\n<meshBDD></opf>".into(),
            "2:10: this is no XML: ill-formed document: expected `</meshBDD>`, but `</opf>` was found; expected elements that are closed and values in quotes",
        ),
        (
            plant("<Name>&me;</Name>"),
            "4:7: `&me;` stands for nothing; expected characters themselves, or `&lt;`, `&gt;`, `&amp;`, `&quot;`, `&apos;`",
        ),
        (
            "<!DOCTYPE opf [<!ENTITY a SYSTEM \"file:///etc/passwd\">]>\n<opf>&a;</opf>".into(),
            "1:1: the file declares a document type; expected no document type",
        ),
        ("<scene/>".into(), "1:1: the file begins with `<scene>`; expected `<opf version=\"2.0\">`"),
        ("text".into(), ": the file has no element; expected `<opf version=\"2.0\">`"),
        ("<opf version='2.0'/>".into(), ": the file has no plant; expected a `<topology>` with a plant in it"),
        (
            opf("<meshBDD><mesh Id=\"0\"><points>0 0\n1,5</points></mesh></meshBDD>"),
            "3:1: `1,5` is no number; expected numbers with blanks between them",
        ),
        (
            opf("<meshBDD><mesh Id=\"0\"><points>0 0 0 1</points></mesh></meshBDD>"),
            "2:47: 4 numbers are no points; expected three numbers a point",
        ),
        (opf("<meshBDD><mesh Id=\"a\"/></meshBDD>"), "2:10: `Id` is `a`; expected a whole number"),
        (
            opf("<meshBDD><mesh Id=\"1\"/>\n<mesh Id=\"1\"/></meshBDD>"),
            "3:1: a second `<mesh>` has the `Id` 1; expected an `Id` of its own",
        ),
        (
            mesh("<faces><face>0 1\n7</face></faces>"),
            "4:1: a face names point 7 of a mesh with 3 points; expected a whole number below 3",
        ),
        (mesh("<faces><face>0 1</face></faces>"), "3:8: a face has 2 corners; expected three corners or more"),
        (
            mesh("<faces>0 1 2 0</faces>"),
            "3:23: 4 corners outside of `<face>` are no triangles; expected a multiple of three",
        ),
        (mesh("<faces>0 -1 2</faces>"), "3:10: `-1` is no corner of a face; expected whole numbers from 0"),
        (
            opf("<materialBDD><material Id=\"0\"><diffuse>1 1</diffuse></material></materialBDD>"),
            "2:53: a colour has 2 numbers; expected red, green, blue and opacity, 0 to 1",
        ),
        (
            opf("<shapeBDD><shape Id=\"0\"><meshIndex>3</meshIndex></shape></shapeBDD>"),
            "2:11: the mesh of a shape has the `meshIndex` 3, which no mesh has as its `Id`; expected the `Id` of a `<mesh>`",
        ),
        (
            opf("<attributeBDD><attribute class=\"String\"/></attributeBDD>"),
            "2:15: an attribute has no `name`; expected `<attribute name=\"…\" class=\"…\"/>`",
        ),
        (
            plant("<geometry><shapeIndex>0</shapeIndex>\n<mat>1 0 0 0 0 1 0 0 0 0 1</mat></geometry>"),
            "5:33: a matrix has 11 numbers; expected three rows of four",
        ),
        (
            plant("<geometry><shapeIndex>0</shapeIndex></geometry>"),
            "4:1: a `<geometry>` with a shape has no `<mat>`; expected a matrix of three rows and four columns",
        ),
        (
            plant("<geometry><shapeIndex>5</shapeIndex><mat>1 0 0 0 0 1 0 0 0 0 1 0</mat></geometry>"),
            "4:1: `<shapeIndex>` is 5, which no shape has as its `Id`; expected the `Id` of a `<shape>`",
        ),
        (plant("<geometry><dUp>-1</dUp></geometry>"), "4:16: a width is `-1`; expected a number that is not below 0"),
        (plant("<Count>many</Count>"), "4:8: `<Count>` is `many`; expected a whole number, as its class says"),
        (plant("<Length>-2</Length>"), "4:9: `<Length>` is `-2`; expected a number that is not below 0"),
        (plant("<BirthAge>1.5</BirthAge>"), "4:11: `<BirthAge>` is `1.5`; expected a whole number of ticks from 0"),
        (plant("<decomp class=\"Axis\" scale=\"x\"/>"), "4:1: `scale` is `x`; expected a whole number from 0"),
        (plant("<decomp scale=\"2\"/>"), "4:1: an entity has no `class`; expected `class=\"Internode\"` or the like"),
        (
            format!("{}<topology/></opf>", plant("").replace("</opf>", "\n")),
            "6:1: a second `<topology>`; expected one, with several plants within a scene where there are more",
        ),
    ];
    for (text, expected) in bad {
        told("opf", &text, expected);
    }
}

#[test]
fn what_nests_too_deep_is_refused() {
    let deep = "<decomp class='A' scale='2'>".repeat(70);
    told(
        "opf",
        &format!("<opf><topology class='P' scale='1'>{deep}"),
        "1:1828: wholes stand too deep within one another; expected at most 64 scales",
    );
    let deeper = "<follow class='I'>".repeat(1_000_000);
    let (_, report) = read("opf", &format!("<opf><topology class='P' scale='1'>{deeper}"));
    assert_eq!(report.faults().len(), 1);
    assert_eq!(report.faults()[0].problem, "elements stand too deep within one another");
    // Nested as deep as an axis may be: one internode in the other.
    let (count, open, close) = (90_000, "<follow class='I' scale='2'>", "</follow>");
    let axis =
        format!("<opf><topology class='I' scale='2'>{}{}</topology></opf>", open.repeat(count), close.repeat(count));
    assert_eq!(super::plants("opf", &axis).entities(), count + 1);
}

const ROW: &str = "0.1\t1\t0\t0\t0\t0\t0\t1\t0\t0\t0\t0.1\t1\t0\t1\n";
const NAMES: &str = "cyl_ID,parent_ID,axis_ID,startX,startY,startZ,endX,endY,endZ,radius_cyl,length\n";

#[test]
fn files_of_cylinders() {
    let row = |column: usize, value: &str| {
        let mut cells: Vec<&str> = ROW.trim_end().split('\t').collect();
        cells[column] = value;
        format!("{ROW}{}\n", cells.join("\t"))
    };
    let bad: [(&str, String, &str); 16] = [
        ("treeqsm", String::new(), ": the file has no cylinders; expected rows of 15 or 17 numbers"),
        (
            "treeqsm",
            "radius (m)\tlength (m)\n".into(),
            ": the file has no cylinders; expected rows of 15 or 17 numbers",
        ),
        ("treeqsm", "1 2 3\n".into(), "1: the row has 3 columns; expected 15 or 17"),
        ("treeqsm", format!("{ROW}1 2 3\n"), "2: the row has 3 columns; expected 15, as before"),
        ("treeqsm", row(2, "NaN"), "2:7: `NaN` is no number; expected a number"),
        ("treeqsm", row(0, "-0.1"), "2: the radius is -0.1; expected a number that is not below 0"),
        ("treeqsm", row(8, "7"), "2: the parent is 7; expected the number of a row from 1 to 2, or 0 for none"),
        (
            "treeqsm",
            row(8, "2"),
            "2: the parents of a cylinder go round in a circle; expected a way from each cylinder to the base",
        ),
        ("treeqsm", row(12, "1.5"), "2: the branch is 1.5; expected a whole number"),
        ("rtwig", "\n \n".into(), ": the file has no lines; expected a line of names, and a row a cylinder"),
        (
            "rtwig",
            NAMES.replace("radius_cyl", "r"),
            "1: the table has no column for the radius; expected a column `radius_cyl` or `radius`",
        ),
        ("rtwig", NAMES.into(), ": the table has no cylinders; expected a row a cylinder below the names"),
        ("rtwig", format!("{NAMES}1,0,1\n"), "2: the row has 3 cells; expected 11, as there are names"),
        ("rtwig", format!("{NAMES}1,0,1,0,0,0,0,zero,1,0.1,1\n"), "2:15: end y is `zero`; expected a number"),
        (
            "rtwig",
            format!("{NAMES}1,0,1,0,0,0,0,0,1,0.1,1\n1,0,1,0,0,0,0,0,1,0.1,1\n"),
            "3: a second cylinder has the number 1; expected a number of its own",
        ),
        (
            "rtwig",
            format!("{NAMES}1,5,1,0,0,0,0,0,1,0.1,1\n"),
            "2: the parent is 5, which is the number of no cylinder; expected the number of a cylinder, or 0 or -1 for none",
        ),
    ];
    for (word, text, expected) in bad {
        told(word, &text, expected);
    }
    told(
        "obj",
        "v 0 0 0",
        ": OBJ files are written, not read; expected a file of another format, since a mesh tells no plant",
    );
}

#[test]
fn scenes() {
    let bad = [
        (
            "T 0 0 0 1 1 flat\n",
            ": the scene has no plant; expected rows of scene, plant, OPF file, place, scale and three angles",
        ),
        (
            "1 1 none.opf 0 0 0 1 0 0 0\n",
            "1: `none.opf` cannot be read: no such file; expected an OPF file beside the scene",
        ),
        (
            "1 1 a.opf 0 0\n",
            "1: the row has 5 cells; expected scene, plant, file, x, y, z, scale and three angles; the scale may be missing",
        ),
        ("\n1 1 a.opf 0 0 zero 1 0 0 0\n", "2: `zero` is no number; expected a number"),
        ("1 1 a.opf 0 0 0 -1 0 0 0\n", "1: the scale is -1; expected a number above 0"),
    ];
    for (text, expected) in bad {
        told("ops", text, expected);
    }
    // What is wrong with a plant's own file is told with its place there.
    let others: BTreeMap<String, Vec<u8>> = [("a.opf".to_owned(), b"<opf>\n<meshBDD></opf>".to_vec())].into();
    let (_, report) = read_with("ops", b"1 1 a.opf 0 0 0 1 0 0 0\n1 2 a.opf 0 0 0 1 0 0 0\n", &others);
    assert_eq!(report.faults().len(), 1, "{:?}", report.faults());
    assert!(report.faults()[0].to_string().starts_with("a.opf:2:10: this is no XML"), "{}", report.faults()[0]);
}

fn told(word: &str, text: &str, expected: &str) {
    let (_, report) = read(word, text);
    let faults: Vec<String> = report.faults().iter().map(ToString::to_string).collect();
    let expected = if expected.starts_with(": ") { format!("plant{expected}") } else { format!("plant:{expected}") };
    assert!(
        faults.first() == Some(&expected),
        "{}\n  expected {expected}\n  told {faults:?}",
        &text[..text.len().min(500)]
    );
}
