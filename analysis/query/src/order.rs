//! The order of rows: the parts of a plan run at once, and what they give is taken part after part.
//!
//! DataFusion takes the rows of parts as they come, so that the order of groups, the sums of real numbers and rows of
//! equal rank would depend on threads. After its own rules this one replaces each place where parts meet: plain
//! meetings become [`InOrder`], merges of sorted parts prefer the earlier one, each part finds its own first rows
//! ([`Apart`]), and a join that keeps a side whole meets the other side as one part. Absent: the number of parts, which
//! the engine states, and the order of groups and ties once memory was too small and they went by the disk.

use super::aligned::{by_parts, is_plant, whole_files};
use super::step::{Plan, only};
use arrow_array::RecordBatch;
use datafusion::common::config::ConfigOptions;
use datafusion::common::tree_node::{Transformed, TreeNode, TreeNodeRecursion};
use datafusion::common::{DataFusionError, JoinType, Result};
use datafusion::execution::{SendableRecordBatchStream, TaskContext};
use datafusion::physical_expr::{EquivalenceProperties, LexOrdering, PhysicalExpr};
use datafusion::physical_optimizer::PhysicalOptimizerRule;
use datafusion::physical_plan::coalesce_partitions::CoalescePartitionsExec;
use datafusion::physical_plan::common::spawn_buffered;
use datafusion::physical_plan::joins::{HashJoinExec, NestedLoopJoinExec, PartitionMode};
use datafusion::physical_plan::sorts::sort::SortExec;
use datafusion::physical_plan::sorts::sort_preserving_merge::SortPreservingMergeExec;
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::{
    DisplayAs, DisplayFormatType, ExecutionPlan, ExecutionPlanProperties, Partitioning, PlanProperties,
    replace_children_if_necessary,
};
use futures::{Stream, StreamExt, stream};
use std::collections::VecDeque;
use std::fmt;
use std::sync::Arc;

/// The batches that a part may be ahead of those before it.
const AHEAD: usize = 2;

/// The rule that keeps rows in the order of parts.
#[derive(Debug)]
pub struct KeepOrder {
    /// The parts that run at once where parts meet.
    pub at_once: usize,
}

impl PhysicalOptimizerRule for KeepOrder {
    fn optimize(&self, plan: Plan, _options: &ConfigOptions) -> Result<Plan> {
        // From the top: a join by parts takes the meeting of one of its sides out.
        let aligned = plan.transform_down(|step| match step.downcast_ref::<HashJoinExec>() {
            Some(join) => Ok(by_parts(join)?.map_or_else(|| Transformed::no(step), Transformed::yes)),
            None => Ok(Transformed::no(step)),
        })?;
        Ok(self.as_one(aligned.data.transform_up(|step| self.kept(step))?.data))
    }

    fn name(&self) -> &'static str {
        "keep_order"
    }

    fn schema_check(&self) -> bool {
        true
    }
}

impl KeepOrder {
    /// A step of a plan, with its parts in order.
    fn kept(&self, plan: Plan) -> Result<Transformed<Plan>> {
        if let Some(meeting) = plan.downcast_ref::<CoalescePartitionsExec>() {
            let parts = InOrder::of(Arc::clone(meeting.input()), meeting.fetch(), self.at_once);
            return Ok(Transformed::yes(Arc::new(parts)));
        }
        if let Some(merge) = plan.downcast_ref::<SortPreservingMergeExec>() {
            return Ok(Transformed::yes(Arc::new(merge.clone().with_round_robin_repartition(false))));
        }
        if let Some(sort) = plan.downcast_ref::<SortExec>() {
            return match sort.fetch() {
                Some(_) if parts_of(&plan) > 1 => Ok(Transformed::yes(Arc::new(Apart::of(&plan)?))),
                Some(first) => match sort.input().downcast_ref::<InOrder>().filter(|parts| parts.fetch.is_none()) {
                    Some(parts) => first_of_parts(sort, first, parts).map(Transformed::yes),
                    None => Ok(Transformed::no(plan)),
                },
                None => Ok(match self.sorted_by_parts(sort)? {
                    Some(sorted) => Transformed::yes(sorted),
                    None => Transformed::no(plan),
                }),
            };
        }
        let hash =
            plan.downcast_ref::<HashJoinExec>().filter(|join| *join.partition_mode() != PartitionMode::Partitioned);
        let hash = hash.map(|join| *join.join_type());
        let joins = hash.or_else(|| plan.downcast_ref::<NestedLoopJoinExec>().map(|join| *join.join_type()));
        if joins.is_some_and(tells_left_at_the_end) && parts_of(&plan) > 1 {
            let sides: Vec<Plan> = plan.children().into_iter().map(|side| self.as_one(Arc::clone(side))).collect();
            return Ok(Transformed::yes(replace_children_if_necessary(plan, sides)?));
        }
        Ok(Transformed::no(plan))
    }

    /// A sort by the plant first, part by part: the plants of a part file come before those of the next.
    fn sorted_by_parts(&self, sort: &SortExec) -> Result<Option<Plan>> {
        let Some(parts) = sort.input().downcast_ref::<InOrder>().filter(|parts| parts.fetch.is_none()) else {
            return Ok(None);
        };
        let first = sort.expr().first();
        if first.options.descending || !is_plant(&parts.input, &first.expr) {
            return Ok(None);
        }
        let Some(input) = whole_files(&parts.input)? else { return Ok(None) };
        let apart: Plan = Arc::new(SortExec::new(sort.expr().clone(), input).with_preserve_partitioning(true));
        let sorted = InOrder::of(apart, None, self.at_once);
        Ok(Some(Arc::new(sorted.in_order_of(sort.expr().clone()))))
    }

    fn as_one(&self, plan: Plan) -> Plan {
        if parts_of(&plan) > 1 { Arc::new(InOrder::of(plan, None, self.at_once)) } else { plan }
    }
}

/// The first rows of all parts: those of each part, found apart and merged.
fn first_of_parts(sort: &SortExec, first: usize, parts: &InOrder) -> Result<Plan> {
    let of_part = SortExec::new(sort.expr().clone(), Arc::clone(&parts.input)).with_fetch(Some(first));
    let of_part: Plan = Arc::new(of_part.with_preserve_partitioning(true));
    let apart: Plan = Arc::new(Apart::of(&of_part)?);
    let merge = SortPreservingMergeExec::new(sort.expr().clone(), apart).with_fetch(Some(first));
    Ok(Arc::new(merge.with_round_robin_repartition(false)))
}

/// Whether rows of the left side are told by the part that ends last.
fn tells_left_at_the_end(join: JoinType) -> bool {
    use JoinType::{Full, Left, LeftAnti, LeftMark, LeftSemi};
    matches!(join, Left | Full | LeftAnti | LeftSemi | LeftMark)
}

fn parts_of(plan: &Plan) -> usize {
    plan.output_partitioning().partition_count()
}

/// The rows of all parts of a step, part after part; the next few run meanwhile.
#[derive(Debug)]
pub struct InOrder {
    input: Plan,
    /// The most rows that are wanted.
    fetch: Option<usize>,
    /// The parts that run at once.
    at_once: usize,
    properties: Arc<PlanProperties>,
}

impl InOrder {
    fn of(input: Plan, fetch: Option<usize>, at_once: usize) -> Self {
        let of = input.properties();
        let equal = EquivalenceProperties::new(input.schema());
        let one = Partitioning::UnknownPartitioning(1);
        let properties = Arc::new(PlanProperties::new(equal, one, of.emission_type, of.boundedness));
        Self { input, fetch, at_once, properties }
    }
}

impl InOrder {
    /// The same where the parts, one after the other, are in this order.
    fn in_order_of(mut self, order: LexOrdering) -> Self {
        let of = self.input.properties();
        let equal = EquivalenceProperties::new_with_orderings(self.input.schema(), [order]);
        let one = Partitioning::UnknownPartitioning(1);
        self.properties = Arc::new(PlanProperties::new(equal, one, of.emission_type, of.boundedness));
        self
    }
}

impl DisplayAs for InOrder {
    fn fmt_as(&self, _form: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fetch = self.fetch.map(|rows| format!(": fetch={rows}")).unwrap_or_default();
        write!(f, "InOrder{fetch}")
    }
}

impl ExecutionPlan for InOrder {
    fn name(&self) -> &'static str {
        "InOrder"
    }

    fn properties(&self) -> &Arc<PlanProperties> {
        &self.properties
    }

    fn children(&self) -> Vec<&Plan> {
        vec![&self.input]
    }

    fn apply_expressions(
        &self,
        _look: &mut dyn FnMut(&Arc<dyn PhysicalExpr>) -> Result<TreeNodeRecursion>,
    ) -> Result<TreeNodeRecursion> {
        Ok(TreeNodeRecursion::Continue)
    }

    fn with_new_children(self: Arc<Self>, children: Vec<Plan>) -> Result<Plan> {
        let parts = Self::of(only(children)?, self.fetch, self.at_once);
        Ok(Arc::new(match self.properties.output_ordering().cloned() {
            Some(order) => parts.in_order_of(order),
            None => parts,
        }))
    }

    fn execute(&self, _part: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        let (input, schema) = (Arc::clone(&self.input), self.input.schema());
        let begin = move |part| Ok(spawn_buffered(input.execute(part, Arc::clone(&context))?, AHEAD));
        let rows = in_turn((0..parts_of(&self.input)).map(begin), self.at_once);
        Ok(match self.fetch {
            None => Box::pin(RecordBatchStreamAdapter::new(schema, rows)),
            Some(most) => Box::pin(RecordBatchStreamAdapter::new(schema, first_of(rows, most))),
        })
    }
}

/// The rows of parts one after the other. A part begins when it is among the next `at_once`, so that what parts hold is
/// held by few at a time.
fn in_turn(
    parts: impl Iterator<Item = Result<SendableRecordBatchStream>>,
    at_once: usize,
) -> impl Stream<Item = Result<RecordBatch>> + Unpin {
    let begun = VecDeque::with_capacity(at_once);
    Box::pin(stream::try_unfold((parts, begun), move |(mut parts, mut begun)| async move {
        loop {
            while begun.len() < at_once.max(1)
                && let Some(part) = parts.next()
            {
                begun.push_back(part?);
            }
            let Some(first) = begun.front_mut() else { return Ok(None) };
            match first.next().await {
                Some(batch) => return Ok(Some((batch?, (parts, begun)))),
                None => _ = begun.pop_front(),
            }
        }
    }))
}

/// The first rows of a stream, which is asked for no batch more than they need.
fn first_of(
    rows: impl Stream<Item = Result<RecordBatch>> + Unpin,
    most: usize,
) -> impl Stream<Item = Result<RecordBatch>> {
    stream::unfold((rows, most), |(mut rows, left)| async move {
        if left == 0 {
            return None;
        }
        Some(match rows.next().await? {
            Ok(batch) => {
                let batch = batch.slice(0, batch.num_rows().min(left));
                let left = left - batch.num_rows();
                (Ok(batch), (rows, left))
            }
            Err(error) => (Err(error), (rows, 0)),
        })
    })
}

/// The first rows of each part by a sort, found by each for itself: one sort of all parts would let what one has found
/// leave out rows of equal rank of another.
#[derive(Debug)]
pub struct Apart {
    /// The sort, once a part.
    sorts: Vec<Plan>,
}

impl Apart {
    fn of(sort: &Plan) -> Result<Self> {
        let sorts = (0..parts_of(sort)).map(|_| Arc::clone(sort).reset_state()).collect::<Result<_>>()?;
        Ok(Self { sorts })
    }
}

impl DisplayAs for Apart {
    fn fmt_as(&self, _form: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Apart: parts={}", self.sorts.len())
    }
}

impl ExecutionPlan for Apart {
    fn name(&self) -> &'static str {
        "Apart"
    }

    fn properties(&self) -> &Arc<PlanProperties> {
        self.sorts[0].properties()
    }

    fn children(&self) -> Vec<&Plan> {
        vec![&self.sorts[0]]
    }

    fn apply_expressions(
        &self,
        _look: &mut dyn FnMut(&Arc<dyn PhysicalExpr>) -> Result<TreeNodeRecursion>,
    ) -> Result<TreeNodeRecursion> {
        Ok(TreeNodeRecursion::Continue)
    }

    fn with_new_children(self: Arc<Self>, children: Vec<Plan>) -> Result<Plan> {
        Ok(Arc::new(Self::of(&only(children)?)?))
    }

    fn execute(&self, part: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        let sort = self.sorts.get(part).ok_or_else(|| DataFusionError::Internal(format!("there is no part {part}")))?;
        sort.execute(part, context)
    }
}
