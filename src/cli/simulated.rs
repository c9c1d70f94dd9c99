//! What verbs that simulate share: the numbers that are varied, plants, seed and threads on the command line, and the
//! simulations side by side, with a journal and a bar.
//!
//! Absent: what is asked of the simulations.

use super::{Misuse, Verdict, bar, interrupt, refuse, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer::simulate::journal::{Journal, key};
use phytomer::simulate::{Simulator, Unready};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};

/// How plants are simulated.
#[derive(Debug, Args)]
pub struct Simulating {
    /// Vary a number of the species within a range, such as order.1.pause=0.02..0.3; left out: all numbers with a
    /// `prior` in the species.
    #[arg(long, value_name = "PATH=LOW..HIGH")]
    pub vary: Vec<String>,
    /// The plants of each simulation.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub plants: Option<u32>,
    /// The seed of all that is drawn [default: 1988].
    #[arg(long)]
    pub seed: Option<u64>,
    /// Threads; the result is the same on any number [default: all].
    #[arg(long)]
    pub threads: Option<u16>,
    /// Go on where an analysis with the same --out was interrupted.
    #[arg(long, requires = "out")]
    pub resume: bool,
    /// No bar and no words beside the result.
    #[arg(long)]
    pub quiet: bool,
}

/// The seed where none is said.
const SEED: u64 = 1988;

impl Simulating {
    /// The seed.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(SEED)
    }

    /// An option of simulations that was given.
    pub fn given(&self) -> Option<&'static str> {
        let options = [
            (!self.vary.is_empty(), "--vary"),
            (self.plants.is_some(), "--plants"),
            (self.seed.is_some(), "--seed"),
            (self.threads.is_some(), "--threads"),
            (self.resume, "--resume"),
            (self.quiet, "--quiet"),
        ];
        options.into_iter().find(|(given, _)| *given).map(|(_, name)| name)
    }

    /// Varies the numbers that the command line names, or those with a prior. Returns whether there are any.
    ///
    /// # Errors
    /// As [`Simulator::vary`], and a text that is no path with a range.
    pub fn vary(&self, simulator: &mut Simulator) -> Result<bool, Unready> {
        for text in &self.vary {
            let (path, limits) = range(text).map_err(Unready::Asked)?;
            simulator.vary(path, limits)?;
        }
        if self.vary.is_empty() {
            simulator.vary_priors()?;
        }
        Ok(!simulator.varied().is_empty())
    }
}

/// `PATH=LOW..HIGH`.
fn range(text: &str) -> Result<(&str, [f64; 2]), String> {
    let wrong = || format!("--vary {text}: a path and two numbers are expected, such as order.1.pause=0.02..0.3");
    let (path, range) = text.split_once('=').ok_or_else(wrong)?;
    let (low, high) = range.split_once("..").ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(wrong);
    let limits = [number(low)?, number(high)?];
    match limits[0] < limits[1] {
        true => Ok((path.trim(), limits)),
        false => Err(format!("--vary {text}: the first number must be below the second")),
    }
}

/// Tells why there is no simulator: a wrong species with its source lines, all else as misuse.
///
/// # Errors
/// [`Misuse`].
pub fn declined(unready: Unready, as_json: bool) -> Result<Verdict> {
    match unready {
        Unready::Species(report) => refuse(&report, as_json),
        other => Err(Misuse(other.to_string()).into()),
    }
}

/// Simulations side by side.
pub struct Work {
    /// The simulator.
    pub simulator: Arc<Simulator>,
    journal: Option<Journal>,
    done: AtomicU64,
    failed: Mutex<Option<std::io::Error>>,
}

impl Work {
    /// Simulations that are kept in a journal beside a file, where one is written. `of` is all that they depend on.
    ///
    /// # Errors
    /// A journal that is there already, or of another analysis.
    pub fn begin(simulator: Simulator, out: Option<&Path>, of: &str, asked: &Simulating) -> Result<Self> {
        let open = |out: &Path| Journal::open(&Journal::beside(out), of, asked.resume);
        let journal = out.map(open).transpose()?;
        if let Some(journal) = journal.as_ref().filter(|journal| journal.known() > 0 && !asked.quiet) {
            terminal::say(&format!("{} simulations are in the journal and are not done again", journal.known()));
        }
        let simulator = Arc::new(simulator);
        let (asked_of, told) = (Arc::clone(&simulator), Arc::clone(&simulator));
        let words = "stopping; what was simulated is kept where --out names a file, and --resume goes on";
        interrupt::listen(move || asked_of.is_stopped(), move || told.stop(), words)?;
        Ok(Self { simulator, journal, done: AtomicU64::new(0), failed: Mutex::new(None) })
    }

    /// The summaries of a simulation, from the journal or by growth; `None` where it has none.
    pub fn simulate(&self, values: &[f64], seed: u64) -> Option<Vec<f64>> {
        let key = key(values, seed);
        if let Some(known) = self.journal.as_ref().and_then(|journal| journal.get(key)) {
            return known;
        }
        let found = self.simulator.simulate(values, seed).ok();
        if self.simulator.is_stopped() {
            return None;
        }
        self.done.fetch_add(1, Relaxed);
        if let Some(Err(error)) = self.journal.as_ref().map(|journal| journal.put(key, found.as_deref())) {
            self.failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
            self.simulator.stop();
        }
        found
    }

    /// Does `work` on so many threads, with a bar that knows about how many simulations there are to be.
    ///
    /// # Errors
    /// No threads, or a journal that cannot be written; `None` where it was stopped.
    pub fn run<T: Send>(&self, asked: &Simulating, about: u64, work: impl FnOnce() -> T + Send) -> Result<Option<T>> {
        let threads = asked.threads.unwrap_or(0).into();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().context("cannot start the threads")?;
        let done = bar::simulating(&self.done, about, asked.quiet, || pool.install(work));
        let failed = self.failed.lock().unwrap_or_else(PoisonError::into_inner).take();
        match failed {
            Some(error) => Err(error).context("cannot write the journal"),
            None => Ok(Some(done).filter(|_| !self.simulator.is_stopped())),
        }
    }

    /// How many simulations were done, and for how long: told on stderr.
    pub fn tell(&self, asked: &Simulating) {
        let [all, growth] = self.simulator.spent();
        if !asked.quiet && all > 0.0 {
            let (done, share) = (self.done.load(Relaxed), 100.0 * growth / all);
            terminal::say(&format!("{done} simulations in {all:.1} s of all threads, {share:.1} % of it in growth"));
        }
    }

    /// Removes the journal, once all is written.
    ///
    /// # Errors
    /// The system's.
    pub fn finish(self) -> Result<()> {
        self.journal.map_or(Ok(()), Journal::finish).context("cannot remove the journal")
    }
}

#[cfg(test)]
mod tests {
    use super::range;

    #[test]
    fn ranges_are_read_or_told() {
        assert_eq!(range("order.1.pause=0.02..0.3").unwrap(), ("order.1.pause", [0.02, 0.3]));
        assert_eq!(range("a=-2..1e3").unwrap(), ("a", [-2.0, 1e3]));
        for wrong in ["a", "a=1", "a=1..", "a=1..x", "a=NaN..1", "a=1..inf"] {
            assert!(range(wrong).unwrap_err().contains("two numbers are expected"), "{wrong}");
        }
        assert!(range("a=2..1").unwrap_err().contains("below the second"));
    }
}
