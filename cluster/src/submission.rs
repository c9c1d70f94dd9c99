//! Calls to a scheduler: whether it is there and of the same program, and a plan with its answers.

use super::codec::Codec;
use super::order::Order;
use super::parts::{Answer, Piece};
use super::plan::GrowExec;
use super::program::naming;
use super::scheduler::MESSAGE;
use anyhow::{Context, Result, bail};
use ballista_core::config::{BALLISTA_SCHEDULER_MAX_PARTITIONS_PER_TASK, BallistaConfig};
use ballista_core::execution_plans::execute_physical_plan;
use ballista_core::extension::SessionConfigExt;
use ballista_core::serde::protobuf::GetJobStatusParams;
use ballista_core::serde::protobuf::scheduler_grpc_client::SchedulerGrpcClient;
use datafusion::prelude::SessionConfig;
use datafusion_proto::protobuf::PhysicalPlanNode;
use futures::TryStreamExt;
use phytomer::run::Program;
use std::sync::Arc;
use std::time::Duration;
use tonic::transport::Endpoint;

/// How long a scheduler is waited for, seconds, before it is told that none answers.
const PATIENCE_S: u64 = 10;

/// Parts that are asked for at once: as many as one message holds by far.
const AT_ONCE: usize = 4096;

/// Calls a scheduler once, so that a wrong address and a foreign version are told before anything is begun.
///
/// # Errors
/// Where none answers, or one of another program.
pub async fn greet(scheduler: &str, program: &Program) -> Result<()> {
    let url = format!("http://{scheduler}");
    let endpoint = Endpoint::from_shared(url).with_context(|| format!("`{scheduler}` is no HOST:PORT"))?;
    let endpoint = endpoint.connect_timeout(Duration::from_secs(PATIENCE_S)).timeout(Duration::from_secs(PATIENCE_S));
    let endpoint = naming(program)(endpoint).map_err(|error| anyhow::anyhow!("{error}"))?;
    let channel = endpoint.connect().await.with_context(|| format!("no scheduler answers at {scheduler}"))?;
    let mut client = SchedulerGrpcClient::new(channel);
    match client.get_job_status(GetJobStatusParams { job_id: String::new() }).await {
        Err(status) if status.code() == tonic::Code::FailedPrecondition => bail!("{}", status.message()),
        Err(status) if status.code() == tonic::Code::Unavailable => {
            bail!("the scheduler at {scheduler} does not answer: {}", status.message())
        }
        Err(status) if status.code() == tonic::Code::Unimplemented => {
            bail!("what answers at {scheduler} is no scheduler")
        }
        // That there is no such run is an answer too.
        _ => Ok(()),
    }
}

/// Asks for parts and waits for their answers, some thousand at a time.
///
/// # Errors
/// What the scheduler tells of the run as a whole: a part that failed too often, or that the scheduler is gone.
pub async fn ask(scheduler: &str, pieces: &[Piece], order: &Arc<Order>, program: &Program) -> Result<Vec<Answer>> {
    let (mut answers, codec) = (Vec::new(), Codec::default());
    for some in pieces.chunks(AT_ONCE) {
        let plan = Arc::new(GrowExec::over(some, Arc::clone(order))?);
        // A task has one part: when an executor is lost, so are the parts that it grew just then, and no others.
        let session = SessionConfig::new_with_ballista()
            .set_str(BALLISTA_SCHEDULER_MAX_PARTITIONS_PER_TASK, "1")
            .with_ballista_adaptive_query_planner(false)
            .with_ballista_job_name(&order.stated.scenario)
            .with_ballista_grpc_client_max_message_size(MESSAGE)
            .with_ballista_override_create_grpc_client_endpoint(naming(program));
        let config: BallistaConfig = session.ballista_config();
        let (url, name) = (format!("http://{scheduler}"), order.submission.clone());
        let asked = execute_physical_plan::<PhysicalPlanNode>(url, &config, plan, &codec, name, session);
        let batches = asked.await?.try_collect::<Vec<_>>().await?;
        for batch in batches {
            answers.extend(Answer::all(&batch)?);
        }
    }
    Ok(answers)
}
