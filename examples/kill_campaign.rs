//! The kill campaign: runs are killed at random moments, resumed and compared byte for byte with a run that was not.
//!
//! ```sh
//! cargo run --release --example kill_campaign [KILLS [SCENARIO]]
//! ```
//!
//! If nothing is given, `tests/data/runs/orchard.toml`, with cuts and pests, is killed 200 times, on 1, 2, 3 and 8
//! threads: by turns a whole run, or each of its three shards and then their merge. Each file must then be that of the
//! undisturbed run, `run.json` but for its timings; the first difference ends it with exit code 1 and keeps the
//! folders. Absent: a machine that fails; the same in short (`tests/resume.rs`, `tests/shards.rs`).

use anyhow::{Context, Result, anyhow, bail, ensure};
use phytomer::config::validate;
use phytomer::outputs::{Checking, Mode, Opening, Share, SystemSpace, merge};
use phytomer::run::{self, Progress, Settings};
use serde_json::Value;
use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};

const KILLS: u32 = 200;
const SHARES: u32 = 3;
const THREADS: [usize; 4] = [1, 2, 3, 8];

fn main() -> Result<()> {
    let words: Vec<String> = env::args().skip(1).collect();
    if words.first().is_some_and(|word| word == "child") {
        return child(&words[1..]);
    }
    let kills = words.first().map_or(Ok(KILLS), |word| word.parse()).context("the number of kills is expected")?;
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/runs/orchard.toml");
    let scenario = words.get(1).cloned().unwrap_or_else(|| shipped.display().to_string());
    let home = env::temp_dir().join(format!("phytomer-kills-{}", std::process::id()));
    fs::create_dir_all(&home)?;
    let whole = home.join("undisturbed");
    let start = Instant::now();
    ensure!(grow(&scenario, &whole, "whole", 2)?.wait()?.success(), "the undisturbed run has failed");
    let mut campaign = Campaign { time: start.elapsed(), state: 1988, left: kills, starts: 0 };
    let expected = contents(&whole)?;
    let mut runs = 0;
    while campaign.left > 0 {
        let folder = home.join("killed");
        match runs % 2 {
            0 => campaign.kill(|threads| grow(&scenario, &folder, "whole", threads))?,
            _ => campaign.kill_shares(&scenario, &home, &folder)?,
        }
        compare(&expected, &contents(&folder)?).with_context(|| format!("{} differs", folder.display()))?;
        fs::read_dir(&home)?
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| *path != whole)
            .try_for_each(fs::remove_dir_all)?;
        runs += 1;
        println!("{} of {kills} kills, {runs} runs compared", kills - campaign.left);
    }
    fs::remove_dir_all(&home)?;
    println!(
        "{} starts were killed {kills} times; every byte of {runs} runs is that of the undisturbed run",
        campaign.starts
    );
    Ok(())
}

/// A process of this program that does what [`child`] says.
fn start(words: &[&str]) -> Result<Child> {
    let mut command = Command::new(env::current_exe()?);
    Ok(command.arg("child").args(words).stdout(Stdio::null()).spawn()?)
}

fn grow(scenario: &str, folder: &Path, share: &str, threads: usize) -> Result<Child> {
    start(&["grow", scenario, &folder.display().to_string(), share, &threads.to_string()])
}

/// What a process of the campaign does: it grows a run or a share of it, or merges shares; either is resumed.
fn child(words: &[String]) -> Result<()> {
    match words {
        [verb, scenario, folder, share, threads] if verb == "grow" => {
            let resolved = validate(scenario).map_err(|report| anyhow!("{}", report.render(false)))?;
            let settings = Settings {
                mode: Mode::Resume,
                share: share.parse::<Share>().ok(),
                threads: threads.parse()?,
                ..Settings::in_folder(folder)
            };
            run::run(&resolved, &settings, &Progress::default())?;
        }
        [verb, folder, parts @ ..] if verb == "merge" => {
            let parts: Vec<PathBuf> = parts.iter().map(PathBuf::from).collect();
            let opening = Opening { checking: &Checking::default(), space: Arc::new(SystemSpace), share: None };
            merge(Path::new(folder), &parts, Mode::Resume, &opening)?;
        }
        _ => bail!("grow or merge is expected"),
    }
    Ok(())
}

/// The kills that are left, and the moments at which they come.
struct Campaign {
    /// The time of an undisturbed run.
    time: Duration,
    state: u64,
    left: u32,
    starts: u32,
}

impl Campaign {
    /// A share of the whole in [0, 1); a linear congruential generator is random enough.
    fn moment(&mut self) -> f64 {
        self.state = self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Starts a process again and again, and kills it, until it comes to its end before it is killed.
    fn kill(&mut self, begin: impl Fn(usize) -> Result<Child>) -> Result<()> {
        loop {
            let mut process = begin(THREADS[self.starts as usize % THREADS.len()])?;
            self.starts += 1;
            if self.left > 0 {
                sleep(self.time.mul_f64(self.moment()));
                process.kill()?;
            }
            let ended = process.wait()?;
            match ended.code() {
                Some(0) => return Ok(()),
                // A signal has no code on Unix; on Windows a process that was killed has the code 1.
                code if self.left > 0 && code == cfg!(windows).then_some(1) => self.left -= 1,
                code => bail!("a process that was not killed has ended with {code:?}"),
            }
        }
    }

    fn kill_shares(&mut self, scenario: &str, home: &Path, folder: &Path) -> Result<()> {
        let shares: Vec<PathBuf> = (1..=SHARES).map(|number| home.join(format!("share-{number}"))).collect();
        for (number, share) in (1..).zip(&shares) {
            self.kill(|threads| grow(scenario, share, &format!("{number}/{SHARES}"), threads))?;
        }
        let words: Vec<String> = [folder]
            .into_iter()
            .chain(shares.iter().map(PathBuf::as_path))
            .map(|path| path.display().to_string())
            .collect();
        self.kill(|_| start(&["merge"].into_iter().chain(words.iter().map(String::as_str)).collect::<Vec<_>>()))
    }
}

/// Every file of a run folder, by its path there; of `run.json` all but what depends on the time. The lock is left out.
fn contents(run: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>> {
    let mut contents = BTreeMap::new();
    let mut folders = vec![run.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            let name = path.strip_prefix(run)?.to_path_buf();
            if path.is_dir() {
                folders.push(path);
            } else if name == Path::new("run.json") {
                let mut json: Value = serde_json::from_slice(&fs::read(&path)?)?;
                let object = json.as_object_mut().context("run.json is an object")?;
                ["timings_s", "check"].iter().for_each(|key| _ = object.remove(*key));
                contents.insert(name, json.to_string().into_bytes());
            } else if name != Path::new("run.lock") {
                contents.insert(name, fs::read(&path)?);
            }
        }
    }
    Ok(contents)
}

fn compare(expected: &BTreeMap<PathBuf, Vec<u8>>, found: &BTreeMap<PathBuf, Vec<u8>>) -> Result<()> {
    for (name, bytes) in expected {
        ensure!(found.get(name) == Some(bytes), "{} is missing or not the same", name.display());
    }
    match found.keys().find(|name| !expected.contains_key(*name)) {
        Some(more) => bail!("{} is left over", more.display()),
        None => Ok(()),
    }
}
