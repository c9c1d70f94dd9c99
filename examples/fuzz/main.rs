//! The fuzz targets on stable, for a stated time: `cargo run --example fuzz`, with `--target species --seconds 600
//! --seed 7` one of them, and one input again: `--target species --input FILE`. `.ci/run` has a minute of it.
//!
//! Each target runs in a process of its own, two at a time, over inputs that follow from the seed and their number. An
//! input is written to a file before it is tried; where its process ends by a panic, a signal or a lack of memory, or
//! answers too late, the file is kept in `fuzz/artifacts` with the command to see it again. The targets stand in the
//! folder `fuzz`, which hands them to libFuzzer too. Absent: coverage.

#[path = "../../fuzz/src/lib.rs"]
mod targets;

use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode};
use std::time::{Duration, Instant, SystemTime};
use std::{env, fs, thread};
use targets::{TARGETS, Target, broken, folder, lay_in, seeds};

/// No answer may be waited for longer than this, in the slowest build on a busy machine.
const LONGEST: Duration = Duration::from_secs(20);
/// No input may make the program ask for more memory than this, in MiB. All are small.
const MOST_MEMORY: u64 = 1500;
/// Targets that run at a time.
const AT_A_TIME: usize = 2;
const USAGE: &str = "fuzz [--target NAME] [--seconds N] [--seed N] [--input FILE]";

/// What was asked for.
struct Asked {
    target: Option<String>,
    seconds: u64,
    seed: u64,
    /// One file to try, and nothing else.
    input: Option<PathBuf>,
    /// Where a process leaves the input that it tries: it is one target's.
    current: Option<PathBuf>,
}

fn asked() -> Option<Asked> {
    let mut asked = Asked { target: None, seconds: 60, seed: 1988, input: None, current: None };
    let mut words = env::args().skip(1);
    while let Some(word) = words.next() {
        let value = words.next()?;
        match word.as_str() {
            "--target" => asked.target = Some(value),
            "--seconds" => asked.seconds = value.parse().ok()?,
            "--seed" => asked.seed = value.parse().ok()?,
            "--input" => asked.input = Some(value.into()),
            "--current" => asked.current = Some(value.into()),
            _ => return None,
        }
    }
    Some(asked)
}

fn main() -> ExitCode {
    let Some(asked) = asked() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let chosen: Vec<(&str, Target)> =
        TARGETS.into_iter().filter(|(name, _)| asked.target.as_deref().is_none_or(|target| target == *name)).collect();
    let (Some(&(name, target)), once) = (chosen.first(), chosen.len() == 1) else {
        eprintln!("there is no such target; expected one of {}", TARGETS.map(|(name, _)| name).join(", "));
        return ExitCode::from(2);
    };
    match (&asked.input, &asked.current) {
        (Some(_) | None, Some(current)) if once => try_many(name, target, &asked, current),
        (Some(input), None) if once => try_one(target, input),
        (Some(_), _) => {
            eprintln!("an input is of one target; name it by --target");
            return ExitCode::from(2);
        }
        _ => return watch(&chosen, &asked),
    }
    ExitCode::SUCCESS
}

/// In a thread of its own, whose stack is that of a worker.
fn try_one(target: Target, input: &Path) {
    let home = folder();
    lay_in(home.path());
    let bytes = fs::read(input).unwrap_or_else(|error| panic!("{}: {error}", input.display()));
    thread::scope(|scope| scope.spawn(|| target(&bytes)).join()).expect("the input is answered");
    println!("answered");
}

fn try_many(name: &str, target: Target, asked: &Asked, current: &Path) {
    // Beside it, so that the process that watches this one removes both.
    let home = current.with_extension("home");
    fs::create_dir_all(&home).expect("a folder");
    lay_in(&home);
    let (seeds, seed) = (seeds::of(name), asked.seed);
    let until = Instant::now() + Duration::from_secs(asked.seconds);
    let work = || {
        (0..).take_while(|_| Instant::now() < until).fold(0_u64, |tried, number| {
            let input = broken::input(&seeds, seed, number);
            fs::write(current, &input).expect("the input is kept");
            target(&input);
            tried + 1
        })
    };
    let tried = thread::scope(|scope| scope.spawn(work).join()).expect("every input is answered");
    println!("{name}: {tried} inputs, of {} seeds", seeds.len());
    assert!(tried > 0, "no input was tried");
}

/// A process of one target.
struct Running<'a> {
    name: &'a str,
    child: Child,
    current: PathBuf,
    started: SystemTime,
}

/// Runs every target in a process of its own and keeps what went wrong.
fn watch(chosen: &[(&str, Target)], asked: &Asked) -> ExitCode {
    let home = folder();
    println!("seed {}", asked.seed);
    let shares: u64 = chosen.iter().map(|(name, _)| share(name)).sum();
    let in_all = asked.seconds * AT_A_TIME.min(chosen.len()) as u64;
    let mut waiting = chosen.iter().map(|(name, _)| (*name, (in_all * share(name)).div_ceil(shares)));
    let (mut running, mut all_well) = (Vec::new(), true);
    loop {
        while running.len() < AT_A_TIME
            && let Some((name, seconds)) = waiting.next()
        {
            running.push(start(name, seconds, asked.seed, home.path()));
        }
        running.retain_mut(|target| match ended(target) {
            None => true,
            Some(Ok(())) => false,
            Some(Err(what)) => {
                keep(target, &what);
                all_well = false;
                false
            }
        });
        if running.is_empty() && waiting.len() == 0 {
            return if all_well { ExitCode::SUCCESS } else { ExitCode::FAILURE };
        }
        thread::sleep(Duration::from_millis(100));
    }
}

/// How much of the time a target has beside the others: a mesh is answered in microseconds, a run folder is not.
fn share(name: &str) -> u64 {
    match name {
        "run_folder" => 4,
        "species" => 3,
        "scenario" => 2,
        _ => 1,
    }
}

fn start<'a>(name: &'a str, seconds: u64, seed: u64, home: &Path) -> Running<'a> {
    let current = home.join(name);
    let program = env::current_exe().expect("this program");
    let (seconds, seed) = (seconds.to_string(), seed.to_string());
    let words = ["--target", name, "--seconds", &seconds, "--seed", &seed, "--current"];
    let child = Command::new(program).args(words).arg(&current).spawn().expect("a process");
    Running { name, child, current, started: SystemTime::now() }
}

/// How a process ended, if it has; where it must not go on it is ended here.
fn ended(running: &mut Running) -> Option<Result<(), String>> {
    match running.child.try_wait().expect("a child") {
        Some(status) if status.success() => return Some(Ok(())),
        Some(status) => return Some(Err(format!("{status}"))),
        None => {}
    }
    let what = too_much(running)?;
    // It may have ended in the meantime.
    let _ = running.child.kill();
    running.child.wait().expect("a child");
    Some(Err(what))
}

/// Keeps the input at which a process ended badly, and tells how to see it again.
fn keep(running: &Running, what: &str) {
    let name = running.name;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/artifacts").join(name);
    fs::create_dir_all(&folder).expect("a folder");
    let since = running.started.duration_since(SystemTime::UNIX_EPOCH);
    let kept = folder.join(format!("{name}-{}", since.map_or(0, |since| since.as_millis())));
    if fs::copy(&running.current, &kept).is_err() {
        return eprintln!("{name}: {what}, before its first input");
    }
    let again = "cargo run --example fuzz --";
    eprintln!("{name}: {what}; to see its input again:\n  {again} --target {name} --input {}", kept.display());
}

/// Why a process must be stopped.
fn too_much(running: &Running) -> Option<String> {
    // Laying the seeds and growing the run that is broken come before the first input.
    let last = fs::metadata(&running.current).and_then(|file| file.modified()).unwrap_or(running.started + 2 * LONGEST);
    if last.elapsed().is_ok_and(|since| since > LONGEST) {
        return Some(format!("no answer for {LONGEST:?}"));
    }
    // On Linux alone.
    let status = fs::read_to_string(format!("/proc/{}/status", running.child.id())).ok()?;
    let peak =
        status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB")?.trim().parse().ok());
    peak.filter(|kb: &u64| *kb > MOST_MEMORY * 1024).map(|kb| format!("{} MiB of memory", kb / 1024))
}
