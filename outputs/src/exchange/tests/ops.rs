//! Scenes: rows with and without a scale, groups, and plants that share a file.

use super::{read_with, text, written};
use crate::exchange::{Description, Standing};
use std::collections::BTreeMap;

const PLANT: &str = "<opf><meshBDD><mesh Id='0'><points>0 0 0 1 0 0 1 1 0</points><faces>0 1 2</faces></mesh></meshBDD>\
    <shapeBDD><shape Id='0'><meshIndex>0</meshIndex></shape></shapeBDD>\
    <topology class='Plant' scale='1'><decomp class='Leaf' scale='2'><geometry><shapeIndex>0</shapeIndex>\
    <mat>1 0 0 0 0 1 0 0 0 0 1 5</mat></geometry></decomp></topology></opf>";
const OTHER: &str =
    "<opf><topology class='Individual' scale='1'><Species>oak</Species><Length>12</Length></topology></opf>";

fn files() -> BTreeMap<String, Vec<u8>> {
    [("a.opf", PLANT), ("b.opf", OTHER)].map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())).into()
}

fn scene(text: &str) -> (Description, Vec<String>) {
    let (description, report) = read_with("ops", text.as_bytes(), &files());
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    (description, report.warnings().iter().map(ToString::to_string).collect())
}

const SCENE: &str = "# a scene\nT 0 0 0 2 2 flat\n#[Archimed] coffee\n1\t1\ta.opf\t0\t0\t0\t1\t0\t0\t0\n\
    1 2 a.opf 1 0.5 0 0.1 0.2 1.5\n#[Archimed] plant\n1 3 b.opf 2 0 0 0 0 0 0\n1 4 a.opf 3 0 0 2.5 0 0 0\n-1 1 1\n1 5 c.gwa 0 0 0 1 0 0 0\n";

#[test]
fn rows_have_a_scale_or_none() {
    let (plants, warnings) = scene(SCENE);
    let standing: Vec<Standing> = plants.individuals.iter().filter_map(|plant| plant.standing).collect();
    let of = |place, scale, azimuth, inclination, twist| Standing { place, scale, azimuth, inclination, twist };
    assert_eq!(
        standing,
        [
            of([0.0, 0.0, 0.0], 1.0, 0.0, 0.0, 0.0),
            of([1.0, 0.5, 0.0], 1.0, 0.1, 0.2, 1.5),
            of([2.0, 0.0, 0.0], 1.0, 0.0, 0.0, 0.0),
            of([3.0, 0.0, 0.0], 2.5, 0.0, 0.0, 0.0),
        ]
    );
    let species: Vec<_> = plants.individuals.iter().map(|plant| plant.species.as_deref()).collect();
    assert_eq!(species, [Some("coffee"), Some("coffee"), Some("oak"), None]);
    let names: Vec<_> = plants.individuals.iter().filter_map(|plant| plant.name.as_deref()).collect();
    assert_eq!(names, ["1", "2", "3", "4"]);
    // The mesh of the file that three plants have is there once.
    assert_eq!((plants.meshes.len(), plants.shapes.len(), plants.entities()), (1, 1, 7));
    assert_eq!(
        warnings,
        [
            "plant:5: the row has no scale: read as 1",
            "plant:7: the scale is 0: read as 1",
            "plant:9: a line of three numbers, as of a chain of scenes, is left out",
            "plant:10: `c.gwa` is no OPF file and is left out",
        ]
    );
}

/// As in a scene of the tests of PlantGeom.jl: names of columns in a comment, no scale, a last column without meaning,
/// and two tabs between some cells.
#[test]
fn columns_that_a_comment_names_may_have_no_scale() {
    let (plants, warnings) = scene(
        "T 0 0 0 2 1 flat\n\n#[Archimed] coffee\n\
         #sceneId plantId plantFileName x y z inclinationAzimut inclinationAngle stemTwist ignored\n\
         1\t1\ta.opf\t1\t\t0.5\t\t0\t0.25\t0.125\t2\t9\n\
         #sceneId plantId plantFileName x y z scale inclinationAzimut inclinationAngle stemTwist\n\
         1\t2\ta.opf\t1\t\t0.5\t\t0\t3\t0.25\t0.125\t2\n",
    );
    let standing: Vec<Standing> = plants.individuals.iter().filter_map(|plant| plant.standing).collect();
    let of = |scale| Standing { place: [1.0, 0.5, 0.0], scale, azimuth: 0.25, inclination: 0.125, twist: 2.0 };
    assert_eq!(standing, [of(1.0), of(3.0)]);
    assert_eq!(warnings, ["plant:5: the row has no scale: read as 1"]);
}

#[test]
fn a_scene_has_a_file_a_plant_and_stays_as_it_is() {
    let (plants, _) = scene(SCENE);
    let (out, losses) = written("ops", &plants);
    assert!(losses.is_empty(), "{losses:?}");
    assert_eq!(out.beside.keys().collect::<Vec<_>>(), ["plant_1.opf", "plant_2.opf", "plant_3.opf", "plant_4.opf"]);
    let lines = text(&out);
    assert!(
        lines.starts_with("# T xOrigin yOrigin zOrigin xSize ySize flat\nT 0 0 0 4 1 flat\n#[Archimed] coffee\n"),
        "{lines}"
    );
    assert!(lines.contains("\n1\t2\tplant_2.opf\t1\t0.5\t0\t1\t0.1\t0.2\t1.5\n#[Archimed] oak\n"), "{lines}");
    let (again, report) = read_with("ops", &out.main, &out.beside);
    assert!(report.faults().is_empty() && report.warnings().is_empty(), "{report:?}");
    assert_eq!(written("ops", &again).0, out);
    assert_eq!(again.individuals[3].standing, plants.individuals[3].standing);
}
