//! Two sides by turns: ratios of a pair of times each, of which the median holds on a machine that does other work too.
//!
//! Wall time, and the processor time of all threads where the system tells it (Linux). Absent: what the sides do.

use std::time::Instant;

/// Tells the medians of how many times as long `ours` takes as `theirs`, over so many pairs that are run by turns after
/// one of each that is not counted. `before` makes each side ready, and is not counted.
pub fn by_turns(name: &str, pairs: usize, mut before: impl FnMut(), mut ours: impl FnMut(), mut theirs: impl FnMut()) {
    let mut timed = |side: &mut dyn FnMut()| {
        before();
        let (start, spent) = (Instant::now(), processor_seconds());
        side();
        let wall = start.elapsed().as_secs_f64();
        (wall, processor_seconds().zip(spent).map(|(after, before)| after - before))
    };
    timed(&mut ours);
    timed(&mut theirs);
    let (mut walls, mut sums) = (Vec::new(), [0.0; 2]);
    for _ in 0..pairs {
        let (one, other) = (timed(&mut ours), timed(&mut theirs));
        walls.push(one.0 / other.0);
        sums = [sums[0] + one.1.unwrap_or(0.0), sums[1] + other.1.unwrap_or(0.0)];
    }
    walls.sort_by(f64::total_cmp);
    let [low, median, high] = [pairs / 4, pairs / 2, pairs * 3 / 4].map(|place| walls[place.min(pairs - 1)]);
    let of_processor = if sums[1] > 0.0 { format!("{:.2}", sums[0] / sums[1]) } else { "unknown".to_owned() };
    println!(
        "{name}, {pairs} pairs by turns: wall time {median:.2} x (quartiles {low:.2} and {high:.2}), processor time \
         {of_processor} x"
    );
}

/// The processor time of this process so far, of threads that have ended too, in hundredths of a second.
fn processor_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let after_name = stat.rsplit_once(')')?.1;
    let fields: Vec<&str> = after_name.split_whitespace().collect();
    let ticks = |place: usize| fields.get(place)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) / 100.0)
}
