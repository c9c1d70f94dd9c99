//! Meshes have the areas and volumes of the tables: over every shipped species the triangles of each kind of organ have
//! the area of its `area_m2`, and the tubes of internodes hold their `wood_volume_m3`, to 1 %.
//!
//! The areas are those of one side: of closed forms half the surface. Tables and meshes are read from the files of one
//! run. Absent: blades and internodes of other forms, which are drawn as sheets without volume.

#[path = "program/side_by_side.rs"]
mod side_by_side;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Int8Type, Int32Type};
use arrow_array::{Array, RecordBatch};
use phytomer::run::{Progress, Settings, run, seed_of};
use phytomer_config::scenario::{MeshAges, MeshFile, MeshPlants, Meshes, Record, Table};
use phytomer_config::{Kind, Resolved, presets, validate};
use phytomer_outputs::read::Run;
use phytomer_sim::{Ending, Plot, Tick, grow};
use side_by_side::each;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Larger plants are measured at an earlier age, at which they have at most so many components.
const MOST_COMPONENTS: u32 = 6_000;

/// Bytes of a vertex and of a triangle in a file, and the offset of the component's number in a vertex.
const VERTEX: usize = 49;
const FACE: usize = 13;
const COMPONENT: usize = 44;

type Point = [f64; 3];

/// The values that the table states of a component.
struct Stated {
    kind: String,
    area: Option<f64>,
    volume: Option<f64>,
}

/// The one plant of a species, grown to an age at which it is not too large.
fn plant_of(name: &str) -> Resolved {
    let mut resolved = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let last = resolved.species.about.shown_at.unwrap_or(resolved.scenario.ages.until);
    let ages = [1.0, 0.6, 0.35, 0.2, 0.12, 0.07].map(|share| (f64::from(last) * share).max(2.0) as Tick);
    let grows = |until: &Tick| {
        let model = resolved.species.model.compile(*until).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
        let mut seed = seed_of(&resolved.scenario, 0);
        seed.component_limit = MOST_COMPONENTS;
        let mut plot = Plot::of_one(model.as_ref(), &seed);
        let grown = grow(&mut plot, *until, &mut ());
        matches!(grown, Ok(Ending::Complete)).then_some((*until, model))
    };
    let (until, model) = ages.iter().find_map(grows).unwrap_or_else(|| panic!("{name} is too large at any age"));
    resolved.model = model;
    let scenario = &mut resolved.scenario;
    scenario.plants = 1;
    scenario.ages.until = until;
    scenario.ages.record = Record::List(BTreeSet::from([until]));
    scenario.tables = [Table::Records].into_iter().collect();
    let (ages, plants, per) = (MeshAges::default(), MeshPlants::default(), MeshFile::default());
    scenario.meshes = Some(Meshes { ages, plants, sides: 8, per });
    scenario.output.mechanics = true;
    resolved
}

fn stated(run: &Run) -> BTreeMap<i32, Stated> {
    let batches = run.batches(phytomer_outputs::Table::Records).expect("records");
    batches.map(|batch| batch.expect("rows")).flat_map(|batch| rows(&batch)).collect()
}

fn rows(batch: &RecordBatch) -> Vec<(i32, Stated)> {
    let column = |name: &str| batch.column_by_name(name).unwrap_or_else(|| panic!("no column {name}"));
    let kinds = column("kind").as_dictionary::<Int8Type>();
    let words = kinds.values().as_string::<i32>();
    let components = column("component_id").as_primitive::<Int32Type>();
    let number = |name: &str, row: usize| {
        let numbers = column(name).as_primitive::<Float32Type>();
        numbers.is_valid(row).then(|| f64::from(numbers.value(row)))
    };
    let row = |row: usize| {
        let kind = words.value(kinds.keys().value(row) as usize).to_owned();
        let (area, volume) = (number("area_m2", row), number("wood_volume_m3", row));
        (components.value(row), Stated { kind, area, volume })
    };
    (0..batch.num_rows()).map(row).collect()
}

/// The triangles of each component of a file. Those of a component follow one another.
fn drawn(file: &Path) -> BTreeMap<i32, Vec<[Point; 3]>> {
    let bytes = fs::read(file).expect("a mesh");
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|window| window == end).expect("a header") + end.len();
    let header = String::from_utf8_lossy(&bytes[..start]).into_owned();
    let count = |of: &str| {
        let line = header.lines().find_map(|line| line.strip_prefix(of)).expect("a count");
        line.trim().parse::<usize>().expect("a number")
    };
    let (vertices, faces) = bytes[start..].split_at(count("element vertex ") * VERTEX);
    let four = |of: &[u8], at: usize| [of[at], of[at + 1], of[at + 2], of[at + 3]];
    let single = |of: &[u8], at: usize| f64::from(f32::from_le_bytes(four(of, at)));
    let vertices: Vec<(Point, i32)> = (vertices.chunks_exact(VERTEX))
        .map(|of| ([single(of, 0), single(of, 4), single(of, 8)], i32::from_le_bytes(four(of, COMPONENT))))
        .collect();
    let faces = faces.chunks_exact(FACE).take(count("element face ")).map(|of| {
        let corner = |at: usize| vertices[i32::from_le_bytes(four(of, at)) as usize];
        (corner(1).1, [corner(1).0, corner(5).0, corner(9).0])
    });
    let faces: Vec<(i32, [Point; 3])> = faces.collect();
    let mut drawn: BTreeMap<i32, Vec<[Point; 3]>> = BTreeMap::new();
    for of_one in faces.chunk_by(|a, b| a.0 == b.0) {
        drawn.entry(of_one[0].0).or_default().extend(of_one.iter().map(|face| face.1));
    }
    drawn
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether triangles meet in pairs of either direction at every edge. Places are numbered in the order in which they
/// appear, so that edges are compared as numbers.
fn is_closed(triangles: &[[Point; 3]]) -> bool {
    let mut places: Vec<Point> = Vec::new();
    let mut number = |point: &Point| {
        let known =
            places.iter().position(|place| place[0] == point[0] && place[1] == point[1] && place[2] == point[2]);
        known.unwrap_or_else(|| {
            places.push(*point);
            places.len() - 1
        })
    };
    let mut edges: BTreeMap<(usize, usize), i32> = BTreeMap::new();
    for triangle in triangles {
        let corners = [number(&triangle[0]), number(&triangle[1]), number(&triangle[2])];
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            *edges.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    edges.values().all(|sum| *sum == 0)
}

fn one_side(triangles: &[[Point; 3]], closed: bool) -> f64 {
    let area = |[a, b, c]: &[Point; 3]| {
        let across = cross(minus(*b, *a), minus(*c, *a));
        0.5 * dot(across, across).sqrt()
    };
    let surface: f64 = triangles.iter().map(area).sum();
    if closed { 0.5 * surface } else { surface }
}

fn volume(triangles: &[[Point; 3]]) -> f64 {
    let origin = triangles[0][0];
    let cone = |triangle: &[Point; 3]| {
        let [a, b, c] = triangle.map(|point| minus(point, origin));
        dot(a, cross(b, c)) / 6.0
    };
    triangles.iter().map(cone).sum()
}

/// The drawn and the stated measures, by kind of component.
#[derive(Default)]
struct Sums {
    areas: BTreeMap<String, [f64; 2]>,
    volumes: BTreeMap<String, [f64; 2]>,
}

fn sums(folder: &Path) -> Sums {
    let run = Run::open(folder).expect("a run");
    let meshes: Vec<_> =
        fs::read_dir(folder.join("meshes")).expect("meshes").map(|file| file.expect("a file").path()).collect();
    let drawn = drawn(&meshes[0]);
    let mut sums = Sums::default();
    let add = |to: &mut BTreeMap<String, [f64; 2]>, kind: &str, found: f64, stated: f64| {
        let [sum, of_table] = to.entry(kind.to_owned()).or_default();
        *sum += found;
        *of_table += stated;
    };
    for (component, stated) in &stated(&run) {
        let triangles = drawn.get(component).map_or(&[][..], Vec::as_slice);
        let closed = is_closed(triangles);
        if let Some(area) = stated.area {
            add(&mut sums.areas, &stated.kind, one_side(triangles, closed), area);
        }
        if let Some(of_table) = stated.volume.filter(|_| closed && !triangles.is_empty()) {
            add(&mut sums.volumes, &stated.kind, volume(triangles), of_table);
        }
    }
    sums
}

#[test]
fn meshes_of_every_shipped_species_have_the_areas_and_the_volumes_of_the_tables() {
    let home = tempfile::tempdir().expect("a folder");
    let species: Vec<&str> = presets(Kind::Species).iter().map(|(name, _)| *name).collect();
    let measured = each(species, |name| {
        let folder = home.path().join(name.replace('/', "-"));
        run(&plant_of(name), &Settings::in_folder(&folder), &Progress::default())
            .unwrap_or_else(|error| panic!("{name}: {error:#}"));
        (name, sums(&folder))
    });
    let mut wrong = Vec::new();
    let mut kinds = BTreeSet::new();
    for (name, Sums { areas, volumes }) in measured {
        // Of the first L-system of Synthetic Topiary nothing is drawn: its modules are buds.
        assert!(!volumes.is_empty() || name == "topiary/1", "{name} has no wood");
        for (what, (kind, [drawn, stated])) in
            areas.iter().map(|of| ("area", of)).chain(volumes.iter().map(|of| ("volume", of)))
        {
            let ratio = drawn / stated;
            println!("{name}: {what} of {kind}: {ratio:.4} of {stated:.3e}");
            kinds.insert((what, kind.clone()));
            if (ratio - 1.0).abs() > 0.01 {
                wrong.push(format!("{name}: {what} of {kind}: {ratio:.4}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(kinds.contains(&("area", "leaf".to_owned())) && kinds.contains(&("volume", "internode".to_owned())));
}
