//! Executors, schedulers and those who ask are killed at random moments, by SIGKILL; the run is then gone on with, and
//! each run that comes to its end has the bytes of the run that nobody disturbed.
//!
//! `PHYTOMER_KILLS` has how many are killed; few if it is not set.

use super::home::{Home, Process, Scheduler, contents, stated};
use std::fs;
use std::thread::sleep;
use std::time::{Duration, Instant};

const FEW: u32 = 4;

/// Numbers that look random, the same in each test run (xorshift, Marsaglia 2003).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % end
    }
}

/// A cluster whose processes are killed and started again.
struct Cluster<'a> {
    home: &'a Home,
    scheduler: Scheduler,
    executors: Vec<Process>,
}

impl Cluster<'_> {
    fn kill(&mut self, which: u64) {
        if which == 0 {
            let address = self.scheduler.address.clone();
            self.scheduler.process.0.kill().unwrap();
            self.scheduler.process.0.wait().unwrap();
            self.scheduler = self.home.scheduler_at(&address);
        } else {
            let place = which as usize - 1;
            self.executors[place].0.kill().unwrap();
            self.executors[place].0.wait().unwrap();
            self.executors[place] = self.home.executor(&self.scheduler, &format!("executor {place}"));
        }
    }
}

#[test]
fn killed_processes_change_no_byte() {
    let kills = std::env::var("PHYTOMER_KILLS").map_or(FEW, |number| number.parse().expect("a number"));
    let home = Home::new();
    let whole = home.whole();
    let scheduler = home.scheduler();
    let executors = ["executor 0", "executor 1"].map(|name| home.executor(&scheduler, name)).into();
    let mut cluster = Cluster { home: &home, scheduler, executors };
    let address = cluster.scheduler.address.clone();
    let words = ["--scheduler", &address, "--out", "run", "--resume", "--quiet"];
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let (mut runs, mut cut) = (0, 0);
    let compare = |runs: &mut u32| {
        assert!(contents(&home.path("run")) == whole, "a file differs");
        fs::remove_dir_all(home.path("run")).unwrap();
        *runs += 1;
    };
    for kill in 0..kills {
        let mut asking = home.start_grow(&words);
        sleep(Duration::from_millis(100 + numbers.below(900)));
        cluster.kill(numbers.below(3));
        // Every second time the one who asks is killed too; else it ends by itself, well or because of the kill.
        if kill % 2 == 0 {
            asking.0.kill().unwrap();
        }
        if asking.0.wait().unwrap().success() {
            compare(&mut runs);
        } else {
            cut += 1;
        }
    }
    home.grow(&words).ending(0);
    compare(&mut runs);
    println!("{kills} processes killed; {cut} askings cut off; {runs} runs compared");
    assert!(cut > 0, "no kill came before the end of a run of {}", stated().scenario);
}

/// The answers of an executor that has ended are lost; what it has grown is not, and nothing is asked for twice.
#[test]
fn an_executor_that_ends_takes_no_part_with_it() {
    let home = Home::new();
    let scheduler = home.scheduler();
    let mut first = home.executor(&scheduler, "first");
    let mut asking = home.start_grow(&["--scheduler", &scheduler.address, "--out", "run"]);
    let begun = Instant::now();
    while home.parts_of("run") < 2 && begun.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(5));
    }
    first.0.kill().unwrap();
    first.0.wait().unwrap();
    let _second = home.executor(&scheduler, "second");
    assert!(asking.0.wait().unwrap().success());
    assert!(contents(&home.path("run")) == home.whole());
}
