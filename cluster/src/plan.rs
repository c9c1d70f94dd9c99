//! The plan of a run: over the rows of its parts, one operator that grows the part of its row.
//!
//! It has as many partitions as its child, which has a row in each; and nothing may deal the rows out anew before it.
//! A leaf that made its own rows would be run whole by every task: a scheduler restricts a task to some partitions by
//! restricting the leaves that it knows.

use super::fault::Fault;
use super::order::Order;
use super::parts::{ANSWERS, Answer, Piece, ROWS};
use super::worker::Worker;
use arrow_array::RecordBatch;
use datafusion::common::tree_node::TreeNodeRecursion;
use datafusion::common::{Result, exec_err, internal_err};
use datafusion::datasource::memory::MemorySourceConfig;
use datafusion::error::DataFusionError;
use datafusion::execution::TaskContext;
use datafusion::physical_expr::{EquivalenceProperties, PhysicalExpr};
use datafusion::physical_plan::execution_plan::{Boundedness, EmissionType};
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::{
    ChildrenPropertiesMode, DisplayAs, DisplayFormatType, ExecutionPlan, ExecutionPlanProperties, Partitioning,
    PlanProperties, ReplaceChildrenOptions, SendableRecordBatchStream,
};
use futures::TryStreamExt;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Grows the part of the one row of each partition.
#[derive(Debug, Clone)]
pub struct GrowExec {
    rows: Arc<dyn ExecutionPlan>,
    order: Arc<Order>,
    /// The executor that it runs on; `None` where it is only planned.
    worker: Option<Arc<Worker>>,
    properties: Arc<PlanProperties>,
}

impl GrowExec {
    /// The operator over a plan of rows.
    pub fn new(rows: Arc<dyn ExecutionPlan>, order: Arc<Order>, worker: Option<Arc<Worker>>) -> Self {
        let partitions = rows.output_partitioning().partition_count();
        let properties = Arc::new(PlanProperties::new(
            EquivalenceProperties::new(Arc::clone(&ANSWERS)),
            Partitioning::UnknownPartitioning(partitions),
            EmissionType::Final,
            Boundedness::Bounded,
        ));
        Self { rows, order, worker, properties }
    }

    /// The plan of some parts: a partition with one row for each.
    ///
    /// # Errors
    /// None that DataFusion could have with rows of one kind.
    pub fn over(pieces: &[Piece], order: Arc<Order>) -> Result<Self> {
        let rows = pieces.iter().map(|piece| Ok(vec![piece.row()?])).collect::<Result<Vec<_>>>()?;
        Ok(Self::new(MemorySourceConfig::try_new_exec(&rows, Arc::clone(&ROWS), None)?, order, None))
    }

    /// What is asked for.
    pub fn order(&self) -> &Order {
        &self.order
    }
}

impl DisplayAs for GrowExec {
    fn fmt_as(&self, _: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "GrowExec: scenario={}, run={}", self.order.stated.scenario, self.order.fingerprint)
    }
}

impl ExecutionPlan for GrowExec {
    fn name(&self) -> &'static str {
        "GrowExec"
    }

    fn properties(&self) -> &Arc<PlanProperties> {
        &self.properties
    }

    fn benefits_from_input_partitioning(&self) -> Vec<bool> {
        vec![false]
    }

    fn children(&self) -> Vec<&Arc<dyn ExecutionPlan>> {
        vec![&self.rows]
    }

    fn apply_expressions(
        &self,
        _: &mut dyn FnMut(&Arc<dyn PhysicalExpr>) -> Result<TreeNodeRecursion>,
    ) -> Result<TreeNodeRecursion> {
        Ok(TreeNodeRecursion::Continue)
    }

    fn replace_children(
        self: Arc<Self>,
        children: Vec<Arc<dyn ExecutionPlan>>,
        _: ReplaceChildrenOptions,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let [rows] = children.as_slice() else {
            return internal_err!("GrowExec has one child, and got {}", children.len());
        };
        Ok(Arc::new(Self::new(Arc::clone(rows), Arc::clone(&self.order), self.worker.clone())))
    }

    // Deprecated, and still asked for by the trait.
    fn with_new_children(self: Arc<Self>, children: Vec<Arc<dyn ExecutionPlan>>) -> Result<Arc<dyn ExecutionPlan>> {
        self.replace_children(children, ReplaceChildrenOptions::new(ChildrenPropertiesMode::Recompute))
    }

    fn execute(&self, partition: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        let Some(worker) = self.worker.clone() else {
            return exec_err!("a part is grown by a phytomer-cluster executor alone");
        };
        let (rows, order) = (self.rows.execute(partition, context)?, Arc::clone(&self.order));
        let work = async move {
            let rows: Vec<RecordBatch> = rows.try_collect().await?;
            Ok::<_, DataFusionError>(answered(worker, order, Piece::only(&rows)).await?.row()?)
        };
        Ok(Box::pin(RecordBatchStreamAdapter::new(Arc::clone(&ANSWERS), futures::stream::once(work))))
    }
}

/// Tells a part that nobody waits for it any more, when the task that waits is dropped.
struct Left(Arc<AtomicBool>);

impl Drop for Left {
    fn drop(&mut self) {
        self.0.store(true, Relaxed);
    }
}

/// The answer for a part, which is grown on a thread of its own.
async fn answered(worker: Arc<Worker>, order: Arc<Order>, piece: Result<Piece, Fault>) -> Result<Answer> {
    let is_left = Arc::new(AtomicBool::new(false));
    let left = Left(Arc::clone(&is_left));
    let grown = tokio::task::spawn_blocking(move || worker.answer(&order, piece, &is_left)).await;
    drop(left);
    match grown {
        // An error of this kind is what Ballista tries again.
        Ok(answer) => answer.map_err(DataFusionError::IoError),
        Err(panic) => exec_err!("a part ended in a panic, which the executor's stderr tells: {panic}"),
    }
}
