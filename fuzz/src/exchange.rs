//! Plants in files of other programs: read, and what was read is written in every format.
//!
//! Absent: the tables of a run, which `phytomer convert` makes of them.

use phytomer::outputs::exchange::{FORMATS, InMemory, Incoming, Losses, Report};

/// The plant that a scene finds beside it, under any name.
const BESIDE: &[u8] = include_bytes!("../seeds/plant.opf");

/// A file of plants. The first byte tells its format, by its place among all.
pub fn exchange(data: &[u8]) {
    let Some((&choice, bytes)) = data.split_first() else { return };
    let format = FORMATS[usize::from(choice) % FORMATS.len()];
    let mut report = Report::new("plant");
    let beside = |_: &str| Ok(BESIDE.to_vec());
    let plants = format.read(&Incoming { name: "plant", bytes, units: None, beside: &beside }, &mut report);
    if report.is_refused() {
        return assert!(report.faults().iter().all(|fault| !fault.problem.is_empty()));
    }
    for format in FORMATS.into_iter().filter(|format| format.writes()) {
        let mut out = InMemory { stem: "plant".to_owned(), ..InMemory::default() };
        format.write(&plants, &mut out, &mut Losses::default()).expect("memory does not fail");
    }
}
