//! The engine over some runs: their part files as tables, the views and table functions over them, and the run of a
//! query.
//!
//! A table of a run is the list of its part files that the run's papers name, never a pattern, so a query sees what
//! `describe` sees. Memory that sorts, joins and groups ask for is limited; beyond it they write to the temporary
//! folder of the system. Every scan is cut into [`PARTS`] parts, which threads share, and parts meet in their order
//! (`order`), so that rows, their order and the sums of real numbers do not depend on the number of threads. Absent:
//! what becomes of the rows (`output`).

use super::codes::GroupByCodes;
use super::error::Error;
use super::functions::Macro;
use super::order::KeepOrder;
use super::output::Rows;
use super::stop::Stop;
use arrow_schema::Schema;
use datafusion::catalog::{MemorySchemaProvider, SchemaProvider};
use datafusion::common::DataFusionError;
use datafusion::common::config::ConfigNonZeroUsize;
use datafusion::datasource::ViewTable;
use datafusion::datasource::file_format::parquet::ParquetFormat;
use datafusion::datasource::listing::{ListingOptions, ListingTable, ListingTableConfig, ListingTableUrl};
use datafusion::execution::context::SQLOptions;
use datafusion::execution::memory_pool::FairSpillPool;
use datafusion::execution::runtime_env::{RuntimeEnv, RuntimeEnvBuilder};
use datafusion::execution::session_state::SessionStateBuilder;
use datafusion::logical_expr::LogicalPlan;
use datafusion::prelude::{SessionConfig, SessionContext};
use futures::StreamExt;
use phytomer_outputs::Table;
use phytomer_outputs::read::Run;
use phytomer_outputs::views::{Relation, relations};
use phytomer_outputs::views_of_run::tables_of;
use std::sync::Arc;
use tokio::runtime::{Builder, Runtime};

/// The schema that holds the tables of single runs.
const FILES: &str = "files";

/// The longest SQL, bytes. A sum of as many terms as fit is a tree as deep, which is planned, and dropped, by
/// recursion.
const LONGEST: usize = 64 << 10;

/// The stack of a query; what is not used of it takes no memory.
const STACK_BYTES: usize = 1 << 30;

/// The batches of rows that find room in the memory, at least.
const BATCHES: usize = 64;

/// The bytes of a row, about.
const BYTES_A_ROW: usize = 128;

/// The parts of a scan, on any number of threads: what parts find and where they meet is the same everywhere.
const PARTS: usize = 8;

/// The most threads that read files and write what memory does not hold, beside those that compute.
const READERS: usize = 16;

/// What a query may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// The memory that sorts, joins and groups may take before they write to the disk, bytes.
    pub memory_bytes: usize,
    /// The threads that work on a query; 0 for as many as the machine has.
    pub threads: usize,
}

impl Default for Settings {
    /// 2 GiB and all threads of the machine.
    fn default() -> Self {
        Self { memory_bytes: 2 << 30, threads: 0 }
    }
}

/// An engine over some runs.
pub struct Engine {
    runtime: Runtime,
    context: SessionContext,
}

impl Engine {
    /// An engine over runs, each with its name in the column `run`.
    ///
    /// # Errors
    /// Where the part files of a run cannot be read.
    pub fn over(runs: &[(String, Run)], settings: &Settings) -> Result<Self, Error> {
        let threads = match settings.threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            threads => threads,
        };
        let runtime = Builder::new_multi_thread()
            .worker_threads(threads.min(PARTS))
            .max_blocking_threads(READERS)
            .thread_stack_size(STACK_BYTES)
            .build()
            .map_err(|error| Error::Run(format!("no threads can be started: {error}")))?;
        let pool = Arc::new(FairSpillPool::new(settings.memory_bytes));
        let environment = RuntimeEnvBuilder::new().with_memory_pool(pool).build_arc();
        let environment = environment.map_err(|error| Error::of_run(&error))?;
        let config = config_of(settings.memory_bytes)?;
        let order = KeepOrder { at_once: threads + 1 };
        let engine = Self { runtime, context: context_of(config, environment, order) };
        engine.lay_out(runs)?;
        Ok(engine)
    }

    /// Registers the tables, views and table functions of the runs.
    fn lay_out(&self, runs: &[(String, Run)]) -> Result<(), Error> {
        let files = Arc::new(MemorySchemaProvider::new());
        let mut laid = Vec::new();
        for (number, (name, run)) in runs.iter().enumerate() {
            let place = |table: Table| format!("{}_{number}", table.name());
            laid.push(tables_of(run, name, |table| format!("{FILES}.{}", place(table)))?);
            for table in Table::ALL {
                let Some(schema) = run.schema(table)? else { continue };
                let listed = listing(run, table, &schema)?;
                files.register_table(place(table), Arc::new(listed)).map_err(|error| Error::of_run(&error))?;
            }
        }
        let catalog = self.context.catalog("datafusion");
        let registered = catalog.map(|catalog| catalog.register_schema(FILES, files)).transpose();
        registered.map_err(|error| Error::of_run(&error))?;
        relations(&laid).iter().try_for_each(|relation| self.relate(relation)).map_err(|error| Error::of_run(&error))
    }

    fn relate(&self, relation: &Relation) -> Result<(), DataFusionError> {
        let sql = relation.body(|place, _| format!("${}", place + 1));
        let plan = self.runtime.block_on(self.context.state().create_logical_plan(&sql));
        let plan = plan.map_err(|error| error.context(format!("the view {}: {sql}", relation.name)))?;
        match relation.parameters {
            None => self.context.register_table(relation.name, Arc::new(ViewTable::new(plan, None))).map(drop),
            Some(parameters) => {
                let function = Macro { name: relation.name, parameters, plan };
                self.context.register_udtf(relation.name, Arc::new(function));
                Ok(())
            }
        }
    }

    /// Runs a query and hands its rows on, batch after batch. Returns their number.
    ///
    /// # Errors
    /// [`Error::Sql`] and [`Error::ReadOnly`] before anything is read; those of the run and of `rows` later.
    pub fn query(&self, sql: &str, stop: &Stop, rows: &mut dyn Rows) -> Result<u64, Error> {
        if sql.len() > LONGEST {
            let length = sql.len();
            return Err(Error::Sql(format!(
                "the SQL has {length} bytes; expected at most {LONGEST}: split the question"
            )));
        }
        let work = || {
            self.runtime.block_on(async {
                tokio::select! {
                    biased;
                    () = stop.stopped() => Err(Error::Interrupted),
                    done = self.run(sql, rows) => done,
                }
            })
        };
        std::thread::scope(|scope| {
            let thread = std::thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, work);
            let thread = thread.map_err(|error| Error::Run(format!("no thread can be started: {error}")))?;
            thread.join().unwrap_or_else(|_| Err(Error::Run("a part of DataFusion gave up".to_owned())))
        })
    }

    async fn run(&self, sql: &str, rows: &mut dyn Rows) -> Result<u64, Error> {
        let plan = self.context.state().create_logical_plan(sql).await.map_err(|error| Error::of_sql(sql, &error))?;
        only_reads(&plan)?;
        let frame = self.context.execute_logical_plan(plan).await.map_err(|error| Error::of_sql(sql, &error))?;
        let mut stream = frame.execute_stream().await.map_err(|error| Error::of_sql(sql, &error))?;
        rows.begin(&stream.schema())?;
        let mut count = 0;
        while let Some(batch) = stream.next().await {
            let batch = batch.map_err(|error| Error::of_run(&error))?;
            count += batch.num_rows() as u64;
            rows.add(&batch)?;
            tokio::task::yield_now().await;
        }
        Ok(count)
    }
}

/// What DataFusion may do: it cuts the files of a table into [`PARTS`] ranges and nothing else into parts, takes no
/// range from a slower part, and looks for first rows in each part alone, so that time decides nothing.
fn config_of(memory_bytes: usize) -> Result<SessionConfig, Error> {
    let mut config = SessionConfig::new().with_target_partitions(PARTS).with_information_schema(true);
    let options = config.options_mut();
    options.sql_parser.collect_spans = true;
    options.execution.parquet.pushdown_filters = true;
    options.execution.enable_file_stream_work_stealing = false;
    options.optimizer.enable_round_robin_repartition = false;
    options.optimizer.repartition_aggregations = false;
    options.optimizer.repartition_joins = false;
    options.optimizer.repartition_windows = false;
    // Sorts of all parts at once would leave no memory for their merge; first rows are found in parts all the same.
    options.optimizer.repartition_sorts = false;
    options.optimizer.enable_topk_dynamic_filter_pushdown = false;
    // It waits until the first side of all parts of a join is there, and parts are joined in turn.
    options.optimizer.enable_join_dynamic_filter_pushdown = false;
    // A merge holds a batch of each of its inputs, which no disk can take: where memory is little, batches are
    // small, and the merge of sorted files gets its part.
    let most = options.execution.batch_size.get();
    let rows = (memory_bytes / (BATCHES * BYTES_A_ROW)).clamp(128, most);
    options.execution.batch_size = ConfigNonZeroUsize::try_new(rows).map_err(|error| Error::of_run(&error))?;
    let for_merges = options.execution.sort_spill_reservation_bytes;
    options.execution.sort_spill_reservation_bytes = for_merges.min(memory_bytes / 20);
    Ok(config)
}

fn context_of(config: SessionConfig, environment: Arc<RuntimeEnv>, order: KeepOrder) -> SessionContext {
    let state = SessionStateBuilder::new().with_config(config).with_runtime_env(environment).with_default_features();
    SessionContext::new_with_state(
        state
            .with_optimizer_rule(Arc::new(GroupByCodes::default()))
            .with_physical_optimizer_rule(Arc::new(order))
            .build(),
    )
}

/// Refuses a plan that would change anything.
fn only_reads(plan: &LogicalPlan) -> Result<(), Error> {
    let options = SQLOptions::new().with_allow_ddl(false).with_allow_dml(false).with_allow_statements(false);
    options.verify_plan(plan).map_err(|error| {
        let words = error.strip_backtrace();
        let what = words.rsplit(": ").next().unwrap_or_default().trim();
        Error::ReadOnly(format!("`{what}` is refused"))
    })
}

/// The part files of a table of a run.
fn listing(run: &Run, table: Table, schema: &Schema) -> Result<ListingTable, Error> {
    let url = |path: &std::path::PathBuf| {
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.clone());
        ListingTableUrl::parse(file_url(&whole.display().to_string()))
    };
    let urls = run.parts(table)?.iter().map(url).collect::<Result<Vec<_>, _>>();
    let urls = urls.map_err(|error| Error::of_run(&error))?;
    let options = ListingOptions::new(Arc::new(ParquetFormat::default())).with_file_extension(".parquet");
    let schema = Arc::new(schema.clone().with_metadata(std::collections::HashMap::new()));
    let config = ListingTableConfig::new_with_multi_paths(urls).with_listing_options(options).with_schema(schema);
    ListingTable::try_new(config).map_err(|error| Error::of_run(&error))
}

/// The path of a file as a URL, in which no character of a name is a pattern.
fn file_url(path: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/-_.~".contains(&byte);
    let mut url = String::from(if path.starts_with('/') { "file://" } else { "file:///" });
    for byte in path.bytes().map(|byte| if byte == b'\\' && cfg!(windows) { b'/' } else { byte }) {
        if plain(byte) || (byte == b':' && cfg!(windows)) {
            url.push(char::from(byte));
        } else {
            url += &format!("%{byte:02X}");
        }
    }
    url
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_character_of_a_path_is_a_pattern() {
        assert_eq!(file_url("/a b/[1]*?%/é.parquet"), "file:///a%20b/%5B1%5D%2A%3F%25/%C3%A9.parquet");
    }
}
