//! A landscape from a raster, from its file to the table, the meshes and the scene.
//!
//! The rasters are written here. Absent: where plants stand (`outputs/forest`), and what USD's own tools read of a
//! scene.

mod program;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int32Type};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use program::{Said, run, sha256};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::path::Path;
use tempfile::tempdir;

const SITE: &str = r#"
name = "hill"
seed = 3

[cover]
file = "cover.asc"

[elevation]
file = "height.asc"

[[tree]]
bit = 0
species = "coffee"
age = 12
variants = 2
scale = [0.8, 1.2]

[[tree]]
bit = 13
species = "bush.toml"
age = 5
variants = 1
trees_ha = 5000

[[grass]]
number = 2
species = "meadow_grass"
age = 20
variants = 1
tufts_m2 = 0.5
"#;

/// Ten by eight cells of 2 m, as an ASCII grid.
fn grid(cell: impl Fn(usize, usize) -> u32) -> String {
    let mut text = "ncols 10\nnrows 8\nxllcorner 500000\nyllcorner 200000\ncellsize 2\n".to_owned();
    for row in 0..8 {
        (0..10).for_each(|column| _ = write!(text, "{} ", cell(row, column)));
        text.push('\n');
    }
    text
}

/// What grows where: coffee to the west, bushes to the east, grass in the south.
fn cover(row: usize, column: usize) -> u32 {
    let tree = if column < 4 { 1 } else { 1 << 13 };
    tree | if row >= 6 { 2 << 14 } else { 0 }
}

fn lay(folder: &Path, site: &str, cover: &str) {
    fs::write(folder.join("site.toml"), site).unwrap();
    fs::write(folder.join("cover.asc"), cover).unwrap();
    fs::write(folder.join("height.asc"), grid(|row, _| 100 - 5 * row as u32)).unwrap();
    fs::write(folder.join("bush.toml"), "inherits = \"coffee\"\nname = \"bush\"\n").unwrap();
}

fn forest(folder: &Path, words: &[&str]) -> Said {
    run(folder, &[&["forest", "site.toml"], words].concat())
}

/// The rows of the table: species, variant and place.
fn rows(folder: &Path) -> Vec<(String, i32, [f64; 3])> {
    let file = File::open(folder.join("instances.parquet")).unwrap();
    let mut rows = Vec::new();
    for batch in ParquetRecordBatchReaderBuilder::try_new(file).unwrap().build().unwrap() {
        let batch = batch.unwrap();
        let column = |name: &str| batch.column_by_name(name).unwrap();
        let species = column("species").as_dictionary::<Int32Type>();
        let names = species.values().as_string::<i32>();
        let places = ["x_m", "y_m", "z_m"].map(|name| column(name).as_primitive::<Float64Type>());
        for row in 0..batch.num_rows() {
            let name = names.value(species.key(row).unwrap()).to_owned();
            let variant = column("variant").as_primitive::<Int32Type>().value(row);
            rows.push((name, variant, places.map(|place| place.value(row))));
        }
    }
    rows
}

#[test]
fn a_site_becomes_a_table_meshes_and_a_scene() {
    let folder = tempdir().unwrap();
    lay(folder.path(), SITE, &grid(cover));
    let json = forest(folder.path(), &["--json", "--tolerance", "1cm"]).ending(0).json();
    let hill = folder.path().join("hill");
    let rows = rows(&hill);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    rows.iter().for_each(|(species, _, _)| *counts.entry(species).or_default() += 1);
    // 8 rows of 4 cells with one, 48 cells of 4 m² with 5,000 a hectare, 20 cells with 0.5 a square metre.
    assert_eq!(counts, BTreeMap::from([("coffee", 32), ("bush", 96), ("meadow_grass", 40)]));
    for (species, _, [x, y, z]) in &rows {
        let (column, row) = (((x - 500_000.0) / 2.0) as usize, ((200_016.0 - y) / 2.0) as usize);
        assert_eq!(species == "coffee", column < 4 && species != "meadow_grass", "{species} at {x}, {y}");
        assert!(species != "meadow_grass" || row >= 6, "{species} at {x}, {y}");
        // The height falls by 5 m a row, from its middle to that of the next.
        let expected = (102.5 - 2.5 * (200_016.0 - y)).clamp(65.0, 100.0);
        assert!((z - expected).abs() < 1e-6, "{z} for {expected}");
    }
    let scene = fs::read_to_string(hill.join("scene.usda")).unwrap();
    assert_eq!(scene.matches("def PointInstancer").count(), 3);
    for species in json["species"].as_array().unwrap() {
        for file in species["variants"].as_array().unwrap() {
            let file = file.as_str().unwrap();
            assert!(scene.contains(&format!("@{file}@")), "{file}");
            let mesh = fs::read(hill.join(file)).unwrap();
            assert!(mesh.starts_with(b"PXR-USDC") && mesh.len() > 4000, "{file}: {} bytes", mesh.len());
        }
    }
    // Each list of an instancer has one value for each of its rows.
    let indices: Vec<usize> = scene
        .lines()
        .filter_map(|line| line.trim().strip_prefix("int[] protoIndices = "))
        .map(|list| list.split(", ").count())
        .collect();
    assert_eq!(indices, [32, 96, 40]);
}

#[test]
fn the_same_site_has_the_same_bytes_and_a_changed_cell_its_own_plants() {
    let folder = tempdir().unwrap();
    lay(folder.path(), SITE, &grid(cover));
    forest(folder.path(), &["--out", "a", "--tolerance", "1cm"]).ending(0);
    forest(folder.path(), &["--out", "b", "--tolerance", "1cm"]).ending(0);
    for file in ["instances.parquet", "scene.usda", "meshes/tree_0_coffee_1.usdc", "meshes/tree_13_bush_0.usdc"] {
        let hash = |of: &str| sha256(&folder.path().join(of).join(file));
        assert_eq!(hash("a"), hash("b"), "{file}");
    }
    lay(folder.path(), SITE, &grid(|row, column| if (row, column) == (3, 2) { 0 } else { cover(row, column) }));
    forest(folder.path(), &["--out", "b", "--overwrite", "--tolerance", "1cm"]).ending(0);
    let (before, after) = (rows(&folder.path().join("a")), rows(&folder.path().join("b")));
    let gone: Vec<_> = before.iter().filter(|row| !after.contains(row)).collect();
    assert_eq!((gone.len(), after.len() + 1), (1, before.len()), "{gone:?}");
    let refused = forest(folder.path(), &["--out", "b"]).ending(2);
    assert!(refused.stderr.contains("b has a forest already"), "{}", refused.stderr);
}

#[test]
fn what_is_wrong_is_told_at_its_place_and_writes_nothing() {
    let folder = tempdir().unwrap();
    let good = grid(cover);
    let narrow = "P5 2 2 255\nabcd";
    let bare = "P5 2 2 65535\nabcdefgh";
    let cases = [
        (SITE.to_owned(), narrow, "cover.asc, line 1, column 8: the cells have 8 bits"),
        (SITE.to_owned(), bare, "cover.asc, byte 0: the raster has no scale"),
        (SITE.to_owned(), "ncols 3", "the header has no `nrows`"),
        (SITE.replace("cover.asc", "none.asc"), &good, "the raster `none.asc` cannot be read"),
        (SITE.replace("bit = 13", "bit = 14"), &good, "site.toml:19:7"),
        (SITE.replace("bit = 13", "bit = 0"), &good, "a second tree has the bit 0"),
        (SITE.replace("\"coffee\"", "\"cofee\""), &good, "coffee"),
        (SITE.replace("scale = [0.8, 1.2]", "scale = [2, 1]"), &good, "the least size is above the greatest"),
        (SITE.replace("tufts_m2", "tuft_m2"), &good, "tufts_m2"),
        ("name = \"a\"\ncover = { file = \"cover.asc\" }\n".to_owned(), &good, "the forest has no plants"),
    ];
    for (site, cover, told) in cases {
        lay(folder.path(), &site, cover);
        let said = forest(folder.path(), &[]).ending(3);
        assert!(said.stderr.contains(told), "{told}\n{}", said.stderr);
        assert!(!folder.path().join("hill").exists() && !folder.path().join("a").exists(), "{told}");
    }
    lay(folder.path(), SITE, &good);
    fs::write(folder.path().join("height.asc"), good.replace("ncols 10", "ncols 8").replace("nrows 8", "nrows 10"))
        .unwrap();
    let said = forest(folder.path(), &[]).ending(3);
    assert!(said.stderr.contains("does not reach over the whole cover"), "{}", said.stderr);
}
