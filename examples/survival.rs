//! What survival costs beside reading its columns: the ratio of two times, by turns.
//!
//! ```sh
//! phytomer grow coffee --plants 1700 --out runs/axes
//! cargo run --release --example survival runs/axes
//! ```
//!
//! The baseline reads the columns that `bud-life` reads, batch by batch, and looks at nothing. Each turn does both; the
//! ratio is that of the medians. Absent: bounds, which depend on the machine.

use anyhow::{Context, Result};
use phytomer::analysis::measure::{Asked, MEASURES, measure};
use phytomer::outputs::Table;
use phytomer::outputs::read::Run;
use std::env;
use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

const TURNS: usize = 9;

/// The columns of `components` that `bud-life` reads.
const COLUMNS: [&str; 6] = ["plot_id", "plant_id", "kind", "birth_age", "death_age", "cause_of_death"];

fn main() -> Result<()> {
    let folder: PathBuf = env::args().nth(1).context("a run folder is expected")?.into();
    let card = MEASURES.iter().find(|card| card.name == "bud-life").context("the measure bud-life")?;
    let run = Run::open(&folder)?;
    let (mut reading, mut measuring, mut rows, mut lives) = (Vec::new(), Vec::new(), 0, String::new());
    for _ in 0..TURNS {
        let start = Instant::now();
        rows = 0;
        for batch in run.batches_with(Table::Components, &COLUMNS)? {
            rows += black_box(batch?).num_rows();
        }
        reading.push(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let measured = black_box(measure(&[&folder], card, &Asked::default())?);
        measuring.push(start.elapsed().as_secs_f64());
        lives = format!("{:?}", measured.sheets[1].rows[0][1]);
    }
    let [reading, measuring] = [reading, measuring].map(median);
    println!(
        "{rows} rows, {lives} buds: reading {reading:.3} s, survival {measuring:.3} s, ratio {:.2}",
        measuring / reading
    );
    Ok(())
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
