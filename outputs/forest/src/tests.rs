//! Rasters read from bytes that are written here by hand, plants against their expectation, and the table read back.

use crate::{Count, Cover, Georeference, Heights, Instance, Planting, What, Where, write_instances};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::Write as _;

const PLACE: Georeference = Georeference { cell_m: 2.0, west_m: 100.0, south_m: 50.0 };

fn png(columns: u32, cells: &[u16], depth: png::BitDepth) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, columns, cells.len() as u32 / columns);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(depth);
    let wide: Vec<u8> = cells.iter().flat_map(|cell| cell.to_be_bytes()).collect();
    let narrow: Vec<u8> = cells.iter().map(|cell| *cell as u8).collect();
    let data = if depth == png::BitDepth::Sixteen { wide } else { narrow };
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
    bytes
}

fn pgm(columns: u32, cells: &[u16]) -> Vec<u8> {
    let mut bytes = format!("P5\n# a comment\n{columns} {}\n65535\n", cells.len() as u32 / columns).into_bytes();
    bytes.extend(cells.iter().flat_map(|cell| cell.to_be_bytes()));
    bytes
}

fn ascii(columns: u32, cells: &[u16]) -> Vec<u8> {
    let rows = cells.len() as u32 / columns;
    let mut text = format!("ncols {columns}\nnrows {rows}\nxllcorner 100\nyllcenter 51\ncellsize 2\nNODATA_value -1\n");
    for row in cells.chunks(columns as usize) {
        row.iter().for_each(|cell| _ = write!(text, "{cell} "));
        text.push('\n');
    }
    text.into_bytes()
}

/// Six cells, one of them without anything.
const CELLS: [u16; 6] = [1, 0x8001, 2, 0, 0x4002, 0xffff];

fn all(planting: &Planting, cover: &Cover, heights: Option<&Heights>) -> Vec<Instance> {
    let mut found = Vec::new();
    let keep = |instance| {
        found.push(instance);
        Ok::<(), ()>(())
    };
    planting.each(cover, heights, keep).unwrap();
    found
}

fn planting(what: What, count: Count) -> Planting {
    Planting { what, count, variants: 3, scale: [0.8, 1.2], seed: 5 }
}

#[test]
fn three_formats_tell_one_raster() {
    let read = |bytes: Vec<u8>| Cover::read(&bytes, Some(PLACE)).unwrap();
    let from_png = read(png(3, &CELLS, png::BitDepth::Sixteen));
    assert_eq!(from_png, read(pgm(3, &CELLS)));
    assert_eq!(from_png, Cover::read(&ascii(3, &CELLS), None).unwrap());
    let plain = format!("P2 3 2 65535 {}", CELLS.map(|cell| cell.to_string()).join(" "));
    assert_eq!(from_png, read(plain.into_bytes()));
    assert_eq!((from_png.size(), from_png.far_edges()), ([3, 2], [106.0, 54.0]));
}

#[test]
fn bits_say_what_stands_where() {
    let stands = |what: What| CELLS.map(|cell| what.stands_in(cell));
    assert_eq!(stands(What::Tree(0)), [true, true, false, false, false, true]);
    assert_eq!(stands(What::Tree(13)), [false, false, false, false, false, true]);
    assert_eq!(stands(What::Grass(1)), [false, false, false, false, true, false]);
    assert_eq!(stands(What::Grass(2)), [false, true, false, false, false, false]);
    assert_eq!(stands(What::Grass(3)), [false, false, false, false, false, true]);
}

#[test]
fn one_a_cell_stands_in_its_cell() {
    let cover = Cover::read(&pgm(3, &CELLS), Some(PLACE)).unwrap();
    let found = all(&planting(What::Tree(0), Count::One), &cover, None);
    let corners = [[100.0, 52.0], [102.0, 52.0], [104.0, 50.0]];
    assert_eq!(found.len(), corners.len());
    for (instance, corner) in found.iter().zip(corners) {
        for (place, corner) in instance.place_m.iter().zip(corner) {
            assert!((corner..=corner + 2.0).contains(place), "{instance:?}");
        }
        assert!(instance.variant < 3 && (0.8..=1.2).contains(&instance.scale), "{instance:?}");
        assert!((0.0..=TAU).contains(&instance.turn_rad));
    }
}

/// Numbers, variants, places and turns against their means, within five standard errors of a uniform draw.
#[test]
fn densities_are_met_in_the_mean() {
    let cover = Cover::read(&pgm(100, &[4; 10_000]), Some(PLACE)).unwrap();
    // 0.3 a cell of 4 m²: the number is that of 10,000 draws, each 0 or 1.
    let found = all(&planting(What::Tree(2), Count::PerSquareMetre(0.075)), &cover, None);
    let error = (10_000.0 * 0.3 * 0.7_f64).sqrt();
    assert!((found.len() as f64 - 3000.0).abs() < 5.0 * error, "{}", found.len());
    let count = found.len() as f64;
    let near = |of: &dyn Fn(&Instance) -> f64, mean: f64, variance: f64| {
        let told = found.iter().map(of).sum::<f64>() / count;
        assert!((told - mean).abs() < 5.0 * (variance / count).sqrt(), "{told} for {mean}");
    };
    near(&|plant| f64::from(plant.variant), 1.0, 2.0 / 3.0);
    near(&|plant| plant.place_m[0], 200.0, 200.0 * 200.0 / 12.0);
    near(&|plant| plant.place_m[1], 150.0, 200.0 * 200.0 / 12.0);
    near(&|plant| plant.turn_rad, std::f64::consts::PI, TAU * TAU / 12.0);
    near(&|plant| plant.scale, 1.0, 0.16 / 12.0);
    // Whole numbers of plants a cell are met exactly.
    assert_eq!(all(&planting(What::Tree(2), Count::PerSquareMetre(0.5)), &cover, None).len(), 20_000);
}

#[test]
fn a_changed_cell_changes_its_own_plants_alone() {
    let cells = [1_u16; 400];
    let mut changed = cells;
    changed[137] = 2;
    changed[200] = 3;
    let of = |cells: &[u16], what| {
        let cover = Cover::read(&pgm(20, cells), Some(PLACE)).unwrap();
        all(&planting(what, Count::PerSquareMetre(0.6)), &cover, None)
    };
    let (before, after) = (of(&cells, What::Tree(0)), of(&changed, What::Tree(0)));
    let gone: Vec<&Instance> = before.iter().filter(|plant| !after.contains(plant)).collect();
    assert!(after.iter().all(|plant| before.contains(plant)) && (2..=3).contains(&gone.len()), "{gone:?}");
    // Cell 137 is that of row 6 and column 17.
    assert!(gone.iter().all(|plant| (134.0..=136.0).contains(&plant.place_m[0])));
    assert!(gone.iter().all(|plant| (76.0..=78.0).contains(&plant.place_m[1])));
    assert!(!of(&changed, What::Tree(1)).is_empty());
}

#[test]
fn heights_are_bilinear_between_the_middles_of_cells() {
    let heights = Heights::read(&pgm(3, &[0, 10, 20, 30, 40, 50]), Some(PLACE), 0.5, 7.0).unwrap();
    // z = 7 + 0.5 (5 (x − 101) + 15 (53 − y)) is linear, and bilinear interpolation is exact for it.
    for (x, y) in [(101.0, 53.0), (103.0, 51.0), (102.2, 52.9), (104.9, 51.1), (101.5, 52.0)] {
        let expected = 7.0 + 0.5 * (5.0 * (x - 101.0) + 15.0 * (53.0 - y));
        assert!((heights.at(x, y) - expected).abs() < 1e-12, "{x} {y}: {}", heights.at(x, y));
    }
    // Beyond the middles of the last cells the height goes on level.
    assert_eq!([heights.at(0.0, 99.0), heights.at(200.0, 0.0)], [7.0, 32.0]);
    assert!(heights.covers([100.0, 50.0], [106.0, 54.0]) && !heights.covers([100.0, 50.0], [110.0, 54.0]));
    let one = Heights::read(&pgm(1, &[8]), Some(PLACE), 1.0, 0.0).unwrap();
    assert_eq!(one.at(3.0, 4.0), 8.0);
    let cover = Cover::read(&pgm(3, &CELLS), Some(PLACE)).unwrap();
    for plant in all(&planting(What::Tree(0), Count::One), &cover, Some(&heights)) {
        assert_eq!(plant.place_m[2], heights.at(plant.place_m[0], plant.place_m[1]));
    }
}

#[test]
fn what_is_no_raster_of_16_bits_is_told_with_its_place() {
    let good = ascii(3, &CELLS);
    let text = |from: &str, to: &str| String::from_utf8_lossy(&good).replace(from, to).into_bytes();
    let cut = |bytes: Vec<u8>, end: usize| bytes[..end].to_vec();
    let place = Some(PLACE);
    let bad = [
        (png(3, &CELLS, png::BitDepth::Eight), place, Where::Byte(24), "the cells have 8 bits"),
        (png(3, &CELLS, png::BitDepth::Sixteen), None, Where::Byte(0), "the raster has no scale"),
        (b"P5 3 2 255 abcdef".to_vec(), place, Where::Text(1, 8), "the cells have 8 bits: the greatest is 255"),
        (b"P2 3 2 65535 1 2 3 4 5 70000".to_vec(), place, Where::Text(1, 24), "`70000` stands for a cell"),
        (b"P5 0 2 65535 ".to_vec(), place, Where::Text(1, 4), "the raster has 0 columns and 2 rows"),
        (b"P5 4000000000 4000000000 65535 ".to_vec(), place, Where::Text(1, 4), "the raster has 4000000000 columns"),
        (cut(pgm(3, &CELLS), 30), place, Where::Byte(30), "the file is too short"),
        (text("cellsize 2\n", ""), place, Where::Text(6, 1), "the header has no `cellsize`"),
        (text("cellsize 2", "cellsize -2"), place, Where::Text(5, 10), "`cellsize` is -2"),
        (text("ncols 3", "ncols three"), place, Where::Text(1, 7), "`ncols` has no number"),
        (text("ncols 3", "ncols 30000"), place, Where::Text(7, 1), "the file is too short for 30000 × 2 cells"),
        (text("16386", "0.5"), place, Where::Text(8, 3), "`0.5` stands for a cell"),
        (text("65535", ""), place, Where::Text(9, 1), "the end of the file stands for a cell"),
        (text("65535", "65535 9"), place, Where::Text(8, 15), "`9` follows the last cell"),
        (Vec::new(), place, Where::Text(1, 1), "the header has no `ncols`"),
    ];
    for (bytes, place, at, problem) in bad {
        let fault = Cover::read(&bytes, place).expect_err(problem);
        assert!(fault.at == at && fault.problem.starts_with(problem), "{fault:?} for {at} {problem}");
    }
    let broken = cut(png(3, &CELLS, png::BitDepth::Sixteen), 50);
    assert!(Cover::read(&broken, place).unwrap_err().problem.starts_with("this PNG cannot be read"));
    let sea = Heights::read(&text("0 16386", "-1 16386"), None, 1.0, 0.0).unwrap_err();
    assert_eq!((sea.at, sea.expected.as_str()), (Where::Text(8, 1), "a height: plants may stand there"));
}

/// Every byte of a raster cut off, and many changed: a raster or a fault.
#[test]
fn broken_rasters_are_read_or_told() {
    let good = [png(3, &CELLS, png::BitDepth::Sixteen), pgm(3, &CELLS), ascii(3, &CELLS)];
    let mut state = 7_u64;
    for bytes in &good {
        for end in 0..bytes.len() {
            let _ = Cover::read(&bytes[..end], Some(PLACE));
            for _ in 0..20 {
                state = phytomer_sim::key::scramble(state);
                let mut changed = bytes.clone();
                changed[end] = state as u8;
                let _ = Cover::read(&changed, Some(PLACE)).map(|cover| cover.size());
            }
        }
    }
}

#[test]
fn the_table_has_a_row_for_each_plant() {
    use arrow_array::cast::AsArray;
    use arrow_array::types::{Float32Type, Float64Type, Int32Type};
    let cover = Cover::read(&pgm(300, &[1; 90_000]), Some(PLACE)).unwrap();
    let plantings =
        [("ash", planting(What::Tree(0), Count::PerSquareMetre(0.5))), ("none", planting(What::Tree(1), Count::One))];
    let mut file = Vec::new();
    let counts = write_instances(&cover, None, &plantings, "1", &mut file).unwrap();
    assert_eq!(counts, [180_000, 0]);
    let mut stored = tempfile::tempfile().unwrap();
    stored.write_all(&file).unwrap();
    let reader = parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder::try_new(stored);
    let mut rows = Vec::new();
    for batch in reader.unwrap().build().unwrap() {
        let batch = batch.unwrap();
        let species = batch.column(0).as_dictionary::<Int32Type>().downcast_dict::<arrow_array::StringArray>();
        assert!(species.unwrap().into_iter().all(|name| name == Some("ash")));
        let variants = batch.column(1).as_primitive::<Int32Type>();
        let doubles = [2, 3, 4].map(|column| batch.column(column).as_primitive::<Float64Type>());
        let singles = [5, 6].map(|column| batch.column(column).as_primitive::<Float32Type>());
        for row in 0..batch.num_rows() {
            let place_m = doubles.map(|column| column.value(row));
            rows.push((variants.value(row), place_m, singles.map(|column| column.value(row))));
        }
    }
    let expected = all(&plantings[0].1, &cover, None);
    let expected =
        expected.iter().map(|plant| (plant.variant as i32, plant.place_m, [plant.turn_rad as f32, plant.scale as f32]));
    assert!(rows.into_iter().eq(expected));
}
