//! An executor: asks a scheduler for parts and grows as many at once as it has threads.
//!
//! It opens connections to the scheduler; its own port hands out answers, which are a few hundred bytes a part. Absent:
//! what it does with a part (`worker`).

use super::codec::Codec;
use super::program::naming;
use super::submission::greet;
use super::worker::Worker;
use anyhow::{Context, Result, anyhow};
use ballista_core::config::TaskSchedulingPolicy;
use ballista_core::ids::new_instance_id;
use ballista_executor::executor_process::{ExecutorProcessConfig, start_executor_process};
use std::net::{IpAddr, TcpListener};
use std::sync::Arc;

/// How an executor is set up.
#[derive(Debug, Clone)]
pub struct Executing {
    /// HOST and PORT of the scheduler.
    pub scheduler: (String, u16),
    /// The address that answers are fetched from.
    pub listen: IpAddr,
    /// Its port; 0 takes one that is free.
    pub port: u16,
    /// The name or address by which other machines reach it, where it is not the one that it listens on.
    pub advertise: Option<String>,
    /// How many parts grow at once, each on one thread.
    pub threads: usize,
    /// The folder for answers, until they are fetched.
    pub work: std::path::PathBuf,
}

/// Works until the process is told to end; `ready` is called when the scheduler has answered.
///
/// # Errors
/// Where no scheduler answers, or one of another program; where the port is taken.
pub async fn serve(executing: Executing, worker: Arc<Worker>, ready: impl FnOnce(u16)) -> Result<()> {
    let (host, port) = executing.scheduler.clone();
    greet(&format!("{host}:{port}"), &worker.program).await?;
    let own = match executing.port {
        0 => free_port(executing.listen)?,
        port => port,
    };
    let listen = match executing.listen {
        IpAddr::V4(address) => address.to_string(),
        IpAddr::V6(address) => format!("[{address}]"),
    };
    let config = ExecutorProcessConfig {
        // Not its name: an executor that is started again must not be taken for the one that was lost, whose parts
        // would then be waited for without end.
        executor_id: new_instance_id(),
        bind_host: listen.clone(),
        external_host: Some(executing.advertise.unwrap_or(listen)),
        port: own,
        // Tasks are asked for, so nothing listens there.
        grpc_port: own,
        scheduler_host: host,
        scheduler_port: port,
        vcores: executing.threads,
        task_scheduling_policy: TaskSchedulingPolicy::PullStaged,
        work_dir: Some(executing.work.display().to_string()),
        // Growth has its own bound of memory, and answers need none.
        memory_pool_size: Some(0),
        override_physical_codec: Some(Arc::new(Codec::of(Arc::clone(&worker)))),
        override_create_grpc_client_endpoint: Some(naming(&worker.program)),
        ..ExecutorProcessConfig::default()
    };
    ready(own);
    start_executor_process(Arc::new(config)).await.map_err(|error| anyhow!("the executor has ended: {error}"))
}

/// A port that is free now.
fn free_port(address: IpAddr) -> Result<u16> {
    let listener = TcpListener::bind((address, 0)).with_context(|| format!("cannot listen on {address}"))?;
    Ok(listener.local_addr().context("cannot tell a free port")?.port())
}
