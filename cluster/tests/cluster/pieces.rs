//! The operator that grows, without a scheduler: one row a task, a part that two executors grow, and orders that do not
//! fit the executor.

use super::home::stated;
use arrow_array::RecordBatch;
use datafusion::datasource::memory::MemorySourceConfig;
use datafusion::execution::TaskContext;
use datafusion::physical_plan::ExecutionPlan;
use futures::TryStreamExt;
use phytomer::outputs::{SystemSpace, fingerprint};
use phytomer::run::{Program, plan_of};
use phytomer_cluster::fault::Kind;
use phytomer_cluster::order::Order;
use phytomer_cluster::parts::{Answer, Piece, ROWS};
use phytomer_cluster::plan::GrowExec;
use phytomer_cluster::store::{Held, Store};
use phytomer_cluster::worker::Worker;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The order of the scenario of the tests, and the rows of its parts.
fn ordered(folder: &Path) -> (Held, Order, Vec<Piece>) {
    let resolved = stated().resolved().unwrap_or_else(|report| panic!("{}", report.render(false)));
    let program = Program::default();
    let plan = plan_of(&resolved, &program).unwrap();
    let store = Store::of(folder, &fingerprint(&plan), plan.shards());
    let held = Held::take(store, (false, false)).unwrap();
    let order = Order {
        version: program.version,
        git_hash: program.git_hash,
        stated: stated(),
        fingerprint: fingerprint(&plan),
        shards: plan.shards(),
        folder: folder.to_path_buf(),
        submission: held.begin().unwrap(),
        ignore_disk: false,
    };
    let pieces = (0..plan.shards()).map(|shard| Piece { shard, plots: plan.plots_of(shard) }).collect();
    (held, order, pieces)
}

/// What a task with these rows answers.
fn answers(rows: &[RecordBatch], order: &Order) -> Answer {
    let rows = MemorySourceConfig::try_new_exec(&[rows.to_vec()], Arc::clone(&ROWS), None).unwrap();
    let plan = GrowExec::new(rows, Arc::new(order.clone()), Some(Arc::new(Worker::new("a"))));
    assert_eq!(plan.benefits_from_input_partitioning(), [false]);
    let runtime = tokio::runtime::Builder::new_multi_thread().build().unwrap();
    let batches: Vec<RecordBatch> =
        runtime.block_on(async { plan.execute(0, Arc::new(TaskContext::default()))?.try_collect().await }).unwrap();
    let mut all: Vec<Answer> = batches.iter().flat_map(|batch| Answer::all(batch).unwrap()).collect();
    assert_eq!(all.len(), 1);
    all.remove(0)
}

#[test]
fn a_task_grows_the_part_of_its_row() {
    let home = tempfile::tempdir().unwrap();
    let (held, order, pieces) = ordered(home.path());
    let row = |shard: usize| pieces[shard].row().unwrap();
    // The task is the first and only one of its plan; the row says part 7.
    let answer = answers(&[row(7)], &order);
    let grown = answer.outcome.clone().unwrap();
    assert_eq!((answer.shard, grown.now, held.store().there()), (Some(7), true, 1));
    assert!(grown.rows["summary"] > 0 && held.store().part(7).is_dir());
    // Once more, as for an executor that was lost after its answer: nothing is grown twice, and the answer is the same.
    let again = answers(&[row(7)], &order).outcome.unwrap();
    assert_eq!((again.rows, again.bytes, again.now), (grown.rows, grown.bytes, false));
    for (rows, told) in [(vec![], "0 rows"), (vec![row(1), row(2)], "2 rows")] {
        let answer = answers(&rows, &order);
        let fault = answer.outcome.unwrap_err();
        assert!(answer.shard.is_none() && fault.kind == Kind::WrongRow && fault.text.contains(told), "{fault}");
    }
    assert_eq!(held.store().there(), 1, "no part was grown for a wrong row");
}

#[test]
fn orders_that_do_not_fit_are_told() {
    let home = tempfile::tempdir().unwrap();
    let (held, order, pieces) = ordered(home.path());
    let worker = Worker::new("a");
    let left = AtomicBool::new(false);
    let fault = |order: &Order, piece: &Piece| {
        worker.answer(order, Ok(piece.clone()), &left).unwrap().outcome.expect_err("a fault")
    };
    let changed = |change: &dyn Fn(&mut Order)| {
        let mut order = order.clone();
        change(&mut order);
        fault(&order, &pieces[0])
    };
    type Change<'a> = &'a dyn Fn(&mut Order);
    let cases: [(Kind, &str, Change); 5] = [
        (Kind::ForeignVersion, "asked for by phytomer-cluster/9.9.9", &|order| order.version = "9.9.9".to_owned()),
        (Kind::ForeignScenario, "is another one here", &|order| order.stated.seed = Some(77)),
        (Kind::ForeignScenario, "cannot be read here", &|order| order.stated.scenario = "/nowhere/a.toml".to_owned()),
        (Kind::NotShared, "under the same path", &|order| order.folder = "/nowhere".into()),
        (Kind::Superseded, "asked for anew", &|order| order.submission = "earlier".to_owned()),
    ];
    for (kind, told, change) in cases {
        let fault = changed(change);
        assert!(fault.kind == kind && fault.text.contains(told), "{kind:?}: {fault}");
    }
    for piece in
        [Piece { shard: 12, plots: 0..4 }, Piece { shard: 1, plots: 4..7 }, Piece { shard: u32::MAX, plots: 0..0 }]
    {
        let fault = fault(&order, &piece);
        assert!(fault.kind == Kind::WrongRow && fault.text.contains("the run has 12 parts"), "{fault}");
    }
    let foreign = Program { version: "0.0.1".to_owned(), git_hash: "abc".to_owned() };
    let worker = Worker::new("b").acting_as(foreign, Arc::new(SystemSpace));
    let fault = worker.answer(&order, Ok(pieces[0].clone()), &left).unwrap().outcome.unwrap_err();
    assert!(fault.text.contains("the executor is phytomer-cluster/0.0.1 (abc)"), "{fault}");
    assert_eq!(held.store().there(), 0);
}
