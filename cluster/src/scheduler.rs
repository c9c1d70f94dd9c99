//! The scheduler: deals the parts of runs out to the executors that ask for work, and deals them out again when an
//! executor is gone.
//!
//! All of it is Ballista's, behind a door that lets the same program pass alone. What it knows is in memory; when it is
//! started again, runs that were under way are asked for again with `--resume`. Absent: the parts themselves, which
//! never pass through it.

use super::codec::Codec;
use super::program::only;
use anyhow::{Context, Result};
use ballista_core::config::TaskSchedulingPolicy;
use ballista_core::serde::protobuf::scheduler_grpc_server::SchedulerGrpcServer;
use ballista_scheduler::cluster::BallistaCluster;
use ballista_scheduler::config::SchedulerConfig;
use ballista_scheduler::scheduler_process::create_scheduler;
use datafusion_proto::protobuf::{LogicalPlanNode, PhysicalPlanNode};
use phytomer::run::Program;
use std::net::SocketAddr;
use std::sync::Arc;
use tokio::net::TcpListener;
use tonic::service::interceptor::InterceptedService;
use tonic::transport::Server;
use tonic::transport::server::TcpIncoming;

/// The largest message, bytes: some thousands of rows with their plan.
pub const MESSAGE: usize = 64 << 20;

/// How a scheduler is set up.
#[derive(Debug, Clone)]
pub struct Scheduling {
    /// After so many seconds without a sign an executor is given up, and its parts are dealt out again.
    pub executor_timeout_s: u64,
    /// After so many failures of one part the run is given up.
    pub task_failures: usize,
    /// The program that alone may call.
    pub program: Program,
}

impl Default for Scheduling {
    fn default() -> Self {
        Self { executor_timeout_s: 180, task_failures: 4, program: Program::default() }
    }
}

/// Serves until the process ends; `ready` is told the address when calls are answered.
///
/// # Errors
/// Where the address cannot be listened on.
pub async fn serve(address: SocketAddr, scheduling: Scheduling, ready: impl FnOnce(SocketAddr)) -> Result<()> {
    let listener = TcpListener::bind(address).await.with_context(|| format!("cannot listen on {address}"))?;
    let address = listener.local_addr().context("cannot tell the address of the scheduler")?;
    let config = SchedulerConfig {
        bind_host: address.ip().to_string(),
        bind_port: address.port(),
        external_host: address.ip().to_string(),
        scheduling_policy: TaskSchedulingPolicy::PullStaged,
        executor_timeout_seconds: scheduling.executor_timeout_s,
        expire_dead_executor_interval_seconds: (scheduling.executor_timeout_s / 4).clamp(1, 15),
        no_executors_grace_period_seconds: scheduling.executor_timeout_s,
        task_max_failures: scheduling.task_failures,
        stage_max_failures: scheduling.task_failures,
        override_physical_codec: Some(Arc::new(Codec::default())),
        grpc_server_max_decoding_message_size: MESSAGE as u32,
        grpc_server_max_encoding_message_size: MESSAGE as u32,
        ..SchedulerConfig::default()
    };
    let cluster = BallistaCluster::new_from_config(&config).await?;
    let scheduler = create_scheduler::<LogicalPlanNode, PhysicalPlanNode>(cluster, Arc::new(config)).await?;
    let service =
        SchedulerGrpcServer::new(scheduler).max_decoding_message_size(MESSAGE).max_encoding_message_size(MESSAGE);
    let guarded = InterceptedService::new(service, only(&scheduling.program));
    ready(address);
    let incoming = TcpIncoming::from(listener).with_nodelay(Some(true));
    Server::builder().add_service(guarded).serve_with_incoming(incoming).await.context("the scheduler has ended")
}
