//! What is told of a cluster that cannot grow a run, and that the run can be gone on with where it can be.

use super::home::{self, Home, contents};
use phytomer::outputs::{FreeSpace, Mode, Space, SystemSpace};
use phytomer::run::Program;
use phytomer_cluster::executor::{self, Executing};
use phytomer_cluster::growing::{Asked, GrowError, prepare};
use phytomer_cluster::scheduler::{self, Scheduling};
use phytomer_cluster::worker::Worker;
use std::collections::BTreeSet;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::thread;

/// A disk on which nothing is free.
#[derive(Debug)]
struct Full;

impl FreeSpace for Full {
    fn space(&self, _: &Path) -> Option<Space> {
        Some(Space { free: 0, total: 1 << 40 })
    }
}

fn old() -> Program {
    Program { version: "0.0.1".to_owned(), git_hash: "abc".to_owned() }
}

/// A scheduler of another program in this process, for as long as the process lives.
fn foreign_scheduler() -> String {
    let (ready, address) = channel();
    thread::spawn(move || {
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().unwrap();
        let scheduling = Scheduling { program: old(), ..Scheduling::default() };
        let any = SocketAddr::from((Ipv4Addr::LOCALHOST, 0));
        runtime.block_on(scheduler::serve(any, scheduling, move |address| ready.send(address).unwrap()))
    });
    address.recv().unwrap().to_string()
}

/// An executor in this process; what it ends with comes through the channel.
fn executor(scheduler: &str, worker: Worker, work: &Path) -> std::sync::mpsc::Receiver<String> {
    let (host, port) = scheduler.rsplit_once(':').unwrap();
    let executing = Executing {
        scheduler: (host.to_owned(), port.parse().unwrap()),
        listen: Ipv4Addr::LOCALHOST.into(),
        port: 0,
        advertise: None,
        threads: 1,
        work: work.to_path_buf(),
    };
    let (ended, end) = channel();
    thread::spawn(move || {
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().unwrap();
        let done = runtime.block_on(executor::serve(executing, Arc::new(worker), |_| ()));
        _ = ended.send(done.map_or_else(|error| format!("{error:#}"), |()| "ended".to_owned()));
    });
    end
}

#[test]
fn another_version_is_refused() {
    let home = Home::new();
    let address = foreign_scheduler();
    let told = home.grow(&["--scheduler", &address, "--out", "run"]).ending(1).stderr;
    let own = Program::default();
    let words = ["is phytomer-cluster/0.0.1 (abc)", "install the same version", &own.version, &own.git_hash];
    assert!(words.iter().all(|word| told.contains(word)), "{told}");
    let told = home.run(&["executor", "--scheduler", &address, "--port", "0"]).ending(1).stderr;
    assert!(words.iter().all(|word| told.contains(word)), "{told}");
    // And the other way round: an old executor at a new scheduler.
    let scheduler = home.scheduler();
    let old = Worker::new("old").acting_as(old(), Arc::new(SystemSpace));
    let told = executor(&scheduler.address, old, &home.path("work")).recv().unwrap();
    assert!(told.contains("was called by phytomer-cluster/0.0.1 (abc): install the same version"), "{told}");
}

#[test]
fn a_full_disk_is_told_and_the_run_goes_on_elsewhere() {
    let home = Home::new();
    let scheduler = home.scheduler();
    let full = Worker::new("full").acting_as(Program::default(), Arc::new(Full));
    let _ended = executor(&scheduler.address, full, &home.path("work"));
    let words = ["--scheduler", &scheduler.address, "--out", "run"];
    let told = home.grow(&words).ending(1).stderr;
    for word in ["12 of 12 parts were not grown", "on full", "0 B free", "--resume goes on"] {
        assert!(told.contains(word), "`{word}` is missing in {told}");
    }
    // The executor with the full disk is still there; another scheduler knows nothing of it.
    let scheduler = home.scheduler();
    let _executor = home.executor(&scheduler, "empty");
    home.grow(&["--scheduler", &scheduler.address, "--out", "run", "--resume", "--quiet"]).ending(0);
    assert!(contents(&home.path("run")) == home.whole());
}

/// Notes the folders in which parts were begun.
#[derive(Debug, Default)]
struct Noting(Mutex<BTreeSet<PathBuf>>);

impl FreeSpace for Noting {
    fn space(&self, folder: &Path) -> Option<Space> {
        self.0.lock().unwrap().insert(folder.to_path_buf());
        None
    }
}

/// A part whose name a file has, which an executor can neither write nor pass by: it is tried so often as the scheduler
/// says, and the others are grown.
#[test]
fn a_part_that_fails_is_tried_again_and_given_up() {
    let home = Home::new();
    let scheduler = home.scheduler();
    let noting = Arc::new(Noting::default());
    let space: Arc<dyn FreeSpace> = noting.clone();
    let _ended =
        executor(&scheduler.address, Worker::new("a").acting_as(Program::default(), space), &home.path("work"));
    let asked = Asked {
        stated: home::stated(),
        out: home.path("run"),
        mode: Mode::New,
        ignore_disk: false,
        scheduler: scheduler.address.clone(),
        program: Program::default(),
    };
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().unwrap();
    let (ready, failed) = runtime.block_on(async {
        let ready = prepare(asked).await.unwrap().unwrap();
        std::fs::write(ready.store().part(3), "in the way").unwrap();
        let failed = ready.grow().await.unwrap_err();
        (ready, failed)
    });
    let told = format!("{failed}: {}", std::error::Error::source(&failed).unwrap());
    assert!(matches!(failed, GrowError::Cluster { .. }) && told.contains("Job "), "{told}");
    let begun = noting.0.lock().unwrap();
    let of_part = |shard: &str| begun.iter().filter(|folder| folder.to_string_lossy().contains(shard)).count();
    assert_eq!(of_part("-00003-"), 4, "{begun:?}");
    std::fs::remove_file(ready.store().part(3)).unwrap();
    drop(ready);
    drop(begun);
    home.grow(&["--scheduler", &scheduler.address, "--out", "run", "--resume", "--quiet"]).ending(0);
    assert!(contents(&home.path("run")) == home.whole());
}

#[test]
fn what_cannot_begin_is_told_at_once() {
    let home = Home::new();
    let none = ["--scheduler", "127.0.0.1:1", "--out", "run"];
    let told = home.grow(&none).ending(1).stderr;
    assert!(told.contains("no scheduler answers at 127.0.0.1:1"), "{told}");
    let told = home.run(&["executor", "--scheduler", "127.0.0.1:1"]).ending(1).stderr;
    assert!(told.contains("no scheduler answers at 127.0.0.1:1"), "{told}");
    for words in
        [&["grow", "coffee"][..], &["grow", "coffee", "--scheduler", "nowhere"], &["scheduler", "--listen", "x"]]
    {
        home.run(words).ending(2);
    }
    let told = home.run(&["grow", "cofee", "--scheduler", "127.0.0.1:1"]).ending(3).stderr;
    assert!(told.contains("coffee"), "{told}");
    let told = home.run(&["scheduler", "--listen", "192.0.2.1:50050"]).ending(1).stderr;
    assert!(told.contains("cannot listen on 192.0.2.1:50050"), "{told}");
    assert!(!home.path("run").exists() && !home.path("run.parts").exists());
}
