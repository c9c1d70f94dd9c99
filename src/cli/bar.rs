//! The progress bars: drawn on stderr beside the work, with the rate and the time left. Where stderr is no terminal
//! there are none.
//!
//! The working threads only raise numbers ([`Progress`], [`Checking`]); a thread of the bar's reads them ten times a
//! second.

use super::amounts;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use phytomer::run::Progress;
use phytomer_outputs::Checking;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::thread;
use std::time::Duration;

const TEMPLATE: &str = "{bar:32} {percent:>3} %  {msg}  {eta} left";
const STEPS: u64 = 10_000;
const PAUSE: Duration = Duration::from_millis(100);

/// Does `work` while a bar shows how far growth has come.
pub fn growing<T>(progress: &Progress, hidden: bool, work: impl FnOnce() -> T) -> T {
    let state = |bar: &ProgressBar| {
        let rate = progress.components() as f64 / bar.elapsed().as_secs_f64().max(1e-3);
        let plants = amounts::of(progress.plants(), "plant");
        (progress.share(), format!("{plants}, {} components/s", amounts::about(rate.round())))
    };
    beside(hidden, state, work)
}

/// Does `work` while a bar shows how much of the files has been read.
pub fn checking<T>(checking: &Checking, hidden: bool, work: impl FnOnce() -> T) -> T {
    let state = |_: &ProgressBar| {
        let (read, in_all) = (checking.bytes() as f64, checking.in_all() as f64);
        let message = format!("{} of {} checked", amounts::bytes(read), amounts::bytes(in_all));
        (read / in_all.max(1.0), message)
    };
    beside(hidden, state, work)
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
    let done = AtomicBool::new(false);
    thread::scope(|scope| {
        let drawing = scope.spawn(|| {
            while !done.load(Relaxed) {
                thread::park_timeout(PAUSE);
                let (share, message) = state(&bar);
                bar.set_message(message);
                bar.set_position((share * STEPS as f64) as u64);
            }
            bar.finish_and_clear();
        });
        let result = work();
        done.store(true, Relaxed);
        drawing.thread().unpark();
        result
    })
}
