//! What survival costs beside reading its columns: the ratio of two times, by turns.
//!
//! ```sh
//! phytomer grow coffee --plants 1700 --out runs/axes
//! cargo run --release -p phytomer-analysis --example survival runs/axes
//! ```
//!
//! The baseline reads the columns that `bud-life` reads, batch by batch, and looks at nothing. Each turn does both; the
//! ratio is that of the medians, of processor time where Linux tells it. Absent: bounds, which depend on the machine.

use phytomer_analysis::measure::{Asked, MEASURES, measure};
use phytomer_outputs::Table;
use phytomer_outputs::read::Run;
use std::env;
use std::error::Error;
use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

const TURNS: usize = 9;

/// The columns of `components` that `bud-life` reads.
const COLUMNS: [&str; 6] = ["plot_id", "plant_id", "kind", "birth_age", "death_age", "cause_of_death"];

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = env::args().nth(1).ok_or("a run folder is expected")?.into();
    let card = MEASURES.iter().find(|card| card.name == "bud-life").ok_or("the measure bud-life")?;
    let run = Run::open(&folder)?;
    let (mut reading, mut measuring, mut rows, mut lives) = (Vec::new(), Vec::new(), 0, String::new());
    let begun = Instant::now();
    for _ in 0..TURNS {
        let start = spent(begun);
        rows = 0;
        for batch in run.batches_with(Table::Components, &COLUMNS)? {
            rows += black_box(batch?).num_rows();
        }
        reading.push(spent(begun) - start);
        let start = spent(begun);
        let measured = black_box(measure(&[&folder], card, &Asked::default())?);
        measuring.push(spent(begun) - start);
        lives = format!("{:?}", measured.sheets[1].rows[0][1]);
    }
    let [reading, measuring] = [reading, measuring].map(median);
    println!(
        "{rows} rows, {lives} buds: reading {reading:.3} s, survival {measuring:.3} s, ratio {:.2}",
        measuring / reading
    );
    Ok(())
}

/// The seconds that this thread has had a processor; by the clock where the system does not tell.
fn spent(begun: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let of_thread = told.as_deref().and_then(|told| told.split(' ').next()?.parse::<f64>().ok());
    of_thread.map_or_else(|| begun.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
