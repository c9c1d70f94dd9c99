//! `scheduler` and `executor`: processes that work until they are ended.

use super::process::{host_and_port, runtime, threads_here};
use crate::executor::{self, Executing};
use crate::local::ends_with_parent;
use crate::scheduler::{self, Scheduling};
use crate::worker::Worker;
use anyhow::{Context, Result};
use clap::Args;
use phytomer::cli::{Verdict, terminal};
use phytomer::run::Program;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;

/// When parts are dealt out again, and when a run is given up.
#[derive(Debug, Clone, Copy, Args)]
struct Limits {
    /// Seconds without a sign after which an executor is given up, and its parts are dealt out again.
    #[arg(long, value_name = "SECONDS", default_value_t = 180, value_parser = clap::value_parser!(u64).range(6..=86_400))]
    executor_timeout: u64,
    /// Failures of one part after which the run is given up.
    #[arg(long, value_name = "NUMBER", default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..=1000))]
    task_failures: u16,
}

/// Deal parts out to executors, until this process is ended.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer-cluster scheduler
  phytomer-cluster scheduler --listen 10.0.0.1:50050 --executor-timeout 60

What it knows is in memory: after a new start, ask for the runs again with --resume. An executor that works gives a sign
every five seconds, so that a timeout of less than twenty gives up executors that are only slow.")]
pub struct SchedulerVerb {
    /// The address and the port to listen on. Others than 127.0.0.1 are open to the network.
    #[arg(long, value_name = "ADDRESS:PORT", default_value = "127.0.0.1:50050")]
    listen: SocketAddr,
    #[command(flatten)]
    limits: Limits,
    /// End with the process that began this one.
    #[arg(long, hide = true)]
    with_parent: bool,
}

/// Grow parts that a scheduler deals out, until this process is ended.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer-cluster executor
  phytomer-cluster executor --scheduler 10.0.0.1:50050 --listen 10.0.0.2 --threads 8

It opens connections to the scheduler; its own port hands out answers of a few hundred bytes a part. Ctrl-C ends it when
the parts that it grows are done.")]
pub struct ExecutorVerb {
    /// The scheduler.
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:50050", value_parser = host_and_port)]
    scheduler: (String, u16),
    /// The address that answers are fetched from. Others than 127.0.0.1 are open to the network.
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    listen: IpAddr,
    /// Its port; 0 takes one that is free.
    #[arg(long, default_value_t = 50051)]
    port: u16,
    /// The name or address by which other machines reach it, where it is not the one that it listens on.
    #[arg(long, value_name = "HOST")]
    advertise: Option<String>,
    /// How many parts grow at once, each on one thread; as many as the machine has threads if not given.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// The folder for answers until they are fetched; one in the system's folder for such files if not given.
    #[arg(long, value_name = "DIR")]
    work: Option<PathBuf>,
    /// Its name in messages; its address and port if not given.
    #[arg(long)]
    name: Option<String>,
    /// End with the process that began this one.
    #[arg(long, hide = true)]
    with_parent: bool,
}

impl SchedulerVerb {
    pub fn obey(self) -> Result<Verdict> {
        if self.with_parent {
            ends_with_parent();
        }
        let Limits { executor_timeout, task_failures } = self.limits;
        let scheduling = Scheduling {
            executor_timeout_s: executor_timeout,
            task_failures: task_failures.into(),
            program: Program::default(),
        };
        // A closed stdout keeps no scheduler from its work.
        let ready = |address: SocketAddr| _ = terminal::put(&format!("the scheduler listens on {address}"));
        runtime()?.block_on(scheduler::serve(self.listen, scheduling, ready))?;
        Ok(Verdict::Done)
    }
}

impl ExecutorVerb {
    pub fn obey(self) -> Result<Verdict> {
        let threads = self.threads.map_or_else(threads_here, usize::from);
        let own = || std::env::temp_dir().join(format!("phytomer-cluster-{}", std::process::id()));
        let work = self.work.unwrap_or_else(own);
        if self.with_parent {
            ends_with_parent();
        }
        std::fs::create_dir_all(&work).with_context(|| format!("cannot create {}", work.display()))?;
        let name = self.name.unwrap_or_else(|| format!("{}:{}", self.listen, self.port));
        let worker = Arc::new(Worker::new(name.clone()));
        let executing = Executing {
            scheduler: self.scheduler,
            listen: self.listen,
            port: self.port,
            advertise: self.advertise,
            threads,
            work: work.clone(),
        };
        let ready =
            |port: u16| _ = terminal::put(&format!("{name} grows {threads} parts at once, and answers on port {port}"));
        let done = runtime()?.block_on(executor::serve(executing, worker, ready));
        // What is left of answers is of no use to anyone.
        let _ = std::fs::remove_dir_all(&work);
        done.map(|()| Verdict::Done)
    }
}
