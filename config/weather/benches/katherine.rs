//! Forty years of a station, read in each format, beside the splitting of the same lines at their blanks.
//!
//! The days are made here, as long as those of a DSSAT file of Katherine. The bar is .2 of the speed of splitting: a
//! reader that checks every value may take five times as long as one that looks at none (`splitting` over `reading`).

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use phytomer_weather::{Asked, read};
use std::fmt::Write as _;
use std::hint::black_box;

const YEARS: i32 = 40;

/// A file of a name: what stands above the rows, and how a row is written.
type File = (&'static str, &'static str, fn(&mut String, i32, u32, [f64; 4]));

const FILES: [File; 3] = [
    (
        "katherine.WTH",
        "*WEATHER : Katherine\n@DATE  SRAD  TMAX  TMIN  RAIN\n",
        |text, year, day, [sun, most, least, rain]| {
            let _ = writeln!(text, "{:02}{day:03}{sun:6.1}{most:6.1}{least:6.1}{rain:6.1}", year % 100);
        },
    ),
    (
        "katherine.met",
        "[weather]\nyear day radn maxt mint rain\n() () () () () ()\n",
        |text, year, day, [sun, most, least, rain]| {
            let _ = writeln!(text, "{year} {day} {sun:.1} {most:.1} {least:.1} {rain:.1}");
        },
    ),
    ("katherine.csv", "YEAR,DOY,SRAD,TMAX,TMIN,RAIN\n", |text, year, day, [sun, most, least, rain]| {
        let _ = writeln!(text, "{year},{day},{sun:.1},{most:.1},{least:.1},{rain:.1}");
    }),
];

fn text((_, head, row): &File) -> String {
    let mut text = (*head).to_owned();
    for year in 1970..1970 + YEARS {
        let days = 365 + u32::from(year % 4 == 0);
        for day in 1..=days {
            let draw = f64::from((day * 7919 + year as u32 * 104_729) % 997) / 99.7;
            row(&mut text, year, day, [15.0 + draw, 28.0 + draw, 12.0 + draw, if day % 3 == 0 { draw } else { 0.0 }]);
        }
    }
    text
}

fn katherine(criterion: &mut Criterion) {
    for file in &FILES {
        let (name, text) = (file.0, text(file));
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Bytes(text.len() as u64));
        let separator = if name.ends_with("csv") { ',' } else { ' ' };
        group.bench_function("splitting", |bencher| {
            bencher.iter(|| {
                let cells = |line: &str| line.split(separator).filter(|cell| !cell.is_empty()).count();
                black_box(&text).lines().map(cells).sum::<usize>()
            });
        });
        group.bench_function("reading", |bencher| {
            bencher.iter(|| read(name, black_box(text.as_bytes()), &Asked::default()).expect("weather"));
        });
        group.finish();
    }
}

criterion_group!(benches, katherine);
criterion_main!(benches);
