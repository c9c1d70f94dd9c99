//! How fast plants are read and written as files of other programs, beside a plain write of the same bytes.
//!
//! `cargo run --release -p phytomer-outputs --example exchange -- coffee.opf [TIMES]` reads a file of any format and
//! writes it as every one. Told are medians of alternating runs, in milliseconds.

use phytomer_outputs::exchange::{Description, FORMATS, InMemory, Incoming, Losses, Report, by_ending};
use std::path::Path;
use std::time::Instant;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(file) = arguments.first() else { return eprintln!("name a file of plants, and how often it is written") };
    let times = arguments.get(1).and_then(|times| times.parse().ok()).unwrap_or(11);
    let bytes = std::fs::read(file).expect("the file is read");
    let folder = Path::new(file).parent().unwrap_or(Path::new(""));
    let format = by_ending(Path::new(file).extension().and_then(|ending| ending.to_str()).unwrap_or_default());
    let format = format.first().expect("the ending tells a format");
    let beside = |name: &str| std::fs::read(folder.join(name));
    let incoming = Incoming { name: file, bytes: &bytes, units: None, beside: &beside };
    let mut plants = Description::default();
    let read = median(times, || plants = format.read(&incoming, &mut Report::new(file)));
    println!("read {}: {} entities, {read:.2} ms", format.word(), plants.entities());
    let plain = std::env::temp_dir().join(format!("phytomer-plain-{}", std::process::id()));
    for format in FORMATS.into_iter().filter(|format| format.writes()) {
        let mut out = InMemory::default();
        let (mut writing, mut copying) = (Vec::new(), Vec::new());
        for _ in 0..times {
            out = InMemory { stem: "plant".to_owned(), ..InMemory::default() };
            writing
                .push(once(|| format.write(&plants, &mut out, &mut Losses::default()).expect("memory does not fail")));
            let all: Vec<u8> = std::iter::once(&out.main).chain(out.beside.values()).flatten().copied().collect();
            copying.push(once(|| std::fs::write(&plain, &all).expect("the file is written")));
        }
        let size = out.main.len() + out.beside.values().map(Vec::len).sum::<usize>();
        let (writing, copying) = (middle(writing), middle(copying));
        let word = format.word();
        println!(
            "write {word}: {size} bytes, {writing:.2} ms; plain {copying:.2} ms: {:.2} of its speed",
            copying / writing
        );
    }
    let _ = std::fs::remove_file(plain);
}

fn once(act: impl FnOnce()) -> f64 {
    let start = Instant::now();
    act();
    start.elapsed().as_secs_f64() * 1e3
}

fn median(times: usize, mut act: impl FnMut()) -> f64 {
    middle((0..times).map(|_| once(&mut act)).collect())
}

fn middle(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}
