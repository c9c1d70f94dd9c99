//! The crate `parquet` as the oracle: files of random columns, with its chunks and with ours, are the same bytes.

use super::*;
use crate::tables::buffers::lend;
use crate::tables::schema::{Named, Rounding, Type};
use crate::tables::{ROW_GROUP, arrow};
use ::arrow_schema::Schema;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::compute_leaves;
use std::sync::Arc;

/// Draws: SplitMix64 (Steele, Lea & Flood 2014).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit
    }
}

/// The shapes of columns: how values follow one another.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Constant,
    Climbing,
    Few,
    Runs,
    Any,
    Extreme,
}

const SHAPES: [Shape; 6] = [Shape::Constant, Shape::Climbing, Shape::Few, Shape::Runs, Shape::Any, Shape::Extreme];

/// Bits that a shape gives each row.
fn bits(shape: Shape, rows: usize, draw: &mut Draw) -> Vec<u64> {
    let mut run = draw.next();
    let extremes = [0, 1, u64::MAX, 1 << 31, (1 << 31) - 1, 1 << 63, (1 << 63) - 1, 0x7fc0_0001, 0xff80_0000, 1 << 30];
    let mut bit = |row: usize| match shape {
        Shape::Constant => 7,
        Shape::Climbing => row as u64 / 3 + draw.below(3),
        Shape::Few => draw.below(5) * 1_000_003,
        Shape::Runs => {
            if draw.below(40) == 0 {
                run = draw.below(1 << 20);
            }
            run
        }
        Shape::Any => draw.next(),
        Shape::Extreme => extremes[draw.below(extremes.len() as u64) as usize],
    };
    (0..rows).map(&mut bit).collect()
}

/// Which rows are null: a share in 256ths, alone or in runs.
fn nulls(rows: usize, share: u64, draw: &mut Draw) -> Vec<bool> {
    let mut null = false;
    let long = draw.below(2) == 0;
    let mut of = |_| {
        if !long || draw.below(50) == 0 {
            null = draw.below(256) < share;
        }
        null
    };
    (0..rows).map(&mut of).collect()
}

const WORDS: [&str; 5] = ["leaf", "flower", "leaf", "", "fruit"];

/// Values of a type, from bits, with nulls.
fn values(holds: Type, bits: &[u64], null: &[bool]) -> Values {
    let rows = || bits.iter().zip(null);
    let whole = |bits: u64| (bits as u32 & 0x7fff_ffff) as i32;
    let real = |bits: u64| f32::from_bits((bits >> 8) as u32 ^ bits as u32);
    let double = |bits: u64| f64::from_bits(bits.rotate_left(11));
    let word = |bits: u64| (bits % WORDS.len() as u64) as i8;
    match holds {
        Type::Bool => Values::Bool(rows().map(|(bits, null)| if *null { -1 } else { (bits & 1) as i8 }).collect()),
        Type::Int => Values::Int(rows().map(|(bits, null)| if *null { -1 } else { whole(*bits) }).collect()),
        Type::Key => Values::Key(bits.iter().map(|bits| *bits as i64).collect()),
        Type::Date => Values::Date(rows().map(|(bits, null)| if *null { NO_DATE } else { whole(*bits) }).collect()),
        Type::Float => Values::Float(rows().map(|(bits, null)| if *null { f32::NAN } else { real(*bits) }).collect()),
        Type::Double => {
            Values::Double(rows().map(|(bits, null)| if *null { f64::NAN } else { double(*bits) }).collect())
        }
        Type::Word(_) => Values::Word(rows().map(|(bits, null)| if *null { -1 } else { word(*bits) }).collect()),
        Type::Name(_) => {
            Values::Name(rows().map(|(bits, null)| if *null { -1 } else { i32::from(word(*bits)) }).collect())
        }
    }
}

/// A file of one column with these row groups; `own` says who encodes them. `None` where that is left to the crate.
fn file(column: &Column, groups: &[Values], own: bool) -> Option<Vec<u8>> {
    let schema = Arc::new(Schema::new(vec![arrow::field(column)]));
    let properties = arrow::encode(arrow::basis(3).expect("a level"), column).build();
    let writer = ArrowWriter::try_new(Vec::new(), schema.clone(), Some(properties)).expect("a file");
    let (mut file, factory) = writer.into_serialized_writer().expect("a file");
    let words = Arc::new(StringArray::from_iter_values(WORDS));
    let properties = file.properties().clone();
    let described = Described::of(column, file.schema_descr().column(0), properties, &words);
    for (number, values) in groups.iter().enumerate() {
        let mut group = file.next_row_group().expect("a group");
        if own {
            encode(values, &described).expect("an encoded column")?.append(&mut group).expect("room");
        } else {
            let mut writer = factory.create_column_writers(number).expect("writers").remove(0);
            let (array, _) = lend(copy(values), column, &words).expect("an array");
            for leaf in compute_leaves(&schema.fields()[0], &array).expect("a leaf") {
                writer.write(&leaf).expect("encoded");
            }
            writer.close().expect("a chunk").append_to_row_group(&mut group).expect("room");
        }
        group.close().expect("a whole group");
    }
    Some(file.into_inner().expect("a whole file"))
}

fn copy(values: &Values) -> Values {
    match values {
        Values::Date(values) => Values::Date(values.clone()),
        Values::Bool(values) => Values::Bool(values.clone()),
        Values::Int(values) => Values::Int(values.clone()),
        Values::Key(values) => Values::Key(values.clone()),
        Values::Float(values) => Values::Float(values.clone()),
        Values::Double(values) => Values::Double(values.clone()),
        Values::Word(values) => Values::Word(values.clone()),
        Values::Name(values) => Values::Name(values.clone()),
    }
}

fn column(holds: Type, encoding: Encoding, nullable: bool) -> Column {
    let mut column = Column::new("column", holds, encoding, "a column");
    (column.nullable, column.rounding) = (nullable, Rounding::Exact);
    column
}

const OF_NUMBERS: [Encoding; 4] = [Encoding::Plain, Encoding::Split, Encoding::Dictionary, Encoding::Repeated];

/// Each type with each encoding that it may have.
fn columns() -> Vec<(Type, Encoding)> {
    let whole = [Type::Int, Type::Key, Type::Date];
    let real = [Type::Float, Type::Double];
    let words = [Type::Word(&WORDS), Type::Name(Named::Treatment)];
    let mut all = vec![(Type::Bool, Encoding::Plain)];
    all.extend(whole.into_iter().chain(real).flat_map(|of| OF_NUMBERS.map(|encoding| (of, encoding))));
    all.extend(whole.map(|of| (of, Encoding::Delta)));
    all.extend(words.map(|of| (of, Encoding::Dictionary)));
    all
}

/// Row groups around the ends of groups of bits, blocks, batches and pages.
const ROWS: [usize; 14] = [1, 7, 8, 9, 129, 1_024, 1_025, 19_999, 20_000, 20_001, 20_480, 20_481, 45_000, ROW_GROUP];

/// Whether a file of such columns with our chunks has the bytes of one with the crate's.
fn compare((holds, encoding): (Type, Encoding), shape: Shape, nullable: bool, sizes: &[usize], draw: &mut Draw) {
    let column = column(holds, encoding, nullable && holds != Type::Key);
    let mut group = |rows: &usize| {
        let share = [0, 8, 128, 250, 256][draw.below(5) as usize];
        let null = nulls(*rows, if column.nullable { share } else { 0 }, draw);
        values(holds, &bits(shape, *rows, draw), &null)
    };
    let groups: Vec<Values> = sizes.iter().map(&mut group).collect();
    let own = file(&column, &groups, true).expect("nothing is left to the crate");
    let theirs = file(&column, &groups, false).expect("a file");
    let at = own.iter().zip(&theirs).position(|(own, theirs)| own != theirs);
    assert!(own == theirs, "{holds:?} {encoding:?} {shape:?} nullable {nullable}, {sizes:?} rows: at {at:?}");
}

#[test]
fn chunks_are_those_of_the_crate_byte_for_byte() {
    let mut draw = Draw(1988);
    for of in columns() {
        for (round, shape) in SHAPES.into_iter().cycle().take(2 * SHAPES.len()).enumerate() {
            let sizes = [ROWS[round % ROWS.len()], ROWS[(round * 5 + 3) % ROWS.len()]];
            compare(of, shape, round % 3 != 0, &sizes, &mut draw);
        }
    }
}

/// A number of the environment.
fn asked(name: &str, otherwise: u64) -> u64 {
    let asked = std::env::var(name).ok();
    asked.map_or(otherwise, |asked| asked.parse().unwrap_or_else(|_| panic!("{name} is a number, not {asked}")))
}

/// Small groups, drawn: 5,000 here, or as many as `PHYTOMER_CHUNKS` says, from the seed `PHYTOMER_CHUNKS_SEED`.
#[test]
fn chunks_of_drawn_groups_are_those_of_the_crate() {
    let (groups, seed) = (asked("PHYTOMER_CHUNKS", 5_000), asked("PHYTOMER_CHUNKS_SEED", 1989));
    let all = columns();
    let of_thread = |seed: u64| {
        let mut draw = Draw(seed);
        for _ in 0..groups.div_ceil(2) {
            let of = all[draw.below(all.len() as u64) as usize];
            let shape = SHAPES[draw.below(SHAPES.len() as u64) as usize];
            let most = [16, 300, 3_000][draw.below(3) as usize];
            let rows = 1 + draw.below(most) as usize;
            compare(of, shape, draw.below(2) == 0, &[rows], &mut draw);
        }
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(|| of_thread(seed.wrapping_add(1)));
        of_thread(seed);
        other.join().expect("no group differs");
    });
}

/// A word that is not in the list is for the crate, which refuses it; and so are words longer than statistics hold.
#[test]
fn what_the_crate_refuses_or_shortens_is_left_to_it() {
    let names = column(Type::Name(Named::Species), Encoding::Dictionary, true);
    assert!(file(&names, &[Values::Name(vec![0, -1, 5])], true).is_none());
    assert!(file(&names, &[Values::Name(vec![0, -1, 4])], true).is_some());
    let properties = Arc::new(arrow::encode(arrow::basis(3).expect("a level"), &names).build());
    let writer = ArrowWriter::try_new(Vec::new(), Arc::new(Schema::new(vec![arrow::field(&names)])), None);
    let (file, _) = writer.and_then(ArrowWriter::into_serialized_writer).expect("a file");
    let words = StringArray::from_iter_values(["a".repeat(65)]);
    let described = Described::of(&names, file.schema_descr().column(0), properties, &words);
    assert!(encode(&Values::Name(vec![0]), &described).expect("no fault").is_none());
}
