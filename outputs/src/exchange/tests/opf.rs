//! OPF texts with all that the format leaves open: what stands where, what is missing, and how faces and axes are
//! written.

use super::{plants, read, text, written};
use crate::exchange::{Description, FeatureType, Link, Value};

/// A plant in which axes go on within their internodes, then beside them.
fn axes(inside: bool) -> String {
    let (first, last) = if inside { ("", "</decomp>") } else { ("</decomp>", "") };
    format!(
        "<opf version='2.0'><topology class='Individual' scale='1'><decomp class='Axis' scale='2'>\
         <decomp class='Internode' scale='3'><branch class='Leaf' scale='3'/>{first}\
         <follow class='Internode' scale='3'><branch class='Axis' scale='2'><decomp class='Internode' scale='3'/></branch>\
         </follow>{last}</decomp></topology></opf>"
    )
}

/// Class, bearer, link and whole of each entity.
fn topology(description: &Description) -> Vec<String> {
    let entities = &description.individuals[0].entities;
    let line = |entity: &crate::exchange::Entity| {
        let link = match entity.link {
            Some(Link::Follows) => "<",
            Some(Link::Branches) => "+",
            None => "-",
        };
        let place = |of: Option<u32>| of.map_or(String::new(), |of| of.to_string());
        format!("{}{link}{} in {}", description.class_of(entity).symbol, place(entity.bearer), place(entity.complex))
    };
    entities.iter().map(line).collect()
}

#[test]
fn axes_go_on_within_or_beside_what_they_go_on_from() {
    let expected = [
        "Individual- in ",
        "Axis- in 0",
        "Internode- in 1",
        "Leaf+2 in 1",
        "Internode<2 in 1",
        "Axis+4 in 0",
        "Internode- in 5",
    ];
    for inside in [true, false] {
        let plant = plants("opf", &axes(inside));
        assert_eq!(topology(&plant), expected, "{inside}");
        let (out, losses) = written("opf", &plant);
        assert!(losses.is_empty(), "{losses:?}");
        assert_eq!(topology(&plants("opf", &text(&out))), expected);
        // Each internode ends before the next begins.
        assert!(text(&out).contains("</decomp>\n\t\t\t<follow"), "{}", text(&out));
    }
}

#[test]
fn scales_that_are_missing_follow_from_what_is_around() {
    let bare: String = axes(false).replace(" scale='1'", "").replace(" scale='2'", "").replace(" scale='3'", "");
    let plant = plants("opf", &bare);
    assert_eq!(topology(&plant)[..5], topology(&plants("opf", &axes(false)))[..5]);
    let scales: Vec<u32> = plant.classes.iter().map(|class| class.scale).collect();
    // The axis that branches has the scale of what it branches from, since nothing tells another.
    assert_eq!(scales, [1, 2, 3, 3, 3, 4]);
}

const MESHES: &str = "<shapeBDD><shape Id='7'><name>x</name><meshIndex>4</meshIndex><materialIndex>9</materialIndex></shape>\
    <shape Id='3'><meshIndex>2</meshIndex></shape></shapeBDD>\
    <meshBDD><mesh Id='2' enableScale='false'><points>0 0 0 2 0 0 2 1 0 0 1 0</points><faces>0 1 2 0 2 3</faces></mesh>\
    <mesh name='kite' Id='4'><points>0 0 0\t3 -1 0\n6 0 0 3 1 0</points><faces><face Id='0'>0 1 2 3</face></faces></mesh>\
    </meshBDD><materialBDD><material Id='9'><diffuse>0.1 0.2 0.3</diffuse></material></materialBDD>";

fn drawn(shape: &str, more: &str) -> String {
    format!(
        "<opf>{MESHES}<attributeBDD><attribute name='Length' class='Millimetre'/><attribute name='Vigour' class='Integer'/>\
         </attributeBDD><topology class='Plant' scale='1'><decomp class='Leaf' scale='2'>{more}<geometry class='Mesh'>\
         <shapeIndex>{shape}</shapeIndex><mat>0 -1 0 10\n2 0 0 20\n0 0 1 30</mat><dUp>4</dUp><dDwn>3</dDwn></geometry>\
         </decomp></topology></opf>"
    )
}

#[test]
fn shapes_are_found_by_their_ids_wherever_they_stand() {
    let plant = plants("opf", &drawn("7", ""));
    let leaf = &plant.individuals[0].entities[1];
    let form = leaf.form.as_ref().unwrap();
    let shape = &plant.shapes[form.shape as usize];
    assert_eq!((shape.name.as_str(), plant.meshes[shape.mesh as usize].name.as_str()), ("x", "kite"));
    // A polygon becomes a fan.
    assert_eq!(plant.meshes[shape.mesh as usize].triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(plant.materials[shape.material.unwrap() as usize].diffuse, [0.1, 0.2, 0.3, 1.0]);
    assert_eq!(form.taper, Some([3.0, 4.0]));
    let seen = leaf.latest().unwrap();
    // 6 units along x, twice as long by the matrix: 12 cm.
    assert!((seen.length.unwrap() - 0.12).abs() < 1e-15);
    assert_eq!((seen.place, seen.direction), (Some([0.1, 0.2, 0.3]), Some([0.0, 1.0, 0.0])));
    assert_eq!((seen.base_diameter, seen.tip_diameter), (Some(0.03), None));

    let plain = plants("opf", &drawn("3", "<Length>5</Length><Width>NA</Width>"));
    let leaf = &plain.individuals[0].entities[1];
    // The class of the attribute tells millimetres; a mesh that is not scaled has no widths.
    assert_eq!(leaf.latest().unwrap().length, Some(0.005));
    assert_eq!((leaf.form.as_ref().unwrap().taper, leaf.latest().unwrap().base_diameter), (None, None));
    assert_eq!(plain.meshes[plain.shapes[1].mesh as usize].triangles, [[0, 1, 2], [0, 2, 3]]);
    // What is not tapered stays so.
    let (out, _) = written("opf", &plain);
    assert!(text(&out).contains("enableScale=\"false\"") && text(&out).contains("<dUp>1</dUp><dDwn>1</dDwn>"));
    let found = plants("opf", &text(&out));
    assert_eq!(found.individuals[0].entities[1].form.as_ref().unwrap().taper, None);
    assert_eq!(written("opf", &found).0, out);
}

#[test]
fn attributes_have_the_type_of_their_class() {
    let plant = plants("opf", &drawn("7", "<Vigour>12.0</Vigour>"));
    assert_eq!(plant.features[0].kind, FeatureType::Int);
    assert_eq!(plant.individuals[0].entities[1].latest().unwrap().values, [(0, Value::Int(12))]);
    let (plant, report) = read("opf", &drawn("7", "<Colour>deep red</Colour><Vigour> NA </Vigour>"));
    assert_eq!(plant.individuals[0].entities[1].latest().unwrap().values, [(1, Value::Text("deep red".into()))]);
    assert_eq!(report.warnings()[0].to_string(), "plant:2:346: the attribute `Colour` is not declared: read as text");
}

#[test]
fn what_is_unusual_is_read_with_a_warning() {
    let text = "\u{feff}<?xml version='1.0'?><!-- a -->\n<opf version='1.9' editable='true'><other><a/></other>\n\
        <topology class='Scene' scale='0' id='1'><decomp class='Individual' scale='1'>lost<follow class='Axis' scale='2'/>\
        </decomp><decomp class='Individual' scale='1'/></topology></opf>";
    let (plant, report) = super::read_with("opf", text.as_bytes(), &Default::default());
    assert_eq!((plant.individuals.len(), plant.individuals[0].entities.len()), (2, 2));
    let told: Vec<String> = report.warnings().iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "plant:2:1: the file is of version `1.9` and is read as 2.0",
            "plant:2:36: `<other>` is not known here and is left out",
            "plant:3:79: `lost` stands outside of attributes: left out",
            "plant:3:83: `<follow>` has nothing of its scale before it: read as a first part",
        ]
    );
    assert!(report.faults().is_empty(), "{:?}", report.faults());
}

#[test]
fn a_width_of_exactly_one_is_written_a_little_larger() {
    let plant = plants("opf", &drawn("7", "").replace("<dUp>4</dUp>", "<dUp>1</dUp>"));
    let (out, _) = written("opf", &plant);
    assert!(text(&out).contains("<dUp>1.0000000001</dUp><dDwn>3</dDwn>"), "{}", text(&out));
    let both = plants("opf", &drawn("7", "").replace("<dUp>4</dUp>", "<dUp>1</dUp>").replace(">3<", ">1<"));
    assert!(text(&written("opf", &both).0).contains("<dUp>1</dUp><dDwn>1</dDwn>"));
}

#[test]
fn names_that_no_element_can_have_are_changed_and_told() {
    let mut plant = plants("opf", &drawn("7", "<Vigour>1</Vigour>"));
    for name in ["two words", "9th", "geometry", "Length", "two_words"] {
        let feature = plant.feature(name, FeatureType::Text);
        let seen = plant.individuals[0].entities[1].latest_mut();
        seen.values.push((feature, Value::Text(format!("<{name}> & \"more\"").into())));
    }
    let (out, losses) = written("opf", &plant);
    assert_eq!(losses, ["lost: names of features that no attribute can have (5): similar names"]);
    let found = plants("opf", &text(&out));
    let names: Vec<&str> = found.features.iter().map(|feature| feature.name.as_str()).collect();
    assert_eq!(names, ["Length_", "Vigour", "_9th", "geometry_", "two_words", "two_words_2"]);
    let values = &found.individuals[0].entities[1].latest().unwrap().values;
    assert_eq!(values[2].1, Value::Text("<9th> & \"more\"".into()));
    assert_eq!(written("opf", &found).0, out);
}

#[test]
fn several_that_go_on_from_one_entity_stand_within_and_beside_it() {
    let mut plant = plants("opf", &axes(false));
    let internode = plant.individuals[0].entities[2].class;
    for _ in 0..2 {
        let mut entity = crate::exchange::Entity::of(internode);
        (entity.bearer, entity.link, entity.complex) = (Some(2), Some(Link::Follows), Some(1));
        plant.individuals[0].entities.push(entity);
    }
    let (out, losses) = written("opf", &plant);
    // One stands within, the last beside; the one between becomes a branch.
    assert_eq!(losses, ["lost: links between entities (1): they stand in their wholes, or as branches"]);
    let found = plants("opf", &text(&out));
    let links = |of: &Description| topology(of).iter().filter(|line| line.starts_with("Internode<2")).count();
    assert_eq!((links(&plant), links(&found), found.entities()), (3, 2, plant.entities()));
    assert_eq!(written("opf", &found).0, out);
}
