//! A plant is computed relative to its own seed, and its place is added once, in double precision: a plant without
//! draws is the same to the bit at every place, in its records, its measures and its mesh, and the place adds up with
//! them.
//!
//! Single precision has steps of 8 mm 100 km from the origin and of 60 mm 1,000 km from it. These are the distances of
//! the last of ten thousand, and of a million, plants that stand a kilometre apart.

mod ply;
mod program;
mod read;

use ply::{count, mesh, place_in};
use program::{data, run};
use read::Columns;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The resolution of single precision in a plant of half a metre, with a few roundings on the way, metres.
const FLOAT: f64 = 5e-7;

/// Columns of the tables that identify a plant.
const OWN: [&str; 2] = ["plot_id", "plant_id"];

/// A scenario of a species by its path or name, its plants a kilometre apart, with a wind where the species bends.
fn scenario(folder: &Path, species: &str, plants: u32, more: &str) {
    let text = format!(
        "name = \"far\"\nspecies = \"{species}\"\nplants = {plants}\nspacing_m = 1000\n\
         ages = {{ until = 6, record = [3, 6] }}\n{more}\n"
    );
    fs::write(folder.join("far.toml"), text.replace('\\', "/")).unwrap();
}

const WIND: &str = "[site]\nwind = { speed_m_s = 3, towards_deg = 30 }";

/// Every number of each plant of a table, bit by bit, row after row; plants in their order.
fn by_plant(table: &Columns) -> BTreeMap<u32, Vec<u64>> {
    let columns: Vec<&[f64]> =
        table.names().filter(|name| !OWN.contains(name)).map(|name| table.numbers(name)).collect();
    let mut plants: BTreeMap<u32, Vec<u64>> = BTreeMap::new();
    for (row, plant) in table.numbers("plant_id").iter().enumerate() {
        let bits = columns.iter().map(|column| column[row].to_bits());
        plants.entry(*plant as u32).or_default().extend(bits);
    }
    plants
}

/// Every plant has the rows of the first.
fn assert_alike(table: &Columns, plants: u32, what: &str) {
    let all = by_plant(table);
    assert_eq!(all.len(), plants as usize, "{what}");
    let other = all.iter().find(|(_, bits)| **bits != all[&0]);
    assert!(other.is_none(), "{what}: plant {:?} differs from plant 0", other.map(|(plant, _)| plant));
}

/// Internodes and organs begin at the tip of the internode that bears them, at whatever place.
fn assert_joined(records: &Columns) {
    let number = |name: &str| records.numbers(name);
    let (plant, age, component, parent) =
        (number("plant_id"), number("age"), number("component_id"), number("parent_id"));
    let (length, base) = (number("length_m"), ["x_m", "y_m", "z_m"].map(number));
    let (dir, kind) = (["dir_x", "dir_y", "dir_z"].map(number), records.words("kind"));
    let mut tips = BTreeMap::new();
    let mut joints = 0;
    for row in 0..plant.len() {
        let of = |component: f64| [plant[row], age[row], component].map(|number| number as u32);
        let tip = [0, 1, 2].map(|k| base[k][row] + length[row] * dir[k][row]);
        tips.insert(of(component[row]), tip);
        if kind[row] == "apical_bud" || parent[row].is_nan() {
            continue;
        }
        let foot = tips[&of(parent[row])];
        let gap = (0..3).map(|k| (base[k][row] - foot[k]).abs()).fold(0.0, f64::max);
        assert!(gap <= FLOAT, "component {} of plant {} stands {gap} m off", component[row], plant[row]);
        joints += 1;
    }
    assert!(joints > plant.len() / 2);
}

#[test]
fn ten_thousand_plants_a_kilometre_apart_are_one_plant() {
    const PLANTS: u32 = 10_000;
    let folder = tempfile::tempdir().unwrap();
    scenario(folder.path(), &data("still.toml"), PLANTS, &format!("output = {{ mechanics = true }}\n{WIND}"));
    run(folder.path(), &["grow", "far.toml", "--quiet"]).ending(0);
    let table = |name: &str| Columns::of(&folder.path().join("runs/far"), name);
    let records = table("records");
    assert_joined(&records);
    for (name, rows) in [("records", &records), ("components", &table("components")), ("summary", &table("summary"))] {
        assert_alike(rows, PLANTS, name);
    }
    let widths: BTreeSet<u64> = table("summary").numbers("crown_width_m").iter().map(|width| width.to_bits()).collect();
    assert_eq!(widths.len(), 2, "one width an age");
    let bends = records.numbers("curvature_per_m").iter().any(|curvature| *curvature > 0.0);
    assert!(bends, "mechanics has had its say");
    // Each plant has a place of its own, exactly where the grid has one.
    let plants = table("plants");
    let places: Vec<[f64; 3]> =
        (0..PLANTS as usize).map(|row| ["x_m", "y_m", "z_m"].map(|axis| plants.numbers(axis)[row])).collect();
    assert!(places.iter().flatten().all(|x| x % 1000.0 == 0.0 && x.abs() <= 99_000.0));
    let apart: BTreeSet<[i64; 3]> = places.iter().map(|place| place.map(|x| x as i64)).collect();
    assert_eq!((apart.len(), plants.numbers("plant_id").len()), (PLANTS as usize, PLANTS as usize));
    assert_eq!(plants.numbers("plant_id")[9_999], 9_999.0);
    assert!(plants.words("species").iter().all(|species| species == "still"));
}

/// A plant without draws, for each of three models of pose: bent, at rest, and with stated headings.
#[test]
fn records_and_meshes_are_the_same_wherever_a_plant_stands() {
    const PLANTS: u32 = 12;
    for (species, wind) in [(data("still.toml"), WIND), ("example1".to_owned(), ""), ("gmt1/5a".to_owned(), "")] {
        let folder = tempfile::tempdir().unwrap();
        scenario(folder.path(), &species, PLANTS, &format!("{wind}\n[meshes]\nages = [6]\nplants = \"all\""));
        run(folder.path(), &["grow", "far.toml", "--quiet"]).ending(0);
        let home = folder.path().join("runs/far");
        assert_alike(&Columns::of(&home, "records"), PLANTS, &species);
        let places = Columns::of(&home, "plants");
        let (_, first) = mesh(&home.join("meshes/plant-00000_age-0006.ply"));
        for plant in 0..PLANTS as usize {
            let (header, payload) = mesh(&home.join(format!("meshes/plant-{plant:05}_age-0006.ply")));
            assert!(payload == first, "{species}: the mesh of plant {plant} differs from that of plant 0");
            let place = ["x_m", "y_m", "z_m"].map(|axis| places.numbers(axis)[plant]);
            assert_eq!(place_in(&header), place, "{species}: the comment of plant {plant}");
        }
    }
}

#[test]
fn the_last_of_a_million_plants_has_the_mesh_of_the_first() {
    let folder = tempfile::tempdir().unwrap();
    scenario(folder.path(), &data("still.toml"), 1_000_000, WIND);
    let [(_, first), (header, last)] = ["0", "999999"].map(|plant| {
        run(folder.path(), &["mesh", "far.toml", "--plant", plant, "--age", "6", "--out", "one.ply"]).ending(0);
        mesh(&folder.path().join("one.ply"))
    });
    assert!(first == last, "to the bit");
    let far = place_in(&header);
    assert!(far[0].max(far[1]) >= 500_000.0, "it stands far away: {far:?}");
    let (vertices, faces) = (count(&header, "vertex"), count(&header, "face"));
    assert_eq!(last.len(), vertices * 49 + faces * 13);
    let position = |vertex: usize| [0, 1, 2].map(|k| float(&last[vertex * 49 + 4 * k..]));
    let flat = (0..faces).filter(|face| {
        let face = &last[vertices * 49 + face * 13 + 1..];
        let [a, b, c] = [0, 1, 2].map(|k| position(word(&face[4 * k..]) as usize));
        area(a, b, c) <= 0.0
    });
    assert_eq!((flat.count(), faces > 500), (0, true), "triangles without area, of {faces}");
}

#[test]
fn rounded_places_hold_their_precision_however_far_the_plant() {
    const PRECISION: f64 = 1e-4;
    let folder = tempfile::tempdir().unwrap();
    let [exact, rounded] = ["", "output = { float_precision_m = 1e-4 }"].map(|output| {
        scenario(folder.path(), &data("still.toml"), 400, output);
        run(folder.path(), &["grow", "far.toml", "--quiet", "--overwrite"]).ending(0);
        let home = folder.path().join("runs/far");
        (Columns::of(&home, "records"), Columns::of(&home, "plants"))
    });
    for axis in ["x_m", "y_m", "z_m"] {
        assert_eq!(exact.1.numbers(axis), rounded.1.numbers(axis), "a place is never rounded");
        let plants = exact.0.numbers("plant_id");
        let world = |(records, places): &(Columns, Columns), row: usize| {
            places.numbers(axis)[plants[row] as usize] + records.numbers(axis)[row]
        };
        let worst = (0..plants.len()).map(|row| (world(&exact, row) - world(&rounded, row)).abs()).fold(0.0, f64::max);
        // The sum in double precision has steps of 4·10⁻¹² m 20 km away.
        assert!(worst > 0.0 && worst <= PRECISION / 2.0 + 1e-11, "{axis}: {worst} m");
    }
}

/// `plants` and `treatments` are written beside any other table.
#[test]
fn places_go_with_every_table() {
    let folder = tempfile::tempdir().unwrap();
    for (tables, written) in [("[\"records\"]", 3), ("[\"plants\"]", 2), ("[]", 0)] {
        let meshes = "[meshes]\nages = \"last\"";
        scenario(folder.path(), "example1", 3, &format!("tables = {tables}\n{meshes}"));
        run(folder.path(), &["grow", "far.toml", "--quiet", "--overwrite"]).ending(0);
        let told = run(folder.path(), &["describe", "runs/far", "--json"]).ending(0).json();
        let tables = told["tables"].as_object().unwrap();
        assert_eq!((tables.len(), tables.contains_key("plants")), (written, written > 0), "{told}");
    }
}

fn word(bytes: &[u8]) -> u32 {
    u32::from_le_bytes(bytes[..4].try_into().expect("four bytes"))
}

fn float(bytes: &[u8]) -> f64 {
    f64::from(f32::from_bits(word(bytes)))
}

fn area(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let [u, v] = [b, c].map(|corner| [0, 1, 2].map(|k| corner[k] - a[k]));
    let across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    0.5 * across.iter().map(|x| x * x).sum::<f64>().sqrt()
}
