//! The progress bar: drawn on stderr beside the work, with the rate and the time left; none where nobody looks.
//!
//! The growing threads only raise numbers ([`Progress`]); this thread reads them ten times a second.

use super::super::amounts;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use phytomer::run::Progress;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::thread;
use std::time::Duration;

const TEMPLATE: &str = "{bar:32} {percent:>3} %  {msg}  {eta} left";
const STEPS: u64 = 10_000;
const PAUSE: Duration = Duration::from_millis(100);

/// Does `work` while the bar shows how far it has come.
pub fn beside<T>(progress: &Progress, hidden: bool, work: impl FnOnce() -> T) -> T {
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
        let drawing = scope.spawn(|| draw(&bar, progress, &done));
        let result = work();
        done.store(true, Relaxed);
        drawing.thread().unpark();
        result
    })
}

fn draw(bar: &ProgressBar, progress: &Progress, done: &AtomicBool) {
    while !done.load(Relaxed) {
        thread::park_timeout(PAUSE);
        let rate = progress.components() as f64 / bar.elapsed().as_secs_f64().max(1e-3);
        let plants = amounts::of(progress.plants(), "plant");
        bar.set_message(format!("{plants}, {} components/s", amounts::about(rate.round())));
        bar.set_position((progress.share() * STEPS as f64) as u64);
    }
    bar.finish_and_clear();
}
