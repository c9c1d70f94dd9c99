//! Joins and sorts within parts: tables of one run that are joined by the plant are joined part file by part file.
//!
//! A part file has whole plots, so rows of one plant lie in part files of one name in every table of the run. Where
//! both sides of a join are scans of such tables, narrowed or not, and `plant_id` of both is among the keys, this rule
//! gives both scans the same files part by part and lets each part be joined by itself: what is held at once is a part
//! and not the whole side, and parts are joined on all threads. Rows that are sorted by the plant first can be sorted
//! in the same parts (`order`). Absent: joins of several runs, and of what was grouped.

use super::step::{Plan, only};
use datafusion::common::tree_node::TreeNodeRecursion;
use datafusion::common::{JoinType, Result};
use datafusion::datasource::physical_plan::{FileGroup, FileScanConfig, FileScanConfigBuilder};
use datafusion::datasource::source::DataSourceExec;
use datafusion::execution::{SendableRecordBatchStream, TaskContext};
use datafusion::physical_expr::PhysicalExpr;
use datafusion::physical_expr::expressions::Column;
use datafusion::physical_plan::coalesce_partitions::CoalescePartitionsExec;
use datafusion::physical_plan::coop::CooperativeExec;
use datafusion::physical_plan::filter::FilterExec;
use datafusion::physical_plan::joins::{HashJoinExec, HashJoinExecBuilder, PartitionMode};
use datafusion::physical_plan::projection::ProjectionExec;
use datafusion::physical_plan::{
    DisplayAs, DisplayFormatType, ExecutionPlan, Partitioning, PlanProperties, replace_children_if_necessary,
};
use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

/// The most parts of a join: so many that one is small beside the caches of a processor.
const PARTS: usize = 64;

/// The column that is the same for all rows of a plant of a run.
const PLANT: &str = "plant_id";

/// The part files of one run that a step reads.
struct Files {
    /// The folder of the run.
    folder: String,
    /// The names of the files, which are the same in every table of the run.
    names: BTreeSet<String>,
}

/// The join by parts; `None` where its sides are no scans of one run by the plant.
pub fn by_parts(join: &HashJoinExec) -> Result<Option<Plan>> {
    let Some(files) = joined_files(join) else { return Ok(None) };
    match files.parts() {
        Some(parts) => joined_in(join, &parts),
        None => Ok(None),
    }
}

/// A step that reads whole files of one run part by part, in the order of their names; `None` where it reads more.
pub fn whole_files(plan: &Plan) -> Result<Option<Plan>> {
    match files_of(plan).as_ref().and_then(Files::parts) {
        Some(parts) => dealt(plan, &parts),
        None => Ok(None),
    }
}

impl Files {
    /// The names in the parts of a step; `None` where there are not two.
    fn parts(&self) -> Option<Vec<BTreeSet<&str>>> {
        let mut names: Vec<&str> = self.names.iter().map(String::as_str).collect();
        // By their numbers: one of six digits comes after all of five.
        names.sort_by_key(|name| (name.len(), *name));
        let in_part = names.len().div_ceil(PARTS).max(1);
        let parts: Vec<BTreeSet<&str>> = names.chunks(in_part).map(|names| names.iter().copied().collect()).collect();
        (parts.len() > 1).then_some(parts)
    }
}

/// The files of a join that can be joined part by part.
fn joined_files(join: &HashJoinExec) -> Option<Files> {
    let [left, right] = [join.left(), join.right()].map(one_by_one);
    let (mut files, others) = (files_of(&left)?, files_of(&right)?);
    let by_plant = join.on().iter().any(|(a, b)| is_plant(&left, a) && is_plant(&right, b));
    let joins = *join.partition_mode() == PartitionMode::CollectLeft && !join.null_aware && join.fetch().is_none();
    files.names.extend(others.names);
    (joins && by_plant && files.folder == others.folder).then_some(files)
}

/// The join of sides that read the files of each part by themselves.
fn joined_in(join: &HashJoinExec, parts: &[BTreeSet<&str>]) -> Result<Option<Plan>> {
    let [left, right] = [join.left(), join.right()].map(one_by_one);
    let (Some(left), Some(right)) = (dealt(&left, parts)?, dealt(&right, parts)?) else { return Ok(None) };
    let (of_left, of_right) = join.on().iter().cloned().unzip();
    let [left, right] = [(left, of_left), (right, of_right)].map(|(side, keys)| Keyed::of(side, keys));
    let joined = HashJoinExecBuilder::from(join).with_partition_mode(PartitionMode::Partitioned);
    joined.with_new_children(vec![left, right])?.recompute_properties().build_exec().map(Some)
}

/// A side of a join before its parts meet.
fn one_by_one(side: &Plan) -> Plan {
    match side.downcast_ref::<CoalescePartitionsExec>() {
        Some(meeting) if meeting.fetch().is_none() => Arc::clone(meeting.input()),
        _ => Arc::clone(side),
    }
}

/// The step below one that takes rows one by one and keeps the parts.
fn below(plan: &Plan) -> Option<&Plan> {
    let filter = plan.downcast_ref::<FilterExec>().filter(|filter| filter.fetch().is_none()).map(FilterExec::input);
    let projection = plan.downcast_ref::<ProjectionExec>().map(ProjectionExec::input);
    let cooperative = plan.downcast_ref::<CooperativeExec>().map(CooperativeExec::input);
    filter.or(projection).or(cooperative)
}

fn scan_of(plan: &Plan) -> Option<&FileScanConfig> {
    plan.downcast_ref::<DataSourceExec>()?.data_source().downcast_ref::<FileScanConfig>()
}

/// The files that a side reads; `None` where it is more than scans and joins of one run, or not all of its rows.
fn files_of(plan: &Plan) -> Option<Files> {
    if let Some(join) = plan.downcast_ref::<HashJoinExec>() {
        return joined_files(join);
    }
    if let Some(below) = below(plan) {
        return files_of(below);
    }
    let scan = scan_of(plan).filter(|scan| scan.limit.is_none())?;
    let mut folders = BTreeSet::new();
    let mut names = BTreeSet::new();
    for file in scan.file_groups.iter().flat_map(FileGroup::iter) {
        let path = file.object_meta.location.as_ref();
        let (table, name) = path.rsplit_once('/')?;
        folders.insert(table.rsplit_once('/')?.0.to_owned());
        names.insert(name.to_owned());
    }
    let folder = folders.pop_first().filter(|_| folders.is_empty())?;
    Some(Files { folder, names })
}

/// Whether an expression over a side is the number of the plant as its files state it.
pub fn is_plant(plan: &Plan, expr: &Arc<dyn PhysicalExpr>) -> bool {
    let Some(column) = expr.downcast_ref::<Column>() else { return false };
    if let Some(projection) = plan.downcast_ref::<ProjectionExec>() {
        return projection.expr().get(column.index()).is_some_and(|of| is_plant(projection.input(), &of.expr));
    }
    if let Some(filter) = plan.downcast_ref::<FilterExec>() {
        let place = kept_at(filter.projection().as_deref(), column.index());
        return place.is_some_and(|place| is_plant(filter.input(), &column_at(place)));
    }
    if let Some(join) = plan.downcast_ref::<HashJoinExec>() {
        let Some(place) = kept_at(join.projection.as_deref(), column.index()) else { return false };
        // A side that a join fills with nulls has no plant in these rows.
        let [left, right] = [join.left(), join.right()].map(one_by_one);
        let of_left = left.schema().fields().len();
        return match place.checked_sub(of_left) {
            _ if *join.join_type() != JoinType::Inner => false,
            None => is_plant(&left, &column_at(place)),
            Some(place) => is_plant(&right, &column_at(place)),
        };
    }
    if let Some(below) = below(plan) {
        return is_plant(below, expr);
    }
    let Some(projection) = scan_of(plan).and_then(|scan| scan.file_source().projection()) else { return false };
    let of = projection.as_ref().get(column.index()).and_then(|of| of.expr.downcast_ref::<Column>());
    of.is_some_and(|column| column.name() == PLANT)
}

/// The place of a column before a step kept some of them.
fn kept_at(kept: Option<&[usize]>, place: usize) -> Option<usize> {
    kept.map_or(Some(place), |kept| kept.get(place).copied())
}

fn column_at(place: usize) -> Arc<dyn PhysicalExpr> {
    Arc::new(Column::new("", place))
}

/// A side that reads whole files, those of each part by themselves.
fn dealt(plan: &Plan, parts: &[BTreeSet<&str>]) -> Result<Option<Plan>> {
    if let Some(join) = plan.downcast_ref::<HashJoinExec>() {
        return joined_in(join, parts);
    }
    if let Some(below) = below(plan) {
        let Some(below) = dealt(below, parts)? else { return Ok(None) };
        return replace_children_if_necessary(Arc::clone(plan), vec![below]).map(Some);
    }
    let Some(scan) = scan_of(plan) else { return Ok(None) };
    let mut seen = BTreeSet::new();
    let mut groups = vec![Vec::new(); parts.len()];
    for file in scan.file_groups.iter().flat_map(FileGroup::iter) {
        let path = file.object_meta.location.as_ref();
        let name = path.rsplit_once('/').map_or(path, |(_, name)| name);
        let Some(part) = parts.iter().position(|part| part.contains(name)) else { return Ok(None) };
        // A scan may read a file in several ranges.
        if seen.insert(path.to_owned()) {
            let mut whole = file.clone();
            whole.range = None;
            groups[part].push(whole);
        }
    }
    let groups = groups.into_iter().map(FileGroup::new).collect();
    let dealt =
        FileScanConfigBuilder::from(scan.clone()).with_file_groups(groups).with_output_partitioning(None).build();
    Ok(Some(DataSourceExec::from_data_source(dealt)))
}

/// A step whose parts have no key in common, which the step itself cannot tell.
#[derive(Debug)]
struct Keyed {
    input: Plan,
    properties: Arc<PlanProperties>,
}

impl Keyed {
    fn of(input: Plan, keys: Vec<Arc<dyn PhysicalExpr>>) -> Plan {
        let of = input.properties();
        let parts = Partitioning::Hash(keys, of.partitioning.partition_count());
        let properties = PlanProperties::new(of.eq_properties.clone(), parts, of.emission_type, of.boundedness);
        Arc::new(Self { properties: Arc::new(properties), input })
    }
}

impl DisplayAs for Keyed {
    fn fmt_as(&self, _form: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Keyed")
    }
}

impl ExecutionPlan for Keyed {
    fn name(&self) -> &'static str {
        "Keyed"
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
        let Partitioning::Hash(keys, _) = &self.properties.partitioning else { return only(children) };
        Ok(Self::of(only(children)?, keys.clone()))
    }

    fn execute(&self, part: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        self.input.execute(part, context)
    }
}
