//! The progress bars: drawn on stderr beside the work, with the rates and the time left. Where stderr is no terminal
//! there are none.
//!
//! The working threads only raise numbers ([`Progress`], [`Checking`]); a thread of the bar's reads them ten times a
//! second. Absent: progress for programs (`events`).

use super::amounts;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use phytomer::run::filming::Filming;
use phytomer::run::{Progress, Reading};
use phytomer_outputs::Checking;
use phytomer_shade::Watch;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::thread;
use std::time::Duration;

const TEMPLATE: &str = "{bar:32} {percent:>3} %  {msg}  {eta} left";
const STEPS: u64 = 10_000;
const PAUSE: Duration = Duration::from_millis(100);

/// Does `work` while a bar shows how far growth has come.
pub fn growing<T>(progress: &Progress, hidden: bool, work: impl FnOnce() -> T) -> T {
    let state = |_: &ProgressBar| {
        let now = progress.reading();
        (now.share, in_words(&now))
    };
    beside(hidden, state, work)
}

/// "1 234 plants (56.0/s), 2.30 M components/s, 31.5 MB written".
fn in_words(now: &Reading) -> String {
    let plants = amounts::of(now.plants, "plant");
    let [plants_per_s, components_per_s] = [now.plants_per_s, now.components_per_s].map(amounts::about);
    format!(
        "{plants} ({plants_per_s}/s), {components_per_s} components/s, {} written",
        amounts::bytes(now.bytes as f64)
    )
}

/// Does `work` while a bar shows how much of the files has been read.
pub fn checking<T>(checking: &Checking, hidden: bool, work: impl FnOnce() -> T) -> T {
    let state = |_: &ProgressBar| {
        let (read, in_all) = (checking.bytes() as f64, checking.in_all() as f64);
        (read / in_all.max(1.0), read_in_words(checking))
    };
    beside(hidden, state, work)
}

/// Does `work` while a bar shows how far a film of so many frames has come.
pub fn filming<T>(filming: &Filming, frames: u32, hidden: bool, work: impl FnOnce() -> T) -> T {
    let state = |_: &ProgressBar| {
        let words = match filming.frames() {
            0 => "finding the place of the camera".to_owned(),
            drawn => format!("{drawn} of {frames} frames"),
        };
        (filming.share(), words)
    };
    beside(hidden, state, work)
}

/// Does `work` while a bar shows how many of the ages of a page have been grown.
pub fn viewing<T>(filming: &Filming, hidden: bool, work: impl FnOnce() -> T) -> T {
    beside(hidden, |_| (filming.share(), "growing".to_owned()), work)
}

/// Does `work` while a bar shows how far the sun of a year has been followed.
pub fn following<T>(watch: &Watch, hidden: bool, work: impl FnOnce() -> T) -> T {
    beside(hidden, |_| (watch.share(), "following the sun".to_owned()), work)
}

/// Does `work` while a bar shows how many of about so many simulations have been done.
pub fn simulating<T>(done: &AtomicU64, about: u64, hidden: bool, work: impl FnOnce() -> T) -> T {
    let state = |_: &ProgressBar| {
        let done = done.load(Relaxed);
        (done as f64 / about.max(1) as f64, amounts::of(done, "simulation"))
    };
    beside(hidden, state, work)
}

/// "1.2 MB of 30 MB checked", or "copied" while a merge writes them.
fn read_in_words(checking: &Checking) -> String {
    let [read, in_all] = [checking.bytes(), checking.in_all()].map(|bytes| amounts::bytes(bytes as f64));
    let done = if checking.copies() { "copied" } else { "checked" };
    format!("{read} of {in_all} {done}")
}

/// Does `work` while a bar shows a share in [0, 1] and a message.
fn beside<T>(hidden: bool, state: impl Fn(&ProgressBar) -> (f64, String) + Sync, work: impl FnOnce() -> T) -> T {
    let target = if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    if target.is_hidden() {
        return work();
    }
    let bar = ProgressBar::with_draw_target(Some(STEPS), target);
    if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
        bar.set_style(style.progress_chars("=> "));
    }
    let draw = || {
        let (share, message) = state(&bar);
        bar.set_message(message);
        bar.set_position((share * STEPS as f64) as u64);
    };
    let result = meanwhile(PAUSE, draw, work);
    bar.finish_and_clear();
    result
}

/// Does something every now and then, on a thread of its own, while `work` is done.
pub fn meanwhile<T>(pause: Duration, each: impl Fn() + Sync, work: impl FnOnce() -> T) -> T {
    let done = AtomicBool::new(false);
    thread::scope(|scope| {
        let beside = scope.spawn(|| {
            while !done.load(Relaxed) {
                thread::park_timeout(pause);
                if !done.load(Relaxed) {
                    each();
                }
            }
        });
        let result = work();
        done.store(true, Relaxed);
        beside.thread().unpark();
        result
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_tells_rates_and_bytes() {
        let now = Reading {
            plants: 1234,
            plants_per_s: 56.0,
            components_per_s: 2.3e6,
            bytes: 31_500_000,
            ..Reading::default()
        };
        assert_eq!(in_words(&now), "1 234 plants (56/s), 2.30 M components/s, 31.5 MB written");
    }
}
