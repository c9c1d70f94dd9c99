//! Reading and writing of small texts, and of measured plants where they stand beside the project.

use super::Mtg;
use crate::exchange::contract::{Format, InMemory, Incoming, Units};
use crate::exchange::description::{Description, Link, Role, Value};
use crate::exchange::losses::Losses;
use crate::exchange::report::Report;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The head of a small file, with the features Length, Date and note.
pub const HEAD: &str = "CODE :\tFORM-A\t\n\nCLASSES :\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n\
    $\t0\tFREE\tFREE\tIMPLICIT\nP \t1\tFREE\tFREE\tEXPLICIT\nA\t2\tFREE\tFREE\tEXPLICIT\nI\t3\tFREE\tFREE\tEXPLICIT\n\n\
    DESCRIPTION :\nLEFT\tRIGHT\tRELTYPE\tMAX\n\nFEATURES:\nNAME\tTYPE\nAlias\tALPHA\nLength\tREAL\nDate\tDD/MM/YY\nnote\tALPHA\n\n\
    MTG :\n\nENTITY-CODE\t\t\tAlias\tLength\tDate\tnote\n";

pub fn read(text: &str) -> (Description, Report) {
    read_bytes(text.as_bytes(), Some(Units::default()))
}

pub fn read_bytes(bytes: &[u8], units: Option<Units>) -> (Description, Report) {
    let mut report = Report::new("plant.mtg");
    let beside = |name: &str| Err(std::io::Error::new(std::io::ErrorKind::NotFound, name.to_owned()));
    let description = Mtg.read(&Incoming { name: "plant.mtg", bytes, units, beside: &beside }, &mut report);
    (description, report)
}

pub fn small(rows: &str) -> (Description, Report) {
    read(&format!("{HEAD}{rows}"))
}

fn written(description: &Description) -> (String, Losses) {
    let (mut out, mut losses) = (InMemory::default(), Losses::default());
    Mtg.write(description, &mut out, &mut losses).unwrap();
    (String::from_utf8(out.main).unwrap(), losses)
}

fn whole(rows: &str) -> Description {
    let (description, report) = small(rows);
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    description
}

/// Class, index, bearer, link and complex of each entity of the first plant.
fn topology(description: &Description) -> Vec<String> {
    let individual = &description.individuals[0];
    let name = |place: u32| {
        let entity = &individual.entities[place as usize];
        format!("{}{}", description.class_of(entity).symbol, entity.index.unwrap_or_default())
    };
    let line = |(place, entity): (usize, &crate::exchange::Entity)| {
        let sign = match entity.link {
            Some(Link::Follows) => "<",
            Some(Link::Branches) => "+",
            None => "",
        };
        let of = |place: Option<u32>| place.map(name).unwrap_or_default();
        format!("{}{sign}{} in {}", name(place as u32), of(entity.bearer), of(entity.complex))
    };
    individual.entities.iter().enumerate().map(line).collect()
}

#[test]
fn codes_go_on_from_what_stands_above() {
    let plant = whole("/P1\n^/A1\n^/I1<I2\n\t+A2/I1\n\t^<I2\n^<I3\n\t+A3\n");
    let expected =
        ["P1 in ", "A1 in P1", "I1 in A1", "I2<I1 in A1", "A2+I2 in P1", "I1 in A2", "I2<I1 in A2", "I3<I2 in A1"];
    assert_eq!(topology(&plant)[..8], expected);
    assert_eq!(topology(&plant)[8], "A3+I3 in P1");
    let first = &plant.individuals[0];
    assert_eq!(first.bearer_of(5), Some((3, Link::Branches)), "the first internode springs from where its axis does");
}

#[test]
fn ranges_give_their_values_to_the_last_or_to_each() {
    let plant = whole("/P1/A1/I1<<I4\t\t\t\t2.5\n^<I5<.<I7\t\t\t\t3\n");
    let lengths: Vec<_> =
        plant.individuals[0].entities.iter().map(|e| e.latest().and_then(|seen| seen.length)).collect();
    assert_eq!(lengths, [None, None, None, None, None, Some(2.5), Some(3.0), Some(3.0), Some(3.0)]);
    let borne = whole("/P1/A1++A3\n");
    assert_eq!(topology(&borne)[2..], ["A2+A1 in P1", "A3+A2 in P1"]);
}

#[test]
fn aliases_comments_missing_and_decimal_indices_and_line_ends() {
    let text = format!("{HEAD}# a comment\n/P\t\t\ttop # not this\t\t\t\r\n/A1.5/I1# nothing\t\t\t\t0.5\n")
        .replace("/A1.5", "(top)/A1.5");
    let (plant, report) = read(&text);
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    let entities = &plant.individuals[0].entities;
    assert_eq!(entities.iter().map(|entity| entity.index).collect::<Vec<_>>(), [None, Some(1.5), Some(1.0)]);
    assert_eq!(entities[2].latest().and_then(|seen| seen.length), Some(0.5));
}

#[test]
fn several_plants_and_several_dates() {
    let text = "/P1\t\t\t\t\t01/02/2003\n*\t\t\t\t\t05/02/2003\n^/A1\n/P2\n^/A1/I1\t\t\t\t1\t01/02/2003\ta b\n*\t\t\t\t2\t09/02/2003\n";
    let plants = whole(text);
    assert_eq!(plants.individuals.len(), 2);
    let dates: Vec<String> =
        plants.individuals[0].entities[0].observations.iter().map(|seen| seen.date.unwrap().to_string()).collect();
    assert_eq!(dates, ["2003-02-01", "2003-02-05"]);
    let seen = &plants.individuals[1].entities[2].observations;
    assert_eq!(seen.iter().map(|seen| seen.length).collect::<Vec<_>>(), [Some(1.0), Some(2.0)]);
    let (again, losses) = written(&plants);
    assert_eq!(losses.told()[0].what, "signs in texts");
    let (read_again, report) = read(&again);
    assert!(report.faults().is_empty(), "{again}\n{:?}", report.faults());
    assert_eq!(read_again.individuals[0], plants.individuals[0]);
    assert_eq!(read_again.individuals[1].entities[2].observations[1], seen[1]);
    assert_eq!(written(&read_again).0, again);
}

#[test]
fn a_root_that_is_not_declared_is_the_file_and_scales_may_leap() {
    let plant = whole("/Scene0\n^/P1\n^/I1\n\t+A1/I1\n");
    assert_eq!(plant.individuals.len(), 1);
    assert_eq!(topology(&plant), ["P1 in ", "I1 in P1", "A1+I1 in P1", "I1 in A1"]);
    // MultiScaleTreeGraph.jl has files whose root stands in one code with the plant.
    let in_one_line = whole("/Scene0/P1/A1\n^/I1\n\t+I2\n");
    assert_eq!(topology(&in_one_line), ["P1 in ", "A1 in P1", "I1 in A1", "I2+I1 in A1"]);
}

#[test]
fn a_line_that_begins_as_a_comment_is_one() {
    let plant = whole("/P1/A1\n#ENTITY-CODE\t\t\tLength\n#/P2/A1\t\t\t10.\t5.9\n^/I1\n");
    assert_eq!(topology(&plant), ["P1 in ", "A1 in P1", "I1 in A1"]);
}

/// A file of openalea.mtg has a forest of plants `N1`, `^<N2`, `^<N3`.
#[test]
fn plants_that_hang_on_one_another_are_plants() {
    let (plants, report) = read(&format!("{HEAD}/P1\n\t/A1\n^<P2\n\t/A1/I1\n^+P3/A1\n"));
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    let counts: Vec<usize> = plants.individuals.iter().map(|plant| plant.entities.len()).collect();
    assert_eq!(counts, [2, 3, 2]);
    let told: Vec<String> = report.warnings().iter().map(ToString::to_string).collect();
    assert!(told.iter().any(|line| line.contains("`P2` hangs on another plant")), "{told:?}");
}

/// A file of MultiScaleTreeGraph.jl has two branches `A2a` and `A2b` on one segment.
#[test]
fn letters_behind_an_index_are_left_out_and_told() {
    let (plant, report) = read(&format!("{HEAD}/P1/A1\n\t+A2a\n\t+A2b\n"));
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    let indices: Vec<_> = plant.individuals[0].entities.iter().map(|entity| entity.index).collect();
    assert_eq!(indices, [Some(1.0), Some(1.0), Some(2.0), Some(2.0)]);
    let told: Vec<String> = report.warnings().iter().map(ToString::to_string).collect();
    assert!(
        told.iter().any(|line| line.contains("24:3: the letters behind the index of `A2a` are left out")),
        "{told:?}"
    );
}

#[test]
fn a_plant_of_a_finer_scale_is_told() {
    let (plants, report) = read(&format!("{HEAD}/P1/A1\n/I1<I2\n/P2\n"));
    assert_eq!(plants.individuals.len(), 3);
    let told: Vec<String> = report.warnings().iter().map(ToString::to_string).collect();
    assert!(told.iter().any(|line| line.contains("`I1` is read as a plant")), "{told:?}");
    assert_eq!(told.iter().filter(|line| line.contains("is read as a plant")).count(), 1, "{told:?}");
}

#[test]
fn bytes_that_are_not_utf_8_are_latin_1() {
    let mut bytes = format!("{HEAD}/P1/A1\t\t\t\t\t\tann").into_bytes();
    bytes.extend([0xe9, b'e', b'\n']);
    let (plant, report) = read_bytes(&bytes, None);
    assert!(report.faults().is_empty());
    let seen = plant.individuals[0].entities[1].latest().unwrap();
    assert_eq!(seen.values, [(0, Value::Text("ann\u{e9}e".into()))]);
    let warned: Vec<&str> = report.warnings().iter().map(|warning| warning.text.as_str()).collect();
    assert!(warned[0].contains("Latin-1") && warned[1].contains("no unit"), "{warned:?}");
}

#[test]
fn points_of_digitised_plants_are_ends() {
    let head = HEAD.replace("note\tALPHA", "XX\tREAL\nYY\tREAL\nZZ\tREAL").replace("\tnote\n", "\tXX\tYY\tZZ\n");
    let rows = "/P1\n^/A1\t\t\t\t\t\t0\t0\t1\n^/I1\t\t\t\t\t\t0\t0\t3\n^<I2\n^<I3\t\t\t\t\t\t0\t4\t3\n\t+A2\t\t\t\t\t0\t5\t3\n\t^/I1\t\t\t\t\t0\t5\t3\n";
    let (plant, report) = read(&format!("{head}{rows}"));
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    let entities = &plant.individuals[0].entities;
    let pose = |place: usize| entities[place].latest().map(|seen| (seen.place, seen.direction, seen.length));
    assert_eq!(pose(2), Some((Some([0.0, 0.0, 1.0]), Some([0.0, 0.0, 1.0]), Some(2.0))));
    assert_eq!(pose(3), None, "nothing is told of it");
    assert_eq!(pose(4), Some((Some([0.0, 0.0, 3.0]), Some([0.0, 1.0, 0.0]), Some(4.0))));
    assert_eq!(
        pose(6),
        Some((Some([0.0, 4.0, 3.0]), Some([0.0, 1.0, 0.0]), Some(1.0))),
        "the point of its axis is its own"
    );
}

#[test]
fn names_and_texts_that_readers_trip_over_are_changed() {
    let (plant, report) =
        read(&HEAD.replace("note", "component_id").replace("MTG :", "MTG:").replacen("\n\nENTITY", "\nENTITY", 1));
    assert_eq!(report.faults().len(), 1, "no entity: {:?}", report.faults());
    assert!(plant.individuals.is_empty());
    let text = format!("{}/P1/A1\t\t\t\t\t\t1e+05/a(b\n", HEAD.replace("note", "component_id"));
    let (plant, _) = read(&text);
    let (again, losses) = written(&plant);
    assert!(again.contains("component_id_\tALPHA") && again.contains("1e_05_a_b"), "{again}");
    assert_eq!(losses.told().len(), 2, "{losses:?}");
    assert!(!again.contains("\n\n"));
}

/// The folder of measured plants beside the project; `None` where it is not there.
pub fn measured() -> Option<PathBuf> {
    let data = match std::env::var_os("PHYTOMER_DATA") {
        Some(data) if data == "none" => return None,
        Some(data) => PathBuf::from(data),
        None => PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data")),
    };
    let folder = [data.clone(), PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data"))];
    folder.into_iter().map(|data| data.join("exchange")).find(|folder| folder.is_dir())
}

/// The names of the files of the table of the oracle, which are those of openalea.mtg, and their names here.
const FILES: [(&str, &str); 5] = [
    ("agraf.mtg", "agraf.mtg"),
    ("noylum2.mtg", "walnut_noylum2.mtg"),
    ("wij10.mtg", "apple_wijcik_hybrids_wij10.mtg"),
    ("mtg_dynamic.mtg", "mtg_dynamic.mtg"),
    ("boutdenoylum2.mtg", "boutdenoylum2.mtg"),
];

#[test]
fn measured_plants_have_the_vertices_that_another_reader_finds() {
    let Some(folder) = measured() else {
        assert!(std::env::var_os("CI").is_none() || std::env::var_os("PHYTOMER_DATA").is_some(), "no measured data");
        return eprintln!("skipped: no measured data");
    };
    let table = std::fs::read_to_string(folder.join("mtg_oracle.tsv")).unwrap();
    for (listed, file) in FILES {
        let row = table.lines().map(|line| line.split('\t').collect::<Vec<_>>()).find(|row| row[0] == listed).unwrap();
        let (plants, report) = read_bytes(&std::fs::read(folder.join(file)).unwrap(), None);
        assert!(report.faults().is_empty(), "{file}: {:?}", report.faults());
        let (mut scales, mut classes) = (BTreeMap::new(), BTreeMap::new());
        for entity in plants.individuals.iter().flat_map(|individual| &individual.entities) {
            let class = plants.class_of(entity);
            *scales.entry(class.scale).or_insert(0_u32) += 1;
            *classes.entry(class.symbol.as_str()).or_insert(0_u32) += 1;
        }
        // The oracle counts its root, which no file has, among the vertices alone.
        assert_eq!(row[3].parse(), Ok(plants.entities() + 1), "{file}");
        assert_eq!(row[4], format!("{scales:?}"), "{file}");
        let told = row[5].trim_matches(['{', '}']).split(", ").map(|pair| pair.split_once(": ").unwrap());
        let told: BTreeMap<&str, u32> =
            told.map(|(symbol, count)| (symbol.trim_matches('\''), count.parse().unwrap())).collect();
        assert_eq!(classes, told, "{file}");
        let (again, _) = written(&plants);
        let (read_again, report) = read(&again);
        assert!(report.faults().is_empty(), "{file}: {:?}", report.faults());
        assert_eq!(read_again.entities(), plants.entities(), "{file}");
        assert_eq!(written(&read_again).0, again, "{file}: the second trip gives other bytes");
    }
}

#[test]
fn the_measured_coffee_tree_has_its_axes_metamers_and_leaves() {
    let Some(folder) = measured() else { return eprintln!("skipped: no measured data") };
    let (plants, report) = read_bytes(&std::fs::read(folder.join("coffee.mtg")).unwrap(), None);
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    let entities = &plants.individuals[0].entities;
    let of = |role: Role| entities.iter().filter(|entity| plants.role_of(entity) == role).count();
    assert_eq!([Role::Axis, Role::Internode, Role::Leaf].map(of), [158, 1853, 2179]);
    let sum = |of: fn(&crate::exchange::Observation) -> Option<f64>| -> f64 {
        entities.iter().filter_map(|entity| of(entity.latest()?)).sum()
    };
    let (areas, lengths) = (sum(|seen| seen.area), sum(|seen| seen.length));
    assert!((areas - 77_961.477).abs() < 0.001, "{areas}");
    assert!((lengths - 43_020.86).abs() < 0.01, "{lengths}");
}
